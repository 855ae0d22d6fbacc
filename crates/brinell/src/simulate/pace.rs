//! How fast a run goes: how many steps it will take, and whether it may.

/// Steps after which a run that would take too many is refused: the start may be stiffer than what follows.
const WATCHED: std::ops::Range<u64> = 65_536..131_072;

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
    pub(super) fn expected(&self, steps: u64, t: f64) -> (f64, f64) {
        let (before, from) = self.marks[0];
        let step = (t - from) / (steps - before).max(1) as f64;
        (steps as f64 + (self.end - t).max(0.0) / step, step)
    }

    /// Steps that the run may take.
    pub(super) fn most(&self) -> f64 {
        self.most as f64
    }

    /// What they are where a run is to be refused: it has taken too many steps, or soon will have.
    pub(super) fn too_long(&mut self, steps: u64, t: f64) -> Option<(f64, f64)> {
        let told = self.expected(steps, t);
        if steps >= 2 * self.marks[1].0 {
            self.marks = [self.marks[1], (steps, t)];
        }
        (steps >= self.most || WATCHED.contains(&steps) && told.0 > self.most()).then_some(told)
    }
}
