//! The sample rate, and columns of times.

use crate::channel::resolve;
use crate::known::{Known, Source};
use crate::problem::{NoRateStated, Problem, Question, TIME_UNITS};
use crate::request::Request;
use brinell::signal::short;
use brinell_io::{Channel, NoRate, NoTimes, SignalFile, seconds_in};

/// The rate, Hz; `Err` within asks for it. `own` says whether a run of brinell's made the file.
pub(crate) fn rate(
    file: &mut SignalFile,
    channel: &Channel,
    request: &Request,
    own: bool,
) -> Result<Result<Known<f64>, Question>, Problem> {
    let called = request.called;
    let known = |hz: f64, source: Source| {
        let note = format!("sample rate {hz} Hz, {source}");
        Known::by(hz, source).noted(note)
    };
    if let Some(given) = request.rate {
        let asked = called.number("rate", given);
        if !(given > 0.0 && given.is_finite()) {
            return Err(Problem::Given(format!("{asked}: expected more than 0 Hz")));
        }
        let other = file.other_rate(channel, &asked, given, five);
        return Ok(Ok(known(given, Source::Given).doubted(other)));
    }
    if let Some((hz, place)) = channel.stated_rate() {
        return Ok(Ok(known(hz, Source::File(place))));
    }
    let time = match times(file, channel, request)? {
        Ok(time) => time,
        Err(why) => return Ok(Err(Question::Rate(NoRateStated::Times(why)))),
    };
    let Some(time) = time else {
        let Some(hz) = request.like.as_ref().map(|like| like.rate) else {
            return Ok(Err(Question::Rate(NoRateStated::Nothing)));
        };
        let give = called.with("rate", "HZ");
        let doubt = format!("no sample rate is stated: the first signal's {hz} Hz was taken; else give {give}");
        return Ok(Ok(known(hz, Source::Like).doubted(doubt)));
    };
    let unit = match (request.time_unit.as_deref(), time.seconds_in_unit()) {
        (Some(text), _) => seconds_in(text)
            .ok_or_else(|| Problem::Given(format!("{}: expected {TIME_UNITS}", called.text("time-unit", text))))?,
        (None, Some(unit)) => unit,
        // By brinell's own contract.
        (None, None) if own && time.name == "t" => 1.0,
        (None, None) => return Ok(Err(Question::Rate(NoRateStated::TimeUnit(time.why_no_time_unit())))),
    };
    let hz = file.rate_of(&time.name, unit)?.map_err(|why| {
        let at = at_line(file, &why, [&time.name, &channel.name]);
        Problem::Signal(format!(
            "{}: no sample rate follows from `{}`: {}{at}; give {} if you know it and the times are wrong",
            file.path().display(),
            time.name,
            why.words(five),
            called.with("rate", "HZ")
        ))
    })?;
    Ok(Ok(known(hz, Source::File(format!("the times in `{}`", time.name)))))
}

fn five(step: f64) -> String {
    short(step, 5)
}

/// The column of times that was named, or that is the channel's; `Err` within is why there is none.
fn times(
    file: &mut SignalFile,
    channel: &Channel,
    request: &Request,
) -> Result<Result<Option<Channel>, NoTimes>, Problem> {
    let Some(text) = request.time_channel.as_deref() else {
        return Ok(file.times_of(channel));
    };
    let called = || request.called.text("time-channel", text);
    let (_, time) = resolve(file, text, called)?;
    match channel.is_timed_by(&time) {
        true => Ok(Ok(Some(time))),
        false => Err(Problem::Given(format!(
            "{}: {}; expected as many, or give {}",
            called(),
            channel.not_timed_by(&time),
            request.called.with("rate", "HZ")
        ))),
    }
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
