//! Eq. (27) in other readings: the irregular defect as a profile with the jumps of the print.
//!
//! Half-widths h in mm over six arcs, as in section 12 of the model. Joined, they are
//! [`brinell::defect::Shape::Li2023Irregular`].

use brinell::defect::li2023_half_width_mm;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, PI};

/// A reading of Eq. (27).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outline {
    /// The six arcs joined.
    #[default]
    Joined,
    /// The third arc with the square of the print: it stays at 1 mm, and a step of 0.71 mm in half-width leads to the
    /// fourth.
    ThirdArc,
    /// The third arc as printed, and the last arc with the print's theta_4 and theta_5, where the root is imaginary: no
    /// width there.
    LastArc,
    /// Both arcs as printed, over the printed angles on the raceway's radius.
    PrintedAngles,
    /// Both arcs as printed, and the printed factor 16 on the half-width, no wider than the roller.
    Factor16,
    /// The left side read as the effective length: L_s = L - 2 h.
    Inverted,
    /// The joined arcs as a depth: 20 um where they are widest, over the whole roller.
    Depth,
}

/// Arcs, mm.
#[expect(clippy::approx_constant, reason = "the paper's printed digits")]
const ARCS_MM: [f64; 6] = [1.6695, 1.5, 0.7071, 1.4142, 0.7071, 1.0];
/// The printed angles theta_1 to theta_7, rad.
const ANGLES: [f64; 7] = [4.6148, 4.6311, 4.6457, 4.7795, 4.7933, 4.8002, 4.8099];
/// Radius of the outer raceway, mm.
const RACEWAY_MM: f64 = 27.5;
/// L, mm.
const ROLLER_MM: f64 = 6.0;
/// Depth, um.
const DEPTH_UM: f64 = 20.0;
/// Largest width that Eq. (27) tabulates, mm.
const WIDTH_MM: f64 = 4.0;
/// Points of an arc but its first.
const POINTS: usize = 24;

impl Outline {
    /// As tables say it.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Joined => "arcs joined",
            Self::ThirdArc => "third arc as printed (a jump of 0.71 mm in half-width)",
            Self::LastArc => "third arc as printed, last arc imaginary, hence 0 (jumps of 0.71 and 1 mm)",
            Self::PrintedAngles => "both arcs as printed, on the printed angles (5.1 mm long)",
            Self::Factor16 => "both arcs as printed, with the factor 16, at most the roller's length",
            Self::Inverted => "left side read as the effective length",
            Self::Depth => "depth follows the width: 20 µm at the widest place, over the whole roller",
        }
    }

    /// The defect's shape in TOML for a greatest width (mm); `None` where it is the program's own.
    pub fn shape(self, max_width_mm: f64) -> Option<String> {
        if self == Self::Joined {
            return None;
        }
        let scale = max_width_mm / WIDTH_MM;
        let (mut arc, mut half) = (Vec::new(), Vec::new());
        let lengths: [f64; 6] = match self {
            Self::PrintedAngles => std::array::from_fn(|k| (ANGLES[k + 1] - ANGLES[k]) * RACEWAY_MM),
            _ => ARCS_MM,
        };
        let printed_end = matches!(self, Self::LastArc | Self::PrintedAngles | Self::Factor16);
        let mut from = -0.5 * lengths.iter().sum::<f64>();
        for (k, length) in lengths.iter().enumerate().take(if printed_end { 5 } else { 6 }) {
            for point in 0..=POINTS {
                let s = spaced(k, point);
                arc.push(from + s * length);
                half.push(self.half_width_mm(k, s));
            }
            from += length;
        }
        let width = |h: &f64| match self {
            Self::Factor16 => 16.0 * h * scale,
            Self::Inverted => ROLLER_MM - 2.0 * h * scale,
            Self::Depth => ROLLER_MM,
            _ => 2.0 * h * scale,
        };
        let width = half.iter().map(|h| width(h).clamp(0.0, ROLLER_MM));
        let mut text =
            format!("{{ profile = {{ arc_mm = {}, width_mm = {}", list(&arc), list(&width.collect::<Vec<_>>()));
        if self == Self::Depth {
            let depth: Vec<f64> = half
                .iter()
                // The printed digits of the first arc begin at -2e-5 mm.
                .map(|h| (DEPTH_UM * 2.0 * h * scale / WIDTH_MM).max(0.0))
                .collect();
            text += &format!(", depth_um = {}", list(&depth));
        }
        Some(text + " } }")
    }

    /// Half-width on an arc at the fraction s of it, mm.
    fn half_width_mm(self, arc: usize, s: f64) -> f64 {
        match (self, arc) {
            (Self::Inverted | Self::Depth, _) => li2023_half_width_mm(arc, s),
            // (0.7071e-3 s)^2 m is 0.5e-3 s^2 mm.
            (_, 2) => 1.0 + 0.5e-3 * s * s,
            _ => li2023_half_width_mm(arc, s),
        }
    }
}

