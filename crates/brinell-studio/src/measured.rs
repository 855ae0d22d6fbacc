//! A measured file: what it states of its signals, and one of them judged by that and by what was given.

use crate::answers::{Judged, Line, Listed, Listened, MadeBy, Reply, Spectrum, Verdict};
use crate::judged;
use crate::message::Arrays;
use crate::report::{Answer, Trouble};
use crate::text;
use brinell::analysis::{Family, Quantity, Unit, shown_spectrum};
use brinell::signal;
use brinell_io::{Channel, FileKind, SignalFile, open_bytes};
use brinell_measured::{Asked, Called, GivenSpeed, Measurement, Problem, Request, examine, made_by, stated};
use serde_json::Value;
use std::collections::HashMap;

/// Most samples of a waveform that the page gets: more are not seen.
const SHOWN: usize = 1 << 18;

fn file(request: &Value, arrays: &Arrays) -> Answer<SignalFile> {
    let bytes = request.get("bytes").and_then(|b| arrays.octets(b));
    let bytes = bytes.ok_or_else(|| Trouble::of("\"bytes\" must be an array of u8"))?;
    let name = request["name"].as_str().unwrap_or("signal");
    open_bytes(name, bytes.to_vec()).map_err(|error| Trouble::of(error.to_string()))
}

impl From<Problem> for Trouble {
    fn from(problem: Problem) -> Self {
        match problem {
            Problem::Missing { questions, called, .. } => {
                Self(questions.iter().flat_map(|question| Self::of(question.words(called)).0).collect())
            }
            other => Self::of(other.to_string()),
        }
    }
}

/// `listen`: the channels of a file.
pub(crate) fn listen(request: &Value, arrays: &Arrays) -> Answer<Reply> {
    let mut file = file(request, arrays)?;
    let run = made_by(&file);
    let mut shown: Vec<Channel> =
        (file.channels().iter()).filter(|c| c.may_be_signal() && !c.is_time()).cloned().collect();
    if shown.is_empty() {
        return Err(Trouble::of("nothing here is a signal"));
    }
    // What is most probably meant comes first: a sensor's channel.
    shown.sort_by_key(|c| !c.name.starts_with("sensor"));
    let (mut channels, mut counts) = (Vec::new(), HashMap::<String, u64>::new());
    for c in shown {
        // All columns of a text file are as long as that of times.
        let samples = match (c.length, file.times_of(&c).ok().flatten()) {
            (None, Some(times)) => Some(match counts.get(&times.name) {
                Some(count) => *count,
                None => {
                    let values = file.read(&times.name).map_err(|error| Trouble::of(error.to_string()))?;
                    *counts.entry(times.name).or_insert(values.len() as u64)
                }
            }),
            (length, _) => length,
        };
        let stated = stated(&mut file, &c, run.as_deref(), Called::Fields)?;
        let (rate, rate_missing) = (stated.rate.as_ref().ok(), stated.rate.as_ref().err());
        channels.push(Listed {
            name: c.name,
            samples,
            rate_hz: rate.map(|rate| rate.0),
            rate_missing: rate_missing.cloned(),
            rate_from: rate.map(|rate| rate.1.clone()),
            unit: stated.unit,
            rpm: stated.speed.as_ref().map(|speed| speed.0),
            rpm_from: stated.speed.map(|speed| speed.1),
            is_wav: file.kind() == FileKind::Wav,
        });
    }
    let run = run.map(|run| MadeBy { from_s: run.scenario.settled_s(), bearing: run.scenario.bearing.preset });
    Ok(Reply::Listen(Listened { channels, run }))
}

