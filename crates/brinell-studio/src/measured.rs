//! A measured file: what it states of its signals, and one of them judged by that and by what was given.

use crate::judged;
use crate::message::Arrays;
use crate::report::{Answer, Trouble};
use crate::text;
use brinell::analysis::{
    Analysis, Called, DefectOrders, Given, NoUnit, Numbers, Options, Quantity, Scaled, Unit, analyze,
    beyond_full_scale, once, other_bearing, other_speed, shown_spectrum, unit_of,
};
use brinell::bearing::{KnownBearing, orders_of};
use brinell::channel::unit_of_run;
use brinell::scenario::Scenario;
use brinell::signal::short;
use brinell_io::{Channel, FileKind, IoError, NoTimes, SignalFile, open_bytes};
use serde_json::{Value, json};
use std::collections::HashMap;

/// Most samples of a waveform that the page gets: more are not seen.
const SHOWN: usize = 1 << 18;

fn file(request: &Value, arrays: &Arrays) -> Answer<SignalFile> {
    let bytes = request.get("bytes").and_then(|b| arrays.octets(b));
    let bytes = bytes.ok_or_else(|| Trouble::of("\"bytes\" must be an array of u8"))?;
    let name = request["name"].as_str().unwrap_or("signal");
    open_bytes(name, bytes.to_vec()).map_err(bad)
}

fn bad(error: IoError) -> Trouble {
    Trouble::of(error.to_string())
}

/// `listen`: the channels of a file.
pub(crate) fn listen(request: &Value, arrays: &Arrays) -> Answer<Value> {
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
        let times = file.times_of(&c);
        // All columns of a text file are as long as that of times.
        let samples = match (c.length, times.as_ref().ok().and_then(Option::as_ref)) {
            (None, Some(times)) => Some(match counts.get(&times.name) {
                Some(count) => *count,
                None => {
                    let count = file.read(&times.name).map_err(bad)?.len() as u64;
                    *counts.entry(times.name.clone()).or_insert(count)
                }
            }),
            (length, _) => length,
        };
        let rate = match c.stated_rate() {
            Some(stated) => Ok(stated),
            None => rate_by(&mut file, times)?,
        };
        let rpm = stated_speed(&mut file, run.as_ref(), &c.name)?;
        channels.push(json!({
            "name": c.name,
            "samples": samples,
            "rate_hz": rate.as_ref().ok().map(|r| r.0),
            "rate_missing": rate.as_ref().err(),
            "rate_from": rate.ok().map(|r| r.1),
            "unit": c.unit.as_deref().or_else(|| own_unit(&c.name, run.as_ref())),
            "rpm": rpm.as_ref().map(|r| r.0),
            "rpm_from": rpm.map(|r| r.1),
            "is_wav": file.kind() == FileKind::Wav,
        }));
    }
    let run = run.map(|scenario| json!({ "bearing": scenario.bearing.preset, "from_s": scenario.settled_s() }));
    Ok(json!({ "channels": channels, "run": run }))
}

/// The scenario of the run that made a file, where the file carries it.
fn made_by(file: &SignalFile) -> Option<Scenario> {
    Scenario::from_toml(file.metadata().scenario()?).ok()
}

fn own_unit(name: &str, run: Option<&Scenario>) -> Option<&'static str> {
    unit_of_run(name, &run?.sensor)
}

/// The rate by a channel's column of times, Hz, and that in words; else what is to be said of that.
fn rate_by(file: &mut SignalFile, times: Result<Option<Channel>, NoTimes>) -> Answer<Result<(f64, String), String>> {
    let times = match times {
        Ok(Some(times)) => times,
        Ok(None) => return Ok(Err("the file states no sample rate; give it in Hz".into())),
        Err(why) => return Ok(Err(format!("{why}; give the rate in Hz"))),
    };
    let name = &times.name;
    let Some(seconds) = times.seconds_in_unit() else {
        let why = times.why_no_time_unit();
        return Ok(Err(format!("the file states no sample rate, and {why}; give it in Hz")));
    };
    Ok(match file.rate_of(name, seconds).map_err(bad)? {
        Ok(hz) => Ok((hz, format!("the times in `{name}`"))),
        Err(why) => {
            Err(format!("no sample rate follows from `{name}`: {}; give it in Hz if you know it", why.words(five)))
        }
    })
}

