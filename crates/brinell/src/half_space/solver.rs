//! Contact of an elastic half-space with a gap: pressures on a window of cells by conjugate gradients on the cells that touch.
//!
//! The approach is given. Which cells touch is found in turns: equal gaps on those that do, then those that pull are let go and those that overlap
//! join them. Pressures p >= 0 with u = A p, u + g >= delta and p (u + g - delta) = 0 make
//! the sum of p (delta - g) - p u/2 largest: its value there is the stored energy, in which errors of p count squared, and its derivative in
//! delta is the sum of the pressures. Lengths in m. Pressures in units of pi E*/dx, so that u = A p.

use super::influence::{Influence, Scratch};

/// Convolutions of a solution at the most: a bound that nothing met comes near.
const MOST_CONVOLUTIONS: usize = 1000;
/// What is left of the residual after one turn.
const TURN: f64 = 0.1;

/// What presses where.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pressed {
    /// Sum over cells of p (delta - g) - p u/2.
    pub energy: f64,
    /// Sum over cells of p.
    pub force: f64,
    /// Convolutions that it took.
    pub convolutions: usize,
}

/// A window with its pressures, kept as the start of the next solution.
pub struct Contact<'a> {
    influence: &'a Influence,
    room: Scratch,
    /// Rows that can touch.
    rows: Vec<usize>,
    /// Pressures.
    pub p: Vec<f64>,
    /// u + g - delta.
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    /// 1 for cells that touch, else 0; and over their own compliance.
    free: Vec<f64>,
    yields: Vec<f64>,
}

impl<'a> Contact<'a> {
    /// Without pressures.
    pub fn new(influence: &'a Influence) -> Self {
        let n = influence.cells().along * influence.cells().across;
        let zeros = || vec![0.0; n];
        let (room, rows) = (influence.scratch(), Vec::with_capacity(influence.cells().across));
        Self {
            influence,
            room,
            rows,
            p: zeros(),
            residual: zeros(),
            direction: zeros(),
            image: zeros(),
            free: zeros(),
            yields: zeros(),
        }
    }

    /// Presses the window with the gaps `gap` (m; infinite where nothing is to touch) by `delta` (m), from the pressures that there are,
    /// until residual gaps are below `tolerance` times delta.
    pub fn press(&mut self, gap: &[f64], soft: &[f64], delta: f64, tolerance: f64) -> Pressed {
        for (p, g) in self.p.iter_mut().zip(gap) {
            if *g >= delta {
                *p = 0.0;
            }
        }
        let most = gap.iter().map(|g| delta - g).fold(0.0, f64::max);
        if most <= 0.0 {
            self.p.fill(0.0);
            return Pressed::default();
        }
        let along = self.influence.cells().along;
        self.rows.clear();
        self.rows.extend((0..gap.len() / along).filter(|row| gap[row * along..][..along].iter().any(|g| *g < delta)));
        if self.p.iter().all(|p| *p == 0.0) {
            // Any start in the right place: a pressure as the overlap, to be scaled by the first step.
            for (p, g) in self.p.iter_mut().zip(gap) {
                *p = (delta - g).max(0.0);
            }
            self.influence.apply(&self.p, &mut self.image, &self.rows, &mut self.room);
            let (work, stored) = (0..gap.len())
                .filter(|k| self.p[*k] > 0.0)
                .fold((0.0, 0.0), |(w, e), k| (w + self.p[k] * (delta - gap[k]), e + self.p[k] * self.image[k]));
            self.p.iter_mut().for_each(|p| *p *= work / stored);
        }
        let convolutions = self.iterate(gap, soft, delta, tolerance * most);
        let (mut energy, mut force) = (0.0, 0.0);
        for ((p, g), r) in self.p.iter().zip(gap).zip(&self.residual) {
            if *p > 0.0 {
                // u = r - g + delta.
                energy += p * 0.5 * ((delta - g) - r);
                force += p;
            }
        }
        Pressed { energy, force, convolutions }
    }

    #[inline(always)]
    fn find_residual(&mut self, gap: &[f64], soft: &[f64], delta: f64) {
        self.influence.apply(&self.p, &mut self.residual, &self.rows, &mut self.room);
        for (((r, g), p), soft) in self.residual.iter_mut().zip(gap).zip(&self.p).zip(soft) {
            *r += (g - delta) + soft * p;
        }
    }

    /// Which cells touch, with the sum of their squared residuals and their number; whether residuals are below `limit`.
    #[inline(always)]
    fn find_free(&mut self, gap: &[f64], soft: &[f64], delta: f64, limit: f64) -> (f64, usize, bool) {
        let own = self.influence.own();
        let (mut cells, mut done) = (0usize, true);
        for k in 0..gap.len() {
            let overlaps = self.p[k] <= 0.0 && gap[k] < delta && self.residual[k] < -limit;
            let is_free = self.p[k] > 0.0 || overlaps;
            (self.free[k], self.yields[k]) = if is_free { (1.0, 1.0 / (own + soft[k])) } else { (0.0, 0.0) };
            cells += usize::from(is_free);
            done &= !overlaps;
        }
        let square = sum_of_products(&self.residual, &self.residual, &self.free);
        (square, cells, done && square <= limit * limit * cells as f64)
    }

    /// Turns until residuals are below `limit`; the convolutions that they took. The same to the bit with any instructions, for no product is fused.
    fn iterate(&mut self, gap: &[f64], soft: &[f64], delta: f64, limit: f64) -> usize {
        #[cfg(target_arch = "x86_64")]
        {
            #[target_feature(enable = "avx2")]
            fn with_avx2(of: &mut Contact<'_>, gap: &[f64], soft: &[f64], delta: f64, limit: f64) -> usize {
                of.iterate_in_lanes(gap, soft, delta, limit)
            }
            if is_x86_feature_detected!("avx2") {
                // SAFETY: the processor has been asked.
                return unsafe { with_avx2(self, gap, soft, delta, limit) };
            }
        }
        self.iterate_in_lanes(gap, soft, delta, limit)
    }

