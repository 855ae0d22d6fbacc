//! Geometry of bearing and cage.

use std::f64::consts::PI;

use super::{Checker, short};
use crate::analysis::most_elements;
use crate::bearing::clearance::{ClearanceClass, bore_diameter_mm, largest_bore_mm};
use crate::scenario::Walls;

/// Share of a roller's diameter by which rounded catalogue diameters may miss each other.
const GEOMETRY_TOLERANCE: f64 = 0.02;
/// Clearances by which they may miss, where that is more: they may be stated with the clearance in or out.
const CLEARANCES: f64 = 3.0;
/// Share of a roller's diameter beyond which a clearance or preload is a slip of the unit.
const LARGEST_CLEARANCE: f64 = 0.05;

const INNER: &str = "bearing.inner_raceway_diameter_mm";
const OUTER: &str = "bearing.outer_raceway_diameter_mm";
const PITCH: &str = "bearing.pitch_diameter_mm";
const ROLLER: &str = "bearing.roller_diameter_mm";
const COUNT: &str = "bearing.rollers_per_row";
const CLEARANCE: &str = "bearing.radial_clearance_um";
const DIAMETRAL: &str = "bearing.diametral_clearance_um";
const CLASS: &str = "bearing.clearance_class";
const BORE: &str = "bearing.bore_diameter_mm";
/// One-sided clearance (um) below which a value other than 0 is taken for mm: less than a raceway's own roundness
/// error.
const SMALLEST_CLEARANCE: f64 = 0.2;
const CAGE_INNER: &str = "cage.inner_diameter_mm";
const CAGE_OUTER: &str = "cage.outer_diameter_mm";
const POCKET: &str = "cage.pocket_clearance_mm";

