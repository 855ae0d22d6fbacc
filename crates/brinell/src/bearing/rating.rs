//! The static load rating: the catalogue's, or the estimate of ISO 76; the dynamic one by ISO 281.

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

/// C0 of a bearing: that which is given, the catalogue's where the bearing is a preset with its rollers as they are, else ISO 76's formula
/// for cylindrical rollers, C0 = 44 (1 - d/D_m) i Z L d in N and mm, or for deep-groove ball bearings, C0 = f0 i Z d^2.
/// A maker's rating may differ from that by his own factors.
pub fn static_rating(bearing: &Bearing) -> StaticRating {
    let b = bearing;
    if let Some(load) = b.static_load_rating_n {
        return StaticRating { load, source: Some("as given") };
    }
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
    let printed = catalogued.filter(same).and_then(|entry| entry.fact_of(catalogue::STATIC_RATING));
    if let Some((load, source)) = printed {
        return StaticRating { load, source: Some(source) };
    }
    let (d, rollers) = (b.roller_diameter_mm, (b.rows * b.rollers_per_row) as f64);
    let load = match b.element {
        Element::Roller => rating_of_length(b) * b.roller_length_mm,
        Element::Ball => ball_factor(d / b.pitch_diameter_mm) * rollers * d * d,
    };
    StaticRating { load, source: None }
}

/// A load over the static rating: 5 to 9 % of the dynamic rating, a normal load, of which the ring's support, as it is
/// where none is given, carries less than a tenth.
const NORMAL_LOAD: f64 = 0.1;

/// The load that a scenario of a bearing starts from, N: a tenth of its static rating, to one digit.
pub fn normal_load(bearing: &Bearing) -> f64 {
    let load = NORMAL_LOAD * static_rating(bearing).load;
    let power = 10_f64.powi(load.log10().floor() as i32);
    (load / power).round() * power
}

/// C0 of each mm of its rollers' length, N, by ISO 76.
fn rating_of_length(b: &Bearing) -> f64 {
    let (d, rollers) = (b.roller_diameter_mm, (b.rows * b.rollers_per_row) as f64);
    44.0 * (1.0 - d / b.pitch_diameter_mm) * rollers * d
}

/// The length of rollers with which C0 is this by ISO 76, to a micrometre, mm.
pub(crate) fn roller_length_mm(b: &Bearing, c0: f64) -> f64 {
    (1e3 * c0 / rating_of_length(b)).round() / 1e3
}

/// f0 of ISO 76, table 1, for radial contact ball bearings by d/D_m, straight between its lines: grooves of 0.52 inside
/// and 0.53 outside.
pub(super) fn ball_factor(ratio: f64) -> f64 {
    /// From d/D_m = 0 in steps of 0.01.
    const F0: [f64; 41] = [
        14.7, 14.9, 15.1, 15.3, 15.5, 15.7, 15.9, 16.1, 16.3, 16.5, 16.4, 16.1, 15.9, 15.6, 15.4, 15.2, 14.9, 14.7,
        14.4, 14.2, 14.0, 13.7, 13.5, 13.2, 13.0, 12.8, 12.5, 12.3, 12.1, 11.8, 11.6, 11.4, 11.2, 10.9, 10.7, 10.5,
        10.3, 10.0, 9.8, 9.6, 9.4,
    ];
    let at = (100.0 * ratio).clamp(0.0, 39.999_999);
    let k = at as usize;
    F0[k] + (at - k as f64) * (F0[k + 1] - F0[k])
}

/// Lundberg and Palmgren's reduction factor lambda nu of radial roller bearings, which is in C_r.
pub const LAMBDA_NU: f64 = 0.83;
/// b_m of cylindrical roller bearings with machined rings, for today's steel.
const MATERIAL: f64 = 1.1;

/// Basic dynamic radial load rating C_r of a cylindrical roller bearing by ISO 281, N.
///
/// C_r = b_m f_c (i L)^(7/9) Z^(3/4) d^(29/27), f_c = 208 lambda nu gamma^(2/9) (1 - gamma)^(29/27) (1 + gamma)^(-1/4)
/// (1 + (1.04 ((1 - gamma)/(1 + gamma))^(143/108))^(9/2))^(-2/9), gamma = d/D_m, in N and mm (ISO/TR 1281-1). Makers
/// print more for steel and rollers of their own: SKF about a seventh, but nothing in the sizes 204, 205 and 2205.
pub fn dynamic_rating(bearing: &Bearing) -> f64 {
    let (b, d) = (bearing, bearing.roller_diameter_mm);
    let length = (b.rows as f64 * b.roller_length_mm).powf(7.0 / 9.0);
    MATERIAL
        * geometry_factor(d / b.pitch_diameter_mm)
        * length
        * (b.rollers_per_row as f64).powf(0.75)
        * d.powf(29.0 / 27.0)
}

