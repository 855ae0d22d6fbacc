//! Static load of every contact slice by slice: line load, Hertz's pressure, stiffness of the bearing, and the life
//! that follows.
//!
//! For `law = "sliced"`, planar or tilting. Roller and raceway touch as laminae that do not know of each other: the
//! pressure of a slice is that of an even line contact with its line load. It has no stress concentration, neither at
//! the roller's end nor beside damage. Planar and tilting frames are those of [`crate::model`]; SI.

mod along;
mod distribution;
mod life;
mod line;
mod positions;

use crate::error::{Error, refuse};
use crate::scenario::Scenario;
pub use along::{AtRest, LoadAlong};
pub use distribution::{Distribution, Peak};
use life::life_error;
pub use life::{lamina_ratings, reference_life, stress_riser};
use line::in_slices;
pub use line::{ContactLine, FEWEST_SLICES};

/// Load distribution and life, healthy and damaged, with the scenario's slices, but 30 to 200 of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Rating {
    /// Of the bearing without its damage.
    pub healthy: Distribution,
    /// Of the bearing as it is, where it is damaged.
    pub damaged: Option<Distribution>,
    /// L10r of the healthy bearing, revolutions; none without load.
    pub life: Option<f64>,
    /// The same formula over the load distribution of the damaged bearing: what the redistribution of load takes.
    /// Fatigue that starts at the damage, its stress concentration and its impacts are not in it: it is no forecast of
    /// the damaged bearing's life.
    pub damaged_life: Option<f64>,
    /// Its standard error from the positions of turning damage, revolutions.
    pub damaged_life_error: Option<f64>,
}

impl Rating {
    /// The distribution alone of the healthy bearing of a scenario that was checked.
    pub(crate) fn healthy(s: &Scenario) -> Result<Option<Distribution>, Error> {
        let Some(mut s) = in_slices(s) else {
            return Ok(None);
        };
        s.defects.clear();
        Distribution::unchecked(&s).map(Some)
    }

    /// Of a scenario; `None` where its rollers have no slices (`law = "ecl"`, the lumped model), and of balls.
    ///
    /// # Errors
    /// As for [`Distribution::of`].
    pub fn of(s: &Scenario) -> Result<Option<Self>, Error> {
        refuse(s.problems())?;
        Self::unchecked(s)
    }

    /// The same of a scenario that was checked.
    pub(crate) fn unchecked(s: &Scenario) -> Result<Option<Self>, Error> {
        let Some(mut s) = in_slices(s) else {
            return Ok(None);
        };
        let damaged = match s.defects.is_empty() {
            true => None,
            false => Some(Distribution::unchecked(&s)?),
        };
        s.defects.clear();
        let healthy = Distribution::unchecked(&s)?;
        let b = &s.bearing;
        Ok(Some(Self {
            life: reference_life(b, &healthy),
            damaged_life: damaged.as_ref().and_then(|d| reference_life(b, d)),
            damaged_life_error: damaged.as_ref().and_then(|d| life_error(b, d)),
            healthy,
            damaged,
        }))
    }
}
