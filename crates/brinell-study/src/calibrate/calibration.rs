//! From a plan to its outcome.

use super::outcome::Outcome;
use super::runs::{Load, Points, Runs, Unfinished};
use super::spacing::is_spacing;
use super::{FitPlan, Unfit, fit};
use crate::listener::Listener;
use crate::runner::Ledger;
use std::collections::HashSet;
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Makes the runs of a plan, `threads` at a time, as far as the ledger does not hold them, and fits.
///
/// # Errors
/// Where runs cannot go on, or say nothing. What is finished stays in the ledger's journal.
pub fn calibrate(
    plan: &Arc<FitPlan>,
    load: &Load<'_>,
    ledger: Ledger,
    threads: NonZeroUsize,
    listener: &dyn Listener,
) -> Result<Outcome, Unfinished> {
    let points = Points { load, plan };
    let mut runs = Runs { points, ledger, threads, listener, own: HashSet::new(), before: 0, failure: None };
    let mut ask = |places: &[Vec<f64>]| runs.ask(places);
    let found = fit(plan.keys.len(), &plan.targets, plan.settings, &mut ask);
    if let Some(failure) = runs.failure.take() {
        return Err(failure.into());
    }
    match found {
        Ok(found) => Ok(Outcome::new(plan, &runs, found)?),
        // The runs made are in the ledger.
        Err(Unfit::NoValue { name, .. }) if is_spacing(&name) && plan.targets.len() > 1 => {
            let mut outcome = calibrate(&Arc::new(plan.without(&name)), load, runs.ledger, threads, listener)?;
            outcome.warnings.push(format!(
                "warning: {name} is left out: no run spread over the bounds has two events in each pass that are clear, or they are too short"
            ));
            Ok(outcome)
        }
        Err(Unfit::Interrupted) => Err(Unfinished::Unfit { unfit: Unfit::Interrupted, reasons: Vec::new() }),
        Err(unfit) => Err(Unfinished::Unfit { unfit, reasons: runs.reasons() }),
    }
}
