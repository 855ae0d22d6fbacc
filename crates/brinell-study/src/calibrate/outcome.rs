//! What a calibration found, as numbers, as a table of its runs and as JSON.

use super::identify::{Direction, MOST};
use super::plan::settings;
use super::runs::{Runs, own_uncertainty};
use super::target::MISSING;
use super::{Evaluation, Fit, FitPlan, Key};
use crate::campaign::{Beforehand, in_json, of_results};
use crate::runner::RunnerError;
use brinell::document::Loaded;
use brinell::made_by::MadeBy;
use brinell::signal::distribution::chi_square_tail;
use brinell::signal::objects;
use brinell_io::{Cells, Column, Table};
use serde::Serialize;
use serde_json::{Map, Value};
use std::sync::Arc;

/// Significance of a misfit: p-values below are one.
const SIGNIFICANCE: f64 = 0.05;

/// A key's value.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The key.
    pub key: Key,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// The best value.
    pub best: f64,
    /// Ends of the 95 % interval within the bounds, where the data determine the key.
    pub interval: Option<(f64, f64)>,
    /// The best value in the unit interval.
    pub place: f64,
    /// Half the 95 % interval about the best value, in ranges, by differences there.
    pub half_width: f64,
    /// Why there is no interval.
    pub open: Option<Open>,
}

/// Why the data do not determine a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Open {
    /// The interval is as wide as the bounds, or nearly so.
    Wide,
    /// The best run does not meet the targets.
    NotMet,
    /// Linear least squares expects the best value elsewhere, here, and no run there was better.
    Elsewhere(f64),
    /// A run far outside the interval meets the targets as well ([`Fit::rival`]).
    Rival(Rival),
}

/// A run that meets the targets as well as the best.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rival {
    /// Its number, from 1.
    pub run: usize,
    /// Its value of the key.
    pub value: f64,
    /// Its sum of squares of the residuals.
    pub chi_square: f64,
}

impl Found {
    /// Whether the data tell the key.
    pub fn is_determined(&self) -> bool {
        self.interval.is_some()
    }

    /// Whether the interval runs beyond the lower and the upper bound, where it ends for want of runs and not because
    /// data say so.
    pub fn is_cut(&self) -> [bool; 2] {
        let within = self.is_determined();
        [within && self.place - self.half_width < 0.0, within && self.place + self.half_width > 1.0]
    }
}

/// A target against the best run.
#[derive(Debug, Clone, Serialize)]
pub struct Met {
    /// Name of the number.
    pub name: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// What it is to be.
    pub target: f64,
    /// The target's standard uncertainty.
    #[serde(rename = "standard_uncertainty")]
    pub uncertainty: f64,
    /// A run's own standard uncertainty, as it counts.
    #[serde(rename = "runs_own_standard_uncertainty")]
    pub of_runs: f64,
    /// What a residual is in multiples of.
    #[serde(rename = "weighed_with")]
    pub sigma: f64,
    /// What the best run has.
    pub value: Option<f64>,
    /// The run's own standard uncertainty.
    #[serde(rename = "best_runs_own_standard_uncertainty")]
    pub own: f64,
    /// Difference in standard uncertainties.
    pub residual: f64,
}

/// What a calibration found.
#[derive(Debug)]
pub struct Outcome {
    /// What was fitted to what.
    pub plan: Arc<FitPlan>,
    /// The search.
    pub fit: Fit,
    /// The keys.
    pub found: Vec<Found>,
    /// The targets.
    pub compared: Vec<Met>,
    /// The best scenario.
    pub best: Loaded,
    /// Why each run failed, of those that did.
    pub reasons: Vec<Option<String>>,
    /// What the best scenario and the runs should be warned of.
    pub warnings: Vec<String>,
    /// Runs that were made.
    pub done: usize,
    /// Runs that were kept from before.
    pub before: usize,
}

