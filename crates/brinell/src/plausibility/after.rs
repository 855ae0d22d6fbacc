//! What a run that is over shows and its reader should know, in words: an ADC that does not fit the signal, a start that is not over, cages that
//! skid or stray, contacts beneath the floor of their damage, and energy: steps that were too long, contact laws that are not conservative.

use super::table::{FELT, is_beneath};
use super::warning::short;
use crate::channel::Channel;
use crate::defect::{Defect, Defects, SIDES, Side};
use crate::model::Model;
use crate::observe::slip::RowSlip;
use crate::observe::{Drift, Findings};
use crate::scenario::{Accuracy, Laws, ModelKind, Scenario};
use crate::sensor::{Chain, ChannelRecord};
use crate::signal::rounded;
use crate::simulate::{EnergyAudit, Outcome, RESIDUAL_SHARE, Simulation};

/// Share of the dissipation in contacts beyond which the parametric work of damage is worth a warning. A fifth more or less of the power
/// that vibration loses is 1 dB of its level.
const PARAMETRIC_SHARE: f64 = 0.2;
/// Slip of a cage beyond which elements skid rather than roll: bearings whose load drives them slip by a few per cent.
const SKIDDING: f64 = 0.5;
/// Mean distance of a cage from its land's centre, over the clearance, beyond which its stop is too soft: at the
/// defaults cages of small bearings lie 1.0 to 1.1 times the clearance away.
const STRAYED: f64 = 1.2;

/// What a run shows that its reader should know; what kind of warning it is stands before the colon.
pub fn after(scenario: &Scenario, simulation: &Simulation, outcome: &Outcome, findings: &Findings) -> Vec<String> {
    [converted(simulation, outcome), unsettled(findings), doubtful(scenario, simulation, outcome, findings)].concat()
}

/// What a run shows that its scenario or the model should not: in words.
#[doc(hidden)]
pub fn doubtful(scenario: &Scenario, simulation: &Simulation, outcome: &Outcome, findings: &Findings) -> Vec<String> {
    let model = simulation.model();
    let sunk = sunk_too_deep(model, findings);
    [
        strayed(scenario, findings),
        skidding(scenario, model, findings),
        sunk,
        of_energy(scenario, &outcome.energy, outcome.refined),
    ]
    .concat()
}

/// Which sensor channels went beyond the ADC's full scale, or stayed within one of its steps, in words.
#[doc(hidden)]
pub fn converted(simulation: &Simulation, outcome: &Outcome) -> Vec<String> {
    let step = rounded(simulation.sensor().and_then(Chain::step).unwrap_or(f64::NAN), 4);
    let words = |(channel, record): (&Channel, &ChannelRecord)| {
        let (name, rows) = (&channel.name, outcome.rows);
        if record.is_constant() && record.clipped == 0 {
            return Some(format!(
                "all {rows} samples of {name} are one value: the ADC's step of {step} m/s^2 is larger than the signal; give sensor.converter_bits \
                 more bits or a smaller range"
            ));
        }
        (record.clipped > 0).then(|| {
            format!("{} of {rows} samples of {name} are beyond the ADC's range and are clipped", record.clipped)
        })
    };
    simulation.filtered().iter().zip(&outcome.sensor).filter_map(words).collect()
}

/// Cages that stand still or nearly so while elements are loaded, in words.
fn skidding(scenario: &Scenario, model: &Model, findings: &Findings) -> Vec<String> {
    let rim = model.defects.iter().map(|defect| 1e6 * defect.shape.raised()).fold(0.0, f64::max);
    let words = |(k, row): (usize, &RowSlip)| {
        let (cage, element) = (row.cage()?.value, scenario.bearing.element.word());
        let loaded = row.loaded_surface()?.value;
        let cause = match rim > 0.0 {
            true => format!(
                ". Edges raised by {} um may hold its {element}s: look at the damage's depths below 0 and at bearing.radial_clearance_um",
                short(rim)
            ),
            false => format!(
                ", and loaded {element}s slipped over {:.0} % of the inner raceway's way: friction does not drive them. BPFO, BPFI and FTF are far from \
                 pure rolling, and raceways would be smeared. Look at operation.load_n, the friction and lubricant keys (lubricant.drag_coefficient) \
                 and the cage's clearances",
                100.0 * loaded
            ),
        };
        let turned = 100.0 * (1.0 - cage);
        let said = format!(
            "skidding: the cage of row {} turned at {turned:.0} % of its pure-rolling speed on average{cause}",
            k + 1
        );
        (cage > SKIDDING).then_some(said)
    };
    findings.slip.rows.iter().enumerate().filter_map(words).collect()
}

/// Elements that sank deeper into damage than it is deep: its table goes on straight beyond its last deformation, as if there were no floor.
/// In words.
fn sunk_too_deep(model: &Model, findings: &Findings) -> Vec<String> {
    if model.tilt.is_some() {
        return Vec::new();
    }
    // Damage near each other is one surface with one table.
    let deepest = |of: &Defect, side: Side| {
        Defects::beside(&model.defects, of, side).iter().map(Defect::deepest).fold(0.0, f64::max)
    };
    let words = |(k, defect): (usize, &Defect)| {
        let (side, table) = SIDES.into_iter().find_map(|side| Some((side, defect.table(side)?)))?;
        let (sunk, depth, last) = (findings.passes.extremes(k)?.sunk, deepest(defect, side), table.last_delta());
        let um = |x: f64| short(1e6 * x);
        is_beneath(sunk - FELT * last, depth).then(|| {
            format!(
                "sunk too deep: at defect {} contacts yielded by {} um more than healthy ones, and the damage is {} um deep: its table ends at a deformation \
                 of {} um and goes on straight, beneath the floor. Forces there are too small: the load at rest (operation.load_n), which tables are \
                 made for, is far below that of the motion",
                k + 1,
                um(sunk),
                um(depth),
                um(last),
            )
        })
    };
    model.defects.iter().enumerate().filter_map(words).collect()
}

