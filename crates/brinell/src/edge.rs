//! An element that rolls over the edge of damage: where the force on it changes fastest.
//!
//! That is what a sensor hears of damage longer than the contact. The element does not strike at the edge: it is unloaded behind it, and loaded again before the next one. The
//! rings hold still meanwhile, and the edge is sharp: u behind it, the approach delta of both contacts of the element is less by u^2/(2 R), R being the relative radius along
//! the rolling direction. So the force is K (delta - u^2/(2 R))^n, which changes fastest at u = sqrt(2 R delta/(2 n - 1)) and is nought at sqrt(2 R delta). What an elastic
//! half-space (section 19) makes of the same edge is held against it in the tests.

use crate::defect::{Side, relative_radius};
use crate::error::Error;
use crate::model::Model;
use crate::scenario::{Bearing, Scenario, Surface};
use crate::statics::static_load_zone;
use std::f64::consts::PI;

/// An event is as short as this share of the way from the edge to it.
const SHORTEST: f64 = 0.35;

/// The contact that damage of a surface is met by; of an element's, the one that deforms more.
fn side_of(surface: Surface) -> Side {
    if surface == Surface::OuterRaceway { Side::Outer } else { Side::Inner }
}

/// Approach of both contacts of the heaviest loaded element, m, under the scenario's load, without damage.
fn approach(scenario: &Scenario) -> Result<f64, Error> {
    let mut healthy = scenario.clone();
    healthy.defects.clear();
    let model = Model::new(&healthy)?;
    let [inner, outer] = static_load_zone(&model)?.heaviest();
    Ok(model.deflection(Side::Inner, inner) + model.deflection(Side::Outer, outer))
}

/// How far behind the edge of damage of a surface the force on the heaviest loaded element changes fastest, m, under the scenario's load. The damage is deeper than the element
/// sinks there, and as wide as the contact.
///
/// # Errors
/// Where bearing and load make no model or no balance.
pub fn inset(scenario: &Scenario, surface: Surface) -> Result<f64, Error> {
    let radius = relative_radius(&scenario.bearing, side_of(surface));
    Ok((2.0 * radius * approach(scenario)? / (2.0 * scenario.contact.exponent - 1.0)).sqrt())
}

/// How short the events are, s, that elements of this [`inset`] (m) make which roll along the surface at `speed` m/s: what a search for them smooths over.
pub fn shortest_event(inset: f64, speed: f64) -> f64 {
    SHORTEST * inset / speed
}

/// How far along the damaged surface it is from one element to the next, m, the contacts being `angle` rad off the radial plane; of an element's, from one race to the other.
pub fn way_between_passes(b: &Bearing, angle: f64, surface: Surface) -> f64 {
    let [pitch, diameter] = [b.pitch_diameter_mm, b.roller_diameter_mm].map(|mm| 1e-3 * mm);
    let (across, count) = (diameter * angle.cos(), b.rollers_per_row as f64);
    match surface {
        Surface::OuterRaceway => PI * (pitch + across) / count,
        Surface::InnerRaceway => PI * (pitch - across) / count,
        Surface::Roller(_) => 0.5 * PI * diameter,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defect::SIDES;
    use crate::document;
    use crate::scenario::{Defect, Shape, Tables};

    /// A bearing by name under `share` of its static load rating.
    fn loaded(name: &str, share: f64) -> Scenario {
        let text = format!("[bearing]\npreset = \"{name}\"\n[operation]\nspeed_rpm = 1000\nload_n = [0, -1]\n");
        let mut scenario = document::read(&text, &[]).unwrap().scenario;
        scenario.operation.load_n = [0.0, -share * crate::bearing::rating::static_rating(&scenario.bearing).load];
        scenario
    }

    /// Force on an element over damage of its own length `6 u`, places u behind the edge, over that before: half-space tables, rings that hold still.
    fn half_space(scenario: &Scenario, surface: Surface, places: &[f64], reach: f64) -> Vec<f64> {
        let (mut scenario, side, approach) = (scenario.clone(), side_of(surface), approach(scenario).unwrap());
        let b = &scenario.bearing;
        let width_mm = if b.has_balls() { b.roller_diameter_mm } else { b.roller_length_mm };
        let shape = Shape::Rectangle { length_mm: 6e3 * reach, width_mm };
        scenario.contact.tables = Tables::Standard;
        scenario.defects = vec![Defect {
            on: surface,
            row: 1,
            center_deg: -90.0,
            depth_um: 500.0,
            axial_offset_mm: 0.0,
            shape,
            table: None,
        }];
        let model = Model::new(&scenario).unwrap();
        let table = model.defects[0].table(side).unwrap();
        let (own, other) = (model.contact(side), model.contact(SIDES[1 - side as usize]));
        let (edge, _) = model.defects[0].shape.arc();
        let force = |s: f64| {
            let on = |x: f64| {
                let of = table.at(x, s);
                own.healthy(of.delta.max(0.0)) * of.by_delta
            };
            let (mut low, mut high) = (0.0, approach);
            for _ in 0..60 {
                let x = 0.5 * (low + high);
                if on(x) < other.healthy(approach - x) { low = x } else { high = x }
            }
            on(low)
        };
        let before = force(edge - 3.0 * reach);
        places.iter().map(|u| force(edge + u) / before).collect()
    }

    #[test]
    fn analytic_elements_that_do_not_slip_roll_as_fast_along_every_surface() {
        for name in ["6205", "NU206"] {
            let scenario = loaded(name, 0.1);
            let kinematics = Model::new(&scenario).unwrap().kinematics(100.0);
            let speed = |on| way_between_passes(&scenario.bearing, 0.0, on) * kinematics.defect_frequency(on).1;
            let outer = speed(Surface::OuterRaceway);
            for other in [Surface::InnerRaceway, Surface::Roller(1)] {
                assert!((speed(other) / outer - 1.0).abs() < 1e-9, "{name} {other:?}: {} {outer}", speed(other));
            }
        }
    }

    #[test]
    fn xval_an_elastic_half_space_unloads_the_element_where_the_sharp_edge_does() {
        let [inner, outer] = [Surface::InnerRaceway, Surface::OuterRaceway];
        for (name, on, share) in
            [("6205", outer, 0.02), ("6208", inner, 0.2), ("NU206", outer, 0.2), ("N208", inner, 0.02)]
        {
            let scenario = loaded(name, share);
            let own = inset(&scenario, on).unwrap();
            let reach = own * (2.0 * scenario.contact.exponent - 1.0).sqrt();
            let [at_edge, at_own, at_reach, beyond] =
                half_space(&scenario, on, &[0.0, own, reach, 1.1 * reach], reach).try_into().unwrap();
            assert!(at_edge > 0.85, "{name} {on:?} {share}: {at_edge}");
            // Three quarters of a ball's force are gone there, and nine tenths of a roller's.
            assert!((0.05..0.3).contains(&at_own), "{name} {on:?} {share}: {at_own}");
            assert!(at_reach < 0.15 && beyond < 0.02, "{name} {on:?} {share}: {at_reach} {beyond}");
        }
    }
}
