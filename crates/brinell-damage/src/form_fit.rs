//! Fits a plane, a cylinder or a torus to the undamaged part of a scan.
//!
//! Heights in mm, up out of the material, at (s, z) in mm from the grid's centre:
//!
//! ```text
//! H = c + b z + (x (k x + 2 p) + y (2 - k y)) / (sqrt(1 - p^2) + sqrt((1 - k y)^2 - (k x + p)^2))
//! y = w (g w + 2 t) / (sqrt(1 - t^2) + sqrt(1 - (g w + t)^2))
//! x = (s - m z) / n,   w = (z + m s) / n,   n^2 = 1 + m^2
//! ```
//!
//! y is the circle of curvature g through (0, 0) with slope angle asin(t) there. It turns about an axis and leaves a
//! circle of curvature k with slope angle asin(p): (1 - k y) / k is its radius beside the middle. At k = 0 and g = 0
//! they are straight lines, and nothing is singular on the way. A plane has b and p, a cylinder m and k too. A torus has
//! t and g as well, and is turned about x by atan(b) as a whole, for which w is solved; a sphere is one. Where the scan
//! is across its groove (t) and how its axis lies (b) differ by b w x^2 / (2 R r) with the radii R along s and r across:
//! 0.5 um for 1 mm, R = 23 mm, r = 4 mm and b = 0.1.
//! Gauss-Newton steps from two kinds of starts, on some of the points: with weights 1/|residual| (so that damage pulls
//! little), and through as many points as there are parameters, so often that one set is free of damage
//! (P. J. Rousseeuw and K. Van Driessen, "Computing LTS regression for large data sets", Data Mining and Knowledge
//! Discovery 12, 2006). Each is followed on the better half of its points (concentration steps); the least median of
//! |residual| wins. Then on all points: on their better half, and on those within three robust standard deviations of
//! the surface, or within the threshold, until that set stays.

use crate::error::DamageError;
use crate::geometry::{Curve, Form};
use crate::numbers::{median, solved};
use crate::scan::Scan;
use brinell::random::Random;
use brinell::scenario::{ScanFile, ScanForm};

/// More points than this add time, not accuracy.
const MAX_SAMPLES: usize = 100_000;
/// Fewer than this are no surface.
const MIN_SAMPLES: usize = 16;
/// Points that starts are chosen on, at most.
const START_SAMPLES: usize = 500;
/// One of the starts is free of damage in 99 cases of 100 where this share of the points is damaged.
const DAMAGED_SHARE: f64 = 0.4;
/// Points for each parameter from which sets are drawn.
const FEW: usize = 7;
/// Steps through the few points of a start, and concentration steps after them.
const THROUGH: usize = 3;
const CONCENTRATIONS: usize = 3;
/// Starts that are followed to their end.
const FOLLOWED: usize = 5;
const SOFT_PASSES: usize = 25;
const HALF_PASSES: usize = 40;
const HARD_PASSES: usize = 60;
/// The standard deviation of a normal distribution over its median absolute deviation.
const MAD_TO_SIGMA: f64 = 1.4826;
/// Residuals below a picometre are round-off.
const ROUND_OFF_MM: f64 = 1e-9;
/// Steps to the point of a turned torus: each is smaller by its slope times the turn's.
const TURNS: usize = 20;

/// `[c, b, p, m, k, t, g]`.
type Parameters = [f64; 7];
const C: usize = 0;
const B: usize = 1;
const P: usize = 2;
const M: usize = 3;
const K: usize = 4;
const T: usize = 5;
const G: usize = 6;
/// Parameters that are free at once, at most.
const MOST_FREE: usize = 7;

#[derive(Clone, Copy)]
struct Sample {
    s: f64,
    z: f64,
    height: f64,
}

/// The circle with slope angle asin(p) and curvature k, turned about an axis from the height y; `None` past its end.
fn turned(p: f64, k: f64, x: f64, y: f64) -> Option<f64> {
    let (u, v) = (k * x + p, 1.0 - k * y);
    let (start, end) = (1.0 - p * p, v * v - u * u);
    (start > 0.0 && end > 0.0 && v > 0.0)
        .then(|| (x * (k * x + 2.0 * p) + y * (2.0 - k * y)) / (start.sqrt() + end.sqrt()))
}

