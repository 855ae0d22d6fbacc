//! Files in memory: read and written as those on the disk are.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::common::{columns, sampled};
use brinell_io::{Format, IoError, Metadata, Outcome, SignalFile, keys, open, open_bytes};

/// All that is in a file, errors by their words; values by their bits, for some are NaN.
fn everything(file: Result<SignalFile, IoError>) -> Result<String, String> {
    let mut file = file.map_err(|e| e.to_string())?;
    let mut all = format!("{} {:?}\n{:?}\n{:?}\n", file.kind(), file.path(), file.channels(), file.metadata());
    let names: Vec<String> = file.channels().iter().map(|c| c.name.clone()).collect();
    let parts = ["", "(:,2)", "(3,:)"];
    for name in names {
        for part in parts {
            let read = file.read(&format!("{name}{part}"));
            let bits = read.map(|values| values.into_iter().map(f64::to_bits).collect::<Vec<_>>());
            all += &format!("{:?}\n", bits.map_err(|e| e.to_string()));
        }
    }
    Ok(all)
}

fn files() -> Vec<PathBuf> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let mut files = Vec::new();
    for folder in ["data", "corpus"] {
        let entries = std::fs::read_dir(tests.join(folder)).unwrap();
        files.extend(entries.map(|entry| entry.unwrap().path()));
    }
    files.sort();
    files
}

#[test]
fn prop_bytes_are_read_as_the_file_is() {
    let mut readable = 0;
    for path in files() {
        let name = path.to_str().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let by_path = everything(open(&path));
        readable += usize::from(by_path.is_ok());
        assert_eq!(by_path, everything(open_bytes(name, bytes.clone())));
        // Shared ones, which the caller keeps.
        let shared: Arc<[u8]> = bytes.into();
        assert_eq!(by_path, everything(open_bytes(name, shared.clone())));
    }
    let least = if cfg!(all(feature = "parquet", feature = "hdf5", feature = "npz")) { 38 } else { 20 };
    assert!(readable >= least, "{readable} files are readable");
}

#[test]
fn prop_bytes_are_called_by_their_name() {
    let says = |name: &str, bytes: &[u8]| open_bytes(name, bytes.to_vec()).map(drop).unwrap_err().to_string();
    assert_eq!(says("a.csv", b""), "a.csv: the file is empty");
    assert_eq!(
        says("a.wav", b"1,2\n3,4\n"),
        "a.wav: named like WAV, but the content is text; rename it or save it again"
    );
    let error = open_bytes("a.txt", *b"1\n2\nx\n").and_then(|mut f| f.read("column1"));
    assert_eq!(error.unwrap_err().to_string(), "a.txt: line 3, column `column1`: `x` is not a number");
}

/// More rows than a block of the spool holds.
#[test]
fn prop_written_bytes_are_the_files() {
    let folder = tempfile::tempdir().unwrap();
    let metadata = sampled().with(keys::SCENARIO, "name = \"Prüfstand\"\n");
    let outcomes = [Outcome::Complete, Outcome::Partial("interrupted".into())];
    for (format, (rows, outcome)) in
        Format::ALL.into_iter().flat_map(|format| [0, 140_001].into_iter().zip(&outcomes).map(move |r| (format, r)))
    {
        let file = format.create(folder.path(), &columns(), &metadata);
        let memory = format.in_memory(&columns(), &metadata);
        let (mut file, mut memory) = match (file, memory) {
            (Ok(file), Ok(memory)) => (file, memory),
            (Err(IoError::FormatLeftOut { .. }), Err(IoError::FormatLeftOut { .. })) => continue,
            (file, memory) => panic!("{format:?}: {:?}, {memory:?}", file.err()),
        };
        for i in 0..rows {
            let row = [f64::from(i) / 25600.0, f64::from(i * 7919 % 2003) - 1e3];
            file.write_row(&row).unwrap();
            memory.write_row(&row).unwrap();
        }
        let path = file.finish(outcome.clone()).unwrap();
        let bytes = memory.finish(outcome.clone()).unwrap();
        // Not `assert_eq`, which would print megabytes.
        assert!(
            bytes == std::fs::read(path).unwrap(),
            "{format:?}, {rows} rows: the {} bytes are not those of the file",
            bytes.len()
        );
    }
}

#[test]
fn prop_in_memory_the_same_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let none = Metadata::default();
    for format in Format::ALL {
        for columns in [&columns()[..], &columns()[..1], &[]] {
            let file = format.create(folder.path(), columns, &none).err();
            let memory = format.in_memory(columns, &none).err();
            let start = format!("{}/", folder.path().display());
            let file = file.map(|e| e.to_string().replace(&start, ""));
            assert_eq!(file, memory.map(|e| e.to_string()), "{format:?}");
        }
    }
    let mut writer = Format::Csv.in_memory(&columns(), &none).unwrap();
    assert_eq!(writer.write_row(&[1.0]).unwrap_err().to_string(), "signals.csv: a row has 1 values for 2 columns");
}
