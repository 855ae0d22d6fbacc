//! The sample rate, and columns of times.

use super::channel::resolve;
use super::stretch::bad;
use super::wanted::Wanted;
use crate::failure::Failure;
use crate::say::short;
use brinell_io::{Channel, NoRate, NoTimes, SignalFile, seconds_in};

/// The rate and where it comes from; `Err` within are the words that ask for it.
pub(super) fn rate(
    file: &mut SignalFile,
    channel: &Channel,
    wanted: &Wanted,
    own: bool,
    warnings: &mut Vec<String>,
) -> Result<Result<(f64, String), String>, Failure> {
    let option = format!("--{}rate", wanted.whose);
    if let Some(given) = wanted.signal.rate {
        if !(given > 0.0 && given.is_finite()) {
            return Err(Failure::Usage(format!("{option} {given}: expected more than 0 Hz")));
        }
        warnings.extend(file.other_rate(channel, &format!("{option} {given}"), given, |step| short(step, 5)));
        return Ok(Ok((given, format!("sample rate {given} Hz, as given"))));
    }
    if let Some((hz, place)) = channel.stated_rate() {
        return Ok(Ok((hz, format!("sample rate {hz} Hz, from {place}"))));
    }
    let time = match times(file, channel, wanted)? {
        Ok(time) => time,
        Err(why) => return Ok(Err(format!("{why}; give {option} HZ{}", choice(wanted, &why)))),
    };
    let Some(time) = time else {
        if let Some(hz) = wanted.like.map(|like| like.rate) {
            warnings
                .push(format!("no sample rate is stated: the first signal's {hz} Hz was taken; else give {option} HZ"));
            return Ok(Ok((hz, format!("sample rate {hz} Hz, as the first signal's"))));
        }
        return Ok(Err(format!("the file states no sample rate; give {option} HZ")));
    };
    let unit = match (wanted.signal.time_unit.as_deref(), time.seconds_in_unit()) {
        (Some(text), _) => {
            seconds_in(text).ok_or_else(|| Failure::Usage(format!("--time-unit {text}: expected {UNITS}")))?
        }
        (None, Some(unit)) => unit,
        // By brinell's own contract.
        (None, None) if own && time.name == "t" => 1.0,
        (None, None) => {
            let unit = if wanted.whose.is_empty() { format!(", or --time-unit: {UNITS}") } else { String::new() };
            return Ok(Err(format!(
                "the file states no sample rate, and {}; give {option} HZ{unit}",
                time.why_no_time_unit()
            )));
        }
    };
    let found = file.rate_of(&time.name, unit).map_err(bad)?;
    let hz = found.map_err(|why| {
        let at = at_line(file, &why, [&time.name, &channel.name]);
        let why = words(&why);
        Failure::Usage(format!(
            "{}: no sample rate follows from `{}`: {why}{at}; give {option} HZ if you know it and the times are wrong",
            file.path().display(),
            time.name
        ))
    })?;
    let place = format!("sample rate {hz} Hz, from the times in `{}`", time.name);
    Ok(Ok((hz, place)))
}

/// What `--time-unit` takes.
const UNITS: &str = "s, ms, us, ns or min";

/// The column of times that was named, or that is the channel's; `Err` within is why there is none.
fn times(
    file: &mut SignalFile,
    channel: &Channel,
    wanted: &Wanted,
) -> Result<Result<Option<Channel>, NoTimes>, Failure> {
    let Some(text) = wanted.signal.time_channel.as_deref() else {
        return Ok(file.times_of(channel));
    };
    let (_, time) = resolve(file, text, "--time-channel")?;
    match channel.is_timed_by(&time) {
        true => Ok(Ok(Some(time))),
        false => Err(Failure::Usage(format!(
            "--time-channel {text}: {}; expected as many, or give --rate HZ",
            channel.not_timed_by(&time)
        ))),
    }
}

/// The option that chooses, where several columns may be meant.
fn choice(wanted: &Wanted, why: &NoTimes) -> &'static str {
    if wanted.whose.is_empty() && matches!(why, NoTimes::Several(_)) { ", or --time-channel NAME" } else { "" }
}

fn words(why: &NoRate) -> String {
    why.words(|step| short(step, 5))
}

/// The lines of a text file to blame, with what they say in the columns of times and signal.
fn at_line(file: &mut SignalFile, why: &NoRate, columns: [&str; 2]) -> String {
    let mut line = |value: u64| {
        let [(line, time), (_, signal)] = [file.cell(columns[0], value)?, file.cell(columns[1], value)?];
        let cell = |name: &str, text: &str| match text.parse::<f64>() {
            Ok(number) if number.is_finite() => format!("`{name}` {text}"),
            _ if text.is_empty() => format!("`{name}` empty"),
            _ => format!("`{name}` {text}, no number"),
        };
        Some(format!("line {line} ({}; {})", cell(columns[0], &time), cell(columns[1], &signal)))
    };
    match *why {
        NoRate::Missing { after } => line(after as u64).map_or(String::new(), |at| format!("; it is on {at}")),
        NoRate::Uneven { after, .. } => match (line((after as u64).saturating_sub(1)), line(after as u64)) {
            (Some(from), Some(to)) => format!("; that step is from {from} to {to}"),
            _ => String::new(),
        },
        NoRate::TooFew | NoRate::NotIncreasing => String::new(),
    }
}
