//! The scenario that `brinell init` starts from: the NN3007 with the rectangle defect.

use super::alone::write;
use super::load::read;
use super::problem::Problem;
use super::provenance::by_key;
use super::writer::Style;
use crate::scenario::Scenario;

/// What such a scenario must give; everything else has a default.
const SHORTEST: &str = r#"
name = "nn3007-rectangle"
[bearing]
preset = "NN3007"
[operation]
speed_rpm = 1800.0
load_n = [300.0, 0.0]
[[defects]]
on = "outer-raceway"
row = 1
center_deg = 0.0
depth_um = 20.0
shape = { rectangle = { length_mm = 3.0, width_mm = 4.0 } }
[simulation]
duration_s = 0.5
sample_rate_hz = 25600.0
"#;

const HEAD: &str = "\
# A brinell scenario: one file is the whole truth of a run.
# Lines without a leading # are live. The others show what holds if they are left out; remove the # to change one.
# Every key carries its unit in its name. Values marked `assumed` are guesses, and the results list them as such.

";

/// A commented scenario to edit, which reads without problems.
pub fn template() -> String {
    explained(SHORTEST).expect("the example reads: a test holds it to that")
}

/// A scenario file with every key in it, explained: those that the text leaves out are comments that show what holds
/// then.
///
/// # Errors
/// Every problem of the text.
pub fn explained(text: &str) -> Result<String, Vec<Problem>> {
    let loaded = read(text, &[])?;
    if loaded.scenario.machine.is_some() {
        let message =
            "only the file of one bearing is written with every key explained; a machine's schema explains its keys";
        return Err(vec![Problem::error("shaft", message)]);
    }
    let style = Style { provenance: by_key(&loaded.provenance), template: true };
    Ok(HEAD.to_string() + &write(&loaded.scenario, style))
}

impl Scenario {
    /// The NN3007 with the paper's rectangle defect, 3 x 4 mm on the outer raceway.
    pub fn example() -> Scenario {
        let example = read(SHORTEST, &[]).expect("the example reads: a test holds it to that");
        example.scenario
    }
}
