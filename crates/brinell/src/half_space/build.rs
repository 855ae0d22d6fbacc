//! A table from geometry and damage: deformations, the solutions along s at each, and how they are joined (section 19).

use super::error::BuildError;
use super::geometry::Geometry;
use super::level::{self, Fineness, Level, Place};
use super::onset::Onset;
use super::raster::Raster;
use crate::effective::spline;
use crate::effective::table::{FEWEST_NODES, Table, TableError};
use crate::scenario::Tables;
use brinell_signal::parallel;
use std::cell::LazyCell;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

/// Deformations that a table covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Heaviest static deformation, m: nodes of delta begin at a part of it.
    pub static_deflection: f64,
    /// Largest delta, m: beyond, the table is straight.
    pub largest: f64,
}

impl Range {
    /// Up to four times the static deformation, at least 10 um.
    pub fn of(static_deflection: f64) -> Self {
        Self { static_deflection, largest: (4.0 * static_deflection).max(10e-6) }
    }
}

/// A table and what it took.
#[derive(Debug, Clone, PartialEq)]
pub struct Built {
    /// The table.
    pub table: Table,
    /// Contacts that were solved, on either grid.
    pub solutions: usize,
    /// Convolutions of all of them.
    pub convolutions: usize,
}

impl Tables {
    pub(super) fn fineness(self) -> Fineness {
        match self {
            Self::Standard => {
                Fineness { along: 8.0, rows: 40, tolerance: 8e-4, between: [1.5e-3, 5e-3], refinement: 1 }
            }
            Self::Coarse => Fineness { along: 5.0, rows: 24, tolerance: 1e-3, between: [5e-3, 2e-2], refinement: 1 },
            Self::Quick => Fineness { along: 3.0, rows: 10, tolerance: 1e-2, between: [2e-2, 1e-1], refinement: 1 },
        }
    }

    /// Ratio of deformations that follow each other.
    fn ratio(self) -> f64 {
        match self {
            Self::Standard => 1.5,
            Self::Coarse => 1.7,
            Self::Quick => 2.5,
        }
    }
}

/// Nodes of delta: without a rim 0, then equal ratios from a tenth of the static deformation on; under a rim of the height `raised`
/// squares of equal steps from -H on, where contact begins.
pub fn deformations(range: &Range, raised: f64, accuracy: Tables) -> Vec<f64> {
    if raised > 0.0 {
        let steps = match accuracy {
            Tables::Standard => 22,
            Tables::Coarse => 14,
            Tables::Quick => 8,
        };
        let square = |k: i32| (f64::from(k) / f64::from(steps)).powi(2);
        return (0..=steps).map(|k| -raised + (range.largest + raised) * square(k)).collect();
    }
    let first = (0.1 * range.static_deflection).min(0.1 * range.largest);
    let steps = ((range.largest / first).ln() / accuracy.ratio().ln()).ceil().max(3.0) as i32;
    let node = |k: i32| range.largest * (first / range.largest).powf(f64::from(steps - k) / f64::from(steps));
    std::iter::once(0.0).chain((0..=steps).map(node)).collect()
}

/// The table of a damaged surface under a contact. Threads change how long it takes, not one bit of it; once `stop` is set it ends soon.
///
/// # Errors
/// Where lengths make no contact, or `stop` was set.
pub fn table(
    geometry: &Geometry,
    raster: &Raster,
    range: &Range,
    accuracy: Tables,
    threads: NonZeroUsize,
    stop: &AtomicBool,
) -> Result<Built, BuildError> {
    let lengths = [
        ("R_x", geometry.along),
        ("half the contact's width across", geometry.half_across(1e-6)),
        ("the static deformation", range.static_deflection),
        ("the largest deformation", range.largest),
    ];
    if let Some((what, value)) = lengths.into_iter().find(|(_, x)| !(x.is_finite() && *x > 0.0)) {
        return Err(BuildError::NotPositive { what, value });
    }
    refined_table(geometry, raster, range, (accuracy, 1), threads, stop)
}

/// As [`table()`], with grid and nodes finer than the class's own by a power of two: what shows that nothing hangs on them.
///
/// # Errors
/// As [`table()`].
pub fn refined_table(
    geometry: &Geometry,
    raster: &Raster,
    range: &Range,
    (accuracy, refinement): (Tables, u32),
    threads: NonZeroUsize,
    stop: &AtomicBool,
) -> Result<Built, BuildError> {
    let mut delta = deformations(range, raster.raised(), accuracy);
    for _ in 0..refinement.ilog2() {
        delta = halved(&delta);
    }
    let own = accuracy.fineness();
    let shrink = f64::from(refinement.pow(4));
    let between = own.between.map(|error| error / shrink);
    let fineness = Fineness { tolerance: own.tolerance / f64::from(refinement), between, refinement, ..own };
    levels(geometry, raster, &delta, &fineness, threads, stop)
}

/// With a node in the middle of every two: the geometric one, but the arithmetic one where either is at or below 0.
fn halved(delta: &[f64]) -> Vec<f64> {
    let middle = |w: &[f64]| if w[0] > 0.0 { (w[0] * w[1]).sqrt() } else { 0.5 * (w[0] + w[1]) };
    let mut all: Vec<f64> = delta.windows(2).flat_map(|w| [w[0], middle(w)]).collect();
    all.extend(delta.last());
    all
}

