//! The bearing in motion: the last turn of the shaft in a bounded number of frames, for an animation.

use super::section::{SectionRow, Sections};
use crate::channel::Frame;
use crate::defect::{Side, wrap};
use crate::model::Model;
use crate::scenario::ModelKind;
use std::f64::consts::TAU;

/// Frames kept, at most.
#[doc(hidden)]
pub const FRAMES: usize = 240;
/// Fewest frames, of bearings with many rollers.
const FEWEST: usize = 60;
/// Rollers of all rows up to which [`FRAMES`] are kept.
const ROLLERS: usize = 64;

/// One roller at one instant. Angles in rad in [-pi, pi), counter-clockwise from +X; forces in N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerState {
    /// Where it is.
    pub orbit: f32,
    /// How far it has turned about itself, as seen from outside the bearing.
    pub spin: f32,
    /// Q_in.
    pub inner_force: f32,
    /// Q_out.
    pub outer_force: f32,
}

/// A ring buffer of frames, the latest of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    rollers: usize,
    rows: usize,
    capacity: usize,
    /// Samples from frame to frame.
    stride: u64,
    seen: u64,
    taken: usize,
    times: Vec<f64>,
    rings: Vec<f32>,
    cages: Vec<f32>,
    states: Vec<RollerState>,
    sections: Option<Sections>,
}

impl Motion {
    /// For a run of `duration` s at `sample_rate` Hz: the frames span a turn of the shaft at its last speed, or its
    /// highest where it ends at rest.
    pub fn new(model: &Model, duration: f64, sample_rate: f64) -> Self {
        let l = &model.layout;
        let capacity = (FRAMES * ROLLERS / l.rollers().max(1)).clamp(FEWEST, FRAMES);
        let last = model.rotation.at(duration).0.abs();
        let speed = if last > 0.0 { last } else { model.rotation.max_speed().abs() };
        let span = if speed > 0.0 { (TAU / speed).min(duration) } else { duration };
        let stride = ((span * sample_rate / capacity as f64).round() as u64).max(1);
        Self::every(model, stride, capacity)
    }

    /// A frame every `stride` samples, the latest `capacity` of them.
    #[doc(hidden)]
    pub fn every(model: &Model, stride: u64, capacity: usize) -> Self {
        let (rollers, rows) = (model.layout.rollers(), model.layout.rows);
        let still = RollerState { orbit: 0.0, spin: 0.0, inner_force: 0.0, outer_force: 0.0 };
        Self {
            rollers,
            rows,
            capacity,
            stride,
            seen: 0,
            taken: 0,
            times: vec![0.0; capacity],
            rings: vec![0.0; capacity],
            cages: vec![0.0; capacity * rows],
            states: vec![still; capacity * rollers],
            sections: Sections::new(model, capacity),
        }
    }

    /// Takes one sample instant.
    pub fn take(&mut self, f: &Frame) {
        self.seen += 1;
        if !(self.seen - 1).is_multiple_of(self.stride) {
            return;
        }
        let at = self.taken % self.capacity;
        self.taken += 1;
        let l = &f.model.layout;
        let ring = f.model.rotation.at(f.t).1;
        self.times[at] = f.t;
        self.rings[at] = wrap(ring) as f32;
        let [inner, outer] = [Side::Inner, Side::Outer].map(|s| &f.ws.contacts[s as usize].force);
        for slot in 0..self.rollers {
            self.states[at * self.rollers + slot] = RollerState {
                orbit: wrap(f.orbits()[slot]) as f32,
                spin: wrap(f.spin(slot)) as f32,
                inner_force: inner[slot] as f32,
                outer_force: outer[slot] as f32,
            };
        }
        for row in 0..self.rows {
            let angle = match f.model.kind {
                ModelKind::Full | ModelKind::Tilting => f.y[l.cage(row) + 2],
                ModelKind::Lumped => f.ws.kinematic_orbit[l.slot(row, 0)] - f.model.pocket_angle[l.slot(row, 0)],
            };
            self.cages[at * self.rows + row] = wrap(angle) as f32;
        }
        if let Some(sections) = &mut self.sections {
            sections.take(at, f);
        }
    }

    /// Frames taken since the start.
    #[doc(hidden)]
    pub fn taken(&self) -> usize {
        self.taken
    }

    /// Frames held.
    pub fn len(&self) -> usize {
        self.taken.min(self.capacity)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.taken == 0
    }

    fn place(&self, frame: usize) -> usize {
        (self.taken - self.len() + frame) % self.capacity
    }

    /// Time of a frame, s; the first is the earliest.
    pub fn time(&self, frame: usize) -> f64 {
        self.times[self.place(frame)]
    }

    /// Angle of the inner ring in a frame, rad.
    pub fn ring(&self, frame: usize) -> f32 {
        self.rings[self.place(frame)]
    }

    /// Angle by which each row's cage has turned in a frame, rad.
    pub fn cages(&self, frame: usize) -> &[f32] {
        let at = self.place(frame);
        &self.cages[at * self.rows..(at + 1) * self.rows]
    }

    /// Slopes of the inner and the outer ring's axis in the section's plane, rad; `None` where nothing tilts.
    pub fn ring_tilts(&self, frame: usize) -> Option<[f32; 2]> {
        Some(self.sections.as_ref()?.rings(self.place(frame)))
    }

    /// A row of the section of a frame; `None` where nothing tilts.
    pub fn section_row(&self, frame: usize, row: usize) -> Option<SectionRow<'_>> {
        Some(self.sections.as_ref()?.row(self.place(frame), row))
    }

    /// The rollers of a frame, by slot.
    pub fn rollers(&self, frame: usize) -> &[RollerState] {
        let at = self.place(frame);
        &self.states[at * self.rollers..(at + 1) * self.rollers]
    }
}
