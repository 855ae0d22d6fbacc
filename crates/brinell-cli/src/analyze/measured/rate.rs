//! The sample rate, and columns of times.

use super::channel::resolve;
use super::{Wanted, stretch, usage};
use crate::failure::Failure;
use crate::say::short;
use brinell_io::{Channel, RateSource, SignalFile};

/// Steps between times may differ by so much from their mean, relative, before a rate is refused.
const UNEVEN: f64 = 0.02;

/// A rate given and one stated may differ by so much, relative, before it is worth a word.
const DIFFERS: f64 = 1e-4;

/// What a column of times is called: `t`, `Time [s]`, `time_ms`.
const TIMES: [&str; 5] = ["t", "time", "times", "timestamp", "zeit"];

/// Whether a channel is called like a column of times.
pub(super) fn is_time(channel: &Channel) -> bool {
    let name = bare(channel);
    TIMES.contains(&name.as_str()) || named_unit(&name).is_some()
}

/// A channel's name, in small letters, without a unit in brackets.
fn bare(channel: &Channel) -> String {
    let name = channel.name.to_lowercase();
    name.split(['[', '('])
        .next()
        .unwrap_or("")
        .trim()
        .to_owned()
}

/// Seconds in the unit that the name of a column of times ends in.
fn named_unit(bare: &str) -> Option<f64> {
    let (name, unit) = bare.rsplit_once('_')?;
    TIMES.contains(&name).then(|| seconds(unit))?
}

/// Seconds in the unit of a column of times, where it states one.
fn unit_of(channel: &Channel) -> Option<f64> {
    (channel.unit.as_deref().and_then(seconds)).or_else(|| named_unit(&bare(channel)))
}

/// The same of what is called like one.
pub(super) fn time_unit(channel: &Channel) -> Option<f64> {
    is_time(channel).then(|| unit_of(channel))?
}

fn seconds(unit: &str) -> Option<f64> {
    Some(match unit.trim().to_lowercase().as_str() {
        "s" | "sec" | "second" | "seconds" => 1.0,
        "ms" | "msec" => 1e-3,
        "us" | "µs" | "μs" | "usec" => 1e-6,
        _ => return None,
    })
}

/// What a column of times whose unit the file states says of the rate: hertz, or what is wrong with the times; and the column's name.
fn by_times(file: &mut SignalFile) -> Option<(Result<f64, String>, String)> {
    let channels = file.channels().iter();
    let (name, unit) = channels
        .filter(|c| c.may_be_signal())
        .find_map(|c| Some((c.name.clone(), time_unit(c)?)))?;
    let (times, _) = stretch(file, &name, 0, 1 << 16).ok()?;
    Some((even(&times, unit), name))
}

/// A warning, where a rate that was given differs from the file's.
fn contradiction(
    given: &str,
    hz: f64,
    stated: Option<(f64, String)>,
    file: &mut SignalFile,
) -> Option<String> {
    let (other, place) = match (stated, by_times(file)) {
        (Some(stated), _) => stated,
        (None, None) => return None,
        (None, Some((Ok(other), name))) => (other, format!("the column `{name}`")),
        (None, Some((Err(why), name))) => {
            return Some(format!(
                "{given} Hz was taken, but the times in `{name}` give no rate: {why}"
            ));
        }
    };
    ((other / hz - 1.0).abs() > DIFFERS)
        .then(|| format!("{given} Hz was taken, but {place} says {other} Hz"))
}

