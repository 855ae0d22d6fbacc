//! The static load rating: the catalogue's, or the estimate of ISO 76.

use crate::bearing::catalogue;
use crate::scenario::Bearing;

/// Basic static radial load rating C0.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticRating {
    /// C0, N.
    pub load: f64,
    /// Where the catalogue has it from; `None` for the estimate of ISO 76.
    pub source: Option<&'static str>,
}

/// C0 of a bearing: the catalogue's where the bearing is a preset with its rollers as they are, else ISO 76's formula for cylindrical
/// rollers, C0 = 44 (1 - d/D_m) i Z L d in N and mm. A maker's rating may differ from that by his own factors.
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
    StaticRating {
        load: 44.0 * (1.0 - d / b.pitch_diameter_mm) * rollers * b.roller_length_mm * d,
        source: None,
    }
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
