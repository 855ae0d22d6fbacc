//! The channel meant.

use crate::known::{Known, Source};
use crate::problem::{Problem, Question};
use crate::request::Request;
use brinell::document::Loaded;
use brinell_io::{Channel, SignalFile, names};

/// The channel meant, by name, words of a name, or number.
pub(crate) fn resolve(
    file: &SignalFile,
    text: &str,
    called: impl FnOnce() -> String,
) -> Result<(String, Channel), Problem> {
    file.named(text).map_err(|why| Problem::Given(format!("{}: {why}", called())))
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

/// The channel's name, and what the file states of it; `Err` within asks which.
pub(crate) fn channel(
    file: &SignalFile,
    request: &Request,
    run: Option<&Loaded>,
) -> Result<Result<(Known<String>, Channel), Question>, Problem> {
    let named = |found: &Channel, source| (Known::by(found.name.clone(), source), found.clone());
    let signals = || file.channels().iter().filter(|c| c.may_be_signal() && !c.is_time());
    if let Some(text) = request.channel.as_deref() {
        let called = || request.called.text("channel", text);
        let (name, channel) = resolve(file, text, called)?;
        if channel.is_time() && signals().next().is_some() {
            return Err(Problem::Given(format!(
                "{}: `{name}` holds times; expected a signal: {}",
                called(),
                names(signals().map(Channel::with_label))
            )));
        }
        return Ok(Ok((Known::by(name, Source::Given), channel)));
    }
    if let Some(run) = run {
        let along = run.scenario.shown_channel();
        if let Some(found) = file.channels().iter().find(|c| c.name == along) {
            let (known, channel) = named(found, Source::File("the scenario of the run in the file".into()));
            let which = if run.scenario.machine.is_some() {
                "nearest to the bearing that is damaged, or to the first"
            } else {
                "along the load"
            };
            return Ok(Ok((known.noted(format!("channel {along}, {which}, as none was named")), channel)));
        }
    }
    if let Some(found) =
        (request.like.as_ref()).and_then(|like| file.channels().iter().find(|c| c.name == like.channel))
    {
        let (known, channel) = named(found, Source::Like);
        let note = format!("channel {}, {}; else give {}", found.name, Source::Like, request.called.name("channel"));
        return Ok(Ok((known.noted(note), channel)));
    }
    let of_speed = (request.speed_channel.as_deref().or(request.tacho.as_ref().map(|(name, _)| name.as_str())))
        .and_then(|text| file.named(text).ok())
        .map(|(name, _)| name);
    let signals: Vec<&Channel> = signals().filter(|c| of_speed.as_ref() != Some(&c.name)).collect();
    match signals[..] {
        [only] if !only.is_matrix() => Ok(Ok(named(only, Source::Assumed))),
        [] => Err(Problem::Signal(format!("{}: nothing here is a signal: {}", file.path().display(), refused(file)))),
        _ => Ok(Err(Question::Channel(signals.into_iter().cloned().collect()))),
    }
}
