//! Whether damage is met by loaded rollers and by a ball's ellipse, and what a point contact or the lumped model makes
//! of it.

use super::warning::{short, warning};
use crate::defect::{Defect, SIDES, Side, relative_radius, wrap};
use crate::document::{Problem, toml_float};
use crate::model::Model;
use crate::scenario::{Law, ModelKind, RollerPath, Scenario, Shape};
use crate::statics::StaticLoadZone;

/// Share of a defect's depth that a roller must reach: the deepest point of a rough floor is nobody's.
const REACHED_SHARE: f64 = 0.9;
/// Static deformations of the heaviest contact: deeper damage over a roller's whole width takes all load off it where
/// it begins.
const DROP: f64 = 10.0;
/// Depth of damage that roughness hides, m: ground raceways have Ra of some 0.05 to 0.2 um.
const ROUGHNESS: f64 = 0.05e-6;

pub(super) fn warnings(scenario: &Scenario, model: &Model, zone: Option<&StaticLoadZone>) -> Vec<Problem> {
    let mut all = hardly_any(scenario, model);
    if let Some(zone) = zone {
        all.extend(outside_the_load_zone(scenario, model, zone));
        all.extend(beside_the_ellipse(scenario, model, zone));
    }
    all.extend(felt_by_a_point(scenario, model, zone.map(|zone| zone.deformation(model))));
    all
}

/// Damage of less depth than a raceway is rough, which the model leaves out.
fn hardly_any(scenario: &Scenario, model: &Model) -> Vec<Problem> {
    let of_key = |(k, defect): (usize, &Defect)| {
        let largest = defect.deepest().max(defect.shape.raised());
        (largest < ROUGHNESS).then(|| {
            // Depths of a map are in its shape.
            let (key, value) = match &scenario.defects[k].shape {
                Shape::DepthMap { .. } => (format!("defects.{k}.shape.depth_map.depth_um"), "the map's".into()),
                _ => (format!("defects.{k}.depth_um"), toml_float(scenario.defects[k].depth_um)),
            };
            warning(
                &key,
                value,
                match largest > 0.0 {
                    true => format!(
                        "this damage is {} um deep at most: a machine's raceways are rougher and would hide it, these have no roughness and may show it",
                        short(1e6 * largest)
                    ),
                    false => "this damage has no depth: the bearing runs as a healthy one".into(),
                },
                format!(">= {}", short(1e6 * ROUGHNESS)),
            )
        })
    };
    model.defects.iter().enumerate().filter_map(of_key).collect()
}

/// Damage on the outer raceway that no loaded roller meets. Damage on the inner raceway and on rollers turns into the
/// load zone.
fn outside_the_load_zone(scenario: &Scenario, model: &Model, zone: &StaticLoadZone) -> Vec<Problem> {
    let element = scenario.bearing.element.word();
    let mut warnings = Vec::new();
    for (k, _) in model.defects.iter().enumerate().filter(|(_, defect)| !zone.reaches(model, defect)) {
        let degrees = |x: f64| wrap(x).to_degrees();
        let (words, allowed) = if zone.extent > 0.0 {
            let [from, to] = zone.arc().map(degrees);
            (
                format!(
                    "this damage is outside the load zone, which is {:.0} deg wide around {:.0} deg: no load presses {element}s onto it, and only impacts \
                     of unloaded {element}s remain, which centrifugal force and weight take into it",
                    zone.extent.to_degrees(),
                    // Not -0.
                    degrees(zone.middle).round() + 0.0
                ),
                format!("{from:.0} to {to:.0}, counter-clockwise"),
            )
        } else {
            (
                format!("no {element} is loaded at rest: there is no load zone that this damage could be in"),
                String::new(),
            )
        };
        warnings.push(warning(
            &format!("defects.{k}.center_deg"),
            toml_float(scenario.defects[k].center_deg),
            words,
            allowed,
        ));
    }
    warnings
}

