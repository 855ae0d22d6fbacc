//! A machine as the system that the solver integrates.

use super::assembly::{Machine, Mount, Ring, Seated};
use crate::accuracy::{self, settings_together};
use crate::channel::Frame;
use crate::lanes::Column;
use crate::model::{Model, Power, Workspace};
use crate::scenario::Accuracy;
use crate::solver::{Settings, System};
use std::borrow::BorrowMut;

/// One bearing of the machine at the last evaluation.
#[derive(Debug, Clone)]
pub struct Evaluated {
    /// Its contacts and flows.
    pub ws: Workspace,
    /// Its own state, positions and rates; of a bearing on its own the machine's is that.
    y: Column,
    /// Its accelerations, those of rings as if they were free with their mass.
    pub(super) a: Column,
}

/// What an evaluation of a machine's equations of motion leaves behind; made once, used for a whole run.
#[derive(Debug, Clone)]
pub struct Parts {
    /// Of each bearing.
    pub each: Vec<Evaluated>,
    /// Flows of energy of the whole, W.
    pub power: Power,
}

impl Parts {
    /// For one machine.
    pub fn new(machine: &Machine) -> Self {
        let part = |seated: &Seated| {
            let dof = seated.model.layout.dof();
            Evaluated { ws: Workspace::new(&seated.model), y: Column::new(2 * dof, 0.0), a: Column::new(dof, 0.0) }
        };
        Self { each: machine.bearings.iter().map(part).collect(), power: Power::default() }
    }

    /// The state of a bearing at the last evaluation, which was at `y`.
    pub fn state<'a>(&'a self, machine: &Machine, k: usize, y: &'a [f64]) -> &'a [f64] {
        if machine.is_one_bearing() { y } else { &self.each[k].y }
    }
}

impl Machine {
    /// Settings of the solver.
    pub fn settings(&self, accuracy: Accuracy) -> Settings {
        if self.is_one_bearing() {
            return accuracy::settings(self.leading(), accuracy);
        }
        let gravity = self.leading().gravity;
        let pulled = self.structures.iter().map(|structure| structure.pulled(gravity));
        let each = pulled.map(|[x, y]| x.hypot(y)).sum::<f64>() / self.bearings.len() as f64;
        let bearings: Vec<_> = self.bearings.iter().map(|seated| (seated.first, &seated.model, each)).collect();
        let mut settings = settings_together(&bearings, self.coordinates(), self.dof(), accuracy);
        for seated in &self.bearings {
            let rings = Seated::rings(&seated.model);
            // What follows counts where it follows.
            for (_, ring) in seated.mounts.iter().zip(rings).filter(|(mount, _)| mount.is_some()) {
                for at in [Some(ring.shift), ring.tilt.map(|(at, _)| at)].into_iter().flatten() {
                    settings.mass[seated.first + at..][..2].fill(0.0);
                }
            }
        }
        settings
    }

    /// Second time derivatives `a` of the positions at the state `y` and `t`; forces and flows stay in `parts`.
    #[inline]
    pub fn accelerations(&self, t: f64, y: &[f64], a: &mut [f64], parts: &mut Parts) {
        if self.is_one_bearing() {
            let ws = &mut parts.each[0].ws;
            self.leading().accelerations(t, y, a, ws);
            parts.power = ws.power;
        } else {
            parts.power = self.together(t, y, a, &mut parts.each);
        }
    }

