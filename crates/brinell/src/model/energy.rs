//! Energy that the bodies and springs hold, and the flows that change it.
//!
//! d(energy)/dt = load + drive + film + lever - contact - friction - pocket - pocket_friction - land - support - drag,
//! plus the parametric work of the law `ecl`, whose stiffnesses change under a roller (section 3), which [`parametric_work`]
//! measures over a step.

use super::full::exact::stretch;
use super::{Layout, Model, Workspace};
use crate::defect::{Angles, SIDES, Side};
use crate::lanes::{Column, WIDTH};
use crate::scenario::ModelKind;
use crate::slices::Approach;

/// Energy held, J.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Energy {
    /// Of all moving bodies.
    pub kinetic: f64,
    /// Of raceway contacts.
    pub contacts: f64,
    /// Of pockets and cage lands.
    pub cage: f64,
    /// Of supports.
    pub supports: f64,
    /// In the gravity field.
    pub gravity: f64,
}

impl std::ops::AddAssign for Energy {
    fn add_assign(&mut self, other: Self) {
        let Self { kinetic, contacts, cage, supports, gravity } = other;
        self.kinetic += kinetic;
        self.contacts += contacts;
        self.cage += cage;
        self.supports += supports;
        self.gravity += gravity;
    }
}

impl Energy {
    /// All of it.
    pub fn total(&self) -> f64 {
        self.kinetic + self.contacts + self.cage + self.supports + self.gravity
    }

    /// The sum of their sizes: what round-off is a share of.
    pub(crate) fn size(&self) -> f64 {
        [self.kinetic, self.contacts, self.cage, self.supports, self.gravity].iter().map(|e| e.abs()).sum()
    }

    /// Energy of the state `y` at `t`; `ws` must hold the evaluation at that state.
    pub fn of(model: &Model, t: f64, y: &[f64], ws: &Workspace) -> Self {
        let l = &model.layout;
        let (q, v) = y.split_at(l.dof());
        let m = &model.inertia;
        let mut e = Self::default();
        let square = |u: &[f64]| u[0] * u[0] + u[1] * u[1];
        let along = |u: &[f64]| model.gravity[0] * u[0] + model.gravity[1] * u[1];
        for (at, mass, support) in
            [(l.inner(), m.inner_ring, model.inner_support), (l.outer(), m.outer_ring, model.acting_outer_support())]
        {
            e.kinetic += 0.5 * mass * square(&v[at..]);
            e.supports += 0.5 * support.stiffness * square(&q[at..]);
            e.gravity -= mass * along(&q[at..]);
        }
        let angles = |slot: usize, side: Side| Angles {
            orbit: q[l.theta() + slot] + ws.contacts[side as usize].lean(slot),
            spin: q[l.phi() + slot],
            ring: model.rotation.at(t).1,
        };
        if model.kind == ModelKind::Lumped {
            e.contacts = (0..l.rollers()).map(|slot| super::lumped::contact_energy(model, t, slot, ws)).sum();
            return e;
        }
        let g = &model.geometry;
        if let Some(tilt) = &model.tilt {
            let rings = [(l.inner_tilt(), &tilt.inner), (l.outer_tilt(), &tilt.outer)];
            for (at, ring) in rings {
                e.kinetic += 0.5 * ring.inertia * square(&v[at..]);
                e.supports += 0.5 * ring.support.stiffness * square(&q[at..]);
            }
            let rates = &v[l.beta()..][..l.rollers()];
            e.kinetic += 0.5 * tilt.roller_inertia * rates.iter().map(|b| b * b).sum::<f64>();
        }
        for slot in 0..l.rollers() {
            let arm = g.pitch_radius + q[l.r() + slot];
            let (dr, dtheta, dphi) = (v[l.r() + slot], v[l.theta() + slot], v[l.phi() + slot]);
            e.kinetic += 0.5 * m.roller * (dr * dr + (arm * dtheta).powi(2)) + 0.5 * m.roller_spin * dphi * dphi;
            e.gravity -= m.roller * arm * along(&[ws.cos[slot], ws.sin[slot]]);
            for side in SIDES {
                let at = ws.contacts[side as usize].approach(slot);
                e.contacts += held(model, (slot, side), &at, &angles(slot, side));
            }
            if model.exact {
                e.cage += model.pocket.energy(stretch(model, slot, q));
                continue;
            }
            let xc = &q[l.cage(l.row(slot))..];
            let s = g.pitch_radius * (xc[2] + model.pocket_angle[slot] - q[l.theta() + slot]) + ws.cos[slot] * xc[1]
                - ws.sin[slot] * xc[0];
            e.cage += model.pocket.energy(s);
        }
        for row in 0..l.rows {
            let at = l.cage(row);
            e.kinetic += 0.5 * m.cage * square(&v[at..]) + 0.5 * m.cage_spin * v[at + 2] * v[at + 2];
            e.gravity -= m.cage * along(&q[at..]);
            let ring = model.land().centre(row, q);
            let offset = [q[at] - ring[0], q[at + 1] - ring[1]];
            e.cage += model.guide.land_energy(offset);
        }
        e
    }
}

