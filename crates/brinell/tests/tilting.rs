//! Rollers and rings that tilt, and profiles: sections 15 and 16.

use crate::common::cases::{case, random_state, tilting_offset};
use brinell::channel::Frame;
use brinell::model::{Model, Workspace};
use brinell::observe::line_load::LineLoads;
use brinell::scenario::{ContactDamping, LoadOn, ModelKind, RollerProfile, Scenario, Start};
use brinell::simulate::{Observer, Simulation};
use brinell::slices::drop;
use brinell::statics::{Problem, solve};

fn edge() -> Scenario {
    let mut s = case("xval/tilting");
    s.contact.slices = 32;
    s.operation.gravity_m_per_s2 = [0.0; 2];
    s
}

/// Accelerations at a state.
fn accelerations(s: &Scenario, t: f64, y: &[f64]) -> Vec<f64> {
    let model = Model::new(s).unwrap();
    let mut ws = Workspace::new(&model);
    let mut a = vec![0.0; model.layout.dof()];
    model.accelerations(t, y, &mut a, &mut ws);
    a
}

#[test]
fn lit_logarithmic_drop_of_iso_16281() {
    // ISO/TS 16281 with L <= 2.5 d, at 90 % of the half length: 0.00035 d ln(1/(1 - 0.81)) = 0.58126e-3 d.
    let at = drop(&RollerProfile::Logarithmic, 2.7e-3, 6e-3, 6e-3);
    assert!((at / 6e-3 - 0.00035 * (1.0_f64 / 0.19).ln()).abs() < 1e-15);
    // L > 2.5 d: straight in the middle.
    assert_eq!(drop(&RollerProfile::Logarithmic, 2.4e-3, 20e-3, 6e-3), 0.0);
    let at = drop(&RollerProfile::Logarithmic, 9e-3, 20e-3, 6e-3);
    let x: f64 = (18.0 - 5.0) / 15.0;
    assert!((at / (0.0005 * 6e-3 * (1.0 / (1.0 - x * x)).ln()) - 1.0).abs() < 1e-12);
}

#[test]
fn analytic_nothing_tilted_is_the_planar_model() {
    // Without damping at the contacts, where every slice is damped by itself; at states without tilt the other
    // coordinates move as in the plane.
    let mut tilting = edge();
    tilting.contact.damping = ContactDamping::Constant { ns_per_m: 0.0 };
    let mut planar = tilting.clone();
    planar.simulation.model = ModelKind::Full;
    let (flat, full) = (Model::new(&planar).unwrap(), Model::new(&tilting).unwrap());
    for seed in 0..20 {
        let y = random_state(&flat, seed);
        let (l, m) = (&flat.layout, &full.layout);
        let mut tilted = vec![0.0; 2 * m.dof()];
        let places: Vec<(usize, usize)> = (0..3 * l.slots)
            .map(|k| (k, k))
            .chain((l.cage(0)..l.outer() + 2).map(|k| (k, k + m.cage(0) - l.cage(0))))
            .collect();
        for &(from, to) in &places {
            tilted[to] = y[from];
            tilted[m.dof() + to] = y[l.dof() + from];
        }
        let a = accelerations(&planar, 0.01, &y);
        let b = accelerations(&tilting, 0.01, &tilted);
        let largest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for &(from, to) in &places {
            assert!(
                (a[from] - b[to]).abs() < 1e-11 * largest,
                "{}: {} in the plane, {} with tilt",
                l.name(from, flat.element),
                a[from],
                b[to]
            );
        }
    }
}

#[test]
fn prop_a_mirrored_load_mirrors_the_tilts() {
    for mut s in [edge(), tilting_offset()] {
        s.bearing.row_stagger_deg = 0.0;
        let mut there = s.clone();
        there.operation.load_offset_mm *= -1.0;
        let here = s;
        let model = Model::new(&here).unwrap();
        let l = &model.layout;
        // Rows change places, and tilts their sign.
        let place = |k: usize| -> (usize, f64) {
            if k < l.cage(0) {
                let (column, slot) = (k / l.slots, k % l.slots);
                if slot >= l.rollers() {
                    return (k, 1.0);
                }
                let other = l.slot(l.rows - 1 - l.row(slot), l.roller(slot));
                let sign = if column == 3 { -1.0 } else { 1.0 };
                (column * l.slots + other, sign)
            } else if k < l.inner() {
                let row = (k - l.cage(0)) / 3;
                (l.cage(l.rows - 1 - row) + (k - l.cage(0)) % 3, 1.0)
            } else {
                (k, if (l.inner_tilt()..l.outer_tilt() + 2).contains(&k) { -1.0 } else { 1.0 })
            }
        };
        for seed in 0..20 {
            let y = random_state(&model, seed);
            let mut image = y.clone();
            for k in 0..l.dof() {
                let (to, sign) = place(k);
                image[to] = sign * y[k];
                image[l.dof() + to] = sign * y[l.dof() + k];
            }
            let a = accelerations(&here, 0.01, &y);
            let b = accelerations(&there, 0.01, &image);
            let largest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            for k in 0..l.dof() {
                let (to, sign) = place(k);
                let difference = (sign * a[k] - b[to]).abs();
                assert!(difference < 1e-11 * largest, "{}: {difference:e}", l.name(k, model.element));
            }
        }
    }
}

