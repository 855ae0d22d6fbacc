//! The options of the customer's report, and where it is written.

use super::args::AnalyzeArgs;
use super::files::Files;
use crate::failure::Failure;
use crate::figures::PlotFormat;
use crate::inputs::Inputs;
use brinell_measured::Times;
use brinell_report::{DamageKind, GENERATOR, Heading};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::io::Read;
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, Args)]
pub(crate) struct CustomerArgs {
    /// Write the customer's report, two pages of A4, as PDF; `-o FILE.html` writes it as HTML
    #[arg(long, value_name = "FILE.pdf", help_heading = REPORT)]
    pub(super) pdf: Option<PathBuf>,
    /// Its title
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    title: Option<String>,
    /// The machine
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    machine: Option<String>,
    /// The measuring point and its direction
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    point: Option<String>,
    /// Who writes it
    #[arg(long, value_name = "TEXT", help_heading = REPORT)]
    author: Option<String>,
    /// The kind of damage that somebody has seen, as ISO 15243 names it: vibration does not tell it
    #[arg(long, value_name = "KIND", help_heading = REPORT, value_parser = damage_kind())]
    damage_kind: Option<DamageKind>,
}

const REPORT: &str = "Customer's report (-o FILE.html, --pdf FILE.pdf)";

/// Reads `false-brinelling`.
fn damage_kind() -> impl TypedValueParser<Value = DamageKind> {
    let values = DamageKind::all().map(|kind| PossibleValue::new(kind.name()).help(kind.words()));
    PossibleValuesParser::new(values)
        .try_map(|name| DamageKind::all().find(|kind| kind.name() == name).ok_or("no such kind"))
}

impl AnalyzeArgs {
    /// The file of `-o`, where it is one and no folder.
    fn html(&self) -> Option<&Path> {
        let path = self.output.as_deref()?;
        let is_html = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("html")) && !path.is_dir();
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
        if !self.is_reported() {
            let given = [
                ("--title", of.title.is_some()),
                ("--machine", of.machine.is_some()),
                ("--point", of.point.is_some()),
                ("--author", of.author.is_some()),
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
        if let Some(path) = pdf.filter(|path| path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("pdf"))) {
            return usage(format!("--pdf {}: expected a name that ends in .pdf", path.display()));
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
            _ => Ok(()),
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
