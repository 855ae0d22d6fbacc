//! The signal in a file: which channel, at what rate, in what unit; and what else the file states.

use crate::called::Called;
use crate::channel::channel;
use crate::known::{Known, Source};
use crate::problem::{NoRateStated, Problem, Question};
use crate::rate::rate;
use crate::request::{MOST, Request};
use crate::speed::{Turning, given, may_be_speed, of_pulses, speed, states_speed};
use crate::stretch::{Beyond, Part, scale, stretch};
use crate::unit::{beyond_full_scale, unit};
use brinell::analysis::{AnalysisError, Flaw, Unit, repetition};
use brinell::channel::unit_of_run;
use brinell::document::{Loaded, read};
use brinell::signal::short;
use brinell_io::{Channel, FileKind, Format, SignalFile, open};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// A stretch of one channel, with everything that is known of it.
pub struct Measurement {
    /// The file; empty where there is none.
    pub path: PathBuf,
    /// The channel's name.
    pub channel: Known<String>,
    /// Sample rate, Hz.
    pub rate: Known<f64>,
    /// The samples' unit.
    pub unit: Known<Unit>,
    /// The shaft's speed, given or stated.
    pub speed: Option<Known<Turning>>,
    /// The samples.
    pub x: Vec<f64>,
    /// Where the stretch begins, s.
    pub start: f64,
    /// What is said of the stretch, of the run that made it and of further records: sentences.
    pub notes: Vec<String>,
    /// What deserves attention there.
    pub warnings: Vec<String>,
    /// What is warned of where the file repeats one stretch, to which `x` is cut.
    pub repeats: Option<String>,
    /// What lies beyond the stretch, where the signal is longer than one analysis takes; locked, so that threads may share
    /// findings.
    pub(crate) beyond: Option<Mutex<Beyond>>,
    /// The scenario of the run that made the file.
    pub run: Option<Box<Loaded>>,
    /// What the sensor of a run lacks of a machine's noise, in the signal's unit.
    pub silent: Option<f64>,
    /// Further records of the machine, each with the shaft's speed in it, Hz.
    pub others: Vec<(Measurement, f64)>,
}

impl Measurement {
    /// What was asked for of a file, or of the folder of a run.
    ///
    /// # Errors
    /// [`Problem::Missing`] with all that has to be given, or why the file is not read.
    pub fn open(path: &Path, request: &Request) -> Result<Self, Problem> {
        let path = signals_in(path)?;
        Self::of_file(open(&path)?, request)
    }

    /// The same of a file that was opened, also of one in memory.
    ///
    /// # Errors
    /// As [`Measurement::open`].
    pub fn of_file(mut file: SignalFile, request: &Request) -> Result<Self, Problem> {
        let path = file.path().to_owned();
        let mut run = made_by(&file);
        let what = what(&mut file, request, run.as_deref())?;
        let What { channel: (channel, of), rate, unit, factor } = what;
        // Of a machine the bearing that the channel is nearest to.
        if let Some(run) = &mut run {
            run.scenario = run.scenario.seen_from(&channel.value);
        }
        let (mut notes, mut warnings) = (Vec::new(), Vec::new());
        let (name, hz, called) = (&channel.value, rate.value, request.called);
        let start = start(request, run.as_deref(), &mut notes)?;
        let skip = (start * hz).round() as usize;
        let most = match request.duration {
            Some(d) => ((d * hz).round() as usize).max(1),
            None => request.most.unwrap_or(MOST),
        };
        let part = Part { skip, most, rate: hz, called };
        let (mut x, more) = stretch(&mut file, name, part, &mut warnings)?;
        finite(&mut file, name, &x, part)?;
        warnings.extend(beyond_full_scale(&x, of.stored_as, request));
        scale(&mut x, factor);
        let long = more && request.duration.is_none();
        if x.is_empty() {
            return Err(Problem::Signal(format!(
                "{}: `{name}` holds no samples {}",
                path.display(),
                if skip > 0 { format!("beyond {start} s") } else { "at all".into() }
            )));
        }
        if long {
            warnings.push(format!(
                "a long signal: the verdict is on its first {most} samples ({:.1} s from {start} s on), and one on its last follows it; \
                 {} and {} choose another stretch",
                most as f64 / hz,
                called.name("start"),
                called.name("duration")
            ));
        }
        let repeats = once(&mut x, hz);
        warnings.extend(repeats.clone());
        let seconds = x.len() as f64 / hz;
        let speed = speed(&mut file, request, run.as_deref(), (name, &of), (start, seconds, hz))?;
        let silent = run.as_deref().and_then(|run| unit.value.missing_noise(run.scenario.sensor.noise_rms()));
        let mut measurement = Self {
            beyond: long.then(|| Mutex::new(Beyond { file, name: name.clone(), skip, rate: hz, factor })),
            path,
            channel,
            rate,
            unit,
            speed,
            x,
            start,
            notes,
            warnings,
            repeats,
            run,
            silent,
            others: Vec::new(),
        };
        if request.judged {
            measurement.note_the_run();
        }
        Ok(measurement)
    }

