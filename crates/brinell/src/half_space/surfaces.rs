//! The tables of a bearing's damage, and the pressures over it.

use super::build::{self, Accuracy, BuildError, Range};
use super::damage::{Damage, gather, offset};
use super::field::{self, Field};
use super::geometry::Geometry;
use super::shelf::{self, Key};
use crate::defect::{Defect, SIDES, Side};
use crate::effective::Table;
use crate::scenario::{Bearing, Contact};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Makes the tables of all damage that has none yet, each surface's once for every contact that meets it, and gives them to the first
/// defect of each surface. `deflection` is the heaviest static deformation of the healthy contact on a side, m.
///
/// # Errors
/// Where the contact makes no table: lengths that are not positive, damage too large for a table.
pub fn add_tables(
    defects: &mut [Defect],
    (bearing, contact): (&Bearing, &Contact),
    deflection: impl Fn(Side) -> f64,
) -> Result<(), BuildError> {
    let own: Vec<usize> =
        (0..defects.len()).filter(|k| SIDES.iter().all(|s| defects[*k].table(*s).is_none())).collect();
    let to_make: Vec<Defect> = own.iter().map(|k| defects[*k].clone()).collect();
    let ranges = SIDES.map(|side| Range::of(step_up(deflection(side))));
    let geometries = SIDES.map(|side| Geometry::of_bearing(bearing, contact, side));
    let edge = 1e-6 * contact.edge_radius_um;
    let reach = |defect: &Defect| {
        let of = |side: Side| {
            let (geometry, range) = (&geometries[side as usize], &ranges[side as usize]);
            let met = defect.depth_profile(side).is_some();
            geometry.as_ref().filter(|_| met).map_or(0.0, |g| g.reach(range.largest + defect.raised()))
        };
        of(Side::Inner).max(of(Side::Outer))
    };
    for group in gather(&to_make, reach) {
        let first = group[0];
        for side in SIDES {
            let (Some(geometry), range) = (&geometries[side as usize], &ranges[side as usize]) else {
                continue;
            };
            if to_make[first].depth_profile(side).is_none() {
                continue;
            }
            let members = group.iter().map(|m| {
                let d = &to_make[*m];
                (&d.shape, d.depth, d.middle, d.center - to_make[first].center, d.radius)
            });
            let accuracy = Accuracy::Standard;
            let key =
                Key::of(format_args!("{geometry:?} {range:?} {edge:?} {accuracy:?} {:?}", members.collect::<Vec<_>>()));
            let table: Arc<Table> = shelf::table(key, || {
                let damage = Damage::of(&to_make, &group, edge);
                let threads = brinell_signal::parallel::threads(usize::MAX);
                Ok(build::table(geometry, &damage.raster, range, accuracy, threads, &AtomicBool::new(false))?.table)
            })?;
            defects[own[first]].use_table_at(side, table);
        }
    }
    Ok(())
}

/// Pressures under a contact that passes the damage `defects[of]` at the deformation `delta` (m), where they are largest; with all damage
/// that the contact meets there. s is from the defect's centre. `None` where nothing touches, or the defect does not meet the side.
pub fn pressure_over(
    (defects, of): (&[Defect], usize),
    (bearing, contact): (&Bearing, &Contact),
    side: Side,
    delta: f64,
) -> Option<Field> {
    let defect = &defects[of];
    defect.depth_profile(side)?;
    let geometry = Geometry::of_bearing(bearing, contact, side)?;
    let groups = gather(defects, |d| geometry.reach(delta + d.raised()));
    let group = groups.into_iter().find(|group| group.contains(&of))?;
    let damage = Damage::of(defects, &group, 1e-6 * contact.edge_radius_um);
    let apart = offset(defect, &defects[group[0]]);
    let (first, last) = defect.shape.arc();
    let between = [first + apart, last + apart];
    field::largest_pressure(&geometry, &damage.raster, delta, between).map(|field| field.seen_from(apart))
}

/// The largest pressure of the healthy contact at the deformation `delta` (m), Pa.
pub fn healthy_pressure((bearing, contact): (&Bearing, &Contact), side: Side, delta: f64) -> Option<f64> {
    field::healthy(&Geometry::of_bearing(bearing, contact, side)?, delta)
}

/// The next of the steps of a quarter of an octave, m: loads that differ little share their tables.
fn step_up(deflection: f64) -> f64 {
    let least = deflection.max(1e-8);
    (4.0 * least.log2()).ceil().mul_add(0.25, 0.0).exp2()
}