/// What was given of a signal.
fn given(request: &Value) -> Answer<Request> {
    let text = |key: &str| request[key].as_str().filter(|text| !text.trim().is_empty()).map(str::to_owned);
    let number = |key: &str| request[key].as_f64();
    let bearing = match (request["bearing"].as_str(), request["of"].as_str()) {
        (Some(name), _) => Some(Asked::Name(name.to_owned())),
        (None, Some(toml)) => {
            let bearing = Box::new(text::read(toml)?.scenario.bearing);
            let preset = bearing.preset.as_deref().map_or(String::new(), |name| format!(", {name}"));
            let name = "that of this page".to_owned();
            Some(Asked::Scenario { words: format!("{name}{preset}"), name, bearing })
        }
        (None, None) => None,
    };
    let pulses = request["pulses"].as_u64().and_then(|n| u32::try_from(n).ok()).map_or(1, |n| n.max(1));
    Ok(Request {
        channel: request["channel"].as_str().map(str::to_owned),
        rate: number("rate_hz"),
        unit: text("unit"),
        sensitivity: text("sensitivity"),
        full_scale: text("full_scale"),
        start: number("from_s"),
        duration: number("duration_s"),
        most: Some(usize::MAX),
        judged: true,
        speed: number("rpm").map(|rpm| GivenSpeed { rpm, is_bare: false }),
        speed_channel: text("speed_channel"),
        tacho: text("tacho").map(|name| (name, pulses)),
        bearings: bearing.into_iter().collect(),
        size: true,
        in_haste: true,
        ..Request::new(Called::Fields)
    })
}

/// `judge`: one channel, analysed as `brinell analyze` does.
pub(crate) fn judge(request: &Value, sent: &Arrays, arrays: &mut Arrays) -> Answer<Reply> {
    let given = given(request)?;
    given.check()?;
    let found = examine(Measurement::of_file(file(request, sent)?, &given)?, &given)?;
    let (m, analysis) = (&found.measurement, &found.lead().analysis);
    let (rate, unit, x) = (m.rate.value, &m.unit.value, &m.x);
    let spectrum = shown_spectrum(x, rate).map_err(|error| Trouble::of(error.to_string()))?;
    let envelope = &analysis.view.spectrum;
    let channel = &m.channel.value;
    let before = [
        format!("bearing: {}", found.lead().said_of_bearing()),
        format!("{}, and {}", found.speed, analysis.shaft_words()),
    ];
    let channel = format!("channel {channel}: {:.3} s, {} samples", analysis.duration(), analysis.samples);
    let used = before.into_iter().chain(found.notes.iter().cloned()).chain([channel]).collect();
    // Beside a simulation's, in its unit.
    let shown = arrays.rounded(&unit.in_si(&x[..x.len().min(SHOWN)]));
    let mut si = |of: &signal::Spectrum| Spectrum::new(of.frequency_step, &unit.in_si(&of.amplitude), arrays);
    Ok(Reply::Judge(Box::new(Judged {
        verdict: Verdict { words: found.lead().verdict_text(), ..judged::verdict(analysis) },
        warnings: found.warnings.clone(),
        used,
        levels: analysis.headlines(&unit.name),
        from_s: m.start,
        rate_hz: rate,
        unit: in_si(unit).to_owned(),
        x: shown,
        spectrum: si(&spectrum),
        envelope: Spectrum { band_hz: Some([analysis.view.band.low, analysis.view.band.high]), ..si(envelope) },
        lines: analysis.causes().map(line).collect(),
    })))
}

/// The unit of what [`Unit::in_si`] gives.
fn in_si(unit: &Unit) -> &str {
    match unit.quantity {
        Quantity::Acceleration => "m/s^2",
        Quantity::Velocity => "m/s",
        Quantity::Displacement => "m",
        // A voltage's or a current's multiple is the plain one.
        Quantity::Voltage => "V",
        Quantity::Current => "A",
        Quantity::Other => &unit.name,
    }
}

/// A family that was called damage, as the page marks it.
fn line(f: &Family) -> Line {
    Line {
        name: f.name,
        hz: Some(f.frequency),
        nominal_hz: f.expected,
        found: true,
        harmonics: f.detected_harmonics(),
        over_noise_db: Some(f.highest_db()),
        defect: None,
    }
}
