//! One machine's history to failure: outlines, size, indicators and signals over its life.

use std::sync::Arc;

use crate::chart::{Chart, Domain, Size, Spec, left_margin, right_margin};
use crate::data::Along;
use crate::fact::Fact;
use crate::layout::Layout;
use crate::markup::escape;
use crate::number::{plural, significant};
use crate::overlay::{OverlaidCurve, Overlay, Vertical};
use crate::page::{Chapter, Figure, Page, Piece, Stack};
use crate::picture::{Paint, Picture, Shape};
use crate::sheet::tile;
use crate::sweep::{IndicatorLine, IndicatorPlot, IndicatorPoint};
use brinell_study::dataset::{HistorySheet, Sheet, SheetSnapshot};

/// From the first outline to the last: light to dark.
const SHADES: [&str; 8] = ["#c6dbef", "#9ecae1", "#7fb8da", "#5ba3cf", "#3787c0", "#1c6ab0", "#0b4d94", "#08306b"];
/// Tallest picture of outlines, px.
const TALLEST: f64 = 420.0;

impl Page {
    /// One machine's history: `machine-K.html` of `brinell dataset sheet --machine K`.
    pub fn of_history(history: HistorySheet) -> Self {
        let history = Arc::new(history);
        let of = &*history;
        let count = |state: &str| of.snapshots.iter().filter(|s| s.state == state).count();
        let mut chapters = Vec::new();
        if of.snapshots.iter().any(|s| !s.outline_mm.is_empty()) {
            let surface = if of.on == "roller" { "rolling element's surface" } else { "raceway" };
            let words = format!("The damage at each snapshot on the {surface} unrolled, {OUTLINES}");
            let figure = Figure::still("outlines", &words, &history, outlines);
            chapters.push(Chapter::of("outlines", "Outlines", Piece::Figure(figure)));
        }
        // Of a machine that stays healthy a length is a false alarm.
        if of.snapshots.iter().any(|s| s.size.is_some() || !s.outline_mm.is_empty()) {
            let words = format!("{SIZE} Length: {}. {COVERAGE}", of.told());
            let pieces = vec![Piece::Trend(size(of)), Piece::Note(words)];
            chapters.push(Chapter::new("size", "Size", "Size over life", pieces));
        }
        chapters.push(Chapter::of("indicators", "Indicators over life", Piece::Stack(indicators(of))));
        chapters.push(signals(of));
        let assumed = format!("<p>Assumed, and no prediction: {}.</p>", escape(&of.assumed));
        chapters.push(Chapter::of("assumed", "What is assumed", Piece::Markup(assumed)));
        Self {
            title: format!("{}: machine {}", of.name, of.machine),
            subtitle: format!(
                "class {}: {}, {} healthy, {} damaged, {} failed",
                of.class,
                plural(of.snapshots.len(), "snapshot"),
                count("healthy"),
                count("damaged"),
                count("failed")
            ),
            version: of.version.clone(),
            facts: facts(of),
            chapters,
            ..Self::default()
        }
    }
}

const OUTLINES: &str = "seen from above: the later, the darker. s counts from the place of the damage, \
    counter-clockwise; both axes have one scale.";

const SIZE: &str = "The true length along the rolling direction, and what brinell analyze --size tells of each snapshot's signal, given the bearing and the speed alone, without a machine's noise. A cross: no length is told.";

/// By the book's table of the length (docs/src/results/analyze-size.md).
const COVERAGE: &str = "On 400 other signals that brinell made, 88 lengths were told and 95 % of the intervals held the true one (89 to 99 %); of ragged outlines and scans \
    24 of 26, 92 % (75 to 99 %).";

fn facts(of: &HistorySheet) -> Vec<Fact> {
    let numbers = [
        ("Damage begins", of.begins_h, "h"),
        ("Life until failure", of.life_h, "h"),
        ("Fails at a length of", of.fails_mm, "mm"),
    ];
    let known = numbers.into_iter().filter_map(|(label, value, unit)| Some((label, value?, unit)));
    known.map(|(label, value, unit)| Fact::new(label, value, unit, "")).collect()
}