fn five(x: f64) -> String {
    short(x, 5)
}

/// The speed that the file states, r/min, and where.
fn stated_speed(file: &mut SignalFile, run: Option<&Scenario>, signal: &str) -> Answer<Option<(f64, String)>> {
    match run {
        Some(run) => {
            let rpm = run.operation.speed_rpm.constant().filter(|rpm| *rpm != 0.0);
            Ok(rpm.map(|rpm| (rpm.abs(), "the scenario of the run in the file".into())))
        }
        None => file.stated_rpm(signal).map_err(bad),
    }
}

/// What is known of a signal, with what is said of that.
struct Known {
    channel: String,
    stored_as: &'static str,
    rate: f64,
    scaled: Scaled,
    options: Options,
    run: Option<Scenario>,
    /// Rate, speed and bearing as they were used, and where they come from: sentences.
    rate_words: String,
    speed_words: String,
    bearing_words: String,
    warnings: Vec<String>,
}

/// `judge`: one channel, analysed as `brinell analyze` does.
pub(crate) fn judge(request: &Value, sent: &Arrays, arrays: &mut Arrays) -> Answer<Value> {
    let mut file = file(request, sent)?;
    let mut known = known(request, &mut file)?;
    let (rate, unit) = (known.rate, known.scaled.unit.clone());
    let from_s = request["from_s"].as_f64().or(known.run.as_ref().map(Scenario::settled_s)).unwrap_or(0.0);
    let mut x = after(file.read(&known.channel).map_err(bad)?, from_s, rate)?;
    known.warnings.extend(beyond_full_scale(&x, known.stored_as, &given(request), &Called::fields()));
    x.iter_mut().for_each(|v| *v *= known.scaled.factor);
    known.warnings.extend(once(&mut x, rate));
    let failed = |e: brinell::analysis::AnalysisError| Trouble::of(format!("`{}`: {e}", known.channel));
    let mut analysis = analyze(&x, rate, &known.options).map_err(failed)?;
    if known.options.exact && known.run.as_ref().is_some_and(|run| run.defects.is_empty()) {
        analysis.beside_healthy_run(None);
    }
    known.warnings.extend(analysis.flaws.iter().map(|(_, flaw)| flaw.to_string()));
    let spectrum = shown_spectrum(&x, rate).map_err(failed)?;
    let envelope = &analysis.view.spectrum;
    let mut answer = judged::verdict(&analysis);
    answer["warnings"] = json!(known.warnings);
    answer["used"] = json!(known.used(&analysis));
    answer["levels"] = analysis.headlines(&unit.name).into();
    answer["from_s"] = json!(from_s);
    answer["rate_hz"] = json!(rate);
    answer["unit"] = json!(in_si(&unit));
    // Beside a simulation's, in its unit.
    let mut si = |x: &[f64]| arrays.rounded(&unit.in_si(x));
    answer["x"] = si(&x[..x.len().min(SHOWN)]);
    answer["spectrum"] = json!({ "df": spectrum.frequency_step, "values": si(&spectrum.amplitude) });
    answer["envelope"] = json!({
        "df": envelope.frequency_step,
        "values": si(&envelope.amplitude),
        "band_hz": [analysis.view.band.low, analysis.view.band.high],
    });
    answer["lines"] = lines(&analysis);
    Ok(answer)
}

