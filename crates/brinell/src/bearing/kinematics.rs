//! Pure rolling: the speeds of cage and rollers, and the defect frequencies.
//!
//! The outer ring rests. Rollers roll on both raceways without slip, with the levers of the centred bearing
//! (`docs/src/theory/frame.md`): `dtheta = w R_i / (2 R_m)`, `dphi = -(w R_i - R_m dtheta) / r`. Where `R_i = R_m -
//! r`, as in NN3007, these are the textbook's `(1 - d/D_m)` formulas. Angles are counter-clockwise positive; lengths in
//! m, speeds in rad/s, frequencies in Hz.

use crate::scenario::{Bearing, Surface};
use std::f64::consts::TAU;

/// What the speeds depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geometry {
    /// D_i, m.
    pub inner_raceway_diameter: f64,
    /// D_m, m.
    pub pitch_diameter: f64,
    /// d, m.
    pub roller_diameter: f64,
    /// Z.
    pub rollers_per_row: usize,
}

impl Geometry {
    /// Of a scenario's bearing.
    pub fn of(bearing: &Bearing) -> Self {
        Self {
            inner_raceway_diameter: 1e-3 * bearing.inner_raceway_diameter_mm,
            pitch_diameter: 1e-3 * bearing.pitch_diameter_mm,
            roller_diameter: 1e-3 * bearing.roller_diameter_mm,
            rollers_per_row: bearing.rollers_per_row,
        }
    }
}

/// Speeds (signed) and defect frequencies (never negative) in pure rolling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// FTF: turns of the cage a second, Hz.
    pub ftf: f64,
    /// BPFO: rollers passing a point of the outer raceway a second, Hz.
    pub bpfo: f64,
    /// BPFI: rollers passing a point of the inner raceway a second, Hz.
    pub bpfi: f64,
    /// BSF: turns of a roller relative to the cage a second, Hz. Damage on it passes a raceway 2 BSF times.
    pub bsf: f64,
    /// dtheta: orbit speed of rollers and cage, rad/s.
    pub orbit_speed: f64,
    /// dphi: absolute spin speed of a roller, rad/s, against the shaft's sense.
    pub spin_speed: f64,
}

impl Kinematics {
    /// Pure rolling at an inner ring's speed of `shaft_speed` rad/s.
    #[inline]
    pub fn pure_rolling(geometry: &Geometry, shaft_speed: f64) -> Self {
        let inner_radius = geometry.inner_raceway_diameter / 2.0;
        let pitch_radius = geometry.pitch_diameter / 2.0;
        let roller_radius = geometry.roller_diameter / 2.0;
        let rollers = geometry.rollers_per_row as f64;

        let surface_speed = shaft_speed * inner_radius;
        let orbit_speed = surface_speed / (2.0 * pitch_radius);
        let spin_speed = -(surface_speed - pitch_radius * orbit_speed) / roller_radius;
        Self {
            ftf: orbit_speed.abs() / TAU,
            bpfo: rollers * orbit_speed.abs() / TAU,
            bpfi: rollers * (shaft_speed - orbit_speed).abs() / TAU,
            bsf: (spin_speed - orbit_speed).abs() / TAU,
            orbit_speed,
            spin_speed,
        }
    }

    /// With a cage, and rollers, that orbit more slowly by the share `slip`; spins are left as they are.
    pub(crate) fn with_cage_slip(self, slip: f64) -> Self {
        Self {
            ftf: self.ftf * (1.0 - slip),
            bpfo: self.bpfo * (1.0 - slip),
            bpfi: self.bpfi + self.bpfo * slip,
            orbit_speed: self.orbit_speed * (1.0 - slip),
            ..self
        }
    }

    /// Name, value (Hz) and meaning of every frequency, that of the shaft (Hz) first.
    pub fn table(&self, shaft: f64) -> [(&'static str, f64, &'static str); 6] {
        frequency_table(shaft, self.ftf, self.bpfo, self.bpfi, self.bsf)
    }

    /// Name and value (Hz) of the frequency at which damage on a surface causes impacts.
    pub fn defect_frequency(&self, surface: Surface) -> (&'static str, f64) {
        match surface {
            Surface::OuterRaceway => ("BPFO", self.bpfo),
            Surface::InnerRaceway => ("BPFI", self.bpfi),
            Surface::Roller(_) => ("2 BSF", 2.0 * self.bsf),
        }
    }
}

