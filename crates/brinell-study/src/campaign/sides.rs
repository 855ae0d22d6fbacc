//! A comparison as a table and as JSON: every number of each run, and its ratio to the baseline's, which is the first
//! run; and what runs may be called there.

use super::Compared;
use super::row::in_json;
use super::spread::{Level, band_of};
use brinell::document::{Loaded, Provenance};
use brinell::made_by::MadeBy;
use brinell::signal::{Written, objects};
use brinell_io::{Cells, Column, Table};
use serde_json::{Map, Value};

/// Runs that a page can show in distinct colours.
const MOST: usize = 6;
/// The table's own columns.
static OWN: [&str; 2] = ["quantity", "unit"];
/// Endings of the columns of each run, and of each but the baseline.
static VALUE: [&str; 3] = ["", ".low", ".high"];
static RATIO: [&str; 3] = [".ratio", ".ratio.low", ".ratio.high"];
/// By what is assumed, where that was asked.
static ASSUMED: [&str; 2] = [".ratio.assumed_low", ".ratio.assumed_high"];

/// One of the runs: what it is called, and its scenario.
#[derive(Debug, Clone)]
pub struct Side {
    /// Its name in tables and legends.
    pub label: String,
    /// What was run.
    pub loaded: Loaded,
}

/// Why runs cannot be laid side by side.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SidesError {
    /// So many.
    #[error("{0} to compare, and it takes two at least\n  allowed: 2 to {MOST} scenarios and variants")]
    Count(usize),
    /// A name that cannot head a column.
    #[error("`{0}` cannot name a run\n  allowed: words without commas and quotes that are no number")]
    Name(String),
    /// One name for two runs.
    #[error("two runs would be called {0}")]
    Twice(String),
    /// One name for two columns.
    #[error("two columns would be called {0}")]
    Columns(String),
}

/// That runs of these names can be laid side by side.
///
/// # Errors
/// Where they cannot.
pub fn check_labels(labels: &[String]) -> Result<(), SidesError> {
    if !(2..=MOST).contains(&labels.len()) {
        return Err(SidesError::Count(labels.len()));
    }
    for (k, name) in labels.iter().enumerate() {
        let bad = name.trim().is_empty()
            || name.contains([',', '"'])
            || name.contains(char::is_control)
            || name.parse::<f64>().is_ok();
        if bad {
            return Err(SidesError::Name(name.clone()));
        }
        if labels[..k].contains(name) {
            return Err(SidesError::Twice(name.clone()));
        }
    }
    let columns: Vec<String> = columns(labels).collect();
    match (1..columns.len()).find(|k| columns[..*k].contains(&columns[*k])) {
        Some(twice) => Err(SidesError::Columns(columns[twice].clone())),
        None => Ok(()),
    }
}

/// Names of the table's columns.
fn columns(labels: &[String]) -> impl Iterator<Item = String> {
    let of = |(k, label): (usize, &String)| {
        let endings = VALUE.iter().chain(RATIO.iter().chain(&ASSUMED).filter(|_| k > 0));
        let names: Vec<String> = endings.map(|ending| format!("{label}{ending}")).collect();
        names
    };
    let own = OWN.iter().map(|name| (*name).to_owned());
    own.chain(labels.iter().enumerate().flat_map(of))
}

/// A row a number: its value and interval in each run, and its ratio to the baseline's. `spread`: of each side but the baseline its ratios
/// with their bands by what is assumed; empty where that was not asked.
pub fn sides_table(sides: &[Side], compared: &[Compared], spread: &[Vec<Level>]) -> Table {
    let mut table = Table::default();
    let words = |of: fn(&Compared) -> &str| Cells::Words(compared.iter().map(|c| Some(of(c).to_owned())).collect());
    table.push(Column::new(OWN[0], "", ""), words(|c| &c.name));
    table.push(Column::new(OWN[1], "", "SI"), words(|c| &c.unit));
    let mut push = |name: String, of: &dyn Fn(&Compared) -> Option<f64>| {
        let numbers = compared.iter().map(of).collect();
        table.push(Column::new(name, "", ""), Cells::Numbers(numbers));
    };
    for (k, side) in sides.iter().enumerate() {
        let named = |ending: &str| format!("{}{ending}", side.label);
        let interval = |c: &Compared| c.of[k].as_ref()?.interval();
        push(named(VALUE[0]), &|c| c.of[k].as_ref()?.value);
        push(named(VALUE[1]), &|c| Some(interval(c)?.0));
        push(named(VALUE[2]), &|c| Some(interval(c)?.1));
        if k > 0 {
            push(named(RATIO[0]), &|c| Some(c.ratios[k]?.value));
            push(named(RATIO[1]), &|c| Some(c.ratios[k]?.interval?.0));
            push(named(RATIO[2]), &|c| Some(c.ratios[k]?.interval?.1));
            for (end, ending) in ASSUMED.iter().enumerate().filter(|_| !spread.is_empty()) {
                push(named(ending), &|c| Some(band_of(spread, k, &c.name)?.band[end]));
            }
        }
    }
    table
}

