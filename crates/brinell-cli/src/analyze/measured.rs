//! The signal in a file: which channel, at what rate, in what unit; and what else the file states.

use crate::failure::Failure;
use brinell::analysis::Unit;
use brinell::document::{Loaded, read};
use brinell::scenario::Speed;
use brinell::signal::Moments;
use brinell_io::{Channel, IoError, RateSource, SignalFile, open};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Most samples analysed unless told: 82 s at 51.2 kHz. Bounds memory, whatever the file.
pub(crate) const MOST: usize = 1 << 22;
/// Steps between times may differ by so much from their mean, relative, before a rate is refused.
const UNEVEN: f64 = 0.02;

/// A speed that strays from its mean by more than this share is followed; below, the tolerance covers it.
const VARIES: f64 = 0.005;

/// What was asked of a file.
#[derive(Debug, Default)]
pub(crate) struct Wanted<'a> {
    pub(crate) channel: Option<&'a str>,
    pub(crate) rate: Option<f64>,
    pub(crate) time_channel: Option<&'a str>,
    pub(crate) time_unit: Option<&'a str>,
    pub(crate) unit: Option<&'a str>,
    pub(crate) speed_channel: Option<&'a str>,
    pub(crate) start: Option<f64>,
    pub(crate) duration: Option<f64>,
}

/// A stretch of one channel, with everything that is known of it.
pub(crate) struct Measured {
    pub(crate) path: PathBuf,
    pub(crate) channel: String,
    pub(crate) x: Vec<f64>,
    pub(crate) rate: f64,
    pub(crate) unit: Unit,
    /// Where the stretch begins, s.
    pub(crate) start: f64,
    /// Where rate, unit and channel come from, and what was left out: sentences.
    pub(crate) notes: Vec<String>,
    /// What deserves attention.
    pub(crate) warnings: Vec<String>,
    /// What lies beyond the stretch, where the signal is longer than one analysis takes.
    pub(crate) rest: Option<Rest>,
    /// Shaft speed that the file states, and where.
    pub(crate) speed: Option<StatedSpeed>,
    /// The scenario of the run that made the file.
    pub(crate) scenario: Option<Box<Loaded>>,
}

/// A speed that the file states.
pub(crate) struct StatedSpeed {
    /// Its mean, r/min.
    pub(crate) rpm: f64,
    /// Where it is stated.
    pub(crate) source: String,
    /// Time (s, from the stretch's beginning) and speed (r/min), where it varies by more than [`VARIES`].
    pub(crate) course: Vec<(f64, f64)>,
}

impl StatedSpeed {
    fn steady(rpm: f64, source: String) -> Self {
        StatedSpeed {
            rpm,
            source,
            course: Vec::new(),
        }
    }
}

fn usage(message: String) -> Failure {
    Failure::Usage(message)
}

/// Reads what was wanted.
pub(crate) fn load(path: &Path, wanted: &Wanted) -> Result<Measured, Failure> {
    let path = signals_in(path)?;
    let mut file = open(&path).map_err(bad)?;
    let scenario = scenario(&file, &path);
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let (name, channel) = channel(&file, wanted.channel, scenario.as_deref(), &mut notes)?;
    let (rate, rate_note) = rate(
        &mut file,
        &channel,
        wanted,
        scenario.is_some(),
        &mut warnings,
    )?;
    notes.push(rate_note);
    let unit = unit(
        &path,
        &name,
        &channel,
        wanted,
        scenario.is_some(),
        &mut notes,
        &mut warnings,
    )?;

    let positive = |option: &str, value: Option<f64>, least: f64| match value {
        Some(v) if !(v.is_finite() && v >= least) => Err(usage(format!(
            "{option} {v}: expected {} s",
            if least == 0.0 {
                "0 or more"
            } else {
                "more than 0"
            }
        ))),
        _ => Ok(()),
    };
    positive("--start", wanted.start, 0.0)?;
    positive("--duration", wanted.duration, f64::MIN_POSITIVE)?;
    let settled = scenario.as_deref().map(settled);
    let start = match (wanted.start, settled) {
        (Some(start), _) => start,
        (None, Some(settled)) => {
            notes.push(format!(
                "begins at {settled:.4} s, after the run's load ramp and a turn of the shaft"
            ));
            settled
        }
        (None, None) => 0.0,
    };
    let skip = (start * rate).round() as usize;
    let (x, rest) = match wanted.duration {
        Some(d) => {
            let most = ((d * rate).round() as usize).max(1);
            (stretch(&mut file, &name, skip, most)?.0, None)
        }
        None => whole(&mut file, &name, skip, rate)?,
    };
    if x.is_empty() {
        return Err(usage(format!(
            "{}: `{name}` holds no samples {}",
            path.display(),
            if skip > 0 {
                format!("beyond {start} s")
            } else {
                "at all".into()
            }
        )));
    }
    if let Some(rest) = &rest {
        warnings.push(format!(
            "a long signal, {} samples: the verdict is on the first {MOST} ({:.1} s from {start} s on), and one on the last {} follows it; \
             --start and --duration choose another stretch",
            rest.samples,
            MOST as f64 / rate,
            rest.last.len()
        ));
    }
    let seconds = x.len() as f64 / rate;
    let speed = speed(
        &mut file,
        wanted,
        scenario.as_deref(),
        &name,
        (start, seconds, rate),
    )?;
    Ok(Measured {
        path,
        channel: name,
        x,
        rate,
        unit,
        start,
        rest,
        notes,
        warnings,
        speed,
        scenario,
    })
}

