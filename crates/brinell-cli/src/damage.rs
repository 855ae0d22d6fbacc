//! Damage as it is seen before it is simulated: extents, outlines, what a roller meets, the ring's section.

use crate::plan::{CORNERS, polygons_mm};
use crate::say::short;
use brinell::defect::section::{Section, sections};
use brinell::defect::simplify::Extent;
use brinell::defect::{Angles, Defect, Shape, Side, acting, wrap};
use brinell::derived::defect_passes;
use brinell::model::{Model, ModelError};
use brinell::observe::passes::place;
use brinell::scenario::{self, Contact, EdgeReaction, Law, RollerPath, Scenario, Surface};
use brinell::statics::static_load_zone;
use brinell_report::{DamageCurve, DamagePanel, DamageView, DepthPatch, Fact, Value};
use std::f64::consts::TAU;

/// Points of a curve.
const POINTS: usize = 1601;
/// Nodes of a shaded picture, along and across.
const SHADED: [usize; 2] = [161, 121];
/// Thickness of a ring that nobody stated, over the roller's diameter.
pub(crate) const THICKNESS_SHARE: f64 = 0.6;
/// Approach where no static balance gives one, m.
const FALLBACK_APPROACH: f64 = 10e-6;

/// One defect's numbers; lengths in mm, depths in um.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Measures {
    pub(crate) length_mm: f64,
    pub(crate) arc_deg: f64,
    pub(crate) widest_mm: f64,
    pub(crate) area_mm2: f64,
    pub(crate) mean_depth_um: f64,
    pub(crate) deepest_um: f64,
    pub(crate) raised_um: f64,
    pub(crate) pass_ms: f64,
    pub(crate) speed_rpm: f64,
    pub(crate) load_zone_share: Option<f64>,
    pub(crate) approach_um: f64,
    pub(crate) force_n: Option<f64>,
}

/// One defect with its pictures' data.
#[derive(Debug, Clone)]
pub(crate) struct Damage {
    pub(crate) measures: Measures,
    pub(crate) view: DamageView,
}

/// Every defect of a scenario; `thickness_mm` is the ring's.
pub(crate) fn all(s: &Scenario, thickness_mm: Option<f64>) -> Result<Vec<Damage>, ModelError> {
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
    let mut all = Vec::new();
    for (k, defect) in model.defects.iter().enumerate() {
        let side = match defect.surface {
            Surface::InnerRaceway => Side::Inner,
            _ => Side::Outer,
        };
        let force = statics.as_ref().map(|z| z.largest).filter(|f| *f > 0.0);
        let delta_on =
            |side: Side| force.map_or(FALLBACK_APPROACH, |f| model.contact(side).deflection(f));
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
        let (angle_deg, passage) = passage(s, &s.defects[k], defect, &model, &sides);
        let thickness =
            1e-3 * thickness_mm.unwrap_or(THICKNESS_SHARE * s.bearing.roller_diameter_mm);
        let through = deepest >= thickness;
        let (section_s_mm, section) = if is_roller || through {
            (Vec::new(), Vec::new())
        } else {
            section(defect, thickness)
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
        let approach = match sides[..] {
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
                        "{title}. What both contacts meet as it turns; K at an approach of {approach}"
                    )
                }
                _ => {
                    format!("{title}. What a passing roller meets; K at an approach of {approach}")
                }
            },
            section_title: format!(
                "{title}. Section under it of a ring {} mm thick",
                short(1e3 * thickness, 3)
            ),
            surface: match defect.surface {
                Surface::OuterRaceway => "outer raceway".into(),
                Surface::InnerRaceway => "inner raceway".into(),
                Surface::Roller(_) => "roller".into(),
            },
            half_turn_mm: is_roller.then_some(0.5e3 * TAU * defect.radius),
            title,
            facts: facts(&measures, defect),
            polygons_mm: polygons_mm(&s.defects[k], &defect.shape, CORNERS),
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
                "stiffness Q/δⁿ at an approach of {approach} ({by_force}); this defect alone, the paths and laws side by side"
            ),
            section_s_mm,
            section,
            section_note: if is_roller {
                "section properties describe rings; this damage lies on a roller".into()
            } else if through {
                format!(
                    "the damage is deeper than the ring is thick, {} mm ({assumed}): no section is left",
                    short(1e3 * thickness, 3)
                )
            } else {
                format!(
                    "ring {} mm thick ({assumed}), as wide as the roller is long; as in the paper, these do not enter the equations of motion",
                    short(1e3 * thickness, 3)
                )
            },
        };
        all.push(Damage { measures, view });
    }
    Ok(all)
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

/// s over the arc at equal distances, a hair inside its ends.
fn along(shape: &Shape, points: usize) -> impl Iterator<Item = f64> + use<> {
    let (first, last) = shape.arc();
    let inset = 1e-9 * (last - first);
    (0..points).map(move |k| {
        let share = k as f64 / (points - 1) as f64;
        first + inset + (last - first - 2.0 * inset) * share
    })
}

