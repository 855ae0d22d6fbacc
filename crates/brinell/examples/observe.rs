//! An observer of one's own, which keeps what no result has and ends the run early:
//!
//!     cargo run --release -p brinell --example observe -- examples/rectangle.toml

use brinell::channel::{self, Channel, Frame};
use brinell::result::finish;
use brinell::simulate::{End, Simulation};
use brinell::{Observer, Scenario};
use std::error::Error;
use std::ops::ControlFlow;

/// The largest force at the outer contact of each roller.
struct Largest {
    contacts: Vec<Channel>,
    forces: Vec<f64>,
    /// Place of sensor_ax in a row, and its largest value, m/s^2.
    sensor: usize,
    peak: f64,
    /// Rows that are enough.
    enough: u64,
}

impl Observer for Largest {
    /// A frame holds the whole state: any channel can be read from it, recorded or not.
    fn sample(&mut self, _: u64, frame: &Frame) {
        for (largest, contact) in self.forces.iter_mut().zip(&self.contacts) {
            *largest = largest.max(contact.value(frame));
        }
    }

    /// A row holds the recorded channels, in the order of `Simulation::channels`.
    fn row(&mut self, index: u64, row: &[f64], _: &[f64]) -> ControlFlow<()> {
        self.peak = self.peak.max(row[self.sensor].abs());
        if index < self.enough { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1);
    let path = path.as_deref().unwrap_or("examples/rectangle.toml");
    let scenario = Scenario::from_toml(&std::fs::read_to_string(path)?)?;
    let simulation = Simulation::new(&scenario)?;

    let mut contacts = channel::all(simulation.model(), &scenario.sensor);
    contacts.retain(|c| c.name.starts_with("contact") && c.name.ends_with("_outer_force"));
    let sensor = simulation.channels().iter().position(|c| c.name == "sensor_ax");
    let sensor = sensor.ok_or("sensor_ax is not recorded")?;
    let enough = (0.2 * simulation.sample_rate()) as u64;
    let mut largest = Largest { forces: vec![0.0; contacts.len()], contacts, sensor, peak: 0.0, enough };

    // `simulate_with` gives no result of a run that its observer ended; `finish` does.
    let result = finish(scenario, simulation, &mut largest);
    match &result.outcome.end {
        End::Failed(error) => return Err(error.to_string().into()),
        End::Complete | End::Stopped => println!("{} s", result.outcome.reached),
    }
    let loaded = largest.contacts.iter().zip(&largest.forces).filter(|(_, force)| **force > 60.0);
    loaded.for_each(|(contact, force)| println!("{}: at most {force:.1} {}", contact.name, contact.unit));
    println!("sensor_ax: at most {:.1} m/s^2", largest.peak);
    println!("sensor_ax.rms: {:?} m/s^2", result.quantity("sensor_ax.rms").and_then(|q| q.value));
    Ok(())
}
