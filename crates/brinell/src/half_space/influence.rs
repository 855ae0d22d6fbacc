//! Displacements of an elastic half-space under uniformly loaded rectangles: Love's coefficients on a grid.
//!
//! x along the rolling direction, z across. Fourier transforms along x; direct sums along z, over the rows that can touch alone. Lengths in
//! cells of x, pressures as displacements: u = (dx / (pi E*)) A p with A from here.

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealToComplex};
use std::sync::Arc;

use crate::signal::fft;

/// Real and imaginary parts that are summed together.
const LANES: usize = 8;
/// Rows next to each other that are summed together.
const BLOCK: usize = 4;
/// Cells that are left free between the farthest two and the nearest two the other way around.
const APART: usize = 4;
/// ln of what is left of a wave where rows no longer count for each other: it falls with exp(-k z).
const LEFT: f64 = 16.0;

/// Cells of a window: `along` in x by `across` in z; pressures row by row of z, x within a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cells {
    /// Cells along x.
    pub along: usize,
    /// Rows across.
    pub across: usize,
    /// Width of a cell across over its length along.
    pub aspect: f64,
    /// Whether the rows are those of z > 0, from z = 0 on, and the other side is alike.
    pub mirrored: bool,
}

/// The convolution with Love's coefficients.
pub struct Influence {
    cells: Cells,
    /// Values along x with the zeros that keep both ends apart.
    padded: usize,
    /// Transforms along x of the coefficients, each twice for real and imaginary parts: group by group of lanes, rows apart from -(n - 1) up to
    /// n - 1, or to 2n - 1 where mirrored.
    waves: Vec<[f64; LANES]>,
    /// Groups of lanes in a row's transform.
    groups: usize,
    /// Rows apart that each group has, with room for the last block.
    apart: usize,
    /// Rows apart beyond which nothing is left of a group's waves.
    farthest: Vec<usize>,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

/// What a convolution needs; of one [`Influence`].
pub struct Scratch {
    line: Vec<f64>,
    spectrum: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    /// Spectra of rows, group by group of lanes.
    from: Vec<[f64; LANES]>,
    to: Vec<[f64; LANES]>,
    /// Rows with pressures.
    loaded: Vec<usize>,
}

impl std::fmt::Debug for Influence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Influence").field("cells", &self.cells).field("padded", &self.padded).finish_non_exhaustive()
    }
}

/// Integral of 1/r over the rectangle from the origin to (x, z), signed (Love 1929; Johnson, Contact Mechanics, 3.25).
fn corner(x: f64, z: f64) -> f64 {
    x * (z / x.abs()).asinh() + z * (x / z.abs()).asinh()
}

/// The next length from `n` on that transforms fast: even, without factors above 5.
fn fast_length(n: usize) -> usize {
    let smooth = |mut n: usize| {
        for p in [2, 3, 5] {
            while n.is_multiple_of(p) {
                n /= p;
            }
        }
        n == 1
    };
    (n.max(4)..).find(|n| n.is_multiple_of(2) && smooth(*n)).unwrap_or(n)
}

impl Influence {
    /// For a window.
    pub fn new(cells: Cells) -> Self {
        let Cells { along, across, aspect, mirrored } = cells;
        let padded = fast_length(2 * along + APART);
        let (forward, inverse) = (fft::forward(padded), fft::inverse(padded));
        let rows = if mirrored { 2 * across } else { across };
        let groups = (2 * (padded / 2 + 1)).div_ceil(LANES);
        let apart = across - 1 + rows + BLOCK;
        let farthest: Vec<usize> = (0..groups)
            .map(|group| {
                let wave = std::f64::consts::TAU * (LANES / 2 * group) as f64 / padded as f64;
                // Of the longest waves all.
                ((LEFT / (wave * aspect)).ceil() as usize).min(rows)
            })
            .collect();
        let mut waves = vec![[0.0; LANES]; groups * apart];
        // Corners lie between cells: half a cell off their middles. Up to where the other way around is as near: a jump there would leave short waves.
        let corners: Vec<Vec<f64>> = (0..=rows)
            .map(|row| (0..=padded / 2 + 1).map(|k| corner(k as f64 - 0.5, (row as f64 - 0.5) * aspect)).collect())
            .collect();
        let (mut line, mut spectrum) = (forward.make_input_vec(), forward.make_output_vec());
        let scale = 1.0 / padded as f64;
        for row in 0..rows {
            for k in 0..=padded / 2 {
                let value = corners[row + 1][k + 1] - corners[row + 1][k] - corners[row][k + 1] + corners[row][k];
                line[k] = scale * value;
                if k > 0 {
                    line[padded - k] = scale * value;
                }
            }
            // The lengths are the plan's own.
            let done = forward.process(&mut line, &mut spectrum);
            debug_assert!(done.is_ok());
            // Even in x: the transform is real.
            for (k, value) in spectrum.iter().flat_map(|value| [value.re; 2]).enumerate() {
                if row > farthest[k / LANES] {
                    continue;
                }
                let at = k / LANES * apart + across - 1;
                waves[at + row][k % LANES] = value;
                if row < across {
                    waves[at - row][k % LANES] = value;
                }
            }
        }
        Self { cells, padded, waves, groups, apart, farthest, forward, inverse }
    }

