//! Energy and momentum of a self.

use super::assembly::{Machine, Mount, Ring, Seated};
use super::motion::{Parts, forces_on_ring};
use crate::model::{Energy, imbalance};

impl Machine {
    /// Energy of the whole at `t` and the state `y`, at which the last evaluation has to have been. The rings that sit on structures count
    /// there.
    pub fn energy(&self, t: f64, y: &[f64], parts: &Parts) -> Energy {
        if self.is_one_bearing() {
            return Energy::of(self.leading(), t, y, &parts.each[0].ws);
        }
        let (q, v) = y.split_at(self.dof());
        let mut whole = Energy::default();
        for (k, (seated, part)) in self.bearings.iter().zip(&parts.each).enumerate() {
            let (model, own) = (&seated.model, parts.state(self, k, y));
            let mut of = Energy::of(model, t, own, &part.ws);
            let (own_q, own_v) = own.split_at(model.layout.dof());
            for (_, ring) in seated.mounts.iter().zip(Seated::rings(model)).filter(|(mount, _)| mount.is_some()) {
                let square = |at: usize| own_v[at].powi(2) + own_v[at + 1].powi(2);
                let Ring { shift, mass, tilt } = ring;
                of.kinetic -= 0.5 * mass * square(shift);
                of.kinetic -= tilt.map_or(0.0, |(at, inertia)| 0.5 * inertia * square(at));
                of.gravity += mass * (model.gravity[0] * own_q[shift] + model.gravity[1] * own_q[shift + 1]);
            }
            of.supports += self.fit(seated, y).map_or(0.0, |fit| fit.energy);
            whole += of;
        }
        let gravity = self.leading().gravity;
        for (structure, &first) in self.structures.iter().zip(&self.firsts) {
            let [kinetic, elastic] = structure.energy((&q[first..], &v[first..]));
            whole.kinetic += kinetic;
            whole.supports += elastic;
            whole.gravity -= (0..2).map(|k| gravity[k] * structure.momentum[k].of(&q[first..])).sum::<f64>();
        }
        whole
    }

    /// The largest force (or torque) that appears from nowhere in any bearing, relative to those at play there
    /// ([`imbalance`](crate::model::imbalance)), or on any structure; `a` are the accelerations at `t` and `y`. `None` where it is not defined.
    pub fn imbalance(&self, (t, y, a): (f64, &[f64], &[f64]), parts: &Parts) -> Option<f64> {
        if self.is_one_bearing() {
            return imbalance(self.leading(), t, y, a, &parts.each[0].ws);
        }
        let of_bearings = self
            .bearings
            .iter()
            .zip(&parts.each)
            .enumerate()
            .map(|(k, (seated, part))| imbalance(&seated.model, t, parts.state(self, k, y), &part.a, &part.ws));
        let of_structures = (0..self.structures.len()).map(|k| Some(self.of_nowhere(k, (t, y, a), parts)));
        of_bearings.chain(of_structures).try_fold(0.0, |worst: f64, of| Some(worst.max(of?)))
    }

    /// Momentum of a structure changes by the forces on it alone.
    fn of_nowhere(&self, k: usize, (t, y, a): (f64, &[f64], &[f64]), parts: &Parts) -> f64 {
        let (all, index) = (y, k);
        let (q, v) = y.split_at(self.dof());
        let structure = &self.structures[k];
        // Of what bends against the ground in ways of its own no sum of forces is known.
        if !structure.is_body {
            return 0.0;
        }
        let (q, v, a) = (self.of_structure(k, q), self.of_structure(k, v), self.of_structure(k, a));
        let (driven, gravity) = (self.driven(t), self.leading().gravity);
        // What a rigid motion feels: no spring between the structure's own parts, and no gyroscopic term.
        let outer = |k: usize| structure.driving(k, driven) - structure.squares[k] * q[k] - structure.dampers[k] * v[k];
        // Of both directions: in one of them there may be no force to speak of.
        let (mut worst, mut most): (f64, f64) = (0.0, 0.0);
        for along in 0..2 {
            let momentum = &structure.momentum[along];
            let (pulled, weight) = (momentum.of_each(outer), momentum.square() * gravity[along]);
            let mut sum = pulled + weight - momentum.of(a);
            let mut scale = momentum.of(a).abs() + weight.abs() + pulled.abs();
            for (seated, part) in self.bearings.iter().zip(&parts.each) {
                if let Some(fit) =
                    self.fit(seated, all).filter(|_| seated.fit.as_ref().is_some_and(|of| of.structure == index))
                {
                    sum += fit.on_seat[along];
                    scale += fit.on_seat[along].abs();
                }
                for (side, mount) in seated.mounts.iter().enumerate() {
                    if !matches!(mount, Some(Mount { structure, .. }) if *structure == k) {
                        continue;
                    }
                    let force = forces_on_ring(&seated.model, side, &part.a)[0][along];
                    sum += force;
                    scale += force.abs();
                }
            }
            worst = worst.max(sum.abs());
            most = most.max(scale);
        }
        if most > 0.0 { worst / most } else { 0.0 }
    }
}
