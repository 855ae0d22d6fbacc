//! The report's pictures, from its data.

use std::f64::consts::TAU;

use crate::chart::{Chart, Domain, Lane, Mark, Size, Spec, left_margin, range, right_margin};
use crate::damage::{damage_passage, damage_plan, damage_section};
use crate::data::{EventKind, Marker, MinMax, Pass, Report, Series, Spectrum};
use crate::font;
use crate::load::load_distribution;
use crate::motion::bearing_motion;
use crate::number::significant;
use crate::orbit::cage_orbit;
use crate::picture::{Anchor, Error, Paint, Picture, Shape, Text, ink};
use crate::slip::{self, slip_over_angle, slip_over_time};
use crate::spectrogram::spectrogram;

/// What a picture is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A desktop page, print, a file: 960 pixels across.
    Wide,
    /// A phone: 360 pixels across.
    Narrow,
}

impl Layout {
    pub(crate) fn size(self, height: f64) -> Size {
        match self {
            Self::Wide => Size {
                width: 960.0,
                height,
                font: 12.5,
            },
            Self::Narrow => Size {
                width: 360.0,
                height,
                font: 11.0,
            },
        }
    }
}

const CURVE: Paint = Paint {
    stroke: ink::BLUE,
    width: 1.2,
    dash: &[],
    fill: None,
    opacity: 1.0,
};

/// Seconds or milliseconds, whichever reads better over `span`.
pub(crate) fn time_unit(span: f64) -> (&'static str, f64) {
    if span.is_finite() && span >= 0.5 {
        ("s", 1.0)
    } else {
        ("ms", 1e3)
    }
}

fn known(spacing: f64) -> bool {
    spacing.is_finite() && spacing > 0.0
}

/// A spacing to lay a plot out with, even where there is none to draw with.
fn spacing(d: f64) -> f64 {
    if known(d) { d } else { 1.0 }
}

fn start(t0: f64) -> f64 {
    if t0.is_finite() { t0 } else { 0.0 }
}

fn span(series: &Series) -> (f64, f64) {
    let (t0, dt) = (start(series.t0_s), spacing(series.dt_s));
    (t0, t0 + dt * series.values.len().saturating_sub(1) as f64)
}

fn usable(markers: &[Marker]) -> impl Iterator<Item = &Marker> {
    markers
        .iter()
        .filter(|m| m.frequency_hz.is_finite() && m.frequency_hz > 0.0)
}

/// The markers that decide what is shown: those of damage that is there, or all of them.
fn telling(markers: &[Marker]) -> Vec<&Marker> {
    let present: Vec<&Marker> = usable(markers).filter(|m| m.present).collect();
    if present.is_empty() {
        usable(markers).collect()
    } else {
        present
    }
}

/// Start and end in seconds of the waveform shown close up: the last five periods of the quickest damage in the bearing.
pub fn detail_window(report: &Report) -> (f64, f64) {
    let series = &report.waveform.series;
    let (first, last) = span(series);
    let quickest = telling(&report.markers)
        .iter()
        .map(|m| m.frequency_hz)
        .fold(0.0, f64::max);
    let wanted = if quickest > 0.0 { 5.0 / quickest } else { 0.02 };
    let width = wanted.max(32.0 * spacing(series.dt_s));
    ((last - width).max(first), last)
}

/// The frequency up to which the envelope spectrum is shown: all harmonics of the damage in the bearing.
fn envelope_top(report: &Report) -> f64 {
    let spectrum = &report.envelope_spectrum;
    let end = spacing(spectrum.df_hz) * spectrum.amplitude.len().saturating_sub(1) as f64;
    let top = telling(&report.markers)
        .iter()
        .map(|m| m.frequency_hz * (m.harmonics.clamp(1, 20) as f64 + 0.5))
        .fold(0.0, f64::max);
    if top > 0.0 { top.min(end) } else { end }
}

