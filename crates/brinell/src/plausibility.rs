//! What an engineer would ask about a scenario that can run: whether the damage is loaded, the steel bears the load,
//! the run is long enough.
//!
//! These are warnings, not errors. [`before`] needs the model and its static balance, and takes milliseconds; `brinell
//! check`, `run`, `sweep`, `compare` and `dataset` say it, and `summary.json` holds it. [`after`] is of a run that is over.
//! What a scenario file alone can say is in [`crate::document`].

mod after;
mod damage;
mod machine;
mod table;
mod tilting;
mod warning;

use crate::analysis::STANDARD_GRAVITY;
use crate::bearing::rating::static_rating;
use crate::channel;
use crate::defect::{SIDES, Side};
use crate::document::{Problem, Problems, toml_float};
use crate::lamina::Rating;
use crate::model::Model;
use crate::operation::Rotation;
use crate::pressure::{pressures, static_limit};
use crate::scenario::{Choice, GeometryLaw, LoadOn, Scenario, Speed};
use crate::simulate::Simulation;
use crate::statics::{NoBalance, StaticLoadZone, static_load_zone};
pub use after::{after, converted, doubtful, of_changing_speed, of_energy, strayed, unsettled};
pub use machine::{carried, observed};
use std::f64::consts::TAU;
use warning::{NO_LOAD, WEIGHT_SHARE, short, warning};

/// Share of the load beyond which what a support carries is worth a warning.
const SUPPORT_SHARE: f64 = 0.1;
/// Share of the pitch radius by which the bearing may sink as a whole: up to so much off do the cage's and the outer race's
/// frequencies come out, more than a cage slips or runs ahead by its play.
const SUNK_SHARE: f64 = 0.01;
/// Half-width of a groove with shoulders of a fifth of the ball's diameter, over the ball's radius.
const GROOVE: f64 = 0.8;

const LOAD: &str = "operation.load_n";

/// What is known of a scenario before anything moves; found once, because solving for a static balance takes
/// milliseconds.
#[derive(Debug)]
pub struct Beforehand {
    /// The static load distribution.
    pub statics: Result<StaticLoadZone, NoBalance>,
    /// Warnings of the scenario.
    pub warnings: Vec<Problem>,
}

impl Beforehand {
    /// Of a scenario and its model.
    pub fn of(scenario: &Scenario, model: &Model) -> Self {
        let statics = static_load_zone(model);
        Beforehand { warnings: before(scenario, model, &statics), statics }
    }

    /// Of a simulation; of a machine's: the bearing that is observed under what it carries, with the warnings of all.
    pub fn of_run(scenario: &Scenario, simulation: &Simulation) -> Self {
        let Some(of) = &scenario.machine else { return Self::of(scenario, simulation.model()) };
        let machine = simulation.machine();
        match machine.balance() {
            Ok(balance) => {
                let mut each: Vec<Self> =
                    carried(scenario, machine, &balance).iter().map(|(alone, model)| Self::of(alone, model)).collect();
                let mut warnings = machine::warnings(scenario, simulation);
                for (k, one) in each.iter().enumerate() {
                    warnings.extend(machine::of_bearing(k, !of.shaft.unbalance.is_empty(), &one.warnings));
                }
                Self { statics: each.swap_remove(of.lead).statics, warnings: few_of_a_kind(warnings) }
            }
            Err(error) => {
                let mut warnings = machine::warnings(scenario, simulation);
                warnings.push(Problem::warning("shaft", error.to_string()));
                Self { statics: Err(error), warnings }
            }
        }
    }
}

