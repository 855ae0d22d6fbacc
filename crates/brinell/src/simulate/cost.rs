//! What a run costs: how many steps it will take, told by its first ones.

use super::pace::Pace;
use super::{End, Observer, Run, Simulation, SolverWork};
use crate::error::Error;
use std::ops::ControlFlow;

/// Steps that tell what a run costs.
const TRIED: u64 = 4096;

/// What a run will cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Steps of the whole run, at the pace of the later half of those that were tried.
    pub steps: f64,
    /// Steps that were tried.
    pub tried: u64,
}

/// What a run will cost, by its first steps; where they say that it would take more than it may, by more of them.
///
/// # Errors
/// [`Error::TooLong`], and where the run fails in its first steps.
pub fn cost(simulation: &Simulation) -> Result<Cost, Error> {
    struct First(Pace, Cost);
    impl Observer for First {
        fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
            let steps = work.solver.steps;
            self.1 = Cost { steps: self.0.expected(steps, t).0, tried: steps };
            self.0.too_long(steps, t);
            match steps >= TRIED && self.1.steps <= self.0.most() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        }
    }
    let mut run = Run::new(simulation);
    let mut first = First(run.pace().clone(), Cost { steps: 0.0, tried: 0 });
    match run.advance(u64::MAX, &mut first) {
        Some(End::Failed(error)) => Err(error),
        Some(End::Stopped) => Ok(first.1),
        Some(End::Complete) | None => {
            let steps = run.work().steps;
            Ok(Cost { steps: steps as f64, tried: steps })
        }
    }
}
