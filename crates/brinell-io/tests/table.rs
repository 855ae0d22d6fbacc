//! Tables of numbers and words, and journals: what is written comes back, and a killed process costs one line at most.
#![cfg(feature = "parquet")]

use brinell_io::{Cell, Cells, Column, IoError, Journal, Metadata, Table, keys, open, read_records};
use serde_json::json;
use std::fs;
use tempfile::tempdir;

fn table() -> Table {
    let mut table = Table::default();
    let words = ["full", "a, \"b\"\nc", " blank "].map(|w| Some(w.to_owned()));
    let mut words = words.to_vec();
    words.push(None);
    table.push(Column::new("model", "", ""), Cells::Words(words));
    table.push(
        Column::new("sensor_ax.rms", "m/s^2", ""),
        Cells::Numbers(vec![Some(0.1), None, Some(-0.0), Some(1e-300)]),
    );
    table
}

#[test]
fn regress_csv_quotes_what_needs_it_and_leaves_empty_cells_empty() {
    let folder = tempdir().unwrap();
    let path = table().write_csv(folder.path().join("t.csv")).unwrap();
    assert_eq!(
        fs::read_to_string(path).unwrap(),
        "model,sensor_ax.rms\nfull,0.1\n\"a, \"\"b\"\"\nc\",\n\" blank \",-0.0\n,1e-300\n"
    );
}

#[test]
fn prop_parquet_gives_the_table_back_and_the_same_bytes_each_time() {
    let folder = tempdir().unwrap();
    let metadata = Metadata::default().with(keys::VERSION, "0.1.0");
    let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
    for path in [&a, &b] {
        table().write_parquet(path, &metadata).unwrap();
    }
    assert_eq!(fs::read(&a).unwrap(), fs::read(&b).unwrap());
    let all = |path| read_records(path, &["model", "sensor_ax.rms"], |_| true).unwrap();
    let words = |text: &str| Cell::Words(text.into());
    let expected = [
        [words("full"), Cell::Number(0.1)],
        [words("a, \"b\"\nc"), Cell::Empty],
        [words(" blank "), Cell::Number(-0.0)],
        [Cell::Empty, Cell::Number(1e-300)],
    ];
    assert_eq!(all(&a), expected);
    let unit = open(&a).unwrap().channels().iter().find(|c| c.name == "sensor_ax.rms").unwrap().unit.clone();
    assert_eq!(unit.as_deref(), Some("m/s^2"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    // No row at all is a table too.
    let empty = Table { cells: vec![Cells::Words(vec![]), Cells::Numbers(vec![])], ..table() };
    empty.write_parquet(&a, &metadata).unwrap();
    assert!(all(&a).is_empty());
}

#[test]
fn regress_uneven_columns_are_refused() {
    let folder = tempdir().unwrap();
    let mut table = table();
    table.push(Column::new("x", "m", ""), Cells::Numbers(vec![None]));
    let error = table.write_csv(folder.path().join("t.csv")).unwrap_err();
    assert!(matches!(error, IoError::RowLength { expected: 4, got: 1, .. }));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn prop_a_journal_cut_anywhere_keeps_its_whole_lines() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("journal.jsonl");
    let lines: Vec<_> = (0..4).map(|k| json!({ "k": k, "x": 0.1 * f64::from(k), "s": "ü\n" })).collect();
    let (mut journal, found) = Journal::open(&path).unwrap();
    assert!(found.is_empty());
    for line in &lines {
        journal.append(line).unwrap();
    }
    drop(journal);
    let whole = fs::read(&path).unwrap();
    for cut in 0..=whole.len() {
        fs::write(&path, &whole[..cut]).unwrap();
        let (mut journal, found) = Journal::open(&path).unwrap();
        let ends = whole[..cut].iter().filter(|b| **b == b'\n').count();
        assert_eq!(found, lines[..ends], "cut at {cut}");
        journal.append(&json!("more")).unwrap();
        drop(journal);
        let (_, found) = Journal::open(&path).unwrap();
        assert_eq!(found.len(), ends + 1);
        assert_eq!(found[ends], json!("more"));
    }
}

#[test]
fn regress_a_journal_damaged_in_its_middle_is_an_error_and_stays_as_it_is() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("journal.jsonl");
    fs::write(&path, "{\"k\":0}\nnot json\n{\"k\":1}\n").unwrap();
    let error = Journal::open(&path).unwrap_err().to_string();
    assert!(error.contains("line 2 is no line of a journal"), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), 3);
}

#[test]
fn regress_a_file_that_is_no_journal_stays_as_it_is() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("journal.jsonl");
    for text in ["my diary\n", "my diary", "{\"k\":0}\nnot json\n", "12"] {
        fs::write(&path, text).unwrap();
        let error = Journal::open(&path).unwrap_err().to_string();
        assert!(error.contains("is no line of a journal"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }
    // What some file systems leave of a line after a power cut.
    fs::write(&path, "{\"k\":0}\n\0\0\0").unwrap();
    assert_eq!(Journal::open(&path).unwrap().1, [json!({ "k": 0 })]);
}

#[test]
fn regress_one_process_at_a_time() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("journal.jsonl");
    let _open = Journal::open(&path).unwrap();
    assert!(matches!(Journal::open(&path), Err(IoError::Busy { .. })));
}
