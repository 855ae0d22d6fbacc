//! An outline that grows and always holds what it was: scaled about a point of the edge that stays.
//!
//! Scaling about a point holds the former outline only where every ray from that point leaves the damage once. So an
//! outline is taken as far as it reaches in each direction from there: its hollows, as the point sees them, are filled.

use std::f64::consts::{FRAC_PI_2, PI};

/// Directions over half a turn; an outline of few corners has those of its corners beside.
const DIRECTIONS: u32 = 90;
const FEW_CORNERS: usize = 40;
/// Halvings of the scale that a length belongs to.
const HALVINGS: usize = 100;
/// Coordinates are written to a nanometre: parts of a mm.
const NANOMETRES: f64 = 1e6;

/// Which edge moves as damage grows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Edge {
    /// The one that rolling elements leave.
    #[default]
    Trailing,
    /// The one that they meet first.
    Leading,
    /// Both, about the middle of the shape.
    Both,
}

/// How far damage reaches in each direction from a point that stays; mm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Star {
    /// The point, (s, z) in the frame of the shape.
    origin: [f64; 2],
    /// -1 where the edge that stays is the last one: rays count from there.
    sign: f64,
    /// Whether the point is within the damage.
    is_inside: bool,
    /// Angles from the first to the last, rad, and the reach along each.
    rays: Vec<(f64, f64)>,
    /// Along s.
    length: f64,
}

impl Star {
    /// Of polygons. `edge` moves; `towards_plus` says whether rolling elements pass from the first s to the last. `None`
    /// where the polygons have no extent.
    pub(super) fn of(polygons: &[Vec<[f64; 2]>], edge: Edge, towards_plus: bool) -> Option<Self> {
        let is_inside = edge == Edge::Both;
        let sign = if is_inside || (edge == Edge::Trailing) == towards_plus { 1.0 } else { -1.0 };
        let turned = |p: &[f64; 2]| [sign * p[0], p[1]];
        let points: Vec<[f64; 2]> = polygons.iter().flatten().map(turned).collect();
        let s = || points.iter().map(|p| p[0]);
        let (first, last) = (s().fold(f64::INFINITY, f64::min), s().fold(f64::NEG_INFINITY, f64::max));
        let span = last - first;
        if !(span > 0.0 && span.is_finite()) {
            return None;
        }
        let on_edge: Vec<f64> = points.iter().filter(|p| p[0] - first <= 1e-6 * span).map(|p| p[1]).collect();
        let stays = match is_inside {
            true => [0.5 * (first + last), 0.0],
            false => [first, on_edge.iter().sum::<f64>() / on_edge.len() as f64],
        };
        let from_there = |p: &[f64; 2]| [sign * p[0] - stays[0], p[1] - stays[1]];
        let sides = polygons.iter().flat_map(|polygon| {
            let next = polygon.iter().skip(1).chain(polygon.first());
            polygon.iter().zip(next).map(move |(p, q)| [from_there(p), from_there(q)])
        });
        let sides: Vec<[[f64; 2]; 2]> = sides.collect();
        let ray = |angle: f64| (angle, sides.iter().map(|side| reach(angle, side, span)).fold(0.0, f64::max));
        let rays: Vec<(f64, f64)> = angles(&sides, is_inside, span).into_iter().map(ray).collect();
        let mut star = Self { origin: [sign * stays[0], stays[1]], sign, is_inside, rays, length: 1.0 };
        star.length = star.extent(1.0, [f64::INFINITY; 2]);
        (star.length > 0.0).then_some(star)
    }

    /// Corners seen from the point that stays, counted along s from the edge; `room` is what there is below and above it, mm.
    fn corners(&self, scale: f64, [below, above]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        self.rays.iter().map(move |(angle, reach)| {
            let (sin, cos) = angle.sin_cos();
            let room = match sin {
                sin if sin.abs() < 1e-12 => f64::INFINITY,
                sin if sin < 0.0 => below / -sin,
                sin => above / sin,
            };
            let reach = (scale * reach).min(room.max(0.0));
            [reach * cos, reach * sin]
        })
    }

    fn extent(&self, scale: f64, room: [f64; 2]) -> f64 {
        let (low, high) = self
            .corners(scale, room)
            .fold((0.0, 0.0), |(low, high): (f64, f64), corner| (low.min(corner[0]), high.max(corner[0])));
        high - low
    }

