//! Damage where it lies: which contact it meets, at which angle, and what it leaves of that contact (section 3).
//!
//! A [`Shape`] is damage seen from above; a [`DepthProfile`] is the same made ready for one law, path and surface, so
//! that a step of the simulation looks depths up in constant time; [`damaged_contact()`] is what a contact feels of it.

mod across;
mod angles;
mod ball_contact;
mod bands;
mod contact_defects;
mod damaged_contact;
mod depth_profile;
mod edge_gradient;
mod envelope;
mod extent;
pub mod fit;
mod grid;
mod joint;
mod map_slices;
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
mod track;

pub use angles::{Angles, SIDES, Side, wrap};
pub use contact_defects::DamagedContact;
pub use damaged_contact::{
    cover_slices, damaged_contact, damaged_contact_given, depth_at_bottom, energy, floors, tangent,
};
pub use depth_profile::{DepthProfile, Rules, relative_radius};
pub use edge_gradient::{EdgeGradient, edge_gradient, edge_gradient_of_slices};
pub use envelope::envelope;
pub use grid::{Covered, Grid};
pub use mean_depths::MeanDepths;
pub use on_table::Met;
pub use outline::{Fault, MOST_CROSSINGS, Outline, Tangle, check_crossings, faults};
#[doc(hidden)]
pub use parts::{neighbours, parts};
pub use piecewise::{Line, PiecewisePolynomial};
pub use placed::{Defect, Defects};
pub use profile::Profile;
pub use random::spall;
pub use shape::Shape;