/// The outlines, the latest lowest, to one scale.
fn outlines(of: &HistorySheet, layout: Layout) -> Picture {
    let shown: Vec<&SheetSnapshot> = of.snapshots.iter().filter(|s| !s.outline_mm.is_empty()).collect();
    let ends = |k: usize| {
        let all = || shown.iter().flat_map(|s| &s.outline_mm).map(|p| p[k]);
        let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
        let (middle, half) = (0.5 * (low + high), 0.55 * (high - low).max(1e-3));
        [middle, half]
    };
    let [[s, half_s], [z, half_z]] = [ends(0), ends(1)];
    let Size { width, font, .. } = layout.size(0.0);
    let around = 8.0 + 3.4 * font;
    let spec = |height: f64, half_s: f64, left: f64| Spec {
        left,
        ..Spec::new(
            "outlines",
            "Damage over life",
            Size { width, height, font },
            (Domain::exact(s - half_s, s + half_s), "Along the surface, s counter-clockwise", "mm"),
            (Domain::exact(z - half_z, z + half_z), "Axial, z", "mm"),
        )
    };
    let draft = spec(TALLEST + around, half_s, 0.0);
    let left = left_margin(&draft);
    let room = width - left - right_margin(&draft);
    let scale = (room / half_s).min(TALLEST / half_z);
    let mut chart = Chart::new(spec(scale * half_z + around, room / scale, left));
    for (k, snapshot) in shown.iter().enumerate().rev() {
        let shade = SHADES[k * (SHADES.len() - 1) / (shown.len() - 1).max(1)];
        let (xs, ys): (Vec<f64>, Vec<f64>) = snapshot.outline_mm.iter().map(|p| (p[0], p[1])).unzip();
        let line = xs.iter().zip(&ys).map(|(s, z)| (chart.x.at(*s), chart.y.at(*z))).collect();
        chart.keep(&format!("{} h", significant(snapshot.time_h, 4)), xs, ys);
        let paint = Paint::line("#ffffff", 0.8).filled(shade, 1.0);
        let clip = Some(chart.frame);
        chart.picture.shapes.push(Shape::Path { lines: vec![line], close: true, paint, clip });
    }
    chart.finish()
}

/// The true length, and what signals say of it.
fn size(of: &HistorySheet) -> IndicatorPlot {
    let point = |x: f64, value: f64, interval| IndicatorPoint { x, value, interval };
    let truth = of.snapshots.iter().map(|s| point(s.time_h, s.length_mm.unwrap_or(0.0), None));
    let mut lines = vec![IndicatorLine { label: "true length".into(), points: truth.collect() }];
    // Nothing joins two estimates over a snapshot that tells none.
    let told = of.snapshots.iter().filter_map(|s| {
        Some(match s.size.as_ref()? {
            Ok([low, value, high]) => point(s.time_h, *value, Some((*low, *high))),
            Err(_) => point(s.time_h, f64::NAN, None),
        })
    });
    let points: Vec<IndicatorPoint> = told.collect();
    if points.iter().any(|p| p.value.is_finite()) {
        lines.push(IndicatorLine { label: "told by the signal, 95 % interval".into(), points });
    }
    IndicatorPlot {
        name: "size".into(),
        label: "Length of the damage".into(),
        unit: "mm".into(),
        x_label: "Running time".into(),
        x_unit: "h".into(),
        lines,
        in_place: true,
        limits: of.fails_mm.into_iter().map(|mm| (mm, "fails".to_owned())).collect(),
        ..IndicatorPlot::default()
    }
}

const LEVEL: &str = "The envelope's line is that of the damaged part, before there is damage as well. ";

/// Indicators of every snapshot below one another.
fn indicators(of: &HistorySheet) -> Stack {
    let panel = |name: &str, label: &str, unit: &str, value: &dyn Fn(&SheetSnapshot) -> Option<f64>| {
        let values: Vec<f64> = of.snapshots.iter().map(|s| value(s).unwrap_or(f64::NAN)).collect();
        let times = Along::At(of.snapshots.iter().map(|s| s.time_h).collect());
        let known = values.iter().any(|x| x.is_finite());
        known.then(|| Overlay {
            vertical: Vertical::FromZero,
            ..Overlay::new(
                name,
                ("Running time", "h"),
                (label, unit),
                vec![OverlaidCurve { of: 0, along: times, values }],
            )
        })
    };
    let panels = [
        panel("rms", &format!("RMS of {}", of.signal), &of.unit, &|s| Some(s.run.rms)),
        panel("kurtosis", "Kurtosis", "", &|s| Some(s.run.kurtosis)),
        panel("envelope", "Envelope at the frequency of the damage", &of.unit, &|s| s.level),
        panel("edge", "Largest pressure over the damage", "MPa", &|s| s.edge_mpa),
        panel("speed", "Speed", "r/min", &|s| s.run.speed_rpm),
        panel("remaining", "Remaining life", "h", &|s| s.remaining_h),
    ];
    Stack {
        name: "indicators".into(),
        panels: panels.into_iter().flatten().collect(),
        names: vec![of.signal.clone()],
        note: format!(
            "RMS, kurtosis and envelope from the end of the start on. {}Speed and load differ from snapshot to snapshot where the plan draws them, and so do these.",
            if of.snapshots.iter().any(|s| s.level.is_some()) { LEVEL } else { "" }
        ),
        ..Stack::default()
    }
}

