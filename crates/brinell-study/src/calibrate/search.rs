//! Where to look next: a Latin hypercube, a particle swarm, and Levenberg and Marquardt's method. All in the unit cube;
//! knows no bearing.
//!
//! Points are requested in batches, and a batch does not depend on how many threads answer it or in which order. A
//! search is a function of its seed and the answers alone: asked again with the same answers, it asks for the same
//! points. That is how an interrupted one goes on.

use super::target::MISSING;
use argmin::core::{CostFunction, Error, Executor, PopulationState};
use argmin::solver::particleswarm::{Particle, ParticleSwarm};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use std::cell::{Cell, RefCell};

/// Why a search ends before its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Halt {
    /// The points that it may ask for are used up.
    Budget,
    /// Somebody stopped it.
    Interrupted,
}

/// Answers a batch of points with their residuals; `None` for one that failed.
pub type Ask<'a> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Halt> + 'a;

/// Half the distance of a difference at least, in the unit cube; twice that where runs state an uncertainty of their
/// own: a chaotic run is uncertain by per cents, which closer points would take for a slope.
pub const STEP: f64 = 0.05;
/// Residual of a failed point for the local search, which then shortens its step.
const FAILED: f64 = 1e4;
/// Weight that brings the local search back into the cube.
const WALL: f64 = 100.0;

/// Sum of squares; infinite for a failed point.
pub fn chi_square(residuals: Option<&[f64]>) -> f64 {
    residuals.map_or(f64::INFINITY, |r| r.iter().map(|x| x * x).sum())
}

/// `count` points that have one in each of `count` slices of each axis, at random places within them.
pub fn latin_hypercube(seed: u64, dimensions: usize, count: usize) -> Vec<Vec<f64>> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut points = vec![vec![0.0; dimensions]; count];
    for axis in 0..dimensions {
        let mut slices: Vec<usize> = (0..count).collect();
        for k in (1..count).rev() {
            slices.swap(k, (random.next_u64() % (k as u64 + 1)) as usize);
        }
        for (point, slice) in points.iter_mut().zip(slices) {
            let within = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            point[axis] = (slice as f64 + within) / count as f64;
        }
    }
    points
}

/// A swarm's cost, in batches.
struct Swarmed<'a, 'b> {
    ask: &'a RefCell<&'b mut Ask<'b>>,
    halt: &'a Cell<Option<Halt>>,
}

impl CostFunction for Swarmed<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.bulk_cost(std::slice::from_ref(point))?[0])
    }

    fn bulk_cost<P: std::borrow::Borrow<Vec<f64>>>(&self, points: &[P]) -> Result<Vec<f64>, Error> {
        let points: Vec<Vec<f64>> = points.iter().map(|p| p.borrow().clone()).collect();
        match (self.ask.borrow_mut())(&points) {
            Ok(answers) => Ok(answers.iter().map(|a| chi_square(a.as_deref())).collect()),
            Err(halt) => {
                self.halt.set(Some(halt));
                Err(Error::msg("no more points"))
            }
        }
    }
}

/// A swarm of particles that begin at `population`, points with their chi-square, for so many rounds.
///
/// # Errors
/// Where it was not answered.
pub fn swarm<'b>(
    ask: &RefCell<&'b mut Ask<'b>>,
    population: &[(Vec<f64>, f64)],
    rounds: u64,
    seed: u64,
) -> Result<(), Halt> {
    let Some((first, _)) = population.first() else {
        return Ok(());
    };
    let dimensions = first.len();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed ^ 0x5357_4152_4D00_0001);
    // A particle's first velocity leads half-way to a random place.
    let particles: Vec<Particle<Vec<f64>, f64>> = population
        .iter()
        .map(|(position, cost)| {
            let velocity = position.iter().map(|x| {
                let place = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
                0.5 * (place - x)
            });
            Particle::new(position.clone(), *cost, velocity.collect())
        })
        .collect();
    let halt = Cell::new(None);
    let problem = Swarmed { ask, halt: &halt };
    let bounds = (vec![0.0; dimensions], vec![1.0; dimensions]);
    let solver = ParticleSwarm::new(bounds, particles.len()).with_rng_generator(random);
    let result = Executor::new(problem, solver)
        .configure(|state: PopulationState<Particle<Vec<f64>, f64>, f64>| state.population(particles).max_iters(rounds))
        .run();
    match (result, halt.get()) {
        (_, Some(halt)) => Err(halt),
        // A cost that is not a number cannot come: failed points cost infinity.
        _ => Ok(()),
    }
}

/// Residuals by differences, for the least-squares solver. Its parameters may leave the cube; what is requested does
/// not.
struct Local<'a, 'b> {
    ask: &'a RefCell<&'b mut Ask<'b>>,
    halt: Cell<Option<Halt>>,
    place: Vec<f64>,
    residuals: Option<Vec<f64>>,
    count: usize,
    step: f64,
}

