//! What the analysis says of signals whose damage is known: made-up rig signals with shaft, mains, jitter and noise.

use crate::cases::{CASES, first};
use std::f64::consts::TAU;

use brinell_signal::Rotation;
use brinell_signal::analysis::{
    Analysis, AnalysisError, Component, DefectOrders, Finding, Flaw, NamedBearing, Options, Side, Verdict, analyze,
    compare,
};
use brinell_signal::random::Random;

pub(crate) const SHAFT: f64 = 29.95;
/// The speed that the analyst was given: half a turn in a thousand off.
const TOLD: f64 = 29.93;

/// A rig: shaft harmonics, mains, and white noise of unit RMS.
pub(crate) fn healthy(fs: f64, seconds: f64, seed: u64) -> Vec<f64> {
    let mut noise = Random::new(seed.wrapping_mul(77) + 5);
    let phases: Vec<f64> = (0..12).map(|_| TAU * noise.uniform()).collect();
    (0..(fs * seconds) as usize)
        .map(|i| {
            let t = i as f64 / fs;
            let shaft: f64 = (1..=6).map(|k| 0.5 / k as f64 * (TAU * SHAFT * k as f64 * t + phases[k]).sin()).sum();
            let mains: f64 = [50.0, 100.0, 150.0].iter().zip(&phases).map(|(f, p)| 0.2 * (TAU * f * t + p).sin()).sum();
            // Unbalance turns the load, and with it the noise of rolling, a little.
            let breathing = 1.0 + 0.1 * (TAU * SHAFT * t).sin();
            shaft + mains + breathing * noise.normal()
        })
        .collect()
}

/// Damage: impacts at `order` with cumulative slip and jitter `jitter`, heights modulated at `modulation` orders,
/// ringing at 3 kHz, with `snr_db` of impacts to noise over the whole band.
pub(crate) struct Damage {
    pub(crate) order: f64,
    pub(crate) modulation: f64,
    pub(crate) jitter: f64,
    pub(crate) snr_db: f64,
}

pub(crate) fn damaged(fs: f64, seconds: f64, seed: u64, d: &Damage) -> Vec<f64> {
    let mut noise = Random::new(seed + 900);
    let n = (fs * seconds) as usize;
    let mut ring = vec![0.0; n];
    // Half a per cent of slip.
    let period = 1.0 / (d.order * SHAFT * 0.995);
    let mut strike = noise.uniform() * period;
    while strike < seconds {
        let at = strike + d.jitter * period * noise.normal();
        let height = match d.modulation {
            0.0 => 1.0,
            m => (0.5 + 0.5 * (TAU * m * SHAFT * at).cos()).max(0.0),
        };
        let first = (at * fs).ceil().max(0.0) as usize;
        for (i, value) in ring.iter_mut().enumerate().skip(first).take((0.006 * fs) as usize) {
            let since = i as f64 / fs - at;
            *value += height * (-since / 8e-4).exp() * (TAU * 3000.0 * since).sin();
        }
        // A tenth of the jitter stays: slip wanders.
        strike += period * (1.0 + 0.1 * d.jitter * noise.normal());
    }
    let rms = (ring.iter().map(|v| v * v).sum::<f64>() / n as f64).sqrt();
    let scale = 10f64.powf(d.snr_db / 20.0) / rms;
    (healthy(fs, seconds, seed).iter().zip(&ring)).map(|(h, r)| h + scale * r).collect()
}

pub(crate) fn look(x: &[f64], fs: f64) -> Analysis {
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    analyze(x, fs, &Options::new(TOLD, orders)).unwrap()
}

