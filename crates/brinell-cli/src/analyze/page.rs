//! The page of an analysis: what it calls the signals, and what it is made of.

use super::diagnosis::Diagnosis;
use super::measured::Measured;
use brinell::analysis::Analysis;
use brinell_report::{AnalysisReport, Analyzed, Findings};

/// Most letters of a name of file or channel in titles and legends.
const LONGEST_NAME: usize = 24;

pub(super) fn report(result: &Diagnosis) -> AnalysisReport {
    let m = &result.measured;
    // In whole, which the title may have shortened.
    let mut notes: Vec<String> =
        m.records().map(|record| format!("{}, channel {}", record.path.display(), record.channel)).collect();
    notes.extend(m.notes.iter().cloned());
    if let Some(other) = &result.against {
        notes.extend(other.measured.notes.iter().map(|note| format!("of {}: {note}", other.measured.path.display())));
    }
    let other_name = result.against.as_ref().map(|other| name(&other.measured));
    let against = result.against.as_ref().zip(other_name.as_deref());
    AnalysisReport::of_findings(&Findings {
        signal: signal(m, &name(m), &result.analysis),
        unit: &m.unit,
        verdict: &result.verdict_text(),
        notes: &notes,
        warnings: &m.warnings,
        speed: &result.speed,
        bearing: &result.bearing,
        levels: &result.levels,
        velocity: result.velocity.as_ref(),
        against: against.map(|(other, name)| {
            let signal = signal(&other.measured, name, &other.analysis);
            (signal, &other.comparison)
        }),
    })
}

fn signal<'a>(m: &'a Measured, name: &'a str, analysis: &'a Analysis) -> Analyzed<'a> {
    Analyzed { name, x: &m.x, rate: m.rate, analysis }
}

/// File and channel.
fn name(m: &Measured) -> String {
    // `signals.parquet` is what every run calls it: its folder tells more.
    let own = m.path.file_stem().is_some_and(|n| n == "signals");
    let of = if own { m.path.parent() } else { None };
    let file = of.and_then(|f| f.file_name()).or_else(|| m.path.file_name()).map(|n| n.to_string_lossy().into_owned());
    let others = if m.others.is_empty() { String::new() } else { format!(" and {} more", m.others.len()) };
    format!("{}{others} · {}", shortened(&file.unwrap_or_default()), shortened(&m.channel))
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
