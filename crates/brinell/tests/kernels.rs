//! The kernels for different instructions compute the same equations, to round-off.

use crate::common::cases::{case, raceway_film, rectangle};
use brinell::model::{Kernel, Model, Workspace};
use brinell::scenario::{Accuracy, Guidance, Scenario};
use brinell::simulate::Simulation;

/// States along a run, so that contacts, pockets and damage are at work.
fn states(s: &Scenario) -> Vec<(f64, Vec<f64>)> {
    use brinell::model::Motion;
    use brinell::solver::Stepper;
    let model = Model::new(s).unwrap();
    let mut motion = Motion::new(&model);
    let y = brinell::start::state(&model).unwrap();
    let settings = brinell::accuracy::settings(&model, Accuracy::Standard);
    let mut stepper = Stepper::new(&mut motion, settings, 0.0, &y);
    let mut states = Vec::new();
    while stepper.t() < 0.008 {
        for _ in 0..7 {
            stepper.step(&mut motion).unwrap();
        }
        states.push((stepper.t(), stepper.y().to_vec()));
    }
    states
}

/// Largest difference of a derivative between two kernels, relative to the largest force at play: forces cancel in
/// sums, so an acceleration cannot be closer than the round-off of its largest term.
const LIMIT: f64 = 2e-13;

#[test]
fn xval_kernels_agree_to_round_off() {
    for name in [
        "reference/outer-rectangle",
        "reference/inner-defect-gravity",
        "xval/balls",
        "xval/three-rows-drag-gap",
        "xval/single-row-inner-guided",
        "xval/linear-circle",
        "xval/rest-speed-profile",
        "raceway film",
    ] {
        let s = if name == "raceway film" { raceway_film() } else { case(name) };
        let model = Model::new(&s).unwrap();
        let dof = model.layout.dof();
        let mass = model.mass();
        let mut there = 0;
        for kernel in Kernel::ALL.into_iter().filter(|k| k.is_there()) {
            there += 1;
            let mut plain = Workspace::with_kernel(&model, Kernel::Portable);
            let mut other = Workspace::with_kernel(&model, kernel);
            assert_eq!(other.kernel(), kernel);
            let mut worst: f64 = 0.0;
            for (t, y) in states(&s) {
                let (mut a, mut b) = (vec![0.0; 2 * dof], vec![0.0; 2 * dof]);
                model.derivative(t, &y, &mut a, &mut plain);
                model.derivative(t, &y, &mut b, &mut other);
                assert_eq!(a[..dof], b[..dof], "rates are copied");
                // Work of a force per unit of rate: the generalised force; angles' levers make them moments.
                let size = (0..dof).map(|k| (mass[k] * a[dof + k]).abs()).fold(0.0, f64::max);
                let pressed: f64 = plain.contacts.iter().flat_map(|c| &c.elastic).sum();
                for k in 0..dof {
                    let lever = if mass[k] < 1e-5 { model.geometry.roller_radius } else { 1.0 };
                    let difference = mass[k] * (a[dof + k] - b[dof + k]).abs() / lever;
                    worst = worst.max(difference / (size + pressed));
                }
            }
            println!("{name}: {kernel:?} differs by {worst:.1e}");
            assert!(worst < LIMIT, "{name}: {kernel:?} differs by {worst:e}");
        }
        assert!(there > 0);
    }
}

#[test]
fn prop_a_workspace_never_holds_a_kernel_that_is_not_there() {
    let mut s = rectangle();
    s.cage.guidance = Guidance::Rollers;
    let simulation = Simulation::new(&s).unwrap();
    for kernel in Kernel::ALL {
        let ws = Workspace::with_kernel(simulation.model(), kernel);
        assert!(ws.kernel().is_there());
    }
    assert!(Kernel::fastest().is_there());
}