fn widest(defect: &Defect) -> f64 {
    along(&defect.shape, 20_001)
        .map(|s| defect.damaged_length(s))
        .fold(0.0, f64::max)
}

/// Deepest point and height of the highest raised edge, m.
fn deepest(defect: &Defect) -> (f64, f64) {
    let own = match &defect.shape {
        Shape::DepthMap(grid) => grid.extremes().0,
        shape => along(shape, 20_001)
            .map(|s| shape.own_depth(s).unwrap_or(defect.depth))
            .fold(0.0, f64::max),
    };
    (own, defect.shape.raised())
}

fn facts(m: &Measures, defect: &Defect) -> Vec<Fact> {
    let fact = |label: &str, value: f64, digits: usize, unit: &str, note: String| {
        Fact::new(label, Value::Text(short(value, digits)), unit, note)
    };
    let none = String::new;
    let floor = if m.deepest_um > m.approach_um {
        format!(
            "deeper than the approach of {} μm: a roller's line does not reach its floor",
            short(m.approach_um, 3)
        )
    } else {
        format!(
            "less than the approach of {} μm: the floor carries too",
            short(m.approach_um, 3)
        )
    };
    let mut facts = vec![
        fact(
            "Length",
            m.length_mm,
            4,
            "mm",
            "along the rolling direction".into(),
        ),
        fact("Arc", m.arc_deg, 4, "°", "of the damaged surface".into()),
        fact(
            "Widest",
            m.widest_mm,
            4,
            "mm",
            format!(
                "largest L_s; the roller is {} mm long",
                short(1e3 * defect.roller_length, 4)
            ),
        ),
        fact("Area", m.area_mm2, 4, "mm^2", none()),
        fact(
            "Mean depth",
            m.mean_depth_um,
            4,
            "μm",
            "volume over area".into(),
        ),
        fact("Deepest", m.deepest_um, 4, "μm", floor),
        fact(
            "Time to pass",
            m.pass_ms,
            4,
            "ms",
            format!("of the line of contact, at {} r/min", short(m.speed_rpm, 4)),
        ),
    ];
    if m.raised_um > 0.0 {
        facts.push(fact(
            "Raised edge",
            m.raised_um,
            4,
            "μm",
            "felt by the law \"sliced\"".into(),
        ));
    }
    if let Some(share) = m.load_zone_share {
        facts.push(fact(
            "Share of the load zone",
            100.0 * share,
            3,
            "%",
            "arc over the static load zone of the healthy bearing".into(),
        ));
    }
    facts
}

