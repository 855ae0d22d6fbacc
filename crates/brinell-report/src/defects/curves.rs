//! What a roller meets on a defect, and the ring's section under it; depths for the picture from above.

use crate::{DamageCurve, DamagePanel, DepthPatch};
use brinell::defect::section::{Section, sections};
use brinell::defect::{Defect, Shape, Side, damaged_contact};
use brinell::model::Model;
use brinell::scenario::{self, Contact, EdgeReaction, Law, RollerPath, Scenario};

/// Points of a curve.
const POINTS: usize = 1601;
/// Nodes of a shaded picture, along and across.
const SHADED: [usize; 2] = [161, 121];

pub(super) fn curve(name: &str, values: Vec<f64>) -> DamageCurve {
    DamageCurve {
        name: name.into(),
        values,
    }
}

/// What a roller meets, over its angle from the defect's centre.
pub(super) fn passage(
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
        let k = |u: &f64| {
            damaged_contact(std::iter::once(d), law, &d.met_at(side, *u), side, delta)
                .map_or(law.stiffness, |a| {
                    law.stiffness * a.elastic / law.healthy(delta)
                })
        };
        angles.iter().map(k).collect()
    };
    let damaged: Vec<f64> = angles
        .iter()
        .map(|u| 1e3 * defect.damaged_length(u * defect.radius))
        .collect();
    // Under a ball the contact is its ellipse's axis across the groove.
    let of_ball = |side: Side, delta: f64| -> Option<Vec<f64>> {
        let law = model.contact(side);
        let axis = law.strips?.pressed(delta).length([f64::MIN, f64::MAX]);
        let lost = |u: &f64| {
            damaged_contact(
                std::iter::once(defect),
                law,
                &defect.met_at(side, *u),
                side,
                delta,
            )
            .map_or(0.0, |d| d.floor.damaged_length)
        };
        Some(angles.iter().map(|u| 1e3 * (axis - lost(u))).collect())
    };
    let left = match sides
        .first()
        .and_then(|&(side, delta)| of_ball(side, delta))
    {
        Some(left) => left,
        None => damaged
            .iter()
            .map(|x| 1e3 * defect.roller_length - x)
            .collect(),
    };
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
            if law == Law::Ecl && s.bearing.has_balls() {
                continue;
            }
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

pub(super) fn section(defect: &Defect, thickness: f64) -> (Vec<f64>, Vec<DamagePanel>) {
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

pub(super) fn depths(shape: &Shape) -> Option<DepthPatch> {
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
