//! What the benches share: the paper's rectangle, and states along its run.
#![allow(dead_code, unreachable_pub, reason = "each bench uses its own part")]

use brinell::accuracy::settings;
use brinell::model::{Model, Motion};
use brinell::scenario::{Accuracy, Scenario};
use brinell::solver::Stepper;
use criterion::Criterion;
use std::path::Path;
use std::time::Duration;

/// `examples/rectangle.toml` with the paper's laws.
pub fn rectangle() -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/rectangle.toml");
    let text = std::fs::read_to_string(path).expect("the example is there");
    let laws = ("simulation.laws".to_owned(), "li2023".to_owned());
    brinell::document::read(&text, &[laws]).expect("the example is sound").scenario
}

/// A time and the state there.
pub type Moment = (f64, Vec<f64>);

/// The first moments after 50 ms with no roller on damage, and with one.
pub fn off_and_on_damage(model: &Model) -> [Moment; 2] {
    let mut motion = Motion::new(model);
    let y = brinell::start::state(model).expect("a start");
    let settings = settings(model, Accuracy::Standard);
    let mut stepper = Stepper::new(&mut motion, settings, 0.0, &y);
    let mut found: [Option<Moment>; 2] = [None, None];
    while found.iter().any(Option::is_none) && stepper.t() < 0.5 {
        stepper.step(&mut motion).expect("a step");
        let on = motion.ws.contacts.iter().any(|c| c.on_damage.iter().any(|on| *on));
        let place = &mut found[usize::from(on)];
        if stepper.t() > 0.05 && place.is_none() {
            *place = Some((stepper.t(), stepper.y().to_vec()));
        }
    }
    found.map(|moment| moment.expect("damage that rollers pass"))
}

/// Moments along a run, from 50 to 80 ms.
pub fn moments(model: &Model) -> Vec<Moment> {
    const SPACING_S: f64 = 1e-3;
    let mut motion = Motion::new(model);
    let y = brinell::start::state(model).expect("a start");
    let settings = settings(model, Accuracy::Standard);
    let mut stepper = Stepper::new(&mut motion, settings, 0.0, &y);
    let mut moments = Vec::new();
    while stepper.t() < 0.08 {
        stepper.step(&mut motion).expect("a step");
        if stepper.t() >= 0.05 + SPACING_S * moments.len() as f64 {
            moments.push((stepper.t(), stepper.y().to_vec()));
        }
    }
    moments
}

/// Short measurements: these runs are long beside the clock.
pub fn criterion() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2))
        .configure_from_args()
}
