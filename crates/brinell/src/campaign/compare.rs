//! Runs side by side: every number of each, and how it stands to the first run's.

use super::impacts::impacts;
use super::quantities::{LEAST_STIFFNESS, Quantity, indicator_name};
use super::run::Finished;
use crate::signal::ratio::{Ratio, ratio};
use crate::signal::{Indicator, Interval};
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
    /// Of each run, over the first; `None` of the first itself, of what is not positive, of extremes over blocks of different
    /// lengths, and of stiffnesses with different exponents, whose units differ.
    pub ratios: Vec<Option<Ratio>>,
}

/// Everything that the runs have, in the order of the first that has it. Ratios of indicators and impacts are those of the means over
/// blocks, with intervals (see [`crate::signal::ratio`]); others are plain.
pub fn compare(runs: &[&Finished]) -> Vec<Compared> {
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
    let intervals: Vec<HashMap<String, Interval>> = runs.iter().map(|run| intervals(run)).collect();
    for compared in &mut all {
        for k in 1..runs.len() {
            let known = |k: usize| intervals[k].get(&compared.name);
            let value = |k: usize| compared.of[k].as_ref().and_then(|q: &Quantity| q.value);
            let exponent = |k: usize| runs[k].scenario.contact.exponent;
            if compared.name.ends_with(LEAST_STIFFNESS) && exponent(k) != exponent(0) {
                continue;
            }
            compared.ratios[k] = match (known(k), known(0)) {
                (Some(of), Some(to)) => ratio(of, to),
                _ => plain(value(k), value(0)),
            };
        }
    }
    all
}

fn plain(of: Option<f64>, to: Option<f64>) -> Option<Ratio> {
    let (of, to) = (of?, to?);
    (of > 0.0 && to > 0.0).then_some(Ratio {
        value: of / to,
        interval: None,
    })
}

/// Of everything whose interval comes from blocks or instants.
fn intervals(run: &Finished) -> HashMap<String, Interval> {
    let mut all = HashMap::new();
    for channel in &run.findings.channels {
        for indicator in Indicator::ALL {
            let interval = channel.blocks.estimate(indicator).and_then(|e| e.interval);
            if let Some(interval) = interval {
                let name = indicator_name(&channel.name, channel.kind, indicator);
                all.insert(name, interval);
            }
        }
    }
    for one in impacts(&run.simulation, &run.findings) {
        if let Some(interval) = one.interval {
            all.insert(super::quantities::impact_name(&one), interval);
        }
    }
    all
}
