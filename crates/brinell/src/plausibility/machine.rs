//! What an engineer would ask about a machine: what each bearing carries, whether anything has weight, whether a channel is meant.

use super::warning::{NO_LOAD, WEIGHT_SHARE, short, warning};
use crate::bearing::clearance::bore_diameter_mm;
use crate::document::Problem;
use crate::machine::{Balance, Carried, Machine};
use crate::model::Model;
use crate::scenario::{LoadOn, Scenario, Seat};
use crate::simulate::Simulation;

/// The bearings of a machine in its static balance, each on its own: its scenario with the load that it carries on the inner ring, and the
/// model of that. Weights are part of the loads.
pub fn carried(scenario: &Scenario, machine: &Machine, balance: &Balance) -> Vec<(Scenario, Model)> {
    let one = |(k, of): (usize, &Carried)| {
        let (mut alone, mut model) = (scenario.bearing_of_machine(k), machine.bearings[k].model.clone());
        (alone.operation.load_n, alone.operation.load_on) = (of.force, LoadOn::InnerRing);
        alone.operation.gravity_m_per_s2 = [0.0; 2];
        // Held to be looked at alone, as it would be without a housing.
        model.outer_support.stiffness = alone.support.outer_stiffness_n_per_m;
        (model.load.full, model.load.on, model.gravity) = (of.force, LoadOn::InnerRing, [0.0; 2]);
        // The moment as a lever of the load, as far as it lies in its plane.
        let square: f64 = of.force.iter().map(|f| f * f).sum();
        if let Some(tilt) = model.tilt.as_mut().filter(|_| square > 0.0) {
            let along: f64 = of.moment.iter().zip(&of.force).map(|(m, f)| m * f).sum();
            tilt.load_offset = along / square;
            alone.operation.load_offset_mm = 1e3 * tilt.load_offset;
        }
        (alone, model)
    };
    balance.bearings.iter().enumerate().map(one).collect()
}

/// The bearing that is observed, on its own: of a machine under what it carries in balance.
pub fn observed(scenario: &Scenario) -> Scenario {
    let Some(of) = &scenario.machine else { return scenario.clone() };
    let under_load = || {
        let planned = Simulation::planned(scenario).ok()?;
        let balance = planned.machine().balance().ok()?;
        Some(carried(scenario, planned.machine(), &balance).swap_remove(of.lead).0)
    };
    under_load().unwrap_or_else(|| scenario.bearing_of_machine(of.lead))
}

/// Of a bearing's warnings those that a machine does not answer, with the bearing's number; `turns`: whether anything is out of balance.
pub(super) fn of_bearing(k: usize, turns: bool, warnings: &[Problem]) -> impl Iterator<Item = Problem> {
    const ANSWERED: [&str; 3] = ["support.", "simulation.record", "operation.gravity_m_per_s2"];
    // Unbalance is a load.
    let answered = move |warning: &Problem| turns && warning.message.starts_with(NO_LOAD);
    let concerns =
        move |warning: &&Problem| !ANSWERED.iter().any(|key| warning.key.starts_with(key)) && !answered(warning);
    let numbered = move |warning: &Problem| {
        let key = match warning.key.as_str() {
            "operation.load_n" => "shaft.load".into(),
            key if key.starts_with("simulation.") || key.starts_with("operation.") => key.to_owned(),
            key => format!("bearing.{k}.{}", key.strip_prefix("bearing.").unwrap_or(key)),
        };
        let message = format!("bearing {}: {}", k + 1, warning.message);
        Problem { key, message, value: None, ..warning.clone() }
    };
    warnings.iter().filter(concerns).map(numbered)
}

/// Of the machine as a whole.
pub(super) fn warnings(scenario: &Scenario, simulation: &Simulation) -> Vec<Problem> {
    let idle = simulation.idle_patterns().iter().map(|pattern| {
        let message = format!("\"{pattern}\" matches no channel of this machine");
        let allowed = "names of channels, such as \"bearing1.outer_ax\", \"shaft.x1\"; * stands for any characters";
        Problem::warning("simulation.record", message).allowed(allowed)
    });
    idle.chain(weightless(scenario, simulation.machine())).chain(bores(scenario)).collect()
}

/// Share by which a shaft may differ from the bore of a bearing on it.
const BORE_SHARE: f64 = 0.05;

/// Bearings that do not fit the shaft where they sit.
fn bores(scenario: &Scenario) -> Vec<Problem> {
    let Some(of) = &scenario.machine else { return Vec::new() };
    let (stations, diameters) = (&of.shaft.stations_mm, &of.shaft.diameters_mm);
    let misfit = |(k, (seat, bearing)): (usize, (&Seat, Scenario))| {
        let bore = bore_diameter_mm(&bearing.bearing)?;
        let touches = |ends: &[f64]| (ends[0]..=ends[1]).contains(&seat.at_mm);
        let near = stations.windows(2).zip(diameters).filter(|(ends, _)| touches(ends));
        let fits = near.clone().any(|(_, diameter)| (diameter / bore - 1.0).abs() <= BORE_SHARE);
        let (_, diameter) = near.clone().next()?;
        (!fits).then(|| {
            let message = format!(
                "bearing {}: its bore is {} mm, and the shaft there {} mm thick",
                k + 1,
                short(bore),
                short(*diameter)
            );
            Problem::warning(format!("bearing.{k}.at_mm"), message)
                .allowed("a part of the shaft that fits, or another bearing")
        })
    };
    of.each(scenario).enumerate().filter_map(misfit).collect()
}

/// A shaft whose weight is left out and counts beside the load.
fn weightless(scenario: &Scenario, machine: &Machine) -> Option<Problem> {
    let of = scenario.machine.as_ref()?;
    let load =
        of.shaft.load.iter().fold([0.0; 2], |sum: [f64; 2], of| [sum[0] + of.force_n[0], sum[1] + of.force_n[1]]);
    let (load, weight) = (load[0].hypot(load[1]), machine.shaft_weight());
    (scenario.operation.gravity_m_per_s2 == [0.0; 2] && weight > WEIGHT_SHARE * load).then(|| {
        warning(
            "operation.gravity_m_per_s2",
            "[0.0, 0.0]".into(),
            format!("the shaft and what is on it weigh {} N, and gravity is left out", short(weight)),
            "[0.0, -9.81] m/s^2 for a horizontal shaft",
        )
    })
}
