//! The signal in a file: which channel, at what rate, in what unit; and what else the file states.

mod args;
mod channel;
mod rate;
mod speed;
mod stretch;
mod unit;
mod wanted;

use crate::failure::Failure;
pub(crate) use args::SignalArgs;
use brinell::analysis::AnalysisError;
use brinell::analysis::{Scaled, Unit, once};
use brinell::document::{Loaded, read};
use brinell_io::{Channel, FileKind, Format, SignalFile, open};
use channel::{Chosen, channel};
use rate::rate;
pub(crate) use speed::StatedSpeed;
use speed::{speed, states_speed};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
pub(crate) use stretch::{Beyond, MOST, Reading, Rest};
use stretch::{Part, bad, scale, stretch};
use unit::{beyond, unit};
pub(crate) use wanted::{Like, Wanted};

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
    /// What is warned of where the file repeats one stretch, to which `x` is cut.
    pub(crate) repeats: Option<String>,
    /// What lies beyond the stretch, where the signal is longer than one analysis takes.
    pub(crate) beyond: Option<Beyond>,
    /// Shaft speed that the file states, and where.
    pub(crate) speed: Option<StatedSpeed>,
    /// The scenario of the run that made the file.
    pub(crate) scenario: Option<Box<Loaded>>,
    /// Further records of the machine, each with the shaft's speed in it, Hz.
    pub(crate) others: Vec<(Measured, f64)>,
}

impl Measured {
    /// Itself and the others.
    pub(super) fn records(&self) -> impl Iterator<Item = &Measured> {
        std::iter::once(self).chain(self.others.iter().map(|(record, _)| record))
    }

    /// What is known of the run that made the signal: sentences.
    pub(super) fn of_the_run(&self) -> Vec<String> {
        let noise = self.silent().filter(|noise| *noise > 0.0);
        let added = |noise| {
            format!(
                "its sensor has less noise than a quiet machine: for the verdict {} {} are added",
                crate::say::short(noise, 3),
                self.unit.name
            )
        };
        (self.scenario.as_deref().map(truth).into_iter()).chain(noise.map(added)).collect()
    }

    /// Where a run made it: what its sensor lacks of a machine's noise, in the signal's unit.
    pub(super) fn silent(&self) -> Option<f64> {
        self.unit.missing_noise(self.scenario.as_ref()?.scenario.sensor.noise_rms())
    }
}

/// The request for a missing shaft speed.
pub(super) const ASK_SPEED: &str = "the file states no shaft speed, and defect frequencies follow from it; give --speed RPM, --speed-channel NAME, or \
     --tacho NAME for a channel of pulses";
/// The request for a missing bearing.
pub(super) const ASK_BEARING: &str = "which bearing? Give --bearing NAME, or --rollers, --pitch and --diameter, or frequencies (--bpfo, --bpfi, --bsf, --ftf)";

/// All that has to be given, at once.
fn not_stated(path: &Path, missing: &[String]) -> Failure {
    let path = path.display();
    Failure::Usage(match missing {
        [only] => format!("{path}: {only}"),
        _ => format!("{path}: {} things have to be given:\n  {}", missing.len(), missing.join("\n  ")),
    })
}

/// Reads what was wanted.
pub(crate) fn load(path: &Path, wanted: &Wanted) -> Result<Measured, Failure> {
    let path = signals_in(path)?;
    let mut file = open(&path).map_err(bad)?;
    let scenario = scenario(&file, &path);
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let run = scenario.as_deref();
    let Known { name, channel, rate, scaled: Scaled { unit, factor, .. } } =
        known(&mut file, &path, wanted, run, (&mut notes, &mut warnings))?;
    let start = start(wanted, run, &mut notes)?;
    let skip = (start * rate).round() as usize;
    let most = match wanted.signal.duration {
        Some(d) => ((d * rate).round() as usize).max(1),
        None => MOST,
    };
    let part = Part { skip, most, rate };
    let (mut x, more) = stretch(&mut file, &name, part, &mut warnings)?;
    if let Some(first) = x.iter().position(|v| !v.is_finite())
        && let Some((line, text)) = file.cell(&name, (skip + first) as u64)
    {
        let count = x.iter().filter(|v| !v.is_finite()).count();
        let why = AnalysisError::NotFinite { count, samples: x.len(), first: first + 1 };
        let text = if text.is_empty() { "empty".into() } else { format!("`{text}`") };
        let without = part.without(first);
        return Err(Failure::Usage(format!(
            "{}, `{name}`: {why}; on line {line} it is {text}; {without}",
            path.display()
        )));
    }
    warnings.extend(beyond(&x, channel.stored_as, wanted));
    scale(&mut x, factor);
    let long = more && wanted.signal.duration.is_none();
    if x.is_empty() {
        return Err(Failure::Usage(format!(
            "{}: `{name}` holds no samples {}",
            path.display(),
            if skip > 0 { format!("beyond {start} s") } else { "at all".into() }
        )));
    }
    if long {
        warnings.push(format!(
            "a long signal: the verdict is on its first {MOST} samples ({:.1} s from {start} s on), and one on its last follows it; \
             --start and --duration choose another stretch",
            MOST as f64 / rate
        ));
    }
    let repeats = once(&mut x, rate);
    warnings.extend(repeats.clone());
    let seconds = x.len() as f64 / rate;
    let speed = speed(&mut file, wanted, run, (&name, &channel), (start, seconds, rate))?;
    Ok(Measured {
        beyond: long.then(|| Beyond { file, name: name.clone(), skip, rate, factor }),
        path,
        channel: name,
        x,
        rate,
        unit,
        start,
        notes,
        warnings,
        repeats,
        speed,
        scenario,
        others: Vec::new(),
    })
}

