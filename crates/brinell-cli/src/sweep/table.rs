//! The table of a sweep: a row a point, in the plan's order.

use super::points::{Points, signal_file};
use brinell::result::Quantity;
use brinell_io::{Cells, Column, Table};
use brinell_study::campaign::{Row, columns};
use brinell_study::runner::Task;
use serde_json::Value;

/// The state of a point: its row, or why it failed; `None` where it has not run.
pub(super) struct State<'a>(Option<Result<&'a Row, &'a str>>);

impl<'a> State<'a> {
    pub(super) fn word(&self) -> &'static str {
        match self.0 {
            Some(Ok(_)) => "complete",
            Some(Err(_)) => "failed",
            None => "not run",
        }
    }

    /// The row of a point that is complete.
    pub(super) fn row(&self) -> Option<&'a Row> {
        self.0.and_then(Result::ok)
    }

    /// Why a point failed.
    pub(super) fn failure(&self) -> Option<&'a str> {
        self.0.and_then(Result::err)
    }
}

/// How many points are in a state, by its word.
pub(super) fn count(states: &[State], word: &str) -> usize {
    states.iter().filter(|state| state.word() == word).count()
}

/// The state of every point.
pub(super) fn states<'a>(points: &'a Points, row: impl Fn(&str) -> Option<&'a Row>) -> Vec<State<'a>> {
    let one = |task: &'a Result<Task, String>| match task {
        Err(reason) => State(Some(Err(reason.as_str()))),
        Ok(task) => {
            let row = row(&task.fingerprint);
            State(row.map(|row| row.result.as_ref().map(|_| row).map_err(String::as_str)))
        }
    };
    points.read.tasks.iter().map(one).collect()
}

/// Point, keys, status, reason, and every number that any point has, with its interval.
pub(super) fn table(points: &Points, states: &[State], signals: bool) -> Table {
    let mut table = Table::default();
    let rows = states.len();
    let number = (1..=rows).map(|k| Some(k as f64)).collect();
    let about = "number of the point, in the plan's order";
    table.push(Column::new("point", "1", about), Cells::Numbers(number));
    let settings: Vec<Vec<(String, String)>> = (0..rows).map(|k| points.plan.settings(k)).collect();
    for (index, key) in points.plan.keys().enumerate() {
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
    let runs: Vec<&[Quantity]> =
        states.iter().map(|s| s.row().and_then(|row| row.result.as_deref().ok()).unwrap_or_default()).collect();
    for column in columns(&runs) {
        let about = if column.end { "end of its 95 % interval" } else { "" };
        let head = Column::new(column.name, &column.unit, about);
        table.push(head, Cells::Numbers(column.values));
    }
}
