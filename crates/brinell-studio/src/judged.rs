//! Signals in and out: a measured file looked into and judged, and a run's channels as a file.

use crate::bench::Bench;
use crate::message::Arrays;
use crate::report::{Answer, Trouble};
use brinell::analysis::{Analysis, COLUMNS, DefectOrders, Family, Options, Quantity, Unit, analyze, shown_spectrum};
use brinell::bearing::{KnownBearing, orders_of};
use brinell::scenario::Scenario;
use brinell::signal::{Estimate, Indicator, Moments};
use brinell::simulate::Simulation;
use brinell_io::{Column, Format, Metadata, Outcome, keys};
use brinell_io::{SignalFile, open_bytes, rate_of_times};
use serde_json::{Value, json};

/// Most samples of a waveform that the page gets: more are not seen.
const SHOWN: usize = 1 << 18;

fn file(request: &Value, arrays: &Arrays) -> Answer<SignalFile> {
    let bytes = request.get("bytes").and_then(|b| arrays.octets(b));
    let bytes = bytes.ok_or_else(|| Trouble::of("\"bytes\" must be an array of u8"))?;
    let name = request["name"].as_str().unwrap_or("signal");
    open_bytes(name, bytes.to_vec()).map_err(|e| Trouble::of(e.to_string()))
}

/// `listen`: the channels of a file.
pub(crate) fn listen(request: &Value, arrays: &Arrays) -> Answer<Value> {
    let mut file = file(request, arrays)?;
    let signals: Vec<_> = (file.channels().iter()).filter(|c| c.may_be_signal()).cloned().collect();
    let time = signals.iter().find(|c| c.is_time()).cloned();
    let timed = time.and_then(|time| {
        let t = file.read(&time.name).ok()?;
        // Where the file does not say, as brinell's own CSV, in seconds.
        let hz = rate_of_times(&t, time.seconds_in_unit().unwrap_or(1.0)).ok()?;
        Some((t.len() as u64, hz))
    });
    // What is most probably meant comes first: a sensor's channel, and time last.
    let mut shown: Vec<_> = signals.iter().collect();
    shown.sort_by_key(|c| (c.is_time(), !c.name.starts_with("sensor")));
    let channels: Vec<Value> = (shown.into_iter())
        .map(|c| {
            json!({
                "name": c.name,
                "samples": c.length.or(timed.map(|t| t.0)),
                "rate_hz": c.rate.as_ref().map(|r| r.hz).or(timed.map(|t| t.1)),
                "unit": c.unit,
            })
        })
        .collect();
    let run = made_by(&file).map(|scenario| {
        json!({
            "bearing": scenario.bearing.preset,
            "rpm": rpm(&scenario),
            "from_s": scenario.settled_s(),
        })
    });
    Ok(json!({ "channels": channels, "run": run }))
}

/// The scenario of the run that made a file, where the file carries it.
fn made_by(file: &SignalFile) -> Option<Scenario> {
    Scenario::from_toml(file.metadata().scenario()?).ok()
}

fn rpm(scenario: &Scenario) -> Option<f64> {
    scenario.operation.speed_rpm.constant().filter(|rpm| *rpm != 0.0).map(f64::abs)
}

