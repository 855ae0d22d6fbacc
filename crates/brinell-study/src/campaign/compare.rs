//! Runs side by side: every number of each, and its ratio to that of the baseline, the first run.

use super::columns::by_name;
use brinell::result::fields::LEAST_STIFFNESS;
use brinell::result::{Quantity, RunResult};
use brinell::signal::ratio::{Ratio, ratio};

/// One number of several runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// What it is.
    pub name: String,
    /// SI unit; 1 where it has none.
    pub unit: String,
    /// Of each run, in their order; `None` where a run has no such number.
    pub of: Vec<Option<Quantity>>,
    /// Value of each run over the baseline's, with an interval where both values have one; `None` of the baseline
    /// itself, of what is not positive, and of stiffnesses with different exponents, whose units differ.
    pub ratios: Vec<Option<Ratio>>,
}

/// Everything that the runs have, in the order of the first that has it. A ratio is that of the two values; see
/// [`brinell::signal::ratio`].
pub fn compare(runs: &[&RunResult]) -> Vec<Compared> {
    let numbers: Vec<Vec<Quantity>> = runs.iter().map(|run| run.quantities()).collect();
    let numbers: Vec<&[Quantity]> = numbers.iter().map(Vec::as_slice).collect();
    let compared = by_name(&numbers).into_iter().map(|(first, of)| Compared {
        name: first.name.clone(),
        unit: first.unit.clone(),
        of: of.into_iter().map(Option::<&Quantity>::cloned).collect(),
        ratios: vec![None; runs.len()],
    });
    let mut all: Vec<Compared> = compared.collect();
    for compared in &mut all {
        for k in 1..runs.len() {
            let estimate = |k: usize| compared.of[k].as_ref().and_then(Quantity::estimate);
            let exponent = |k: usize| runs[k].scenario.contact.exponent;
            if compared.name.ends_with(LEAST_STIFFNESS.name) && exponent(k) != exponent(0) {
                continue;
            }
            compared.ratios[k] = (estimate(k).zip(estimate(0))).and_then(|(of, to)| ratio(&of, &to));
        }
    }
    all
}
