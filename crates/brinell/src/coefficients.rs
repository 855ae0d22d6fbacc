//! A bearing for programs that know none: stiffness and damping between its rings over speed and load, and the force that its damage
//! makes over the cage's angle. SI; frame as in [`crate::model`].
//!
//! The outer ring is held and the inner one carries the load, without tilt; supports and the rings' weights take no part. Elements have
//! their weight and the centrifugal force of pure rolling, lie still in balance between the raceways and are condensed out; friction, cage and the
//! rates that come of orbiting are left out. Stiffness, damping and displacement are means over 64 positions of the cage in a pitch.

use crate::model::{Model, Support};
use crate::operation::Load;
use crate::scenario::{LoadOn, ModelKind, Surface};
use crate::statics::{Balance, NoBalance, Problem, damping, pressed, solve};
use std::f64::consts::TAU;

/// Positions of the cage over one pitch: of 16 a light load's stiffness across it has steps of 2 % over the speed.
const PHASES: usize = 64;

/// A bearing about its balance.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Coefficients {
    /// Displacement of the inner ring in the outer one, m.
    pub displacement: [f64; 2],
    /// K, N/m: displaced by d, the inner ring is pushed back by K d.
    pub stiffness: [[f64; 2]; 2],
    /// C, N s/m: moved at v, it is pushed back by C v.
    pub damping: [[f64; 2]; 2],
}

/// Those of a bearing without its damage, under `load` (N, from its centre to the middle of the load zone) at a speed of the inner ring, rad/s.
///
/// # Errors
/// Where there is no balance.
pub fn coefficients(model: &Model, load: [f64; 2], speed: f64) -> Result<Coefficients, NoBalance> {
    debug_assert!(model.kind == ModelKind::Full, "elements that move, rings that do not tilt");
    let alone = alone(model, load);
    let mut problem = held(&alone, speed);
    let mut mean = Coefficients::default();
    let add = |sum: &mut [f64; 2], of: &[f64; 2]| (0..2).for_each(|k| sum[k] += of[k] / PHASES as f64);
    for phase in 0..PHASES {
        problem.turn_cage(&alone, pitch(&alone) * phase as f64 / PHASES as f64);
        let balance = solve(&alone, &problem)?;
        let Balance { inner, outer, stiffness, .. } = &balance;
        add(&mut mean.displacement, inner);
        let damping = damping(&alone, &problem, &balance);
        for axis in 0..2 {
            add(&mut mean.stiffness[axis], &stiffness[axis]);
            add(&mut mean.damping[axis], &damping[axis]);
        }
        problem.guess = [*inner, *outer];
    }
    Ok(mean)
}

/// The bearing by itself before it was damaged, the load on its inner ring.
fn alone(model: &Model, load: [f64; 2]) -> Model {
    let mut alone = model.without_damage();
    alone.load = Load { full: load, on: LoadOn::InnerRing, ..model.load };
    alone.inner_support = Support { stiffness: 0.0, damping: 0.0 };
    alone.inertia.inner_ring = 0.0;
    alone
}

fn held(model: &Model, speed: f64) -> Problem {
    Problem { speed, fix_outer: true, ..Problem::at_start(model) }
}

fn pitch(model: &Model) -> f64 {
    TAU / model.layout.rollers_per_row as f64
}

/// The elements' force on the outer ring at an angle of the cage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// From where the cage starts, rad.
    pub cage_angle: f64,
    /// Of the bearing as it is, N.
    pub damaged: [f64; 2],
    /// Of the bearing without its damage, N.
    pub healthy: [f64; 2],
}

/// Steps in a pitch, at least, and their length at the outer raceway at most, m.
const STEPS: f64 = 360.0;
const STEP: f64 = 50e-6;

/// The force of its damage under its full load, with the rings held at the healthy bearing's mean displacement at this speed (rad/s): quasi-static,
/// in pure rolling, inner ring and elements turning with the cage.
///
/// Over one pitch of the elements; with damage on the inner raceway over a turn of the shaft, with damage on an element over a turn of the cage.
///
/// # Errors
/// Where there is no balance.
pub fn force_over_cage_angle(model: &Model, speed: f64) -> Result<Vec<Push>, NoBalance> {
    let Coefficients { displacement: [x, y], .. } = coefficients(model, model.load.full, speed)?;
    let (sound, pitch) = (alone(model, model.load.full), pitch(model));
    // Angles of the inner ring and of an element over the cage's.
    let orbit = model.rolling_orbit_speed(1.0);
    let (ring, spin) = (1.0 / orbit, model.rolling_spin_speed(1.0) / orbit);
    let span = model.defects.iter().fold(pitch, |span, defect| match defect.surface {
        Surface::OuterRaceway => span,
        Surface::InnerRaceway => span.max(TAU * orbit),
        Surface::Roller(_) => TAU,
    });
    let steps = (STEPS * span / pitch).max(model.geometry.outer_radius * span / STEP).ceil() as usize;
    let mut problem = held(&sound, speed);
    let at = |k: usize| {
        let cage_angle = span * k as f64 / steps as f64;
        problem.turn_cage(model, cage_angle);
        problem.ring_angle = ring * cage_angle;
        problem.spin.fill(spin * cage_angle);
        let [damaged, healthy] = [model, &sound].map(|of| {
            let gradient = pressed(of, &problem, model.load.size(), &[x, y, 0.0, 0.0]).state.gradient;
            [-gradient[2], -gradient[3]]
        });
        Push { cage_angle, damaged, healthy }
    };
    Ok((0..=steps).map(at).collect())
}
