//! Columns of times: what they are called, in which unit they count, and the sample rate that follows from them.

use super::channel::Channel;

/// Steps between times may differ by so much from their mean, relative, before a rate is refused.
const UNEVEN: f64 = 0.02;

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

    /// Seconds in its unit, of a column of times, where it states one.
    pub fn seconds_in_unit(&self) -> Option<f64> {
        (self.unit.as_deref().and_then(seconds_in)).or_else(|| named_unit(&bare(self)))
    }

    /// The same of what [is one](Self::is_time).
    pub fn time_unit(&self) -> Option<f64> {
        self.is_time().then(|| self.seconds_in_unit())?
    }
}

/// A channel's name, in small letters, without a unit in brackets.
fn bare(channel: &Channel) -> String {
    let name = channel.name.to_lowercase();
    name.split(['[', '(']).next().unwrap_or("").trim().to_owned()
}

/// Seconds in the unit that the name of a column of times ends in.
fn named_unit(bare: &str) -> Option<f64> {
    let (name, unit) = bare.rsplit_once('_')?;
    TIMES.contains(&name).then(|| seconds_in(unit))?
}

/// Seconds in a unit by its name: s, ms or us.
pub fn seconds_in(unit: &str) -> Option<f64> {
    Some(match unit.trim().to_lowercase().as_str() {
        "s" | "sec" | "second" | "seconds" => 1.0,
        "ms" | "msec" => 1e-3,
        "us" | "µs" | "μs" | "usec" => 1e-6,
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

/// The sample rate, Hz, of evenly spaced times in units of `unit` seconds.
///
/// # Errors
/// Where they are not evenly spaced.
pub fn rate_of_times(times: &[f64], unit: f64) -> Result<f64, NoRate> {
    let n = times.len();
    if n < 3 {
        return Err(NoRate::TooFew);
    }
    let step = (times[n - 1] - times[0]) / (n - 1) as f64;
    if !(step > 0.0 && step.is_finite()) {
        return Err(NoRate::NotIncreasing);
    }
    // Printed times are rounded: allow for the digits that large values lose.
    let largest = times[0].abs().max(times[n - 1].abs());
    let allowed = (UNEVEN * step).max(4e-16 * largest);
    let off = (times.windows(2).enumerate()).find(|(_, w)| {
        let off = (w[1] - w[0] - step).abs();
        off.is_nan() || off > allowed
    });
    let rounded = times.iter().enumerate().all(|(i, t)| (t - times[0] - i as f64 * step).abs() <= 0.6 * step);
    if off.is_some() && !rounded {
        let steps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
        let middle = steps.len() / 2;
        let usual = *steps.clone().select_nth_unstable_by(middle, f64::total_cmp).1;
        let away = |(_, step): &(usize, &f64)| (*step - usual).abs();
        let worst = (steps.iter().enumerate()).max_by(|a, b| away(a).total_cmp(&away(b)));
        let (i, step) = worst.unwrap_or((0, &usual));
        return Err(NoRate::Uneven { step: *step, after: i + 1, usual });
    }
    let hz = 1.0 / (step * unit);
    let round = hz.round();
    Ok(if (hz / round - 1.0).abs() < 1e-5 { round } else { hz })
}
