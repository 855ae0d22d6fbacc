//! The page itself, and its pictures.

use std::fmt::Write as _;

use super::AnalysisReport;
use super::curves::{draw, embed};
use super::waveform::{about_middle, close, close_up_domain, close_up_unit, whole};
use crate::chart::{Domain, Spec};
use crate::data::Spectrum;
use crate::embedded;
use crate::frame::{THINNED, close as finish, figure, open, plain, section};
use crate::kurtogram::kurtogram;
use crate::layout::Layout;
use crate::markup::escape;
use crate::picture::Picture;
use crate::plots::{marker_lanes, spectrum_spec};
use crate::tables::{facts, table};

fn end(spectra: &[Spectrum]) -> f64 {
    (spectra.iter()).map(|s| s.df_hz * s.amplitude.len().saturating_sub(1) as f64).fold(0.0, f64::max)
}

fn curves(spectra: &[Spectrum]) -> Vec<(f64, f64, &[f64])> {
    (spectra.iter()).map(|s| (0.0, s.df_hz, &s.amplitude[..])).collect()
}

/// Values of all spectra from bin `from` on.
fn amplitudes(spectra: &[Spectrum], from: usize) -> impl Iterator<Item = f64> {
    (spectra.iter()).flat_map(move |s| s.amplitude.iter().skip(from).copied())
}

fn spectrum_domain(report: &AnalysisReport) -> Domain {
    Domain::decades(&amplitudes(&report.spectra, 2).collect::<Vec<f64>>())
}

fn spectrum(report: &AnalysisReport, layout: Layout) -> Picture {
    let first = report.spectra.first().cloned().unwrap_or_default();
    let height = if layout.roomy() { 320.0 } else { 280.0 };
    let (y, top) = (spectrum_domain(report), end(&report.spectra));
    let spec = spectrum_spec(("spectrum", "spectrum"), &first, layout.size(height), top, y, vec![]);
    let curves = curves(&report.spectra);
    draw(report, spec, "spectrum", &curves, true, report.band_hz)
}

fn envelope_domain(report: &AnalysisReport) -> Domain {
    Domain::from_zero(amplitudes(&report.envelopes, 3))
}

fn envelope(report: &AnalysisReport, layout: Layout) -> Picture {
    let first = report.envelopes.first().cloned().unwrap_or_default();
    let height = if layout.roomy() { 400.0 } else { 360.0 };
    let lanes = marker_lanes(&report.markers);
    let (y, top) = (envelope_domain(report), end(&report.envelopes));
    let names = ("envelope-spectrum", "envelope-spectrum");
    let spec = spectrum_spec(names, &first, layout.size(height), top, y, lanes);
    let spec = Spec { x_label: envelope_axis(report).into(), ..spec };
    draw(report, spec, "envelope", &curves(&report.envelopes), true, None)
}

/// What the envelope spectrum is over.
fn envelope_axis(report: &AnalysisReport) -> &'static str {
    if report.order_tracked { "Order × mean speed" } else { "Frequency" }
}

/// The page's pictures, for saving as files.
pub fn analysis_pictures(report: &AnalysisReport, layout: Layout) -> Vec<Picture> {
    let mut pictures = vec![whole(report, layout), close(report, layout), spectrum(report, layout)];
    pictures.extend(report.kurtogram.as_ref().map(|k| kurtogram(k, layout)));
    pictures.push(envelope(report, layout));
    layout.finished(pictures)
}

/// The self-contained page.
pub fn analysis_html(report: &AnalysisReport) -> String {
    let mut page = open(&report.title, &report.subtitle, ("Analysed", &report.version), plain(&report.warnings));
    page.push_str("<main>\n");
    section(&mut page, "verdict", "Verdict", |page| verdict(page, report));
    section(&mut page, "waveform", "Waveform", |page| {
        figure(page, "whole", |layout| whole(report, layout), "");
        figure(
            page,
            "close",
            |layout| close(report, layout),
            "A stretch from the middle, about ten periods of the strongest defect frequency long.",
        );
        let unit = report.waveforms.first().map_or("", |s| &s.unit);
        let chart = embedded::Chart {
            name: "close-up",
            domain: close_up_domain(report),
            x: ("Time", close_up_unit(report).0),
            y: ("Signal", unit),
            ..embedded::Chart::default()
        };
        embed(page, &report.names, &about_middle(report), chart);
    });
    let lanes = marker_lanes(&report.markers);
    let note = |spectra: &[Spectrum]| spectra.first().map_or(String::new(), |s| escape(&s.note));
    section(&mut page, "spectrum", "Spectrum", |page| {
        let draw = |layout| spectrum(report, layout);
        figure(page, "spectrum", draw, &note(&report.spectra));
        let chart = embedded::Chart {
            name: "spectrum",
            domain: spectrum_domain(report),
            peak: true,
            x: ("Frequency", "Hz"),
            y: axis_of(&report.spectra),
            velocity: true,
            toggles: &lanes,
            band: report.band_hz,
            ..embedded::Chart::default()
        };
        embed(page, &report.names, &curves(&report.spectra), chart);
    });
    if let Some(map) = &report.kurtogram {
        section(&mut page, "kurtogram", "Kurtogram", |page| {
            let draw = |layout| kurtogram(map, layout);
            figure(page, "kurtogram", draw, &escape(&map.note));
        });
    }
    section(&mut page, "envelope", "Envelope spectrum", |page| {
        let draw = |layout| envelope(report, layout);
        figure(page, "envelope", draw, &note(&report.envelopes));
        let chart = embedded::Chart {
            name: "envelope",
            domain: envelope_domain(report),
            peak: true,
            x: (envelope_axis(report), "Hz"),
            y: axis_of(&report.envelopes),
            lanes: &lanes,
            toggles: &lanes,
            ..embedded::Chart::default()
        };
        embed(page, &report.names, &curves(&report.envelopes), chart);
    });
    for one in &report.tables {
        table(&mut page, one);
    }
    section(&mut page, "given", "What was given", |page| {
        page.push_str("<ul>\n");
        for note in &report.notes {
            let _ = writeln!(page, "<li>{}</li>", escape(note));
        }
        page.push_str("</ul>\n");
    });
    finish(page, THINNED, &[])
}

/// Label and unit of the spectra's y axis.
fn axis_of(spectra: &[Spectrum]) -> (&str, &str) {
    spectra.first().map_or(("", ""), |s| (&s.label, &s.unit))
}

fn verdict(page: &mut String, report: &AnalysisReport) {
    let class = report.tone.class();
    let verdict = escape(&report.verdict);
    let _ = writeln!(page, "<p class=\"verdict {class}\">{verdict}</p>");
    facts(page, &report.facts);
}
