//! The load along rollers: q(z) of contacts at an instant, and of all loaded contacts at chosen ones.

use crate::channel::Frame;
use crate::defect::{Angles, SIDES, Side};
use crate::model::Model;
use crate::slices::Slices;

/// Reads line loads off frames.
#[derive(Debug, Clone, PartialEq)]
pub struct LineLoad {
    values: Vec<f64>,
}

impl LineLoad {
    /// For contacts in such slices.
    pub fn new(slices: &Slices) -> Self {
        Self { values: vec![0.0; slices.count] }
    }

    /// Line load of each slice of one contact, N/m, with each slice's own damping; empty where contacts have no slices
    /// of their own.
    pub fn of(&mut self, f: &Frame, slot: usize, side: Side) -> &[f64] {
        let Some(slices) = &f.model.slices else {
            return &[];
        };
        let contacts = &f.ws.contacts[side as usize];
        let at = contacts.approach(slot);
        let l = &f.model.layout;
        let orbit = f.y[l.theta() + slot] + contacts.lean(slot);
        let angles = Angles { orbit, spin: f.y[l.phi() + slot], ring: f.model.rotation.at(f.t).1 };
        let at = match contacts.on_damage[slot] {
            true => f.model.shown_in_slices((slot, side), &angles, at),
            false => at,
        };
        slices.line_load(f.model.contact(side), &at, &mut self.values);
        &self.values
    }
}

/// Line loads of every loaded contact at the samples next to chosen instants.
#[derive(Debug, Clone, PartialEq)]
pub struct LineLoads {
    /// Chosen samples, rising.
    samples: Vec<u64>,
    reader: LineLoad,
    /// What was read, in time's order.
    pub rows: Vec<LineLoadRow>,
}

/// One slice of one contact at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineLoadRow {
    /// s.
    pub t: f64,
    /// Row and roller, from 1.
    pub roller: (usize, usize),
    /// Raceway.
    pub side: Side,
    /// Middle of the slice, m.
    pub z: f64,
    /// N/m.
    pub line_load: f64,
}

impl LineLoads {
    /// At `instants` (s) of a run at `sample_rate` (Hz); `None` where contacts have no slices of their own.
    pub fn new(model: &Model, instants: &[f64], sample_rate: f64) -> Option<Self> {
        let mut samples: Vec<u64> = instants.iter().map(|t| (t * sample_rate).round() as u64).collect();
        samples.sort_unstable();
        samples.dedup();
        Some(Self { samples, reader: LineLoad::new(model.slices.as_ref()?), rows: Vec::new() })
    }

    /// Takes one sample instant.
    pub fn take(&mut self, index: u64, f: &Frame) {
        let Some(slices) = &f.model.slices else {
            return;
        };
        if self.samples.binary_search(&index).is_err() {
            return;
        }
        let l = &f.model.layout;
        for row in 0..l.rows {
            for roller in 0..l.rollers_per_row {
                for side in SIDES {
                    let loads = self.reader.of(f, l.slot(row, roller), side);
                    if loads.iter().all(|q| *q == 0.0) {
                        continue;
                    }
                    let of = |(z, line_load): (&f64, &f64)| LineLoadRow {
                        t: f.t,
                        roller: (row + 1, roller + 1),
                        side,
                        z: *z,
                        line_load: *line_load,
                    };
                    self.rows.extend(slices.z.iter().zip(loads).map(of));
                }
            }
        }
    }
}
