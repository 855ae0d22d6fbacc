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
//! ```
//! use brinell_shaft::{Beam, Disc, Linear, Material, Part, Whirl};
//!
//! let steel = Material { youngs_modulus: 211e9, shear_modulus: 81.2e9, density: 7810.0 };
//! let part = |length, outer_diameter, inner_diameter| Part { length, outer_diameter, inner_diameter };
//! let disc = Disc::of_cylinder(0.5, &part(0.07, 0.28, 0.05), steel.density);
//! let ends = [0.0, 1.5];
//! let beam = Beam::new(&steel, &[part(1.5, 0.05, 0.0)], (&[disc], &[]), &ends, 0.25).ok_or("beyond the shaft")?;
//! let bearing = |z| {
//!     let port = beam.port(z).ok_or("no node")?;
//!     Ok(Linear { port, stiffness: [[1e6, 0.0], [0.0, 1e6]], damping: [[100.0, 0.0], [0.0, 100.0]] })
//! };
//! let bearings = ends.map(bearing).into_iter().collect::<Result<Vec<_>, &str>>()?;
//! // A Campbell diagram's column at 4000 r/min and its first lines from rest on, and the first critical speed that unbalance excites, r/min.
//! let per_rpm = std::f64::consts::PI / 30.0;
//! let modes = beam.equations.modes(&bearings, 4000.0 * per_rpm);
//! assert_eq!(modes[0].whirl, Whirl::Backward);
//! let lines = beam.equations.campbell(|_| bearings.clone(), &[0.0, 2000.0 * per_rpm, 4000.0 * per_rpm], 4);
//! assert!(lines.iter().any(|line| line[2] == Some(modes[0])));
//! let critical = beam.equations.critical_speeds(&bearings);
//! let first = critical.iter().find(|(_, whirl)| *whirl == Whirl::Forward).map(|(w, _)| w / per_rpm);
//! assert_eq!(first.map(f64::round), Some(1162.0));
//! # Ok::<(), &str>(())
//! ```
//!
//! Nothing here knows a bearing: it is a 2 x 2 stiffness and damping at a node ([`Linear`]), or, after [`reduce`], whatever presses there.

mod beam;
mod equations;
mod reduce;

pub use beam::{Beam, Disc, Material, Part, Spring};
pub use equations::{Equations, Linear, Mode, Port, Whirl};
pub use reduce::{Reduced, normal_modes, reduce};
