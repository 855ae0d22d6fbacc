//! Rates that are known, in jitter and noise.

use super::super::test_signals::{ImpactTrain, Noise, close, cosine};
use super::super::{Band, StreamSpectra, line_frequency};
use super::*;

const FS: f64 = 25_600.0;

/// Half a second of impacts as from a raceway defect of the NN3007 at 1800 r/min.
fn train(rate: f64, jitter: f64, noise: f64) -> ImpactTrain {
    ImpactTrain { fs: FS, rate, jitter, resonance: 4000.0, decay: 6e-4, noise }
}

const BAND: Band = Band { low: 2000.0, high: f64::INFINITY };

fn search() -> LineSearch {
    LineSearch::new(250.102)
}

fn tracked(x: &[f64], length: usize) -> Option<LineFrequency> {
    StreamSpectra::of(x, FS, length, BAND, &[search()]).lines[0]
}

#[test]
fn analytic_clean_train() {
    for rate in [246.31, 249.6, 250.102, 254.7] {
        let found = line_frequency(&train(rate, 0.0, 0.0).generate(12_800, 1), FS, BAND, &search()).unwrap();
        assert!((found.frequency - rate).abs() < 5e-3, "{rate}: {found:?}");
        assert_eq!(found.resolution, 4.0);
    }
}

#[test]
fn analytic_half_a_second_with_jitter_and_noise_is_good_to_a_fifth_of_a_percent() {
    // 1 % of a period of timing error and noise of a third of the signal's RMS.
    let mut worst: f64 = 0.0;
    for (i, rate) in [248.0, 249.6, 250.39, 252.0].into_iter().enumerate() {
        for seed in 0..25 {
            let x = train(rate, 0.01, 0.1).generate(12_800, 100 * i as u64 + seed);
            let found = line_frequency(&x, FS, BAND, &search()).unwrap();
            worst = worst.max((found.frequency / rate - 1.0).abs());
        }
    }
    assert!(worst < 2e-3, "{worst}");
}

#[test]
fn analytic_uncertainty_is_the_scatter() {
    for (jitter, noise) in [(0.0, 0.3), (0.02, 0.05), (0.01, 0.3)] {
        let (mut scores, trials) = (Moments::new(), 300);
        for seed in 0..trials {
            let x = train(249.6, jitter, noise).generate(12_800, 7000 + seed);
            let found = line_frequency(&x, FS, BAND, &search()).unwrap();
            scores.push((found.frequency - 249.6) / found.uncertainty);
        }
        let rms = scores.rms();
        assert!((0.75..1.33).contains(&rms), "jitter {jitter}, noise {noise}: {rms}");
    }
}

#[test]
fn analytic_variance_of_one_line_follows_the_formula() {
    // One harmonic of an amplitude-modulated carrier in white noise.
    let (n, trials) = (6400, 300);
    let band = Band::between(5000.0, 7000.0);
    let mut one = LineSearch::new(250.0);
    one.harmonics = 1;
    let mut noise = Noise::new(21);
    let carrier = cosine(n, FS, 6000.0, 1.0, 0.0);
    let modulation = cosine(n, FS, 250.0, 0.5, 1.0);
    let (mut errors, mut predicted) = (Moments::new(), Moments::new());
    for _ in 0..trials {
        let x: Vec<f64> = (0..n).map(|i| carrier[i] * (1.0 + modulation[i]) + 0.5 * noise.normal()).collect();
        let found = line_frequency(&x, FS, band, &one).unwrap();
        errors.push(found.frequency - 250.0);
        predicted.push(found.uncertainty);
    }
    let ratio = errors.rms() / predicted.rms();
    assert!((0.8..1.25).contains(&ratio), "{ratio}");
}

#[test]
fn prop_noise_alone_shows_no_line() {
    let mut alarms = 0;
    for seed in 0..600 {
        let x = Noise::new(9000 + seed).normals(12_800);
        alarms += u32::from(line_frequency(&x, FS, BAND, &search()).is_some());
    }
    assert!(alarms <= 1, "{alarms} of 600");
}

#[test]
fn prop_line_outside_the_range_is_not_found_at_its_edge() {
    let mut narrow = search();
    narrow.tolerance = 0.004;
    let found = line_frequency(&train(252.5, 0.0, 0.05).generate(12_800, 3), FS, BAND, &narrow);
    assert_eq!(found, None);
    narrow.tolerance = 0.012;
    assert!(line_frequency(&train(252.5, 0.0, 0.05).generate(12_800, 3), FS, BAND, &narrow).is_some());
}

/// Another train's harmonic within the range of one of the comb's: 9 x 139 Hz beside 5 x 250.102 Hz.
#[test]
fn prop_one_harmonic_of_another_train_is_no_comb() {
    for seed in 0..20 {
        let x = train(139.0, 0.0, 0.1).generate(25_600, 4000 + seed);
        assert_eq!(line_frequency(&x, FS, BAND, &search()), None, "{seed}");
    }
}

/// Trains of which every second or third harmonic of the comb is one: at 2/3, 3/2, 1/3 and half of that rate.
#[test]
fn prop_a_fraction_of_another_trains_rate_is_no_comb() {
    for (rate, shares) in [(249.6, [2.0 / 3.0, 1.5, 0.5, 1.0 / 3.0]), (161.2, [2.0 / 3.0, 1.5, 0.5, 1.0 / 3.0])] {
        for (share, off, seconds) in shares.into_iter().flat_map(|share| [(share, 1.002, 2), (share, 0.985, 5)]) {
            let search = LineSearch::new(off * share * rate);
            let x = train(rate, 0.0, 0.1).generate(seconds * 25_600, 77);
            assert_eq!(line_frequency(&x, FS, BAND, &search), None, "{share} of {rate}");
        }
    }
}

