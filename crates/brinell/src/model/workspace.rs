//! What one evaluation of the equations of motion leaves behind: forces of every contact and the flows of energy.

use super::{Layout, Power};

/// Contact of one side, structure of arrays over slots.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Contacts {
    /// delta, m.
    pub approach: Vec<f64>,
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
    /// Orbit, spin and radial offset of each roller in the reference model, where they are not states.
    pub kinematic_orbit: Vec<f64>,
    /// phi of a roller in the reference model, rad.
    pub kinematic_spin: f64,
    /// Flows of energy at this instant, W.
    pub power: Power,
}

impl Workspace {
    /// For one layout.
    pub fn new(layout: &Layout) -> Self {
        let slots = layout.slots;
        let zeros = || vec![0.0; slots];
        Self {
            cos: vec![1.0; slots],
            sin: zeros(),
            contacts: [Contacts::new(slots), Contacts::new(slots)],
            edge_force: zeros(),
            pocket_force: zeros(),
            pocket_friction: zeros(),
            kinematic_orbit: zeros(),
            kinematic_spin: 0.0,
            power: Power::default(),
        }
    }
}