    /// Samples that are in no file, and what the numbers were multiplied by to be in their unit. A run that made them
    /// comes with the channel's name and unit and where they begin, s; pulses for the speed with their rate, Hz, and how
    /// many come a turn.
    ///
    /// # Errors
    /// As [`Measurement::open`].
    pub fn of_samples(
        mut x: Vec<f64>,
        request: &Request,
        run: Option<(Box<Loaded>, [String; 2], f64)>,
        pulses: Option<(Vec<f64>, f64, u32)>,
    ) -> Result<(Self, f64), Problem> {
        let called = request.called;
        let missing = |question: Question| Problem::Given(question.words(called));
        let (mut name, mut start, mut of) = ("signal".to_owned(), 0.0, Channel::default());
        let run = run.map(|(run, [channel, unit], from)| {
            (name, start, of.unit) = (channel, from, Some(unit));
            run
        });
        let hz = request.rate.ok_or_else(|| missing(Question::Rate(NoRateStated::Nothing)))?;
        let rate = Known::by(hz, Source::Given).noted(format!("sample rate {hz} Hz, {}", Source::Given));
        let mut scaled = unit(&name, &of, false, request, run.as_deref())?.map_err(missing)?;
        if run.is_some() && request.unit.is_none() {
            scaled.unit.source = Source::File("the run".into());
            scaled.unit.notes[0] = format!("unit {}, from the run", of.unit.unwrap_or_default());
        }
        scale(&mut x, scaled.factor);
        let seconds = x.len() as f64 / hz;
        let speed = match (request.speed, pulses) {
            (Some(speed), _) => Some(given(request, speed, None)),
            (None, Some(pulses)) => Some(of_pulses(&pulses, seconds, called)?),
            (None, None) => None,
        };
        let measurement = Self {
            path: PathBuf::new(),
            channel: Known::by(name, Source::Given),
            rate,
            unit: scaled.unit,
            speed,
            x,
            start,
            notes: Vec::new(),
            warnings: Vec::new(),
            repeats: None,
            beyond: None,
            run,
            silent: None,
            others: Vec::new(),
        };
        Ok((measurement, scaled.factor))
    }

    /// Itself and the others.
    pub fn records(&self) -> impl Iterator<Item = &Measurement> {
        std::iter::once(self).chain(self.others.iter().map(|(record, _)| record))
    }

    /// Where channel, rate and unit come from, and what else is said: sentences.
    pub fn notes(&self) -> Vec<String> {
        [&self.channel.notes, &self.rate.notes, &self.unit.notes, &self.notes].into_iter().flatten().cloned().collect()
    }

    /// What deserves attention of the signal itself.
    pub fn warnings(&self) -> Vec<String> {
        [&self.rate.doubts, &self.unit.doubts, &self.warnings].into_iter().flatten().cloned().collect()
    }

    /// The shaft's speed and where it comes from, in words; empty where nobody says it.
    pub fn speed_words(&self) -> String {
        // A mean has more digits than anybody reads.
        let rounded = |rpm: f64| (100.0 * rpm).round() / 100.0;
        let words = |speed: &Known<Turning>| format!("{} r/min, {}", rounded(speed.value.rpm), speed.source);
        self.speed.as_ref().map_or_else(String::new, words)
    }

