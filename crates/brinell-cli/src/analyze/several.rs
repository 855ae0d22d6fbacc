//! Several files with the same options: a row for each, one after the other, so that no more than one signal is held.

use super::args::AnalyzeArgs;
use super::columns::{COLUMNS, in_columns};
use super::page::called;
use super::records::{Record, records};
use super::written::{earlier, put_json, put_pages};
use crate::failure::Failure;
use crate::results::Earlier;
use crate::say::{self, complain, one_line, say, short};
use brinell::analysis::{MachineClass, Unit};
use brinell::signal::{Estimate, Indicator};
use brinell_measured::{Diagnosis, Findings, Measurement, Request, Short, examine, is_too_short};
use brinell_report::{
    Chapter, IndicatorLine, IndicatorPlot, IndicatorPoint, Page, Piece, Table, ZONES, html, pictures, scaled,
};
use brinell_study::campaign::of_results;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What is kept of a file.
struct Row {
    name: String,
    found: Result<Found, String>,
}

struct Found {
    seconds: f64,
    verdict: String,
    /// Whether a verdict takes a longer record.
    too_short: bool,
    /// The same in whole, of each bearing.
    sentences: Vec<String>,
    /// Score of the damage that leads; `None` where none is called.
    lead: Option<f64>,
    unit: Unit,
    rms: Option<Estimate>,
    peak: Option<Estimate>,
    kurtosis: Option<Estimate>,
    /// mm/s.
    velocity: Option<Estimate>,
    zone: Option<&'static str>,
    /// Scores of the families, by name.
    scores: Vec<(String, f64)>,
    /// The speed used in place of the one given.
    speed_used: Option<String>,
    /// Where speed and bearings come from.
    said: String,
    class: Option<MachineClass>,
    /// Scores from which a family is high, and beyond noise.
    high: f64,
    noise: f64,
    /// What it is compared with: name, RMS, kurtosis.
    other: Option<(String, f64, f64)>,
    /// The RMS over the other's, in the range that both hold.
    rms_over_other: Option<f64>,
    /// What contradicts what was given.
    warnings: Vec<String>,
    json: Value,
}

/// Longest name that the terminal's table makes room for.
const WIDEST: usize = 48;

pub(super) fn analyze(args: &AnalyzeArgs, request: &Request, files: &[PathBuf]) -> Result<ExitCode, Failure> {
    let records = records(request, &args.signal.channel, files);
    let paths: Vec<String> = records.iter().map(|record| record.path.display().to_string()).collect();
    let what = if args.signal.channel.len() < 2 { "file" } else { "signal" };
    let of_same = |previous: &Value| {
        let records = previous["records"].as_array();
        records.is_some_and(|all| {
            let of = all.iter().map(|r| r["file"]["path"].as_str());
            of.eq(paths.iter().map(|p| Some(p.as_str())))
        })
    };
    let earlier = earlier(args, files, of_same)?;
    let quiet = args.quiet || args.json.as_deref() == Some(Path::new("-"));
    let width = records.iter().map(|r| r.name.chars().count()).max().unwrap_or(0);
    let width = width.clamp(4, WIDEST);
    let mut columns = COLUMNS;
    // Of several each has its name, and may have another's.
    if args.bearing.len() > 1 {
        columns[1].1 = 40 * args.bearing.len();
    }
    if args.against.is_some() {
        columns[2].1 += 10;
    }
    if !quiet {
        let heads = columns.map(|(head, width)| format!("{head:>width$}"));
        say!("{what:<width$} {}", heads.join(" "));
    }
    let mut rows: Vec<Row> = Vec::new();
    for record in records {
        let found = one(args, &record).map_err(|error| {
            let words = error.to_string().replace('\n', " ");
            // The row has its name.
            let named = format!("{}: ", record.path.display());
            words.strip_prefix(&named).map_or(words.clone(), str::to_owned)
        });
        let row = Row { name: record.name, found };
        if !quiet {
            match &row.found {
                Ok(found) => {
                    for line in in_columns(&one_line(&row.name), width, &found.cells(), &columns) {
                        say!("{line}");
                    }
                }
                Err(why) => say!("{:<width$} no result: {why}", one_line(&row.name)),
            }
        }
        rows.push(row);
    }
    let failed = rows.iter().filter(|r| r.found.is_err()).count();
    if let [Row { name, found: Err(why) }, ..] = &rows[..]
        && failed == rows.len()
    {
        // Most often an option that is missing.
        return Err(Failure::Usage(format!(
            "none of the {failed} {what}s could be analysed; the first, {name}: {why}"
        )));
    }
    let written = write(args, &rows, &paths, &earlier)?;
    if failed > 0 {
        complain!("error: {failed} of {} {what}s could not be analysed", rows.len());
    }
    if !quiet {
        let mut short = rows.iter().filter(|r| r.found.as_ref().is_ok_and(|f| f.too_short));
        if let Some(Row { name, found: Ok(first) }) = short.next() {
            let more = short.count();
            let others = if more > 0 { format!(" and {more} more") } else { String::new() };
            say!("  {}{others}: {}", one_line(name), first.sentences.join(" "));
        }
        if let Some(words) = leading(args, &rows) {
            say!("{words}");
        }
        for (name, speed) in speeds_used(&rows) {
            say!("  {}: {speed}", one_line(name));
        }
        say::wrote(written);
    }
    Ok(ExitCode::from(u8::from(failed > 0)))
}

