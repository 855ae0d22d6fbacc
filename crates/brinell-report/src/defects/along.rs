//! The load along a roller at rest, healthy and damaged, for the pictures.

use super::curves::curve;
use crate::number::short;
use crate::{DamageCurves, DamagePanel};
use brinell::lamina::{AtRest, ContactLine};
use brinell::scenario::Scenario;

/// Of the roller that carries most. `None` where rollers have no slices, or nothing holds the rings
/// against the load.
pub(crate) fn along_healthy_roller(s: &Scenario) -> Option<DamageCurves> {
    along_roller(s, &AtRest::of(s).ok()??, None)
}

/// Of the roller over a defect (from 0), or of the one that carries most.
pub(super) fn along_roller(s: &Scenario, at_rest: &AtRest, defect: Option<usize>) -> Option<DamageCurves> {
    let load = at_rest.over(defect).ok()?;
    let sides = [(1, "outer"), (0, "inner")];
    let conditions = || {
        let damaged = load.damaged.as_ref().map(|pair| ("damaged", pair));
        std::iter::once(("healthy", &load.healthy)).chain(damaged)
    };
    let curves = |values: &dyn Fn(&ContactLine) -> Vec<f64>| {
        let of = |(side, name): (usize, &'static str)| {
            conditions()
                .map(move |(condition, pair)| curve(&format!("{condition}, {name} contact"), values(&pair[side])))
        };
        sides.into_iter().flat_map(of).collect::<Vec<_>>()
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
    let says = |(condition, pair): (&str, &[ContactLine; 2])| {
        let of = |line: &ContactLine| format!("{} N over {} mm", short(line.force, 3), short(1e3 * line.touching, 3));
        format!("{condition}: {} at the outer, {} at the inner contact", of(&pair[1]), of(&pair[0]))
    };
    let said: Vec<String> = conditions().map(says).collect();
    let at = &load.healthy[1];
    let place = match defect {
        Some(_) => "over the damage where it carries least".to_owned(),
        None => format!(
            "that carries most: {}at {}°, with {} N",
            if s.bearing.rows > 1 { format!("row {}, ", at.row + 1) } else { String::new() },
            short(at.angle.to_degrees(), 3),
            short(at.force, 4)
        ),
    };
    Some(DamageCurves {
        title: format!("The load along a roller at rest {place}"),
        along: scaled(1e3, &load.z),
        panels,
        note: format!(
            "{}. Static balance of the whole bearing, in {} slices that do not know of each other: without the stress concentration at edges",
            said.join("; "),
            load.z.len()
        ),
    })
}
