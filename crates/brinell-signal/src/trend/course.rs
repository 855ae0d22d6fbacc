//! Values over time.

use crate::frequency;

/// Values over time: times ascend.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Course {
    /// Times, in any unit.
    pub t: Vec<f64>,
    /// Values; of positive quantities their logarithms.
    pub y: Vec<f64>,
    /// Standard uncertainty of each; 0 where none is known.
    pub s: Vec<f64>,
}

impl Course {
    /// Most values that changes are looked for in.
    const MOST: usize = 400;

    /// Of many values the means of as many neighbours each as leave 400 or fewer.
    pub fn grouped(self) -> Self {
        let each = self.t.len().div_ceil(Self::MOST);
        if each < 2 {
            return self;
        }
        let mean = |x: &[f64]| x.chunks(each).map(|x| x.iter().sum::<f64>() / x.len() as f64).collect();
        let uncertainty = |s: &[f64]| s.iter().map(|s| s * s).sum::<f64>().sqrt() / s.len() as f64;
        Self { t: mean(&self.t), y: mean(&self.y), s: self.s.chunks(each).map(uncertainty).collect() }
    }

    /// Values that single records far off do not move: one beyond four deviations of those around it from the median of its two
    /// neighbours on either side gives way to this median (the identifier of F. R. Hampel). Steps and growth stay as they are.
    pub(super) fn calmed(&self) -> Self {
        const NEAR: usize = 2;
        const AROUND: usize = 6;
        const FAR: f64 = 4.0 * 1.4826;
        let n = self.y.len();
        let inner = NEAR..n.saturating_sub(NEAR);
        let medians: Vec<f64> =
            (0..n).map(|i| if inner.contains(&i) { median(&self.y[i - NEAR..=i + NEAR]) } else { self.y[i] }).collect();
        let off: Vec<f64> = self.y.iter().zip(&medians).map(|(y, m)| (y - m).abs()).collect();
        let mut calm = self.clone();
        for i in inner.clone() {
            let (from, to) = (i.saturating_sub(AROUND).max(NEAR), (i + AROUND + 1).min(n - NEAR));
            if off[i] > FAR * median(&off[from..to]).max(self.s[i]) {
                calm.y[i] = medians[i];
            }
        }
        calm
    }
}

/// 0 of none.
pub(super) fn median(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { frequency::median(&mut values.to_vec()) }
}
