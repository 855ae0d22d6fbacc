//! Transforms of long signals in interleaved parts, so that each fits a processor's cache and needs little room.
//!
//! Every P-th of N samples, from the p-th on, has a transform F_p of its own, M = N / P long. With w = e^(2 pi i / N) the whole one's is
//! X_k = sum over p of w^(-k p) F_p[k mod M], and backward the samples p, p + P, p + 2 P, ... are the transform of length M of the bins
//! X_k w^(k p), those of equal k mod M added (J. W. Cooley and J. W. Tukey, Math. Comput. 19 (1965) 297-301). The tables of one
//! transform of four million values take longer to make than the transform itself, and as much memory as its values.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

use realfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// Values of a part, where the signal's length can be divided so.
const LONGEST: usize = 1 << 19;
/// Parts at most.
const MOST_PARTS: usize = 16;
/// Bins that are turned at a time.
const BLOCK: usize = 512;

/// How signals of one length are transformed.
pub(super) struct Interleaved {
    length: usize,
    parts: usize,
    /// Backward, of one part; forward is its complex conjugate.
    fft: Arc<dyn Fft<f64>>,
}

/// What one thread transforms in.
pub(super) struct Room {
    values: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Interleaved {
    pub(super) fn new(length: usize) -> Self {
        Interleaved::planned(length, &mut FftPlanner::new())
    }

    /// With tables from a planner, which keeps those of every length of a part.
    pub(super) fn planned(length: usize, planner: &mut FftPlanner<f64>) -> Self {
        let parts = parts(length);
        Interleaved {
            length,
            parts,
            fft: planner.plan_fft_inverse(length / parts),
        }
    }

    pub(super) fn room(&self) -> Room {
        Room {
            values: vec![Complex::ZERO; self.length / self.parts],
            scratch: vec![Complex::ZERO; self.fft.get_inplace_scratch_len()],
        }
    }

    /// Bins 0 to N / 2 of the transform of `x`.
    pub(super) fn forward(&self, x: &[f64], room: &mut Room) -> Vec<Complex<f64>> {
        let mut bins = vec![Complex::ZERO; self.length / 2 + 1];
        let all = 0..bins.len();
        let m = room.values.len();
        // Two real parts make one complex transform.
        for p in (0..self.parts).step_by(2) {
            let pair = p + 1 < self.parts;
            for (value, group) in room.values.iter_mut().zip(x.chunks_exact(self.parts)) {
                let second = if pair { group[p + 1] } else { 0.0 };
                *value = Complex::new(group[p], -second);
            }
            self.fft
                .process_with_scratch(&mut room.values, &mut room.scratch);
            let values = &room.values;
            // Conjugate of the transform of both, and the transform at the mirrored bin.
            let both = |j: usize| (values[j].conj(), values[if j == 0 { 0 } else { m - j }]);
            self.turned(all.clone(), p, |k, j, turns| {
                for (i, turn) in turns.iter().enumerate() {
                    let (z, mirrored) = both(j + i);
                    bins[k + i] += 0.5 * (z + mirrored) * turn.conj();
                }
            });
            if pair {
                self.turned(all.clone(), p + 1, |k, j, turns| {
                    for (i, turn) in turns.iter().enumerate() {
                        let (z, mirrored) = both(j + i);
                        let d = z - mirrored;
                        bins[k + i] += Complex::new(0.5 * d.im, -0.5 * d.re) * turn.conj();
                    }
                });
            }
        }
        bins
    }

    /// The complex signal that has the bins of `range` and no others, N times as large, part by part: `each` gets p and the samples p,
    /// p + P, p + 2 P, ... of P in all. `bins` are those from 0 on, of a transform of any length: with N bins or fewer in `range` the samples
    /// are the signal's at N equal steps. `shape` gets the number of the first of a few bins, these, and factors that
    /// it may change.
    pub(super) fn backward(
        &self,
        bins: &[Complex<f64>],
        range: Range<usize>,
        room: &mut Room,
        mut shape: impl FnMut(usize, &[Complex<f64>], &mut [Complex<f64>]),
        mut each: impl FnMut(Part, &[Complex<f64>]),
    ) {
        for p in 0..self.parts {
            let Room { values, scratch } = &mut *room;
            values.fill(Complex::ZERO);
            self.turned(range.clone(), p, |k, j, factors| {
                let bins = &bins[k..k + factors.len()];
                shape(k, bins, factors);
                let places = &mut values[j..j + factors.len()];
                for ((value, bin), factor) in places.iter_mut().zip(bins).zip(factors) {
                    *value += bin * *factor;
                }
            });
            self.fft.process_with_scratch(values, scratch);
            let part = Part {
                first: p,
                step: self.parts,
            };
            each(part, values);
        }
    }

    /// w^(k p) over `range`, some at a time: `each` gets the first k, k mod M, and the powers.
    fn turned(
        &self,
        range: Range<usize>,
        p: usize,
        mut each: impl FnMut(usize, usize, &mut [Complex<f64>]),
    ) {
        let unit = |power: usize| {
            let angle = TAU * (power % self.length) as f64 / self.length as f64;
            Complex::from_polar(1.0, angle)
        };
        let fine: [Complex<f64>; BLOCK] = std::array::from_fn(|i| unit(i * p));
        let m = self.length / self.parts;
        let mut turns = fine;
        let mut k = range.start;
        while k < range.end {
            let j = k % m;
            let count = BLOCK.min(range.end - k).min(m - j);
            let coarse = unit(k * p);
            for (turn, fine) in turns.iter_mut().zip(&fine) {
                *turn = coarse * fine;
            }
            each(k, j, &mut turns[..count]);
            k += count;
        }
    }
}

/// Which samples a part has.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) first: usize,
    pub(super) step: usize,
}

