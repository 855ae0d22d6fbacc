//! Whether the slices are narrow enough for the edges of the damage.
//!
//! An edge that runs slantwise across a slice reaches its borders at different s. Away from an edge an envelope sinks
//! as s^2 / (2 R_eq), so strips beside one another sink by different depths, while the slice has one mean depth
//! (section 3) and lets go as a whole. A strip lets go where it has sunk by the contact's deformation delta, at s =
//! sqrt(2 R_eq delta), and there the depth grows by sqrt(2 delta / R_eq) per length. Strips of one slice differ by less
//! than delta if the edge runs less than sqrt(R_eq delta / 2) across it. Of depth maps only the edges are judged, not
//! how the floor varies.

use super::warning::{short, warning};
use crate::defect::{Defect, Defects, SIDES, Side, cover_slices, relative_radius, wrap};
use crate::document::Problem;
use crate::model::Model;
use crate::scenario::{self, Contact, Law, RollerPath, Scenario, Surface};
use crate::slices::Cover;
use crate::statics::StaticLoadZone;
use std::f64::consts::TAU;

/// Places along damage at which its slices are looked at.
const PLACES: usize = 512;
/// Damages that are looked at: thousands can be alike.
const DAMAGES: usize = 32;
/// Most slices that a scenario may have.
const MOST: usize = 10_000;

/// Slices too wide for slanted edges along an envelope.
pub(super) fn coarse_slices(scenario: &Scenario, model: &Model, zone: &StaticLoadZone) -> Option<Problem> {
    let c = &scenario.contact;
    let counts = c.law == Law::Sliced
        && c.roller_path == RollerPath::Envelope
        && model.kind.moves_every_part()
        // Under balls they divide the damage, however narrow.
        && !scenario.bearing.has_balls();
    if !counts || scenario.defects.is_empty() {
        return None;
    }
    let edges = Edges {
        scenario,
        deformation: zone.deformation(model),
        pressed: model.defects.iter().map(|d| is_pressed(model, zone, d)).collect(),
    };
    let (run, way) = edges.worst(c.slices)?;
    let mut needed = c.slices;
    let mut now = Some((run, way));
    // Where the outline is smooth, what an edge runs across a slice is inversely proportional to their number.
    while let Some((run, way)) = now
        && needed < MOST
    {
        needed = ((needed as f64 * run / way).ceil() as usize).clamp(needed + 1, MOST);
        now = edges.worst(needed);
    }
    Some(warning(
        "contact.slices",
        c.slices.to_string(),
        format!(
            "the slices are too wide for this damage: its slanted edge runs {} mm along s within one slice, and {} mm is the most at which the force \
             on the roller changes gradually. A wider slice comes onto the edge and off it at once, an impact that the real roller does not make. With a \
             third as many slices as needed the RMS can be twice too large",
            short(1e3 * run),
            short(1e3 * way)
        ),
        format!(">= {needed}"),
    ))
}

/// Whether rollers are pressed onto damage: on the outer raceway where it lies, elsewhere it turns into the load zone.
fn is_pressed(model: &Model, zone: &StaticLoadZone, defect: &Defect) -> bool {
    if defect.surface != Surface::OuterRaceway {
        return true;
    }
    let (first, last) = defect.shape.arc();
    let between = TAU / (16 * model.layout.rollers_per_row) as f64;
    let reach = 0.5 * (last - first) / defect.radius + between;
    let middle = defect.center + 0.5 * (first + last) / defect.radius;
    let mut points = zone.points.iter().filter(|p| p.0 == defect.row);
    // By both raceways: its own weight on the inner ring presses no roller onto damage.
    points.any(|p| p.2 > 0.0 && p.3 > 0.0 && wrap(p.1 - middle).abs() <= reach)
}

/// The edges of the damage under rollers that sink by `deformation` (m).
struct Edges<'a> {
    scenario: &'a Scenario,
    deformation: f64,
    /// Of each defect, whether rollers are pressed onto it.
    pressed: Vec<bool>,
}

impl Edges<'_> {
    /// The edge that runs farthest across one of so many slices beside the way that it may, and that way, m; none that
    /// runs too far.
    fn worst(&self, slices: usize) -> Option<(f64, f64)> {
        // Edges are where they are by either path, and without an envelope they are found sooner.
        let contact = Contact { slices, roller_path: RollerPath::Point, ..self.scenario.contact.clone() };
        let looked_at: &[scenario::Defect] = &self.scenario.defects;
        let looked_at = &looked_at[..looked_at.len().min(DAMAGES)];
        let all = Defect::all(looked_at, &self.scenario.bearing, &contact).ok()?;
        let mut worst: Option<(f64, f64)> = None;
        for (defect, _) in all.iter().zip(&self.pressed).filter(|(_, pressed)| **pressed) {
            for side in SIDES {
                let radius = relative_radius(&self.scenario.bearing, side);
                let way = (0.5 * radius * self.deformation).sqrt();
                let run = self.run_across(&all, defect, side, slices);
                if run > way && worst.is_none_or(|(r, w)| run * w > r * way) {
                    worst = Some((run, way));
                }
            }
        }
        worst
    }

    /// How far (m) the first or the last edge runs along s within one slice, on average over the slices that meet the
    /// damage; several defects are one surface. 0 where the contact never meets the damage, or never sinks by the
    /// deformation.
    fn run_across(&self, all: &[Defect], defect: &Defect, side: Side, slices: usize) -> f64 {
        let radius = relative_radius(&self.scenario.bearing, side);
        if defect.depth_profile(side).is_none() || defect.reach(radius).1 <= self.deformation {
            return 0.0;
        }
        let together = Defects::beside(all, defect, side);
        let (first, last) = defect.shape.arc();
        let step = (last - first) / PLACES as f64;
        let mut cover = Cover::new(slices);
        let mut edges = vec![Edge::default(); slices];
        for place in 0..PLACES {
            let s = first + (place as f64 + 0.5) * step;
            let at = defect.met_at(side, s / defect.radius);
            if cover_slices(together, &at, &mut cover) {
                for (edge, fraction) in edges.iter_mut().zip(cover.fraction.iter()) {
                    edge.meet(place, *fraction);
                }
            }
        }
        let met = || edges.iter().filter(|edge| edge.most > 0.0);
        let mean = |of: &dyn Fn(&Edge) -> usize| met().map(of).sum::<usize>() as f64 / met().count().max(1) as f64;
        step * mean(&|e| e.full[0] - e.any[0]).max(mean(&|e| e.any[1] - e.full[1]))
    }
}

/// Where along s a slice is covered: first and last place with anything, and with the most.
#[derive(Clone, Default)]
struct Edge {
    most: f64,
    any: [usize; 2],
    full: [usize; 2],
}

impl Edge {
    fn meet(&mut self, place: usize, fraction: f64) {
        if fraction <= 0.0 {
            return;
        }
        if self.most == 0.0 {
            self.any[0] = place;
        }
        self.any[1] = place;
        // Round-off is no edge.
        if fraction > self.most + 1e-9 {
            self.full[0] = place;
            self.most = fraction;
        }
        if fraction >= self.most - 1e-9 {
            self.full[1] = place;
        }
    }
}
