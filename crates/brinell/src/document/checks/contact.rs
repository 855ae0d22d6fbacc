//! The contacts of rolling elements and raceways, and the elements' material.

use super::super::bearing_keys::steel_element_kg;
use super::super::contact_keys::stiffness;
use super::{Checker, short};
use crate::bearing::catalogue;
use crate::contact::is_line_exponent;
use crate::scenario::Law;

const ELEMENT: &str = "bearing.element";
const ROLLER: &str = "bearing.roller_diameter_mm";
/// Factor by which a stiffness may differ from that of the geometry: conformities and rims make it two or three, and the
/// unit of textbooks, N/mm^n, a thousand and more.
const STIFFNESS_FACTOR: f64 = 10.0;
/// The same of an element's mass and that of steel: silicon nitride has 0.41 of its density (3200 kg/m^3).
const MASS_FACTOR: f64 = 3.0;
/// Friction that no dry steel has: hard steel on hard steel slides at 0.42 and sticks at 0.78 (Marks' Standard Handbook
/// for Mechanical Engineers).
const MOST_FRICTION: f64 = 1.0;

impl Checker<'_> {
    /// What balls cannot have.
    fn balls(&mut self) {
        const LAW: &str = "contact.law";
        let entry = self.s.bearing.preset.as_deref().and_then(catalogue::find);
        if let Some(entry) = entry
            && entry.has_balls() != self.s.bearing.has_balls()
        {
            let word = if entry.has_balls() { "ball" } else { "roller" };
            self.error(
                ELEMENT,
                format!("{} is a {word} bearing", entry.name),
                format!("\"{word}\", or no preset"),
                &["bearing.preset"],
            );
        }
        let planar = self.s.simulation.model.moves_every_part();
        if self.s.bearing.has_balls() && planar && self.s.contact.law == Law::Ecl {
            self.error(
                LAW,
                "a ball's contact has no length that damage could take a share of".into(),
                "\"half-space\", or the key left out".into(),
                &[ELEMENT],
            );
        }
    }

    pub(super) fn contact(&mut self) {
        const EXPONENT: &str = "contact.exponent";
        self.balls();
        for stiffness in ["contact.inner_stiffness", "contact.outer_stiffness"] {
            if self.finder.is_preset(stiffness)
                && self.finder.place(EXPONENT).is_some()
                && !is_line_exponent(self.s.contact.exponent)
            {
                self.warn(
                    EXPONENT,
                    format!("the preset's {stiffness} is in N/m^(10/9) and is now read as N/m^n"),
                    String::new(),
                    &[stiffness],
                );
            }
        }
        self.stiffness();
        self.element_mass();
        self.friction();
    }

    /// Stiffnesses far from what the geometry gives: textbooks have N/mm^n.
    fn stiffness(&mut self) {
        let (b, c) = (&self.s.bearing, &self.s.contact);
        let keys = ["contact.inner_stiffness", "contact.outer_stiffness"];
        let given = [c.inner_stiffness, c.outer_stiffness];
        for ((key, given), of_geometry) in keys.into_iter().zip(given).zip(stiffness(b, c)) {
            let Some(expected) = of_geometry.value() else {
                continue;
            };
            let beyond = |x: f64| x > STIFFNESS_FACTOR * expected || x < expected / STIFFNESS_FACTOR;
            if !beyond(given) {
                continue;
            }
            let in_mm = if beyond(given * 1e3_f64.powf(c.exponent)) { "" } else { "; in N/mm^n instead of N/m^n?" };
            self.warn(
                key,
                format!(
                    "{} times the {expected:.3e} N/m^n that the geometry gives (n = {}){in_mm}",
                    short(given / expected),
                    short(c.exponent)
                ),
                format!("{:.1e} to {:.1e} N/m^n", expected / STIFFNESS_FACTOR, expected * STIFFNESS_FACTOR),
                &[],
            );
        }
    }

    /// A mass that no roller or ball of this size has.
    fn element_mass(&mut self) {
        const MASS: &str = "bearing.roller_mass_kg";
        let b = &self.s.bearing;
        let (given, steel) = (b.roller_mass_kg, steel_element_kg(b));
        let beyond = |x: f64| x > MASS_FACTOR * steel || x < steel / MASS_FACTOR;
        if beyond(given) {
            let in_grams = if beyond(1e-3 * given) { "" } else { "; in g instead of kg?" };
            self.warn(
                MASS,
                format!(
                    "{} times the {steel:.3e} kg of a steel {} of this size{in_grams}",
                    short(given / steel),
                    b.element.word()
                ),
                format!("{:.1e} to {:.1e}", steel / MASS_FACTOR, steel * MASS_FACTOR),
                &[ROLLER],
            );
        }
    }

    fn friction(&mut self) {
        if self.s.friction.raceway_coefficient > MOST_FRICTION {
            self.warn(
                "friction.raceway_coefficient",
                "more than dry steel on steel, 0.4 sliding and 0.8 at rest".into(),
                format!("0 to {}", short(MOST_FRICTION)),
                &[],
            );
        }
    }
}
