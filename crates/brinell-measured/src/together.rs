//! Records of one machine for one verdict: what they have to have in common.

use crate::examine::turning;
use crate::measurement::Measurement;
use crate::problem::Problem;
use crate::request::{MOST, Request};
use std::path::{Path, PathBuf};

/// How far sample rates may differ, relative: those that a file's times tell are rounded.
const SAME_RATE: f64 = 1e-3;
/// Names of files in a note at most.
const NAMED: usize = 6;

/// The first of the files, with the others.
///
/// # Errors
/// As [`Measurement::open`], and where they have too little in common.
pub fn together(paths: &[PathBuf], request: &Request) -> Result<Measurement, Problem> {
    let mut first = Measurement::open(&paths[0], request)?;
    if paths.len() == 1 {
        return Ok(first);
    }
    let shaft = shaft(request, &first)?;
    let mut samples = first.x.len();
    for path in &paths[1..] {
        let other = Measurement::open(path, request)?;
        let own = self::shaft(request, &other)?;
        alike(request, (&first, shaft), (&other, own))?;
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
        let speed = other.speed.as_ref().and_then(|speed| speed.value.other.clone());
        let warnings = other.warnings().into_iter().chain(speed);
        first.warnings.extend(warnings.map(|warning| format!("{name}: {warning}")));
        // A time is a sample's number over one rate.
        let hz = own / 60.0 * first.rate.value / other.rate.value;
        first.others.push((other, hz));
    }
    let names: Vec<String> = paths[1..].iter().take(NAMED).map(|path| one_line(path)).collect();
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
fn shaft(request: &Request, record: &Measurement) -> Result<f64, Problem> {
    if record.speed.as_ref().is_some_and(|speed| !speed.value.course.is_empty()) {
        return Err(refused(
            record,
            "its speed varies by more than 0.5 %, expected one speed in each; give --start and --duration of a steady stretch",
        ));
    }
    if record.run.is_some() {
        return Err(refused(record, "a run of brinell's, expected measured records; a longer run tells as much"));
    }
    if record.beyond.is_some() {
        return Err(refused(record, &format!("it holds more than {MOST} samples; --duration takes less")));
    }
    Ok(turning(record, request)?.0.rpm.abs())
}

/// That two records may be averaged; each has its speed, r/min.
fn alike(request: &Request, first: (&Measurement, f64), other: (&Measurement, f64)) -> Result<(), Problem> {
    let ((first, shaft), (other, own)) = (first, other);
    let of_first = first.path.display();
    if (other.rate.value / first.rate.value - 1.0).abs() > SAME_RATE {
        let (rate, expected) = (other.rate.value, first.rate.value);
        return Err(refused(other, &format!("sample rate {rate} Hz, expected {expected} Hz, that of {of_first}")));
    }
    if other.unit.value.name != first.unit.value.name {
        let (unit, expected) = (&other.unit.value.name, &first.unit.value.name);
        return Err(refused(other, &format!("unit {unit}, expected {expected}, that of {of_first}")));
    }
    if (own / shaft - 1.0).abs() > request.tolerance() {
        let most = (1e8 * request.tolerance()).round() / 1e6;
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

fn refused(record: &Measurement, why: &str) -> Problem {
    Problem::Given(format!("--together: {}{why}", record.name()))
}

/// A file's name in a note.
fn one_line(path: &Path) -> String {
    path.display().to_string().replace('\n', "\\u{a}").replace('\t', "\\u{9}")
}
