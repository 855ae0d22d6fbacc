//! The solver's counted work stays what it was: a check of speed that no noise can move.
//!
//! `work.csv` holds steps, rejections and right-hand sides per simulated second: the mean over runs whose starts differ
//! in the last digits, with rounded and with fused products, and the standard deviation of one run. Impacts amplify
//! round-off, so such runs are different runs of the same process after some tens of milliseconds, as runs on another
//! processor are; that scatter is what the bounds come from. The fastest kernel represents all with fused products.
//!
//! A change that moves the counts on purpose records them anew, and says why where it is committed:
//!
//!     BRINELL_RECORD=1 cargo test --release --test all work::

use crate::common::cases::{case, healthy};
use brinell::accuracy::settings;
use brinell::many;
use brinell::model::{Kernel, Model, Motion, Workspace};
use brinell::scenario::{Accuracy, Scenario};
use brinell::simulate::{End, Simulation};
use brinell::solver::Stepper;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Simulated time of each count, s.
const DURATION_S: f64 = 0.25;
/// Relative size of the push that makes another start.
const PUSH: f64 = 1e-13;
/// Starts of each kernel in a test.
const STARTS: usize = 4;
/// Starts of each kernel when recording.
const RECORDED: usize = 16;
/// Mean and recorded mean may differ by this many times the standard deviation of that difference: one of 10^4
/// differences between runs of the same process does, and the file has 24.
const DEVIATIONS: f64 = 4.5;
/// And by this share of the mean, where nothing scatters.
const SHARE: f64 = 0.005;

/// The counts' names, as in the file.
const COUNTS: [&str; 3] = ["steps", "rejections", "right_hand_sides"];

fn example(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name).with_extension("toml");
    let text = std::fs::read_to_string(path).unwrap();
    crate::common::read_li2023(&text, &[]).unwrap().scenario
}

fn scenarios() -> Vec<(&'static str, Scenario)> {
    let mut reference = example("rectangle");
    reference.simulation.accuracy = Accuracy::Reference;
    // The load that its counts were recorded under.
    let mut inner_race = example("inner-race");
    inner_race.operation.load_n = [300.0, 0.0];
    vec![
        ("rectangle", example("rectangle")),
        ("rectangle-reference", reference),
        ("circle", example("circle")),
        ("irregular", example("irregular")),
        ("inner-race", inner_race),
        ("roller", example("roller")),
        ("healthy", healthy()),
        ("heavy", case("xval/heavy-load-profile")),
    ]
}

/// Rounded products, and fused ones where the processor has them.
fn kernels() -> Vec<Kernel> {
    let mut kernels = vec![Kernel::Portable, Kernel::fastest()];
    kernels.dedup();
    kernels
}

/// Counts per simulated second.
fn counted(s: &Scenario, kernel: Kernel, start: usize) -> [f64; 3] {
    let model = Model::new(s).unwrap();
    let mut y = brinell::start::state(&model).unwrap();
    // The rollers' orbits: every contact feels it.
    let at = model.layout.theta();
    for angle in &mut y[at..at + model.layout.rollers()] {
        *angle += PUSH * start as f64;
    }
    let mut motion = Motion { ws: Workspace::with_kernel(&model, kernel), model: &model };
    let mut stepper = Stepper::new(&mut motion, settings(&model, s.simulation.accuracy), 0.0, &y);
    // At least as long as the damage needs to be met; `reference` costs many times as much.
    let duration = match s.simulation.accuracy {
        Accuracy::Standard => DURATION_S,
        Accuracy::Reference => 0.2 * DURATION_S,
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

/// Mean and standard deviation of each count, over `starts` starts of each kernel; and how many runs that is.
fn statistics(s: &Scenario, starts: usize) -> ([(f64, f64); 3], f64) {
    let kernels = kernels();
    let count = kernels.len() * starts;
    let mut runs = vec![[0.0; 3]; count];
    many::each(
        count,
        many::threads(count),
        |k| counted(s, kernels[k / starts], k % starts),
        |k, counts| runs[k] = counts,
    );
    let n = count as f64;
    let of = |k: usize| {
        let mean = runs.iter().map(|r| r[k]).sum::<f64>() / n;
        let squares: f64 = runs.iter().map(|r| (r[k] - mean).powi(2)).sum();
        (mean, (squares / (n - 1.0)).sqrt())
    };
    ([of(0), of(1), of(2)], n)
}

fn record() {
    let mut text = String::from("scenario,count,per_second,deviation_of_a_run,runs\n");
    for (name, s) in scenarios() {
        let (counts, n) = statistics(&s, RECORDED);
        for (count, (mean, deviation)) in COUNTS.iter().zip(counts) {
            writeln!(text, "{name},{count},{mean:.1},{deviation:.1},{n}").unwrap();
        }
    }
    std::fs::write(file(), text).unwrap();
}

#[test]
fn regress_counted_work_stays_as_recorded() {
    if std::env::var_os("BRINELL_RECORD").is_some() {
        record();
    }
    let text = std::fs::read_to_string(file()).unwrap();
    let mut recorded = text.lines().skip(1);
    let mut moved = String::new();
    for (name, s) in scenarios() {
        let (counts, n) = statistics(&s, STARTS);
        for (count, (mean, _)) in COUNTS.iter().zip(counts) {
            let line: Vec<&str> = recorded.next().expect("a line").split(',').collect();
            assert_eq!(line[..2], [name, *count]);
            let [was, deviation, runs] = [line[2], line[3], line[4]].map(|cell| cell.parse::<f64>().unwrap());
            let scatter = deviation * (1.0 / n + 1.0 / runs).sqrt();
            let bound = (DEVIATIONS * scatter).max(SHARE * was);
            let told = format!(
                "{name}: {mean:.0} {count} a second, {:+.2} % (bound {:.2} %)",
                100.0 * (mean / was - 1.0),
                100.0 * bound / was
            );
            println!("{told}");
            if (mean - was).abs() > bound {
                writeln!(moved, "{told}").unwrap();
            }
        }
    }
    assert!(moved.is_empty(), "\n{moved}");
}

#[test]
fn regress_counted_work_of_samples() {
    // One right-hand side a sample, those under the filter's tail included; nothing chaotic in that, so exactly.
    for (name, mut s) in [("rectangle", example("rectangle")), ("healthy", healthy())] {
        s.simulation.duration_s = 0.05;
        let simulation = Simulation::new(&s).unwrap();
        let outcome = simulation.run(&mut ());
        assert_eq!(outcome.end, End::Complete);
        let tail = outcome.work.sample_evaluations - simulation.samples();
        println!("{name}: {} samples and {tail} more", simulation.samples());
        let half_length = brinell::simulate::Decimator::new(2).half_length();
        let expected = half_length / brinell::signal::decimate::FACTOR;
        assert_eq!(tail, expected as u64, "{name}");
    }
}
