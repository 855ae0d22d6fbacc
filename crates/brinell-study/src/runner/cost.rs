//! What a campaign will cost: some of its runs are made for a moment, and the clock is read. Nothing of that enters the
//! results.

use super::{Task, Work};
use brinell::result::finish;
use brinell::scenario::Scenario;
use brinell::simulate::{Progress, Simulation};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Runs that are tried: the first, the last, and some between.
const TRIED: usize = 5;
/// Wall time of one trial.
const MOMENT: Duration = Duration::from_millis(60);

/// Wall time of all tasks, s; `None` where no trial ran.
pub fn estimate(tasks: &[Task], work: &impl Work, threads: NonZeroUsize) -> Option<f64> {
    let simulated: f64 = tasks.iter().map(|task| task.duration_s).sum();
    let at_once = threads.get().min(tasks.len().max(1));
    let pace = mean_pace(tasks.len(), |k| work.scenario(&tasks[k]).ok())?;
    Some(pace * simulated / at_once as f64)
}

/// Wall time of a simulated second, s, of a few of `count` scenarios; `None` where no trial ran.
pub fn mean_pace(count: usize, scenario: impl Fn(usize) -> Option<Scenario>) -> Option<f64> {
    let tried = count.min(TRIED);
    let chosen = (0..tried).map(|k| k * (count - 1) / (tried - 1).max(1));
    let paces: Vec<f64> = chosen.filter_map(|k| pace(scenario(k)?)).collect();
    (!paces.is_empty()).then(|| paces.iter().sum::<f64>() / paces.len() as f64)
}

/// Wall time of a simulated second, s; `None` where the scenario does not run.
fn pace(scenario: Scenario) -> Option<f64> {
    let simulation = Simulation::unchecked(&scenario).ok()?;
    let (begin, duration) = (Instant::now(), scenario.simulation.duration_s);
    let mut reached = 0.0;
    let mut trial = Progress(|t| {
        reached = t;
        if begin.elapsed() > MOMENT { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    finish(scenario, simulation, &mut trial);
    let reached = f64::min(reached, duration);
    (reached > 0.0).then(|| begin.elapsed().as_secs_f64() / reached)
}