/// Warnings of a scenario that makes a model; `statics` is its static load zone.
pub fn before(scenario: &Scenario, model: &Model, statics: &Result<StaticLoadZone, NoBalance>) -> Vec<Problem> {
    let mut warnings = Vec::new();
    warnings.extend(no_load(scenario, model));
    warnings.extend(sensor_at_rest(scenario, model));
    warnings.extend(weight_left_out(scenario, model));
    match statics {
        Ok(zone) => {
            warnings.extend(overload(scenario, zone));
            warnings.extend(carried_by_support(scenario, model, zone));
            warnings.extend(sunk(scenario, model, zone));
            warnings.extend(wide_ellipses(scenario, model, zone));
            warnings.extend(displaced(scenario, zone));
            warnings.extend(table::warnings(scenario, model, zone));
        }
        Err(error) => warnings.push(warning(LOAD, list(scenario.operation.load_n), error.to_string(), "")),
    }
    warnings.extend(damage::warnings(scenario, model, statics.as_ref().ok()));
    warnings.extend(tilting::warnings(scenario, model));
    warnings.extend(too_short(scenario, model));
    warnings.extend(idle_patterns(scenario, model));
    few_of_a_kind(warnings)
}

/// The first of each kind: thousands of defects can lie outside the load zone.
fn few_of_a_kind(warnings: Vec<Problem>) -> Vec<Problem> {
    let mut few = Problems::of("");
    warnings.into_iter().for_each(|w| few.add(w, None));
    few.finish()
}

fn list([x, y]: [f64; 2]) -> String {
    format!("[{}, {}]", toml_float(x), toml_float(y))
}

/// Weight of the bearing, N: of its rings, cages and elements. What its housing weighs rests on the machine.
fn weight(scenario: &Scenario, model: &Model) -> f64 {
    let (m, l) = (&model.inertia, &model.layout);
    let outer_ring = m.outer_ring - scenario.housing.mass_kg;
    let mass = m.inner_ring + outer_ring + m.cage * l.rows as f64 + m.roller * l.rollers() as f64;
    STANDARD_GRAVITY * mass
}

fn no_load(scenario: &Scenario, model: &Model) -> Option<Problem> {
    let o = &scenario.operation;
    if o.load_n != [0.0; 2] || o.gravity_m_per_s2 != [0.0; 2] {
        return None;
    }
    let speed = model.rolling_orbit_speed(model.rotation.max_speed());
    let force = model.inertia.roller * model.geometry.pitch_radius * speed.powi(2);
    Some(warning(
        LOAD,
        list(o.load_n),
        format!(
            "{NO_LOAD}: the centrifugal force of {} N a {} is all that presses the contacts",
            short(force),
            scenario.bearing.element.word()
        ),
        "a load, or operation.gravity_m_per_s2",
    ))
}

fn weight_left_out(scenario: &Scenario, model: &Model) -> Option<Problem> {
    let o = &scenario.operation;
    let (load, weight) = (o.load_n[0].hypot(o.load_n[1]), weight(scenario, model));
    let counts = o.gravity_m_per_s2 == [0.0; 2] && load > 0.0 && weight > WEIGHT_SHARE * load;
    counts.then(|| {
        warning(
            "operation.gravity_m_per_s2",
            list(o.gravity_m_per_s2),
            format!(
                "the bearing weighs {} N, {:.0} % of the load of {} N, and gravity is left out",
                short(weight),
                100.0 * weight / load,
                short(load)
            ),
            "[0.0, -9.81] m/s^2 for a horizontal shaft",
        )
    })
}

/// The lumped model has the outer ring fixed where the load is on the inner one.
fn sensor_at_rest(scenario: &Scenario, model: &Model) -> Option<Problem> {
    model.outer_ring_is_fixed().then(|| {
        warning(
            "simulation.model",
            format!("\"{}\"", scenario.simulation.model.word()),
            "the lumped model holds the outer ring where the load is on the inner one: its acceleration is 0, and a sensor has its own noise alone".into(),
            "\"full\", or operation.load_on = \"outer-ring\"",
        )
    })
}

/// A support that carries a part of the load that counts, which the bearing then does not.
fn carried_by_support(scenario: &Scenario, model: &Model, zone: &StaticLoadZone) -> Option<Problem> {
    let key = match scenario.operation.load_on {
        LoadOn::OuterRing => "support.outer_stiffness_n_per_m",
        LoadOn::InnerRing => "support.inner_stiffness_n_per_m",
    };
    let (stiffness, load) = (model.loaded_support().stiffness, model.force_on_loaded_ring());
    let share = zone.support / load;
    // Where it can carry all of it, the document's own warning says so.
    let all = stiffness * model.geometry.clearance >= load;
    (share > SUPPORT_SHARE && !all).then(|| {
        warning(
            key,
            toml_float(stiffness),
            format!(
                "at rest the support carries {} N of the {} N on its ring{}, and the bearing {} N",
                short(zone.support),
                short(load),
                if model.gravity == [0.0; 2] { "" } else { ", weight included" },
                short(load - zone.support)
            ),
            // A softer one lets the ring move a little farther.
            format!("about {:.0e} or less", 0.7 * stiffness * SUPPORT_SHARE / share),
        )
    })
}

