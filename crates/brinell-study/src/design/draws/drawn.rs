//! What the runs of one class draw, and by which design.

use super::Parameter;
use crate::design::distribution::Distribution;
use crate::design::plan::{Class, Design, Plan};
use crate::design::sequence::{Sequence, Sobol};
use crate::design::stream::{bits, word};
use brinell::document::Problem;

/// A key that a class draws.
pub(super) struct Axis {
    /// Its index among the plan's.
    pub(super) parameter: usize,
    pub(super) distribution: Distribution,
}

/// A class as it is drawn.
pub(super) struct Drawn {
    /// All of its runs, and those of them that the design spreads.
    pub(super) runs: usize,
    pub(super) open: usize,
    pub(super) axes: Vec<Axis>,
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
        let combinations = axes
            .iter()
            .fold(1_usize, |product, axis| match &axis.distribution {
                Distribution::Grid { values } => product.saturating_mul(values.len()),
                _ => product,
            });
        if combinations > open && open > 0 {
            problems.push(too_few_runs(plan, class, open, combinations));
        }
        let sequence = sequence(plan, c, axes.len(), open, problems);
        Self {
            runs,
            open,
            axes,
            sequence,
            combinations,
        }
    }
}

/// What the class draws: the plan's keys, then its own.
fn axes(plan: &Plan, class: &Class, parameters: &mut Vec<Parameter>) -> Vec<Axis> {
    let mut found = Vec::new();
    plan.vary.distributions("", &mut found);
    let common = found.len();
    class.vary.distributions("", &mut found);
    if let Some(defects) = &class.defects {
        defects.distributions("defects", &mut found);
    }
    found
        .into_iter()
        .enumerate()
        .map(|(k, (key, distribution))| Axis {
            parameter: parameter(parameters, &key, distribution, k < common),
            distribution: distribution.clone(),
        })
        .collect()
}

/// The parameter of that key, made where there is none yet.
fn parameter(
    all: &mut Vec<Parameter>,
    key: &str,
    distribution: &Distribution,
    common: bool,
) -> usize {
    let numeric = distribution.is_numeric();
    if let Some(k) = all.iter().position(|p| p.key == key) {
        all[k].numeric &= numeric;
        return k;
    }
    all.push(Parameter {
        key: key.into(),
        numeric,
        common,
    });
    all.len() - 1
}

fn too_few_runs(plan: &Plan, class: &Class, runs: usize, combinations: usize) -> Problem {
    let apart = if plan.holds_out() {
        " whose labels are not held out"
    } else {
        ""
    };
    let message = format!(
        "class {:?} has {runs} of the plan's {} runs{apart}, and its grids have {combinations} combinations",
        class.name, plan.runs
    );
    Problem::error("runs", message)
        .value(plan.runs.to_string())
        .allowed(format!(
            "a run for each combination: about {} runs, or shorter grids",
            combinations.saturating_mul(plan.runs).div_ceil(runs.max(1))
        ))
}

/// Where `runs` runs of class `c` draw.
fn sequence(
    plan: &Plan,
    c: usize,
    dimensions: usize,
    runs: usize,
    problems: &mut Vec<Problem>,
) -> Sequence {
    let own = bits(&[plan.seed, word("design"), c as u64]);
    match plan.design {
        Design::Random => Sequence::Random,
        Design::LatinHypercube => Sequence::latin(own, dimensions, runs),
        Design::Sobol if dimensions > Sobol::MOST => {
            let message = format!("class {:?} draws {dimensions} keys", plan.classes[c].name);
            let allowed = format!(
                "up to {} keys in a Sobol sequence; \"latin-hypercube\" has no limit",
                Sobol::MOST
            );
            problems.push(
                Problem::error("design", message)
                    .value("\"sobol\"")
                    .allowed(allowed),
            );
            Sequence::Random
        }
        Design::Sobol => Sequence::Sobol(Sobol::new(dimensions).shifted(own)),
    }
}
