//! How fast a run goes: how many steps it will take, and whether it may.

/// Steps from which on a run that would take too many is refused where its pace is steady: the start may be stiffer than what follows.
const WATCHED: u64 = 65_536;
/// The same however its pace is.
const SURE: u64 = 8 * WATCHED;
/// Factor between the mean steps of one stretch and of the next, twice as long, up to which the pace is steady.
const STEADY: f64 = 1.5;

/// How fast time goes.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    /// Steps, of a number that doubles, and the time then reached, s.
    marks: [(u64, f64); 2],
    /// End of the run, s.
    end: f64,
    /// Steps that the run may take.
    pub(super) most: f64,
}

/// What the later half of the steps so far tells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Told {
    /// Steps of the whole run.
    pub(super) steps: f64,
    /// Mean length of a step, s.
    pub(super) step: f64,
    /// Whether the quarter before went as fast.
    pub(super) steady: bool,
}

impl Pace {
    pub(super) fn new(end: f64, most: f64) -> Self {
        Self { marks: [(0, 0.0); 2], end, most }
    }

    /// Without bound, of a run without end.
    pub(super) fn unbounded() -> Self {
        Self::new(0.0, f64::INFINITY)
    }

    /// After so many steps at the time `t`, each time that their number has doubled.
    pub(super) fn told(&mut self, steps: u64, t: f64) -> Option<Told> {
        if steps < 2 * self.marks[1].0 {
            return None;
        }
        let mean = |(n, t): (u64, f64), (before, from): (u64, f64)| (t - from) / (n - before).max(1) as f64;
        let (step, before) = (mean((steps, t), self.marks[1]), mean(self.marks[1], self.marks[0]));
        self.marks = [self.marks[1], (steps, t)];
        let steady = step < STEADY * before && before < STEADY * step;
        Some(Told { steps: self.whole(steps, t, step), step, steady })
    }

    /// Steps of the whole run, where those to come are as long as `step`, s.
    fn whole(&self, steps: u64, t: f64, step: f64) -> f64 {
        steps as f64 + (self.end - t).max(0.0) / step
    }

    /// What is told where the run is to be refused: it has taken too many steps, or will have.
    pub(super) fn too_long(&mut self, steps: u64, t: f64) -> Option<Told> {
        let told = self.told(steps, t);
        if steps as f64 >= self.most {
            let step = t / steps as f64;
            return Some(Told { steps: self.whole(steps, t, step), step, steady: false });
        }
        told.filter(|told| told.steps > self.most && (steps >= SURE || steps >= WATCHED && told.steady))
    }
}