/// Whatever is wrong with a file that is read is bad input.
fn bad(error: IoError) -> Failure {
    usage(error.to_string())
}

/// The file itself, or the signals in the folder of a run.
fn signals_in(path: &Path) -> Result<PathBuf, Failure> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    ["parquet", "npz", "mat", "csv", "uff", "wav"]
        .iter()
        .map(|ending| path.join(format!("signals.{ending}")))
        .find(|file| file.is_file())
        .ok_or_else(|| {
            usage(format!(
                "{} is a folder without signals.parquet, .npz, .mat, .csv, .uff or .wav; name a file, or the folder of a run",
                path.display()
            ))
        })
}

/// The scenario that the file carries, or that lies beside it where the file is a run's.
fn scenario(file: &SignalFile, path: &Path) -> Option<Box<Loaded>> {
    let carried = (file.metadata().pairs.iter())
        .find(|(key, _)| key.starts_with("brinell") && key.ends_with("scenario"))
        .map(|(_, text)| text.clone());
    let beside = || {
        let own = path.file_stem()? == "signals" && file.channels().first()?.name == "t";
        own.then(|| std::fs::read_to_string(path.with_file_name("scenario.toml")).ok())?
    };
    let text = carried.or_else(beside)?;
    read(&text, &[]).ok().map(Box::new)
}

/// Where a run's statistics begin: after the load ramp and a full turn, or half-way through.
fn settled(run: &Loaded) -> f64 {
    let turn = match &run.scenario.operation.speed_rpm {
        Speed::Constant(rpm) if *rpm != 0.0 => 60.0 / rpm.abs(),
        _ => 0.0,
    };
    (run.scenario.operation.load_ramp_s + turn).min(0.5 * run.scenario.simulation.duration_s)
}

/// The channel meant, by name, part of a name, or number.
fn resolve(file: &SignalFile, text: &str, option: &str) -> Result<(String, Channel), Failure> {
    let channels = file.channels();
    let whole = |c: &Channel| (c.name.clone(), c.clone());
    if let Some(found) = channels.iter().find(|c| c.name == text) {
        return Ok(whole(found));
    }
    if let Ok(number) = text.trim().parse::<usize>() {
        return (number
            .checked_sub(1)
            .and_then(|i| channels.get(i))
            .map(whole))
        .ok_or_else(|| {
            usage(format!(
                "{option} {text}: {} has {} channels; they count from 1: {}",
                file.path().display(),
                channels.len(),
                listed(channels.iter())
            ))
        });
    }
    // `X(:,2)`: the reader takes it apart; rate and unit are the matrix's.
    if let Some(open) = text.rfind('(')
        && let Some(found) = channels.iter().find(|c| c.name == text[..open])
    {
        return Ok((text.to_owned(), found.clone()));
    }
    let lower = text.to_lowercase();
    let partly: Vec<&Channel> = (channels.iter())
        .filter(|c| c.may_be_signal() && c.name.to_lowercase().contains(&lower))
        .collect();
    match partly[..] {
        [only] => Ok(whole(only)),
        [] => Err(usage(format!(
            "{option} {text}: {} has no such channel; there are {}",
            file.path().display(),
            listed(channels.iter())
        ))),
        _ => Err(usage(format!(
            "{option} {text}: several channels are called like that: {}",
            listed(partly.into_iter())
        ))),
    }
}

