//! A plan looked over before any of its runs: which drawn values do not make a scenario, and how often.

use super::draws::Draws;
use super::plan::OutOfRange;
use super::repeats::print;
use crate::campaign::{Misses, count, join};
use brinell::document::{Place, Problem, Severity, locate};
use brinell::many;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

/// Runs looked at as one job.
const CHUNK: usize = 64;

/// What came of looking.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Survey {
    /// Runs looked at.
    pub runs: usize,
    /// Of them, those whose first draw makes no scenario.
    pub unfit: usize,
    /// Of those, the ones that no further draw mended.
    pub hopeless: usize,
    /// What was wrong with first draws, errors first, each kind once.
    pub errors: Vec<Misses>,
    /// What authors of the scenarios should know.
    pub warnings: Vec<Misses>,
    /// Runs whose static balance was solved: the first ones.
    pub balanced: usize,
    /// What authors of those should know.
    pub before: Vec<Misses>,
    /// Simulated time of the runs looked at, s.
    pub simulated: f64,
    /// Of the runs looked at, those with damage.
    pub damaged: usize,
    /// Samples of the runs looked at.
    pub samples: f64,
    /// Of each run looked at that makes a scenario: what it sets, for [`Repeats::of`](super::Repeats::of).
    pub prints: Vec<(usize, u64)>,
}

impl Survey {
    /// Looks at every `step`-th run; once `stop` is set, at no further ones.
    pub fn of(draws: &Draws, base: &str, step: NonZeroUsize, threads: NonZeroUsize, stop: &AtomicBool) -> Self {
        let looked = draws.runs().div_ceil(step.get());
        let chunks = looked.div_ceil(CHUNK);
        let parts = many::map(chunks, threads, |k| {
            let mut part = Self::default();
            if stop.load(Ordering::Relaxed) {
                return part;
            }
            for n in k * CHUNK..((k + 1) * CHUNK).min(looked) {
                part.look(draws, base, n * step.get());
            }
            part
        });
        // In the runs' order, whatever the threads did.
        let mut all = Self::default();
        parts.into_iter().for_each(|part| all.join(part));
        all
    }

    /// Whether the plan can be carried out as written.
    pub fn is_sound(&self, out_of_range: OutOfRange) -> bool {
        match out_of_range {
            OutOfRange::Refuse => self.unfit == 0,
            OutOfRange::Redraw => self.hopeless == 0,
            OutOfRange::Fail => self.unfit < self.runs,
        }
    }

    fn look(&mut self, draws: &Draws, base: &str, run: usize) {
        self.runs += 1;
        let (problems, loaded) = match draws.scenario(base, run) {
            Ok((loaded, draw)) => {
                let again = draw.redrawn > 0;
                self.prints.push((run, print(&draw.settings, &loaded.scenario)));
                let problems = match draws.first(base, run) {
                    Ok(first) if again => brinell::document::read(base, &first.settings).err(),
                    _ => None,
                };
                (problems.unwrap_or_default(), Some(loaded))
            }
            Err((problems, _)) => {
                self.hopeless += 1;
                (problems, None)
            }
        };
        let is_error = |p: &Problem| p.severity == Severity::Error;
        self.unfit += usize::from(problems.iter().any(is_error));
        for problem in problems.into_iter().filter(is_error) {
            count(&mut self.errors, without_override(problem), run);
        }
        if let Some(loaded) = loaded {
            let simulation = &loaded.scenario.simulation;
            self.simulated += simulation.duration_s;
            self.damaged += usize::from(!loaded.scenario.defects.is_empty());
            self.samples += simulation.duration_s * simulation.sample_rate_hz;
            for warning in loaded.warnings {
                count(&mut self.warnings, without_override(warning), run);
            }
        }
    }

    fn join(&mut self, other: Self) {
        self.runs += other.runs;
        self.unfit += other.unfit;
        self.hopeless += other.hopeless;
        self.simulated += other.simulated;
        self.damaged += other.damaged;
        self.samples += other.samples;
        self.prints.extend(other.prints);
        for (mine, theirs) in [(&mut self.errors, other.errors), (&mut self.warnings, other.warnings)] {
            for miss in theirs {
                join(mine, miss);
            }
        }
    }
}

fn without_override(mut problem: Problem) -> Problem {
    problem.message = unsaid(&problem.message);
    problem
}

/// A message without the word that its value is an override's: in a plan every drawn value is, and in Python every value.
pub fn unsaid(message: &str) -> String {
    message.replace(" (given as an override)", "")
}

/// Where the plan sets the key that a problem of a run is about: a place in the plan's text. `None` where it does not:
/// the base does.
pub(crate) fn place_in_plan(draws: &Draws, plan_text: &str, run: usize, problem: &Problem) -> Option<Place> {
    let class = draws.class(run);
    // A key of the plan itself.
    if ["history.", "classes."].iter().any(|table| problem.key.starts_with(table)) {
        return locate(plan_text, &problem.key);
    }
    let mut key = problem.key.as_str();
    loop {
        let own = format!("classes.{class}");
        for at in ["vary", "history.snapshot", &format!("{own}.vary"), &own].map(|table| format!("{table}.{key}")) {
            if let Some(place) = locate(plan_text, &at) {
                return Some(place);
            }
        }
        // What holds the key may be what the plan sets.
        key = key.rsplit_once('.')?.0;
    }
}