    #[inline(always)]
    fn iterate_in_lanes(&mut self, gap: &[f64], soft: &[f64], delta: f64, limit: f64) -> usize {
        self.find_residual(gap, soft, delta);
        let mut convolutions = 1;
        while convolutions < MOST_CONVOLUTIONS {
            let (square, cells, done) = self.find_free(gap, soft, delta, limit);
            if done {
                break;
            }
            let goal = (TURN * TURN * square).max(0.25 * limit * limit * cells as f64);
            convolutions += self.equalise(soft, goal, MOST_CONVOLUTIONS - convolutions);
            let mut pulls = false;
            for p in self.p.iter_mut().filter(|p| **p < 0.0) {
                *p = 0.0;
                pulls = true;
            }
            if pulls {
                self.find_residual(gap, soft, delta);
                convolutions += 1;
            }
        }
        convolutions
    }

    /// Conjugate gradients on the cells that touch, scaled by each cell's own compliance, until the sum of squared residuals is below `goal`.
    #[inline(always)]
    fn equalise(&mut self, soft: &[f64], goal: f64, most: usize) -> usize {
        let mut before = f64::INFINITY;
        self.direction.fill(0.0);
        let mut scaled = sum_of_products(&self.residual, &self.residual, &self.yields);
        for convolutions in 1..=most {
            let share = scaled / before;
            before = scaled;
            for ((d, r), yields) in self.direction.iter_mut().zip(&self.residual).zip(&self.yields) {
                *d = r * yields + share * *d;
            }
            self.influence.apply(&self.direction, &mut self.image, &self.rows, &mut self.room);
            let stiff = stiffness(&mut self.image, &self.direction, soft, &self.free);
            let step = if stiff > 0.0 { scaled / stiff } else { 0.0 };
            let square;
            [square, scaled] = self.go(step);
            if square <= goal {
                return convolutions;
            }
        }
        most
    }

    /// A step along the direction; sums of squared residuals, of cells that touch and over their compliance.
    #[inline(always)]
    fn go(&mut self, step: f64) -> [f64; 2] {
        let mut sums = [[0.0; LANES]; 2];
        let ((r, r_end), (p, p_end)) = (self.residual.as_chunks_mut::<LANES>(), self.p.as_chunks_mut::<LANES>());
        let ((q, q_end), (d, d_end)) = (self.image.as_chunks::<LANES>(), self.direction.as_chunks::<LANES>());
        let ((free, free_end), (yields, yields_end)) =
            (self.free.as_chunks::<LANES>(), self.yields.as_chunks::<LANES>());
        for ((r, p), ((q, d), (free, yields))) in r.iter_mut().zip(p).zip(q.iter().zip(d).zip(free.iter().zip(yields)))
        {
            for k in 0..LANES {
                step_one(
                    (&mut r[k], &mut p[k]),
                    step,
                    (q[k], d[k]),
                    (free[k], yields[k]),
                    sums.each_mut().map(|s| &mut s[k]),
                );
            }
        }
        for k in 0..r_end.len() {
            let (at, of, cell) = ((&mut r_end[k], &mut p_end[k]), (q_end[k], d_end[k]), (free_end[k], yields_end[k]));
            step_one(at, step, of, cell, sums.each_mut().map(|s| &mut s[k]));
        }
        sums.map(|sums| sums.iter().sum())
    }
}

/// A step of one cell's residual and pressure, added to the sums of [`Contact::go`].
#[inline(always)]
fn step_one(
    (r, p): (&mut f64, &mut f64),
    step: f64,
    (q, d): (f64, f64),
    (free, yields): (f64, f64),
    sums: [&mut f64; 2],
) {
    *r -= step * q;
    *p -= step * d;
    let square = *r * *r;
    *sums[0] += square * free;
    *sums[1] += square * yields;
}

/// Numbers that are summed side by side, so that sums have the same order with any instructions.
const LANES: usize = 8;

/// Adds what soft cells yield to the image of a direction; the product of both over cells that touch.
#[inline(always)]
fn stiffness(image: &mut [f64], direction: &[f64], soft: &[f64], free: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    let add = |q: &mut f64, d: f64, soft: f64, free: f64, sum: &mut f64| {
        *q += soft * d;
        *sum += *q * d * free;
    };
    let ((q, q_end), (d, d_end)) = (image.as_chunks_mut::<LANES>(), direction.as_chunks::<LANES>());
    let ((soft, soft_end), (free, free_end)) = (soft.as_chunks::<LANES>(), free.as_chunks::<LANES>());
    for ((q, d), (soft, free)) in q.iter_mut().zip(d).zip(soft.iter().zip(free)) {
        for k in 0..LANES {
            add(&mut q[k], d[k], soft[k], free[k], &mut sums[k]);
        }
    }
    for k in 0..q_end.len() {
        add(&mut q_end[k], d_end[k], soft_end[k], free_end[k], &mut sums[k]);
    }
    sums.iter().sum()
}

/// Sum of a b c, in the same order with any instructions.
#[inline(always)]
fn sum_of_products(a: &[f64], b: &[f64], c: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for ((a, b), c) in a.chunks(LANES).zip(b.chunks(LANES)).zip(c.chunks(LANES)) {
        for (((sum, a), b), c) in sums.iter_mut().zip(a).zip(b).zip(c) {
            *sum += a * b * c;
        }
    }
    sums.iter().sum()
}
