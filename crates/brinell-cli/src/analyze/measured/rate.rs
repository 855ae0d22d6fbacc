//! The sample rate, and columns of times.

use super::channel::resolve;
use super::stretch::bad;
use super::wanted::Wanted;
use crate::failure::Failure;
use crate::say::short;
use brinell_io::{Channel, NoRate, SignalFile, seconds_in};

/// The rate and where it comes from; `Err` within are the words that ask for it.
pub(super) fn rate(
    file: &mut SignalFile,
    channel: &Channel,
    wanted: &Wanted,
    own: bool,
    warnings: &mut Vec<String>,
) -> Result<Result<(f64, String), String>, Failure> {
    let option = format!("--{}rate", wanted.whose);
    if let Some(given) = wanted.rate {
        if !(given > 0.0 && given.is_finite()) {
            return Err(Failure::Usage(format!("{option} {given}: expected more than 0 Hz")));
        }
        warnings.extend(file.other_rate(channel, &format!("{option} {given}"), given, |step| short(step, 5)));
        return Ok(Ok((given, format!("sample rate {given} Hz, as given"))));
    }
    if let Some((hz, place)) = channel.stated_rate() {
        return Ok(Ok((hz, format!("sample rate {hz} Hz, from {place}"))));
    }
    let time = match wanted.time_channel {
        Some(text) => Some(resolve(file, text, "--time-channel")?.1),
        None => file.times(),
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
    let hz = file.rate_of(&time.name, unit).map_err(bad)?.map_err(|why| {
        let why = words(&why);
        Failure::Usage(format!(
            "{}: no sample rate follows from `{}`: {why}; give {option} HZ if you know it",
            file.path().display(),
            time.name
        ))
    })?;
    let place = format!("sample rate {hz} Hz, from the times in `{}`", time.name);
    Ok(Ok((hz, place)))
}

fn words(why: &NoRate) -> String {
    why.words(|step| short(step, 5))
}
