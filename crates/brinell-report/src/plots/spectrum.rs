//! Amplitude spectrum and envelope spectrum.

use super::markers::{marker_lanes, order_lanes, telling};
use crate::chart::{Chart, Domain, Lane, Size, Spec, range};
use crate::data::{Marker, Report, Spectrum};
use crate::layout::{Layout, healthy_words, known, over_healthy, spacing};
use crate::picture::Picture;

/// The frequency up to which the envelope spectrum is shown: all harmonics of the damage in the bearing.
fn envelope_top(report: &Report) -> f64 {
    top(&report.envelope_spectrum, &report.markers)
}

fn top(spectrum: &Spectrum, markers: &[Marker]) -> f64 {
    let end = spacing(spectrum.df_hz) * spectrum.amplitude.len().saturating_sub(1) as f64;
    let top =
        telling(markers).iter().map(|m| m.frequency_hz * (m.harmonics.clamp(1, 20) as f64 + 0.5)).fold(0.0, f64::max);
    if top > 0.0 { top.min(end) } else { end }
}

/// The whole amplitude spectrum over decades.
pub(crate) fn spectrum(report: &Report, layout: Layout) -> Picture {
    let size = layout.size(if layout.roomy() { 320.0 } else { 270.0 });
    let spectrum = &report.spectrum;
    let end = spacing(spectrum.df_hz) * spectrum.amplitude.len().saturating_sub(1) as f64;
    let y = spectrum_domain(report);
    let spec = spectrum_spec(("spectrum", "Spectrum"), spectrum, size, end, y, vec![]);
    drawn(spec, spectrum, &report.healthy.spectrum, "spectrum")
}

pub(crate) fn spectrum_domain(report: &Report) -> Domain {
    let healthy = report.healthy.spectrum.iter().copied();
    let all: Vec<f64> = (report.spectrum.amplitude.iter().copied()).chain(healthy).collect();
    Domain::decades(&all)
}

/// The envelope spectrum up to the last harmonic of the damage there is, every defect frequency marked.
pub(crate) fn envelope_spectrum(report: &Report, layout: Layout) -> Picture {
    let height = if layout.roomy() { 370.0 } else { 330.0 };
    draw_envelope(report, envelope_spec(report, layout.size(height)))
}

pub(crate) fn envelope_domain(report: &Report) -> Domain {
    let healthy = &report.healthy.envelope_spectrum;
    lines_domain(&report.envelope_spectrum, healthy, envelope_top(report))
}

pub(crate) fn order_domain(report: &Report) -> Domain {
    let spectrum = &report.envelope_orders;
    let healthy = &report.healthy.envelope_orders;
    lines_domain(spectrum, healthy, top(spectrum, &report.order_markers))
}

/// The envelope over orders of the shaft, with the bearing's orders marked.
pub(crate) fn order_spectrum(report: &Report, layout: Layout) -> Picture {
    let spectrum = &report.envelope_orders;
    let size = layout.size(if layout.roomy() { 370.0 } else { 330.0 });
    let spec = Spec {
        x_label: "Order of the shaft".into(),
        x_unit: String::new(),
        ..spectrum_spec(
            ("envelope-orders", "Envelope orders"),
            spectrum,
            size,
            top(spectrum, &report.order_markers),
            order_domain(report),
            order_lanes(&report.order_markers),
        )
    };
    drawn(spec, spectrum, &report.healthy.envelope_orders, "orders")
}

fn lines_domain(spectrum: &Spectrum, healthy: &[f64], top: f64) -> Domain {
    // The line at 0 Hz is the envelope's mean and says nothing about damage.
    let shown = ((top / spacing(spectrum.df_hz)) as usize).min(spectrum.amplitude.len().saturating_sub(1));
    let shown = |values: &[f64]| values.iter().take(shown + 1).skip(1).copied().collect::<Vec<f64>>();
    Domain::from_zero([shown(&spectrum.amplitude), shown(healthy)].concat())
}

pub(super) fn envelope_spec(report: &Report, size: Size) -> Spec {
    let spectrum = &report.envelope_spectrum;
    let (top, y) = (envelope_top(report), envelope_domain(report));
    let names = ("envelope-spectrum", "Envelope spectrum");
    let spec = spectrum_spec(names, spectrum, size, top, y, marker_lanes(&report.markers));
    Spec { remark: healthy_words(&report.healthy.envelope_spectrum), ..spec }
}

pub(super) fn draw_envelope(report: &Report, spec: Spec) -> Picture {
    drawn(spec, &report.envelope_spectrum, &report.healthy.envelope_spectrum, "envelope")
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

/// A spectrum's lines on their axes; the page's script knows the plot by its name.
fn drawn(spec: Spec, spectrum: &Spectrum, healthy: &[f64], name: &str) -> Picture {
    let mut chart = Chart::new(Spec { remark: healthy_words(healthy), ..spec });
    if range(spectrum.amplitude.iter().copied()).is_none() {
        chart.say("No spectrum");
    } else if !known(spectrum.df_hz) {
        chart.say("The line spacing is not known");
    } else {
        over_healthy(&mut chart, (0.0, spacing(spectrum.df_hz)), &spectrum.amplitude, healthy, true);
    }
    chart.interactive(name);
    chart.finish()
}
