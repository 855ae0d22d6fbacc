//! What a run costs: how many steps it will take, told by its first ones.

use super::{End, Observer, Run, Simulation, SolverWork};
use crate::error::Error;
use std::ops::ControlFlow;

/// Steps that tell what a run costs.
const TRIED: u64 = 4096;
/// Steps after which a run that would take too many is refused: the start may be stiffer than what follows.
const WATCHED: u64 = 16 * TRIED;

/// What a run will cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Steps of the whole run, at the pace of the later half of those that were tried.
    pub steps: f64,
    /// Steps that were tried.
    pub tried: u64,
}

/// How fast time goes: the pace of the later half of the steps so far.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    /// Steps, of a number that doubles, and the time then reached, s.
    marks: [(u64, f64); 2],
    /// End of the run, s.
    end: f64,
    most: u64,
}

impl Pace {
    pub(super) fn new(end: f64, most: u64) -> Self {
        Self { marks: [(0, 0.0); 2], end, most }
    }

    /// Without bound, of a run without end.
    pub(super) fn unbounded() -> Self {
        Self::new(0.0, u64::MAX)
    }

    /// After so many steps at the time `t`: all the steps that the run takes, and the mean of the later ones, s.
    fn expected(&self, steps: u64, t: f64) -> (f64, f64) {
        let (before, from) = self.marks[0];
        let step = (t - from) / (steps - before).max(1) as f64;
        (steps as f64 + (self.end - t).max(0.0) / step, step)
    }

    /// What they are where a run is to be refused: it has taken too many steps, or soon will have.
    pub(super) fn too_long(&mut self, steps: u64, t: f64) -> Option<(f64, f64)> {
        let told = self.expected(steps, t);
        if steps >= 2 * self.marks[1].0 {
            self.marks = [self.marks[1], (steps, t)];
        }
        let most = self.most as f64;
        (steps >= self.most || steps >= WATCHED && steps < 2 * WATCHED && told.0 > most).then_some(told)
    }
}

/// Tries the first steps of a run.
pub(super) fn tried(simulation: &Simulation) -> Result<Cost, Error> {
    struct First(Pace, Cost);
    impl Observer for First {
        fn progress(&mut self, t: f64, work: &SolverWork) -> ControlFlow<()> {
            let steps = work.solver.steps;
            self.1 = Cost { steps: self.0.expected(steps, t).0, tried: steps };
            self.0.too_long(steps, t);
            match steps >= TRIED && self.1.steps <= self.0.most as f64 {
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