impl Checker<'_> {
    pub(super) fn bearing(&mut self) {
        self.ways_to_clearance();
        let b = &self.s.bearing;
        let d = b.roller_diameter_mm;
        let clearance_mm = 1e-3 * (b.radial_clearance_um.abs() + b.outer_gap_um);
        if clearance_mm > LARGEST_CLEARANCE * d {
            let (key, factor) = self.clearance_key();
            self.error(
                key,
                format!(
                    "clearance and outer gap together are {} mm, out of proportion to a roller of {} mm",
                    short(clearance_mm),
                    short(d)
                ),
                format!("-{0} to {0}", short(factor * 1e3 * LARGEST_CLEARANCE * d)),
                &["bearing.outer_gap_um", ROLLER],
            );
            return;
        }
        self.clearance_unit();
        self.bore();
        if self.raceways(clearance_mm) {
            self.spacing();
        }
    }

    /// Whether the inner ring has a wall. A preset's bore says nothing of raceways of one's own.
    fn bore(&mut self) {
        let b = &self.s.bearing;
        if let Some(bore) = b.bore_diameter_mm
            && bore >= b.inner_raceway_diameter_mm
        {
            let inner = short(b.inner_raceway_diameter_mm);
            self.error(
                BORE,
                format!("a bore of {} mm leaves no inner ring under a raceway of {inner} mm", short(bore)),
                format!("< {inner}"),
                &[INNER],
            );
        }
    }

    /// Whether the rollers fit between the raceways. `false` where the outer is not the larger one, and nothing else
    /// can be said.
    fn raceways(&mut self, clearance_mm: f64) -> bool {
        let b = &self.s.bearing;
        let (inner, outer) = (b.inner_raceway_diameter_mm, b.outer_raceway_diameter_mm);
        let (pitch, d) = (b.pitch_diameter_mm, b.roller_diameter_mm);
        let tolerance = (GEOMETRY_TOLERANCE * d).max(CLEARANCES * clearance_mm);
        let room = 0.5 * (outer - inner);
        if outer <= inner {
            self.error(
                OUTER,
                format!("the outer raceway must be larger than the inner one, {} mm", short(inner)),
                format!("> {}", short(inner)),
                &[INNER],
            );
            return false;
        }
        if (room - d).abs() > tolerance {
            self.error(
                ROLLER,
                format!(
                    "the raceways leave a gap of {} mm for rollers of {} mm: (D_o - D_i)/2 must be d within {} mm",
                    short(room),
                    short(d),
                    short(tolerance)
                ),
                format!("{} to {}", short(room - tolerance), short(room + tolerance)),
                &[INNER, OUTER],
            );
        } else if (pitch - d - inner).abs() > tolerance || (pitch + d - outer).abs() > tolerance {
            let low = (inner + d).max(outer - d) - tolerance;
            let high = (inner + d).min(outer - d) + tolerance;
            let preset = match self.s.bearing.preset.is_some() {
                true => "; the preset's raceways hold where none are given: give both, as D_m - d and D_m + d",
                false => "",
            };
            self.error(
                PITCH,
                format!(
                    "the gap is in the wrong place: D_m - d = {} mm against D_i = {} mm, D_m + d = {} mm against \
                     D_o = {} mm, {} mm allowed{preset}",
                    short(pitch - d),
                    short(inner),
                    short(pitch + d),
                    short(outer),
                    short(tolerance)
                ),
                format!("{} to {}", short(low), short(high)),
                &[INNER, OUTER, ROLLER],
            );
        }
        true
    }

    /// Whether the rollers of a row have room beside each other.
    fn spacing(&mut self) {
        let b = &self.s.bearing;
        let (pitch, d, z) = (b.pitch_diameter_mm, b.roller_diameter_mm, b.rollers_per_row);
        if z == 0 {
            return;
        }
        let spacing = pitch * (PI / z as f64).sin();
        if spacing <= d {
            let fit = most_elements(d, pitch);
            self.error(
                COUNT,
                format!(
                    "rollers overlap in the row: their centres are {} mm apart, their diameter is {} mm",
                    short(spacing),
                    short(d)
                ),
                match fit >= 3.0 {
                    true => format!("3 to {}", short(fit)),
                    false => "fewer than three fit: a smaller roller_diameter_mm, or a larger pitch circle".into(),
                },
                &[PITCH, ROLLER],
            );
        } else if spacing <= d + 2.0 * self.s.cage.pocket_clearance_mm {
            self.warn(
                POCKET,
                format!(
                    "neighbouring pockets meet: roller centres are {} mm apart, a pocket is {} mm wide",
                    short(spacing),
                    short(d + 2.0 * self.s.cage.pocket_clearance_mm)
                ),
                format!("< {}", short(0.5 * (spacing - d))),
                &[COUNT, PITCH, ROLLER],
            );
        }
    }

    /// The key that gives the clearance, and how many times the one-sided clearance its value is.
    fn clearance_key(&self) -> (&'static str, f64) {
        if self.finder.is_given(DIAMETRAL) { (DIAMETRAL, 2.0) } else { (CLEARANCE, 1.0) }
    }

    /// Whether the clearance is given in one way, and a class with its bore.
    fn ways_to_clearance(&mut self) {
        let ways: Vec<&str> =
            [CLEARANCE, DIAMETRAL, CLASS].into_iter().filter(|key| self.finder.is_given(key)).collect();
        if let [others @ .., last] = &ways[..]
            && !others.is_empty()
        {
            self.error(
                last,
                "the clearance is given twice".into(),
                "one of radial_clearance_um, diametral_clearance_um and clearance_class".into(),
                others,
            );
            return;
        }
        let bore = bore_diameter_mm(&self.s.bearing);
        let of = self.s.bearing.element;
        let known = bore.is_some_and(|bore| ClearanceClass::CN.limits(of, bore).is_some());
        if ways == [CLASS] && !known {
            let (key, message) = match bore {
                None => (CLASS, "a class needs the bore: give bearing.bore_diameter_mm, or a preset"),
                Some(_) => (BORE, "ISO 5753-1 has no class for this bore"),
            };
            let allowed = format!("a bore of up to {} mm", largest_bore_mm(of));
            self.error(key, message.into(), allowed, &[CLASS]);
        }
    }

    /// Whether the unit of the clearance can be right.
    fn clearance_unit(&mut self) {
        let b = &self.s.bearing;
        let (key, factor) = self.clearance_key();
        let (one_sided, bore) = (b.radial_clearance_um, bore_diameter_mm(b));
        let largest = bore.and_then(|bore| ClearanceClass::C5.limits(b.element, bore));
        if one_sided != 0.0 && one_sided.abs() < SMALLEST_CLEARANCE {
            self.warn(
                key,
                "very small for a clearance: in mm instead of um?".into(),
                format!(">= {}, or 0", short(factor * SMALLEST_CLEARANCE)),
                &[],
            );
        }
        if let (Some(bore), Some([_, most])) = (bore, largest)
            && 2.0 * one_sided > most
        {
            self.warn(
                key,
                format!(
                    "{} um on the diameter is more than ISO 5753-1 has for a bore of {} mm; its largest class, C5, ends at {} um",
                    short(2.0 * one_sided),
                    short(bore),
                    short(most)
                ),
                format!("<= {}", short(0.5 * factor * most)),
                &[],
            );
        }
    }

    pub(super) fn cage(&mut self) {
        let b = &self.s.bearing;
        let c = &self.s.cage;
        if c.pocket_clearance_mm == 0.0 && c.walls == Walls::Oiled {
            self.error(
                POCKET,
                "oil between element and pocket needs room (cage.walls = \"oiled\")".into(),
                "> 0".into(),
                &[],
            );
        }
        if b.outer_raceway_diameter_mm <= b.inner_raceway_diameter_mm {
            return;
        }
        if c.inner_diameter_mm >= c.outer_diameter_mm {
            self.error(
                CAGE_INNER,
                format!("the cage's inner diameter must be less than its outer one, {} mm", short(c.outer_diameter_mm)),
                format!("< {}", short(c.outer_diameter_mm)),
                &[CAGE_OUTER],
            );
            return;
        }
        if c.inner_diameter_mm < b.inner_raceway_diameter_mm {
            self.error(
                CAGE_INNER,
                "the cage reaches into the inner ring".into(),
                format!(">= {}", short(b.inner_raceway_diameter_mm)),
                &[INNER],
            );
        }
        if c.outer_diameter_mm > b.outer_raceway_diameter_mm {
            self.error(
                CAGE_OUTER,
                "the cage reaches into the outer ring".into(),
                format!("<= {}", short(b.outer_raceway_diameter_mm)),
                &[OUTER],
            );
        }
        let pitch = b.pitch_diameter_mm;
        if c.inner_diameter_mm >= pitch {
            self.error(
                CAGE_INNER,
                "the roller centres must be within the cage's section".into(),
                format!("< {}", short(pitch)),
                &[PITCH],
            );
        } else if c.outer_diameter_mm <= pitch {
            self.error(
                CAGE_OUTER,
                "the roller centres must be within the cage's section".into(),
                format!("> {}", short(pitch)),
                &[PITCH],
            );
        }
    }
}
