//! Runs side by side: every number of each, and its ratio to that of the baseline, the first run.

use brinell::result::fields::LEAST_STIFFNESS;
use brinell::result::{Quantity, RunResult};
use brinell::signal::ratio::{Ratio, ratio};
use std::collections::HashMap;

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
    let mut all: Vec<Compared> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for (k, run) in runs.iter().enumerate() {
        for quantity in run.quantities() {
            let place = *places.entry(quantity.name.clone()).or_insert_with(|| {
                all.push(Compared {
                    name: quantity.name.clone(),
                    unit: quantity.unit.clone(),
                    of: vec![None; runs.len()],
                    ratios: vec![None; runs.len()],
                });
                all.len() - 1
            });
            all[place].of[k] = Some(quantity);
        }
    }
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
