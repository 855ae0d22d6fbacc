//! A number with its 95 % interval, by the scatter of what it is an average of.

use super::scatter::{Scatter, scatter};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Degrees of freedom of the Student's t that it was made with.
    pub freedom: u32,
}

impl Interval {
    /// Of a value whose standard uncertainty is known.
    pub fn normal(value: f64, uncertainty: f64) -> Self {
        Interval { low: value - NORMAL * uncertainty, high: value + NORMAL * uncertainty, freedom: MOST_FREEDOM }
    }

    /// Half the width over 1.96: with many degrees of freedom the standard error; with few it is larger, so that 1.96
    /// times it still covers.
    pub fn standard_uncertainty(&self) -> f64 {
        0.5 * (self.high - self.low) / NORMAL
    }
}

/// Beyond so many degrees of freedom Student's t is the normal distribution.
pub const MOST_FREEDOM: u32 = 1000;

/// Two-sided 95 % of a normal distribution.
pub const NORMAL: f64 = 1.959_963_984_540_054;

/// A number as every file of results has it: its value, and `low` and `high`, the ends of its 95 % interval, where there is one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Written {
    value: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    low: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    high: Option<f64>,
}

impl Written {
    /// Of a value and the ends of its interval.
    pub fn new(value: impl Into<Option<f64>>, interval: Option<(f64, f64)>) -> Self {
        let (low, high) = interval.unzip();
        Written { value: value.into(), low, high }
    }

    /// In another unit, so many of which one of its own is.
    pub fn times(self, factor: f64) -> Self {
        let scaled = |x: Option<f64>| x.map(|x| factor * x);
        Written { value: scaled(self.value), low: scaled(self.low), high: scaled(self.high) }
    }
}

/// The same with its unit; empty where it has none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct InUnit<'a> {
    /// The number.
    #[serde(flatten)]
    pub number: Written,
    /// Its unit.
    pub unit: &'a str,
}

impl InUnit<'_> {
    /// As JSON.
    pub fn json(number: impl Into<Written>, unit: &str) -> Value {
        serde_json::to_value(InUnit { number: number.into(), unit }).unwrap_or_default()
    }
}

impl From<Estimate> for Written {
    fn from(e: Estimate) -> Self {
        Written::new(e.value, e.interval.map(|i| (i.low, i.high)))
    }
}

/// An indicator with its scatter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(into = "Written")]
pub struct Estimate {
    /// The value, within the interval.
    pub value: f64,
    /// 95 % interval of the same quantity; `None` where the record is too short to tell.
    pub interval: Option<Interval>,
}

impl Estimate {
    /// Of a quantity that is positive by definition: value / f to value * f. `relative` is the standard error of its
    /// logarithm.
    pub fn positive(value: f64, relative: Option<Scatter>) -> Self {
        let interval = relative.filter(|_| value > 0.0).map(|s| {
            let factor = s.half_width().exp();
            Interval { low: value / factor, high: value * factor, freedom: s.freedom }
        });
        Estimate { value, interval: interval.filter(|i| i.high.is_finite()) }
    }

    /// Of a quantity of either sign: value +- half width.
    pub fn signed(value: f64, scatter: Option<Scatter>) -> Self {
        let interval =
            scatter.map(|s| Interval { low: value - s.half_width(), high: value + s.half_width(), freedom: s.freedom });
        Estimate { value, interval: interval.filter(|i| i.low.is_finite() && i.high.is_finite()) }
    }

    /// Of several records that say nothing of each other: the mean of their values to the power `exponent` (2 of an RMS),
    /// each with its weight; their sum is 1.
    pub fn pooled(each: &[(Self, f64)], exponent: i32) -> Self {
        if let [(only, _)] = each {
            return *only;
        }
        let raised = |v: f64| v.powi(exponent);
        let back = |v: f64| if exponent == 1 { v } else { v.powf(1.0 / f64::from(exponent)) };
        let mean: f64 = each.iter().map(|(e, w)| w * raised(e.value)).sum();
        // To one side, of independent records.
        let off = |end: &dyn Fn(Interval) -> f64| -> Option<f64> {
            let squares = each.iter().map(|(e, w)| Some((w * (raised(end(e.interval?)) - raised(e.value))).powi(2)));
            squares.sum::<Option<f64>>().map(f64::sqrt)
        };
        let ends = off(&|i| i.low).zip(off(&|i| i.high));
        let freedom = each.iter().filter_map(|(e, _)| Some(e.interval?.freedom)).min().unwrap_or(0);
        let interval =
            ends.map(|(below, above)| Interval { low: back(mean - below), high: back(mean + above), freedom });
        Estimate { value: back(mean), interval }
    }

    /// Of the mean of a correlated series of positive numbers, such as the peaks after impacts; `None` of an empty one.
    pub fn of_mean(series: &[f64]) -> Option<Self> {
        let mean = series.iter().sum::<f64>() / series.len() as f64;
        let relative: Vec<f64> = series.iter().map(|x| x / mean - 1.0).collect();
        mean.is_finite().then(|| Self::positive(mean, scatter(&relative)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_n_alike_have_an_interval_narrower_by_the_root_of_n() {
        let one = Estimate { value: 3.0, interval: Some(Interval { low: 2.8, high: 3.4, freedom: 4 }) };
        let pooled = Estimate::pooled(&[(one, 0.25); 4], 1);
        let interval = pooled.interval.unwrap();
        assert!((pooled.value - 3.0).abs() < 1e-12);
        assert!((interval.low - 2.9).abs() < 1e-12 && (interval.high - 3.2).abs() < 1e-12, "{interval:?}");
        assert_eq!(Estimate::pooled(&[(one, 1.0)], 2), one);
        // Root mean square, and no interval where one has none.
        let bare = |value| Estimate { value, interval: None };
        let rms = Estimate::pooled(&[(bare(1.0), 0.5), (bare(7.0), 0.5)], 2);
        assert!((rms.value - 5.0).abs() < 1e-12 && rms.interval.is_none());
    }
}