/// The whole run, the smallest and largest value of each stretch; the close-up's window is shaded.
pub fn overview(report: &Report, layout: Layout) -> Picture {
    let series = &report.waveform.series;
    let whole = MinMax {
        t0_s: start(series.t0_s) - 0.5 * spacing(series.dt_s),
        dt_s: series.dt_s,
        min: series.values.clone(),
        max: series.values.clone(),
    };
    let bins = report.waveform.overview.as_ref().unwrap_or(&whole);
    let (t0, dt, count) = (
        start(bins.t0_s),
        spacing(bins.dt_s),
        bins.min.len().min(bins.max.len()),
    );
    let end = t0 + dt * count as f64;
    let (unit, scale) = time_unit(end - t0);
    let mut chart = Chart::new(Spec {
        name: "overview".into(),
        title: format!("Whole run: {}", series.label),
        size: layout.size(if layout == Layout::Wide { 190.0 } else { 170.0 }),
        x: Domain::exact(t0 * scale, end * scale),
        y: Domain::around(bins.min.iter().chain(&bins.max).copied()),
        x_label: "Time".into(),
        x_unit: unit.into(),
        y_label: "Acceleration".into(),
        y_unit: series.unit.clone(),
        lanes: vec![],
        left: 0.0,
        right: 0.0,
        x_axis: true,
    });
    if range(bins.min.iter().copied()).is_none() {
        chart.say("No samples");
    } else {
        let (low, high) = (&bins.min[..count], &bins.max[..count]);
        let paint = Paint::line(ink::BLUE, 0.6).filled(ink::BLUE, 0.75);
        chart.band(t0 * scale, dt * scale, low, high, paint);
        let (lo, hi) = detail_window(report);
        chart.highlight(lo * scale, hi * scale);
    }
    chart.interactive("overview");
    chart.finish()
}

pub(crate) fn event_lanes(report: &Report, scale: f64) -> Vec<Lane> {
    let lane = |kind: EventKind, label: &str, color, dash: &'static [f64]| Lane {
        label: label.into(),
        value: String::new(),
        color,
        dash,
        through: true,
        marks: {
            let mut marks: Vec<Mark> = report
                .waveform
                .events
                .iter()
                .filter(|event| event.kind == kind && event.t_s.is_finite())
                .map(|event| Mark {
                    x: event.t_s * scale,
                    name: format!("Roller {} {label}", event.label),
                    label: event.label.clone(),
                })
                .collect();
            marks.sort_by(|a, b| a.x.total_cmp(&b.x));
            marks
        },
    };
    [
        lane(EventKind::Enter, "enters", ink::VERMILLION, &[]),
        lane(EventKind::Leave, "leaves", ink::GREEN, &[5.0, 3.0]),
    ]
    .into_iter()
    .filter(|lane| !lane.marks.is_empty())
    .collect()
}

/// The measured signal close up, with the instants at which rollers enter and leave defects.
pub fn waveform(report: &Report, layout: Layout) -> Picture {
    let height = if layout == Layout::Wide { 340.0 } else { 300.0 };
    draw_waveform(report, waveform_spec(report, layout.size(height)))
}

fn draw_waveform(report: &Report, spec: Spec) -> Picture {
    let mut chart = Chart::new(spec);
    let series = &report.waveform.series;
    let (_, scale) = waveform_unit(report);
    if range(series.values.iter().copied()).is_none() {
        chart.say("No samples");
    } else if !known(series.dt_s) && series.values.len() > 1 {
        chart.say("The sample interval is not known");
    } else {
        chart.curve(
            start(series.t0_s) * scale,
            spacing(series.dt_s) * scale,
            &series.values,
            false,
            CURVE,
        );
    }
    chart.interactive("waveform");
    chart.finish()
}

pub(crate) fn waveform_unit(report: &Report) -> (&'static str, f64) {
    let (lo, hi) = detail_window(report);
    time_unit(hi - lo)
}

pub(crate) fn waveform_domain(report: &Report) -> Domain {
    let series = &report.waveform.series;
    let (t0, dt) = (start(series.t0_s), spacing(series.dt_s));
    let first =
        (((detail_window(report).0 - t0) / dt).floor().max(0.0) as usize).min(series.values.len());
    Domain::around(series.values[first..].iter().copied())
}

fn waveform_spec(report: &Report, size: Size) -> Spec {
    let series = &report.waveform.series;
    let (lo, hi) = detail_window(report);
    let (unit, scale) = waveform_unit(report);
    Spec {
        name: "waveform".into(),
        title: format!("Waveform: {}", series.label),
        size,
        x: Domain::exact(lo * scale, hi * scale),
        y: waveform_domain(report),
        x_label: "Time".into(),
        x_unit: unit.into(),
        y_label: series.label.clone(),
        y_unit: series.unit.clone(),
        lanes: event_lanes(report, scale),
        left: 0.0,
        right: 0.0,
        x_axis: true,
    }
}

