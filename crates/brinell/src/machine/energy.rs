//! Energy and momentum of a machine.

use super::assembly::{Mount, Seated};
use super::motion::{MachineMotion, forces_on_ring};
use crate::model::{Energy, imbalance};

impl MachineMotion<'_> {
    /// Energy of the whole at `t` and the state `y`, at which the last evaluation has to have been. The rings that sit on structures count
    /// there.
    pub fn energy(&self, t: f64, y: &[f64]) -> Energy {
        let machine = self.machine;
        let (q, v) = y.split_at(machine.dof());
        let mut whole = Energy::default();
        for (seated, part) in machine.bearings.iter().zip(&self.parts) {
            let model = &seated.model;
            let mut of = Energy::of(model, t, &part.y, &part.ws);
            let (own_q, own_v) = part.y.split_at(model.layout.dof());
            for side in (0..2).filter(|side| seated.mounts[*side].is_some()) {
                let (shift, tilt) = Seated::rings(&model.layout)[side];
                let mass = [model.inertia.inner_ring, model.inertia.outer_ring][side];
                of.kinetic -= 0.5 * mass * (own_v[shift].powi(2) + own_v[shift + 1].powi(2));
                of.gravity += mass * (model.gravity[0] * own_q[shift] + model.gravity[1] * own_q[shift + 1]);
                if let (Some(tilting), Some(at)) = (&model.tilt, tilt) {
                    let inertia = [tilting.inner.inertia, tilting.outer.inertia][side];
                    of.kinetic -= 0.5 * inertia * (own_v[at].powi(2) + own_v[at + 1].powi(2));
                }
            }
            whole.kinetic += of.kinetic;
            whole.contacts += of.contacts;
            whole.cage += of.cage;
            whole.supports += of.supports;
            whole.gravity += of.gravity;
        }
        for (structure, &first) in machine.structures.iter().zip(&machine.firsts) {
            let [kinetic, elastic] = structure.energy((&q[first..], &v[first..]));
            whole.kinetic += kinetic;
            whole.supports += elastic;
            whole.gravity -= (0..2).map(|k| machine.gravity[k] * structure.momentum[k].of(&q[first..])).sum::<f64>();
        }
        whole
    }

    /// The largest force (or torque) that appears from nowhere in any bearing, relative to those at play there ([`imbalance`]), or on any
    /// structure; `a` are the accelerations at `t` and `y`.
    pub fn imbalance(&self, t: f64, y: &[f64], a: &[f64]) -> f64 {
        let machine = self.machine;
        let of_bearings = machine
            .bearings
            .iter()
            .zip(&self.parts)
            .filter_map(|(seated, part)| imbalance(&seated.model, t, &part.y, &part.a, &part.ws));
        let of_structures = (0..machine.structures.len()).map(|k| self.of_structure(k, t, y, a));
        of_bearings.chain(of_structures).fold(0.0, f64::max)
    }

    /// Momentum of a structure changes by the forces on it alone.
    fn of_structure(&self, k: usize, t: f64, y: &[f64], a: &[f64]) -> f64 {
        let machine = self.machine;
        let (q, v) = y.split_at(machine.dof());
        let structure = &machine.structures[k];
        let (q, v, a) = (machine.of_structure(k, q), machine.of_structure(k, v), machine.of_structure(k, a));
        let mut driven = vec![0.0; machine.dof()];
        machine.drive(t, &mut driven);
        let mut worst: f64 = 0.0;
        for along in 0..2 {
            let momentum = &structure.momentum[along];
            let mass = momentum.square();
            // What a rigid motion feels: no spring between the structure's own parts, and no gyroscopic term.
            let pulls = machine.of_structure(k, &driven);
            let outer: Vec<f64> = (0..structure.size())
                .map(|k| pulls[k] - structure.squares[k] * q[k] - structure.dampers[k] * v[k])
                .collect();
            let mut sum = momentum.of(&outer) + mass * machine.gravity[along] - momentum.of(a);
            let mut scale = momentum.of(a).abs() + mass * machine.gravity[along].abs() + momentum.of(&outer).abs();
            for (seated, part) in machine.bearings.iter().zip(&self.parts) {
                for (side, mount) in seated.mounts.iter().enumerate() {
                    if !matches!(mount, Some(Mount { structure, .. }) if *structure == k) {
                        continue;
                    }
                    let force = forces_on_ring(&seated.model, side, &part.a)[0][along];
                    sum += force;
                    scale += force.abs();
                }
            }
            worst = worst.max(if scale > 0.0 { sum.abs() / scale } else { 0.0 });
        }
        worst
    }
}
