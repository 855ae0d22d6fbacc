//! What is asked of the solvers and what they answer, and the forces that both of them know.

use crate::defect::{Angles, Defect, Side};
use crate::model::Model;
use crate::scenario::Surface;

/// Question put to the solver.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Problem {
    /// Speed of the inner ring, rad/s: sets the centrifugal force of rollers in pure rolling.
    pub speed: f64,
    /// Angle of the inner ring, rad.
    pub ring_angle: f64,
    /// Orbit angle of each slot, rad.
    pub orbit: Vec<f64>,
    /// Spin angle of each slot, rad.
    pub spin: Vec<f64>,
    /// Hold the inner ring at the centre.
    pub fix_inner: bool,
    /// Hold the outer ring at the centre.
    pub fix_outer: bool,
    /// Where the search begins: offsets of the inner and the outer ring, m. A ring that is held stays at the centre.
    pub guess: [[f64; 2]; 2],
}

impl Problem {
    /// The state of a model at t = 0 under its full load.
    pub fn at_start(model: &Model) -> Self {
        Self {
            speed: model.rotation.at(0.0).0,
            ring_angle: 0.0,
            orbit: model.pocket_angle.to_vec(),
            spin: vec![0.0; model.layout.slots],
            fix_inner: false,
            fix_outer: model.outer_ring_is_fixed(),
            guess: [[0.0; 2]; 2],
        }
    }

    /// The positions of all parts with a roller at s (m) of a defect: of the outer raceway where it lies, of the inner
    /// one or of a roller turned to the angle `middle` (rad), a roller's towards the outer raceway. Without a defect, with
    /// a roller of `row` at `middle`. And the slot that is looked at.
    pub(crate) fn at_rest(model: &Model, over: Option<(&Defect, f64)>, row: usize, middle: f64) -> (Self, usize) {
        let l = &model.layout;
        let mut problem = Self::at_start(model);
        let (slot, orbit) = match over {
            None => (l.slot(row, 0), middle),
            Some((defect, s)) => {
                // With spin and inner ring at 0.
                let met = |side| defect.met_at(side, s / defect.radius).orbit;
                match defect.surface {
                    Surface::OuterRaceway => (l.slot(defect.row, 0), met(Side::Outer)),
                    Surface::InnerRaceway => {
                        problem.ring_angle = middle - met(Side::Inner);
                        (l.slot(defect.row, 0), middle)
                    }
                    Surface::Roller(roller) => {
                        let slot = l.slot(defect.row, roller);
                        problem.spin[slot] = middle - met(Side::Outer);
                        (slot, middle)
                    }
                }
            }
        };
        problem.turn_cage(model, orbit - model.pocket_angle[slot]);
        (problem, slot)
    }

    /// Turns the cages to an angle, rad, from where they start.
    pub(crate) fn turn_cage(&mut self, model: &Model, angle: f64) {
        self.orbit.iter_mut().zip(&model.pocket_angle).for_each(|(orbit, pocket)| *orbit = pocket + angle);
    }
}

/// The balance.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Balance {
    /// Offset of the inner ring, m.
    pub inner: [f64; 2],
    /// Offset of the outer ring, m.
    pub outer: [f64; 2],
    /// Radial offset of each slot's roller, m.
    pub r: Vec<f64>,
    /// Q_in of each slot, N.
    pub inner_force: Vec<f64>,
    /// Q_out of each slot, N.
    pub outer_force: Vec<f64>,
    /// Stiffness of the bearing between its rings, N/m: the force on the inner ring is minus this times its
    /// displacement.
    pub stiffness: [[f64; 2]; 2],
    /// Tilts, where rollers and rings tilt.
    pub tilting: Option<Tilted>,
    /// Largest force left over on a ring, N; of a moment its share of the pitch radius.
    pub residual: f64,
    /// Newton iterations.
    pub iterations: usize,
}

/// The tilts of a balance, section 16.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Tilted {
    /// tau of the inner and of the outer ring, rad.
    pub rings: [[f64; 2]; 2],
    /// beta of each slot's roller, rad.
    pub rollers: Vec<f64>,
    /// T of each slot's inner and outer contact, N m.
    pub moments: [Vec<f64>; 2],
    /// Stiffness of the bearing between its rings over (x, y, tau_x, tau_y): N/m, N/rad, N m/rad. Along the axis
    /// cylindrical rollers hold nothing.
    pub stiffness: [[f64; 4]; 4],
}

