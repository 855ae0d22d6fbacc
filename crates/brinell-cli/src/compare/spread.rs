//! `brinell compare --spread`: what assumed values do to a ratio.

use super::CompareArgs;
use super::sides::Sides;
use crate::say::{complain, plural, short};
use brinell::RunResult;
use brinell::many;
use brinell::signal::objects;
use brinell_study::campaign::{Level, SPREAD_MEANING, Side, assumed, ratios, run_ends};
use serde_json::Value;
use std::sync::atomic::{AtomicBool, Ordering};

objects! {
    /// What is assumed, and what it does.
    Spread<'a> { meaning: &'static str, sides: Vec<OfSide<'a>> }
    /// Ratios of a side to the baseline.
    OfSide<'a> { of: &'a str, ratios: &'a [Level] }
}

/// Of each side but the baseline its ratios to the baseline with their bands, over the values that both assume. `None` where Ctrl-C ended it.
pub(super) fn of(args: &CompareArgs, read: &Sides, runs: &[&RunResult], stop: &AtomicBool) -> Option<Vec<Vec<Level>>> {
    let numbers: Vec<_> = runs.iter().map(|run| run.quantities()).collect();
    let of_side = |k: usize| assumed(&read.sides[k].loaded.provenance);
    let ends = |k: usize, keys: &[_]| {
        if !args.quiet {
            complain!("spread of {}: {} at both ends", read.sides[k].label, plural(keys.len(), "assumed value"));
        }
        let threads = args.jobs.unwrap_or(many::threads(2 * keys.len()));
        run_ends(keys, &numbers[k], |key, value| read.with(k, key, value), threads, stop)
    };
    let baseline = of_side(0);
    let of_baseline = ends(0, &baseline);
    let ratio = |k: usize| {
        let place = |key: &str| baseline.iter().position(|other| other.key == key);
        let mut keys = of_side(k);
        keys.retain(|key| place(&key.key).is_some());
        let same = keys.iter().filter_map(|key| Some(of_baseline[place(&key.key)?].clone())).collect();
        ratios(&keys, [&numbers[k], &numbers[0]], [&ends(k, &keys), &same])
    };
    let ratios = (1..runs.len()).map(ratio).collect();
    (!stop.load(Ordering::Relaxed)).then_some(ratios)
}

/// A ratio's band in words, and whether it stays on its side of 1.
pub(super) fn words(level: &Level) -> String {
    let [low, high] = level.band;
    let first = level.bars.first().map_or(String::new(), |bar| format!(", {} first", bar.key));
    format!("; {} x to {} x by what is assumed{first}: {}", short(low, 3), short(high, 3), level.beside_one())
}

/// The ratios of each side.
pub(super) fn json(sides: &[Side], ratios: &[Vec<Level>]) -> Value {
    let sides = sides[1..].iter().zip(ratios).map(|(side, ratios)| OfSide { of: &side.label, ratios });
    serde_json::to_value(Spread { meaning: SPREAD_MEANING, sides: sides.collect() }).unwrap_or_default()
}
