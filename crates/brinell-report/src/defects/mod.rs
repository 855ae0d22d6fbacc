//! Damage as it is seen before it is simulated: extents, outlines, what a roller meets, the ring's section.

mod along;
mod curves;
mod measures;
mod passage;

use crate::DamageView;
use crate::number::short;
pub(crate) use along::along_healthy_roller;
use along::along_roller;
use brinell::defect::simplify::Extent;
use brinell::defect::{Shape, Side, wrap};
use brinell::derived::defect_passes;
use brinell::lamina::AtRest;
use brinell::model::{Model, ModelError};
use brinell::observe::passes::place;
use brinell::scenario::{self, Scenario, Surface};
use brinell::statics::static_load_zone;
use brinell_damage::plan::{CORNERS, polygons_mm};
use curves::{depths, section};
pub use measures::Measures;
use measures::{deepest, facts, widest};
use passage::Passage;
use std::f64::consts::TAU;

/// Thickness of a ring that nobody stated, over the roller's diameter.
const THICKNESS_SHARE: f64 = 0.6;
/// Approach where no static balance gives one, m.
const FALLBACK_APPROACH: f64 = 10e-6;

/// One defect with its pictures' data.
#[derive(Debug, Clone)]
pub struct Damage {
    /// Its numbers.
    pub measures: Measures,
    /// What its pictures show.
    pub view: DamageView,
}

