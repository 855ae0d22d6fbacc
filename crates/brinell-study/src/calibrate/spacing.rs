//! The spacing of the two events that elements make in damage, of a measured signal and of runs alike: what the damage's length follows from.
//!
//! It is a time, so that it does not depend on the way from the bearing to the sensor, as levels do: its uncertainty is its own.

use super::Target;
use brinell::edge::{inset, shortest_event, way_between_passes};
use brinell::result::{Quantity, Spread};
use brinell::scenario::{Scenario, Surface};
use brinell::signal::{EventSpacing, Interval, event_spacing};

/// What a spacing of the model may differ by from a machine's, relative: those of simulated runs are so far from the line through them over length and width.
const MODEL: f64 = 0.03;
const NAME: &str = "signature.event_spacing_";

/// Whether a target is one of these.
pub(super) fn is_spacing(name: &str) -> bool {
    name.starts_with(NAME)
}

/// How the events of one surface's damage are looked for.
#[derive(Debug, Clone)]
pub(super) struct Spacing {
    name: String,
    pub(super) on: Surface,
    /// How short an event is, s: the same for all runs and the measured signal.
    shortest: f64,
}

impl Spacing {
    /// Of damage that elements pass `frequency` times a second, a line called `line`; none where the scenario has no static balance.
    pub(super) fn new(scenario: &Scenario, on: Surface, (line, frequency): (&str, f64)) -> Option<Self> {
        let speed = frequency * way_between_passes(&scenario.bearing, 0.0, on);
        Some(Self { name: format!("{NAME}{line}"), on, shortest: shortest_event(inset(scenario, on).ok()?, speed) })
    }

    /// The spacing where it is clear.
    fn find(&self, x: &[f64], rate: f64, frequency: f64) -> Option<EventSpacing> {
        let found = event_spacing(x, rate, (1.0 / frequency, self.shortest), None).ok()??;
        found.is_clear().then_some(found)
    }

    /// What a measured signal says.
    pub(super) fn target(&self, x: &[f64], rate: f64, frequency: f64) -> Option<Target> {
        let EventSpacing { seconds, uncertainty, .. } = self.find(x, rate, frequency)?;
        let uncertainty = uncertainty.hypot(1.0 / rate).hypot(MODEL * seconds);
        Some(Target { name: self.name.clone(), value: seconds, uncertainty })
    }

    /// What a run says.
    pub(super) fn quantity(&self, x: &[f64], rate: f64, frequency: f64) -> Quantity {
        let found = self.find(x, rate, frequency);
        Quantity {
            name: self.name.clone(),
            unit: "s".into(),
            value: found.map(|found| found.seconds),
            spread: found.map_or(Spread::Unknown, |f| Spread::Interval(Interval::normal(f.seconds, f.uncertainty))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brinell::document;
    use std::f64::consts::TAU;

    const RATE: f64 = 25_600.0;
    const FREQUENCY: f64 = 107.0;

    /// A second of passes, each with an event that rings at 3.1 kHz at these instants after its begin.
    fn passes(events: &[f64]) -> Vec<f64> {
        let ring = |t: f64| if t < 0.0 { 0.0 } else { (-t / 6e-4).exp() * (TAU * 3100.0 * t).sin() };
        let one = |k: u32| {
            let t = (f64::from(k) / RATE).rem_euclid(1.0 / FREQUENCY);
            events.iter().map(|at| ring(t - at)).sum::<f64>() + 0.03 * (f64::from(k * k) * 0.37).sin()
        };
        (0..25_600).map(one).collect()
    }

    #[test]
    fn analytic_the_spacing_of_events_is_the_same_of_a_signal_and_of_a_run_and_none_of_single_events() {
        let text = "[bearing]\npreset = \"6205\"\n[operation]\nspeed_rpm = 1797\nload_n = [0, -500]\n";
        let scenario = document::read(text, &[]).unwrap().scenario;
        let spacing = Spacing::new(&scenario, Surface::OuterRaceway, ("bpfo", FREQUENCY)).unwrap();
        for apart in [0.9e-3, 2.0e-3] {
            let x = passes(&[1e-3, 1e-3 + apart]);
            let target = spacing.target(&x, RATE, FREQUENCY).unwrap();
            assert!((target.value / apart - 1.0).abs() < 0.02, "{apart}: {target:?}");
            let least = (MODEL * apart).hypot(1.0 / RATE);
            assert!((0.98 * least..1.2 * least).contains(&target.uncertainty), "{target:?}");
            let run = spacing.quantity(&x, RATE, 1.002 * FREQUENCY);
            assert_eq!(run.name, target.name);
            assert!((run.value.unwrap() / target.value - 1.0).abs() < 1e-3, "{run:?}");
        }
        let single = passes(&[1e-3]);
        assert_eq!(spacing.target(&single, RATE, FREQUENCY), None);
        assert_eq!(spacing.quantity(&single, RATE, FREQUENCY).value, None);
        // Too short a signal has none either.
        assert_eq!(spacing.target(&passes(&[1e-3, 2e-3])[..4000], RATE, FREQUENCY), None);
    }
}
