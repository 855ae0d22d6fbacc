//! Contact conditions during roller passage over a defect: under `ecl` lengths, depths and stiffness by path, under `half-space` what the
//! tables hold (section 19).

use super::curves::{POINTS, curve};
use crate::{DamageCurve, DamagePanel};
use brinell::defect::{Defect, Shape, Side};
use brinell::half_space::geometry::Geometry;
use brinell::model::Model;
use brinell::scenario::{self, Contact, Law, RollerPath, Scenario};

/// The second deformation that Q/Q_0 is drawn at, over the static one.
const TWICE: f64 = 2.0;
/// One defect under a roller that does not tilt, alone under `ecl`; `sides` with the deformation of each, m.
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
        let panels = match self.scenario.contact.law {
            Law::HalfSpace => self.on_tables(&angles),
            Law::Ecl => {
                let mut panels = vec![self.lengths(&angles), self.depths(&angles)];
                panels.extend(self.stiffnesses(&angles));
                panels
            }
        };
        (angles.iter().map(|u| u.to_degrees()).collect(), panels)
    }

    /// rad.
    fn angles(&self) -> Vec<f64> {
        let (first, last) = self.defect.shape.arc();
        let radius = self.defect.radius;
        let pad = (0.2 * (last - first)).max(self.felt_before());
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

    /// How far before an edge a contact feels it, m; 0 under `ecl`, which knows no width of the contact along s.
    fn felt_before(&self) -> f64 {
        if self.scenario.contact.law != Law::HalfSpace {
            return 0.0;
        }
        let reach = |&(side, delta): &(Side, f64)| {
            let geometry = Geometry::of_bearing(&self.scenario.bearing, &self.scenario.contact, side);
            geometry.map_or(0.0, |g| g.reach(TWICE * delta))
        };
        self.sides.iter().map(reach).fold(0.0, f64::max)
    }

    /// L_s, depth, and on each side delta_eff and the force over the healthy one.
    fn on_tables(&self, angles: &[f64]) -> Vec<DamagePanel> {
        let over = |of: &dyn Fn(f64) -> f64| angles.iter().map(|u| of(*u)).collect::<Vec<f64>>();
        let on_damage = |s: f64| {
            let (first, last) = self.defect.shape.arc();
            (first..=last).contains(&s)
        };
        let damaged = over(&|u| 1e3 * self.defect.damaged_length(u * self.defect.radius));
        let depth = over(&|u| {
            let s = u * self.defect.radius;
            if on_damage(s) { 1e6 * self.defect.depth_at(s) } else { 0.0 }
        });
        let mut panels = vec![
            panel("Damaged, L_s", "mm", vec![curve("", damaged)]),
            panel(self.depth_label(), "µm", vec![curve("", depth)]),
        ];
        for &(side, delta) in self.sides {
            let label = |what: &str| match self.sides.len() > 1 {
                true => format!("{what}, {}", contact(side)),
                false => what.to_owned(),
            };
            let at = |u: f64, delta: f64| self.model.effective_over(self.defect, side, u, delta);
            // Where nothing touches a table goes on below 0 to keep its slope: no place of the element.
            let effective = over(&|u| 1e6 * at(u, delta)[0].max(0.0));
            let healthy = over(&|_| 1e6 * delta);
            let both = vec![curve("damaged", effective), curve("healthy, δ", healthy)];
            panels.push(magnified(panel(&label("Effective δ"), "µm", both)));
            let ratio = |name: &str, delta: f64| {
                let whole = self.model.healthy(side).force_and_tangent(delta)[0];
                curve(name, over(&|u| at(u, delta)[1] / whole))
            };
            let ratios = vec![ratio("at the static deformation", delta), ratio("at twice it", TWICE * delta)];
            panels.push(magnified(panel(&label("Q/Q_0"), "", ratios)));
        }
        panels
    }

    fn depth_label(&self) -> &'static str {
        match self.defect.shape {
            Shape::DepthMap(_) => "Mean depth h_s",
            _ => "Depth h_s",
        }
    }

    /// The defect under a path.
    fn under(&self, roller_path: RollerPath) -> Option<Defect> {
        let contact = Contact { roller_path, ..self.scenario.contact.clone() };
        Defect::new(self.of, &self.scenario.bearing, &contact)
    }

    fn lengths(&self, angles: &[f64]) -> DamagePanel {
        let damaged = |u: &f64| 1e3 * self.defect.damaged_length(u * self.defect.radius);
        let damaged: Vec<f64> = angles.iter().map(damaged).collect();
        let left = match self.sides.first() {
            Some(&(side, delta)) => {
                let length = |u: &f64| 1e3 * self.model.length_over(self.defect, side, *u, delta);
                angles.iter().map(length).collect()
            }
            None => damaged.iter().map(|x| 1e3 * self.defect.roller_length - x).collect(),
        };
        let curves = vec![curve("in contact, L_e", left), curve("damaged, L_s", damaged)];
        panel("Length", "mm", curves)
    }

    fn depths(&self, angles: &[f64]) -> DamagePanel {
        let depths = |path: RollerPath, side: Side, name: &str| {
            let d = self.under(path)?;
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
        panel(self.depth_label(), "µm", curves)
    }

    /// K = Q / delta^n, a panel a side.
    fn stiffnesses(&self, angles: &[f64]) -> Vec<DamagePanel> {
        let unit = brinell::channel::stiffness_unit(self.scenario.contact.exponent);
        let of = |&(side, delta): &(Side, f64)| {
            let paths = [(RollerPath::Point, "point"), (RollerPath::Envelope, "envelope")];
            let curves = paths.into_iter().filter_map(|(path, name)| {
                let d = self.under(path)?;
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
        let k = |u: &f64| per_force * self.model.force_over(d, side, *u, delta);
        angles.iter().map(k).collect()
    }
}

/// Without the axis down to 0 where little changes.
fn magnified(panel: DamagePanel) -> DamagePanel {
    let all = || panel.curves.iter().flat_map(|c| c.values.iter().copied());
    let from_zero = all().fold(f64::INFINITY, f64::min) < 0.8 * all().fold(0.0, f64::max);
    DamagePanel { from_zero, ..panel }
}

pub(super) fn contact(side: Side) -> String {
    format!("{} contact", side.word())
}

fn panel(label: &str, unit: &str, curves: Vec<DamageCurve>) -> DamagePanel {
    DamagePanel { label: label.into(), unit: unit.into(), from_zero: true, curves }
}
