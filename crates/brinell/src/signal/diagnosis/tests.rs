//! Known damage, and none.

use std::f64::consts::TAU;

use super::super::envelope::{Band, envelope_spectrum};
use super::super::psd::{Segments, psd};
use super::super::test_signals::{ImpactTrain, Noise, cosine};
use super::*;

const FS: f64 = 25_600.0;
const N: usize = 131_072;
const SHAFT: f64 = 29.95;
const FTF: f64 = 11.9;

/// Nine rollers, pure rolling with 1 % of slip either way.
fn candidates() -> Vec<Candidate> {
    [
        ("BPFO", 107.3, None),
        ("BPFI", 162.2, Some(SHAFT)),
        ("2 BSF", 141.2, Some(FTF)),
        ("BSF", 70.6, Some(FTF)),
        ("FTF", FTF, None),
    ]
    .map(|(name, frequency, sideband_spacing)| Candidate {
        name: name.to_owned(),
        frequency,
        tolerance: 0.01 * frequency,
        sideband_spacing,
    })
    .to_vec()
}

/// Impacts at `rate` whose height follows 1 + cos at `modulation` Hz, in noise.
fn impacts(rate: f64, modulation: f64, noise: f64, seed: u64) -> Vec<f64> {
    let train = ImpactTrain {
        fs: FS,
        rate,
        jitter: 0.003,
        resonance: 5000.0,
        decay: 4e-4,
        noise: 0.0,
    };
    let mut random = Noise::new(seed + 500);
    (train.generate(N, seed).iter().enumerate())
        .map(|(i, x)| {
            let phase = TAU * modulation * i as f64 / FS;
            x * 0.5 * (1.0 + phase.cos()) + noise * random.normal()
        })
        .collect()
}

fn diagnosis(x: &[f64], segment: usize, level: f64) -> Diagnosis {
    let band = Band::between(3500.0, 6500.0);
    let s = envelope_spectrum(x, FS, band, &Segments::of(segment)).unwrap();
    let options = DiagnosisOptions {
        level,
        ..DiagnosisOptions::default()
    };
    diagnose(&s.spectrum, &candidates(), &options).unwrap()
}

fn causes(d: &Diagnosis) -> Vec<usize> {
    d.causes().map(|e| e.candidate).collect()
}

#[test]
fn prop_outer_race_damage_is_found() {
    for seed in 0..10 {
        // Half a per cent of slip; the impacts stand out of the noise in no waveform.
        let d = diagnosis(&impacts(106.8, 0.0, 0.5, seed), 32_768, 0.01);
        assert_eq!(causes(&d), [0], "{seed}");
        let e = &d.evidence[0];
        assert!((e.frequency - 106.8).abs() < 0.1, "{}", e.frequency);
        assert!(e.false_alarm < 1e-6 && e.standing >= 3);
        assert!(e.alternatives.is_empty() && e.sidebands.is_none());
    }
}

/// A comb's skirts reach two bins; what counts is where its peaks are.
#[test]
fn prop_a_comb_stands_within_the_tolerance_and_its_skirts_do_not() {
    let segments = Segments::of(32_768);
    let (expected, tolerance, step) = (107.3, 0.01 * 107.3, FS / 32_768.0);
    for seed in 0..10 {
        for (beyond, stands) in [(-0.5, true), (1.5, false)] {
            let mut noise = Noise::new(seed);
            let comb = expected + tolerance + beyond * step;
            let lines: Vec<Vec<f64>> = (1..=3)
                .map(|h| cosine(N, FS, f64::from(h) * comb, 1.0, f64::from(h)))
                .collect();
            let x: Vec<f64> = (0..N)
                .map(|i| lines.iter().map(|l| l[i]).sum::<f64>() + 3.0 * noise.normal())
                .collect();
            let s = psd(&x, FS, &segments).unwrap();
            let d = diagnose(&s, &candidates(), &DiagnosisOptions::default()).unwrap();
            assert_eq!(d.evidence[0].stands, stands, "{seed}: {:?}", d.evidence[0]);
        }
    }
}

#[test]
fn prop_inner_race_damage_is_found_with_its_sidebands() {
    for seed in 0..10 {
        let d = diagnosis(&impacts(162.9, SHAFT, 0.3, seed), 32_768, 0.01);
        assert_eq!(causes(&d), [1], "{seed}");
        let e = &d.evidence[1];
        assert!((e.frequency - 162.9).abs() < 0.1, "{}", e.frequency);
        let sidebands = e.sidebands.as_ref().unwrap();
        assert!(sidebands.false_alarm < 1e-6 && sidebands.standing >= 4);
    }
}

#[test]
fn prop_roller_damage_is_found_with_cage_sidebands() {
    for seed in 0..10 {
        let d = diagnosis(&impacts(140.7, FTF, 0.3, seed), 32_768, 0.01);
        assert_eq!(causes(&d)[0], 2, "{seed} {:?}", d.ranking);
        let sidebands = d.evidence[2].sidebands.as_ref().unwrap();
        assert!(sidebands.false_alarm < 1e-6 && sidebands.standing >= 4);
        // Its lines are the even harmonics of BSF, which adds nothing.
        let bsf = &d.evidence[3];
        if bsf.stands {
            assert_eq!(bsf.explained_by, [2]);
            assert!(bsf.alternatives.iter().any(|(other, _)| *other == 2));
        }
    }
}

