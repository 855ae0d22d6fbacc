//! From a file to what is found in it.

use super::args::AnalyzeArgs;
use super::diagnosis::{Against, Diagnosis};
use super::measured::{self, ASK_SPEED, Beyond, Like, MOST, Measured, Reading, Rest, SignalArgs, Wanted};
use super::{bearing, ends};
use crate::failure::Failure;
use brinell::analysis::{
    Analysis, AnalysisError, DefectOrders, FEWEST_REVOLUTIONS, Levels, Options, Quantity, Side, analyze as analysis_of,
    analyze_records, compare, other_bearing, other_speed, velocity,
};
use brinell::bearing::orders_of;
use brinell::result::{Stretch, beside_healthy};
use brinell::signal::{Band, Rotation, VelocityBands};
use std::path::Path;

/// Speeds below, in r/min, are as many Hz of usual machines.
const MAY_BE_HZ: f64 = 100.0;

/// A result for each bearing that was named, or one. For each but the first it is read `again`.
pub(super) fn results(
    args: &AnalyzeArgs,
    measured: Measured,
    again: impl Fn() -> Result<Measured, Failure>,
) -> Result<Vec<Diagnosis>, Failure> {
    let mut names = args.bearing.iter().map(String::as_str);
    let mut results = vec![examine(args, measured, names.next())?];
    for name in names {
        results.push(examine(args, again()?, Some(name))?);
    }
    ends::set_beside(&mut results);
    // What one of the bearings asked about is warned of is said of all.
    let mut warnings: Vec<String> = Vec::new();
    for warning in results.iter().flat_map(|r| &r.measured.warnings) {
        if !warnings.contains(warning) {
            warnings.push(warning.clone());
        }
    }
    for result in &mut results {
        result.measured.warnings.clone_from(&warnings);
    }
    Ok(results)
}

/// The signal in a file.
pub(super) fn load(args: &AnalyzeArgs, path: &Path) -> Result<Measured, Failure> {
    let mut measured = measured::load(
        path,
        &Wanted {
            speed_channel: args.speed_channel.as_deref(),
            tacho: args.tacho.as_deref().map(|name| (name, args.pulses)),
            ask_speed: args.speed.is_none(),
            ask_bearing: !args.names_a_bearing(),
            ..Wanted::of(&args.signal)
        },
    )?;
    let of_the_run = measured.of_the_run();
    measured.notes.extend(of_the_run);
    Ok(measured)
}

/// Everything that follows from a signal.
fn examine(args: &AnalyzeArgs, mut measured: Measured, name: Option<&str>) -> Result<Diagnosis, Failure> {
    let (rpm, speed) = speed(args, &measured)?;
    let other_speed = stated_speed(args, &measured);
    let shaft = rpm.abs() / 60.0;
    let (orders, bearing) = bearing::orders(args, name, &measured, shaft)?;
    measured.warnings.extend(may_be_hz(args, &measured));
    // At another speed frequencies in Hz are other orders.
    if other_speed.is_none() {
        measured.warnings.extend(bearing_of_run(&orders, name, &measured, args.tolerance));
    }
    measured.warnings.extend(other_speed);
    let mut options = Options::new(shaft, orders);
    options.tolerance = 0.01 * args.tolerance;
    options.silent = measured.silent();
    options.exact = measured.scenario.is_some() && args.speed.is_none() && !args.names_a_bearing();
    options.supply = args.supply;
    options.band = args.band.as_ref().map(|b| Band::between(b[0], b[1]));
    if args.speed.is_none() {
        options.rotation = rotation(&measured)?;
        options.measured_speed = measured.speed.is_some();
    }
    // The rest of a long signal is read beside the analysis of its beginning.
    let reading = measured.beyond.take().map(Beyond::start);
    let mut analysis = look(&measured, &options)?;
    let of_flaws: Vec<String> = (analysis.flaws.iter())
        .filter_map(|(k, flaw)| match &measured.others[..] {
            [] => Some(flaw.to_string()),
            _ => Some(format!("{}: {flaw}", measured.records().nth(*k)?.path.display())),
        })
        .collect();
    measured.warnings.extend(of_flaws);
    let velocity = velocities(&measured, shaft);
    let all: Vec<&[f64]> = measured.records().map(|record| &record.x[..]).collect();
    let levels = Levels::of(&all, &measured.unit, &analysis, args.machine_class);
    let mut rest = reading.map(Reading::finish).transpose()?;
    let last = match rest.as_mut() {
        Some(rest) => Some(look_at_last(&measured.path, &measured.channel, rest, measured.rate, &options)?),
        None => None,
    };
    // Of a run, what passing rollers show is no damage of the outer race.
    if let Some(run) = measured.scenario.as_deref().filter(|_| options.exact && !args.healthy) {
        let stretch = Stretch { channel: &measured.channel, from_s: measured.start, to_si: measured.unit.to_si };
        beside_healthy(&mut analysis, &run.scenario, stretch);
        if analysis.passing_known {
            measured.notes.push("the outer race is judged beside the same run without its damage".into());
        }
    }
    let against = match &args.against {
        Some(path) => Some(lay_over(path, args, &measured, &mut analysis)?),
        None => None,
    };
    if let Some(other) = &against {
        let of_other = other.measured.warnings.iter();
        measured.warnings.extend(of_other.map(|w| format!("--against {}: {w}", other.measured.path.display())));
    }
    Ok(Diagnosis {
        measured,
        rest,
        analysis,
        // A mean has more digits than anybody reads.
        speed: format!("shaft speed {} r/min, from {speed}", (100.0 * rpm).round() / 100.0),
        name: name.unwrap_or_default().to_owned(),
        bearing,
        beside: None,
        lines_of: None,
        last,
        velocity,
        levels,
        against,
    })
}