const MARKER_COLORS: [&str; 6] = [
    ink::VERMILLION,
    ink::GREEN,
    ink::PURPLE,
    ink::ORANGE,
    ink::SKY,
    ink::BLACK,
];

pub(crate) fn marker_lanes(markers: &[Marker]) -> Vec<Lane> {
    usable(markers)
        .enumerate()
        .map(|(index, marker)| Lane {
            label: marker.label.clone(),
            value: format!("{} Hz", significant(marker.frequency_hz, 4)),
            color: MARKER_COLORS[index % MARKER_COLORS.len()],
            dash: &[4.0, 3.0],
            through: marker.present,
            marks: (1..=marker.harmonics.clamp(1, 200))
                .map(|n| Mark {
                    x: n as f64 * marker.frequency_hz,
                    name: if n == 1 {
                        marker.label.clone()
                    } else {
                        format!("{n} × {}", marker.label)
                    },
                    label: if n == 1 {
                        String::new()
                    } else {
                        format!("×{n}")
                    },
                })
                .collect(),
        })
        .collect()
}

/// The whole amplitude spectrum over decades.
pub fn spectrum(report: &Report, layout: Layout) -> Picture {
    let size = layout.size(if layout == Layout::Wide { 320.0 } else { 270.0 });
    let spectrum = &report.spectrum;
    let end = spacing(spectrum.df_hz) * spectrum.amplitude.len().saturating_sub(1) as f64;
    let title = format!("Spectrum: {}", spectrum.label);
    let y = Domain::decades(&spectrum.amplitude);
    let mut chart = Chart::new(spectrum_spec(
        "spectrum",
        title,
        spectrum,
        size,
        end,
        y,
        vec![],
    ));
    draw_spectrum(&mut chart, spectrum);
    chart.interactive("spectrum");
    chart.finish()
}

/// The envelope spectrum up to the last harmonic of the damage there is, every defect frequency marked.
pub fn envelope_spectrum(report: &Report, layout: Layout) -> Picture {
    let height = if layout == Layout::Wide { 370.0 } else { 330.0 };
    draw_envelope(report, envelope_spec(report, layout.size(height)))
}

pub(crate) fn envelope_domain(report: &Report) -> Domain {
    let spectrum = &report.envelope_spectrum;
    let top = envelope_top(report);
    // The line at 0 Hz is the envelope's mean and says nothing about damage.
    let shown =
        ((top / spacing(spectrum.df_hz)) as usize).min(spectrum.amplitude.len().saturating_sub(1));
    Domain::from_zero(spectrum.amplitude.iter().take(shown + 1).skip(1).copied())
}

fn envelope_spec(report: &Report, size: Size) -> Spec {
    let spectrum = &report.envelope_spectrum;
    let (top, y) = (envelope_top(report), envelope_domain(report));
    let title = format!("Envelope spectrum: {}", spectrum.label);
    spectrum_spec(
        "envelope-spectrum",
        title,
        spectrum,
        size,
        top,
        y,
        marker_lanes(&report.markers),
    )
}

fn draw_envelope(report: &Report, spec: Spec) -> Picture {
    let mut chart = Chart::new(spec);
    draw_spectrum(&mut chart, &report.envelope_spectrum);
    chart.interactive("envelope");
    chart.finish()
}

fn spectrum_spec(
    name: &str,
    title: String,
    spectrum: &Spectrum,
    size: Size,
    top: f64,
    y: Domain,
    lanes: Vec<Lane>,
) -> Spec {
    Spec {
        name: name.into(),
        title,
        size,
        x: Domain::exact(0.0, if top > 0.0 { top } else { 1.0 }),
        y,
        x_label: "Frequency".into(),
        x_unit: "Hz".into(),
        y_label: if spectrum.label.is_empty() {
            "Amplitude".into()
        } else {
            spectrum.label.clone()
        },
        y_unit: spectrum.unit.clone(),
        lanes,
        left: 0.0,
        right: 0.0,
        x_axis: true,
    }
}

