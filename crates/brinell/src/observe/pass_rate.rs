//! The rate at which rollers meet each defect, from the motion itself: how slip lets a defect frequency wander.
//!
//! The phase of a defect, in impacts: Z theta / (2 pi) of a defect on the outer raceway, Z (alpha - theta) / (2 pi) on
//! the inner one, with theta the mean orbit angle of the row's Z rollers and alpha the inner ring's angle, and 2 (phi -
//! theta) / (2 pi) on a roller that turns by phi. Its rise over each revolution of the inner ring is kept; the scatter
//! of these, autocorrelation included, is that of the mean rate.

use crate::channel::Frame;
use crate::model::{Layout, Model};
use crate::scenario::{ModelKind, Surface};
use crate::signal::estimate::MOST_FREEDOM;
use crate::signal::{Averages, Estimate, Interval, LineFrequency, Scatter};
use std::f64::consts::TAU;

/// Share of a run, at its beginning, that hardly moves a frequency found under Hann's window.
const TAPERED: f64 = 0.2;

/// Distance from the mean rate, relative, at which a comb is taken for a lobe of itself. Cages that settle move a
/// frequency by 0.1 %.
const LOBE: f64 = 0.005;

/// Of one defect.
#[derive(Debug, Clone)]
struct Rate {
    surface: Surface,
    row: usize,
    /// The damaged roller, or the row's first.
    slot: usize,
    last: f64,
    /// Impacts over seconds.
    averages: Averages,
}

impl Rate {
    /// Whether the mean rate of the motion is that of the impacts: a roller spins more slowly where nothing presses it,
    /// and causes impacts where something does.
    fn on_raceway(&self) -> bool {
        !matches!(self.surface, Surface::Roller(_))
    }

    fn phase(&self, f: &Frame) -> f64 {
        let l = &f.model.layout;
        let orbit = || {
            let slots = (0..l.rollers()).filter(|slot| l.row(*slot) == self.row);
            slots.map(|slot| f.y[l.theta() + slot]).sum::<f64>()
        };
        let rollers = (l.rollers() / l.rows) as f64;
        let turns = match self.surface {
            Surface::OuterRaceway => orbit(),
            Surface::InnerRaceway => rollers * f.model.rotation.at(f.t).1 - orbit(),
            Surface::Roller(_) => 2.0 * (f.y[l.phi() + self.slot] - f.y[l.theta() + self.slot]),
        };
        turns / TAU
    }
}

/// Of all defects.
#[derive(Debug, Clone)]
pub(super) struct PassRates {
    last: Option<f64>,
    rates: Vec<Rate>,
}

impl PassRates {
    /// Nothing seen yet.
    pub(super) fn new(model: &Model) -> Self {
        let l: &Layout = &model.layout;
        let rate = |d: &crate::defect::Defect| Rate {
            surface: d.surface,
            row: d.row,
            slot: l.slot(
                d.row,
                match d.surface {
                    Surface::Roller(k) => k,
                    _ => 0,
                },
            ),
            last: 0.0,
            averages: Averages::new(),
        };
        let kinematic = model.kind == ModelKind::Lumped;
        let defects = model.defects.iter().filter(|_| !kinematic);
        Self { last: None, rates: defects.map(rate).collect() }
    }

    /// Takes the instant at which statistics begin or a whole revolution of the inner ring has ended.
    pub(super) fn take(&mut self, f: &Frame) {
        for rate in &mut self.rates {
            let phase = rate.phase(f);
            if let Some(last) = self.last {
                rate.averages.add(phase - rate.last, f.t - last);
                rate.averages.end_block();
            }
            rate.last = phase;
        }
        self.last = Some(f.t);
    }

    /// Impacts per second on a defect, counted from 0, over whole revolutions; negative where the phase falls. `None`
    /// in the lumped model, whose rollers do not slip, and before the first revolution.
    pub(super) fn rate(&self, defect: usize) -> Option<Estimate> {
        self.rates.get(defect)?.averages.estimate()
    }

    /// The mean rate of the motion, Hz, where it is that of the impacts: of damage on a raceway.
    pub(super) fn motion(&self, defect: usize) -> Option<f64> {
        self.rates.get(defect).filter(|rate| rate.on_raceway())?;
        Some(self.rate(defect)?.value.abs())
    }

    /// The frequency found in the envelope as an estimate of the mean rate, with its interval.
    ///
    /// Where the rate swings at a steady pace (a cage that whirls takes the rollers with it), each line of the comb
    /// splits into lobes, and the highest lobe is not the mean rate: farther from the motion's own by more than half a
    /// percent, that one replaces it.
    pub(super) fn mean_rate(&self, defect: usize, found: LineFrequency) -> (LineFrequency, Option<Interval>) {
        let interval = self.interval(defect, &found);
        let Some((frequency, rate)) = self.motion(defect).zip(self.rate(defect)) else {
            return (found, interval);
        };
        if (found.frequency - frequency).abs() <= LOBE * found.frequency {
            return (found, interval);
        }
        let interval = rate.interval.map(|i| match rate.value < 0.0 {
            true => Interval { low: -i.high, high: -i.low, ..i },
            false => i,
        });
        (LineFrequency { frequency, ..found }, interval)
    }

    /// The interval of a frequency found in the envelope: of its noise, of slip's wander about the mean rate, and of
    /// what sets it apart from the motion's own mean.
    ///
    /// A rate that wanders with spectral density S at frequency zero scatters by sqrt(S / T) over a time T, and the
    /// motion gives S. A comb of many harmonics settles on the stretch in which the rate was steadiest, so on a
    /// raceway, where the motion's mean rate over the same time is the same quantity, the distance between the two
    /// counts as a further error. A roller spins more slowly where it has no impacts: there T is
    /// [`LineFrequency::span`], of a weighted average over the record. Hann's window gives the beginning little weight,
    /// so where cages still settle there (Geweke's comparison finds a drift) it does not count as wander. Degrees of
    /// freedom by Welch and Satterthwaite, those of the noise counting as many. `None` where the run is too short to
    /// tell.
    fn interval(&self, defect: usize, found: &LineFrequency) -> Option<Interval> {
        let noise = found.noise * found.noise;
        let (wander, freedom) = match self.rates.get(defect) {
            None => (0.0, 1.0),
            Some(rate) => {
                let settles = rate.averages.drift().is_some();
                let skipped = if settles { TAPERED } else { 0.0 };
                let (density, freedom) = rate.averages.density(skipped)?;
                let wander = match rate.averages.estimate().filter(|_| rate.on_raceway()) {
                    Some(mean) => {
                        let apart = found.frequency - mean.value.abs();
                        density / rate.averages.weight() + apart * apart
                    }
                    None => density / found.span,
                };
                (wander, f64::from(freedom))
            }
        };
        let share = wander / (wander + noise);
        let freedom = (freedom / (share * share)).min(f64::from(MOST_FREEDOM));
        let scatter = Scatter { error: (wander + noise).sqrt(), freedom: freedom as u32 };
        Estimate::signed(found.frequency, Some(scatter)).interval
    }
}