pub(super) fn speed(args: &AnalyzeArgs, measured: &Measured) -> Result<(f64, String), Failure> {
    let (rpm, source) = match (args.speed, &measured.speed) {
        (Some(given), _) => (given.rpm, "--speed".to_owned()),
        (None, Some(stated)) => (stated.rpm, stated.source.clone()),
        (None, None) => return Err(Failure::Usage(ASK_SPEED.into())),
    };
    turning(rpm, &source)?;
    Ok((rpm, source))
}

/// A warning, where the file states another speed than was given.
pub(super) fn stated_speed(args: &AnalyzeArgs, measured: &Measured) -> Option<String> {
    let (given, stated) = (args.speed?.rpm, measured.speed.as_ref()?);
    other_speed(&format!("--speed {given}"), given, stated.rpm, &stated.source, 0.01 * args.tolerance)
}

/// Whether the speed is a number without a unit that is so low that it may be in Hz.
pub(super) fn is_bare(args: &AnalyzeArgs, measured: &Measured, rpm: f64) -> bool {
    let bare = args.speed.map_or(measured.speed.as_ref().is_some_and(|s| s.is_bare), |given| given.is_bare);
    bare && rpm.abs() < MAY_BE_HZ
}

/// A warning, where a number without a unit is so low that it may be in Hz.
pub(super) fn may_be_hz(args: &AnalyzeArgs, measured: &Measured) -> Option<String> {
    let words = |rpm: f64| format!("{rpm:.4} r/min is {:.2} Hz", rpm / 60.0);
    match (&args.speed, &measured.speed) {
        (Some(given), _) if is_bare(args, measured, given.rpm) => {
            let rpm = given.rpm;
            Some(format!("--speed {rpm}: {rpm} r/min is {:.2} Hz; if it is in Hz write {rpm}Hz", rpm / 60.0))
        }
        (None, Some(stated)) if is_bare(args, measured, stated.rpm) => Some(format!(
            "{}: a mean of {}; if it is in Hz let the channel say so (`speed [Hz]`, `speed_hz`), or give --speed {:.4}Hz",
            stated.source,
            words(stated.rpm),
            stated.rpm
        )),
        _ => None,
    }
}

/// A warning, where the run that made the file is of another bearing than was asked about.
fn bearing_of_run(orders: &DefectOrders, name: Option<&str>, measured: &Measured, tolerance: f64) -> Option<String> {
    let own = orders_of(&measured.scenario.as_deref()?.scenario.bearing);
    let asked = name.map_or("the bearing given".to_owned(), |name| format!("--bearing {name}"));
    other_bearing(&asked, orders, &own, 0.01 * tolerance)
}

pub(super) fn turning(rpm: f64, source: &str) -> Result<(), Failure> {
    if rpm.is_finite() && rpm != 0.0 {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "shaft speed {rpm} r/min, from {source}: expected a speed other than 0; give --speed RPM"
    )))
}

fn look(measured: &Measured, options: &Options) -> Result<Analysis, Failure> {
    let others = measured.others.iter().map(|(record, shaft)| (&record.x[..], *shaft));
    let records: Vec<(&[f64], f64)> = std::iter::once((&measured.x[..], options.shaft)).chain(others).collect();
    analyze_records(&records, measured.rate, options).map_err(|error| {
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
            // As many r/min would be enough as Hz.
            (AnalysisError::TooShort { revolutions, .. }, None)
                if measured.speed.is_none() && 60.0 * revolutions >= FEWEST_REVOLUTIONS =>
            {
                let rpm = 60.0 * options.shaft;
                format!(", at {rpm:.2} r/min; a speed in Hz is written {rpm:.2}Hz")
            }
            _ => String::new(),
        };
        Failure::Usage(format!("{}, `{}`: {error}{hint}", record.path.display(), record.channel))
    })
}

