//! Of a run's page, the envelope over orders: where the speed varies, what a defect frequency is to a steady
//! shaft.

use super::signals::{axis, markers_at};
use crate::number::short;
use crate::{Marker, Spectrum};
use brinell::analysis::HARMONICS;
use brinell::observe::Findings;
use brinell::result::Parts;
use brinell::scenario::Speed;
use brinell::signal::{Rotation, Segments, envelope, psd, resample};
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
    let mut envelope = envelope(&values, fs, *band).ok()?;
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
             defect frequencies stay lines while the speed varies. Marks are those of pure rolling: {}.",
            axis(parts),
            span,
            moved_by_slip(model.kinematics(TAU).ftf)
        ),
    };
    Some((spectrum, markers))
}

/// How lines move where the cage turns slower than in pure rolling; `cage` is its turns over the shaft's, f_c/f_s.
///
/// BPFO = Z f_c and BPFI = Z (f_s - f_c): what f_c loses relative to itself, f_s - f_c gains times f_c/(f_s - f_c).
fn moved_by_slip(cage: f64) -> String {
    let up = short(cage / (1.0 - cage), 2);
    format!("a cage that slips by 1 % moves the lines of BPFO and FTF down by 1 %, and those of BPFI up by {up} %")
}

#[cfg(test)]
mod tests {
    use super::*;
    use brinell::scenario::Scenario;

    #[test]
    fn analytic_slip_of_the_cage_moves_bpfi_up() {
        let model = brinell::model::Model::new(&Scenario::example()).unwrap();
        let k = model.kinematics(TAU);
        let z = model.layout.rollers_per_row as f64;
        let slow = 0.99 * k.ftf;
        assert!((z * slow / k.bpfo - 0.99).abs() < 1e-12);
        let up = 100.0 * (z * (1.0 - slow) / k.bpfi - 1.0);
        assert!(moved_by_slip(k.ftf).contains(&format!("BPFI up by {} %", short(up, 2))));
    }
}
