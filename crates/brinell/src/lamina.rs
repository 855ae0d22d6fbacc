//! Static load of every contact slice by slice: line load, Hertz's pressure, stiffness of the bearing, and the life
//! that follows.
//!
//! Of bearings with rollers, planar or tilting, without their damage. Roller and raceway touch as laminae that do not know of each
//! other: the pressure of a slice is that of an even line contact with its line load. It has no stress concentration at the
//! roller's end; pressures over damage are in [`crate::half_space`]. Planar and tilting frames are those of [`crate::model`]; SI.

mod along;
mod distribution;
mod life;
mod line;

use crate::error::{Error, refuse};
use crate::scenario::Scenario;
pub use along::LoadAlong;
pub use distribution::{Distribution, Peak};
pub use life::{lamina_ratings, reference_life, stress_riser};
use line::in_slices;
pub use line::{ContactLine, FEWEST_SLICES};

/// Load distribution and life without damage, in the scenario's slices, but 30 to 200 of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Rating {
    /// What every contact carries.
    pub distribution: Distribution,
    /// L10r, revolutions; none without load.
    pub life: Option<f64>,
}

impl Rating {
    /// Of a scenario; `None` for balls and for the lumped model.
    ///
    /// # Errors
    /// As for [`Distribution::of`].
    pub fn of(s: &Scenario) -> Result<Option<Self>, Error> {
        refuse(s.problems())?;
        Self::unchecked(s)
    }

    /// The same of a scenario that was checked.
    pub(crate) fn unchecked(s: &Scenario) -> Result<Option<Self>, Error> {
        let Some(s) = in_slices(s) else {
            return Ok(None);
        };
        let distribution = Distribution::unchecked(&s)?;
        Ok(Some(Self { life: reference_life(&s.bearing, &distribution), distribution }))
    }
}
