//! One deformation delta of a table: the damaged contact solved along s, in steps as fine as it changes.
//!
//! Cells are fixed to the surface and s goes in whole cells, so that the energy has no ripple along s. Two grids, one of cells twice as
//! large: at sharp edges the error is of first order in the cell, and both together extrapolate to none.

use super::error::BuildError;
use super::geometry::Geometry;
use super::healthy::Energies;
use super::influence::{Cells, Influence};
use super::raster::{Cell, Raster, Seen};
use super::solver::{Contact, Pressed};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::atomic::{AtomicBool, Ordering};

/// Settings of a class of accuracy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fineness {
    /// Cells to half the contact's width, at the least; up to twice as many, so that steps of all deformations nest.
    pub(super) along: f64,
    /// Rows from z = 0 to where bodies would overlap.
    pub(super) rows: usize,
    /// Residual gaps over delta.
    pub(super) tolerance: f64,
    /// What a cubic through four places may miss half-way between two, for these not to be halved again: of delta_eff over delta, and of its slope. What is
    /// left after that halving is a sixteenth.
    pub(super) between: [f64; 2],
    /// By how much grid and steps are finer than the class's own, to show that nothing hangs on them.
    pub(super) refinement: u32,
}

/// delta_eff at one place, and its slope in delta.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) s: f64,
    pub(super) value: f64,
    pub(super) slope: f64,
    /// Whether the contact presses at all.
    pub(super) touches: bool,
}

/// delta_eff of one deformation along s, rising.
#[derive(Debug, Clone)]
pub(super) struct Level {
    pub(super) delta: f64,
    pub(super) places: Vec<Place>,
    /// Solutions and convolutions that it took.
    pub(super) work: [usize; 2],
}

/// One of the two grids.
pub(super) struct Grid {
    pub(super) influence: Influence,
    /// The same over some of the columns, rising: where contacts are narrow, most of the window carries nothing.
    narrow: Vec<Influence>,
    /// Cells to either side of the contact's middle.
    half: usize,
    /// Gap of the healthy contact.
    gap: Vec<f64>,
    energies: Energies,
    /// Which column of the surface lies where, from `first` on, in cells from s = 0.
    first: i64,
    columns: Vec<usize>,
    /// What the cells of each different column see.
    kinds: Vec<Vec<Seen>>,
}

/// Share of delta below which a contact's energy stands for nothing but a cell or two.
const LEAST: f64 = 0.01;
/// Slope of delta_eff in delta beyond which a place of damage that rises nowhere counts as not touching: on floors and beside pits it is near 1.
const STEEPEST: f64 = 4.0;
/// Columns of narrow windows over half of those of the whole one, and their least number.
const NARROW: [f64; 4] = [0.35, 0.55, 0.85, 1.25];
const LEAST_COLUMNS: usize = 8;
/// Columns beside those that press in a narrow window.
const MARGIN: usize = 2;
/// Halvings of the steps along s, from eight times half the contact's width to a quarter of it; one more for each doubling of the grid.
const HALVINGS: u32 = 5;
/// First steps along all s that see damage, at the least.
const LEAST_STEPS: u64 = 8;

/// The cell along s (m) at a deformation whose contact has this half-width: a power of two, so that steps of all deformations nest.
pub(super) fn cell_length(half_width: f64, fineness: &Fineness) -> f64 {
    2f64.powi((half_width / (fineness.along * f64::from(fineness.refinement))).log2().floor() as i32)
}