#[test]
fn analytic_false_alarms_stay_below_the_level() {
    let level = 0.05;
    for segment in [4096, N] {
        let (mut said, mut bound) = (0, 0);
        for seed in 0..200 {
            let x = Noise::new(9000 + seed).normals(N / 2);
            let d = diagnosis(&x, segment, level);
            said += usize::from(!d.nothing_stands_out());
            bound += usize::from(d.evidence.iter().any(|e| e.false_alarm <= level));
        }
        println!("segments of {segment}: {said} of 200 said to stand, {bound} within the bound");
        // 5 % of 200 is 10, and 3 standard deviations of that count 9.
        assert!(said <= bound && bound <= 19, "{segment}: {bound} of 200");
    }
}

#[test]
fn prop_a_single_line_is_not_a_family() {
    // A tone that modulates the noise at exactly BPFO: strong, and alone.
    let mut x = Noise::new(4).normals(N);
    (x.iter_mut().zip(cosine(N, FS, 107.3, 0.3, 0.0))).for_each(|(x, m)| *x *= 1.0 + m);
    let d = diagnosis(&x, 16_384, 0.01);
    assert!(d.nothing_stands_out());
    assert!(d.evidence[0].harmonics.lines[0].false_alarm < 1e-9);
}

#[test]
fn prop_odd_input() {
    let x = Noise::new(5).normals(4096);
    let s = super::super::psd::psd(&x, FS, &Segments::of(1024)).unwrap();
    let options = DiagnosisOptions::default();
    assert!(diagnose(&s, &[], &options).unwrap().nothing_stands_out());
    let candidate = |frequency, tolerance| Candidate {
        name: String::new(),
        frequency,
        tolerance,
        sideband_spacing: Some(0.01),
    };
    for (f, t) in [
        (-1.0, 0.0),
        (f64::NAN, 0.0),
        (100.0, 51.0),
        (100.0, f64::NAN),
    ] {
        assert!(diagnose(&s, &[candidate(f, t)], &options).is_err());
    }
    let beyond = diagnose(&s, &[candidate(1e5, 1.0)], &options).unwrap();
    assert_eq!(beyond.evidence[0].false_alarm, 1.0);
    assert!(
        diagnose(
            &s,
            &[],
            &DiagnosisOptions {
                level: 0.0,
                ..options
            }
        )
        .is_err()
    );
    assert!(
        diagnose(
            &s,
            &[],
            &DiagnosisOptions {
                harmonics: 1,
                ..options
            }
        )
        .is_err()
    );
}

#[test]
fn prop_what_one_accounts_for_can_be_taken_away() {
    // Outer and inner race at once, in one band.
    let mut x = impacts(106.8, 0.0, 0.3, 3);
    (x.iter_mut().zip(impacts(162.9, SHAFT, 0.3, 4))).for_each(|(a, b)| *a += b);
    let band = Band::between(3500.0, 6500.0);
    let s = envelope_spectrum(&x, FS, band, &Segments::of(32_768)).unwrap();
    let options = DiagnosisOptions::default();
    let before = diagnose(&s.spectrum, &candidates(), &options).unwrap();
    assert!(before.evidence[0].stands && before.evidence[1].stands);
    let left = without(&s.spectrum, before.evidence[0].frequency, &[]).unwrap();
    let after = diagnose(&left, &candidates(), &options).unwrap();
    assert!(!after.evidence[0].stands && after.evidence[1].stands);
    assert!(
        (left.amplitude.iter().zip(&s.spectrum.amplitude)).all(|(a, b)| a <= b),
        "nothing is added"
    );
    assert!(without(&s.spectrum, 0.0, &[]).is_err());
}

#[test]
fn prop_an_element_whose_places_are_anothers_shows_by_its_sidebands() {
    // As where 2 BSF is four times the shaft's frequency, whose lines were taken out.
    let (rate, band) = (140.7, Band::between(3500.0, 6500.0));
    let options = DiagnosisOptions::default();
    let aside: Vec<f64> = (1..=10).map(|h| f64::from(h) * rate).collect();
    for seed in 0..10 {
        let x = impacts(rate, FTF, 0.3, seed);
        let s = envelope_spectrum(&x, FS, band, &Segments::of(32_768)).unwrap();
        let left = without(&s.spectrum, rate, &[]).unwrap();
        assert!(!diagnose(&left, &candidates(), &options).unwrap().evidence[2].stands);
        let told = diagnose_beside(&left, &candidates(), &options, &aside).unwrap();
        assert_eq!(causes(&told)[0], 2, "{seed} {:?}", told.ranking);
        let e = &told.evidence[2];
        assert!(e.standing == 0 && e.carried.len() >= 2, "{:?}", e.carried);
        assert!(e.modulation() > 0.0 && (e.frequency - rate).abs() < 1.0);
        // Sidebands say nothing of a carrier that could be seen, and is not there.
        let elsewhere = [7.0, 13.0];
        let told = diagnose_beside(&left, &candidates(), &options, &elsewhere).unwrap();
        assert!(!told.evidence[2].stands);
    }
    for seed in 0..50 {
        let x = Noise::new(700 + seed).normals(N);
        let s = envelope_spectrum(&x, FS, band, &Segments::of(32_768)).unwrap();
        let told = diagnose_beside(&s.spectrum, &candidates(), &options, &aside).unwrap();
        assert!(told.nothing_stands_out(), "{seed}");
    }
}