/// `judge`: one channel, analysed as `brinell analyze` does.
pub(crate) fn judge(request: &Value, given: &Arrays, arrays: &mut Arrays) -> Answer<Value> {
    let mut file = file(request, given)?;
    let name = match request["channel"].as_str() {
        Some(name) => name.to_owned(),
        None => (file.only_signal().map_err(|e| Trouble::of(e.to_string()))?).name.clone(),
    };
    let stated = file.channels().iter().find(|c| c.name == name);
    let stated_rate = stated.and_then(|c| c.rate.as_ref()).map(|r| r.hz);
    let unit = (request["unit"].as_str().map(str::to_owned))
        .or_else(|| stated.and_then(|c| c.unit.clone()))
        .unwrap_or_default();
    let rate = positive(request, "rate_hz").or(stated_rate);
    let rate = rate.ok_or_else(|| Trouble::of("the sample rate is missing: the file does not state it"))?;
    let run = made_by(&file);
    let unit = Unit::of(&unit);
    let options = options(request, run.as_ref(), &unit)?;
    let x = file.read(&name).map_err(|e| Trouble::of(e.to_string()))?;
    let x = unit.in_si(&x);
    let from_s = match (request["from_s"].as_f64(), &run) {
        (Some(from_s), _) => from_s,
        (None, Some(run)) => run.settled_s(),
        (None, None) => 0.0,
    };
    let x = after(&x, from_s, rate)?;
    let failed = |e: brinell::analysis::AnalysisError| Trouble::of(e.to_string());
    let mut analysis = analyze(x, rate, &options).map_err(failed)?;
    if options.exact && run.as_ref().is_some_and(|run| run.defects.is_empty()) {
        analysis.beside_healthy_run(None);
    }
    let spectrum = shown_spectrum(x, rate).map_err(failed)?;
    let envelope = &analysis.view.spectrum;
    let mut answer = verdict(&analysis);
    let mut moments = Moments::default();
    moments.extend(x);
    answer["moments"] = moments_json(&moments);
    answer["from_s"] = json!(from_s);
    answer["rate_hz"] = json!(rate);
    answer["unit"] = json!(in_si(&unit));
    answer["x"] = arrays.rounded(&x[..x.len().min(SHOWN)]);
    answer["spectrum"] = json!({
        "df": spectrum.frequency_step, "values": arrays.rounded(&spectrum.amplitude),
    });
    answer["envelope"] = json!({
        "df": envelope.frequency_step,
        "values": arrays.rounded(&envelope.amplitude),
        "band_hz": [analysis.view.band.low, analysis.view.band.high],
    });
    answer["lines"] = lines(&analysis);
    Ok(answer)
}

fn positive(request: &Value, key: &str) -> Option<f64> {
    request[key].as_f64().filter(|x| *x > 0.0 && x.is_finite())
}

/// What is known of a signal beside its samples: as requested, else of the run that made it.
fn options(request: &Value, run: Option<&Scenario>, unit: &Unit) -> Answer<Options> {
    let requested = positive(request, "rpm");
    let turned = requested.or(run.and_then(rpm));
    let turned = turned.ok_or_else(|| Trouble::of("the speed of the shaft is missing, r/min"))?;
    let named = request["bearing"].as_str();
    let own = run.filter(|run| named.is_none() || named == run.bearing.preset.as_deref());
    let orders = match (own, named) {
        (Some(run), _) => orders_of(&run.bearing),
        (None, None) => DefectOrders::default(),
        (None, Some(name)) => KnownBearing::named(name).and_then(|known| known.orders()).map_err(Trouble::of)?.0,
    };
    let mut options = Options::new(turned / 60.0, orders);
    if let Some(run) = run {
        // Of samples in SI.
        let missing = unit.missing_noise(run.sensor.noise_rms());
        options.silent = missing.map(|noise| noise * unit.to_si);
        options.exact = own.is_some() && rpm(run) == Some(turned);
    }
    Ok(options)
}

/// What comes after a time, s.
fn after(x: &[f64], from_s: f64, rate: f64) -> Answer<&[f64]> {
    let length = x.len() as f64 / rate;
    if !(0.0..length).contains(&from_s) {
        return Err(Trouble::of(format!(
            "the signal begins to count at {from_s} s; allowed: 0 or more, and below its length, {length} s"
        )));
    }
    let first = (from_s * rate).round() as usize;
    Ok(&x[first.min(x.len())..])
}

/// The unit of what [`Unit::in_si`] gives.
fn in_si(unit: &Unit) -> &str {
    match unit.quantity {
        Quantity::Acceleration => "m/s^2",
        Quantity::Velocity => "m/s",
        Quantity::Displacement => "m",
        _ => &unit.name,
    }
}

