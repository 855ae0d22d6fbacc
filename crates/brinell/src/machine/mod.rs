//! Bearings in a machine (section 25), by a [`Plan`]: one shaft, housings, and bearings between them that are each a [`Model`](crate::model::Model) of their own.
//!
//! Positions are those of every bearing, in the order of its own layout, then the coordinates of every structure, then those of the points
//! that are looked at. A ring that sits on a structure has no motion of its own: its entries follow the structure, whose accelerations are
//! linear in its coordinates, so that they stay where the structure is to round-off. What a bearing makes of such a ring by itself, free with
//! its mass, says which force acts on it.

mod assembly;
mod balance;
mod channels;
mod energy;
mod motion;
mod of_scenario;
mod plan;
mod rotor;
mod structure;

pub use assembly::{Machine, Mount, Point, Seated};
pub use balance::{Balance, Carried};
pub use brinell_shaft::{Disc, Equations, Linear, Material, Mode, Part, Port, Spring, Whirl};
pub use motion::{Evaluated, MachineMotion, Parts};
pub(crate) use of_scenario::{bearings, machine, unloaded};
pub use plan::{Housing, HousingMode, OnShaft, Plan, PlanError, Shaft};
pub use structure::{Row, Seat, Structure};