fn draw_spectrum(chart: &mut Chart, spectrum: &Spectrum) {
    if range(spectrum.amplitude.iter().copied()).is_none() {
        chart.say("No spectrum");
    } else if !known(spectrum.df_hz) {
        chart.say("The line spacing is not known");
    } else {
        chart.curve(
            0.0,
            spacing(spectrum.df_hz),
            &spectrum.amplitude,
            true,
            CURVE,
        );
    }
}

/// Boxes of line and text, from `left` on, wrapped at `right`; returns the height used.
pub(crate) fn legend(
    picture: &mut Picture,
    entries: &[(&str, Paint)],
    left: f64,
    right: f64,
    top: f64,
    font: f64,
) -> f64 {
    let (mut x, mut y) = (left, top + font);
    for (label, paint) in entries {
        let words = Text::with_unit(0.0, 0.0, font, Anchor::Start, label);
        let width = 26.0 + words.width() + 18.0;
        if x > left && x + width > right + 18.0 {
            x = left;
            y += 1.6 * font;
        }
        let middle = y - 0.36 * font;
        if paint.width > 0.0 || paint.fill.is_none() {
            picture.path(
                &[(x, middle), (x + 20.0, middle)],
                Paint {
                    fill: None,
                    ..*paint
                },
            );
        } else {
            picture.shapes.push(Shape::Circle {
                x: x + 10.0,
                y: middle,
                r: 3.5,
                paint: *paint,
            });
        }
        picture.text(Text {
            x: x + 26.0,
            y,
            ..words
        });
        x += width;
    }
    y - top + 0.6 * font
}

/// Contact length, stiffness and force of one roller over its angle from the defect's centre.
pub fn pass(pass: &Pass, index: usize, layout: Layout) -> Picture {
    let size = layout.size(0.0);
    let part = if layout == Layout::Wide { 130.0 } else { 120.0 };
    let other = pass.other_length_mm.as_deref();
    let second = Paint::line(ink::ORANGE, 1.8).dashed(&[6.0, 3.0]);
    let first = Paint::line(ink::BLUE, 1.8);
    let or = |name: &str, fallback: &str| {
        if name.is_empty() {
            fallback.to_owned()
        } else {
            name.to_owned()
        }
    };
    let x = {
        let (lo, hi) = range(pass.angle_deg.iter().copied()).unwrap_or((-1.0, 1.0));
        Domain::exact(lo, hi)
    };
    let panel = |y_label: &str, unit: &str, y: Domain, last: bool| Spec {
        name: String::new(),
        title: String::new(),
        size: Size {
            height: part + if last { 3.4 * size.font } else { 0.0 },
            ..size
        },
        x,
        y,
        x_label: "Angle from the defect’s centre".into(),
        x_unit: "°".into(),
        y_label: y_label.into(),
        y_unit: unit.into(),
        lanes: vec![],
        left: 0.0,
        right: 0.0,
        x_axis: last,
    };
    let lengths = pass.length_mm.iter().chain(other.unwrap_or(&[])).copied();
    let mut specs = [
        panel("Contact length", "mm", Domain::from_zero(lengths), false),
        panel(
            "Stiffness",
            &pass.stiffness_unit,
            Domain::from_zero(pass.stiffness.iter().copied()),
            false,
        ),
        panel(
            "Force",
            "N",
            Domain::from_zero(pass.force_n.iter().copied()),
            true,
        ),
    ];
    let left = specs.iter().map(left_margin).fold(0.0, f64::max);
    specs.iter_mut().for_each(|spec| spec.left = left);

    let total = 3.0 * part + 3.4 * size.font + 1.9 * size.font;
    let name = format!("pass-{}", index + 1);
    let mut picture = Picture::new(&name, &pass.title, size.width, total);
    let mut entries = vec![];
    let names = (
        or(&pass.contact, "this contact"),
        or(&pass.other_contact, "other contact"),
    );
    entries.push((names.0.as_str(), first));
    if other.is_some() {
        entries.push((names.1.as_str(), second));
    }
    let mut top = legend(&mut picture, &entries, left, size.width, 2.0, size.font);
    let curves = [&pass.length_mm, &pass.stiffness, &pass.force_n];
    for (index, (spec, curve)) in specs.into_iter().zip(curves).enumerate() {
        let height = spec.size.height;
        let mut chart = Chart::new(spec);
        if range(curve.iter().copied()).is_none() || pass.angle_deg.is_empty() {
            chart.say("Not recorded");
        }
        if let (0, Some(other)) = (index, other) {
            chart.points(&pass.angle_deg, other, second);
        }
        chart.points(&pass.angle_deg, curve, first);
        picture.place(chart.finish(), 0.0, top);
        top += height;
    }
    picture
}