/// What has to be known of a channel before it is read.
struct Known {
    name: String,
    channel: Channel,
    /// Hz.
    rate: f64,
    scaled: Scaled,
}

/// Channel, rate and unit; what is missing is requested at once, speed and bearing with it.
fn known(
    file: &mut SignalFile,
    path: &Path,
    wanted: &Wanted,
    run: Option<&Loaded>,
    (notes, warnings): (&mut Vec<String>, &mut Vec<String>),
) -> Result<Known, Failure> {
    let mut missing = Vec::new();
    let (name, channel) = match channel(file, wanted, run, notes)? {
        Chosen::One(name, channel) => (name, channel),
        Chosen::Among(channels, words) => {
            missing.push(words);
            // What any of them states is not requested yet.
            let states = |c: &Channel| usize::from(c.rate.is_some()) + usize::from(c.unit.is_some());
            let most = channels.into_iter().rev().max_by_key(states);
            most.map(|c| (c.name.clone(), c)).ok_or_else(|| not_stated(path, &missing))?
        }
    };
    let rate = rate(file, &channel, wanted, run.is_some(), warnings)?;
    notes.extend(rate.as_ref().ok().map(|(_, note)| note.clone()));
    let is_wav = file.kind() == FileKind::Wav;
    let unit = unit(&name, &channel, is_wav, wanted, run)?;
    if let Ok(scaled) = &unit {
        notes.extend(scaled.notes.iter().cloned());
        warnings.extend(scaled.warnings.iter().cloned());
    }
    missing.extend(rate.as_ref().err().cloned());
    missing.extend(unit.as_ref().err().cloned());
    if wanted.ask_speed && !states_speed(file, wanted, run, &name) {
        missing.push(ASK_SPEED.into());
    }
    if wanted.ask_bearing && run.is_none() {
        missing.push(ASK_BEARING.into());
    }
    match (rate, unit, &missing[..]) {
        (Ok((rate, _)), Ok(scaled), []) => Ok(Known { name, channel, rate, scaled }),
        _ => Err(not_stated(path, &missing)),
    }
}

/// Where the stretch begins, s: where it was wanted, or where a run's statistics begin.
fn start(wanted: &Wanted, run: Option<&Loaded>, notes: &mut Vec<String>) -> Result<f64, Failure> {
    let positive = |option: &str, value: Option<f64>, least: f64| match value {
        Some(v) if !(v.is_finite() && v >= least) => Err(Failure::Usage(format!(
            "{option} {v}: expected {} s",
            if least == 0.0 { "0 or more" } else { "more than 0" }
        ))),
        _ => Ok(()),
    };
    positive("--start", wanted.signal.start, 0.0)?;
    positive("--duration", wanted.signal.duration, f64::MIN_POSITIVE)?;
    Ok(match (wanted.signal.start, run) {
        (Some(start), _) => {
            if start > 0.0 {
                notes.push(format!("begins at {start} s of the signal: times of the results count from there"));
            }
            start
        }
        (None, Some(run)) => {
            let settled = run.scenario.settled_s();
            notes.push(format!(
                "begins at {settled:.4} s, where statistics of the run do: times of the results count from there"
            ));
            settled
        }
        (None, None) => 0.0,
    })
}

/// The file itself, or the signals in the folder of a run.
fn signals_in(path: &Path) -> Result<PathBuf, Failure> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    run_in(path).ok_or_else(|| {
        Failure::Usage(format!(
            "{} is a folder without the signals of a run ({}); name a file, or the folder of a run",
            path.display(),
            names_of_runs()
        ))
    })
}

/// The signals in a folder, where it is a run's.
pub(super) fn run_in(folder: &Path) -> Option<PathBuf> {
    Format::ALL.iter().map(|format| folder.join(format.file_name())).find(|file| file.is_file())
}

/// What the signals of a run may be called.
pub(super) fn names_of_runs() -> String {
    Format::ALL.map(Format::file_name).join(", ")
}

/// What damage the run had that made a signal, and what it lacks.
fn truth(run: &Loaded) -> String {
    let on: BTreeSet<&str> = run.scenario.defects.iter().map(|d| d.on.word()).collect();
    let on: Vec<&str> = on.into_iter().collect();
    match on[..] {
        [] => "the run that made it had no damage".into(),
        _ => format!("the run that made it had damage on: {}", on.join(", ")),
    }
}

/// The scenario that the file carries, or that lies beside it where the file is a run's.
fn scenario(file: &SignalFile, path: &Path) -> Option<Box<Loaded>> {
    let carried = file.metadata().scenario().map(str::to_owned);
    let beside = || {
        // CSV has no place for a word of brinell's, and UFF has one without room.
        let words = file.metadata().pairs.iter();
        let signed = words.into_iter().any(|(_, v)| v.starts_with("brinell "));
        let own = path.file_stem()? == "signals" && (signed || file.channels().first()?.name == "t");
        own.then(|| std::fs::read_to_string(path.with_file_name("scenario.toml")).ok())?
    };
    let text = carried.or_else(beside)?;
    read(&text, &[]).ok().map(Box::new)
}
