//! Helpers that several test programs share.
#![allow(
    dead_code,
    unreachable_pub,
    reason = "each test program uses its own part"
)]

pub mod cases;
#[path = "../../../brinell-signal/tests/common/counting.rs"]
pub mod counting;

use brinell::scenario::Scenario;
use brinell::simulate::{End, Observer, Outcome, Simulation};
use std::ops::ControlFlow;

/// Named columns.
pub struct Rows {
    pub names: Vec<String>,
    pub data: Vec<Vec<f64>>,
}

impl Rows {
    pub fn column(&self, name: &str) -> &[f64] {
        let k = self
            .names
            .iter()
            .position(|n| n == name)
            .unwrap_or_else(|| panic!("no column {name}"));
        &self.data[k]
    }
}

/// Parses a CSV of numbers with a header line.
pub fn columns(text: &str) -> Rows {
    let mut lines = text.lines();
    let names: Vec<String> = lines
        .next()
        .unwrap()
        .split(',')
        .map(str::to_owned)
        .collect();
    let mut data = vec![Vec::new(); names.len()];
    for line in lines {
        for (column, value) in data.iter_mut().zip(line.split(',')) {
            column.push(value.parse().unwrap());
        }
    }
    Rows { names, data }
}

struct Keep {
    rate: f64,
    data: Vec<Vec<f64>>,
}

impl Observer for Keep {
    fn row(&mut self, index: u64, row: &[f64], _: &[f64]) -> ControlFlow<()> {
        self.data[0].push(index as f64 / self.rate);
        for (column, value) in self.data[1..].iter_mut().zip(row) {
            column.push(*value);
        }
        ControlFlow::Continue(())
    }
}

/// Runs a scenario and keeps its rows; panics where the run does not complete.
pub fn simulate(scenario: &Scenario) -> (Rows, Outcome) {
    let simulation = Simulation::new(scenario).unwrap();
    let names: Vec<String> = std::iter::once("t".to_owned())
        .chain(simulation.channels().iter().map(|c| c.name.clone()))
        .collect();
    let mut keep = Keep {
        rate: simulation.sample_rate(),
        data: vec![Vec::new(); names.len()],
    };
    let outcome = simulation.run(&mut keep);
    assert_eq!(outcome.end, End::Complete);
    (
        Rows {
            names,
            data: keep.data,
        },
        outcome,
    )
}

/// The rows alone.
pub fn simulate_rows(scenario: &Scenario) -> Rows {
    simulate(scenario).0
}
