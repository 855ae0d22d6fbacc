//! What one evaluation of the equations of motion leaves behind: forces of every contact and the flows of energy.

use super::{Model, Power};
use crate::lanes::{Column, WIDTH};

/// How the equations of motion are computed. The kernels differ in round-off alone: [`Kernel::Plain`] and [`Kernel::Portable`] round every
/// product on x86-64, the others fuse products with sums.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// One roller at a time, with the standard library's functions.
    Plain,
    /// Whatever the target always has: SSE2 on x86-64, NEON on 64-bit Arm.
    Portable,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512.
    Avx512,
}

impl Kernel {
    /// Every kernel.
    pub const ALL: [Self; 4] = [Self::Plain, Self::Portable, Self::Avx2, Self::Avx512];

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
                Self::Plain | Self::Portable => true,
                Self::Avx2 => avx2,
                Self::Avx512 => avx512,
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            matches!(self, Self::Plain | Self::Portable)
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
    pub approach: Column,
    /// d(delta)/dt, m/s.
    pub approach_rate: Column,
    /// `[delta]_+^n`.
    pub power: Column,
    /// Elastic part of Q, N.
    pub elastic: Column,
    /// Q, N.
    pub force: Column,
    /// Friction on the roller along e_t, N.
    pub friction: Column,
    /// Slip of the ring's surface over the roller's, m/s.
    pub slip: Column,
    /// L_s at the contact, m.
    pub damaged_length: Column,
    /// Whether the contact stands on damage.
    pub on_damage: Vec<bool>,
}

impl Contacts {
    fn new(slots: usize) -> Self {
        let zeros = || Column::new(slots, 0.0);
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
    pub cos: Column,
    /// sin theta of each slot.
    pub sin: Column,
    /// Inner and outer contacts, indexed by `Side as usize`.
    pub contacts: [Contacts; 2],
    /// Tangential push of damage's slopes on each roller along e_t, N; 0 without `edge_reaction`.
    pub edge_force: Column,
    /// F_c of each slot, N.
    pub pocket_force: Column,
    /// f_c of each slot, N.
    pub pocket_friction: Column,
    /// (cos, sin) of the middle of each raceway defect that meets the contacts of each side.
    pub(super) directions: [Vec<[f64; 2]>; 2],
    /// Lanes of each group whose contact may stand on damage, a bit each; as many groups as the kernel's pairs make of the slots.
    pub(super) exposed: [Vec<u8>; 2],
    /// Groups of which some contact may be closed.
    pub(super) near: [Vec<bool>; 2],
    kernel: Kernel,
    /// Orbit angle of each roller in the reference model, where they are not states.
    pub kinematic_orbit: Vec<f64>,
    /// phi of a roller in the reference model, rad.
    pub kinematic_spin: f64,
    /// Largest elastic force of each side's contacts, N, in each lane.
    pub(super) heaviest: [[f64; WIDTH]; 2],
    /// Largest damping of a cage's guidance film in any direction, N s/m.
    pub(crate) film_damping: f64,
    /// Flows of energy at this instant, W.
    pub power: Power,
}

impl Workspace {
    /// For one model, with the fastest kernel that this processor has.
    pub fn new(model: &Model) -> Self {
        Self::with_kernel(model, Kernel::fastest())
    }

    /// For one model and one kernel; the fastest where this processor lacks it.
    pub fn with_kernel(model: &Model, kernel: Kernel) -> Self {
        let slots = model.layout.slots;
        let zeros = || Column::new(slots, 0.0);
        Self {
            cos: Column::new(slots, 1.0),
            sin: zeros(),
            contacts: [Contacts::new(slots), Contacts::new(slots)],
            edge_force: zeros(),
            pocket_force: zeros(),
            pocket_friction: zeros(),
            exposed: [vec![0; slots], vec![0; slots]],
            near: [vec![false; slots], vec![false; slots]],
            directions: [0, 1].map(|side| model.exposure[side].directions()),
            kernel: if kernel.is_there() {
                kernel
            } else {
                Kernel::fastest()
            },
            kinematic_orbit: vec![0.0; slots],
            kinematic_spin: 0.0,
            heaviest: [[0.0; WIDTH]; 2],
            film_damping: 0.0,
            power: Power::default(),
        }
    }

    /// Largest elastic force of each side's contacts, N.
    pub fn heaviest(&self) -> [f64; 2] {
        self.heaviest
            .map(|lanes| lanes.into_iter().fold(0.0, f64::max))
    }

    /// The kernel that evaluations use.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }
}
