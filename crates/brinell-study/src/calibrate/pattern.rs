//! A measured signal as targets: its levels, RMS and kurtosis, and the defects' frequencies where they are significant.

use super::signature::{Level, Signature, decibels};
use super::{CalibrateError, Key, Target};
use brinell::analysis::{Quantity as Dimension, Unit};
use brinell::bearing::Kinematics;
use brinell::channel::SENSOR;
use brinell::result::{Quantity, Spread};
use brinell::scenario::{Scenario, Surface};
use brinell::signal::{Band, Blocks, Indicator, Interval, LineFrequency, LineSearch, line_frequency};
use brinell::simulate::Simulation;

/// Share of a run that its statistics are of, at most; and periods of a line that are needed to time it.
const ANALYSED: f64 = 0.75;
const PERIODS: f64 = 24.0;
/// The key whose bounds move every line.
const SPEED: &str = "operation.speed_rpm";
/// Widest search about the middle of its bounds, relative ([`LineSearch::tolerance`]).
const WIDEST: f64 = 0.3;

/// A measured acceleration.
#[derive(Debug)]
pub struct Measured<'a> {
    /// Its samples.
    pub x: &'a [f64],
    /// Samples a second.
    pub rate: f64,
    /// Unit of the samples.
    pub unit: &'a Unit,
}

/// What is taken from a run's signal, and what the measured one had.
#[derive(Debug, Clone)]
pub struct Pattern {
    signature: Signature,
    /// Which of the filtered channels represents the sensor.
    pub(super) axis: usize,
    /// Its name.
    pub channel: &'static str,
    /// What the measured signal says.
    pub targets: Vec<Target>,
    /// What was read, in sentences.
    pub notes: Vec<String>,
}

impl Pattern {
    /// Of a signal, for runs of a scenario, that of the middle of the bounds of `keys`. Where the speed is one of them,
    /// the signal's own lines are sought over its bounds, and levels are read there. `axis` is the sensor's, x or y;
    /// without one the one nearer the load.
    /// `model_uncertainty_percent` is what levels of the model may differ by from a machine's.
    ///
    /// # Errors
    /// Where signal and scenario do not go together.
    pub fn new(
        measured: &Measured,
        keys: &[Key],
        (scenario, simulation): (&Scenario, &Simulation),
        axis: Option<&str>,
        model_uncertainty_percent: f64,
    ) -> Result<Self, CalibrateError> {
        let share = 0.01 * model_uncertainty_percent;
        if !(share > 0.0 && share <= 1.0) {
            return Err(CalibrateError::ModelUncertainty(model_uncertainty_percent));
        }
        let rpm = scenario.operation.speed_rpm.constant().ok_or(CalibrateError::Speed)?;
        let axis = match axis {
            Some("x") => 0,
            Some("y") => 1,
            None => scenario.operation.axis_of_load(),
            Some(other) => return Err(CalibrateError::Axis(other.into())),
        };
        if measured.unit.quantity != Dimension::Acceleration {
            return Err(CalibrateError::NoAcceleration(measured.unit.name.clone()));
        }
        let simulated = simulation.sample_rate();
        if (measured.rate / simulated - 1.0).abs() > 1e-6 {
            return Err(CalibrateError::Rate { measured: measured.rate, simulated });
        }
        let x = &*measured.unit.in_si(measured.x);
        let speed = keys.iter().find(|key| key.name == SPEED);
        let reach = speed.map_or(0.0, |key| ((key.high - key.low) / (key.high + key.low)).abs());
        targets((scenario, simulation), (x, measured.rate), axis, (rpm.abs() / 60.0, reach), share)
    }

    /// The levels of a run's signal as numbers of its row.
    pub(super) fn quantities(&self, x: &[f64]) -> Vec<Quantity> {
        // A run too short for a signature has none, and its row says so by their absence.
        let levels = self.signature.of(x).unwrap_or_default();
        let one = |l: Level| Quantity {
            name: l.name,
            unit: "dB".into(),
            value: Some(l.decibels),
            spread: Spread::Interval(Interval::normal(l.decibels, l.uncertainty)),
        };
        levels.into_iter().map(one).collect()
    }

    /// Everything that the levels of a run depend on beside its scenario, as text.
    pub(super) fn describe(&self) -> String {
        format!("{} {}", self.channel, self.signature.describe())
    }
}

