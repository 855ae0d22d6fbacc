//! Places in the unit cube that runs draw their values at: at random, in a Latin hypercube, along a Sobol sequence.

use super::stream::bits;
use crate::calibrate::search::latin_hypercube;
use sobol::params::JoeKuoD6;

/// Sobol's sequence with the direction numbers of Joe and Kuo (2008), table new-joe-kuo-6, in the order of Antonov and
/// Saleev (Gray code): point n by its number, without those before it.
///
/// A shift moves every point by the same bits in each dimension (a digital shift): the points stay as even as they
/// were, no two seeds have the same ones, and the first one is not the corner of the cube.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sobol {
    directions: Vec<Vec<u32>>,
    shift: Vec<u32>,
}

/// Bits of a place.
const BITS: u32 = 32;

impl Sobol {
    /// Most dimensions: those of the table that comes with the program.
    pub const MOST: usize = 100;

    /// The sequence in at most [`Sobol::MOST`] dimensions, without a shift.
    pub fn new(dimensions: usize) -> Self {
        let parameters = JoeKuoD6::minimal();
        Self {
            directions: sobol::Sobol::<u32>::init_direction_vals(dimensions, BITS as usize, &parameters),
            shift: vec![0; dimensions],
        }
    }

    /// The same, shifted by what belongs to a seed.
    #[must_use]
    pub fn shifted(mut self, seed: u64) -> Self {
        for (axis, shift) in self.shift.iter_mut().enumerate() {
            *shift = (bits(&[seed, axis as u64]) >> 32) as u32;
        }
        self
    }

    /// Coordinate of point `n` along `axis`, a multiple of 2^-32 in [0, 1).
    pub fn coordinate(&self, n: u32, axis: usize) -> f64 {
        let gray = n ^ (n >> 1);
        let directions = self.directions[axis].iter().enumerate();
        let set = directions.filter(|(bit, _)| gray >> bit & 1 == 1);
        let x = set.fold(self.shift[axis], |x, (_, direction)| x ^ direction);
        f64::from(x) / 2_f64.powi(BITS as i32)
    }
}

/// Where the runs of one class draw.
#[derive(Debug, Clone)]
pub(super) enum Sequence {
    /// Each for itself.
    Random,
    /// One run in each slice of each axis.
    Latin(Vec<Vec<f64>>),
    /// Evenly, however many there are.
    Sobol(Sobol),
}

impl Sequence {
    pub(super) fn latin(seed: u64, dimensions: usize, runs: usize) -> Self {
        Self::Latin(latin_hypercube(seed, dimensions, runs))
    }

    /// Place of run `n` of its class along `axis`; `None` where each run draws for itself.
    pub(super) fn place(&self, n: usize, axis: usize) -> Option<f64> {
        match self {
            Self::Random => None,
            Self::Latin(points) => Some(points[n][axis]),
            Self::Sobol(sobol) => Some(sobol.coordinate(n as u32, axis)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn xval_sobol_is_scipys() {
        // SciPy 1.17.1: scipy.stats.qmc.Sobol(8, scramble=False).random(6)[2:].
        let sobol = Sobol::new(8);
        let expected = [
            [0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.25, 0.75],
            [0.25, 0.75, 0.75, 0.75, 0.25, 0.25, 0.75, 0.25],
            [0.375, 0.375, 0.625, 0.875, 0.375, 0.125, 0.375, 0.875],
            [0.875, 0.875, 0.125, 0.375, 0.875, 0.625, 0.875, 0.375],
        ];
        // And random(16)[[8, 15]], of the fourth direction numbers.
        let further = [
            [0.1875, 0.3125, 0.9375, 0.4375, 0.5625, 0.3125, 0.4375, 0.9375],
            [0.0625, 0.9375, 0.5625, 0.3125, 0.6875, 0.1875, 0.8125, 0.3125],
        ];
        for (n, point) in (2..).zip(&expected).chain([8, 15].into_iter().zip(&further)) {
            let found: [f64; 8] = std::array::from_fn(|axis| sobol.coordinate(n, axis));
            assert_eq!(found, *point, "point {n}");
        }
    }

    #[test]
    fn prop_every_stretch_of_two_to_the_m_points_is_stratified() {
        // Each dimension of a Sobol sequence is a (0, 1)-sequence in base 2: of 2^m points from a multiple of 2^m on,
        // one lies in each slice of 2^-m, and a digital shift keeps that.
        for sobol in [Sobol::new(100), Sobol::new(100).shifted(5)] {
            for m in 0..9 {
                let count = 1_u32 << m;
                for axis in 0..100 {
                    for start in [0, 3 * count] {
                        let mut seen = vec![false; count as usize];
                        for n in start..start + count {
                            let slice = (sobol.coordinate(n, axis) * f64::from(count)) as usize;
                            assert!(!std::mem::replace(&mut seen[slice], true));
                        }
                    }
                }
            }
        }
    }
}
