//! Static load slice by slice, edge pressure and reference rating life: against ISO/TS 16281 by another program,
//! against limits and printed tables.

use crate::common::read_li2023 as read;
use brinell::bearing::rating::dynamic_rating;
use brinell::lamina::{Distribution, LoadAlong, reference_life, stress_riser};
use brinell::scenario::{LoadOn, RollerProfile, Scenario};

/// NU206 with ISO/TS 16281's line constant, 35 948 L^(8/9) N/mm^(10/9) for both contacts in series; the load on the
/// inner ring, which nothing else holds, the outer ring at rest, no speed to speak of.
fn iso(force: f64, offset_mm: f64, clearance_um: f64, profile: RollerProfile) -> Scenario {
    let text = "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 1\nload_n = [1, 0]\n\
                [contact]\nslices = 30\n[simulation]\nmodel = \"tilting\"";
    let mut s = read(text, &[]).unwrap().scenario;
    let n: f64 = 10.0 / 9.0;
    // Each of two equal contacts takes half the deformation.
    let stiffness = 2f64.powf(n) * 35_948.0 * 8.8f64.powf(8.0 / 9.0) * 1e3f64.powf(n);
    s.contact.inner_stiffness = stiffness;
    s.contact.outer_stiffness = stiffness;
    s.bearing.radial_clearance_um = clearance_um;
    s.bearing.profile = profile;
    s.operation.load_n = [force, 0.0];
    s.operation.load_on = LoadOn::InnerRing;
    s.operation.load_offset_mm = offset_mm;
    s.support.inner_stiffness_n_per_m = 0.0;
    s.support.inner_tilt_stiffness_nm_per_rad = 0.0;
    s.support.outer_stiffness_n_per_m = 1e9;
    s.support.outer_tilt_stiffness_nm_per_rad = 1e7;
    s
}

/// L10r in million revolutions.
fn life(s: &Scenario) -> f64 {
    1e-6 * reference_life(&s.bearing, &Distribution::of(s).unwrap()).unwrap()
}

#[test]
fn xval_iso_16281_by_another_program() {
    // validation/lamina/iso16281.py prints these.
    let cases = [
        (5e3, 0.0, 0.0, RollerProfile::Straight, [0.0, 1574.27181, 178.894523, 2090.98026]),
        (5e3, 4.0, 0.0, RollerProfile::Straight, [1.17569589, 1574.27181, 274.873773, 778.672371]),
        (5e3, 4.0, 10.0, RollerProfile::Logarithmic, [1.65275555, 1957.24104, 322.510041, 1771.23468]),
        (8e3, 10.0, 10.0, RollerProfile::Logarithmic, [3.54712444, 2940.11022, 531.937664, 181.981692]),
    ];
    for (force, moment, clearance, profile, [tilt, largest, line, million]) in cases {
        let s = iso(force, 1e3 * moment / force, clearance, profile);
        let d = Distribution::of(&s).unwrap();
        let heaviest = d.heaviest().unwrap()[1].force;
        let lines = d.contacts.iter().flat_map(|pair| &pair[1].line_load);
        let found: [f64; 4] = [1e3 * d.tilt[0], heaviest, 1e-3 * lines.fold(0.0, |m: f64, q| m.max(*q)), life(&s)];
        let printed: [f64; 4] = [tilt, largest, line, million];
        for (ours, theirs) in found.into_iter().zip(printed) {
            let scale = theirs.abs().max(1e-3);
            assert!((ours - theirs).abs() < 2e-6 * scale, "{force} N, {moment} N m: {ours} and {theirs}");
        }
    }
}

#[test]
fn lit_geometry_factors_of_iso_281() {
    // ISO 281, table of f_c for radial roller bearings, by d cos(alpha)/D_m; b_m = 1.1. Quoted at second hand.
    let s = iso(1.0, 0.0, 0.0, RollerProfile::Straight);
    for (gamma, printed) in
        [(0.01, 52.1), (0.05, 74.1), (0.10, 84.2), (0.15, 88.2), (0.20, 88.7), (0.25, 87.0), (0.30, 83.8)]
    {
        let mut b = s.bearing.clone();
        b.pitch_diameter_mm = b.roller_diameter_mm / gamma;
        let rest = 1.1 * 8.8f64.powf(7.0 / 9.0) * 13f64.powf(0.75) * 9f64.powf(29.0 / 27.0);
        let factor = dynamic_rating(&b) / rest;
        assert!((factor - printed).abs() < 0.1, "{gamma}: {factor}");
    }
}

