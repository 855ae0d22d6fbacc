//! What the paper's cases need of a run beside its findings: statistics from t = 0 on, and the forces between cage and
//! rollers around the bearing.

use crate::reading::{WINDOWS_MS, from_start_name};
use brinell::channel::Frame;
use brinell::defect::wrap;
use brinell::observe::Findings;
use brinell::observe::load_zone::BINS;
use brinell::result::{Quantity, Spread};
use brinell::simulate::{Observer, Simulation};
use std::f64::consts::TAU;
use std::ops::ControlFlow;

/// Of a bin around the bearing, a row's rollers: sum of the forces between roller and cage, and how often one was seen.
#[derive(Debug, Clone, Copy, Default)]
struct Pocket {
    sum: f64,
    count: u32,
}

/// Sums of one channel from t = 0 on.
#[derive(Debug, Clone, Copy)]
struct Sums {
    squares: f64,
    low: f64,
    high: f64,
}

/// Observes a run of a case.
#[derive(Debug, Clone)]
pub(crate) struct FromStart {
    names: Vec<String>,
    sums: Vec<Sums>,
    /// Index of the first sample that no longer belongs to each of [`WINDOWS_MS`].
    ends: Vec<u64>,
    /// By window: RMS and peak to peak of each channel.
    closed: Vec<Vec<(f64, f64)>>,
    /// Of the damaged row.
    pockets: Vec<Pocket>,
    settled: f64,
}

impl FromStart {
    /// For one run.
    pub(crate) fn new(simulation: &Simulation) -> Self {
        let rate = simulation.sample_rate();
        let names: Vec<String> = simulation.channels().iter().map(|c| c.name.clone()).collect();
        let none = Sums { squares: 0.0, low: f64::INFINITY, high: f64::NEG_INFINITY };
        let turn = TAU / simulation.model().rotation.max_speed().abs();
        Self {
            sums: vec![none; names.len()],
            names,
            ends: WINDOWS_MS.iter().map(|ms| (f64::from(*ms) * 1e-3 * rate).round() as u64).collect(),
            closed: Vec::new(),
            pockets: vec![Pocket::default(); BINS],
            settled: turn + simulation.model().load.ramp,
        }
    }

    /// Mean force between roller and cage in each bin around the bearing, N: bin k spans [k, k + 1) 2 pi / [`BINS`]
    /// from +X. NaN where no roller came by.
    pub(crate) fn pocket_forces(&self) -> Vec<f64> {
        let mean = |p: &Pocket| p.sum / f64::from(p.count);
        self.pockets.iter().map(mean).collect()
    }