impl Grid {
    /// Over all of the surface's damage; `half` cells to either side of the contact's middle.
    ///
    /// # Errors
    /// [`BuildError::TooFine`].
    pub(super) fn new(
        geometry: &Geometry,
        raster: &Raster,
        delta: f64,
        cell: [f64; 2],
        half: usize,
        fine: &Fineness,
    ) -> Result<Self, BuildError> {
        let [dx, dz] = cell;
        let raised = raster.raised();
        let mirrored = geometry.is_mirrored(raster);
        let half_rows = (geometry.half_across(delta + raised) / dz).round().max(1.0) as usize;
        let across = if mirrored { half_rows } else { 2 * half_rows };
        let cells = |along: usize| Cells { along, across, aspect: dz / dx, mirrored };
        let influence = Influence::new(cells(2 * half));
        let narrow = NARROW.map(|share| (share * half as f64).ceil() as usize);
        let narrow =
            narrow.into_iter().filter(|along| *along >= LEAST_COLUMNS).map(|along| Influence::new(cells(along)));
        let narrow = narrow.collect();
        let z = |row: usize| if mirrored { row as f64 * dz } else { (row as f64 - half_rows as f64) * dz };
        let gap: Vec<f64> = (0..2 * half * across)
            .map(|k| {
                let x = ((k % (2 * half)) as f64 - half as f64 + 0.5) * dx;
                let row = k / (2 * half);
                geometry.gap(x, [z(row), z(row + 1)])
            })
            .collect();
        let mut contact = Contact::new(&influence);
        let soft = vec![0.0; gap.len()];
        let energies = Energies::new(&mut contact, &gap, &soft, delta + raised, fine.tolerance);
        let reach = raster.reach().s;
        let first = (reach[0] / dx).floor() as i64 - 1;
        let last = (reach[1] / dx).ceil() as i64 + 1;
        let half_width = geometry.half_width(delta + raised);
        let levelled = 0.5 * half_width * dx / geometry.along;
        let (mut kinds, mut columns): (Vec<Vec<Seen>>, Vec<usize>) = (vec![vec![Seen::default(); across]], Vec::new());
        // Where columns of a hash are among the kinds, which hold what is compared.
        let mut known: HashMap<u64, Vec<usize>> = HashMap::new();
        let hash = |column: &[Seen]| {
            let mut hasher = DefaultHasher::new();
            column.iter().for_each(|seen| [seen.depth, seen.soft].map(f64::to_bits).hash(&mut hasher));
            hasher.finish()
        };
        known.insert(hash(&kinds[0]), vec![0]);
        for k in first..last {
            let s = [k as f64 * dx, (k + 1) as f64 * dx];
            let column: Vec<Seen> = (0..across)
                .map(|row| raster.seen(&Cell { s, z: [z(row), z(row + 1)], levelled, half_width, deepest: delta }))
                .collect();
            let alike = known.entry(hash(&column)).or_default();
            let kind = alike.iter().find(|kind| kinds[**kind] == column).copied().unwrap_or_else(|| {
                alike.push(kinds.len());
                kinds.push(column);
                kinds.len() - 1
            });
            columns.push(kind);
            if kinds.len() * across > MOST_CELLS {
                return Err(BuildError::TooFine { reached: s[1] - reach[0], delta });
            }
        }
        Ok(Self { influence, narrow, half, gap, energies, first, columns, kinds })
    }

    /// Columns under a contact whose middle lies before cell `middle`.
    pub(super) fn window(&self, middle: i64) -> Vec<usize> {
        let half = self.half as i64;
        (middle - half..middle + half)
            .map(|k| usize::try_from(k - self.first).ok().and_then(|k| self.columns.get(k)).copied().unwrap_or(0))
            .collect()
    }

    /// Gaps and softness under a window of columns.
    fn over(&self, window: &[usize], gap: &mut [f64], soft: &mut [f64]) {
        let along = window.len();
        for (k, (gap, soft)) in gap.iter_mut().zip(soft).enumerate() {
            let seen = self.kinds[window[k % along]][k / along];
            *gap = self.gap[k] + seen.depth;
            *soft = seen.soft;
        }
    }
}