    /// The window.
    pub fn cells(&self) -> Cells {
        self.cells
    }

    /// What a cell does to itself.
    pub(super) fn own(&self) -> f64 {
        let (a, b) = (0.5, 0.5 * self.cells.aspect);
        4.0 * corner(a, b)
    }

    /// Room for [`Self::apply`].
    pub fn scratch(&self) -> Scratch {
        let scratch = self.forward.get_scratch_len().max(self.inverse.get_scratch_len());
        Scratch {
            line: self.forward.make_input_vec(),
            spectrum: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); scratch],
            from: vec![[0.0; LANES]; self.groups * self.cells.across],
            to: vec![[0.0; LANES]; self.groups * (self.cells.across + BLOCK)],
            loaded: Vec::with_capacity(self.cells.across),
        }
    }

    /// `to` = A `p` in these rows, rising, where all pressures are; elsewhere `to` stays.
    pub fn apply(&self, p: &[f64], to: &mut [f64], rows: &[usize], room: &mut Scratch) {
        let Cells { along, across, .. } = self.cells;
        room.loaded.clear();
        for &row in rows {
            let line = &p[row * along..][..along];
            if line.iter().all(|p| *p == 0.0) {
                continue;
            }
            room.loaded.push(row);
            room.line[..along].copy_from_slice(line);
            room.line[along..].fill(0.0);
            let done = self.forward.process_with_scratch(&mut room.line, &mut room.spectrum, &mut room.scratch);
            debug_assert!(done.is_ok());
            for (group, values) in room.spectrum.chunks(LANES / 2).enumerate() {
                let mut lanes = [0.0; LANES];
                for (lanes, value) in lanes.chunks_exact_mut(2).zip(values) {
                    lanes.copy_from_slice(&[value.re, value.im]);
                }
                room.from[group * across + row] = lanes;
            }
        }
        self.add_up(rows, room);
        let last = room.spectrum.len() - 1;
        for &row in rows {
            for (group, values) in room.spectrum.chunks_mut(LANES / 2).enumerate() {
                let lanes = &room.to[group * (across + BLOCK) + row];
                for (value, lanes) in values.iter_mut().zip(lanes.chunks_exact(2)) {
                    *value = Complex::new(lanes[0], lanes[1]);
                }
            }
            // What round-off leaves there, which the transform refuses.
            room.spectrum[0].im = 0.0;
            room.spectrum[last].im = 0.0;
            let done = self.inverse.process_with_scratch(&mut room.spectrum, &mut room.line, &mut room.scratch);
            debug_assert!(done.is_ok());
            to[row * along..][..along].copy_from_slice(&room.line[..along]);
        }
    }

    /// Sums of what the loaded rows do to all others, wave by wave: the same to the bit with any instructions, for no product is fused.
    fn add_up(&self, rows: &[usize], room: &mut Scratch) {
        #[cfg(target_arch = "x86_64")]
        {
            #[target_feature(enable = "avx512f")]
            fn with_avx512(of: &Influence, rows: &[usize], room: &mut Scratch) {
                of.add_up_in_lanes(rows, room);
            }
            #[target_feature(enable = "avx2")]
            fn with_avx2(of: &Influence, rows: &[usize], room: &mut Scratch) {
                of.add_up_in_lanes(rows, room);
            }
            if is_x86_feature_detected!("avx512f") {
                // SAFETY: the processor has been asked.
                return unsafe { with_avx512(self, rows, room) };
            }
            if is_x86_feature_detected!("avx2") {
                // SAFETY: as above.
                return unsafe { with_avx2(self, rows, room) };
            }
        }
        self.add_up_in_lanes(rows, room);
    }

    #[inline(always)]
    fn add_up_in_lanes(&self, rows: &[usize], room: &mut Scratch) {
        let Cells { across, mirrored, .. } = self.cells;
        for group in 0..self.groups {
            let waves = &self.waves[group * self.apart..][..self.apart];
            let from = &room.from[group * across..][..across];
            let to = &mut room.to[group * (across + BLOCK)..][..across + BLOCK];
            let mut next = 0;
            for &row in rows {
                if row < next {
                    continue;
                }
                next = row + BLOCK;
                let mut sums = [[0.0; LANES]; BLOCK];
                let most = self.farthest[group];
                let from_other = room.loaded.partition_point(|other| other + most < row);
                let to_other = room.loaded.partition_point(|other| *other < next + most);
                for &other in &room.loaded[from_other..to_other] {
                    let near = &waves[across - 1 + row - other..][..BLOCK];
                    let far = if mirrored { &waves[across + row + other..][..BLOCK] } else { near };
                    let from = &from[other];
                    for j in 0..BLOCK {
                        for k in 0..LANES {
                            let both = if mirrored { near[j][k] + far[j][k] } else { near[j][k] };
                            sums[j][k] += both * from[k];
                        }
                    }
                }
                to[row..next].copy_from_slice(&sums);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Love's coefficient of a cell (1 by `aspect`) at a distance.
    fn love(x: f64, z: f64, aspect: f64) -> f64 {
        let (a, b) = (0.5, 0.5 * aspect);
        corner(x + a, z + b) - corner(x - a, z + b) - corner(x + a, z - b) + corner(x - a, z - b)
    }

    #[test]
    fn analytic_far_away_a_cell_is_a_point_load_and_at_its_middle_as_in_books() {
        assert!((love(30.0, 40.0, 2.0) - 2.0 / 50.0).abs() < 1e-5);
        // A square of side a: 4 a ln(1 + sqrt 2) at its middle.
        assert!((love(0.0, 0.0, 1.0) - 4.0 * (1.0 + 2f64.sqrt()).ln()).abs() < 1e-12);
    }

    #[test]
    fn xval_convolution_is_the_sum_over_cells() {
        for mirrored in [false, true] {
            let cells = Cells { along: 7, across: 5, aspect: 1.7, mirrored };
            let influence = Influence::new(cells);
            let p: Vec<f64> =
                (0..35).map(|k| ((k * k) % 11) as f64 * f64::from(u8::from(!(10..20).contains(&k)))).collect();
            let mut u = vec![0.0; 35];
            influence.apply(&p, &mut u, &[0, 1, 2, 3, 4], &mut influence.scratch());
            for (k, u) in u.iter().enumerate() {
                let sum: f64 = (0..35)
                    .map(|m| {
                        let x = (m % 7) as f64 - (k % 7) as f64;
                        let (to, from) = ((k / 7) as f64, (m / 7) as f64);
                        let other = if mirrored { love(x, 1.7 * (to + from + 1.0), 1.7) } else { 0.0 };
                        p[m] * (love(x, 1.7 * (to - from), 1.7) + other)
                    })
                    .sum();
                // What is left out of short waves, most at the ends of the window, where waves come around the other way.
                assert!((u - sum).abs() < 1e-4 * sum.abs().max(1.0), "{k}: {u} {sum}");
            }
        }
    }

    #[test]
    fn analytic_short_waves_that_do_not_reach_across_are_not_missed() {
        // A roller's cells: what is left out is of waves that have fallen to 1e-7.
        let (along, across, aspect) = (24, 16, 6.0);
        for mirrored in [false, true] {
            let influence = Influence::new(Cells { along, across, aspect, mirrored });
            assert!(influence.farthest.iter().any(|rows| *rows < across / 3), "{:?}", influence.farthest);
            let at = |k: usize| [(k % along) as f64, (k / along) as f64];
            let pressed = |k: usize| (at(k)[0] - 11.5).abs() < 7.0;
            let p: Vec<f64> =
                (0..along * across).map(|k| if pressed(k) { 1.0 + ((k * k) % 7) as f64 } else { 0.0 }).collect();
            let mut u = vec![0.0; p.len()];
            let rows: Vec<usize> = (0..across).collect();
            influence.apply(&p, &mut u, &rows, &mut influence.scratch());
            for (k, u) in u.iter().enumerate() {
                let sum: f64 = (0..p.len())
                    .map(|m| {
                        let ([x, to], [other, from]) = (at(k), at(m));
                        let far = if mirrored { love(x - other, aspect * (to + from + 1.0), aspect) } else { 0.0 };
                        p[m] * (love(x - other, aspect * (to - from), aspect) + far)
                    })
                    .sum();
                // Ends of the window are where waves come around the other way.
                let tolerance = if pressed(k) { 3e-5 } else { 2e-4 };
                assert!((u - sum).abs() < tolerance * sum, "{k}: {u} {sum}");
            }
        }
    }
}
