//! What a run costs: how many steps it will take, told by its first ones.

use super::pace::{Pace, Told};
use super::{End, Observer, Run, Simulation, SolverWork};
use crate::error::Error;
use std::ops::ControlFlow;

/// Least steps that tell what a run costs.
const TRIED: u64 = 1024;
/// Steps times rolling elements, of tilting ones slices, that a trial takes at most where the run is none too long.
const TRIAL: u64 = 4_000_000;

/// What a run will cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Steps of the whole run, at the pace of the later half of those that were tried: where that is steady and the start over, within a
    /// factor of some two; what comes later, such as damage or a cage that leaves its place, is not in it.
    pub steps: f64,
    /// Steps that were tried.
    pub tried: u64,
}

/// What a run will cost, by its first steps: until the start is over and the pace is steady, or as many as a trial may take.
///
/// # Errors
/// [`Error::TooLong`], and where the run fails in its first steps.
pub fn cost(simulation: &Simulation) -> Result<Cost, Error> {
    struct First {
        pace: Pace,
        /// From when on the pace is that of the run, s.
        settled: f64,
        enough: u64,
        told: Option<Told>,
        tried: u64,
    }
    impl Observer for First {
        fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
            let steps = work.solver.steps;
            let Some(told) = self.pace.told(steps, t) else { return ControlFlow::Continue(()) };
            (self.told, self.tried) = (Some(told), steps);
            let known = told.steady && t >= self.settled && told.steps <= self.pace.most;
            match steps >= TRIED && (known || steps >= self.enough) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        }
    }
    let mut run = Run::new(simulation);
    let model = simulation.model();
    let slices = model.slices.as_ref().filter(|_| model.layout.tilts).map_or(1, |slices| slices.count);
    let mut first = First {
        pace: run.pace().clone(),
        settled: simulation.settled,
        enough: TRIAL / (model.layout.rollers() * slices) as u64,
        told: None,
        tried: 0,
    };
    match (run.advance(u64::MAX, &mut first), first.told) {
        (Some(End::Failed(error)), _) => Err(error),
        (Some(End::Stopped), Some(told)) if told.steps > first.pace.most => Err(run.too_long(told)),
        (Some(End::Stopped), Some(told)) => Ok(Cost { steps: told.steps, tried: first.tried }),
        _ => {
            let steps = run.work().steps;
            Ok(Cost { steps: steps as f64, tried: steps })
        }
    }
}