/// A key that has not the same value in all scenarios.
#[derive(Debug, Clone)]
pub struct Differing<'a> {
    /// Its dotted path.
    pub key: &'a str,
    /// Unit of its values.
    pub unit: &'static str,
    /// What every scenario has: `None` where it has no such key.
    pub values: Vec<Option<&'a Provenance>>,
}

/// Keys that have not the same value in all scenarios, each in the order of its first file.
pub fn differing<'a>(all: &[&'a Loaded]) -> Vec<Differing<'a>> {
    let mut keys: Vec<&str> = Vec::new();
    for p in all.iter().flat_map(|loaded| &loaded.provenance) {
        if !keys.contains(&p.key.as_str()) {
            keys.push(&p.key);
        }
    }
    let with_values = keys.into_iter().map(|key| {
        let values: Vec<_> = all.iter().map(|loaded| loaded.provenance.iter().find(|p| p.key == key)).collect();
        let unit = values.iter().flatten().next().map_or("", |p| p.unit);
        Differing { key, unit, values }
    });
    let value = |p: Option<&'a Provenance>| p.map(|p| p.value.as_str());
    with_values.filter(|d| d.values.windows(2).any(|pair| value(pair[0]) != value(pair[1]))).collect()
}

/// Each scenario by its label, as the files have it.
pub fn sides_scenarios(sides: &[Side]) -> Map<String, Value> {
    let one = |side: &Side| (side.label.clone(), side.loaded.to_toml().into());
    sides.iter().map(one).collect()
}

objects! {
    /// One number of all runs, by their labels.
    Number<'a> { unit: &'a str, runs: Map<String, Value>, ratios: Map<String, Value> }
    /// `compare.json`.
    Comparison<'a> {
        brinell: &'a str, made_by: MadeBy, baseline: Option<&'a str>, warnings: &'a [String], interval: &'a str, ratio: &'a str,
        interval_of_a_ratio: &'a str, quantities: Map<String, Value>, scenarios: Map<String, Value>,
    }
}

/// What `compare.json` holds; `warnings` are what its reader should know.
pub fn sides_json(sides: &[Side], compared: &[Compared], warnings: &[String]) -> Value {
    let by_label = |of: &dyn Fn(usize) -> Option<Value>| -> Map<String, Value> {
        let pairs = sides.iter().enumerate();
        pairs.filter_map(|(k, side)| Some((side.label.clone(), of(k)?))).collect()
    };
    let number = |c: &Compared| {
        in_json(&Number {
            unit: &c.unit,
            runs: by_label(&|k| c.of[k].as_ref().map(|q| in_json(&Written::new(q.value, q.interval())))),
            ratios: by_label(&|k| c.ratios[k].as_ref().map(in_json)),
        })
    };
    in_json(&Comparison {
        brinell: brinell::VERSION,
        made_by: MadeBy::now(),
        baseline: sides.first().map(|side| &*side.label),
        warnings,
        interval: "95 % of the value, an average over whole revolutions, or over a defect's entries or exits; peaks are those of a revolution",
        ratio: "of the value to the baseline's",
        interval_of_a_ratio: "95 %: ln(a/b) +- t sqrt(s_a^2/a^2 + s_b^2/b^2), Student's t with Welch's degrees of freedom; \
                              supposes runs that scatter independently",
        quantities: compared.iter().map(|c| (c.name.clone(), number(c))).collect(),
        scenarios: sides_scenarios(sides),
    })
}
