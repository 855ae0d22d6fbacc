//! A machine with linear bearings: natural frequencies, critical speeds.

use super::assembly::{Machine, Mount};
use super::structure::Row;
use brinell_shaft::{Equations, Port};

impl Machine {
    /// Equations of the shaft, of housings and of outer rings on supports of their own, in their modes, and of each bearing the place that
    /// its stiffness and damping act at: the inner ring's displacement less the outer one's. Bearings hold no tilt here, and housings of modes
    /// of their own, which differ from plane to plane, stand still.
    pub fn linearised(&self) -> (Equations, Vec<Port>) {
        // In a plane a structure has half of its coordinates, and a ring on its own support one.
        let mut starts = Vec::new();
        let mut size = 0;
        for structure in &self.structures {
            starts.push(size);
            size += if structure.is_body { structure.size() / 2 } else { 0 };
        }
        let alone: Vec<Option<usize>> = (self.bearings.iter())
            .map(|seated| {
                let is_alone = seated.mounts[1].is_none();
                size += usize::from(is_alone);
                is_alone.then_some(size - 1)
            })
            .collect();
        let mut equations = Equations::new(size);
        equations.mass.fill_with_identity();
        for (structure, &start) in self.structures.iter().zip(&starts).filter(|(structure, _)| structure.is_body) {
            let half = structure.size() / 2;
            for k in 0..half {
                // Of a rigid body shifts come before tilts, of a shaft X before Y: either way the first plane's are those of `in_first_plane`.
                let own = structure.in_first_plane(k);
                equations.stiffness[(start + k, start + k)] = structure.squares[own];
                equations.damping[(start + k, start + k)] = structure.dampers[own];
            }
            for (k, row) in structure.gyroscopic_rows().enumerate() {
                row.iter().enumerate().for_each(|(j, g)| equations.gyroscopic[(start + k, start + j)] = *g);
            }
        }
        let mut ports = Vec::new();
        for (seated, own) in self.bearings.iter().zip(&alone) {
            let mut port = Port::zeros(size);
            let add = |port: &mut Port, mount: &Mount, sign: f64| {
                let structure = &self.structures[mount.structure];
                let row: &Row = &mount.seat.shift[0];
                if !structure.is_body {
                    return;
                }
                for k in 0..structure.size() / 2 {
                    port.0[starts[mount.structure] + k] += sign * row.share(structure.in_first_plane(k));
                }
            };
            seated.mounts[0].iter().for_each(|mount| add(&mut port, mount, 1.0));
            seated.mounts[1].iter().for_each(|mount| add(&mut port, mount, -1.0));
            if let Some(k) = *own {
                let (mass, support) = (seated.model.inertia.outer_ring, seated.model.outer_support);
                let mut held = Port::zeros(size);
                held.0[k] = mass.sqrt().recip();
                port.0 -= &held.0;
                seated.fit.iter().for_each(|mount| add(&mut held, mount, -1.0));
                let place = &held.0 * held.0.transpose();
                equations.stiffness += support.stiffness * &place;
                equations.damping += support.damping * &place;
            }
            if let Some(mount) = &seated.mounts[0] {
                let (mut seat, support) = (Port::zeros(size), seated.model.inner_support);
                add(&mut seat, mount, 1.0);
                let place = &seat.0 * seat.0.transpose();
                equations.stiffness += support.stiffness * &place;
                equations.damping += support.damping * &place;
            }
            ports.push(port);
        }
        (equations, ports)
    }
}
