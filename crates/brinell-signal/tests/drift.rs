//! A shaft whose speed drifts during the record: noticed by its own lines or a defect's, followed where that tells
//! more, and nothing made up where it is steady.

use crate::cases::{CASES, first};
use brinell_signal::Rotation;
use brinell_signal::analysis::{Analysis, NamedBearing, Options, Verdict, analyze};
use brinell_signal::random::Random;
use std::f64::consts::TAU;

const FS: f64 = 12_000.0;
const SHAFT: f64 = 27.3;

/// A rig whose speed rises by `ramp` from the first sample to the last, relative: harmonics of the shaft where `lines`,
/// mains, and white noise of unit RMS; impacts of `order` where there are some, turning through the load at
/// `modulation` orders, `snr_db` over the noise.
struct Rig {
    seconds: f64,
    ramp: f64,
    lines: bool,
    strikes: Option<(f64, f64, f64)>,
}

impl Rig {
    /// Speed at a time, over the mean.
    fn speed(&self, t: f64) -> f64 {
        1.0 + self.ramp * (t / self.seconds - 0.5)
    }

    /// Revolutions since the first sample.
    fn angle(&self, t: f64) -> f64 {
        SHAFT * t * (1.0 + 0.5 * self.ramp * (t / self.seconds - 1.0))
    }

    fn signal(&self, seed: u64) -> Vec<f64> {
        let mut noise = Random::new(seed.wrapping_mul(77) + 5);
        let phases: Vec<f64> = (0..12).map(|_| TAU * noise.uniform()).collect();
        let n = (FS * self.seconds) as usize;
        let mut x = vec![0.0; n];
        if let Some((order, modulation, snr_db)) = self.strikes {
            let mut strike = noise.uniform() / order;
            while strike < self.angle(self.seconds) {
                let at_angle = strike + 0.01 / order * noise.normal();
                let height = match modulation {
                    0.0 => 1.0,
                    m => (0.5 + 0.5 * (TAU * m * at_angle).cos()).max(0.0),
                };
                // When the shaft is there, by Newton's method.
                let mut at = at_angle / SHAFT;
                for _ in 0..8 {
                    at -= (self.angle(at) - at_angle) / (SHAFT * self.speed(at));
                }
                let first = (at * FS).ceil().max(0.0) as usize;
                for (i, value) in x.iter_mut().enumerate().skip(first).take(72) {
                    let since = i as f64 / FS - at;
                    *value += height * (-since / 8e-4).exp() * (TAU * 3000.0 * since).sin();
                }
                // Half a per cent of slip, which wanders.
                strike += (1.005 + 1e-3 * noise.normal()) / order;
            }
            let rms = (x.iter().map(|v| v * v).sum::<f64>() / n as f64).sqrt();
            x.iter_mut().for_each(|v| *v *= 10f64.powf(snr_db / 20.0) / rms);
        }
        for (i, value) in x.iter_mut().enumerate() {
            let t = i as f64 / FS;
            let turn = TAU * self.angle(t);
            if self.lines {
                let line = |k: usize| 0.5 / k as f64 * (k as f64 * turn + phases[k]).sin();
                *value += (1..=6).map(line).sum::<f64>();
            }
            for (f, p) in [50.0, 100.0, 150.0].iter().zip(&phases) {
                *value += 0.2 * (TAU * f * t + p).sin();
            }
            *value += (1.0 + 0.1 * turn.sin()) * noise.normal();
        }
        x
    }
}

fn look(x: &[f64]) -> Analysis {
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    analyze(x, FS, &Options::new(SHAFT, orders)).unwrap()
}

/// How far the course strays from the truth, relative, RMS; the mean left out where a defect's lines told it.
fn stray(analysis: &Analysis, rig: &Rig) -> f64 {
    let drift = analysis.drift.as_ref().unwrap();
    let off = drift.course.iter().map(|(t, hz)| (hz / (SHAFT * rig.speed(*t)) - 1.0).powi(2));
    (off.sum::<f64>() / drift.course.len() as f64).sqrt()
}

