//! One defect with what its numbers, words and pictures are made of.

use super::curves::{depths, section};
use super::measures::{Measures, facts};
use super::passage::Passage;
use super::pressures::pressures;
use crate::number::short;
use crate::{DamageCurves, DamageView};
use brinell::defect::Extent;
use brinell::defect::{Defect, Shape, Side, wrap};
use brinell::derived::Passing;
use brinell::model::Model;
use brinell::observe::passes::place;
use brinell::scenario::{self, Law, Scenario, Surface};
use brinell::statics::{FALLBACK_APPROACH, StaticLoadZone};
use brinell_damage::plan::{CORNERS, polygons_mm};
use std::f64::consts::TAU;

/// Thickness of a ring that nobody stated, over the roller's diameter.
const THICKNESS_SHARE: f64 = 0.6;

/// One defect with its pictures' data.
#[derive(Debug, Clone)]
pub struct Damage {
    /// Its numbers.
    pub measures: Measures,
    /// What its pictures show.
    pub view: DamageView,
}

pub(super) struct Seen<'a> {
    scenario: &'a Scenario,
    model: &'a Model,
    index: usize,
    defect: &'a Defect,
    measures: Measures,
    /// Contacts that meet it, with their approach, m.
    sides: Vec<(Side, f64)>,
    /// Where the static load zone of the healthy bearing begins and ends, rad.
    zone: Option<[f64; 2]>,
    /// Of the ring, m, and whether somebody stated it.
    thickness: f64,
    stated: bool,
}

impl<'a> Seen<'a> {
    /// Defect `index` of a model; a roller passes it in `pass` s.
    pub(super) fn of(
        (scenario, model, index): (&'a Scenario, &'a Model, usize),
        pass: f64,
        statics: Option<&StaticLoadZone>,
        thickness_mm: Option<f64>,
    ) -> Self {
        let defect = &model.defects[index];
        let force = statics.map(|z| z.largest).filter(|f| *f > 0.0);
        let approach = |side: Side| {
            let delta = force.map_or(FALLBACK_APPROACH, |f| model.deflection(side, f));
            (side, delta)
        };
        let sides = match defect.surface {
            Surface::OuterRaceway => vec![approach(Side::Outer)],
            Surface::InnerRaceway => vec![approach(Side::Inner)],
            Surface::Roller(_) => vec![approach(Side::Outer), approach(Side::Inner)],
        };
        let zone = statics.filter(|z| z.extent > 0.0).map(StaticLoadZone::arc);
        let (first, last) = defect.shape.arc();
        let arc = (last - first) / defect.radius;
        let extent = Extent::of(&defect.shape, defect.depth);
        let measures = Measures {
            length_mm: 1e3 * extent.length,
            arc_deg: arc.to_degrees(),
            width_mm: 1e3 * extent.width,
            widest_mm: 1e3 * extent.widest,
            area_mm2: 1e6 * extent.area,
            area_in_ecl_mm2: 1e6 * defect.shape.area_in_ecl(),
            mean_depth_um: 1e6 * extent.depth,
            deepest_um: 1e6 * extent.deepest,
            raised_um: 1e6 * extent.raised,
            pass_ms: 1e3 * pass,
            speed_rpm: 60.0 * model.rotation.max_speed() / TAU,
            load_zone_share: match defect.surface {
                Surface::Roller(_) => None,
                _ => zone.map(|[from, to]| arc / (to - from)),
            },
            approach_um: 1e6 * sides[0].1,
            force_n: force,
        };
        let share = THICKNESS_SHARE * scenario.bearing.roller_diameter_mm;
        Self {
            scenario,
            model,
            index,
            defect,
            measures,
            sides,
            zone,
            thickness: 1e-3 * thickness_mm.unwrap_or(share),
            stated: thickness_mm.is_some(),
        }
    }

    pub(super) fn damage(self) -> Damage {
        let (s, defect) = (self.scenario, self.defect);
        let of = &s.defects[self.index];
        let passage = Passage { scenario: s, of, defect, model: self.model, sides: &self.sides }.panels();
        let section = match self.is_roller() || self.is_through() {
            true => (Vec::new(), Vec::new()),
            false => section(defect, ring_width(s), self.thickness),
        };
        let title = format!("Defect {}: {}", self.index + 1, place(defect));
        let element = s.bearing.element.word();
        let passing = Passing::of(self.model, defect.surface);
        let view = DamageView {
            plan_title: format!("{title}. {}", self.unrolled()),
            element: element.into(),
            surface: match defect.surface {
                Surface::OuterRaceway => "outer raceway".into(),
                Surface::InnerRaceway => "inner raceway".into(),
                Surface::Roller(_) => element.into(),
            },
            half_turn_mm: self.is_roller().then_some(0.5e3 * TAU * defect.radius),
            facts: facts(&self.measures, s, defect, passing),
            polygons_mm: in_place(of, &defect.shape),
            against_mm: Vec::new(),
            against: String::new(),
            photo: None,
            depths: depths(&defect.shape),
            roller_length_mm: s.bearing.roller_length_mm,
            roller_diameter_mm: s.bearing.roller_diameter_mm,
            passing,
            load_zone_mm: self.load_zone_mm(),
            passage: DamageCurves {
                title: format!("{title}. {}", self.conditions()),
                along: passage.0,
                panels: passage.1,
                note: self.passage_note(),
            },
            pressures: pressures((s, self.model, self.index), &self.sides, &title),
            section: DamageCurves {
                title: format!("{title}. Section under it of a ring {} mm thick", short(1e3 * self.thickness, 3)),
                along: section.0,
                panels: section.1,
                note: self.section_note(),
            },
            title,
        };
        Damage { measures: self.measures, view }
    }

