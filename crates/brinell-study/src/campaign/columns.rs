//! Runs as a table: a column for each number that any of them has.

use brinell::result::{Quantity, Spread};
use std::collections::HashMap;

/// A column of numbers, one a run.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberColumn {
    /// The number's name; ends of intervals are `.low` and `.high` of it.
    pub name: String,
    /// SI unit; 1 where it has none.
    pub unit: String,
    /// Whether these are ends of 95 % intervals.
    pub end: bool,
    /// A value a run; `None` where a run does not have it.
    pub values: Vec<Option<f64>>,
}

/// A column for each number, three for one with an interval, in the order of the first run that has them. A run that
/// failed has no numbers.
pub fn columns(runs: &[&[Quantity]]) -> Vec<NumberColumn> {
    let mut order: Vec<&Quantity> = Vec::new();
    let mut places: HashMap<&str, usize> = HashMap::new();
    for quantity in runs.iter().copied().flatten() {
        if !places.contains_key(quantity.name.as_str()) {
            places.insert(&quantity.name, order.len());
            order.push(quantity);
        }
    }
    let mut cells = vec![vec![None; runs.len()]; order.len()];
    for (row, run) in runs.iter().enumerate() {
        for quantity in *run {
            cells[places[quantity.name.as_str()]][row] = Some(quantity);
        }
    }
    let mut table = Vec::new();
    for (first, cells) in order.into_iter().zip(cells) {
        let mut push = |suffix: &str, end: bool, of: fn(&Quantity) -> Option<f64>| {
            table.push(NumberColumn {
                name: format!("{}{suffix}", first.name),
                unit: first.unit.clone(),
                end,
                values: cells.iter().map(|cell| cell.and_then(of)).collect(),
            });
        };
        push("", false, |q| q.value);
        if first.spread != Spread::Without {
            push(".low", true, |q| q.interval().map(|i| i.0));
            push(".high", true, |q| q.interval().map(|i| i.1));
        }
    }
    table
}
