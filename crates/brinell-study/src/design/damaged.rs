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

/// What a class's damage sets: in a machine that of one bearing, and none of the others.
pub(super) fn damage_of(bearings: Option<usize>, number: Option<usize>, damage: String) -> Vec<(String, String)> {
    let Some(count) = bearings else { return vec![("defects".into(), damage)] };
    let damaged = number.unwrap_or(1);
    let of = |k: usize| {
        let own = if k == damaged { damage.clone() } else { "[]".into() };
        (format!("bearing.{}.defects", k - 1), own)
    };
    // One that is not there is refused where the scenario is read.
    (1..=count.max(damaged)).map(of).collect()
}