#[test]
fn prop_the_right_component_ranks_first() {
    let (mut wrong, mut missed) = (Vec::new(), 0);
    for fs in [12_000.0, 25_600.0, 48_000.0, 50_000.0] {
        for (seconds, snr_db) in [(1.0, -3.0), (2.0, -6.0), (5.0, -10.0)] {
            for (component, order, modulation) in CASES {
                for jitter in [0.01, 0.02] {
                    let damage = Damage { order, modulation, jitter, snr_db };
                    let a = look(&damaged(fs, seconds, 11, &damage), fs);
                    if first(&a).is_none() {
                        println!("missed {component:?} {fs} Hz {seconds} s {snr_db} dB {jitter}: {:?}", a.families);
                        missed += 1;
                    } else if first(&a) != Some(component) {
                        wrong.push(format!(
                            "{component:?} {fs} Hz {seconds} s {snr_db} dB jitter {jitter}: {}",
                            a.verdict()
                        ));
                    } else if snr_db < -9.0 && jitter > 0.015 {
                        println!("{fs} {}", a.verdict());
                    }
                }
            }
        }
    }
    println!("{} of 72 wrong, {missed} missed", wrong.len());
    wrong.iter().for_each(|w| println!("{w}"));
    assert!(wrong.is_empty());
}

#[test]
fn prop_no_alarm_on_healthy_rigs() {
    let mut alarms = Vec::new();
    for seed in 0..60 {
        let fs = [12_000.0, 25_600.0, 48_000.0][seed as usize % 3];
        let seconds = [1.0, 2.0, 5.0][(seed / 3) as usize % 3];
        let a = look(&healthy(fs, seconds, seed), fs);
        if a.causes().next().is_some() {
            alarms.push(format!("{seed} {fs} {seconds}: {}", a.verdict()));
        }
        if seed == 0 {
            println!("{}", a.verdict());
        }
    }
    alarms.iter().for_each(|a| println!("{a}"));
    // The level is 1 %: of 60, more than two come with a chance of 2 %.
    assert!(alarms.len() <= 2, "{} of 60", alarms.len());
}

#[test]
fn analytic_noise_alone_raises_no_more_alarms_than_the_level() {
    // White, and coloured by a resonance as narrow as a bearing's.
    let (fs, n, count) = (12_000.0, 12_000, 150);
    let mut alarms = [0, 0];
    for seed in 0..count {
        let mut noise = Random::new(31 * seed + 3);
        let white: Vec<f64> = (0..n).map(|_| noise.normal()).collect();
        let (mut y1, mut y2) = (0.0, 0.0);
        let radius = (-0.03 * TAU * 3000.0 / fs).exp();
        let ringing: Vec<f64> = (white.iter())
            .map(|v| {
                let y = v + 2.0 * radius * (TAU * 3000.0 / fs).cos() * y1 - radius * radius * y2;
                (y1, y2) = (y, y1);
                y
            })
            .collect();
        for (alarms, x) in alarms.iter_mut().zip([&white, &ringing]) {
            *alarms += usize::from(look(x, fs).causes().next().is_some());
        }
    }
    println!("alarms of {count}: {alarms:?}");
    // 1 % of 150 is 1.5; more than five come with a chance of 0.5 %.
    assert!(alarms.iter().all(|a| *a <= 5), "{alarms:?}");
}

/// Short records like those of the public data sets with a 6205 at 1797 r/min and 12 kHz, ever deeper in noise.
#[test]
fn regress_the_verdict_at_falling_signal_to_noise() {
    let levels = [0.0, -5.0, -10.0, -15.0, -20.0, -30.0];
    let seeds = 8;
    println!("2 s, right | another's, of {seeds} each, at {levels:?} dB");
    for (component, order, modulation) in CASES {
        let counts = levels.map(|snr_db| {
            let damage = Damage { order, modulation, jitter: 0.01, snr_db };
            let named = (0..seeds).map(|s| first(&look(&damaged(12_000.0, 2.0, s, &damage), 12_000.0)));
            named.fold((0, 0), |(right, wrong), n| match n {
                Some(n) if n == component => (right + 1, wrong),
                Some(_) => (right, wrong + 1),
                None => (right, wrong),
            })
        });
        println!("{component:?}: {counts:?}");
        assert!(counts[0].0 == seeds && counts[1].0 >= seeds - 2, "{component:?} {counts:?}");
        // Buried, it is missed, and nothing else is named.
        assert!(counts.iter().all(|c| c.1 <= 1), "{component:?} {counts:?}");
    }
}

