//! What one evaluation of the equations of motion leaves behind: forces of every contact and the flows of energy.

use super::{External, Model, Power};
use crate::cage::GuideForce;
use crate::kernel::Kernel;
use crate::lanes::{Column, Lanes, WIDTH};
use crate::slices::Approach;

/// Contact of one side, structure of arrays over slots.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Contacts {
    /// delta, m.
    pub deformation: Column,
    /// d(delta)/dt, m/s.
    pub approach_rate: Column,
    /// `[delta]_+^n`.
    pub power: Column,
    /// Elastic part of Q, N.
    pub elastic: Column,
    /// Q, N.
    pub force: Column,
    /// What the film of an open contact carries, N; 0 where the model has no film.
    pub film: Column,
    /// Friction on the roller along e_t, N.
    pub friction: Column,
    /// Slip of the ring's surface over the roller's, m/s.
    pub slip: Column,
    /// delta less the surfaces' waviness, m; empty where there is none.
    pub pressed: Column,
    /// dw/du of the raceway and of the rolling element, m/rad; empty like that.
    pub wave_slope: [Column; 2],
    /// c of the contact, N s/m, where damping goes with the stiffness.
    pub damper: Column,
    /// M_r against the rolling on the roller, N m.
    pub rolling: Column,
    /// n along e_r and e_t, in exact geometry.
    pub normal: [Column; 2],
    /// rho, m, in exact geometry.
    pub distance: Column,
    /// P = dE/du of both surfaces together, N m, and of the rolling element's own: what pushes along the surface.
    pub push: Column,
    /// See above.
    pub push_element: Column,
    /// L_s at the contact, m; under `half-space`, where nothing tilts, of the profile alone: [`crate::channel::contact_length`].
    pub damaged_length: Column,
    /// Whether the contact is on damage.
    pub on_damage: Vec<bool>,
    /// d(delta)/dz, its rate (1/s), T (N m) and what damping takes (W), where rollers tilt; else empty.
    pub tilt: Column,
    /// See above.
    pub tilt_rate: Column,
    /// See above.
    pub moment: Column,
    /// See above.
    pub loss: Column,
}

impl Contacts {
    fn new(slots: usize, tilts: bool, wavy: bool) -> Self {
        let zeros = || Column::new(slots, 0.0);
        let waves = || Column::new(if wavy { slots } else { 0 }, 0.0);
        let tilting = || Column::new(if tilts { slots } else { 0 }, 0.0);
        Self {
            tilt: tilting(),
            tilt_rate: tilting(),
            moment: tilting(),
            loss: tilting(),
            deformation: zeros(),
            approach_rate: zeros(),
            power: zeros(),
            elastic: zeros(),
            force: zeros(),
            film: zeros(),
            pressed: waves(),
            wave_slope: [waves(), waves()],
            damper: zeros(),
            rolling: zeros(),
            normal: [Column::new(slots, 1.0), zeros()],
            distance: Column::new(slots, 1.0),
            push: zeros(),
            push_element: zeros(),
            friction: zeros(),
            slip: zeros(),
            damaged_length: zeros(),
            on_damage: vec![false; slots],
        }
    }

    /// Takes the slots from `first` on off damage.
    #[inline(always)]
    pub(super) fn heal<L: Lanes>(&mut self, first: usize) {
        let group = first / L::COUNT;
        for column in [&mut self.push, &mut self.push_element] {
            L::groups_mut(column)[group] = L::zero().array();
        }
        self.on_damage[first..first + L::COUNT].fill(false);
    }

    /// Angle from the direction of the bearing's centre to that of the ring's, alpha - theta, rad: section 18; 0 in centred
    /// geometry.
    #[inline]
    pub fn lean(&self, slot: usize) -> f64 {
        (self.normal[1][slot] / self.normal[0][slot]).atan()
    }

    /// delta less waviness where there is any, m.
    #[inline(always)]
    pub fn pressed_or_deformed(&self) -> &Column {
        if self.pressed.is_empty() { &self.deformation } else { &self.pressed }
    }