/// A contact with the room for its gaps.
pub(super) struct Presser<'a> {
    grid: &'a Grid,
    pub(super) contact: Contact<'a>,
    narrow: Vec<Contact<'a>>,
    gap: Vec<f64>,
    soft: Vec<f64>,
    /// Gaps and softness of a narrow window.
    cut: [Vec<f64>; 2],
}

/// Pressures that a place was solved with.
type Solved = Vec<f32>;

impl<'a> Presser<'a> {
    pub(super) fn new(grid: &'a Grid) -> Self {
        let zeros = || vec![0.0; grid.gap.len()];
        let contact = Contact::new(&grid.influence);
        let narrow = grid.narrow.iter().map(Contact::new).collect();
        Self { grid, contact, narrow, gap: zeros(), soft: zeros(), cut: [zeros(), zeros()] }
    }

    /// Starts with the mean of two places.
    fn begin_between(&mut self, [a, b]: [&Solved; 2]) {
        for (p, (a, b)) in self.contact.p.iter_mut().zip(a.iter().zip(b)) {
            *p = 0.5 * (f64::from(*a) + f64::from(*b));
        }
    }

    /// Starts with the pressures of a grid whose cells are twice as large; with what this grid's have beyond them in the mean of two places beside, each
    /// given by the coarse and the fine pressures.
    fn begin_with(&mut self, coarse: &Contact<'_>, beside: Option<[&[Solved; 2]; 2]>) {
        let along = 2 * self.grid.half;
        for (k, p) in self.contact.p.iter_mut().enumerate() {
            // Half the pressure's unit, which is of a cell's length.
            let below = k / along / 2 * (along / 2) + k % along / 2;
            *p = 0.5 * coarse.p[below];
            if let Some(beside) = beside {
                let more: f32 = beside.iter().map(|[coarse, fine]| fine[k] - 0.5 * coarse[below]).sum();
                *p = (*p + 0.5 * f64::from(more)).max(0.0);
            }
        }
    }

    /// Presses what a window sees: first, where few columns press in what it begins with, these alone.
    pub(super) fn pressed(&mut self, window: &[usize], delta: f64, tolerance: f64) -> Pressed {
        self.grid.over(window, &mut self.gap, &mut self.soft);
        let within = self.press_narrow(delta, tolerance);
        let pressed = self.contact.press(&self.gap, &self.soft, delta, tolerance);
        Pressed { convolutions: within + pressed.convolutions, ..pressed }
    }

    /// Presses some of the columns and leaves their pressures as the start of all; the convolutions that it took.
    fn press_narrow(&mut self, delta: f64, tolerance: f64) -> usize {
        let along = 2 * self.grid.half;
        let presses = |column: &usize| self.contact.p[*column..].iter().step_by(along).any(|p| *p > 0.0);
        let (Some(first), Some(last)) = ((0..along).find(presses), (0..along).rev().find(presses)) else {
            return 0;
        };
        let wanted = last + 1 - first + 2 * MARGIN;
        let Some(narrow) = self.grid.narrow.iter().position(|influence| influence.cells().along >= wanted) else {
            return 0;
        };
        let columns = self.grid.narrow[narrow].cells().along;
        let narrow = &mut self.narrow[narrow];
        let first = ((first + last + 1).saturating_sub(columns) / 2).min(along - columns);
        let cut = |from: &[f64], to: &mut Vec<f64>| {
            to.clear();
            to.extend(from.chunks_exact(along).flat_map(|row| &row[first..first + columns]));
        };
        cut(&self.gap, &mut self.cut[0]);
        cut(&self.soft, &mut self.cut[1]);
        cut(&self.contact.p, &mut narrow.p);
        let pressed = narrow.press(&self.cut[0], &self.cut[1], delta, tolerance);
        for (all, own) in self.contact.p.chunks_exact_mut(along).zip(narrow.p.chunks_exact(columns)) {
            all[first..first + columns].copy_from_slice(own);
        }
        pressed.convolutions
    }

