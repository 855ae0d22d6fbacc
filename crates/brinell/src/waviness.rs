//! Waviness of raceways and rolling elements: section 23.
//!
//! w(u) = sum over k of A_k cos(k u + phase_k), A_k = A_1 k^-q, over the surface's own angle u; w > 0 is a valley, m. Each surface
//! is kept as a C2 polynomial of the fifth degree between points that have the sum's own value, slope and curvature: its slope is
//! exactly that of what it gives, so that energy closes.

use crate::random::mix;
use crate::scenario;
use std::f64::consts::TAU;

/// Points for each of the shortest waves: w is off by (2 pi/8)^6/46080 = 5e-6 of that wave's amplitude at most.
const POINTS: usize = 8;

/// One surface's.
#[derive(Debug, Clone, PartialEq)]
pub struct Wave {
    /// Value, slope and curvature over the spacing at each point; the first stands again at the end.
    points: Vec<[f64; 3]>,
    /// Points in a radian.
    per_radian: f64,
}

/// Phase of wave k of surface `surface`, rad: the same on every machine.
fn phase(seed: u64, surface: u64, k: u64) -> f64 {
    const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
    let index = (surface << 20).wrapping_add(k);
    // `mix` adds the ratio before it mixes.
    let bits = mix(seed.wrapping_add(index.wrapping_sub(1).wrapping_mul(GOLDEN)));
    TAU * ((bits >> 11) as f64 / (1u64 << 53) as f64)
}

impl Wave {
    /// Of surface number `surface`.
    pub fn new(of: &scenario::Waviness, seed: u64, surface: u64) -> Self {
        let [first, last] = of.waves;
        let count = POINTS * last.max(1);
        let spacing = TAU / count as f64;
        let mut points = vec![[0.0; 3]; count + 1];
        for k in first..=last {
            let (wave, amplitude) = (k as f64, 1e-6 * of.amplitude_um * (k as f64).powf(-of.exponent));
            let per_point = wave * spacing;
            let phase = phase(seed, surface, k as u64);
            for (n, [value, slope, curvature]) in points[..count].iter_mut().enumerate() {
                // n k points of the turn, taken modulo the turn as whole numbers.
                let (sin, cos) = (spacing * ((n * k) % count) as f64 + phase).sin_cos();
                *value += amplitude * cos;
                *slope -= amplitude * per_point * sin;
                *curvature -= amplitude * per_point * per_point * cos;
            }
        }
        points[count] = points[0];
        Self { points, per_radian: 1.0 / spacing }
    }

    /// w (m) and dw/du (m/rad) at the angle u, rad.
    #[inline]
    pub fn at(&self, u: f64) -> [f64; 2] {
        let count = (self.points.len() - 1) as f64;
        let along = u * self.per_radian;
        let along = along - count * (along / count).floor();
        // Round-off may leave a whole turn.
        let index = (along as usize).min(self.points.len() - 2);
        let x = along - index as f64;
        let ([f, d, c], [g, e, b]) = (self.points[index], self.points[index + 1]);
        // Quintic Hermite: f + d x + c x^2/2 + x^3 (p + q x + r x^2).
        let (rise, turn, bend) = (g - f - d - 0.5 * c, e - d - c, b - c);
        let p = 10.0 * rise - 4.0 * turn + 0.5 * bend;
        let q = -15.0 * rise + 7.0 * turn - bend;
        let r = 6.0 * rise - 3.0 * turn + 0.5 * bend;
        let square = x * x;
        let value = f + x * (d + 0.5 * c * x) + square * x * (p + x * (q + x * r));
        let slope = d + c * x + square * (3.0 * p + x * (4.0 * q + x * 5.0 * r));
        [value, slope * self.per_radian]
    }
}

/// The waviness of a bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Waviness {
    /// Row i's inner raceway at 2 i, its outer at 2 i + 1; none where raceways are even.
    pub raceways: Vec<Wave>,
    /// Element j of row i at i Z + j; none where elements are even.
    pub elements: Vec<Wave>,
    /// The most by which surfaces of one contact rise together, m.
    pub rise: f64,
}

impl Waviness {
    /// `None` where every surface is even.
    pub fn new(bearing: &scenario::Bearing, seed: u64) -> Option<Self> {
        let (rows, elements) = (bearing.rows as u64, (bearing.rows * bearing.rollers_per_row) as u64);
        let surfaces = |of: &Option<scenario::Waviness>, from: u64, count: u64| -> Vec<Wave> {
            let one = |of: &scenario::Waviness| (0..count).map(|k| Wave::new(of, seed, from + k)).collect();
            of.as_ref().filter(|of| of.amplitude_um != 0.0).map_or(Vec::new(), one)
        };
        let all = Self {
            raceways: surfaces(&bearing.waviness, 0, 2 * rows),
            elements: surfaces(&bearing.element_waviness, 2 * rows, elements),
            rise: [&bearing.waviness, &bearing.element_waviness].into_iter().flatten().map(largest).sum(),
        };
        (!all.raceways.is_empty() || !all.elements.is_empty()).then_some(all)
    }
}

/// The sum of a surface's amplitudes, m.
fn largest(of: &scenario::Waviness) -> f64 {
    let [first, last] = of.waves;
    (first..=last).map(|k| 1e-6 * of.amplitude_um.abs() * (k as f64).powf(-of.exponent)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_the_contracts_phase() {
        assert!((phase(1, 0, 2) - 4.685_884_980).abs() < 5e-10);
    }

    #[test]
    fn analytic_a_surface_is_the_sum_of_its_waves_and_its_slope_the_derivative() {
        let of = scenario::Waviness { amplitude_um: 0.3, exponent: 1.5, waves: [2, 60] };
        let wave = Wave::new(&of, 7, 3);
        for step in 0..2000 {
            let u = -9.0 + 0.011_3 * f64::from(step);
            let (mut value, mut slope) = (0.0, 0.0);
            for k in 2..=60_u32 {
                let (a, wave) = (0.3e-6 * f64::from(k).powf(-1.5), f64::from(k));
                let (sin, cos) = (wave * u + phase(7, 3, u64::from(k))).sin_cos();
                value += a * cos;
                slope -= a * wave * sin;
            }
            let [w, dw] = wave.at(u);
            // What Hermite's polynomial of the fifth degree leaves of each wave: A (k h)^6/720 times (x (1 - x))^3, at most 1/64, and of its
            // slope that derivative, at most 0.054.
            let sum = |most: f64, of: i32| -> f64 {
                let left = |k: f64| 0.3e-6 * k.powf(-1.5) * (k * TAU / 480.0).powi(of) * k.powi(6 - of) / 720.0;
                (2..=60).map(|k| most * left(f64::from(k))).sum()
            };
            assert!((w - value).abs() < sum(1.0 / 64.0, 6) + 1e-20, "{u}: {w} {value}");
            assert!((dw - slope).abs() < sum(0.054, 5) + 1e-18, "{u}: {dw} {slope}");
            let h = 1e-6;
            let difference = (wave.at(u + h)[0] - wave.at(u - h)[0]) / (2.0 * h);
            // Third derivatives of 0.02 m/rad^3 and round-off of 1e-22 m.
            assert!((difference - dw).abs() < 1e-12);
        }
    }
}
