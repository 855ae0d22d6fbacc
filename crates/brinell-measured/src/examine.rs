//! From a signal to what is found in it.

use crate::asked::Asked;
use crate::bearing::orders;
use crate::beside;
use crate::diagnosis::{Against, Diagnosis, Findings};
use crate::improbable::improbable;
use crate::known::Source;
use crate::measurement::Measurement;
use crate::problem::{Problem, Question};
use crate::request::{Like, MOST, Request};
use crate::size::length;
use crate::speed::{Turning, is_long_otherwise, written_otherwise};
use crate::stretch::{Beyond, Reading, Rest};
use brinell::analysis::{
    Analysis, AnalysisError, Levels, Options, Quantity, Side, analyze, analyze_records, compare, velocity,
};
use brinell::bearing::orders_of;
use brinell::result::{Stretch, beside_healthy};
use brinell::signal::{Rotation, VelocityBands};
use std::path::Path;

/// The shaft's speed, and in words where it comes from.
pub(crate) fn turning<'a>(measurement: &'a Measurement, request: &Request) -> Result<(&'a Turning, String), Problem> {
    let speed = measurement.speed.as_ref();
    let speed = speed.ok_or_else(|| Problem::Given(Question::Speed(None).words(request.called)))?;
    let source = request.source_of_speed(&speed.source);
    request.turning(speed.value.rpm, &source)?;
    // A mean has more digits than anybody reads.
    let rpm = (100.0 * speed.value.rpm).round() / 100.0;
    Ok((&speed.value, format!("shaft speed {rpm} r/min, {source}")))
}

/// Everything that follows from a signal: a diagnosis for each bearing that was asked about, or one.
///
/// # Errors
/// Where the signal is too short for a verdict, or what was given does not go with it.
pub fn examine(mut measurement: Measurement, request: &Request) -> Result<Findings, Problem> {
    let (turning, speed) = turning(&measurement, request)?;
    let shaft = turning.shaft();
    let asked: Vec<Option<&Asked>> = match &request.bearings[..] {
        [] => vec![None],
        all => all.iter().map(Some).collect(),
    };
    // The rest of a long signal is read beside the analysis of its beginning.
    let mut reading = None;
    let mut bearings = Vec::new();
    for bearing in &asked {
        let name = bearing.map_or("", Asked::name);
        let orders = orders(request, *bearing, measurement.run.as_deref(), shaft)?;
        let options = options(&measurement, request, orders.value)?;
        reading = reading
            .or_else(|| measurement.beyond.take().and_then(|beyond| beyond.into_inner().ok()).map(Beyond::start));
        let analysis = look(&measurement, &options)?;
        let all: Vec<&[f64]> = measurement.records().map(|record| &record.x[..]).collect();
        let levels = Levels::of(&all, &measurement.unit.value, &analysis, request.machine_class);
        bearings.push(Diagnosis::new(name, orders, analysis, levels));
    }
    let mut rest = reading.map(Reading::finish).transpose()?;
    for (diagnosis, asked) in bearings.iter_mut().zip(&asked) {
        let own = options(&measurement, request, diagnosis.bearing.value)?;
        if let Some(rest) = &rest {
            diagnosis.last = Some(look_at_last(&measurement, rest, own)?);
        }
        beside_own_run(&mut measurement, request, &mut diagnosis.analysis);
        if request.size {
            let rotation = diagnosis.analysis.options.rotation.clone();
            let signal = (&measurement.x[..], measurement.rate.value);
            let of = (request, *asked, measurement.run.as_deref());
            diagnosis.size = Some(length(signal, &diagnosis.analysis, rotation.as_ref(), of));
        }
        if let Some((path, of_other)) = &request.against {
            diagnosis.against = Some(lay_over(path, of_other, request, &measurement, &mut diagnosis.analysis)?);
        }
    }
    if let Some(rest) = &mut rest {
        rest.last = Vec::new();
    }
    beside::set(&mut bearings);
    for diagnosis in &mut bearings {
        let run = measurement.run.as_deref();
        diagnosis.wrong = run.and_then(|run| Diagnosis::contradicted(&diagnosis.analysis, run));
    }
    Ok(Findings {
        speed,
        rest,
        velocity: velocities(&measurement, shaft),
        notes: measurement.notes(),
        warnings: warnings(&measurement, &bearings),
        bearings,
        measurement,
    })
}