/// A tone that was computed has round-off between its lines, and round-off has a pattern: it is nobody's damage.
#[test]
fn prop_a_stretch_that_repeats_is_judged_once() {
    for (_, order, modulation) in CASES {
        let damage = Damage { order, modulation, jitter: 0.01, snr_db: -6.0 };
        let once = damaged(12_000.0, 1.0, 11, &damage);
        let (alone, repeated) = (look(&once, 12_000.0), look(&once.repeat(10), 12_000.0));
        assert!(matches!(repeated.flaws[..], [(0, Flaw::Repeats { every })] if (every - 1.0).abs() < 1e-9));
        for (a, b) in alone.families.iter().zip(&repeated.families) {
            assert_eq!(a.finding, b.finding, "{}", a.name);
            assert!((a.score - b.score).abs() < 1e-6, "{}: {} once, {} ten times", a.name, a.score, b.score);
        }
    }
}

#[test]
fn regress_a_computed_tone_is_no_damage() {
    for hz in [330.0, 1000.0, 2517.0] {
        let x: Vec<f64> = (0..60_000).map(|i| (TAU * hz * f64::from(i) / 12_000.0).sin()).collect();
        let orders = NamedBearing::find("6205-2RS").unwrap().orders();
        let analysis = analyze(&x, 12_000.0, &Options::new(1750.0 / 60.0, orders)).unwrap();
        assert_eq!(first(&analysis), None, "{hz} Hz: {}", analysis.verdict());
    }
}

/// Lines at multiples of one speed tell it; two lines that merely lie near the first and the second harmonic do not.
#[test]
fn prop_the_speed_is_found_from_lines_that_agree() {
    // Away from the mains.
    let (fs, turns, told) = (12_000.0, 27.3, 27.2);
    let tones = |tones: [f64; 2]| {
        let mut noise = Random::new(3);
        let x: Vec<f64> = (0..60_000)
            .map(|i| {
                let t = f64::from(i) / fs;
                let lines: f64 = tones.iter().map(|f| 0.3 * (TAU * f * t).sin()).sum();
                lines + noise.normal()
            })
            .collect();
        let orders = NamedBearing::find("6205-2RS").unwrap().orders();
        analyze(&x, fs, &Options::new(told, orders)).unwrap()
    };
    let own = tones([turns, 2.0 * turns]);
    assert_eq!(own.shaft_lines, [1, 2]);
    assert!((own.shaft / turns - 1.0).abs() < 1e-3);
    let strangers = tones([0.985 * told, 2.0 * 1.01 * told]);
    assert!(strangers.shaft_lines.is_empty() && !strangers.shaft_found);
    assert_eq!(strangers.shaft, told);
}

/// A line or two that noise does not explain are no family: other machines have such.
#[test]
fn regress_one_line_is_reported_and_not_called_damage() {
    let fs = 12_000.0;
    let mut noise = Random::new(11);
    // The carrier's level turns with the outer race's frequency, and with nothing else.
    let x: Vec<f64> = (0..60_000)
        .map(|i| {
            let turn = TAU * 3.5848 * TOLD * f64::from(i) / fs;
            noise.normal() * (1.0 + 0.5 * turn.sin())
        })
        .collect();
    let analysis = look(&x, fs);
    assert_eq!(first(&analysis), None, "{}", analysis.verdict());
    let outer = analysis.families.iter().find(|f| f.name == "BPFO").unwrap();
    assert!(outer.harmonics[0].detected && outer.detected_harmonics() < 3);
    assert_eq!(analysis.conclusion(), Verdict::CannotTell);
    let words = analysis.verdict();
    assert!(words.contains("fewer harmonics than damage has"), "{words}");
}

