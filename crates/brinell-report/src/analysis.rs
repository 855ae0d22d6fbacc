//! The page of an analysed signal: verdict, waveform, spectrum, envelope spectrum; and a second signal over it.

use std::fmt::Write as _;

use crate::chart::{Chart, Domain, Lane, Spec, range};
use crate::data::{Fact, Marker, Series, Spectrum};
use crate::frame::{THINNED, close, figure, open, plain, section};
use crate::kurtogram::{Kurtogram, kurtogram};
use crate::picture::{Paint, Picture, escape, ink};
use crate::plots::{Layout, legend, marker_lanes, time_unit};
use crate::tables::{Table, facts, table};

/// Everything the page of an analysis shows. Curves come in the order of `names`, one or two of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnalysisReport {
    /// File and channel.
    pub title: String,
    /// Bearing, speed, length.
    pub subtitle: String,
    /// The version of the program.
    pub version: String,
    /// The verdict in a paragraph.
    pub verdict: String,
    /// Whether it speaks of damage.
    pub damage: bool,
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
    /// Defect frequencies; `present` for those that stand.
    pub markers: Vec<Marker>,
    /// The band demodulated, Hz: shaded in the spectrum.
    pub band_hz: Option<(f64, f64)>,
    /// Which bands are how impulsive.
    pub kurtogram: Option<Kurtogram>,
    /// Findings, indicators, differences.
    pub tables: Vec<Table>,
}

fn paints() -> [Paint; 2] {
    [
        Paint::line(ink::BLUE, 1.1),
        Paint::line(ink::VERMILLION, 1.1),
    ]
}

/// A plot of all curves, with a legend where there are several.
fn plot(
    report: &AnalysisReport,
    layout: Layout,
    spec: Spec,
    curves: &[(f64, f64, &[f64])],
    peak: bool,
    highlight: Option<(f64, f64)>,
) -> Picture {
    let (name, title, size) = (spec.name.clone(), spec.title.clone(), spec.size);
    let mut chart = Chart::new(spec);
    if curves.iter().all(|c| range(c.2.iter().copied()).is_none()) {
        chart.say("No samples");
    }
    if let Some((lo, hi)) = highlight {
        chart.highlight(lo, hi);
    }
    // The second lies on top, and lets the first shine through.
    for (index, (x0, dx, values)) in curves.iter().enumerate() {
        let paint = paints()[index.min(1)];
        chart.curve(
            *x0,
            *dx,
            values,
            peak,
            if index > 0 { paint.faded(0.75) } else { paint },
        );
    }
    let chart = chart.finish();
    if curves.len() < 2 {
        return chart;
    }
    let entries: Vec<(&str, Paint)> = (report.names.iter().zip(paints()))
        .map(|(name, paint)| (name.as_str(), paint))
        .collect();
    let width = layout.size(0.0).width;
    let mut picture = Picture::new(&name, &title, width, size.height);
    let top = legend(&mut picture, &entries, 12.0, width - 12.0, 2.0, size.font);
    picture.height = top + size.height;
    picture.place(chart, 0.0, top);
    picture
}

fn waveform(report: &AnalysisReport, layout: Layout, close: bool) -> Picture {
    let first = report.waveforms.first().cloned().unwrap_or_default();
    let span = |s: &Series| s.dt_s * s.values.len() as f64;
    let whole = report.waveforms.iter().map(span).fold(0.0, f64::max);
    let shortest = report
        .waveforms
        .iter()
        .map(span)
        .fold(f64::INFINITY, f64::min);
    let (from, to) = if close {
        let from = (0.5 * (shortest - report.close_up_s)).max(0.0);
        (from, from + report.close_up_s.min(shortest))
    } else {
        (0.0, whole)
    };
    let (unit, scale) = time_unit(to - from);
    let shown = |s: &Series| -> Vec<f64> {
        let bin = |t: f64| ((t / s.dt_s).max(0.0) as usize).min(s.values.len());
        let end = bin(to);
        s.values[bin(from).min(end)..end].to_vec()
    };
    let extremes = report.waveforms.iter().flat_map(shown);
    let spec = Spec {
        name: if close { "close-up" } else { "waveform" }.into(),
        title: format!("Waveform: {}", first.label),
        size: layout.size(if close { 300.0 } else { 200.0 }),
        x: Domain::exact(from * scale, to * scale),
        y: Domain::around(extremes),
        x_label: "Time".into(),
        x_unit: unit.into(),
        y_label: first.label.clone(),
        y_unit: first.unit.clone(),
        lanes: vec![],
        left: 0.0,
        right: 0.0,
        x_axis: true,
    };
    let curves: Vec<(f64, f64, &[f64])> = (report.waveforms.iter())
        .map(|s| (0.0, s.dt_s * scale, &s.values[..]))
        .collect();
    plot(report, layout, spec, &curves, false, None)
}