/// Damage under balls against the heaviest contact's ellipse of the healthy bearing: none of it within, or, in the lumped
/// model, which knows the depth at z = 0 alone, not all of the ellipse on it.
fn beside_the_ellipse(scenario: &Scenario, model: &Model, zone: &StaticLoadZone) -> Vec<Problem> {
    let mut warnings = Vec::new();
    for (k, defect) in model.defects.iter().enumerate() {
        let half_length = |side: Side, raised: f64| {
            let delta = model.deflection(side, zone.healthy_largest);
            Some(0.5 * model.contact(side).axis_across(delta + raised)?)
        };
        let met = || SIDES.into_iter().filter(|side| defect.meets_side(*side));
        let longest = |raised: f64| met().filter_map(|side| half_length(side, raised)).reduce(f64::max);
        // Raised damage is touched where nothing is pressed elsewhere.
        let (Some(half), Some(touched)) = (longest(0.0), longest(defect.shape.raised())) else {
            continue;
        };
        let [low, high] = defect.heights();
        let lies = format!("lies at z = {} to {} mm", short(1e3 * low), short(1e3 * high));
        let ellipse =
            format!("the ellipse of the heaviest contact at rest reaches from -{0} to {0} mm", short(1e3 * half));
        let offset = (format!("defects.{k}.axial_offset_mm"), toml_float(scenario.defects[k].axial_offset_mm));
        let ((key, value), words, allowed) = if low > touched || high < -touched {
            (
                offset,
                format!("this damage {lies}, and {ellipse}: nothing touches it"),
                format!("damage that reaches into z from -{0} to {0}", short(1e3 * touched)),
            )
        } else if scenario.simulation.model == ModelKind::Lumped && (low > -half || high < half) {
            let felt = if low > 0.0 || high < 0.0 {
                ", which is 0: this damage does not act"
            } else {
                ": the ball sinks by it as a whole even where the contact beside the damage carries it, and impacts come out far too strong"
            };
            (
                ("simulation.model".into(), "\"lumped\"".into()),
                format!("defect {} {lies}, and {ellipse}; the lumped model uses only the depth at z = 0{felt}", k + 1),
                "\"full\"".into(),
            )
        } else {
            continue;
        };
        warnings.push(warning(&key, value, words, allowed));
    }
    warnings
}

/// What `roller_path = "point"` makes of damage: a floor that the roller's radius keeps it from is felt all the same;
/// and where the damage is as wide as the roller, it drops by the whole depth at once. `deformation` is that of the
/// heaviest contact, m.
fn felt_by_a_point(scenario: &Scenario, model: &Model, deformation: Option<f64>) -> Vec<Problem> {
    // In a half-space the element's radius is.
    if scenario.contact.law == Law::HalfSpace || scenario.contact.roller_path != RollerPath::Point {
        return Vec::new();
    }
    let element = scenario.bearing.element.word();
    let mut warnings = Vec::new();
    for (k, defect) in model.defects.iter().enumerate() {
        let met = SIDES.into_iter().filter(|s| defect.meets_side(*s));
        let worst = met
            .map(|side| (side, defect.reach(relative_radius(&scenario.bearing, side))))
            .min_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let Some((side, (deep, reached))) = worst else {
            continue;
        };
        let ring = side.word();
        let words = if reached < REACHED_SHARE * deep {
            format!(
                "defect {} is {} um deep, and the {element}'s radius lets it sink {} um into it at the {ring} raceway; a \"point\" feels the \
                 floor all the same",
                k + 1,
                short(1e6 * deep),
                short(1e6 * reached)
            )
        } else if let (Some(deformation), drop) = (deformation, drop_at_once(defect))
            && drop > DROP * deformation
        {
            format!(
                "defect {} is as wide as the {element} and {} um deep, {:.0} times the elastic deformation of the most loaded contact at rest: at a \"point\" the \
                 {element} drops by the whole depth at once, which makes impacts many times as strong as along the envelope",
                k + 1,
                short(1e6 * drop),
                drop / deformation
            )
        } else {
            continue;
        };
        warnings.push(warning("contact.roller_path", "\"point\"".into(), words, "\"envelope\""));
    }
    warnings
}

/// Depth at the ends of damage that is as wide as the roller there, m.
fn drop_at_once(defect: &Defect) -> f64 {
    let (first, last) = defect.shape.arc();
    let ends = [first, last].into_iter();
    ends.filter(|s| defect.damaged_length(*s) >= defect.roller_length).map(|s| defect.depth_at(s)).fold(0.0, f64::max)
}