/// Something that impacts half or a third as often as a race would be passed has lines at the race's frequency as well.
#[test]
fn prop_a_slower_comb_is_distinguished_from_damage_at_its_multiple() {
    let fs = 12_000.0;
    for part in 2..=6 {
        let slower = Damage { order: 3.5848 / f64::from(part), modulation: 0.0, jitter: 0.002, snr_db: 6.0 };
        let told = look(&damaged(fs, 4.0, part as u64, &slower), fs);
        assert_eq!(first(&told), None, "{}", told.verdict());
        let comb = told.elsewhere.expect("a comb between the lines");
        let off = comb.frequency / (slower.order * SHAFT) - 1.0;
        // Slip of half a per cent, as of all that this rig is struck by.
        assert!(off.abs() < 0.01, "{part}: {comb:?}");
    }
}

/// A shaft that impacts once a turn has a line at five times its speed, near BPFI of a 6203: a speed half a per cent
/// off does not hide it, and makes it no damage.
#[test]
fn prop_impacts_once_a_turn_are_no_damage() {
    let fs = 12_000.0;
    let orders = NamedBearing::find("6203-2RS").unwrap().orders();
    // The rig's damage slips by half a per cent; the shaft does not.
    let once = Damage { order: 1.0 / 0.995, modulation: 0.0, jitter: 0.0, snr_db: 6.0 };
    for seed in 0..6 {
        let impacts =
            damaged(fs, 4.0, seed, &once).into_iter().zip(healthy(fs, 4.0, seed)).map(|(all, rest)| all - rest);
        let mut noise = Random::new(seed);
        let x: Vec<f64> = impacts.map(|v| v + 0.1 * noise.normal()).collect();
        for off in [0.99, 0.995, 1.005, 1.01] {
            let a = analyze(&x, fs, &Options::new(off * SHAFT, orders)).unwrap();
            assert_eq!(first(&a), None, "{seed} {off}: {}", a.verdict());
        }
    }
}

/// Three impacts a turn, as of a coupling's jaws, lie within the tolerance of a 6203's BPFO: where nothing tells the
/// shaft's speed the verdict says so, and not where the speed told is another multiple's.
#[test]
fn regress_impacts_at_a_multiple_of_the_speed_are_said_to_look_the_same() {
    let fs = 12_000.0;
    let jaws = Damage { order: 3.0, modulation: 0.0, jitter: 0.0, snr_db: 0.0 };
    let impacts = damaged(fs, 4.0, 1, &jaws).into_iter().zip(healthy(fs, 4.0, 1)).map(|(all, rest)| all - rest);
    let mut noise = Random::new(1);
    let x: Vec<f64> = impacts.map(|v| v + 0.1 * noise.normal()).collect();
    let of = |x: &[f64], name: &str, shaft: f64| {
        let options = Options::new(shaft, NamedBearing::find(name).unwrap().orders());
        analyze(x, fs, &options).unwrap()
    };
    let told = of(&x, "6203-2RS", 0.99 * SHAFT);
    let verdict = told.verdict();
    assert_eq!(first(&told), Some(Component::OuterRace), "{verdict}");
    assert!(verdict.starts_with("Outer race damage, weak"), "{verdict}");
    let words = "Impacts 3 times a turn of the shaft (blades, jaws of a coupling) look the same if it turns at";
    assert_eq!(verdict.matches(words).count(), 1, "{verdict}");
    // A 6205's BPFO is no multiple.
    let outer = Damage { order: 3.5848, ..jaws };
    let told = of(&damaged(fs, 4.0, 1, &outer), "6205-2RS", SHAFT).verdict();
    assert!(told.contains("Outer race damage") && !told.contains("times a turn of the shaft"), "{told}");
}

