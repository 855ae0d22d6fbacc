//! Fits a plane or a cylinder to the undamaged part of a scan.
//!
//! Heights in mm, up out of the material, at (s, z) in mm from the grid's centre:
//!
//! ```text
//! H = c + b z + y(s - m z),   y(x) = x (k x + 2 p) / (sqrt(1 - p^2) + sqrt(1 - (k x + p)^2))
//! ```
//!
//! y is the circle of curvature k through (0, 0) with slope angle asin(p) there; at k = 0 it is a straight line, and
//! nothing is singular on the way. Gauss-Newton steps, first with weights 1/|residual| (so that damage pulls little),
//! then on the better half of the points (Rousseeuw's concentration steps), then on the points within three robust
//! standard deviations of the surface, or within the threshold, until that set stays.

use crate::error::DamageError;
use crate::numbers::{median, solved};
use crate::scan::Scan;
use brinell::scenario::{ScanFile, ScanForm};

/// More points than this add time, not accuracy.
const MAX_SAMPLES: usize = 100_000;
/// Fewer than this are no surface.
const MIN_SAMPLES: usize = 16;
const SOFT_PASSES: usize = 25;
const HALF_PASSES: usize = 40;
const HARD_PASSES: usize = 60;
/// The standard deviation of a normal distribution over its median absolute deviation.
const MAD_TO_SIGMA: f64 = 1.4826;
/// Residuals below a picometre are round-off.
const ROUND_OFF_MM: f64 = 1e-9;

/// `[c, b, p, m, k]`.
type Parameters = [f64; 5];
const C: usize = 0;
const B: usize = 1;
const P: usize = 2;
const M: usize = 3;
const K: usize = 4;

struct Sample {
    s: f64,
    z: f64,
    height: f64,
}

/// The circle, and its slope; `None` past its end.
fn circle(p: f64, k: f64, x: f64) -> Option<[f64; 2]> {
    let u = k * x + p;
    let (start, end) = (1.0 - p * p, 1.0 - u * u);
    if !(start > 0.0 && end > 0.0) {
        return None;
    }
    let w = end.sqrt();
    Some([x * (k * x + 2.0 * p) / (start.sqrt() + w), u / w])
}

fn height(q: &Parameters, s: f64, z: f64) -> Option<f64> {
    Some(q[C] + q[B] * z + circle(q[P], q[K], s - q[M] * z)?[0])
}

/// Takes the form that is asked for off the scan's depths, along the depth and not along its normal. Gives how many of
/// the points that were looked at are on it, and how many lie apart, as damage does.
pub(crate) fn remove(scan: &mut Scan, options: &ScanFile) -> Result<Option<(usize, usize)>, DamageError> {
    let samples = samples(scan);
    let Some((best, found)) = fit(&samples, options)? else {
        return Ok(None);
    };
    for row in 0..scan.rows {
        for column in 0..scan.columns {
            let (s, z) = scan.place(column, row);
            let surface = height(&best, s, z)
                .ok_or_else(|| DamageError::NoFit { form: "cylinder", why: "it ends inside the scan".to_owned() })?;
            scan.depth_um[row * scan.columns + column] += 1e3 * surface;
        }
    }
    Ok(Some((found.used, samples.len() - found.used)))
}

/// The form that is asked for. What lies closer to the surface than the threshold always belongs to it.
fn fit(samples: &[Sample], options: &ScanFile) -> Result<Option<(Parameters, Found)>, DamageError> {
    let fit = |name, free: &[usize], k| {
        Fit { samples, free, weights: vec![1.0; samples.len()], floor: (1e-3 * options.threshold_um).max(ROUND_OFF_MM) }
            .run(name, k)
    };
    let found = match (options.remove_form, options.radius_mm) {
        (ScanForm::None, _) => return Ok(None),
        (ScanForm::Plane, _) => fit("plane", &[C, B, P], 0.0)?,
        (ScanForm::Cylinder, None) => fit("cylinder", &[C, B, P, M, K], 0.0)?,
        (ScanForm::Cylinder, Some(radius)) => {
            let free = [C, B, P, M];
            match (fit("cylinder", &free, 1.0 / radius), fit("cylinder", &free, -1.0 / radius)) {
                (Ok(hollow), Ok(bulging)) if bulging.1.typical < hollow.1.typical => bulging,
                (Ok(hollow), _) => hollow,
                (Err(_), other) => other?,
            }
        }
    };
    Ok(Some(found))
}

