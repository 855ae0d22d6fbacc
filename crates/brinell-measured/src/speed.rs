//! The shaft's speed, as far as the file states it.

use crate::called::Called;
use crate::channel::resolve;
use crate::known::{Known, Source};
use crate::problem::Problem;
use crate::request::{GivenSpeed, MOST, Request};
use crate::stretch::{Part, stretch};
use brinell::analysis::FEWEST_REVOLUTIONS;
use brinell::document::{Loaded, reading};
use brinell::operation::Rotation;
use brinell::scenario::Speed;
use brinell::signal::tacho::{are_pulses, course, speed_by_pulses, varies};
use brinell_io::{Channel, SignalFile};
use std::f64::consts::PI;

/// Said of a speed without a unit.
const TAKEN: &str = "taken as r/min";

/// Speeds below, in r/min, are as many Hz of usual machines.
const MAY_BE_HZ: f64 = 100.0;

/// How the shaft turns.
#[derive(Debug, Clone, PartialEq)]
pub struct Turning {
    /// Mean speed, r/min.
    pub rpm: f64,
    /// Whether its unit was stated by nobody.
    pub is_bare: bool,
    /// Whether a channel holds one value throughout: one that was set, and no record of the speed.
    pub is_set: bool,
    /// Time (s, from the stretch's beginning) and speed (r/min), where it [varies].
    pub course: Vec<(f64, f64)>,
    /// That the file states another speed than was given.
    pub other: Option<String>,
}

impl Turning {
    fn steady(rpm: f64) -> Self {
        Self { rpm, is_bare: false, is_set: false, course: Vec::new(), other: None }
    }

    /// Whether it is a number without a unit that is so low that it may be in Hz.
    pub(crate) fn may_be_hz(&self) -> bool {
        self.is_bare && self.rpm.abs() < MAY_BE_HZ
    }

    /// Hz.
    pub fn shaft(&self) -> f64 {
        self.rpm.abs() / 60.0
    }
}

type Stated = (Turning, String);

/// The speed that was given, or that the file states; `stretch_of` is where the signal's stretch begins and how long
/// it is, s, and the signal's rate, Hz.
pub(crate) fn speed(
    file: &mut SignalFile,
    request: &Request,
    run: Option<&Loaded>,
    of: (&str, &Channel),
    stretch_of: (f64, f64, f64),
) -> Result<Option<Known<Turning>>, Problem> {
    let stated = stated(file, request, run, of, stretch_of)?;
    Ok(request.speed.map(|speed| given(request, speed, stated.as_ref())).or_else(|| {
        let (turning, place) = stated?;
        let doubt = turning.may_be_hz().then(|| {
            format!(
                "{place}: a mean of {:.4} r/min is {:.2} Hz; if it is in Hz let the channel say so (`speed [Hz]`, `speed_hz`), or give {}",
                turning.rpm,
                turning.rpm / 60.0,
                request.called.text("speed", &format!("{:.4}Hz", turning.rpm))
            )
        });
        Some(Known::by(turning, Source::File(place)).doubted(doubt))
    }))
}

/// The speed that was given.
pub(crate) fn given(
    request: &Request,
    GivenSpeed { rpm, is_bare }: GivenSpeed,
    stated: Option<&Stated>,
) -> Known<Turning> {
    let asked = request.called.number("speed", rpm);
    let other = stated.and_then(|(stated, place)| other_speed(&asked, rpm, stated.rpm, place, request.tolerance()));
    let turning = Turning { is_bare, other, ..Turning::steady(rpm) };
    let doubt = (turning.may_be_hz()).then(|| {
        format!("{asked}: {rpm} r/min is {:.2} Hz; if it is in Hz write {rpm}Hz{}", rpm / 60.0, thousands(rpm))
    });
    Known::by(turning, Source::Given).doubted(doubt)
}

/// Whether a record of so few revolutions is long enough for a verdict where the speed, r/min, was meant in Hz, or its point divides thousands.
pub(crate) fn is_long_otherwise(rpm: f64, revolutions: f64) -> bool {
    let times = if thousands(rpm).is_empty() { 60.0 } else { 1e3 };
    times * revolutions >= FEWEST_REVOLUTIONS
}

