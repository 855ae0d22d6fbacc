//! Data sets: the same bytes whatever the threads, the shards and the interruptions; what is there stays; what does not
//! fit is reported.

mod bearing_datasets;
mod bytes;
mod heed;
mod histories;
mod refusals;
mod rows;

use crate::common::{Call, SHORT, brinell, command, files, json, parsed, results, same};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

const PLAN: &str = r#"name = "test"
base = "base.toml"
runs = 7
seed = 11
runs_per_file = 3
licence = "CC0-1.0"

[vary]
operation.speed_rpm = { uniform = [1400, 1600] }

[[classes]]
name = "healthy"
defects = []

[[classes]]
name = "outer"
[[classes.defects]]
on = "outer-raceway"
depth_um = { log = [5, 20] }
shape.random = { length_mm = { uniform = [1, 3] }, width_mm = 4 }
"#;

const SECRET: &str = "9f86d081884c7d659a2feaa0c55ad015";

fn folder_with(plan: &str) -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("base.toml"), SHORT).unwrap();
    fs::write(folder.path().join("plan.toml"), plan).unwrap();
    folder
}

fn make(folder: &Path, more: &[&str]) -> Call {
    brinell(folder, &[&["dataset", "plan.toml"], more].concat())
}

/// Rows of a file.
fn rows_of(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(fs::File::open(path).unwrap()).unwrap();
    reader.get_row_iter(None).unwrap().map(Result::unwrap).collect()
}

/// Rows of a file of runs, with the truth beside it where it is open.
pub(crate) fn rows(path: &Path) -> Vec<Row> {
    let beside = path.parent().unwrap().with_file_name("truth").join(path.file_name().unwrap());
    let runs = rows_of(path);
    if !beside.exists() {
        return runs;
    }
    let truth = rows_of(&beside);
    assert_eq!(truth.len(), runs.len());
    let join = |(run, truth): (Row, Row)| {
        assert_eq!(cell(&run, "run"), cell(&truth, "run"));
        Row::new(run.into_columns().into_iter().chain(truth.into_columns().into_iter().skip(1)).collect())
    };
    runs.into_iter().zip(truth).map(join).collect()
}

/// Whether a row does not tell a value: it has no such column, or nothing in it.
fn is_hidden(row: &Row, name: &str) -> bool {
    row.get_column_iter().find(|(n, _)| *n == name).is_none_or(|(_, field)| *field == Field::Null)
}

fn cell<'a>(row: &'a Row, name: &str) -> &'a Field {
    row.get_column_iter().find(|(n, _)| *n == name).unwrap_or_else(|| panic!("{name}")).1
}

pub(crate) fn whole(row: &Row, name: &str) -> i64 {
    match cell(row, name) {
        Field::Int(x) => i64::from(*x),
        Field::Long(x) => *x,
        other => panic!("{name}: {other}"),
    }
}

pub(crate) fn text(row: &Row, name: &str) -> Option<String> {
    match cell(row, name) {
        Field::Str(text) => Some(text.clone()),
        Field::Null => None,
        other => panic!("{name}: {other}"),
    }
}

fn list(row: &Row, name: &str) -> Option<Vec<f64>> {
    let number = |field: &Field| match field {
        Field::Float(x) => f64::from(*x),
        Field::Double(x) => *x,
        Field::Long(x) => *x as f64,
        other => panic!("{name}: {other}"),
    };
    match cell(row, name) {
        Field::ListInternal(list) => Some(list.elements().iter().map(number).collect()),
        Field::Null => None,
        other => panic!("{name}: {other}"),
    }
}
