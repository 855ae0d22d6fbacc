//! Damage seen from above: the inside of polygons by the even-odd rule. Points (s, z) in m.

use super::piecewise::{Line, PiecewisePolynomial};
use std::collections::HashSet;

/// Places where sides of an outline may cross: each is a corner of L_s.
pub const MOST_CROSSINGS: usize = 10_000;
/// Pairs of sides that are compared to find them: an outline of a hundred thousand short sides takes a tenth.
const MOST_COMPARED: usize = 50_000_000;

/// Why the crossings of polygons were not all looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Tangle {
    /// There are too many.
    #[error("sides cross in more than {} places", MOST_CROSSINGS)]
    Crossings,
    /// There are too many places to look at.
    #[error(
        "so many long sides are side by side that their crossings cannot be counted (more than {:e} pairs)",
        MOST_COMPARED as f64
    )]
    Neighbours,
}

/// What is wrong with polygons; coordinates in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fault {
    /// No polygon at all.
    Nothing,
    /// A polygon of fewer than three different corners, counted from 0: an open line.
    Open {
        /// Which polygon.
        polygon: usize,
    },
    /// A coordinate that is not finite.
    NotFinite {
        /// Which polygon.
        polygon: usize,
    },
    /// A polygon without area.
    Flat {
        /// Which polygon.
        polygon: usize,
    },
    /// A polygon that crosses itself.
    CrossesItself {
        /// Which polygon.
        polygon: usize,
        /// Where.
        at: [f64; 2],
    },
    /// Two polygons that cross: where they overlap, the even-odd rule leaves the surface undamaged.
    Cross {
        /// Which polygons.
        polygons: [usize; 2],
        /// Where.
        at: [f64; 2],
    },
    /// Too many crossings to be an outline.
    Tangled(Tangle),
}

/// An edge from left to right.
#[derive(Debug, Clone, Copy)]
struct Edge {
    polygon: usize,
    left: [f64; 2],
    right: [f64; 2],
}

impl Edge {
    /// z at s.
    fn at(&self, s: f64) -> f64 {
        let share = (s - self.left[0]) / (self.right[0] - self.left[0]);
        self.left[1] + (self.right[1] - self.left[1]) * share
    }
}

/// Polygons with their width L_s(s).
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    polygons: Vec<Vec<[f64; 2]>>,
    width: PiecewisePolynomial,
}

impl Outline {
    /// From polygons in m. `None` where one has a coordinate that is not finite, nothing has an area, or sides cross in
    /// too many places.
    pub fn new(polygons: Vec<Vec<[f64; 2]>>) -> Option<Self> {
        if !polygons.iter().flatten().flatten().all(|x| x.is_finite()) {
            return None;
        }
        let width = width(&polygons, f64::INFINITY)?;
        (width.integral() > 0.0).then_some(Self { polygons, width })
    }

    /// The same, moved along z by `offset` (m).
    pub fn moved(mut self, offset: f64) -> Self {
        for point in self.polygons.iter_mut().flatten() {
            point[1] += offset;
        }
        self
    }

    /// The same with L_s counted within |z| <= L/2 alone, for a roller of length L (m).
    pub fn within(mut self, length: f64) -> Self {
        let (low, high) = self.heights();
        let half = 0.5 * length;
        if (low < -half || high > half)
            && let Some(width) = width(&self.polygons, half)
        {
            self.width = width;
        }
        self
    }

    /// The s at which sides cross the line z = 0, rising: damage begins and ends by turns.
    pub(super) fn crossings_of_bottom(&self) -> Vec<f64> {
        let all = self.polygons.iter().flat_map(|p| sides(p));
        let mut crossed: Vec<f64> = all
            .filter(|(p, q)| (p[1] <= 0.0) != (q[1] <= 0.0))
            .map(|(p, q)| p[0] - (q[0] - p[0]) * p[1] / (q[1] - p[1]))
            .collect();
        crossed.sort_by(f64::total_cmp);
        crossed
    }

    /// The same, larger by `factor` in both directions about the origin.
    pub fn scaled(&self, factor: f64) -> Option<Self> {
        let scaled = |p: &Vec<[f64; 2]>| p.iter().map(|x| x.map(|x| x * factor)).collect();
        Self::new(self.polygons.iter().map(scaled).collect())
    }

    /// The polygons.
    pub fn polygons(&self) -> &[Vec<[f64; 2]>] {
        &self.polygons
    }

    /// L_s(s): the measure of the damaged z at s, straight between corners.
    pub fn width(&self) -> &PiecewisePolynomial {
        &self.width
    }

