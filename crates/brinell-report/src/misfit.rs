//! Misfit against a key, and over the runs.

use crate::chart::{Chart, Domain, Spec};
use crate::data::Along;
use crate::embedded::{Curve, Plot};
use crate::layout::Layout;
use crate::picture::{Paint, Picture, Shape, ink};
use brinell_study::calibrate::{Found, Key};

/// A run as the picture of a key shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// Value of the key.
    pub value: f64,
    /// Sum of squares of the residuals; not finite where the run failed.
    pub chi_square: f64,
    /// Whether it differs from the best run in this key alone.
    pub alone: bool,
}

/// Misfits this far above the best are drawn at the upper edge.
const DECADES: f64 = 6.0;

/// The misfit's axis: from below the best up, in decades; a floor, as a perfect fit has no logarithm.
fn misfits(chi_squares: impl Iterator<Item = f64> + Clone) -> (Domain, f64) {
    let finite = chi_squares.filter(|c| c.is_finite());
    let lowest = finite.clone().fold(f64::INFINITY, f64::min);
    let highest = finite.fold(0.0, f64::max);
    if !lowest.is_finite() {
        let (lo, hi) = (0.1, 10.0);
        return (Domain { lo, hi, log: true }, lo);
    }
    let floor = lowest.max(1e-3);
    let lo = 10_f64.powf((floor.log10() - 0.3).floor());
    let hi = 10_f64.powf((highest.max(floor).log10() + 0.1).ceil()).min(lo * 10_f64.powf(DECADES));
    let hi = hi.max(10.0 * lo);
    (Domain { lo, hi, log: true }, floor)
}

fn spec(name: String, title: String, layout: Layout, x: Domain, y: Domain, x_label: (&str, &str)) -> Spec {
    let height = if layout.roomy() { 300.0 } else { 260.0 };
    Spec::new(name, title, layout.size(height), (x, x_label.0, x_label.1), (y, "Chi-square", ""))
}

fn dot(chart: &mut Chart, x: f64, y: f64, filled: bool) {
    let paint =
        if filled { Paint::fill(ink::VERMILLION, 1.0) } else { Paint::line(ink::BLUE, 1.2).filled("#ffffff", 1.0) };
    chart.picture.shapes.push(Shape::Circle { x: chart.x.at(x), y: chart.y.at(y), r: 3.2, paint });
}

/// Axes of the runs over a key, and the floor.
fn key_axes(about: &Found, tried: &[Tried], layout: Layout) -> (Spec, f64) {
    let Key { name, low, high, log } = &about.key;
    let x = if *log {
        let room = (high / low).powf(0.02);
        Domain { lo: low / room, hi: high * room, log: true }
    } else {
        let room = 0.02 * (high - low);
        Domain::exact(low - room, high + room)
    };
    let (y, floor) = misfits(tried.iter().map(|run| run.chi_square));
    let file = format!("misfit-{}", name.replace('.', "-"));
    let title = format!("Chi-square over {name}");
    (spec(file, title, layout, x, y, (name, about.unit)), floor)
}

/// Axes of the runs in their order, and the floor.
fn course_axes(chi_squares: &[f64], layout: Layout) -> (Spec, f64) {
    let (y, floor) = misfits(chi_squares.iter().copied());
    let x = Domain::exact(0.0, chi_squares.len().max(1) as f64 + 1.0);
    (spec("course".into(), "Chi-square over the runs".into(), layout, x, y, ("Run", "")), floor)
}

/// Sum of squares against a key.
pub(crate) fn key_plot(about: &Found, tried: &[Tried], layout: Layout) -> Picture {
    let (spec, floor) = key_axes(about, tried, layout);
    let (name, highest) = (spec.name.clone(), spec.y.hi);
    let mut chart = Chart::new(spec);
    if let Some((from, to)) = about.interval {
        chart.highlight(from, to);
    }
    let best = chart.x.at(about.best);
    let upright = [(best, chart.frame.top), (best, chart.frame.bottom)];
    chart.picture.path(&upright, Paint::line(ink::VERMILLION, 1.2).dashed(&[4.0, 3.0]));
    let height = |c: f64| c.clamp(floor, highest);
    let runs = tried.iter().filter(|t| t.chi_square.is_finite());
    let mut alone: Vec<(f64, f64)> = Vec::new();
    for run in runs {
        let place = (run.value, height(run.chi_square));
        if run.alone {
            alone.push(place);
        } else {
            dot(&mut chart, place.0, place.1, false);
        }
    }
    alone.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (xs, ys): (Vec<f64>, Vec<f64>) = alone.iter().copied().unzip();
    if alone.len() > 1 {
        chart.points(&xs, &ys, Paint::line(ink::VERMILLION, 1.4));
    }
    for (x, y) in alone {
        dot(&mut chart, x, y, true);
    }
    chart.interactive(&name);
    chart.finish()
}

/// What the page's script needs to read the runs over a key.
pub(crate) fn embed_key(page: &mut String, about: &Found, tried: &[Tried]) {
    let place = |x: f64| if about.key.log { x.log10() } else { x };
    let runs = tried.iter().map(|run| (place(run.value), run.chi_square));
    embed(page, key_axes(about, tried, Layout::Wide).0, runs.collect());
}

/// The same of the runs in their order.
pub(crate) fn embed_course(page: &mut String, chi_squares: &[f64]) {
    let runs = chi_squares.iter().enumerate().map(|(k, chi_square)| ((k + 1) as f64, *chi_square));
    embed(page, course_axes(chi_squares, Layout::Wide).0, runs.collect());
}

fn embed(page: &mut String, spec: Spec, mut runs: Vec<(f64, f64)>) {
    runs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (places, values): (Vec<f64>, Vec<f64>) = runs.into_iter().unzip();
    let curve = Curve { name: "", along: Along::At(places), values: &values, paint: Paint::line(ink::BLUE, 1.2) };
    let name = spec.name.clone();
    Plot { still: true, ..Plot::new(spec, name, vec![curve]) }.embed(page);
}

/// Sum of squares of each run in its order, and the best so far.
pub(crate) fn course_plot(chi_squares: &[f64], layout: Layout) -> Picture {
    let (spec, floor) = course_axes(chi_squares, layout);
    let highest = spec.y.hi;
    let mut chart = Chart::new(spec);
    let mut line: Vec<(f64, f64)> = Vec::new();
    let mut least = f64::INFINITY;
    for (k, &chi_square) in chi_squares.iter().enumerate() {
        least = least.min(chi_square);
        let x = (k + 1) as f64;
        if least.is_finite() {
            line.push((x, least.clamp(floor, highest)));
        }
        if chi_square.is_finite() {
            dot(&mut chart, x, chi_square.clamp(floor, highest), false);
        }
    }
    let (xs, ys): (Vec<f64>, Vec<f64>) = line.into_iter().unzip();
    if xs.len() > 1 {
        chart.points(&xs, &ys, Paint::line(ink::VERMILLION, 1.6));
    }
    chart.interactive("course");
    chart.finish()
}