/// A race whose lines lie on multiples of the shaft's frequency, or of the mains', is neither called nor passed over;
/// where the record is long enough to part them it is called. One impact a turn is the shaft's. A record of the healthy
/// machine says whether the lines are new.
#[test]
fn prop_a_race_on_known_lines_is_not_passed_over() {
    let fs = 20_000.0;
    let told = |x: &[f64], bpfo: f64| {
        let orders = DefectOrders { bpfo: Some(bpfo), ..DefectOrders::default() };
        analyze(x, fs, &Options::new(SHAFT, orders)).unwrap()
    };
    let rig = |impacts: f64, seconds: f64, seed: u64| {
        // The rig slips by half a per cent.
        let damage = Damage { order: impacts / 0.995, modulation: 0.0, jitter: 0.002, snr_db: 0.0 };
        damaged(fs, seconds, seed, &damage)
    };
    let of = |impacts: f64, bpfo: f64, seconds: f64, seed: u64| told(&rig(impacts, seconds, seed), bpfo);
    let beside = |healthy: &[f64]| {
        let x = rig(7.0, 1.0, 9);
        let mut now = told(&x, 7.03);
        now.beside_healthy(&x, Side { x: healthy, analysis: &told(healthy, 7.03) }).unwrap();
        (now.families[0].finding, now.conclusion())
    };
    // A simulation has no mains.
    let on_mains = 50.0 / SHAFT;
    let orders = DefectOrders { bpfo: Some(on_mains), ..DefectOrders::default() };
    let run = Options { exact: true, ..Options::new(SHAFT, orders) };
    let run = analyze(&rig(on_mains, 1.0, 7), fs, &run).unwrap();
    assert_eq!(first(&run), Some(Component::OuterRace), "{}", run.verdict());
    assert_eq!(beside(&healthy(fs, 1.0, 1)), (Finding::Grown, Verdict::CannotTell));
    assert_eq!(beside(&rig(7.0, 1.0, 8)), (Finding::AsBefore, Verdict::CannotTell));
    let on_shaft = "7 impacts a turn of the shaft (blades, jaws of a coupling) have theirs";
    for (on, words) in [(7.0, on_shaft), (on_mains, "50 Hz mains would have theirs")] {
        for seed in 0..4 {
            let told = of(on, 1.004 * on, 1.0, seed);
            let verdict = told.verdict();
            assert_eq!(told.conclusion(), Verdict::CannotTell, "{verdict}");
            assert!(told.families[0].masked && verdict.contains(words), "{verdict}");
        }
    }
    for seed in 0..4 {
        let told = of(7.06, 7.09, 4.0, seed);
        assert_eq!(first(&told), Some(Component::OuterRace), "{}", told.verdict());
        let told = of(1.0, 7.03, 1.0, seed);
        assert!(told.families.iter().all(|f| !f.masked), "{}", told.verdict());
    }
}

/// An inverter's lines near BPFO are nobody's where its frequency is given.
#[test]
fn prop_lines_of_the_supply_are_excluded() {
    let fs = 12_000.0;
    // Six poles: 3.05 times the shaft's speed, where a 6203 has its BPFO.
    let supply = 3.05 * SHAFT;
    let x: Vec<f64> = (healthy(fs, 4.0, 1).iter().enumerate())
        .map(|(i, v)| {
            let t = i as f64 / fs;
            let sidebands = (-6..=6).map(|k| (TAU * (3000.0 + f64::from(k) * supply) * t).cos());
            v + 0.2 * sidebands.sum::<f64>()
        })
        .collect();
    let mut options = Options::new(SHAFT, NamedBearing::find("6203-2RS").unwrap().orders());
    let told = analyze(&x, fs, &options).unwrap();
    assert_eq!(first(&told), Some(Component::OuterRace), "{}", told.verdict());
    let doubt = "has lines there too where an inverter feeds it";
    assert!(told.verdict().contains(doubt), "{}", told.verdict());
    options.supply = Some(1.002 * supply);
    let told = analyze(&x, fs, &options).unwrap();
    assert_eq!(told.conclusion(), Verdict::NothingFound, "{}", told.verdict());
    // Multiples of nothing would have no end.
    for bad in [0.0, -50.0, f64::NAN, 1001.0] {
        options.supply = Some(bad);
        assert!(analyze(&x, fs, &options).is_err(), "{bad}");
    }
}

