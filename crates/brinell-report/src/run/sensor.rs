//! Of a run's page, the measurement chain.

use crate::number::short;
use crate::{Fact, SensorView};
use brinell::result::Parts;

/// Frequencies of the response, up to half the sample rate; not 0, which a band with a lower end does not pass at all.
const POINTS: usize = 600;

pub(super) fn view(parts: &Parts) -> SensorView {
    let Some(chain) = parts.simulation.sensor() else {
        return SensorView::default();
    };
    let top = 0.5 * parts.simulation.sample_rate();
    let frequency_hz: Vec<f64> = if chain.shapes_the_signal() {
        (1..=POINTS).map(|k| top * k as f64 / POINTS as f64).collect()
    } else {
        Vec::new()
    };
    let gain = |f: &f64| 20.0 * chain.response(*f).norm().max(1e-12).log10();
    SensorView { gain_db: frequency_hz.iter().map(gain).collect(), frequency_hz, facts: facts(parts) }
}

fn facts(parts: &Parts) -> Vec<Fact> {
    let Some(chain) = parts.simulation.sensor() else {
        return Vec::new();
    };
    let mut facts = Vec::new();
    let text = |x: f64| short(x, 3);
    if let Some(rms) = chain.noise_rms() {
        let note = "standard deviation, on every channel its own";
        facts.push(Fact::new("Noise", text(rms), "m/s^2", note));
    }
    if let Some(step) = chain.step() {
        facts.push(Fact::new("ADC", text(step), "m/s^2", "a step"));
    }
    let channels = parts.simulation.filtered();
    for (channel, record) in channels.iter().zip(&parts.outcome.sensor) {
        if let Some(rms) = record.signal_rms() {
            let ratio = record.signal_to_noise_db().map_or(String::new(), |db| format!("; {db:.1} dB over the noise"));
            let note = format!("RMS before noise and ADC, of the analysed time{ratio}");
            facts.push(Fact::new(channel.name.clone(), text(rms), "m/s^2", note));
        }
        if record.clipped > 0 {
            facts.push(Fact::new(
                format!("{}, clipped", channel.name),
                record.clipped.to_string(),
                "samples",
                format!("of {}", parts.outcome.rows),
            ));
        }
    }
    facts
}