/// What a small number with three decimals may be meant as.
fn thousands(rpm: f64) -> String {
    let whole = (1e3 * rpm).round();
    let three = (whole - 1e3 * rpm).abs() < 1e-9 && whole % 10.0 != 0.0 && (1e3..1e5).contains(&whole);
    if three { format!(", and if the point divides thousands {whole}") } else { String::new() }
}

/// How a speed is written that was meant otherwise than in r/min.
pub(crate) fn written_otherwise(rpm: f64) -> String {
    format!("a speed in Hz is written {rpm:.2}Hz{}", thousands(rpm))
}

/// A warning, where the speed that was given, `asked` for short, differs from the one stated by more than the tolerance
/// (relative); both in r/min.
fn other_speed(asked: &str, rpm: f64, stated: f64, place: &str, tolerance: f64) -> Option<String> {
    let differs = (rpm.abs() / stated.abs() - 1.0).abs() > tolerance;
    differs.then(|| format!("{asked} r/min was taken, but {place} says {stated:.1} r/min"))
}

/// The speed by the file, and where that is stated.
pub(crate) fn stated(
    file: &mut SignalFile,
    request: &Request,
    run: Option<&Loaded>,
    (signal, of): (&str, &Channel),
    (start, seconds, rate): (f64, f64, f64),
) -> Result<Option<Stated>, Problem> {
    let named = match (&request.speed_channel, &request.tacho) {
        (Some(text), _) => Some(("speed-channel", text, None)),
        (None, Some((text, a_turn))) => Some(("tacho", text, Some(*a_turn))),
        (None, None) => None,
    };
    if let Some((key, text, a_turn)) = named {
        let channel = SpeedChannel { called: request.called, key, text, a_turn };
        return channel.speed(file, of, (start, seconds, rate)).map(Some);
    }
    let Some(run) = run else {
        return Ok(file.stated_rpm(signal)?.map(|(rpm, place)| (Turning::steady(rpm), place)));
    };
    let place = "the scenario of the run in the file";
    if let Speed::Constant(rpm) = run.scenario.operation.speed_rpm {
        return Ok(Some((Turning::steady(rpm), place.into())));
    }
    let (mean, course) = prescribed(&run.scenario.operation.speed_rpm, start, seconds);
    if !varies(&course, mean) {
        return Ok(Some((Turning::steady(mean), place.into())));
    }
    followed(mean, course, place, "operation.speed_rpm", request.called).map(Some)
}

/// By pulses that are in no file, with their rate, Hz, and how many come a turn; they last as long as the signal.
pub(crate) fn of_pulses(
    (x, rate, a_turn): &(Vec<f64>, f64, u32),
    seconds: f64,
    called: Called,
) -> Result<Known<Turning>, Problem> {
    let refused = |why: String| Problem::Signal(format!("{}: {why}", called.name("tacho")));
    let covers = x.len() as f64 / rate;
    if (covers / seconds - 1.0).abs() > 0.02 {
        return Err(refused(format!("its {} values last {covers:.3} s and the signal {seconds:.3} s", x.len())));
    }
    let speeds = speed_by_pulses(x, *rate, *a_turn).map_err(|why| refused(why.to_string()))?;
    let speeds: Vec<f64> = speeds.into_iter().map(|hz| 60.0 * hz).collect();
    let rpm = speeds.iter().sum::<f64>() / speeds.len() as f64;
    let turning = Turning { course: course(&speeds, *rate, rpm), ..Turning::steady(rpm) };
    Ok(Known::by(turning, Source::File(format!("the pulses of {}", called.name("tacho")))))
}

/// A channel that was named, of speeds or of pulses.
struct SpeedChannel<'a> {
    called: Called,
    /// Its option.
    key: &'static str,
    text: &'a str,
    /// Pulses a turn.
    a_turn: Option<u32>,
}

