//! The line along which a grid has one depth, as polygons.

use crate::contour::Field;
use crate::error::{DamageError, check_range};
use crate::geometry::{Polygons, signed_area};
use brinell::defect::{Fault, faults};
use brinell::scenario::DepthGrid;

/// Depths beyond are no damage; what is computed with them stays finite.
pub(crate) const DEEPEST_UM: f64 = 1e9;

/// That a grid is one, of a size and of depths that can be reckoned with.
pub(crate) fn check_grid(grid: &DepthGrid) -> Result<(), DamageError> {
    let DepthGrid { s0_mm, z0_mm, ds_mm, dz_mm, columns, rows, depth_um } = grid;
    let sound = (*columns).min(*rows) >= 2
        && columns.checked_mul(*rows) == Some(depth_um.len())
        && [ds_mm, dz_mm].iter().all(|step| (1e-9..=1e4).contains(*step))
        && [s0_mm, z0_mm].iter().all(|origin| origin.abs() <= 1e4)
        && depth_um.iter().all(|depth| depth.abs() <= DEEPEST_UM);
    if sound {
        return Ok(());
    }
    let depths = depth_um.len();
    Err(DamageError::Option {
        option: "grid",
        value: format!(
            "{depths} depths of {columns} columns and {rows} rows, {ds_mm} by {dz_mm} mm apart, from ({s0_mm}, {z0_mm}) mm"
        ),
        allowed: "2 columns and rows or more, 1e-9 mm to 10 m apart and beginning within 10 m, with a depth within 1 km at each node",
    })
}

/// What is deeper than `level_um`, its border found between nodes by straight interpolation (marching squares) and
/// then freed of the corners that lie within `tolerance_mm` of it; along the grid's edge where damage reaches that.
///
/// Polygons as elsewhere: outer rings counter-clockwise, holes clockwise, none crossing itself or another.
///
/// # Errors
///
/// Sizes that do not fit the depths, or are no numbers; a level below 0 or a tolerance below 0; nothing deeper than the level;
/// a border of more than two million points.
pub fn outline(grid: &DepthGrid, level_um: f64, tolerance_mm: f64) -> Result<Polygons, DamageError> {
    check_grid(grid)?;
    check_range("level_um", level_um, -f64::MIN_POSITIVE, f64::MAX, "a depth of 0 um or more")?;
    check_range("tolerance_mm", tolerance_mm, -f64::MIN_POSITIVE, f64::MAX, "a distance of 0 mm or more")?;
    let mut rings = field(grid, level_um).outlines(0.0)?.rings;
    if rings.is_empty() {
        return Err(DamageError::NothingDamaged {
            why: format!("no depth is above `level_um` = {level_um}; the deepest is {} um", grid.deepest_um()),
        });
    }
    for point in rings.iter_mut().flatten() {
        // Node (0, 0) is the middle of pixel (0, 0).
        *point = [grid.s0_mm + (point[0] - 0.5) * grid.ds_mm, grid.z0_mm + (point[1] - 0.5) * grid.dz_mm];
    }
    Ok(Polygons {
        polygons_mm: simplified(rings, tolerance_mm),
        warnings: Vec::new(),
        notes: Vec::new(),
        threshold: None,
    })
}

/// The level, um, at which [`outline`] encloses `area_mm2`; 0 where even that encloses less.
///
/// # Errors
///
/// Sizes that do not fit the depths, or are no numbers; an area below 0; outlines of more than two million points.
pub fn level_of_area(grid: &DepthGrid, area_mm2: f64) -> Result<f64, DamageError> {
    /// Halvings of the deepest depth: to a part in a million.
    const HALVINGS: u32 = 20;
    check_grid(grid)?;
    check_range("area_mm2", area_mm2, -f64::MIN_POSITIVE, f64::MAX, "an area of 0 mm^2 or more")?;
    let cell = grid.ds_mm * grid.dz_mm;
    let (mut low, mut high) = (0.0, grid.deepest_um());
    for _ in 0..HALVINGS {
        let level = 0.5 * (low + high);
        let rings = field(grid, level).outlines(0.0)?.rings;
        let area: f64 = rings.iter().map(|ring| cell * signed_area(ring)).sum();
        if area > area_mm2 {
            low = level;
        } else {
            high = level;
        }
    }
    Ok(high)
}

fn field(grid: &DepthGrid, level: f64) -> Field<'_, f64> {
    Field { width: grid.columns, height: grid.rows, values: &grid.depth_um, level, rim: 0.0, sub_pixel: true }
}

/// The rings with fewer corners; a tolerance under which they would cross is halved.
fn simplified(rings: Vec<Vec<[f64; 2]>>, mut tolerance: f64) -> Vec<Vec<[f64; 2]>> {
    /// A tolerance of less than a thousandth of what was requested changes next to nothing.
    const HALVINGS: u32 = 10;
    for _ in 0..HALVINGS {
        let fewer: Vec<Vec<[f64; 2]>> = rings
            .iter()
            .map(|ring| without_close_corners(ring, tolerance))
            .filter(|ring| ring.len() > 2 && signed_area(ring) != 0.0)
            .collect();
        let cross = |f: &Fault| matches!(f, Fault::CrossesItself { .. } | Fault::Cross { .. });
        if !fewer.is_empty() && !faults(&fewer).iter().any(cross) {
            return fewer;
        }
        tolerance *= 0.5;
    }
    rings
}

/// Douglas and Peucker's choice of corners on a closed ring: no corner left out lies farther than `tolerance` from the
/// side in its place.
fn without_close_corners(ring: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let squared = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
    let farthest = |from: usize| {
        let distance = |k: &usize| squared(ring[*k], ring[from]);
        (0..ring.len()).max_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    // Two corners that stay: the one farthest from the first, and the one farthest from that.
    let (Some(a), Some(b)) = (farthest(0), farthest(0).and_then(farthest)) else {
        return Vec::new();
    };
    let (low, high) = (a.min(b), a.max(b));
    let at = |k: usize| ring[k % ring.len()];
    let mut kept = vec![low, high];
    let mut open = vec![(low, high), (high, low + ring.len())];
    while let Some((from, to)) = open.pop() {
        let off = |k: usize| from_side(at(k), at(from), at(to));
        let worst = (from + 1..to).max_by(|x, y| off(*x).total_cmp(&off(*y)));
        if let Some(k) = worst.filter(|k| off(*k) > tolerance) {
            kept.push(k % ring.len());
            open.extend([(from, k), (k, to)]);
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(at).collect()
}

/// Distance of a point from the side between two others.
fn from_side(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = along[0] * along[0] + along[1] * along[1];
    let share = if length > 0.0 { ((to[0] * along[0] + to[1] * along[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    (to[0] - share * along[0]).hypot(to[1] - share * along[1])
}
