//! Amplitude spectrum and envelope spectrum.

use super::healthy::over_healthy;
use super::markers::{marker_lanes, order_lanes, telling};
use crate::chart::{Domain, Lane, Size, Spec, range};
use crate::data::{Along, Marker, Signals, Spectrum};
use crate::embedded::Plot;
use crate::layout::{Layout, known, spacing};

fn end(spectrum: &Spectrum) -> f64 {
    spacing(spectrum.df_hz) * spectrum.amplitude.len().saturating_sub(1) as f64
}

/// The frequency up to which an envelope's spectrum is shown: all harmonics of the damage in the bearing.
fn top(spectrum: &Spectrum, markers: &[Marker]) -> f64 {
    let top =
        telling(markers).iter().map(|m| m.frequency_hz * (m.harmonics.clamp(1, 20) as f64 + 0.5)).fold(0.0, f64::max);
    if top > 0.0 { top.min(end(spectrum)) } else { end(spectrum) }
}

/// The whole amplitude spectrum over decades.
pub(crate) fn spectrum(run: &Signals, layout: Layout) -> Plot<'_> {
    let size = layout.size(if layout.roomy() { 320.0 } else { 270.0 });
    let (spectrum, healthy) = (&run.spectrum, &run.healthy.spectrum);
    let all: Vec<f64> = spectrum.amplitude.iter().chain(healthy).copied().collect();
    let spec = spectrum_spec(("spectrum", "Spectrum"), spectrum, size, end(spectrum), Domain::decades(&all), vec![]);
    Plot { velocity: true, toggles: marker_lanes(&run.markers), ..lines(spec, "spectrum", spectrum, healthy) }
}

fn envelope_size(layout: Layout) -> Size {
    layout.size(if layout.roomy() { 370.0 } else { 330.0 })
}

/// The envelope spectrum up to the last harmonic of the damage there is, every defect frequency marked.
pub(crate) fn envelope_spectrum(run: &Signals, layout: Layout) -> Plot<'_> {
    envelope_of_size(run, envelope_size(layout))
}

pub(super) fn envelope_of_size(run: &Signals, size: Size) -> Plot<'_> {
    let both = (&run.envelope_spectrum, &run.healthy.envelope_spectrum[..]);
    let names = ("envelope-spectrum", "Envelope spectrum");
    marked(names, "envelope", size, both, &run.markers, marker_lanes(&run.markers))
}

/// The envelope over orders of the shaft, with the bearing's orders marked.
pub(crate) fn order_spectrum(run: &Signals, layout: Layout) -> Plot<'_> {
    let both = (&run.envelope_orders, &run.healthy.envelope_orders[..]);
    let (names, markers) = (("envelope-orders", "Envelope orders"), &run.order_markers);
    let plot = marked(names, "orders", envelope_size(layout), both, markers, order_lanes(markers));
    let spec = Spec { x_label: "Order of the shaft".into(), x_unit: String::new(), ..plot.spec };
    Plot { spec, called: ["Order", ""], ..plot }
}

/// An envelope's spectrum and the healthy bearing's, up to the last harmonic of the damage there is, with lanes.
fn marked<'a>(
    names: (&str, &str),
    id: &str,
    size: Size,
    (spectrum, healthy): (&'a Spectrum, &'a [f64]),
    markers: &[Marker],
    lanes: Vec<Lane>,
) -> Plot<'a> {
    let top = top(spectrum, markers);
    let y = lines_domain(spectrum, healthy, top);
    let spec = spectrum_spec(names, spectrum, size, top, y, lanes.clone());
    Plot { toggles: lanes, ..lines(spec, id, spectrum, healthy) }
}

fn lines_domain(spectrum: &Spectrum, healthy: &[f64], top: f64) -> Domain {
    // The line at 0 Hz is the envelope's mean and says nothing about damage.
    let shown = ((top / spacing(spectrum.df_hz)) as usize).min(spectrum.amplitude.len().saturating_sub(1));
    let shown = |values: &[f64]| values.iter().take(shown + 1).skip(1).copied().collect::<Vec<f64>>();
    Domain::from_zero([shown(&spectrum.amplitude), shown(healthy)].concat())
}

pub(crate) fn spectrum_spec(
    (name, title): (&str, &str),
    spectrum: &Spectrum,
    size: Size,
    top: f64,
    y: Domain,
    lanes: Vec<Lane>,
) -> Spec {
    let label = if spectrum.label.is_empty() { "Amplitude" } else { &spectrum.label };
    let x = Domain::exact(0.0, if top > 0.0 { top } else { 1.0 });
    let title = format!("{title}: {}", spectrum.label);
    Spec { lanes, ..Spec::new(name, title, size, (x, "Frequency", "Hz"), (y, label, &spectrum.unit)) }
}

/// A spectrum's lines on their axes; the page's script knows the plot by its name `id`.
fn lines<'a>(spec: Spec, id: &str, spectrum: &'a Spectrum, healthy: &'a [f64]) -> Plot<'a> {
    let words = match range(spectrum.amplitude.iter().copied()) {
        None => "No spectrum",
        Some(_) if !known(spectrum.df_hz) => "The line spacing is not known",
        Some(_) => "",
    };
    let along = Along::Even { first: 0.0, step: spectrum.df_hz };
    Plot { peak: true, ..over_healthy(spec, id, words, along, &spectrum.amplitude, healthy) }
}
