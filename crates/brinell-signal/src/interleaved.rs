//! Transforms of long signals in interleaved parts, each of which fits a processor's cache.
//!
//! Every P-th of N samples, from the p-th on, has a transform F_p of its own, L = N / P long. With w = e^(2 pi i / N)
//! the whole one's is X_(j + L r) = sum over p of e^(-2 pi i r p / P) (w^(-j p) F_p[j]), and backward the samples p, p +
//! P, p + 2 P, ... are the transform of length L of w^(j p) times the sum over r of e^(2 pi i r p / P) X_(j + L r) (J.
//! W. Cooley and J. W. Tukey, Math. Comput. 19 (1965) 297-301): transforms of length P across the parts, and of length
//! L along them. The tables of one transform of four million values take longer to make than the transform itself, and
//! as much memory as its values.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

use realfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// Values of a part, where the signal's length can be divided so.
const LONGEST: usize = 1 << 17;
/// Parts at most.
const MOST_PARTS: usize = 32;
/// Places of all parts that are transformed across at a time.
const BLOCK: usize = 128;

/// How signals of one length are transformed.
pub(super) struct Interleaved {
    length: usize,
    parts: usize,
    /// Backward, along a part; forward is its complex conjugate.
    along: Arc<dyn Fft<f64>>,
    /// Backward, across the parts.
    across: Arc<dyn Fft<f64>>,
    /// w^(i p) for the places i of a block, part by part.
    turns: Vec<Complex<f64>>,
}

/// What one thread transforms in; fits whatever it is used for.
#[derive(Default)]
pub(super) struct Room {
    values: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

/// Some samples of a part.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// The first one's place in the signal.
    pub(super) first: usize,
    /// From one to the next.
    pub(super) step: usize,
}

impl Interleaved {
    /// With tables from a planner, which keeps those of every length of a part.
    pub(super) fn planned(length: usize, planner: &mut FftPlanner<f64>) -> Self {
        let parts = parts(length);
        let mut plan = Interleaved {
            length,
            parts,
            along: planner.plan_fft_inverse(length / parts),
            across: planner.plan_fft_inverse(parts),
            turns: Vec::new(),
        };
        let turns = (0..parts).flat_map(|p| (0..BLOCK).map(move |i| (i, p)));
        plan.turns = turns.map(|(i, p)| plan.unit(i * p)).collect();
        plan
    }

    /// w to a power.
    fn unit(&self, power: usize) -> Complex<f64> {
        let angle = TAU * (power % self.length) as f64 / self.length as f64;
        Complex::from_polar(1.0, angle)
    }

    /// Bins 0 to N / 2 of the transform of `x`.
    pub(super) fn forward(&self, x: &[f64], room: &mut Room) -> Vec<Complex<f64>> {
        let parts = self.parts;
        let long = self.length / parts;
        // Two real parts make one complex transform.
        let pairs = parts.div_ceil(2);
        self.fit(room, pairs * long);
        let Room { values, scratch } = room;
        let halves = &mut values[..pairs * long];
        // A block of the signal after the other, for it is read once.
        for (block, x) in x[..self.length].chunks(BLOCK * parts).enumerate() {
            for (pair, values) in halves.chunks_exact_mut(long).enumerate() {
                let p = 2 * pair;
                let groups = x.chunks_exact(parts);
                for (value, group) in values[block * BLOCK..].iter_mut().zip(groups) {
                    let second = group.get(p + 1).copied().unwrap_or(0.0);
                    *value = Complex::new(group[p], -second);
                }
            }
        }
        self.along.process_with_scratch(halves, scratch);
        let mut bins = vec![Complex::ZERO; self.length / 2 + 1];
        let mut block = vec![Complex::ZERO; BLOCK * parts];
        for first in (0..long).step_by(BLOCK) {
            let count = BLOCK.min(long - first);
            let block = &mut block[..count * parts];
            // Complex conjugates of w^(-j p) F_p[j].
            for (pair, values) in halves.chunks_exact(long).enumerate() {
                let p = 2 * pair;
                let coarse = [self.unit(first * p), self.unit(first * (p + 1))];
                let turns = [p, p + 1].map(|p| self.turns.get(p * BLOCK..).unwrap_or_default());
                for (i, places) in block.chunks_exact_mut(parts).enumerate() {
                    let j = first + i;
                    // Conjugate of the transform of both, and the transform at the mirrored place.
                    let z = values[j];
                    let mirrored = values[if j == 0 { 0 } else { long - j }].conj();
                    places[p] = 0.5 * (z + mirrored) * (coarse[0] * turns[0][i]);
                    if let Some(place) = places.get_mut(p + 1) {
                        let d = z - mirrored;
                        let second = Complex::new(-0.5 * d.im, 0.5 * d.re);
                        *place = second * (coarse[1] * turns[1][i]);
                    }
                }
            }
            self.across.process_with_scratch(block, scratch);
            for r in 0..=parts / 2 {
                let from = (first + r * long).min(bins.len());
                for (bin, places) in bins[from..].iter_mut().zip(block.chunks_exact(parts)) {
                    *bin = places[r].conj();
                }
            }
        }
        bins
    }