/// Points that have a value, thinned evenly.
fn samples(scan: &Scan) -> Vec<Sample> {
    let step = (scan.depth_um.len() as f64 / MAX_SAMPLES as f64).sqrt().ceil().max(1.0) as usize;
    let mut samples = Vec::new();
    for row in (0..scan.rows).step_by(step) {
        for column in (0..scan.columns).step_by(step) {
            let depth = scan.depth_um[row * scan.columns + column];
            if depth.is_finite() {
                let (s, z) = scan.place(column, row);
                let height = -1e-3 * depth;
                samples.push(Sample { s, z, height });
            }
        }
    }
    samples
}

struct Found {
    used: usize,
    /// The median absolute residual over all samples.
    typical: f64,
}

struct Fit<'a> {
    samples: &'a [Sample],
    free: &'a [usize],
    weights: Vec<f64>,
    /// Closer than this to the surface belongs to it, mm.
    floor: f64,
}

impl Fit<'_> {
    fn run(mut self, form: &'static str, curvature: f64) -> Result<(Parameters, Found), DamageError> {
        let no_fit = |why: String| DamageError::NoFit { form, why };
        if self.samples.len() < MIN_SAMPLES {
            return Err(no_fit(format!(
                "it has {} points with a value; at least {MIN_SAMPLES} are needed",
                self.samples.len()
            )));
        }
        let middle = median(self.samples.iter().map(|p| p.height));
        let mut q = [middle, 0.0, 0.0, 0.0, curvature];
        let past_end =
            || no_fit("the scan is longer than the cylinder is wide; check the radius and `ds_mm`".to_owned());
        for _ in 0..SOFT_PASSES {
            q = self.step(&q).ok_or_else(past_end)?;
            let residuals = self.residuals(&q).ok_or_else(past_end)?;
            let typical = median(residuals.iter().map(|r| r.abs()));
            let least = (0.1 * typical).max(ROUND_OFF_MM);
            for (weight, r) in self.weights.iter_mut().zip(&residuals) {
                *weight = least / r.abs().max(least);
            }
        }
        for _ in 0..HALF_PASSES {
            let residuals = self.residuals(&q).ok_or_else(past_end)?;
            let typical = median(residuals.iter().map(|r| r.abs()));
            let mut changed = false;
            for (weight, r) in self.weights.iter_mut().zip(&residuals) {
                let kept = if r.abs() <= typical { 1.0 } else { 0.0 };
                changed |= *weight != kept;
                *weight = kept;
            }
            if !changed {
                break;
            }
            q = self.step(&q).ok_or_else(past_end)?;
        }
        let mut steady = 0;
        for _ in 0..HARD_PASSES {
            let residuals = self.residuals(&q).ok_or_else(past_end)?;
            let typical = median(residuals.iter().map(|r| r.abs()));
            let limit = (3.0 * MAD_TO_SIGMA * typical).max(self.floor);
            let mut changed = false;
            for (weight, r) in self.weights.iter_mut().zip(&residuals) {
                let kept = if r.abs() <= limit { 1.0 } else { 0.0 };
                changed |= *weight != kept;
                *weight = kept;
            }
            q = self.step(&q).ok_or_else(past_end)?;
            // A few steps more on the set that stays, to converge on it.
            steady = if changed { 0 } else { steady + 1 };
            if steady > 6 {
                break;
            }
        }
        let residuals = self.residuals(&q).ok_or_else(past_end)?;
        let found = Found {
            used: self.weights.iter().filter(|&&w| w > 0.0).count(),
            typical: median(residuals.iter().map(|r| r.abs())),
        };
        Ok((q, found))
    }

    fn residuals(&self, q: &Parameters) -> Option<Vec<f64>> {
        self.samples.iter().map(|p| Some(p.height - height(q, p.s, p.z)?)).collect()
    }

    fn cost(&self, q: &Parameters) -> Option<f64> {
        let residuals = self.residuals(q)?;
        Some(residuals.iter().zip(&self.weights).map(|(r, w)| w * r * r).sum())
    }

    /// One Gauss-Newton step with the present weights, shortened until it does not make things worse.
    fn step(&self, q: &Parameters) -> Option<Parameters> {
        let n = self.free.len();
        let mut normal = [[0.0; 6]; 5];
        let reach = self.samples.iter().fold(1e-6_f64, |most, p| most.max(p.s.abs()));
        // Differences for the slope and the curvature: their closed forms are singular where either vanishes.
        let nudge = [1e-6, 1e-6 / reach];
        for (p, &weight) in self.samples.iter().zip(&self.weights) {
            if weight == 0.0 {
                continue;
            }
            let x = p.s - q[M] * p.z;
            let [y, slope] = circle(q[P], q[K], x)?;
            let by = |dp: f64, dk: f64| -> Option<f64> {
                Some(circle(q[P] + dp, q[K] + dk, x)?[0] - circle(q[P] - dp, q[K] - dk, x)?[0])
            };
            let residual = p.height - q[C] - q[B] * p.z - y;
            let mut gradient = [0.0; 5];
            for (slot, &parameter) in gradient.iter_mut().zip(self.free) {
                *slot = match parameter {
                    C => 1.0,
                    B => p.z,
                    P => by(nudge[0], 0.0)? / (2.0 * nudge[0]),
                    M => -p.z * slope,
                    _ => by(0.0, nudge[1])? / (2.0 * nudge[1]),
                };
            }
            for i in 0..n {
                for j in 0..n {
                    normal[i][j] += weight * gradient[i] * gradient[j];
                }
                normal[i][5] += weight * gradient[i] * residual;
            }
        }
        // On a plane the axis's turn cannot be told from a slope: the damping leaves it where it is.
        let trace: f64 = (0..n).map(|i| normal[i][i]).sum();
        for i in 0..n {
            normal[i][i] += 1e-9 * normal[i][i] + 1e-12 * trace;
        }
        let change = solved(&mut normal[..n], 0.0)?;
        let before = self.cost(q)?;
        let mut share = 1.0;
        for _ in 0..20 {
            let mut next = *q;
            for (i, &parameter) in self.free.iter().enumerate() {
                next[parameter] += share * change[i];
            }
            if self.cost(&next).is_some_and(|cost| cost <= before) {
                return Some(next);
            }
            share *= 0.5;
        }
        Some(*q)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brinell::random::Random;

    #[test]
    fn analytic_noise_and_a_large_spall_hardly_move_the_parameters() {
        // A raceway of 27.5 mm, tilted and turned, with 0.2 um of noise; a fifth of it is 25 um deep.
        let truth = [0.1, 0.002, 0.003, 0.02, 1.0 / 27.5];
        let mut noise = Random::new(5);
        let samples: Vec<Sample> = (0..8000)
            .map(|k| {
                let (s, z) = (0.06 * f64::from(k % 100 - 50), 0.06 * f64::from(k / 100 - 40));
                let depth = if (s - 0.4).abs() < 1.2 && z.abs() < 1.2 { 0.025 } else { 0.0 };
                Sample { s, z, height: height(&truth, s, z).unwrap() - depth + 2e-4 * noise.normal() }
            })
            .collect();
        let options = ScanFile { remove_form: ScanForm::Cylinder, threshold_um: 2.0, ..ScanFile::default() };
        let (found, counts) = fit(&samples, &options).unwrap().unwrap();
        assert!((found[K] / truth[K] - 1.0).abs() < 0.01, "radius {}", 1.0 / found[K]);
        for (of, bound) in [(C, 1e-4), (B, 5e-5), (P, 5e-5), (M, 2e-3)] {
            assert!((found[of] - truth[of]).abs() < bound, "{of}: {} for {}", found[of], truth[of]);
        }
        let damaged = samples.iter().filter(|p| (p.s - 0.4).abs() < 1.2 && p.z.abs() < 1.2).count();
        assert_eq!(counts.used, samples.len() - damaged);
    }
}