/// The shaft's angle over time, where its speed varies.
fn rotation(measured: &Measured) -> Result<Option<Rotation>, Failure> {
    let course = match &measured.speed {
        Some(stated) if !stated.course.is_empty() => &stated.course,
        _ => return Ok(None),
    };
    let points: Vec<(f64, f64)> = course.iter().map(|(t, rpm)| (*t, rpm.abs() / 60.0)).collect();
    Rotation::from_speeds(&points)
        .map(Some)
        .map_err(|error| Failure::Usage(format!("the course of the speed: {error}")))
}

/// The last stretch of a long signal, which is given up for it.
fn look_at_last(
    path: &Path,
    channel: &str,
    rest: &mut Rest,
    rate: f64,
    options: &Options,
) -> Result<Analysis, Failure> {
    let mut options = options.clone();
    if options.rotation.take().is_some() {
        return Err(Failure::Usage(format!(
            "{}: a speed that varies is followed over {} samples at most; choose a stretch with --start and --duration",
            path.display(),
            MOST
        )));
    }
    let last = std::mem::take(&mut rest.last);
    analysis_of(&last, rate, &options).map_err(|error| {
        Failure::Usage(format!("{}, `{channel}`, from {:.3} s on: {error}", path.display(), rest.last_start))
    })
}

/// Bands of ISO 15242, where the signal is one acceleration.
fn velocities(measured: &Measured, shaft: f64) -> Option<VelocityBands> {
    if measured.unit.quantity != Quantity::Acceleration || !measured.others.is_empty() {
        return None;
    }
    let x = measured.unit.in_si(&measured.x);
    velocity(&x, measured.rate, shaft).ok()
}

fn lay_over(path: &Path, args: &AnalyzeArgs, measured: &Measured, analysis: &mut Analysis) -> Result<Against, Failure> {
    let alike = Like { channel: &measured.channel, rate: measured.rate, unit: &measured.unit };
    let signal = SignalArgs {
        channel: args.against_channel.iter().cloned().collect(),
        rate: args.against_rate,
        unit: args.against_unit.clone(),
        sensitivity: args.against_sensitivity.clone(),
        full_scale: args.against_full_scale.clone(),
        ..SignalArgs::default()
    };
    let wanted = Wanted {
        whose: "against-",
        like: Some(alike).filter(|_| args.signal.sensitivity.is_none() && is_alike(&measured.path, path)),
        ..Wanted::of(&signal)
    };
    let mut other = measured::load(path, &wanted)?;
    if other.unit.quantity != measured.unit.quantity {
        return Err(Failure::Usage(format!(
            "--against {}: `{}` is in {}, and the signal in {}; only signals of one quantity are laid over each other",
            path.display(),
            other.channel,
            other.unit.name,
            measured.unit.name
        )));
    }
    let of_the_run = other.of_the_run();
    other.notes.extend(of_the_run);
    let factor = other.unit.to_si / measured.unit.to_si;
    other.x.iter_mut().for_each(|v| *v *= factor);
    other.unit = measured.unit.clone();
    let mut options = analysis.options.clone();
    if let Some(stated) = &other.speed {
        options.shaft = stated.rpm.abs() / 60.0;
    }
    options.rotation = rotation(&other)?;
    options.silent = other.silent();
    options.exact = other.scenario.is_some();
    if let Some(run) = &other.scenario {
        options.orders = brinell::bearing::orders_of(&run.scenario.bearing);
    }
    let found = look(&other, &options)?;
    let refused = |error| Failure::Usage(format!("--against {}: {error}", path.display()));
    let other_side = Side { x: &other.x, analysis: &found };
    if args.healthy {
        (analysis.beside_healthy(&measured.x, other_side)).map_err(refused)?;
    }
    let comparison = compare(Side { x: &measured.x, analysis }, other_side).map_err(refused)?;
    let (low, high) = comparison.band;
    let shown = analysis.view.band;
    if (low, high) != (shown.low, shown.high) {
        other.notes.push(format!(
            "envelopes are compared from {low:.0} to {high:.0} Hz, which both sample rates hold; the first signal's band is \
             {:.0} to {:.0} Hz",
            shown.low, shown.high
        ));
    }
    Ok(Against { measured: other, analysis: found, comparison })
}

/// Whether two files are of one format whose numbers mean the same in both: a WAV's may be parts of other full scales.
fn is_alike(one: &Path, other: &Path) -> bool {
    let format = |path: &Path| path.extension().map(|e| e.to_ascii_lowercase()).filter(|e| e != "wav");
    format(one).is_some() && format(one) == format(other)
}
