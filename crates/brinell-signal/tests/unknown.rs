//! A bearing that nobody knows: its race's comb is found at any frequency.

use crate::analysis::{Damage, SHAFT, damaged, healthy};
use crate::cases::CASES;
use brinell_signal::analysis::{Analysis, DefectOrders, Options, Verdict, analyze};
use brinell_signal::random::Random;

fn look(x: &[f64], fs: f64) -> Analysis {
    analyze(x, fs, &Options::new(SHAFT, DefectOrders::default())).unwrap()
}

#[test]
fn prop_without_a_bearing_the_comb_is_the_races() {
    for (k, fs) in [12_000.0, 25_600.0, 48_000.0].into_iter().enumerate() {
        for (component, order, modulation) in CASES.into_iter().take(2) {
            let damage = Damage { order, modulation, jitter: 0.005, snr_db: 3.0 };
            let told = look(&damaged(fs, 4.0, k as u64, &damage), fs);
            let comb = told.elsewhere.unwrap_or_else(|| panic!("{component:?} at {fs} Hz: {}", told.verdict()));
            // Half a per cent of slip.
            let off = comb.frequency / (0.995 * order * SHAFT) - 1.0;
            assert!(off.abs() < 2e-3, "{component:?} at {fs} Hz: {off}");
            assert_eq!(told.conclusion(), Verdict::CannotTell);
            assert!(told.verdict().starts_with("Cannot tell which part: no bearing is given."), "{}", told.verdict());
            assert!(told.families.is_empty());
        }
    }
}

#[test]
fn prop_without_a_bearing_healthy_rigs_and_noise_have_no_comb() {
    let (mut rigs, mut noise) = (0, 0);
    for seed in 0..40 {
        let fs = [12_000.0, 25_600.0][seed as usize % 2];
        let told = look(&healthy(fs, 2.0, seed), fs);
        assert_eq!(told.conclusion(), Verdict::CannotTell);
        rigs += usize::from(told.elsewhere.is_some());
        let mut random = Random::new(seed + 40);
        let white: Vec<f64> = (0..24_000).map(|_| random.normal()).collect();
        noise += usize::from(look(&white, 12_000.0).elsewhere.is_some());
    }
    println!("of 40 each: healthy rigs {rigs}, noise {noise}");
    // Of ten thousand places one may be as high by chance: 2 of 40, 5 %.
    assert!(rigs <= 2 && noise <= 2, "of 40 each: healthy rigs {rigs}, noise {noise}");
}