/// Each once: what one of the bearings is warned of is said of all.
fn warnings(measurement: &Measurement, bearings: &[Diagnosis]) -> Vec<String> {
    let mut all = measurement.warnings();
    all.extend(bearings.first().and_then(|first| improbable(measurement, first)));
    for diagnosis in bearings {
        let speed = measurement.speed.as_ref();
        all.extend(speed.into_iter().flat_map(|speed| speed.doubts.clone()));
        // At another speed frequencies in Hz are other orders.
        match speed.and_then(|speed| speed.value.other.clone()) {
            Some(other) => all.push(other),
            None => all.extend(diagnosis.bearing.doubts.iter().cloned()),
        }
        all.extend(diagnosis.analysis.flaws.iter().map(|(k, flaw)| match &measurement.others[..] {
            [] => flaw.to_string(),
            _ => format!(
                "{}{flaw}",
                measurement.records().nth(*k).map_or(String::new(), |r| format!("{}: ", r.path.display()))
            ),
        }));
        if let Some(other) = &diagnosis.against {
            let path = other.measurement.path.display();
            all.extend(other.measurement.warnings().into_iter().map(|w| format!("--against {path}: {w}")));
        }
    }
    let mut seen = std::collections::HashSet::new();
    all.retain(|warning| seen.insert(warning.clone()));
    all
}

fn options(
    measurement: &Measurement,
    request: &Request,
    orders: brinell::analysis::DefectOrders,
) -> Result<Options, Problem> {
    let turning = measurement.speed.as_ref().map(|speed| &speed.value);
    let mut options = Options::new(turning.map_or(0.0, Turning::shaft), orders);
    options.tolerance = request.tolerance();
    options.silent = measurement.silent;
    // Of a machine any bearing may be named: its speed is known all the same.
    let in_machine = measurement.run.as_ref().is_some_and(|run| run.scenario.machine.is_some());
    let is_asked = request.speed.is_some() || request.names_a_bearing() && !in_machine;
    options.exact = request.simulated || (measurement.run.is_some() && !is_asked);
    options.supply = request.supply;
    options.band = request.band;
    options.rotation = rotation(turning)?;
    options.measured_speed =
        measurement.speed.as_ref().is_some_and(|speed| speed.source != Source::Given && !speed.value.is_set);
    Ok(options)
}

/// Of a run, what passing rollers show is no damage of the outer race.
fn beside_own_run(measurement: &mut Measurement, request: &Request, analysis: &mut Analysis) {
    let Some(run) = measurement.run.as_deref().filter(|_| analysis.options.exact && !request.healthy) else {
        return;
    };
    if request.in_haste && !run.scenario.defects.is_empty() {
        return;
    }
    let stretch =
        Stretch { channel: &measurement.channel.value, from_s: measurement.start, to_si: measurement.unit.value.to_si };
    beside_healthy(analysis, &run.scenario, stretch);
    if analysis.passing_known {
        measurement.notes.push("the outer race is judged beside the same run without its damage".into());
    }
}

fn look(measured: &Measurement, options: &Options) -> Result<Analysis, Problem> {
    let others = measured.others.iter().map(|(record, shaft)| (&record.x[..], *shaft));
    let records: Vec<(&[f64], f64)> = std::iter::once((&measured.x[..], options.shaft)).chain(others).collect();
    analyze_records(&records, measured.rate.value, options).map_err(|error| {
        let (error, record, among) = match error {
            AnalysisError::InRecord { number, why } => (*why, measured.records().nth(number - 1), true),
            error => (error, None, false),
        };
        let record = record.unwrap_or(measured);
        let hint = match (&error, &record.repeats) {
            (AnalysisError::TooShort { .. }, Some(why)) => format!("; {why}"),
            (AnalysisError::TooShort { .. }, None) if among => {
                ", however many are averaged: a shorter record does not tell a bearing's lines from the shaft's".into()
            }
            (AnalysisError::RateTooLow { rate_hz, needed_hz, .. }, _)
                if (*needed_hz..1e6).contains(&(1e3 * rate_hz)) =>
            {
                format!("; a rate in kHz is written {rate_hz}kHz")
            }
            (AnalysisError::TooShort { revolutions, .. }, None)
                if measured.is_told_in_rpm() && is_long_otherwise(60.0 * options.shaft, *revolutions) =>
            {
                let rpm = 60.0 * options.shaft;
                format!(", at {rpm:.2} r/min; {}", written_otherwise(rpm))
            }
            _ => String::new(),
        };
        Problem::Signal(format!("{}{error}{hint}", record.name()))
    })
}

