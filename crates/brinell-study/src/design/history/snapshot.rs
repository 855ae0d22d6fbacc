//! A machine at one time of its life.

use super::History;
use crate::design::distribution::Value;
use brinell::scenario::Surface;
use brinell::signal::rounded;

/// Significant digits of a time and a length, as of a drawn number.
const DIGITS: usize = 9;

/// What a machine is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// Without damage.
    Healthy,
    /// With damage that it runs with.
    Damaged,
    /// Damage has the length of failure.
    Failed,
}

impl State {
    /// As the column says it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Healthy => "healthy",
            Self::Damaged => "damaged",
            Self::Failed => "failed",
        }
    }
}

/// When a machine is looked at: a plan's interval, which has nothing to do with its life, from new on until it is seen for the
/// last time. Running times of all snapshots, h; the last one of a machine that is seen to fail is its life to the last digit.
pub(in crate::design) fn times(history: &History, drawn: &[Value]) -> Vec<f64> {
    let Drawn { every_h, life_h, observed, .. } = Drawn::of(history, drawn);
    let end = observed * life_h;
    let regular = (0..history.snapshots).map(|k| rounded(every_h * k as f64, DIGITS)).take_while(|h| *h < end);
    let mut times: Vec<f64> = regular.collect();
    if observed >= 1.0 && times.len() < history.snapshots {
        times.push(end);
    }
    times
}

/// Whether the last snapshot is at the end of the life.
pub(in crate::design) fn is_to_the_end(history: &History, drawn: &[Value]) -> bool {
    times(history, drawn).last() == Some(&Drawn::of(history, drawn).life_h)
}

/// What a machine's life has drawn.
struct Drawn {
    every_h: f64,
    begins_mm: f64,
    fails_mm: f64,
    life_h: f64,
    begins_at: f64,
    observed: f64,
    steepness: f64,
}

impl Drawn {
    fn of(history: &History, drawn: &[Value]) -> Self {
        let mut drawn = drawn.iter();
        let [every_h, begins_mm, fails_mm, life_h, begins_at, observed, steepness] =
            history.drawn().map(|(_, value)| value.number(&mut drawn));
        Self { every_h, begins_mm, fails_mm, life_h, begins_at, observed, steepness }
    }
}

/// One snapshot of a history.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Number of the machine, from 0.
    pub machine: usize,
    /// Number of the snapshot, from 0.
    pub number: usize,
    /// Running time since the machine was new, h.
    pub time_h: f64,
    /// Of all snapshots of the machine.
    times_h: Vec<f64>,
    /// Running time until failure, h.
    pub life_h: f64,
    /// Running time until damage begins, h.
    pub begins_h: f64,
    /// Length at which the machine counts as failed, mm.
    pub fails_mm: f64,
    /// Length of damage, mm; 0 without.
    pub length_mm: f64,
    /// Damaged surface, sooner or later; `None` of a machine that stays healthy.
    pub on: Option<Surface>,
    /// Which bearing it is of, from 0.
    pub bearing: usize,
    /// Turns of the shaft since the machine was new, and since damage began; `None` where the speed varies within a
    /// snapshot.
    pub turns: Option<[f64; 2]>,
}

impl Snapshot {
    /// Of a machine whose life has these values drawn; `on` is what its damage is on, `places` where its increments are in
    /// their distribution.
    pub(in crate::design) fn of(
        history: &History,
        (machine, number): (usize, usize),
        on: Option<Surface>,
        drawn: &[Value],
        places: impl Fn(usize) -> f64,
    ) -> Self {
        let times_h = times(history, drawn);
        let Drawn { begins_mm, fails_mm, life_h, begins_at, steepness, .. } = Drawn::of(history, drawn);
        let time_h = times_h.get(number).copied().unwrap_or(f64::NAN);
        let begins_h = rounded(begins_at * life_h, DIGITS);
        let is_failed = time_h >= life_h;
        let grown = match is_failed {
            true => 1.0,
            false => {
                let x = (time_h - begins_h) / (life_h - begins_h);
                history.law.scattered(x, steepness, history.scatter, places)
            }
        };
        let length_mm = match on {
            Some(_) if time_h >= begins_h || is_failed => begins_mm + grown * (fails_mm - begins_mm),
            _ => 0.0,
        };
        Self {
            machine,
            number,
            time_h,
            times_h,
            life_h,
            begins_h,
            fails_mm,
            length_mm: rounded(length_mm, DIGITS),
            on,
            bearing: 0,
            turns: None,
        }
    }

    /// What the machine is.
    pub fn state(&self) -> State {
        match self.on {
            Some(_) if self.time_h >= self.life_h => State::Failed,
            Some(_) if self.length_mm > 0.0 => State::Damaged,
            _ => State::Healthy,
        }
    }

    /// Whether its failure is not seen.
    pub fn is_censored(&self) -> bool {
        self.on.is_none() || self.times_h.last().is_none_or(|last| *last < self.life_h)
    }

    /// A number of a machine that fails.
    fn where_it_fails(&self, x: f64) -> Option<f64> {
        self.on.map(|_| x)
    }

    /// Running time until failure, h.
    pub fn life(&self) -> Option<f64> {
        self.where_it_fails(self.life_h)
    }

    /// Running time until damage begins, h.
    pub fn begins(&self) -> Option<f64> {
        self.where_it_fails(self.begins_h)
    }

    /// Length at which it fails, mm.
    pub fn fails(&self) -> Option<f64> {
        self.where_it_fails(self.fails_mm)
    }

    /// Running time from here until failure, h.
    pub fn remaining(&self) -> Option<f64> {
        self.where_it_fails(rounded(self.life_h - self.time_h, DIGITS))
    }

    /// Share of the life that is over.
    pub fn share(&self) -> Option<f64> {
        self.where_it_fails(rounded(self.time_h / self.life_h, DIGITS))
    }

    /// Turns of the shaft up to here, where each snapshot's speed (r/min) holds from the one before it.
    pub(in crate::design) fn turned(&self, speeds: &[f64]) -> [f64; 2] {
        let each = (1..=self.number).map(|k| {
            let [from, to] = [self.times_h[k - 1], self.times_h[k]];
            [to - from, (to - from.max(self.begins_h)).max(0.0)].map(|h| 60.0 * h * speeds[k].abs())
        });
        let sum = each.fold([0.0, 0.0], |sum, turns| [sum[0] + turns[0], sum[1] + turns[1]]);
        sum.map(|x| rounded(x, DIGITS))
    }
}