    /// Length of the stretch, s.
    pub fn seconds(&self) -> f64 {
        self.x.len() as f64 / self.rate.value
    }

    /// File and channel, before what is wrong with them.
    pub(crate) fn name(&self) -> String {
        match self.path.as_os_str().is_empty() {
            true => String::new(),
            false => format!("{}, `{}`: ", self.path.display(), self.channel.value),
        }
    }

    /// Whether a number says the speed, and nothing in the file.
    pub(crate) fn is_told_in_rpm(&self) -> bool {
        let given = |speed: &Known<Turning>| speed.source == Source::Given && speed.value.is_bare;
        self.speed.as_ref().is_some_and(given)
    }

    /// Notes what is known of the run that made the signal.
    pub(crate) fn note_the_run(&mut self) {
        let noise = self.silent.filter(|noise| *noise > 0.0);
        self.notes.extend(self.run.as_deref().map(truth));
        self.notes.extend(noise.map(|noise| {
            format!(
                "{} {} of noise added before the verdict, as of a quiet machine: the simulation has less",
                short(noise, 3),
                self.unit.value.name
            )
        }));
    }
}

/// What a file states of a channel, where nothing is given.
pub struct Stated {
    /// Hz, and where; or what is to be given in its place.
    pub rate: Result<(f64, String), String>,
    /// As the file spells it.
    pub unit: Option<String>,
    /// Shaft speed, r/min, and where.
    pub speed: Option<(f64, String)>,
}

/// That of one channel; `run` is [what made the file](made_by).
///
/// # Errors
/// Where the file cannot be read.
pub fn stated(
    file: &mut SignalFile,
    channel: &Channel,
    run: Option<&Loaded>,
    called: Called,
) -> Result<Stated, Problem> {
    let request = Request::new(called);
    let rate = match rate(file, channel, &request, run.is_some()) {
        Ok(Ok(Known { value, source: Source::File(place), .. })) => Ok((value, place)),
        Ok(Ok(Known { value, source, .. })) => Ok((value, source.to_string())),
        Ok(Err(question)) => Err(question.words(called)),
        Err(Problem::Signal(why)) => {
            let path = format!("{}: ", file.path().display());
            Err(why.strip_prefix(&path).unwrap_or(&why).to_owned())
        }
        Err(other) => return Err(other),
    };
    let own = || unit_of_run(&channel.name, &run?.scenario.sensor).map(str::to_owned);
    let whole = run.map_or((0.0, 0.0), |run| {
        let start = run.scenario.settled_s();
        (start, (run.scenario.simulation.duration_s - start).max(0.0))
    });
    let speed = match crate::speed::stated(file, &request, run, (&channel.name, channel), (whole.0, whole.1, 1.0)) {
        // A run that turns back: nobody's mean.
        Err(Problem::Given(_)) => None,
        found => found?,
    };
    let speed = speed.filter(|(turning, _)| turning.rpm != 0.0).map(|(turning, place)| (turning.rpm.abs(), place));
    Ok(Stated { rate, unit: channel.unit.clone().or_else(own), speed })
}

/// That all samples are numbers, where a text file tells the line of one that is not.
fn finite(file: &mut SignalFile, name: &str, x: &[f64], part: Part) -> Result<(), Problem> {
    let Some(first) = x.iter().position(|v| !v.is_finite()) else { return Ok(()) };
    let Some((line, text)) = file.cell(name, (part.skip + first) as u64) else { return Ok(()) };
    let count = x.iter().filter(|v| !v.is_finite()).count();
    let why = AnalysisError::NotFinite { count, samples: x.len(), first: first + 1 };
    let text = if text.is_empty() { "empty".into() } else { format!("`{text}`") };
    let without = part.without(first);
    Err(Problem::Signal(format!("{}, `{name}`: {why}; on line {line} it is {text}; {without}", file.path().display())))
}

/// Cuts a record that repeats one stretch, sampled at `rate` Hz, to that, and warns of it.
fn once(x: &mut Vec<f64>, rate: f64) -> Option<String> {
    let samples = repetition(x)?;
    let whole = x.len() as f64 / rate;
    x.truncate(samples);
    Some(format!("of {whole:.3} s {}", Flaw::Repeats { every: samples as f64 / rate }))
}