/// Into how many parts a signal goes: the fewest that are short enough, or as many as may be; two or more where its length can be divided,
/// as two real parts are transformed in one.
fn parts(length: usize) -> usize {
    let fits = || (2..=MOST_PARTS).filter(|p| length.is_multiple_of(*p));
    let short = fits().find(|p| length / p <= LONGEST);
    short.or(fits().next_back()).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use realfft::RealFftPlanner;

    use super::super::test_signals::Noise;
    use super::*;

    /// Whatever the factors of a length, the transform and its inverse are those of one piece.
    #[test]
    fn xval_realfft() {
        for length in [1, 8, 9, 30, 97, 1024, 2 * 1013, 3 * 4096, 7 << 18, 3 << 20] {
            let x = Noise::new(length as u64).normals(length);
            let forward = RealFftPlanner::new().plan_fft_forward(length);
            let (mut input, mut expected) = (x.clone(), forward.make_output_vec());
            forward.process(&mut input, &mut expected).unwrap();
            let plan = Interleaved::new(length);
            let mut room = plan.room();
            let bins = plan.forward(&x, &mut room);
            assert_eq!(bins.len(), expected.len());
            let size = (length as f64).sqrt();
            for (k, (a, b)) in bins.iter().zip(&expected).enumerate() {
                assert!((a - b).norm() < 1e-13 * size, "{length} {k}: {a} {b}");
            }
            // Positive frequencies twice and zero once: the real part is the signal.
            let mut back = vec![f64::NAN; length];
            plan.backward(
                &bins,
                0..length.div_ceil(2),
                &mut room,
                |k, _, factors| {
                    for (i, factor) in factors.iter_mut().enumerate() {
                        *factor *= if k + i == 0 { 1.0 } else { 2.0 } / length as f64;
                    }
                },
                |part, values| {
                    for (q, value) in values.iter().enumerate() {
                        back[part.first + part.step * q] = value.re;
                    }
                },
            );
            let half = if length % 2 == 0 && length > 1 {
                bins[length / 2].re / length as f64
            } else {
                0.0
            };
            for (i, (a, b)) in back.iter().zip(&x).enumerate() {
                let alternating = if i % 2 == 0 { half } else { -half };
                assert!((a + alternating - b).abs() < 1e-13 * size, "{length} {i}");
            }
        }
    }

    #[test]
    fn regress_parts() {
        for (length, expected) in [
            (7, 7),
            (13, 13),
            (17, 1),
            (512_000, 2),
            (1 << 22, 8),
            (1 << 25, 16),
        ] {
            assert_eq!(parts(length), expected, "{length}");
        }
    }
}
