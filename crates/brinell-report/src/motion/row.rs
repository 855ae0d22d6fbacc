//! One row of the bearing in motion, drawn.

use super::frames::{Motion, MotionRow};
use crate::number::finite;
use crate::picture::{Paint, Shape, ink};
use brinell::scenario::Surface;
use std::f64::consts::{PI, TAU};

/// A ring's thickness as drawn, share of the outer raceway's radius.
pub(super) const RING: f64 = 0.1;

/// What is drawn in which colour.
pub(super) const COLORS: [(&str, Paint); 4] = [
    ("force at the outer contact", Paint::line(ink::VERMILLION, 2.2)),
    ("force at the inner contact", Paint::line(ink::BLUE, 2.2)),
    ("cage", Paint::line(ink::GREEN, 5.0)),
    ("damage", Paint::line(ink::ORANGE, 5.0)),
];

/// One row at one instant.
pub(super) struct DrawnRow<'a> {
    pub(super) motion: &'a Motion,
    pub(super) row: &'a MotionRow,
    pub(super) frame: usize,
    /// px.
    pub(super) centre: (f64, f64),
    /// px per mm.
    pub(super) scale: f64,
}

/// Lines that do not close.
fn open(lines: Vec<Vec<(f64, f64)>>, paint: Paint) -> Shape {
    Shape::Path { lines, close: false, paint, clip: None }
}

fn group(shapes: &mut Vec<Shape>, name: &'static str, lines: Vec<Vec<(f64, f64)>>, paint: Paint) {
    shapes.push(Shape::Open(name));
    shapes.push(open(lines, paint));
    shapes.push(Shape::Close);
}

impl DrawnRow<'_> {
    fn at(&self, radius: f64, angle: f64) -> (f64, f64) {
        let (sin, cos) = angle.sin_cos();
        let (x, y) = self.centre;
        (x + self.scale * radius * cos, y - self.scale * radius * sin)
    }

    /// A value a roller, of this instant.
    fn values(&self, list: &[f32]) -> Vec<f64> {
        let n = self.row.pockets.len();
        let own = &list[self.frame * n..(self.frame + 1) * n];
        own.iter().map(|v| finite(*v)).collect()
    }

    /// Angle of the inner ring, rad.
    fn ring(&self) -> f64 {
        finite(self.motion.ring[self.frame])
    }

    pub(super) fn rings(&self, s: &mut Vec<Shape>) {
        let (inner, outer) = (self.motion.inner_radius_mm, self.motion.outer_radius_mm);
        let (x, y) = self.centre;
        let mut circle = |r: f64, fill: &'static str| {
            s.push(Shape::Circle { x, y, r: self.scale * r, paint: Paint::line(ink::FRAME, 1.0).filled(fill, 1.0) });
        };
        let thick = RING * outer;
        let bore = (inner - thick).max(0.2 * inner);
        circle(outer + thick, "#eef1f4");
        circle(outer, "#ffffff");
        circle(inner, "#eef1f4");
        circle(bore, "#ffffff");
        let mark = vec![self.at(bore, self.ring()), self.at(inner, self.ring())];
        group(s, "m-ring", vec![mark], Paint::line(ink::BLACK, 2.5));
    }

    /// Bars of the cage between the pockets, and the rollers with their spins.
    pub(super) fn bodies(&self, s: &mut Vec<Shape>) {
        let (pitch, roller) = (self.motion.pitch_radius_mm, self.motion.roller_radius_mm);
        let n = self.row.pockets.len();
        let half = (PI / n.max(1) as f64 - 1.06 * (roller / pitch).min(1.0).asin()).max(0.006);
        let cage = finite(self.row.cage[self.frame]);
        let bars = self.row.pockets.iter().map(|pocket| {
            let middle = finite(*pocket) + cage + PI / n as f64;
            [-half, 0.0, half].map(|a| self.at(pitch, middle + a)).to_vec()
        });
        let [_, _, (_, cage_paint), _] = COLORS;
        group(s, "m-cage", bars.collect(), cage_paint);
        let (orbit, spin) = (self.values(&self.row.orbit), self.values(&self.row.spin));
        s.push(Shape::Open("m-bodies"));
        for angle in &orbit {
            let (x, y) = self.at(pitch, *angle);
            s.push(Shape::Circle {
                x,
                y,
                r: self.scale * roller,
                paint: Paint::line(ink::TEXT, 1.0).filled("#ffffff", 1.0),
            });
        }
        s.push(Shape::Close);
        let spins = orbit.iter().zip(&spin).map(|(angle, spin)| {
            let (x, y) = self.at(pitch, *angle);
            let (sin, cos) = spin.sin_cos();
            let reach = 0.85 * self.scale * roller;
            vec![(x, y), (x + reach * cos, y - reach * sin)]
        });
        group(s, "m-spins", spins.collect(), Paint::line(ink::TEXT, 1.2));
    }

    /// Damage of the row with this index.
    pub(super) fn damage(&self, s: &mut Vec<Shape>, index: usize) {
        let motion = self.motion;
        let (orbit, spin) = (self.values(&self.row.orbit), self.values(&self.row.spin));
        let [.., (_, damage_paint)] = COLORS;
        s.push(Shape::Open("m-damage"));
        for damage in motion.damage.iter().filter(|d| d.row == index) {
            let ends = damage.angle.map(|a| match a.is_finite() {
                true => a.clamp(-TAU, TAU),
                false => 0.0,
            });
            let along = (0..=8).map(|k| ends[0] + f64::from(k) / 8.0 * (ends[1] - ends[0]));
            let line = match damage.surface {
                Surface::OuterRaceway => along.map(|a| self.at(motion.outer_radius_mm, a)).collect(),
                Surface::InnerRaceway => along.map(|a| self.at(motion.inner_radius_mm, a + self.ring())).collect(),
                Surface::Roller(k) => {
                    let (Some(orbit), Some(spin)) = (orbit.get(k), spin.get(k)) else {
                        continue;
                    };
                    let (x, y) = self.at(motion.pitch_radius_mm, *orbit);
                    let reach = self.scale * motion.roller_radius_mm;
                    let on = |a: f64| {
                        let (sin, cos) = (a + spin).sin_cos();
                        (x + reach * cos, y - reach * sin)
                    };
                    along.map(on).collect()
                }
            };
            s.push(open(vec![line], damage_paint));
        }
        s.push(Shape::Close);
    }

    pub(super) fn forces(&self, s: &mut Vec<Shape>, per_newton: f64) {
        let orbit = self.values(&self.row.orbit);
        let lines = |forces: &[f32], from: f64, way: f64| -> Vec<Vec<(f64, f64)>> {
            let forces = self.values(forces);
            let loaded = orbit.iter().zip(forces).filter(|(_, f)| *f > 0.0);
            let line = |(a, f): (&f64, f64)| {
                let to = from + way * f * per_newton / self.scale;
                vec![self.at(from, *a), self.at(to, *a)]
            };
            loaded.map(line).collect()
        };
        let (inner, outer) = (self.motion.inner_radius_mm, self.motion.outer_radius_mm);
        let [(_, outer_paint), (_, inner_paint), ..] = COLORS;
        let (outside, inside) = (lines(&self.row.outer_n, outer, 1.0), lines(&self.row.inner_n, inner, -1.0));
        group(s, "m-outer", outside, outer_paint);
        group(s, "m-inner", inside, inner_paint);
    }
}