    /// The numbers: RMS and peak to peak of each channel over each of [`WINDOWS_MS`], how much a roller's spin changes
    /// around the bearing, and the mean force between cage and rollers at the ends of the load zone and elsewhere.
    pub(crate) fn quantities(&self, findings: &Findings) -> Vec<Quantity> {
        let mut all = Vec::new();
        for (k, channel) in self.names.iter().enumerate() {
            for (window, ms) in WINDOWS_MS.iter().enumerate() {
                let of = self.closed.get(window).map(|channels| channels[k]);
                all.push(number(from_start_name(channel, *ms, "rms"), "m/s^2", of.map(|x| x.0)));
                let range = from_start_name(channel, *ms, "peak_to_peak");
                all.push(number(range, "m/s^2", of.map(|x| x.1)));
            }
        }
        let spin = findings.slip_course.over_angle(0).spin;
        let known = || spin.iter().copied().filter(|x| x.is_finite());
        let (least, most) = (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
        all.push(number("row1.spin_change".into(), "1", (most >= least).then_some(most - least)));
        let loads = findings.load_zone.rows.first().map_or(Vec::new(), |row| row.mean());
        let (ends, elsewhere) = at_ends(&loads, &self.pocket_forces()).unzip();
        all.push(number("row1.pocket_force_at_zone_ends".into(), "N", ends));
        all.push(number("row1.pocket_force_elsewhere".into(), "N", elsewhere));
        all
    }
}

fn number(name: String, unit: &str, value: Option<f64>) -> Quantity {
    Quantity { name, unit: unit.into(), value: value.filter(|x| x.is_finite()), spread: Spread::Without }
}

/// Bins to either side of an end of the load zone that count as its end: 15 degrees.
const BESIDE: usize = 3;
/// Share of the largest mean load from which on a bin belongs to the load zone.
const LOADED: f64 = 0.02;

/// Mean of `forces` within 15 degrees of the ends of the load zone, and elsewhere; `None` where `loads` show no such
/// zone.
fn at_ends(loads: &[f64], forces: &[f64]) -> Option<(f64, f64)> {
    let n = loads.len();
    let most = loads.iter().copied().fold(0.0, f64::max);
    let loaded = |k: usize| loads[k % n] > LOADED * most;
    let ends: Vec<usize> = (0..n).filter(|k| loaded(*k) != loaded(k + 1)).collect();
    // A zone has two ends; a defect within it that takes all of the load away would make more, and the outer two count.
    if most <= 0.0 || ends.len() < 2 || forces.len() != n {
        return None;
    }
    // The longest unloaded stretch lies between them.
    let gap = |k: usize| (ends[(k + 1) % ends.len()] + n - ends[k]) % n;
    let free = (0..ends.len()).filter(|k| !loaded(ends[*k] + 1));
    let widest = free.max_by_key(|k| gap(*k))?;
    let (leaves, enters) = (ends[widest], ends[(widest + 1) % ends.len()]);
    let beside = |k: usize, end: usize| {
        let away = (k + n - end) % n;
        away <= BESIDE || away > n - BESIDE
    };
    let mean = |wanted: bool| {
        let all = (0..n).filter(|k| (beside(*k, leaves) || beside(*k, enters)) == wanted);
        let known: Vec<f64> = all.map(|k| forces[k]).filter(|f| f.is_finite()).collect();
        (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
    };
    Some((mean(true)?, mean(false)?))
}

impl Observer for FromStart {
    fn sample(&mut self, _: u64, f: &Frame) {
        if !f.model.kind.moves_every_part() || f.t < self.settled {
            return;
        }
        let l = &f.model.layout;
        for slot in (0..l.rollers()).filter(|slot| l.row(*slot) == 0) {
            let turn = wrap(f.y[l.theta() + slot]) / TAU;
            let bin = (((turn + 1.0).fract() * BINS as f64) as usize).min(BINS - 1);
            let pocket = &mut self.pockets[bin];
            pocket.sum += f.ws.pocket_force[slot].abs();
            pocket.count += 1;
        }
    }

    fn row(&mut self, index: u64, row: &[f64], _: &[f64]) -> ControlFlow<()> {
        while self.ends.get(self.closed.len()).is_some_and(|end| index >= *end) {
            let n = self.ends[self.closed.len()] as f64;
            let of = |s: &Sums| ((s.squares / n).sqrt(), s.high - s.low);
            self.closed.push(self.sums.iter().map(of).collect());
        }
        if self.closed.len() < self.ends.len() {
            for (sums, x) in self.sums.iter_mut().zip(row) {
                sums.squares += x * x;
                sums.low = sums.low.min(*x);
                sums.high = sums.high.max(*x);
            }
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BASE;
    use brinell::document::read;

    #[test]
    fn analytic_records_from_the_start() {
        let short = [("simulation.duration_s".to_owned(), "0.001".to_owned())];
        let scenario = read(BASE, &short).unwrap().scenario;
        let simulation = Simulation::new(&scenario).unwrap();
        let mut watch = FromStart::new(&simulation);
        // 10 for 0.1 s, then 1: the mean square over 0.2 s is 50.5.
        let n = watch.names.len();
        for index in 0..=5120_u64 {
            let x = if index < 2560 { 10.0 } else { 1.0 };
            let _ = watch.row(index, &vec![x; n], &[]);
        }
        assert_eq!(watch.closed.len(), 2);
        assert_eq!(watch.closed[0][0], (10.0, 0.0));
        let (rms, range) = watch.closed[1][0];
        assert!((rms - 50.5_f64.sqrt()).abs() < 1e-12 && range == 9.0);
    }

    #[test]
    fn analytic_ends_of_the_load_zone() {
        // Loaded from bin 10 to 61 the long way round, over bin 0; a defect takes the load off bin 1.
        let loads: Vec<f64> = (0..72).map(|k| f64::from(!(10..62).contains(&k) && k != 1)).collect();
        let at = |k: usize| (7..13).contains(&k) || (59..65).contains(&k);
        let forces: Vec<f64> = (0..72).map(|k| if at(k) { 5.0 } else { 1.0 }).collect();
        assert_eq!(at_ends(&loads, &forces), Some((5.0, 1.0)));
        assert_eq!(at_ends(&[1.0; 72], &forces), None);
        assert_eq!(at_ends(&[0.0; 72], &forces), None);
    }
}