/// Name, value (Hz) and meaning of every frequency, that of the shaft first.
pub(super) fn frequency_table(
    shaft: f64,
    ftf: f64,
    bpfo: f64,
    bpfi: f64,
    bsf: f64,
) -> [(&'static str, f64, &'static str); 6] {
    [
        ("shaft", shaft, "turns of the inner ring"),
        ("FTF", ftf, "turns of the cage"),
        ("BPFO", bpfo, "rolling elements passing a point of the outer raceway"),
        ("BPFI", bpfi, "rolling elements passing a point of the inner raceway"),
        ("BSF", bsf, "turns of a rolling element relative to the cage"),
        ("2 BSF", 2.0 * bsf, "impacts of damage on a rolling element"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const NN3007: Geometry =
        Geometry { inner_raceway_diameter: 0.043, pitch_diameter: 0.049, roller_diameter: 0.006, rollers_per_row: 19 };
    const SHAFT: f64 = 1800.0 / 60.0 * TAU;

    /// Half a unit of the last digit printed.
    #[track_caller]
    fn assert_digits(value: f64, printed: f64, digits: i32) {
        let tolerance = 0.5 * 10f64.powi(-digits) * (1.0 + 1e-9);
        assert!((value - printed).abs() <= tolerance, "{value} is not {printed} to {digits} digits");
    }

    #[test]
    fn analytic_nn3007_speeds_and_frequencies_of_model_section_13() {
        let k = Kinematics::pure_rolling(&NN3007, SHAFT);
        assert_digits(k.bpfo, 250.102, 3);
        assert_digits(k.bpfi, 319.898, 3);
        assert_digits(k.ftf, 13.163, 3);
        assert_digits(k.bsf, 120.663, 3);
        assert_digits(k.orbit_speed, 82.707, 3);
        assert_digits(k.spin_speed, -675.4, 1);
        // Centrifugal force of a roller of 1.3 g, N.
        assert_digits(0.0013 * 0.5 * NN3007.pitch_diameter * k.orbit_speed.powi(2), 0.218, 3);
    }

    #[test]
    fn analytic_textbook_formulas_where_the_raceway_touches_the_roller() {
        let k = Kinematics::pure_rolling(&NN3007, SHAFT);
        let ratio = NN3007.roller_diameter / NN3007.pitch_diameter;
        let turns = SHAFT / TAU;
        for (value, textbook) in [
            (k.ftf, turns / 2.0 * (1.0 - ratio)),
            (k.bpfo, 19.0 * turns / 2.0 * (1.0 - ratio)),
            (k.bpfi, 19.0 * turns / 2.0 * (1.0 + ratio)),
            (k.bsf, turns / (2.0 * ratio) * (1.0 - ratio * ratio)),
        ] {
            assert!((value / textbook - 1.0).abs() < 1e-14, "{value} is not {textbook}");
        }
    }

    #[test]
    fn analytic_no_slip_at_either_raceway() {
        // A raceway that does not touch the roller exactly, and a shaft turning clockwise.
        let geometry = Geometry { inner_raceway_diameter: 0.0429, ..NN3007 };
        let speed = -123.0;
        let k = Kinematics::pure_rolling(&geometry, speed);
        let centre = geometry.pitch_diameter / 2.0 * k.orbit_speed;
        let spin = geometry.roller_diameter / 2.0 * k.spin_speed;
        let slip_inner = speed * geometry.inner_raceway_diameter / 2.0 - (centre - spin);
        let slip_outer = -(centre + spin);
        assert!(slip_inner.abs() < 1e-15 && slip_outer.abs() < 1e-15, "{slip_inner} {slip_outer}");
    }

    #[test]
    fn prop_frequencies_do_not_depend_on_the_sense_of_rotation() {
        let (ccw, cw) = (Kinematics::pure_rolling(&NN3007, SHAFT), Kinematics::pure_rolling(&NN3007, -SHAFT));
        assert_eq!((ccw.ftf, ccw.bpfo, ccw.bpfi, ccw.bsf), (cw.ftf, cw.bpfo, cw.bpfi, cw.bsf));
        assert_eq!((ccw.orbit_speed, ccw.spin_speed), (-cw.orbit_speed, -cw.spin_speed));
    }

    #[test]
    fn prop_every_roller_passes_one_ring_or_the_other() {
        let k = Kinematics::pure_rolling(&NN3007, SHAFT);
        assert!((k.bpfo + k.bpfi - 19.0 * SHAFT / TAU).abs() < 1e-10);
    }
}
