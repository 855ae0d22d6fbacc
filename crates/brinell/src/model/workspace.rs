//! What one evaluation of the equations of motion leaves behind: forces of every contact and the flows of energy.

use super::full::CAGE;
use super::{Layout, Power};
use crate::lanes::WIDTH;

/// Instructions that the equations of motion are compiled for. They differ in round-off alone: [`Kernel::Portable`] rounds every
/// product on x86-64, the others fuse products with sums.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// Whatever the target always has: SSE2 on x86-64, NEON on 64-bit Arm.
    Portable,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512.
    Avx512,
}

impl Kernel {
    /// Every kernel.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// Whether this processor can run it.
    pub fn is_there(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            let avx512 = avx2
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl");
            match self {
                Self::Portable => true,
                Self::Avx2 => avx2,
                Self::Avx512 => avx512,
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            self == Self::Portable
        }
    }

    /// The widest that this processor can run.
    pub fn fastest() -> Self {
        Self::ALL
            .into_iter()
            .rev()
            .find(|k| k.is_there())
            .unwrap_or(Self::Portable)
    }
}

/// Contact of one side, structure of arrays over slots.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Contacts {
    /// delta, m.
    pub approach: Vec<f64>,
    /// d(delta)/dt, m/s.
    pub approach_rate: Vec<f64>,
    /// `[delta]_+^n`.
    pub power: Vec<f64>,
    /// Elastic part of Q, N.
    pub elastic: Vec<f64>,
    /// Q, N.
    pub force: Vec<f64>,
    /// Friction on the roller along e_t, N.
    pub friction: Vec<f64>,
    /// Slip of the ring's surface over the roller's, m/s.
    pub slip: Vec<f64>,
    /// L_s at the contact, m.
    pub damaged_length: Vec<f64>,
    /// Whether the contact stands on damage.
    pub on_damage: Vec<bool>,
}

impl Contacts {
    fn new(slots: usize) -> Self {
        let zeros = || vec![0.0; slots];
        Self {
            approach: zeros(),
            approach_rate: zeros(),
            power: zeros(),
            elastic: zeros(),
            force: zeros(),
            friction: zeros(),
            slip: zeros(),
            damaged_length: zeros(),
            on_damage: vec![false; slots],
        }
    }
}

/// Scratch and results of one evaluation; made once, used for a whole run.
#[derive(Debug, Clone, PartialEq)]
pub struct Workspace {
    /// cos theta of each slot.
    pub cos: Vec<f64>,
    /// sin theta of each slot.
    pub sin: Vec<f64>,
    /// Inner and outer contacts, indexed by `Side as usize`.
    pub contacts: [Contacts; 2],
    /// Tangential push of damage's slopes on each roller along e_t, N; 0 without `edge_reaction`.
    pub edge_force: Vec<f64>,
    /// F_c of each slot, N.
    pub pocket_force: Vec<f64>,
    /// f_c of each slot, N.
    pub pocket_friction: Vec<f64>,
    /// Cage quantities spread over the lanes of one period of rows.
    pub(super) cage_lanes: Vec<[[f64; WIDTH]; CAGE]>,
    kernel: Kernel,
    /// Orbit angle of each roller in the reference model, where they are not states.
    pub kinematic_orbit: Vec<f64>,
    /// phi of a roller in the reference model, rad.
    pub kinematic_spin: f64,
    /// Flows of energy at this instant, W.
    pub power: Power,
}

impl Workspace {
    /// For one layout, with the fastest kernel that this processor has.
    pub fn new(layout: &Layout) -> Self {
        Self::with_kernel(layout, Kernel::fastest())
    }

    /// For one layout and one kernel; the fastest where this processor lacks it.
    pub fn with_kernel(layout: &Layout, kernel: Kernel) -> Self {
        let slots = layout.slots;
        let zeros = || vec![0.0; slots];
        Self {
            cos: vec![1.0; slots],
            sin: zeros(),
            contacts: [Contacts::new(slots), Contacts::new(slots)],
            edge_force: zeros(),
            pocket_force: zeros(),
            pocket_friction: zeros(),
            cage_lanes: vec![[[0.0; WIDTH]; CAGE]; layout.row_period() / WIDTH],
            kernel: if kernel.is_there() {
                kernel
            } else {
                Kernel::fastest()
            },
            kinematic_orbit: zeros(),
            kinematic_spin: 0.0,
            power: Power::default(),
        }
    }

    /// The kernel that evaluations use.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }
}