fn listed<'a>(channels: impl Iterator<Item = &'a Channel>) -> String {
    let names: Vec<&str> = channels.map(|c| c.name.as_str()).collect();
    let more = names.len().saturating_sub(20);
    let shown = names[..names.len() - more].join(", ");
    match more {
        0 if shown.is_empty() => "nothing".into(),
        0 => shown,
        _ => format!("{shown} and {more} more"),
    }
}

fn channel(
    file: &SignalFile,
    wanted: Option<&str>,
    run: Option<&Loaded>,
    notes: &mut Vec<String>,
) -> Result<(String, Channel), Failure> {
    if let Some(text) = wanted {
        return resolve(file, text, "--channel");
    }
    if let Some(run) = run {
        let load = run.scenario.operation.load_n;
        let along = if load[1].abs() > load[0].abs() {
            "measured_ay"
        } else {
            "measured_ax"
        };
        if let Some(found) = file.channels().iter().find(|c| c.name == along) {
            notes.push(format!(
                "channel {along}, along the load, as nobody named one"
            ));
            return Ok((found.name.clone(), found.clone()));
        }
    }
    let signals: Vec<&Channel> = (file.channels().iter())
        .filter(|c| c.may_be_signal() && time_unit(c).is_none() && !is_time(c))
        .collect();
    match signals[..] {
        [only] => Ok((only.name.clone(), only.clone())),
        [] => Err(usage(format!(
            "{}: nothing here is a signal; there are {}",
            file.path().display(),
            listed(file.channels().iter())
        ))),
        _ => Err(usage(format!(
            "{}: several channels may be the signal; choose one with --channel: {}",
            file.path().display(),
            listed(signals.into_iter())
        ))),
    }
}

/// Whether a channel is called like a column of times.
fn is_time(channel: &Channel) -> bool {
    let name = channel.name.to_lowercase();
    let bare = name
        .split(['[', '('])
        .next()
        .unwrap_or("")
        .trim()
        .to_owned();
    ["t", "time", "times", "timestamp", "zeit"].contains(&bare.as_str())
}

/// Seconds in the unit of a column of times, where its unit is one.
fn time_unit(channel: &Channel) -> Option<f64> {
    channel
        .unit
        .as_deref()
        .filter(|_| is_time(channel))
        .and_then(seconds)
}

fn seconds(unit: &str) -> Option<f64> {
    Some(match unit.trim().to_lowercase().as_str() {
        "s" | "sec" | "second" | "seconds" => 1.0,
        "ms" | "msec" => 1e-3,
        "us" | "µs" | "μs" | "usec" => 1e-6,
        _ => return None,
    })
}

