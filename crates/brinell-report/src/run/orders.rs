//! Of the report's data, the envelope over orders: where the speed varies, what a defect frequency is to a steady
//! shaft.

use super::signals::{HARMONICS, axis, markers_at};
use crate::{Marker, Spectrum};
use brinell::observe::Findings;
use brinell::scenario::Speed;
use brinell::signal::{Rotation, Segments, envelope, psd, resample};
use brinell::summary::Parts;
use std::f64::consts::TAU;

/// Instants a second at which the shaft's angle is given to the resampling.
const ANGLES_PER_S: f64 = 1000.0;

/// The envelope of what findings of the run keep of the signal at equal angles of the shaft, and the bearing's orders;
/// both empty where the speed is constant.
pub(super) fn orders(parts: &Parts, findings: &Findings) -> (Spectrum, Vec<Marker>) {
    spectrum(parts, findings).unwrap_or_default()
}

fn spectrum(parts: &Parts, findings: &Findings) -> Option<(Spectrum, Vec<Marker>)> {
    let scenario = &parts.loaded.scenario;
    if let Speed::Constant(_) = scenario.operation.speed_rpm {
        return None;
    }
    let model = parts.simulation.model();
    let (_, band) = findings.envelope.as_ref()?;
    let fs = parts.simulation.sample_rate();
    let (first, values) = findings.waveform.latest();
    let from = first as f64 / fs;
    let span = values.len() as f64 / fs;
    let turns = |t: f64| model.rotation.at(from + t).1.abs() / TAU;
    let count = (span * ANGLES_PER_S).ceil() as usize + 1;
    let angles: Vec<(f64, f64)> = (0..=count).map(|k| k as f64 / ANGLES_PER_S).map(|t| (t, turns(t))).collect();
    let rotation = Rotation::from_angles(&angles).ok()?;
    // At one turn a second, frequencies are orders.
    let markers = markers_at(scenario, model, TAU);
    let highest = (markers.iter()).fold(1.0, |m: f64, one| m.max(one.frequency_hz));
    let per_turn = (2.2 * (HARMONICS as f64 + 0.5) * highest).ceil() as usize;
    let mut envelope = envelope(&values, fs, *band)?;
    let mean = envelope.iter().sum::<f64>() / envelope.len().max(1) as f64;
    envelope.iter_mut().for_each(|e| *e -= mean);
    let angular = resample(&envelope, fs, &rotation, per_turn.max(4)).ok()?;
    let segments = Segments::of(angular.values.len());
    let lines = psd(&angular.values, angular.samples_per_revolution, &segments).ok()?;
    let spectrum = Spectrum {
        label: "Envelope amplitude".into(),
        df_hz: lines.frequency_step,
        amplitude: lines.amplitude.clone(),
        unit: "m/s^2".into(),
        note: format!(
            "Envelope of the sensor acceleration along {} at equal angles of the shaft, the last {:.2} s of the run. An order is an event a turn: \
             defect frequencies stay lines while the speed varies. Marks are those of pure rolling: a cage that slips moves the lines down by as much.",
            axis(parts),
            span
        ),
    };
    Some((spectrum, markers))
}
