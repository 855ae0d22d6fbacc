//! Damage as it is seen before it is simulated: extents, outlines, what a roller meets, the ring's section.

use crate::say::short;
use brinell::defect::section::{Section, sections};
use brinell::defect::simplify::Extent;
use brinell::defect::{Angles, Defect, Shape, Side, acting, spall, wrap};
use brinell::derived::Derived;
use brinell::model::{Model, ModelError};
use brinell::observe::load_zone::static_load_zone;
use brinell::observe::passes::place;
use brinell::scenario::{self, Contact, EdgeReaction, Law, RollerPath, Scenario, Surface};
use brinell_report::{DamageCurve, DamagePanel, DamageView, DepthPatch, Fact, Value};
use std::f64::consts::TAU;

/// Points of a curve.
const POINTS: usize = 1601;
/// Nodes of a shaded picture, along and across.
const SHADED: [usize; 2] = [161, 121];
/// Corners of a drawn circle.
pub(crate) const CORNERS: usize = 113;
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
    let derived = Derived::new(&model, s.simulation.accuracy);
    let statics = static_load_zone(&healthy).ok();
    let mut all = Vec::new();
    for (k, defect) in model.defects.iter().enumerate() {
        let side = match defect.surface {
            Surface::InnerRaceway => Side::Inner,
            _ => Side::Outer,
        };
        let law = model.contact(side);
        let force = statics.as_ref().map(|z| z.largest).filter(|f| *f > 0.0);
        let delta = force.map_or(FALLBACK_APPROACH, |f| law.deflection(f));
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
            pass_ms: 1e3 * derived.defect_passes[k],
            speed_rpm: 60.0 * derived.top_speed / TAU,
            load_zone_share: match defect.surface {
                Surface::Roller(_) => None,
                _ => zone.map(|[from, to]| arc / (to - from)),
            },
            approach_um: 1e6 * delta,
            force_n: force,
        };
        let (angle_deg, passage) = passage(s, &s.defects[k], defect, &model, side, delta);
        let thickness =
            1e-3 * thickness_mm.unwrap_or(THICKNESS_SHARE * s.bearing.roller_diameter_mm);
        let is_roller = matches!(defect.surface, Surface::Roller(_));
        let (section_s_mm, section) = if is_roller {
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
        let view = DamageView {
            title: format!("Defect {}: {}", k + 1, place(defect)),
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
                "stiffness Q/delta^n at an approach of {} um ({by_force}); this defect alone, the paths and laws side by side",
                short(1e6 * delta, 3)
            ),
            section_s_mm,
            section,
            section_note: if is_roller {
                "section properties describe rings; this damage lies on a roller".into()
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
    side: Side,
    delta: f64,
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
    let law = model.contact(side);
    let under = |law: Law, roller_path: RollerPath| {
        let contact = Contact {
            law,
            roller_path,
            edge_reaction: EdgeReaction::None,
            ..s.contact.clone()
        };
        Defect::new(of, &s.bearing, &contact)
    };
    let stiffness = |d: &Defect| -> Vec<f64> {
        let k = |u: &f64| {
            let angles = Angles {
                orbit: d.center + u,
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
    let (mut depth, mut k) = (Vec::new(), Vec::new());
    for (path, name) in [
        (RollerPath::Point, "point"),
        (RollerPath::Envelope, "envelope"),
    ] {
        if let Some(d) = under(Law::Ecl, path) {
            let h = |u: &f64| d.floor(*u, side).map_or(0.0, |f| 1e6 * f.depth);
            depth.push(curve(name, angles.iter().map(h).collect()));
        }
    }
    for (law, path, name) in [
        (Law::Ecl, RollerPath::Point, "ecl, point"),
        (Law::Ecl, RollerPath::Envelope, "ecl, envelope"),
        (Law::Sliced, RollerPath::Point, "sliced, point"),
        (Law::Sliced, RollerPath::Envelope, "sliced, envelope"),
    ] {
        k.extend(under(law, path).map(|d| curve(name, stiffness(&d))));
    }
    let panel = |label: &str, unit: &str, curves| DamagePanel {
        label: label.into(),
        unit: unit.into(),
        from_zero: true,
        curves,
    };
    let unit = if (s.contact.exponent - 10.0 / 9.0).abs() < 1e-9 {
        "N/m^(10/9)"
    } else {
        brinell::channel::STIFFNESS_UNIT
    };
    let panels = vec![
        panel(
            "Length",
            "mm",
            vec![
                curve("in contact, L_e", left),
                curve("damaged, L_s", damaged),
            ],
        ),
        panel("Depth h_s", "μm", depth),
        panel("Stiffness K", unit, k),
    ];
    (angles.iter().map(|u| u.to_degrees()).collect(), panels)
}

fn section(defect: &Defect, thickness: f64) -> (Vec<f64>, Vec<DamagePanel>) {
    let all = sections(
        &defect.shape,
        defect.depth,
        defect.roller_length,
        thickness,
        POINTS,
    );
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

/// The grid of a shape that has one.
pub(crate) fn depth_grid(of: &scenario::Defect) -> Option<brinell_damage::DepthGrid> {
    let grid = match &of.shape {
        scenario::Shape::DepthMap { grid } => grid.clone(),
        scenario::Shape::Random {
            seed,
            length_mm,
            width_mm,
            roughness,
        } => spall(
            *seed,
            *length_mm,
            *width_mm,
            *roughness,
            of.depth_um.max(1.0),
        ),
        _ => return None,
    };
    Some(brinell_damage::DepthGrid {
        s0_mm: grid.s0_mm,
        z0_mm: grid.z0_mm,
        ds_mm: grid.ds_mm,
        dz_mm: grid.dz_mm,
        columns: grid.columns,
        rows: grid.rows,
        depth_um: grid.depth_um,
        ..brinell_damage::DepthGrid::default()
    })
}

/// Where a grid's border is drawn if nobody says otherwise.
pub(crate) struct Contour {
    pub(crate) level_um: f64,
    pub(crate) tolerance_mm: f64,
}

impl Contour {
    /// At the depth at which the outline encloses the damaged area, to a tenth of the finer step.
    pub(crate) fn of(
        grid: &brinell_damage::DepthGrid,
        shape: &Shape,
    ) -> Result<Self, brinell_damage::DamageError> {
        Ok(Self {
            level_um: grid.level_of_area(1e6 * shape.area())?,
            tolerance_mm: 0.1 * grid.ds_mm.min(grid.dz_mm),
        })
    }
}

/// The damage seen from above, mm: exact where it has corners, `points` of them on a curved edge; widths alone are centred.
pub(crate) fn polygons_mm(
    of: &scenario::Defect,
    shape: &Shape,
    points: usize,
) -> Vec<Vec<[f64; 2]>> {
    match shape {
        Shape::Rectangle { half_length, width } if *width > 0.0 => {
            let (a, b) = (1e3 * half_length, 0.5e3 * width);
            vec![vec![[-a, -b], [a, -b], [a, b], [-a, b]]]
        }
        Shape::Circle { radius } => {
            let corner = |k: usize| {
                let (sin, cos) = (TAU * k as f64 / points as f64).sin_cos();
                [1e3 * radius * cos, 1e3 * radius * sin]
            };
            vec![(0..points).map(corner).collect()]
        }
        Shape::Outline(outline) => {
            let mm = |p: &Vec<[f64; 2]>| p.iter().map(|x| x.map(|x| 1e3 * x)).collect();
            outline.polygons().iter().map(mm).collect()
        }
        Shape::DepthMap(_) => depth_grid(of)
            .and_then(|grid| {
                let usual = Contour::of(&grid, shape).ok()?;
                grid.outline(usual.level_um, usual.tolerance_mm).ok()
            })
            .map_or(Vec::new(), |outline| outline.polygons_mm),
        _ => centred(shape, points),
    }
}

/// Polygons around the parts where L_s > 0, half of it to either side.
fn centred(shape: &Shape, points: usize) -> Vec<Vec<[f64; 2]>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open: Vec<[f64; 2]> = Vec::new();
    let mut close = |open: &mut Vec<[f64; 2]>| {
        let back: Vec<[f64; 2]> = open
            .iter()
            .rev()
            .filter(|p| p[1] > 0.0)
            .map(|p| [p[0], -p[1]])
            .collect();
        if open.len() > 1 && !back.is_empty() {
            parts.push(open.drain(..).chain(back).collect());
        }
        open.clear();
    };
    for (s, width) in course(shape, points) {
        let half = 0.5 * width;
        if half > 0.0 || !open.is_empty() {
            open.push([s, half]);
        } else {
            // The last point without width before the damage begins.
            open = vec![[s, 0.0]];
        }
        if half <= 0.0 && open.len() > 1 {
            close(&mut open);
            open = vec![[s, 0.0]];
        }
    }
    close(&mut open);
    parts
}

/// (s, L_s) in mm over the arc: closer at its ends, twice where L_s jumps.
pub(crate) fn course(shape: &Shape, points: usize) -> Vec<(f64, f64)> {
    let (first, last) = shape.arc();
    let length = last - first;
    let mut nodes: Vec<f64> = match shape {
        Shape::Rectangle { .. } => vec![first, last],
        Shape::Outline(outline) => outline.width().breakpoints(),
        Shape::DepthMap(grid) => grid.width().breakpoints(),
        _ => {
            let n = points.max(2) - 1;
            let cosine = |k: usize| 0.5 - 0.5 * (0.5 * TAU * k as f64 / n as f64).cos();
            (0..=n).map(|k| first + length * cosine(k)).collect()
        }
    };
    if nodes.len() > 4 * points {
        let n = points.max(2) - 1;
        nodes = (0..=n)
            .map(|k| first + length * k as f64 / n as f64)
            .collect();
    }
    let hair = 1e-9 * length;
    let width = |s: f64| shape.damaged_length(s.clamp(first, last)).max(0.0);
    let mut all = Vec::with_capacity(nodes.len());
    let end = nodes.len() - 1;
    for (k, s) in nodes.into_iter().enumerate() {
        let s = if k == end { last } else { s };
        let (before, after) = (width(s - hair), width(s + hair));
        let (mm, jump) = (1e3 * s, (after - before).abs() > 1e-6 * length);
        if k == 0 {
            all.push((
                mm,
                1e3 * if after < 1e-4 * length {
                    width(s)
                } else {
                    after
                },
            ));
        } else if k == end {
            all.push((
                mm,
                1e3 * if before < 1e-4 * length {
                    width(s)
                } else {
                    before
                },
            ));
        } else if jump {
            all.extend([(mm, 1e3 * before), (mm, 1e3 * after)]);
        } else {
            all.push((mm, 1e3 * width(s)));
        }
    }
    all
}
