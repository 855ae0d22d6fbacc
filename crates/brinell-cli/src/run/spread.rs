//! `brinell run --spread`: how far the levels hang on what is assumed.

use crate::args::RunArgs;
use crate::files::Source;
use crate::say::{complain, plural, short};
use crate::sweep::duration;
use brinell::document::Loaded;
use brinell::many;
use brinell::result::RunResult;
use brinell::simulate::End;
use brinell_study::campaign::{Spread, run_spread};
use std::sync::atomic::AtomicBool;

/// Assumed values that are printed of a level.
const PRINTED: usize = 5;

/// Runs every assumed value at both ends of its range, where that is asked for and the run came to its end. `None` where Ctrl-C ended it.
pub(super) fn of(
    args: &RunArgs,
    (source, loaded): (&Source, &Loaded),
    (run, seconds): (&RunResult, Option<f64>),
    stop: &AtomicBool,
) -> Option<Spread> {
    if !args.spread || run.outcome.end != End::Complete {
        return None;
    }
    let load = |key: &str, value: f64| Ok(source.variant(&[(key.to_owned(), value.to_string())])?.scenario);
    let keys = brinell_study::campaign::assumed(&loaded.provenance);
    let threads = args.jobs.unwrap_or(many::threads(2 * keys.len()));
    if !args.quiet {
        let all =
            |seconds: f64| format!(", about {}", duration(seconds * (2 * keys.len()) as f64 / threads.get() as f64));
        let cost = seconds.map_or(String::new(), all);
        complain!("spread: {} at both ends of their plausible ranges{cost}", plural(keys.len(), "assumed value"));
    }
    run_spread(keys, &run.quantities(), load, threads, stop)
}

/// The bands of the sensor's levels, and what moves the first of them most.
pub(super) fn lines(spread: &Spread) -> Vec<String> {
    let mut printed = Vec::new();
    let told = |name: &str| name.starts_with("sensor_") && (name.ends_with(".rms") || name.ends_with(".peak_to_peak"));
    for level in spread.levels.iter().filter(|level| told(&level.name)) {
        let [low, high] = level.band.map(|x| short(x, 2));
        let first = level.bars.first().map_or(String::new(), |bar| format!("; {} first", bar.key));
        printed.push(format!(
            "  {} {} {}; {low} to {high} by what is assumed{first}",
            level.name,
            short(level.value, 3),
            level.unit
        ));
        if printed.len() > 1 {
            continue;
        }
        for bar in level.bars.iter().take(PRINTED) {
            let Some(key) = spread.keys.iter().find(|key| key.key == bar.key) else { continue };
            let at = bar.at.map(|x| x.map_or("-".into(), |x| short(x, 3)));
            let [from, to] = key.ends.map(|x| short(x, 3));
            printed.push(format!("    {} {from} to {to} {}: {} to {}", bar.key, key.unit, at[0], at[1]));
        }
    }
    let failed = spread.ends.iter().flatten().filter(|run| run.is_err()).count();
    if failed > 0 {
        printed.push(format!("  {} of the spread failed: summary.json says why", plural(failed, "run")));
    }
    printed
}
