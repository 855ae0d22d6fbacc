//! Depths of a damaged surface on a fine raster, with edges rounded, and what cells of a solver see of them.
//!
//! s along the surface, z across, m; depth into the material, raised below 0. Off the raster the surface is whole.

/// Raster cells of one surface at the most.
const MOST_CELLS: usize = 3_000_000;
/// Steps of a raster, m, where it is not too large.
const STEP: f64 = 2.5e-6;
/// Samples of a cell of the solver along each axis, and those of a cell whose depths differ by less than a share of what its pressure levels.
const MOST_SAMPLES: usize = 12;
const FEWEST_SAMPLES: usize = 4;
const SMOOTH: f64 = 0.25;
/// Step of these samples, m, where that many are enough.
const SAMPLE: f64 = 0.5e-6;
/// Halvings of a step of samples in which an edge lies.
const HALVINGS: u32 = 4;
/// Softness of a cell with the share f left, over (1 - f)/f and the cell's size across the edge: with it the force is straight in the
/// place of an edge within a cell, to 2 % of what a cell carries. Found on edges along both axes, cells from 1:1 to 1:3, and the same on all.
const SOFTNESS: f64 = 5.43;
/// How it falls for edges along the rolling direction where a cell is wide against half the contact's width.
const SPREAD: f64 = 0.25;
/// Least share of a cell that is left: less carries nothing that counts.
const LEAST_SHARE: f64 = 1e-3;

/// Depths (m) and shares that differ by less are the same, so that columns that differ by round-off are solved once.
const SAME_DEPTH: f64 = 1e-12;
const SAME_SHARE: f64 = 1e-5;

fn alike(x: f64, step: f64) -> f64 {
    (x / step).round() * step
}

/// First and last s and z of damage, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// First and last s.
    pub s: [f64; 2],
    /// Lowest and highest z.
    pub z: [f64; 2],
}

/// Depths with rounded edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    bounds: Bounds,
    /// Steps along s and z.
    step: [f64; 2],
    /// Cells along s and z.
    cells: [usize; 2],
    /// Length of the running mean along both axes.
    edge: f64,
    /// Mean depths, column by column of s.
    depth: Vec<f64>,
    /// Sums of depths over all cells before a corner along both axes, column by column.
    sums: Vec<f64>,
    /// Cells before a corner that are not as deep as the one before them along either axis.
    changes: Vec<u32>,
    /// Least and greatest depth of every block of cells, column by column of s.
    extremes: Vec<[f64; 2]>,
    /// Height of the highest raised place, m.
    raised: f64,
}

/// Raster cells along either side of a block.
const BLOCK: usize = 8;

/// What a cell of the solver sees.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Seen {
    /// Depth of what can touch, m.
    pub(super) depth: f64,
    /// Compliance beyond that of a cell that is wholly there, where u = A p.
    pub(super) soft: f64,
}

/// Corner before either end of what is averaged, and how far beyond it.
type Around = [(usize, f64); 2];

/// A cell of the solver, the depth difference within it that its pressure levels (m), and the contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) s: [f64; 2],
    pub(super) z: [f64; 2],
    pub(super) levelled: f64,
    /// Half the contact's width along s, m.
    pub(super) half_width: f64,
    /// Depth from which on nothing can touch, m.
    pub(super) deepest: f64,
}

impl Raster {
    /// Of damage within `bounds`; edges rounded by a running mean of the length `edge` (m) along both axes. `column` adds to
    /// each cell of the column between two s its mean depth; the cells lie between equal steps of z.
    pub fn new(bounds: Bounds, edge: f64, mut column: impl FnMut([f64; 2], &mut [f64])) -> Self {
        let lengths = [bounds.s, bounds.z].map(|[from, to]| (to - from).max(0.0));
        let mut pitch = STEP;
        let count = |pitch: f64| lengths.map(|length| ((length / pitch).ceil() as usize).max(1));
        while count(pitch).iter().product::<usize>() > MOST_CELLS {
            pitch *= 1.25;
        }
        let cells = count(pitch);
        let step = [lengths[0] / cells[0] as f64, lengths[1] / cells[1] as f64];
        let mut depth = vec![0.0; cells[0] * cells[1]];
        for (k, column_depth) in depth.chunks_exact_mut(cells[1]).enumerate() {
            let from = bounds.s[0] + k as f64 * step[0];
            column([from, from + step[0]], column_depth);
        }
        let raised = depth.iter().fold(0.0_f64, |most, h| most.max(-h));
        let extremes = extremes(cells, &depth);
        let [sums, changes] = [0, 1].map(|_| (cells[0] + 1) * (cells[1] + 1));
        let (mut sums, mut changes) = (vec![0.0; sums], vec![0u32; changes]);
        let wide = cells[1] + 1;
        for k in 0..cells[0] {
            let (mut sum, mut change) = (0.0, 0);
            for j in 0..cells[1] {
                let here = depth[k * cells[1] + j];
                let beside = if k > 0 { depth[(k - 1) * cells[1] + j] } else { 0.0 };
                let below = if j > 0 { depth[k * cells[1] + j - 1] } else { 0.0 };
                sum += here;
                change += u32::from(here != beside || here != below);
                sums[(k + 1) * wide + j + 1] = sums[k * wide + j + 1] + sum;
                changes[(k + 1) * wide + j + 1] = changes[k * wide + j + 1] + change;
            }
        }
        Self { bounds, step, cells, edge, depth, sums, changes, extremes, raised }
    }