/// Supports so soft that the bearing as a whole sinks, which the levers of the centred bearing take for a smaller bearing.
fn sunk(scenario: &Scenario, model: &Model, zone: &StaticLoadZone) -> Option<Problem> {
    let share = zone.sunk.abs() / model.geometry.pitch_radius;
    // That of the ring without the load holds the bearing.
    let (key, stiffness) = match scenario.operation.load_on {
        LoadOn::InnerRing => ("support.outer_stiffness_n_per_m", scenario.support.outer_stiffness_n_per_m),
        LoadOn::OuterRing => ("support.inner_stiffness_n_per_m", scenario.support.inner_stiffness_n_per_m),
    };
    // The orbits of the lumped model are prescribed; exact levers are those of where the rings are.
    let centred = scenario.simulation.geometry == GeometryLaw::Centred;
    (share > SUNK_SHARE && centred && scenario.simulation.model.moves_every_part()).then(|| {
        warning(
            key,
            toml_float(stiffness),
            format!(
                "the bearing as a whole sinks by {} um, {} % of the pitch radius: as levers are those of the centred bearing, FTF and BPFO come out \
                 up to as much {}",
                short(1e6 * zone.sunk.abs()),
                short(100.0 * share),
                if zone.sunk > 0.0 { "higher" } else { "lower" }
            ),
            // In proportion; twice as stiff as the limit asks.
            format!("about {:.0e} or more", 2.0 * stiffness * share / SUNK_SHARE),
        )
    })
}

/// Rings displaced by more than an element's diameter: contacts deform by thousandths of it.
fn displaced(scenario: &Scenario, zone: &StaticLoadZone) -> Option<Problem> {
    let (b, c) = (&scenario.bearing, &scenario.contact);
    let displacement = zone.shift[0].hypot(zone.shift[1]);
    let (key, stiffness) = match c.inner_stiffness <= c.outer_stiffness {
        true => ("contact.inner_stiffness", c.inner_stiffness),
        false => ("contact.outer_stiffness", c.outer_stiffness),
    };
    (displacement > 1e-3 * b.roller_diameter_mm).then(|| {
        warning(
            key,
            toml_float(stiffness),
            format!(
                "at rest the load displaces the inner ring by {} mm in the outer one, more than the {}'s diameter of {} mm: contacts are far too soft \
                 for this load",
                short(1e3 * displacement),
                b.element.word(),
                short(b.roller_diameter_mm)
            ),
            "",
        )
    })
}

/// Beyond the static load rating, or beyond the pressure that it represents.
fn overload(scenario: &Scenario, zone: &StaticLoadZone) -> Vec<Problem> {
    let o = &scenario.operation;
    let mut warnings = Vec::new();
    let load = o.load_n[0].hypot(o.load_n[1]);
    let rating = static_rating(&scenario.bearing);
    let source = rating.source.unwrap_or("estimated by the formula of ISO 76");
    if load > rating.load {
        warnings.push(warning(
            LOAD,
            list(o.load_n),
            format!(
                "the load of {} kN exceeds the static load rating C0 = {} kN ({source})",
                short(1e-3 * load),
                short(1e-3 * rating.load)
            ),
            format!("a load of up to {}", short(rating.load)),
        ));
    }
    let (side, highest) = highest_pressure(scenario, zone);
    let ring = side.word();
    let limit = static_limit(&scenario.bearing);
    let element = scenario.bearing.element.word();
    if highest > limit {
        warnings.push(warning(
            LOAD,
            list(o.load_n),
            format!(
                "the contact pressure reaches {:.0} MPa at the {ring} raceway under the heaviest {element}'s {} kN, beyond the static limit of {:.0} MPa \
                 (ISO 76): raceways and {element}s would keep dents, and the model is elastic",
                1e-6 * highest,
                short(1e-3 * zone.heaviest()[side as usize]),
                1e-6 * limit
            ),
            "",
        ));
    }
    warnings
}

