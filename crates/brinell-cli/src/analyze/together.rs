//! Records of one machine for one verdict: what they have to have in common.

use super::args::AnalyzeArgs;
use super::examine::{load as one, speed, stated_speed};
use super::measured::{MOST, Measured};
use crate::failure::Failure;
use crate::say::one_line;
use std::path::PathBuf;

/// How far sample rates may differ, relative: those that a file's times tell are rounded.
const SAME_RATE: f64 = 1e-3;
/// Names of files in a note at most.
const NAMED: usize = 6;

/// The first of the files, with the others.
pub(super) fn load(args: &AnalyzeArgs, paths: &[PathBuf]) -> Result<Measured, Failure> {
    let mut first = one(args, &paths[0])?;
    if paths.len() == 1 {
        return Ok(first);
    }
    let shaft = shaft(args, &first)?;
    let mut samples = first.x.len();
    for path in &paths[1..] {
        let mut other = one(args, path)?;
        let own = self::shaft(args, &other)?;
        alike(args, (&first, shaft), (&other, own))?;
        samples += other.x.len();
        if samples > MOST {
            return Err(refused(
                &other,
                &format!(
                    "with it the records hold {samples} samples, expected {MOST} at most; --duration takes less of each"
                ),
            ));
        }
        let name = other.path.display().to_string();
        other.warnings.extend(stated_speed(args, &other));
        first.warnings.extend(other.warnings.iter().map(|warning| format!("{name}: {warning}")));
        // A time is a sample's number over one rate.
        let hz = own / 60.0 * first.rate / other.rate;
        first.others.push((other, hz));
    }
    let names: Vec<String> = paths[1..].iter().take(NAMED).map(|path| one_line(&path.display().to_string())).collect();
    let more = paths.len() - 1 - names.len();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    first.notes.push(format!(
        "{} records of one machine, their evidence averaged: the others are {}{more}; waveform, amplitude spectrum and kurtogram are of the first",
        paths.len(),
        names.join(", ")
    ));
    Ok(first)
}

/// Its shaft speed, r/min.
fn shaft(args: &AnalyzeArgs, record: &Measured) -> Result<f64, Failure> {
    if record.speed.as_ref().is_some_and(|speed| args.speed.is_none() && !speed.course.is_empty()) {
        return Err(refused(
            record,
            "its speed varies by more than 0.5 %, expected one speed in each; give --start and --duration of a steady stretch",
        ));
    }
    if record.scenario.is_some() {
        return Err(refused(record, "a run of brinell's, expected measured records; a longer run tells as much"));
    }
    if record.beyond.is_some() {
        return Err(refused(record, &format!("it holds more than {MOST} samples; --duration takes less")));
    }
    Ok(speed(args, record)?.0.abs())
}

/// That two records may be averaged; each has its speed, r/min.
fn alike(args: &AnalyzeArgs, first: (&Measured, f64), other: (&Measured, f64)) -> Result<(), Failure> {
    let ((first, shaft), (other, own)) = (first, other);
    let of_first = first.path.display();
    if (other.rate / first.rate - 1.0).abs() > SAME_RATE {
        let (rate, expected) = (other.rate, first.rate);
        return Err(refused(other, &format!("sample rate {rate} Hz, expected {expected} Hz, that of {of_first}")));
    }
    if other.unit.name != first.unit.name {
        let (unit, expected) = (&other.unit.name, &first.unit.name);
        return Err(refused(other, &format!("unit {unit}, expected {expected}, that of {of_first}")));
    }
    if (own / shaft - 1.0).abs() > 0.01 * args.tolerance {
        let most = args.tolerance;
        return Err(refused(
            other,
            &format!(
                "shaft speed {own:.2} r/min, expected {shaft:.2} r/min, that of {of_first}, within {most} % (--tolerance)"
            ),
        ));
    }
    if let Some(twin) = first.records().find(|record| record.x == other.x) {
        return Err(refused(
            other,
            &format!("it holds the same samples as {}, expected another record", twin.path.display()),
        ));
    }
    Ok(())
}

fn refused(record: &Measured, why: &str) -> Failure {
    Failure::Usage(format!("--together: {}, `{}`: {why}", record.path.display(), record.channel))
}
