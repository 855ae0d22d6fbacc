//! What is said beside the part that leads, and beside a record of the healthy machine.

use crate::analysis::{Damage, SHAFT, damaged, healthy, look};
use brinell_signal::Indicator;
use brinell_signal::analysis::{Finding, NamedBearing, Options, Side, Unexplained, Verdict, analyze, compare};
use brinell_signal::random::Random;
use std::f64::consts::TAU;

const FS: f64 = 12_000.0;

/// BPFO is Z times FTF: damage of the outer race says where the cage's lines are, and BPFI's second harmonic is sought
/// where BPFO's third lies (2 x 5.4152 and 3 x 3.5848 orders, 0.7 % apart).
#[test]
fn analytic_one_slip_for_cage_and_leading_race_and_no_line_of_it_is_the_others() {
    let mut taken = 0;
    for seed in 0..6 {
        let outer = Damage { order: 3.5848, modulation: 0.0, jitter: 0.005, snr_db: 3.0 };
        let inner = Damage { order: 5.4152, modulation: 1.0, jitter: 0.005, snr_db: -14.0 };
        // The same machine twice: its own lines and noise are taken off one.
        let weak: Vec<f64> =
            (damaged(FS, 4.0, seed, &inner).iter().zip(healthy(FS, 4.0, seed))).map(|(d, h)| d - h).collect();
        let x: Vec<f64> = damaged(FS, 4.0, seed, &outer).iter().zip(&weak).map(|(o, i)| o + i).collect();
        let a = look(&x, FS);
        let lead = a.causes().next().expect("damage");
        assert_eq!(lead.name, "BPFO", "{}", a.verdict());
        let of = |name| a.families.iter().find(|f| f.name == name).unwrap();
        // Half a bin of a segment of 120 turns, at the fifth harmonic.
        let resolved = 0.5 * a.shaft / 120.0 / (5.0 * of("FTF").expected);
        assert!((of("FTF").shift() - lead.shift()).abs() <= 1.05 * resolved, "{:?}", a.rows());
        for other in a.families.iter().filter(|f| !matches!(f.finding, Finding::Damage | Finding::Shared("BPFO"))) {
            let detected = other.harmonics.iter().filter(|h| h.detected);
            if let Some(highest) = detected.max_by(|a, b| a.snr_db.unwrap().total_cmp(&b.snr_db.unwrap())) {
                let times = (highest.frequency / lead.frequency).round();
                assert!((highest.frequency - times * lead.frequency).abs() > a.shaft / 60.0, "{:?}", a.rows());
            }
        }
        taken += usize::from(of("BPFI").finding == Finding::Shared("BPFO"));
    }
    println!("{taken} of 6");
    assert!(taken >= 1);
}

/// Tones below 5 kHz, and at 48 kHz one above what 12 kHz holds, ten times as high: nothing has grown where both look.
#[test]
fn analytic_levels_beside_a_healthy_record_are_of_the_range_that_both_hold() {
    let at = |fs: f64, high: f64| -> Vec<f64> {
        let tone = |f: f64, t: f64| (TAU * f * t + f).sin();
        let of = |t: f64| (1..40).map(|k| tone(123.7 * f64::from(k), t)).sum::<f64>() + high * tone(15_000.0, t);
        (0..(2.0 * fs) as usize).map(|i| of(i as f64 / fs)).collect()
    };
    let (fast, slow) = (at(48_000.0, 40.0), at(FS, 0.0));
    let (mut measured, other) = (look(&fast, 48_000.0), look(&slow, FS));
    let whole = |a: &brinell_signal::analysis::Analysis| a.indicator(Indicator::Rms).unwrap().value;
    assert!(whole(&measured) / whole(&other) > 5.0);
    measured.beside_healthy(&fast, Side { x: &slow, analysis: &other }).unwrap();
    assert!((measured.level_growth.unwrap() - 1.0).abs() < 0.01, "{:?}", measured.level_growth);
    let range = measured.level_range.unwrap();
    assert_eq!((range.low, range.high), (0.0, 6000.0));
    assert!(!measured.verdict().contains("times that of the healthy record"), "{}", measured.verdict());
    let c = compare(Side { x: &fast, analysis: &measured }, Side { x: &slow, analysis: &other }).unwrap();
    assert_eq!(c.range.map(|r| r.high), Some(6000.0));
    for wanted in [Indicator::Rms, Indicator::Peak] {
        let d = c.indicators.iter().find(|d| d.indicator == wanted).unwrap();
        assert!((d.first / d.second - 1.0).abs() < 0.03, "{d:?}");
    }
    // Of one rate they are of the whole.
    let twice = compare(Side { x: &slow, analysis: &other }, Side { x: &slow, analysis: &other }).unwrap();
    assert_eq!((twice.range.map(|r| r.high), twice.indicators[0].first), (None, whole(&other)));
}

