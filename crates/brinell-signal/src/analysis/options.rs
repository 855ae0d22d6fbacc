//! What is asked of an analysis.

use super::error::{AnalysisError, LARGEST};
use super::frequencies::DefectOrders;
use crate::error::require;
use crate::{Band, Rotation};
use std::ops::RangeInclusive;

/// What is known beside the samples, and how sure to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Shaft speed, Hz.
    pub shaft: f64,
    /// Defect frequencies over the shaft's.
    pub orders: DefectOrders,
    /// How far slip and an inexact speed may move a defect frequency, relative; [`TOLERANCE`] unless told.
    pub tolerance: f64,
    /// The range to demodulate; `None` takes everything above three times the highest defect frequency.
    pub band: Option<Band>,
    /// Frequency of the motor's supply, Hz, where an inverter makes it: lines at its multiples are set aside, as those
    /// of the mains are.
    pub supply: Option<f64>,
    /// The shaft's angle over time, where its speed varies: envelopes are then taken at equal angles, and a frequency
    /// in Hz is its order times `shaft`, the mean speed. Time counts from the first sample.
    pub rotation: Option<Rotation>,
    /// Whether the speed was measured beside the signal, and not merely believed.
    pub measured_speed: bool,
    /// For a simulation's signal without a sensor's noise, in which healthy rollers that enter the load are heard too:
    /// RMS of the white noise that a machine would add, in the signal's unit ([`MACHINE_NOISE`] of an acceleration).
    /// `None` for a signal that has its own.
    pub silent: Option<f64>,
    /// Whether speed and bearing are those of a simulation: nothing but the bearing turns, and a shift beyond the
    /// tolerance is slip of the cage.
    pub exact: bool,
}

/// What a defect frequency may be over the shaft's, and FTF, for any bearing of three elements or more with its outer
/// ring at rest; narrower for those that somebody states, [`DefectOrders::POSSIBLE`].
const ORDERS: (f64, f64) = (0.1, 1000.0);
const FTF_ORDERS: (f64, f64) = (0.01, 0.6);
/// How far the mean speed of a rotation may be from the shaft's, relative: that of its points is a little off.
const ALIKE: f64 = 0.1;

impl Options {
    /// With the usual tolerance, for a measured signal.
    pub fn new(shaft: f64, orders: DefectOrders) -> Self {
        Options {
            shaft,
            orders,
            tolerance: TOLERANCE,
            band: None,
            supply: None,
            rotation: None,
            measured_speed: false,
            silent: None,
            exact: false,
        }
    }

    /// That they can be, for a record of so many s.
    pub(super) fn check(&self, seconds: f64) -> Result<(), AnalysisError> {
        require(self.shaft > 0.0 && self.shaft.is_finite(), "shaft speed (Hz)", self.shaft, "above 0")?;
        require(self.tolerance > 0.0 && self.tolerance <= 0.1, "tolerance", self.tolerance, "above 0 to 0.1")?;
        let supply = self.supply.unwrap_or(*SUPPLY_HZ.start());
        require(SUPPLY_HZ.contains(&supply), "supply (Hz)", supply, "1 to 1000")?;
        let noise = self.silent.unwrap_or(0.0);
        require((0.0..=LARGEST).contains(&noise), "silent (RMS of a machine's noise)", noise, "0 to 1e60")?;
        let turned = self.rotation.as_ref().map(|rotation| rotation.at(seconds).0 - rotation.at(0.0).0);
        let mean = turned.map_or(self.shaft, |turns| turns / seconds);
        let alike = (mean / self.shaft - 1.0).abs() <= ALIKE;
        require(alike, "rotation (Hz, mean over the record)", mean, "within a tenth of `shaft`, which is that mean")?;
        for (_, name, order) in self.orders.defect_frequencies() {
            let (least, most) = if name == "FTF" { FTF_ORDERS } else { ORDERS };
            if !(least..=most).contains(&order) {
                return Err(AnalysisError::Order { name, order, least, most });
            }
        }
        self.orders.with_given([None; 4]).map(drop)
    }

    /// The tolerance in per cent, as it was given.
    pub fn tolerance_percent(&self) -> f64 {
        (1e4 * self.tolerance).round() / 1e2
    }

    /// Whether a speed (Hz) lies farther from the one given than the tolerance.
    pub(super) fn is_other_speed(&self, shaft: f64) -> bool {
        (shaft / self.shaft - 1.0).abs() > self.tolerance
    }
}

/// How far slip and an inexact speed may move a defect frequency, relative, unless told.
pub const TOLERANCE: f64 = 0.02;
/// Allowed values of [`Options::supply`], Hz.
pub const SUPPLY_HZ: RangeInclusive<f64> = 1.0..=1000.0;
/// RMS of a machine's noise, m/s^2: somewhat below that of the sound motor in the public records of Case Western
/// Reserve University, 0.63 and 0.67 above 1 kHz at its two ends (48 kHz, 1797 r/min).
pub const MACHINE_NOISE: f64 = 0.5;
