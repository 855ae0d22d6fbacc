//! The shaft's speed, as far as the file states it.

use super::channel::resolve;
use super::stretch::{MOST, Part, bad, stretch};
use super::wanted::Wanted;
use crate::failure::Failure;
use brinell::document::{Loaded, reading};
use brinell::operation::Rotation;
use brinell::scenario::Speed;
use brinell::signal::tacho::{are_pulses, course, speed_by_pulses, varies};
use brinell_io::{Channel, SignalFile};
use std::f64::consts::PI;

/// Said of a speed without a unit.
const TAKEN: &str = "taken as r/min";

/// A speed that the file states.
pub(crate) struct StatedSpeed {
    /// Its mean, r/min.
    pub(crate) rpm: f64,
    /// Where it is stated.
    pub(crate) source: String,
    /// Whether its unit was stated by nobody.
    pub(crate) is_bare: bool,
    /// Time (s, from the stretch's beginning) and speed (r/min), where it [varies].
    pub(crate) course: Vec<(f64, f64)>,
}

impl StatedSpeed {
    fn steady(rpm: f64, source: String) -> Self {
        StatedSpeed { rpm, source, is_bare: false, course: Vec::new() }
    }
}

/// The speed that the file states, or a channel of speeds; `stretch_of` is where the signal's stretch begins and how
/// long it is, s, and the signal's rate, Hz.
pub(super) fn speed(
    file: &mut SignalFile,
    wanted: &Wanted,
    run: Option<&Loaded>,
    (signal, of): (&str, &Channel),
    (start, seconds, rate): (f64, f64, f64),
) -> Result<Option<StatedSpeed>, Failure> {
    let whose = match (wanted.speed_channel, wanted.tacho) {
        (Some(text), _) => Some(SpeedChannel { option: "--speed-channel", text, a_turn: None }),
        (None, Some((text, a_turn))) => Some(SpeedChannel { option: "--tacho", text, a_turn: Some(a_turn) }),
        (None, None) => None,
    };
    if let Some(whose) = whose {
        return whose.speed(file, of, (start, seconds, rate)).map(Some);
    }
    if let Some(run) = run {
        let source = "the scenario of the run in the file";
        if let Speed::Constant(rpm) = run.scenario.operation.speed_rpm {
            return Ok(Some(StatedSpeed::steady(rpm, source.into())));
        }
        let (mean, course) = prescribed(&run.scenario.operation.speed_rpm, start, seconds);
        if !varies(&course, mean) {
            return Ok(Some(StatedSpeed::steady(mean, source.into())));
        }
        return followed(mean, course, source, "operation.speed_rpm").map(Some);
    }
    let stated = file.stated_rpm(signal).map_err(bad)?;
    Ok(stated.map(|(rpm, source)| StatedSpeed::steady(rpm, source)))
}

/// A channel that was named, of speeds or of pulses.
struct SpeedChannel<'a> {
    option: &'static str,
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
    ) -> Result<StatedSpeed, Failure> {
        let (name, channel) = resolve(file, self.text, self.option)?;
        let called = format!("{} {name}", self.option);
        let refused = |why: String| Failure::Usage(format!("{called}: {why}"));
        let own = own_rate(file, &channel, of, &called)?.unwrap_or(rate);
        let skip = (start * own).round() as usize;
        let most = ((seconds * own).round() as usize).clamp(1, MOST);
        let (values, _) = stretch(file, &name, Part { skip, most, rate: own }, &mut Vec::new())?;
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
            None => in_rpm(values, &name, &channel, own)?,
        };
        let is_bare = said == TAKEN;
        let mean = speeds.iter().sum::<f64>() / speeds.len() as f64;
        let covers = speeds.len() as f64 / own;
        let source = format!("the channel `{name}`, {said}");
        let course = course(&speeds, own, mean);
        if course.is_empty() {
            let source = format!("the mean of {source}");
            return Ok(StatedSpeed { is_bare, ..StatedSpeed::steady(mean, source) });
        }
        if covers < 0.98 * seconds {
            return Err(refused(format!(
                "its {} values last {covers:.3} s at {own} Hz and the signal {seconds:.3} s; a speed that varies has to be known all along",
                speeds.len()
            )));
        }
        let followed = followed(mean, course, &source, &called)?;
        Ok(StatedSpeed { is_bare, ..followed })
    }
}

/// Speeds in r/min, and the words on their unit.
fn in_rpm(mut values: Vec<f64>, name: &str, channel: &Channel, rate: f64) -> Result<(Vec<f64>, String), Failure> {
    let (unit, rpm) = unit_of(name, channel)?;
    if unit == TAKEN && are_pulses(&values, rate) {
        return Err(Failure::Usage(format!(
            "--speed-channel {name}: it holds pulses, not speeds in r/min; give --tacho {name}, with --pulses N where there are N a turn"
        )));
    }
    values.iter_mut().for_each(|v| *v *= rpm);
    Ok((values, unit))
}

/// The rate that the file states of a channel of speeds alone; else it is sampled with the signal `of`, and as long.
fn own_rate(file: &mut SignalFile, speeds: &Channel, of: &Channel, called: &str) -> Result<Option<f64>, Failure> {
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
        && let Ok(hz) = file.rate_of(&times.name, unit).map_err(bad)?
    {
        return Ok(Some(hz));
    }
    // A single number is the speed all along.
    if speeds.length == Some(1) || of.is_timed_by(speeds) || speeds.is_timed_by(of) {
        return Ok(None);
    }
    let count = |c: &Channel| c.length.unwrap_or_default();
    Err(Failure::Usage(format!(
        "{called}: it has {} values and `{}` {}; expected as many, or a sample rate of its own in the file",
        count(speeds),
        of.name,
        count(of)
    )))
}

/// The unit of a channel of speeds in words, and r/min in it.
fn unit_of(name: &str, channel: &Channel) -> Result<(String, f64), Failure> {
    let by_name = name.to_lowercase().ends_with("_hz").then_some("Hz");
    let Some(unit) = channel.unit.as_deref().or(by_name) else {
        return Ok((TAKEN.into(), 1.0));
    };
    match reading::quantity(&format!("1 {unit}"), "r/min") {
        Ok(rpm) => Ok((format!("in {unit}"), rpm)),
        Err(_) => Err(Failure::Usage(format!(
            "--speed-channel {name}: its unit is {unit}; expected r/min, rpm, 1/min, Hz, 1/s or rad/s, or no unit, which is r/min; \
             a channel of pulses is given by --tacho {name}"
        ))),
    }
}

/// Whether a speed follows from the file, or from a channel that was named.
pub(super) fn states_speed(file: &SignalFile, wanted: &Wanted, run: Option<&Loaded>, signal: &str) -> bool {
    wanted.speed_channel.is_some() || wanted.tacho.is_some() || run.is_some() || file.speed_variable(signal).is_some()
}

/// A speed that varies, which has to keep its sign: `of` is what states it.
fn followed(rpm: f64, course: Vec<(f64, f64)>, source: &str, of: &str) -> Result<StatedSpeed, Failure> {
    let (low, high) = (course.iter()).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.1), h.max(p.1)));
    if low <= 0.0 && high >= 0.0 {
        return Err(Failure::Usage(format!(
            "{of}: the speed goes from {low:.1} to {high:.1} r/min; expected a shaft that keeps turning one way: choose a stretch with \
             --start and --duration"
        )));
    }
    let source = format!("{source}: {low:.1} to {high:.1}, so envelopes are taken at equal angles of the shaft");
    Ok(StatedSpeed { rpm, source, is_bare: false, course })
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