/// Peak over RMS of a sine with one impact of nine times its amplitude.
#[test]
fn analytic_the_records_crest_factor_is_its_peak_over_its_rms() {
    let mut x: Vec<f64> = (0..24_000).map(|i| (TAU * 163.0 * f64::from(i) / FS).sin()).collect();
    x[7_000] = 9.0;
    let a = look(&x, FS);
    let expected = 9.0 / 0.5f64.sqrt();
    assert!((a.record_crest_factor().unwrap() / expected - 1.0).abs() < 0.01);
    // The mean of the revolutions' peaks hardly sees it.
    assert!(a.indicator(Indicator::CrestFactor).unwrap().value < 2.0);
}

/// Impacts whose fifth harmonic comes by a line of the shaft, order 18, which hides it in part.
#[test]
fn analytic_the_rate_of_impacts_is_right_where_a_harmonic_is_half_hidden() {
    for fifth in (0..12).map(|k| 17.95 + 0.01 * f64::from(k)) {
        let order = fifth / 5.0;
        let x = damaged(FS, 4.0, 3, &Damage { order: order / 0.995, modulation: 0.0, jitter: 0.0, snr_db: 0.0 });
        let a = look(&x, FS);
        let family = a.families.iter().find(|f| f.name == "BPFO").unwrap();
        let off = family.frequency / (order * SHAFT) - 1.0;
        assert!(off.abs() < 1e-4, "fifth harmonic {fifth}: {off:e}");
    }
}

/// Given 1 % off, revolutions are those of the speed that the signal's lines tell.
#[test]
fn analytic_indicators_are_of_the_speed_that_is_used() {
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    let x = damaged(FS, 4.0, 3, &Damage { order: 3.585, modulation: 1.0, jitter: 0.0, snr_db: 6.0 });
    let analyses = [1.0, 1.01].map(|given| analyze(&x, FS, &Options::new(given * SHAFT, orders)).unwrap());
    let [right, off] = &analyses;
    assert!((off.shaft / right.shaft - 1.0).abs() < 1e-3, "{} {}", off.shaft, right.shaft);
    for indicator in [Indicator::Peak, Indicator::PeakToPeak, Indicator::CrestFactor] {
        let [right, off] = analyses.each_ref().map(|a| a.indicator(indicator).unwrap().value);
        assert!((off / right - 1.0).abs() < 3e-3, "{indicator:?}: {off} {right}");
    }
}

/// Noise whose amplitude varies, at ten places from one bin of the envelope's spectrum to the next, 1/120 of the shaft's
/// speed apart. A Hann window's own reading falls by 15 % half way.
#[test]
fn analytic_modulation_is_the_same_on_a_bin_and_between_two() {
    let modulations: Vec<f64> = (0..10)
        .map(|k| {
            let order = 3.58 + f64::from(k) / 1200.0;
            let x: Vec<f64> = (healthy(FS, 16.0, 3).iter().enumerate())
                .map(|(i, x)| x * (1.0 + 0.5 * (TAU * order * SHAFT * i as f64 / FS).cos()))
                .collect();
            look(&x, FS).families.iter().find(|f| f.name == "BPFO").unwrap().modulation
        })
        .collect();
    // Half, but for what noise loses where one sideband of it lies in a band and the other beyond: 107 Hz of 920.
    let mean = modulations.iter().sum::<f64>() / 10.0;
    assert!((0.40..0.47).contains(&mean), "{modulations:?}");
    assert!(modulations.iter().all(|m| (m / mean - 1.0).abs() < 0.04), "{modulations:?}");
}