/// As [`table()`], with nodes at the given rising delta (m): at the first nothing touches.
///
/// # Errors
/// Where the solutions make no table, or `stop` was set.
pub fn table_at(
    geometry: &Geometry,
    raster: &Raster,
    delta: &[f64],
    accuracy: Tables,
    threads: NonZeroUsize,
    stop: &AtomicBool,
) -> Result<Built, BuildError> {
    levels(geometry, raster, delta, &accuracy.fineness(), threads, stop)
}

fn levels(
    geometry: &Geometry,
    raster: &Raster,
    delta: &[f64],
    fineness: &Fineness,
    threads: NonZeroUsize,
    stop: &AtomicBool,
) -> Result<Built, BuildError> {
    let levels = parallel::map(delta.len() - 1, threads, |k| {
        // The deepest first: they take longest.
        level::solve(geometry, raster, delta[delta.len() - 1 - k], fineness, stop)
    });
    if stop.load(Ordering::Relaxed) {
        return Err(BuildError::Stopped);
    }
    let levels = levels.into_iter().collect::<Result<Vec<_>, _>>()?;
    let [solutions, convolutions] = [0, 1].map(|k| levels.iter().map(|level| level.work[k]).sum());
    // Asked for only where the deepest level leaves a place untouched.
    let onset = LazyCell::new(|| Onset::new(geometry, raster));
    Ok(Built { table: join(delta, levels, |s| onset.at(s))?, solutions, convolutions })
}

/// A level as splines along s.
struct Spline {
    s: Vec<f64>,
    /// Values and slopes, each with its second derivatives along s.
    fields: [[Vec<f64>; 2]; 2],
    delta: f64,
}

impl Spline {
    fn new(delta: f64, places: &[Place]) -> Self {
        let s: Vec<f64> = places.iter().map(|place| place.s).collect();
        let field = |of: fn(&Place) -> f64| {
            let y: Vec<f64> = places.iter().map(of).collect();
            let second = spline::curvatures(&s, &y);
            [y, second]
        };
        let fields = [field(|place| place.value), field(|place| place.slope)];
        Self { s, fields, delta }
    }

    /// Value and slope at s; healthy beyond.
    fn at(&self, s: f64) -> [f64; 2] {
        if s < self.s[0] || s > self.s[self.s.len() - 1] {
            return [self.delta, 1.0];
        }
        self.fields.each_ref().map(|[y, second]| spline::value(&self.s, y, second, s))
    }
}

/// Joins the levels (the deepest first) to a table. Where nothing touches, delta_eff goes on straight in delta from the level above; from
/// the deepest on to `onset`, delta_0(s).
fn join(delta: &[f64], levels: Vec<Level>, onset: impl Fn(f64) -> f64) -> Result<Table, TableError> {
    let mut s: Vec<f64> = levels.iter().flat_map(|level| level.places.iter().map(|place| place.s)).collect();
    s.sort_by(f64::total_cmp);
    s.dedup();
    let s = thinned(s, delta.len());
    let mut splines: Vec<Spline> = Vec::with_capacity(levels.len());
    for level in levels {
        let mut places = level.places;
        for place in places.iter_mut().filter(|place| !place.touches) {
            (place.value, place.slope) = match splines.last() {
                // At a floor in reach of rounding nothing may touch yet.
                None => ((level.delta - onset(place.s)).min(0.0), 1.0),
                Some(above) => {
                    let [value, slope] = above.at(place.s);
                    (value - slope * (above.delta - level.delta), slope)
                }
            };
        }
        splines.push(Spline::new(level.delta, &places));
    }
    let n = delta.len();
    let (mut values, mut slopes) = (vec![0.0; s.len() * n], vec![0.0; s.len() * n]);
    let mut lowest = Vec::with_capacity(s.len());
    for (row, s) in s.iter().enumerate() {
        let (values, slopes) = (&mut values[row * n..(row + 1) * n], &mut slopes[row * n..(row + 1) * n]);
        for (k, level) in splines.iter().enumerate() {
            [values[n - 1 - k], slopes[n - 1 - k]] = level.at(*s);
        }
        let first = (1..n).find(|k| values[*k] > 0.0).unwrap_or(n - 1);
        for k in 0..first {
            values[k] = values[first] - slopes[first] * (delta[first] - delta[k]);
            slopes[k] = slopes[first];
        }
        lowest.push(first);
    }
    Table::from_slopes((&s, delta), &values, &slopes, &lowest)
}

/// Without every other of the finest steps, as often as it takes for a table to be allowed.
fn thinned(mut s: Vec<f64>, deformations: usize) -> Vec<f64> {
    let most = crate::effective::table::MOST_NODES / deformations.max(1);
    while s.len() > most.max(FEWEST_NODES) {
        let finest = s.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        // Powers of two times whole numbers: the remainders are exact.
        s.retain(|s| s % (2.0 * finest) == 0.0);
    }
    s
}
