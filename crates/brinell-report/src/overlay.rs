//! Curves of several runs in one plot, under a legend.

use crate::chart::{Domain, Lane, Spec, range};
use crate::data::{Along, Marker};
use crate::embedded::{Curve, Plot};
use crate::font;
use crate::layout::Layout;
use crate::picture::{Anchor, Paint, Picture, Text, ink};
use crate::plots::marker_lanes;

/// One run's curve.
#[derive(Clone, Debug, PartialEq)]
pub struct OverlaidCurve {
    /// Which of the page's names it belongs to, from 0.
    pub of: usize,
    /// Where its values are.
    pub along: Along,
    /// The values; NaN is a gap.
    pub values: Vec<f64>,
}

/// How the y axis is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Vertical {
    /// Around the values.
    #[default]
    Around,
    /// From zero up.
    FromZero,
    /// Decades of what is largest.
    Decades,
}

/// Curves of several runs in one plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// Name of the picture's file.
    pub name: String,
    /// Over the plot; may be empty.
    pub title: String,
    /// Quantity on the x axis.
    pub x_label: String,
    /// Its unit; may be empty.
    pub x_unit: String,
    /// Ends of the x axis; all that the curves have where there are none.
    pub x_range: Option<(f64, f64)>,
    /// Quantity on the y axis.
    pub y_label: String,
    /// Its unit; may be empty.
    pub y_unit: String,
    /// The y axis.
    pub vertical: Vertical,
    /// The curves, the first lowest.
    pub curves: Vec<OverlaidCurve>,
    /// Frequencies marked above the plot.
    pub markers: Vec<Marker>,
    /// Whose each of them is; of all runs where none is said.
    pub marked: Vec<Option<usize>>,
    /// Under it; may be empty.
    pub note: String,
}

impl Overlay {
    /// Of these curves; labels with their units.
    pub fn new(
        name: impl Into<String>,
        (x_label, x_unit): (&str, &str),
        (y_label, y_unit): (&str, &str),
        curves: Vec<OverlaidCurve>,
    ) -> Self {
        Self {
            name: name.into(),
            x_label: x_label.into(),
            x_unit: x_unit.into(),
            y_label: y_label.into(),
            y_unit: y_unit.into(),
            curves,
            ..Self::default()
        }
    }
}

/// Told apart by everybody; a dash more where two might be taken for one another in grey.
const PAINTS: [(&str, &[f64]); 6] = [
    (ink::BLUE, &[]),
    (ink::VERMILLION, &[]),
    (ink::GREEN, &[]),
    (ink::PURPLE, &[]),
    (ink::BLACK, &[7.0, 3.0]),
    (ink::ORANGE, &[7.0, 3.0]),
];

fn paint(run: usize) -> Paint {
    let (color, dash) = PAINTS[run % PAINTS.len()];
    Paint::line(color, 1.4).dashed(dash)
}

fn ends(curve: &OverlaidCurve) -> [f64; 2] {
    match &curve.along {
        Along::Even { first, step } => [*first, first + step * curve.values.len().saturating_sub(1) as f64],
        Along::At(places) => {
            let (lo, hi) = range(places.iter().copied()).unwrap_or((f64::NAN, f64::NAN));
            [lo, hi]
        }
    }
}

/// Values within the x axis.
fn shown(curve: &OverlaidCurve, (lo, hi): (f64, f64)) -> Vec<f64> {
    let place = |k: usize| match &curve.along {
        Along::Even { first, step } => first + step * k as f64,
        Along::At(places) => places.get(k).copied().unwrap_or(f64::NAN),
    };
    let inside = |(k, _): &(usize, &f64)| (lo..=hi).contains(&place(*k));
    let values = curve.values.iter().enumerate().filter(inside);
    values.map(|(_, value)| *value).collect()
}

/// The plot; `names` are those of the runs.
pub(crate) fn overlay<'a>(overlay: &'a Overlay, names: &'a [String], layout: Layout) -> Plot<'a> {
    let height = if layout.roomy() { 330.0 } else { 290.0 };
    plot(overlay, names, layout, height, None)
}

/// Values of a curve that the page keeps for zooming.
const KEPT: usize = 8192;

/// Marks of defect frequencies, in the colour of their run; in grey those of all.
fn lanes(overlay: &Overlay) -> Vec<Lane> {
    let of = overlay.marked.iter().copied().chain(std::iter::repeat(None));
    let color = |run: Option<usize>| run.map_or(ink::FAINT, |run| PAINTS[run % PAINTS.len()].0);
    let lanes = marker_lanes(&overlay.markers).into_iter().zip(of);
    lanes.map(|(lane, run)| Lane { color: color(run), ..lane }).collect()
}