/// What a roller meets, over its angle from the defect's centre.
fn passage(
    s: &Scenario,
    of: &scenario::Defect,
    defect: &Defect,
    model: &Model,
    sides: &[(Side, f64)],
) -> (Vec<f64>, Vec<DamagePanel>) {
    let (first, last) = defect.shape.arc();
    let pad = 0.2 * (last - first);
    let (from, to) = ((first - pad) / defect.radius, (last + pad) / defect.radius);
    let mut angles: Vec<f64> = (0..POINTS)
        .map(|k| from + (to - from) * k as f64 / (POINTS - 1) as f64)
        .collect();
    // Edges are jumps, not slopes between two points.
    let hair = 1e-6 * (to - from);
    for edge in [first, last] {
        let u = edge / defect.radius;
        angles.extend([u - hair, u + hair]);
    }
    angles.sort_by(f64::total_cmp);
    let under = |law: Law, roller_path: RollerPath| {
        let contact = Contact {
            law,
            roller_path,
            edge_reaction: EdgeReaction::None,
            ..s.contact.clone()
        };
        Defect::new(of, &s.bearing, &contact)
    };
    let stiffness = |d: &Defect, side: Side, delta: f64| -> Vec<f64> {
        let law = model.contact(side);
        // A roller's defect meets the inner raceway half a turn after the outer one.
        let half_turn = match (d.surface, side) {
            (Surface::Roller(_), Side::Inner) => 0.5 * TAU,
            _ => 0.0,
        };
        let k = |u: &f64| {
            let angles = Angles {
                orbit: d.center + u - half_turn,
                spin: 0.0,
                ring: 0.0,
            };
            acting(std::iter::once(d), law, &angles, side, delta).map_or(law.stiffness, |a| {
                law.stiffness * a.elastic / law.healthy(delta)
            })
        };
        angles.iter().map(k).collect()
    };
    let curve = |name: &str, values: Vec<f64>| DamageCurve {
        name: name.into(),
        values,
    };
    let damaged: Vec<f64> = angles
        .iter()
        .map(|u| 1e3 * defect.damaged_length(u * defect.radius))
        .collect();
    let left = damaged
        .iter()
        .map(|x| 1e3 * defect.roller_length - x)
        .collect();
    let several = sides.len() > 1;
    let contact = |side: Side| match side {
        Side::Outer => "outer contact",
        Side::Inner => "inner contact",
    };
    let panel = |label: &str, unit: &str, curves| DamagePanel {
        label: label.into(),
        unit: unit.into(),
        from_zero: true,
        curves,
    };
    let mut depth = Vec::new();
    let depths = |path: RollerPath, side: Side| {
        under(Law::Ecl, path).map(|d| {
            let h = |u: &f64| d.floor(*u, side).map_or(0.0, |f| 1e6 * f.depth);
            angles.iter().map(h).collect::<Vec<f64>>()
        })
    };
    let first_side = sides.first().map_or(Side::Outer, |s| s.0);
    depth.extend(depths(RollerPath::Point, first_side).map(|h| curve("point", h)));
    for &(side, _) in sides {
        let name = if several {
            format!("envelope, {}", contact(side))
        } else {
            "envelope".to_owned()
        };
        depth.extend(depths(RollerPath::Envelope, side).map(|h| curve(&name, h)));
    }
    let unit = if (s.contact.exponent - 10.0 / 9.0).abs() < 1e-9 {
        "N/m^(10/9)"
    } else {
        brinell::channel::STIFFNESS_UNIT
    };
    let mut panels = vec![
        panel(
            "Length",
            "mm",
            vec![
                curve("in contact, L_e", left),
                curve("damaged, L_s", damaged),
            ],
        ),
        panel(
            match defect.shape {
                Shape::DepthMap(_) => "Mean depth h_s",
                _ => "Depth h_s",
            },
            "μm",
            depth,
        ),
    ];
    for &(side, delta) in sides {
        let mut k = Vec::new();
        for (law, path, name) in [
            (Law::Ecl, RollerPath::Point, "ecl, point"),
            (Law::Ecl, RollerPath::Envelope, "ecl, envelope"),
            (Law::Sliced, RollerPath::Point, "sliced, point"),
            (Law::Sliced, RollerPath::Envelope, "sliced, envelope"),
        ] {
            k.extend(under(law, path).map(|d| curve(name, stiffness(&d, side, delta))));
        }
        let label = if several {
            format!("K, {}", contact(side))
        } else {
            "Stiffness K".to_owned()
        };
        panels.push(panel(&label, unit, k));
    }
    (angles.iter().map(|u| u.to_degrees()).collect(), panels)
}

fn section(defect: &Defect, thickness: f64) -> (Vec<f64>, Vec<DamagePanel>) {
    let under = sections(
        &defect.shape,
        defect.depth,
        defect.roller_length,
        thickness,
        POINTS,
    );
    // The whole section to both sides, to hold the damaged one against.
    let whole = Section::new(defect.roller_length, thickness, 0.0, 0.0);
    let (first, last) = defect.shape.arc();
    let pad = 0.1 * (last - first);
    let mut all = vec![(first - pad, whole), (first, whole)];
    all.extend(under);
    all.extend([(last, whole), (last + pad, whole)]);
    let of = |name: &str, f: &dyn Fn(&Section) -> f64| DamageCurve {
        name: name.into(),
        values: all.iter().map(|(_, x)| f(x)).collect(),
    };
    let panel = |label: &str, unit: &str, curves| DamagePanel {
        label: label.into(),
        unit: unit.into(),
        from_zero: false,
        curves,
    };
    let panels = vec![
        panel("Area A", "mm^2", vec![of("", &|x| 1e6 * x.area)]),
        panel("Inertia I", "mm^4", vec![of("", &|x| 1e12 * x.inertia)]),
        panel(
            "Thickness",
            "mm",
            vec![
                of("of equal area, h_a", &|x| 1e3 * x.area_thickness),
                of("of equal inertia, h_I", &|x| 1e3 * x.inertia_thickness),
            ],
        ),
        panel(
            "Ratio",
            "",
            vec![
                of("inertia over the whole section's, K_I", &|x| {
                    x.inertia_ratio
                }),
                of("h_I / h_a = K_r", &|x| x.thickness_ratio),
            ],
        ),
    ];
    (all.iter().map(|(s, _)| 1e3 * s).collect(), panels)
}

fn depths(shape: &Shape) -> Option<DepthPatch> {
    let Shape::DepthMap(grid) = shape else {
        return None;
    };
    let ((first, last), (low, high)) = (shape.arc(), grid.heights());
    let [columns, rows] = SHADED;
    let (ds, dz) = (
        (last - first) / (columns - 1) as f64,
        (high - low) / (rows - 1) as f64,
    );
    let at = |k: usize| {
        let (row, column) = (k / columns, k % columns);
        1e6 * grid.depth(first + ds * column as f64, low + dz * row as f64)
    };
    Some(DepthPatch {
        start_mm: [1e3 * first, 1e3 * low],
        step_mm: [1e3 * ds, 1e3 * dz],
        columns,
        depth_um: (0..columns * rows).map(at).collect(),
    })
}
