//! The sensor signal: the whole run, and the stretch close up with what rollers do in it.

use super::healthy::over_healthy;
use super::markers::telling;
use crate::chart::{Chart, Domain, Lane, Mark, Size, Spec, range};
use crate::data::{Along, MinMax, Series, Signals};
use crate::embedded::Plot;
use crate::layout::{Layout, known, spacing, start, time_unit};
use crate::number::significant;
use crate::picture::{Paint, Picture, ink};
use std::borrow::Cow;

fn span(series: &Series) -> (f64, f64) {
    let (t0, dt) = (start(series.t0_s), spacing(series.dt_s));
    (t0, t0 + dt * series.values.len().saturating_sub(1) as f64)
}

/// Start and end in seconds of the waveform shown close up: the last five periods of the quickest damage in the
/// bearing.
pub fn detail_window(run: &Signals) -> (f64, f64) {
    let series = &run.waveform.series;
    let (first, last) = span(series);
    let quickest = telling(&run.markers).iter().map(|m| m.frequency_hz).fold(0.0, f64::max);
    let wanted = if quickest > 0.0 { 5.0 / quickest } else { 0.02 };
    let width = wanted.max(32.0 * spacing(series.dt_s));
    ((last - width).max(first), last)
}

/// Of the run, this share is its start.
const START: f64 = 0.05;
/// The start is cut off where it is as many times as large as all that follows.
const OUTSHINES: f64 = 2.0;

/// What the overview's axis shows, and from where to where the start goes where it is cut off: else a bearing that
/// drops into its load zone would flatten the run to a line.
fn settled_domain(min: &[f64], max: &[f64]) -> (Domain, Option<(f64, f64)>) {
    let whole = || min.iter().chain(max).copied();
    let first = ((START * min.len() as f64) as usize).max(1).min(min.len());
    let later = range(min[first..].iter().chain(&max[first..]).copied());
    match (range(whole()), later) {
        (Some((lo, hi)), Some((low, high))) if high > low && hi - lo > OUTSHINES * (high - low) => {
            (Domain::around([low, high]), Some((lo, hi)))
        }
        _ => (Domain::around(whole()), None),
    }
}

/// The bins that the overview shows: of the whole run, or else a bin a sample.
fn bins(run: &Signals) -> Cow<'_, MinMax> {
    let series = &run.waveform.series;
    let a_sample_each = || MinMax {
        t0_s: start(series.t0_s) - 0.5 * spacing(series.dt_s),
        dt_s: series.dt_s,
        min: series.values.clone(),
        max: series.values.clone(),
    };
    run.waveform.overview.as_ref().map_or_else(|| Cow::Owned(a_sample_each()), Cow::Borrowed)
}

/// Start and end of bins, s.
fn ends(bins: &MinMax) -> (f64, f64) {
    let t0 = start(bins.t0_s);
    (t0, t0 + spacing(bins.dt_s) * bins.min.len().min(bins.max.len()) as f64)
}

/// The whole run, the smallest and largest value of each stretch; the close-up's window is shaded.
pub fn overview(run: &Signals, layout: Layout) -> Picture {
    let (series, bins) = (&run.waveform.series, bins(run));
    let (dt, count) = (spacing(bins.dt_s), bins.min.len().min(bins.max.len()));
    let (t0, end) = ends(&bins);
    let (unit, scale) = time_unit(end - t0);
    let (y, cut) = settled_domain(&bins.min[..count], &bins.max[..count]);
    let remark = cut.map_or(String::new(), |(lo, hi)| {
        let [lo, hi] = [lo, hi].map(|v| significant(v, 3));
        format!("Cut off: the start reaches from {lo} to {hi} {}", series.unit)
    });
    let spec = Spec::new(
        "overview",
        format!("Whole run: {}", series.label),
        layout.size(if layout.roomy() { 190.0 } else { 170.0 }),
        (Domain::exact(t0 * scale, end * scale), "Time", unit),
        (y, "Acceleration", &series.unit),
    );
    let mut chart = Chart::new(Spec { remark, ..spec });
    if range(bins.min.iter().copied()).is_none() {
        chart.say("No samples");
    } else {
        let (low, high) = (&bins.min[..count], &bins.max[..count]);
        let paint = Paint::line(ink::BLUE, 0.6).filled(ink::BLUE, 0.75);
        chart.band(t0 * scale, dt * scale, low, high, paint);
        let (lo, hi) = detail_window(run);
        chart.highlight(lo * scale, hi * scale);
    }
    chart.interactive("overview");
    chart.finish()
}

fn event_lanes(run: &Signals, scale: f64) -> Vec<Lane> {
    let lane = |enters: bool, label: &str, color, dash: &'static [f64]| Lane {
        label: label.into(),
        value: String::new(),
        color,
        dash,
        through: true,
        marks: {
            let mut marks: Vec<Mark> = run
                .waveform
                .events
                .iter()
                .filter(|event| event.enters == enters && event.t_s.is_finite())
                .map(|event| Mark {
                    x: event.t_s * scale,
                    name: format!("Rolling element {} {label}", event.label),
                    label: event.label.clone(),
                })
                .collect();
            marks.sort_by(|a, b| a.x.total_cmp(&b.x));
            marks
        },
        minor: Vec::new(),
    };
    [lane(true, "enters", ink::VERMILLION, &[]), lane(false, "leaves", ink::GREEN, &[5.0, 3.0])]
        .into_iter()
        .filter(|lane| !lane.marks.is_empty())
        .collect()
}

/// The sensor signal close up, with the instants at which rollers enter and leave defects.
pub(crate) fn waveform(run: &Signals, layout: Layout) -> Plot<'_> {
    waveform_of_size(run, layout.size(if layout.roomy() { 340.0 } else { 300.0 }))
}

pub(super) fn waveform_of_size(run: &Signals, size: Size) -> Plot<'_> {
    let (series, healthy) = (&run.waveform.series, &run.healthy.waveform);
    let (lo, hi) = detail_window(run);
    let (unit, scale) = time_unit(hi - lo);
    let (t0, dt) = (start(series.t0_s), spacing(series.dt_s));
    let first = (((lo - t0) / dt).floor().max(0.0) as usize).min(series.values.len());
    let y = Domain::around(series.values[first..].iter().chain(healthy.iter().skip(first)).copied());
    let spec = Spec {
        lanes: event_lanes(run, scale),
        ..Spec::new(
            "waveform",
            format!("Waveform: {}", series.label),
            size,
            (Domain::exact(lo * scale, hi * scale), "Time", unit),
            (y, &series.label, &series.unit),
        )
    };
    let words = match range(series.values.iter().copied()) {
        None => "No samples",
        Some(_) if !known(series.dt_s) && series.values.len() > 1 => "The sample interval is not known",
        Some(_) => "",
    };
    let along = Along::Even { first: t0 * scale, step: dt * scale };
    let (from, to) = ends(&bins(run));
    Plot {
        called: ["", "Acceleration"],
        overview_scale: scale / time_unit(to - from).1,
        ..over_healthy(spec, "waveform", words, along, &series.values, healthy)
    }
}