    /// Its pressures, kept.
    fn solved(&self) -> Solved {
        self.contact.p.iter().map(|p| *p as f32).collect()
    }

    /// delta_eff, its slope, and the convolutions that it took. 0 where nothing touches.
    fn press(&mut self, window: &[usize], delta: f64, tolerance: f64) -> ([f64; 2], usize) {
        let pressed = self.pressed(window, delta, tolerance);
        if pressed.energy <= 0.0 {
            return ([0.0; 2], pressed.convolutions);
        }
        let (effective, force) = self.grid.energies.at_energy(pressed.energy);
        ([effective, pressed.force / force], pressed.convolutions)
    }
}

/// Bytes of pressures that are kept as starts for the places between, at the most; what comes after starts from its coarser grid alone.
const MOST_KEPT: usize = 20 << 20;
/// Cells of all different columns of a grid, at the most: 64 MB.
const MOST_CELLS: usize = 4 << 20;

/// Solves one deformation along all s that see damage. Once `stop` is set the rest counts as healthy.
///
/// # Errors
/// [`BuildError::TooFine`].
pub(super) fn solve(
    geometry: &Geometry,
    raster: &Raster,
    delta: f64,
    fineness: &Fineness,
    stop: &AtomicBool,
) -> Result<Level, BuildError> {
    let raised = raster.raised();
    let cell = cell_length(geometry.half_width(delta + raised), fineness);
    let least = LEAST * (delta + raised);
    // Whole cells of the coarser grid to either side.
    let half = ((geometry.reach(delta + raised) / (2.0 * cell)).ceil() as usize).max(2);
    let rows = fineness.refinement as usize * geometry.rows(raster, delta + raised, fineness.rows);
    let dz = geometry.half_across(delta + raised) / (2 * rows) as f64;
    let grids = [
        Grid::new(geometry, raster, delta, [2.0 * cell, 2.0 * dz], half, fineness)?,
        Grid::new(geometry, raster, delta, [cell, dz], 2 * half, fineness)?,
    ];
    let mut pressers = grids.each_ref().map(Presser::new);
    let mut known: HashMap<Vec<usize>, Place> = HashMap::new();
    let mut solved: HashMap<i64, [Solved; 2]> = HashMap::new();
    let mut work = [0; 2];
    let healthy = Place { s: 0.0, value: delta, slope: 1.0, touches: delta > 0.0 };
    let mut at = |k: i64, step: i64| -> Place {
        let s = k as f64 * 2.0 * cell;
        let window = grids[1].window(2 * k);
        if window.iter().all(|kind| *kind == 0) || stop.load(Ordering::Relaxed) {
            return Place { s, ..healthy };
        }
        let mut key = window.clone();
        key.reverse();
        if window < key {
            key.clone_from(&window);
        }
        if let Some(place) = known.get(&key) {
            return Place { s, ..*place };
        }
        let windows = [grids[0].window(k), window];
        let mut found = [[0.0; 2]; 2];
        let beside = solved.get(&(k - step)).zip(solved.get(&(k + step))).map(|(a, b)| [a, b]);
        let [coarse, fine] = &mut pressers;
        let mut convolutions = [0; 2];
        if let Some([a, b]) = beside {
            coarse.begin_between([&a[0], &b[0]]);
        }
        (found[0], convolutions[0]) = coarse.press(&windows[0], delta, fineness.tolerance);
        fine.begin_with(&coarse.contact, beside);
        (found[1], convolutions[1]) = fine.press(&windows[1], delta, fineness.tolerance);
        let pressures = [coarse.solved(), fine.solved()];
        let bytes = 4 * (pressures[0].len() + pressures[1].len());
        if (solved.len() + 1) * bytes <= MOST_KEPT {
            solved.insert(k, pressures);
        }
        work[0] += 2;
        work[1] += convolutions[0] + convolutions[1];
        let [coarse, fine] = found;
        // Of energies near nothing the healthy force is not known: their slopes may come out a hundred times too steep.
        let sound = |[value, slope]: [f64; 2]| value > least && (raised > 0.0 || (0.0..STEEPEST).contains(&slope));
        let touches = sound(fine);
        let both = [2.0 * fine[0] - coarse[0], 2.0 * fine[1] - coarse[1]];
        let [value, slope] = if touches && sound(coarse) && sound(both) { both } else { fine };
        let place = Place { s, value, slope, touches };
        known.insert(key, place);
        place
    };
    let span = raster.reach().s;
    let step = 2.0 * cell;
    let [first, last] =
        [(span[0] / step).floor() as i64 - half as i64 - 1, (span[1] / step).ceil() as i64 + half as i64 + 1];
    // No first steps that could miss damage shorter than they are.
    let longest = ((last - first) as u64 / LEAST_STEPS).max(1).ilog2();
    let halvings = (HALVINGS + fineness.refinement.ilog2()).min(longest);
    let places = along(halvings, [first, last], [(delta + raised) * fineness.between[0], fineness.between[1]], &mut at);
    Ok(Level { delta, places, work })
}