fn targets(
    (scenario, simulation): (&Scenario, &Simulation),
    (x, rate): (&[f64], f64),
    axis: usize,
    (shaft, reach): (f64, f64),
    share: f64,
) -> Result<Pattern, CalibrateError> {
    let channel = SENSOR[axis];
    let model = simulation.model();
    let kinematics = model.kinematics(model.rotation.at(0.0).0);
    let analysed = ANALYSED * simulation.samples() as f64 / rate;
    let line = |nominal: f64, band: Band, tolerance: f64| -> Option<LineFrequency> {
        let search = LineSearch { tolerance, ..LineSearch::new(nominal) };
        let fits = nominal < 0.4 * rate && analysed * nominal >= PERIODS;
        fits.then(|| line_frequency(x, rate, band, &search)).flatten()
    };
    let mut lines = lines(scenario, &kinematics);
    let (mut shaft, mut notes) = (shaft, Vec::new());
    if reach > 0.0 {
        // The speed is to be found: first where the signal's own lines are, anywhere within its bounds.
        let wide = (reach + LineSearch::new(1.0).tolerance).min(WIDEST);
        let around = demodulated(rate, &lines);
        let middle = shaft;
        for (name, at) in &mut lines {
            match line(*at, around, wide) {
                Some(found) => {
                    shaft = middle * found.frequency / *at;
                    *at = found.frequency;
                }
                None => notes.push(format!(
                    "no line of {} stands out from {:.1} to {:.1} Hz: its levels are read at {at:.1} Hz, the middle of the bounds of {SPEED}",
                    name.to_uppercase(),
                    *at * (1.0 - wide),
                    *at * (1.0 + wide)
                )),
            }
        }
    }
    let band = demodulated(rate, &lines);
    // Runs are analysed from half-way on at the latest.
    let simulated = simulation.samples() as usize / 2;
    let signature = Signature::new(rate, simulated.min(x.len()), band, &lines)?;
    let level = decibels(share);
    let mut targets: Vec<Target> = signature
        .of(x)?
        .into_iter()
        .map(|l| Target { name: l.name, value: l.decibels, uncertainty: l.uncertainty.hypot(level) })
        .collect();
    let blocks = Blocks::of(x, rate / shaft);
    for indicator in [Indicator::Rms, Indicator::Kurtosis] {
        if let Some(estimate) = blocks.estimate(indicator) {
            let own = estimate.interval.map_or(0.0, |i| i.standard_uncertainty());
            targets.push(Target {
                name: format!("{channel}.{}", indicator.name()),
                value: estimate.value,
                uncertainty: own.hypot(share * estimate.value.abs()),
            });
        }
    }
    for (k, defect) in scenario.defects.iter().enumerate() {
        let name = line_name(&kinematics, defect.on);
        let at = lines.iter().find(|l| l.0 == name).map(|l| l.1);
        if let Some(found) = at.and_then(|at| line(at, band, LineSearch::new(at).tolerance)) {
            targets.push(Target {
                name: format!("defect{}.frequency", k + 1),
                value: found.frequency,
                uncertainty: found.uncertainty,
            });
        }
    }
    Ok(Pattern { signature, axis, channel, targets, notes })
}

/// The band whose envelope holds these lines: above ten times the highest.
fn demodulated(rate: f64, lines: &[(&str, f64)]) -> Band {
    let highest = lines.iter().map(|l| l.1).fold(0.0, f64::max);
    Band::between((10.0 * highest).clamp(0.02 * rate, 0.1 * rate), 0.4 * rate)
}

/// The defect frequencies, Hz, each once, by the names that levels have.
fn lines(scenario: &Scenario, kinematics: &Kinematics) -> Vec<(&'static str, f64)> {
    let mut lines: Vec<(&'static str, f64)> = Vec::new();
    for defect in &scenario.defects {
        let (name, frequency) = (line_name(kinematics, defect.on), kinematics.defect_frequency(defect.on).1);
        if frequency > 0.0 && !lines.iter().any(|l| l.0 == name) {
            lines.push((name, frequency));
        }
    }
    lines
}

fn line_name(kinematics: &Kinematics, on: Surface) -> &'static str {
    match kinematics.defect_frequency(on).0 {
        "BPFO" => "bpfo",
        "BPFI" => "bpfi",
        _ => "2bsf",
    }
}
