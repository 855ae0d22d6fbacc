//! Contact conditions during roller passage over a defect, and the ring's section under it; depths for the picture from
//! above.

use crate::{DamageCurve, DamagePanel, DepthPatch};
use brinell::defect::section::{Section, sections};
use brinell::defect::{Defect, Shape};

/// Points of a curve.
pub(super) const POINTS: usize = 1601;
/// Nodes of a shaded picture, along and across.
const SHADED: [usize; 2] = [161, 121];

pub(super) fn curve(name: &str, values: Vec<f64>) -> DamageCurve {
    DamageCurve { name: name.into(), values }
}

pub(super) fn section(defect: &Defect, width: f64, thickness: f64) -> (Vec<f64>, Vec<DamagePanel>) {
    let under = sections(&defect.shape, defect.depth, width, thickness, POINTS);
    // The whole section to both sides, to hold the damaged one against.
    let whole = Section::new(width, thickness, 0.0, 0.0);
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
                of("inertia over the whole section's, K_I", &|x| x.inertia_ratio),
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
    let (ds, dz) = ((last - first) / (columns - 1) as f64, (high - low) / (rows - 1) as f64);
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
