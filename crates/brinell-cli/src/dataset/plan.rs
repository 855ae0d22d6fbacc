//! What a plan means and costs, in words; and why it is refused.

use super::DatasetArgs;
use crate::say::{complain, say, short};
use crate::sweep::{duration, plural};
use brinell::document::on_one_line;
use brinell_study::dataset::Campaign;
use brinell_study::design::{Misses, OutOfRange, Survey};
use brinell_study::runner::mean_pace;
use std::num::NonZeroUsize;

/// Share of a 32-bit float that is left after compression, about: the low mantissa bytes are noise.
const COMPRESSED: f64 = 0.9;
/// Bytes of a row beside its signals, about.
const BESIDES: f64 = 12e3;

/// The plan, to standard output; warnings to standard error.
pub(super) fn tell(
    campaign: &Campaign,
    survey: &Survey,
    runs: usize,
    threads: NonZeroUsize,
    args: &DatasetArgs,
) {
    let (plan, draws) = (campaign.plan(), campaign.draws());
    for warning in campaign.warnings(survey) {
        complain!("{warning}");
    }
    if args.quiet {
        return;
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
        say!(
            "  {label} {}: {}",
            class.name,
            plural(draws.runs_of(label), "run")
        );
    }
    let names: Vec<&str> = draws.parameters().iter().map(|p| p.key.as_str()).collect();
    say!(
        "  varies: {}",
        if names.is_empty() {
            "nothing".into()
        } else {
            names.join(", ")
        }
    );
    let signals: Vec<&str> = campaign.signals().iter().map(|s| s.name.as_str()).collect();
    say!("  signals: {}", signals.join(", "));
    if plan.holds_out() {
        let apart = (0..draws.runs())
            .filter(|run| draws.is_held_out(*run))
            .count();
        say!("  labels of {} in held_out/", plural(apart, "run"));
    }
    let looked = survey.runs.max(1) as f64;
    if survey.unfit > 0 {
        let then = match plan.out_of_range {
            OutOfRange::Refuse => "refused",
            OutOfRange::Redraw => "drawn again",
            OutOfRange::Fail => "kept as failed",
        };
        say!(
            "  {} of {} looked at draw values that make no scenario: {then}",
            survey.unfit,
            plural(survey.runs, "run")
        );
        // Where the plan is refused for them, that says which.
        if survey.is_sound(plan.out_of_range) {
            tell_misses(survey);
        }
    }
    let good = (survey.runs - survey.hopeless).max(1) as f64;
    let seconds = survey.simulated / good * runs as f64;
    let values = survey.samples / good * draws.runs() as f64 * signals.len() as f64;
    let bytes = 4.0 * COMPRESSED * values
        + BESIDES * draws.runs() as f64 * (1.0 - survey.hopeless as f64 / looked);
    let cost = cost(campaign, seconds, runs, threads)
        .map_or(String::new(), |s| format!(", about {}", duration(s)));
    say!(
        "  about {}; {} of this shard: {} s simulated, {} at a time{cost}",
        size(bytes),
        plural(runs, "run"),
        short(seconds, 3),
        threads.get().min(runs.max(1))
    );
}

fn tell_misses(survey: &Survey) {
    for Misses {
        problem,
        run,
        count,
    } in &survey.errors
    {
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