#[test]
fn lit_makers_dynamic_ratings_are_those_of_iso_281_or_a_seventh_above() {
    // SKF's catalogue 17000: NU 205 ECP 28.6 kN, NU 206 ECP 44 kN; a bearing's effective roller length here is from its
    // C0.
    for (name, printed, expected) in [("NU205", 28.6e3, 0.98..1.01), ("NU206", 44e3, 1.10..1.17)] {
        let text = format!("[bearing]\npreset = \"{name}\"\n[operation]\nspeed_rpm = 1\nload_n = [1, 0]");
        let ours = dynamic_rating(&read(&text, &[]).unwrap().scenario.bearing);
        let ratio = printed / ours;
        println!("{name}: {ours:.0} N by ISO 281, {printed:.0} N printed, {ratio:.3}");
        assert!(expected.contains(&ratio), "{name}: {ratio}");
    }
}

#[test]
fn analytic_life_of_an_aligned_bearing_is_the_fourth_power_of_c_over_p() {
    // No clearance, straight: half a turn is loaded, and without the stress riser L10r = (C/(0.83 P))^4: ISO 281 takes
    // the reduction 0.83 for edges and misalignment, and the power 10/3 for its range of loads. The riser is between
    // both.
    let riser = |n: usize| {
        let sum: f64 = (0..n).map(|k| stress_riser(k, n).powf(4.5)).sum();
        (sum / n as f64).powf(-8.0 / 9.0)
    };
    for load in [2e3, 5e3, 1e4] {
        let s = iso(load, 0.0, 0.0, RollerProfile::Straight);
        let ratio = dynamic_rating(&s.bearing) / load;
        let expected = (ratio / 0.83).powi(4) * riser(30);
        let found = life(&s);
        println!("C/P {ratio:.2}: L10r {found:.0}, ISO 281 {:.0}", ratio.powf(10.0 / 3.0));
        // 0.378 and 0.364 are of three figures, and the integrals J of n = 1.1, where here it is 10/9.
        assert!((found / expected - 1.0).abs() < 0.02, "{found} and {expected}");
    }
}

#[test]
fn prop_a_mirrored_moment_mirrors_loads_and_keeps_the_life() {
    let there = Distribution::of(&iso(5e3, 0.8, 10.0, RollerProfile::Logarithmic)).unwrap();
    let here = Distribution::of(&iso(5e3, -0.8, 10.0, RollerProfile::Logarithmic)).unwrap();
    for (a, b) in there.contacts.iter().flatten().zip(here.contacts.iter().flatten()) {
        assert!((a.force - b.force).abs() < 1e-4);
        let mirrored = a.line_load.iter().zip(b.line_load.iter().rev());
        for (a, b) in mirrored {
            assert!((a - b).abs() < 1.0, "{a} and {b} N/m");
        }
    }
    assert!((there.tilt[0] + here.tilt[0]).abs() < 1e-9);
}

#[test]
fn analytic_slices_add_up_to_the_load() {
    let s = iso(5e3, 0.8, 10.0, RollerProfile::Logarithmic);
    let d = Distribution::of(&s).unwrap();
    let positions = (d.contacts.len() / 13) as f64;
    let mut sums = [0.0; 2];
    for [inner, _] in &d.contacts {
        sums[0] += inner.force * inner.angle.cos() / positions;
        sums[1] += inner.moment * inner.angle.cos() / positions;
    }
    assert!((sums[0] / 5e3 - 1.0).abs() < 1e-6, "{}", sums[0]);
    assert!((sums[1] / 4.0 - 1.0).abs() < 1e-5, "{}", sums[1]);
    // The tangent: a little more load shifts and tilts the ring by what the stiffness says.
    let stiffness = d.stiffness.unwrap();
    assert!(stiffness[0][0] > 1e8 && stiffness[2][2] > 1e2, "{stiffness:?}");
    for (i, row) in stiffness.iter().enumerate() {
        for (j, k) in row.iter().enumerate() {
            let scale = (stiffness[i][i] * stiffness[j][j]).sqrt();
            assert!((k - stiffness[j][i]).abs() < 1e-9 * scale);
        }
    }
}

