//! The customer's report: of one signal or of several channels.

use super::args::AnalyzeArgs;
use super::page::{called, on_page};
use crate::failure::Failure;
use crate::say::complain;
use brinell_io::atomic_prepare;
use brinell_measured::{Diagnosis, Findings};
use brinell_report::{CustomerReport, Judged, JudgedOf, NotJudged};
use std::path::{Path, PathBuf};

/// What it says of a signal.
pub(super) fn judged(found: &Findings) -> Judged {
    let (m, result) = (&found.measurement, found.lead());
    let name = |path: &Path| path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let files: Vec<String> = m.records().map(|record| name(&record.path)).collect();
    let of = |one: &Diagnosis| (one.name.clone(), called(one));
    on_page(found, |findings| {
        Judged::of(JudgedOf {
            findings,
            files: &files,
            notes: &found.notes,
            simulated: m.run.is_some(),
            channel: &m.channel.value,
            bearing: &result.name,
            bearings: found.bearings.iter().map(of).collect(),
            speed: m.speed_words(),
            size: result.size_words(),
        })
    })
}

/// Writes it as the files that are wanted; `first` is the first file that was read.
pub(super) fn write(
    args: &AnalyzeArgs,
    first: &Path,
    signals: Vec<Judged>,
    without: &[NotJudged],
    written: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    let [html, pdf] = args.reports();
    let Some(report) = CustomerReport::of(args.heading(first)?, signals, without).filter(|_| args.is_reported()) else {
        return Ok(());
    };
    let missing = report.missing_letters();
    if pdf.is_some() && !missing.is_empty() && !args.quiet {
        complain!(
            "warning: the PDF has ? in place of letters that its typeface lacks: {missing}; the HTML (-o REPORT.html) shows them"
        );
    }
    // Both or none.
    let html = html.map(|path| atomic_prepare(path, report.html())).transpose()?;
    let pdf = pdf.map(|path| atomic_prepare(path, report.pdf())).transpose()?;
    for file in [html, pdf].into_iter().flatten() {
        written.push(file.publish()?);
    }
    Ok(())
}