/// A record of the healthy machine: lines too faint for damage are reported where they have grown, and damage that was
/// there before is none.
#[test]
fn prop_a_healthy_record_shows_what_has_grown() {
    // Another sample rate: families are compared in the range that both hold.
    let (fs, before_fs) = (12_000.0, 25_600.0);
    let at = |snr_db| Damage { order: 3.5848, modulation: 0.0, jitter: 0.01, snr_db };
    let beside = |x: &[f64], before: &[f64]| {
        let mut analysis = look(x, fs);
        let before = Side { x: before, analysis: &look(before, before_fs) };
        analysis.beside_healthy(x, before).unwrap();
        let outer = analysis.families.iter().find(|f| f.name == "BPFO").cloned();
        (analysis.conclusion(), outer.unwrap())
    };
    let (sound, weak, plain) =
        (healthy(before_fs, 4.0, 1), damaged(fs, 4.0, 2, &at(-11.0)), damaged(fs, 4.0, 3, &at(-3.0)));
    assert_eq!(look(&weak, fs).conclusion(), Verdict::NothingFound);
    let (verdict, outer) = beside(&weak, &sound);
    assert_eq!((verdict, outer.finding), (Verdict::CannotTell, Finding::Grown));
    assert!(outer.growth.unwrap() > 2.0);
    let (verdict, outer) = beside(&plain, &sound);
    assert_eq!((verdict, outer.finding), (Verdict::Damage, Finding::Damage));
    let before = damaged(before_fs, 4.0, 4, &at(0.0));
    let (verdict, outer) = beside(&plain, &before);
    assert_eq!(outer.finding, Finding::AsBefore);
    assert_ne!(verdict, Verdict::Damage);
    // As deep, and four times as high.
    let louder: Vec<f64> = plain.iter().map(|v| 4.0 * v).collect();
    assert_eq!(beside(&louder, &before).0, Verdict::Damage);
    let (verdict, _) = beside(&healthy(fs, 4.0, 5), &sound);
    assert_eq!(verdict, Verdict::NothingFound);
}

#[test]
fn regress_words_on_what_cannot_be_analysed() {
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    let say = |x: &[f64], fs: f64| analyze(x, fs, &Options::new(30.0, orders)).unwrap_err().to_string();
    let x = healthy(12_000.0, 1.0, 1);
    let slow = say(&x, 600.0);
    assert!(
        slow.starts_with("sampled at 600 Hz the signal holds nothing above 300.0 Hz, and BPFI lies at 162.5 Hz"),
        "{slow}"
    );
    assert!(say(&x[..1200], 12_000.0).starts_with("0.1000 s are 3.00 revolutions"));
    assert_eq!(say(&[2.5; 9000], 12_000.0), "all 9000 samples are 2.5: a constant is no vibration");
    let mut holes = x.clone();
    holes[7] = f64::NAN;
    holes[9] = f64::INFINITY;
    assert!(say(&holes, 12_000.0).starts_with("2 of 12000 samples are missing or infinite, the first at sample 8"));
}

#[test]
fn prop_odd_input_does_not_panic() {
    let orders = NamedBearing::find("NICE").unwrap().orders();
    for fs in [f64::NAN, -1.0, 0.0, 1e-300, 1e300, 12_000.0] {
        for shaft in [f64::NAN, 0.0, -30.0, 1e-9, 30.0, 1e9] {
            for x in [vec![], vec![0.0], vec![0.0, 1.0], healthy(12_000.0, 0.5, 3)] {
                let _ = analyze(&x, fs, &Options::new(shaft, orders));
            }
        }
    }
    let spike: Vec<f64> = (0..12_000).map(|i| f64::from(u8::from(i == 6000))).collect();
    assert!(look(&spike, 12_000.0).causes().next().is_none());
}