    /// From depths at points, m: the mean of 4 by 4 of every raster cell.
    pub fn of_depths(bounds: Bounds, edge: f64, depth: impl Fn(f64, f64) -> f64) -> Self {
        const POINTS: usize = 4;
        Self::new(bounds, edge, |[from, to], column| {
            let step = (bounds.z[1] - bounds.z[0]) / column.len() as f64;
            for (j, cell) in column.iter_mut().enumerate() {
                for point in 0..POINTS * POINTS {
                    let [a, b] = [point / POINTS, point % POINTS].map(|k| (k as f64 + 0.5) / POINTS as f64);
                    let z = bounds.z[0] + (j as f64 + b) * step;
                    *cell += depth(from + a * (to - from), z) / (POINTS * POINTS) as f64;
                }
            }
        })
    }

    /// First and last s and z that rounded damage reaches, m.
    pub fn reach(&self) -> Bounds {
        let wider = |[from, to]: [f64; 2]| [from - 0.5 * self.edge, to + 0.5 * self.edge];
        Bounds { s: wider(self.bounds.s), z: wider(self.bounds.z) }
    }

    /// H: height of the highest raised place before rounding, m.
    pub fn raised(&self) -> f64 {
        self.raised
    }

    /// Whether z < 0 mirrors z > 0 to a nanometre.
    pub fn is_mirrored(&self) -> bool {
        let [columns, rows] = self.cells;
        let middle = self.bounds.z[0] + self.bounds.z[1];
        middle.abs() < 1e-9
            && (0..columns).all(|k| {
                let column = &self.depth[k * rows..(k + 1) * rows];
                column.iter().zip(column.iter().rev()).all(|(a, b)| (a - b).abs() < 1e-9)
            })
    }

    /// The corner before a place on an axis, and how far beyond it, in raster cells.
    fn place(&self, x: f64, axis: usize) -> (usize, f64) {
        let first = if axis == 0 { self.bounds.s[0] } else { self.bounds.z[0] };
        let x = ((x - first) / self.step[axis]).clamp(0.0, self.cells[axis] as f64);
        let k = (x as usize).min(self.cells[axis] - 1);
        (k, x - k as f64)
    }

    /// Sum of the depths before a place along both axes, in raster cells: exact for depths constant in each.
    fn sum(&self, (k, a): (usize, f64), (j, b): (usize, f64)) -> f64 {
        let wide = self.cells[1] + 1;
        let at = |k: usize, j: usize| self.sums[k * wide + j];
        let low = at(k, j) + b * (at(k, j + 1) - at(k, j));
        let high = at(k + 1, j) + b * (at(k + 1, j + 1) - at(k + 1, j));
        low + a * (high - low)
    }

    /// Half the length over which depths are averaged, m.
    fn half(&self) -> f64 {
        (0.5 * self.edge).max(0.25 * self.step[0].min(self.step[1]))
    }

    /// Both ends of what is averaged about a place on an axis.
    fn around(&self, x: f64, axis: usize) -> Around {
        [x - self.half(), x + self.half()].map(|x| self.place(x, axis))
    }

    /// Depth with rounded edges, m.
    fn mean(&self, [from, to]: Around, [low, high]: Around) -> f64 {
        let sum = self.sum(to, high) - self.sum(to, low) - self.sum(from, high) + self.sum(from, low);
        let half = self.half();
        sum * self.step[0] * self.step[1] / (4.0 * half * half)
    }

