//! What is fitted to what, before anything runs.

use super::fit::least_budget;
use super::spacing::is_spacing;
use super::target::check;
use super::{CalibrateError, Key, Pattern, Settings, Target};
use crate::campaign::{fingerprint, in_json};
use brinell::document::Loaded;
use brinell::result::{can_be_negative, check_name, listed};
use brinell::signal::objects;
use brinell::simulate::Simulation;
use serde_json::Value;

/// Runs for each key where no budget is given.
const RUNS_PER_KEY: usize = 30;

/// A calibration before it runs.
#[derive(Debug, Clone)]
pub struct FitPlan {
    /// What is fitted.
    pub keys: Vec<Key>,
    /// Unit of each key.
    pub units: Vec<&'static str>,
    /// What is to be met: what is given, then what the measured signal says.
    pub targets: Vec<Target>,
    /// Units of the targets; empty where a number has none.
    pub target_units: Vec<String>,
    /// The measured signal, where there is one.
    pub pattern: Option<Pattern>,
    /// How it is searched.
    pub settings: Settings,
    /// The scenario in the middle of the bounds.
    pub middle: Loaded,
}

/// What a point of the unit cube gives the keys.
pub(super) fn settings(keys: &[Key], place: &[f64]) -> Vec<(String, String)> {
    keys.iter().zip(place).map(|(key, unit)| (key.name.clone(), key.text(*unit))).collect()
}

/// Settings whose scenarios have to be sound before anything runs: each bound with the middle of the other keys.
pub fn bounds(keys: &[Key]) -> impl Iterator<Item = Vec<(String, String)>> {
    let ends = (0..keys.len()).flat_map(|k| [(k, 0.0), (k, 1.0)]);
    ends.map(|(k, end)| {
        let mut place = vec![0.5; keys.len()];
        place[k] = end;
        settings(keys, &place)
    })
}

/// Settings in the middle of the bounds.
pub fn middle(keys: &[Key]) -> Vec<(String, String)> {
    settings(keys, &vec![0.5; keys.len()])
}

impl FitPlan {
    /// Of keys that may be fitted together; `middle` is the scenario of [`middle`]'s settings, and `simulation` is its.
    ///
    /// # Errors
    /// Where there is nothing to meet, a target is no number of a run or one that its number cannot
    /// have, or the budget is too small.
    pub fn new(
        keys: Vec<Key>,
        mut targets: Vec<Target>,
        pattern: Option<Pattern>,
        middle: Loaded,
        simulation: &Simulation,
        seed: u64,
        budget: Option<usize>,
    ) -> Result<Self, CalibrateError> {
        let numbers = listed(&middle.scenario, simulation);
        let names: Vec<String> = numbers.iter().map(|number| number.name.clone()).collect();
        for target in &targets {
            check_name(&target.name, &names)?;
            if target.value < 0.0 && !can_be_negative(&target.name) {
                return Err(target.negative().into());
            }
        }
        if let Some(pattern) = &pattern {
            // A target that is given outweighs what the signal says of the same number.
            let given = |t: &&Target| !targets.iter().any(|g| g.name == t.name);
            let more: Vec<Target> = pattern.targets.iter().filter(given).cloned().collect();
            targets.extend(more);
        }
        check(&targets)?;
        let least = least_budget(keys.len());
        let budget = budget.unwrap_or(RUNS_PER_KEY * keys.len());
        if budget < least {
            return Err(CalibrateError::Budget { budget, least, keys: keys.len() });
        }
        // What a signal says of events, a band or a line.
        let of_signature = |name: &str| match name.starts_with("signature.") {
            true => Some(if is_spacing(name) { "s" } else { "dB" }),
            false => None,
        };
        let of_run = |name: &str| Some(&*numbers.iter().find(|q| q.name == name)?.unit).filter(|unit| *unit != "1");
        let unit = |target: &Target| of_signature(&target.name).or_else(|| of_run(&target.name)).unwrap_or("");
        let target_units = targets.iter().map(|target| unit(target).to_owned()).collect();
        let unit = |key: &Key| middle.provenance_of(&key.name).map_or("", |p| p.unit);
        let units = keys.iter().map(unit).collect();
        Ok(Self { settings: Settings { seed, budget }, keys, units, targets, target_units, pattern, middle })
    }

    /// The same without the spacing `name`, which no run has.
    pub(super) fn without(&self, name: &str) -> Self {
        let mut plan = self.clone();
        if let Some(at) = plan.targets.iter().position(|target| target.name == name) {
            plan.targets.remove(at);
            plan.target_units.remove(at);
        }
        plan
    }

    /// What distinguishes this calibration from others. A larger budget resumes the same one.
    pub fn header(&self) -> Value {
        objects! { Head<'a> { campaign: &'a str, keys: &'a [Key], targets: &'a [Target], seed: u64, scenario: String } }
        let (keys, targets, scenario) = (&self.keys, &self.targets, fingerprint(&self.middle.scenario));
        in_json(&Head { campaign: "calibrate", keys, targets, seed: self.settings.seed, scenario })
    }
}
