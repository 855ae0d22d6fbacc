//! The page of a calibration: what was found, how sure it is, what the data do not determine, and the runs that say so.

mod content;
mod plot;
mod words;

use std::fmt::Write as _;

use crate::fact::Fact;
use crate::frame::{close, figure, lead, none, open, scenario, section};
use crate::markup::escape;
use crate::tables::{Table, fact_table, facts, failures, table};
pub use plot::{FittedKey, Tried};
use plot::{course_plot, embed_course, embed_key, key_plot};
pub use words::{calibration_undetermined, calibration_verdict, interval_text};

/// Everything that the page shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CalibrationReport {
    /// Its name.
    pub title: String,
    /// What was fitted to what.
    pub subtitle: String,
    /// The version of the program.
    pub version: String,
    /// Whether the targets are met.
    pub met: bool,
    /// The outcome in sentences.
    pub verdict: Vec<String>,
    /// Headline numbers.
    pub facts: Vec<Fact>,
    /// The keys.
    pub keys: Vec<FittedKey>,
    /// The keys with intervals and what to know, a line each.
    pub found: Vec<Fact>,
    /// What is not determined, in sentences.
    pub undetermined: Vec<String>,
    /// Targets against the best run.
    pub targets: Table,
    /// Correlations of the keys' estimates.
    pub correlation: Table,
    /// Directions of the keys' space.
    pub directions: Table,
    /// The runs in their order.
    pub tried: Vec<Tried>,
    /// Runs that failed, and why.
    pub failures: Vec<(String, String)>,
    /// How it was done, in sentences.
    pub method: Vec<String>,
    /// The best scenario.
    pub scenario_toml: String,
}

fn sentences(page: &mut String, all: &[String]) {
    for sentence in all {
        let _ = writeln!(page, "<p>{}</p>", escape(sentence));
    }
}

/// The self-contained page.
pub fn calibration_html(report: &CalibrationReport) -> String {
    let mut page = open(
        &report.title,
        &report.subtitle,
        ("Simulated", &report.version),
        (!report.met).then_some(("The targets are not met within the bounds.", "")),
    );
    page.push_str("<main>\n");
    lead(&mut page, report.verdict.first().map_or("", String::as_str));
    facts(&mut page, &report.facts);
    section(&mut page, "outcome", "Outcome", |page| {
        sentences(page, &report.verdict);
        fact_table(page, &report.found, "No key was fitted.");
    });
    let title = "What the data do not determine";
    section(&mut page, "undetermined", title, |page| {
        sentences(page, &report.undetermined);
    });
    table(&mut page, &report.targets);
    section(&mut page, "keys", "Misfit over each key", |page| {
        none(
            page,
            "Dots: all runs, whatever the other keys. Filled: runs that differ from the best in this key alone, joined. Shaded: the 95 % interval, \
             where the data determine the key. Upright line: the best value. A floor without a hollow is a key that the data leave open.",
        );
        for (index, key) in report.keys.iter().enumerate() {
            let _ = writeln!(page, "<h3><code>{}</code></h3>", escape(&key.name));
            let draw = |layout| key_plot((index, key), &report.tried, layout);
            figure(page, &format!("key{index}"), draw, "");
            embed_key(page, (index, key), &report.tried);
        }
    });
    section(&mut page, "course", "Course of the search", |page| {
        let caption = "Dots: each run in the order requested. Line: the best so far.";
        figure(page, "course", |layout| course_plot(&report.tried, layout), caption);
        embed_course(page, &report.tried);
    });
    table(&mut page, &report.directions);
    if report.keys.len() > 1 {
        table(&mut page, &report.correlation);
    }
    if !report.failures.is_empty() {
        section(&mut page, "failures", "Runs that failed", |page| failures(page, "Run", &report.failures));
    }
    section(&mut page, "method", "Method", |page| {
        sentences(page, &report.method);
    });
    scenario(&mut page, "Best scenario", &report.scenario_toml);
    let footer = "All runs are in calibrate.csv, all numbers in calibrate.json; best.toml is the best scenario.";
    close(page, footer, &[])
}
