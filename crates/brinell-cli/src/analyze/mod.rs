//! `brinell analyze`: a signal from a file to a verdict, in words, as JSON and as a page.

mod args;
mod columns;
mod customer;
mod customer_args;
mod evidence;
mod files;
mod page;
mod plots;
mod records;
mod rows;
mod several;
pub(crate) mod signal_args;
mod trend;
mod trend_args;
mod words;
mod written;

pub(crate) use args::AnalyzeArgs;

use crate::confined;
use crate::failure::{ExitCode, Failure};
use crate::results::SCENARIO;
use crate::say::complain;
use brinell_measured::{Request, Short, examine, is_too_short, of_file, together};
use files::{Files, files};
use serde_json::Value;
use std::path::{Path, PathBuf};
use written::{earlier, put_json, put_pages};

pub(crate) fn analyze(args: &AnalyzeArgs) -> Result<ExitCode, Failure> {
    for path in args.files.iter().chain(&args.against) {
        confined::check_read(path, SCENARIO)?;
    }
    if !(args.tolerance > 0.0 && args.tolerance <= 10.0) {
        return Err(Failure::Usage(format!("--tolerance {}: expected more than 0 to 10 per cent", args.tolerance)));
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
    let request = args.request()?;
    request.check()?;
    let found = files(&args.files)?;
    args.check_report(&found)?;
    if args.trend.trend {
        let (paths, times) = args.trend.dated(found, channels)?;
        return several::analyze(args, &request, &paths, Some(times));
    }
    match found {
        Files::One(path) if channels < 2 => one(args, &request, &[path]),
        Files::Several(paths) if args.together => one(args, &request, &paths),
        Files::One(path) => several::analyze(args, &request, &[path], None),
        Files::Several(paths) => several::analyze(args, &request, &paths, None),
    }
}

/// Of one file, or of several together, with all that is known of it.
fn one(args: &AnalyzeArgs, request: &Request, paths: &[PathBuf]) -> Result<ExitCode, Failure> {
    let measurement = together(paths, request)?;
    if is_too_short(&measurement, request)? {
        if args.is_reported() {
            let Short { why, .. } = Short::of(measurement, request)?;
            return Err(Failure::Usage(format!("{}: {why} The customer's report takes a verdict", paths[0].display())));
        }
        // Its levels, as a row.
        return several::analyze(args, request, paths, None);
    }
    let file = of_file(&measurement);
    let alike = |previous: &Value| ["path", "records"].iter().all(|key| previous.get(key) == file.get(key));
    let same = |previous: &Value| alike(&previous["file"]);
    let earlier = earlier(args, &[paths, std::slice::from_ref(&measurement.path)].concat(), same)?;
    let found = examine(measurement, request)?;
    let json = found.to_json(true);
    let mut written = Vec::new();
    if let Some(folder) = args.folder() {
        let page = page::report(&found).into();
        written = put_pages(
            folder,
            None,
            &args.plots,
            &json,
            &brinell_report::html(&page),
            &brinell_report::pictures(&page, args.print.layout(&args.plots)?),
            &earlier,
        )?;
    }
    put_json(args, &json, &mut written)?;
    if args.is_reported() {
        customer::write(args, &paths[0], vec![customer::judged(&found)], &[], &mut written)?;
    }
    if !args.quiet {
        for warning in &found.warnings {
            complain!("warning: {warning}");
        }
        if args.json.as_deref() != Some(Path::new("-")) {
            words::tell(&found, &written);
        }
    }
    Ok(ExitCode::SUCCESS)
}
