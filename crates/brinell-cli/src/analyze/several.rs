//! Several files with the same options: a row for each, one after the other, so that no more than one signal is held.

use super::args::AnalyzeArgs;
use super::columns::{COLUMNS, in_columns};
use super::customer;
use super::evidence;
use super::plots::plots;
use super::records::records;
use super::rows::{Each, Row, judged, one};
use super::trend;
use super::written::{earlier, put_json, put_pages};
use crate::failure::{ExitCode, Failure};
use crate::results::Earlier;
use crate::say::{self, complain, one_line, say};
use brinell::made_by::MadeBy;
use brinell_measured::{Request, Times, Trend};
use brinell_report::{Chapter, Page, Piece, Table, ZONES, html, pictures};
use brinell_study::campaign::of_results;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Longest name that the terminal's table makes room for.
const WIDEST: usize = 48;

/// Of files in the order of `times`, their trend too.
pub(super) fn analyze(
    args: &AnalyzeArgs,
    request: &Request,
    files: &[PathBuf],
    times: Option<Times>,
) -> Result<ExitCode, Failure> {
    let records = records(request, &args.signal.channel, files);
    let paths: Vec<String> = records.iter().map(|record| record.path.display().to_string()).collect();
    let what = Each::of(args).word();
    let of_same = |previous: &Value| {
        let records = previous["records"].as_array();
        records.is_some_and(|all| {
            let of = all.iter().map(|r| r["file"]["path"].as_str());
            of.eq(paths.iter().map(|p| Some(p.as_str())))
        })
    };
    let earlier = earlier(args, files, of_same)?;
    let quiet = args.quiet || args.json.as_deref() == Some(Path::new("-"));
    let labels: Vec<String> = (records.iter().enumerate()).map(|(k, r)| label(times.as_ref(), k, &r.name)).collect();
    let width = labels.iter().map(|label| label.chars().count()).max().unwrap_or(0);
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
    for (record, label) in records.into_iter().zip(&labels) {
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
                    for line in in_columns(&one_line(label), width, &found.cells(), &columns) {
                        say!("{line}");
                    }
                }
                Err(why) => say!("{:<width$} no result: {why}", one_line(label)),
            }
        }
        rows.push(row);
        evidence::keep_most_telling(&mut rows);
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
    let records = json_of(&rows, &paths);
    let trend = times.map(|times| {
        let names: Vec<String> = rows.iter().map(|row| row.name.clone()).collect();
        Trend::of(times, &names, &records, &args.trend.limit)
    });
    let trend = trend.transpose()?;
    let reported = if args.is_reported() { Some(judged(&rows)?) } else { None };
    let mut written = write(args, &rows, records, trend.as_ref(), &earlier)?;
    if let Some((signals, without)) = reported {
        customer::write(args, &files[0], signals, &without, &mut written)?;
    }
    if let Some(trend) = trend.as_ref().filter(|_| !args.quiet) {
        trend.warnings.iter().for_each(|warning| complain!("warning: {warning}"));
    }
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
        if let Some(trend) = &trend {
            trend::tell(trend);
        }
        say::wrote(written);
    }
    Ok(ExitCode(u8::from(failed > 0)))
}

/// What a record is called in tables: of a trend behind its time.
fn label(times: Option<&Times>, record: usize, name: &str) -> String {
    times.map_or(name.to_owned(), |times| format!("{}  {name}", times.text(times.at[record])))
}

/// The verdict of several channels of one machine: that of the highest score.
fn leading(args: &AnalyzeArgs, rows: &[Row]) -> Option<String> {
    if Each::of(args) == Each::File {
        return None;
    }
    let found = || rows.iter().filter_map(|row| Some((row, row.found.as_ref().ok()?)));
    let calls = found().filter_map(|(row, found)| Some((row, found, found.lead?)));
    let mut open = found().filter(|(_, found)| found.is_open);
    Some(match calls.max_by(|a, b| a.2.total_cmp(&b.2)) {
        Some((row, found, _)) => format!("{} leads: {}", one_line(&row.name), found.sentences.join(" ")),
        None => match open.next() {
            Some((row, first)) => format!(
                "Damage is called in none, and {} cannot tell. {}: {}",
                open.count() + 1,
                one_line(&row.name),
                first.sentences.join(" ")
            ),
            None => "No damage is called in any of them.".into(),
        },
    })
}

/// Of each file.
fn json_of(rows: &[Row], paths: &[String]) -> Vec<Value> {
    let one = |(row, path): (&Row, &String)| match &row.found {
        Ok(found) => found.json.clone(),
        Err(why) => json!({ "file": { "path": path }, "error": why }),
    };
    rows.iter().zip(paths).map(one).collect()
}