/// What has to be known of a channel before it is read.
struct What {
    channel: (Known<String>, Channel),
    rate: Known<f64>,
    unit: Known<Unit>,
    /// The signal's unit over the file's numbers.
    factor: f64,
}

/// Channel, rate and unit; what is missing is asked for at once, speed and bearing with it.
fn what(file: &mut SignalFile, request: &Request, run: Option<&Loaded>) -> Result<What, Problem> {
    let missing =
        |path: &Path, questions| Err(Problem::Missing { path: path.to_owned(), questions, called: request.called });
    let mut questions = Vec::new();
    let channel = match channel(file, request, run)? {
        Ok(found) => found,
        Err(question) => {
            // What any of them states is not asked for yet.
            let states = |c: &&Channel| usize::from(c.rate.is_some()) + usize::from(c.unit.is_some());
            let Question::Channel(channels) = &question else { return missing(file.path(), vec![question]) };
            let most = channels.iter().rev().max_by_key(states).cloned().unwrap_or_default();
            questions.push(question);
            (Known::by(most.name.clone(), Source::Assumed), most)
        }
    };
    let (name, of) = (&channel.0.value, &channel.1);
    let rate = rate(file, of, request, run.is_some())?.map_err(|q| questions.push(q));
    let unit = unit(name, of, file.kind() == FileKind::Wav, request, run)?.map_err(|q| questions.push(q));
    if request.judged && request.speed.is_none() && !states_speed(file, request, run, name) {
        questions.push(Question::Speed(may_be_speed(file, name)));
    }
    if request.judged && !request.names_a_bearing() && run.is_none() {
        questions.push(Question::Bearing);
    }
    match (rate, unit, &questions[..]) {
        (Ok(rate), Ok(scaled), []) => Ok(What { channel, rate, unit: scaled.unit, factor: scaled.factor }),
        _ => missing(file.path(), questions),
    }
}

