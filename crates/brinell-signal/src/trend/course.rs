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

/// Four standard deviations, in median deviations of normal values.
const FAR: f64 = 4.0 * 1.4826;
/// Records whose course those at an end are held against.
const BESIDE_AN_END: usize = 6;

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
    /// neighbours on either side gives way to this median (the identifier of F. R. Hampel). One or two at either end that leap off the course
    /// of the six beside them give way to that course. Steps of three records and growth stay as they are.
    ///
    /// And how many of the last gave way so: whether they are odd records or the beginning of something only the next ones tell.
    pub(super) fn calmed(&self) -> (Self, usize) {
        const NEAR: usize = 2;
        const AROUND: usize = 6;
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
        let usual = median(&off[inner]);
        let aside = calm.calm_end(&(0..n).rev().collect::<Vec<_>>(), usual);
        calm.calm_end(&(0..n).collect::<Vec<_>>(), usual);
        (calm, aside)
    }

    /// Of the records in this order the first one or two, where they leap off the course of the next six. `usual` is the median deviation of all.
    /// How many did.
    fn calm_end(&mut self, order: &[usize], usual: f64) -> usize {
        let mut aside = 0;
        for leaps in [2, 1] {
            let Some(beside) = order.get(leaps..leaps + BESIDE_AN_END) else { return aside };
            let slope = median(
                &(beside.iter().enumerate())
                    .flat_map(|(k, a)| beside[k + 1..].iter().map(move |b| (*a, *b)))
                    .map(|(a, b)| (self.y[b] - self.y[a]) / (self.t[b] - self.t[a]))
                    .collect::<Vec<_>>(),
            );
            let of = |x: &dyn Fn(usize) -> f64| median(&beside.iter().map(|i| x(*i)).collect::<Vec<_>>());
            let level = of(&|i| self.y[i]);
            let intercept = of(&|i| self.y[i] - slope * self.t[i]);
            // Six records alone tell too little of it.
            let scatter = of(&|i| (self.y[i] - intercept - slope * self.t[i]).abs()).max(usual);
            // What lies between the level and the line goes on from here.
            let expected = |i: usize| {
                let line = intercept + slope * self.t[i];
                self.y[i].clamp(level.min(line), level.max(line))
            };
            let off = |i: usize| self.y[i] - expected(i);
            let (ends, before) = (&order[..leaps], order[leaps]);
            let largest = ends.iter().map(|i| off(*i)).fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
            let far =
                ends.iter().all(|i| off(*i) / largest >= 0.5 && largest.abs() > (FAR * scatter).max(4.0 * self.s[*i]));
            if far && off(before) / largest < 0.25 {
                // With the usual scatter: without any they would look like records of a quieter time.
                let calm: Vec<f64> = ends.iter().map(|i| expected(*i) + scatter.copysign(largest)).collect();
                ends.iter().zip(calm).for_each(|(i, y)| self.y[*i] = y);
                aside = aside.max(leaps);
            }
        }
        aside
    }
}

/// 0 of none.
pub(super) fn median(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { frequency::median(&mut values.to_vec()) }
}