/// f_c of ISO 281 for gamma = d/D_m.
fn geometry_factor(gamma: f64) -> f64 {
    let rings = 1.04 * ((1.0 - gamma) / (1.0 + gamma)).powf(143.0 / 108.0);
    208.0 * LAMBDA_NU * gamma.powf(2.0 / 9.0) * (1.0 - gamma).powf(29.0 / 27.0) / (1.0 + gamma).powf(0.25)
        * (1.0 + rings.powf(4.5)).powf(-2.0 / 9.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::read;

    #[test]
    fn analytic_rating_of_changed_rollers_is_the_estimate() {
        let text = "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 1500\nload_n = [1000, 0]\n";
        let mut b = read(text, &[]).unwrap().scenario.bearing;
        b.rollers_per_row = 12;
        let estimate = static_rating(&b);
        let by_hand = 44.0 * (1.0 - 9.0 / 46.5) * 12.0 * 8.8 * 9.0;
        assert_eq!(estimate.source, None);
        assert!((estimate.load / by_hand - 1.0).abs() < 1e-12);
    }

    /// NU 206 ECP: C0 = 36.5 kN of SKF's sheet.
    #[test]
    fn analytic_normal_load_is_a_tenth_of_the_rating() {
        let text = "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 1500\nload_n = [1000, 0]\n";
        let mut b = read(text, &[]).unwrap().scenario.bearing;
        assert_eq!(normal_load(&b), 4000.0);
        b.static_load_rating_n = Some(12_400.0);
        assert_eq!(normal_load(&b), 1000.0);
    }

    /// NU 204 ECP: F = 26.5 mm, E of the N 204 41.5 mm, C0 = 22 kN of SKF's sheet; 11 rollers.
    #[test]
    fn analytic_what_a_sheet_prints_gives_the_rollers() {
        let sheet = "[bearing]\ninner_raceway_diameter_mm = 26.5\nouter_raceway_diameter_mm = 41.5\nrollers_per_row = 11\n\
                     static_load_rating_n = 22000.0\n[operation]\nspeed_rpm = 1500\nload_n = [1000, 0]\n";
        let read_one = |text: &str| read(text, &[]).unwrap();
        let loaded = read_one(sheet);
        let b = &loaded.scenario.bearing;
        assert!((b.roller_diameter_mm - 7.5).abs() < 1e-12);
        // To a micrometre of length.
        assert!(
            (44.0 * (1.0 - 7.5 / 34.0) * 11.0 * b.roller_length_mm * 7.5 - 22e3).abs() < 1.5,
            "{}",
            b.roller_length_mm
        );
        assert_eq!(static_rating(b).load, 22e3);
        for key in ["bearing.roller_diameter_mm", "bearing.roller_length_mm"] {
            assert!(loaded.provenance.iter().any(|p| p.key == key && p.assumed), "{key}");
        }
        // What is given outranks it, and the written form says the same again.
        assert_eq!(
            read_one(&sheet.replace("[operation]", "roller_length_mm = 7.0\n[operation]"))
                .scenario
                .bearing
                .roller_length_mm,
            7.0
        );
        assert_eq!(read_one(&loaded.to_toml()).scenario, loaded.scenario);
        // Of a preset its own length, with the rating that is given.
        let preset = "[bearing]\npreset = \"NU206\"\nstatic_load_rating_n = 5e4\n[operation]\nspeed_rpm = 1500\nload_n = [1000, 0]\n";
        let known = read_one(preset).scenario.bearing;
        assert_eq!((known.roller_length_mm, static_rating(&known).load), (8.8, 5e4));
        // Without it the length is asked for.
        let missing = read(&sheet.replace("static_load_rating_n = 22000.0\n", ""), &[]).unwrap_err();
        assert!(missing.iter().any(|problem| problem.to_string().contains("bearing.roller_length_mm")), "{missing:?}");
    }
}