fn spectrum_spec(
    name: &str,
    first: &Spectrum,
    layout: Layout,
    height: f64,
    top: f64,
    y: Domain,
    lanes: Vec<Lane>,
) -> Spec {
    Spec {
        name: name.into(),
        title: format!("{name}: {}", first.label),
        size: layout.size(height),
        x: Domain::exact(0.0, top),
        y,
        x_label: "Frequency".into(),
        x_unit: "Hz".into(),
        y_label: first.label.clone(),
        y_unit: first.unit.clone(),
        lanes,
        left: 0.0,
        right: 0.0,
        x_axis: true,
    }
}

fn end(spectra: &[Spectrum]) -> f64 {
    (spectra.iter())
        .map(|s| s.df_hz * s.amplitude.len().saturating_sub(1) as f64)
        .fold(0.0, f64::max)
}

fn curves(spectra: &[Spectrum]) -> Vec<(f64, f64, &[f64])> {
    (spectra.iter())
        .map(|s| (0.0, s.df_hz, &s.amplitude[..]))
        .collect()
}

fn spectrum(report: &AnalysisReport, layout: Layout) -> Picture {
    let first = report.spectra.first().cloned().unwrap_or_default();
    let all: Vec<f64> = (report.spectra.iter())
        .flat_map(|s| s.amplitude.iter().skip(2).copied())
        .collect();
    let height = if layout == Layout::Wide { 320.0 } else { 280.0 };
    let y = Domain::decades(&all);
    let spec = spectrum_spec(
        "spectrum",
        &first,
        layout,
        height,
        end(&report.spectra),
        y,
        vec![],
    );
    plot(
        report,
        layout,
        spec,
        &curves(&report.spectra),
        true,
        report.band_hz,
    )
}

fn envelope(report: &AnalysisReport, layout: Layout) -> Picture {
    let first = report.envelopes.first().cloned().unwrap_or_default();
    let all = (report.envelopes.iter()).flat_map(|s| s.amplitude.iter().skip(3).copied());
    let height = if layout == Layout::Wide { 400.0 } else { 360.0 };
    let lanes = marker_lanes(&report.markers);
    let y = Domain::from_zero(all);
    let top = end(&report.envelopes);
    let spec = spectrum_spec("envelope-spectrum", &first, layout, height, top, y, lanes);
    plot(report, layout, spec, &curves(&report.envelopes), true, None)
}

/// The page's pictures, drawn wide.
pub fn analysis_pictures(report: &AnalysisReport) -> Vec<Picture> {
    let wide = Layout::Wide;
    let mut pictures = vec![
        waveform(report, wide, false),
        waveform(report, wide, true),
        spectrum(report, wide),
    ];
    pictures.extend(report.kurtogram.as_ref().map(|k| kurtogram(k, wide)));
    pictures.push(envelope(report, wide));
    pictures
}

/// The self-contained page.
pub fn analysis_html(report: &AnalysisReport) -> String {
    let mut page = open(
        &report.title,
        &report.subtitle,
        ("Analysed", &report.version),
        plain(&report.warnings),
    );
    page.push_str("<main>\n");
    section(&mut page, "verdict", "Verdict", |page| {
        verdict(page, report)
    });
    section(&mut page, "waveform", "Waveform", |page| {
        figure(page, "whole", |layout| waveform(report, layout, false), "");
        figure(
            page,
            "close",
            |layout| waveform(report, layout, true),
            "A stretch from the middle, about ten strikes of the frequency that matters most long.",
        );
    });
    let note = |spectra: &[Spectrum]| spectra.first().map_or(String::new(), |s| escape(&s.note));
    section(&mut page, "spectrum", "Spectrum", |page| {
        let draw = |layout| spectrum(report, layout);
        figure(page, "spectrum", draw, &note(&report.spectra));
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
    close(page, THINNED, &[])
}

fn verdict(page: &mut String, report: &AnalysisReport) {
    let class = if report.damage { "bad" } else { "good" };
    let word = if report.damage {
        "damage"
    } else {
        "nothing stands out"
    };
    let _ = writeln!(
        page,
        "<p><span class=\"tag {class}\">{word}</span></p>\n<p>{}</p>",
        escape(&report.verdict)
    );
    facts(page, &report.facts);
}