impl Known {
    /// All that a verdict rests on, for its head.
    fn used(&self, analysis: &Analysis) -> Vec<String> {
        let channel = format!("channel {}: {:.3} s, {} samples", self.channel, analysis.duration(), analysis.samples);
        let speed = format!("{}, and {}", self.speed_words, analysis.shaft_words());
        let before = [format!("bearing: {}", self.bearing_words), speed, self.rate_words.clone()];
        before.into_iter().chain(self.scaled.notes.iter().cloned()).chain([channel]).collect()
    }
}

/// What has to be known of a signal before it is judged: as given, else as the file states it; all that is missing is
/// asked for at once.
fn known(request: &Value, file: &mut SignalFile) -> Answer<Known> {
    let run = made_by(file);
    let channel = match request["channel"].as_str() {
        Some(name) => name.to_owned(),
        None => file.only_signal().map_err(bad)?.name.clone(),
    };
    let stated = file.channels().iter().find(|c| c.name == channel).cloned().unwrap_or_default();
    let stored_as = stated.stored_as;
    let (mut missing, mut warnings) = (Vec::new(), Vec::new());
    let rate = rate(request, file, &stated, &mut warnings)?.map_err(|words| missing.push(words)).ok();
    let scaled = scaled(request, file, (&channel, &stated), run.as_ref())?.map_err(|words| missing.push(words)).ok();
    let of_file = stated_speed(file, run.as_ref(), &channel)?;
    let speed = speed(request, of_file.as_ref())?;
    if speed.is_none() {
        missing.push("the file states no shaft speed, and defect frequencies follow from it; give it in r/min".into());
    }
    let bearing = bearing(request, run.as_ref())?;
    if bearing.is_none() {
        missing.push("which bearing? Choose one".into());
    }
    warnings.extend(scaled.iter().flat_map(|s| s.warnings.iter().cloned()));
    let (Some((rate, rate_words)), Some(scaled), Some((rpm, speed_words)), Some((orders, bearing_words))) =
        (rate, scaled, speed, bearing)
    else {
        return Err(Trouble(missing.into_iter().flat_map(|words| Trouble::of(words).0).collect()));
    };
    let mut options = Options::new(rpm.abs() / 60.0, orders);
    let tolerance = options.tolerance;
    let asked = format!("the speed {rpm}");
    let stated = of_file.filter(|_| !request["rpm"].is_null());
    let other_speed = stated.and_then(|(stated, place)| other_speed(&asked, rpm, stated, &place, tolerance));
    if let Some(run) = &run {
        options.silent = scaled.unit.missing_noise(run.sensor.noise_rms());
        let named = !request["bearing"].is_null() || !request["of"].is_null();
        options.exact = !named && request["rpm"].is_null();
        // At another speed frequencies in Hz are other orders.
        if other_speed.is_none() {
            warnings.extend(other_bearing(&bearing_words, &options.orders, &orders_of(&run.bearing), tolerance));
        }
    }
    warnings.extend(other_speed);
    Ok(Known { channel, stored_as, rate, scaled, options, run, rate_words, speed_words, bearing_words, warnings })
}

/// The rate, Hz, and that in words; `Err` within are the words that ask for it.
fn rate(
    request: &Value,
    file: &mut SignalFile,
    channel: &Channel,
    warnings: &mut Vec<String>,
) -> Answer<Result<(f64, String), String>> {
    let Some(given) = request["rate_hz"].as_f64() else {
        let stated = match channel.stated_rate() {
            Some(stated) => Ok(stated),
            None => {
                let times = file.times_of(channel);
                rate_by(file, times)?
            }
        };
        return Ok(stated.map(|(hz, place)| (hz, format!("sample rate {hz} Hz, from {place}"))));
    };
    if !(given > 0.0 && given.is_finite()) {
        return Err(Trouble::of(format!("sample rate {given}: expected more than 0 Hz")));
    }
    warnings.extend(file.other_rate(channel, &format!("the sample rate {given}"), given, five));
    Ok(Ok((given, format!("sample rate {given} Hz, as given"))))
}

