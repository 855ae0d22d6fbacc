//! A machine as the system that the solver integrates.

use super::assembly::{Machine, Mount, Seated};
use super::structure::Structure;
use crate::accuracy::settings_together;
use crate::lanes::Column;
use crate::model::{Model, Power, Workspace};
use crate::scenario::Accuracy;
use crate::solver::{DAMPED_CONTACT, Settings, System};

/// One bearing of the machine at the last evaluation.
#[derive(Debug, Clone)]
pub struct Part {
    /// Its contacts and flows.
    pub ws: Workspace,
    /// Its own state, positions and rates.
    pub y: Column,
    /// Its accelerations, those of rings as if they were free with their mass.
    pub a: Column,
}

impl Part {
    fn new(model: &Model) -> Self {
        let dof = model.layout.dof();
        Self { ws: Workspace::new(model), y: Column::new(2 * dof, 0.0), a: Column::new(dof, 0.0) }
    }
}

/// A machine and what its last evaluation left.
#[derive(Debug)]
pub struct MachineMotion<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// Its bearings.
    pub parts: Vec<Part>,
    /// Flows of energy of the whole.
    pub power: Power,
    /// Longest step that any structure allows, s.
    longest: f64,
}

impl Machine {
    /// Settings of the solver.
    pub fn settings(&self, accuracy: Accuracy) -> Settings {
        let total: f64 = self
            .structures
            .iter()
            .map(|structure| {
                let [x, y] = structure.pulled(self.gravity);
                x.hypot(y)
            })
            .sum();
        let each = total / self.bearings.len() as f64;
        let bearings: Vec<_> = self.bearings.iter().map(|seated| (seated.first, &seated.model, each)).collect();
        let first = self.firsts.first().copied().unwrap_or(self.first_point);
        let mut settings = settings_together(&bearings, first..self.first_point, self.dof(), accuracy);
        for seated in &self.bearings {
            let rings = Seated::rings(&seated.model.layout);
            // What follows counts where it follows.
            for (_, (shift, tilt)) in seated.mounts.iter().zip(rings).filter(|(mount, _)| mount.is_some()) {
                for at in [Some(shift), tilt].into_iter().flatten() {
                    settings.mass[seated.first + at..][..2].fill(0.0);
                }
            }
        }
        settings
    }
}

impl<'a> MachineMotion<'a> {
    /// With fresh workspaces.
    pub fn new(machine: &'a Machine) -> Self {
        let fastest = machine.rotation.max_speed();
        let limits = machine.structures.iter().map(|structure| longest_step(structure, fastest));
        Self {
            parts: machine.bearings.iter().map(|seated| Part::new(&seated.model)).collect(),
            power: Power::default(),
            longest: limits.fold(f64::INFINITY, f64::min),
            machine,
        }
    }
}

/// Longest step in which every motion of a structure decays at speeds up to `fastest`, rad/s.
fn longest_step(structure: &Structure, fastest: f64) -> f64 {
    let turning = fastest * structure.largest_gyroscopic();
    let of = structure.squares.iter().zip(&structure.dampers).map(|(square, damper)| {
        let rate = square.sqrt() + turning;
        DAMPED_CONTACT.stability_limit(rate, 0.5 * damper / rate.max(f64::MIN_POSITIVE))
    });
    of.fold(f64::INFINITY, f64::min)
}

impl System for MachineMotion<'_> {
    type Flow = Power;

    fn size(&self) -> usize {
        2 * self.machine.dof()
    }

    fn accelerations(&mut self, t: f64, y: &[f64], a: &mut [f64]) {
        let machine = self.machine;
        let (q, v) = y.split_at(machine.dof());
        let w = machine.rotation.at(t).0;
        let mut power = Power::default();
        machine.drive(t, a);
        for (structure, &first) in machine.structures.iter().zip(&machine.firsts) {
            let (f, rates) = (&mut a[first..][..structure.size()], &v[first..]);
            power.load += f.iter().zip(rates).map(|(f, v)| f * v).sum::<f64>();
            (0..2).for_each(|k| structure.momentum[k].push(machine.gravity[k], f));
            power.support += structure.hold((&q[first..], rates), w, f);
        }
        for (seated, part) in machine.bearings.iter().zip(&mut self.parts) {
            let own = seated.model.layout.dof();
            part.y[..own].copy_from_slice(&q[seated.range()]);
            part.y[own..].copy_from_slice(&v[seated.range()]);
            seated.model.accelerations(t, &part.y, &mut part.a, &mut part.ws);
            a[seated.range()].copy_from_slice(&part.a);
            power += part.ws.power;
            for (side, mount) in seated.mounts.iter().enumerate() {
                let Some(Mount { structure, seat }) = mount else { continue };
                let f = &mut a[machine.firsts[*structure]..];
                let forces = forces_on_ring(&seated.model, side, &part.a);
                (0..2).for_each(|k| seat.shift[k].push(forces[0][k], f));
                if seated.model.tilt.is_some() {
                    (0..2).for_each(|k| seat.tilt[k].push(forces[1][k], f));
                }
            }
        }
        machine.follow(a);
        self.power = power;
    }

    fn stable_step(&self) -> f64 {
        let of = |(seated, part): (&Seated, &Part)| seated.model.longest_step(&part.ws);
        self.machine.bearings.iter().zip(&self.parts).map(of).fold(self.longest, f64::min)
    }

    fn flow(&self) -> Power {
        self.power
    }
}

/// Force (N) and, where it tilts, moment (N m) on the inner (0) or outer (1) ring but for its weight, from the accelerations that it would have
/// if it were free.
#[inline]
pub(super) fn forces_on_ring(model: &Model, side: usize, a: &[f64]) -> [[f64; 2]; 2] {
    let (shift, tilt) = Seated::rings(&model.layout)[side];
    let mass = [model.inertia.inner_ring, model.inertia.outer_ring][side];
    let force = [0, 1].map(|k: usize| mass * (a[shift + k] - model.gravity[k]));
    let moment = match (&model.tilt, tilt) {
        (Some(of), Some(at)) => {
            let inertia = [of.inner.inertia, of.outer.inertia][side];
            [0, 1].map(|k: usize| inertia * a[at + k])
        }
        _ => [0.0; 2],
    };
    [force, moment]
}