    fn is_roller(&self) -> bool {
        matches!(self.defect.surface, Surface::Roller(_))
    }

    /// Deeper than the ring is thick.
    fn is_through(&self) -> bool {
        1e-6 * self.measures.deepest_um >= self.thickness
    }

    fn unrolled(&self) -> &'static str {
        match self.defect.surface {
            Surface::OuterRaceway => "Unrolled",
            Surface::InnerRaceway => "Unrolled; it turns through the load zone",
            Surface::Roller(_) => "Unrolled once around; the damage passes both raceways",
        }
    }

    fn deformation(&self) -> String {
        match self.sides[..] {
            [(_, outer), (_, inner)] => format!(
                "{} µm at the outer and {} µm at the inner contact",
                short(1e6 * outer, 3),
                short(1e6 * inner, 3)
            ),
            _ => format!("{} µm", short(self.measures.approach_um, 3)),
        }
    }

    fn conditions(&self) -> String {
        let deformation = self.deformation();
        let contacts = match self.is_roller() {
            true => "Both contacts while it turns".to_owned(),
            false => format!("Contact during {} passage", self.scenario.bearing.element.word()),
        };
        match self.scenario.contact.law {
            Law::HalfSpace => format!("{contacts}; law half-space, at a static deformation of {deformation}"),
            Law::Ecl => format!("{contacts}; law ecl, K at a deformation of {deformation}"),
        }
    }

    fn passage_note(&self) -> String {
        let by_force = self.measures.force_n.map_or("no static balance, assumed".to_owned(), |f| {
            format!("the heaviest static contact of the healthy bearing, {} N", short(f, 3))
        });
        let profile = match self.model.profiled() {
            Some(_) => "; along the profile, the roller does not tilt",
            None => "",
        };
        let deformation = self.deformation();
        let damage = match self.scenario.defects[self.index].table {
            Some(_) => "by the table of its file, which has no pressures to draw",
            None => "with all damage of this surface",
        };
        match self.scenario.contact.law {
            Law::HalfSpace => format!(
                "law half-space, as the run takes it: the effective δ is that at which the healthy contact stores the energy that the damaged one \
                 stores at δ; Q over the healthy Q_0 at the same δ, the static {deformation} ({by_force}) and twice it; {damage}{profile}"
            ),
            Law::Ecl => format!(
                "law ecl: stiffness Q/δⁿ at a deformation of {deformation} ({by_force}); this defect alone, the paths side by side{profile}"
            ),
        }
    }

    fn load_zone_mm(&self) -> Option<[f64; 2]> {
        let Surface::OuterRaceway = self.defect.surface else {
            return None;
        };
        let [from, to] = self.zone?;
        let start = wrap(0.5 * (from + to) - self.defect.center) - 0.5 * (to - from);
        Some([start, start + to - from].map(|u| 1e3 * u * self.defect.radius))
    }

    fn section_note(&self) -> String {
        let thick = short(1e3 * self.thickness, 3);
        let assumed = match self.stated {
            true => "stated",
            false => "an assumption: 0.6 of the roller's diameter",
        };
        let bearing = &self.scenario.bearing;
        if self.is_roller() {
            let element = bearing.element.word();
            format!("section properties describe rings; this damage is on a {element}")
        } else if self.is_through() {
            format!("the damage is deeper than the ring is thick, {thick} mm ({assumed}): no section is left")
        } else {
            let width = match bearing.has_balls() {
                true => "the bearing",
                false => "the roller is long",
            };
            format!(
                "ring {thick} mm thick ({assumed}), as wide as {width}; as in the paper, these do not enter the equations of motion"
            )
        }
    }
}

/// Width of the ring whose section is taken, m: a roller's length, or of a ball bearing its own.
fn ring_width(s: &Scenario) -> f64 {
    let b = &s.bearing;
    match b.has_balls() {
        true => 1e-3 * b.width_mm,
        false => 1e-3 * b.roller_length_mm,
    }
}

/// The damage seen from above where it lies, mm.
fn in_place(of: &scenario::Defect, shape: &Shape) -> Vec<Vec<[f64; 2]>> {
    let mut polygons = polygons_mm(of, shape, CORNERS);
    // An outline has been moved already.
    if !matches!(shape, Shape::Outline(_)) {
        for point in polygons.iter_mut().flatten() {
            point[1] += of.axial_offset_mm;
        }
    }
    polygons
}
