//! brinell itself. Methods:
//! - `solver`: the library's solver, sampled like the peers; a TOL multiplies the tolerance of `accuracy = "standard"`.
//! - `run`: the library's whole run: oversampling, anti-alias filter, energy and momentum audits. TOL is 1, for
//!   `standard`.

use brinell::accuracy;
use brinell::model::{Model, Motion};
use brinell::scenario::Accuracy;
use brinell::simulate::{Observer, Simulation};
use brinell::solver::Stepper;
use brinell::start;
use brinell_peers::{Job, Sample, Work, scenario};
use std::ops::ControlFlow;

fn main() {
    let Some(job) = Job::new() else { return };
    match job.method.as_str() {
        "solver" => solver(&job),
        "run" => run(&job),
        other => panic!("no method {other}"),
    }
}

fn solver(job: &Job) {
    let model = Model::new(&scenario(&job.scenario, &[])).unwrap();
    let times = job.times();
    let at = model.layout.dof();
    let (inner, outer) = (at + model.layout.inner(), at + model.layout.outer());
    job.go(|factor, samples| {
        let mut settings = accuracy::settings(&model, Accuracy::Standard);
        settings.tolerance *= factor;
        let mut y = start::state(&model).unwrap();
        let mut dy = vec![0.0; y.len()];
        let (mut motion, mut probe) = (Motion::new(&model), Motion::new(&model));
        let mut stepper = Stepper::new(&mut motion, settings, 0.0, &y);
        for &t in &times {
            while stepper.t() < t {
                stepper.step(&mut motion).unwrap();
            }
            stepper.interpolate(t, &mut y);
            probe.derivative(t, &y, &mut dy);
            samples.push([dy[inner], dy[inner + 1], dy[outer], dy[outer + 1]]);
        }
        let work = stepper.work();
        Work { rhs: work.evaluations, steps: work.steps }
    });
}

struct Rows<'a> {
    samples: &'a mut Vec<Sample>,
}

impl Observer for Rows<'_> {
    fn row(&mut self, _: u64, row: &[f64], _: &[f64]) -> ControlFlow<()> {
        self.samples.push([row[0], row[1], row[2], row[3]]);
        ControlFlow::Continue(())
    }
}

fn run(job: &Job) {
    let record = "[\"inner_ax\", \"inner_ay\", \"outer_ax\", \"outer_ay\"]";
    let scenario = scenario(
        &job.scenario,
        &[
            ("simulation.record", record.to_owned()),
            ("simulation.duration_s", job.duration.to_string()),
            ("simulation.sample_rate_hz", format!("{:?}", job.rate)),
        ],
    );
    job.go(|factor, samples| {
        assert!(factor == 1.0, "a whole run has the accuracy of its scenario");
        let simulation = Simulation::new(&scenario).unwrap();
        let names: Vec<&str> = simulation.channels().iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["inner_ax", "inner_ay", "outer_ax", "outer_ay"]);
        let work = simulation.run(&mut Rows { samples }).work.solver;
        Work { rhs: work.evaluations, steps: work.steps }
    });
}
