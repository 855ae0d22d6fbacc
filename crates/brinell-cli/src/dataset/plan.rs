//! What a plan means and costs, in words; and why it is refused.

use super::DatasetArgs;
use crate::say::{complain, plural, say, short, twelve_digits};
use crate::sweep::duration;
use brinell::document::on_one_line;
use brinell_study::campaign::Misses;
use brinell_study::dataset::Campaign;
use brinell_study::design::{OutOfRange, Part, Survey};
use brinell_study::runner::mean_pace;
use serde_json::{Value, json};
use std::num::NonZeroUsize;

/// Share of a 32-bit float that is left after compression, about: the low mantissa bytes are noise.
const COMPRESSED: f64 = 0.9;
/// Bytes of a row beside its signals, about.
const BESIDES: f64 = 12e3;

/// The plan, to standard output; warnings to standard error.
pub(super) fn tell(campaign: &Campaign, survey: &Survey, runs: usize, threads: NonZeroUsize, args: &DatasetArgs) {
    let (plan, draws) = (campaign.plan(), campaign.draws());
    if args.quiet {
        return;
    }
    for warning in campaign.warnings(survey) {
        complain!("{warning}");
    }
    say!(
        "{}: {} in {}, design {}, seed {}",
        plan.name,
        plural(draws.runs(), "run"),
        plural(campaign.parts(), "file"),
        plan.design.word(),
        plan.seed
    );
    for (label, class) in plan.classes.iter().enumerate() {
        say!("  {label} {}: {}", class.name, plural(draws.runs_of(label), "run"));
    }
    tell_splits(campaign);
    let names: Vec<&str> = draws.parameters().iter().map(|p| p.key.as_str()).collect();
    say!("  varies: {}", if names.is_empty() { "nothing".into() } else { names.join(", ") });
    let signals: Vec<&str> = campaign.signals().iter().map(|s| s.name.as_str()).collect();
    say!("  signals: {}", signals.join(", "));
    if plan.holds_out() {
        let apart = (0..draws.runs()).filter(|run| draws.is_held_out(*run)).count();
        say!("  labels of {} in held_out/", plural(apart, "run"));
    }
    if survey.unfit > 0 {
        say!(
            "  {} of {} looked at draw values that make no scenario: {}",
            survey.unfit,
            plural(survey.runs, "run"),
            fate(plan.out_of_range)
        );
        // Where the plan is refused for them, that says which.
        if survey.is_sound(plan.out_of_range) {
            tell_misses(survey);
        }
    }
    let costs = Costs::of(campaign, survey, runs, threads);
    let about = (costs.wall_s).map_or(String::new(), |s| format!(", about {}", duration(s)));
    say!(
        "  about {}; {} of this shard: {} s simulated, {} at a time{about}",
        size(costs.bytes),
        plural(runs, "run"),
        short(costs.simulated_s, 3),
        costs.at_a_time
    );
}

/// Runs of each class by split, where the runs are divided.
pub(super) fn tell_splits(campaign: &Campaign) {
    let (classes, splits) = (&campaign.plan().classes, campaign.draws().splits());
    if splits.len() < 2 {
        return;
    }
    let names = || std::iter::once("class").chain(classes.iter().map(|class| class.name.as_str()));
    let width = names().map(|name| name.chars().count()).max().unwrap_or(0);
    for (row, name) in names().enumerate() {
        let cell = |(part, runs): &(Part, Vec<usize>)| {
            let head = part.word();
            let text = row.checked_sub(1).map_or(head.to_owned(), |class| runs[class].to_string());
            format!("  {text:>0$}", head.len().max(7))
        };
        let cells: String = splits.iter().map(cell).collect();
        say!("  {name:<width$}{cells}");
    }
}

/// What becomes of values that make no scenario.
fn fate(out_of_range: OutOfRange) -> &'static str {
    match out_of_range {
        OutOfRange::Refuse => "refused",
        OutOfRange::Redraw => "drawn again",
        OutOfRange::Fail => "kept as failed",
    }
}

