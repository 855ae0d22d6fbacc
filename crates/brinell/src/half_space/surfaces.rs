//! The tables of a bearing's damage.

use super::build::{self, Accuracy, BuildError, Range};
use super::damage::{Damage, gather};
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

/// The next of the steps of a quarter of an octave, m: loads that differ little share their tables.
fn step_up(deflection: f64) -> f64 {
    let least = deflection.max(1e-8);
    (4.0 * least.log2()).ceil().mul_add(0.25, 0.0).exp2()
}
