//! How often a trend is falsely said to change, and what is found of growth that is known: the tables of docs/src/results/analyze-trend.md.
//!
//!     cargo run --release -p brinell-signal --example trend_rates

use brinell_signal::random::Random;
use brinell_signal::trend::{Course, Kind, changes};

const SERIES: u32 = 200;
/// The share of a level where eight of them make 5 %.
const SHARE: f64 = 0.006;

/// Scatter of standard deviation 0.1 that wanders with this correlation from value to value, on a level that is known to 0.02.
fn course(random: &mut Random, n: usize, correlation: f64, level: impl Fn(usize) -> f64) -> Course {
    let mut last = random.normal();
    let y = (0..n).map(|i| {
        let now = last;
        last = correlation * last + (1.0 - correlation * correlation).sqrt() * random.normal();
        0.1 * now + level(i)
    });
    Course { y: y.collect(), t: (0..n).map(|i| i as f64).collect(), s: vec![0.02; n] }
}

/// Of series without a change, the share in which one is found where 5 % are asked for.
fn false_alarms(n: usize, correlation: f64, far_off: f64) -> f64 {
    let mut random = Random::new(n as u64);
    let mut found = 0;
    for _ in 0..SERIES {
        let mut course = course(&mut random, n, correlation, |_| 0.0);
        for y in &mut course.y {
            if random.part() < far_off {
                *y += 1.0;
            }
        }
        found += u32::from(changes(&course, 0.05).is_some_and(|trend| !trend.changes.is_empty()));
    }
    f64::from(found) / f64::from(SERIES)
}

/// Growth by `times` in the last two fifths: the share that is found, and of these the shares whose intervals of onset, rate and time to a limit hold.
fn growth(n: usize, correlation: f64, times: f64) -> [f64; 4] {
    let (onset, mut random) = (n * 3 / 5, Random::new(n as u64));
    let rate = times.ln() / (n - 1 - onset) as f64;
    let mut held = [0; 4];
    for _ in 0..SERIES {
        let course = course(&mut random, n, correlation, |i| rate * (i as f64 - onset as f64).max(0.0));
        let Some(trend) = changes(&course, SHARE) else { continue };
        let Some(change) = trend.changes.iter().find(|change| change.kind == Kind::Growth) else { continue };
        held[0] += 1;
        held[1] += u32::from((change.between.0..=change.between.1).contains(&onset));
        held[2] += u32::from(change.by.interval.is_some_and(|of| of.low <= rate && rate <= of.high));
        let (limit, at) = ((2.0 * times).ln(), onset as f64 + (2.0 * times).ln() / rate);
        let reach = change.reach(&course, limit);
        held[3] += u32::from(reach.is_some_and(|r| r.low <= at && r.high.is_none_or(|high| at <= high)));
    }
    let [found, rest @ ..] = held.map(f64::from);
    let [a, b, c] = rest.map(|held| held / found.max(1.0));
    [found / f64::from(SERIES), a, b, c]
}

#[expect(clippy::print_stdout, reason = "it is what the example is for")]
fn main() {
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    println!("| records | 0 | 0.5 | 0.8 | 0.95 |\n| --- | --- | --- | --- | --- |");
    for (n, far_off, words) in
        [(8, 0.0, "8"), (15, 0.0, "15"), (30, 0.0, "30"), (60, 0.0, "60"), (30, 0.05, "30, 5 % of the records far off")]
    {
        let row = [0.0, 0.5, 0.8, 0.95].map(|correlation| percent(false_alarms(n, correlation, far_off)));
        println!("| {words} | {} |", row.join(" | "));
    }
    println!(
        "\n| records, correlation, growth | found | onset | rate | time to a limit |\n| --- | --- | --- | --- | --- |"
    );
    for (n, correlation, times) in [
        (15, 0.0, 4.0),
        (15, 0.7, 4.0),
        (40, 0.0, 4.0),
        (40, 0.7, 4.0),
        (15, 0.0, 2.0),
        (15, 0.7, 2.0),
        (40, 0.0, 2.0),
        (40, 0.7, 2.0),
    ] {
        println!("| {n}, {correlation}, {times}-fold | {} |", growth(n, correlation, times).map(percent).join(" | "));
    }
}