impl Outcome {
    pub(super) fn new(plan: &Arc<FitPlan>, runs: &Runs, fit: Fit) -> Result<Self, RunnerError> {
        let place = &fit.evaluations[fit.best].place;
        let row = runs.row(place).ok();
        let compared = plan.targets.iter().enumerate().map(|(t, target)| {
            let quantity = row.and_then(|row| row.quantity(&target.name));
            Met {
                name: target.name.clone(),
                unit: quantity.map_or("", |q| if q.unit == "1" { "" } else { &*q.unit }).to_owned(),
                target: target.value,
                uncertainty: target.uncertainty,
                of_runs: fit.own[t],
                sigma: fit.sigma[t],
                value: quantity.and_then(|q| q.value),
                own: quantity.map_or(0.0, own_uncertainty),
                residual: fit.residuals.get(t).copied().unwrap_or(MISSING),
            }
        });
        let compared = compared.collect();
        let failed = fit.evaluations.iter().map(|e| match e.answers {
            Some(_) => None,
            None => runs.row(&e.place).err(),
        });
        let reasons = failed.collect();
        let best = runs.scenario(place)?;
        let told = |(k, e): (usize, &Evaluation)| Some((k, runs.row(&e.place).ok()?.warnings.clone()));
        let of_runs = of_results(fit.evaluations.iter().enumerate().filter_map(told), "run", |k| k + 1);
        let before = Beforehand::default().warnings(&best.scenario);
        let warnings = before.iter().map(ToString::to_string).chain(of_runs).collect();
        let (done, before) = (runs.own.len(), runs.before);
        let mut outcome =
            Self { plan: Arc::clone(plan), found: Vec::new(), compared, best, reasons, warnings, done, before, fit };
        outcome.found = (0..plan.keys.len()).map(|k| outcome.key(k)).collect();
        Ok(outcome)
    }

    /// What is known of key `k`.
    fn key(&self, k: usize) -> Found {
        let (fit, key) = (&self.fit, &self.plan.keys[k]);
        let (place, half_width) = (fit.evaluations[fit.best].place[k], fit.identified.half_widths[k]);
        let (low, high) = fit.interval(k);
        let rival = || {
            let run = fit.rival(k)?;
            let Evaluation { place, chi_square, .. } = &fit.evaluations[run];
            Some(Rival { run: run + 1, value: key.value(place[k]), chi_square: *chi_square })
        };
        let open = if 2.0 * half_width >= MOST {
            Some(Open::Wide)
        } else if !self.is_met() {
            Some(Open::NotMet)
        } else if let Some(expected) = fit.elsewhere(k) {
            Some(Open::Elsewhere(key.value(expected)))
        } else if let Some(rival) = rival() {
            Some(Open::Rival(rival))
        } else {
            (high - low >= MOST).then_some(Open::Wide)
        };
        Found {
            key: key.clone(),
            unit: self.plan.units[k],
            best: key.value(place),
            interval: open.is_none().then(|| (key.value(low), key.value(high))),
            place,
            half_width,
            open,
        }
    }

    /// What a run sets.
    pub fn settings(&self, run: usize) -> Vec<(String, String)> {
        settings(&self.plan.keys, &self.fit.evaluations[run].place)
    }

    /// Sum of squares of the residuals.
    pub fn chi_square(&self) -> f64 {
        self.fit.evaluations[self.fit.best].chi_square
    }

    /// The p-value of the misfit; `None` without a degree of freedom.
    pub fn p_value(&self) -> Option<f64> {
        let freedom = self.fit.identified.freedom;
        (freedom > 0).then(|| chi_square_tail(self.chi_square(), freedom as f64))
    }

    /// Whether the uncertainties explain the misfit.
    pub fn is_met(&self) -> bool {
        match self.p_value() {
            Some(p) => p >= SIGNIFICANCE,
            // As many keys as targets, or more: each target by itself.
            None => self.compared.iter().all(|c| c.residual.abs() <= 2.0),
        }
    }

    /// A row a run, in the order requested.
    pub fn table(&self) -> Table {
        let all = &self.fit.evaluations;
        let mut table = Table::default();
        let mut numbers = |name: String, unit: &str, about: &str, of: &dyn Fn(usize) -> Option<f64>| {
            let cells = (0..all.len()).map(of).collect();
            table.push(Column::new(name, unit, about), Cells::Numbers(cells));
        };
        numbers("run".into(), "1", "number of the run", &|k| Some((k + 1) as f64));
        for (index, key) in self.plan.keys.iter().enumerate() {
            let value = |k: usize| Some(key.value(all[k].place[index]));
            numbers(key.name.clone(), self.plan.units[index], "fitted", &value);
        }
        numbers("chi_square".into(), "1", "sum of squares of the residuals", &|k| {
            Some(all[k].chi_square).filter(|c| c.is_finite())
        });
        for (t, compared) in self.compared.iter().enumerate() {
            let answer = |k: usize| all[k].answers.as_ref().map(|a| a[t]);
            let name = &compared.name;
            numbers(name.clone(), &compared.unit, "", &|k| answer(k)?.value);
            let about = "the run's own standard uncertainty";
            numbers(format!("{name}.own_uncertainty"), &compared.unit, about, &|k| Some(answer(k)?.uncertainty));
            let about = "difference from the target in standard uncertainties";
            numbers(format!("{name}.residual"), "1", about, &|k| {
                let value = answer(k)?.value?;
                Some((value - compared.target) / self.fit.sigma[t])
            });
        }
        let stages = all.iter().map(|e| Some(e.stage.word().to_owned())).collect();
        let about = "start, swarm, local, or around the best";
        table.push(Column::new("stage", "", about), Cells::Words(stages));
        let status = all.iter().map(|e| Some(if e.answers.is_some() { "complete" } else { "failed" }.to_owned()));
        table.push(Column::new("status", "", "complete or failed"), Cells::Words(status.collect()));
        table.push(Column::new("reason", "", "why it failed"), Cells::Words(self.reasons.clone()));
        table
    }

