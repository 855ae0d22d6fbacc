//! Plans of data sets.

use brinell::document::Problem;
use brinell_study::design::{Draws, Plan};

mod drawing;
mod held_out;
mod histories;
mod refusals;
mod splits;

const BASE: &str = r#"name = "base"
[bearing]
preset = "NU206"
[operation]
speed_rpm = 1500.0
load_n = [300.0, 0.0]
[simulation]
laws = "li2023"
duration_s = 0.02
"#;

const PLAN: &str = r#"base = "base.toml"
runs = 60
seed = 5

[vary]
operation.speed_rpm = { uniform = [1000, 3000] }
operation.load_n = [{ normal = [500, 100], within = [300, 700] }, 0.0]

[[classes]]
name = "healthy"
defects = []

[[classes]]
name = "outer"
share = 2
[[classes.defects]]
on = "outer-raceway"
depth_um = { log = [1, 100] }
shape.random = { length_mm = { uniform = [0.5, 4] }, width_mm = 3 }
"#;

/// Of plans that hold labels out.
const SECRET: &str = "secret = \"9f86d081884c7d659a2feaa0c55ad015\"";

fn draws(plan: &str) -> Draws {
    Draws::new(Plan::read(plan).unwrap_or_else(|p| panic!("{p:?}"))).unwrap_or_else(|p| panic!("{p:?}"))
}

fn refusals(plan: &str) -> Vec<String> {
    let problems: Vec<Problem> = match Plan::read(plan) {
        Ok(plan) => Draws::new(plan).err().expect("the plan is bad"),
        Err(problems) => problems,
    };
    problems.iter().map(ToString::to_string).collect()
}

fn number(draws: &Draws, run: usize, key: &str) -> Option<f64> {
    let mut parameters = draws.parameters().iter();
    let k = parameters.position(|p| p.key == key).unwrap();
    draws.first(BASE, run).unwrap().values[k].as_ref()?.number
}

fn numbers(draws: &Draws, key: &str) -> Vec<f64> {
    let value = |run| number(draws, run, key);
    (0..draws.runs()).filter_map(value).collect()
}