/// Largest pressure at the rollers' ends (MPa) and life where the inner ring is held at a tilt against the load.
fn tilted(profile: RollerProfile, minutes: f64) -> (f64, f64) {
    let mut s = iso(5e3, 0.0, 10.0, profile);
    // The moment of the load against a support so stiff that nothing else counts.
    let (stiffness, tilt) = (1e7, (minutes / 60.0_f64).to_radians());
    s.support.inner_tilt_stiffness_nm_per_rad = stiffness;
    s.operation.load_offset_mm = 1e3 * stiffness * tilt / 5e3;
    let d = Distribution::of(&s).unwrap();
    assert!((d.tilt[0] - tilt).abs() < 1e-5, "{}", d.tilt[0]);
    let end = d.end_peak().map_or(0.0, |p| 1e-6 * p.pressure);
    (end, reference_life(&s.bearing, &d).unwrap())
}

/// Mesh study and misalignment: `cargo test -p brinell --test all lamina:: -- --nocapture`.
#[test]
fn prop_tables_of_the_book() {
    println!(
        "slices  end straight  end logarithmic  most logarithmic  L10r straight  L10r logarithmic   (MPa, 1e6 r; 8 kN, 10 N m)"
    );
    let mut last = [0.0; 3];
    for slices in [8, 16, 32, 64, 128] {
        let row = [RollerProfile::Straight, RollerProfile::Logarithmic].map(|profile| {
            let mut s = iso(8e3, 1.25, 10.0, profile);
            s.contact.slices = slices;
            let d = Distribution::of(&s).unwrap();
            let [end, most] = [d.end_peak(), d.peak()].map(|p| p.map_or(0.0, |p| 1e-6 * p.pressure));
            (end, most, 1e-6 * reference_life(&s.bearing, &d).unwrap())
        });
        println!(
            "{slices:6}  {:12.0}  {:15.0}  {:16.0}  {:13.1}  {:16.1}",
            row[0].0, row[1].0, row[1].1, row[0].2, row[1].2
        );
        last = [row[0].1, row[1].1, row[1].2];
    }
    assert!(last[0] > last[1], "a straight roller's edge is pressed harder");
    println!(
        "minutes  end straight  end logarithmic  life straight  life logarithmic   (share of the aligned life; 5 kN)"
    );
    let aligned = [RollerProfile::Straight, RollerProfile::Logarithmic].map(|p| tilted(p, 0.0));
    for minutes in [0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0] {
        let [a, b] = [RollerProfile::Straight, RollerProfile::Logarithmic].map(|p| tilted(p, minutes));
        println!("{minutes:7}  {:12.0}  {:15.0}  {:13.2}  {:16.2}", a.0, b.0, a.1 / aligned[0].1, b.1 / aligned[1].1);
    }
}

#[test]
fn prop_the_roller_shown_without_damage_is_the_one_that_carries_most() {
    // A load beside the middle of two rows: the second carries more. Without it, the first of two that carry alike.
    let text = |offset: f64| {
        format!(
            "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1\nload_n = [0, -3000]\nload_on = \"inner-ring\"\n\
             load_offset_mm = {offset}\n[support]\ninner_stiffness_n_per_m = 1e3\ninner_tilt_stiffness_nm_per_rad = 1\n\
             [simulation]\nmodel = \"tilting\""
        )
    };
    for (offset, row) in [(2.0, 1), (0.0, 0), (-2.0, 0)] {
        let s = read(&text(offset), &[]).unwrap().scenario;
        let load = LoadAlong::of(&s).unwrap().unwrap();
        let shown = &load.contacts[1];
        let heaviest = Distribution::of(&s).unwrap().heaviest().unwrap()[1].force;
        assert_eq!(shown.row, row, "load {offset} mm off");
        assert!((shown.force / heaviest - 1.0).abs() < 0.02, "{} and {heaviest} N", shown.force);
    }
}
