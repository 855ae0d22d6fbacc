//! Slip of cages and rollers against pure rolling, averaged over a run.

use crate::channel::Frame;
use crate::defect::Side;
use crate::model::Layout;
use crate::scenario::ModelKind;

/// A running mean.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Mean {
    sum: f64,
    count: u64,
}

impl Mean {
    fn push(&mut self, x: f64) {
        self.sum += x;
        self.count += 1;
    }

    fn value(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}

/// Slip of one row, as fractions.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RowSlip {
    cage: Mean,
    loaded_orbit: Mean,
    loaded_surface: Mean,
    unloaded_orbit: Mean,
}

impl RowSlip {
    /// 1 - cage speed / its pure-rolling speed.
    pub fn cage(&self) -> Option<f64> {
        self.cage.value()
    }

    /// 1 - orbit speed / its pure-rolling speed, of rollers that the inner raceway presses.
    pub fn loaded_orbit(&self) -> Option<f64> {
        self.loaded_orbit.value()
    }

    /// |slip| at the inner contact / speed of the inner raceway's surface, of the same rollers.
    pub fn loaded_surface(&self) -> Option<f64> {
        self.loaded_surface.value()
    }

    /// 1 - orbit speed / its pure-rolling speed, of the other rollers.
    pub fn unloaded_orbit(&self) -> Option<f64> {
        self.unloaded_orbit.value()
    }
}

/// Slip of every row.
#[derive(Debug, Clone, PartialEq)]
pub struct Slip {
    /// One a row; empty means for the reference model, whose motion is kinematic.
    pub rows: Vec<RowSlip>,
}

impl Slip {
    /// Empty.
    pub fn new(layout: &Layout) -> Self {
        Self {
            rows: vec![RowSlip::default(); layout.rows],
        }
    }

    /// Takes one instant; skipped while the ring stands still.
    pub fn take(&mut self, f: &Frame) {
        let (w, _) = f.model.rotation.at(f.t);
        if f.model.kind == ModelKind::Reference || w == 0.0 {
            return;
        }
        let l = &f.model.layout;
        let dof = l.dof();
        let rolling = f.model.rolling_orbit_speed(w);
        let surface = w * f.model.geometry.inner_radius;
        let inner = &f.ws.contacts[Side::Inner as usize];
        for row in 0..l.rows {
            self.rows[row]
                .cage
                .push(1.0 - f.y[dof + l.cage(row) + 2] / rolling);
        }
        for slot in 0..l.rollers() {
            let row = &mut self.rows[l.row(slot)];
            let orbit = 1.0 - f.y[dof + l.theta() + slot] / rolling;
            if inner.force[slot] > 0.0 {
                row.loaded_orbit.push(orbit);
                row.loaded_surface.push((inner.slip[slot] / surface).abs());
            } else {
                row.unloaded_orbit.push(orbit);
            }
        }
    }
}
