//! Values over time.

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
}
