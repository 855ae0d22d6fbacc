//! Slip of cages and rollers against pure rolling, averaged over a run: by way, so that a speed near zero counts for
//! next to nothing.

use crate::channel::Frame;
use crate::defect::Side;
use crate::model::Layout;
use crate::scenario::ModelKind;
use crate::signal::{Averages, Estimate, Interval};

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

    /// 1 - angle turned by the cage / in pure rolling.
    pub fn cage(&self) -> Option<Estimate> {
        self.cage.estimate()
    }

    /// 1 - angle of the orbit / in pure rolling, of rollers that both raceways press.
    pub fn loaded_orbit(&self) -> Option<Estimate> {
        self.loaded_orbit.estimate()
    }

    /// Way slipped at the inner contact / way of the inner raceway's surface, of the same rollers.
    pub fn loaded_surface(&self) -> Option<Estimate> {
        let estimate = self.loaded_surface.estimate()?;
        let interval = estimate.interval.map(|i| Interval { low: i.low.max(0.0), ..i });
        Some(Estimate { interval, ..estimate })
    }

    /// 1 - angle of the orbit / in pure rolling, of the other rollers.
    pub fn unloaded_orbit(&self) -> Option<Estimate> {
        self.unloaded_orbit.estimate()
    }
}

/// Slip of every row.
#[derive(Debug, Clone)]
pub struct Slip {
    /// One a row; empty means for the lumped model, whose motion is kinematic.
    pub rows: Vec<RowSlip>,
    /// The first instant, s.
    start: Option<f64>,
    /// Whole revolutions since then.
    turn: i64,
}

impl Slip {
    /// Empty.
    pub fn new(layout: &Layout) -> Self {
        Self { rows: vec![RowSlip::default(); layout.rows], start: None, turn: 0 }
    }

    /// Takes one instant; skipped while the ring is at rest.
    pub fn take(&mut self, f: &Frame) {
        let (w, _) = f.model.rotation.at(f.t);
        if f.model.kind == ModelKind::Lumped || w == 0.0 {
            return;
        }
        let turn = f.model.rotation.whole_turns(*self.start.get_or_insert(f.t), f.t);
        if turn != self.turn {
            self.turn = turn;
            self.rows.iter_mut().for_each(RowSlip::end_revolution);
        }
        let l = &f.model.layout;
        let dof = l.dof();
        let rolling = f.model.rolling_orbit_speed(w);
        // Behind pure rolling, in its direction.
        let behind = |speed: f64| (rolling - speed) * rolling.signum();
        let surface = (w * f.model.geometry.inner_radius).abs();
        let [inner, outer] = [Side::Inner, Side::Outer].map(|side| &f.ws.contacts[side as usize]);
        for row in 0..l.rows {
            self.rows[row].cage.add(behind(f.y[dof + l.cage(row) + 2]), rolling.abs());
        }
        for slot in 0..l.rollers() {
            let row = &mut self.rows[l.row(slot)];
            let orbit = behind(f.y[dof + l.theta() + slot]);
            // At one raceway alone it is held by its weight or the centrifugal force, and may slide.
            if inner.force[slot] > 0.0 && outer.force[slot] > 0.0 {
                row.loaded_orbit.add(orbit, rolling.abs());
                row.loaded_surface.add(inner.slip[slot].abs(), surface);
            } else {
                row.unloaded_orbit.add(orbit, rolling.abs());
            }
        }
    }
}
