//! The plan file: keys, ranges and defaults.

use super::history::{HistoryKeys, MOST_RUNS};
use super::problems::problems;
use super::{Class, Design, HeldSeverity, OutOfRange, Plan, Split};
use crate::design::template::Template;
use brinell::channel::SENSOR;
use brinell::document::reading::{Fallback, Finder, Keys, Reader, key, parse, stated};
use brinell::document::{Problem, Severity};

impl Plan {
    /// Reads a plan file's text.
    ///
    /// # Errors
    /// Every problem of the text at once.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let root = parse(text, &[])?;
        let mut plan = Self::default();
        let mut reader = Reader::with_vocabulary(text, &root, &[]);
        keys(&mut reader, &mut plan);
        reader.finish();
        if let Some(history) = &plan.history {
            plan.runs = history.machines.saturating_mul(history.snapshots);
        }
        let finder = Finder::new(text, &reader.found, &reader.provenance);
        let problems =
            if reader.problems.is_empty() { problems(&plan, text, &finder) } else { reader.problems.finish() };
        if problems.iter().any(|p| p.severity == Severity::Error) {
            return Err(problems);
        }
        if plan.classes.is_empty() {
            plan.classes.push(Class {
                name: "all".into(),
                share: 1.0,
                vary: Template::default(),
                defects: None,
                bearing: None,
            });
        }
        Ok(plan)
    }
}

/// The keys of `[split]`, in their order.
type SplitKeys = (Option<f64>, Option<f64>, Option<Vec<String>>, Option<Vec<String>>, Option<[f64; 2]>);

/// `None` where no key is given.
fn split_of((validation, test, by, severity, range): SplitKeys) -> Option<Split> {
    let is_given = validation.is_some() || test.is_some() || by.is_some();
    let severity = (severity.is_some() || range.is_some())
        .then(|| HeldSeverity { keys: severity.unwrap_or_default(), range: range.unwrap_or([f64::NAN; 2]) });
    (is_given || severity.is_some()).then(|| Split {
        validation: validation.unwrap_or(0.0),
        test: test.unwrap_or(0.0),
        by,
        severity,
    })
}

/// Every key of a plan, once.
pub(in super::super) fn keys(k: &mut Keys, p: &mut Plan) {
    k.key(key("name", "name of the data set"), stated("dataset".into(), "no name given"), &mut p.name);
    k.key(key("base", "file of the base scenario, from the plan's folder"), Fallback::Required, &mut p.base);
    let mut history = HistoryKeys::default();
    history.of_all(k, &mut p.runs);
    k.key(key("seed", "which runs: another seed draws others"), stated(1, "the first"), &mut p.seed);
    k.key(
        key("design", "how runs are spread over the distributions"),
        stated(Design::Random, "each run for itself"),
        &mut p.design,
    );
    k.key(
        key("out_of_range", "what to do about drawn values that make no scenario"),
        stated(OutOfRange::Refuse, "nothing is changed unasked"),
        &mut p.out_of_range,
    );
    k.key(
        key("runs_per_file", "rows of a Parquet file").from(1.0).to(MOST_RUNS),
        stated(256, "some 50 MB of a second's signals"),
        &mut p.runs_per_file,
    );
    k.key(key("licence", "terms of use, best an SPDX identifier"), stated(String::new(), "not stated"), &mut p.licence);
    k.key(
        key("held_out", "fraction of the runs whose labels are in files of their own").from(0.0).to(1.0),
        stated(0.0, "labels beside the signals"),
        &mut p.held_out,
    );
    k.key(
        key("secret", "hexadecimal digits drawn at random, which decide what is held out and everything about it"),
        stated(String::new(), "nothing is held out"),
        &mut p.secret,
    );
    let mut split = (None, None, None, None, None);
    k.section(key("split", "how the open runs are divided, by groups of conditions"), |k| {
        k.optional(key("validation", "share of the open runs for validation").from(0.0).to(1.0), &mut split.0);
        k.optional(key("test", "share of the open runs for the test").from(0.0).to(1.0), &mut split.1);
        k.optional(key("by", "keys of [vary]: runs that are alike in all of them stay together"), &mut split.2);
        k.optional(
            key(
                "severity",
                "drawn keys of damage, such as defects.0.depth_um: runs in severity_range are all for the test",
            ),
            &mut split.3,
        );
        k.optional(
            key("severity_range", "least and largest value of the keys in severity, in their unit"),
            &mut split.4,
        );
    });
    p.split = split_of(split);
    p.history = history.section(k);
    let sensor = SENSOR.map(String::from).to_vec();
    k.key(
        key("signals", "channels to keep; * matches any characters"),
        stated(sensor, "what a data logger holds"),
        &mut p.signals,
    );
    k.key(
        key("vary", "keys of the scenario with values or distributions"),
        stated(Template::default(), "nothing varies"),
        &mut p.vary,
    );
    k.tables(
        key("classes", "kinds of runs: none, one or many"),
        &mut p.classes,
        || Class { name: String::new(), share: 1.0, vary: Template::default(), defects: None, bearing: None },
        |k, class| {
            k.key(key("name", "label of the class"), Fallback::Required, &mut class.name);
            k.key(
                key("share", "its share of the runs, relative to the others'").from(0.0),
                stated(1.0, "as many as the others"),
                &mut class.share,
            );
            k.key(
                key("vary", "keys that vary in this class"),
                stated(Template::default(), "what varies in all"),
                &mut class.vary,
            );
            k.optional(key("defects", "defects in place of the base's"), &mut class.defects);
            k.optional(
                key("bearing", "of a base that is a machine: number of the bearing that has these defects; left out: the first. The others have none")
                    .from(1.0),
                &mut class.bearing,
            );
        },
    );
}
