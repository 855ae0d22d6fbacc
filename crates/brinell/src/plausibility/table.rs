//! Whether the table of a file fits the damage whose contact it is said to be, and the load (section 19).
//!
//! What a table says at its own ends is in [`crate::scenario::TableData`]; of another bearing or other damage it can only be told where its
//! reach or its deformations differ.

use super::warning::short;
use crate::defect::{Defect, Defects, SIDES, Side, relative_radius};
use crate::document::Problem;
use crate::effective::Table;
use crate::model::Model;
use crate::scenario::Scenario;
use crate::statics::StaticLoadZone;

/// Share of delta by which delta_eff differs where damage is felt: the accuracy of tables.
pub(super) const FELT: f64 = 0.01;
/// Static deformations that the first delta above 0 may be.
const COARSE: f64 = 4.0;
/// And by this much at least, m: digits of a file.
const DIGITS: f64 = 1e-9;
/// Share of the shape's length over which the contact has to be changed: thin and flat ends may be felt by none.
const LEAST_COVERED: f64 = 0.5;
/// Depths of damage that a contact may sink by: a floor as deep bears it.
const DEEPER: f64 = 1.1;
/// What damage may reach beyond its shape and the contact's own reach, m: a length that its edges are rounded over, a cell of a grid.
const ROUNDED: f64 = 0.1e-3;

pub(super) fn warnings(scenario: &Scenario, model: &Model, zone: &StaticLoadZone) -> Vec<Problem> {
    let mut all = Vec::new();
    for (k, defect) in model.defects.iter().enumerate() {
        if scenario.defects[k].table.is_none() {
            continue;
        }
        let heaviest = |side: &Side| model.deflection(*side, zone.healthy_largest);
        let met = SIDES.into_iter().filter(|side| defect.meets_side(*side));
        let Some(side) = met.max_by(|a, b| heaviest(a).total_cmp(&heaviest(b))) else { continue };
        let Some(table) = defect.table(side) else { continue };
        let radius = relative_radius(&scenario.bearing, side);
        let alone = Defects::beside(&model.defects, defect, side).iter().count() == 1;
        let said = [of_load(table, heaviest(&side)), of_shape((defect, alone), table, radius)];
        let problem = |(words, allowed)| Problem::warning(format!("defects.{k}.table"), words).allowed(allowed);
        all.extend(said.into_iter().flatten().map(problem));
    }
    all
}

/// Deformations against `heaviest`, that of the healthy bearing's most loaded contact at rest, m.
fn of_load(table: &Table, heaviest: f64) -> Option<(String, String)> {
    let um = |x: f64| short(1e6 * x);
    let (last, first) = (table.last_delta(), *table.delta_nodes().iter().find(|delta| **delta > 0.0)?);
    let words = if last < heaviest {
        format!(
            "its delta_um end at {}, and the heaviest contact deforms by {} um at rest: beyond its end the table is straight",
            um(last),
            um(heaviest)
        )
    } else if first > COARSE * heaviest {
        format!(
            "its delta_um begin with {} above 0, and the heaviest contact deforms by {} um at rest: nothing between is known",
            um(first),
            um(heaviest)
        )
    } else {
        return None;
    };
    let allowed =
        format!("delta_um from below {} to above; about 4 times as much is enough; look at their unit", um(heaviest));
    Some((words, allowed))
}

/// s of the nodes against what the shape says; `radius` is that of the contact along s, m. Where the defect is not `alone` on its surface the
/// table may have the others too.
fn of_shape((defect, alone): (&Defect, bool), table: &Table, radius: f64) -> Option<(String, String)> {
    let mm = |x: f64| short(1e3 * x);
    let (first, last) = defect.shape.arc();
    let shape = format!("the damage's shape lies at s = {} to {} mm", mm(first), mm(last));
    let [begin, end] = table.range_s();
    if begin > first || end < last {
        let words = format!(
            "it ends at s = {} and {} mm, and {shape}: beyond the table the contact is healthy",
            mm(begin),
            mm(end)
        );
        return Some((words, format!("s_mm from below {} to above {}; look at their unit", mm(first), mm(last))));
    }
    let reach = (2.0 * radius * (table.last_delta() + defect.shape.raised())).sqrt() + ROUNDED;
    let Some([from, to]) = felt(table) else {
        return Some((
            "it leaves the contact healthy everywhere".into(),
            "delta_eff_um other than delta_um over the damage".into(),
        ));
    };
    let changed = format!("the contact is changed at s = {} to {} mm", mm(from), mm(to));
    let words = if to.min(last) - from.max(first) < LEAST_COVERED * (last - first) {
        format!("{changed} alone, and {shape}: this is the table of other damage")
    } else if alone && (from < first - reach || to > last + reach) {
        format!(
            "{changed}, and {shape}, from which contacts reach {} mm farther at most: this is the table of other damage",
            mm(reach)
        )
    } else if let Some(sunk) = sunk(table).filter(|sunk| alone && is_beneath(*sunk, defect.deepest())) {
        format!(
            "a contact yields by {} um more than a healthy one, and the damage is {} um deep: this is the table of deeper damage",
            short(1e6 * sunk),
            short(1e6 * defect.deepest())
        )
    } else {
        return None;
    };
    Some((words, "the table of this damage, s counted from its center_deg; look at the units".into()))
}

/// Whether a contact that yields by so much more than a healthy one, beyond the accuracy of tables, is beneath the floor of damage, m.
pub(super) fn is_beneath(sunk: f64, depth: f64) -> bool {
    sunk > DEEPER * depth + DIGITS
}

/// Largest delta - delta_eff beyond the accuracy of tables, m.
fn sunk(table: &Table) -> Option<f64> {
    let deltas = table.delta_nodes().iter().enumerate();
    let of = |(column, delta): (usize, &f64)| {
        let at = (0..table.s_nodes().len()).map(|row| table.node(row, column).0);
        Some(delta - at.reduce(f64::min)?.max(0.0) - FELT * delta)
    };
    // Where delta_eff is below 0 nothing touches.
    deltas.filter(|(_, delta)| **delta > 0.0).filter_map(of).reduce(f64::max)
}

/// First and last s at which a contact is not the healthy one, m.
fn felt(table: &Table) -> Option<[f64; 2]> {
    let deltas = || table.delta_nodes().iter().enumerate().filter(|(_, delta)| **delta > 0.0);
    let changed = |row: &usize| {
        deltas().any(|(column, delta)| (table.node(*row, column).0 - delta).abs() > FELT * delta + DIGITS)
    };
    let mut rows = (0..table.s_nodes().len()).filter(changed);
    let from = rows.next()?;
    Some([from, rows.next_back().unwrap_or(from)].map(|row| table.s_nodes()[row]))
}
