//! The page of an analysis: its chapters.

use std::sync::Arc;

use super::AnalysisReport;
use super::curves::plot;
use super::waveform::{close, whole};
use crate::chart::{Domain, Lane, Size};
use crate::data::Spectrum;
use crate::embedded::Plot;
use crate::frame::THINNED;
use crate::kurtogram::kurtogram;
use crate::layout::Layout;
use crate::markup::escape;
use crate::page::{Chapter, Figure, Page, Piece};
use crate::plots::{marker_lanes, spectrum_spec};
use crate::tables::Table;

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

pub(super) fn envelope(report: &AnalysisReport, layout: Layout) -> Plot<'_> {
    envelope_of_size(report, layout.size(if layout.roomy() { 400.0 } else { 360.0 }))
}

pub(crate) fn envelope_of_size(report: &AnalysisReport, size: Size) -> Plot<'_> {
    let y = Domain::from_zero(amplitudes(&report.envelopes, 3));
    let names = ("envelope-spectrum", "envelope");
    let mut plot = lines(report, &report.envelopes, names, size, y, marker_lanes(&report.markers));
    if report.order_tracked {
        plot.spec.x_label = "Order × mean speed".into();
    }
    plot
}

impl From<AnalysisReport> for Page {
    fn from(mut report: AnalysisReport) -> Self {
        let tables = std::mem::take(&mut report.tables);
        let has_families = tables.first().is_some_and(|table| !table.rows.is_empty());
        let r = Arc::new(report);
        let verdict = vec![Piece::Verdict(r.tone, r.verdict.clone()), Piece::Headline(r.facts.clone())];
        let whole = Figure::still("whole", "", &r, |r, layout| whole(r, layout).picture());
        let middle = "A stretch from the middle, about ten periods of the strongest defect frequency long; <em>All</em> shows the signal around it, up to 65 536 samples, to zoom in.";
        let waveform = vec![Piece::Figure(whole), Piece::Figure(Figure::plot("close", middle, &r, close))];
        let note = |spectra: &[Spectrum]| spectra.first().map_or(String::new(), |s| escape(&s.note));
        let plot = |id, spectra: &[Spectrum], draw| Piece::Figure(Figure::plot(id, note(spectra), &r, draw));
        let mut chapters = vec![
            Chapter::new("verdict", "Verdict", "Verdict", verdict),
            // What the verdict rests on, before what else the signal shows.
            Chapter::of("envelope", "Envelope spectrum", plot("envelope", &r.envelopes, envelope)),
        ];
        let table = |table: Table| {
            let id = format!("table-{}", table.title.to_lowercase().replace(|c: char| !c.is_ascii_alphanumeric(), "-"));
            let short = table.title.clone();
            Chapter::table(&id, &short, table)
        };
        let mut tables = tables.into_iter().map(table);
        // Of no bearing nothing is in it.
        chapters.extend(tables.next().filter(|_| has_families));
        chapters.push(Chapter::new("waveform", "Waveform", "Waveform", waveform));
        chapters.push(Chapter::of("spectrum", "Spectrum", plot("spectrum", &r.spectra, spectrum)));
        if let Some(map) = r.kurtogram.clone() {
            let caption = escape(&map.note);
            let map = Figure::still("kurtogram", caption, &Arc::new(map), kurtogram);
            chapters.push(Chapter::of("kurtogram", "Kurtogram", Piece::Figure(map)));
        }
        chapters.extend(tables);
        chapters.push(Chapter::of("given", "What was given", Piece::List(r.notes.clone())));
        Self {
            title: r.title.clone(),
            subtitle: r.subtitle.clone(),
            analysed: true,
            version: r.version.clone(),
            warnings: r.warnings.clone(),
            chapters,
            footer: THINNED.into(),
            ..Self::default()
        }
    }
}