fn rate(
    file: &mut SignalFile,
    channel: &Channel,
    wanted: &Wanted,
    own: bool,
    warnings: &mut Vec<String>,
) -> Result<(f64, String), Failure> {
    let stated = channel.rate.as_ref().map(|rate| {
        let place = match &rate.source {
            RateSource::Header(field) => format!("the file's header ({field})"),
            RateSource::Variable(name) => format!("the variable `{name}` in the file"),
        };
        (rate.hz, place)
    });
    if let Some(given) = wanted.rate {
        if !(given > 0.0 && given.is_finite()) {
            return Err(usage(format!("--rate {given}: expected more than 0 Hz")));
        }
        if let Some((hz, place)) = stated.filter(|(hz, _)| (hz / given - 1.0).abs() > 1e-6) {
            warnings.push(format!(
                "--rate {given} Hz was taken, but {place} says {hz} Hz"
            ));
        }
        return Ok((given, format!("sample rate {given} Hz, as given")));
    }
    if let Some((hz, place)) = stated {
        return Ok((hz, format!("sample rate {hz} Hz, from {place}")));
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
        return Err(usage(format!(
            "{}: the file states no sample rate; give --rate HZ",
            file.path().display()
        )));
    };
    let unit = match (wanted.time_unit, time.unit.as_deref().and_then(seconds)) {
        (Some(text), _) => seconds(text)
            .ok_or_else(|| usage(format!("--time-unit {text}: expected s, ms or us")))?,
        (None, Some(unit)) => unit,
        // By brinell's own contract.
        (None, None) if own && time.name == "t" => 1.0,
        (None, None) => {
            return Err(usage(format!(
                "{}: the file states no sample rate, and no unit for its times in `{}`; give --rate HZ, or --time-unit s",
                file.path().display(),
                time.name
            )));
        }
    };
    let (times, _) = stretch(file, &time.name, 0, 1 << 16)?;
    let hz = even(&times, unit).map_err(|why| {
        usage(format!(
            "{}: no sample rate follows from `{}`: {why}; give --rate HZ if you know it",
            file.path().display(),
            time.name
        ))
    })?;
    Ok((
        hz,
        format!("sample rate {hz} Hz, from the times in `{}`", time.name),
    ))
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
    if let Some((i, w)) = off.filter(|_| !rounded) {
        return Err(format!(
            "its steps are uneven ({} after {} values, {step} on average)",
            w[1] - w[0],
            i + 1
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

#[allow(clippy::too_many_arguments)]
fn unit(
    path: &Path,
    name: &str,
    channel: &Channel,
    wanted: &Wanted,
    own: bool,
    notes: &mut Vec<String>,
    warnings: &mut Vec<String>,
) -> Result<Unit, Failure> {
    let stated = channel.unit.as_deref().map(Unit::of);
    if let Some(text) = wanted.unit {
        let given = Unit::of(text);
        if let Some(other) = stated.filter(|s| s.name != given.name) {
            warnings.push(format!(
                "--unit {} was taken, but the file says {}",
                given.name, other.name
            ));
        }
        notes.push(format!("unit {}, as given", given.name));
        return Ok(given);
    }
    if let Some(unit) = stated {
        notes.push(format!("unit {}, from the file", unit.name));
        return Ok(unit);
    }
    if own && (name.ends_with("_ax") || name.ends_with("_ay")) {
        notes.push("unit m/s^2, as brinell's own channels have it".into());
        return Ok(Unit::of("m/s^2"));
    }
    Err(usage(format!(
        "{}: the file states no unit for `{name}`; give --unit, such as --unit g or --unit m/s^2",
        path.display()
    )))
}

/// The speed that the file states, or a channel of speeds; `stretch_of` is where the signal's stretch begins and how long it is, s,
/// and the signal's rate, Hz.
fn speed(
    file: &mut SignalFile,
    wanted: &Wanted,
    run: Option<&Loaded>,
    signal: &str,
    (start, seconds, rate): (f64, f64, f64),
) -> Result<Option<StatedSpeed>, Failure> {
    if let Some(text) = wanted.speed_channel {
        let (name, channel) = resolve(file, text, "--speed-channel")?;
        // A channel of its own rate, or sampled with the signal.
        let own = channel.rate.as_ref().map_or(rate, |r| r.hz);
        let skip = (start * own).round() as usize;
        let most = ((seconds * own).round() as usize).clamp(1, MOST);
        let (values, _) = stretch(file, &name, skip, most)?;
        if values.is_empty() {
            return Err(usage(format!(
                "--speed-channel {name}: holds no values {start} s from its beginning"
            )));
        }
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            return Err(usage(format!(
                "--speed-channel {name}: holds the value {bad}; expected speeds in r/min"
            )));
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let covers = values.len() as f64 / own;
        let source = format!("the channel `{name}`, taken as r/min");
        let course = course(&values, own, mean);
        if course.is_empty() {
            let source = format!("the mean of {source}");
            return Ok(Some(StatedSpeed::steady(mean, source)));
        }
        if covers < 0.98 * seconds {
            return Err(usage(format!(
                "--speed-channel {name}: its {} values last {covers:.3} s at {own} Hz and the signal {seconds:.3} s; a speed that varies has to be \
                 known all along",
                values.len()
            )));
        }
        let (low, high) = (course.iter()).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| {
            (l.min(p.1), h.max(p.1))
        });
        if low <= 0.0 && high >= 0.0 {
            return Err(usage(format!(
                "--speed-channel {name}: the speed goes from {low:.1} to {high:.1} r/min; expected a shaft that keeps turning one way"
            )));
        }
        let source = format!(
            "{source}: {low:.1} to {high:.1}, so envelopes are taken at equal angles of the shaft"
        );
        return Ok(Some(StatedSpeed {
            rpm: mean,
            source,
            course,
        }));
    }
    if let Some(run) = run {
        if let Speed::Constant(rpm) = run.scenario.operation.speed_rpm {
            let source = "the scenario of the run in the file".into();
            return Ok(Some(StatedSpeed::steady(rpm, source)));
        }
        return Ok(None);
    }
    // A single number called like a speed, as X097RPM beside X097_DE_time.
    let prefix: String = signal
        .chars()
        .take_while(char::is_ascii_alphanumeric)
        .collect();
    let named: Vec<String> = (file.channels().iter())
        .filter(|c| c.length == Some(1) && c.unreadable.is_none())
        .map(|c| c.name.clone())
        .filter(|n| n.to_lowercase().trim_end_matches("_").ends_with("rpm"))
        .collect();
    let mine: Vec<&String> = named.iter().filter(|n| n.starts_with(&prefix)).collect();
    let name = match (&mine[..], &named[..]) {
        ([only], _) => (*only).clone(),
        (_, [only]) => only.clone(),
        _ => return Ok(None),
    };
    let (values, _) = stretch(file, &name, 0, 1)?;
    Ok((values.first().filter(|v| v.is_finite())).map(|rpm| {
        let source = format!("the variable `{name}` in the file, taken as r/min");
        StatedSpeed::steady(*rpm, source)
    }))
}

/// Means over a tenth of a second or two turns, whichever is longer; none where they stay within [`VARIES`] of the mean.
fn course(values: &[f64], rate: f64, mean: f64) -> Vec<(f64, f64)> {
    let seconds = f64::max(0.1, 120.0 / mean.abs().max(1.0));
    let each = ((seconds * rate).round() as usize).max(1);
    let points: Vec<(f64, f64)> = (values.chunks(each).enumerate())
        .map(|(i, part)| {
            let middle = (i * each) as f64 + 0.5 * part.len() as f64;
            (middle / rate, part.iter().sum::<f64>() / part.len() as f64)
        })
        .collect();
    let varies = (points.iter()).any(|(_, v)| (v - mean).abs() > VARIES * mean.abs());
    if varies { points } else { Vec::new() }
}

/// Up to `most` samples after the first `skip`, and whether there are more.
fn stretch(
    file: &mut SignalFile,
    name: &str,
    skip: usize,
    most: usize,
) -> Result<(Vec<f64>, bool), Failure> {
    let (mut values, mut passed, mut more) = (Vec::new(), 0, false);
    file.read_pieces(name, |piece| {
        let from = skip.saturating_sub(passed).min(piece.len());
        passed += piece.len();
        let room = most - values.len();
        let rest = &piece[from..];
        more = rest.len() > room;
        values.extend_from_slice(&rest[..rest.len().min(room)]);
        if more {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .map_err(bad)?;
    Ok((values, more))
}

/// What lies beyond the first [`MOST`] samples of a long signal.
pub(crate) struct Rest {
    /// Samples of the whole, from the first one analysed on.
    pub(super) samples: u64,
    /// Their moments.
    pub(super) moments: Moments,
    /// Those that are not finite numbers.
    pub(super) missing: u64,
    /// The last [`MOST`] samples that do not belong to the first, or as many as there are.
    pub(super) last: Vec<f64>,
    /// Where those begin, s.
    pub(super) last_start: f64,
}

/// All samples after the first `skip`, in one pass: the first [`MOST`] of them, and what lies beyond.
fn whole(
    file: &mut SignalFile,
    name: &str,
    skip: usize,
    rate: f64,
) -> Result<(Vec<f64>, Option<Rest>), Failure> {
    let (mut first, mut passed) = (Vec::new(), 0);
    let mut rest = Rest {
        samples: 0,
        moments: Moments::new(),
        missing: 0,
        last: Vec::new(),
        last_start: 0.0,
    };
    // A ring; `at` is its oldest sample once it is full.
    let mut at = 0;
    file.read_pieces(name, |piece| {
        let from = skip.saturating_sub(passed).min(piece.len());
        passed += piece.len();
        for value in &piece[from..] {
            rest.samples += 1;
            if value.is_finite() {
                rest.moments.push(*value);
            } else {
                rest.missing += 1;
            }
            if first.len() < MOST {
                first.push(*value);
            } else if rest.last.len() < MOST {
                rest.last.push(*value);
            } else {
                rest.last[at] = *value;
                at = (at + 1) % MOST;
            }
        }
        ControlFlow::Continue(())
    })
    .map_err(bad)?;
    rest.last.rotate_left(at);
    rest.last_start = (skip as u64 + rest.samples - rest.last.len() as u64) as f64 / rate;
    let long = !rest.last.is_empty();
    Ok((first, long.then_some(rest)))
}