/// Both axes; the upright one holds `common` too.
fn domains(overlay: &Overlay, common: Option<&[f64]>) -> (Domain, Domain) {
    let (lo, hi) = overlay.x_range.unwrap_or_else(|| range(overlay.curves.iter().flat_map(ends)).unwrap_or((0.0, 1.0)));
    let values: Vec<f64> = overlay
        .curves
        .iter()
        .flat_map(|curve| shown(curve, (lo, hi)))
        .chain(common.unwrap_or(&[]).iter().copied())
        .collect();
    let y = match overlay.vertical {
        Vertical::Around => Domain::around(values),
        Vertical::FromZero => Domain::from_zero(values),
        Vertical::Decades => Domain::decades(&values),
    };
    (Domain::exact(lo, hi), y)
}

/// Plots one below the other, each under its title, with the same axes for all where `alike`. A panel of one curve
/// needs no legend.
pub(crate) fn stacked(
    name: &str,
    title: &str,
    panels: &[Overlay],
    names: &[String],
    alike: bool,
    layout: Layout,
) -> Picture {
    let whole = (f64::NEG_INFINITY, f64::INFINITY);
    let of = |panel: &Overlay| {
        let range = panel.x_range.unwrap_or(whole);
        let values = panel.curves.iter().flat_map(move |c| shown(c, range));
        values.collect::<Vec<f64>>()
    };
    let all: Vec<f64> = panels.iter().flat_map(of).collect();
    let common = alike.then_some(all.as_slice());
    let along = range(panels.iter().flat_map(|p| p.curves.iter().flat_map(ends)));
    let size = layout.size(0.0);
    let mut picture = Picture::new(name, title, size.width, 0.0);
    let mut top = 2.0;
    for panel in panels {
        let words = font::fitted(&panel.title, size.font, true, size.width - 24.0);
        picture.text(Text::new(12.0, top + size.font, size.font, Anchor::Start, &words).bold());
        top += 1.5 * size.font;
        let panel = Overlay { x_range: panel.x_range.or(along.filter(|_| alike)), ..panel.clone() };
        let named = if panel.curves.len() > 1 { names } else { &[] };
        let drawn = plot(&panel, named, layout, 215.0, common).picture();
        let height = drawn.height;
        picture.place(drawn, 0.0, top);
        top += height + 6.0;
    }
    picture.height = top.max(1.0);
    picture
}

/// A plot of some height under its legend; its y axis holds `common` too.
fn plot<'a>(
    overlay: &'a Overlay,
    names: &'a [String],
    layout: Layout,
    height: f64,
    common: Option<&[f64]>,
) -> Plot<'a> {
    let (x, y) = domains(overlay, common);
    let lanes = lanes(overlay);
    let size = layout.size(height + 16.0 * lanes.len() as f64);
    let (name, title) = (&overlay.name, format!("{} over {}", overlay.y_label, overlay.x_label));
    let (x_label, y_label) = ((x, &*overlay.x_label, &*overlay.x_unit), (y, &*overlay.y_label, &*overlay.y_unit));
    let spec = Spec { lanes: lanes.clone(), ..Spec::new(name, &title, size, x_label, y_label) };
    let curve = |curve: &'a OverlaidCurve| {
        let full = paint(curve.of);
        Curve {
            name: names.get(curve.of).map_or("", String::as_str),
            along: curve.along.clone(),
            values: &curve.values,
            // What lies on top lets the lower ones shine through.
            paint: if curve.of > 0 { full.faded(0.8) } else { full },
        }
    };
    let values = overlay.curves.iter().flat_map(|c| shown(c, (x.lo, x.hi)));
    let entries = names.iter().enumerate();
    let entries = entries.filter(|(k, _)| overlay.curves.iter().any(|curve| curve.of == *k));
    Plot {
        peak: overlay.vertical != Vertical::Around,
        words: if range(values).is_none() { "Nothing to show" } else { "" },
        legend: entries.map(|(k, name)| (name.as_str(), paint(k))).collect(),
        velocity: overlay.vertical == Vertical::Decades && overlay.x_unit == "Hz",
        toggles: lanes,
        most: KEPT,
        ..Plot::new(spec, name, overlay.curves.iter().map(curve).collect())
    }
}
