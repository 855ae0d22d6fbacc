//! The page itself, and its pictures.

use std::fmt::Write as _;

use super::AnalysisReport;
use super::curves::plot;
use super::waveform::{close, whole};
use crate::chart::{Domain, Lane, Size};
use crate::data::Spectrum;
use crate::embedded::Plot;
use crate::frame::{THINNED, close as finish, figure, open, plain, plot as plot_of, section};
use crate::kurtogram::kurtogram;
use crate::layout::Layout;
use crate::markup::escape;
use crate::picture::Picture;
use crate::plots::{marker_lanes, spectrum_spec};
use crate::tables::{facts, table};

fn end(spectra: &[Spectrum]) -> f64 {
    (spectra.iter()).map(|s| s.df_hz * s.amplitude.len().saturating_sub(1) as f64).fold(0.0, f64::max)
}

/// The lines of a signal's spectrum, and over them those of a second one's.
fn lines<'a>(
    report: &'a AnalysisReport,
    spectra: &'a [Spectrum],
    (name, id): (&str, &str),
    size: Size,
    y: Domain,
    lanes: Vec<Lane>,
) -> Plot<'a> {
    let first = spectra.first().cloned().unwrap_or_default();
    let spec = spectrum_spec((name, name), &first, size, end(spectra), y, lanes);
    let curves = spectra.iter().map(|s| (0.0, s.df_hz, &s.amplitude[..]));
    Plot { toggles: marker_lanes(&report.markers), ..plot(report, spec, id, curves.collect(), true) }
}

/// Values of all spectra from bin `from` on.
fn amplitudes(spectra: &[Spectrum], from: usize) -> impl Iterator<Item = f64> {
    (spectra.iter()).flat_map(move |s| s.amplitude.iter().skip(from).copied())
}

fn spectrum(report: &AnalysisReport, layout: Layout) -> Plot<'_> {
    let size = layout.size(if layout.roomy() { 320.0 } else { 280.0 });
    let y = Domain::decades(&amplitudes(&report.spectra, 2).collect::<Vec<f64>>());
    let plot = lines(report, &report.spectra, ("spectrum", "spectrum"), size, y, vec![]);
    Plot { velocity: true, band: report.band_hz, ..plot }
}

fn envelope(report: &AnalysisReport, layout: Layout) -> Plot<'_> {
    let size = layout.size(if layout.roomy() { 400.0 } else { 360.0 });
    let y = Domain::from_zero(amplitudes(&report.envelopes, 3));
    let names = ("envelope-spectrum", "envelope");
    let mut plot = lines(report, &report.envelopes, names, size, y, marker_lanes(&report.markers));
    if report.order_tracked {
        plot.spec.x_label = "Order × mean speed".into();
    }
    plot
}

/// The page's pictures, for saving as files.
pub fn analysis_pictures(report: &AnalysisReport, layout: Layout) -> Vec<Picture> {
    let mut pictures = [whole, close, spectrum].map(|draw| draw(report, layout).picture()).to_vec();
    pictures.extend(report.kurtogram.as_ref().map(|k| kurtogram(k, layout)));
    pictures.push(envelope(report, layout).picture());
    layout.finished(pictures)
}

/// The self-contained page.
pub fn analysis_html(report: &AnalysisReport) -> String {
    let mut page = open(&report.title, &report.subtitle, ("Analysed", &report.version), plain(&report.warnings));
    page.push_str("<main>\n");
    section(&mut page, "verdict", "Verdict", |page| verdict(page, report));
    section(&mut page, "waveform", "Waveform", |page| {
        figure(page, "whole", |layout| whole(report, layout).picture(), "");
        plot_of(
            page,
            "close",
            |layout| close(report, layout),
            "A stretch from the middle, about ten periods of the strongest defect frequency long.",
        );
    });
    let note = |spectra: &[Spectrum]| spectra.first().map_or(String::new(), |s| escape(&s.note));
    section(&mut page, "spectrum", "Spectrum", |page| {
        plot_of(page, "spectrum", |layout| spectrum(report, layout), &note(&report.spectra));
    });
    if let Some(map) = &report.kurtogram {
        section(&mut page, "kurtogram", "Kurtogram", |page| {
            let draw = |layout| kurtogram(map, layout);
            figure(page, "kurtogram", draw, &escape(&map.note));
        });
    }
    section(&mut page, "envelope", "Envelope spectrum", |page| {
        plot_of(page, "envelope", |layout| envelope(report, layout), &note(&report.envelopes));
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

fn verdict(page: &mut String, report: &AnalysisReport) {
    let class = report.tone.class();
    let verdict = escape(&report.verdict);
    let _ = writeln!(page, "<p class=\"verdict {class}\">{verdict}</p>");
    facts(page, &report.facts);
}
