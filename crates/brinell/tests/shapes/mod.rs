//! Shapes of damage against closed forms, against each other, and against an independent geometry library.

mod envelope;
mod plan;
mod several;
mod slices;

use brinell::contact::{Damping, LoadDeflection};
use brinell::defect::{Angles, Defect, Shape};
use brinell::elementary::Exponent;
use brinell::scenario::{self, DepthGrid, Law, RollerPath, Surface};
use std::f64::consts::TAU;

const LAW: LoadDeflection = LoadDeflection {
    strips: None,
    stiffness: 1.898e8,
    exponent: Exponent::TenNinths,
    damping: Damping::Constant(200.0),
};

fn circle_mm(radius: f64, corners: usize) -> Vec<[f64; 2]> {
    (0..corners)
        .map(|k| {
            let (sin, cos) = (TAU * k as f64 / corners as f64).sin_cos();
            [radius * cos, radius * sin]
        })
        .collect()
}

fn grid_mm(half: [f64; 2], step: f64, depth: impl Fn(f64, f64) -> f64) -> DepthGrid {
    let [columns, rows] = half.map(|h| (2.0 * h / step).round() as usize + 1);
    let s = |c: usize| -half[0] + c as f64 * step;
    let z = |r: usize| -half[1] + r as f64 * step;
    DepthGrid {
        s0_mm: -half[0],
        z0_mm: -half[1],
        ds_mm: step,
        dz_mm: step,
        columns,
        rows,
        depth_um: (0..rows * columns).map(|k| depth(s(k % columns), z(k / columns))).collect(),
    }
}

fn shape(of: scenario::Shape) -> Shape {
    Shape::new(&of, 20e-6).unwrap()
}

/// The example's defect with another shape, law and path.
fn defect(of: scenario::Shape, on: Surface, law: Law, path: RollerPath, slices: usize) -> Defect {
    let mut s = crate::common::example();
    s.contact.law = law;
    s.contact.roller_path = path;
    s.contact.slices = slices;
    let d = scenario::Defect { shape: of, on, ..s.defects[0].clone() };
    Defect::new(&d, &s.bearing, &s.contact).unwrap()
}

fn at(orbit: f64) -> Angles {
    Angles { orbit, spin: 0.0, ring: 0.0 }
}

/// An outline with slanted edges off the middle of the row.
fn oblique() -> scenario::Shape {
    let corners = [[-1.7, 0.15], [0.4, -0.65], [1.6, 0.9], [1.1, 2.75], [-0.3, 1.35], [-1.2, 2.4]];
    scenario::Shape::Outline { polygons_mm: vec![corners.map(|[s, z]| [s, z - 0.3]).to_vec()] }
}
