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

/// Share of a run that its statistics are of, at most.
const ANALYSED: f64 = 0.75;
/// The key whose bounds move every line.
const SPEED: &str = "operation.speed_rpm";
/// Lines of parts of one bearing are apart as in pure rolling, but for slip: relative.
const ONE_SPEED: f64 = 0.01;

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
    /// Of a signal, for runs of a scenario, that of the middle of the bounds of `keys`. The signal's lines are sought
    /// about the speed that `own` states, the scenario before anything is fitted, where that is within the bounds of
    /// the speed, else about their middle. `axis` is the sensor's, x or y; without one the one nearer the load.
    /// `model_uncertainty_percent` is what levels of the model may differ by from a machine's.
    ///
    /// # Errors
    /// Where signal and scenario do not go together.
    pub fn new(
        measured: &Measured,
        (own, keys): (&Scenario, &[Key]),
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
        let bounds = keys.iter().find(|key| key.name == SPEED);
        let within = |own: &f64| bounds.is_none_or(|key| (key.low..=key.high).contains(own));
        let speed = own.operation.speed_rpm.constant().filter(within).unwrap_or(rpm);
        targets((scenario, simulation), (x, measured.rate), axis, (speed, speed / rpm), share)
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
    (rpm, scale): (f64, f64),
    share: f64,
) -> Result<Pattern, CalibrateError> {
    let channel = SENSOR[axis];
    let model = simulation.model();
    let kinematics = model.kinematics(model.rotation.at(0.0).0 * scale);
    let lines = lines(scenario, &kinematics);
    let highest = lines.iter().map(|l| l.1).fold(0.0, f64::max);
    let band = Band::between((10.0 * highest).clamp(0.02 * rate, 0.1 * rate), 0.4 * rate);
    // Runs are analysed from half-way on at the latest.
    let simulated = simulation.samples() as usize / 2;
    let signature = Signature::new(rate, simulated.min(x.len()), band, &lines)?;
    let level = decibels(share);
    let mut targets: Vec<Target> = signature
        .of(x)?
        .into_iter()
        .map(|l| Target { name: l.name, value: l.decibels, uncertainty: l.uncertainty.hypot(level) })
        .collect();
    let blocks = Blocks::of(x, 60.0 * rate / rpm.abs());
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
    let analysed = (ANALYSED * simulation.samples() as f64) as usize;
    let mut notes = Vec::new();
    let mut found: Vec<(&str, f64, LineFrequency)> = Vec::new();
    for &(name, nominal) in &lines {
        let search = LineSearch::new(nominal);
        if !search.fits(analysed, rate) {
            continue;
        }
        match line_frequency(x, rate, band, &search) {
            Some(line) => found.push((name, line.frequency / nominal, line)),
            None => notes.push(format!(
                "no line of {} within {:.0} % of {nominal:.1} Hz, where it is at {rpm:.0} r/min: is {SPEED} the speed of the signal?",
                name.to_uppercase(),
                100.0 * search.tolerance
            )),
        }
    }
    // The one nearest pure rolling says where the others are: what is not there is another line.
    let nearest = found.iter().map(|f| f.1).min_by(|a, b| (a - 1.0).abs().total_cmp(&(b - 1.0).abs()));
    found.retain(|(name, ratio, line)| {
        let stays = nearest.is_some_and(|nearest| (ratio / nearest - 1.0).abs() < ONE_SPEED);
        if !stays {
            let hz = line.frequency;
            notes.push(format!(
                "the line at {hz:.2} Hz is left out: {} is not so far from the others",
                name.to_uppercase()
            ));
        }
        stays
    });
    for (k, defect) in scenario.defects.iter().enumerate() {
        let name = line_name(&kinematics, defect.on);
        if let Some((.., line)) = found.iter().find(|f| f.0 == name) {
            targets.push(Target {
                name: format!("defect{}.frequency", k + 1),
                value: line.frequency,
                uncertainty: line.uncertainty,
            });
        }
    }
    Ok(Pattern { signature, axis, channel, targets, notes })
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