fn write(
    args: &AnalyzeArgs,
    rows: &[Row],
    records: Vec<Value>,
    trend: Option<&Trend>,
    earlier: &Earlier,
) -> Result<Vec<PathBuf>, Failure> {
    let mut json = json!({ "brinell": brinell::VERSION, "made_by": MadeBy::now(), "records": records });
    if let Some(trend) = trend {
        json["trend"] = trend.to_json();
    }
    if let Some(words) = leading(args, rows) {
        json["leading"] = words.into();
    }
    let mut written = Vec::new();
    if let Some(folder) = args.folder() {
        let report = report(args, rows, trend);
        let table = |trend: &Trend| (trend::TABLE, trend.to_csv());
        written = put_pages(
            folder,
            trend.map(table),
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
const TREND: &str = "In the order of the table; many files are numbered as in its first column. Bars: 95 % intervals; \
    rings: values without one; crosses on the axis: no value; dashed: boundaries of the zones, the scores from which a \
    family is beyond noise or high, the record that each is compared with. The score says only how far a family's \
    harmonics rise over the noise; the verdict also takes how deep they modulate the envelope, and leaves out lines that \
    another part's damage accounts for: a high score alone is no damage.";

fn report(args: &AnalyzeArgs, rows: &[Row], dated: Option<&Trend>) -> Page {
    let found = || rows.iter().filter_map(|r| r.found.as_ref().ok());
    let failures = rows.iter().filter_map(|r| Some((r.name.clone(), r.found.as_ref().err()?.clone())));
    let failures: Vec<(String, String)> = failures.collect();
    let damaged = found().filter(|f| f.lead.is_some()).count();
    let each = Each::of(args);
    let of = each.heading();
    let all = format!("{of}s");
    let called = |k: usize| label(dated.map(|trend| &trend.times), k, &rows[k].name);
    let table = Table::new(
        &*all,
        ["#No.", of, "#Length, s", "Damage", "#RMS", "#Peak", "#Kurtosis", "#RMS velocity, mm/s", "Zone"],
        (rows.iter().enumerate()).map(|(i, row)| {
            let mut cells = vec![(i + 1).to_string(), called(i)];
            match &row.found {
                Ok(found) => cells.extend(found.cells()),
                Err(_) => cells.extend(["–", "no result", "–", "–", "–", "–", "–"].map(str::to_owned)),
            }
            cells
        }),
        note(rows) + &alone(rows, each),
    );
    let mut subtitle = format!("{}, damage called in {damaged}", say::plural(rows.len(), &of.to_lowercase()));
    let open = found().filter(|f| f.is_open).count();
    if open > 0 {
        subtitle += &format!(", cannot tell in {open}");
    }
    if !failures.is_empty() {
        subtitle += &format!(", no result from {}", failures.len());
    }
    let mut chapters: Vec<Chapter> = dated.into_iter().flat_map(trend::chapters).collect();
    chapters.push(Chapter::table("files", &all, table));
    chapters.extend(evidence::chapter(rows, each, called));
    chapters.extend(Chapter::failures(&format!("{all} without a result"), of, failures));
    if dated.is_none() {
        let plots = plots(rows, each).into_iter().map(Piece::Trend);
        let trend = std::iter::once(Piece::Note(TREND.into())).chain(plots).collect();
        let title = match each {
            Each::File => "Trend",
            Each::Channel => "Side by side",
        };
        chapters.push(Chapter::new("trend", title, title, trend));
    }
    let title = match (dated, rows.len()) {
        (Some(_), _) => "Trend of one machine",
        (None, 1) => "A signal too short for a verdict",
        _ if each == Each::Channel => "Several channels",
        _ => "Several signals",
    };
    Page {
        title: title.into(),
        subtitle,
        lead: leading(args, rows).or(dated.map(Trend::summary)).unwrap_or_default(),
        analysed: true,
        version: MadeBy::now().to_string(),
        warnings: warnings(rows, each).into_iter().chain(dated.into_iter().flat_map(|t| t.warnings.clone())).collect(),
        chapters,
        ..Page::default()
    }
}

/// Each kind once: a folder of files that one option contradicts would fill the page.
fn warnings(rows: &[Row], each: Each) -> Vec<String> {
    let of = |(k, row): (usize, &Row)| Some((k, row.found.as_ref().ok()?.warnings.clone()));
    of_results(rows.iter().enumerate().filter_map(of), each.word(), |k| &rows[k].name)
}

/// Files whose verdict rests on another speed than the one given.
fn speeds_used(rows: &[Row]) -> impl Iterator<Item = (&str, &str)> {
    rows.iter().filter_map(|r| Some((r.name.as_str(), r.found.as_ref().ok()?.speed_used.as_deref()?)))
}

/// Where waveforms and spectra are.
fn alone(rows: &[Row], each: Each) -> String {
    if rows.len() < 2 {
        return String::new();
    }
    format!(
        " Waveform, spectrum, kurtogram and all indicators are on the page of one {}: {}.",
        each.heading().to_lowercase(),
        each.alone()
    )
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
