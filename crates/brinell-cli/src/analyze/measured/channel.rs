//! The channel meant.

use super::wanted::Wanted;
use crate::failure::Failure;
use brinell::channel::SENSOR;
use brinell::document::Loaded;
use brinell_io::{Channel, SignalFile, names};

/// The channel meant, by name, words of a name, or number.
pub(super) fn resolve(file: &SignalFile, text: &str, option: &str) -> Result<(String, Channel), Failure> {
    file.named(text).map_err(|why| Failure::Usage(format!("{option} {text}: {why}")))
}

fn listed<'a>(channels: impl Iterator<Item = &'a Channel>) -> String {
    names(channels.map(Channel::with_label))
}

/// Every channel, with why it is no signal.
fn refused(file: &SignalFile) -> String {
    let why = |c: &Channel| match (&c.unreadable, c.length) {
        (Some(why), _) => why.clone(),
        (None, Some(0)) => "holds no values".into(),
        (None, Some(1)) => "holds a single number".into(),
        _ => "holds times".into(),
    };
    let channels = file.channels().iter();
    names(channels.map(|c| format!("`{}` {}", c.name, why(c))))
}

/// The channel to analyse.
pub(super) enum Chosen {
    /// This one.
    One(String, Channel),
    /// One of these; the words ask which.
    Among(Vec<Channel>, String),
}

pub(super) fn channel(
    file: &SignalFile,
    wanted: &Wanted,
    run: Option<&Loaded>,
    notes: &mut Vec<String>,
) -> Result<Chosen, Failure> {
    let option = format!("--{}channel", wanted.whose);
    let one = |(name, channel)| Chosen::One(name, channel);
    if let Some(text) = wanted.signal.channel.first().map(String::as_str) {
        let (name, channel) = resolve(file, text, &option)?;
        let others = || file.channels().iter().filter(|c| c.may_be_signal() && !c.is_time());
        if channel.is_time() && others().next().is_some() {
            return Err(Failure::Usage(format!(
                "{option} {text}: `{name}` holds times; expected a signal: {}",
                listed(others())
            )));
        }
        return Ok(one((name, channel)));
    }
    if let Some(run) = run {
        let along = SENSOR[run.scenario.operation.axis_of_load()];
        if let Some(found) = file.channels().iter().find(|c| c.name == along) {
            notes.push(format!("channel {along}, along the load, as none was named"));
            return Ok(one((found.name.clone(), found.clone())));
        }
    }
    if let Some(found) = wanted.like.and_then(|like| file.channels().iter().find(|c| c.name == like.channel)) {
        notes.push(format!("channel {}, as the first signal's; else give {option}", found.name));
        return Ok(one((found.name.clone(), found.clone())));
    }
    let of_speed = (wanted.speed_channel.or(wanted.tacho.map(|(name, _)| name)))
        .and_then(|text| file.named(text).ok())
        .map(|(name, _)| name);
    let may_be = |c: &&Channel| c.may_be_signal() && !c.is_time() && of_speed.as_ref() != Some(&c.name);
    let signals: Vec<&Channel> = file.channels().iter().filter(may_be).collect();
    let among = |words: String| {
        let signals = signals.iter().map(|c| (*c).clone()).collect();
        Ok(Chosen::Among(signals, words))
    };
    match signals[..] {
        [only] if only.is_matrix() => among(format!(
            "`{name}` is {} x {}; choose a column, as {option} '{name}(:,1)', or a row, as {option} '{name}(1,:)'",
            only.shape[0],
            only.shape[1],
            name = only.name
        )),
        [only] => Ok(one((only.name.clone(), only.clone()))),
        [] => Err(Failure::Usage(format!("{}: nothing here is a signal: {}", file.path().display(), refused(file)))),
        _ => among(format!(
            "several channels may be the signal; choose one with {option}: {}",
            listed(signals.iter().copied())
        )),
    }
}
