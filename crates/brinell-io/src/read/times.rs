//! Columns of times: what they are called, in which unit they count, and the sample rate that follows from them.

use super::channel::Channel;

use std::ops::ControlFlow;

/// Steps between times may differ by so much from their mean, relative, before a rate is refused.
const UNEVEN: f64 = 0.02;
/// The mean step of later times may differ by so much from that of the first, relative.
const DRIFTS: f64 = 1e-3;
/// Steps in one digit of later times, at most, that have lost digits as they grew.
const COARSE: f64 = 64.0;
/// Times looked at together, at least; the first of them give the rate.
const TOGETHER: usize = 1 << 16;

/// What a column of times is called: `t`, `Time [s]`, `time_ms`.
const TIMES: [&str; 5] = ["t", "time", "times", "timestamp", "zeit"];

impl Channel {
    /// Whether it is called like a column of times.
    pub fn is_called_time(&self) -> bool {
        let name = bare(self);
        TIMES.contains(&name.as_str()) || named_unit(&name).is_some()
    }

    /// Whether it is called so, or its unit is one of time: no vibration has that.
    pub fn is_time(&self) -> bool {
        self.is_called_time() || self.unit.as_deref().and_then(seconds_in).is_some()
    }

    /// Seconds in its unit, of a column of times, where it states one that is known.
    pub fn seconds_in_unit(&self) -> Option<f64> {
        self.time_unit_words().as_deref().and_then(seconds_in).or_else(|| named_unit(&bare(self)))
    }

    /// The same of what [is one](Self::is_time).
    pub fn time_unit(&self) -> Option<f64> {
        self.is_time().then(|| self.seconds_in_unit())?
    }

    /// The unit of a column of times as the file spells it, known or not.
    pub fn time_unit_words(&self) -> Option<String> {
        let within = |name: &str| {
            let (_, unit) = name.split_once(['[', '('])?;
            Some(unit.split([']', ')']).next()?.trim().to_owned()).filter(|unit| !unit.is_empty())
        };
        self.unit.clone().or_else(|| within(self.own_name()))
    }

    /// That no unit of its times is known, in words.
    pub fn no_time_unit(&self) -> String {
        match self.time_unit_words() {
            Some(unit) => format!("the unit `{unit}` of its times in `{}` is not known", self.name),
            None => format!("no unit for its times in `{}`", self.name),
        }
    }
}

/// A channel's name, in small letters, without its groups and a unit in brackets.
fn bare(channel: &Channel) -> String {
    let name = channel.own_name();
    // A text file has no groups.
    let in_groups = channel.length.is_some() && !name.contains(['[', '(']);
    let own = name.rsplit(['.', '/']).next().filter(|_| in_groups).unwrap_or(name);
    let name = own.to_lowercase();
    name.split(['[', '(']).next().unwrap_or("").trim().to_owned()
}

/// Seconds in the unit that the name of a column of times ends in.
fn named_unit(bare: &str) -> Option<f64> {
    let (name, unit) = bare.rsplit_once('_')?;
    TIMES.contains(&name).then(|| seconds_in(unit))?
}

/// Seconds in a unit by its name: min, s, ms, us or ns.
pub fn seconds_in(unit: &str) -> Option<f64> {
    Some(match unit.trim().to_lowercase().as_str() {
        "min" | "minute" | "minutes" => 60.0,
        "s" | "sec" | "secs" | "second" | "seconds" | "sekunden" => 1.0,
        "ms" | "msec" | "millisecond" | "milliseconds" => 1e-3,
        "us" | "µs" | "μs" | "usec" | "microsecond" | "microseconds" => 1e-6,
        "ns" | "nsec" | "nanosecond" | "nanoseconds" => 1e-9,
        _ => return None,
    })
}

/// Why times give no sample rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoRate {
    /// Fewer than three.
    TooFew,
    /// The last is not after the first.
    NotIncreasing,
    /// One is no number.
    Missing {
        /// Values before it.
        after: usize,
    },
    /// Steps differ.
    Uneven {
        /// The step that differs most.
        step: f64,
        /// Values before it ends.
        after: usize,
        /// The middle one of all steps.
        usual: f64,
    },
}

/// Times as they are read, and the rate that they give.
pub(super) struct Clock {
    held: Vec<f64>,
    /// Times before those.
    before: usize,
    /// The first of all.
    first: f64,
    /// The mean step of the first times.
    usual: Option<f64>,
    fault: Option<NoRate>,
}

impl Clock {
    pub(super) fn new() -> Self {
        Self { held: Vec::new(), before: 0, first: f64::NAN, usual: None, fault: None }
    }

    /// Takes the next times; breaks off where no rate can follow any more.
    pub(super) fn take(&mut self, times: &[f64]) -> ControlFlow<()> {
        self.held.extend_from_slice(times);
        while self.held.len() > 2 * TOGETHER && self.fault.is_none() {
            // The last of these is looked at twice, for the step to it and from it.
            self.fault = self.look(TOGETHER + 1).err();
            self.held.drain(..TOGETHER);
            self.before += TOGETHER;
        }
        if self.fault.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Whether the next `n` are evenly spaced, as those before.
    fn look(&mut self, n: usize) -> Result<(), NoRate> {
        let times = &self.held[..n];
        let Some(usual) = self.usual else {
            self.first = *times.first().ok_or(NoRate::TooFew)?;
            self.usual = Some(even(times, 0.0)?);
            return Ok(());
        };
        let digit = times.windows(2).map(|w| w[1] - w[0]).filter(|step| *step > 0.0).fold(f64::INFINITY, f64::min);
        let digit = if digit <= COARSE * usual { digit } else { 0.0 };
        let step = even(times, digit).map_err(|why| why.later(self.before))?;
        match (step / usual - 1.0).abs() <= DRIFTS + 2.0 * digit / (usual * n as f64) {
            true => Ok(()),
            false => Err(NoRate::Uneven { step, after: self.before, usual }),
        }
    }

    /// The sample rate, Hz, where `unit` are the seconds in a unit of the times.
    ///
    /// # Errors
    /// Where they are not evenly spaced.
    pub(super) fn rate(mut self, unit: f64) -> Result<f64, NoRate> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        let n = self.held.len();
        self.look(n)?;
        let step = (self.held[n - 1] - self.first) / (self.before + n - 1) as f64;
        let hz = 1.0 / (step * unit);
        let round = hz.round();
        Ok(if (hz / round - 1.0).abs() < 1e-5 { round } else { hz })
    }
}

