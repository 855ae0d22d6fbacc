//! Geometry of bearing and cage, and their contact.

use std::f64::consts::PI;

use super::{Checker, short};

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
const CAGE_INNER: &str = "cage.inner_diameter_mm";
const CAGE_OUTER: &str = "cage.outer_diameter_mm";
const POCKET: &str = "cage.pocket_clearance_mm";

impl Checker<'_> {
    pub(super) fn bearing(&mut self) {
        let b = &self.s.bearing;
        let (inner, outer) = (b.inner_raceway_diameter_mm, b.outer_raceway_diameter_mm);
        let (pitch, d) = (b.pitch_diameter_mm, b.roller_diameter_mm);
        let clearance_mm = 1e-3 * (b.radial_clearance_um.abs() + b.outer_gap_um);
        if clearance_mm > LARGEST_CLEARANCE * d {
            self.error(
                CLEARANCE,
                format!(
                    "clearance and outer gap together are {} mm, out of proportion to a roller of {} mm",
                    short(clearance_mm),
                    short(d)
                ),
                format!("-{0} to {0}", short(1e3 * LARGEST_CLEARANCE * d)),
                &["bearing.outer_gap_um", ROLLER],
            );
            return;
        }
        let tolerance = (GEOMETRY_TOLERANCE * d).max(CLEARANCES * clearance_mm);
        let room = 0.5 * (outer - inner);
        if outer <= inner {
            self.error(
                OUTER,
                format!(
                    "the outer raceway must be larger than the inner one, {} mm",
                    short(inner)
                ),
                format!("> {}", short(inner)),
                &[INNER],
            );
            return;
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
            self.error(
                PITCH,
                format!(
                    "the gap is in the wrong place: D_m - d = {} mm against D_i = {} mm, D_m + d = {} mm against \
                     D_o = {} mm, {} mm allowed",
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
        let z = b.rollers_per_row;
        if z == 0 {
            return;
        }
        let spacing = pitch * (PI / z as f64).sin();
        if spacing <= d {
            let fit = (PI / (d / pitch).clamp(0.0, 1.0).asin()).ceil() - 1.0;
            self.error(
                COUNT,
                format!(
                    "rollers overlap in the row: their centres are {} mm apart, their diameter is {} mm",
                    short(spacing),
                    short(d)
                ),
                format!("3 to {}", short(fit)),
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

    pub(super) fn cage(&mut self) {
        let b = &self.s.bearing;
        let c = &self.s.cage;
        if b.outer_raceway_diameter_mm <= b.inner_raceway_diameter_mm {
            return;
        }
        if c.inner_diameter_mm >= c.outer_diameter_mm {
            self.error(
                CAGE_INNER,
                format!(
                    "the cage's inner diameter must be less than its outer one, {} mm",
                    short(c.outer_diameter_mm)
                ),
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
                "the roller centres must lie within the cage's section".into(),
                format!("< {}", short(pitch)),
                &[PITCH],
            );
        } else if c.outer_diameter_mm <= pitch {
            self.error(
                CAGE_OUTER,
                "the roller centres must lie within the cage's section".into(),
                format!("> {}", short(pitch)),
                &[PITCH],
            );
        }
    }

    pub(super) fn contact(&mut self) {
        const EXPONENT: &str = "contact.exponent";
        for stiffness in ["contact.inner_stiffness", "contact.outer_stiffness"] {
            if self.finder.is_preset(stiffness)
                && self.finder.place(EXPONENT).is_some()
                && (self.s.contact.exponent - 10.0 / 9.0).abs() > 1e-9
            {
                self.warn(
                    EXPONENT,
                    format!("the preset's {stiffness} is in N/m^(10/9) and is now read as N/m^n"),
                    String::new(),
                    &[stiffness],
                );
            }
        }
    }
}
