//! Whether the slices are narrow enough for the edges of the damage.
//!
//! An edge that runs slantwise across a slice reaches its borders at different s. From an edge an envelope sinks by s^2 / (2 R_eq), so strips
//! beside one another sink by different depths, while the slice has one mean depth (section 3) and lets go as a whole. Strips let go one after the
//! other where the edge runs less across the slice than the way in which the envelope sinks by the contact's deformation, sqrt(2 R_eq delta). Of
//! depth maps only the edges are judged, not how the floor varies.

use super::{short, warning};
use crate::defect::{Defect, SIDES, Side, cover_slices, relative_radius};
use crate::document::Problem;
use crate::model::Model;
use crate::scenario::{self, Contact, Law, RollerPath, Scenario, Shape};
use crate::slices::Cover;

/// Places along damage at which its slices are looked at.
const PLACES: usize = 512;
/// Slices in which an edge is measured: its run across one is inversely proportional to their number where the outline is smooth.
const FINE: usize = 100;
/// Damages that are looked at: thousands can be alike.
const DAMAGES: usize = 32;

/// Slices too wide for slanted edges along an envelope; `deformation` is that of the heaviest contact at rest, m.
pub(super) fn coarse_slices(
    scenario: &Scenario,
    model: &Model,
    deformation: f64,
) -> Option<Problem> {
    let c = &scenario.contact;
    let counts = c.law == Law::Sliced
        && c.roller_path == RollerPath::Envelope
        && model.kind.moves_every_part()
        // Under balls they divide the damage, however narrow.
        && !scenario.bearing.has_balls();
    if !counts {
        return None;
    }
    let slanted = |d: &&scenario::Defect| !matches!(d.shape, Shape::Rectangle { .. });
    let fine = Contact {
        slices: FINE,
        ..c.clone()
    };
    let of_all = scenario
        .defects
        .iter()
        .filter(slanted)
        .take(DAMAGES)
        .filter_map(|d| Defect::new(d, &scenario.bearing, &fine))
        .flat_map(|defect| {
            SIDES.map(|side| {
                let way = (2.0 * relative_radius(&scenario.bearing, side) * deformation).sqrt();
                let run = run_across(&defect, side) * FINE as f64 / c.slices as f64;
                (run, way)
            })
        });
    let worst = of_all.max_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
    let (run, way) = worst.filter(|(run, way)| run > way)?;
    Some(warning(
        "contact.slices",
        c.slices.to_string(),
        format!(
            "across one slice the slanted edge of the damage runs {} mm on average, and along an envelope the roller sinks by its elastic deformation \
             within {} mm: wide slices let go of it as a whole, which makes impacts, and the RMS can be twice that of narrow ones",
            short(1e3 * run),
            short(1e3 * way)
        ),
        format!(">= {:.0}", (c.slices as f64 * run / way).ceil()),
    ))
}

/// How far (m) an edge runs along s within one of [`FINE`] slices, on average over the slices that meet the damage: half the way on which what is
/// covered of a slice changes, for it has a first and a last edge. 0 where the contact never meets the damage.
fn run_across(defect: &Defect, side: Side) -> f64 {
    if defect.depth_profile(side).is_none() {
        return 0.0;
    }
    let (first, last) = defect.shape.arc();
    let step = (last - first) / PLACES as f64;
    let (mut before, mut now) = (Cover::new(FINE), Cover::new(FINE));
    let mut changes = [0_usize; FINE];
    for place in 0..=PLACES {
        let s = first + (place as f64 - 0.5) * step;
        let at = defect.met_at(side, s / defect.radius);
        if !cover_slices(std::iter::once(defect), &at, side, &mut now) {
            now.fraction.fill(0.0);
        }
        let both = before.fraction.iter().zip(now.fraction.iter());
        for (changes, (before, now)) in changes.iter_mut().zip(both) {
            *changes += usize::from(before != now);
        }
        std::mem::swap(&mut before, &mut now);
    }
    let met = changes.iter().filter(|n| **n > 0).count().max(1);
    0.5 * step * changes.iter().sum::<usize>() as f64 / met as f64
}
