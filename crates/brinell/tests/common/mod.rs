//! Helpers that several test programs share.
#![allow(dead_code, unreachable_pub, reason = "each test program uses its own part")]

pub mod cases;
#[path = "../../../brinell-signal/tests/common/counting.rs"]
pub mod counting;

use brinell::document::{Loaded, Problem, read};
use brinell::model::Model;
use brinell::plausibility::before;
use brinell::scenario::Scenario;
use brinell::simulate::{End, Outcome, Signals, Simulation};
use brinell::statics::static_load_zone;

/// A scenario under the laws of Li et al. 2023 where its text names no set: for what is about those laws, or was recorded under them.
pub fn read_li2023(text: &str, overrides: &[(String, String)]) -> Result<Loaded, Vec<Problem>> {
    let mut overrides = overrides.to_vec();
    if !text.contains("laws =") && !overrides.iter().any(|(key, _)| key == "simulation.laws") {
        overrides.push(("simulation.laws".into(), "li2023".into()));
    }
    read(text, &overrides)
}

/// The same of a valid text.
pub fn li2023(text: &str) -> Scenario {
    read_li2023(text, &[]).unwrap_or_else(|problems| panic!("{problems:?}")).scenario
}

/// The scenario of `Scenario::example`, the NN3007 with the rectangle, under the paper's laws.
pub fn example() -> Scenario {
    rectangle_with(&[("name", "nn3007-rectangle")]).scenario
}

/// The rectangle of `examples/`, half a second long.
const RECTANGLE: &str = "\
[bearing]
preset = \"NN3007\"
[operation]
speed_rpm = 1800.0
load_n = [300.0, 0.0]
[[defects]]
on = \"outer-raceway\"
center_deg = 0.0
depth_um = 20.0
shape = { rectangle = { length_mm = 3.0, width_mm = 4.0 } }
[simulation]
duration_s = 0.5
";

/// The rectangle of `examples/` with settings over it, by the paper's laws unless they say otherwise.
pub fn rectangle_with(settings: &[(&str, &str)]) -> Loaded {
    let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    read_li2023(RECTANGLE, &settings).unwrap_or_else(|problems| panic!("{settings:?}: {problems:?}"))
}

/// What is said of a scenario beforehand.
pub fn warnings(s: &Scenario) -> Vec<String> {
    let model = Model::new(s).unwrap();
    let told = before(s, &model, &static_load_zone(&model));
    told.iter().map(ToString::to_string).collect()
}

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