/// One row, exponent 1, straight, no clearance, no speed, the load at Z_F on the inner ring.
fn one_row(slices: usize, offset_mm: f64) -> Scenario {
    let mut s = edge();
    s.bearing.rows = 1;
    s.bearing.row_stagger_deg = 0.0;
    s.bearing.row_spacing_mm = 0.0;
    s.bearing.profile = RollerProfile::Straight;
    s.bearing.radial_clearance_um = 0.0;
    s.contact.exponent = 1.0;
    s.contact.slices = slices;
    s.operation.load_n = [300.0, 0.0];
    s.operation.load_on = LoadOn::InnerRing;
    s.operation.load_offset_mm = offset_mm;
    // What the supports hold does not pass through the rollers.
    s.support.inner_stiffness_n_per_m = 0.0;
    s.support.inner_tilt_stiffness_nm_per_rad = 0.0;
    s
}

#[test]
fn analytic_a_load_off_the_middle_tilts_one_row() {
    // tau_i - tau_o = 12 (x_i - x_o) Z_F / (L^2 (1 - 1/n_s^2)), Z_F < L/6, where no roller has a force of its own.
    for (slices, offset) in [(2, 0.3), (8, 0.5), (20, -0.4)] {
        let s = one_row(slices, offset);
        let model = Model::new(&s).unwrap();
        let mut problem = Problem::at_start(&model);
        problem.speed = 0.0;
        let balance = solve(&model, &problem).unwrap();
        let tilted = balance.tilting.unwrap();
        let tilt = tilted.rings[0][0] - tilted.rings[1][0];
        let shift = balance.inner[0] - balance.outer[0];
        let n = slices as f64;
        let expected = 12.0 * shift * 1e-3 * offset / (36e-6 * (1.0 - 1.0 / (n * n)));
        assert!((tilt / expected - 1.0).abs() < 1e-6, "{slices} slices: {tilt:e} rad, {expected:e} expected");
    }
}

#[test]
fn analytic_an_equilibrium_is_one() {
    let mut s = tilting_offset();
    s.simulation.start = Start::Equilibrium;
    // Neither friction nor film nor damping, which the orbit makes felt: what is left is the balance's error, and the
    // centrifugal force on the arm R_m + r in place of R_m, 0.2 N times 20 um over 25 mm.
    s.friction.raceway_coefficient = 0.0;
    s.contact.damping = ContactDamping::Constant { ns_per_m: 0.0 };
    s.lubricant.viscosity_pa_s = 0.0;
    let model = Model::new(&s).unwrap();
    let y = brinell::start::state(&model).unwrap();
    let a = accelerations(&s, 1.0, &y);
    let l = &model.layout;
    let mass = model.mass();
    for slot in 0..l.rollers() {
        for k in [l.r() + slot, l.beta() + slot] {
            let force = mass[k] * a[k].abs();
            assert!(force < 2e-4, "{}: {force:e} N left over", l.name(k, model.element));
        }
    }
    for k in l.inner()..l.outer_tilt() + 2 {
        let force = mass[k] * a[k].abs();
        assert!(force < 1e-3, "{}: {force:e} N left over", l.name(k, model.element));
    }
    assert!(y[l.inner_tilt()].abs() > 1e-6, "the load is off the middle");
}

#[test]
fn analytic_a_profile_of_no_drop_is_straight() {
    let mut s = edge();
    s.simulation.model = ModelKind::Full;
    s.bearing.profile = RollerProfile::Straight;
    let mut table = s.clone();
    table.bearing.profile = RollerProfile::Table { z_mm: vec![-1.0, 1.0], drop_um: vec![0.0, 0.0] };
    let model = Model::new(&s).unwrap();
    for seed in 0..20 {
        let y = random_state(&model, seed);
        let (a, b) = (accelerations(&s, 0.01, &y), accelerations(&table, 0.01, &y));
        let largest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for k in 0..a.len() {
            assert!((a[k] - b[k]).abs() < 1e-9 * largest, "{} and {}", a[k], b[k]);
        }
    }
}

/// Reads line loads and the forces of the same contacts.
struct Loads {
    lines: LineLoads,
    forces: Vec<f64>,
}

impl Observer for Loads {
    fn sample(&mut self, index: u64, frame: &Frame) {
        let before = self.lines.rows.len();
        self.lines.take(index, frame);
        if self.lines.rows.len() > before {
            let all = frame.ws.contacts.iter().map(|c| c.force.iter().sum::<f64>());
            self.forces.push(all.sum());
        }
    }
}

#[test]
fn prop_line_loads_add_up_to_the_forces() {
    let mut s = edge();
    s.simulation.duration_s = 0.012;
    let simulation = Simulation::new(&s).unwrap();
    let instants = [0.008, 0.01, 0.0115];
    let lines = LineLoads::new(simulation.model(), &instants, 25600.0).unwrap();
    let mut loads = Loads { lines, forces: Vec::new() };
    simulation.run(&mut loads);
    assert_eq!(loads.forces.len(), 3);
    let width = 6e-3 / 32.0;
    let sum: f64 = loads.lines.rows.iter().map(|r| r.line_load * width).sum();
    let forces: f64 = loads.forces.iter().sum();
    assert!((sum / forces - 1.0).abs() < 1e-9, "{sum} N and {forces} N");
}
