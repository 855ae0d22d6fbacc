//! What the runs of one class draw, and by which design.

use super::distribution::Distribution;
use super::plan::{Class, Design, Plan};
use super::sequence::{Sequence, Sobol};
use super::stream::{bits, word};
use brinell::document::Problem;
use std::ops::Range;

/// A key that is drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Its path; elements of lists by number.
    pub key: String,
    /// Whether every value is a number.
    pub numeric: bool,
    /// Whether all classes draw it from `[vary]`, so that it says nothing of the class.
    pub common: bool,
    /// Whether each snapshot of a machine draws it anew.
    pub anew: bool,
}

/// A key that a class draws.
pub(super) struct Axis {
    /// Its index among the plan's.
    pub(super) parameter: usize,
    pub(super) distribution: Distribution,
    /// Whether each snapshot of a machine draws it anew.
    pub(super) is_anew: bool,
}

/// A class as it is drawn.
pub(super) struct Drawn {
    /// All of its runs, and those of them that the design spreads.
    pub(super) runs: usize,
    pub(super) open: usize,
    /// The keys of `[vary]` and of a machine's life first, as in every class; those of its snapshots last.
    pub(super) axes: Vec<Axis>,
    /// Those of a machine's life.
    pub(super) life: Range<usize>,
    /// Of the class's own keys.
    pub(super) sequence: Sequence,
    /// Settings of all grids together.
    pub(super) combinations: usize,
}

impl Drawn {
    /// Class `c` of the plan with so many runs: all, and those that the design spreads.
    pub(super) fn new(
        plan: &Plan,
        c: usize,
        [runs, open]: [usize; 2],
        parameters: &mut Vec<Parameter>,
        problems: &mut Vec<Problem>,
    ) -> Self {
        let class = &plan.classes[c];
        let axes = axes(plan, class, parameters);
        let drawn_once = || axes.iter().filter(|axis| !axis.is_anew);
        let common = common_axes(plan);
        let own = drawn_once().count() - common;
        let combinations = drawn_once().fold(1_usize, |product, axis| match &axis.distribution {
            Distribution::Grid { values } => product.saturating_mul(values.len()),
            _ => product,
        });
        if combinations > open && open > 0 {
            problems.push(too_few_runs(plan, class, open, combinations));
        }
        let keys = drawn_once().count();
        if plan.design == Design::Sobol && keys > Sobol::MOST {
            problems.push(too_many_keys(class, keys));
        }
        let sequence = sequence(plan, c as u64, own, open);

        let mut of_scenario = Vec::new();
        plan.vary.distributions("", &mut of_scenario);
        Self { runs, open, axes, life: of_scenario.len()..common, sequence, combinations }
    }
}

/// What the class draws: the plan's keys, then its own.
fn axes(plan: &Plan, class: &Class, parameters: &mut Vec<Parameter>) -> Vec<Axis> {
    let mut found = common_distributions(plan);
    let common = found.len();
    class.vary.distributions("", &mut found);
    if let Some(defects) = &class.defects {
        defects.distributions("defects", &mut found);
    }
    let once = found.len();
    if let Some(history) = &plan.history {
        history.snapshot.distributions("", &mut found);
    }
    found
        .into_iter()
        .enumerate()
        .map(|(k, (key, distribution))| Axis {
            parameter: parameter(parameters, &key, distribution, [k < common || k >= once, k >= once]),
            distribution: distribution.clone(),
            is_anew: k >= once,
        })
        .collect()
}

/// The parameter of that key, made where there is none yet.
fn parameter(all: &mut Vec<Parameter>, key: &str, distribution: &Distribution, [common, anew]: [bool; 2]) -> usize {
    let numeric = distribution.is_numeric();
    if let Some(k) = all.iter().position(|p| p.key == key) {
        all[k].numeric &= numeric;
        return k;
    }
    all.push(Parameter { key: key.into(), numeric, common, anew });
    all.len() - 1
}

fn too_few_runs(plan: &Plan, class: &Class, runs: usize, combinations: usize) -> Problem {
    let apart = if plan.holds_out() { " whose labels are not held out" } else { "" };
    let (all, each) = (plan.units(), plan.unit());
    let message = format!(
        "class {:?} has {runs} of the plan's {all} {each}s{apart}, and its grids have {combinations} combinations",
        class.name
    );
    Problem::error(format!("{each}s"), message).value(all.to_string()).allowed(format!(
        "a {each} for each combination: about {} {each}s, or shorter grids",
        combinations.saturating_mul(all).div_ceil(runs.max(1))
    ))
}

fn too_many_keys(class: &Class, keys: usize) -> Problem {
    let message = format!("class {:?} draws {keys} keys", class.name);
    let allowed = format!("up to {} keys in a Sobol sequence; \"latin-hypercube\" has no limit", Sobol::MOST);
    Problem::error("design", message).value("\"sobol\"").allowed(allowed)
}

/// Keys that all classes draw.
pub(super) fn common_axes(plan: &Plan) -> usize {
    common_distributions(plan).len()
}

fn common_distributions(plan: &Plan) -> Vec<(String, &Distribution)> {
    let mut found = Vec::new();
    plan.vary.distributions("", &mut found);
    plan.history.iter().for_each(|history| history.distributions(&mut found));
    found
}

/// Where `runs` runs draw so many keys; `own` tells the designs of a plan apart.
pub(super) fn sequence(plan: &Plan, own: u64, keys: usize, runs: usize) -> Sequence {
    let seed = bits(&[plan.seed, word("design"), own]);
    match plan.design {
        Design::Random => Sequence::Random,
        Design::LatinHypercube => Sequence::latin(seed, keys, runs),
        Design::Sobol => Sequence::Sobol(Sobol::new(keys.min(Sobol::MOST)).shifted(seed)),
    }
}