fn height(q: &Parameters, s: f64, z: f64) -> Option<f64> {
    let n = q[M].hypot(1.0);
    let (x, across) = ((s - q[M] * z) / n, (z + q[M] * s) / n);
    let surface = |w: f64| turned(q[P], q[K], x, turned(q[T], q[G], w, 0.0)?);
    if q[T] == 0.0 && q[G] == 0.0 {
        return Some(q[C] + q[B] * z + surface(across)?);
    }
    let cos = 1.0 / q[B].hypot(1.0);
    let mut w = across;
    for _ in 0..TURNS {
        let next = across / cos + surface(w)? * q[B];
        if (next - w).abs() < ROUND_OFF_MM {
            break;
        }
        w = next;
    }
    Some(q[C] + cos * (q[B] * w + surface(w)?))
}

/// What was taken off.
pub(crate) struct Removed {
    /// Points that were looked at and are on the form.
    pub(crate) used: usize,
    /// Those that lie apart, as damage does.
    pub(crate) apart: usize,
    /// Where it is curved.
    pub(crate) form: Option<Form>,
}

/// Takes the form that is asked for off the scan's depths, along the depth and not along its normal.
pub(crate) fn remove(scan: &mut Scan, options: &ScanFile) -> Result<Option<Removed>, DamageError> {
    let samples = samples(scan);
    let Some((best, found)) = fit(&samples, options)? else {
        return Ok(None);
    };
    let name = options.remove_form.word();
    for row in 0..scan.rows {
        for column in 0..scan.columns {
            let (s, z) = scan.place(column, row);
            let surface = height(&best, s, z)
                .ok_or_else(|| DamageError::NoFit { form: name, why: "it ends inside the scan".to_owned() })?;
            scan.depth_um[row * scan.columns + column] += 1e3 * surface;
        }
    }
    let (half_s, half_z) = scan.place(scan.columns - 1, scan.rows - 1);
    let curve = |of: usize, half_mm| Curve { curvature_per_mm: best[of], half_mm };
    let given = options.radius_mm.is_some();
    let form = match options.remove_form {
        ScanForm::None | ScanForm::Plane => None,
        ScanForm::Cylinder => Some(Form { name, around: curve(K, half_s), across: None, given }),
        ScanForm::Torus => Some(Form { name, around: curve(K, half_s), across: Some(curve(G, half_z)), given }),
    };
    Ok(Some(Removed { used: found.used, apart: samples.len() - found.used, form }))
}

