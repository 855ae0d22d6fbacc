//! Where the damage of a class goes: into a scenario, or to one bearing of a machine.

use brinell::document::Problem;
use brinell::document::reading::{Toml, parse};

/// How many bearings a base has that is a machine; `None` of one bearing.
pub(super) fn bearings_of(base: &str) -> Result<Option<usize>, Vec<Problem>> {
    let root = parse(base, &[])?;
    Ok(match root.get("bearing").map(|entry| &entry.node.value) {
        Some(Toml::Array(bearings)) => Some(bearings.len()),
        _ => None,
    })
}

/// What the damage of class `c` sets: in a machine that of one bearing, and none of the others.
///
/// # Errors
/// Where the machine has no such bearing.
pub(super) fn damage_of(
    bearings: Option<usize>,
    (c, number): (usize, Option<usize>),
    damage: String,
) -> Result<Vec<(String, String)>, Vec<Problem>> {
    let Some(count) = bearings else { return Ok(vec![("defects".into(), damage)]) };
    let damaged = number.unwrap_or(1);
    if damaged > count {
        let message = format!("the base has {count} bearing{}", if count == 1 { "" } else { "s" });
        let problem = Problem::error(format!("classes.{c}.bearing"), message).value(damaged.to_string());
        return Err(vec![problem.allowed(format!("1 to {count}"))]);
    }
    let of = |k: usize| {
        let own = if k == damaged { damage.clone() } else { "[]".into() };
        (format!("bearing.{}.defects", k - 1), own)
    };
    Ok((1..=count).map(of).collect())
}
