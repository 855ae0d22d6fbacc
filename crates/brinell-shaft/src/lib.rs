//! A rotating shaft as Timoshenko beams: its matrices, what it does on linear bearings, and its reduction to a few modes.
//!
//! SI units. The axis is Z, the planes are (X, Z) and (Y, Z); the shaft turns from X to Y. A node has in each plane a displacement x (m) and
//! the rotation of its section, tau (rad), counted as the slope dx/dZ that it has without shear. A force and a moment Z F at the node
//! belong to them. Both planes have the same matrices, and the gyroscopic one couples them at the speed w:
//!
//! ```text
//! M a_x + w G v_y + K x = F_x,    M a_y - w G v_x + K y = F_y
//! ```
//!
//! Nothing here knows a bearing: it is a 2 x 2 stiffness and damping at a node ([`Linear`]), or, after [`reduce`], whatever presses there.

mod beam;
mod equations;
mod reduce;

pub use beam::{Beam, Disc, Material, Part, Spring};
pub use equations::{Equations, Linear, Mode, Port, Whirl};
pub use reduce::{Reduced, reduce};