#[test]
fn prop_options_that_cannot_be_are_refused_by_name() {
    let x = healthy(12_000.0, 1.0, 1);
    let usual = Options::new(SHAFT, NamedBearing::find("6205").unwrap().orders());
    let turning = |hz| Some(Rotation::from_speeds(&[(0.0, hz)]).unwrap());
    assert!(analyze(&x, 12_000.0, &Options { rotation: turning(1.01 * SHAFT), ..usual.clone() }).is_ok());
    for (name, options) in [
        ("silent", Options { silent: Some(f64::NAN), ..usual.clone() }),
        ("silent", Options { silent: Some(1e200), ..usual.clone() }),
        ("silent", Options { silent: Some(-1.0), ..usual.clone() }),
        ("rotation", Options { rotation: turning(0.0), ..usual.clone() }),
        ("rotation", Options { rotation: turning(0.5 * SHAFT), ..usual.clone() }),
        ("BPFO", Options { orders: DefectOrders { bpfo: usual.orders.bpfi, ..usual.orders }, ..usual }),
    ] {
        let error = analyze(&x, 12_000.0, &options).unwrap_err().to_string();
        assert!(error.starts_with(name), "{error}");
    }
}

#[test]
fn analytic_a_signal_over_itself_differs_nowhere() {
    let damage = Damage { order: 3.5848, modulation: 0.0, jitter: 0.01, snr_db: 0.0 };
    let x = damaged(25_600.0, 2.0, 1, &damage);
    let a = look(&x, 25_600.0);
    let side = Side { x: &x, analysis: &a };
    let c = compare(side, side).unwrap();
    assert!(c.level_db.0.abs() < 1e-12 && c.level_db.1 < 1e-12);
    assert!(c.indicators.iter().all(|d| d.first == d.second && d.apart == Some(false)));
    assert!(c.lines.iter().any(|l| l.name == "BPFO" && l.snr_db[0] > 10.0));
    // Half as high: 6 dB everywhere, and the same modulation.
    let half: Vec<f64> = x.iter().map(|v| 0.5 * v).collect();
    let b = look(&half, 25_600.0);
    let c = compare(side, Side { x: &half, analysis: &b }).unwrap();
    assert!((c.level_db.0 - 6.0206).abs() < 1e-3, "{:?}", c.level_db);
    assert!(c.lines.iter().all(|l| (l.modulation[0] / l.modulation[1] - 1.0).abs() < 1e-9));
}

/// Orders that no bearing has made the search for slip endless, or left it without a bin.
#[test]
fn prop_orders_that_no_bearing_has_are_refused() {
    let x = healthy(12_000.0, 1.0, 1);
    let of = |orders: DefectOrders| analyze(&x, 12_000.0, &Options::new(SHAFT, orders));
    let real = NamedBearing::find("6205").unwrap().orders();
    for ftf in [1e-3, 0.7, 0.999_999, 1.0, f64::NAN] {
        assert!(matches!(of(DefectOrders { ftf: Some(ftf), ..real }), Err(AnalysisError::Order { .. })), "{ftf}");
    }
    for bpfo in [-3.0, 0.0, 1e-9, 1e-3, f64::INFINITY] {
        assert!(matches!(of(DefectOrders { bpfo: Some(bpfo), ..real }), Err(AnalysisError::Order { .. })), "{bpfo}");
    }
    // The ends of what is looked for.
    assert!(of(DefectOrders { bpfo: Some(0.1), ftf: Some(0.01), ..real }).is_ok());
    assert!(of(DefectOrders { ftf: Some(0.6), ..real }).is_ok());
}
