//! Of a run's page, the same bearing without its damage.

use super::orders;
use crate::Healthy;
use crate::number::short;
use brinell::observe::Findings;
use brinell::result::Parts;
use brinell::signal::Spectrum;

/// Curves at the places of the damaged bearing's own, whose envelope over orders is `orders`; what lies elsewhere is
/// left out.
pub(super) fn healthy(parts: &Parts, orders: &crate::Spectrum) -> Healthy {
    let Some(healthy) = parts.healthy else {
        return Healthy::default();
    };
    let (of, at) = (parts.findings.waveform.latest(), healthy.waveform.latest());
    let turned = orders::orders(parts, healthy).0;
    let alike = orders.df_hz == turned.df_hz && orders.amplitude.len() == turned.amplitude.len();
    Healthy {
        waveform: match (of.0, of.1.len()) == (at.0, at.1.len()) {
            true => at.1,
            false => Vec::new(),
        },
        spectrum: lines(parts.findings.spectrum.as_ref(), healthy.spectrum.as_ref()),
        envelope_spectrum: lines(envelope(parts.findings), envelope(healthy)),
        envelope_orders: if alike { turned.amplitude } else { Vec::new() },
    }
}

fn envelope(findings: &Findings) -> Option<&Spectrum> {
    Some(&findings.envelope.as_ref()?.0.spectrum)
}

fn lines(of: Option<&Spectrum>, healthy: Option<&Spectrum>) -> Vec<f64> {
    match (of, healthy) {
        (Some(of), Some(healthy))
            if of.frequency_step == healthy.frequency_step && of.amplitude.len() == healthy.amplitude.len() =>
        {
            healthy.amplitude.clone()
        }
        _ => Vec::new(),
    }
}

/// "4.1 times the healthy bearing's", and its interval; `None` where there is no healthy bearing or no level.
pub(super) fn times(parts: &Parts) -> Option<(String, String)> {
    let ratio = parts.findings.over_healthy(parts.healthy?)?;
    let interval = ratio
        .interval
        .map_or(String::new(), |(low, high)| format!("95 %, scatter only: {} to {}", short(low, 2), short(high, 2)));
    let what = if parts.loaded.scenario.machine.is_some() { "machine" } else { "bearing" };
    let words = format!("{} times the healthy {what}’s", short(ratio.value, 2));
    Some((words, interval))
}

/// Why that is more than a machine shows.
pub(super) fn smooth(parts: &Parts) -> &'static str {
    let b = &parts.loaded.scenario.bearing;
    match b.waviness.is_none() && b.element_waviness.is_none() {
        true => " (without roughness, so more than a machine shows)",
        false => "",
    }
}
