//! The page of an analysis: what it calls the signals, and what it is made of.

use brinell::analysis::Analysis;
use brinell_measured::{Diagnosis, Measurement};
use brinell_report::{AnalysisReport, Analyzed, Findings, Table};

/// Most letters of a name of file or channel in titles and legends.
const LONGEST_NAME: usize = 24;

pub(super) fn report(found: &brinell_measured::Findings) -> AnalysisReport {
    let result = found.lead();
    let mut report = on_page(found, |findings| AnalysisReport::of_findings(&findings));
    if found.bearings.len() > 1 {
        report.verdict = format!("{}: {}", result.name, report.verdict);
        report.tables.insert(0, table(&found.bearings));
    }
    report
}

/// What pages are made of, of the bearing that leads.
pub(super) fn on_page<T>(found: &brinell_measured::Findings, make: impl FnOnce(Findings) -> T) -> T {
    let (m, result) = (&found.measurement, found.lead());
    // In whole, which the title may have shortened.
    let mut notes: Vec<String> =
        m.records().map(|record| format!("{}, channel {}", record.path.display(), record.channel.value)).collect();
    notes.extend(found.notes.iter().cloned());
    if let Some(other) = &result.against {
        let path = other.measurement.path.display();
        notes.extend(other.measurement.notes().iter().map(|note| format!("of {path}: {note}")));
    }
    let other_name = result.against.as_ref().map(|other| name(&other.measurement));
    let against = result.against.as_ref().zip(other_name.as_deref());
    make(Findings {
        signal: signal(m, &name(m), &result.analysis),
        unit: &m.unit.value,
        verdict: &result.verdict_text(),
        notes: &notes,
        warnings: &found.warnings,
        speed: &found.speed,
        bearing: &result.said_of_bearing(),
        levels: &result.levels,
        velocity: found.velocity.as_ref(),
        against: against.map(|(other, name)| {
            let signal = signal(&other.measurement, name, &other.analysis);
            (signal, &other.comparison)
        }),
    })
}

/// The damaged parts in a word or two each, or what is said instead.
pub(super) fn called(result: &Diagnosis) -> String {
    let whose = result.lines_of.as_ref().map(|name| format!(", lines of {name}"));
    brinell_report::called(&result.analysis) + &whose.unwrap_or_default()
}

/// The bearings on the page.
fn table(results: &[Diagnosis]) -> Table {
    let row = |result: &Diagnosis| {
        let call = result.call();
        let found = call.map(|f| {
            let hz = f.frequency;
            [format!("{} at {hz:.2} Hz", f.name), format!("{:.1}", f.score)]
        });
        let [frequency, score] = found.unwrap_or(["–", "–"].map(str::to_owned));
        vec![result.name.clone(), called(result), frequency, score, result.verdict_text()]
    };
    Table::new(
        "Bearings",
        ["Bearing", "Damage", "Frequency", "#Score", "Verdict"],
        results.iter().map(row),
        "Each bearing is judged by itself, and one sensor records all. The pictures are of the one that leads, or of the first.",
    )
}

fn signal<'a>(m: &'a Measurement, name: &'a str, analysis: &'a Analysis) -> Analyzed<'a> {
    Analyzed { name, x: &m.x, rate: m.rate.value, analysis }
}

/// File and channel.
fn name(m: &Measurement) -> String {
    // `signals.parquet` is what every run calls it: its folder tells more.
    let own = m.path.file_stem().is_some_and(|n| n == "signals");
    let of = if own { m.path.parent() } else { None };
    let file = of.and_then(|f| f.file_name()).or_else(|| m.path.file_name()).map(|n| n.to_string_lossy().into_owned());
    let others = if m.others.is_empty() { String::new() } else { format!(" and {} more", m.others.len()) };
    format!("{}{others} · {}", shortened(&file.unwrap_or_default()), shortened(&m.channel.value))
}

/// A name that fits a legend: of a long one its ends, which tell most.
fn shortened(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= LONGEST_NAME {
        return name.to_owned();
    }
    let (head, tail) = (LONGEST_NAME / 2, LONGEST_NAME - LONGEST_NAME / 2 - 1);
    let of = |part: &[char]| part.iter().collect::<String>();
    format!("{}…{}", of(&letters[..head]), of(&letters[letters.len() - tail..]))
}
