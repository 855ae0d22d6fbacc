//! Momentum, linear and angular: every internal force has its reaction, so the bodies' mass times acceleration adds up to the external
//! forces; in exact geometry the change of angular momentum adds up to their torques (section 18), and where rings tilt the same holds for
//! the moments Z x force about the bearing's middle.

use super::{Model, Tilt, Workspace};

/// Force that appears from nowhere, relative to the forces at play: |sum m a - external| / (sum of |internal| and
/// |external|). Round-off where Newton's third law holds. `None` where the outer ring's mount takes unknown forces (the
/// lumped model with a fixed outer ring). In exact geometry the larger one of that and the same of torques, and where rings tilt of moments.
pub fn imbalance(model: &Model, t: f64, y: &[f64], a: &[f64], ws: &Workspace) -> Option<f64> {
    if model.outer_ring_is_fixed() {
        return None;
    }
    let l = &model.layout;
    let (q, v) = y.split_at(l.dof());
    let m = &model.inertia;
    let mut sum = Sum::default();
    let mut add = |f| sum.add(f);
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [
        (l.inner(), m.inner_ring, model.inner_support, load_in),
        (l.outer(), m.outer_ring, model.acting_outer_support(), load_out),
    ];
    for (at, mass, support, load) in rings {
        add([mass * (a[at] - model.gravity[0]), mass * (a[at + 1] - model.gravity[1])]);
        add([support.stiffness * q[at], support.stiffness * q[at + 1]]);
        add([support.damping * v[at], support.damping * v[at + 1]]);
        add([-load[0], -load[1]]);
    }
    if model.kind.moves_every_part() {
        for slot in 0..l.rollers() {
            let (cos, sin) = (ws.cos[slot], ws.sin[slot]);
            let [radial, tangential] = internal_force(model, slot, (q, v, a), ws);
            add([radial * cos - tangential * sin, radial * sin + tangential * cos]);
        }
        for row in 0..l.rows {
            let at = l.cage(row);
            add([m.cage * (a[at] - model.gravity[0]), m.cage * (a[at + 1] - model.gravity[1])]);
        }
    }
    add(ws.external.force.map(|f| -f));
    let pressed = ws.contacts.iter().flat_map(|c| &c.force).sum::<f64>();
    let mut forces = sum.relative(pressed);
    // Where rings tilt their forces act at the rows' middles: a torque of second order in small slopes has no body to turn.
    if model.exact && model.tilt.is_none() {
        forces = forces.max(turning(model, t, (q, v, a), (ws, pressed)));
    }
    Some(match &model.tilt {
        None => forces,
        Some(tilt) => forces.max(moments(model, tilt, t, (q, v, a), ws)),
    })
}

/// Vectors that should add up to nothing.
#[derive(Default)]
struct Sum {
    left: [f64; 2],
    scale: f64,
}

impl Sum {
    #[inline(always)]
    fn add(&mut self, f: [f64; 2]) {
        self.left[0] += f[0];
        self.left[1] += f[1];
        self.scale += f[0].abs() + f[1].abs();
    }

    /// What is left of them, relative to their sizes and to `more`.
    fn relative(&self, more: f64) -> f64 {
        let scale = self.scale + more;
        if scale > 0.0 { (self.left[0].abs() + self.left[1].abs()) / scale } else { 0.0 }
    }
}

/// Torque about the bearing's centre that appears from nowhere, relative to those at play: angular momentum of all bodies changes
/// by the torques of loads, supports, gravity, drag, the drive and the housing alone (section 18). All contacts press with `pressed` together, N.
fn turning(model: &Model, t: f64, (q, v, a): (&[f64], &[f64], &[f64]), (ws, pressed): (&Workspace, f64)) -> f64 {
    let (l, m) = (&model.layout, &model.inertia);
    let (mut left, mut scale) = (0.0, 0.0);
    let mut add = |torque: f64, size: f64| {
        left += torque;
        scale += size;
    };
    // A force's torque is as large as its parts: where nothing touches they are all that is at play, and cancel.
    let moment = |x: &[f64], f: [f64; 2]| (x[0] * f[1] - x[1] * f[0], (x[0] * f[1]).abs() + (x[1] * f[0]).abs());
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [
        (l.inner(), m.inner_ring, model.inner_support, load_in),
        (l.outer(), m.outer_ring, model.outer_support, load_out),
    ];
    for (at, mass, support, load) in rings {
        let inertia = |k: usize| mass * (a[at + k] - model.gravity[k]);
        let supports = |k: usize| support.stiffness * q[at + k] + support.damping * v[at + k];
        let parts: [&dyn Fn(usize) -> f64; 3] = [&inertia, &supports, &|k| -load[k]];
        for part in parts {
            let (torque, size) = moment(&q[at..], [part(0), part(1)]);
            add(torque, size);
        }
    }
    for slot in 0..l.rollers() {
        let arm = model.geometry.pitch_radius + q[l.r() + slot];
        let [_, tangential] = internal_force(model, slot, (q, v, a), ws);
        let coriolis = 2.0 * m.roller * arm * v[l.r() + slot] * v[l.theta() + slot];
        add(arm * tangential, (arm * tangential).abs() + coriolis.abs());
        let spun = m.roller_spin * a[l.phi() + slot];
        add(spun, spun.abs());
    }
    for row in 0..l.rows {
        let at = l.cage(row);
        let spun = m.cage_spin * a[at + 2];
        add(spun, spun.abs());
        let (torque, size) = moment(&q[at..], [0, 1].map(|k: usize| m.cage * (a[at + k] - model.gravity[k])));
        add(torque, size);
    }
    // Of the drive and of the housing, and of the user's own forces.
    ws.torques.into_iter().chain([ws.external.torque]).for_each(|torque| add(-torque, torque.abs()));
    let scale = scale + pressed * model.geometry.pitch_radius;
    if scale > 0.0 { left.abs() / scale } else { 0.0 }
}

