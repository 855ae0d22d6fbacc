//! Hertz's pressure of a roller's line contact and of a ball's ellipse.
//!
//! It is for reading, not for motion: the contact law of [`crate::contact`] knows forces and deformations alone. SI.

use crate::contact::{ball, remaining_share};
use crate::defect::{SIDES, relative_radius};
use crate::model::Model;
use crate::scenario::{Bearing, Contact, Element, Scenario};
use crate::steel;
use std::f64::consts::PI;

/// Largest contact pressure under the static load rating of roller bearings, Pa (ISO 76): there the roller and the
/// raceway together keep a permanent deformation of about 1/10000 of the roller's diameter.
pub const STATIC_LIMIT: f64 = 4.0e9;
/// The same of radial ball bearings.
const STATIC_LIMIT_OF_BALLS: f64 = 4.2e9;

/// Largest contact pressure under the static load rating, Pa (ISO 76).
pub fn static_limit(bearing: &Bearing) -> f64 {
    match bearing.element {
        Element::Roller => STATIC_LIMIT,
        Element::Ball => STATIC_LIMIT_OF_BALLS,
    }
}

/// Largest pressure of a smooth contact at which bearing steel begins to yield, below its surface, Pa (Johnson, Contact Mechanics, 4.2,
/// 6.1): 1.6 Y in a circle, which is taken for a ball's ellipse, and about 1.8 Y in a line.
pub fn yields_at(bearing: &Bearing) -> f64 {
    match bearing.element {
        Element::Roller => 1.8 * steel::YIELD,
        Element::Ball => 1.6 * steel::YIELD,
    }
}

/// Largest pressure of a line contact of two bodies alike, Pa: Hertz's p = sqrt(E* w / (pi R)) with the line load w = Q/L and E* = E / (2 (1 - nu^2)), of
/// `contact` where it has a material, else of steel. `force` is Q (N), `length` is L (m), `radius` is R with 1/R = 1/r +- 1/R_raceway (m).
///
/// With steel's E = 206 GPa and nu = 0.3 this is Harris's 190 sqrt(Q Sigma-rho / L) N/mm^2, in N and mm (Rolling Bearing
/// Analysis, chapter on contact stress). The pressure is even along L: it knows neither edge stress nor crowning nor
/// tilt. It is elastic, so a value far above [`STATIC_LIMIT`] says that the steel yields, not how hard it is pressed.
pub(crate) fn line_pressure(contact: &Contact, force: f64, length: f64, radius: f64) -> f64 {
    let modulus = 0.5 * contact.modulus().unwrap_or(steel::MODULUS);
    (modulus * force.max(0.0) / length / (PI * radius)).sqrt()
}

/// Largest pressure under `forces` (N) at the inner and at the outer raceway of the undamaged bearing, Pa.
pub fn pressures(scenario: &Scenario, forces: [f64; 2]) -> [f64; 2] {
    let bearing = &scenario.bearing;
    if let Some(ellipses) = ball::ellipses(bearing, &scenario.contact) {
        return SIDES.map(|side| ellipses[side as usize].pressure(forces[side as usize]));
    }
    SIDES.map(|side| {
        let length = 1e-3 * bearing.roller_length_mm;
        line_pressure(&scenario.contact, forces[side as usize], length, relative_radius(bearing, side))
    })
}

/// Pressure on what a defect leaves of a contact at its widest place, under `forces` (N) on the inner and the outer
/// contact: the length left (m) and the pressure (Pa), the larger one of the sides that it meets. `None` where nothing is left, or where
/// the roller is pressed down to the damage's floor, which then carries its share.
pub fn pressure_beside(model: &Model, scenario: &Scenario, defect: usize, forces: [f64; 2]) -> Option<(f64, f64)> {
    // Under a ball there is no length beside the damage that an even pressure would stand for.
    let (bearing, contact) = (&scenario.bearing, &scenario.contact);
    if bearing.has_balls() {
        return None;
    }
    let defect = &model.defects[defect];
    let (first, last) = defect.shape.arc();
    // The widest place on a grid finer than any outline is drawn.
    const PLACES: u32 = 400;
    let widest = (0..=PLACES)
        .map(|k| first + (last - first) * f64::from(k) / f64::from(PLACES))
        .max_by(|a, b| defect.damaged_length(*a).total_cmp(&defect.damaged_length(*b)))?;
    let left = defect.roller_length - defect.damaged_length(widest);
    if left <= 1e-9 * defect.roller_length {
        return None;
    }
    let share = remaining_share(defect.roller_length, defect.roller_length - left);
    SIDES
        .into_iter()
        .filter(|side| defect.meets_side(*side))
        .map(|side| {
            let force = forces[side as usize];
            let sunk = model.contact(side).deflection(force / share);
            let pressure = line_pressure(contact, force, left, relative_radius(bearing, side));
            (sunk <= defect.depth_at(widest)).then_some((left, pressure))
        })
        .collect::<Option<Vec<_>>>()?
        .into_iter()
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::rating::static_rating;
    use crate::document::read;

    fn preset(name: &str) -> Scenario {
        let text = format!("[bearing]\npreset = \"{name}\"\n[operation]\nspeed_rpm = 1500\nload_n = [1000, 0]\n");
        read(&text, &[]).unwrap().scenario
    }

    #[test]
    fn lit_pressure_of_harris() {
        // Harris: half width b = 3.35e-3 sqrt(Q/(L Sigma-rho)) mm and pressure 2 Q/(pi L b), for steel; 3.35e-3 has
        // three figures.
        let (force, length, r, raceway) = (1000.0_f64, 8.8e-3, 4.5e-3, 18.75e-3);
        let curvature = 1.0 / r + 1.0 / raceway;
        let half_width = 3.35e-3 * (force / (8.8 * 1e-3 * curvature)).sqrt();
        let harris = 2.0 * force / (PI * 8.8 * half_width);
        let ours = 1e-6 * line_pressure(&Scenario::example().contact, force, length, 1.0 / curvature);
        assert!((ours / harris - 1.0).abs() < 2e-3, "{ours} against {harris}");
    }

    #[test]
    fn lit_iso_76_load_gives_iso_76_pressure() {
        // ISO 76: C0 is the load whose heaviest roller, 5 C0/(i Z) with a small clearance, is pressed with 4000 MPa at
        // the inner raceway.
        for name in ["NU204", "NU205", "NU2205", "NU206"] {
            let s = preset(name);
            let b = &s.bearing;
            let rating = static_rating(b);
            let source = rating.source.expect("the catalogue has it");
            assert!(source.contains("SKF"), "{source}");
            let heaviest = 5.0 * rating.load / (b.rows * b.rollers_per_row) as f64;
            let inner = pressures(&s, [heaviest; 2])[0];
            assert!((inner / STATIC_LIMIT - 1.0).abs() < 0.02, "{name}: {inner}");
        }
    }
}