/// The shaft's angle over time, where its speed varies.
fn rotation(turning: Option<&Turning>) -> Result<Option<Rotation>, Problem> {
    let Some(Turning { course, .. }) = turning.filter(|turning| !turning.course.is_empty()) else {
        return Ok(None);
    };
    let points: Vec<(f64, f64)> = course.iter().map(|(t, rpm)| (*t, rpm.abs() / 60.0)).collect();
    let rotation = Rotation::from_speeds(&points);
    rotation.map(Some).map_err(|error| Problem::Given(format!("the course of the speed: {error}")))
}

/// The last stretch of a long signal.
fn look_at_last(measured: &Measurement, rest: &Rest, mut options: Options) -> Result<Analysis, Problem> {
    if options.rotation.take().is_some() {
        return Err(Problem::Given(format!(
            "{}: a speed that varies is followed over {MOST} samples at most; choose a stretch with --start and --duration",
            measured.path.display()
        )));
    }
    analyze(&rest.last, measured.rate.value, &options).map_err(|error| {
        let (path, channel) = (measured.path.display(), &measured.channel.value);
        Problem::Signal(format!("{path}, `{channel}`, from {:.3} s on: {error}", rest.last_start))
    })
}

/// Bands of ISO 15242, where the signal is one acceleration.
fn velocities(measured: &Measurement, shaft: f64) -> Option<VelocityBands> {
    if measured.unit.value.quantity != Quantity::Acceleration || !measured.others.is_empty() {
        return None;
    }
    let x = measured.unit.value.in_si(&measured.x);
    velocity(&x, measured.rate.value, shaft).ok()
}

fn lay_over(
    path: &Path,
    of_other: &Request,
    request: &Request,
    measured: &Measurement,
    analysis: &mut Analysis,
) -> Result<Against, Problem> {
    let unit = &measured.unit.value;
    let alike = is_alike(&measured.path, path) && request.sensitivity.is_none();
    let like = Like { channel: measured.channel.value.clone(), rate: measured.rate.value, unit: unit.clone() };
    let wanted = Request { like: Some(like).filter(|_| alike), ..of_other.clone() };
    let mut other = Measurement::open(path, &wanted)?;
    let refused = |why: String| Problem::Given(format!("--against {}: {why}", path.display()));
    if other.unit.value.quantity != unit.quantity {
        return Err(refused(format!(
            "`{}` is in {}, and the signal in {}; only signals of one quantity are laid over each other",
            other.channel.value, other.unit.value.name, unit.name
        )));
    }
    other.note_the_run();
    let factor = other.unit.value.to_si / unit.to_si;
    other.x.iter_mut().for_each(|v| *v *= factor);
    other.unit.value = unit.clone();
    other.silent = other.run.as_ref().and_then(|run| unit.missing_noise(run.scenario.sensor.noise_rms()));
    let mut options = analysis.options.clone();
    let turning = other.speed.as_ref().map(|speed| &speed.value);
    options.shaft = turning.map_or(options.shaft, Turning::shaft);
    options.rotation = rotation(turning)?;
    options.silent = other.silent;
    options.exact = other.run.is_some();
    if let Some(run) = &other.run {
        options.orders = orders_of(&run.scenario.bearing);
    }
    let found = look(&other, &options)?;
    let failed = |error: AnalysisError| refused(error.to_string());
    let other_side = Side { x: &other.x, analysis: &found };
    if request.healthy {
        analysis.beside_healthy(&measured.x, other_side).map_err(failed)?;
    }
    let comparison = compare(Side { x: &measured.x, analysis }, other_side).map_err(failed)?;
    let (low, high) = comparison.band;
    let shown = analysis.view.band;
    if (low, high) != (shown.low, shown.high) {
        other.notes.push(format!(
            "envelopes are compared from {low:.0} to {high:.0} Hz, which both sample rates hold; the first signal's band is \
             {:.0} to {:.0} Hz",
            shown.low, shown.high
        ));
    }
    Ok(Against { measurement: other, analysis: found, comparison })
}

/// Whether two files are of one format whose numbers mean the same in both: a WAV's may be parts of other full scales.
fn is_alike(one: &Path, other: &Path) -> bool {
    let format = |path: &Path| path.extension().map(|e| e.to_ascii_lowercase()).filter(|e| e != "wav");
    format(one).is_some() && format(one) == format(other)
}
