//! Width and depth listed along the arc, straight between points.

use super::course::Line;

/// Piecewise-linear width and depth; the arc may repeat where they jump.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    arc: Vec<f64>,
    width: Vec<f64>,
    depth: Option<Vec<f64>>,
}

impl Profile {
    /// From equally long lists (m), the arc never decreasing. `None` where they do not fit or are empty.
    pub fn new(arc: Vec<f64>, width: Vec<f64>, depth: Option<Vec<f64>>) -> Option<Self> {
        let fits = arc.len() >= 2
            && arc.len() == width.len()
            && depth.as_ref().is_none_or(|d| d.len() == arc.len())
            && arc.windows(2).all(|w| w[0] <= w[1]);
        fits.then_some(Self { arc, width, depth })
    }

    /// First and last s, m.
    pub fn arc(&self) -> (f64, f64) {
        (self.arc[0], self.arc[self.arc.len() - 1])
    }

    /// L_s(s), m.
    #[inline]
    pub fn width(&self, s: f64) -> f64 {
        lerp(&self.width, self.locate(s))
    }

    /// h_s(s), m, where the profile lists depths.
    #[inline]
    pub fn depth(&self, s: f64) -> Option<f64> {
        self.depth.as_ref().map(|d| lerp(d, self.locate(s)))
    }

    /// Depth along a line at the distance `from_middle` (m) from z = 0, where the profile is at least that wide to either side; `slack`
    /// (m) is the distance at which a border counts as reached. `depth` (m) stands in for depths that are not listed.
    pub(super) fn along(&self, from_middle: f64, slack: f64, depth: f64) -> Vec<Line> {
        let least = 2.0 * (from_middle - slack);
        let mut lines = Vec::new();
        for k in 0..self.arc.len() - 1 {
            let (a, b) = (self.arc[k], self.arc[k + 1]);
            let (wa, wb) = (self.width[k], self.width[k + 1]);
            let wide = |w: f64| w >= least;
            if b <= a || (wa <= 0.0 && wb <= 0.0) || !(wide(wa) || wide(wb)) {
                continue;
            }
            let (ha, hb) = self
                .depth
                .as_ref()
                .map_or((depth, depth), |d| (d[k], d[k + 1]));
            // Where the width passes the least one, if it does. A point of the profile stays to the bit where it is: a gap of a rounding
            // error between two lines would be a wall to the envelope.
            let border = (least - wa) / (wb - wa);
            let (s, h) = (a + (b - a) * border, ha + (hb - ha) * border);
            let (from, at_from) = if wide(wa) { (a, ha) } else { (s, h) };
            let (to, at_to) = if wide(wb) { (b, hb) } else { (s, h) };
            lines.push(Line {
                from,
                to,
                at_from,
                at_to,
            });
        }
        lines
    }

    /// h_s(s) as straight pieces over the whole arc.
    pub(super) fn depths(&self, depth: f64) -> Vec<Line> {
        let h = |k: usize| self.depth.as_ref().map_or(depth, |d| d[k]);
        (0..self.arc.len() - 1)
            .map(|k| Line {
                from: self.arc[k],
                to: self.arc[k + 1],
                at_from: h(k),
                at_to: h(k + 1),
            })
            .collect()
    }

    /// Index k and fraction f with s between points k and k + 1; the right-hand value at a jump.
    fn locate(&self, s: f64) -> (usize, f64) {
        let k = self
            .arc
            .partition_point(|&a| a <= s)
            .clamp(1, self.arc.len() - 1)
            - 1;
        let step = self.arc[k + 1] - self.arc[k];
        let fraction = if step > 0.0 {
            ((s - self.arc[k]) / step).clamp(0.0, 1.0)
        } else {
            1.0
        };
        (k, fraction)
    }
}

fn lerp(values: &[f64], (k, fraction): (usize, f64)) -> f64 {
    values[k] + (values[k + 1] - values[k]) * fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_neighbouring_lines_meet_to_the_bit() {
        // -1.0e-3 + (0.3e-3 - -1.0e-3) is not 0.3e-3: the envelope took the gap for undamaged surface.
        let arc: Vec<f64> = [-1.0, 0.3, 1.2].map(|s| s * 1e-3).to_vec();
        let depth = vec![2e-6, 8e-6, 5e-6];
        let profile = Profile::new(arc.clone(), vec![1e-3, 4e-3, 2e-3], Some(depth)).unwrap();
        for from_middle in [0.0, 0.25e-3, 1.3e-3, 1.9e-3] {
            let lines = profile.along(from_middle, 6e-12, 5e-6);
            assert_eq!(
                (lines[0].to, lines[1].from),
                (arc[1], arc[1]),
                "{from_middle}"
            );
            assert_eq!((lines[0].at_to, lines[1].at_from), (8e-6, 8e-6));
        }
    }
}