/// Every picture of the report, for saving as files.
pub fn pictures(report: &Report) -> Vec<Picture> {
    let mut pictures = vec![
        overview(report, Layout::Wide),
        waveform(report, Layout::Wide),
        spectrum(report, Layout::Wide),
        envelope_spectrum(report, Layout::Wide),
    ];
    for (index, view) in report.damage.iter().enumerate() {
        pictures.push(damage_plan(view, index, Layout::Wide));
        if !view.passage.is_empty() {
            pictures.push(damage_passage(view, index, Layout::Wide));
        }
        if !view.section.is_empty() {
            pictures.push(damage_section(view, index, Layout::Wide));
        }
    }
    pictures.extend(
        report
            .passes
            .iter()
            .enumerate()
            .map(|(i, p)| pass(p, i, Layout::Wide)),
    );
    if !report.load_distribution.is_empty() {
        pictures.push(load_distribution(&report.load_distribution, Layout::Wide));
    }
    if !report.spectrogram.density.is_empty() {
        pictures.push(spectrogram(&report.spectrogram, Layout::Wide));
    }
    if !report.motion.rows.is_empty() {
        pictures.push(bearing_motion(&report.motion, usize::MAX, Layout::Wide));
    }
    if !report.cage_orbits.rows.is_empty() {
        pictures.push(cage_orbit(&report.cage_orbits, Layout::Wide));
    }
    if slip::there_is(&report.slip_rows) {
        pictures.push(slip_over_time(&report.slip_rows, Layout::Wide));
        pictures.push(slip_over_angle(&report.slip_rows, Layout::Wide));
    }
    pictures
}

/// Waveform over envelope spectrum under the report's title: the run in one picture.
pub fn headline(report: &Report) -> Picture {
    const WIDTH: f64 = 1400.0 / HEADLINE_SCALE;
    const HEIGHT: f64 = 700.0 / HEADLINE_SCALE;
    let mut picture = Picture::new("headline", &report.title, WIDTH, HEIGHT);
    let size = |height| Size {
        width: WIDTH - 12.0,
        height,
        font: 12.5,
    };
    let height = 0.5 * (HEIGHT - 34.0);
    let mut upper = waveform_spec(report, size(height));
    let mut lower = envelope_spec(report, size(height));
    if lower.lanes.iter().any(|lane| lane.through) {
        lower.lanes.retain(|lane| lane.through);
    }
    let left = left_margin(&upper).max(left_margin(&lower));
    let right = right_margin(&upper).max(right_margin(&lower));
    for spec in [&mut upper, &mut lower] {
        (spec.left, spec.right) = (left, right);
    }
    let title = font::fitted(&report.title, 16.0, true, 0.45 * WIDTH);
    let used = font::width(&title, 16.0, true);
    let subtitle = font::fitted(&report.subtitle, 13.0, false, WIDTH - used - left - 40.0);
    picture.text(
        Text::new(left, 24.0, 16.0, Anchor::Start, &title)
            .bold()
            .color(ink::BLACK),
    );
    picture.text(Text::new(
        left + used + 14.0,
        24.0,
        13.0,
        Anchor::Start,
        &subtitle,
    ));
    picture.place(draw_waveform(report, upper), 0.0, 32.0);
    picture.place(draw_envelope(report, lower), 0.0, 32.0 + height);
    picture
}

const HEADLINE_SCALE: f64 = 1.5;

/// [`headline`] as a PNG of 1400 x 700 pixels.
pub fn headline_png(report: &Report) -> Result<Vec<u8>, Error> {
    headline(report).png(HEADLINE_SCALE)
}

/// Angles of equal bins around the circle, degrees: what `RowLoad::angle_deg` holds.
pub fn bin_centres(bins: usize) -> Vec<f64> {
    (0..bins)
        .map(|bin| ((bin as f64 + 0.5) * TAU / bins as f64).to_degrees())
        .collect()
}
