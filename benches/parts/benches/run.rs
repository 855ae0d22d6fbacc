//! A whole run of the paper's rectangle, from the model to the last sample. `cargo bench -p brinell-bench --bench run`.
//!
//! Also prints what a simulated second costs in runs of 0.25 to 10 s.

mod common;

use brinell::scenario::{Accuracy, Scenario};
use brinell::simulate::Simulation;
use common::rectangle;
use criterion::Throughput;
use std::time::Instant;

/// Simulated time of one measurement, s.
const DURATION_S: f64 = 0.1;

fn run(s: &Scenario) -> u64 {
    let outcome = Simulation::new(s).expect("a run").run(&mut ());
    outcome.work.solver.evaluations + outcome.work.sample_evaluations
}

/// Least of three, s: what a machine does when nobody else is at it.
fn seconds(s: &Scenario) -> (f64, u64) {
    let mut evaluations = 0;
    let least = (0..3)
        .map(|_| {
            let begin = Instant::now();
            evaluations = run(s);
            begin.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min);
    (least, evaluations)
}

fn durations() {
    let mut s = rectangle();
    println!("simulated      a simulated second costs");
    for duration in [0.25, 0.5, 1.0, 2.5, 5.0, 10.0] {
        s.simulation.duration_s = duration;
        let (seconds, evaluations) = seconds(&s);
        println!(
            "{duration:6} s       {:.4} s, {:.0} right-hand sides",
            seconds / duration,
            evaluations as f64 / duration
        );
    }
}

fn main() {
    let mut criterion = common::criterion();
    // `cargo test --benches` only wants to see that it runs.
    if !std::env::args().any(|a| a == "--test") {
        durations();
    }
    let mut group = criterion.benchmark_group("rectangle, 0.1 s");
    group.sample_size(10);
    for (name, accuracy) in [("standard", Accuracy::Standard), ("reference", Accuracy::Reference)] {
        let mut s = rectangle();
        s.simulation.duration_s = DURATION_S;
        s.simulation.accuracy = accuracy;
        group.throughput(Throughput::Elements(run(&s)));
        group.bench_function(name, |b| b.iter(|| run(&s)));
    }
    group.finish();
    criterion.final_summary();
}
