//! The tables of a bearing's damage, and the pressures over it.

use super::build::{self, Range};
use super::damage::{Damage, gather, offset};
use super::error::BuildError;
use super::field::{self, Field};
use super::geometry::Geometry;
use super::raster::Bounds;
use super::shelf::{self, Key};
use crate::defect::{Defect, SIDES, Side};
use crate::effective::{Table, Tilted};
use crate::scenario::{Bearing, Contact, Tables};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Tilts of tables: how much deeper one end of the roller lies than its middle, over the static deformation.
const TILTS: [f64; 4] = [0.0, 1.0, 3.0, 9.0];

/// One contact that meets damage.
struct Met<'a> {
    geometry: &'a Geometry,
    range: &'a Range,
    /// Length over which edges are rounded, m.
    edge: f64,
    accuracy: Tables,
    /// Whether what is not at hand is made.
    may_make: bool,
    /// What the damage is made of, as far as a table depends on it.
    of: String,
}

/// Makes the tables of all damage that has none yet, each surface's once for every contact that meets it, and gives them to the first
/// defect of each surface; where rollers tilt (`tilts`) one for each of a few tilts. `deflection` is the heaviest static deformation of the
/// healthy contact on a side, m.
///
/// # Errors
/// Where the contact makes no table: lengths that are not positive, damage too large for a table; unless it `may_make` them, where one is not
/// at hand.
pub(crate) fn add_tables(
    defects: &mut [Defect],
    (bearing, contact): (&Bearing, &Contact),
    (tilts, may_make): (bool, bool),
    deflection: impl Fn(Side) -> f64,
) -> Result<(), BuildError> {
    let own: Vec<usize> =
        (0..defects.len()).filter(|k| SIDES.iter().all(|s| defects[*k].table(*s).is_none())).collect();
    let to_make: Vec<Defect> = own.iter().map(|k| defects[*k].clone()).collect();
    let ranges = SIDES.map(|side| Range::of(step_up(deflection(side))));
    let geometries = SIDES.map(|side| Geometry::of_bearing(bearing, contact, side));
    let edge = 1e-6 * contact.edge_radius_um;
    let most_lead = |range: &Range| if tilts { TILTS[TILTS.len() - 1] * range.static_deflection } else { 0.0 };
    let reach = |defect: &Defect| {
        let of = |side: Side| {
            let (geometry, range) = (&geometries[side as usize], &ranges[side as usize]);
            let met = defect.meets_side(side);
            let most = range.largest + most_lead(range) + defect.shape.raised();
            geometry.as_ref().filter(|_| met).map_or(0.0, |g| g.reach(most))
        };
        of(Side::Inner).max(of(Side::Outer))
    };
    for group in gather(&to_make, reach) {
        let first = group[0];
        for side in SIDES {
            let (Some(geometry), range) = (&geometries[side as usize], &ranges[side as usize]) else {
                continue;
            };
            if !to_make[first].meets_side(side) {
                continue;
            }
            let members = group.iter().map(|m| {
                let d = &to_make[*m];
                (&d.shape, d.depth, d.middle, d.center - to_make[first].center, d.radius)
            });
            let accuracy = contact.tables;
            let met =
                Met { geometry, range, edge, accuracy, may_make, of: format!("{:?}", members.collect::<Vec<_>>()) };
            let upright = met.table(&to_make, &group, 0.0)?;
            if tilts {
                let tables = met.tilted(&to_make, &group, &upright, 0.5 * defects[own[first]].roller_length)?;
                defects[own[first]].use_tilted_at(side, upright, tables);
            } else {
                defects[own[first]].use_table_at(side, upright);
            }
        }
    }
    Ok(())
}

impl Met<'_> {
    /// The table at one tilt, of how much deeper one end lies than the middle, m: that at +z where above 0.
    fn table(&self, defects: &[Defect], group: &[usize], lead: f64) -> Result<Arc<Table>, BuildError> {
        let half = self.geometry.half_across(self.range.largest);
        let geometry = self.geometry.tilted(lead / half);
        let range = Range { largest: self.range.largest + lead.abs(), ..*self.range };
        let (edge, accuracy) = (self.edge, self.accuracy);
        let key = Key::of(format_args!("{geometry:?} {range:?} {edge:?} {accuracy:?} {}", self.of));
        if !self.may_make {
            return shelf::at_hand(key).unwrap_or(Err(BuildError::NotAtHand));
        }
        shelf::table(key, || {
            let damage = Damage::of(defects, group, edge);
            let threads = brinell_signal::parallel::threads(usize::MAX);
            Ok(build::table(&geometry, &damage.raster, &range, accuracy, threads, &AtomicBool::new(false))?.table)
        })
    }

    /// Tables over tilt. Where the contact is alike on both sides of the middle, opposite tilts share theirs.
    fn tilted(
        &self,
        defects: &[Defect],
        group: &[usize],
        upright: &Arc<Table>,
        half: f64,
    ) -> Result<Tilted, BuildError> {
        let mirrored = self.geometry.is_mirrored(&Damage::of(defects, group, self.edge).raster);
        let leads = TILTS.map(|share| share * self.range.static_deflection);
        let mut all = vec![(0.0, upright.clone())];
        for lead in &leads[1..] {
            let up = self.table(defects, group, *lead)?;
            let down = if mirrored { up.clone() } else { self.table(defects, group, -lead)? };
            all.push((lead / half, up));
            all.insert(0, (-lead / half, down));
        }
        let (tilts, tables) = all.into_iter().unzip();
        Ok(Tilted::new(tilts, tables, half))
    }
}

/// Pressures under a contact that passes the damage `defects[of]` at the deformation `delta` (m), where they are largest over that damage
/// and next to its edges (as far as these are rounded); with all damage that the contact meets there. s is from the defect's centre. `None`
/// where nothing touches, or the defect does not meet the side.
pub fn pressure_over(
    (defects, of): (&[Defect], usize),
    (bearing, contact): (&Bearing, &Contact),
    side: Side,
    delta: f64,
) -> Option<Field> {
    let defect = &defects[of];
    if !defect.meets_side(side) {
        return None;
    }
    let geometry = Geometry::of_bearing(bearing, contact, side)?;
    let groups = gather(defects, |d| geometry.reach(delta + d.shape.raised()));
    let group = groups.into_iter().find(|group| group.contains(&of))?;
    let damage = Damage::of(defects, &group, 1e-6 * contact.edge_radius_um);
    let apart = offset(defect, &defects[group[0]]);
    let (first, last) = defect.shape.arc();
    let edge = 1e-6 * contact.edge_radius_um;
    let around = |[low, high]: [f64; 2]| [low - edge, high + edge];
    let bounds = Bounds { s: around([first + apart, last + apart]), z: around(defect.heights()) };
    field::largest_pressure(&geometry, &damage.raster, delta, &bounds).map(|field| field.seen_from(apart))
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
