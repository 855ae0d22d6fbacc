//! What a plan means and costs, in words; and why it is refused.

use super::DatasetArgs;
use crate::say::{complain, plural, say, short, twelve_digits};
use crate::sweep::duration;
use brinell::document::on_one_line;
use brinell::signal::objects;
use brinell_study::campaign::Misses;
use brinell_study::dataset::Campaign;
use brinell_study::design::{History, OutOfRange, Part, Survey};
use brinell_study::runner::mean_pace;
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
    if let Some(history) = &plan.history {
        tell_history(history, draws.to_the_end());
    }
    for (label, class) in plan.classes.iter().enumerate() {
        let runs = draws.runs_of(label);
        let machines = match plan.history {
            Some(_) => format!("{}, ", plural(draws.machines_of(label), "machine")),
            None => String::new(),
        };
        say!("  {label} {}: {machines}{}", class.name, plural(runs, "run"));
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

/// Machines, how many of them are seen until their life ends, and how their damage grows.
fn tell_history(history: &History, to_the_end: usize) {
    say!(
        "  {} of up to {}, one every {} h, observed until {} of the life; {to_the_end} of them to its end",
        plural(history.machines, "machine"),
        plural(history.snapshots, "snapshot"),
        history.every_h,
        history.observed
    );
    say!(
        "  assumed: {} with {} = {}, scatter {}; from {} mm to {} mm, where a machine counts as failed",
        history.law.word(),
        history.law.parameter(),
        history.steepness,
        history.scatter,
        history.begins_mm,
        history.fails_mm
    );
    say!("  damage begins at {} of the life, which is {} h", history.begins_at, history.life_h);
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

objects! {
    /// A data set before it runs.
    Planned {
        name: String, runs: usize, machines: Option<usize>, history: Option<String>, files: usize, design: &'static str, seed: u64,
        classes: Vec<Class>,
        splits: Vec<Split>, varies: Vec<String>, signals: Vec<String>, held_out_runs: usize, survey: Looked,
        bytes: f64, shard: Cost, warnings: Vec<String>,
    }
    /// Runs of a class.
    Class { label: usize, name: String, runs: usize }
    /// Runs of a split, by class.
    Split { name: &'static str, runs_of_classes: Vec<usize> }
    /// Runs looked at, those of them whose values make no scenario, and what becomes of these.
    Looked { runs: usize, no_scenario: usize, then: &'static str }
    /// What the shard costs.
    Cost { runs: usize, simulated_s: f64, at_a_time: usize, wall_s: Option<f64> }
}

/// The same as JSON.
pub(super) fn json(campaign: &Campaign, survey: &Survey, runs: usize, threads: NonZeroUsize) -> Planned {
    let (plan, draws) = (campaign.plan(), campaign.draws());
    let classes = plan.classes.iter().enumerate();
    let splits = draws.splits().into_iter();
    let Costs { bytes, simulated_s, at_a_time, wall_s } = Costs::of(campaign, survey, runs, threads);
    Planned {
        name: plan.name.clone(),
        runs: draws.runs(),
        machines: plan.history.as_ref().map(|history| history.machines),
        history: plan.history.as_ref().map(History::assumptions),
        files: campaign.parts(),
        design: plan.design.word(),
        seed: plan.seed,
        classes: classes.map(|(label, c)| Class { label, name: c.name.clone(), runs: draws.runs_of(label) }).collect(),
        splits: splits.map(|(part, runs_of_classes)| Split { name: part.word(), runs_of_classes }).collect(),
        varies: draws.parameters().iter().map(|p| p.key.clone()).collect(),
        signals: campaign.signals().iter().map(|s| s.name.clone()).collect(),
        held_out_runs: (0..draws.runs()).filter(|run| draws.is_held_out(*run)).count(),
        survey: Looked { runs: survey.runs, no_scenario: survey.unfit, then: fate(plan.out_of_range) },
        bytes: bytes.round(),
        shard: Cost { runs, simulated_s: twelve_digits(simulated_s), at_a_time, wall_s: wall_s.map(f64::ceil) },
        warnings: campaign.warnings(survey).iter().map(ToString::to_string).collect(),
    }
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