/// Elastic energy of a contact, J; its rates do not matter.
fn held(model: &Model, (slot, side): (usize, Side), at: &Approach, angles: &Angles) -> f64 {
    match &model.slices {
        Some(slices) if model.layout.tilts => model.carried(slices, (slot, side), angles, at).energy,
        _ => model.energy_at_rest((slot, side), angles, at.deformation),
    }
}

/// What decides the energy of the contacts at one end of a step.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactState {
    /// Seen from either ring's centre.
    orbit: [Column; 2],
    spin: Column,
    ring: f64,
    deformation: [Column; 2],
    on_damage: [Vec<bool>; 2],
}

impl ContactState {
    pub(crate) fn new(layout: &Layout) -> Self {
        let slots = layout.slots;
        let zeros = || Column::new(slots, 0.0);
        Self {
            orbit: [zeros(), zeros()],
            spin: zeros(),
            ring: 0.0,
            deformation: [zeros(), zeros()],
            on_damage: [vec![false; slots], vec![false; slots]],
        }
    }

    /// Takes over the evaluation in `ws` at (t, y).
    pub(crate) fn store(&mut self, model: &Model, t: f64, y: &[f64], ws: &Workspace) {
        if model.defects.is_empty() || model.has_pushing_law() {
            return;
        }
        let l = &model.layout;
        self.ring = model.rotation.at(t).1;
        match model.kind {
            ModelKind::Full | ModelKind::Tilting => {
                for side in SIDES {
                    let k = side as usize;
                    for slot in 0..l.rollers() {
                        self.orbit[k][slot] = y[l.theta() + slot] + ws.contacts[k].lean(slot);
                    }
                }
                self.spin.copy_from_slice(&y[l.phi()..][..l.slots]);
            }
            ModelKind::Lumped => {
                for orbit in &mut self.orbit {
                    orbit.copy_from_slice(&ws.kinematic_orbit);
                }
                self.spin.fill(ws.kinematic_spin);
            }
        }
        for side in SIDES {
            let k = side as usize;
            self.deformation[k].copy_from_slice(ws.contacts[k].pressed_or_deformed());
            self.on_damage[k].copy_from_slice(&ws.contacts[k].on_damage);
        }
    }

    fn angles(&self, slot: usize, side: Side) -> Angles {
        Angles { orbit: self.orbit[side as usize][slot], spin: self.spin[slot], ring: self.ring }
    }
}

/// Work that the changing stiffness of damaged contacts does from `before` to `after`, J: the change of the elastic
/// energy with the angle at a fixed deformation, the mean of both ends. Jumps at an edge are included.
///
/// Under `half-space` damage pushes back: bodies and drive do that work, and none is parametric.
pub(crate) fn parametric_work(model: &Model, before: &ContactState, after: &ContactState) -> f64 {
    if model.has_pushing_law() {
        return 0.0;
    }
    let mut work = 0.0;
    for side in SIDES {
        let k = side as usize;
        let (from, _) = before.on_damage[k].as_chunks::<WIDTH>();
        let (to, _) = after.on_damage[k].as_chunks::<WIDTH>();
        for (group, (from, to)) in from.iter().zip(to).enumerate() {
            if *from == [false; WIDTH] && *to == [false; WIDTH] {
                continue;
            }
            for lane in 0..WIDTH {
                if from[lane] || to[lane] {
                    let at = (WIDTH * group + lane, side);
                    work += work_at(model, at, (before, after));
                }
            }
        }
    }
    work
}

/// The share of one contact.
fn work_at(model: &Model, (slot, side): (usize, Side), (before, after): (&ContactState, &ContactState)) -> f64 {
    let k = side as usize;
    let (from, to) = (before.angles(slot, side), after.angles(slot, side));
    let change = |state: &ContactState| {
        let deformation = state.deformation[k][slot];
        match model.kind {
            ModelKind::Full | ModelKind::Tilting => {
                let at = |angles: &Angles| model.energy_at_rest((slot, side), angles, deformation);
                at(&to) - at(&from)
            }
            // One contact in series for both sides: counted at the inner one where that is on damage.
            ModelKind::Lumped if side == Side::Outer && (before.on_damage[0][slot] || after.on_damage[0][slot]) => 0.0,
            ModelKind::Lumped => {
                let at = |angles: &Angles| super::lumped::energy_at(model, slot, angles, deformation);
                at(&to) - at(&from)
            }
        }
    };
    0.5 * (change(before) + change(after))
}
