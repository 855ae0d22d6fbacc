//! Defects that one contact can meet together, as one surface: the deepest at each point (section 19).

use super::raster::{Bounds, Raster};
use crate::defect::{Defect, MeanDepths, wrap};
use crate::scenario::Surface;

/// Damage of one surface that a table stands for.
#[derive(Debug, Clone, PartialEq)]
pub struct Damage {
    /// The surface; a roller counts from 0.
    pub surface: Surface,
    /// Row, from 0.
    pub row: usize,
    /// Angle psi of s = 0, rad: the first defect's.
    pub center: f64,
    /// R of the surface, m.
    pub radius: f64,
    /// Which of the defects it is made of.
    pub members: Vec<usize>,
    /// Its depths over s and z.
    pub raster: Raster,
}

/// Length along s of a defect about its centre, m.
fn span(defect: &Defect) -> [f64; 2] {
    defect.shape.arc().into()
}

/// Gathers defects into what is met together: on one surface of one row, nearer to each other along s than `reach` (m) of either, the
/// length over which a contact feels damage before its first edge: the places of each group's members, rising.
pub fn gather(defects: &[Defect], reach: impl Fn(&Defect) -> f64) -> Vec<Vec<usize>> {
    // What is asked of each pair is known of each defect first: thousands make millions of pairs.
    let felt: Vec<[f64; 2]> = defects
        .iter()
        .map(|d| {
            let ([first, last], reach) = (span(d), reach(d));
            [first - reach, last + reach]
        })
        .collect();
    let mut group: Vec<usize> = (0..defects.len()).collect();
    for a in 0..defects.len() {
        for b in 0..a {
            let (one, other) = (&defects[a], &defects[b]);
            if group[a] == group[b] || one.surface != other.surface || one.row != other.row {
                continue;
            }
            let ([first, last], [from, to]) = (felt[a].map(|s| s + offset(one, other)), felt[b]);
            if first < to && from < last {
                let (keep, join) = (group[b], group[a]);
                group.iter_mut().filter(|g| **g == join).for_each(|g| *g = keep);
            }
        }
    }
    let mut all: Vec<Vec<usize>> = Vec::new();
    for (k, own) in group.iter().enumerate() {
        // Each group at its first member.
        if group.iter().position(|g| g == own) != Some(k) {
            continue;
        }
        all.push((k..defects.len()).filter(|m| group[*m] == *own).collect());
    }
    all
}

/// From the centre of one defect to that of another of its surface along s, m.
pub(super) fn offset(of: &Defect, from: &Defect) -> f64 {
    wrap(of.center - from.center) * from.radius
}

impl Damage {
    /// Of one group of [`gather`]; `edge` (m) rounds edges.
    pub fn of(defects: &[Defect], members: &[usize], edge: f64) -> Self {
        let first = &defects[members[0]];
        let shifted: Vec<(f64, MeanDepths<'_>)> =
            members.iter().map(|m| (offset(&defects[*m], first), MeanDepths::new(&defects[*m]))).collect();
        Self {
            surface: first.surface,
            row: first.row,
            center: first.center,
            radius: first.radius,
            members: members.to_vec(),
            raster: raster(&shifted, edge),
        }
    }
}

/// Depths of defects whose centres lie at these s (m).
fn raster(defects: &[(f64, MeanDepths<'_>)], edge: f64) -> Raster {
    let mut bounds: Option<Bounds> = None;
    let join = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    for (at, defect) in defects {
        let [s, z] = defect.bounds();
        let s = s.map(|s| s + at);
        bounds = Some(bounds.map_or(Bounds { s, z }, |all| Bounds { s: join(all.s, s), z: join(all.z, z) }));
    }
    let bounds = bounds.unwrap_or(Bounds { s: [0.0; 2], z: [0.0; 2] });
    let mut own = Vec::new();
    Raster::new(bounds, edge, |[from, to], column| {
        let cells = (bounds.z[0], (bounds.z[1] - bounds.z[0]) / column.len() as f64);
        for (at, defect) in defects {
            own.clear();
            own.resize(column.len(), 0.0);
            defect.add([from - at, to - at], cells, &mut own);
            for (all, own) in column.iter_mut().zip(&own) {
                *all = if *all == 0.0 || *own == 0.0 { *all + own } else { all.max(*own) };
            }
        }
    })
}
