//! The interval of the frequency that an analysis found, on made-up signals whose impacts are counted.

use crate::analysis::{Damage, SHAFT, damaged, look};
use crate::cases::CASES;
use brinell_signal::analysis::{NamedBearing, Options, analyze_records};
use brinell_signal::random::Random;

/// Mean rate of the impacts of [`damaged`], Hz.
fn mean_rate(seconds: f64, seed: u64, d: &Damage) -> f64 {
    let mut noise = Random::new(seed + 900);
    let period = 1.0 / (d.order * SHAFT * 0.995);
    let mut strikes = vec![noise.uniform() * period];
    while strikes[strikes.len() - 1] < seconds {
        noise.normal();
        strikes.push(strikes[strikes.len() - 1] + period * (1.0 + 0.1 * d.jitter * noise.normal()));
    }
    (strikes.len() - 1) as f64 / (strikes[strikes.len() - 1] - strikes[0])
}

/// The number and its interval are of one quantity: the mean rate of the impacts, which is known here.
#[test]
fn analytic_the_interval_of_a_frequency_holds_the_mean_rate_of_impacts() {
    let (mut held, mut all) = (0_usize, 0);
    for (_, order, modulation) in CASES {
        for (seconds, snr_db, jitter) in [(1.0, -3.0, 0.01), (2.0, -3.0, 0.02), (5.0, -6.0, 0.02)] {
            for seed in 0..6 {
                let damage = Damage { order, modulation, jitter, snr_db };
                let rate = mean_rate(seconds, seed, &damage);
                let a = look(&damaged(12_000.0, seconds, seed, &damage), 12_000.0);
                let Some(family) = a.causes().next() else { continue };
                let interval = family.interval.unwrap();
                let words =
                    format!("{:.2} Hz (95 %: {:.2} to {:.2} Hz; ", family.frequency, interval.low, interval.high);
                assert!(a.verdict().contains(&words), "{words} in {}", a.verdict());
                assert!(interval.low < family.frequency && family.frequency < interval.high);
                // Far narrower than the tolerance of 2 % within which it was sought.
                assert!(interval.high - interval.low < 0.004 * rate, "{words}");
                held += usize::from(interval.low < rate && rate < interval.high);
                all += 1;
            }
        }
    }
    assert!(all >= 40 && held as f64 >= 0.95 * f64::from(all), "{held} of {all}");
    // Several records have no one rate.
    let damage = Damage { order: 3.5848, modulation: 0.0, jitter: 0.01, snr_db: 0.0 };
    let two = [1, 2].map(|seed| damaged(12_000.0, 2.0, seed, &damage));
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    let several =
        analyze_records(&[(&two[0], SHAFT), (&two[1], SHAFT)], 12_000.0, &Options::new(SHAFT, orders)).unwrap();
    assert_eq!(several.causes().next().unwrap().interval, None);
    assert!(!several.verdict().contains("95 %"), "{}", several.verdict());
}