impl NoRate {
    /// The same, where so many values are before those that were looked at.
    fn later(self, before: usize) -> Self {
        match self {
            Self::Missing { after } => Self::Missing { after: before + after },
            Self::Uneven { step, after, usual } => Self::Uneven { step, after: before + after, usual },
            _ => self,
        }
    }
}

/// The mean step of evenly spaced times whose last digit is worth `digit` or less than a step.
fn even(times: &[f64], digit: f64) -> Result<f64, NoRate> {
    let n = times.len();
    if n < 3 {
        return Err(NoRate::TooFew);
    }
    if let Some(after) = times.iter().position(|t| !t.is_finite()) {
        return Err(NoRate::Missing { after });
    }
    let step = (times[n - 1] - times[0]) / (n - 1) as f64;
    if !(step > 0.0 && step.is_finite()) {
        return Err(NoRate::NotIncreasing);
    }
    // Printed times are rounded: allow for the digits that large values lose.
    let largest = times[0].abs().max(times[n - 1].abs());
    let allowed = (UNEVEN * step).max(4e-16 * largest);
    let off = times.windows(2).any(|w| (w[1] - w[0] - step).abs() > allowed);
    let strays = (0.6 * step).max(1.1 * digit);
    let rounded = || times.iter().enumerate().all(|(i, t)| (t - times[0] - i as f64 * step).abs() <= strays);
    if off && !rounded() {
        let steps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
        let middle = steps.len() / 2;
        let usual = *steps.clone().select_nth_unstable_by(middle, f64::total_cmp).1;
        let away = |(_, step): &(usize, &f64)| (*step - usual).abs();
        let worst = (steps.iter().enumerate()).max_by(|a, b| away(a).total_cmp(&away(b)));
        let (i, step) = worst.unwrap_or((0, &usual));
        return Err(NoRate::Uneven { step: *step, after: i + 1, usual });
    }
    Ok(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(times: impl Iterator<Item = f64>) -> Result<f64, NoRate> {
        let times: Vec<f64> = times.collect();
        let mut clock = Clock::new();
        // What comes after a break is not handed on.
        let _ = times.chunks(16 << 10).try_for_each(|piece| match clock.take(piece) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(()),
        });
        clock.rate(1.0)
    }

    const LONG: usize = 5 * TOGETHER + 777;

    #[test]
    fn analytic_even_times_of_any_length_give_their_rate() {
        let digits = |t: f64, digits: i32| (t * 10f64.powi(digits)).round() / 10f64.powi(digits);
        for n in [3, 1000, TOGETHER, 2 * TOGETHER + 1, LONG] {
            let even = |i: usize| i as f64 / 12_000.0;
            assert_eq!(rate((0..n).map(even)), Ok(12_000.0), "{n}");
            let printed = rate((0..n).map(|i| digits(even(i), 7))).unwrap();
            assert!((printed / 12_000.0 - 1.0).abs() < 1e-3, "{n}: {printed}");
            // A clock that counts from 1970.
            assert!((rate((0..n).map(|i| 1.7e9 + even(i))).unwrap() / 12_000.0 - 1.0).abs() < 5e-3, "{n}");
        }
        // Six digits in all, and single precision: digits are lost on the way.
        let six = |t: f64| digits(t, 5 - t.max(1e-9).log10().floor() as i32);
        let found = rate((0..LONG).map(|i| six(i as f64 / 2000.0))).unwrap();
        assert!((found / 2000.0 - 1.0).abs() < 1e-4, "{found}");
        let found = rate((0..40 * TOGETHER).map(|i| f64::from((i as f64 / 12_000.0) as f32))).unwrap();
        assert!((found / 12_000.0 - 1.0).abs() < 1e-5, "{found}");
    }

    #[test]
    fn analytic_a_gap_and_another_rate_are_found_wherever_they_are() {
        for at in [100, TOGETHER - 1, TOGETHER, TOGETHER + 1, 2 * TOGETHER, 3 * TOGETHER + 5, LONG - 2] {
            let gap = rate((0..LONG).map(|i| (i + if i >= at { 500 } else { 0 }) as f64 / 12_000.0));
            assert!(matches!(gap, Err(NoRate::Uneven { after, .. }) if after == at), "{at}: {gap:?}");
            let missing = rate((0..LONG).map(|i| if i == at { f64::NAN } else { i as f64 }));
            assert_eq!(missing, Err(NoRate::Missing { after: at }));
        }
        for (at, factor) in [(TOGETHER, 2.0), (3 * TOGETHER, 1.01), (2 * TOGETHER + 99, 1.5), (LONG - 9, 2.0)] {
            let other = rate((0..LONG).map(|i| if i < at { i as f64 } else { at as f64 + (i - at) as f64 * factor }));
            assert!(matches!(other, Err(NoRate::Uneven { .. })), "{at} {factor}: {other:?}");
        }
    }
}
