//! `brinell analyze`: a signal from a file to a verdict, in words, as JSON and as a page.

mod args;
mod bearing;
mod columns;
mod diagnosis;
mod ends;
mod examine;
mod files;
mod json;
pub(crate) mod measured;
mod page;
mod records;
mod several;
mod short;
mod together;
mod words;
mod written;

pub(crate) use args::AnalyzeArgs;

use crate::failure::Failure;
use crate::say::complain;
use brinell::analysis::SUPPLY_HZ;
use examine::{results, turning};
use files::{Files, files};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use written::{earlier, put_json, put_pages};

pub(crate) fn analyze(args: &AnalyzeArgs) -> Result<ExitCode, Failure> {
    if let Some(speed) = args.speed {
        turning(speed.rpm, "--speed")?;
    }
    if !(args.tolerance > 0.0 && args.tolerance <= 10.0) {
        return Err(Failure::Usage(format!("--tolerance {}: expected more than 0 to 10 per cent", args.tolerance)));
    }
    if let Some(hz) = args.supply.filter(|hz| !SUPPLY_HZ.contains(hz)) {
        return Err(Failure::Usage(format!("--supply {hz}: expected 1 to 1000 Hz")));
    }
    args.print.layout(&args.plots)?;
    if args.bearing.len() > 1 {
        let beside = [&args.bpfo, &args.bpfi, &args.bsf, &args.ftf];
        if beside.iter().any(|option| option.is_some()) {
            return Err(Failure::Usage(
                "--bearing: expected one bearing with --bpfo, --bpfi, --bsf or --ftf, and there are several".into(),
            ));
        }
    }
    let channels = args.signal.channel.len();
    if args.together && channels > 1 {
        return Err(Failure::Usage(format!(
            "--together: {channels} channels, expected one: records are of one sensor"
        )));
    }
    match files(&args.files)? {
        Files::One(path) if channels < 2 => one(args, &[path]),
        Files::Several(paths) if args.together => one(args, &paths),
        Files::One(path) => several::analyze(args, &[path]),
        Files::Several(paths) => several::analyze(args, &paths),
    }
}

/// Of one file, or of several together, with all that is known of it.
fn one(args: &AnalyzeArgs, paths: &[PathBuf]) -> Result<ExitCode, Failure> {
    let again = || together::load(args, paths);
    let mut measured = again()?;
    if paths.len() == 1 {
        measured = match short::too_short(args, measured)? {
            // Its levels, as a row.
            Ok(_) => return several::analyze(args, paths),
            Err(measured) => measured,
        };
    }
    let file = json::of_file(&measured);
    let alike = |previous: &Value| ["path", "records"].iter().all(|key| previous.get(key) == file.get(key));
    let same = |previous: &Value| previous.is_null() || alike(&previous["file"]);
    let earlier = earlier(args, &[paths, &[measured.path.clone()]].concat(), same)?;
    let results = results(args, measured, again)?;
    let json = ends::whole(&results);
    let lead = &results[ends::lead(&results).unwrap_or(0)];
    let mut written = Vec::new();
    if let Some(folder) = &args.output {
        let mut report = page::report(lead);
        if results.len() > 1 {
            report.verdict = format!("{}: {}", lead.name, report.verdict);
            report.tables.insert(0, ends::table(&results));
        }
        let page = report.into();
        written = put_pages(
            folder,
            &args.plots,
            &json,
            &brinell_report::html(&page),
            &brinell_report::pictures(&page, args.print.layout(&args.plots)?),
            &earlier,
        )?;
    }
    put_json(args, &json, &mut written)?;
    if !args.quiet {
        for warning in &lead.measured.warnings {
            complain!("warning: {warning}");
        }
        if args.json.as_deref() != Some(Path::new("-")) {
            words::tell(&results, lead, &written);
        }
    }
    Ok(ExitCode::SUCCESS)
}