#[test]
fn prop_samples_that_were_not_analysed_are_refused() {
    let x = healthy(12_000.0, 1.0, 1);
    let a = look(&x, 12_000.0);
    let (whole, none) = (Side { x: &x, analysis: &a }, Side { x: &[], analysis: &a });
    assert!(compare(whole, none).is_err() && compare(none, whole).is_err());
    assert!(a.clone().beside_healthy(&[], whole).is_err() && a.clone().beside_healthy(&x, none).is_err());
}

/// Impacts at random times have no line. They and a level that has doubled leave the verdict open, unless the healthy
/// machine has them too or another bearing is damaged.
#[test]
fn prop_impacts_and_levels_that_no_line_explains_leave_the_verdict_open() {
    let struck = |seed: u64, height: f64| -> Vec<f64> {
        let mut random = Random::new(seed);
        let mut x = healthy(FS, 4.0, seed);
        for _ in 0..400 {
            let at = (random.uniform() * 47_900.0) as usize;
            for (k, v) in x[at..at + 60].iter_mut().enumerate() {
                *v += height * (-(k as f64) / 12.0).exp() * (1.6 * k as f64).sin();
            }
        }
        x
    };
    let of = |x: &[f64], before: Option<&[f64]>| {
        let mut a = look(x, FS);
        if let Some(before) = before {
            a.beside_healthy(x, Side { x: before, analysis: &look(before, FS) }).unwrap();
        }
        a
    };
    let (sound, impacts) = (healthy(FS, 4.0, 1), struck(2, 20.0));
    let mut a = of(&impacts, None);
    let kurtosis = a.indicator(Indicator::Kurtosis).unwrap().value;
    assert!(kurtosis > 6.0, "{kurtosis}");
    assert_eq!(a.conclusion(), Verdict::CannotTell);
    assert!(matches!(a.unexplained(), Some(Unexplained::Impacts(k, _)) if k >= kurtosis), "{:?}", a.unexplained());
    // Unbalance that hides them from the kurtosis of the whole record does not hide them.
    let unbalance = |(i, x): (usize, &f64)| x + 50.0 * (std::f64::consts::TAU * SHAFT * i as f64 / FS).sin();
    let hidden: Vec<f64> = impacts.iter().enumerate().map(unbalance).collect();
    let hidden = of(&hidden, None);
    assert!(hidden.indicator(Indicator::Kurtosis).unwrap().value < 2.0);
    assert!(matches!(hidden.unexplained(), Some(Unexplained::Impacts(k, Some(_))) if k > 6.0), "{}", hidden.verdict());
    assert!(a.verdict().starts_with("Cannot tell: the record has impacts (kurtosis "), "{}", a.verdict());
    a.beside_damage = true;
    assert_eq!(a.conclusion(), Verdict::NothingFound, "{}", a.verdict());
    let beside = of(&impacts, Some(&sound));
    assert_eq!(beside.conclusion(), Verdict::CannotTell, "{}", beside.verdict());
    assert!(beside.verdict().contains(" in the healthy record) that no line"), "{}", beside.verdict());
    // The healthy machine has them too; the level has not doubled; it has.
    for (x, before, expected) in [
        (&impacts, &struck(3, 18.0), None),
        (&sound.iter().map(|v| 1.9 * v).collect(), &healthy(FS, 4.0, 4), None),
        (&sound.iter().map(|v| 2.1 * v).collect(), &healthy(FS, 4.0, 4), Some("level")),
    ] {
        let a = of(x, Some(before));
        assert_eq!(a.unexplained().map(Unexplained::key), expected, "{}", a.verdict());
        let open = if expected.is_some() { Verdict::CannotTell } else { Verdict::NothingFound };
        assert_eq!(a.conclusion(), open, "{}", a.verdict());
    }
}
