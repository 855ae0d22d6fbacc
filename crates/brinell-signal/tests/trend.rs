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

/// Two last records far above a level are in no change, and are said to be in none; of as many within the scatter nothing is said.
#[test]
fn analytic_last_records_that_leap_are_set_aside_and_counted() {
    for (leap, aside) in [(0.0, 0), (1.0, 1), (2.0, 2)] {
        let mut random = Random::new(11);
        let mut y: Vec<f64> = scatter(&mut random, 16, 0.0).iter().map(|v| 0.03 * v).collect();
        if leap > 0.0 {
            y[15] += 2.0;
        }
        if leap > 1.0 {
            y[14] += 1.6;
        }
        let found = changes(&course(y, 0.01), 0.01).unwrap();
        assert_eq!((found.aside, found.changes.len()), (aside, 0), "{leap}");
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
        begun += usize::from((growth.between.0..=growth.between.1).contains(&(onset as f64)));
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
    let [Change { kind: Kind::Step, between: (11.0, 12.0), at: 11.5, by, .. }] = &all[..] else { panic!("{all:?}") };
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
    // The same value throughout, but for rounding.
    for value in [1.0, 0.1f64.ln(), 0.3] {
        let y = (0..12).map(|i| value * (1.0 + f64::EPSILON * f64::from(i % 3))).collect();
        let outcome = changes(&course(y, 0.0), 0.01).unwrap();
        assert!(outcome.changes.is_empty() && outcome.p > 0.5, "{outcome:?}");
    }
    assert!(changes(&course(vec![0.0; FEWEST - 1], 0.1), 0.01).is_none());
}

/// One or two records at either end that leap do not tell a change, which takes three. Of 40 series each; scatter alone would give 2.
#[test]
fn prop_a_leap_of_one_or_two_records_at_an_end_is_no_change() {
    for ends in [&[29][..], &[28, 29], &[0], &[0, 1]] {
        let mut random = Random::new(4);
        let mut found = 0;
        for _ in 0..40 {
            let mut y: Vec<f64> = (0..30).map(|_| 0.05 * random.normal()).collect();
            ends.iter().for_each(|i| y[*i] += 2f64.ln());
            found += usize::from(!changes(&course(y, 0.005), 0.006).unwrap().changes.is_empty());
        }
        assert!(found <= 7, "{ends:?}: {found} of 40");
    }
    // Growth that three records show is left.
    let y = (0..30).map(|i| 0.4 * f64::max(0.0, f64::from(i) - 26.0) + 0.001 * f64::from(i % 3)).collect();
    let all = changes(&course(y, 0.001), 0.006).unwrap().changes;
    assert!(matches!(&all[..], [Change { kind: Kind::Growth, .. }]), "{all:?}");
}

/// Growth begins at any time, and so in a gap. Each interval misses in 5 of 100; of 40 series each, with three standard errors.
#[test]
fn analytic_growth_that_begins_between_records_is_within_its_intervals() {
    let weekdays = (0..35).filter(|day| day % 7 < 5).map(f64::from).collect::<Vec<_>>();
    let gap = (0..16).chain(46..54).map(f64::from).collect::<Vec<_>>();
    for (t, onset, rate) in
        [((0..20).map(f64::from).collect(), 11.0..12.0, 0.1), (weekdays, 18.0..21.0, 0.1), (gap, 15.0..46.0, 0.06)]
    {
        let mut random = Random::new(6);
        let [mut begun, mut fast, mut reached, mut found] = [0; 4];
        for _ in 0..40 {
            let onset = onset.start + random.part() * (onset.end - onset.start);
            let y = t.iter().map(|t| 0.02 * random.normal() + rate * (t - onset).max(0.0)).collect();
            let course = Course { t: t.clone(), s: vec![0.002; t.len()], y };
            let all = changes(&course, 0.006).unwrap().changes;
            let Some(growth) = all.iter().find(|change| change.kind == Kind::Growth) else { continue };
            found += 1;
            begun += usize::from((growth.between.0..=growth.between.1).contains(&onset));
            fast += usize::from(growth.by.interval.is_some_and(|of| of.low <= rate && rate <= of.high));
            let at = onset + 4.0 / rate;
            reached += usize::from(
                growth.reach(&course, 4.0).is_some_and(|r| r.low <= at && r.high.is_none_or(|high| at <= high)),
            );
        }
        for (what, within) in [("onset", begun), ("rate", fast), ("time to a limit", reached)] {
            assert!(found >= 35 && within + 6 >= found, "{what}: {within} of {found}");
        }
    }
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
