//! Contact conditions during roller passage over a defect: lengths, depths and stiffness by path and law.

use super::curves::curve;
use crate::{DamageCurve, DamagePanel};
use brinell::defect::{Defect, Shape, Side};
use brinell::model::Model;
use brinell::scenario::{self, Contact, EdgeReaction, Law, RollerPath, Scenario};
use brinell::slices::Cover;

/// Points of a curve.
const POINTS: usize = 1601;
/// Every law and path, with its name.
const LAWS: [(Law, RollerPath, &str); 4] = [
    (Law::Ecl, RollerPath::Point, "ecl, point"),
    (Law::Ecl, RollerPath::Envelope, "ecl, envelope"),
    (Law::Sliced, RollerPath::Point, "sliced, point"),
    (Law::Sliced, RollerPath::Envelope, "sliced, envelope"),
];

/// One defect alone under a roller that does not tilt; `sides` with the deformation of each, m.
pub(super) struct Passage<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) of: &'a scenario::Defect,
    pub(super) defect: &'a Defect,
    pub(super) model: &'a Model,
    pub(super) sides: &'a [(Side, f64)],
}

impl Passage<'_> {
    /// Angles of a roller from the defect's centre in degrees, and what it meets there.
    pub(super) fn panels(&self) -> (Vec<f64>, Vec<DamagePanel>) {
        let angles = self.angles();
        let mut panels = vec![self.lengths(&angles), self.depths(&angles)];
        panels.extend(self.stiffnesses(&angles));
        (angles.iter().map(|u| u.to_degrees()).collect(), panels)
    }

    /// rad.
    fn angles(&self) -> Vec<f64> {
        let (first, last) = self.defect.shape.arc();
        let radius = self.defect.radius;
        let pad = 0.2 * (last - first);
        let (from, to) = ((first - pad) / radius, (last + pad) / radius);
        let mut angles: Vec<f64> = (0..POINTS).map(|k| from + (to - from) * k as f64 / (POINTS - 1) as f64).collect();
        // Edges are jumps, not slopes between two points.
        let hair = 1e-6 * (to - from);
        for edge in [first, last] {
            let u = edge / radius;
            angles.extend([u - hair, u + hair]);
        }
        angles.sort_by(f64::total_cmp);
        angles
    }

    /// The defect under a law and a path.
    fn under(&self, law: Law, roller_path: RollerPath) -> Option<Defect> {
        let contact = Contact { law, roller_path, edge_reaction: EdgeReaction::None, ..self.scenario.contact.clone() };
        Defect::new(self.of, &self.scenario.bearing, &contact)
    }

    fn lengths(&self, angles: &[f64]) -> DamagePanel {
        let damaged = |u: &f64| 1e3 * self.defect.damaged_length(u * self.defect.radius);
        let damaged: Vec<f64> = angles.iter().map(damaged).collect();
        let mut cover = Cover::new(self.model.profiled().map_or(0, |s| s.count));
        let left = match self.sides.first() {
            Some(&(side, delta)) => {
                let length = |u: &f64| 1e3 * self.model.length_over(self.defect, side, *u, delta, &mut cover);
                angles.iter().map(length).collect()
            }
            None => damaged.iter().map(|x| 1e3 * self.defect.roller_length - x).collect(),
        };
        let curves = vec![curve("in contact, L_e", left), curve("damaged, L_s", damaged)];
        panel("Length", "mm", curves)
    }

    fn depths(&self, angles: &[f64]) -> DamagePanel {
        let depths = |path: RollerPath, side: Side, name: &str| {
            let d = self.under(Law::Ecl, path)?;
            let h = |u: &f64| d.floor(*u, side).map_or(0.0, |f| 1e6 * f.depth);
            Some(curve(name, angles.iter().map(h).collect()))
        };
        let first = self.sides.first().map_or(Side::Outer, |s| s.0);
        let mut curves: Vec<DamageCurve> = depths(RollerPath::Point, first, "point").into_iter().collect();
        for &(side, _) in self.sides {
            let name = match self.sides.len() > 1 {
                true => format!("envelope, {}", contact(side)),
                false => "envelope".to_owned(),
            };
            curves.extend(depths(RollerPath::Envelope, side, &name));
        }
        let label = match self.defect.shape {
            Shape::DepthMap(_) => "Mean depth h_s",
            _ => "Depth h_s",
        };
        panel(label, "µm", curves)
    }

    /// K = Q / delta^n, a panel a side.
    fn stiffnesses(&self, angles: &[f64]) -> Vec<DamagePanel> {
        let unit = brinell::channel::stiffness_unit(self.scenario.contact.exponent);
        // One length is no law under balls, nor along a profile.
        let sliced_alone = self.scenario.bearing.has_balls() || self.model.profiled().is_some();
        let of = |&(side, delta): &(Side, f64)| {
            let laws = LAWS.iter().filter(|l| l.0 == Law::Sliced || !sliced_alone);
            let curves = laws.filter_map(|&(law, path, name)| {
                let d = self.under(law, path)?;
                Some(curve(name, self.stiffness(angles, &d, side, delta)))
            });
            let label = match self.sides.len() > 1 {
                true => format!("K, {}", contact(side)),
                false => "Stiffness K".to_owned(),
            };
            panel(&label, unit, curves.collect())
        };
        self.sides.iter().map(of).collect()
    }

    fn stiffness(&self, angles: &[f64], d: &Defect, side: Side, delta: f64) -> Vec<f64> {
        let law = self.model.contact(side);
        let per_force = law.stiffness / law.healthy(delta);
        let mut cover = Cover::new(self.model.profiled().map_or(0, |s| s.count));
        let k = |u: &f64| per_force * self.model.force_over(d, side, *u, delta, &mut cover);
        angles.iter().map(k).collect()
    }
}

fn contact(side: Side) -> String {
    format!("{} contact", side.word())
}

fn panel(label: &str, unit: &str, curves: Vec<DamageCurve>) -> DamagePanel {
    DamagePanel { label: label.into(), unit: unit.into(), from_zero: true, curves }
}
