//! Bearings that work out of the box. Every number says where it comes from; estimates say how they were made.
//!
//! The numbers live in `catalogue.toml`, one table a bearing, keyed by scenario path; those of series that follow from a
//! maker's table by rule in `catalogue/series.csv`. Values keep the scenario
//! file's units, which the keys name.

mod series;

use super::designation::{of_one_kind, plain, readings, with_zeros};
use super::kinematics::Geometry;
use crate::analysis::has_bore_in_mm;
use crate::did_you_mean::did_you_mean;
use crate::scenario::{Choice, Laws};
use serde::Serialize;
use serde_json::Value as Json;
use std::sync::{LazyLock, OnceLock};

/// One bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Name, as `bearing.preset` gives it.
    pub name: String,
    /// One line: what it is, who makes it, which data set or paper knows it.
    pub title: String,
    /// Its numbers for the scenario, in the file's order.
    pub values: Vec<Value>,
    /// Numbers that fill no key of the scenario: `BORE`, and others of `FACTS` where a maker's are known.
    pub facts: Vec<Value>,
}

/// Bore diameter d, mm.
pub const BORE: &str = "bore_diameter_mm";
/// Outside diameter D, mm.
pub const OUTSIDE: &str = "outside_diameter_mm";
/// Width B, mm.
pub const WIDTH: &str = "width_mm";
/// Basic dynamic radial load rating C, N.
pub const DYNAMIC_RATING: &str = "dynamic_load_rating_n";
/// Basic static radial load rating C0, N.
pub const STATIC_RATING: &str = "static_load_rating_n";
/// Mass of the bearing, kg.
pub const MASS: &str = "mass_kg";
/// Every fact.
pub const FACTS: [&str; 6] = [BORE, OUTSIDE, WIDTH, DYNAMIC_RATING, STATIC_RATING, MASS];

/// One number of a bearing, and where it comes from.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Value {
    /// Scenario path, such as `bearing.pitch_diameter_mm`; its unit is in its name.
    #[serde(skip)]
    pub key: String,
    /// The value, in the key's unit: a measure, a count, or the word of a choice.
    pub value: Json,
    /// Where it is printed, or how it was estimated.
    pub source: String,
    /// Whether no source prints it.
    pub estimated: bool,
    /// The one set of laws that it holds with; `None`: every one.
    #[serde(skip)]
    pub laws: Option<Laws>,
}

impl Value {
    /// Whether it is a value of a bearing under these laws.
    pub(crate) fn holds_with(&self, laws: Laws) -> bool {
        self.laws.is_none_or(|own| own == laws)
    }
}

impl Entry {
    /// A number by its key of `[bearing]`; `None` where the entry does not give it.
    pub fn number(&self, key: &str) -> Option<f64> {
        let named = |v: &&Value| v.key.strip_prefix("bearing.") == Some(key);
        self.values.iter().find(named)?.value.as_f64()
    }

    /// Whether balls roll in it.
    pub fn has_balls(&self) -> bool {
        self.values.iter().any(|v| v.key == "bearing.element" && v.value == "ball")
    }

    /// How number, size or pitch circle of its elements was estimated, and with it its defect frequencies: of the
    /// number, where it was. `None` where sources print all three.
    pub(super) fn estimates_orders(&self) -> Option<&str> {
        let of_elements = ["bearing.rollers_per_row", "bearing.roller_diameter_mm", "bearing.pitch_diameter_mm"];
        let estimated = |key: &&str| self.values.iter().find(|v| v.estimated && v.key == *key);
        Some(&of_elements.iter().find_map(estimated)?.source)
    }

    /// One of `FACTS`.
    pub fn fact(&self, key: &str) -> Option<f64> {
        self.fact_of(key).map(|(value, _)| value)
    }

    /// The same with its source.
    pub fn fact_of(&self, key: &str) -> Option<(f64, &str)> {
        let fact = self.facts.iter().find(|v| v.key == key)?;
        Some((fact.value.as_f64()?, &fact.source))
    }

    /// What its kinematics follow from.
    ///
    /// # Errors
    /// In words, the first key that the entry does not give.
    pub(super) fn geometry(&self) -> Result<Geometry, String> {
        let needed = |key| self.number(key).ok_or_else(|| format!("{}: the catalogue gives no {key}", self.name));
        Ok(Geometry {
            inner_raceway_diameter: 1e-3 * needed("inner_raceway_diameter_mm")?,
            pitch_diameter: 1e-3 * needed("pitch_diameter_mm")?,
            roller_diameter: 1e-3 * needed("roller_diameter_mm")?,
            rollers_per_row: needed("rollers_per_row")? as usize,
        })
    }
}

const TEXT: &str = include_str!("catalogue.toml");

