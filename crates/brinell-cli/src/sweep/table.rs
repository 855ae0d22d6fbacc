//! The table of a sweep: a row a point, in the plan's order.

use super::points::{Points, signal_file};
use brinell::result::Quantity;
use brinell_io::{Cells, Column, Table};
use brinell_study::campaign::columns;
use brinell_study::runner::State;
use serde_json::Value;

/// How many points are in a state, by its word.
pub(super) fn count(states: &[State], word: &str) -> usize {
    states.iter().filter(|state| state.word() == word).count()
}

/// Point, keys, status, reason, and every number that any point has, with its interval.
pub(super) fn table(points: &Points, states: &[State], signals: bool) -> Table {
    let mut table = Table::default();
    let rows = states.len();
    let number = (1..=rows).map(|k| Some(k as f64)).collect();
    let about = "number of the point, in the plan's order";
    table.push(Column::new("point", "1", about), Cells::Numbers(number));
    let settings: Vec<Vec<(String, String)>> = (0..rows).map(|k| points.read.grid.settings(k)).collect();
    for (index, key) in points.read.grid.keys().enumerate() {
        let values: Vec<&str> = settings.iter().map(|s| s[index].1.as_str()).collect();
        let unit = points.read.units.get(key).copied().unwrap_or("");
        table.push(Column::new(key, unit, "what the point sets"), cells(&values));
    }
    let words = |of: &dyn Fn(&State) -> Option<String>| Cells::Words(states.iter().map(of).collect());
    let status = words(&|s| Some(s.word().to_owned()));
    table.push(Column::new("status", "", "complete, failed or not run"), status);
    let reason = words(&|s| s.failure().map(str::to_owned));
    table.push(Column::new("reason", "", "why it failed"), reason);
    if signals {
        let file = words(&|s| Some(format!("signals/{}", signal_file(&s.row()?.scenario))));
        table.push(Column::new("signals", "", "file of its channels"), file);
    }
    numbers(states, &mut table);
    table
}

/// The rows as JSON: of each point the cells by their columns' names, an empty one null.
pub(super) fn rows(table: &Table) -> Vec<Value> {
    let cell = |cells: &Cells, k: usize| match cells {
        Cells::Numbers(values) => values[k].into(),
        Cells::Words(values) => values[k].as_deref().into(),
    };
    let row = |k| {
        let named = table.columns.iter().zip(&table.cells);
        let named = named.map(|(column, cells)| (column.name.clone(), cell(cells, k)));
        Value::Object(named.collect())
    };
    (0..table.rows()).map(row).collect()
}

/// Numbers where all are numbers.
fn cells(values: &[&str]) -> Cells {
    let numbers: Option<Vec<f64>> = values.iter().map(|v| number(v)).collect();
    match numbers {
        Some(numbers) => Cells::Numbers(numbers.into_iter().map(Some).collect()),
        None => Cells::Words(values.iter().map(|v| Some((*v).to_owned())).collect()),
    }
}

/// The value of a setting, where it is a finite number.
pub(super) fn number(value: &str) -> Option<f64> {
    let value = value.trim().replace('_', "").parse::<f64>().ok()?;
    value.is_finite().then_some(value)
}

/// A column for each number of any point, and for the ends of its interval.
fn numbers(states: &[State], table: &mut Table) {
    let runs: Vec<&[Quantity]> = states.iter().map(State::numbers).collect();
    for column in columns(&runs) {
        let about = if column.end { "end of its 95 % interval" } else { "" };
        let head = Column::new(column.name, &column.unit, about);
        table.push(head, Cells::Numbers(column.values));
    }
}
