//! Columns of times: what they are called, in which unit they count, and the sample rate that follows from them.

use super::channel::Channel;

use std::ops::ControlFlow;

/// Steps between times may differ by so much from their mean, relative, before a rate is refused.
const UNEVEN: f64 = 0.02;
/// The first times, which are looked at one by one.
const TOGETHER: usize = 1 << 16;
/// Times whose mean is taken: what printed digits lose averages out.
const STRETCH: usize = 1 << 10;
/// First times from which the usual step is known well enough for that.
const WELL_KNOWN: usize = 16 * STRETCH;
/// Steps by which the means of two stretches, one between them, may lie apart: a lost sample moves them by one.
const SHIFT: f64 = 0.6;
/// Steps by which the last time may lie off.
const AT_THE_END: f64 = 3.0;

/// What a column of times is called: `t`, `Time [s]`, `time_ms`.
const TIMES: [&str; 5] = ["t", "time", "times", "timestamp", "zeit"];

impl Channel {
    /// Whether its name is that of a column of times: `t`, `Time [s]`, `time_ms`.
    pub fn is_called_time(&self) -> bool {
        let name = bare(self);
        TIMES.contains(&name.as_str()) || named_unit(&name).is_some()
    }

    /// Whether it is a column of times: by its name, or by its unit, as no vibration is in seconds.
    pub fn is_time(&self) -> bool {
        self.is_called_time() || self.unit.as_deref().and_then(seconds_in).is_some()
    }

    /// Seconds in one of its unit, where the file states a unit of time that is known. The name is not looked at, but for
    /// a unit that it ends in.
    pub fn seconds_in_unit(&self) -> Option<f64> {
        self.time_unit().as_deref().and_then(seconds_in).or_else(|| named_unit(&bare(self)))
    }

    /// Seconds in one of its unit, where it [is a column of times](Self::is_time) and the unit is known.
    pub fn seconds_in_time_unit(&self) -> Option<f64> {
        self.is_time().then(|| self.seconds_in_unit())?
    }

    /// The unit of a column of times as the file spells it, known or not: of the channel, or in brackets in its name.
    pub fn time_unit(&self) -> Option<String> {
        let within = |name: &str| {
            let (_, unit) = name.split_once(['[', '('])?;
            // An index is no unit: `X[1].Data`.
            let unit = unit.split([']', ')']).next()?.trim();
            Some(unit.to_owned()).filter(|unit| !unit.is_empty() && unit.parse::<f64>().is_err())
        };
        self.unit.clone().or_else(|| within(self.own_name()))
    }