/// Where the stretch begins, s: where it was wanted, or where a run's statistics begin.
fn start(request: &Request, run: Option<&Loaded>, notes: &mut Vec<String>) -> Result<f64, Problem> {
    let positive = |key: &str, value: Option<f64>, least: f64| match value {
        Some(v) if !(v.is_finite() && v >= least) => Err(Problem::Given(format!(
            "{}: expected {} s",
            request.called.number(key, v),
            if least == 0.0 { "0 or more" } else { "more than 0" }
        ))),
        _ => Ok(()),
    };
    positive("start", request.start, 0.0)?;
    positive("duration", request.duration, f64::MIN_POSITIVE)?;
    Ok(match (request.start, run) {
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
fn signals_in(path: &Path) -> Result<PathBuf, Problem> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    run_in(path).ok_or_else(|| {
        Problem::Signal(format!(
            "{} is a folder without the signals of a run ({}); name a file, or the folder of a run",
            path.display(),
            names_of_runs()
        ))
    })
}

/// The signals in a folder, where it is a run's.
pub fn run_in(folder: &Path) -> Option<PathBuf> {
    Format::ALL.iter().map(|format| folder.join(format.file_name())).find(|file| file.is_file())
}

/// What the signals of a run may be called.
pub fn names_of_runs() -> String {
    Format::ALL.map(Format::file_name).join(", ")
}

/// What damage the run had that made a signal, and what it lacks.
fn truth(run: &Loaded) -> String {
    let bearings = run.scenario.bearings();
    let of = |k: usize| if run.scenario.machine.is_some() { format!(" of bearing {}", k + 1) } else { String::new() };
    let damaged = bearings.iter().enumerate().flat_map(|(k, one)| one.defects.iter().map(move |d| (k, d.on.word())));
    let on: BTreeSet<String> = damaged.map(|(k, on)| format!("{on}{}", of(k))).collect();
    let on: Vec<String> = on.into_iter().collect();
    match on[..] {
        [] => "the run that made it had no damage".into(),
        _ => format!("the run that made it had damage on: {}", on.join(", ")),
    }
}

/// The scenario that the file carries, or that lies beside it where the file is a run's.
pub fn made_by(file: &SignalFile) -> Option<Box<Loaded>> {
    let carried = file.metadata().scenario().map(str::to_owned);
    let beside = || {
        // CSV has no place for a word of brinell's, and UFF has one without room.
        let words = file.metadata().pairs.iter();
        let signed = words.into_iter().any(|(_, v)| v.starts_with("brinell "));
        let own = file.path().file_stem()? == "signals" && (signed || file.channels().first()?.name == "t");
        own.then(|| std::fs::read_to_string(file.path().with_file_name("scenario.toml")).ok())?
    };
    let text = carried.or_else(beside)?;
    read(&text, &[]).ok().map(Box::new)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::request::GivenSpeed;
    use brinell_io::open_bytes;

    #[test]
    fn prop_a_record_that_repeats_is_cut() {
        let mut x = [1.0, 2.0, 3.0].repeat(4);
        let words = once(&mut x, 3.0).unwrap();
        assert!(words.starts_with("of 4.000 s the record repeats the same 1.000 s"), "{words}");
        assert_eq!((x.len(), once(&mut vec![1.0, 2.0, 4.0], 1.0)), (3, None));
    }

    /// What is given goes before what the file states, which is a doubt then; each says whose it is.
    #[test]
    fn prop_every_value_has_its_source_and_its_doubt() {
        let rows: Vec<String> = (0..400).map(|k| format!("{},{}", f64::from(k) / 400.0, k * k % 37)).collect();
        let text = format!("time [s],acc [g]\n{}\n", rows.join("\n")).into_bytes();
        let of = |request: &Request| Measurement::of_file(open_bytes("a.csv", text.clone()).unwrap(), request).unwrap();
        let stated = of(&Request::new(Called::Fields));
        assert_eq!(stated.channel.source, Source::Assumed);
        assert_eq!(stated.rate.source, Source::File("the times in `time [s]`".into()));
        assert_eq!((stated.rate.value, stated.unit.value.name.as_str(), stated.speed), (400.0, "g", None));
        assert!(stated.rate.doubts.is_empty() && stated.unit.doubts.is_empty());
        let speed = Some(GivenSpeed { rpm: 25.0, is_bare: true });
        let given = Request { rate: Some(500.0), unit: Some("mg".into()), speed, ..Request::new(Called::Keywords) };
        let given = of(&given);
        let speed = given.speed.as_ref().unwrap();
        assert_eq!([&given.rate.source, &given.unit.source, &speed.source], [&Source::Given; 3]);
        assert_eq!(given.rate.doubts, ["rate_hz = 500 Hz was taken, but the column `time [s]` says 400 Hz"]);
        assert_eq!(given.unit.doubts, ["unit = \"mg\" was taken, but the file says g"]);
        assert_eq!(speed.doubts, ["speed_rpm = 25: 25 r/min is 0.42 Hz; if it is in Hz write 25Hz"]);
    }

    /// One question, in the words of whoever asks.
    #[test]
    fn prop_what_nobody_states_is_asked_for_at_once() {
        let text = b"acc\n1\n2\n4\n".to_vec();
        let asked = |called| {
            let request = Request { judged: true, ..Request::new(called) };
            match Measurement::of_file(open_bytes("a.csv", text.clone()).unwrap(), &request) {
                Err(Problem::Missing { questions, .. }) => {
                    questions.iter().map(|q| q.words(called)).collect::<Vec<_>>()
                }
                _ => panic!(),
            }
        };
        let gives = [
            (Called::Options(""), ["--rate HZ", "--unit", "--speed RPM", "--bearing NAME"]),
            (Called::Fields, ["the sample rate in Hz", "unit", "the speed in r/min", "which bearing?"]),
            (Called::Keywords, ["rate_hz", "unit", "speed_rpm", "bearing"]),
        ];
        for (called, gives) in gives {
            let asked = asked(called);
            assert_eq!(asked.len(), gives.len(), "{asked:?}");
            assert!(asked.iter().zip(gives).all(|(words, give)| words.contains(give)), "{asked:?}");
        }
    }
}
