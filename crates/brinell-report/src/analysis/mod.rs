//! The page of an analysed signal: verdict, waveform, spectrum, envelope spectrum; and a second signal over it.

mod content;
mod level;
mod waveform;
mod words;

use std::fmt::Write as _;

use crate::chart::{Chart, Domain, Spec, range};
use crate::data::{Along, Marker, Series, Spectrum, Tone};
use crate::embedded::{self, Curve};
use crate::fact::Fact;
use crate::frame::{THINNED, close as finish, figure, open, plain, section};
use crate::kurtogram::{Kurtogram, kurtogram};
use crate::layout::{Layout, legend};
use crate::markup::escape;
use crate::picture::{Paint, Picture, ink};
use crate::plots::{marker_lanes, spectrum_spec};
use crate::tables::{Table, facts, table};
pub use content::{Analyzed, Findings};
pub use level::{ZONES, level_lines, scaled};
use waveform::{about_middle, close, close_up_domain, close_up_unit, whole};
pub use words::{called, ratio, shaft_lines};

/// Everything the page of an analysis shows. Curves come in the order of `names`, one or two of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnalysisReport {
    /// The verdict in a few words.
    pub title: String,
    /// File and channel, length, speed.
    pub subtitle: String,
    /// The version of the program.
    pub version: String,
    /// The verdict in a paragraph.
    pub verdict: String,
    /// What colour it has.
    pub tone: Tone,
    /// What deserves attention.
    pub warnings: Vec<String>,
    /// Where rate, unit, speed and bearing come from.
    pub notes: Vec<String>,
    /// Headline numbers.
    pub facts: Vec<Fact>,
    /// What the curves are: "measured", "simulated".
    pub names: Vec<String>,
    /// Waveforms, thinned or not.
    pub waveforms: Vec<Series>,
    /// Seconds shown close up, from the middle of the signal.
    pub close_up_s: f64,
    /// Amplitude spectra.
    pub spectra: Vec<Spectrum>,
    /// Envelope spectra.
    pub envelopes: Vec<Spectrum>,
    /// Defect frequencies; `present` for those that are detected.
    pub markers: Vec<Marker>,
    /// The band demodulated, Hz: shaded in the spectrum.
    pub band_hz: Option<(f64, f64)>,
    /// Which bands are how impulsive.
    pub kurtogram: Option<Kurtogram>,
    /// Findings, indicators, differences.
    pub tables: Vec<Table>,
}

/// Of the signal and of what it is laid over: grey, as colours are those of the marks.
fn paints() -> [Paint; 2] {
    [Paint::line(ink::BLUE, 1.1), Paint::line(ink::FAINT, 1.1)]
}

/// The order in which curves are drawn: what reaches farther lies below, and hides nothing.
fn drawing_order(curves: &[(f64, f64, &[f64])], peak: bool) -> Vec<usize> {
    let mut order: Vec<usize> = (0..curves.len()).collect();
    if !peak {
        let size = |i: &usize| {
            let finite = curves[*i].2.iter().filter(|v| v.is_finite());
            finite.fold(0.0, |m: f64, v| m.max(v.abs()))
        };
        order.sort_by(|a, b| size(b).total_cmp(&size(a)));
    }
    order
}

/// A plot of all curves, with a legend where there are several; `plot` is its name to the page's script, empty for a
/// still one.
fn draw(
    report: &AnalysisReport,
    layout: Layout,
    spec: Spec,
    plot: &str,
    curves: &[(f64, f64, &[f64])],
    peak: bool,
    highlight: Option<(f64, f64)>,
) -> Picture {
    let size = spec.size;
    let width = layout.size(0.0).width;
    let mut picture = Picture::new(&spec.name, &spec.title, width, size.height);
    let mut top = 0.0;
    if curves.len() > 1 {
        let entries: Vec<(&str, Paint)> =
            (report.names.iter().zip(paints())).map(|(name, paint)| (name.as_str(), paint)).collect();
        top = legend(&mut picture, &entries, 12.0, width - 12.0, 2.0, size.font);
        picture.height = top + size.height;
    }
    let mut chart = Chart::new(spec);
    if curves.iter().all(|c| range(c.2.iter().copied()).is_none()) {
        chart.say("No samples");
    }
    if let Some((lo, hi)) = highlight {
        chart.highlight(lo, hi);
    }
    // What lies on top lets the rest shine through.
    for (above, index) in drawing_order(curves, peak).into_iter().enumerate() {
        let (x0, dx, values) = curves[index];
        let paint = paints()[index.min(1)];
        let paint = if above > 0 { paint.faded(0.75) } else { paint };
        if curves.len() > 1 {
            chart.of(&report.names[index.min(1)]);
        }
        chart.curve(x0, dx, values, peak, paint);
    }
    if !plot.is_empty() {
        chart.interactive_at(plot, top);
    }
    let chart = chart.finish();
    picture.attributes.clone_from(&chart.attributes);
    picture.place(chart, 0.0, top);
    picture
}

/// Writes what the page's script needs of a plot drawn by [`draw`]: `chart` without its curves.
fn embed(page: &mut String, names: &[String], curves: &[(f64, f64, &[f64])], chart: embedded::Chart) {
    let order = drawing_order(curves, chart.peak);
    let drawn: Vec<usize> = (0..curves.len()).filter_map(|i| order.iter().position(|o| *o == i)).collect();
    let named = names.iter().map(String::as_str).chain(std::iter::repeat(""));
    let curves: Vec<Curve> = (curves.iter().zip(named))
        .map(|((x0, dx, values), name)| Curve { name, along: Along::Even { first: *x0, step: *dx }, values })
        .collect();
    embedded::Chart { curves: &curves, drawn: &drawn, ..chart }.write(page);
}

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
    draw(report, layout, spec, "spectrum", &curves, true, report.band_hz)
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
    draw(report, layout, spec, "envelope", &curves(&report.envelopes), true, None)
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
            x: ("Frequency", "Hz"),
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
