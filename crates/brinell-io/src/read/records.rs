//! Rows of cells of many kinds, read back: some columns of some rows of what [`crate::RecordWriter`] wrote.

use crate::{Cell, IoError};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use parquet::schema::types::Type;
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

/// The `columns` of those rows for which `wanted` says so, rows counting from 0; cells in the order of `columns`. A
/// list without elements is one of numbers. One row is in memory beside what comes back.
///
/// # Errors
/// Where the file cannot be read, has no such column, or a cell is of a kind that no row has.
pub fn read_records(
    path: impl AsRef<Path>,
    columns: &[&str],
    wanted: impl Fn(usize) -> bool,
) -> Result<Vec<Vec<Cell>>, IoError> {
    let mut all = Vec::new();
    each_record(path, columns, wanted, |cells| all.push(cells))?;
    Ok(all)
}

/// The same, each row handed on as it is read: one is in memory.
///
/// # Errors
/// As [`read_records`]; rows before the fault are handed on.
pub fn each_record(
    path: impl AsRef<Path>,
    columns: &[&str],
    wanted: impl Fn(usize) -> bool,
    each: impl FnMut(Vec<Cell>),
) -> Result<(), IoError> {
    let path = path.as_ref();
    let file = File::open(path).map_err(|e| IoError::reading(path, e))?;
    // The crate asserts some of what a damaged file can break.
    let damaged = |_| Err(ParquetError::General("the file is damaged".to_owned()));
    let rows = catch_unwind(AssertUnwindSafe(|| read(file, columns, wanted, each)));
    rows.unwrap_or_else(damaged).map_err(|error| IoError::Parquet { path: path.to_owned(), why: error.to_string() })
}

fn read(
    file: File,
    columns: &[&str],
    wanted: impl Fn(usize) -> bool,
    mut each: impl FnMut(Vec<Cell>),
) -> Result<(), ParquetError> {
    let reader = SerializedFileReader::new(file)?;
    let schema = reader.metadata().file_metadata().schema();
    let fields = schema.get_fields().iter();
    let fields = fields.filter(|field| columns.contains(&field.name()));
    let projected = Type::group_type_builder(schema.name()).with_fields(fields.cloned().collect()).build()?;
    let projected = Arc::new(projected);
    let mut first = 0;
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        let rows = first..first + group.metadata().num_rows().max(0) as usize;
        first = rows.end;
        let Some(last) = rows.clone().rev().find(|row| wanted(*row)) else {
            continue;
        };
        let read = group.get_row_iter(Some(projected.as_ref().clone()))?;
        for (row, cells) in (rows.start..=last).zip(read) {
            let cells = cells?;
            if wanted(row) {
                each(cells_of(&cells, columns)?);
            }
        }
    }
    Ok(())
}

fn cells_of(row: &Row, columns: &[&str]) -> Result<Vec<Cell>, ParquetError> {
    let cell = |name: &&str| {
        let mut fields = row.get_column_iter();
        let found = fields.find(|(column, _)| column.as_str() == *name);
        let cell = found.and_then(|(_, field)| cell_of(field));
        cell.ok_or_else(|| ParquetError::General(format!("no column `{name}` of rows")))
    };
    columns.iter().map(cell).collect()
}

fn cell_of(field: &Field) -> Option<Cell> {
    Some(match field {
        Field::Null => Cell::Empty,
        Field::Bool(x) => Cell::Flag(*x),
        Field::Long(x) => Cell::Whole(*x),
        Field::Double(x) => Cell::Number(*x),
        Field::Str(text) => Cell::Words(text.clone()),
        Field::ListInternal(list) => list_of(list.elements())?,
        _ => return None,
    })
}

fn list_of(elements: &[Field]) -> Option<Cell> {
    fn all<T>(elements: &[Field], of: impl Fn(&Field) -> Option<T>) -> Option<Vec<T>> {
        elements.iter().map(of).collect()
    }
    match elements.first() {
        Some(Field::Float(_)) => {
            all(elements, |e| if let Field::Float(x) = e { Some(*x) } else { None }).map(Cell::Signal)
        }
        Some(Field::Long(_)) => {
            all(elements, |e| if let Field::Long(x) = e { Some(*x) } else { None }).map(Cell::Wholes)
        }
        Some(Field::Str(_)) => {
            all(elements, |e| if let Field::Str(text) = e { Some(text.clone()) } else { None }).map(Cell::WordsList)
        }
        _ => all(elements, |e| if let Field::Double(x) = e { Some(*x) } else { None }).map(Cell::Numbers),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Column, Kind, Metadata, RecordColumn, RecordWriter};

    #[test]
    fn prop_rows_come_back_as_they_were_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rows.parquet");
        let columns = [
            ("whole", Kind::Whole),
            ("number", Kind::Number),
            ("words", Kind::Words),
            ("signal", Kind::Signal),
            ("wholes", Kind::Wholes),
            ("numbers", Kind::Numbers),
            ("list", Kind::WordsList),
        ];
        let columns = columns.map(|(name, kind)| RecordColumn { column: Column::new(name, "1", ""), kind });
        let row = |k: i64| {
            vec![
                Cell::Whole(k),
                Cell::number((k % 2 == 0).then_some(0.5 * k as f64)),
                Cell::Words(format!("run {k}")),
                Cell::Signal(vec![k as f32, -1.5]),
                Cell::Wholes(vec![k; 3]),
                Cell::Numbers(vec![0.25; k as usize]),
                Cell::WordsList(vec!["a".into(), "ü".into()]),
            ]
        };
        let rows: Vec<Vec<Cell>> = (0..7).map(row).collect();
        let mut writer = RecordWriter::create(&path, &columns, &Metadata::default()).unwrap();
        writer.write_group(&rows[..3]).unwrap();
        writer.write_group(&rows[3..]).unwrap();
        writer.finish().unwrap();
        // In another order than the file's, and of both groups.
        let names = ["signal", "list", "numbers", "wholes", "words", "number", "whole"];
        let back = read_records(&path, &names, |row| row % 2 == 0).unwrap();
        let expected = rows.iter().step_by(2).map(|row| {
            let place = |name| columns.iter().position(|c| c.column.name == name);
            names.map(|name| row[place(name).unwrap()].clone()).to_vec()
        });
        assert_eq!(back, expected.collect::<Vec<_>>());
        let error = read_records(&path, &["whole", "absent"], |_| true).unwrap_err();
        assert!(error.to_string().contains("`absent`"), "{error}");
    }
}
