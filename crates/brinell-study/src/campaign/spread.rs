//! How far levels hang on what nobody stated: every assumed value at both ends of its plausible range, one at a time.
//!
//! The band of a number takes its changes for independent: the logarithms of what each value does to it, up and down apart, added as squares.
//! It is no confidence interval: the ends of the ranges are judgement, not statistics.

use crate::campaign::row::in_json;
use brinell::document::Provenance;
use brinell::many;
use brinell::result::{Quantity, can_be_negative, simulate_with};
use brinell::scenario::Scenario;
use brinell::signal::objects;
use brinell::simulate::Progress;
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

/// What the numbers of a spread are.
pub const SPREAD_MEANING: &str = "value, and low to high, the band of what is assumed: each assumed value at both ends of its plausible range, one at a \
                                  time, their changes added as squares of logarithms; no confidence interval";

/// An assumed value and where it may lie.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Assumed {
    /// Path of its key.
    pub key: String,
    /// Its unit, empty where it has none.
    pub unit: &'static str,
    /// The value, and both ends.
    pub value: f64,
    /// Both ends; one may be the value.
    #[serde(flatten, serialize_with = "low_high")]
    pub ends: [f64; 2],
}

/// The assumed values of a scenario of which a plausible range is known.
pub fn assumed(provenance: &[Provenance]) -> Vec<Assumed> {
    let of = |p: &Provenance| {
        let (value, ends) = (p.value.parse().ok()?, p.plausible?);
        (ends[0] < ends[1]).then(|| Assumed { key: p.key.clone(), unit: p.unit, value, ends })
    };
    provenance.iter().filter_map(of).collect()
}

/// One number at both ends of one assumed value; `None` where a run there has no such number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bar {
    /// Path of the key.
    pub key: String,
    /// The number at the low and at the high end.
    #[serde(flatten, serialize_with = "at_low_high")]
    pub at: [Option<f64>; 2],
}

/// One number of a run, with what every assumed value does to it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Level {
    /// What it is.
    pub name: String,
    /// SI unit; 1 where it has none.
    pub unit: String,
    /// As the scenario has it.
    pub value: f64,
    /// The band.
    #[serde(flatten, serialize_with = "low_high")]
    pub band: [f64; 2],
    /// Of each assumed value that changes it, what changes it most first: the tornado.
    #[serde(rename = "by")]
    pub bars: Vec<Bar>,
}

impl Level {
    /// Where the band of a ratio lies.
    pub fn beside_one(&self) -> &'static str {
        match self.band {
            [low, _] if low > 1.0 => "above 1 throughout",
            [_, high] if high < 1.0 => "below 1 throughout",
            [low, high] if low == 1.0 && high == 1.0 => "1 throughout",
            _ => "on both sides of 1",
        }
    }
}

/// Of the ratios of each run but the baseline, run 0, that of a run's number.
pub fn band_of<'a>(ratios: &'a [Vec<Level>], run: usize, name: &str) -> Option<&'a Level> {
    ratios.get(run.checked_sub(1)?)?.iter().find(|level| level.name == name)
}

fn low_high<S: Serializer>(ends: &[f64; 2], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map([("low", ends[0]), ("high", ends[1])])
}

fn at_low_high<S: Serializer>(ends: &[Option<f64>; 2], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map([("at_low", ends[0]), ("at_high", ends[1])])
}

/// The numbers of the run at both ends of each assumed value; the reason where there are none.
pub type Ends = Vec<[Result<Vec<Quantity>, String>; 2]>;

/// What the assumed values of a scenario do to its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// The assumed values.
    pub keys: Vec<Assumed>,
    /// The runs at both ends of each.
    pub ends: Ends,
    /// The numbers with their bands.
    pub levels: Vec<Level>,
}

/// Runs `keys` at both ends as [`run_ends`]; `None` once `stop` is set.
pub fn run_spread(
    keys: Vec<Assumed>,
    base: &[Quantity],
    load: impl Fn(&str, f64) -> Result<Scenario, String> + Sync,
    threads: NonZeroUsize,
    stop: &AtomicBool,
) -> Option<Spread> {
    let ends = run_ends(&keys, base, load, threads, stop);
    let levels = levels(&keys, base, &ends);
    (!stop.load(Ordering::Relaxed)).then_some(Spread { keys, ends, levels })
}

/// Runs `keys` at both ends, up to `threads` runs at a time. `load` reads the scenario with one value set. An end that is the value itself is
/// `base`, and not run.
pub fn run_ends(
    keys: &[Assumed],
    base: &[Quantity],
    load: impl Fn(&str, f64) -> Result<Scenario, String> + Sync,
    threads: NonZeroUsize,
    stop: &AtomicBool,
) -> Ends {
    let run = |k: usize| {
        let (key, end) = (&keys[k / 2], keys[k / 2].ends[k % 2]);
        if end == key.value {
            return Ok(base.to_vec());
        }
        let mut scenario = load(&key.key, end)?;
        // Of each run only what the sensor reads and what defects show is kept.
        scenario.simulation.record.clear();
        let run = simulate_with(&scenario, &mut Progress(|_| many::go_on(stop)));
        run.map(|run| run.quantities()).map_err(|error| error.to_string())
    };
    let mut all = many::map(2 * keys.len(), threads, run).into_iter();
    keys.iter().filter_map(|_| Some([all.next()?, all.next()?])).collect()
}