/// The verdict of several channels of one machine: that of the highest score.
fn leading(args: &AnalyzeArgs, rows: &[Row]) -> Option<String> {
    if args.signal.channel.len() < 2 {
        return None;
    }
    let found = rows.iter().filter_map(|row| Some((row, row.found.as_ref().ok()?)));
    let calls = found.filter_map(|(row, found)| Some((row, found, found.lead?)));
    Some(match calls.max_by(|a, b| a.2.total_cmp(&b.2)) {
        Some((row, found, _)) => format!("{} leads: {}", one_line(&row.name), found.sentences.join(" ")),
        None => "No damage is called in any of them.".into(),
    })
}

fn one(args: &AnalyzeArgs, Record { request, path, .. }: &Record) -> Result<Found, Failure> {
    let measurement = Measurement::open(path, request)?;
    let found = match is_too_short(&measurement, request)? {
        true => Found::of_short(Short::of(measurement, request)?),
        false => Found::of(&examine(measurement, request)?),
    };
    if !args.quiet {
        found.warnings.iter().for_each(|warning| complain!("warning: {}: {warning}", path.display()));
    }
    Ok(found)
}

impl Found {
    fn of_short(short: Short) -> Self {
        Found {
            seconds: short.measurement.seconds(),
            json: short.to_json(),
            verdict: "too short".into(),
            too_short: true,
            sentences: vec![short.why],
            lead: None,
            unit: short.measurement.unit.value,
            rms: short.rms,
            peak: Some(Estimate { value: short.peak, interval: None }),
            kurtosis: short.kurtosis,
            velocity: short.velocity.map(|v| scaled(&v, 1e3)),
            zone: None,
            scores: Vec::new(),
            speed_used: None,
            said: format!("{}; bearing: {}", short.speed, short.bearing),
            class: None,
            high: 0.0,
            noise: 0.0,
            other: None,
            rms_over_other: None,
            warnings: short.warnings,
        }
    }

