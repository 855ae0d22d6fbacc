//! How often a trend is falsely said to change, and what is found of growth that is known: the tables of docs/src/results/analyze-trend.md.
//!
//!     cargo run --release -p brinell-signal --example trend_rates

use brinell_signal::random::Random;
use brinell_signal::trend::{Course, Kind, changes};

const SERIES: u32 = 200;
/// The share of a level where eight of them make 5 %.
const SHARE: f64 = 0.006;

/// Scatter of standard deviation 0.1 that wanders with this correlation from value to value, on a level that is known to 0.02.
fn course(random: &mut Random, t: Vec<f64>, correlation: f64, level: impl Fn(f64) -> f64) -> Course {
    let mut last = random.normal();
    let y = t.iter().map(|t| {
        let now = last;
        last = correlation * last + (1.0 - correlation * correlation).sqrt() * random.normal();
        0.1 * now + level(*t)
    });
    Course { y: y.collect(), s: vec![0.02; t.len()], t }
}

/// One record in each unit of time.
fn daily(n: usize) -> Vec<f64> {
    (0..n).map(|i| i as f64).collect()
}

/// Records without a change that are far off.
#[derive(Clone, Copy)]
enum FarOff {
    None,
    /// Each with this probability.
    Some(f64),
    /// So many at the end.
    Last(usize),
}

/// Of series without a change, the share in which one is found where 5 % are asked for.
fn false_alarms(n: usize, correlation: f64, far_off: FarOff) -> f64 {
    let mut random = Random::new(n as u64);
    let mut found = 0;
    for _ in 0..SERIES {
        let mut course = course(&mut random, daily(n), correlation, |_| 0.0);
        for (i, y) in course.y.iter_mut().enumerate() {
            let off = match far_off {
                FarOff::None => false,
                FarOff::Some(share) => random.part() < share,
                FarOff::Last(count) => i + count >= n,
            };
            *y += f64::from(u8::from(off));
        }
        found += u32::from(changes(&course, 0.05).is_some_and(|trend| !trend.changes.is_empty()));
    }
    f64::from(found) / f64::from(SERIES)
}

/// Growth by `times` in the last two fifths, from a record on or from any time before the next: the share that is found, and of these the shares
/// whose intervals of onset, rate and time to a limit hold. With a gap, the onset is anywhere in it.
fn growth(t: &[f64], correlation: f64, times: f64) -> [f64; 4] {
    let (n, mut random) = (t.len(), Random::new(t.len() as u64));
    let mut held = [0; 4];
    for _ in 0..SERIES {
        let k = n * 3 / 5;
        let onset = t[k] + random.part() * (t[k + 1] - t[k]);
        let rate = times.ln() / (t[n - 1] - onset);
        let course = course(&mut random, t.to_vec(), correlation, |t| rate * (t - onset).max(0.0));
        let Some(trend) = changes(&course, SHARE) else { continue };
        let Some(change) = trend.changes.iter().find(|change| change.kind == Kind::Growth) else { continue };
        held[0] += 1;
        held[1] += u32::from((change.between.0..=change.between.1).contains(&onset));
        held[2] += u32::from(change.by.interval.is_some_and(|of| of.low <= rate && rate <= of.high));
        let (limit, at) = ((2.0 * times).ln(), onset + (2.0 * times).ln() / rate);
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
    for (n, far_off, words) in [
        (8, FarOff::None, "8"),
        (15, FarOff::None, "15"),
        (30, FarOff::None, "30"),
        (60, FarOff::None, "60"),
        (30, FarOff::Some(0.05), "30, 5 % of the records far off"),
        (30, FarOff::Last(1), "30, the last record far off"),
        (30, FarOff::Last(2), "30, the last two far off"),
    ] {
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
        let row = growth(&daily(n), correlation, times).map(percent).join(" | ");
        println!("| {n}, {correlation}, {times}-fold | {row} |");
    }
    for times in [4.0, 16.0] {
        let t: Vec<f64> = (0..40).map(|i| f64::from(i) + if i > 24 { 20.0 } else { 0.0 }).collect();
        let row = growth(&t, 0.0, times).map(percent).join(" | ");
        println!("| 40, 0, {times}-fold, none for 20 units of time before it is seen | {row} |");
    }
}
