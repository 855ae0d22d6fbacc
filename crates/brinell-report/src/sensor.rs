//! What is between the machine and the record: the measurement chain's response and what it did.

use crate::chart::{Chart, Domain, Spec, range};
use crate::fact::Fact;
use crate::layout::Layout;
use crate::picture::{Paint, Picture, ink};

/// The chain; empty where the record is the machine's own vibration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SensorView {
    /// Frequencies of the response, Hz, evenly spaced.
    pub frequency_hz: Vec<f64>,
    /// Gain at each, dB; empty where the chain passes everything alike.
    pub gain_db: Vec<f64>,
    /// Noise, ADC, clipped samples.
    pub facts: Vec<Fact>,
}

impl SensorView {
    /// Whether there is a chain.
    pub fn is_there(&self) -> bool {
        !self.gain_db.is_empty() || !self.facts.is_empty()
    }
}

/// Gain below the largest by more than this is cut off.
const DEEPEST_DB: f64 = 80.0;

/// Gain over frequency.
pub(crate) fn sensor_response(view: &SensorView, layout: Layout) -> Picture {
    let khz: Vec<f64> = view.frequency_hz.iter().map(|f| 1e-3 * f).collect();
    let highest = range(view.gain_db.iter().copied()).map_or(0.0, |r| r.1);
    let gain: Vec<f64> = view.gain_db.iter().map(|g| g.max(highest - DEEPEST_DB)).collect();
    let (lo, hi) = range(khz.iter().copied()).unwrap_or((0.0, 1.0));
    let mut chart = Chart::new(Spec::new(
        "sensor-response",
        "Response of the measurement chain",
        layout.size(230.0),
        (Domain::exact(lo, hi), "Frequency", "kHz"),
        (Domain::around(gain.iter().copied().chain([-1.0, 1.0])), "Gain", "dB"),
    ));
    chart.points(&[lo, hi], &[0.0, 0.0], Paint::line(ink::FAINT, 1.0).dashed(&[4.0, 4.0]));
    chart.points(&khz, &gain, Paint::line(ink::BLUE, 1.6));
    chart.finish()
}
