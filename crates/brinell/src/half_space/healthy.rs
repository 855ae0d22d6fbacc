//! Energy of the healthy contact on a window's own grid, over its deformation: what a damaged contact's is compared with.

use super::solver::{Contact, Pressed};

/// Deformations that the energy is found at, each half of the one before.
const HALVINGS: usize = 6;

/// ln U over ln delta: cubic pieces through values and slopes. Beyond both ends a power of delta.
#[derive(Debug, Clone)]
pub(super) struct Energies {
    /// ln delta, ln U, d ln U/d ln delta = delta Q/U, rising.
    nodes: Vec<[f64; 3]>,
}

impl Energies {
    /// Of the gaps `gap` up to the deformation `most` (m).
    pub(super) fn new(contact: &mut Contact<'_>, gap: &[f64], soft: &[f64], most: f64, tolerance: f64) -> Self {
        contact.p.fill(0.0);
        let mut nodes = Vec::with_capacity(HALVINGS + 1);
        let mut delta = most;
        for _ in 0..=HALVINGS {
            let Pressed { energy, force, .. } = contact.press(gap, soft, delta, tolerance);
            if energy > 0.0 {
                nodes.push([delta.ln(), energy.ln(), delta * force / energy]);
            }
            delta *= 0.5;
        }
        nodes.reverse();
        Self { nodes }
    }

    /// The deformation that stores `energy`, m, and the force there; energy above 0.
    pub(super) fn at_energy(&self, energy: f64) -> (f64, f64) {
        let wanted = energy.ln();
        let (first, last) = (self.nodes[0], self.nodes[self.nodes.len() - 1]);
        let (log, slope) = if wanted <= first[1] {
            (first[0] + (wanted - first[1]) / first[2], first[2])
        } else if wanted >= last[1] {
            (last[0] + (wanted - last[1]) / last[2], last[2])
        } else {
            let k = self.nodes.partition_point(|n| n[1] <= wanted).clamp(1, self.nodes.len() - 1);
            let ([x0, y0, d0], [x1, y1, d1]) = (self.nodes[k - 1], self.nodes[k]);
            let width = x1 - x0;
            let cubic = |t: f64| {
                let (a, b) = (d0 * width - (y1 - y0), (y1 - y0) - d1 * width);
                let bent = t * (1.0 - t);
                let value = y0 + t * (y1 - y0) + bent * (a * (1.0 - t) + b * t);
                let by_t = (y1 - y0) + (1.0 - 2.0 * t) * (a * (1.0 - t) + b * t) + bent * (b - a);
                (value, by_t / width)
            };
            // Rising and almost straight: Newton from the chord.
            let mut t = (wanted - y0) / (y1 - y0);
            for _ in 0..6 {
                let (value, slope) = cubic(t);
                t = (t - (value - wanted) / (slope * width)).clamp(0.0, 1.0);
            }
            (x0 + t * width, cubic(t).1)
        };
        let delta = log.exp();
        (delta, slope * energy / delta)
    }
}