    /// The outline of this length in the frame of the shape as it is at failure, where it has the length `fails` and lies
    /// about the shape's own middle; within `widest` about z = `middle` of that frame. The outline of a larger length holds that
    /// of a smaller one.
    pub(super) fn grown(&self, length: f64, fails: f64, widest: f64, middle: f64) -> Vec<[f64; 2]> {
        let end = fails / self.length;
        let z = || self.corners(end, [f64::INFINITY; 2]).map(|corner| corner[1]);
        let width = z().fold(0.0, f64::max) - z().fold(0.0, f64::min);
        // Of a shape that is wider than there is room for, the point is as far from the middle as the room allows.
        let off = end * self.origin[1] - middle;
        let off = (off * (widest / width).min(1.0)).clamp(-0.5 * widest, 0.5 * widest);
        let stays = [end * self.origin[0], middle + off];
        let room = [0.5 * widest + stays[1] - middle, 0.5 * widest - stays[1] + middle];
        // Where the width has its bound, the length grows slower than the scale.
        let [mut low, mut high] = [0.0, length / self.length];
        for _ in 0..HALVINGS {
            if self.extent(high, room) >= length * (1.0 - 1e-12) {
                break;
            }
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *if self.extent(middle, room) < length { &mut low } else { &mut high } = middle;
        }
        let placed = |[s, z]: [f64; 2]| [stays[0] + self.sign * s, stays[1] + z].map(rounded);
        let own = (!self.is_inside).then_some([0.0, 0.0]);
        let mut corners: Vec<[f64; 2]> = own.into_iter().chain(self.corners(high, room)).map(placed).collect();
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        // A corner on the straight line between its neighbours says nothing.
        let mut kept: Vec<[f64; 2]> = Vec::with_capacity(corners.len());
        for (k, corner) in corners.iter().enumerate() {
            let next = corners[(k + 1) % corners.len()];
            let before = *kept.last().unwrap_or(&corners[corners.len() - 1]);
            if across(before, *corner, next) > 2.0 / NANOMETRES {
                kept.push(*corner);
            }
        }
        kept
    }
}

fn rounded(x: f64) -> f64 {
    (x * NANOMETRES).round() / NANOMETRES
}

/// Distance of `b` from the straight line from `a` to `c`, ends included.
fn across(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let [u, v] = [[c[0] - a[0], c[1] - a[1]], [b[0] - a[0], b[1] - a[1]]];
    let square = u[0] * u[0] + u[1] * u[1];
    let along = if square > 0.0 { ((u[0] * v[0] + u[1] * v[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    (v[0] - along * u[0]).hypot(v[1] - along * u[1])
}

/// Directions in which the reach is looked for.
fn angles(sides: &[[[f64; 2]; 2]], all_around: bool, span: f64) -> Vec<f64> {
    let half = if all_around { PI } else { FRAC_PI_2 };
    let count = if all_around { 2 * DIRECTIONS } else { DIRECTIONS };
    // Of a full turn the last one is the first.
    let even = (0..=count).skip(usize::from(all_around));
    let mut angles: Vec<f64> = even.map(|k| half * (2.0 * f64::from(k) / f64::from(count) - 1.0)).collect();
    if sides.len() <= FEW_CORNERS {
        let corners = sides.iter().map(|side| side[0]).filter(|p| p[0].hypot(p[1]) > 1e-9 * span);
        angles.extend(corners.map(|p| p[1].atan2(p[0])));
    }
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    angles
}

/// How far a side reaches along a direction; 0 where it does not cross it.
fn reach(angle: f64, [p, q]: &[[f64; 2]; 2], span: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let along = |p: &[f64; 2]| p[0] * cos + p[1] * sin;
    let aside = |p: &[f64; 2]| p[1] * cos - p[0] * sin;
    let hair = 1e-9 * span;
    let [a, b] = [aside(p), aside(q)];
    let on_ray = |p: &[f64; 2], aside: f64| if aside.abs() <= hair { along(p) } else { 0.0 };
    let crossed = if a * b < 0.0 { along(p) + (along(q) - along(p)) * a / (a - b) } else { 0.0 };
    crossed.max(on_ray(p, a)).max(on_ray(q, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_rectangle_grows_from_its_leading_edge_up_to_its_width() {
        let shape = [vec![[-2.0, -1.0], [2.0, -1.0], [2.0, 1.0], [-2.0, 1.0]]];
        let extent = |outline: &[[f64; 2]], k: usize| {
            let x = || outline.iter().map(|p| p[k]);
            [x().fold(f64::INFINITY, f64::min), x().fold(f64::NEG_INFINITY, f64::max)]
        };
        for (edge, towards_plus, ends) in [
            (Edge::Trailing, true, [-2.0, 0.0]),
            (Edge::Trailing, false, [0.0, 2.0]),
            (Edge::Leading, true, [0.0, 2.0]),
            (Edge::Both, true, [-1.0, 1.0]),
        ] {
            let star = Star::of(&shape, edge, towards_plus).unwrap();
            let outline = star.grown(2.0, 4.0, f64::INFINITY, 0.0);
            assert_eq!((extent(&outline, 0), extent(&outline, 1)), (ends, [-0.5, 0.5]), "{edge:?}");
            assert_eq!(outline.len(), 4 + usize::from(false), "{outline:?}");
            // Twice as long at failure, in a track of 1.2 mm.
            let outline = star.grown(8.0, 8.0, 1.2, 0.0);
            assert_eq!((extent(&outline, 0), extent(&outline, 1)), ([-4.0, 4.0], [-0.6, 0.6]), "{edge:?}");
        }
        assert!(Star::of(&[], Edge::Trailing, true).is_none());
    }
}