/// A 6205's inner race with the shaft's sidebands has every third line of a comb near its outer race's frequency.
#[test]
fn prop_a_modulated_train_is_no_comb_at_two_thirds_of_its_rate() {
    let (shaft, rate) = (29.95, 5.4152 * 29.95);
    for seconds in [0.7, 1.0, 2.0] {
        let mut x = train(rate, 0.0, 0.1).generate((seconds * FS) as usize, 78);
        for (i, x) in x.iter_mut().enumerate() {
            *x *= 1.0 + 0.8 * (TAU * shaft * i as f64 / FS).cos();
        }
        assert_eq!(line_frequency(&x, FS, BAND, &LineSearch::new(3.5848 * shaft)), None, "{seconds} s");
    }
}

/// A second of impacts, every second one `low` times as high as the others, late by a share of their period that swings
/// so often a second.
fn high_and_low(rate: f64, (low, noise): (f64, f64), (late, swings): (f64, f64), seed: u64) -> Vec<f64> {
    let n = FS as usize;
    let mut random = Noise::new(seed);
    let mut x: Vec<f64> = (0..n).map(|_| noise * random.normal()).collect();
    for k in 0..(2.0 * rate) as usize {
        let (at, height) = (k as f64 / (2.0 * rate), if k % 2 == 0 { 1.0 } else { low });
        let at = at + late / rate * (1.0 + (TAU * swings * at).sin());
        for i in (at * FS).ceil() as usize..((at + 4e-3) * FS).min(n as f64) as usize {
            let since = i as f64 / FS - at;
            x[i] += height * (-since / 6e-4).exp() * (TAU * 4000.0 * since).sin();
        }
    }
    x
}

/// Every second impact is nearly as high: the second harmonic dominates.
#[test]
fn prop_a_train_of_high_and_low_impacts_is_a_comb() {
    let rate = 200.3;
    for (low, noise) in [(0.95, 0.0), (0.8, 0.1), (0.5, 0.2)] {
        let found = (0..20).filter(|seed| {
            let x = high_and_low(rate, (low, noise), (0.0, 1.0), 600 + seed);
            let search = LineSearch { harmonics: 2, ..LineSearch::new(200.0) };
            line_frequency(&x, FS, BAND, &search).is_some_and(|line| (line.frequency / rate - 1.0).abs() < 1e-3)
        });
        assert!(found.count() >= 19, "{low} {noise}");
    }
}

/// A cage that whirls: the second harmonic dominates and has lobes instead of a line, halfway to which the odd ones have
/// none.
#[test]
fn prop_a_rate_that_swings_is_a_comb() {
    // No line at twice the mean rate: the zero of J0.
    let late = 2.4048 / (2.0 * TAU);
    for (low, swings) in [(0.9, 5.0), (0.8, 5.0), (0.8, 7.0)] {
        let x = high_and_low(246.9, (low, 0.05), (late, swings), 5);
        let found = line_frequency(&x, FS, BAND, &LineSearch::new(250.1));
        close(found.map(|found| found.frequency), 246.9, 0.02);
    }
}

#[test]
fn prop_a_dead_sensor_shows_no_line() {
    for (i, value) in [0.1, 1.0, 2.5, 9.81, -0.03].into_iter().enumerate() {
        for n in [12_800, 12_801, 24_000, 32_768] {
            let x = vec![value; n];
            assert_eq!(line_frequency(&x, FS, BAND, &search()), None, "{value}, {n}");
            assert_eq!(tracked(&x, 10_000 + i), None, "{value}, {n}");
        }
    }
}

#[test]
fn prop_a_range_beyond_half_the_sampling_rate_does_not_fit() {
    let wide = LineSearch { nominal: 9900.0, tolerance: 0.3, harmonics: 8 };
    assert_eq!(line_frequency(&Noise::new(1).normals(12_800), FS, BAND, &wide), None);
}

#[test]
fn prop_too_short_a_record_is_refused() {
    let x = train(250.0, 0.0, 0.0).generate(2457, 1);
    assert_eq!(line_frequency(&x[..2456], FS, BAND, &search()), None);
    assert!(line_frequency(&x, FS, BAND, &search()).is_some());
    assert_eq!(line_frequency(&[], FS, BAND, &search()), None);
}

#[test]
fn analytic_tracker_averages_a_long_run() {
    let rate = 249.6;
    let x = train(rate, 0.01, 0.3).generate(256_000, 5);
    let found = tracked(&x, 16_384).unwrap();
    assert!(found.uncertainty < 0.03, "{found:?}");
    assert!((found.frequency - rate).abs() < 3.0 * found.uncertainty, "{found:?}");
}

#[test]
fn analytic_tracker_owns_its_interpolation_error() {
    // Exactly periodic: all segments agree to round-off, so their scatter says nothing.
    let one = |i| (-0.05 * f64::from(i % 103)).exp() * f64::from(i % 103 % 7);
    let x: Vec<f64> = (0..131_072).map(one).collect();
    let found = tracked(&x, 16_384).unwrap();
    let error = (found.frequency - FS / 103.0).abs();
    assert!(found.uncertainty < 2e-3 && error < found.uncertainty, "{found:?} {error}");
}

#[test]
fn prop_tracker_takes_a_short_run_whole() {
    let x = train(249.6, 0.01, 0.1).generate(12_801, 5);
    let found = tracked(&x, 65_536);
    assert!(found.is_some());
    assert_eq!(found, line_frequency(&x, FS, BAND, &search()));
}
