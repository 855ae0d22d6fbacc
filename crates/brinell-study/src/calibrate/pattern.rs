//! A measured signal as targets: its levels, RMS and kurtosis, the defects' frequencies where they are significant, and how far apart the events of a pass are where that is clear.

use super::signature::{Level, Signature, decibels};
use super::spacing::{Spacing, is_spacing};
use super::{CalibrateError, Key, Target};
use brinell::analysis::{Quantity as Dimension, Unit};
use brinell::bearing::Kinematics;
use brinell::channel::SENSOR;
use brinell::result::{Quantity, Spread};
use brinell::scenario::{Scenario, Surface};
use brinell::signal::{
    Band, Blocks, FEWEST_PERIODS, Indicator, Interval, LineSearch, SignalError, line_frequency, mean_rate_uncertainty,
};
use brinell::simulate::Simulation;
use std::f64::consts::TAU;

/// Share of a run that its statistics are of, at most.
const ANALYSED: f64 = 0.75;
/// The key whose bounds move every line.
const SPEED: &str = "operation.speed_rpm";
/// Lines of parts of one bearing are apart as in pure rolling, but for slip: relative.
const ONE_SPEED: f64 = 0.01;
/// So far beyond the range in which a line is sought none may be higher: relative.
const BEYOND: f64 = 0.04;
/// The bounds of a fitted speed count so far from the speed that is expected, relative: no frequency lies with 4/3 of itself
/// in so narrow a range, where a comb would be taken for its multiple.
const WIDEST: f64 = 0.14;

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
    spacings: Vec<Spacing>,
    /// Which of the filtered channels represents the sensor.
    pub(super) axis: usize,
    /// Its name.
    pub channel: String,
    /// What the measured signal says.
    pub targets: Vec<Target>,
    /// What was read, in sentences.
    pub notes: Vec<String>,
}

impl Pattern {
    /// Of a signal, for runs of a scenario, that of the middle of the bounds of `keys`. The signal's lines are sought
    /// about the speed that `own` states, the scenario before anything is fitted, or about the middle of the bounds of
    /// the speed where that is outside; over the bounds as far as [`WIDEST`] from there. `axis` is the sensor's, x or y;
    /// without one the one nearer the load.
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
        let bounds = keys.iter().find(|key| key.name == SPEED).map(|key| [key.low / rpm, key.high / rpm]);
        let within = |own: &f64| bounds.is_none_or(|[low, high]| (low.min(high)..=low.max(high)).contains(own));
        let own = own.operation.speed_rpm.constant().map(|own| own / rpm).filter(within);
        targets((scenario, simulation), (x, measured.rate), axis, Speeds { own, bounds }, share)
    }

    /// The same with the spacing of events alone, which the way from the bearing to the sensor does not change.
    ///
    /// # Errors
    /// Where none is clear.
    pub fn events_only(mut self) -> Result<Self, CalibrateError> {
        self.targets.retain(|target| is_spacing(&target.name));
        match self.targets.is_empty() {
            true => Err(CalibrateError::NoEvents(self.notes.join("; "))),
            false => Ok(self),
        }
    }

    /// The levels of a run's signal, and the spacing of its events, as numbers of its row.
    pub(super) fn quantities(&self, x: &[f64], simulation: &Simulation) -> Vec<Quantity> {
        // A run too short for a signature has none, and its row says so by their absence.
        let levels = self.signature.of(x).unwrap_or_default();
        let one = |l: Level| Quantity {
            name: l.name,
            unit: "dB".into(),
            value: Some(l.decibels),
            spread: Spread::Interval(Interval::normal(l.decibels, l.uncertainty)),
        };
        let (model, rate) = (simulation.model(), simulation.sample_rate());
        let kinematics = model.kinematics(model.rotation.at(0.0).0);
        let spacing = |s: &Spacing| s.quantity(x, rate, kinematics.defect_frequency(s.on).1);
        levels.into_iter().map(one).chain(self.spacings.iter().map(spacing)).collect()
    }

    /// Everything that the levels of a run depend on beside its scenario, as text.
    pub(super) fn describe(&self) -> String {
        format!("{} {} {:?}", self.channel, self.signature.describe(), self.spacings)
    }
}