impl SpeedChannel<'_> {
    /// The speed during the stretch of the signal `of`.
    fn speed(
        &self,
        file: &mut SignalFile,
        of: &Channel,
        (start, seconds, rate): (f64, f64, f64),
    ) -> Result<Stated, Problem> {
        let (name, channel) = resolve(file, self.text, || self.called.text(self.key, self.text))?;
        let called = self.called.text(self.key, &name);
        let refused = |why: String| Problem::Given(format!("{called}: {why}"));
        let own = own_rate(file, &channel, of, &called)?.unwrap_or(rate);
        let skip = (start * own).round() as usize;
        let most = ((seconds * own).round() as usize).clamp(1, MOST);
        let (values, _) = stretch(file, &name, Part { skip, most, rate: own, called: self.called }, &mut Vec::new())?;
        if values.is_empty() {
            return Err(refused(format!("holds no values {start} s from its beginning")));
        }
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            return Err(refused(format!("holds the value {bad}; expected speeds")));
        }
        let (speeds, said) = match self.a_turn {
            Some(a_turn) => {
                let speeds = speed_by_pulses(&values, own, a_turn).map_err(|why| refused(why.to_string()))?;
                let pulses = if a_turn == 1 { "a pulse".into() } else { format!("{a_turn} pulses") };
                (speeds.into_iter().map(|hz| 60.0 * hz).collect(), format!("{pulses} a turn"))
            }
            None => self.in_rpm(values, &name, &channel, own)?,
        };
        let is_bare = said == TAKEN;
        let mean = speeds.iter().sum::<f64>() / speeds.len() as f64;
        let covers = speeds.len() as f64 / own;
        let source = format!("the channel `{name}`, {said}");
        let course = course(&speeds, own, mean);
        if course.is_empty() {
            let is_set = self.a_turn.is_none() && speeds.len() > 1 && speeds.iter().all(|rpm| *rpm == speeds[0]);
            let place =
                if is_set { format!("{source}, one value throughout") } else { format!("the mean of {source}") };
            return Ok((Turning { is_bare, is_set, ..Turning::steady(mean) }, place));
        }
        if covers < 0.98 * seconds {
            return Err(refused(format!(
                "its {} values last {covers:.3} s at {own} Hz and the signal {seconds:.3} s; a speed that varies has to be known all along",
                speeds.len()
            )));
        }
        let (followed, place) = followed(mean, course, &source, &called, self.called)?;
        Ok((Turning { is_bare, ..followed }, place))
    }

    /// Speeds in r/min, and the words on their unit.
    fn in_rpm(
        &self,
        mut values: Vec<f64>,
        name: &str,
        channel: &Channel,
        rate: f64,
    ) -> Result<(Vec<f64>, String), Problem> {
        let option = self.called.text(self.key, name);
        let tacho = self.called.text("tacho", name);
        let by_name = name.to_lowercase().ends_with("_hz").then_some("Hz");
        let (unit, rpm) = match channel.unit.as_deref().or(by_name) {
            None => (TAKEN.into(), 1.0),
            Some(unit) => match reading::quantity(&format!("1 {unit}"), "r/min") {
                Ok(rpm) => (format!("in {unit}"), rpm),
                Err(_) => {
                    return Err(Problem::Given(format!(
                        "{option}: its unit is {unit}; expected r/min, rpm, 1/min, Hz, 1/s or rad/s, or no unit, which is r/min; \
                         a channel of pulses is given by {tacho}"
                    )));
                }
            },
        };
        if unit == TAKEN && are_pulses(&values, rate) {
            return Err(Problem::Given(format!(
                "{option}: it holds pulses, not speeds in r/min; give {tacho}, with {} where there are N a turn",
                self.called.with("pulses", "N")
            )));
        }
        values.iter_mut().for_each(|v| *v *= rpm);
        Ok((values, unit))
    }
}