    /// Levels are those of the bearing that leads: its band is the one shown.
    fn of(found: &Findings) -> Self {
        let (results, lead, result) = (&found.bearings[..], found.leads(), found.lead());
        let a = &result.analysis;
        let prefix = |r: &Diagnosis| match results.len() {
            1 => String::new(),
            _ => format!("{} ", r.name),
        };
        let verdicts = results.iter().enumerate().map(|(k, r)| {
            let calls = r.analysis.causes().next().is_some();
            let doubt = if calls && lead != Some(k) { "?" } else { "" };
            format!("{}{}{doubt}", prefix(r), called(r))
        });
        let scores = results.iter().flat_map(|r| {
            let families = r.analysis.families.iter();
            families.map(move |f| (format!("{}{}", prefix(r), f.name), f.score))
        });
        Found {
            seconds: a.duration(),
            verdict: verdicts.collect::<Vec<_>>().join("; "),
            too_short: false,
            sentences: match results {
                [only] => vec![only.verdict_text()],
                _ => results.iter().map(|r| format!("{}: {}", r.name, r.verdict_text())).collect(),
            },
            lead: lead.and(result.call()).map(|family| family.score),
            unit: found.measurement.unit.value.clone(),
            rms: a.indicator(Indicator::Rms),
            // The record's own, which has no interval.
            peak: Some(Estimate { value: a.record_peak, interval: None }),
            kurtosis: a.indicator(Indicator::Kurtosis),
            velocity: result.levels.velocity.as_ref().ok().map(|v| scaled(v, 1e3)),
            zone: result.levels.letter(),
            speed_used: a.speed_used(),
            said: format!("{}; bearing: {}", found.speed, said_of_bearings(results)),
            class: result.levels.class,
            high: a.families.iter().map(|f| f.limit).fold(0.0, f64::max),
            noise: a.families.iter().map(|f| f.noise).fold(0.0, f64::max),
            other: result.against.as_ref().map(|other| {
                // Of two sample rates levels are not of one range: none is drawn over the other's.
                let whole = other.comparison.range.is_none();
                let value = |i| other.analysis.indicator(i).filter(|_| whole).map_or(f64::NAN, |e| e.value);
                (other.measurement.path.display().to_string(), value(Indicator::Rms), value(Indicator::Kurtosis))
            }),
            rms_over_other: result.against.as_ref().and_then(|other| {
                let rms = other.comparison.indicators.iter().find(|d| d.indicator == Indicator::Rms)?;
                Some(rms.first / rms.second)
            }),
            scores: scores.collect(),
            warnings: found.warnings.clone(),
            // The version is above all records.
            json: found.to_json(false),
        }
    }

    /// Its JSON, of itself.
    fn whole(&self) -> Value {
        let mut json = self.json.clone();
        json["brinell"] = brinell::VERSION.into();
        json
    }

    /// In the order of [`COLUMNS`].
    fn cells(&self) -> [String; 7] {
        let number = |e: &Option<Estimate>, unit: &str| match e {
            Some(e) if unit.is_empty() => short(e.value, 4),
            Some(e) => format!("{} {unit}", short(e.value, 4)),
            None => "-".into(),
        };
        let mut rms = number(&self.rms, &self.unit.name);
        rms += &self.rms_over_other.map_or(String::new(), |ratio| format!(" (x {})", short(ratio, 3)));
        [
            format!("{:.3}", self.seconds),
            self.verdict.clone(),
            rms,
            number(&self.peak, &self.unit.name),
            number(&self.kurtosis, ""),
            number(&self.velocity, ""),
            self.zone.unwrap_or("-").into(),
        ]
    }
}

/// Where each bearing's frequencies come from.
fn said_of_bearings(results: &[Diagnosis]) -> String {
    let all: Vec<String> = results.iter().map(Diagnosis::said_of_bearing).collect();
    all.join("; ")
}

fn write(args: &AnalyzeArgs, rows: &[Row], paths: &[String], earlier: &Earlier) -> Result<Vec<PathBuf>, Failure> {
    let records: Vec<Value> = (rows.iter().zip(paths))
        .map(|(row, path)| match &row.found {
            Ok(found) => found.json.clone(),
            Err(why) => json!({ "file": { "path": path }, "error": why }),
        })
        .collect();
    let mut json = json!({ "brinell": brinell::VERSION, "records": records });
    if let Some(words) = leading(args, rows) {
        json["leading"] = words.into();
    }
    let mut written = Vec::new();
    if let Some(folder) = &args.output {
        let report = report(args, rows);
        written = put_pages(
            folder,
            &args.plots,
            &json,
            &html(&report),
            &pictures(&report, args.print.layout(&args.plots)?),
            earlier,
        )?;
    }
    // Of one file that is too short it is an object as of any one file.
    let alone = match rows {
        [Row { found: Ok(found), .. }] if args.files.first().is_some_and(|file| file.is_file()) => Some(found.whole()),
        _ => None,
    };
    put_json(args, alone.as_ref().unwrap_or(&json), &mut written)?;
    Ok(written)
}