/// Speeds that the signal's may be, over the scenario's.
struct Speeds {
    /// As it is stated, where that is within the bounds.
    own: Option<f64>,
    /// Where it is fitted.
    bounds: Option<[f64; 2]>,
}

impl Speeds {
    fn expected(&self) -> f64 {
        self.own.unwrap_or(1.0)
    }

    /// From and to which speed lines are sought.
    fn range(&self) -> [f64; 2] {
        let expected = self.expected();
        let [low, high] = self.bounds.unwrap_or([expected; 2]);
        [low.min(high).max(expected * (1.0 - WIDEST)), low.max(high).min(expected * (1.0 + WIDEST))]
    }
}

fn targets(
    (scenario, simulation): (&Scenario, &Simulation),
    (x, rate): (&[f64], f64),
    axis: usize,
    speeds: Speeds,
    share: f64,
) -> Result<Pattern, CalibrateError> {
    // A machine's accelerometers have an axis each.
    let (axis, channel) = match scenario.machine {
        None => (axis, SENSOR[axis].to_owned()),
        Some(_) => {
            let shown = scenario.shown_channel();
            (simulation.filtered().iter().position(|c| c.name == shown).unwrap_or(0), shown)
        }
    };
    let model = simulation.model();
    let (speed, _) = model.rotation.at(0.0);
    let kinematics = model.kinematics(speed);
    let mut lines = lines(scenario, &kinematics);
    let highest = lines.iter().map(|l| l.1).fold(0.0, f64::max);
    let band = Band::between((10.0 * highest).clamp(0.02 * rate, 0.1 * rate), 0.4 * rate);
    // Runs are analysed from half-way on at the latest.
    let analysed = (ANALYSED * simulation.samples() as f64) as usize;
    let (found, mut notes) = combs((x, rate, band), &lines, speeds.range(), analysed)?;
    // Where the speed is not known the signal's lines tell it, but for slip.
    let told = nearest(&found);
    let turning = speeds.bounds.and(told).unwrap_or(speeds.expected());
    for (_, frequency) in &mut lines {
        *frequency *= turning;
    }
    let simulated = simulation.samples() as usize / 2;
    let signature = Signature::new(rate, simulated.min(x.len()), band, &lines)?;
    let level = decibels(share);
    let mut targets: Vec<Target> = signature
        .of(x)?
        .into_iter()
        .map(|l| Target { name: l.name, value: l.decibels, uncertainty: l.uncertainty.hypot(level) })
        .collect();
    let blocks = Blocks::of(x, TAU * rate / (speed * turning).abs());
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
        if let Some(&(_, _, value, uncertainty)) = found.iter().find(|f| f.0 == name) {
            targets.push(Target { name: format!("defect{}.frequency", k + 1), value, uncertainty });
        }
    }
    let mut spacings = Vec::new();
    for &(name, _, frequency, _) in &found {
        let damaged = scenario.defects.iter().map(|defect| defect.on).find(|on| line_name(&kinematics, *on) == name);
        let spacing = damaged.and_then(|on| Spacing::new(scenario, on, (name, frequency)));
        match spacing.as_ref().and_then(|spacing| spacing.target(x, rate, frequency)) {
            Some(target) => {
                targets.push(target);
                spacings.extend(spacing);
            }
            None => notes.push(format!(
                "no second event is clear beside the one of each pass at {}: the signal says nothing of the damage's length by it",
                name.to_uppercase()
            )),
        }
    }
    Ok(Pattern { signature, spacings, axis, channel, targets, notes })
}