/// A point's place within an arc, closer together where the arc is round.
fn spaced(arc: usize, point: usize) -> f64 {
    let u = point as f64 / POINTS as f64;
    match arc {
        3 => 0.5 - 0.5 * (PI * u).cos(),
        5 => (FRAC_PI_2 * u).sin(),
        _ => u,
    }
}

fn list(values: &[f64]) -> String {
    let all: Vec<String> = values.iter().map(|x| format!("{x:.6}")).collect();
    format!("[{}]", all.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BASE;
    use brinell::defect::Shape;

    fn shape(text: Option<String>) -> Shape {
        let settings: Vec<_> = text.into_iter().map(|t| ("defects.0.shape".to_owned(), t)).collect();
        let loaded = brinell::document::read(BASE, &settings).unwrap_or_else(|e| panic!("{e:?}"));
        Shape::new(&loaded.scenario.defects[0].shape, 20e-6).unwrap()
    }

    #[test]
    fn analytic_readings_of_eq_27_against_the_joined_shape() {
        let joined = shape(None);
        let (first, last) = joined.arc();
        let places = |k: i32| first + (last - first) * (f64::from(k) + 0.37) / 400.0;
        // The depth of the depth law is the joined width, 20 um at 4 mm; straight pieces stay within 10 um of the arcs'
        // 4 mm.
        let depth = shape(Outline::Depth.shape(4.0));
        for s in (0..400).map(places) {
            let expected = 20e-6 * joined.damaged_length(s) / 4e-3;
            assert!((depth.own_depth(s).unwrap() - expected).abs() < 5e-8, "{s}");
            assert_eq!(depth.damaged_length(s), 6e-3);
        }
        let inverted = shape(Outline::Inverted.shape(4.0));
        let third = shape(Outline::ThirdArc.shape(4.0));
        let last_arc = shape(Outline::LastArc.shape(3.0));
        for s in (0..400).map(places) {
            assert!((inverted.damaged_length(s) - (6e-3 - joined.damaged_length(s))).abs() < 1e-5, "{s}");
            let mm = 1e3 * (s - first);
            let wide = joined.damaged_length(s);
            let in_third = (3.1695..3.8766).contains(&mm);
            let expected = if in_third { 2e-3 } else { wide };
            assert!((third.damaged_length(s) - expected).abs() < 1e-5, "{mm}");
            if mm < 5.9 {
                assert!((last_arc.damaged_length(s) - 0.75 * expected).abs() < 1e-5, "{mm}");
            }
        }
        // No arc is left beyond the fifth: 1 mm in 7 less.
        assert!((last_arc.arc().1 - (last - 1e-3)).abs() < 1e-8);
        let (a, b) = shape(Outline::PrintedAngles.shape(4.0)).arc();
        assert!((b - a - (4.8002 - 4.6148) * 27.5e-3).abs() < 1e-8);
    }
}