    /// What `calibrate.json` holds; whether the targets are met and what is not determined are given in words.
    pub fn to_json(&self, verdict: &[String], undetermined: &[String]) -> Value {
        let Self { fit, plan, found, .. } = self;
        let identified = &fit.identified;
        let key = |(k, f): (usize, &Found)| {
            let (low, high) = f.interval.unzip();
            let met_as_well_by = match f.open {
                Some(Open::Rival(rival)) => Some(rival),
                _ => None,
            };
            FittedKey {
                key: f.key.name.clone(),
                unit: f.unit,
                value: f.best,
                low,
                high,
                range: [f.key.low, f.key.high],
                log: f.key.log,
                determined: f.is_determined(),
                met_as_well_by,
                standard_uncertainty_in_ranges: identified.deviations[k],
                difference_over_ranges: 2.0 * fit.steps[k],
            }
        };
        let direction = |d: &Direction| Combination {
            of_ranges: found.iter().zip(&d.vector).map(|(f, v)| (f.key.name.clone(), (*v).into())).collect(),
            singular_value: d.singular_value,
            noise: d.noise,
            half_interval_95_in_ranges: d.half_width,
            determined: d.is_determined(),
        };
        in_json(&Calibrated {
            brinell: brinell::VERSION,
            made_by: MadeBy::now(),
            warnings: &self.warnings,
            plan: plan.header(),
            budget: plan.settings.budget,
            runs: Counts {
                asked_for: fit.evaluations.len(),
                failed: fit.evaluations.iter().filter(|e| e.answers.is_none()).count(),
                best: fit.best + 1,
                differences_around: fit.centre + 1,
            },
            met: self.is_met(),
            chi_square: self.chi_square(),
            degrees_of_freedom: identified.freedom,
            p_value: self.p_value(),
            uncertainties_multiplied_by: identified.inflation,
            keys: found.iter().enumerate().map(key).collect(),
            targets: &self.compared,
            correlation: identified.correlation.row_iter().map(|row| row.iter().copied().collect()).collect(),
            directions: identified.directions.iter().map(direction).collect(),
            verdict,
            undetermined,
            measured: plan.pattern.as_ref().map(|p| &*p.notes),
        })
    }
}

objects! {
    /// `calibrate.json`; what is not finite is null there.
    Calibrated<'a> {
        brinell: &'a str, made_by: MadeBy, warnings: &'a [String], plan: Value, budget: usize, runs: Counts, met: bool, chi_square: f64,
        degrees_of_freedom: i64, p_value: Option<f64>, uncertainties_multiplied_by: f64, keys: Vec<FittedKey>,
        targets: &'a [Met], correlation: Vec<Vec<f64>>, directions: Vec<Combination>, verdict: &'a [String],
        undetermined: &'a [String], measured: Option<&'a [String]>,
    }
    /// Runs.
    Counts { asked_for: usize, failed: usize, best: usize, differences_around: usize }
    /// A key.
    FittedKey {
        key: String, unit: &'static str, value: f64, low: Option<f64>, high: Option<f64>, range: [f64; 2], log: bool,
        determined: bool, met_as_well_by: Option<Rival>, standard_uncertainty_in_ranges: f64,
        difference_over_ranges: f64,
    }
    /// A direction.
    Combination {
        of_ranges: Map<String, Value>, singular_value: f64, noise: f64, half_interval_95_in_ranges: f64,
        determined: bool,
    }
}