    /// How the contact of `slot` approaches; without tilt where nothing tilts.
    #[inline(always)]
    pub fn approach(&self, slot: usize) -> Approach {
        let tilting = |of: &[f64]| of.get(slot).copied().unwrap_or_default();
        Approach {
            deformation: self.pressed_or_deformed()[slot],
            tilt: tilting(&self.tilt),
            rate: self.approach_rate[slot],
            tilt_rate: tilting(&self.tilt_rate),
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
    /// What pockets do to each roller in exact geometry: along e_r, along e_t (N) and about its axis (N m).
    pub on_roller: [Column; 3],
    /// Torque of the drive on the inner ring and of the housing that holds the outer one, N m.
    pub torques: [f64; 2],
    /// F_c of each slot, N.
    pub pocket_force: Column,
    /// f_c of each slot, N.
    pub pocket_friction: Column,
    /// (cos, sin) of the middle of each raceway defect that meets the contacts of each side.
    pub(super) directions: [Vec<[f64; 2]>; 2],
    /// Lanes of each group whose contact may be on damage, a bit each; as many groups as the kernel's pairs make of the
    /// slots.
    pub(super) candidates: [Vec<u8>; 2],
    /// The same of the evaluation before: groups whose contacts were written as on damage.
    pub(super) written: [Vec<u8>; 2],
    /// Groups of which some contact may be closed.
    pub(super) maybe_closed: [Vec<bool>; 2],
    /// Sine and cosine of the directions from a ring's centre, of the side that is being looked at.
    pub(super) seen: [Column; 2],
    kernel: Kernel,
    /// Orbit angle of each roller in the lumped model, where they are not states.
    pub kinematic_orbit: Vec<f64>,
    /// phi of a roller in the lumped model, rad.
    pub kinematic_spin: f64,
    /// Largest elastic force of each side's contacts, N, in each lane.
    pub(super) max_elastic: [[f64; WIDTH]; 2],
    /// What guides each row's cage.
    pub(super) guidance: Vec<GuideForce>,
    /// Flows of energy at this instant, W.
    pub power: Power,
    /// Further forces of the user's own.
    pub(super) external: External,
}

impl Workspace {
    /// For one model, with the kernel of this process ([`Kernel::chosen`]).
    pub fn new(model: &Model) -> Self {
        Self::with_kernel(model, Kernel::in_use())
    }

    /// For one model and one kernel; the fastest where this processor lacks it.
    pub fn with_kernel(model: &Model, kernel: Kernel) -> Self {
        let slots = model.layout.slots;
        let zeros = || Column::new(slots, 0.0);
        Self {
            cos: Column::new(slots, 1.0),
            sin: zeros(),
            contacts: [0, 1].map(|_| Contacts::new(slots, model.layout.tilts, model.waviness.is_some())),
            seen: [zeros(), zeros()],
            on_roller: [zeros(), zeros(), zeros()],
            torques: [0.0; 2],
            pocket_force: zeros(),
            pocket_friction: zeros(),
            candidates: [vec![0; slots], vec![0; slots]],
            written: [vec![0; slots], vec![0; slots]],
            maybe_closed: [vec![false; slots], vec![false; slots]],
            directions: [0, 1].map(|side| model.broad_phase[side].directions()),
            kernel: if kernel.is_there() { kernel } else { Kernel::fastest() },
            kinematic_orbit: vec![0.0; slots],
            kinematic_spin: 0.0,
            max_elastic: [[0.0; WIDTH]; 2],
            guidance: vec![GuideForce::default(); model.layout.rows],
            power: Power::default(),
            external: External::default(),
        }
    }

    /// Largest elastic force of each side's contacts, N.
    pub fn max_elastic(&self) -> [f64; 2] {
        self.max_elastic.map(|lanes| lanes.into_iter().fold(0.0, f64::max))
    }

    /// Largest damping of a cage's guidance film in any direction, N s/m.
    pub(super) fn film_damping(&self) -> f64 {
        self.guidance.iter().fold(0.0, |d, f| f.damping.max(d))
    }

    /// The kernel that evaluations use.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }
}
