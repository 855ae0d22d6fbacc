//! Linear momentum: every internal force has its reaction, so the bodies' mass times acceleration adds up to the external forces.

use super::{Model, Workspace};

/// Force that appears from nowhere, relative to the forces at play: |sum m a - external| / (sum of |internal| and |external|).
/// Round-off where Newton's third law holds. `None` where the outer ring's mount takes unknown forces (the lumped model with a fixed
/// outer ring).
pub fn imbalance(model: &Model, t: f64, y: &[f64], a: &[f64], ws: &Workspace) -> Option<f64> {
    if model.outer_ring_is_fixed() {
        return None;
    }
    let l = &model.layout;
    let (q, v) = y.split_at(l.dof());
    let m = &model.inertia;
    let mut left = [0.0; 2];
    let mut scale = 0.0;
    let mut add = |f: [f64; 2]| {
        left[0] += f[0];
        left[1] += f[1];
        scale += f[0].abs() + f[1].abs();
    };
    let (load_in, load_out) = model.load.on_rings(model.load.share(t));
    let rings = [
        (l.inner(), m.inner_ring, model.inner_support, load_in),
        (
            l.outer(),
            m.outer_ring,
            model.acting_outer_support(),
            load_out,
        ),
    ];
    for (at, mass, support, load) in rings {
        add([
            mass * (a[at] - model.gravity[0]),
            mass * (a[at + 1] - model.gravity[1]),
        ]);
        add([support.stiffness * q[at], support.stiffness * q[at + 1]]);
        add([support.damping * v[at], support.damping * v[at + 1]]);
        add([-load[0], -load[1]]);
    }
    if model.kind.moves_every_part() {
        let g = &model.geometry;
        for slot in 0..l.rollers() {
            let (cos, sin) = (ws.cos[slot], ws.sin[slot]);
            let arm = g.pitch_radius + q[l.r() + slot];
            let (dr, dtheta) = (v[l.r() + slot], v[l.theta() + slot]);
            let radial = a[l.r() + slot] - arm * dtheta * dtheta;
            let tangential = arm * a[l.theta() + slot] + 2.0 * dr * dtheta;
            let orbit_speed = g.pitch_radius * dtheta;
            let drag = model.drag * orbit_speed * orbit_speed.abs();
            // Drag and the push of damage's slopes have no reaction on any body.
            let external = drag - ws.edge_force[slot];
            let (radial, tangential) = (m.roller * radial, m.roller * tangential + external);
            add([
                radial * cos - tangential * sin - m.roller * model.gravity[0],
                radial * sin + tangential * cos - m.roller * model.gravity[1],
            ]);
        }
        for row in 0..l.rows {
            let at = l.cage(row);
            add([
                m.cage * (a[at] - model.gravity[0]),
                m.cage * (a[at + 1] - model.gravity[1]),
            ]);
        }
    }
    scale += ws.contacts.iter().flat_map(|c| &c.force).sum::<f64>();
    Some(if scale > 0.0 {
        (left[0].abs() + left[1].abs()) / scale
    } else {
        0.0
    })
}
