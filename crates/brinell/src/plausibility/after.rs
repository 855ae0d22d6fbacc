//! What the energy audit of a run says: steps that were too long, and the energy error of contact laws that are not conservative.

use super::warning::short;
use crate::scenario::{Accuracy, ModelKind, Scenario};
use crate::simulate::EnergyAudit;

/// Share of the dissipation in contacts beyond which the parametric work of damage is worth a warning.
const PARAMETRIC_SHARE: f64 = 0.1;
/// Share of the turnover that an energy audit may miss before the run is worth a warning; sound runs stay far below.
const RESIDUAL_SHARE: f64 = 0.01;

/// Warnings of a run that is over.
pub fn after(scenario: &Scenario, energy: &EnergyAudit) -> Vec<String> {
    let all = [parametric(scenario, energy), residual(scenario, energy)];
    all.into_iter().flatten().collect()
}

/// An energy audit that does not close: the steps were too long for the motion.
fn residual(scenario: &Scenario, energy: &EnergyAudit) -> Option<String> {
    let share = energy.residual().abs() / energy.turnover();
    // Where nothing moved there is no share.
    (share > RESIDUAL_SHARE).then(|| {
        let remedy = match scenario.simulation.accuracy {
            Accuracy::Standard => "raise simulation.accuracy (allowed: \"reference\")",
            Accuracy::Reference => {
                "simulation.accuracy is \"reference\" already: look for damage that the roller falls into at once (contact.roller_path)"
            }
        };
        format!(
            "the energy audit closes to {:.1} % of the turnover, and 1 % is the limit of a run to rely on: {remedy}",
            100.0 * share
        )
    })
}

/// In words.
fn joule(x: f64) -> String {
    match x.abs() {
        size if size >= 1.0 => format!("{} J", short(x)),
        size if size >= 1e-3 => format!("{} mJ", short(1e3 * x)),
        _ => format!("{} uJ", short(1e6 * x)),
    }
}

fn parametric(scenario: &Scenario, energy: &EnergyAudit) -> Option<String> {
    let (work, dissipated) = (energy.parametric, energy.flows.contact);
    // A bearing whose contacts dissipate nothing may still be fed.
    if work.abs() <= PARAMETRIC_SHARE * dissipated.abs() || work == 0.0 {
        return None;
    }
    let done = if work > 0.0 { "put into" } else { "took out of" };
    let share = if dissipated <= 0.0 {
        "while contact damping dissipates nothing".to_owned()
    } else if work.abs() < 10.0 * dissipated {
        let percent = 100.0 * work.abs() / dissipated;
        format!("{percent:.0} % of the {} that contact damping dissipates", joule(dissipated))
    } else {
        format!("{:.0} times the {} that contact damping dissipates", work.abs() / dissipated, joule(dissipated))
    };
    let remedy = match scenario.simulation.model {
        ModelKind::Full | ModelKind::Tilting => " simulation.laws = \"mechanics\" has no such error.",
        ModelKind::Lumped => "",
    };
    Some(format!(
        "parametric work: the energy error of the paper's contact law {done} the bearing {}, {share}; it is spurious: levels are unreliable, \
         frequencies are fine.{remedy}",
        joule(work.abs())
    ))
}
