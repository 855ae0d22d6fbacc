//! Changes of a level over time: how often scatter alone gives one, and what is found of one that is known.

use brinell_signal::random::Random;
use brinell_signal::trend::{Change, Course, FEWEST, Kind, changes};

/// Scatter of standard deviation 1 that wanders with this correlation from value to value.
fn scatter(random: &mut Random, n: usize, correlation: f64) -> Vec<f64> {
    let mut last = random.normal();
    let mut next = || {
        let now = last;
        last = correlation * last + (1.0 - correlation * correlation).sqrt() * random.normal();
        now
    };
    (0..n).map(|_| next()).collect()
}

fn course(y: Vec<f64>, s: f64) -> Course {
    Course { t: (0..y.len()).map(|i| i as f64).collect(), s: vec![s; y.len()], y }
}

/// Of 200 series a kind; the greatest correlation wanders over the whole series, and looks like a change most. Three standard errors of the share above what is
/// said, plus 2 % that the test is known to be beyond it there.
#[test]
fn prop_scatter_that_wanders_changes_no_oftener_than_is_said() {
    for (n, correlation) in [(10, 0.5), (20, 0.0), (20, 0.8), (30, 0.95)] {
        let mut random = Random::new(n as u64);
        let mut found = 0;
        for _ in 0..200 {
            let y = scatter(&mut random, n, correlation).iter().map(|v| 0.1 * v).collect();
            found += usize::from(!changes(&course(y, 0.02), 0.05).unwrap().changes.is_empty());
        }
        assert!(found <= 23, "{found} of 200, {n} records, correlation {correlation}");
    }
}

/// A level that grows fourfold in the last 16 of 40 records, with a scatter of 10 % that wanders.
#[test]
fn analytic_growth_of_known_onset_rate_and_end_is_within_its_intervals() {
    let (n, onset) = (40, 24);
    let rate = 4f64.ln() / (n - 1 - onset) as f64;
    let mut random = Random::new(5);
    let [mut found, mut begun, mut fast, mut reached] = [0; 4];
    for _ in 0..60 {
        let y = scatter(&mut random, n, 0.5);
        let y = y.iter().enumerate().map(|(i, v)| 0.1 * v + rate * (i as f64 - onset as f64).max(0.0)).collect();
        let course = course(y, 0.02);
        let all = changes(&course, 0.005).unwrap().changes;
        let Some(growth) = all.iter().find(|change| change.kind == Kind::Growth) else { continue };
        found += 1;
        begun += usize::from((growth.between.0..=growth.between.1).contains(&onset));
        let interval = growth.by.interval.unwrap();
        fast += usize::from(interval.low <= rate && rate <= interval.high);
        let (limit, at) = (8f64.ln(), onset as f64 + 8f64.ln() / rate);
        let reach = growth.reach(&course, limit).unwrap();
        reached += usize::from(reach.low <= at && reach.high.is_none_or(|high| at <= high));
    }
    assert!(found >= 50, "{found} of 60");
    for (what, within) in [("onset", begun), ("rate", fast), ("time to the limit", reached)] {
        assert!(within * 100 >= found * 85, "{what}: {within} of {found}");
    }
}

/// Damage makes a level higher and less steady.
#[test]
fn analytic_a_step_to_a_level_that_scatters_more_is_found() {
    let mut random = Random::new(2);
    let y = (0..20).map(|i| if i < 12 { 0.01 * random.normal() } else { 3f64.ln() + 0.2 * random.normal() }).collect();
    let all = changes(&course(y, 0.01), 0.005).unwrap().changes;
    let [Change { kind: Kind::Step, between: (12, 12), by, .. }] = &all[..] else { panic!("{all:?}") };
    let interval = by.interval.unwrap();
    assert!(interval.low < 3f64.ln() && 3f64.ln() < interval.high && interval.low > 0.7, "{interval:?}");
}

#[test]
fn prop_what_is_no_change_is_none() {
    let mut random = Random::new(9);
    // One record far off.
    let mut y: Vec<f64> = (0..24).map(|_| 0.05 * random.normal()).collect();
    y[15] += 2.0;
    assert_eq!(changes(&course(y, 0.02), 0.01).unwrap().changes, []);
    // A step within the intervals of the records.
    let y = (0..20).map(|i| if i < 10 { 0.0 } else { 0.05 }).collect();
    assert_eq!(changes(&course(y, 0.2), 0.01).unwrap().changes, []);
    // The same value throughout.
    assert_eq!(changes(&course(vec![1.0; 12], 0.0), 0.01).unwrap().changes, []);
    assert!(changes(&course(vec![0.0; FEWEST - 1], 0.1), 0.01).is_none());
}

#[test]
fn prop_a_rate_alone_leads_to_a_limit() {
    let grows: Vec<f64> =
        (0..20).map(|i| f64::max(0.0, 0.1 * (f64::from(i) - 9.0)) + 0.001 * f64::from(i % 3)).collect();
    let of = |y: Vec<f64>, limit: f64| {
        let course = course(y, 0.001);
        let all = changes(&course, 0.01).unwrap().changes;
        all.last().and_then(|change| change.reach(&course, limit))
    };
    let reach = of(grows.clone(), 2.0).unwrap();
    assert!((reach.at - 29.0).abs() < 1.0 && reach.low < 29.0 && reach.high.unwrap() > 29.0, "{reach:?}");
    // It is above already, and it falls.
    assert_eq!(of(grows.clone(), 0.5), None);
    assert_eq!(of(grows.iter().map(|y| -y).collect(), 2.0), None);
}