#[test]
fn prop_a_drift_is_found_from_the_shafts_lines() {
    let mut unfollowed = 0;
    for ramp in [0.02, -0.02, 0.05, -0.05] {
        for seed in 0..2 {
            let rig = Rig { seconds: 4.0, ramp, lines: true, strikes: None };
            let a = look(&rig.signal(seed));
            let drift = a.drift.as_ref().expect("a drift");
            println!("{ramp} {seed}: {} stray {:.5}", drift.words(), stray(&a, &rig));
            assert_eq!(drift.by, "shaft");
            assert!(stray(&a, &rig) < 2e-3);
            let (low, high) = (drift.lowest(), drift.highest());
            assert_eq!(low.0 < high.0, ramp > 0.0);
            assert_eq!(first(&a), None, "{}", a.verdict());
            // Lines of order 10 smear over far more than the four bins of a steady one.
            if !drift.followed {
                unfollowed += 1;
                assert_eq!(a.conclusion(), Verdict::CannotTell, "{}", a.verdict());
                assert!(a.verdict().contains("A record of the speed would tell."), "{}", a.verdict());
            }
        }
    }
    println!("{unfollowed} of 8 not followed");
    assert!(unfollowed > 0);
}

/// Damage that smears until it is not named, or another part is, is named where the drift is followed: by the shaft's
/// lines where they are significant, and by the damage's own where they do not. At a steady rotation, which is what is
/// done without, most of it is lost.
#[test]
fn prop_followed_the_damage_is_named() {
    let (mut lost, mut count) = (0, 0);
    for lines in [true, false] {
        for (component, order, modulation) in CASES {
            for (seed, ramp) in [(0, 0.01), (1, 0.03), (2, -0.05)] {
                let rig = Rig { seconds: 4.0, ramp, lines, strikes: Some((order, modulation, -6.0)) };
                let x = rig.signal(seed);
                let a = look(&x);
                let drift = a.drift.as_ref().expect("a drift");
                assert!(drift.followed && stray(&a, &rig) < 2e-3, "{drift:?}");
                assert_eq!(drift.by == "shaft", lines);
                assert_eq!(first(&a), Some(component), "{ramp}: {}", a.verdict());
                let mut without = Options::new(SHAFT, a.options.orders);
                without.rotation = Some(Rotation::from_speeds(&[(0.0, SHAFT)]).unwrap());
                let without = analyze(&x, FS, &without).unwrap();
                lost += usize::from(first(&without) != Some(component));
                count += 1;
            }
        }
    }
    println!("lost without: {lost} of {count}");
    assert!(3 * lost >= 2 * count, "{lost} of {count}");
}

/// Where the speed goes farther than is followed, damage that is not found is not said to be none.
#[test]
fn prop_a_drift_too_wide_to_follow_leaves_it_open() {
    for lines in [true, false] {
        for (component, order, modulation) in CASES {
            let rig = Rig { seconds: 8.0, ramp: 0.2, lines, strikes: Some((order, modulation, -3.0)) };
            let a = look(&rig.signal(3));
            println!("{component:?}: {}", a.verdict());
            let drift = a.drift.as_ref().expect("a drift");
            assert!(drift.leaves, "{drift:?}");
            match first(&a) {
                None => assert_eq!(a.conclusion(), Verdict::CannotTell),
                damaged => assert_eq!(damaged, Some(component)),
            }
        }
    }
}

/// Neither noise nor a steady rig, with damage or without, drifts.
#[test]
fn prop_what_is_steady_does_not_drift() {
    let mut told = Vec::new();
    for seed in 0..12 {
        for seconds in [2.0, 4.0, if seed < 4 { 10.0 } else { 3.0 }] {
            let mut noise = Random::new(31 * seed + 3);
            let white: Vec<f64> = (0..(FS * seconds) as usize).map(|_| noise.normal()).collect();
            let strikes = CASES[seed as usize % 3];
            let rig = |lines, strikes| Rig { seconds, ramp: 0.0, lines, strikes };
            let strikes = Some((strikes.1, strikes.2, -3.0));
            let signals = [
                ("noise", white),
                ("rig", rig(true, None).signal(seed)),
                ("damaged", rig(true, strikes).signal(seed)),
                ("damaged, no lines", rig(false, strikes).signal(seed)),
            ];
            for (name, x) in signals {
                if let Some(drift) = look(&x).drift {
                    told.push(format!("{name} {seed} {seconds} s: {}", drift.words()));
                }
            }
        }
    }
    assert!(told.is_empty(), "{told:#?}");
}