/// The rate and where it comes from; `Err` within are the words that ask for it.
pub(super) fn rate(
    file: &mut SignalFile,
    channel: &Channel,
    wanted: &Wanted,
    own: bool,
    warnings: &mut Vec<String>,
) -> Result<Result<(f64, String), String>, Failure> {
    let stated = channel.rate.as_ref().map(|rate| {
        let place = match &rate.source {
            RateSource::Header(field) => format!("the file's header ({field})"),
            RateSource::Variable(name) => format!("the variable `{name}` in the file"),
        };
        (rate.hz, place)
    });
    let option = format!("--{}rate", wanted.whose);
    if let Some(given) = wanted.rate {
        if !(given > 0.0 && given.is_finite()) {
            return Err(usage(format!("{option} {given}: expected more than 0 Hz")));
        }
        warnings.extend(contradiction(
            &format!("{option} {given}"),
            given,
            stated,
            file,
        ));
        return Ok(Ok((given, format!("sample rate {given} Hz, as given"))));
    }
    if let Some((hz, place)) = stated {
        return Ok(Ok((hz, format!("sample rate {hz} Hz, from {place}"))));
    }
    let time = match wanted.time_channel {
        Some(text) => Some(resolve(file, text, "--time-channel")?.1),
        None => file
            .channels()
            .iter()
            .find(|c| is_time(c) && c.may_be_signal())
            .cloned(),
    };
    let Some(time) = time else {
        return Ok(Err(format!(
            "the file states no sample rate; give {option} HZ"
        )));
    };
    let unit = match (wanted.time_unit, unit_of(&time)) {
        (Some(text), _) => seconds(text)
            .ok_or_else(|| usage(format!("--time-unit {text}: expected s, ms or us")))?,
        (None, Some(unit)) => unit,
        // By brinell's own contract.
        (None, None) if own && time.name == "t" => 1.0,
        (None, None) => {
            return Ok(Err(format!(
                "the file states no sample rate, and no unit for its times in `{}`; give {option} HZ{}",
                time.name,
                if wanted.whose.is_empty() {
                    ", or --time-unit s"
                } else {
                    ""
                }
            )));
        }
    };
    let (times, _) = stretch(file, &time.name, 0, 1 << 16)?;
    let hz = even(&times, unit).map_err(|why| {
        usage(format!(
            "{}: no sample rate follows from `{}`: {why}; give {option} HZ if you know it",
            file.path().display(),
            time.name
        ))
    })?;
    let place = format!("sample rate {hz} Hz, from the times in `{}`", time.name);
    Ok(Ok((hz, place)))
}

/// The rate of evenly spaced times; `Err` says what is wrong with them.
fn even(times: &[f64], unit: f64) -> Result<f64, String> {
    let n = times.len();
    if n < 3 {
        return Err("it has fewer than three values".into());
    }
    let step = (times[n - 1] - times[0]) / (n - 1) as f64;
    if !(step > 0.0 && step.is_finite()) {
        return Err("its values do not increase".into());
    }
    // Printed times are rounded: allow for the digits that large values lose.
    let largest = times[0].abs().max(times[n - 1].abs());
    let allowed = (UNEVEN * step).max(4e-16 * largest);
    let off = (times.windows(2).enumerate()).find(|(_, w)| {
        let off = (w[1] - w[0] - step).abs();
        off.is_nan() || off > allowed
    });
    let rounded = times
        .iter()
        .enumerate()
        .all(|(i, t)| (t - times[0] - i as f64 * step).abs() <= 0.6 * step);
    if off.is_some() && !rounded {
        let steps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
        let middle = steps.len() / 2;
        let usual = *steps
            .clone()
            .select_nth_unstable_by(middle, f64::total_cmp)
            .1;
        let away = |(_, step): &(usize, &f64)| (*step - usual).abs();
        let worst = (steps.iter().enumerate()).max_by(|a, b| away(a).total_cmp(&away(b)));
        let (i, step) = worst.unwrap_or((0, &usual));
        return Err(format!(
            "its steps are uneven ({} after {} values, where {} is usual)",
            short(*step, 5),
            i + 1,
            short(usual, 5)
        ));
    }
    let hz = 1.0 / (step * unit);
    let round = hz.round();
    Ok(if (hz / round - 1.0).abs() < 1e-5 {
        round
    } else {
        hz
    })
}