/// What was given of the signal's numbers.
fn given(request: &Value) -> Given<'_> {
    let text = |key: &str| request[key].as_str().filter(|text| !text.trim().is_empty());
    Given { unit: text("unit"), sensitivity: text("sensitivity"), full_scale: text("full_scale") }
}

/// The unit; `Err` within are the words that ask for it.
fn scaled(
    request: &Value,
    file: &SignalFile,
    (name, channel): (&str, &Channel),
    run: Option<&Scenario>,
) -> Answer<Result<Scaled, String>> {
    let is_wav = file.kind() == FileKind::Wav;
    let numbers = Numbers { name, unit: channel.unit.as_deref(), stored_as: channel.stored_as, is_wav };
    let given = given(request);
    if given.unit.is_some() && given.full_scale.is_some() {
        return Err(Trouble::of("a full scale has its own unit: give it or the unit, not both"));
    }
    let own = own_unit(name, run);
    let own = own.map(|unit| (Unit::of(unit), format!("unit {unit}, as brinell's own channels have it")));
    match unit_of(&numbers, &given, &Called::fields(), own) {
        Ok(scaled) => Ok(Ok(scaled)),
        Err(NoUnit::Missing(words)) => Ok(Err(words)),
        Err(NoUnit::Refused(words)) => Err(Trouble::of(words)),
    }
}

/// The speed, r/min, and that in words.
fn speed(request: &Value, of_file: Option<&(f64, String)>) -> Answer<Option<(f64, String)>> {
    let (rpm, place) = match (request["rpm"].as_f64(), of_file) {
        (Some(rpm), _) => (rpm, "as given".to_owned()),
        (None, Some((rpm, place))) => (*rpm, format!("from {place}")),
        (None, None) => return Ok(None),
    };
    if !(rpm.is_finite() && rpm != 0.0) {
        return Err(Trouble::of(format!("shaft speed {rpm} r/min, {place}: expected a speed other than 0")));
    }
    Ok(Some((rpm, format!("shaft speed {rpm} r/min, {place}"))))
}

/// The defect frequencies' orders, and whose they are: a bearing's that is named, that of a scenario, or that of the run
/// that made the file.
fn bearing(request: &Value, run: Option<&Scenario>) -> Answer<Option<(DefectOrders, String)>> {
    if let Some(name) = request["bearing"].as_str() {
        let found = KnownBearing::named(name).and_then(|known| known.orders());
        return found.map(Some).map_err(Trouble::of);
    }
    if let Some(toml) = request["of"].as_str() {
        let bearing = text::read(toml)?.scenario.bearing;
        let name = bearing.preset.as_deref().map_or(String::new(), |name| format!(", {name}"));
        return Ok(Some((orders_of(&bearing), format!("that of this page{name}"))));
    }
    Ok(run.map(|run| (orders_of(&run.bearing), "that of the scenario of the run in the file".into())))
}

/// What comes after a time, s.
fn after(mut x: Vec<f64>, from_s: f64, rate: f64) -> Answer<Vec<f64>> {
    let length = x.len() as f64 / rate;
    if !(0.0..length).contains(&from_s) {
        return Err(Trouble::of(format!(
            "the signal begins to count at {from_s} s; allowed: 0 or more, and below its length, {length} s"
        )));
    }
    let first = (from_s * rate).round() as usize;
    x.drain(..first.min(x.len()));
    Ok(x)
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

/// The families that were called damage, as the page marks lines.
fn lines(analysis: &Analysis) -> Value {
    let all: Vec<Value> = (analysis.causes())
        .map(|f| {
            json!({
                "name": f.name,
                "hz": f.frequency,
                "nominal_hz": f.expected,
                "found": true,
                "harmonics": f.detected_harmonics(),
                "over_noise_db": f.highest_db(),
                "defect": null,
            })
        })
        .collect();
    json!(all)
}