/// The same as JSON.
pub(super) fn json(campaign: &Campaign, survey: &Survey, runs: usize, threads: NonZeroUsize) -> Value {
    let (plan, draws) = (campaign.plan(), campaign.draws());
    let classes = plan.classes.iter().enumerate();
    let classes: Vec<Value> =
        classes.map(|(label, c)| json!({ "label": label, "name": c.name, "runs": draws.runs_of(label) })).collect();
    let splits = draws.splits().into_iter();
    let splits = splits.map(|(part, runs)| json!({ "name": part.word(), "runs_of_classes": runs }));
    let names = draws.parameters().iter().map(|p| p.key.as_str());
    let held_out = (0..draws.runs()).filter(|run| draws.is_held_out(*run));
    let warnings = campaign.warnings(survey);
    let costs = Costs::of(campaign, survey, runs, threads);
    json!({
        "name": plan.name,
        "runs": draws.runs(),
        "files": campaign.parts(),
        "design": plan.design.word(),
        "seed": plan.seed,
        "classes": classes,
        "splits": splits.collect::<Vec<_>>(),
        "varies": names.collect::<Vec<_>>(),
        "signals": campaign.signals().iter().map(|s| s.name.as_str()).collect::<Vec<_>>(),
        "held_out_runs": held_out.count(),
        "survey": { "runs": survey.runs, "no_scenario": survey.unfit, "then": fate(plan.out_of_range) },
        "bytes": costs.bytes.round(),
        "shard": { "runs": runs, "simulated_s": twelve_digits(costs.simulated_s), "at_a_time": costs.at_a_time, "wall_s": costs.wall_s.map(f64::ceil) },
        "warnings": warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// What a data set and a shard of it cost, about.
struct Costs {
    /// Of the data set.
    bytes: f64,
    /// Of the shard, s.
    simulated_s: f64,
    /// Runs of the shard at a time.
    at_a_time: usize,
    /// Of the shard, s; `None` where no trial ran.
    wall_s: Option<f64>,
}

impl Costs {
    fn of(campaign: &Campaign, survey: &Survey, runs: usize, threads: NonZeroUsize) -> Self {
        let all = campaign.draws().runs() as f64;
        let looked = survey.runs.max(1) as f64;
        let good = (survey.runs - survey.hopeless).max(1) as f64;
        let simulated_s = survey.simulated / good * runs as f64;
        let values = survey.samples / good * all * campaign.signals().len() as f64;
        Self {
            bytes: 4.0 * COMPRESSED * values + BESIDES * all * (1.0 - survey.hopeless as f64 / looked),
            simulated_s,
            at_a_time: threads.get().min(runs.max(1)),
            wall_s: cost(campaign, simulated_s, runs, threads),
        }
    }
}

fn tell_misses(survey: &Survey) {
    for Misses { problem, run, count, .. } in &survey.errors {
        complain!(
            "  {count} of {}, such as run {run}: {}",
            plural(survey.runs, "run"),
            on_one_line(std::slice::from_ref(problem))
        );
    }
}

/// Wall time of so many simulated seconds, s; `None` where no trial ran.
fn cost(campaign: &Campaign, seconds: f64, runs: usize, threads: NonZeroUsize) -> Option<f64> {
    let scenario = |run| Some(campaign.scenario(run).ok()?.0.scenario);
    let pace = mean_pace(campaign.draws().runs(), scenario)?;
    Some(pace * seconds / threads.get().min(runs.max(1)) as f64)
}

fn size(bytes: f64) -> String {
    match bytes {
        b if b < 1e6 => format!("{} kB", (b / 1e3).ceil()),
        b if b < 1e9 => format!("{} MB", (b / 1e6).ceil()),
        b => format!("{:.1} GB", b / 1e9),
    }
}
