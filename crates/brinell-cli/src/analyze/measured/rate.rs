//! The sample rate, and columns of times.

use super::channel::resolve;
use super::stretch::stretch;
use super::wanted::Wanted;
use crate::failure::Failure;
use crate::say::short;
use brinell_io::{Channel, NoRate, RateSource, SignalFile, rate_of_times, seconds_in};

/// A rate given and one stated may differ by so much, relative, before it is worth a word.
const DIFFERS: f64 = 1e-4;

/// The column of times: one that is called so, else the first in a unit of time whose values are evenly spaced.
fn times(file: &mut SignalFile) -> Option<Channel> {
    let these: Vec<Channel> =
        file.channels().iter().filter(|c| c.is_time() && c.may_be_signal() && !c.is_matrix()).cloned().collect();
    let called = these.iter().find(|c| c.is_called_time());
    let mut others = these.iter().filter(|c| !c.is_called_time());
    let mut is_even =
        |c: &&Channel| stretch(file, &c.name, 0, 1 << 16).is_ok_and(|(times, _)| rate_of_times(&times, 1.0).is_ok());
    called.or_else(|| others.find(&mut is_even)).cloned()
}

/// What a column of times whose unit the file states says of the rate: hertz, or what is wrong with the times; and the
/// column's name.
fn by_times(file: &mut SignalFile) -> Option<(Result<f64, String>, String)> {
    let channel = times(file)?;
    let (unit, name) = (channel.time_unit()?, channel.name);
    let (times, _) = stretch(file, &name, 0, 1 << 16).ok()?;
    Some((even(&times, unit), name))
}

/// A warning, where a rate that was given differs from the file's.
fn contradiction(given: &str, hz: f64, stated: Option<(f64, String)>, file: &mut SignalFile) -> Option<String> {
    let (other, place) = match (stated, by_times(file)) {
        (Some(stated), _) => stated,
        (None, None) => return None,
        (None, Some((Ok(other), name))) => (other, format!("the column `{name}`")),
        (None, Some((Err(why), name))) => {
            return Some(format!("{given} Hz was taken, but the times in `{name}` give no rate: {why}"));
        }
    };
    ((other / hz - 1.0).abs() > DIFFERS).then(|| format!("{given} Hz was taken, but {place} says {other} Hz"))
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
            return Err(Failure::Usage(format!("{option} {given}: expected more than 0 Hz")));
        }
        warnings.extend(contradiction(&format!("{option} {given}"), given, stated, file));
        return Ok(Ok((given, format!("sample rate {given} Hz, as given"))));
    }
    if let Some((hz, place)) = stated {
        return Ok(Ok((hz, format!("sample rate {hz} Hz, from {place}"))));
    }
    let time = match wanted.time_channel {
        Some(text) => Some(resolve(file, text, "--time-channel")?.1),
        None => times(file),
    };
    let Some(time) = time else {
        if let Some(hz) = wanted.like.map(|like| like.rate) {
            warnings
                .push(format!("no sample rate is stated: the first signal's {hz} Hz was taken; else give {option} HZ"));
            return Ok(Ok((hz, format!("sample rate {hz} Hz, as the first signal's"))));
        }
        return Ok(Err(format!("the file states no sample rate; give {option} HZ")));
    };
    let unit = match (wanted.time_unit, time.seconds_in_unit()) {
        (Some(text), _) => {
            seconds_in(text).ok_or_else(|| Failure::Usage(format!("--time-unit {text}: expected s, ms or us")))?
        }
        (None, Some(unit)) => unit,
        // By brinell's own contract.
        (None, None) if own && time.name == "t" => 1.0,
        (None, None) => {
            return Ok(Err(format!(
                "the file states no sample rate, and no unit for its times in `{}`; give {option} HZ{}",
                time.name,
                if wanted.whose.is_empty() { ", or --time-unit s" } else { "" }
            )));
        }
    };
    let (times, _) = stretch(file, &time.name, 0, 1 << 16)?;
    let hz = even(&times, unit).map_err(|why| {
        Failure::Usage(format!(
            "{}: no sample rate follows from `{}`: {why}; give {option} HZ if you know it",
            file.path().display(),
            time.name
        ))
    })?;
    let place = format!("sample rate {hz} Hz, from the times in `{}`", time.name);
    Ok(Ok((hz, place)))
}

/// [`rate_of_times`], what is wrong in words.
fn even(times: &[f64], unit: f64) -> Result<f64, String> {
    rate_of_times(times, unit).map_err(|why| match why {
        NoRate::TooFew => "it has fewer than three values".into(),
        NoRate::NotIncreasing => "its values do not increase".into(),
        NoRate::Uneven { step, after, usual } => format!(
            "its steps are uneven ({} after {after} values, where {} is usual)",
            short(step, 5),
            short(usual, 5)
        ),
    })
}
