//! Slices of a depth map: what it covers of each and how deep, at a point and along the envelope (section 3).
//!
//! Between four nodes of the grid the surface is damaged unless all four are 0. Depths are straight along z there, so
//! the mean at a point is exact; the mean of envelopes is a sum over lines z = const, by Gauss's rule between the rows
//! of the grid.

use super::envelope::envelope;
use super::extent::{Extent, slice_borders};
use super::grid::Grid;
use super::piecewise::PiecewisePolynomial;
use super::track::{Part, Track};

/// Lines z = const in a slice at the most.
const MOST_LINES: usize = 12;
/// Pieces of all lines that a map may take.
const MOST_PIECES: usize = 1_000_000;

/// Gauss's rules on 0..1: points and weights.
pub(super) const GAUSS: [&[[f64; 2]]; 3] = [
    &[[0.5, 1.0]],
    &[[0.211_324_865_405_187_1, 0.5], [0.788_675_134_594_812_9, 0.5]],
    &[[0.112_701_665_379_258_3, 5.0 / 18.0], [0.5, 8.0 / 18.0], [0.887_298_334_620_741_7, 5.0 / 18.0]],
];

/// Along the arc for every slice, at a point: phi_k the same and h_k straight between two columns.
pub(super) fn at_a_point(grid: &Grid, slices: usize, extent: Extent) -> Vec<Track> {
    let tracks = (0..slices).filter_map(|k| {
        let [low, high] = slice_borders(k, slices, extent);
        let cells = grid.rows_within(low, high);
        let mut parts = Vec::with_capacity(grid.columns());
        for column in 0..grid.columns() - 1 {
            let (covered, [from, to]) = section(grid, column, &cells);
            parts.push(if covered > 0.0 {
                let (from, to) = (from / covered, to / covered);
                Part {
                    start: grid.s(column),
                    phi: [covered / (high - low), 0.0, 0.0, 0.0],
                    h: [from, (to - from) / grid.step(), 0.0, 0.0],
                }
            } else {
                Part::nothing(grid.s(column))
            });
        }
        trimmed(k, parts, grid.s(grid.columns() - 1))
    });
    tracks.collect()
}

/// What is damaged of some z between two columns (m), and the sections of damage at both (m^2).
fn section(grid: &Grid, column: usize, cells: &[(usize, [f64; 2])]) -> (f64, [f64; 2]) {
    let (mut covered, mut sections) = (0.0, [0.0; 2]);
    for &(row, [a, b]) in cells {
        if grid.is_damaged(column, row) {
            covered += b - a;
            for (k, section) in sections.iter_mut().enumerate() {
                *section += (b - a) * grid.between_rows(column + k, row, 0.5 * (a + b));
            }
        }
    }
    (covered, sections)
}

/// Without what is undamaged at both ends.
fn trimmed(slice: usize, mut parts: Vec<Part>, last: f64) -> Option<Track> {
    let covers = |p: &Part| p.phi != [0.0; 4];
    let end = parts.iter().rposition(covers)? + 1;
    let last = parts.get(end).map_or(last, |p| p.start);
    parts.truncate(end);
    parts.drain(..parts.iter().position(covers)?);
    Track::new(slice, 1.0, parts, last)
}

/// One line z = const of a slice.
struct Along {
    weight: f64,
    damaged: Vec<[f64; 2]>,
    envelope: PiecewisePolynomial,
}

/// Along the arc for every slice, on the envelope for the relative radius `radius` (m).
///
/// A raised edge lifts the roller before its line of contact is on damage: what it lifts counts as covered, so that the
/// force has no jump there.
pub(super) fn along_the_envelope(grid: &Grid, slices: usize, extent: Extent, radius: f64) -> Vec<Track> {
    let most = MOST_PIECES / (2 * grid.columns() * slices);
    let most = most.clamp(1, MOST_LINES);
    let columns: Vec<f64> = (0..grid.columns()).map(|c| grid.s(c)).collect();
    let tracks = (0..slices).filter_map(|k| {
        let [low, high] = slice_borders(k, slices, extent);
        let cells = grid.rows_within(low, high);
        let lines: Vec<Along> = places(&cells, [low, high], most)
            .into_iter()
            .map(|[z, weight]| {
                let lines = grid.along(z);
                Along {
                    weight,
                    damaged: lines.iter().map(|l| [l.from, l.to]).collect(),
                    envelope: envelope(&lines, radius),
                }
            })
            .collect();
        let covered: Vec<f64> = (0..grid.columns() - 1).map(|column| section(grid, column, &cells).0).collect();
        let mut stops: Vec<f64> = lines.iter().flat_map(|l| l.envelope.breakpoints()).collect();
        stops.extend(&columns);
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|b, a| *b - *a < 1e-13);
        let mut parts = Vec::with_capacity(stops.len());
        for pair in stops.windows(2) {
            let (from, middle) = (pair[0], 0.5 * (pair[0] + pair[1]));
            let column = columns.partition_point(|s| *s <= middle);
            let mut phi = column.checked_sub(1).and_then(|c| covered.get(c)).map_or(0.0, |x| x / (high - low));
            let (mut weight, mut sum) = (0.0, [0.0; 3]);
            for line in &lines {
                let c = line.envelope.quadratic(middle);
                let at = line.damaged.partition_point(|d| d[1] <= middle);
                let damaged = line.damaged.get(at).is_some_and(|d| d[0] <= middle);
                if !damaged {
                    if c[0] >= 0.0 {
                        continue;
                    }
                    phi += line.weight;
                }
                weight += line.weight;
                for (sum, c) in sum.iter_mut().zip(c) {
                    *sum += line.weight * c;
                }
            }
            if phi <= 0.0 {
                parts.push(Part::nothing(from));
                continue;
            }
            let c = sum.map(|x| if weight > 0.0 { x / weight } else { 0.0 });
            let x = from - middle;
            parts.push(Part {
                start: from,
                phi: [phi.min(1.0), 0.0, 0.0, 0.0],
                h: [c[0] + x * (c[1] + x * c[2]), c[1] + 2.0 * x * c[2], c[2], 0.0],
            });
        }
        trimmed(k, parts, *stops.last()?)
    });
    tracks.collect()
}

/// z of lines within a slice with the share of its width that each represents: Gauss's points between rows where they
/// are few, else equal parts.
fn places(cells: &[(usize, [f64; 2])], [low, high]: [f64; 2], most: usize) -> Vec<[f64; 2]> {
    let each = most / cells.len().max(1);
    if each == 0 {
        let at = |k: usize| low + (k as f64 + 0.5) / most as f64 * (high - low);
        return (0..most).map(|k| [at(k), 1.0 / most as f64]).collect();
    }
    let rule = GAUSS[each.min(GAUSS.len()) - 1];
    let panels = each / rule.len();
    let mut places = Vec::with_capacity(most);
    for &(_, [a, b]) in cells {
        let wide = (b - a) / panels as f64;
        for panel in 0..panels {
            let at = |[x, w]: &[f64; 2]| [a + (panel as f64 + x) * wide, w * wide / (high - low)];
            places.extend(rule.iter().map(at));
        }
    }
    places
}
