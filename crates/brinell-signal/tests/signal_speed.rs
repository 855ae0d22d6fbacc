//! A full analysis of ten seconds at 51.2 kHz takes less than a second on one core.
//!
//! `cargo test --release -p brinell-signal --test all signal_speed:: -- --ignored --nocapture` prints what each part
//! takes.

use crate::analysis::{Damage, damaged, look};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

use brinell_signal::velocity_bands::NOMINAL;
use brinell_signal::{
    Blocks, Indicator, Rotation, Segments, decimate, envelope_spectrum, kurtogram, psd, resample, spectrogram,
    velocity_bands,
};

const FS: f64 = 51_200.0;
const SHAFT: f64 = 30.0;

struct Clock {
    start: Instant,
    total: Duration,
}

impl Clock {
    fn lap(&mut self, what: &str) {
        let taken = self.start.elapsed();
        println!("{what:>24}: {:6.1} ms", 1e3 * taken.as_secs_f64());
        self.total += taken;
        self.start = Instant::now();
    }
}

/// Impacts at 250 Hz, each with an exit 1 ms later, ringing at 9 kHz in noise.
fn signal() -> Vec<f64> {
    let mut state = 1u64;
    (0..512_000)
        .map(|i| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let noise = (state >> 40) as f64 / (1u64 << 24) as f64 - 0.5;
            let ring = |since: f64| {
                if since < 0.0 {
                    return 0.0;
                }
                (-since / 1e-4).exp() * (TAU * 9000.0 * since).sin()
            };
            let since = (i as f64 / FS) % (1.0 / 250.0);
            ring(since) + 0.7 * ring(since - 1e-3) + 0.3 * noise
        })
        .collect()
}

#[test]
#[ignore = "a time, which means something in a release build on a quiet machine"]
fn prop_full_analysis_takes_less_than_a_second() {
    let x = signal();
    let mut clock = Clock { start: Instant::now(), total: Duration::ZERO };
    let blocks = Blocks::of(&x, FS / SHAFT);
    assert!(blocks.estimate(Indicator::Kurtosis).is_some());
    clock.lap("indicators");
    psd(&x, FS, &Segments::of(8192)).unwrap();
    clock.lap("spectrum and density");
    spectrogram(&x, FS, &Segments::of(1024)).unwrap();
    clock.lap("spectrogram");
    let map = kurtogram(&x, FS, 7).unwrap();
    clock.lap("kurtogram");
    let band = map.best(1500.0).unwrap().band;
    envelope_spectrum(&x, FS, band, &Segments::of(131_072)).unwrap();
    clock.lap("envelope spectrum");
    velocity_bands(&x, FS, &NOMINAL, 1.0 / SHAFT).unwrap();
    clock.lap("velocity in three bands");
    decimate(&x, 4).unwrap();
    clock.lap("decimation by 4");
    let rotation = Rotation::from_speeds(&[(0.0, 28.0), (10.0, 32.0)]).unwrap();
    let angular = resample(&x, FS, &rotation, 1024).unwrap();
    psd(&angular.values, angular.samples_per_revolution, &Segments::of(32_768)).unwrap();
    clock.lap("order spectrum");
    println!("{:>24}: {:6.1} ms", "all", 1e3 * clock.total.as_secs_f64());
    assert!(clock.total < Duration::from_secs(1));
}

#[test]
#[ignore = "a time, which means something in a release build on a quiet machine"]
fn prop_a_verdict_on_ten_seconds_takes_less_than_one() {
    let damage = Damage { order: 3.5848, modulation: 0.0, jitter: 0.01, snr_db: -5.0 };
    let x = damaged(FS, 10.0, 1, &damage);
    let start = Instant::now();
    let a = look(&x, FS);
    println!("{:?}: {}", start.elapsed(), a.verdict());
    assert!(start.elapsed().as_secs_f64() < 1.0);
}
