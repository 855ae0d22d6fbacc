//! What no single key of a plan can say.

use super::history::MOST_RUNS;
use super::{Class, OutOfRange, Plan, Split};
use crate::design::distribution::Distribution;
use crate::design::history::{History, short};
use crate::design::stream::Secret;
use crate::design::template::Template;
use brinell::document::reading::{Finder, brief_path, path_parts};
use brinell::document::{Problem, Problems, Severity, locate, numberless};
use std::collections::HashSet;

/// Keys that vary in a class, or in all, at most: a scenario has some two hundred, and lists of defects.
const MOST_VARIED: usize = 2000;

/// The problems of a plan whose keys are sound one by one.
pub(super) fn problems(plan: &Plan, text: &str, finder: &Finder) -> Vec<Problem> {
    let mut checker = Checker { plan, text, finder, all: Problems::of(text) };
    if checker.few_enough_keys() {
        checker.check();
    }
    checker.all.finish()
}

struct Checker<'a> {
    plan: &'a Plan,
    text: &'a str,
    finder: &'a Finder<'a>,
    all: Problems<'a>,
}

impl Checker<'_> {
    /// An error at `key`; `value` is repeated where there is one.
    fn add(&mut self, key: &str, value: &str, message: String, allowed: &str) {
        self.all.add_of(Severity::Error, numberless(&message), || {
            let place = self.finder.place(key).or_else(|| locate(self.text, key));
            let mut problem = Problem::error(brief_path(key), message).allowed(allowed);
            if !value.is_empty() {
                problem = problem.value(value);
            }
            (problem.at(place), None)
        });
    }

    /// Whether so few keys vary that each can be looked at.
    fn few_enough_keys(&mut self) -> bool {
        for (what, template) in self.plan.templates() {
            let count = template.settings().len();
            if count > MOST_VARIED {
                let allowed = format!("at most {MOST_VARIED} keys");
                self.add(&what, "", format!("{count} keys vary"), &allowed);
                return false;
            }
        }
        true
    }

    fn check(&mut self) {
        let plan = self.plan;
        if !matches!(plan.vary, Template::Table(_)) {
            self.add("vary", "", "expected a section [vary]".into(), "keys of a scenario");
        }
        if plan.holds_out() && Secret::of(&plan.secret).is_none() {
            // The value is not repeated: terminals keep what they show.
            self.add(
                "secret",
                "",
                "held_out needs a secret that cannot be guessed; whoever has it has the labels".into(),
                "32 or more hexadecimal digits drawn at random, such as `openssl rand -hex 16` prints",
            );
        }
        if let Some(split) = &plan.split {
            self.split(split);
        }
        if plan.signals.is_empty() {
            self.add("signals", "[]", "a data set without signals".into(), "channels, such as \"sensor_ax\"");
        }
        if let Some(history) = &plan.history {
            self.history(history);
        }
        self.classes();
        self.settings();
    }

    fn history(&mut self, history: &History) {
        let runs = self.plan.runs as f64;
        if runs > MOST_RUNS {
            let message =
                format!("{} machines with {} snapshots are up to {runs} runs", history.machines, history.snapshots);
            self.add("machines", &history.machines.to_string(), message, &format!("at most {MOST_RUNS} runs"));
        }
        if history.begins_at.ends()[1] >= 1.0 {
            let message = "damage would begin at failure, with the length that it has then: nothing grows";
            self.add("history.begins_at", &history.begins_at.to_string(), message.into(), "< 1, such as 0.9");
        }
        let ([_, begins], [fails, _]) = (history.begins_mm.ends(), history.fails_mm.ends());
        if begins >= fails {
            let begins = short(begins);
            let message = format!("damage begins with up to {begins} mm, so that its size would shrink until it fails");
            let allowed = format!("> {begins} mm, or a smaller history.begins_mm");
            self.add("history.fails_mm", &history.fails_mm.to_string(), message, &allowed);
        }
        if self.plan.out_of_range == OutOfRange::Redraw {
            let message = "a snapshot that is drawn again would be of another machine";
            self.add(
                "out_of_range",
                "\"redraw\"",
                message.into(),
                "\"refuse\" or \"fail\" where machines have histories",
            );
        }
        if !matches!(history.snapshot, Template::Table(_)) {
            self.add("history.snapshot", "", "expected a section [history.snapshot]".into(), "keys of a scenario");
        }
        let is_table = matches!(history.snapshot, Template::Table(_));
        for (path, _) in history.snapshot.settings().into_iter().filter(|_| is_table) {
            let at = format!("history.snapshot.{path}");
            if path.starts_with("bearing") || path.starts_with("defects") {
                let message = "a machine keeps its bearing, and its damage grows by [history]";
                self.add(
                    &at,
                    "",
                    message.into(),
                    "keys of operation, sensor, lubricant, ...; this one in [vary] or in a class",
                );
            }
            let sets = |class: &Class| class.vary.sets(&path);
            if self.plan.vary.sets(&path) || self.plan.classes.iter().any(sets) {
                self.add(
                    &at,
                    "",
                    "drawn once for each machine too".into(),
                    "a key varies in one place: [history.snapshot], [vary] or a class",
                );
            }
        }
        self.one_sense();
    }

    /// That no machine turns one way at a snapshot and the other way at another: damage would have no trailing edge.
    fn one_sense(&mut self) {
        for (what, template) in self.plan.templates() {
            let mut found = Vec::new();
            template.distributions("", &mut found);
            let both = |d: &Distribution| d.ends()[0] < 0.0 && d.ends()[1] > 0.0;
            if found.iter().any(|(path, d)| path == "operation.speed_rpm" && both(d)) {
                let message = "speeds of both signs: the trailing edge of damage would be the leading one at times";
                self.add(
                    &format!("{what}.operation.speed_rpm"),
                    "",
                    message.into(),
                    "speeds of one sign in a plan with histories",
                );
            }
        }
    }

    fn split(&mut self, split: &Split) {
        if split.validation + split.test >= 1.0 {
            self.add(
                "split",
                "",
                format!(
                    "validation and test take {} of the runs, and leave none to train with",
                    split.validation + split.test
                ),
                "validation + test < 1",
            );
        }
        if let Some(severity) = &split.severity {
            let [low, high] = severity.range;
            if severity.keys.is_empty() {
                self.add(
                    "split.severity",
                    "[]",
                    "severity_range is of no key".into(),
                    "keys of damage that are drawn, such as [\"defects.0.depth_um\"]",
                );
            }
            // Not a number where it is left out.
            if low.is_nan() || low > high {
                self.add(
                    "split.severity_range",
                    "",
                    "which severities are for the test alone?".into(),
                    "[least, largest], in the unit of the keys in severity",
                );
            }
        }
        if self.plan.out_of_range == OutOfRange::Redraw {
            self.add(
                "split",
                "",
                "a run that is drawn again leaves its group of conditions".into(),
                "out_of_range = \"refuse\" or \"fail\" where runs are split",
            );
        }
    }

    fn classes(&mut self) {
        let classes = &self.plan.classes;
        let mut names = HashSet::new();
        for (k, class) in classes.iter().enumerate() {
            if class.name.is_empty() || !names.insert(class.name.as_str()) {
                let why = if class.name.is_empty() { "a class needs a name" } else { "the name comes twice" };
                self.add(
                    &format!("classes.{k}.name"),
                    &format!("{:?}", class.name),
                    why.into(),
                    "a name of its own for each class",
                );
            }
            self.class(k, class);
        }
        if !classes.is_empty() && classes.iter().all(|class| class.share == 0.0) {
            self.add("classes", "", "every class has a share of 0".into(), "a class with a share above 0");
        }
    }

    /// What varies in a class, and its defects.
    fn class(&mut self, k: usize, class: &Class) {
        let at = |name: &str| format!("classes.{k}.{name}");
        if !matches!(class.vary, Template::Table(_)) {
            self.add(&at("vary"), "", "expected a section".into(), "keys of a scenario");
        }
        if matches!(&class.defects, Some(Template::Fixed(_) | Template::Drawn(_) | Template::Table(_))) {
            self.add(&at("defects"), "", "expected [[classes.defects]] entries, or []".into(), "a list of defects");
        }
        if let (Some(Template::List(defects)), Some(_)) = (&class.defects, &self.plan.history)
            && defects.len() > 1
        {
            let message = format!("a history grows one defect, and this class has {}", defects.len());
            self.add(
                &at("defects"),
                "",
                message,
                "one defect, on the part that the class is about; [] for machines that stay healthy",
            );
        }
        let common = &self.plan.vary;
        if class.defects.is_some() && (common.sets("defects") || class.vary.sets("defects")) {
            let why = "this class has defects of its own, which `vary` would change as well";
            self.add(&at("defects"), "", why.into(), "defects in the class, or defects in vary");
        }
        for (path, _) in common.settings() {
            if class.vary.sets(&path) {
                self.add(&at(&format!("vary.{path}")), "", "set in [vary] too; a key varies in one place".into(), "");
            }
        }
    }

    /// The keys that vary, one by one.
    fn settings(&mut self) {
        for (what, template) in self.plan.templates() {
            let is_table = matches!(template, Template::Table(_));
            for (path, _) in template.settings().into_iter().filter(|_| is_table) {
                if path.split('.').next() == Some("history") {
                    let message = "how damage grows is no key of a scenario".to_owned();
                    self.add(
                        &format!("{what}.{path}"),
                        "",
                        message,
                        "this key in [history]: any number there may be a distribution",
                    );
                    continue;
                }
                if let Err(message) = path_parts(&path) {
                    self.add(&format!("{what}.{path}"), "", message, "");
                }
            }
            let record = format!("{what}.simulation.record");
            if template.sets("simulation.record") {
                self.add(&record, "", "`signals` says what is recorded".into(), "");
            }
        }
    }
}
