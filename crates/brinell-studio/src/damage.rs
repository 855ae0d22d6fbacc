//! Damage as the page draws it: seen from above, and under one roller.

use crate::answers::{Damage, Grid, Passage, Reply, Seen};
use crate::bench::Bench;
use crate::message::Arrays;
use crate::report::{Answer, Trouble};
use brinell::defect::Extent;
use brinell::defect::{Defect, Side};
use brinell::model::Model;
use brinell::scenario::{self, Surface};
use brinell::statics::{FALLBACK_APPROACH, static_load_zone};
use brinell_damage::plan::{CORNERS, depth_grid, polygons_mm};

/// Points of a passage.
const POINTS: usize = 401;

/// Every defect seen from above.
pub(crate) fn seen(bench: &Bench, arrays: &mut Arrays) -> Reply {
    let model = bench.simulation().model();
    let stated = &bench.loaded.scenario.defects;
    let all = stated.iter().zip(&model.defects).enumerate();
    let defects = all.map(|(k, (of, defect))| one(k, of, defect, arrays)).collect();
    Reply::Damage(Damage { defects })
}

fn one(k: usize, of: &scenario::Defect, defect: &Defect, arrays: &mut Arrays) -> Seen {
    let polygons = polygons_mm(of, &defect.shape, CORNERS).into_iter();
    let polygons_mm = polygons.map(|ring| arrays.rounded(ring.as_flattened())).collect();
    let depths = depth_grid(of);
    let deepest = depths.as_ref().map(scenario::DepthGrid::deepest_um);
    let grid = depths.map(|scenario::DepthGrid { s0_mm, z0_mm, ds_mm, dz_mm, columns, rows, depth_um }| {
        let depth_um = arrays.rounded(&depth_um);
        Grid { ds_mm, dz_mm, s0_mm, z0_mm, columns, rows, depth_um }
    });
    let extent = Extent::of(&defect.shape, defect.depth);
    let roller = match of.on {
        Surface::Roller(number) => Some(number),
        _ => None,
    };
    Seen {
        defect: k + 1,
        on: of.on.word(),
        roller,
        row: of.row,
        center_deg: of.center_deg,
        axial_offset_mm: of.axial_offset_mm,
        radius_mm: 1e3 * defect.radius,
        depth_um: of.depth_um,
        polygons_mm,
        grid,
        length_mm: 1e3 * extent.length,
        width_mm: 1e3 * extent.width,
        area_mm2: 1e6 * extent.area,
        deepest_um: deepest.unwrap_or(of.depth_um),
    }
}

/// One roller at rest, at places over a defect: what of it touches, and the force that the approach of the healthy
/// bearing's heaviest contact gives there.
pub(crate) fn passage(bench: &Bench, number: usize, arrays: &mut Arrays) -> Answer<Reply> {
    let scenario = &bench.loaded.scenario;
    let model = bench.simulation().model();
    let at = number.checked_sub(1).filter(|k| *k < model.defects.len());
    let Some(at) = at else {
        return Err(Trouble::of(format!("there is no defect {number}")));
    };
    let defect = &model.defects[at];
    let side = match defect.surface {
        Surface::InnerRaceway => Side::Inner,
        _ => Side::Outer,
    };
    let healthy = Model::new(&scenario::Scenario { defects: Vec::new(), ..scenario.clone() })
        .map_err(|e| Trouble::of(e.to_string()))?;
    let heaviest = static_load_zone(&healthy).ok().map(|z| z.largest);
    let heaviest = heaviest.filter(|f| *f > 0.0);
    let approach = heaviest.map_or(FALLBACK_APPROACH, |f| model.deflection(side, f));
    let (first, last) = defect.shape.arc();
    let pad = 0.25 * (last - first);
    let places: Vec<f64> =
        (0..POINTS).map(|k| first - pad + (last - first + 2.0 * pad) * k as f64 / (POINTS - 1) as f64).collect();
    // Of a ball the axis of its ellipse across the groove.
    let whole = model.contact(side).axis_across(approach).unwrap_or(defect.roller_length);
    let (mut lengths, mut force) = (Vec::new(), Vec::new());
    for s in &places {
        let u = s / defect.radius;
        lengths.push(1e3 * model.length_over(defect, side, u, approach).max(0.0));
        force.push(model.force_over(defect, side, u, approach));
    }
    let places_mm: Vec<f64> = places.iter().map(|s| 1e3 * s).collect();
    Ok(Reply::Passage(Passage {
        s_mm: arrays.rounded(&places_mm),
        length_mm: arrays.rounded(&lengths),
        force_n: arrays.rounded(&force),
        healthy_n: heaviest,
        width_mm: 1e3 * whole,
    }))
}
