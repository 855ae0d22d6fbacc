//! What a fit is to meet: numbers with their standard uncertainties.

use super::CalibrateError;
use crate::campaign::{PlanError, number, syntax};
use serde::Serialize;

/// A number to be met.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Target {
    /// Name of a number of a run: `sensor_ax.rms`.
    pub name: String,
    /// What it is to be, in that number's unit.
    pub value: f64,
    /// Standard uncertainty (one sigma), above 0.
    #[serde(rename = "standard_uncertainty")]
    pub uncertainty: f64,
}

/// What a target looks like.
const SYNTAX: &str = "NAME=VALUE~UNCERTAINTY, the uncertainty being one standard deviation in the target's unit or in per cent, for \
                      instance sensor_ax.rms=30.4~1.0 or sensor_ax.rms=30.4~3%";

impl Target {
    /// `NAME=VALUE~UNCERTAINTY`.
    ///
    /// # Errors
    /// Where the text is not that.
    pub fn read(text: &str) -> Result<Self, CalibrateError> {
        let syntax = || syntax(text, SYNTAX);
        let (name, rest) = text.split_once('=').ok_or_else(syntax)?;
        let name = name.trim();
        if name.is_empty() || name.contains(char::is_whitespace) {
            return Err(syntax().into());
        }
        let wrong = |why: String, allowed: &str| PlanError::Value {
            key: name.into(),
            value: rest.trim().into(),
            why,
            allowed: allowed.into(),
        };
        let number = |what: &str, text: &str| number(what, text.trim(), |why| wrong(why, SYNTAX));
        let Some((value, uncertainty)) = rest.split_once('~') else {
            number("value", rest)?;
            return Err(wrong(
                "no standard uncertainty is given, and without one it cannot be said how well the target is met".into(),
                SYNTAX,
            )
            .into());
        };
        let value = number("value", value)?;
        let uncertainty = match uncertainty.trim().strip_suffix('%') {
            Some(share) => 0.01 * number("uncertainty", share)? * value.abs(),
            None => number("uncertainty", uncertainty)?,
        };
        if uncertainty <= 0.0 {
            return Err(wrong(
                "the standard uncertainty is not above 0".into(),
                "a standard uncertainty above 0; in per cent only of a value other than 0",
            )
            .into());
        }
        Ok(Self { name: name.into(), value, uncertainty })
    }

    /// What is wrong with a value below 0 of a number that cannot be.
    pub(super) fn negative(&self) -> PlanError {
        PlanError::Value {
            key: self.name.clone(),
            value: format!("{:?}", self.value),
            why: "a number of this kind is never below 0".into(),
            allowed: "0 or more, in its SI unit".into(),
        }
    }
}

/// Targets that may be together: at least one, none twice.
///
/// # Errors
/// Where they may not.
pub(super) fn check(targets: &[Target]) -> Result<(), CalibrateError> {
    if targets.is_empty() {
        return Err(CalibrateError::NoTarget);
    }
    for (k, target) in targets.iter().enumerate() {
        if targets[..k].iter().any(|other| other.name == target.name) {
            return Err(PlanError::Refused(format!("{} is a target twice; each has one value", target.name)).into());
        }
    }
    Ok(())
}

/// What a run has for a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// `None` where the run has no such number: a line that is not detected.
    pub value: Option<f64>,
    /// The run's own standard uncertainty; 0 where it states none.
    pub uncertainty: f64,
}

/// Residual of a target for which a run has no number, in standard uncertainties: far off, yet no more than a search
/// can climb over.
pub(super) const MISSING: f64 = 10.0;

/// Difference from the targets over the standard uncertainties `sigma`.
pub(super) fn residuals(targets: &[Target], sigma: &[f64], answers: &[Answer]) -> Vec<f64> {
    let one = |((target, sigma), answer): ((&Target, &f64), &Answer)| match answer.value {
        Some(value) => (value - target.value) / sigma,
        None => MISSING,
    };
    targets.iter().zip(sigma).zip(answers).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_targets_are_read() {
        let read = |text| Target::read(text).unwrap();
        let target = read("sensor_ax.rms = 30.4 ~ 1.5");
        assert_eq!((&target.name[..], target.value, target.uncertainty), ("sensor_ax.rms", 30.4, 1.5));
        assert_eq!(read("a=-50~2%").uncertainty, 1.0);
    }

    #[test]
    fn regress_what_is_wrong_is_said() {
        for (text, said) in [
            ("a.b", "`a.b`: expected NAME=VALUE~UNCERTAINTY"),
            ("a=30", "a = 30: no standard uncertainty is given"),
            ("a=x~1", "the value, `x`, is not a number"),
            ("a=x", "the value, `x`, is not a number"),
            ("a=1~x", "the uncertainty, `x`, is not a number"),
            ("a=1~0", "the standard uncertainty is not above 0"),
            ("a=0~5%", "the standard uncertainty is not above 0"),
        ] {
            let error = Target::read(text).unwrap_err().to_string();
            assert!(error.contains(said), "{text}: {error}");
        }
    }

    #[test]
    fn analytic_residuals_are_in_standard_uncertainties() {
        let targets = [Target::read("a=10~1").unwrap(), Target::read("b=5~1").unwrap()];
        let answer = |value| Answer { value, uncertainty: 0.0 };
        let r = residuals(&targets, &[2.0, 1.0], &[answer(Some(13.0)), answer(None)]);
        assert_eq!(r, [1.5, MISSING]);
    }
}
