//! What runs will cost: the first steps of some of them are made, and the clock is read. Nothing of that enters the results.

use super::{Task, Work};
use brinell::Error;
use brinell::scenario::Scenario;
use brinell::simulate::{Simulation, cost};
use std::num::NonZeroUsize;
use std::time::Instant;

/// Runs that are tried: the first, the last, and some between.
const TRIED: usize = 5;

/// What a run will cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Steps.
    pub steps: f64,
    /// Wall time on this machine, s.
    pub seconds: f64,
}

/// What a run will cost.
///
/// # Errors
/// As [`cost`].
pub fn forecast(simulation: &Simulation) -> Result<Forecast, Error> {
    let begin = Instant::now();
    let cost = cost(simulation)?;
    let each = begin.elapsed().as_secs_f64() / cost.tried.max(1) as f64;
    Ok(Forecast { steps: cost.steps, seconds: each * cost.steps })
}

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
    Some(forecast(&simulation).ok()?.seconds / scenario.simulation.duration_s)
}
