//! The solver's counted work stays what it was: a check of speed that no noise can move.
//!
//! `work.csv` holds steps, rejections and right-hand sides per simulated second, each the mean over all kernels that the recording
//! processor had and over starts that differ in the last digits, and how far apart those runs lay. Impacts amplify round-off, so runs
//! that differ in their last digit are different runs of the same process after some tens of milliseconds, and their
//! counts scatter: by the column `spread`, and no more on another processor.
//!
//! A change that moves the counts on purpose records them anew, and says why where it is committed:
//!
//!     BRINELL_RECORD=1 cargo test --release --test work -- --nocapture

mod common;

use brinell::accuracy::settings;
use brinell::model::{Kernel, Model, Motion, Workspace};
use brinell::scenario::{Accuracy, Scenario};
use brinell::simulate::{End, Observer, Simulation};
use brinell::solver::Stepper;
use common::cases::{case, healthy};
use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Simulated time of each count, s.
const DURATION_S: f64 = 0.4;
/// Relative size of the push that makes another start.
const PUSH: f64 = 1e-13;
/// Starts of each kernel when recording.
const STARTS: u32 = 5;
/// A run may lie this many times the recorded spread from the recorded mean. The spread is the standard deviation of 15 runs where three
/// kernels are there: one run in 10^4 of the same process lies beyond four, and the estimate itself may be off by a third.
const SPREADS: f64 = 6.0;
/// And this share of the mean, where the spread is smaller.
const SHARE: f64 = 0.01;

/// The counts' names, as in the file.
const COUNTS: [&str; 3] = ["steps", "rejections", "right_hand_sides"];

fn example(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(name)
        .with_extension("toml");
    let text = std::fs::read_to_string(path).unwrap();
    brinell::document::read(&text, &[]).unwrap().scenario
}

fn scenarios() -> Vec<(&'static str, Scenario)> {
    let mut reference = example("rectangle");
    reference.simulation.accuracy = Accuracy::Reference;
    vec![
        ("rectangle", example("rectangle")),
        ("rectangle-reference", reference),
        ("circle", example("circle")),
        ("irregular", example("irregular")),
        ("inner-race", example("inner-race")),
        ("roller", example("roller")),
        ("single-row", example("single-row")),
        ("healthy", healthy()),
        ("heavy", case("xval/heavy-load-profile")),
    ]
}

fn kernels() -> impl Iterator<Item = Kernel> {
    Kernel::ALL.into_iter().filter(|k| k.is_there())
}

/// Counts per simulated second.
fn counted(s: &Scenario, kernel: Kernel, start: u32) -> [f64; 3] {
    let model = Model::new(s).unwrap();
    let mut y = brinell::start::state(&model).unwrap();
    // The rollers' orbits: every contact feels it.
    let at = model.layout.theta();
    for angle in &mut y[at..at + model.layout.rollers()] {
        *angle += PUSH * f64::from(start);
    }
    let mut motion = Motion {
        ws: Workspace::with_kernel(&model, kernel),
        model: &model,
    };
    let mut stepper = Stepper::new(
        &mut motion,
        settings(&model, s.simulation.accuracy),
        0.0,
        &y,
    );
    // At least as long as the damage needs to be met; `reference` costs ten times as much.
    let duration = match s.simulation.accuracy {
        Accuracy::Standard => DURATION_S,
        Accuracy::Reference => 0.25 * DURATION_S,
    };
    while stepper.t() < duration {
        stepper.step(&mut motion).unwrap();
    }
    let work = stepper.work();
    [work.steps, work.rejections, work.evaluations].map(|n| n as f64 / stepper.t())
}

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/work.csv")
}

/// Mean and standard deviation of each count.
fn record() -> String {
    let mut text = String::from("scenario,count,per_second,spread\n");
    for (name, s) in scenarios() {
        let runs: Vec<[f64; 3]> = kernels()
            .flat_map(|kernel| (0..STARTS).map(move |start| (kernel, start)))
            .map(|(kernel, start)| counted(&s, kernel, start))
            .collect();
        let n = runs.len() as f64;
        for (k, count) in COUNTS.iter().enumerate() {
            let mean = runs.iter().map(|r| r[k]).sum::<f64>() / n;
            let squares: f64 = runs.iter().map(|r| (r[k] - mean).powi(2)).sum();
            let spread = (squares / (n - 1.0)).sqrt();
            writeln!(text, "{name},{count},{mean:.1},{spread:.1}").unwrap();
        }
    }
    text
}

#[test]
fn regress_counted_work_stays_as_recorded() {
    if std::env::var_os("BRINELL_RECORD").is_some() {
        let text = record();
        print!("{text}");
        std::fs::write(file(), text).unwrap();
    }
    let text = std::fs::read_to_string(file()).unwrap();
    let mut recorded = text.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |k: usize| cells[k].parse::<f64>().unwrap();
        (
            cells[0].to_owned(),
            cells[1].to_owned(),
            number(2),
            number(3),
        )
    });
    let mut moved = String::new();
    for (name, s) in scenarios() {
        let runs: Vec<_> = kernels().map(|k| (k, counted(&s, k, 0))).collect();
        for (k, count) in COUNTS.iter().enumerate() {
            let (scenario, what, mean, spread) = recorded.next().expect("a line for each count");
            assert_eq!((scenario.as_str(), what.as_str()), (name, *count));
            let bound = (SPREADS * spread).max(SHARE * mean);
            for (kernel, counts) in &runs {
                let off = counts[k] - mean;
                println!(
                    "{name}: {count} with {kernel:?} {:.0} a second, {:+.2} % (bound {:.2} %)",
                    counts[k],
                    100.0 * off / mean,
                    100.0 * bound / mean
                );
                if off.abs() > bound {
                    writeln!(
                        moved,
                        "{name}: {count} with {kernel:?}: {:.0} a second, recorded {mean:.0} +- {bound:.0}",
                        counts[k]
                    )
                    .unwrap();
                }
            }
        }
    }
    assert!(moved.is_empty(), "\n{moved}");
}

struct Nothing;

impl Observer for Nothing {
    fn row(&mut self, _: u64, _: &[f64], _: &[f64]) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

#[test]
fn regress_counted_work_of_samples() {
    // One right-hand side a sample, those under the filter's tail included; nothing chaotic in that, so exactly.
    for (name, mut s) in [("rectangle", example("rectangle")), ("healthy", healthy())] {
        s.simulation.duration_s = 0.05;
        let simulation = Simulation::new(&s).unwrap();
        let outcome = simulation.run(&mut Nothing);
        assert_eq!(outcome.end, End::Complete);
        let tail = outcome.work.sample_evaluations - simulation.samples();
        println!("{name}: {} samples and {tail} more", simulation.samples());
        let half_length = brinell::signal::Decimator::new(2).half_length();
        let expected = half_length / brinell::signal::decimate::FACTOR;
        assert_eq!(tail, expected as u64, "{name}");
    }
}