/// The rate that the file states of a channel of speeds alone; else it is sampled with the signal `of`, and as long.
fn own_rate(file: &mut SignalFile, speeds: &Channel, of: &Channel, called: &str) -> Result<Option<f64>, Problem> {
    // One that both have is the signal's, where there are not as many speeds.
    if let Some(rate) = &speeds.rate
        && of.rate.as_ref() != Some(rate)
    {
        return Ok(Some(rate.hz));
    }
    let times = file.times_of(speeds).ok().flatten();
    if let Some(times) = times
        && file.times_of(of).ok().flatten().is_none_or(|other| other.name != times.name)
        && let Some(unit) = times.seconds_in_time_unit()
        && let Ok(hz) = file.rate_of(&times.name, unit)?
    {
        return Ok(Some(hz));
    }
    // A single number is the speed all along.
    if speeds.length == Some(1) || of.is_timed_by(speeds) || speeds.is_timed_by(of) {
        return Ok(None);
    }
    let count = |c: &Channel| c.length.unwrap_or_default();
    Err(Problem::Given(format!(
        "{called}: it has {} values and `{}` {}; expected as many, or a sample rate of its own in the file",
        count(speeds),
        of.name,
        count(of)
    )))
}

/// Whether a speed follows from the file, or from a channel that was named.
pub(crate) fn states_speed(file: &SignalFile, request: &Request, run: Option<&Loaded>, signal: &str) -> bool {
    request.speed_channel.is_some() || request.tacho.is_some() || run.is_some() || file.speed_variable(signal).is_some()
}

/// The channel beside the signal that may be a speed, by its unit or name, where there is one.
pub(crate) fn may_be_speed(file: &SignalFile, signal: &str) -> Option<String> {
    let looks = |channel: &&Channel| {
        let is_speed = |unit: &String| {
            !["Hz", "1/s"].contains(&unit.as_str()) && reading::quantity(&format!("1 {unit}"), "r/min").is_ok()
        };
        let name = channel.name.to_lowercase();
        channel.name != signal
            && (channel.unit.as_ref().is_some_and(is_speed)
                || ["rpm", "speed", "drehzahl"].iter().any(|word| name.contains(word)))
    };
    let mut found = file.channels().iter().filter(looks);
    found.next().filter(|_| found.next().is_none()).map(|channel| channel.name.clone())
}

/// A speed that varies, which has to keep its sign: `of` is what states it.
fn followed(rpm: f64, course: Vec<(f64, f64)>, source: &str, of: &str, called: Called) -> Result<Stated, Problem> {
    let (low, high) = (course.iter()).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.1), h.max(p.1)));
    if low <= 0.0 && high >= 0.0 {
        return Err(Problem::Given(format!(
            "{of}: the speed goes from {low:.1} to {high:.1} r/min; expected a shaft that keeps turning one way: choose a stretch with \
             {} and {}",
            called.name("start"),
            called.name("duration")
        )));
    }
    let source = format!("{source}: {low:.1} to {high:.1}, so envelopes are taken at equal angles of the shaft");
    Ok((Turning { course, ..Turning::steady(rpm) }, source))
}

/// Mean speed and its course over a stretch of a run, both exact.
fn prescribed(speed: &Speed, start: f64, seconds: f64) -> (f64, Vec<(f64, f64)>) {
    let rotation = Rotation::new(speed);
    let end = start + seconds;
    let knots = match speed {
        Speed::Constant(_) => &[][..],
        Speed::Profile(points) => points,
    };
    let within = knots.iter().map(|k| k[0]).filter(|t| (start..end).contains(t) && *t > start);
    let course = std::iter::once(start).chain(within).chain([end]);
    let course = course.map(|t| (t - start, rotation.at(t).0 * 30.0 / PI)).collect();
    let turned = rotation.at(end).1 - rotation.at(start).1;
    (turned * 30.0 / PI / seconds, course)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_another_speed_is_reported_and_agreement_is_not() {
        assert_eq!(other_speed("the speed 1800", -1800.0, 1797.0, "it", 0.02), None);
        assert!(other_speed("the speed 1800", 1800.0, 1730.0, "it", 0.02).is_some());
    }
}