/// A comb of lines found: name, over pure rolling, Hz, and standard uncertainty of its mean, Hz.
type Found = (&'static str, f64, f64, f64);

/// Of the combs found the one nearest pure rolling, over that.
fn nearest(found: &[Found]) -> Option<f64> {
    found.iter().map(|f| f.1).min_by(|a, b| (a - 1.0).abs().total_cmp(&(b - 1.0).abs()))
}

/// The combs of lines at defect frequencies (Hz, of the scenario's speed) in a signal, its rate and band, from and to these
/// speeds over the scenario's; and what is to be said of them. Runs have `analysed` samples to find theirs in.
fn combs(
    (x, rate, band): (&[f64], f64, Band),
    lines: &[(&'static str, f64)],
    [from, to]: [f64; 2],
    analysed: usize,
) -> Result<(Vec<Found>, Vec<String>), SignalError> {
    let (mut notes, mut found) = (Vec::new(), Vec::<Found>::new());
    for &(name, nominal) in lines {
        let usual = LineSearch::new(nominal);
        let upper = name.to_uppercase();
        if !usual.fits(analysed.min(x.len()), rate) {
            notes.push(format!(
                "{upper} is not looked for: signal and runs have to hold {FEWEST_PERIODS} periods of it"
            ));
            continue;
        }
        let range = |reach: f64| [nominal * from * (1.0 - reach), nominal * to * (1.0 + reach)];
        let comb = |reach: f64| {
            let [low, high] = range(reach);
            let search = LineSearch { nominal: 0.5 * (low + high), tolerance: (high - low) / (high + low), ..usual };
            line_frequency(x, rate, band, &search)
        };
        let [low, high] = range(usual.tolerance);
        let place = format!("from {low:.1} to {high:.1} Hz, where the speed has it: is {SPEED} right?");
        let Some(line) = comb(usual.tolerance) else {
            notes.push(format!("no line of {upper} {place}"));
            continue;
        };
        // On the skirt of higher lines, or beside them, is no line of its own.
        let beyond = comb(usual.tolerance + BEYOND);
        if let Some(other) = beyond.filter(|other| (other.frequency - line.frequency).abs() > line.resolution) {
            notes.push(format!("lines at {:.2} Hz are higher than any of {upper} {place}", other.frequency));
            continue;
        }
        let uncertainty = mean_rate_uncertainty(x, rate, band, &line)?;
        found.push((name, line.frequency / nominal, line.frequency, uncertainty));
    }
    // The one nearest pure rolling says where the others are: what is not there is another line.
    let nearest = nearest(&found);
    found.retain(|(name, ratio, frequency, _)| {
        let stays = nearest.is_some_and(|nearest| (ratio / nearest - 1.0).abs() < ONE_SPEED);
        if !stays {
            let upper = name.to_uppercase();
            notes.push(format!("the line at {frequency:.2} Hz is left out: {upper} is not so far from the others"));
        }
        stays
    });
    Ok((found, notes))
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

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: f64 = 25600.0;

    /// A second of impacts at `frequency`.
    fn impacts(frequency: f64) -> Vec<f64> {
        let impact = |t: f64| (-t / 6e-4).exp() * (TAU * 4000.0 * t).sin();
        (0..25600)
            .map(|k| impact((f64::from(k) / RATE).rem_euclid(1.0 / frequency)) + 1e-2 * (f64::from(k * k) * 0.37).sin())
            .collect()
    }

    /// BPFO of 250 Hz at the scenario's speed, impacts elsewhere.
    #[test]
    fn prop_lines_are_sought_over_the_bounds_of_the_speed_and_not_beside_higher_ones() {
        let look = |frequency: f64, own, bounds| {
            let (x, band) = (impacts(frequency), Band::between(2500.0, 10000.0));
            combs((&x, RATE, band), &[("bpfo", 250.0)], Speeds { own, bounds }.range(), 20000).unwrap()
        };
        let (at, wide) = (Some(1.0), Some([0.5, 3.0]));
        for (frequency, own, bounds) in [
            (252.0, at, None),
            (243.0, at, Some([0.97, 1.03])),
            (259.0, None, Some([0.97, 1.03])),
            // Twice and half of it lie within the bounds.
            (249.0, at, wide),
            (233.0, at, wide),
        ] {
            let (found, notes) = look(frequency, own, bounds);
            assert!(notes.is_empty(), "{notes:?}");
            let (_, ratio, line, uncertainty) = found[0];
            assert!((line - frequency).abs() < 0.05 && (ratio - line / 250.0).abs() < 1e-12, "{frequency}: {line}");
            assert!(uncertainty < 0.1, "{frequency}: {uncertainty}");
        }
        for (frequency, own, bounds) in [(243.0, at, None), (239.0, at, None), (264.0, at, Some([0.98, 1.02]))] {
            let (found, notes) = look(frequency, own, bounds);
            assert!(found.is_empty(), "{frequency}: {found:?}");
            assert!(notes[0].contains("is operation.speed_rpm right?"), "{notes:?}");
        }
    }
}
