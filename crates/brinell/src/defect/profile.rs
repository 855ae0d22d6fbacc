//! Width and depth listed along the arc, straight between points.

use super::piecewise::Line;

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

    /// Largest width, m.
    pub(super) fn widest(&self) -> f64 {
        self.width.iter().copied().fold(0.0, f64::max)
    }

    /// h_s(s) as straight pieces over the whole arc.
    pub(super) fn depths(&self, depth: f64) -> Vec<Line> {
        let h = |k: usize| self.depth.as_ref().map_or(depth, |d| d[k]);
        (0..self.arc.len() - 1)
            .map(|k| Line { from: self.arc[k], to: self.arc[k + 1], at_from: h(k), at_to: h(k + 1) })
            .collect()
    }

    /// Index k and fraction f with s between points k and k + 1; the right-hand value at a jump.
    fn locate(&self, s: f64) -> (usize, f64) {
        let k = self.arc.partition_point(|&a| a <= s).clamp(1, self.arc.len() - 1) - 1;
        let step = self.arc[k + 1] - self.arc[k];
        let fraction = if step > 0.0 { ((s - self.arc[k]) / step).clamp(0.0, 1.0) } else { 1.0 };
        (k, fraction)
    }
}

fn lerp(values: &[f64], (k, fraction): (usize, f64)) -> f64 {
    values[k] + (values[k + 1] - values[k]) * fraction
}
