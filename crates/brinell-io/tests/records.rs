//! Rows with lists, read back by the `parquet` crate's own record reader.

#![cfg(feature = "parquet")]

use brinell_io::{Cell, Column, IoError, Kind, Metadata, RecordColumn, RecordWriter, record_facts, sha256_of};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::{Value, json};
use std::fs;

fn plain(field: &Field) -> Value {
    match field {
        Field::Null => Value::Null,
        Field::Bool(x) => json!(x),
        Field::Long(x) => json!(x),
        Field::Float(x) => json!(x),
        Field::Double(x) => json!(x),
        Field::Str(x) => json!(x),
        Field::ListInternal(list) => list.elements().iter().map(plain).collect(),
        other => panic!("{other:?}"),
    }
}

fn columns() -> Vec<RecordColumn> {
    [
        ("run", Kind::Whole),
        ("failed", Kind::Flag),
        ("speed", Kind::Number),
        ("class", Kind::Words),
        ("ax", Kind::Signal),
        ("rollers", Kind::Wholes),
        ("entry_t_s", Kind::Numbers),
        ("places", Kind::WordsList),
    ]
    .map(|(name, kind)| RecordColumn { column: Column::new(name, "1", ""), kind })
    .to_vec()
}

fn rows() -> Vec<Vec<Cell>> {
    let full = |run: i64| {
        vec![
            Cell::Whole(run),
            Cell::Flag(run % 2 == 1),
            Cell::Number(0.1 * run as f64),
            Cell::Words(format!("class \"{run}\"")),
            Cell::Signal((0..1000 * run).map(|k| (k as f32).sin()).collect()),
            Cell::Wholes((0..run).collect()),
            Cell::Numbers(vec![-0.0; run as usize]),
            Cell::WordsList(vec!["outer".into(); run as usize]),
        ]
    };
    let mut rows: Vec<_> = (0..5).map(full).collect();
    rows.insert(2, vec![Cell::Empty; 8]);
    rows
}

#[test]
fn prop_rows_come_back_empty_ones_and_empty_lists_included() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.parquet");
    let metadata = Metadata::default().with("brinell.version", "x");
    let mut writer = RecordWriter::create(&path, &columns(), &metadata).unwrap();
    let rows = rows();
    writer.write_group(&rows[..4]).unwrap();
    writer.write_group(&rows[4..]).unwrap();
    assert!(!path.exists());
    let written = writer.finish().unwrap();
    assert_eq!(written.sha256, sha256_of(&path).unwrap());
    assert_eq!(written.bytes, fs::metadata(&path).unwrap().len());
    let facts = record_facts(&path).unwrap();
    assert_eq!(facts.rows, 6);
    assert_eq!(facts.columns[4], "ax");
    assert_eq!(facts.metadata.get("brinell.version"), Some("x"));

    let reader = SerializedFileReader::new(fs::File::open(&path).unwrap()).unwrap();
    assert_eq!(reader.num_row_groups(), 2);
    let json: Vec<Value> = reader
        .get_row_iter(None)
        .unwrap()
        .map(|row| {
            let pairs = row.unwrap().into_columns().into_iter();
            pairs.map(|(name, field)| (name, plain(&field))).collect()
        })
        .collect();
    for (cells, found) in rows.iter().zip(&json) {
        for (cell, column) in cells.iter().zip(columns()) {
            let found = &found[&column.column.name];
            match cell {
                Cell::Empty => assert!(found.is_null()),
                Cell::Flag(x) => assert_eq!(found, x),
                Cell::Whole(x) => assert_eq!(found, x),
                Cell::Number(x) => assert_eq!(found, x),
                Cell::Words(x) => assert_eq!(found, x),
                Cell::Signal(x) => {
                    let found: Vec<f32> =
                        found.as_array().unwrap().iter().map(|x| x.as_f64().unwrap() as f32).collect();
                    assert_eq!(&found, x);
                }
                Cell::Wholes(x) => assert_eq!(found, &json!(x)),
                Cell::Numbers(x) => assert_eq!(found, &json!(x)),
                Cell::WordsList(x) => assert_eq!(found, &json!(x)),
            }
        }
    }
}

#[test]
fn prop_the_same_rows_give_the_same_bytes_and_a_dropped_writer_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str| {
        let path = folder.path().join(name);
        let mut writer = RecordWriter::create(&path, &columns(), &Metadata::default()).unwrap();
        rows().chunks(2).for_each(|rows| writer.write_group(rows).unwrap());
        writer.finish().unwrap().sha256
    };
    assert_eq!(write("a"), write("b"));
    let mut writer = RecordWriter::create(folder.path().join("c"), &columns(), &Metadata::default()).unwrap();
    writer.write_group(&rows()).unwrap();
    drop(writer);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn regress_rows_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    let mut writer = RecordWriter::create(&path, &columns(), &Metadata::default()).unwrap();
    assert!(matches!(writer.write_group(&[vec![Cell::Empty; 7]]), Err(IoError::RowLength { .. })));
    let mut row = vec![Cell::Empty; 8];
    row[0] = Cell::Number(1.0);
    assert!(writer.write_group(&[row]).is_err());
}