/// No balance was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("no static balance: {} left on a ring after {iterations} iterations; {}", newton(*.residual), self.remedy())]
pub struct NoBalance {
    /// Force left over, N; not a number where a contact force was none.
    pub residual: f64,
    /// The largest force at play, N.
    pub scale: f64,
    /// Iterations made.
    pub iterations: usize,
}

impl NoBalance {
    /// What may be the matter.
    fn remedy(&self) -> String {
        /// Share of the largest force below which a ring is held, and the search alone ended.
        const HELD: f64 = 0.01;
        let share = self.residual / self.scale;
        if share < HELD {
            format!(
                "that is {:.1e} of the largest force: the search ended beside a force that jumps, as it may at the edge of damage",
                share
            )
        } else {
            "a free ring needs a support or a loaded contact against the load, and where it tilts against its moment \
             (support.*_tilt_stiffness_nm_per_rad)"
                .into()
        }
    }
}

fn newton(force: f64) -> String {
    match force.is_finite() {
        true => format!("{force:.3e} N are"),
        false => "a force beyond any number is".into(),
    }
}

/// Rings' offsets (x_i, y_i, x_o, y_o).
pub(super) type Offsets = [f64; 4];

/// The largest force at play, N: loads, and the weight and centrifugal force of all rollers.
pub(super) fn force_scale(model: &Model, problem: &Problem, forces: &[f64]) -> f64 {
    let count = model.layout.rollers() as f64;
    let weight = count * model.inertia.roller * centrifugal(model, problem.speed).abs();
    forces.iter().fold(0.0_f64, |m, f| m.max(f.abs())).max(weight).max(1e-9)
}

/// The residual, N, with which a search that gets no farther has found the balance: what round-off and a table leave, or what an element pushes that only
/// its own force presses, of its centrifugal force and weight. One on the edge of damage stands on it or beside it, and no ring is held by
/// so little; as it counts no more than a ten-thousandth of the largest force `scale` does.
pub(super) fn stalled(model: &Model, problem: &Problem, scale: f64) -> f64 {
    let own = (0..problem.orbit.len()).map(|slot| own_force(model, problem, slot).abs()).fold(0.0, f64::max);
    own.clamp(1e-6 * scale, 1e-4 * scale)
}

/// Where the damping of Newton's method begins, N/m: the series stiffness at a deflection of a micrometre. Any value of
/// this order does.
pub(super) fn softest(model: &Model) -> f64 {
    1e-3 * model.series_contact.tangent(1e-6).max(1.0)
}

/// Centripetal acceleration of a roller in pure rolling, m/s^2.
fn centrifugal(model: &Model, speed: f64) -> f64 {
    model.geometry.pitch_radius * model.rolling_orbit_speed(speed).powi(2)
}

/// Radial force of a roller's own weight and centrifugal force, N: outwards.
pub(super) fn own_force(model: &Model, problem: &Problem, slot: usize) -> f64 {
    let (sin, cos) = problem.orbit[slot].sin_cos();
    model.inertia.roller * (centrifugal(model, problem.speed) + cos * model.gravity[0] + sin * model.gravity[1])
}

/// Loads and weights of the rings, N.
pub(super) fn external(model: &Model) -> Offsets {
    let (inner, outer) = model.load.on_rings(1.0);
    let (m, g) = (&model.inertia, &model.gravity);
    [
        inner[0] + m.inner_ring * g[0],
        inner[1] + m.inner_ring * g[1],
        outer[0] + m.outer_ring * g[0],
        outer[1] + m.outer_ring * g[1],
    ]
}

pub(super) fn angles(problem: &Problem, slot: usize) -> Angles {
    Angles { orbit: problem.orbit[slot], spin: problem.spin[slot], ring: problem.ring_angle }
}

/// A number of each roller by its slot; 0 for padding.
pub(super) fn by_slot<R>(model: &Model, rollers: &[R], of: impl Fn(&R) -> f64) -> Vec<f64> {
    let mut values = vec![0.0; model.layout.slots];
    values.iter_mut().zip(rollers).for_each(|(value, roller)| *value = of(roller));
    values
}