    /// Depth at a point with rounded edges, m.
    pub fn rounded(&self, s: f64, z: f64) -> f64 {
        self.mean(self.around(s, 0), self.around(z, 1))
    }

    /// Raster cells that a span touches, widened by the rounding; `None` where it lies beyond.
    fn touched(&self, span: [f64; 2], axis: usize) -> Option<[usize; 2]> {
        let bounds = if axis == 0 { self.bounds.s } else { self.bounds.z };
        let half = 0.5 * self.edge;
        let [from, to] = [span[0] - half - bounds[0], span[1] + half - bounds[0]].map(|x| x / self.step[axis]);
        let last = self.cells[axis] as f64;
        (to > 0.0 && from < last).then(|| [from.max(0.0).floor() as usize, to.min(last).ceil() as usize])
    }

    /// Depth where all that a cell sees is as deep.
    fn uniform(&self, cell: &Cell) -> Option<f64> {
        let (Some([k0, k1]), Some([j0, j1])) = (self.touched(cell.s, 0), self.touched(cell.z, 1)) else {
            return Some(0.0);
        };
        let half = 0.5 * self.edge;
        let within = |span: [f64; 2], of: [f64; 2]| span[0] - half >= of[0] && span[1] + half <= of[1];
        let inside = within(cell.s, self.bounds.s) && within(cell.z, self.bounds.z);
        // Its first row and column are compared with what lies before them, which the cell does not see.
        let wide = self.cells[1] + 1;
        let count = |k0: usize, j0: usize| {
            let at = |k: usize, j: usize| i64::from(self.changes[k * wide + j]);
            at(k1, j1) - at(k1, j0) - at(k0, j1) + at(k0, j0)
        };
        let depth = self.depth[k0 * self.cells[1] + j0];
        if inside {
            return (count(k0, j0) == 0).then_some(depth);
        }
        (depth == 0.0 && count(k0, j0) == 0).then_some(0.0)
    }

    /// Bounds of the depths that a cell sees.
    fn between(&self, cell: &Cell) -> [f64; 2] {
        let (Some([k0, k1]), Some([j0, j1])) = (self.touched(cell.s, 0), self.touched(cell.z, 1)) else {
            return [0.0; 2];
        };
        let half = 0.5 * self.edge;
        let within = |span: [f64; 2], of: [f64; 2]| span[0] - half >= of[0] && span[1] + half <= of[1];
        let inside = within(cell.s, self.bounds.s) && within(cell.z, self.bounds.z);
        let mut all = if inside { [f64::INFINITY, f64::NEG_INFINITY] } else { [0.0; 2] };
        let wide = self.cells[1].div_ceil(BLOCK);
        for k in k0 / BLOCK..k1.div_ceil(BLOCK) {
            for [low, high] in &self.extremes[k * wide..][j0 / BLOCK..j1.div_ceil(BLOCK)] {
                all = [all[0].min(*low), all[1].max(*high)];
            }
        }
        all
    }

    /// What a cell sees of the surface.
    ///
    /// Within it the deep parts next to an edge carry nothing; what is left has a place and a share, and is softer than a whole cell.
    pub(super) fn seen(&self, cell: &Cell) -> Seen {
        let seen = self.sampled(cell);
        // What cannot touch is alike, so that columns that differ in it are solved once.
        if seen.depth < cell.deepest { seen } else { Seen { depth: cell.deepest, soft: 0.0 } }
    }