/// Cages that push their soft stop far beyond their clearance, in words.
#[doc(hidden)]
pub fn strayed(scenario: &Scenario, findings: &Findings) -> Vec<String> {
    let (orbit, cage) = (&findings.cage_orbit, &scenario.cage);
    let words = |row: usize| {
        let (count, sum) = orbit.points(row).fold((0.0, 0.0), |(n, sum), (_, [x, y])| (n + 1.0, sum + x.hypot(y)));
        let distance = 1e3 * sum / count;
        (distance > STRAYED * cage.guide_clearance_mm).then(|| {
            format!(
                "cage beyond its clearance: the centre of the cage of row {} lay {distance:.3} mm from its land's in its last turns, on average, and \
                 cage.guide_clearance_mm is {:.3}: cage.land_stiffness_n_per_m, {:.1e} N/m, is too soft for its {:.2} kg, and BPFO and slip shift with \
                 it; steel on steel is 1e7, with a cage.land_damping_ns_per_m of 20 to 200, on which the cage strikes, and levels and kurtosis rise",
                row + 1,
                cage.guide_clearance_mm,
                cage.land_stiffness_n_per_m,
                cage.mass_kg,
            )
        })
    };
    (0..orbit.rows()).filter_map(words).collect()
}

/// What had not settled when statistics began, in words.
#[doc(hidden)]
pub fn unsettled(findings: &Findings) -> Vec<String> {
    let change = |x: f64| format!("{:.1} % {}", 100.0 * x.abs(), if x > 0.0 { "higher" } else { "lower" });
    let words = findings.drifts.iter().map(|drift| match drift {
        Drift::CageSlip(row, by) => format!(
            "not settled: the cage of row {} was {:.2} % of its pure-rolling speed {} in the first fifth of the analysed time than in its last half; \
             averages and their intervals hold part of the start: simulate longer",
            row + 1,
            100.0 * by.abs(),
            if *by > 0.0 { "slower" } else { "faster" },
        ),
        Drift::Level(channel, by) => format!(
            "not settled: the RMS of {channel} was {} in the first fifth of the analysed time than in its last half; averages and their intervals \
             hold part of the start: simulate longer",
            change(*by),
        ),
    });
    words.collect()
}

/// Speeds that differ by more within the statistics make an average of many machines.
const ONE_SPEED: f64 = 0.05;

/// That statistics are of a speed that changes, in words.
#[doc(hidden)]
pub fn of_changing_speed(scenario: &Scenario, simulation: &Simulation, findings: &Findings) -> Option<String> {
    let (rotation, from) = (&simulation.model().rotation, findings.from);
    let steps = 200;
    let at = |k: usize| from + (scenario.simulation.duration_s - from) * k as f64 / steps as f64;
    let speeds = (0..=steps).map(|k| rotation.at(at(k)).0.abs());
    let (low, high) = speeds.fold((f64::INFINITY, 0.0_f64), |(low, high), w| (low.min(w), high.max(w)));
    let rpm = |w: f64| (60.0 * w / std::f64::consts::TAU).round();
    (high > (1.0 + ONE_SPEED) * low).then(|| {
        format!(
            "the speed goes from {} to {} r/min in what is analysed: levels are averages over that, and intervals hold it beside scatter; for levels \
             of one speed run that speed",
            rpm(low),
            rpm(high)
        )
    })
}

/// What the energy audit says; `refined`: what it was left open by before the run was made again.
#[doc(hidden)]
pub fn of_energy(scenario: &Scenario, energy: &EnergyAudit, refined: Option<f64>) -> Vec<String> {
    let all = [parametric(scenario, energy), residual(scenario, energy, refined)];
    all.into_iter().flatten().collect()
}

/// An energy audit that does not close: the steps were too long for the motion.
fn residual(scenario: &Scenario, energy: &EnergyAudit, refined: Option<f64>) -> Option<String> {
    let percent = |share: f64| short(100.0 * share);
    let limit = 100.0 * RESIDUAL_SHARE;
    let left = energy.left_open();
    if let Some(first) = refined {
        let now = energy.relative_residual().map_or(0.0, f64::abs);
        let judged = if left.is_some() { "still more than" } else { "below" };
        return Some(format!(
            "refined: at simulation.accuracy = \"standard\" the energy balance error was {} %, so the run was made again at \"reference\"; \
             there it is {} %, {judged} the {limit} % of a run to rely on",
            percent(first),
            percent(now)
        ));
    }
    let remedy = match scenario.simulation.accuracy {
        Accuracy::Standard => "raise simulation.accuracy to \"reference\"",
        Accuracy::Reference => {
            "simulation.accuracy is \"reference\" already: look for damage that the roller falls into at once (contact.roller_path)"
        }
    };
    left.map(|share| {
        format!(
            "the energy balance error is {:.1} %, and {limit} % is the limit of a run to rely on: {remedy}",
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
        _ if scenario.simulation.laws == Laws::Mechanics => {
            " simulation.laws = \"mechanics\" with the keys that differ from it left out has no such error."
        }
        ModelKind::Full | ModelKind::Tilting => " simulation.laws = \"mechanics\" has no such error.",
        ModelKind::Lumped => "",
    };
    Some(format!(
        "parametric work: the energy error of the paper's contact law {done} the bearing {}, {share}; it is spurious: levels are unreliable, \
         frequencies are fine.{remedy}",
        joule(work.abs())
    ))
}