/// Signals of a few snapshots.
fn signals(of: &HistorySheet) -> Chapter {
    let sheet = Sheet { signal: of.signal.clone(), unit: of.unit.clone(), ..Sheet::default() };
    let sheet = Arc::new(sheet);
    let mut pieces = Vec::new();
    for snapshot in of.snapshots.iter().filter(|s| s.is_shown) {
        let left = snapshot.remaining_h.map_or(String::new(), |h| format!(", {} h before failure", significant(h, 4)));
        pieces.push(Piece::Heading(format!("{} h, {}{left}", significant(snapshot.time_h, 4), snapshot.state)));
        pieces.push(tile(&sheet, &snapshot.run));
    }
    if pieces.is_empty() {
        pieces.push(Piece::Note("No snapshot has a signal.".into()));
    }
    Chapter::new("signals", "Signals", "Signals of some snapshots", pieces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::html;

    #[test]
    fn prop_estimates_are_on_the_page_beside_the_truth_and_nothing_is_markup() {
        let at = |time_h: f64, length_mm: Option<f64>| SheetSnapshot {
            time_h,
            length_mm,
            state: "damaged".into(),
            outline_mm: length_mm.map_or(Vec::new(), |mm| vec![[0.0, -1.0], [mm, -1.0], [mm, 1.0]]),
            ..SheetSnapshot::default()
        };
        let history = HistorySheet {
            name: "a <b>".into(),
            fails_mm: Some(3.0),
            snapshots: vec![at(0.0, None), at(10.0, Some(1.0)), at(20.0, Some(3.0))],
            ..HistorySheet::default()
        };
        let mut with = history.clone();
        with.snapshots[1].size = Some(Err("no second event: it is short".into()));
        with.snapshots[2].size = Some(Ok([2.5, 3.1, 3.6]));
        let without = history;
        let lines = size(&with).lines;
        // Nothing is joined over a snapshot that tells no length, and points are at their times.
        assert!(lines[1].points[0].value.is_nan() && lines[1].points[1].interval == Some((2.5, 3.6)));
        assert_eq!((lines[1].points[0].x, lines[1].points[1].x), (10.0, 20.0));
        assert!(size(&with).in_place);
        assert_eq!(size(&without).lines.len(), 1);
        let page = html(&Page::of_history(with));
        for part in [
            "a &lt;b&gt;: machine 0",
            "95 % interval",
            "Length: told in 1 of 2 snapshots with damage; 1 of these intervals hold the true length; not told: 1 time no second event. On 400 other signals",
            "on the raceway unrolled",
            "Damage over life",
            "3 damaged",
            "No snapshot has a signal",
        ] {
            assert!(page.contains(part), "{part}");
        }
        assert!(!html(&Page::of_history(without.clone())).contains("told by the signal"));
        let roller = HistorySheet { on: "roller".into(), ..without };
        assert!(html(&Page::of_history(roller)).contains("on the rolling element's surface unrolled"));
    }

    #[test]
    fn regress_a_healthy_machine_shows_its_false_alarms_and_no_envelope_of_damage() {
        let snapshot = |time_h: f64, size| SheetSnapshot {
            time_h,
            state: "healthy".into(),
            size: Some(size),
            ..SheetSnapshot::default()
        };
        let sizes = [Ok([1.0, 2.0, 3.0]), Err("nothing is found".into())];
        let snapshots: Vec<SheetSnapshot> =
            sizes.into_iter().zip(0..).map(|(s, k)| snapshot(f64::from(k), s)).collect();
        let mut history = HistorySheet { snapshots, ..HistorySheet::default() };
        let page = html(&Page::of_history(history.clone()));
        assert!(page.contains("no snapshot has damage of known length; told of damage that is not there in 1 of 2"));
        assert!(!page.contains("before there is damage as well") && !page.contains("Damage over life"));
        history.snapshots[0].level = Some(1.0);
        assert!(html(&Page::of_history(history)).contains("before there is damage as well"));
    }

    #[test]
    fn regress_reasons_that_differ_in_numbers_are_one() {
        let damaged = |size| SheetSnapshot { length_mm: Some(1.0), size: Some(size), ..SheetSnapshot::default() };
        let short = |need: f64| damaged(Err(format!("{need} s of signal are needed, and there are 1.00 s")));
        let history = HistorySheet { snapshots: vec![short(3.36), short(2.9), short(3.36)], ..HistorySheet::default() };
        let told = history.told();
        assert!(
            told.ends_with(
                "not told: 3 times 3.36 s of signal are needed, and there are 1.00 s (the numbers of the first of them)"
            ),
            "{told}"
        );
    }
}
