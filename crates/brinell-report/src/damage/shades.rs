//! Depths as shades: the colours, the shaded picture and its bar.

use super::DepthPatch;
use crate::chart::Chart;
use crate::font;
use crate::number::significant;
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text};

/// Undamaged to deepest.
pub(super) const SHADES: [&str; 8] =
    ["#fbe3cb", "#f8c99c", "#f2aa6b", "#e78a42", "#d46a22", "#b34e12", "#8a380b", "#602506"];
/// Raised edges.
const RAISED: &str = "#9fd0ee";
/// Side of a shaded cell, px.
const CELL: f64 = 1.4;
/// Less than this share of the largest depth is round-off.
pub(super) const LEAST: f64 = 1e-3;

/// Depths as nested steps of colour, interpolated between nodes; returns them.
pub(super) fn shade(
    chart: &mut Chart,
    patch: &DepthPatch,
    [first, last, low, high]: [f64; 4],
    clipped: impl Fn(Vec<Vec<(f64, f64)>>, bool, Paint) -> Shape,
) -> Vec<f64> {
    let columns = patch.columns;
    let rows = patch.depth_um.len().checked_div(columns).unwrap_or(0);
    let finite: Vec<f64> = patch.depth_um.iter().map(|h| if h.is_finite() { *h } else { 0.0 }).collect();
    let deepest = finite.iter().copied().fold(0.0, f64::max);
    let (left, right) = (chart.x.at(first), chart.x.at(last));
    let (top, bottom) = (chart.y.at(high), chart.y.at(low));
    if columns < 2 || rows < 2 || right - left < 0.5 || bottom - top < 0.5 {
        return finite;
    }
    let across = ((right - left) / CELL).ceil().clamp(1.0, 600.0) as usize;
    let down = ((bottom - top) / CELL).ceil().clamp(1.0, 400.0) as usize;
    let (wide, high) = ((right - left) / across as f64, (bottom - top) / down as f64);
    let depth = |i: usize, j: usize| {
        let u = (i as f64 + 0.5) / across as f64 * (columns - 1) as f64;
        let v = (1.0 - (j as f64 + 0.5) / down as f64) * (rows - 1) as f64;
        let (c, r) = ((u as usize).min(columns - 2), (v as usize).min(rows - 2));
        let (u, v) = (u - c as f64, v - r as f64);
        let node = |dr: usize, dc: usize| finite[(r + dr) * columns + c + dc];
        (node(0, 0) * (1.0 - u) + node(0, 1) * u) * (1.0 - v) + (node(1, 0) * (1.0 - u) + node(1, 1) * u) * v
    };
    let cells: Vec<f64> = (0..down).flat_map(|j| (0..across).map(move |i| (i, j))).map(|(i, j)| depth(i, j)).collect();
    // Each shade lies over the lighter one, a little wider than its cells: no seams.
    let mut layer = |color: &'static str, shown: &dyn Fn(f64) -> bool| {
        let mut runs = vec![];
        for j in 0..down {
            let row = &cells[j * across..(j + 1) * across];
            let mut i = 0;
            while i < across {
                let from = i;
                while i < across && shown(row[i]) {
                    i += 1;
                }
                if i > from {
                    let x = |i: usize| left + wide * i as f64;
                    let (a, b) = (x(from) - 0.3, x(i) + 0.3);
                    let (c, d) = (top + high * j as f64 - 0.3, top + high * (j + 1) as f64 + 0.3);
                    runs.push(vec![(a, c), (b, c), (b, d), (a, d)]);
                }
                i = i.max(from + 1);
            }
        }
        if !runs.is_empty() {
            let path = clipped(runs, true, Paint::fill(color, 1.0));
            chart.picture.shapes.push(path);
        }
    };
    let least = LEAST * deepest.max(finite.iter().map(|h| h.abs()).fold(0.0, f64::max));
    layer(RAISED, &|h| h < -least);
    for (k, color) in SHADES.iter().enumerate() {
        let from = deepest * k as f64 / SHADES.len() as f64;
        layer(color, &|h| h > from.max(least));
    }
    finite
}

/// The shades with their depths; returns the height used.
pub(super) fn colour_bar(
    picture: &mut Picture,
    deepest: f64,
    raised: Option<f64>,
    (left, right_end): (f64, f64),
    top: f64,
    font: f64,
) -> f64 {
    let swatch = 1.5 * font;
    let mut base = top + font;
    let text = |x: f64, base: f64, words: &str| Text::new(x, base, font, Anchor::Start, words);
    picture.text(text(left, base, "depth 0"));
    let mut x = left + font::width("depth 0", font, false) + 6.0;
    for color in SHADES {
        let (right, bottom) = (x + swatch, base + 1.0);
        let rect = Rect { left: x, top: base - 0.8 * font, right, bottom };
        picture.rect(rect, Paint::fill(color, 1.0));
        x = right;
    }
    let words = format!("{} µm", significant(deepest, 3));
    picture.text(text(x + 6.0, base, &words));
    x += font::width(&words, font, false) + 30.0;
    if let Some(height) = raised {
        let words = format!("raised, up to {} µm", significant(height, 3));
        if x + swatch + 6.0 + font::width(&words, font, false) > right_end {
            x = left;
            base += 1.6 * font;
        }
        let rect = Rect { left: x, top: base - 0.8 * font, right: x + swatch, bottom: base + 1.0 };
        picture.rect(rect, Paint::fill(RAISED, 1.0));
        picture.text(text(x + swatch + 6.0, base, &words));
    }
    base - top + 0.9 * font
}
