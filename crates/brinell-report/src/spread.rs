//! The section of a page on what assumed values do to the levels: a table of bands, and the tornado of the first level.

use crate::frame::unit_html;
use crate::markup::escape;
use crate::number::short;
use crate::tables::rows;
use brinell_study::campaign::{Bar, Level};
use std::fmt::Write as _;

/// Bars of a tornado, at the most.
const SHOWN: usize = 12;
/// Sizes of the picture, in its own units: labels, bars, a row.
const LABELS: f64 = 260.0;
const WIDTH: f64 = 420.0;
const ROW: f64 = 22.0;

pub(crate) fn spread(page: &mut String, levels: &[Level]) {
    page.push_str(
        "<p>Every assumed value at both ends of its plausible range, one at a time. The band adds their changes as squares of logarithms; it is \
         no confidence interval, for the ranges are judgement.</p>\n",
    );
    if let Some(first) = levels.iter().find(|level| level.name.ends_with(".rms")) {
        tornado(page, first);
    }
    let row = |level: &Level| {
        let [low, high] = level.band.map(|x| short(x, 3));
        let first = level.bars.first().map_or("", |bar| &bar.key);
        let unit = if level.unit == "1" { String::new() } else { unit_html(&level.unit) };
        let code = |name: &str| format!("<code>{}</code>", escape(name));
        vec![code(&level.name), short(level.value, 4), low, high, unit, code(first)]
    };
    rows(page, &["Number", "#Value", "#From", "#To", "Unit", "Largest effect"], levels.iter().map(row));
}

/// Bars on a logarithmic axis from the least to the greatest value.
fn tornado(page: &mut String, level: &Level) {
    let bars = &level.bars[..level.bars.len().min(SHOWN)];
    let values = || bars.iter().flat_map(|bar| bar.at).flatten().chain([level.value]).chain(level.band);
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max));
    if bars.is_empty() || low >= high {
        return;
    }
    let x = |value: f64| LABELS + WIDTH * (value / low).ln() / (high / low).ln();
    let height = ROW * (bars.len() + 2) as f64;
    let _ = write!(
        page,
        "<svg class=\"tornado\" viewBox=\"0 0 {} {height}\" role=\"img\" aria-label=\"{} at both ends of assumed values\" \
         style=\"max-width:{}px;width:100%;font-size:12px\"><g fill=\"var(--text)\">",
        LABELS + WIDTH + 60.0,
        escape(&level.name),
        LABELS + WIDTH + 60.0
    );
    row(page, 0, "all together (band)", [level.band[0], level.band[1]], ("var(--warn)", &x));
    for (k, bar) in bars.iter().enumerate() {
        row(page, k + 1, &bar.key, ends(bar, level.value), ("var(--blue)", &x));
    }
    let (at, foot) = (x(level.value), ROW * (bars.len() + 1) as f64);
    let _ = writeln!(
        page,
        "<line x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"0\" y2=\"{foot}\" stroke=\"var(--ink)\"/>\
         <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{} {}</text></g></svg>",
        foot + 0.7 * ROW,
        short(level.value, 3),
        escape(&level.unit)
    );
}

/// Both ends of a bar, about the value.
fn ends(bar: &Bar, value: f64) -> [f64; 2] {
    let all = || bar.at.into_iter().flatten().chain([value]);
    [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)]
}

fn row(page: &mut String, k: usize, name: &str, [low, high]: [f64; 2], (colour, x): (&str, &dyn Fn(f64) -> f64)) {
    let (from, to, y) = (x(low), x(high), ROW * k as f64);
    let _ = write!(
        page,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text><rect x=\"{from:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{colour}\">\
         <title>{}: {} to {}</title></rect>",
        LABELS - 8.0,
        y + 0.65 * ROW,
        escape(name),
        y + 0.15 * ROW,
        (to - from).max(1.0),
        0.6 * ROW,
        escape(name),
        short(low, 3),
        short(high, 3)
    );
}