/// Ellipses of balls that reach beyond any groove's shoulders.
fn wide_ellipses(scenario: &Scenario, model: &Model, zone: &StaticLoadZone) -> Vec<Problem> {
    let edge = GROOVE * model.geometry.roller_radius;
    let wide = |side: Side| {
        let half = 0.5 * model.contact(side).axis_across(model.deflection(side, zone.healthy_largest))?;
        let value = match side {
            Side::Inner => scenario.bearing.inner_groove_conformity,
            Side::Outer => scenario.bearing.outer_groove_conformity,
        }?;
        (half > edge).then(|| {
            warning(
                &format!("bearing.{}_groove_conformity", side.word()),
                toml_float(value),
                format!(
                    "under the heaviest ball the contact reaches {} mm to each side, and a groove with shoulders of a fifth of the ball's diameter \
                     ends at {} mm: no such bearing carries this load so",
                    short(1e3 * half),
                    short(1e3 * edge)
                ),
                "a larger one (0.515 to 0.53 is usual), or a smaller operation.load_n",
            )
        })
    };
    SIDES.into_iter().filter_map(wide).collect()
}

/// Largest pressure of the healthy bearing, Pa, and its raceway: of even contacts, but slice by slice where a profile
/// or a tilt makes them uneven.
fn highest_pressure(scenario: &Scenario, zone: &StaticLoadZone) -> (Side, f64) {
    let peak = (!scenario.has_even_contacts()).then(|| Rating::unchecked(scenario).ok()??.distribution.peak());
    if let Some(peak) = peak.flatten() {
        return (peak.side, peak.pressure);
    }
    let [inner, outer] = pressures(scenario, zone.heaviest());
    match inner >= outer {
        true => (Side::Inner, inner),
        false => (Side::Outer, outer),
    }
}

/// A run that ends before every roller has passed the load zone once after the start.
fn too_short(scenario: &Scenario, model: &Model) -> Option<Problem> {
    let (duration, ramp) = (scenario.simulation.duration_s, model.load.ramp);
    // A turn of the shaft before the statistics begin, and then one of the cage; in turns of the shaft.
    let cage = 1.0 / model.kinematics(TAU).ftf;
    let needed = 1.0 + cage;
    let rotation = Rotation::new(&scenario.operation.speed_rpm);
    let turns = |t: f64| rotation.turned(t) / TAU;
    let turned = if duration > ramp { turns(duration) - turns(ramp) } else { 0.0 };
    if turned >= needed {
        return None;
    }
    let allowed = match &scenario.operation.speed_rpm {
        Speed::Constant(rpm) => format!(">= {}", short(1.005 * (ramp + needed * 60.0 / rpm.abs()))),
        Speed::Profile(_) => String::new(),
    };
    let ramp = if ramp > 0.0 { format!("the load's ramp of {} s, ", short(ramp)) } else { String::new() };
    Some(warning(
        "simulation.duration_s",
        toml_float(duration),
        format!(
            "too short to settle: {ramp}a turn of the shaft and a turn of the cage ({} of the shaft) are the least before every roller has passed \
             the load zone once; statistics of this run are those of its start",
            short(cage)
        ),
        allowed,
    ))
}

/// Patterns of `record` that pick no channel.
fn idle_patterns(scenario: &Scenario, model: &Model) -> Vec<Problem> {
    let (_, idle) = channel::select(model, &scenario.sensor, &scenario.simulation.record);
    let of = |pattern: &String| {
        // In the message: problems of one key and message are told once.
        let message = format!("\"{pattern}\" matches no channel of this bearing");
        let allowed = "names of channels, such as \"sensor_ax\"; * stands for any characters";
        Problem::warning("simulation.record", message).allowed(allowed)
    };
    idle.iter().map(of).collect()
}