static ENTRIES: LazyLock<Vec<Entry>> = LazyLock::new(|| {
    let of_series = series::rows().map(|(_, row)| of_lines(row));
    own(TEXT).into_iter().chain(of_series).collect()
});

/// One bearing's lines, read where it is asked for: to read all takes as long as many a run.
struct Lines {
    name: &'static str,
    text: &'static str,
    entry: OnceLock<Entry>,
}

static LINES: LazyLock<Vec<Lines>> = LazyLock::new(|| {
    let begins = TEXT.match_indices("\n[\"").map(|(at, _)| at + 1);
    let ends = begins.clone().skip(1).chain([TEXT.len()]);
    let lines = begins.zip(ends).filter_map(|(from, to)| {
        let text = &TEXT[from..to];
        Some(Lines { name: text[2..].split_once('"')?.0, text, entry: OnceLock::new() })
    });
    lines.chain(series::rows().map(|(name, text)| Lines { name, text, entry: OnceLock::new() })).collect()
});

/// Every bearing, in the files' order.
pub fn all() -> &'static [Entry] {
    &ENTRIES
}

/// The bearing of that name; case, spaces and hyphens do not matter, nor does a maker in front or what follows the
/// size: `SKF NU 206 ECP`, `6205-2RSH/C3`.
pub fn find(name: &str) -> Option<&'static Entry> {
    let mut readings = readings(name).into_iter();
    find_exactly(name).or_else(|| readings.find_map(|(base, _)| find_exactly(&base)))
}

/// The same without suffixes and maker.
#[doc(hidden)]
pub fn find_exactly(name: &str) -> Option<&'static Entry> {
    let wanted = Some(plain(name)).filter(|_| !has_bore_in_mm(name))?;
    let lines = LINES.iter().find(|lines| plain(lines.name) == wanted)?;
    Some(lines.entry.get_or_init(|| of_lines(lines.text)))
}

/// The name of the catalogue that is nearest to one that it does not have.
pub fn nearest_name(name: &str) -> Option<&'static str> {
    if let Some(entry) = with_zeros(name).and_then(|name| find(&name)) {
        return Some(&entry.name);
    }
    let base = readings(name).into_iter().next().map(|(base, _)| base);
    let base = base.unwrap_or_else(|| plain(name));
    did_you_mean(&base, all().iter().map(|entry| entry.name.as_str()).filter(|known| of_one_kind(name, known)))
}

/// Of one bearing's lines of `catalogue.toml`, or its row of `series.csv`.
fn of_lines(text: &str) -> Entry {
    let filled = if text.starts_with('[') { None } else { series::text(text) };
    own(filled.as_deref().unwrap_or(text)).swap_remove(0)
}

/// Of the file that is part of the program.
fn own(text: &str) -> Vec<Entry> {
    parse(text).unwrap_or_else(|fault| panic!("catalogue.toml: {fault}"))
}

fn parse(text: &str) -> Result<Vec<Entry>, String> {
    let file: toml::Table = text.parse().map_err(|fault| format!("{fault}"))?;
    file.into_iter().map(|(name, table)| entry(name, table)).collect()
}

fn entry(name: String, table: toml::Value) -> Result<Entry, String> {
    let toml::Value::Table(mut table) = table else {
        return Err(format!("{name} is not a table"));
    };
    let Some(toml::Value::String(title)) = table.remove("title") else {
        return Err(format!("{name} has no title"));
    };
    let values: Vec<Value> = table
        .into_iter()
        .map(|(key, cell)| {
            value(&key, cell).ok_or_else(|| format!("{name}: {key} is not {{ value, source, estimated }}"))
        })
        .collect::<Result<_, _>>()?;
    // A scenario's key has its section in front.
    let (values, facts) = values.into_iter().partition(|v| v.key.contains('.'));
    Ok(Entry { name, title, values, facts })
}

fn value(key: &str, cell: toml::Value) -> Option<Value> {
    let toml::Value::Table(mut cell) = cell else {
        return None;
    };
    let value = match cell.remove("value")? {
        toml::Value::Float(number) => number.into(),
        toml::Value::Integer(count) => count.into(),
        toml::Value::String(choice) => choice.into(),
        _ => return None,
    };
    let source = cell.remove("source")?.as_str()?.to_owned();
    let estimated = cell.remove("estimated")?.as_bool()?;
    let laws = match cell.remove("laws") {
        None => None,
        Some(word) => Some(Laws::WORDS.iter().find(|(known, ..)| Some(*known) == word.as_str())?.1),
    };
    cell.is_empty().then(|| Value { key: key.to_owned(), value, source, estimated, laws })
}

#[cfg(test)]
mod tests;
