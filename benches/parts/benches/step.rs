//! A step: of the stepper alone, and in a run with its audits. `cargo bench -p brinell-bench --bench step`.

mod common;

use brinell::accuracy::settings;
use brinell::model::{Model, Motion};
use brinell::scenario::Accuracy;
use brinell::simulate::Simulation;
use brinell::solver::Stepper;
use common::{off_and_on_damage, rectangle};
use criterion::{BatchSize, Throughput};

/// Steps of one measurement: some 10 ms simulated, so that rollers pass the damage.
const STEPS: u64 = 500;

fn main() {
    let mut criterion = common::criterion();
    let mut group = criterion.benchmark_group("step");
    let s = rectangle();

    let model = Model::new(&s).expect("a model");
    let [(t, y), _] = off_and_on_damage(&model);
    let settings = settings(&model, Accuracy::Standard);
    group.throughput(Throughput::Elements(STEPS));
    group.bench_function("stepper", |b| {
        b.iter_batched_ref(
            || {
                let mut motion = Motion::new(&model);
                let stepper = Stepper::new(&mut motion, settings.clone(), t, &y);
                (motion, stepper)
            },
            |(motion, stepper)| {
                for _ in 0..STEPS {
                    stepper.step(motion).expect("a step");
                }
            },
            BatchSize::SmallInput,
        );
    });

    // So few samples that they cost nothing: steps and audits are left.
    let mut s = rectangle();
    s.simulation.duration_s = 0.1;
    s.simulation.sample_rate_hz = 500.0;
    let simulation = Simulation::new(&s).expect("a run");
    let steps = simulation.run(&mut ()).work.solver.steps;
    group.throughput(Throughput::Elements(steps));
    group.bench_function("with audits", |b| {
        b.iter(|| simulation.run(&mut ()));
    });
    group.finish();
    criterion.final_summary();
}