    /// Smallest and largest z, m.
    pub fn heights(&self) -> (f64, f64) {
        let z = || self.polygons.iter().flatten().map(|p| p[1]);
        (z().fold(f64::INFINITY, f64::min), z().fold(f64::NEG_INFINITY, f64::max))
    }
}

/// Sides of a closed polygon.
fn sides(polygon: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    let next = polygon.iter().skip(1).chain(polygon.first());
    polygon.iter().copied().zip(next.copied())
}

/// Twice the signed area.
fn double_area(polygon: &[[f64; 2]]) -> f64 {
    sides(polygon).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum()
}

fn edges(polygons: &[Vec<[f64; 2]>]) -> Vec<Edge> {
    let mut all = Vec::new();
    for (polygon, corners) in polygons.iter().enumerate() {
        for (p, q) in sides(corners).filter(|(p, q)| p != q) {
            let (left, right) = if p[0] <= q[0] { (p, q) } else { (q, p) };
            all.push(Edge { polygon, left, right });
        }
    }
    all.sort_by(|a, b| a.left[0].total_cmp(&b.left[0]));
    all
}

/// L_s(s) within |z| <= `half` by a sweep over the corners: between two of them the edges keep their order and L_s is
/// straight. `None` where they cross in too many places.
fn width(polygons: &[Vec<[f64; 2]>], half: f64) -> Option<PiecewisePolynomial> {
    let edges = edges(polygons);
    let mut stops: Vec<f64> = polygons.iter().flatten().map(|p| p[0]).collect();
    stops.extend(crossings(&edges).ok()?.iter().map(|(_, at)| at[0]));
    for edge in &edges {
        let [low, high] = [edge.left[1], edge.right[1]];
        for z in [-half, half] {
            if (low - z) * (high - z) < 0.0 {
                let share = (z - low) / (high - low);
                stops.push(edge.left[0] + share * (edge.right[0] - edge.left[0]));
            }
        }
    }
    stops.sort_by(f64::total_cmp);
    stops.dedup();
    let mut lines: Vec<Line> = Vec::with_capacity(stops.len());
    let mut active: Vec<Edge> = Vec::new();
    let mut next = 0;
    for pair in stops.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        while next < edges.len() && edges[next].left[0] <= a {
            active.push(edges[next]);
            next += 1;
        }
        active.retain(|e| e.right[0] >= b);
        let middle = 0.5 * (a + b);
        active.sort_by(|e, f| e.at(middle).total_cmp(&f.at(middle)));
        let sum = |s: f64| {
            active
                .chunks_exact(2)
                .map(|pair| {
                    let [low, high] = [&pair[0], &pair[1]].map(|e| e.at(s).clamp(-half, half));
                    (high - low).max(0.0)
                })
                .sum::<f64>()
        };
        let line = Line { from: a, to: b, at_from: sum(a), at_to: sum(b) };
        if line.at_from > 0.0 || line.at_to > 0.0 {
            lines.push(line);
        }
    }
    Some(PiecewisePolynomial::of_lines(&lines))
}

/// Where two edges cross properly: of which polygons they are, and the point.
type Crossing = ([usize; 2], [f64; 2]);

/// Every crossing. Edges must be sorted by their left ends.
fn crossings(edges: &[Edge]) -> Result<Vec<Crossing>, Tangle> {
    let mut found = Vec::new();
    let mut active: Vec<&Edge> = Vec::new();
    let mut compared = 0;
    for e in edges {
        active.retain(|a| a.right[0] >= e.left[0]);
        compared += active.len();
        if compared > MOST_COMPARED {
            return Err(Tangle::Neighbours);
        }
        let (low, high) = (e.left[1].min(e.right[1]), e.left[1].max(e.right[1]));
        for a in &active {
            if a.left[1].min(a.right[1]) <= high
                && a.left[1].max(a.right[1]) >= low
                && let Some(at) = crossing(a, e)
            {
                found.push(([a.polygon, e.polygon], at));
            }
        }
        if found.len() > MOST_CROSSINGS {
            return Err(Tangle::Crossings);
        }
        active.push(e);
    }
    Ok(found)
}

/// Refuses polygons whose sides cross in too many places, before anything is computed from them.
///
/// # Errors
/// Where they do.
pub fn check_crossings(polygons: &[Vec<[f64; 2]>]) -> Result<(), Tangle> {
    crossings(&edges(polygons)).map(drop)
}

