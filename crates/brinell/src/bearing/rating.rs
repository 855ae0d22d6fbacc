//! The static load rating: the catalogue's, or the estimate of ISO 76.

use crate::bearing::catalogue;
use crate::scenario::{Bearing, Element};

/// Basic static radial load rating C0.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticRating {
    /// C0, N.
    pub load: f64,
    /// Where the catalogue has it from; `None` for the estimate of ISO 76.
    pub source: Option<&'static str>,
}

/// C0 of a bearing: the catalogue's where the bearing is a preset with its rollers as they are, else ISO 76's formula for cylindrical
/// rollers, C0 = 44 (1 - d/D_m) i Z L d in N and mm, or for deep-groove ball bearings, C0 = f0 i Z d^2. A maker's rating may differ from that by
/// his own factors.
pub fn static_rating(bearing: &Bearing) -> StaticRating {
    let b = bearing;
    let catalogued = b.preset.as_deref().and_then(catalogue::find);
    let same = |entry: &&catalogue::Entry| {
        [
            ("roller_diameter_mm", b.roller_diameter_mm),
            ("roller_length_mm", b.roller_length_mm),
            ("pitch_diameter_mm", b.pitch_diameter_mm),
            ("rollers_per_row", b.rollers_per_row as f64),
            ("rows", b.rows as f64),
        ]
        .iter()
        // A ball has no length.
        .filter(|(key, _)| !(b.has_balls() && *key == "roller_length_mm"))
        .all(|(key, value)| entry.number(key) == Some(*value))
    };
    let printed = catalogued
        .filter(same)
        .and_then(|entry| entry.fact_of(catalogue::STATIC_RATING));
    if let Some((load, source)) = printed {
        return StaticRating {
            load,
            source: Some(source),
        };
    }
    let (d, rollers) = (b.roller_diameter_mm, (b.rows * b.rollers_per_row) as f64);
    let load = match b.element {
        Element::Roller => {
            44.0 * (1.0 - d / b.pitch_diameter_mm) * rollers * b.roller_length_mm * d
        }
        Element::Ball => ball_factor(d / b.pitch_diameter_mm) * rollers * d * d,
    };
    StaticRating { load, source: None }
}

/// f0 of ISO 76, table 1, for radial contact ball bearings by d/D_m, straight between its lines: grooves of 0.52 inside and 0.53 outside.
fn ball_factor(ratio: f64) -> f64 {
    /// From d/D_m = 0 in steps of 0.01.
    const F0: [f64; 41] = [
        14.7, 14.9, 15.1, 15.3, 15.5, 15.7, 15.9, 16.1, 16.3, 16.5, 16.4, 16.1, 15.9, 15.6, 15.4,
        15.2, 14.9, 14.7, 14.4, 14.2, 14.0, 13.7, 13.5, 13.2, 13.0, 12.8, 12.5, 12.3, 12.1, 11.8,
        11.6, 11.4, 11.2, 10.9, 10.7, 10.5, 10.3, 10.0, 9.8, 9.6, 9.4,
    ];
    let at = (100.0 * ratio).clamp(0.0, 39.999_999);
    let k = at as usize;
    F0[k] + (at - k as f64) * (F0[k + 1] - F0[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::read;

    #[test]
    fn analytic_rating_of_changed_rollers_is_the_estimate() {
        let text =
            "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 1500\nload_n = [1000, 0]\n";
        let mut b = read(text, &[]).unwrap().scenario.bearing;
        b.rollers_per_row = 12;
        let estimate = static_rating(&b);
        let by_hand = 44.0 * (1.0 - 9.0 / 46.5) * 12.0 * 8.8 * 9.0;
        assert_eq!(estimate.source, None);
        assert!((estimate.load / by_hand - 1.0).abs() < 1e-12);
    }
}
