//! What many runs should be warned of: each kind of problem once, with how many have it.

use crate::campaign::row::fingerprint;
use brinell::document::{Loaded, Problem, numberless};
use brinell::plausibility;
use brinell::scenario::Scenario;
use brinell::simulate::Simulation;
use std::collections::HashMap;
use std::fmt::Display;
use std::sync::{Mutex, PoisonError};

/// Scenarios whose static balance is solved before any runs: it takes some 10 ms.
pub const BALANCED: usize = 50;

/// A problem that some runs have.
#[derive(Debug, Clone, PartialEq)]
pub struct Misses {
    /// As the first of these runs has it.
    pub problem: Problem,
    /// Index of that run.
    pub run: usize,
    /// How many of the runs looked at.
    pub count: usize,
    /// Index of the last of them.
    pub last: usize,
}

impl Misses {
    /// The problem, and how many of `looked` have it; `what` are they, and `first` is what the first is called.
    pub fn words(&self, looked: usize, what: &str, first: impl Display) -> String {
        let s = if looked == 1 { "" } else { "s" };
        format!(
            "{}\n  (in {} of {looked} {what}{s} looked at, the first of them {what} {first})",
            self.problem, self.count
        )
    }
}

/// Adds to those that differ in numbers alone, of defects too; a run that has several of a kind counts once.
pub fn count(all: &mut Vec<Misses>, problem: Problem, run: usize) {
    join(all, Misses { problem, run, count: 1, last: run });
}

/// Adds what later runs have.
pub fn join(all: &mut Vec<Misses>, later: Misses) {
    let kind = |m: &Misses| {
        let Problem { key, message, .. } = &m.problem;
        // What a result is warned of has no key: its kind is before the colon, and units and remedies behind it vary.
        let words = if key.is_empty() { message.split(": ").next() } else { None };
        (numberless(key), numberless(words.unwrap_or(message)))
    };
    match all.iter_mut().find(|m| kind(m) == kind(&later)) {
        Some(miss) => {
            miss.count += later.count - usize::from(miss.last == later.run);
            miss.last = later.last;
        }
        None => all.push(later),
    }
}

/// What a run that is over should be warned of, by [`brinell::plausibility::after`].
fn count_result(all: &mut Vec<Misses>, warnings: Vec<String>, run: usize) {
    warnings.into_iter().for_each(|words| count(all, Problem::warning("", words), run));
}

/// What results should be warned of, each kind once with how many have it: of run k by [`brinell::plausibility::after`].
/// `one` is what each is, and `name` what it is called.
pub fn of_results<N: Display>(
    results: impl IntoIterator<Item = (usize, Vec<String>)>,
    one: &str,
    name: impl Fn(usize) -> N,
) -> Vec<String> {
    let (mut all, mut looked) = (Vec::new(), 0);
    for (k, warnings) in results {
        count_result(&mut all, warnings, k);
        looked += 1;
    }
    all.iter().map(|miss: &Misses| miss.words(looked, one, name(miss.run))).collect()
}

/// Where a scenario's sensor signals end: its sample rate and the sensor's band, Hz.
pub fn bandwidth(scenario: &Scenario) -> [Option<f64>; 3] {
    let Scenario { simulation, sensor, .. } = scenario;
    [Some(simulation.sample_rate_hz), sensor.low_cut_hz, sensor.high_cut_hz]
}

/// What is said where [`bandwidth`] is not the same in all runs.
pub const BANDWIDTHS: &str = "the sensor's levels, peaks and kurtosis are of different bandwidths, and so are \
    their ratios: the anti-alias filter goes with the sample rate. To compare bearings, give \
    simulation.sample_rate_hz, sensor.low_cut_hz and sensor.high_cut_hz the same values";

/// Finds the warnings of [`plausibility`]; of scenarios that mean the same once.
#[derive(Debug, Default)]
pub struct Beforehand {
    known: Mutex<HashMap<String, Vec<Problem>>>,
}

/// What is known of a point of a grid before it runs.
#[derive(Debug)]
pub struct Known {
    /// Of the document.
    read: Vec<Problem>,
    /// Of the scenario; of the first [`BALANCED`] points.
    before: Option<Vec<Problem>>,
    bandwidth: [Option<f64>; 3],
}

/// What a grid's points should be warned of before they run, each kind once; those that are bad are `None`.
pub(crate) fn of_points<'a>(points: impl IntoIterator<Item = Option<&'a Known>>) -> Vec<String> {
    let (mut read, mut before, mut good, mut balanced) = (Vec::new(), Vec::new(), 0, 0);
    let (mut first, mut unlike) = (None, false);
    for (k, known) in points.into_iter().enumerate() {
        let Some(known) = known else { continue };
        good += 1;
        balanced += usize::from(known.before.is_some());
        known.read.iter().for_each(|problem| count(&mut read, problem.clone(), k));
        known.before.iter().flatten().for_each(|problem| count(&mut before, problem.clone(), k));
        unlike |= *first.get_or_insert(known.bandwidth) != known.bandwidth;
    }
    let words = |misses: Vec<Misses>, looked: usize| {
        misses.into_iter().map(move |miss| miss.words(looked, "point", miss.run + 1))
    };
    let bandwidths = unlike.then(|| format!("warning: {BANDWIDTHS}"));
    words(read, good).chain(words(before, balanced)).chain(bandwidths).collect()
}

impl Beforehand {
    /// Of point `k` of a grid. Its place in the file goes: what the settings give is nowhere there.
    pub fn point(&self, k: usize, loaded: &Loaded) -> Known {
        let mut read = loaded.warnings.clone();
        read.iter_mut().for_each(|problem| (problem.line, problem.column) = (None, None));
        let before = (k < BALANCED).then(|| self.warnings(&loaded.scenario));
        Known { read, before, bandwidth: bandwidth(&loaded.scenario) }
    }

    /// Of a scenario; none where it makes no model: why, its run says.
    pub fn warnings(&self, scenario: &Scenario) -> Vec<Problem> {
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let print = fingerprint(scenario);
        if let Some(warnings) = known().get(&print) {
            return warnings.clone();
        }
        // Unlocked: other threads have other scenarios.
        let planned = Simulation::planned(scenario);
        let found = planned.map_or(Vec::new(), |of| plausibility::Beforehand::of_run(scenario, &of).warnings);
        known().insert(print, found.clone());
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_run_counts_once_for_each_kind() {
        let problem = |key: &str, deep: f64| Problem::error(key, format!("{deep} um is deep"));
        let mut all = Vec::new();
        for run in 3..6 {
            for defect in 0..3 {
                count(&mut all, problem(&format!("defects.{defect}.depth_um"), (run + defect) as f64), run);
            }
        }
        let later = Misses { problem: problem("defects.0.depth_um", 1.0), run: 8, count: 2, last: 9 };
        join(&mut all, later);
        let counts = |all: &[Misses]| -> Vec<_> { all.iter().map(|m| (m.run, m.count, m.last)).collect() };
        assert_eq!(counts(&all), [(3, 5, 9)]);
        let (mut all, said) = (Vec::new(), ["audit: 1 J, 20 %", "audit: 3 mJ, 5 times", "not settled: row 1"]);
        said.into_iter().enumerate().for_each(|(run, words)| count_result(&mut all, vec![words.into()], run));
        assert_eq!(counts(&all), [(0, 2, 1), (2, 1, 2)]);
    }
}
