//! Axes: the part of a quantity that is shown, from there to pixels, ticks and labels.

use crate::number::{linear_ticks, log_ticks, superscript, tick_labels};

/// The part of a quantity that an axis shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Domain {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    pub(crate) log: bool,
}

/// Beyond this a double's square overflows, and below its inverse one vanishes; nothing physical comes near either.
const HUGE: f64 = 1e150;

/// The value that a plot computes with.
fn tame(value: f64) -> f64 {
    if value.abs() < 1.0 / HUGE { 0.0 } else { value.clamp(-HUGE, HUGE) }
}

/// Smallest and largest finite value.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .into_iter()
        .filter(|v| v.is_finite())
        .map(tame)
        .fold(None, |range, v| Some(range.map_or((v, v), |(lo, hi): (f64, f64)| (lo.min(v), hi.max(v)))))
}

impl Domain {
    pub(crate) fn exact(lo: f64, hi: f64) -> Self {
        let (lo, hi) = range([lo, hi]).unwrap_or((0.0, 1.0));
        let largest = lo.abs().max(hi.abs());
        // A span that rounding swallows shows nothing.
        let room = if hi - lo > 1e-12 * largest.max(1e-290) { 0.0 } else { (1e-9 * largest).max(0.5) };
        Self { lo: lo - room, hi: hi + room, log: false }
    }

    /// Holds every value with some room; a constant gets room around it.
    pub(crate) fn around(values: impl IntoIterator<Item = f64>) -> Self {
        match range(values) {
            None => Self { lo: 0.0, hi: 1.0, log: false },
            Some((lo, hi)) if hi - lo > 1e-9 * lo.abs().max(hi.abs()) => {
                let room = 0.06 * (hi - lo);
                Self { lo: lo - room, hi: hi + room, log: false }
            }
            Some((0.0, _)) => Self { lo: -1.0, hi: 1.0, log: false },
            Some((lo, hi)) => {
                let room = 0.1 * lo.abs().max(hi.abs());
                Self { lo: lo - room, hi: hi + room, log: false }
            }
        }
    }

    /// From zero up, for what cannot be negative.
    pub(crate) fn from_zero(values: impl IntoIterator<Item = f64>) -> Self {
        let (lo, hi) = range(values).unwrap_or((0.0, 0.0));
        if lo < 0.0 {
            return Self::around([lo, hi.max(0.0)]);
        }
        Self { lo: 0.0, hi: if hi > 0.0 { hi * 1.08 } else { 1.0 }, log: false }
    }

    /// Logarithmic, where all values are positive and lie at least so many decades apart.
    pub(crate) fn over_decades(values: impl IntoIterator<Item = f64>, decades: f64) -> Option<Self> {
        let (lo, hi) = range(values).filter(|(lo, _)| *lo > 0.0)?;
        let [low, high] = [lo, hi].map(f64::log10);
        let room = 0.06 * (high - low);
        let [lo, hi] = [low - room, high + room].map(|x| 10f64.powf(x));
        (high - low >= decades).then_some(Self { lo, hi, log: true })
    }

    /// Whole decades, at most six of them below the largest value.
    pub(crate) fn decades(values: &[f64]) -> Self {
        let positive = || values.iter().copied().filter(|v| *v > 1e-300);
        let Some((lo, hi)) = range(positive()) else {
            return Self { lo: 0.1, hi: 1.0, log: true };
        };
        // The floor follows the bulk of the lines, not the deepest notch.
        let mut sample: Vec<f64> = positive().step_by(values.len() / 4096 + 1).collect();
        sample.sort_by(f64::total_cmp);
        let floor = sample.get(sample.len() / 20).copied().unwrap_or(lo);
        let decade = hi.log10().floor();
        let tops = [2.0f64, 5.0, 10.0, 20.0].map(|m| m.log10() + decade);
        let top = tops.into_iter().find(|top| *top > hi.log10() + 0.04).unwrap_or(decade + 1.0);
        let bottom = floor.log10().floor().clamp(decade - 5.0, decade - 1.0);
        Self { lo: 10f64.powf(bottom), hi: 10f64.powf(top), log: true }
    }
}

/// From a domain to pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    pub(super) domain: Domain,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Scale {
    pub(crate) fn at(&self, value: f64) -> f64 {
        let Domain { lo, hi, log } = self.domain;
        let part = if log {
            (value.max(lo * 1e-3).log10() - lo.log10()) / (hi.log10() - lo.log10())
        } else {
            (tame(value) - lo) / (hi - lo)
        };
        // A curve may leave the frame, but not by more than the clipping can take.
        self.from + part.clamp(-20.0, 20.0) * (self.to - self.from)
    }
}
/// "Force (10³ N)", or what of it makes sense.
pub(super) fn axis_label(label: &str, unit: &str, power: i32) -> String {
    match (unit, power) {
        ("", 0) => label.to_owned(),
        ("", _) => format!("{label} (10{})", superscript(power)),
        (_, 0) => format!("{label} ({unit})"),
        _ => format!("{label} (10{} {unit})", superscript(power)),
    }
}

/// Ticks with labels, and the power of ten left to the axis label.
pub(super) fn ticks(domain: Domain, target: usize) -> (Vec<f64>, Vec<String>, i32) {
    if domain.log {
        let ticks = log_ticks(domain.lo, domain.hi, target);
        let labels = ticks
            .iter()
            .map(|t| match t.log10().round() as i32 {
                0 => "1".to_owned(),
                1 => "10".to_owned(),
                2 => "100".to_owned(),
                decade => format!("10{}", superscript(decade)),
            })
            .collect();
        return (ticks, labels, 0);
    }
    // Two numbers are hardly a scale: somewhat closer ones, where that gives more.
    let ticks = (target..=target + 2)
        .map(|target| linear_ticks(domain.lo, domain.hi, target))
        .find(|ticks| ticks.len() > 2)
        .unwrap_or_else(|| linear_ticks(domain.lo, domain.hi, target));
    let (labels, power) = tick_labels(&ticks);
    (ticks, labels, power)
}

/// Splits a label so that it fits in two lines: at the best space, but not inside the unit.
pub(super) fn halves(label: &str) -> (String, String) {
    let unit = label.rfind(" (").map_or(label.len(), |at| at + 1);
    let middle = label.len() / 2;
    match label[..unit].match_indices(' ').map(|(at, _)| at).min_by_key(|at| at.abs_diff(middle)) {
        Some(at) => (label[..at].to_owned(), label[at + 1..].to_owned()),
        None => (label.to_owned(), String::new()),
    }
}
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_domains_hold_odd_data() {
        for values in
            [vec![], vec![f64::NAN], vec![0.0], vec![3.0; 4], vec![f64::INFINITY, 1e308, -1e308], vec![1e-320]]
        {
            for domain in [
                Domain::around(values.clone()),
                Domain::from_zero(values.clone()),
                Domain::decades(&values),
                Domain::exact(values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0)),
            ] {
                assert!(domain.lo < domain.hi && (domain.hi - domain.lo).is_finite(), "{values:?} {domain:?}");
            }
        }
    }
}
