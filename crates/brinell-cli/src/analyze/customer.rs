//! The customer's report: what is asked of it, what it is made of, and its files.

use super::args::AnalyzeArgs;
use super::files::Files;
use super::page::{called, on_page};
use crate::failure::Failure;
use crate::figures::PlotFormat;
use crate::inputs::Inputs;
use crate::say::complain;
use brinell_io::atomic_prepare;
use brinell_measured::{Diagnosis, Findings, Times};
use brinell_report::{CustomerReport, GENERATOR, Heading, Judged, JudgedOf, NotJudged};
use std::io::Read;
use std::path::{Path, PathBuf};

fn ends_in(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension))
}

/// Names of files that end so are meant as files, and the command writes none of them.
const DOCUMENTS: [&str; 7] = ["doc", "docx", "htm", "md", "odt", "txt", "xlsx"];

impl AnalyzeArgs {
    /// The file of `-o`, where it is one and no folder.
    fn html(&self) -> Option<&Path> {
        let path = self.output.as_deref()?;
        let is_html = ends_in(path, "html") && !path.is_dir();
        is_html.then_some(path)
    }

    /// The folder of `-o`, where it is one.
    pub(super) fn folder(&self) -> Option<&Path> {
        self.output.as_deref().filter(|_| self.html().is_none())
    }

    /// The files of the customer's report: HTML and PDF.
    pub(super) fn reports(&self) -> [Option<&Path>; 2] {
        [self.html(), self.customer.pdf.as_deref()]
    }

    /// Whether it is wanted.
    pub(super) fn is_reported(&self) -> bool {
        self.reports().iter().any(Option::is_some)
    }

    /// That what is given of the report has one to stand in, of one record.
    pub(super) fn check_report(&self, found: &Files) -> Result<(), Failure> {
        let usage = |words: String| Err(Failure::Usage(words));
        let of = &self.customer;
        let [html, pdf] = self.reports();
        if let Some(path) = self.folder().filter(|path| ends_in(path, "pdf")) {
            return usage(format!(
                "-o {0}: expected a folder, or REPORT.html; a PDF is given by --pdf {0}",
                path.display()
            ));
        }
        if let Some(path) =
            self.folder().filter(|path| DOCUMENTS.iter().any(|kind| ends_in(path, kind)) && !path.is_dir())
        {
            return usage(format!(
                "-o {}: expected a folder, or a customer's report that ends in .html",
                path.display()
            ));
        }
        if !self.is_reported() {
            let given = [
                ("--title", of.title.is_some()),
                ("--machine", of.machine.is_some()),
                ("--point", of.point.is_some()),
                ("--author", of.author.is_some()),
                ("--remark", of.remark.is_some()),
                ("--damage-kind", of.damage_kind.is_some()),
                ("--date", !self.trend.date.is_empty() && !self.trend.trend),
            ];
            return match given.into_iter().find(|(_, is_given)| *is_given) {
                Some((option, _)) => {
                    let trend = if option == "--date" { ", or --trend for records over time" } else { "" };
                    usage(format!("{option}: no report to put it in; give -o REPORT.html or --pdf REPORT.pdf{trend}"))
                }
                None => Ok(()),
            };
        }
        if let Some(path) = pdf.filter(|path| !ends_in(path, "pdf")) {
            return usage(format!("--pdf {}: expected a name that ends in .pdf", path.display()));
        }
        if let Some(path) = pdf.filter(|path| self.folder().is_some_and(|folder| path.starts_with(folder))) {
            return usage(format!(
                "--pdf {}: it lies in the folder of -o, which holds nothing but what its analysis.json lists; choose another place",
                path.display()
            ));
        }
        if html.is_some() && (self.print.width.is_some() || self.plots != [PlotFormat::Svg]) {
            return usage("--plots, --width: pictures go to a folder; give -o FOLDER, and --pdf REPORT.pdf for the customer's report".into());
        }
        if let Some(json) = self.json.as_deref().filter(|json| [html, pdf].contains(&Some(*json))) {
            return usage(format!("--json {}: expected another file than the report's", json.display()));
        }
        let one = "the customer's report is of one record; name one file, with --channel again for further channels";
        match found {
            _ if self.trend.trend => usage(format!("--trend: {one}. -o FOLDER writes the page of a trend")),
            Files::Several(paths) if !self.together => {
                usage(format!("{} files: {one}, or --together for one verdict on all", paths.len()))
            }
            _ if self.trend.date.len() > 1 => {
                usage(format!("--date: {} dates, expected one: {one}", self.trend.date.len()))
            }
            // A date that is none is told before anything is computed.
            _ => self.heading(Path::new("")).map(drop),
        }
    }

    /// That the report replaces no input and nothing but an earlier report.
    pub(super) fn spare_report(&self, inputs: &Inputs) -> Result<(), Failure> {
        for path in self.reports().into_iter().flatten() {
            inputs.spare(path)?;
            if !is_free(path) {
                return Err(Failure::Usage(format!(
                    "{}: a file that is no customer's report of brinell's is there; nothing was written. Choose another path, or remove it",
                    path.display()
                )));
            }
        }
        Ok(())
    }

    /// What stands above the report; `first` is the first file.
    pub(super) fn heading(&self, first: &Path) -> Result<Heading, Failure> {
        let of = &self.customer;
        let text = |given: &Option<String>| given.clone().unwrap_or_default();
        let given = &self.trend.date;
        let dated = Times::of(&[first.display().to_string()], given, None).map(|(_, times)| times);
        let date = match dated {
            Ok(times) if times.first.is_some() && given.is_empty() => {
                format!("{}, by the name of the file", times.text(times.at[0]))
            }
            Ok(times) if times.first.is_some() => times.text(times.at[0]),
            // Whatever number the name holds.
            _ if given.is_empty() => String::new(),
            dated => {
                dated?;
                String::new()
            }
        };
        Ok(Heading {
            title: text(&of.title),
            machine: text(&of.machine),
            point: text(&of.point),
            author: text(&of.author),
            remark: text(&of.remark),
            date,
            kind: of.damage_kind,
        })
    }
}

/// Whether nothing is there, or an earlier report.
fn is_free(path: &Path) -> bool {
    const LARGEST: u64 = 1 << 26;
    let Some(there) = path.metadata().ok().filter(|there| there.is_file() && there.len() > 0) else {
        return true;
    };
    if there.len() > LARGEST {
        return false;
    }
    let mut bytes = Vec::new();
    let read = std::fs::File::open(path).and_then(|mut file| file.read_to_end(&mut bytes));
    let marks = [format!("<meta name=\"generator\" content=\"{GENERATOR}\">"), format!("/Creator ({GENERATOR})")];
    read.is_ok() && marks.iter().any(|mark| bytes.windows(mark.len()).any(|window| window == mark.as_bytes()))
}

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
            alike: result.struck_alike(),
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