    fn sampled(&self, cell: &Cell) -> Seen {
        if let Some(depth) = self.uniform(cell) {
            return Seen { depth, soft: 0.0 };
        }
        let [least, most] = self.between(cell);
        if least >= cell.deepest {
            return Seen { depth: least, soft: 0.0 };
        }
        let start = [cell.s[0], cell.z[0]];
        let size = [cell.s[1] - cell.s[0], cell.z[1] - cell.z[0]];
        let finest = if most - least < SMOOTH * cell.levelled { FEWEST_SAMPLES } else { MOST_SAMPLES };
        let samples = size.map(|size| ((size / SAMPLE).ceil() as usize).clamp(FEWEST_SAMPLES, finest));
        let middle = |k: usize, axis: usize| (k as f64 + 0.5) / samples[axis] as f64;
        let around = [0, 1].map(|axis| {
            let mut all = [Around::default(); MOST_SAMPLES];
            for (k, around) in all[..samples[axis]].iter_mut().enumerate() {
                *around = self.around(start[axis] + middle(k, axis) * size[axis], axis);
            }
            all
        });
        let mut depths = [0.0; MOST_SAMPLES * MOST_SAMPLES];
        let depths = &mut depths[..samples[0] * samples[1]];
        for (k, depth) in depths.iter_mut().enumerate() {
            *depth = self.mean(around[0][k / samples[1]], around[1][k % samples[1]]);
        }
        let left_of = Left { highest: depths.iter().copied().fold(f64::INFINITY, f64::min), levelled: cell.levelled };
        let mut lean = [0.0; 2];
        for (k, depth) in depths.iter().enumerate() {
            // First moments: how much more of the far half is left.
            let weight = left_of.weight(*depth);
            lean[0] += weight * (middle(k / samples[1], 0) - 0.5);
            lean[1] += weight * (middle(k % samples[1], 1) - 0.5);
        }
        let lean = lean.map(f64::abs);
        // Along the axis that crosses the edge, on lines beside each other.
        let along = usize::from(lean[1] / size[1] > lean[0] / size[0]);
        let (mut left, mut sum) = (0.0, 0.0);
        for k in 0..samples[1 - along] {
            let beside = around[1 - along][k];
            let line = |x: f64| {
                let across = self.around(start[along] + x * size[along], along);
                if along == 0 { self.mean(across, beside) } else { self.mean(beside, across) }
            };
            let mut from = (0.0, line(0.0));
            for j in 1..=samples[along] {
                let x = j as f64 / samples[along] as f64;
                let to = (x, line(x));
                let [weight, depth] = left_of.between(&line, from, to, HALVINGS);
                left += weight;
                sum += depth;
                from = to;
            }
        }
        let (sum, left) = (sum / left, left / samples[1 - along] as f64);
        let share = alike(left, SAME_SHARE).max(LEAST_SHARE);
        let lean = lean.map(f64::abs);
        let steep = (lean[0] / size[0]).hypot(lean[1] / size[1]);
        let across = if steep > 0.0 { (lean[0] + lean[1]) / steep } else { size[0].min(size[1]) };
        let wide = if steep > 0.0 { lean[1] / steep } else { 0.0 };
        let softness = SOFTNESS * across / (1.0 + SPREAD * wide / cell.half_width) / size[0];
        Seen { depth: alike(sum, SAME_DEPTH), soft: alike(softness, SAME_SHARE) * (1.0 - share) / share }
    }
}

/// Least and greatest depth of every block of cells, column by column.
fn extremes(cells: [usize; 2], depth: &[f64]) -> Vec<[f64; 2]> {
    let wide = cells[1].div_ceil(BLOCK);
    let mut all = vec![[f64::INFINITY, f64::NEG_INFINITY]; cells[0].div_ceil(BLOCK) * wide];
    for (k, column) in depth.chunks_exact(cells[1]).enumerate() {
        for (j, block) in column.chunks(BLOCK).enumerate() {
            let [low, high] = &mut all[k / BLOCK * wide + j];
            *low = block.iter().copied().fold(*low, f64::min);
            *high = block.iter().copied().fold(*high, f64::max);
        }
    }
    all
}

/// How much of a cell is left: wholly what is as high as its highest place, nothing of what is far deeper than its pressure levels.
struct Left {
    highest: f64,
    levelled: f64,
}

impl Left {
    fn weight(&self, depth: f64) -> f64 {
        let below = (depth - self.highest).max(0.0) / self.levelled;
        (1.0 + below * below).powi(-2)
    }

    /// Integrals along a line of the weight, and of weight times depth, between two places with their depths.
    fn between(&self, line: &impl Fn(f64) -> f64, a: (f64, f64), b: (f64, f64), halvings: u32) -> [f64; 2] {
        let deep = a.1.min(b.1) - self.highest > 4.0 * self.levelled;
        if halvings == 0 || deep || (a.1 - b.1).abs() < 0.5 * self.levelled {
            let [p, q] = [a.1, b.1].map(|depth| 0.5 * (b.0 - a.0) * self.weight(depth));
            return [p + q, p * a.1 + q * b.1];
        }
        let x = 0.5 * (a.0 + b.0);
        let middle = (x, line(x));
        let [near, far] = [self.between(line, a, middle, halvings - 1), self.between(line, middle, b, halvings - 1)];
        [near[0] + far[0], near[1] + far[1]]
    }
}
