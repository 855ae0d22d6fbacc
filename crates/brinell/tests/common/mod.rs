//! Helpers that several test programs share.
#![allow(dead_code, unreachable_pub, reason = "each test program uses its own part")]

pub mod cases;
#[path = "../../../brinell-signal/tests/common/counting.rs"]
pub mod counting;

use brinell::scenario::Scenario;
use brinell::simulate::{End, Outcome, Signals, Simulation};

/// Named columns.
pub struct Rows {
    pub names: Vec<String>,
    pub data: Vec<Vec<f64>>,
}

impl Rows {
    pub fn column(&self, name: &str) -> &[f64] {
        let k = self.names.iter().position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
        &self.data[k]
    }
}

/// Parses a CSV of numbers with a header line.
pub fn columns(text: &str) -> Rows {
    let mut lines = text.lines();
    let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let mut data = vec![Vec::new(); names.len()];
    for line in lines {
        for (column, value) in data.iter_mut().zip(line.split(',')) {
            column.push(value.parse().unwrap());
        }
    }
    Rows { names, data }
}

/// Runs a scenario and keeps its rows; panics where the run does not complete.
pub fn simulate(scenario: &Scenario) -> (Rows, Outcome) {
    let simulation = Simulation::new(scenario).unwrap();
    let mut signals = Signals::new(&simulation).unwrap();
    let outcome = simulation.run(&mut signals);
    assert_eq!(outcome.end, End::Complete);
    let (names, data) = signals.into_iter().unzip();
    (Rows { names, data }, outcome)
}

/// The rows alone.
pub fn simulate_rows(scenario: &Scenario) -> Rows {
    simulate(scenario).0
}
