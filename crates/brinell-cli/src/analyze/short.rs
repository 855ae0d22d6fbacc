//! A record too short for a verdict: its levels, and how long one takes.

use super::args::AnalyzeArgs;
use super::bearing;
use super::examine::{is_bare, may_be_hz, speed};
use super::measured::Measured;
use crate::failure::Failure;
use brinell::analysis::{AnalysisError, FEWEST_REVOLUTIONS, severity};
use brinell::signal::{Blocks, Estimate, InUnit, Indicator, RECORD_PEAK, Written};
use serde_json::{Value, json};

/// What is known of it.
pub(super) struct Short {
    pub(super) measured: Measured,
    pub(super) seconds: f64,
    pub(super) rms: Option<Estimate>,
    pub(super) peak: f64,
    pub(super) kurtosis: Option<Estimate>,
    /// m/s.
    pub(super) velocity: Option<Estimate>,
    /// Why there is no verdict.
    pub(super) why: String,
    /// Where speed and bearing come from.
    pub(super) speed: String,
    pub(super) bearing: String,
}

/// The record as one that is too short; else as it was.
pub(super) fn too_short(args: &AnalyzeArgs, mut measured: Measured) -> Result<Result<Short, Measured>, Failure> {
    let (rpm, speed) = speed(args, &measured)?;
    let shaft = rpm.abs() / 60.0;
    let (samples, rate) = (measured.x.len(), measured.rate);
    let seconds = samples as f64 / rate;
    let revolutions = seconds * shaft;
    let is_constant = measured.x.iter().all(|v| *v == measured.x[0]);
    // As many r/min would be enough as Hz.
    let is_doubted = is_bare(args, &measured, rpm) && 60.0 * revolutions >= FEWEST_REVOLUTIONS;
    if revolutions >= FEWEST_REVOLUTIONS || is_constant || is_doubted || measured.repeats.is_some() {
        return Ok(Err(measured));
    }
    let (_, bearing) = bearing::orders(args, args.bearing.first().map(String::as_str), &measured, shaft)?;
    let doubt = may_be_hz(args, &measured);
    measured.warnings.extend(doubt);
    let mean = measured.x.iter().sum::<f64>() / samples as f64;
    let x: Vec<f64> = measured.x.iter().map(|v| v - mean).collect();
    let blocks = Blocks::of(&x, rate / shaft);
    let why = AnalysisError::TooShort { seconds, revolutions, needed_s: FEWEST_REVOLUTIONS / shaft };
    Ok(Ok(Short {
        seconds,
        rms: blocks.estimate(Indicator::Rms),
        peak: x.iter().fold(0.0, |m: f64, v| m.max(v.abs())),
        kurtosis: blocks.estimate(Indicator::Kurtosis),
        velocity: severity(&measured.x, &measured.unit, rate, shaft).ok(),
        why: format!("Too short for a verdict: {why}."),
        speed: format!("shaft speed {} r/min, from {speed}", (100.0 * rpm).round() / 100.0),
        bearing,
        measured,
    }))
}

impl Short {
    pub(super) fn to_json(&self) -> Value {
        let m = &self.measured;
        let indicator = |e: Option<Estimate>, unit: &str| {
            let number = e.map_or(Written::new(None, None), Written::from);
            json!(InUnit { number, unit })
        };
        let peak = Estimate { value: self.peak, interval: None };
        json!({
            "verdict": { "text": self.why, "says": "too_short", "damage": [] },
            "signal": {
                "unit": m.unit.name,
                "sample_rate_hz": m.rate,
                "samples": m.x.len(),
                "duration_s": self.seconds,
            },
            "indicators": {
                Indicator::Rms.name(): indicator(self.rms, &m.unit.name),
                RECORD_PEAK: indicator(Some(peak), &m.unit.name),
                Indicator::Kurtosis.name(): indicator(self.kurtosis, ""),
            },
            "severity": { "velocity_rms_10_1000_hz": { "value": self.velocity.map(|v| 1e3 * v.value), "unit": "mm/s" } },
            "file": {
                "path": m.path.display().to_string(),
                "channel": m.channel,
                "start_s": m.start,
                "notes": m.notes,
                "warnings": m.warnings,
                "speed": self.speed,
                "bearing": self.bearing,
            },
        })
    }
}
