//! The load along a roller at rest without damage, for the pictures.

use super::curves::curve;
use crate::number::short;
use crate::{DamageCurves, DamagePanel};
use brinell::lamina::{ContactLine, LoadAlong};
use brinell::scenario::Scenario;

/// Of the roller that carries most. `None` where rollers carry alike all along, for balls and the lumped model, or where
/// nothing holds the rings against the load.
pub(crate) fn along_roller(s: &Scenario) -> Option<DamageCurves> {
    if s.has_even_contacts() {
        return None;
    }
    let load = LoadAlong::of(s).ok()??;
    let curves = |values: &dyn Fn(&ContactLine) -> Vec<f64>| {
        let [inner, outer] = &load.contacts;
        vec![curve("outer contact", values(outer)), curve("inner contact", values(inner))]
    };
    let scaled = |by: f64, values: &[f64]| values.iter().map(|x| by * x).collect::<Vec<f64>>();
    let panel = |label: &str, unit: &str, curves| DamagePanel {
        label: label.into(),
        unit: unit.into(),
        from_zero: true,
        curves,
    };
    let mut panels = Vec::new();
    if load.drop.iter().any(|p| *p != 0.0) {
        let drop = curve("", scaled(1e6, &load.drop));
        panels.push(panel("Drop p", "µm", vec![drop]));
    }
    panels.push(panel("Line load q", "N/mm", curves(&|line| scaled(1e-3, &line.line_load))));
    panels.push(panel("Pressure", "MPa", curves(&|line| scaled(1e-6, &line.pressure))));
    let said = |line: &ContactLine| format!("{} N over {} mm", short(line.force, 3), short(1e3 * line.touching, 3));
    let [inner, outer] = &load.contacts;
    let place = format!(
        "that carries most: {}at {}°, with {} N",
        if s.bearing.rows > 1 { format!("row {}, ", outer.row + 1) } else { String::new() },
        short(outer.angle.to_degrees(), 3),
        short(outer.force, 4)
    );
    Some(DamageCurves {
        title: format!("The load along a roller at rest {place}"),
        along: scaled(1e3, &load.z),
        panels,
        note: format!(
            "{} at the outer, {} at the inner contact, without damage. Static balance of the whole bearing, in {} slices that do not know of each \
             other: without the stress concentration at ends",
            said(outer),
            said(inner),
            load.z.len()
        ),
    })
}