/// Every defect of a scenario; `thickness_mm` is the ring's, 0.6 of the roller's diameter where nobody states it.
///
/// # Errors
/// Where the scenario makes no model.
pub fn damage_of(s: &Scenario, thickness_mm: Option<f64>) -> Result<Vec<Damage>, ModelError> {
    if s.defects.is_empty() {
        return Ok(Vec::new());
    }
    let model = Model::new(s)?;
    let healthy = Model::new(&Scenario {
        defects: Vec::new(),
        ..s.clone()
    })?;
    let passes = defect_passes(&model);
    let statics = static_load_zone(&healthy).ok();
    let at_rest = AtRest::of(s).ok().flatten();
    let mut all = Vec::new();
    for (k, defect) in model.defects.iter().enumerate() {
        let side = match defect.surface {
            Surface::InnerRaceway => Side::Inner,
            _ => Side::Outer,
        };
        let force = statics.as_ref().map(|z| z.largest).filter(|f| *f > 0.0);
        let delta_on = |side: Side| force.map_or(FALLBACK_APPROACH, |f| model.deflection(side, f));
        let delta = delta_on(side);
        let (first, last) = defect.shape.arc();
        let extent = Extent::of(&defect.shape, defect.depth);
        let zone = statics
            .as_ref()
            .and_then(|z| ends(&z.points, z.shift, defect.row));
        let (deepest, raised) = deepest(defect);
        let arc = (last - first) / defect.radius;
        let measures = Measures {
            length_mm: 1e3 * extent.length,
            arc_deg: arc.to_degrees(),
            widest_mm: 1e3 * widest(defect),
            area_mm2: 1e6 * extent.area,
            mean_depth_um: 1e6 * extent.depth,
            deepest_um: 1e6 * deepest,
            raised_um: 1e6 * raised,
            pass_ms: 1e3 * passes[k],
            speed_rpm: 60.0 * model.rotation.max_speed() / TAU,
            load_zone_share: match defect.surface {
                Surface::Roller(_) => None,
                _ => zone.map(|[from, to]| arc / (to - from)),
            },
            approach_um: 1e6 * delta,
            force_n: force,
        };
        let is_roller = matches!(defect.surface, Surface::Roller(_));
        let sides: Vec<(Side, f64)> = if is_roller {
            vec![(Side::Outer, delta), (Side::Inner, delta_on(Side::Inner))]
        } else {
            vec![(side, delta)]
        };
        let (angle_deg, passage) = Passage {
            scenario: s,
            of: &s.defects[k],
            defect,
            model: &model,
            sides: &sides,
        }
        .panels();
        let thickness =
            1e-3 * thickness_mm.unwrap_or(THICKNESS_SHARE * s.bearing.roller_diameter_mm);
        let element = s.bearing.element.word();
        let through = deepest >= thickness;
        let (section_s_mm, section) = if is_roller || through {
            (Vec::new(), Vec::new())
        } else {
            section(defect, ring_width(s), thickness)
        };
        let by_force = force.map_or("no static balance, assumed".to_owned(), |f| {
            format!(
                "the heaviest static contact of the healthy bearing, {} N",
                short(f, 3)
            )
        });
        let assumed = if thickness_mm.is_some() {
            "stated"
        } else {
            "an assumption: 0.6 of the roller's diameter"
        };
        let title = format!("Defect {}: {}", k + 1, place(defect));
        let deformation = match sides[..] {
            [(_, outer), (_, inner)] => format!(
                "{} μm at the outer and {} μm at the inner contact",
                short(1e6 * outer, 3),
                short(1e6 * inner, 3)
            ),
            _ => format!("{} μm", short(1e6 * delta, 3)),
        };
        let view = DamageView {
            plan_title: match defect.surface {
                Surface::OuterRaceway => format!("{title}. Unrolled"),
                Surface::InnerRaceway => {
                    format!("{title}. Unrolled; it turns through the load zone")
                }
                Surface::Roller(_) => {
                    format!("{title}. Unrolled once around; either raceway meets the damage")
                }
            },
            passage_title: match defect.surface {
                Surface::Roller(_) => {
                    format!(
                        "{title}. What both contacts meet as it turns; K at a deformation of {deformation}"
                    )
                }
                _ => {
                    format!(
                        "{title}. What a passing {element} meets; K at a deformation of {deformation}"
                    )
                }
            },
            section_title: format!(
                "{title}. Section under it of a ring {} mm thick",
                short(1e3 * thickness, 3)
            ),
            element: element.into(),
            surface: match defect.surface {
                Surface::OuterRaceway => "outer raceway".into(),
                Surface::InnerRaceway => "inner raceway".into(),
                Surface::Roller(_) => element.into(),
            },
            half_turn_mm: is_roller.then_some(0.5e3 * TAU * defect.radius),
            title,
            facts: facts(&measures, &s.bearing),
            polygons_mm: in_place(&s.defects[k], &defect.shape),
            against_mm: Vec::new(),
            against: String::new(),
            photo: None,
            depths: depths(&defect.shape),
            roller_length_mm: s.bearing.roller_length_mm,
            roller_diameter_mm: s.bearing.roller_diameter_mm,
            load_zone_mm: match defect.surface {
                Surface::OuterRaceway => zone.map(|[from, to]| {
                    let start = wrap(0.5 * (from + to) - defect.center) - 0.5 * (to - from);
                    [start, start + to - from].map(|u| 1e3 * u * defect.radius)
                }),
                _ => None,
            },
            angle_deg,
            passage,
            passage_note: format!(
                "stiffness Q/δⁿ at a deformation of {deformation} ({by_force}); this defect alone, the paths and laws side by side{}",
                match model.profiled() {
                    Some(_) => "; along the profile, the roller does not tilt",
                    None => "",
                }
            ),
            along: at_rest.as_ref().and_then(|r| along_roller(r, Some(k))),
            section_s_mm,
            section,
            section_note: if is_roller {
                format!("section properties describe rings; this damage is on a {element}")
            } else if through {
                format!(
                    "the damage is deeper than the ring is thick, {} mm ({assumed}): no section is left",
                    short(1e3 * thickness, 3)
                )
            } else {
                format!(
                    "ring {} mm thick ({assumed}), as wide as {}; as in the paper, these do not enter the equations of motion",
                    short(1e3 * thickness, 3),
                    match s.bearing.has_balls() {
                        true => "the bearing",
                        false => "the roller is long",
                    }
                )
            },
        };
        all.push(Damage { measures, view });
    }
    Ok(all)
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

/// First and last angle of the rollers of a row that the inner raceway loads, rad.
fn ends(points: &[(usize, f64, f64, f64)], shift: [f64; 2], row: usize) -> Option<[f64; 2]> {
    let middle = shift[1].atan2(shift[0]);
    let loaded = points.iter().filter(|p| p.0 == row && p.2 > 0.0);
    let (first, last) = loaded
        .map(|p| wrap(p.1 - middle))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
            (a.min(x), b.max(x))
        });
    (last > first).then_some([middle + first, middle + last])
}