/// The form that is asked for. What lies closer to the surface than the threshold always belongs to it.
fn fit(samples: &[Sample], options: &ScanFile) -> Result<Option<(Parameters, Found)>, DamageError> {
    let free: &[usize] = match options.remove_form {
        ScanForm::None => return Ok(None),
        ScanForm::Plane => &[C, B, P],
        ScanForm::Cylinder => &[C, B, P, M, K],
        ScanForm::Torus => &[C, B, T, P, M, G, K],
    };
    let floor = (1e-3 * options.threshold_um).max(ROUND_OFF_MM);
    let fit =
        |free, k| Fit { samples, free, weights: vec![1.0; samples.len()], floor }.run(options.remove_form.word(), k);
    let Some(radius) = options.radius_mm else {
        return fit(free, 0.0).map(Some);
    };
    // The curvature, which is the last, is known.
    let free = &free[..free.len() - 1];
    Ok(Some(match (fit(free, 1.0 / radius), fit(free, -1.0 / radius)) {
        (Ok(hollow), Ok(bulging)) if bulging.1.typical < hollow.1.typical => bulging,
        (Ok(hollow), _) => hollow,
        (Err(_), other) => other?,
    }))
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

/// The median absolute residual.
fn typical(residuals: &[f64]) -> f64 {
    median(residuals.iter().map(|r| r.abs()))
}

/// A place among `n`.
fn drawn(random: &mut Random, n: usize) -> usize {
    (random.part() * n as f64) as usize
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
        let past_end = || no_fit(format!("the scan is longer than the {form} is wide; check the radius and `ds_mm`"));
        let middle = median(self.samples.iter().map(|p| p.height));
        let flat = [middle, 0.0, 0.0, 0.0, curvature, 0.0, 0.0];
        self.residuals(&flat).ok_or_else(past_end)?;
        let mut random = Random::new(1);
        let some: Vec<Sample> = match self.samples.len() {
            ..=START_SAMPLES => self.samples.to_vec(),
            n => (0..START_SAMPLES).map(|_| self.samples[drawn(&mut random, n)]).collect(),
        };
        let few = Fit { samples: &some, weights: vec![1.0; some.len()], ..self };
        let mut q = few.start(&flat, &mut random).ok_or_else(past_end)?;
        self.concentrate(&mut q, HALF_PASSES).ok_or_else(past_end)?;
        let mut steady = 0;
        for _ in 0..HARD_PASSES {
            let residuals = self.residuals(&q).ok_or_else(past_end)?;
            let limit = (3.0 * MAD_TO_SIGMA * typical(&residuals)).max(self.floor);
            let changed = self.keep(&residuals, limit);
            q = self.step(&q).ok_or_else(past_end)?;
            // A few steps more on the set that stays, to converge on it.
            steady = if changed { 0 } else { steady + 1 };
            if steady > 6 {
                break;
            }
        }
        let residuals = self.residuals(&q).ok_or_else(past_end)?;
        let found = Found { used: self.weights.iter().filter(|&&w| w > 0.0).count(), typical: typical(&residuals) };
        Ok((q, found))
    }

    /// The best of the starts.
    fn start(mut self, flat: &Parameters, random: &mut Random) -> Option<Parameters> {
        let n = self.samples.len();
        let mut soft = *flat;
        for _ in 0..SOFT_PASSES {
            soft = self.step(&soft)?;
            let residuals = self.residuals(&soft)?;
            let least = (0.1 * typical(&residuals)).max(ROUND_OFF_MM);
            for (weight, r) in self.weights.iter_mut().zip(&residuals) {
                *weight = least / r.abs().max(least);
            }
        }
        let mut best = vec![(self.concentrate(&mut soft, HALF_PASSES)?, soft)];
        let clean = (1.0 - DAMAGED_SHARE).powi(self.free.len() as i32);
        // Few points: the best of many sets fits its own half better than the surface.
        let sets = if n < FEW * self.free.len() { 0.0 } else { 0.01_f64.ln() / (1.0 - clean).ln() };
        for _ in 0..sets.ceil() as usize {
            self.weights.fill(0.0);
            for _ in self.free {
                self.weights[drawn(random, n)] = 1.0;
            }
            let mut q = *flat;
            let through = (0..THROUGH).try_for_each(|_| self.step(&q).map(|next| q = next));
            if let Some(typical) = through.and_then(|()| self.concentrate(&mut q, CONCENTRATIONS)) {
                best.push((typical, q));
            }
        }
        best[1..].sort_by(|a, b| a.0.total_cmp(&b.0));
        best.truncate(1 + FOLLOWED);
        for (typical, q) in &mut best[1..] {
            *typical = self.concentrate(q, HALF_PASSES).unwrap_or(f64::INFINITY);
        }
        best.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, q)| q)
    }

    /// Steps on the better half of the points, until that half stays; the median of |residual| at the end.
    fn concentrate(&mut self, q: &mut Parameters, passes: usize) -> Option<f64> {
        for _ in 0..passes {
            let residuals = self.residuals(q)?;
            let typical = typical(&residuals);
            if !self.keep(&residuals, typical) {
                return Some(typical);
            }
            *q = self.step(q)?;
        }
        Some(typical(&self.residuals(q)?))
    }

    /// Weights of the points that lie no farther than this, and none of the others; whether that is another set.
    fn keep(&mut self, residuals: &[f64], limit: f64) -> bool {
        let mut changed = false;
        for (weight, r) in self.weights.iter_mut().zip(residuals) {
            let kept = if r.abs() <= limit { 1.0 } else { 0.0 };
            changed |= *weight != kept;
            *weight = kept;
        }
        changed
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
        let mut normal = [[0.0; MOST_FREE + 1]; MOST_FREE];
        let reach = self.samples.iter().fold(1e-6_f64, |most, p| most.max(p.s.abs()).max(p.z.abs()));
        // Differences: the closed forms are singular where slope or curvature vanishes.
        let nudge = [1e-6, 1e-6, 1e-6, 1e-6, 1e-6 / reach, 1e-6, 1e-6 / reach];
        for (p, &weight) in self.samples.iter().zip(&self.weights) {
            if weight == 0.0 {
                continue;
            }
            let residual = p.height - height(q, p.s, p.z)?;
            let mut gradient = [0.0; MOST_FREE];
            for (slot, &of) in gradient.iter_mut().zip(self.free) {
                let at = |by: f64| {
                    let mut moved = *q;
                    moved[of] += by;
                    height(&moved, p.s, p.z)
                };
                *slot = match of {
                    C => 1.0,
                    _ => (at(nudge[of])? - at(-nudge[of])?) / (2.0 * nudge[of]),
                };
            }
            for i in 0..n {
                for j in 0..n {
                    normal[i][j] += weight * gradient[i] * gradient[j];
                }
                normal[i][MOST_FREE] += weight * gradient[i] * residual;
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

    #[test]
    fn analytic_noise_and_a_spall_on_two_fifths_hardly_move_the_parameters() {
        // Tilted and turned, with 0.2 um of noise; along an end, along a side or in the middle they are 25 um deep.
        let raceway = [0.1, 0.002, 0.003, 0.02, 1.0 / 27.5, 0.0, 0.0];
        let groove = [0.1, 0.02, 0.003, 0.02, -1.0 / 15.5, 0.05, 1.0 / 4.13];
        for (remove_form, truth, half_s, half_z) in
            [(ScanForm::Cylinder, raceway, 3.0, 2.4), (ScanForm::Torus, groove, 1.0, 1.0)]
        {
            for damaged in [|s: f64, _| s < -0.2, |_, z: f64| z < -0.2, |s: f64, z: f64| s.abs().max(z.abs()) < 0.63] {
                let mut noise = Random::new(5);
                let mut count = 0;
                let samples: Vec<Sample> = (0..4000)
                    .map(|k| {
                        let (u, v) = (f64::from(k % 80 - 40) / 40.0, f64::from(k / 80 - 25) / 25.0);
                        let (s, z) = (half_s * u, half_z * v);
                        count += usize::from(damaged(u, v));
                        let depth = if damaged(u, v) { 0.025 } else { 0.0 };
                        Sample { s, z, height: height(&truth, s, z).unwrap() - depth + 2e-4 * noise.normal() }
                    })
                    .collect();
                let options = ScanFile { remove_form, threshold_um: 2.0, ..ScanFile::default() };
                let (found, counts) = fit(&samples, &options).unwrap().unwrap();
                assert_eq!(counts.used, samples.len() - count, "{remove_form:?}");
                for of in [K, G] {
                    let off = (found[of] - truth[of]).abs();
                    assert!(off <= 0.01 * truth[of].abs(), "{remove_form:?} {of}: {} for {}", found[of], truth[of]);
                }
            }
        }
    }

    #[test]
    fn analytic_a_tilted_torus_leaves_nothing() {
        // Points of a groove, by its two angles, turned about the direction of rolling.
        let (ring, groove) = (23.5, 4.13);
        for tilt in [0.0_f64, 0.02, -0.09] {
            let samples: Vec<Sample> = (0..1600)
                .map(|k| {
                    let (around, across) = (0.006 * f64::from(k % 40 - 20), 0.03 * f64::from(k / 40 - 20));
                    let (w, rise) = (groove * across.sin(), groove * (1.0 - across.cos()));
                    let rho = ring - rise;
                    let (s, h) = (rho * around.sin(), ring - rho * around.cos());
                    Sample { s, z: w * tilt.cos() - h * tilt.sin(), height: w * tilt.sin() + h * tilt.cos() }
                })
                .collect();
            let options = ScanFile { remove_form: ScanForm::Torus, threshold_um: 0.01, ..ScanFile::default() };
            let (found, counts) = fit(&samples, &options).unwrap().unwrap();
            assert_eq!(counts.used, samples.len(), "{tilt}");
            assert!(counts.typical < 1e-7, "{tilt}: {} mm", counts.typical);
            for (of, radius) in [(K, ring), (G, groove)] {
                assert!((found[of] * radius - 1.0).abs() < 1e-4, "{tilt}: {} for {radius}", 1.0 / found[of]);
            }
        }
    }
}