impl Local<'_, '_> {
    fn inside(&self) -> Vec<f64> {
        self.place.iter().map(|x| x.clamp(0.0, 1.0)).collect()
    }

    fn answer(&self, points: &[Vec<f64>]) -> Option<Vec<Option<Vec<f64>>>> {
        match (self.ask.borrow_mut())(points) {
            Ok(answers) => Some(answers),
            Err(halt) => {
                self.halt.set(Some(halt));
                None
            }
        }
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Local<'_, '_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, place: &DVector<f64>) {
        self.place = place.iter().copied().collect();
        self.residuals = self.answer(&[self.inside()]).map(|mut answers| {
            let failed = vec![FAILED; self.count];
            answers.pop().flatten().unwrap_or(failed)
        });
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_vec(self.place.clone())
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let mut all = self.residuals.clone()?;
        all.extend(self.place.iter().map(|x| WALL * (x - x.clamp(0.0, 1.0))));
        Some(DVector::from_vec(all))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let steps = vec![self.step; self.place.len()];
        let inside = self.inside();
        let points = around(&inside, &steps);
        let answers = self.answer(&points)?;
        let middle = self.residuals.as_ref()?;
        let slopes = slopes(&inside, middle, &points, &answers);
        let (rows, columns) = (self.count + self.place.len(), self.place.len());
        Some(DMatrix::from_fn(rows, columns, |row, column| {
            let out = !(0.0..=1.0).contains(&self.place[column]);
            match row.checked_sub(self.count) {
                None if out => 0.0,
                None => slopes[(row, column)],
                Some(wall) if wall == column && out => WALL,
                Some(_) => 0.0,
            }
        }))
    }
}

/// Two points for each axis, `steps` to either side; at a wall, the one that leads into it lies on it.
pub fn around(place: &[f64], steps: &[f64]) -> Vec<Vec<f64>> {
    let mut points = Vec::with_capacity(2 * place.len());
    for (axis, step) in steps.iter().enumerate() {
        for direction in [-1.0, 1.0] {
            let mut point = place.to_vec();
            point[axis] = (point[axis] + direction * step).clamp(0.0, 1.0);
            points.push(point);
        }
    }
    points
}

/// Slopes of the residuals along each axis, from the answers to [`around`]: between both sides, or from the middle
/// where one failed or has not the number that the middle has; zero where both did.
pub fn slopes(place: &[f64], middle: &[f64], points: &[Vec<f64>], answers: &[Option<Vec<f64>>]) -> DMatrix<f64> {
    let mut slopes = DMatrix::zeros(middle.len(), place.len());
    for axis in 0..place.len() {
        for row in 0..middle.len() {
            // That a number is lost is no slope of it.
            let known = |of: &&[f64]| of[row] != MISSING || middle[row] == MISSING;
            let side = |k: usize| match answers[2 * axis + k].as_deref().filter(known) {
                Some(found) => (points[2 * axis + k][axis], found[row]),
                None => (place[axis], middle[row]),
            };
            let ((low, below), (high, above)) = (side(0), side(1));
            if high > low {
                slopes[(row, axis)] = (above - below) / (high - low);
            }
        }
    }
    slopes
}

/// Downhill from a point to where the sum of squares falls no more, by differences over `step` to either side.
///
/// # Errors
/// Where it was not answered.
pub fn local<'b>(ask: &RefCell<&'b mut Ask<'b>>, start: &[f64], residuals: usize, step: f64) -> Result<(), Halt> {
    let mut problem =
        Local { ask, halt: Cell::new(None), place: start.to_vec(), residuals: None, count: residuals, step };
    problem.set_params(&DVector::from_column_slice(start));
    // Finer than a thousandth of the sum of squares, or of the range, is finer than the noise of a run.
    let method = LevenbergMarquardt::new().with_ftol(1e-3).with_xtol(1e-3).with_gtol(1e-6).with_stepbound(0.5);
    let (problem, _) = method.minimize(problem);
    match problem.halt.get() {
        Some(halt) => Err(halt),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_number_that_neighbours_lose_has_the_slope_of_the_side_that_has_it() {
        let place = [0.5];
        let points = around(&place, &[0.1]);
        let answers = [Some(vec![MISSING, 1.0, MISSING, 2.0]), Some(vec![3.0, 2.0, MISSING, MISSING])];
        let slopes = slopes(&place, &[1.0, 1.5, 0.0, MISSING], &points, &answers);
        for (row, expected) in [20.0, 5.0, 0.0, 40.0].into_iter().enumerate() {
            assert!((slopes[(row, 0)] - expected).abs() < 1e-9, "{row}: {slopes}");
        }
    }
}
