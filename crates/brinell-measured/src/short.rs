//! A record too short for a verdict: its levels, and how long one takes.

use crate::bearing::orders;
use crate::examine::turning;
use crate::json::{FileOf, Said};
use crate::measurement::Measurement;
use crate::problem::Problem;
use crate::request::Request;
use crate::speed::is_long_otherwise;
use brinell::analysis::{AnalysisError, FEWEST_REVOLUTIONS, severity};
use brinell::signal::{Blocks, Estimate, InUnit, Indicator, RECORD_PEAK, Written};
use serde_json::{Value, json};

/// What is known of it.
pub struct Short {
    /// The record.
    pub measurement: Measurement,
    /// RMS.
    pub rms: Option<Estimate>,
    /// Largest value less the mean.
    pub peak: f64,
    /// Kurtosis.
    pub kurtosis: Option<Estimate>,
    /// RMS velocity, m/s.
    pub velocity: Option<Estimate>,
    /// Why there is no verdict.
    pub why: String,
    /// The speed and where it comes from, in words.
    pub speed: String,
    /// Where the bearing comes from.
    pub bearing: String,
    /// What deserves attention.
    pub warnings: Vec<String>,
}

/// Whether a record is too short for a verdict, and nothing else is wrong with it that explains that.
///
/// # Errors
/// Where the shaft does not turn.
pub fn is_too_short(measurement: &Measurement, request: &Request) -> Result<bool, Problem> {
    let (turning, _) = turning(measurement, request)?;
    let revolutions = measurement.seconds() * turning.shaft();
    let is_constant = measurement.x.iter().all(|v| *v == measurement.x[0]);
    let is_doubted = turning.may_be_hz() && is_long_otherwise(turning.rpm, revolutions);
    let explained = is_constant || is_doubted || measurement.repeats.is_some() || !measurement.others.is_empty();
    Ok(revolutions < FEWEST_REVOLUTIONS && !explained)
}

impl Short {
    /// Of a record that [is too short](is_too_short).
    ///
    /// # Errors
    /// Where what was given of speed and bearing cannot be.
    pub fn of(measurement: Measurement, request: &Request) -> Result<Self, Problem> {
        let (turning, speed) = turning(&measurement, request)?;
        let (shaft, rate, seconds) = (turning.shaft(), measurement.rate.value, measurement.seconds());
        let bearing = orders(request, request.bearings.first(), measurement.run.as_deref(), shaft)?.notes.join("; ");
        let doubts = measurement.speed.iter().flat_map(|speed| speed.doubts.iter().cloned());
        let warnings = measurement.warnings().into_iter().chain(doubts).collect();
        let mean = measurement.x.iter().sum::<f64>() / measurement.x.len() as f64;
        let x: Vec<f64> = measurement.x.iter().map(|v| v - mean).collect();
        let blocks = Blocks::of(&x, rate / shaft);
        let (revolutions, needed_s) = (seconds * shaft, FEWEST_REVOLUTIONS / shaft);
        let why = AnalysisError::TooShort { seconds, revolutions, needed_s };
        Ok(Self {
            rms: blocks.estimate(Indicator::Rms),
            peak: x.iter().fold(0.0, |m: f64, v| m.max(v.abs())),
            kurtosis: blocks.estimate(Indicator::Kurtosis),
            velocity: severity(&measurement.x, &measurement.unit.value, rate, shaft).ok(),
            why: format!("Too short for a verdict: {why}."),
            speed,
            bearing,
            warnings,
            measurement,
        })
    }
}

impl Short {
    /// As JSON, in the shape of an analysis.
    pub fn to_json(&self) -> Value {
        let m = &self.measurement;
        let notes = m.notes();
        let bearing = self.bearing.clone();
        let said = Said { notes: &notes, warnings: &self.warnings, speed: &self.speed, bearing };
        let unit = &m.unit.value.name;
        let indicator = |e: Option<Estimate>, unit: &str| {
            let number = e.map_or(Written::new(None, None), Written::from);
            InUnit::json(number, unit)
        };
        let peak = Estimate { value: self.peak, interval: None };
        json!({
            "verdict": { "text": self.why, "says": "too_short", "damage": [] },
            "signal": {
                "unit": unit,
                "sample_rate_hz": m.rate.value,
                "samples": m.x.len(),
                "duration_s": m.seconds(),
            },
            "indicators": {
                Indicator::Rms.name(): indicator(self.rms, unit),
                RECORD_PEAK: indicator(Some(peak), unit),
                Indicator::Kurtosis.name(): indicator(self.kurtosis, ""),
            },
            "severity": { "velocity_rms_10_1000_hz": { "value": self.velocity.map(|v| 1e3 * v.value), "unit": "mm/s" } },
            "file": FileOf { said: Some(said), ..FileOf::new(m) },
        })
    }
}
