//! Tables that are no plain grid: three columns x, y, z of a point cloud, and grids with their axes in the first row
//! and column.

use crate::error::DamageError;
use crate::scan::{MAX_POINTS, Raw, SAME};

/// Points under which three columns are taken for a narrow grid.
const LEAST_POINTS: usize = 9;
/// How far a point may lie from its node, in steps.
const OFF_NODE: f64 = 0.1;
/// Share of the nodes that must have a point.
const LEAST_FILLED: f64 = 0.5;

/// A point cloud put on its grid, x to the right and y upwards; another table as it is. `names`: the cells of its line
/// of names; `stated_mm`: the distances of x and of y where they are known.
pub(crate) fn gridded(raw: Raw, names: &[String], stated_mm: [Option<f64>; 2]) -> Result<Raw, DamageError> {
    if raw.width != 3 || raw.height < LEAST_POINTS {
        return Ok(raw);
    }
    let column = |k: usize| raw.values.iter().skip(k).step_by(3).copied();
    let named =
        names.len() == 3 && names.iter().zip(["x", "y", "z"]).all(|(n, axis)| n.to_ascii_lowercase().starts_with(axis));
    let nodes = (Axis::of(column(0)), Axis::of(column(1)));
    let (x, y) = match nodes {
        (Some(x), Some(y)) if is_grid(&x, &y, raw.height) => (x, y),
        _ if named => {
            return Err(DamageError::Unsupported {
                at: "the point cloud".to_owned(),
                what: "a set of points that lie on no regular grid".to_owned(),
                way_out: "resample them to a grid along x and y",
            });
        }
        _ => return Ok(raw),
    };
    let unit = |k: usize| names.get(k).filter(|_| named).and_then(|name| unit_in(name));
    let mm = |axis: &Axis, k: usize| -> Result<f64, DamageError> {
        let factor = unit(k).or_else(|| stated_mm[k].and_then(|mm| factor(axis.step, mm)));
        factor.map(|f| f * axis.step).ok_or_else(|| DamageError::Unsupported {
            at: "the point cloud".to_owned(),
            what: format!("the unit of {}, whose points are {} apart,", ["x", "y"][k], axis.step as f32),
            way_out: "name the columns with their units (x_mm,y_mm,z_um), or give `ds_mm` and `dz_mm`",
        })
    };
    let spacing_mm = [mm(&x, 0)?, mm(&y, 1)?];
    let mut grid = Raw {
        width: x.count,
        height: y.count,
        values: vec![f64::NAN; x.count * y.count],
        spacing_mm: Some(spacing_mm),
        unit_um: unit(2).map(|mm| 1e3 * mm),
        warnings: Vec::new(),
        notes: raw.notes,
    };
    grid.notes.push(format!(
        "read as a point cloud x, y, z: {} x {} nodes, {:.6} x {:.6} mm apart, y upwards",
        x.count, y.count, spacing_mm[0], spacing_mm[1]
    ));
    for point in raw.values.chunks_exact(3) {
        if let (Some(i), Some(j)) = (x.node(point[0]), y.node(point[1])) {
            grid.values[(y.count - 1 - j) * x.count + i] = point[2];
        }
    }
    Ok(grid)
}

fn is_grid(x: &Axis, y: &Axis, points: usize) -> bool {
    let nodes = x.count.saturating_mul(y.count);
    x.count > 1 && y.count > 1 && nodes <= MAX_POINTS && points <= nodes && points as f64 >= LEAST_FILLED * nodes as f64
}

/// Evenly spaced places of points.
struct Axis {
    first: f64,
    step: f64,
    count: usize,
}

impl Axis {
    /// `None` where the places are not evenly spaced.
    fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut all: Vec<f64> = values.collect();
        if all.iter().any(|v| !v.is_finite()) {
            return None;
        }
        all.sort_by(f64::total_cmp);
        let (first, last) = (*all.first()?, *all.last()?);
        let range = last - first;
        let mut gaps: Vec<f64> = all.windows(2).map(|w| w[1] - w[0]).filter(|d| *d > 1e-6 * range).collect();
        if gaps.is_empty() || !range.is_finite() {
            return None;
        }
        gaps.sort_by(f64::total_cmp);
        let nodes = (range / gaps[gaps.len() / 2]).round();
        if !(1.0..MAX_POINTS as f64).contains(&nodes) {
            return None;
        }
        let axis = Self { first, step: range / nodes, count: nodes as usize + 1 };
        all.iter().all(|v| axis.node(*v).is_some()).then_some(axis)
    }

    /// The node at a place, if there is one.
    fn node(&self, value: f64) -> Option<usize> {
        let at = (value - self.first) / self.step;
        let node = at.round();
        ((at - node).abs() <= OFF_NODE && node >= 0.0 && node < self.count as f64).then_some(node as usize)
    }
}

/// mm of the unit in a column's name: `x_mm`, `X (um)`, `z [nm]`.
fn unit_in(name: &str) -> Option<f64> {
    let word = |c: char| !(c.is_alphabetic() || c == '\u{b5}');
    name.split(word).skip(1).find_map(|unit| match unit {
        "m" => Some(1e3),
        "mm" => Some(1.0),
        "um" | "\u{b5}m" | "\u{3bc}m" => Some(1e-3),
        "nm" => Some(1e-6),
        _ => None,
    })
}

/// mm of the unit in which a step is the distance that is stated.
fn factor(step: f64, mm: f64) -> Option<f64> {
    let same = |f: &f64| (f * step / mm - 1.0).abs() <= SAME;
    [1.0, 1e-3, 1e3, 1e-6].into_iter().find(same)
}

/// Refuses a grid whose first row and first column count its axes, as instruments export it.
pub(crate) fn refuse_axes(raw: &Raw) -> Result<(), DamageError> {
    let (w, h) = (raw.width, raw.height);
    if w < 4 || h < 4 {
        return Ok(());
    }
    let row = |r: usize| step_of((1..w).map(|c| raw.values[r * w + c]));
    let column = |c: usize| step_of((1..h).map(|r| raw.values[r * w + c]));
    // A tilted plane without noise has such rows too, all of them.
    let (Some(across), Some(down)) = (row(0), column(0)) else {
        return Ok(());
    };
    if row(1).is_some() && column(1).is_some() {
        return Ok(());
    }
    Err(DamageError::Unsupported {
        at: "line 1 and column 1".to_owned(),
        what: format!("a table whose first row and column count its axes, in steps of {across} and {down},"),
        way_out: "delete both, and give the steps as `ds_mm` and `dz_mm`",
    })
}

/// The step of evenly spaced numbers.
fn step_of(values: impl Iterator<Item = f64>) -> Option<f64> {
    let all: Vec<f64> = values.collect();
    let step = (all.last()? - all.first()?) / (all.len() - 1) as f64;
    let even = |w: &[f64]| ((w[1] - w[0]) / step - 1.0).abs() < 0.02;
    (step.is_finite() && step != 0.0 && all.windows(2).all(even)).then_some(step as f32 as f64)
}
