//! Scenario files: reading, writing, and everything that can be wrong with them.

mod bad_input;
mod balls;
mod clearance;
mod defaults;
mod json;
mod laws;
mod limits;
mod machine;
mod quantities;
mod recorded;
mod robust;
mod tilting;

use brinell::document::{Loaded, Problem, read};

const OUTER: &str = include_str!("../reference/outer-rectangle.toml");
const INNER: &str = include_str!("../reference/inner-defect-gravity.toml");

/// A bearing of the user's own, with nothing that has a default.
const BARE: &str = "\
[bearing]
inner_raceway_diameter_mm = 43.0
outer_raceway_diameter_mm = 55.0
roller_diameter_mm = 6.0
roller_length_mm = 6.0
rollers_per_row = 19
[operation]
speed_rpm = 1800.0
load_n = [300.0, 0.0]
";

/// The paper's laws, for what is theirs alone.
const LI2023: (&str, &str) = ("simulation.laws", "li2023");

fn good(text: &str) -> Loaded {
    read(text, &[]).unwrap_or_else(|problems| panic!("{}", report(&problems)))
}

fn with(text: &str, overrides: &[(&str, &str)]) -> Result<Loaded, Vec<Problem>> {
    let overrides: Vec<(String, String)> =
        overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    read(text, &overrides)
}

fn report(problems: &[Problem]) -> String {
    problems.iter().map(|problem| format!("{problem}\n")).collect()
}

/// Overrides over `text` that are refused: a problem of `key` says `words`.
fn refused(text: &str, overrides: &[(&str, &str)], key: &str, words: &str) {
    let problems = with(text, overrides).expect_err(key);
    let found = problems.iter().any(|p| p.key == key && p.to_string().contains(words));
    assert!(found, "{key}, {words}: {}", report(&problems));
}
