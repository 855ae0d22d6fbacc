//! The plan file: keys, ranges and defaults.

mod problems;

use super::template::Template;
use brinell::document::reading::{Choice, Fallback, Finder, Keys, Reader, key, parse, stated};
use brinell::document::{Problem, Severity};

/// Runs of a plan at most: what each of them draws is kept in memory.
const MOST_RUNS: f64 = 1e6;

/// How runs are spread over what their distributions span.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Design {
    /// Each run for itself.
    Random,
    /// Of the n runs of a class one in each n-th part of every distribution.
    LatinHypercube,
    /// A Sobol sequence for each class.
    Sobol,
}

/// What to do about a run whose values do not make a scenario.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutOfRange {
    /// Refuse the plan.
    Refuse,
    /// Draw again until they do: what comes out are the distributions, given that they fit.
    Redraw,
    /// Keep the run as a failed one, with the reason.
    Fail,
}

impl Choice for Design {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("random", Self::Random, "each run for itself"),
        ("latin-hypercube", Self::LatinHypercube, "one run of a class in each slice"),
        ("sobol", Self::Sobol, "a Sobol sequence for each class"),
    ];
}

impl Choice for OutOfRange {
    const WORDS: &'static [(&'static str, Self, &'static str)] = &[
        ("refuse", Self::Refuse, "refuse the plan"),
        ("redraw", Self::Redraw, "draw the run again"),
        ("fail", Self::Fail, "keep the run as a failed one"),
    ];
}

impl Design {
    /// As the plan says it.
    pub fn word(self) -> &'static str {
        Choice::word(self)
    }
}

/// Runs of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Class {
    /// Its label.
    pub name: String,
    /// Its share of the runs, relative to the others'.
    pub share: f64,
    /// Keys that vary in this class.
    pub(super) vary: Template,
    /// The list of defects in place of the base's; `None` leaves those.
    pub(super) defects: Option<Template>,
}

/// How runs whose labels are open are divided for training, validation and test.
#[derive(Debug, Clone, PartialEq)]
pub struct Split {
    /// Share for validation.
    pub validation: f64,
    /// Share for the test.
    pub test: f64,
    /// Keys that make groups: runs that are alike in all of them stay together. `None`: every drawn key of bearing and
    /// operation; empty: each run is a group.
    pub by: Option<Vec<String>>,
    /// Severities that are for the test alone, whatever the group.
    pub severity: Option<HeldSeverity>,
}

/// A range of severities that nothing is trained with.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldSeverity {
    /// Drawn keys; a run has a severity of the range where any of them has.
    pub keys: Vec<String>,
    /// Least and largest, both of them in the range; in the keys' unit.
    pub range: [f64; 2],
}

/// A campaign of runs, as its file says it.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Name of the data set.
    pub name: String,
    /// File of the base scenario, from the plan's folder.
    pub base: String,
    /// How many runs.
    pub runs: usize,
    /// Which ones: another seed draws others.
    pub seed: u64,
    /// How they are spread.
    pub design: Design,
    /// What to do about values that do not fit.
    pub out_of_range: OutOfRange,
    /// Rows of a Parquet file.
    pub runs_per_file: usize,
    /// Under which terms the data may be used, in the author's words; an SPDX identifier is best.
    pub licence: String,
    /// Share of the runs whose labels lie apart.
    pub held_out: f64,
    /// What decides which runs these are and everything that they draw: hexadecimal digits drawn at random; empty where
    /// nothing is held out.
    pub secret: String,
    /// How the runs whose labels are open are divided; `None`: not at all.
    pub split: Option<Split>,
    /// Channels to keep, as `simulation.record` names them.
    pub signals: Vec<String>,
    /// Keys that vary in every class.
    pub(super) vary: Template,
    /// The classes; never empty.
    pub classes: Vec<Class>,
}

impl Plan {
    /// Reads a plan file's text.
    ///
    /// # Errors
    /// Every problem of the text at once.
    pub fn read(text: &str) -> Result<Self, Vec<Problem>> {
        let root = parse(text, &[])?;
        let mut plan = Self::blank();
        let mut reader = Reader::with_vocabulary(text, &root, &[]);
        keys(&mut reader, &mut plan);
        reader.finish();
        let finder = Finder::new(text, &reader.found, &reader.provenance);
        let problems = if reader.problems.is_empty() {
            problems::problems(&plan, text, &finder)
        } else {
            reader.problems.finish()
        };
        if problems.iter().any(|p| p.severity == Severity::Error) {
            return Err(problems);
        }
        if plan.classes.is_empty() {
            plan.classes.push(Class { name: "all".into(), share: 1.0, vary: Template::empty(), defects: None });
        }
        Ok(plan)
    }

    pub(super) fn blank() -> Self {
        Self {
            name: String::new(),
            base: String::new(),
            runs: 0,
            seed: 0,
            design: Design::Random,
            out_of_range: OutOfRange::Refuse,
            runs_per_file: 0,
            licence: String::new(),
            held_out: 0.0,
            secret: String::new(),
            split: None,
            signals: Vec::new(),
            vary: Template::empty(),
            classes: Vec::new(),
        }
    }

    /// Whether labels are held out.
    pub fn holds_out(&self) -> bool {
        self.held_out > 0.0
    }

    fn templates(&self) -> impl Iterator<Item = (String, &Template)> {
        let classes = self.classes.iter().enumerate();
        let own = classes.map(|(k, class)| (format!("classes.{k}.vary"), &class.vary));
        std::iter::once(("vary".to_owned(), &self.vary)).chain(own)
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
pub(super) fn keys<K: Keys>(k: &mut K, p: &mut Plan) {
    k.key(key("name", "name of the data set"), stated("dataset".into(), "no name given"), &mut p.name);
    k.key(key("base", "file of the base scenario, from the plan's folder"), Fallback::Required, &mut p.base);
    k.key(key("runs", "how many runs").from(1.0).to(MOST_RUNS), Fallback::Required, &mut p.runs);
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
    let sensor = ["sensor_ax", "sensor_ay"].map(String::from).to_vec();
    k.key(
        key("signals", "channels to keep; * matches any characters"),
        stated(sensor, "what a data logger holds"),
        &mut p.signals,
    );
    k.key(
        key("vary", "keys of the scenario with values or distributions"),
        stated(Template::empty(), "nothing varies"),
        &mut p.vary,
    );
    k.tables(
        key("classes", "kinds of runs: none, one or many"),
        &mut p.classes,
        || Class { name: String::new(), share: 1.0, vary: Template::empty(), defects: None },
        |k, class| {
            k.key(key("name", "label of the class"), Fallback::Required, &mut class.name);
            k.key(
                key("share", "its share of the runs, relative to the others'").from(0.0),
                stated(1.0, "as many as the others"),
                &mut class.share,
            );
            k.key(
                key("vary", "keys that vary in this class"),
                stated(Template::empty(), "what varies in all"),
                &mut class.vary,
            );
            k.optional(key("defects", "defects in place of the base's"), &mut class.defects);
        },
    );
}