/// What the plots show.
const TREND: &str = "In the order of the table; numbers on the axis are those of its first column. Bars: 95 % intervals; \
    rings: values without one; crosses on the axis: no value; dashed: boundaries of the zones, the scores from which a \
    family is beyond noise or high, the record that each is compared with. The score says only how far a family's \
    harmonics rise over the noise; the verdict also takes how deep they modulate the envelope, and leaves out lines that \
    another part's damage accounts for: a high score alone is no damage.";

fn report(args: &AnalyzeArgs, rows: &[Row]) -> Page {
    let found = || rows.iter().filter_map(|r| r.found.as_ref().ok());
    let failures = rows.iter().filter_map(|r| Some((r.name.clone(), r.found.as_ref().err()?.clone())));
    let failures: Vec<(String, String)> = failures.collect();
    let damaged = found().filter(|f| f.lead.is_some()).count();
    let table = Table::new(
        "Files",
        ["#No.", "File", "#Length, s", "Damage", "#RMS", "#Peak", "#Kurtosis", "#RMS velocity, mm/s", "Zone"],
        (rows.iter().enumerate()).map(|(i, row)| {
            let mut cells = vec![(i + 1).to_string(), row.name.clone()];
            match &row.found {
                Ok(found) => cells.extend(found.cells()),
                Err(_) => cells.extend(["–", "no result", "–", "–", "–", "–", "–"].map(str::to_owned)),
            }
            cells
        }),
        note(rows),
    );
    let verdicts = rows.iter().flat_map(|row| {
        let sentences = row.found.iter().flat_map(|found| &found.sentences);
        sentences.map(|sentence| vec![row.name.clone(), sentence.clone()])
    });
    let verdicts = Table::new("Verdicts", ["File", "Verdict"], verdicts, "");
    let mut trend = vec![Piece::Note(TREND.into())];
    trend.extend(plots(rows).into_iter().map(Piece::Trend));
    let leading = leading(args, rows);
    let what = if leading.is_some() { "signals" } else { "files" };
    let mut subtitle = format!("{} {what}, damage called in {damaged}, no result from {}", rows.len(), failures.len());
    subtitle += &leading.map_or(String::new(), |words| format!(". {words}"));
    let mut chapters = vec![Chapter::table("files", "Files", table)];
    if !verdicts.rows.is_empty() {
        chapters.push(Chapter::table("verdicts", "Verdicts", verdicts));
    }
    chapters.extend(Chapter::failures("Files without a result", "File", failures));
    chapters.push(Chapter::new("trend", "Trend", "Trend", trend));
    Page {
        title: if rows.len() == 1 { "A signal too short for a verdict" } else { "Several signals" }.into(),
        subtitle,
        analysed: true,
        version: brinell::VERSION.into(),
        warnings: warnings(rows),
        chapters,
        ..Page::default()
    }
}

/// Each kind once: a folder of files that one option contradicts would fill the page.
fn warnings(rows: &[Row]) -> Vec<String> {
    let of = |(k, row): (usize, &Row)| Some((k, row.found.as_ref().ok()?.warnings.clone()));
    of_results(rows.iter().enumerate().filter_map(of), "file", |k| &rows[k].name)
}

/// Files whose verdict rests on another speed than the one given.
fn speeds_used(rows: &[Row]) -> impl Iterator<Item = (&str, &str)> {
    rows.iter().filter_map(|r| Some((r.name.as_str(), r.found.as_ref().ok()?.speed_used.as_deref()?)))
}

/// What holds for all rows.
fn note(rows: &[Row]) -> String {
    let mut note = "RMS velocity: 10 to 1000 Hz.".to_owned();
    if let Some(first) = rows.iter().find_map(|r| r.found.as_ref().ok()) {
        note += &format!(" Of the first: {}.", first.said);
        if let Some((other, ..)) = &first.other {
            note += &format!(" In brackets: the RMS over that of {other}.");
        }
        for (name, speed) in speeds_used(rows) {
            note += &format!(" {name}: {speed}");
        }
        if let Some(class) = first.class {
            note += &format!(" Class {} of {}.", class.name(), ZONES);
        }
    }
    note
}

