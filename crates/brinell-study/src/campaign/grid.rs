//! A grid of settings: every combination of the axes, in a fixed order.

use super::axis::Axis;
use super::error::{MOST_POINTS, PlanError};
use super::row::in_json;
use brinell::made_by::digest;
use brinell::signal::objects;
use serde_json::Value;

/// Whether a key is another one, or one inside it.
pub fn is_inside(key: &str, other: &str) -> bool {
    key.strip_prefix(other).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// That no two keys set the same: a key twice, of which `twice` is said, or one inside the other.
pub(crate) fn clash<'a>(keys: impl Iterator<Item = &'a str>, twice: &str) -> Result<(), PlanError> {
    let mut before: Vec<&str> = Vec::new();
    for key in keys {
        if let Some(other) = before.iter().find(|other| is_inside(key, other) || is_inside(other, key)) {
            return Err(PlanError::Refused(match *other == key {
                true => format!("{key} {twice}"),
                false => format!("{other} and {key} lie one inside the other, and would overwrite each other"),
            }));
        }
        before.push(key);
    }
    Ok(())
}

/// Every combination of the settings of some axes. The last axis changes from point to point, the first one slowest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grid {
    axes: Vec<Axis>,
}

impl Grid {
    /// Of axes; without any it has one point, which changes nothing.
    ///
    /// # Errors
    /// Where two axes set one key, or one inside the other, or there are more than 100 000 points.
    pub fn new(axes: Vec<Axis>) -> Result<Self, PlanError> {
        clash(axes.iter().flat_map(Axis::keys).map(String::as_str), "varies twice; each key varies in one place")?;
        // At most 100000^axes: a command line is too short to overflow this, and saturation would still refuse.
        let points = axes.iter().fold(1_u128, |product, axis| product.saturating_mul(axis.settings().len() as u128));
        if points > MOST_POINTS as u128 {
            return Err(PlanError::Refused(format!("{points} points\n  allowed: 1 to {MOST_POINTS} points")));
        }
        Ok(Self { axes })
    }

    /// The axes.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// All keys that vary, in order.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.axes.iter().flat_map(|axis| axis.keys().iter().map(String::as_str))
    }

    /// Points, at least one.
    pub fn points(&self) -> usize {
        self.axes.iter().map(|axis| axis.settings().len()).product()
    }

    /// Which setting of each axis a point has.
    ///
    /// # Panics
    /// Where the point is not below [`Grid::points`].
    pub fn place(&self, point: usize) -> Vec<usize> {
        assert!(point < self.points(), "point {point} of {}", self.points());
        let mut rest = point;
        let mut place: Vec<usize> = self
            .axes
            .iter()
            .rev()
            .map(|axis| {
                let here = rest % axis.settings().len();
                rest /= axis.settings().len();
                here
            })
            .collect();
        place.reverse();
        place
    }

    /// Head of a sweep's journal, which tells it from others: the axes, and the fingerprints of the points' scenarios,
    /// none of a bad one.
    #[doc(hidden)]
    pub fn header<'a>(&self, scenarios: impl Iterator<Item = Option<&'a str>>) -> Value {
        objects! { Head<'a> { campaign: &'a str, plan: &'a [Axis], scenarios: String } }
        let scenarios: Vec<&str> = scenarios.map(|s| s.unwrap_or("bad")).collect();
        in_json(&Head { campaign: "sweep", plan: &self.axes, scenarios: digest(&scenarios.join(" ")) })
    }

    /// Key and value of everything that a point sets: overrides for [`brinell::document::read`].
    ///
    /// # Panics
    /// As [`Grid::place`].
    pub fn settings(&self, point: usize) -> Vec<(String, String)> {
        let chosen = self.axes.iter().zip(self.place(point));
        chosen
            .flat_map(|(axis, k)| {
                let pairs = axis.keys().iter().zip(&axis.settings()[k]);
                pairs.map(|(key, value)| (key.clone(), value.clone()))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(axes: &[&str]) -> Result<Grid, PlanError> {
        Grid::new(axes.iter().map(|text| Axis::vary(text).unwrap()).collect())
    }

    #[test]
    fn prop_every_combination_comes_once_the_last_axis_first() {
        let plan = plan(&["a=1,2,3", "b=x,y", "c=4:6:1"]).unwrap();
        let mut expected = Vec::new();
        for a in ["1", "2", "3"] {
            for b in ["x", "y"] {
                for c in ["4", "5", "6"] {
                    expected.push([("a", a), ("b", b), ("c", c)].map(|(k, v)| (k.into(), v.into())));
                }
            }
        }
        assert_eq!(plan.points(), expected.len());
        for (k, point) in expected.iter().enumerate() {
            assert_eq!(plan.settings(k), point, "point {k}");
        }
        assert_eq!(plan.place(7), [1, 0, 1]);
        assert_eq!(plan.keys().collect::<Vec<_>>(), ["a", "b", "c"]);
    }

    #[test]
    fn regress_no_axis_is_one_point() {
        let plan = plan(&[]).unwrap();
        assert_eq!((plan.points(), plan.settings(0).len()), (1, 0));
    }

    #[test]
    fn regress_plans_that_cannot_be() {
        let say = |axes: &[&str]| plan(axes).unwrap_err().to_string();
        assert_eq!(say(&["a.b=1", "a.b=2"]), "a.b varies twice; each key varies in one place");
        assert_eq!(
            say(&["defects.0=1", "defects.0.depth_um=2"]),
            "defects.0 and defects.0.depth_um lie one inside the other, and would overwrite each other"
        );
        assert_eq!(say(&["a=1:1000:1", "b=1:1000:1"]), "1000000 points\n  allowed: 1 to 100000 points");
        assert!(plan(&["defects.1.depth_um=1", "defects.10.depth_um=2"]).is_ok());
    }
}
