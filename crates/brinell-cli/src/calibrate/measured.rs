//! A measured signal as targets.

use super::CalibrateArgs;
use crate::analyze::measured::{Measured, SignalArgs, load};
use crate::failure::Failure;
use brinell::analysis::Quantity as Dimension;
use brinell::bearing::Kinematics;
use brinell::channel::SENSOR;
use brinell::result::{Quantity, Spread};
use brinell::scenario::Scenario;
use brinell::signal::{Band, Blocks, Indicator, Interval, LineSearch, line_frequency};
use brinell::simulate::Simulation;
use brinell_study::calibrate::Target;
use brinell_study::calibrate::signature::{Signature, decibels};

/// Share of a run that its statistics are of, at most; and periods of a line that are needed to time it.
const ANALYSED: f64 = 0.75;
const PERIODS: f64 = 24.0;

/// What is taken from a run's signal, and what the measured one had.
pub(super) struct Pattern {
    pub(super) signature: Signature,
    /// Which of the filtered channels represents the sensor, and its name.
    pub(super) axis: usize,
    pub(super) channel: &'static str,
    pub(super) targets: Vec<Target>,
    /// What was read, in sentences.
    pub(super) notes: Vec<String>,
    pub(super) warnings: Vec<String>,
}

fn usage(message: String) -> Failure {
    Failure::Usage(message)
}

/// The signal of the command line, if there is one, as targets for runs of a scenario.
pub(super) fn pattern(
    args: &CalibrateArgs,
    scenario: &Scenario,
    simulation: &Simulation,
) -> Result<Option<Pattern>, Failure> {
    let Some(file) = &args.measured else {
        if args.signal != SignalArgs::default() {
            return Err(usage(
                "--channel, --rate, --unit and the like are about a measured signal: give --measured FILE".into(),
            ));
        }
        return Ok(None);
    };
    let share = 0.01 * args.model_uncertainty;
    if !(share > 0.0 && share <= 1.0) {
        return Err(usage(format!(
            "--model-uncertainty {}: expected more than 0 to 100 per cent",
            args.model_uncertainty
        )));
    }
    let Some(rpm) = scenario.operation.speed_rpm.constant() else {
        return Err(usage(
            "--measured: the scenario's speed is not constant, and defect frequencies are looked for at one speed; give --set \
             operation.speed_rpm=RPM"
                .into(),
        ));
    };
    let axis = match args.axis.as_deref() {
        Some("x") => 0,
        Some("y") => 1,
        None => scenario.operation.axis_of_load(),
        Some(other) => return Err(usage(format!("--axis {other}: expected x or y"))),
    };
    let channel = SENSOR[axis];
    let mut measured = load(file, &args.signal.wanted())?;
    let name = measured.path.display().to_string();
    if measured.unit.quantity != Dimension::Acceleration {
        return Err(usage(format!(
            "{name}: `{}` is in {}; a calibration takes accelerations: give --unit m/s^2 or --unit g",
            measured.channel, measured.unit.name
        )));
    }
    let rate = simulation.sample_rate();
    if (measured.rate / rate - 1.0).abs() > 1e-6 {
        return Err(usage(format!(
            "{name} is sampled at {} Hz, and the scenario at {rate} Hz; levels are compared at one rate: give --set \
             simulation.sample_rate_hz={:?}",
            measured.rate, measured.rate
        )));
    }
    let factor = measured.unit.to_si;
    measured.x.iter_mut().for_each(|v| *v *= factor);
    let turns = rpm.abs() / 60.0;
    targets(scenario, simulation, &measured, (axis, channel), turns, share).map(Some)
}

fn targets(
    scenario: &Scenario,
    simulation: &Simulation,
    measured: &Measured,
    (axis, channel): (usize, &'static str),
    shaft: f64,
    share: f64,
) -> Result<Pattern, Failure> {
    let rate = measured.rate;
    let failed = |error: brinell::signal::SignalError| usage(format!("{}: {error}", measured.path.display()));
    let model = simulation.model();
    let kinematics = model.kinematics(model.rotation.at(0.0).0);
    let lines = lines(scenario, &kinematics);
    // Runs are analysed from half-way on at the latest.
    let simulated = simulation.samples() as usize / 2;
    let highest = lines.iter().map(|l| l.1).fold(0.0, f64::max);
    let band = Band::between((10.0 * highest).clamp(0.02 * rate, 0.1 * rate), 0.4 * rate);
    let signature = Signature::new(rate, simulated.min(measured.x.len()), band, &lines).map_err(failed)?;
    let level = decibels(share);
    let mut targets: Vec<Target> = signature
        .of(&measured.x)
        .map_err(failed)?
        .into_iter()
        .map(|l| Target { name: l.name, value: l.decibels, uncertainty: l.uncertainty.hypot(level) })
        .collect();
    let blocks = Blocks::of(&measured.x, rate / shaft);
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
        let (_, nominal) = kinematics.defect_frequency(defect.on);
        let enough = ANALYSED * simulation.samples() as f64 / rate * nominal >= PERIODS;
        if nominal <= 0.0 || nominal >= 0.4 * rate || !enough {
            continue;
        }
        if let Some(line) = line_frequency(&measured.x, rate, band, &LineSearch::new(nominal)) {
            targets.push(Target {
                name: format!("defect{}.frequency", k + 1),
                value: line.frequency,
                uncertainty: line.uncertainty,
            });
        }
    }
    let mut notes = vec![format!(
        "{}, channel {}: {} samples from {:.4} s on, against {channel}",
        measured.path.display(),
        measured.channel,
        measured.x.len(),
        measured.start
    )];
    notes.extend(measured.notes.iter().cloned());
    Ok(Pattern { signature, axis, channel, targets, notes, warnings: measured.warnings.clone() })
}

/// The defect frequencies, Hz, each once, by the names that levels have.
fn lines(scenario: &Scenario, kinematics: &Kinematics) -> Vec<(&'static str, f64)> {
    let mut lines: Vec<(&'static str, f64)> = Vec::new();
    for defect in &scenario.defects {
        let (name, frequency) = kinematics.defect_frequency(defect.on);
        let name = match name {
            "BPFO" => "bpfo",
            "BPFI" => "bpfi",
            _ => "2bsf",
        };
        if frequency > 0.0 && !lines.iter().any(|l| l.0 == name) {
            lines.push((name, frequency));
        }
    }
    lines
}

impl Pattern {
    /// The levels of a run's signal as numbers of its row.
    pub(super) fn quantities(&self, x: &[f64]) -> Vec<Quantity> {
        // A run too short for a signature has none, and its row says so by their absence.
        let levels = self.signature.of(x).unwrap_or_default();
        let one = |l: brinell_study::calibrate::signature::Level| Quantity {
            name: l.name,
            unit: "dB".into(),
            value: Some(l.decibels),
            spread: Spread::Interval(Interval::normal(l.decibels, l.uncertainty)),
        };
        levels.into_iter().map(one).collect()
    }
}
