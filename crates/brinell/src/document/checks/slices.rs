//! Slices, profiles and what tilts.

use super::{Checker, short};
use crate::scenario::{Law, ModelKind, RollerProfile};
use crate::slices::{borders, drop};

const PROFILE: &str = "bearing.profile";
const LAW: &str = "contact.law";
const SLICES: &str = "contact.slices";
const MODEL: &str = "simulation.model";
/// Drop of the whole roller, in diameters, beyond which it never touches: a slip of the unit.
const LARGEST_DROP: f64 = 0.01;

impl Checker<'_> {
    pub(super) fn slices(&mut self) {
        let s = self.s;
        let tilts = s.simulation.model == ModelKind::Tilting;
        let has_profile = s.bearing.profile != RollerProfile::Straight;
        let is_ecl = s.contact.law == Law::Ecl;
        if tilts && s.bearing.has_balls() {
            self.error(
                MODEL,
                "a ball has no ends that could tilt".into(),
                "\"full\" or \"lumped\" where bearing.element = \"ball\"".into(),
                &["bearing.element"],
            );
        } else if tilts && is_ecl {
            self.error(
                LAW,
                "a contact that tilts needs slices: \"ecl\" knows one deformation for the whole roller".into(),
                "\"half-space\" where simulation.model = \"tilting\"".into(),
                &[MODEL],
            );
        } else if has_profile && s.simulation.model == ModelKind::Lumped {
            self.error(
                PROFILE,
                "the lumped model has no slices, and so no profile".into(),
                "\"straight\" where simulation.model = \"lumped\"".into(),
                &[MODEL],
            );
        } else if has_profile && is_ecl {
            self.error(
                PROFILE,
                "a profile needs slices: \"ecl\" knows one deformation for the whole roller".into(),
                "\"straight\", or contact.law = \"half-space\"".into(),
                &[LAW],
            );
        }
        if tilts && s.contact.slices == 1 {
            self.error(
                SLICES,
                "one slice in the middle leaves the roller free to tilt".into(),
                "2 to 10000 where simulation.model = \"tilting\", better even".into(),
                &[MODEL],
            );
        }
        if has_profile {
            self.drops();
        }
    }

    /// A profile with a drop everywhere is a mistake, or a clearance.
    fn drops(&mut self) {
        let b = &self.s.bearing;
        let (length, diameter) = (1e-3 * b.roller_length_mm, 1e-3 * b.roller_diameter_mm);
        let count = self.s.contact.slices;
        // Said of them.
        if !(1..=10_000).contains(&count) {
            return;
        }
        let least = (0..count)
            .map(|k| {
                let [low, high] = borders(k, count, length);
                drop(&b.profile, 0.5 * (low + high), length, diameter)
            })
            .fold(f64::INFINITY, f64::min);
        let most = 1e6 * LARGEST_DROP * diameter;
        if 1e6 * least > most {
            self.error(
                PROFILE,
                format!(
                    "no slice ever touches: the profile has a drop of {} um or more everywhere",
                    short(1e6 * least)
                ),
                format!("a least drop of 0 to {} um", short(most)),
                &[SLICES],
            );
        } else if 1e6 * least > 1.0 && matches!(b.profile, RollerProfile::Table { .. }) {
            self.warn(
                PROFILE,
                format!(
                    "the profile has a drop of {} um or more everywhere, which acts as a clearance of that size at each contact",
                    short(1e6 * least)
                ),
                "a least drop of 0".into(),
                &[],
            );
        }
    }
}