/// The levels of the sensor, and what a defect shows.
fn told(run: &[Quantity]) -> impl Iterator<Item = &Quantity> {
    let is_told = |name: &str| (name.starts_with("sensor_") || name.starts_with("defect")) && !can_be_negative(name);
    run.iter().filter(move |quantity| is_told(&quantity.name))
}

/// A number of a run above 0.
fn number(run: &[Quantity], name: &str) -> Option<f64> {
    run.iter().find(|quantity| quantity.name == name)?.value.filter(|x| *x > 0.0)
}

/// Numbers above 0 of a run with their bands, in the order of the run.
fn levels(keys: &[Assumed], base: &[Quantity], ends: &Ends) -> Vec<Level> {
    let of = |quantity: &Quantity| {
        let name = &quantity.name;
        let at = |k: usize, end: usize| number(ends[k][end].as_ref().ok()?, name);
        Some(level((name, &quantity.unit), number(base, name)?, bars(keys, at)))
    };
    told(base).filter_map(of).collect()
}

/// A bar of each key; `at` gives the number by the key's place and the end.
fn bars(keys: &[Assumed], at: impl Fn(usize, usize) -> Option<f64>) -> Vec<Bar> {
    let bar = |(k, key): (usize, &Assumed)| Bar { key: key.key.clone(), at: [0, 1].map(|end| at(k, end)) };
    keys.iter().enumerate().map(bar).collect()
}

/// A number with its band.
fn level((name, unit): (&str, &str), value: f64, mut bars: Vec<Bar>) -> Level {
    let change = |x: &Option<f64>| x.map_or(0.0, |x| (x / value).ln());
    let reach = |bar: &Bar| bar.at.iter().map(|x| change(x).abs()).fold(0.0, f64::max);
    bars.retain(|bar| reach(bar) > 0.0);
    bars.sort_by(|a, b| reach(b).total_cmp(&reach(a)));
    let sum = |sign: f64| {
        let farthest = |bar: &Bar| bar.at.iter().map(|x| sign * change(x)).fold(0.0, f64::max);
        bars.iter().map(|bar| farthest(bar).powi(2)).sum::<f64>().sqrt()
    };
    let band = [value * (-sum(-1.0)).exp(), value * sum(1.0).exp()];
    Level { name: name.to_owned(), unit: unit.to_owned(), value, band, bars }
}

/// The same of the ratio of two runs' numbers, over the keys that both assume: each is moved in both at once.
pub fn ratios(keys: &[Assumed], [of, to]: [&[Quantity]; 2], [of_ends, to_ends]: [&Ends; 2]) -> Vec<Level> {
    let ratio = |quantity: &Quantity| {
        let name = &quantity.name;
        let value = number(of, name)? / number(to, name)?;
        let at = |k: usize, end: usize| {
            let run = |ends: &Ends| number(ends[k][end].as_ref().ok()?, name);
            Some(run(of_ends)? / run(to_ends)?)
        };
        Some(level((name, "1"), value, bars(keys, at)))
    };
    told(of).filter_map(ratio).collect()
}

objects! {
    /// A spread with the runs that failed.
    Written<'a> { meaning: &'a str, assumed: Vec<Moved<'a>>, levels: &'a [Level] }
    /// A value that was moved.
    Moved<'a> { #[serde(flatten)] key: &'a Assumed, failed: Vec<Failed<'a>> }
    /// A run at an end that failed.
    Failed<'a> { at: f64, why: &'a str }
}

impl Spread {
    /// As JSON: the keys with their ends and the reason of each run that failed, and the numbers with band and bars.
    pub fn to_json(&self) -> Value {
        let moved = self.keys.iter().zip(&self.ends).map(|(key, pair)| {
            let ends = pair.iter().zip(key.ends);
            Moved { key, failed: ends.filter_map(|(run, at)| Some(Failed { at, why: run.as_ref().err()? })).collect() }
        });
        in_json(&Written { meaning: SPREAD_MEANING, assumed: moved.collect(), levels: &self.levels })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(of: &[(&str, [f64; 2])]) -> Vec<Bar> {
        of.iter().map(|(key, at)| Bar { key: (*key).to_owned(), at: at.map(Some) }).collect()
    }

    /// Factors of 2 and 4 up: the root of 1 + 4 powers of 2; down by 2 alone.
    #[test]
    fn analytic_independent_factors_add_as_squares_of_logarithms() {
        let found = level(("a", "1"), 3.0, made(&[("x", [6.0, 1.5]), ("y", [3.0, 12.0]), ("z", [3.0; 2])]));
        assert!((found.band[1] - 3.0 * 2f64.powf(5f64.sqrt())).abs() < 1e-12, "{found:?}");
        assert!((found.band[0] - 1.5).abs() < 1e-12, "{found:?}");
        // The largest first, and nothing that changes nothing.
        assert_eq!(found.bars.iter().map(|bar| &*bar.key).collect::<Vec<_>>(), ["y", "x"]);
    }

    /// One key alone: the band is what it does.
    #[test]
    fn analytic_the_band_of_one_key_is_its_bar() {
        let found = level(("a", "1"), 2.0, made(&[("x", [1.0, 5.0])]));
        assert!((found.band[0] - 1.0).abs() < 1e-15 && (found.band[1] - 5.0).abs() < 1e-14, "{found:?}");
        // Both ends above: nothing goes down.
        let found = level(("a", "1"), 2.0, made(&[("x", [4.0, 3.0])]));
        assert_eq!(found.band[0], 2.0);
    }
}