/// Places from `first` on past `last`, in steps of 2^`halvings` that are halved where a cubic through four neighbours misses what lies between
/// by more than `errors`. `at` is asked for a place and how far from it its neighbours lie, which are found before it.
fn along(
    halvings: u32,
    [first, last]: [i64; 2],
    errors: [f64; 2],
    at: &mut impl FnMut(i64, i64) -> Place,
) -> Vec<Place> {
    let coarse = 1i64 << halvings;
    // Multiples of the largest step, so that steps of all deformations nest, and healthy places at both ends.
    let [first, last] = [first.div_euclid(coarse) - 1, last.div_euclid(coarse) + 2];
    let mut places: Vec<(i64, Place)> = (first..=last).map(|k| (k * coarse, at(k * coarse, coarse))).collect();
    // Intervals to be halved, by their first place.
    let mut wanted: Vec<bool> = vec![true; places.len() - 1];
    for level in 0..halvings {
        let step = coarse >> level;
        let mut finer = Vec::with_capacity(2 * places.len());
        let mut next: Vec<bool> = Vec::with_capacity(2 * places.len());
        for k in 0..places.len() - 1 {
            finer.push(places[k]);
            if !(wanted[k] && places[k + 1].0 - places[k].0 == step) {
                next.push(false);
                continue;
            }
            let middle = places[k].0 + step / 2;
            let found = at(middle, step / 2);
            let [value, slope] = guess(&places, k, middle);
            let alike = places[k].1.touches == found.touches && places[k + 1].1.touches == found.touches;
            let missed = (value - found.value).abs() > errors[0] || (slope - found.slope).abs() > errors[1] || !alike;
            finer.push((middle, found));
            next.extend([missed; 2]);
        }
        finer.push(places[places.len() - 1]);
        // A neighbour of what has to be finer is finer too, as far as it is as fine already.
        let spread: Vec<bool> =
            (0..next.len()).map(|k| next[k] || (k > 0 && next[k - 1]) || next.get(k + 1).is_some_and(|n| *n)).collect();
        (places, wanted) = (finer, spread);
    }
    places.into_iter().map(|(_, place)| place).collect()
}

/// Value and slope by cubics through the places around interval k.
fn guess(places: &[(i64, Place)], k: usize, middle: i64) -> [f64; 2] {
    let from = k.saturating_sub(1).min(places.len().saturating_sub(4));
    let around = &places[from..(from + 4).min(places.len())];
    let mut guessed = [0.0; 2];
    for (x, place) in around {
        let others = around.iter().filter(|(other, _)| other != x);
        let weight: f64 = others.map(|(other, _)| (middle - other) as f64 / (x - other) as f64).product();
        guessed[0] += weight * place.value;
        guessed[1] += weight * place.slope;
    }
    guessed
}