    /// The same where anything is coupled, with the flows of the whole.
    fn together(&self, t: f64, y: &[f64], a: &mut [f64], parts: &mut [Evaluated]) -> Power {
        let (q, v) = y.split_at(self.dof());
        let (w, gravity) = (self.leading().rotation.at(t).0, self.leading().gravity);
        let driven = self.driven(t);
        let mut power = Power::default();
        for (structure, &first) in self.structures.iter().zip(&self.firsts) {
            let (f, rates) = (&mut a[first..][..structure.size()], &v[first..]);
            f.iter_mut().enumerate().for_each(|(k, f)| *f = structure.driving(k, driven));
            power.load += f.iter().zip(rates).map(|(f, v)| f * v).sum::<f64>();
            (0..2).for_each(|k| structure.momentum[k].push(gravity[k], f));
            power.support += structure.hold((&q[first..], rates), w, f);
        }
        for (seated, part) in self.bearings.iter().zip(parts) {
            let own = seated.model.layout.dof();
            part.y[..own].copy_from_slice(&q[seated.range()]);
            part.y[own..].copy_from_slice(&v[seated.range()]);
            seated.model.accelerations(t, &part.y, &mut part.a, &mut part.ws);
            a[seated.range()].copy_from_slice(&part.a);
            power += part.ws.power;
            if let (Some(fit), Some(mount)) = (self.fit(seated, y), &seated.fit) {
                let mass = seated.model.inertia.outer_ring;
                (0..2).for_each(|k| a[fit.ring + k] += fit.on_ring[k] / mass);
                let f = &mut a[self.firsts[mount.structure]..];
                (0..2).for_each(|k| mount.seat.shift[k].push(fit.on_seat[k], f));
                power.support += fit.loss;
            }
            for (side, mount) in seated.mounts.iter().enumerate() {
                let Some(Mount { structure, seat, .. }) = mount else { continue };
                let f = &mut a[self.firsts[*structure]..];
                let forces = forces_on_ring(&seated.model, side, &part.a);
                (0..2).for_each(|k| seat.shift[k].push(forces[0][k], f));
                if seated.model.tilt.is_some() {
                    (0..2).for_each(|k| seat.tilt[k].push(forces[1][k], f));
                }
            }
        }
        self.follow(a);
        power
    }

    /// Stability limit of the step at the last evaluation, s.
    pub fn longest_step(&self, parts: &Parts) -> f64 {
        let of = |(seated, part): (&Seated, &Evaluated)| seated.model.longest_step(&part.ws);
        self.bearings.iter().zip(&parts.each).map(of).fold(self.longest, f64::min)
    }

    /// A bearing at the last evaluation, which was at `t` and the state `y` and gave the accelerations `a`.
    pub fn frame<'a>(&'a self, k: usize, (t, y, a): (f64, &'a [f64], &'a [f64]), parts: &'a Parts) -> Frame<'a> {
        let Seated { model, .. } = &self.bearings[k];
        Frame { model, t, y: parts.state(self, k, y), a: &a[self.bearings[k].range()], ws: &parts.each[k].ws }
    }
}

/// A machine and what its evaluations leave, its own or somebody's.
#[derive(Debug)]
pub struct MachineMotion<'a, P = Parts> {
    /// The machine.
    pub machine: &'a Machine,
    /// What the last evaluation left.
    pub parts: P,
}

impl<'a> MachineMotion<'a> {
    /// With fresh workspaces.
    pub fn new(machine: &'a Machine) -> Self {
        Self { parts: Parts::new(machine), machine }
    }
}

impl<P: BorrowMut<Parts>> System for MachineMotion<'_, P> {
    type Flow = Power;

    fn size(&self) -> usize {
        2 * self.machine.dof()
    }

    #[inline]
    fn accelerations(&mut self, t: f64, y: &[f64], a: &mut [f64]) {
        self.machine.accelerations(t, y, a, self.parts.borrow_mut());
    }

    fn stable_step(&self) -> f64 {
        self.machine.longest_step(self.parts.borrow())
    }

    fn flow(&self) -> Power {
        self.parts.borrow().power
    }
}

/// Force (N) and, where it tilts, moment (N m) on the inner (0) or outer (1) ring but for its weight, from the accelerations that it would have
/// if it were free.
#[inline]
pub(super) fn forces_on_ring(model: &Model, side: usize, a: &[f64]) -> [[f64; 2]; 2] {
    let Ring { shift, mass, tilt } = Seated::rings(model)[side];
    let force = [0, 1].map(|k: usize| mass * (a[shift + k] - model.gravity[k]));
    let moment = tilt.map_or([0.0; 2], |(at, inertia)| [0, 1].map(|k: usize| inertia * a[at + k]));
    [force, moment]
}