/// Headline, words and table of an analysis, and what [`differ`](crate::differ) compares of it.
pub(crate) fn verdict(analysis: &Analysis) -> Value {
    let words = analysis.verdict();
    let found = |f: &Family| json!({ "name": f.name, "hz": f.frequency });
    json!({
        "headline": words.lines().next(),
        "words": words,
        "table": { "columns": COLUMNS.map(|c| c.trim_start_matches('#')), "rows": analysis.rows() },
        "samples": analysis.samples,
        "damage": analysis.causes().map(found).collect::<Vec<_>>(),
        "indicators": analysis.indicators.iter().map(estimated).collect::<Vec<_>>(),
    })
}

/// An indicator with its 95 % interval and that interval's degrees of freedom.
fn estimated((indicator, estimate): &(Indicator, Estimate)) -> Value {
    let interval = estimate.interval;
    json!({
        "name": indicator.name(),
        "value": estimate.value,
        "low": interval.map(|i| i.low),
        "high": interval.map(|i| i.high),
        "freedom": interval.map(|i| i.freedom),
    })
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

/// RMS, peak, crest factor and kurtosis.
pub(crate) fn moments_json(moments: &Moments) -> Value {
    let of = |i: Indicator| moments.get(i).filter(|v| v.is_finite());
    json!({
        "rms": of(Indicator::Rms),
        "peak": of(Indicator::Peak),
        "crest": of(Indicator::CrestFactor),
        "kurtosis": of(Indicator::Kurtosis),
        "samples": moments.count(),
    })
}

/// The columns of a run's file of signals, time and the recorded channels, and what the file says of itself.
pub fn signal_table(scenario_toml: String, simulation: &Simulation) -> (Vec<Column>, Metadata) {
    let channels = simulation.channels().iter();
    let columns = std::iter::once(Column::new("t", "s", "time"))
        .chain(channels.map(|c| Column::new(&c.name, c.unit, &c.description)))
        .collect();
    let metadata = Metadata::default()
        .with(keys::SCENARIO, scenario_toml)
        .with(keys::VERSION, brinell::VERSION)
        .with(keys::SAMPLE_RATE_HZ, simulation.sample_rate().to_string());
    (columns, metadata)
}

/// `save`: the recorded channels of a run from t = 0 that is over, as the command writes them.
pub(crate) fn save(request: &Value, bench: &Bench, arrays: &mut Arrays) -> Answer<Value> {
    let (Some(signals), Some(_)) = (&bench.recording.signals, &bench.finished) else {
        return Err(Trouble::of("only a run from t = 0 that is over is saved"));
    };
    let (format, kind) = match request["format"].as_str() {
        Some("csv") => (Format::Csv, "text/csv"),
        Some("wav") => (Format::Wav, "audio/wav"),
        Some("npz") => (Format::Npz, "application/zip"),
        _ => {
            return Err(Trouble::of("\"format\" must be \"csv\", \"wav\" or \"npz\""));
        }
    };
    let (columns, metadata) = signal_table(bench.loaded.to_toml(), bench.simulation());
    let failed = |e: brinell_io::IoError| Trouble::of(e.to_string());
    let mut writer = format.in_memory(&columns, &metadata).map_err(failed)?;
    let all: Vec<&[f64]> = signals.names().iter().filter_map(|n| signals.get(n)).collect();
    let mut row = vec![0.0; all.len()];
    for k in 0..all.first().map_or(0, |c| c.len()) {
        for (value, column) in row.iter_mut().zip(&all) {
            *value = column[k];
        }
        writer.write_row(&row).map_err(failed)?;
    }
    let bytes = writer.finish(Outcome::Complete).map_err(failed)?;
    let stem: String = (bench.loaded.scenario.name.chars())
        .map(|c| if c.is_alphanumeric() || "-_".contains(c) { c } else { '-' })
        .collect();
    let ending = format.name();
    Ok(json!({ "name": format!("{stem}.{ending}"), "type": kind, "bytes": arrays.bytes(&bytes) }))
}
