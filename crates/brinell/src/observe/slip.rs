//! Slip of cages and rollers against pure rolling, averaged over a run.

use crate::channel::Frame;
use crate::defect::Side;
use crate::model::Layout;
use crate::scenario::ModelKind;
use crate::signal::{Averages, Estimate};
use std::f64::consts::TAU;

/// Slip of one row, as fractions.
#[derive(Debug, Clone, Default)]
pub struct RowSlip {
    cage: Averages,
    loaded_orbit: Averages,
    loaded_surface: Averages,
    unloaded_orbit: Averages,
}

impl RowSlip {
    fn end_revolution(&mut self) {
        let RowSlip { cage, loaded_orbit, loaded_surface, unloaded_orbit } = self;
        for averages in [cage, loaded_orbit, loaded_surface, unloaded_orbit] {
            averages.end_block();
        }
    }

    /// By how much the cage's slip was larger when statistics began than later, where that is more than its scatter
    /// explains.
    pub fn cage_drift(&self) -> Option<f64> {
        self.cage.drift()
    }

    /// 1 - cage speed / its pure-rolling speed.
    pub fn cage(&self) -> Option<Estimate> {
        self.cage.estimate()
    }

    /// 1 - orbit speed / its pure-rolling speed, of rollers that both raceways press.
    pub fn loaded_orbit(&self) -> Option<Estimate> {
        self.loaded_orbit.estimate()
    }

    /// |slip| at the inner contact / speed of the inner raceway's surface, of the same rollers.
    pub fn loaded_surface(&self) -> Option<Estimate> {
        self.loaded_surface.estimate()
    }

    /// 1 - orbit speed / its pure-rolling speed, of the other rollers.
    pub fn unloaded_orbit(&self) -> Option<Estimate> {
        self.unloaded_orbit.estimate()
    }
}

/// Slip of every row.
#[derive(Debug, Clone)]
pub struct Slip {
    /// One a row; empty means for the lumped model, whose motion is kinematic.
    pub rows: Vec<RowSlip>,
    /// Of the inner ring at the first instant, rad.
    start_angle: Option<f64>,
    /// Whole revolutions since then.
    turn: i64,
}

impl Slip {
    /// Empty.
    pub fn new(layout: &Layout) -> Self {
        Self { rows: vec![RowSlip::default(); layout.rows], start_angle: None, turn: 0 }
    }

    /// Takes one instant; skipped while the ring is at rest.
    pub fn take(&mut self, f: &Frame) {
        let (w, angle) = f.model.rotation.at(f.t);
        if f.model.kind == ModelKind::Lumped || w == 0.0 {
            return;
        }
        let start = *self.start_angle.get_or_insert(angle);
        let turn = ((angle - start) / TAU).floor() as i64;
        if turn != self.turn {
            self.turn = turn;
            self.rows.iter_mut().for_each(RowSlip::end_revolution);
        }
        let l = &f.model.layout;
        let dof = l.dof();
        let rolling = f.model.rolling_orbit_speed(w);
        let surface = w * f.model.geometry.inner_radius;
        let [inner, outer] = [Side::Inner, Side::Outer].map(|side| &f.ws.contacts[side as usize]);
        for row in 0..l.rows {
            self.rows[row].cage.push(1.0 - f.y[dof + l.cage(row) + 2] / rolling);
        }
        for slot in 0..l.rollers() {
            let row = &mut self.rows[l.row(slot)];
            let orbit = 1.0 - f.y[dof + l.theta() + slot] / rolling;
            // At one raceway alone it is held by its weight or the centrifugal force, and may slide.
            if inner.force[slot] > 0.0 && outer.force[slot] > 0.0 {
                row.loaded_orbit.push(orbit);
                row.loaded_surface.push((inner.slip[slot] / surface).abs());
            } else {
                row.unloaded_orbit.push(orbit);
            }
        }
    }
}