    /// The complex signal that has the bins of `range` and no others, N times as large: `each` gets some samples p, p +
    /// P, ... of one of P parts, after those of the other parts about there. `bins` are those from 0 on, of a transform
    /// of any length: with N or fewer in `range`, the samples are the signal's at N equal steps. `shape` gets the
    /// number of the first of some bins, these, and where to put what shall represent them.
    pub(super) fn backward(
        &self,
        bins: &[Complex<f64>],
        range: Range<usize>,
        room: &mut Room,
        mut shape: impl FnMut(usize, &[Complex<f64>], &mut [Complex<f64>]),
        mut each: impl FnMut(Place, &[Complex<f64>]),
    ) {
        let parts = self.parts;
        let long = self.length / parts;
        assert!(range.len() <= self.length, "more bins than samples");
        self.fit(room, self.length);
        let Room { values, scratch } = room;
        let values = &mut values[..self.length];
        let mut block = vec![Complex::ZERO; BLOCK * parts];
        let mut shaped = [Complex::ZERO; BLOCK];
        for first in (0..long).step_by(BLOCK) {
            let count = BLOCK.min(long - first);
            let block = &mut block[..count * parts];
            block.fill(Complex::ZERO);
            for round in range.start / long..=range.end / long {
                let here = first + round * long;
                let (from, to) = (range.start.max(here), range.end.min(here + count));
                if from < to {
                    let shaped = &mut shaped[..to - from];
                    shape(from, &bins[from..to], shaped);
                    let places = block[(from - here) * parts..].chunks_exact_mut(parts);
                    for (places, value) in places.zip(shaped) {
                        places[round % parts] = *value;
                    }
                }
            }
            self.across.process_with_scratch(block, scratch);
            for (p, values) in values.chunks_exact_mut(long).enumerate() {
                let (coarse, turns) = (self.unit(first * p), &self.turns[p * BLOCK..]);
                let places = block.chunks_exact(parts).zip(turns);
                for (value, (places, turn)) in values[first..].iter_mut().zip(places) {
                    *value = places[p] * (coarse * turn);
                }
            }
        }
        self.along.process_with_scratch(values, scratch);
        for first in (0..long).step_by(BLOCK) {
            for (p, values) in values.chunks_exact(long).enumerate() {
                let place = Place { first: p + parts * first, step: parts };
                each(place, &values[first..long.min(first + BLOCK)]);
            }
        }
    }

    fn fit(&self, room: &mut Room, values: usize) {
        let fit = |room: &mut Vec<Complex<f64>>, length: usize| {
            if room.len() < length {
                room.resize(length, Complex::ZERO);
            }
        };
        let needed = [&self.along, &self.across].map(|fft| fft.get_inplace_scratch_len());
        fit(&mut room.values, values);
        fit(&mut room.scratch, needed[0].max(needed[1]));
    }
}

/// Into how many parts a signal goes: the fewest that are short enough, or as many as may be; two or more where its
/// length can be divided, as two real parts are transformed in one.
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
            let plan = Interleaved::planned(length, &mut FftPlanner::new());
            let mut room = Room::default();
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
                |k, bins, shaped| {
                    for (i, (shaped, bin)) in shaped.iter_mut().zip(bins).enumerate() {
                        *shaped = bin * if k + i == 0 { 1.0 } else { 2.0 } / length as f64;
                    }
                },
                |place, values| {
                    for (q, value) in values.iter().enumerate() {
                        back[place.first + place.step * q] = value.re;
                    }
                },
            );
            let half = if length % 2 == 0 && length > 1 { bins[length / 2].re / length as f64 } else { 0.0 };
            for (i, (a, b)) in back.iter().zip(&x).enumerate() {
                let alternating = if i % 2 == 0 { half } else { -half };
                assert!((a + alternating - b).abs() < 1e-13 * size, "{length} {i}");
            }
        }
    }

    /// Fewer samples than there were, or more, are those of the same signal at other times.
    #[test]
    fn analytic_samples_at_other_times() {
        let bins: Vec<Complex<f64>> = (0..4000).map(|k| Complex::new((k % 7) as f64 - 3.0, (k % 5) as f64)).collect();
        let range = 1203..1297;
        for length in [97, 600, 2 * 3 * 1024, 9 << 17] {
            let at = |n: usize| -> Complex<f64> {
                let angle = |k: usize| TAU * (k * n % length) as f64 / length as f64;
                (range.clone()).map(|k| bins[k] * Complex::from_polar(1.0, angle(k))).sum()
            };
            let mut seen = 0;
            Interleaved::planned(length, &mut FftPlanner::new()).backward(
                &bins,
                range.clone(),
                &mut Room::default(),
                |_, bins, shaped| shaped.copy_from_slice(bins),
                |place, values| {
                    seen += values.len();
                    let value = values.len() - 1;
                    let expected = at(place.first + place.step * value);
                    assert!((values[value] - expected).norm() < 1e-10, "{length}");
                },
            );
            assert_eq!(seen, length);
        }
    }

    #[test]
    fn regress_parts() {
        for (length, expected) in [(7, 7), (13, 13), (37, 1), (512_000, 4), (1 << 22, 32), (1 << 25, 32)] {
            assert_eq!(parts(length), expected, "{length}");
        }
    }
}
