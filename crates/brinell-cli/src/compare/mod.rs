//! `brinell compare`: scenarios side by side, each against the baseline: the first.

mod args;
mod sides;
mod spread;

use crate::campaign::Terminal;
use crate::failure::{ExitCode, Failure};
use crate::files::{make_folder, safe_name, stem};
use crate::inputs::Inputs;
use crate::results::{COMPARISON, Results};
use crate::say::{self, complain, document, say, short};
use crate::stop::stop_flag;
pub(crate) use args::CompareArgs;
use brinell::made_by;
use brinell::simulate::Simulation;
use brinell::{Error, RunResult};
use brinell_io::{Metadata, atomic_prepare};
use brinell_report::Page;
use brinell_study::campaign::{
    self, Compared, Level, Side, band_of, run_all, sides_json, sides_scenarios, sides_table,
};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

const CSV: &str = "compare.csv";
const PARQUET: &str = "compare.parquet";
const PAGE: &str = "compare.html";
const NOTHING_WRITTEN: &str = "interrupted: nothing is written; the same command begins anew";
/// Folder of the scenarios.
const SCENARIOS: &str = "scenarios";

pub(crate) fn compare(args: &CompareArgs) -> Result<ExitCode, Failure> {
    let layout = args.print.layout(&args.plots)?;
    let mut inputs = Inputs::default();
    let read = sides::read(args, &mut inputs)?;
    let sides = &read.sides;
    for side in sides {
        Simulation::planned(&side.loaded.scenario)?;
    }
    let beforehand = brinell_report::beforehand(sides);
    if !args.quiet {
        beforehand.iter().for_each(|warning| complain!("{warning}"));
    }
    let named = || Path::new("out").join(format!("compare-{}", stem(&args.scenarios[0])));
    let folder = args.output.clone().unwrap_or_else(named);
    let scenarios = scenario_files(sides, &folder);
    let same = |previous: &Value| previous["scenarios"] == Value::Object(sides_scenarios(sides));
    let earlier = Results::COMPARISON.earlier(&folder, &inputs, args.overwrite, same)?;
    make_folder(&folder.join(SCENARIOS))?;
    // Before the runs: a folder that takes no files is reported now.
    let mut ready = Vec::new();
    for (path, side) in scenarios.iter().zip(sides) {
        ready.push(atomic_prepare(path, side.loaded.to_toml())?);
    }
    let stop = stop_flag()?;
    let Some(runs) = run(args, sides, &stop) else {
        // Results of nothing.
        drop(ready);
        let _ = std::fs::remove_dir(folder.join(SCENARIOS));
        return Ok(ExitCode::FAILURE);
    };
    let all: Vec<&RunResult> = runs.iter().collect();
    let compared = campaign::compare(&all);
    let ratios = if args.spread { spread::of(args, &read, &all, &stop) } else { Some(Vec::new()) };
    let Some(ratios) = ratios else {
        complain!("{NOTHING_WRITTEN}");
        return Ok(ExitCode::FAILURE);
    };
    let doubts = brinell_report::doubts(sides, &all);
    let warnings = [&beforehand[..], &doubts].concat();
    let mut json = (COMPARISON, sides_json(sides, &compared, &warnings));
    if args.spread {
        json.1["spread"] = spread::json(sides, &ratios);
    }
    let report = Page::of_runs(sides, &all, &compared, &ratios, warnings);
    let table = sides_table(sides, &compared, &ratios);
    ready.push(table.prepare_csv(folder.join(CSV))?);
    let metadata = Metadata::made_by(brinell::VERSION, made_by::commit());
    ready.push(table.prepare_parquet(folder.join(PARQUET), &metadata)?);
    let pictures = match &args.plots[..] {
        [] => Vec::new(),
        _ => brinell_report::pictures(&report, layout),
    };
    let page = brinell_report::html(&report);
    let (written, json) = earlier.publish(ready, json, Some((PAGE, &page)), (&pictures, &args.plots))?;
    if args.json {
        document(json.trim_end());
    }
    if !args.quiet {
        doubts.iter().for_each(|warning| complain!("{warning}"));
        tell(sides, &compared, &ratios);
        say::wrote(&written);
    }
    Ok(ExitCode::SUCCESS)
}

/// Each scenario's file, in the order of the table.
fn scenario_files(sides: &[Side], folder: &Path) -> Vec<PathBuf> {
    let name = |(k, side): (usize, &Side)| format!("{}-{}.toml", k + 1, safe_name(&side.label));
    let names = sides.iter().enumerate().map(name);
    names.map(|name| folder.join(SCENARIOS).join(name)).collect()
}

/// All runs, or `None` with the errors printed.
fn run(args: &CompareArgs, sides: &[Side], stop: &AtomicBool) -> Option<Vec<RunResult>> {
    let scenario = |side: &Side| side.loaded.scenario.clone();
    let list: Vec<_> = sides.iter().map(scenario).collect();
    let threads = brinell::many::threads(list.len());
    let duration = |side: &Side| side.loaded.scenario.simulation.duration_s;
    let listener = Terminal::new(list.len(), sides.iter().map(duration).sum(), args.quiet, stop);
    let results = run_all(&list, args.jobs.unwrap_or(threads), &listener);
    drop(listener);
    let (mut runs, mut stopped) = (Vec::new(), false);
    for (side, result) in sides.iter().zip(results) {
        match result {
            Ok(finished) => runs.push(finished),
            Err(Error::Stopped) => stopped = true,
            Err(error) => complain!("error: {}: {error}", side.label),
        }
    }
    if stopped {
        complain!("{NOTHING_WRITTEN}");
    }
    (runs.len() == sides.len()).then_some(runs)
}

/// What matters most of the comparison.
fn tell(sides: &[Side], compared: &[Compared], ratios: &[Vec<Level>]) {
    let headline = brinell_report::compared_headline(sides, compared);
    for (k, side) in sides.iter().enumerate().skip(1) {
        if headline.iter().all(|one| one.ratios[k].is_none()) {
            say!("{}", nothing_in_common(side, &sides[0], compared.iter().filter(|c| c.ratios[k].is_some()).count()));
            continue;
        }
        say!("{} over {} (the baseline), ratios:", side.label, sides[0].label);
        for one in &headline {
            let Some(ratio) = one.ratios[k] else {
                continue;
            };
            let over = one.over[k].map_or(String::new(), |(of, to)| format!(" ({of} over {to})"));
            let interval = ratio.interval.map_or(String::new(), |(low, high)| {
                format!(" (95 %, scatter only: {} x to {} x)", short(low, 3), short(high, 3))
            });
            let assumed = band_of(ratios, k, &one.name).map(spread::words);
            say!("  {}{over}: {} x{interval}{}", one.name, short(ratio.value, 3), assumed.unwrap_or_default());
        }
    }
}

/// Where the numbers that are usually printed are not in both runs, and `common` others are.
fn nothing_in_common(side: &Side, baseline: &Side, common: usize) -> String {
    let others = match common {
        0 => "no other number is, either".to_owned(),
        1 => "the one number that is, is in compare.csv and compare.html".to_owned(),
        more => format!("the {more} numbers that are, are in compare.csv and compare.html"),
    };
    format!(
        "{} over {} (the baseline): the sensor's levels and the peaks at defect entry and exit are not in both runs; {others}",
        side.label, baseline.label
    )
}