    /// A message: why [`seconds_in_unit`](Self::seconds_in_unit) has no answer.
    pub fn why_no_time_unit(&self) -> String {
        match self.time_unit() {
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

/// Seconds in one of the unit that the name of a column of times ends in.
fn named_unit(bare: &str) -> Option<f64> {
    let (name, unit) = bare.rsplit_once('_')?;
    TIMES.contains(&name).then(|| seconds_in(unit))?
}

/// Seconds in one of a unit of time, by its name: min, s, ms, us or ns.
pub fn seconds_in(unit: &str) -> Option<f64> {
    // CF conventions: `seconds since 2024-03-05 10:00`.
    let unit = unit.split_once(" since ").map_or(unit, |(unit, _)| unit);
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
    /// The first of them, until their mean step is known.
    begun: Vec<f64>,
    /// That step; 0 until then.
    usual: f64,
    first: f64,
    last: f64,
    count: usize,
    now: Stretch,
    /// The two stretches before.
    before: [Option<Stretch>; 2],
    fault: Option<NoRate>,
}

/// Some times in a row.
#[derive(Debug, Clone, Copy, Default)]
struct Stretch {
    count: usize,
    /// How far they lie behind times of the usual step: their sum.
    behind: f64,
    /// The smallest step, and the one farthest from the usual one with the times before it.
    least: f64,
    worst: (f64, usize),
}

impl Stretch {
    fn mean(&self) -> f64 {
        self.behind / self.count as f64
    }

    /// What the last printed digit is worth, where that is more than a step.
    fn digit(&self) -> f64 {
        if self.least == 0.0 { self.worst.0 } else { 0.0 }
    }

    /// How far such digits may move its mean.
    fn coarse(&self, usual: f64) -> f64 {
        self.digit() * self.digit() / (2.0 * STRETCH as f64 * usual)
    }
}

impl Clock {
    pub(super) fn new() -> Self {
        let (begun, now, before) = (Vec::new(), Stretch::default(), [None; 2]);
        Self { begun, usual: 0.0, first: f64::NAN, last: f64::NAN, count: 0, now, before, fault: None }
    }

    /// Takes the next times; breaks off where no rate can follow any more.
    pub(super) fn take(&mut self, times: &[f64]) -> ControlFlow<()> {
        let more = times.len().min(TOGETHER - self.begun.len());
        self.begun.extend_from_slice(&times[..more]);
        let found = match self.begun.len() == TOGETHER {
            true => self.begin().and_then(|()| times[more..].iter().try_for_each(|t| self.push(*t))),
            false => Ok(()),
        };
        self.fault = self.fault.or(found.err());
        if self.fault.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Looks at the first times, once.
    fn begin(&mut self) -> Result<(), NoRate> {
        if self.usual > 0.0 {
            return Ok(());
        }
        self.usual = even(&self.begun)?;
        self.first = self.begun[0];
        let begun = std::mem::take(&mut self.begun);
        let found = begun.iter().try_for_each(|t| self.push(*t));
        self.begun = begun;
        found
    }

    fn push(&mut self, t: f64) -> Result<(), NoRate> {
        if !t.is_finite() {
            return Err(NoRate::Missing { after: self.count });
        }
        if self.count > 0 {
            let step = t - self.last;
            let (now, usual) = (&mut self.now, self.usual);
            now.least = if now.worst.1 == 0 { step } else { now.least.min(step) };
            if now.worst.1 == 0 || (step - usual).abs() > (now.worst.0 - usual).abs() {
                now.worst = (step, self.count);
            }
        }
        self.now.behind += t - self.first - self.count as f64 * self.usual;
        (self.now.count, self.count, self.last) = (self.now.count + 1, self.count + 1, t);
        if self.now.count < STRETCH {
            return Ok(());
        }
        let now = std::mem::take(&mut self.now);
        let [earlier, before] = self.before;
        self.before = [before, Some(now)];
        match earlier {
            // Of a short record the usual step is not known so well.
            Some(earlier) if self.begun.len() >= WELL_KNOWN || self.count > TOGETHER => {
                let allowed = SHIFT * self.usual + now.coarse(self.usual).max(earlier.coarse(self.usual));
                self.within(now.mean() - earlier.mean(), allowed, now)
            }
            _ => Ok(()),
        }
    }

    /// That times lie no farther off than `allowed`; else the step that is to blame, of the last two stretches.
    fn within(&self, off: f64, allowed: f64, now: Stretch) -> Result<(), NoRate> {
        if off.abs() <= allowed {
            return Ok(());
        }
        let of = |s: &Stretch| (s.worst.0 - self.usual).abs();
        let stretches = self.before.iter().flatten().chain([&now]);
        let (step, after) = stretches.max_by(|a, b| of(a).total_cmp(&of(b))).map_or((0.0, 0), |s| s.worst);
        Err(NoRate::Uneven { step, after, usual: self.usual })
    }

    /// The sample rate, Hz, where `unit` are the seconds in a unit of the times.
    ///
    /// # Errors
    /// Where they are not evenly spaced.
    pub(super) fn rate(mut self, unit: f64) -> Result<f64, NoRate> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        self.begin()?;
        if let [_, Some(before)] = self.before {
            let off = self.last - self.first - (self.count - 1) as f64 * self.usual - before.mean();
            let digit = self.now.digit().max(before.digit());
            self.within(off, AT_THE_END * self.usual + digit, self.now)?;
        }
        let step = (self.last - self.first) / (self.count - 1) as f64;
        let hz = 1.0 / (step * unit);
        let round = hz.round();
        Ok(if (hz / round - 1.0).abs() < 1e-5 { round } else { hz })
    }
}

/// The mean step of evenly spaced times.
fn even(times: &[f64]) -> Result<f64, NoRate> {
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
    let rounded = || times.iter().enumerate().all(|(i, t)| (t - times[0] - i as f64 * step).abs() <= 0.6 * step);
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
        for fs in [1000.0, 2000.0, 12e3, 16e3, 24e3, 25.6e3, 44.1e3, 51.2e3, 100e3] {
            let found = rate((0..20 * TOGETHER).map(|i| six(i as f64 / fs))).unwrap();
            assert!((found / fs - 1.0).abs() < 1e-4, "{fs}: {found}");
        }
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
        // One sample is lost.
        for at in [20_000, TOGETHER + 7, 2 * TOGETHER, 3 * TOGETHER + 5] {
            let lost = rate((0..LONG).map(|i| (i + usize::from(i >= at)) as f64 / 12_000.0));
            assert!(matches!(lost, Err(NoRate::Uneven { after, .. }) if after == at), "{at}: {lost:?}");
        }
        for (at, factor) in [(60_000, 1.018), (TOGETHER, 2.0), (3 * TOGETHER, 1.01), (2 * TOGETHER + 99, 1.5)] {
            let other = rate((0..LONG).map(|i| if i < at { i as f64 } else { at as f64 + (i - at) as f64 * factor }));
            assert!(matches!(other, Err(NoRate::Uneven { .. })), "{at} {factor}: {other:?}");
        }
    }
}
