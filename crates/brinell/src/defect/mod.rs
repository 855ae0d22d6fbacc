//! Damage where it lies: which contact it meets, at which angle, and what it leaves of that contact (section 3).
//!
//! A [`Shape`] is damage seen from above. A contact feels it by its tables (`half-space`, [`Met`]) or by one width and one depth at
//! each s ([`ecl`]).

mod angles;
pub mod ecl;
mod envelope;
mod extent;
pub mod fit;
mod grid;
mod mean_depths;
mod on_table;
mod outline;
mod parts;
mod piecewise;
mod placed;
mod profile;
mod random;
pub mod section;
mod shape;
pub mod simplify;

pub use crate::contact::{SIDES, Side};
pub use angles::{Angles, wrap};
pub use envelope::envelope;
pub use extent::Extent;
pub use grid::{Covered, Grid};
pub use mean_depths::MeanDepths;
pub use on_table::Met;
pub use outline::{Fault, MOST_CROSSINGS, Outline, Tangle, check_crossings, faults};
#[doc(hidden)]
pub use parts::{neighbours, parts};
pub use piecewise::{Line, PiecewisePolynomial};
pub use placed::{Defect, Defects, relative_radius};
pub use profile::Profile;
pub use random::spall;
pub use shape::{Shape, li2023_half_width_mm};
