//! diffsol on brinell's right-hand side, which is vectorised: what is compared is the solver. Method: `tsit45`
//! (explicit, order 5).

use brinell::model::Model;
use brinell::start;
use brinell_peers::{Compact, Job, Sample, Work, levers, scenario};
use diffsol::{NalgebraMat, OdeBuilder, OdeEquations, OdeSolverMethod};
use std::cell::{Cell, RefCell};

type Matrix = NalgebraMat<f64>;

fn main() {
    let Some(job) = Job::new() else { return };
    let model = Model::new(&scenario(&job.scenario, &[])).unwrap();
    let times = job.times();
    let levers = levers(&model);
    job.go(|tolerance, samples| one(&job, &model, &times, &levers, tolerance, samples));
}

fn one(job: &Job, model: &Model, times: &[f64], levers: &[f64], tolerance: f64, samples: &mut Vec<Sample>) -> Work {
    let initial = start::state(model).unwrap();
    let system = RefCell::new(Compact::new(model, &initial));
    let first = system.borrow().compact(&initial);
    let size = first.len();
    let lengths = levers.iter().map(|r| tolerance * job.length / r);
    let speeds = levers.iter().map(|r| tolerance * job.speed / r);
    let atol: Vec<f64> = lengths.chain(speeds).collect();
    let evaluations = Cell::new(0);
    let derivative = |t: f64, y: &[f64], dy: &mut [f64]| {
        evaluations.set(evaluations.get() + 1);
        system.borrow_mut().derivative(t, y, dy);
    };
    let mut problem = OdeBuilder::<Matrix>::new()
        .rtol((tolerance * job.rtol).max(f64::EPSILON))
        .atol(atol)
        .h0(1e-9)
        .rhs(|y, _, t, dy| derivative(t, y, dy))
        .init(|_, _, y: &mut [f64]| y.copy_from_slice(&first), size)
        .build()
        .unwrap();
    // A force that jumps as a contact closes takes the step from microseconds to picoseconds.
    problem.ode_options.max_error_test_failures = 100;
    problem.ode_options.min_timestep = 1e-17;
    let mut probe = Compact::new(model, &initial);
    let mut rates = vec![0.0; size];
    let at = |t: f64, y: &[f64]| {
        probe.derivative(t, y, &mut rates);
        samples.push(rates[size - 4..].try_into().unwrap());
    };
    let steps = match job.method.as_str() {
        "tsit45" => follow(problem.tsit45().unwrap(), times, at),
        other => panic!("no method {other}"),
    };
    Work { rhs: evaluations.get(), steps }
}

/// Steps past each sample and reads the solver's interpolant.
fn follow<'a, E, S>(mut solver: S, times: &[f64], mut at: impl FnMut(f64, &[f64])) -> u64
where
    E: OdeEquations<T = f64, V = diffsol::NalgebraVec<f64>> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    let mut steps = 0;
    for &t in times {
        while solver.state().t < t {
            solver.step().unwrap();
            steps += 1;
        }
        at(t, solver.interpolate(t).unwrap().batch_as_slice(0));
    }
    steps
}