/// The point where two edges cross within both; touching is no crossing.
fn crossing(a: &Edge, b: &Edge) -> Option<[f64; 2]> {
    let side = |e: &Edge, p: [f64; 2]| {
        (e.right[0] - e.left[0]) * (p[1] - e.left[1]) - (e.right[1] - e.left[1]) * (p[0] - e.left[0])
    };
    let (a0, a1) = (side(b, a.left), side(b, a.right));
    let (b0, b1) = (side(a, b.left), side(a, b.right));
    // Below this a corner lies on the other edge, as far as round-off can tell.
    let size = |e: &Edge| (e.right[0] - e.left[0]).abs() + (e.right[1] - e.left[1]).abs();
    let least = 1e-12 * size(a) * size(b);
    if a0 * a1 >= 0.0 || b0 * b1 >= 0.0 || [a0, a1, b0, b1].iter().any(|x| x.abs() <= least) {
        return None;
    }
    let share = a0 / (a0 - a1);
    Some([0, 1].map(|k| a.left[k] + share * (a.right[k] - a.left[k])))
}

/// Everything wrong with polygons; [`Fault::CrossesItself`] and [`Fault::Cross`] can still be simulated.
pub fn faults(polygons: &[Vec<[f64; 2]>]) -> Vec<Fault> {
    let mut faults = Vec::new();
    if polygons.is_empty() {
        faults.push(Fault::Nothing);
    }
    for (polygon, corners) in polygons.iter().enumerate() {
        if !corners.iter().flatten().all(|x| x.is_finite()) {
            faults.push(Fault::NotFinite { polygon });
            continue;
        }
        let mut different: Vec<&[f64; 2]> = corners.iter().collect();
        different.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        different.dedup();
        let extent = corners.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        if different.len() < 3 {
            faults.push(Fault::Open { polygon });
        } else if double_area(corners).abs() <= 1e-12 * extent * extent {
            // A figure of eight can have no net area either; crossing itself is what is wrong with it.
            let own = edges(std::slice::from_ref(corners));
            if crossings(&own).is_ok_and(|found| found.is_empty()) {
                faults.push(Fault::Flat { polygon });
            }
        }
    }
    if faults.iter().any(|f| matches!(f, Fault::NotFinite { .. } | Fault::Nothing)) {
        return faults;
    }
    let crossings = match crossings(&edges(polygons)) {
        Ok(crossings) => crossings,
        Err(tangle) => {
            faults.push(Fault::Tangled(tangle));
            return faults;
        }
    };
    let mut named: HashSet<[usize; 2]> = HashSet::new();
    for (mut pair, at) in crossings {
        pair.sort_unstable();
        if !named.insert(pair) {
            continue;
        }
        faults.push(if pair[0] == pair[1] {
            Fault::CrossesItself { polygon: pair[0], at }
        } else {
            Fault::Cross { polygons: pair, at }
        });
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn square(half: f64) -> Vec<[f64; 2]> {
        vec![[-half, -half], [half, -half], [half, half], [-half, half]]
    }

    #[test]
    fn analytic_square_with_a_hole() {
        let o = Outline::new(vec![square(2.0), square(1.0)]).unwrap();
        assert!((o.width().integral() - 12.0).abs() < 1e-13);
        assert_eq!((o.width().value(0.0), o.width().value(1.5), o.width().value(2.1)), (2.0, 4.0, 0.0));
        assert_eq!(o.clone().within(3.0).width().value(0.0), 1.0);
        let moved = o.moved(1.0).within(4.0);
        assert_eq!((moved.width().value(0.0), moved.width().value(1.5)), (1.0, 3.0));
    }

    #[test]
    fn analytic_faults_are_distinguished() {
        let bow = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(matches!(faults(&[bow])[..], [Fault::CrossesItself { polygon: 0, .. }]));
        assert_eq!(faults(&[vec![[0.0, 0.0], [1.0, 1.0]]]), [Fault::Open { polygon: 0 }]);
        let flat = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
        assert_eq!(faults(&[flat]), [Fault::Flat { polygon: 0 }]);
        assert_eq!(faults(&[]), [Fault::Nothing]);
        let moved = square(1.0).iter().map(|p| [p[0] + 0.5, p[1] + 0.5]).collect();
        assert!(matches!(faults(&[square(1.0), moved])[..], [Fault::Cross { polygons: [0, 1], .. }]));
        assert!(faults(&[square(2.0), square(1.0)]).is_empty());
        // Points all over the place: every third pair of sides crosses.
        let mut random = Random::new(1);
        let mut point = || [random.uniform(), random.uniform()];
        let tangled: Vec<[f64; 2]> = (0..3000).map(|_| point()).collect();
        let tangled = [tangled];
        assert_eq!(faults(&tangled), [Fault::Tangled(Tangle::Crossings)]);
        assert!(Outline::new(tangled.to_vec()).is_none());
        // Halves that share an edge touch and do not cross.
        let left = vec![[-1.0, -1.0], [0.0, -1.0], [0.0, 1.0], [-1.0, 1.0]];
        let right = vec![[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]];
        assert!(faults(&[left, right]).is_empty());
    }
}
