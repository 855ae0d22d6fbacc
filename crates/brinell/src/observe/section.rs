//! A tilting bearing seen from the side: a section along its axis, through the damage or through the middle of the load
//! zone.

use super::line_load::LineLoad;
use crate::channel::Frame;
use crate::defect::SIDES;
use crate::model::Model;
use crate::scenario::Surface;

/// Line loads kept across a roller, at most.
#[doc(hidden)]
pub const STRIPS: usize = 64;

/// Where the section is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// At an angle, rad.
    Still(f64),
    /// At an angle of the inner ring, rad.
    OnInner(f64),
    /// Through a roller: its slot.
    Through(usize),
}

/// One row of a section at one instant: its roller nearest the section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionRow<'a> {
    /// Tilt beta of its roller nearest the section, rad.
    pub tilt: f32,
    /// Line loads at the inner and the outer raceway from -L/2 to L/2, N/m, at even steps.
    pub line_loads: [&'a [f32]; 2],
}

/// Sections of a bounded number of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Sections {
    place: Place,
    rows: usize,
    strips: usize,
    /// Slopes of the rings, frame by frame.
    rings: Vec<[f32; 2]>,
    /// Tilts of the rollers, row by row of each frame.
    tilts: Vec<f32>,
    /// Line loads, likewise: inner, then outer.
    loads: Vec<f32>,
    reader: LineLoad,
}

impl Sections {
    /// For `frames` frames of a model that tilts; `None` for others.
    pub(super) fn new(model: &Model, frames: usize) -> Option<Self> {
        let (slices, l) = (model.slices.as_ref()?, &model.layout);
        model.tilt.as_ref()?;
        let [x, y] = model.load.full;
        let place = model.defects.first().map_or(Place::Still(y.atan2(x)), |d| {
            let (first, last) = d.shape.arc();
            let middle = d.center + 0.5 * (first + last) / d.radius;
            match d.surface {
                Surface::OuterRaceway => Place::Still(middle),
                Surface::InnerRaceway => Place::OnInner(middle),
                Surface::Roller(k) => Place::Through(l.slot(d.row, k)),
            }
        });
        let strips = slices.count.min(STRIPS);
        Some(Self {
            place,
            rows: l.rows,
            strips,
            rings: vec![[0.0; 2]; frames],
            tilts: vec![0.0; frames * l.rows],
            loads: vec![0.0; frames * l.rows * 2 * strips],
            reader: LineLoad::new(slices),
        })
    }

    /// Takes an instant as frame `at` of the ring buffer.
    pub(super) fn take(&mut self, at: usize, f: &Frame) {
        let l = &f.model.layout;
        let angle = match self.place {
            Place::Still(angle) => angle,
            Place::OnInner(angle) => angle + f.model.rotation.at(f.t).1,
            Place::Through(slot) => f.y[l.theta() + slot],
        };
        let (sin, cos) = angle.sin_cos();
        let slope = |tau: usize| (cos * f.y[tau] + sin * f.y[tau + 1]) as f32;
        self.rings[at] = [slope(l.inner_tilt()), slope(l.outer_tilt())];
        for row in 0..self.rows {
            let near = |slot: &usize| cos * f.ws.cos[*slot] + sin * f.ws.sin[*slot];
            let slots = (0..l.rollers_per_row).map(|roller| l.slot(row, roller));
            let Some(slot) = slots.max_by(|a, b| near(a).total_cmp(&near(b))) else {
                continue;
            };
            let place = at * self.rows + row;
            self.tilts[place] = f.y[l.beta() + slot] as f32;
            for side in SIDES {
                let line = self.reader.of(f, slot, side);
                let (strips, count) = (self.strips, line.len());
                let to = &mut self.loads[(2 * place + side as usize) * strips..][..strips];
                for (k, to) in to.iter_mut().enumerate() {
                    let part = &line[k * count / strips..(k + 1) * count / strips];
                    *to = (part.iter().sum::<f64>() / part.len() as f64) as f32;
                }
            }
        }
    }

    /// Slopes of the inner and the outer ring's axis in the plane of the section, of a place in the ring buffer, rad.
    pub(super) fn rings(&self, at: usize) -> [f32; 2] {
        self.rings[at]
    }

    /// A row of the same.
    pub(super) fn row(&self, at: usize, row: usize) -> SectionRow<'_> {
        let place = at * self.rows + row;
        let loads = &self.loads[2 * place * self.strips..][..2 * self.strips];
        let (inner, outer) = loads.split_at(self.strips);
        SectionRow { tilt: self.tilts[place], line_loads: [inner, outer] }
    }
}