/// Moments Z x force that appear from nowhere, relative to those at play: the only check that sees a wrong lever of the
/// cages' guidance.
fn moments(model: &Model, tilt: &Tilt, t: f64, (q, v, a): (&[f64], &[f64], &[f64]), ws: &Workspace) -> f64 {
    let l = &model.layout;
    let m = &model.inertia;
    let mut sum = Sum::default();
    let mut add = |f| sum.add(f);
    let w = model.rotation.at(t).0;
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [(l.inner_tilt(), &tilt.inner, load_in), (l.outer_tilt(), &tilt.outer, load_out)];
    for (at, ring, load) in rings {
        let spin = ring.polar_inertia * w;
        add([ring.inertia * a[at], ring.inertia * a[at + 1]]);
        add([spin * v[at + 1], -spin * v[at]]);
        add([0, 1].map(|k| ring.support.stiffness * q[at + k]));
        add([0, 1].map(|k| ring.support.damping * v[at + k]));
        add(load.map(|f| -tilt.load_offset * f));
    }
    for slot in 0..l.rollers() {
        let (cos, sin) = (ws.cos[slot], ws.sin[slot]);
        let [radial, tangential] = internal_force(model, slot, (q, v, a), ws);
        let [mut radial, mut tangential] = [radial, tangential].map(|force| tilt.levers[slot] * force);
        if model.exact {
            // T acts along n of either contact on its ring, and on the roller's tilt, which has no direction of its own.
            for (contacts, sign) in ws.contacts.iter().zip([1.0, -1.0]) {
                radial += sign * contacts.moment[slot] * contacts.normal[0][slot];
                tangential += sign * contacts.moment[slot] * contacts.normal[1][slot];
            }
        } else {
            radial += tilt.roller_inertia * a[l.beta() + slot];
        }
        add([radial * cos - tangential * sin, radial * sin + tangential * cos]);
    }
    for row in 0..l.rows {
        let at = l.cage(row);
        add([0, 1].map(|k| tilt.rows[row] * m.cage * (a[at + k] - model.gravity[k])));
    }
    add(ws.external.moment.map(|m| -m));
    let carried = ws.contacts.iter().flat_map(|c| c.moment.iter());
    sum.relative(carried.map(|t| t.abs()).sum())
}

/// Force of the raceways and the pocket on a roller along e_r and e_t, from its motion, N.
#[inline(always)]
fn internal_force(model: &Model, slot: usize, (q, v, a): (&[f64], &[f64], &[f64]), ws: &Workspace) -> [f64; 2] {
    let (l, mass) = (&model.layout, model.inertia.roller);
    let (cos, sin) = (ws.cos[slot], ws.sin[slot]);
    let pitch = model.geometry.pitch_radius;
    let arm = pitch + q[l.r() + slot];
    let (dr, dtheta) = (v[l.r() + slot], v[l.theta() + slot]);
    let orbit_speed = pitch * dtheta;
    let drag = model.drag * orbit_speed * orbit_speed.abs();
    let [gx, gy] = model.gravity;
    let radial = a[l.r() + slot] - arm * dtheta * dtheta - (cos * gx + sin * gy);
    let tangential = arm * a[l.theta() + slot] + 2.0 * dr * dtheta - (cos * gy - sin * gx);
    // Drag has no reaction on any body.
    [mass * radial, mass * tangential + drag]
}
