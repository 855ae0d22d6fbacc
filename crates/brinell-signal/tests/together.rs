//! Several records of one machine in one verdict.

use crate::analysis::{Damage, damaged, healthy};
use crate::cases::first;
use brinell_signal::Rotation;
use brinell_signal::analysis::{Analysis, AnalysisError, Component, NamedBearing, Options, analyze, analyze_records};

const FS: f64 = 12_000.0;
const TOLD: f64 = 29.93;

fn options() -> Options {
    Options::new(TOLD, NamedBearing::find("6205-2RS").unwrap().orders())
}

/// Of records, each with its speed, Hz.
fn together(records: &[(Vec<f64>, f64)]) -> Result<Analysis, AnalysisError> {
    let records: Vec<(&[f64], f64)> = records.iter().map(|(x, speed)| (&x[..], *speed)).collect();
    analyze_records(&records, FS, &options())
}

/// An outer race's, weaker than the noise by so much, dB.
fn weak(snr_db: f64) -> Damage {
    Damage { order: 3.5848, modulation: 0.0, jitter: 0.01, snr_db }
}

#[test]
fn prop_six_records_tell_together_what_none_tells_alone() {
    for (seconds, snr) in [(0.5, -8.0), (1.0, -9.0)] {
        let records: Vec<_> = (40..46).map(|seed| (damaged(FS, seconds, seed, &weak(snr)), TOLD)).collect();
        for (x, _) in &records {
            assert_eq!(first(&analyze(x, FS, &options()).unwrap()), None);
        }
        let all = together(&records).unwrap();
        assert_eq!(first(&all), Some(Component::OuterRace), "{}", all.verdict());
        assert_eq!((all.records, all.samples), (6, 6 * records[0].0.len()));
    }
}

#[test]
fn prop_no_alarm_on_records_of_healthy_rigs() {
    let mut alarms = Vec::new();
    for (seconds, number) in [(0.3, 6), (0.3, 30), (0.6, 6), (1.0, 2), (1.0, 12)] {
        for rig in 0..8 {
            let records: Vec<_> = (0..number).map(|k| (healthy(FS, seconds, 100 * rig + k), TOLD)).collect();
            let found = together(&records).unwrap();
            if first(&found).is_some() {
                alarms.push(format!("{seconds} s, {number}, {rig}: {}", found.verdict()));
            }
        }
    }
    assert!(alarms.is_empty(), "{alarms:#?}");
}

/// What is sampled faster than it is said to be is of a machine that turns more slowly. Lines of each record lie at its own
/// speed; taken to turn alike, 1.5 % apart, the records' lines of the third harmonic are five bins apart.
#[test]
fn prop_each_record_turns_at_its_own_speed() {
    let paces = [0.985, 0.99, 1.0, 1.005, 1.01, 1.015];
    let of = |pace: f64, seed: u64| damaged(FS * pace, 2.0 / pace, seed, &weak(-6.0));
    let each: Vec<_> = paces.into_iter().zip(40..).map(|(pace, seed)| (of(pace, seed), TOLD / pace)).collect();
    let own = together(&each).unwrap();
    assert_eq!(first(&own), Some(Component::OuterRace), "{}", own.verdict());
    let alike: Vec<_> = each.into_iter().map(|(x, _)| (x, TOLD)).collect();
    let blurred = together(&alike).unwrap();
    let score = |a: &Analysis| a.families.iter().find(|f| f.name == "BPFO").unwrap().score;
    assert!(score(&own) > 1.5 * score(&blurred), "{} {}", score(&own), score(&blurred));
}

#[test]
fn prop_records_of_any_level_and_length_count() {
    let scaled = |gain: f64, seconds: f64, seed: u64| -> Vec<f64> {
        damaged(FS, seconds, seed, &weak(-6.0)).iter().map(|v| gain * v).collect()
    };
    // A hundred times as loud as the others: its noise would hide their lines.
    let loud: Vec<f64> = healthy(FS, 0.5, 9).iter().map(|v| 100.0 * v).collect();
    let mut records: Vec<_> = (40..46).map(|seed| (scaled(1.0, 0.5 + 0.01 * (seed - 40) as f64, seed), TOLD)).collect();
    records.push((loud, TOLD));
    assert_eq!(first(&together(&records).unwrap()), Some(Component::OuterRace));
    // Kurtosis and RMS are those of the records, not of their mixture.
    let found = together(&[(scaled(1.0, 1.0, 1), TOLD), (scaled(7.0, 1.0, 2), TOLD)]).unwrap();
    let of = |i| found.indicator(i).unwrap().value;
    let alone = analyze(&scaled(1.0, 1.0, 1), FS, &options()).unwrap();
    let own = |i| alone.indicator(i).unwrap().value;
    use brinell_signal::Indicator::{Kurtosis, Rms};
    assert!((of(Kurtosis) / own(Kurtosis) - 1.0).abs() < 0.1, "{} {}", of(Kurtosis), own(Kurtosis));
    assert!((of(Rms) / own(Rms) - 5.0).abs() < 0.1, "{} {}", of(Rms), own(Rms));
}

#[test]
fn prop_what_is_no_record_is_named() {
    let good = || (healthy(FS, 0.5, 1), TOLD);
    let short = (healthy(FS, 0.2, 2), TOLD);
    let error = together(&[good(), good(), short]).unwrap_err();
    assert!(
        matches!(&error, AnalysisError::InRecord { number: 3, why } if matches!(**why, AnalysisError::TooShort { .. }))
    );
    assert!(error.to_string().starts_with("record 3: 0.2"), "{error}");
    assert!(together(&[]).is_err());
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(together(&[good(), (good().0, speed)]).is_err(), "{speed}");
    }
    let followed = Options { rotation: Some(Rotation::from_speeds(&[(0.0, TOLD), (1.0, TOLD)]).unwrap()), ..options() };
    let x = good().0;
    assert!(analyze_records(&[(&x, TOLD), (&x, TOLD)], FS, &followed).is_err());
    assert!(analyze_records(&[(&x, TOLD)], FS, &followed).is_ok());
}
