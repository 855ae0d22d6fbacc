//! Slip of cages and rollers against pure rolling: over time from the start on, and over the place in the bearing.

use super::load_zone::BINS;
use super::stretches::Stretches;
use crate::channel::Frame;
use crate::model::Layout;
use crate::scenario::ModelKind;

/// Stretches of time, at most.
#[doc(hidden)]
pub const STRETCHES: usize = 1024;
/// Below this share of the highest speed, slip says nothing.
const SLOWEST: f64 = 0.05;

/// Sums over one stretch of time or one place, of fractions.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Sums {
    cage: f64,
    orbit: f64,
    spin: f64,
    cages: u32,
    rollers: u32,
}

impl Sums {
    fn with(self, other: Self) -> Self {
        Self {
            cage: self.cage + other.cage,
            orbit: self.orbit + other.orbit,
            spin: self.spin + other.spin,
            cages: self.cages + other.cages,
            rollers: self.rollers + other.rollers,
        }
    }
}

/// Mean slip over time and place, of one row. NaN where there was nothing to average.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Slips {
    /// 1 - cage speed / its pure-rolling speed.
    pub cage: Vec<f64>,
    /// 1 - orbit speed / its pure-rolling speed: the mean of all rollers.
    pub orbit: Vec<f64>,
    /// 1 - spin speed / its pure-rolling speed: the mean of all rollers.
    pub spin: Vec<f64>,
}

/// Gathers slip while a run goes.
#[derive(Debug, Clone, PartialEq)]
pub struct SlipCourse {
    rows: usize,
    /// A row each.
    stretches: Stretches<Sums>,
    /// Row after row, [`BINS`] places each.
    places: Vec<Sums>,
}

impl SlipCourse {
    /// Empty.
    pub fn new(layout: &Layout) -> Self {
        Self {
            rows: layout.rows,
            stretches: Stretches::new(STRETCHES, layout.rows),
            places: vec![Sums::default(); BINS * layout.rows],
        }
    }

    /// Takes one sample instant, at which the rollers are in these bins; places are counted where `settled`.
    pub fn take(&mut self, f: &Frame, bins: &[usize], settled: bool) {
        let stretch = self.stretches.next(Sums::default(), Sums::with);
        let (w, _) = f.model.rotation.at(f.t);
        if f.model.kind == ModelKind::Lumped || w == 0.0 || w.abs() < SLOWEST * f.model.rotation.max_speed().abs() {
            return;
        }
        let l = &f.model.layout;
        let dof = l.dof();
        let per_rolling = 1.0 / f.model.rolling_orbit_speed(w);
        let per_spinning = 1.0 / f.model.rolling_spin_speed(w);
        let orbits = &f.y[dof + l.theta()..];
        let spins = &f.y[dof + l.phi()..];
        for (row, stretch) in stretch.iter_mut().enumerate() {
            let mut sums = *stretch;
            sums.cage += 1.0 - f.y[dof + l.cage(row) + 2] * per_rolling;
            sums.cages += 1;
            let places = &mut self.places[row * BINS..][..BINS];
            for slot in (row..bins.len()).step_by(self.rows) {
                let orbit = 1.0 - orbits[slot] * per_rolling;
                let spin = 1.0 - spins[slot] * per_spinning;
                sums.orbit += orbit;
                sums.spin += spin;
                if settled {
                    let place = &mut places[bins[slot]];
                    place.orbit += orbit;
                    place.spin += spin;
                    place.rollers += 1;
                }
            }
            sums.rollers += l.rollers_per_row as u32;
            *stretch = sums;
        }
    }

    /// Samples of a stretch.
    pub fn samples_per_stretch(&self) -> u64 {
        self.stretches.samples
    }

    /// Slip of a row, stretch by stretch from t = 0 on; empty for the lumped model, whose motion is kinematic.
    pub fn over_time(&self, row: usize) -> Slips {
        means(self.stretches.values.iter().skip(row).step_by(self.rows))
    }

    /// Slip of a row's rollers over their orbit angle, in the bins of the load distribution; `cage` says nothing here.
    pub fn over_angle(&self, row: usize) -> Slips {
        means(&self.places[row * BINS..(row + 1) * BINS])
    }
}

fn means<'a>(sums: impl IntoIterator<Item = &'a Sums> + Clone) -> Slips {
    let sums = || sums.clone().into_iter();
    if sums().all(|s| s.rollers == 0) {
        return Slips::default();
    }
    Slips {
        cage: sums().map(|s| s.cage / f64::from(s.cages)).collect(),
        orbit: sums().map(|s| s.orbit / f64::from(s.rollers)).collect(),
        spin: sums().map(|s| s.spin / f64::from(s.rollers)).collect(),
    }
}