/// Whether the files' names have room on the axis of a trend; else they are numbered.
fn named(rows: &[Row]) -> bool {
    const MOST: usize = 8;
    rows.len() <= MOST
}

/// A point for each file, named or numbered from 1.
fn line(rows: &[Row], label: &str, of: impl Fn(&Found) -> Option<Estimate>) -> IndicatorLine {
    let point = |(i, row): (usize, &Row)| {
        let e = row.found.as_ref().ok().and_then(&of);
        IndicatorPoint {
            x: if named(rows) { i } else { i + 1 } as f64,
            value: e.map_or(f64::NAN, |e| e.value),
            interval: e.and_then(|e| e.interval).map(|i| (i.low, i.high)),
        }
    };
    IndicatorLine { label: label.into(), points: rows.iter().enumerate().map(point).collect() }
}

fn plots(rows: &[Row]) -> Vec<IndicatorPlot> {
    let found = || rows.iter().filter_map(|r| r.found.as_ref().ok());
    let plot = |name: &str, label: &str, unit: &str, lines: Vec<IndicatorLine>| IndicatorPlot {
        name: format!("trend-{name}"),
        label: label.into(),
        unit: unit.into(),
        x_label: "File".into(),
        x_names: match named(rows) {
            true => rows.iter().map(|row| row.name.clone()).collect(),
            false => Vec::new(),
        },
        ordered: true,
        lines,
        ..IndicatorPlot::default()
    };
    let other = |of: fn(&(String, f64, f64)) -> f64| -> Vec<(f64, String)> {
        let other = found().find_map(|f| f.other.as_ref()).map(|o| (of(o), "the other".to_owned()));
        other.filter(|o| o.0.is_finite()).into_iter().collect()
    };
    let mut plots = Vec::new();
    if let Some(first) = found().next() {
        // In the first one's unit, where that can be.
        let unit = &first.unit;
        let rms = line(rows, "RMS", |f| {
            let factor = f.unit.to_si / unit.to_si;
            let same = f.unit.name == unit.name || f.unit.quantity == unit.quantity;
            f.rms.filter(|_| same).map(|e| scaled(&e, factor))
        });
        plots.push(IndicatorPlot { limits: other(|o| o.1), ..plot("rms", "RMS", &unit.name, vec![rms]) });
    }
    let kurtosis = vec![line(rows, "Kurtosis", |f| f.kurtosis)];
    plots.push(IndicatorPlot { limits: other(|o| o.2), ..plot("kurtosis", "Kurtosis", "", kurtosis) });
    if found().any(|f| f.velocity.is_some()) {
        let lines = vec![line(rows, "RMS velocity", |f| f.velocity)];
        let class = found().find_map(|f| f.zone.and(f.class));
        let limits = class.iter().flat_map(|class| class.boundaries().into_iter().zip(["A/B", "B/C", "C/D"]));
        let limits = limits.map(|(limit, zones)| (limit, format!("{zones} {limit}"))).collect();
        plots.push(IndicatorPlot { limits, ..plot("velocity", "RMS velocity, 10 to 1000 Hz", "mm/s", lines) });
    }
    let mut families: Vec<&str> = Vec::new();
    for (name, _) in found().flat_map(|f| &f.scores) {
        if !families.contains(&name.as_str()) {
            families.push(name);
        }
    }
    let lines = families.into_iter().map(|name| {
        line(rows, name, |f| {
            let score = f.scores.iter().find(|(n, _)| n == name)?.1;
            Some(Estimate { value: score, interval: None })
        })
    });
    let most = |of: fn(&Found) -> f64| found().map(of).fold(0.0, f64::max);
    let limits = [(most(|f| f.noise), "noise"), (most(|f| f.high), "high")];
    let limits = limits.map(|(limit, words)| (limit, format!("{words} {limit:.1}"))).to_vec();
    if lines.len() == 0 {
        return plots;
    }
    plots.push(IndicatorPlot { limits, ..plot("score", "Score of a family", "", lines.collect()) });
    plots
}
