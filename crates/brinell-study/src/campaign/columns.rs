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

/// Every number that any of the runs has, in the order of the first that has it: what it is there, and what each run
/// has.
pub(super) fn by_name<'a>(runs: &[&'a [Quantity]]) -> Vec<(&'a Quantity, Vec<Option<&'a Quantity>>)> {
    let mut table: Vec<(&Quantity, Vec<_>)> = Vec::new();
    let mut places: HashMap<&str, usize> = HashMap::new();
    for (k, run) in runs.iter().enumerate() {
        for quantity in *run {
            let place = *places.entry(&quantity.name).or_insert(table.len());
            if place == table.len() {
                table.push((quantity, vec![None; runs.len()]));
            }
            table[place].1[k] = Some(quantity);
        }
    }
    table
}

/// A column for each number, three for one with an interval, in the order of the first run that has them. A run that
/// failed has no numbers.
pub fn columns(runs: &[&[Quantity]]) -> Vec<NumberColumn> {
    let mut table = Vec::new();
    for (first, cells) in by_name(runs) {
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
