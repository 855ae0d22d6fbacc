//! A key that is fitted: its range, and the line between the range and the unit interval that the search works in.

use super::CalibrateError;
use crate::campaign::{PlanError, assigned, clash, number, syntax};
use brinell::signal::rounded;
use serde::Serialize;

/// A key and its bounds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Key {
    /// Dotted path, `bearing.radial_clearance_um`.
    #[serde(rename = "key")]
    pub name: String,
    /// Lower bound.
    pub low: f64,
    /// Upper bound.
    pub high: f64,
    /// Searched in its logarithm.
    pub log: bool,
}

/// What a key to be fitted looks like.
const SYNTAX: &str = "KEY=LOW:HIGH or KEY=LOW:HIGH:log, for instance bearing.radial_clearance_um=2:20 or \
                      support.outer_stiffness_n_per_m=1e5:1e7:log";
/// Digits of a value that is tried: finer ones would mean nothing, and a file with them would be hard to read.
const DIGITS: usize = 6;

impl Key {
    /// `KEY=LOW:HIGH`, or `KEY=LOW:HIGH:log`.
    ///
    /// # Errors
    /// Where the text is not that, or the bounds span nothing.
    pub fn read(text: &str) -> Result<Self, CalibrateError> {
        let (name, bounds) = assigned(text, SYNTAX)?;
        let parts: Vec<&str> = bounds.split(':').map(str::trim).collect();
        let (low, high, log) = match parts[..] {
            [low, high] => (low, high, false),
            [low, high, "log"] => (low, high, true),
            _ => return Err(syntax(text, SYNTAX).into()),
        };
        let wrong = |why: String, allowed: &str| PlanError::Value {
            key: name.into(),
            value: bounds.trim().into(),
            why,
            allowed: allowed.into(),
        };
        let bound = |what: &str, text: &str| number(what, text, |why| wrong(why, SYNTAX));
        let (low, high) = (bound("lower bound", low)?, bound("upper bound", high)?);
        if low >= high {
            let why = if low > high {
                format!("the bounds are reversed; {high:?}:{low:?} is meant")
            } else {
                "the bounds are equal".into()
            };
            return Err(wrong(why, "a lower bound below the upper one").into());
        }
        if log && low <= 0.0 {
            return Err(wrong("a logarithm needs bounds above 0".into(), "bounds above 0, or no `:log`").into());
        }
        // What lies between is computed from that.
        if !(if log { high / low } else { high - low }).is_finite() {
            return Err(
                wrong("the bounds are too far apart to compute with".into(), "a range that a key can have").into()
            );
        }
        Ok(Self { name: name.into(), low, high, log })
    }

    /// The value at a place of the unit interval, to six digits.
    pub fn value(&self, unit: f64) -> f64 {
        let unit = unit.clamp(0.0, 1.0);
        let exact = if self.log {
            (self.low.ln() + unit * (self.high / self.low).ln()).exp()
        } else {
            self.low + unit * (self.high - self.low)
        };
        rounded(exact, DIGITS).clamp(self.low, self.high)
    }

    /// The place of a value in the unit interval, beyond it where the value lies outside the bounds.
    pub fn unit(&self, value: f64) -> f64 {
        if self.log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// The value as TOML.
    pub fn text(&self, unit: f64) -> String {
        format!("{:?}", self.value(unit))
    }
}

/// Keys that may be fitted together: at least one, none twice or inside another.
///
/// # Errors
/// Where they may not.
pub fn check(keys: &[Key]) -> Result<(), CalibrateError> {
    if keys.is_empty() {
        return Err(PlanError::Refused("no key is to be fitted".into()).into());
    }
    Ok(clash(keys.iter().map(|key| key.name.as_str()), "is to be fitted twice; each key has one range")?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_values_and_places_are_inverse() {
        for text in ["a.b=2:20", "a.b=-3:1e4", "a.b=1e5:1e7:log", "a.b=1_000:2_000:log"] {
            let key = Key::read(text).unwrap();
            assert_eq!((key.value(0.0), key.value(1.0)), (key.low, key.high));
            for step in 0..=100 {
                let unit = f64::from(step) / 100.0;
                let again = key.unit(key.value(unit));
                assert!((again - unit).abs() < 2e-5, "{text}: {unit} {again}");
            }
        }
        let key = Key::read("a=1e5:1e7:log").unwrap();
        assert_eq!(key.value(0.5), 1e6);
        assert_eq!(key.text(0.5), "1000000.0");
    }

    #[test]
    fn regress_what_is_wrong_is_said() {
        for (text, said) in [
            ("a.b", "`a.b`: expected KEY=LOW:HIGH"),
            ("a b=1:2", "expected KEY=LOW:HIGH"),
            ("a=1", "expected KEY=LOW:HIGH"),
            ("a=1:2:lin", "expected KEY=LOW:HIGH"),
            ("a=x:2", "a = x:2: the lower bound, `x`, is not a number"),
            ("a=1:inf", "the upper bound, `inf`, is not a number"),
            ("a=20:2", "a = 20:2: the bounds are reversed; 2.0:20.0 is meant"),
            ("a=2:2", "the bounds are equal"),
            ("a=0:2:log", "a logarithm needs bounds above 0"),
            ("a=-1e308:1e308", "the bounds are too far apart"),
            ("a=1e-200:1e200:log", "the bounds are too far apart"),
        ] {
            let error = Key::read(text).unwrap_err().to_string();
            assert!(error.contains(said), "{text}: {error}");
        }
        let key = Key::read("a=1:2").unwrap();
        assert_eq!(
            check(&[key.clone(), key]).unwrap_err().to_string(),
            "a is to be fitted twice; each key has one range"
        );
        let inside = ["a.b=1:2", "a.bc=1:2", "a=1:2"].map(|text| Key::read(text).unwrap());
        assert_eq!(check(&inside[..2]), Ok(()));
        assert_eq!(
            check(&inside).unwrap_err().to_string(),
            "a.b and a lie one inside the other, and would overwrite each other"
        );
    }
}
