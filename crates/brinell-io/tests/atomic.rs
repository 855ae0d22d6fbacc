//! A file appears whole or not at all.

use crate::common::{any_table, columns, names_in, numbered, sampled, within_floats, write};
use brinell_io::{CsvWriter, Format, IoError, Outcome, SignalWriter, atomic_write};
use proptest::prelude::*;

fn formats() -> Vec<Format> {
    let left_out = |format: &Format| match format {
        Format::Parquet => !cfg!(feature = "parquet"),
        Format::Npz => !cfg!(feature = "npz"),
        _ => false,
    };
    Format::ALL.into_iter().filter(|f| !left_out(f)).collect()
}

proptest! {
    #[test]
    fn prop_a_dropped_writer_leaves_nothing_behind(rows in any_table()) {
        for format in formats() {
            let folder = tempfile::tempdir().unwrap();
            let mut writer = format.create(folder.path(), &numbered(rows[0].len()), &sampled()).unwrap();
            write(&mut *writer, &within_floats(&rows)).unwrap();
            prop_assert_eq!(names_in(folder.path()), [format!("{}.partial", format.file_name())]);
            drop(writer);
            prop_assert!(names_in(folder.path()).is_empty());
        }
    }
}

#[test]
fn prop_a_dropped_writer_keeps_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    for format in formats() {
        let path = folder.path().join(format.file_name());
        std::fs::write(&path, "old").unwrap();
        let mut writer = format.create(folder.path(), &columns(), &sampled()).unwrap();
        writer.write_row(&[0.0, 1.0]).unwrap();
        drop(writer);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
        let writer = format.create(folder.path(), &columns(), &sampled()).unwrap();
        writer.finish(Outcome::Complete).unwrap();
        assert_ne!(std::fs::read(&path).unwrap(), b"old");
    }
}

#[test]
fn prop_what_a_killed_run_left_does_not_leak_into_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    std::fs::write(folder.path().join("summary.json.partial"), "a long unfinished text").unwrap();
    atomic_write(&path, "{}").unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "{}");
    atomic_write(&path, "[]").unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "[]");
    assert_eq!(names_in(folder.path()), ["summary.json"]);
}

#[test]
fn regress_two_writers_of_one_file_do_not_mix() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("signals.csv");
    let mut first = Box::new(CsvWriter::create(&path, &columns()).unwrap());
    first.write_row(&[0.0, 1.0]).unwrap();
    assert!(matches!(CsvWriter::create(&path, &columns()), Err(IoError::Busy { .. })));
    first.finish(Outcome::Complete).unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "t,outer_ax\n0.0,1.0\n");
    CsvWriter::create(&path, &columns()).unwrap();
}

#[test]
fn regress_a_folder_that_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("nowhere/signals.csv");
    let error = atomic_write(&missing, "").unwrap_err();
    assert!(matches!(error, IoError::NoFolder { .. }));
    assert!(error.to_string().contains("nowhere; create it first"), "{error}");

    std::fs::write(folder.path().join("file"), "").unwrap();
    let error = atomic_write(folder.path().join("file/a.json"), "").unwrap_err();
    assert!(matches!(error, IoError::NoFolder { .. }), "{error}");

    assert!(matches!(atomic_write(folder.path(), ""), Err(IoError::NotAFileName { .. })));
    assert!(matches!(atomic_write("..", ""), Err(IoError::NotAFileName { .. })));
    assert_eq!(names_in(folder.path()), ["file"]);
}

/// A link in the partial file's place goes; what it names, or would make, is nobody's to write.
#[cfg(unix)]
#[test]
fn regress_a_link_as_partial_file_is_not_followed() {
    let (folder, elsewhere) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (mine, none) = (elsewhere.path().join("mine.txt"), elsewhere.path().join("none.txt"));
    std::fs::write(&mine, "mine").unwrap();
    let partial = folder.path().join("summary.json.partial");
    for target in [&mine, &none] {
        std::os::unix::fs::symlink(target, &partial).unwrap();
        atomic_write(folder.path().join("summary.json"), "{}").unwrap();
        assert_eq!(std::fs::read_to_string(folder.path().join("summary.json")).unwrap(), "{}");
        assert_eq!(names_in(folder.path()), ["summary.json"]);
        assert!(!folder.path().join("summary.json").is_symlink());
        assert_eq!((std::fs::read_to_string(&mine).unwrap().as_str(), none.exists()), ("mine", false));
    }
    // Nor is a file of two names written over by the other one.
    std::fs::hard_link(&mine, &partial).unwrap();
    atomic_write(folder.path().join("summary.json"), "[]").unwrap();
    assert_eq!(std::fs::read_to_string(&mine).unwrap(), "mine");
    assert_eq!(names_in(elsewhere.path()), ["mine.txt"]);
}

/// `/dev/full` takes the partial file's place: every write to it finds the disk full.
#[cfg(target_os = "linux")]
#[test]
fn regress_a_full_disk_is_named_and_leaves_nothing_behind() {
    for format in formats() {
        let folder = tempfile::tempdir().unwrap();
        let partial = folder.path().join(format!("{}.partial", format.file_name()));
        std::os::unix::fs::symlink("/dev/full", partial).unwrap();
        let mut writer = match format.create(folder.path(), &columns(), &sampled()) {
            Ok(writer) => writer,
            Err(error) => {
                assert!(matches!(error, IoError::DiskFull { .. }), "{error}");
                assert!(names_in(folder.path()).is_empty());
                continue;
            }
        };
        let error = (0..300_000).find_map(|i| writer.write_row(&[f64::from(i), 0.1]).err());
        // Formats that store one channel after the other write their file at the end.
        let Some(error) = error else {
            let error = writer.finish(Outcome::Complete).unwrap_err();
            assert!(matches!(error, IoError::DiskFull { .. }), "{error}");
            assert!(names_in(folder.path()).is_empty());
            continue;
        };
        assert!(matches!(error, IoError::DiskFull { .. }), "{error}");
        assert!(matches!(writer.write_row(&[0.0, 0.0]), Err(IoError::AlreadyFailed { .. })));
        assert!(matches!(writer.finish(Outcome::Complete), Err(IoError::AlreadyFailed { .. })));
        assert!(names_in(folder.path()).is_empty());
    }
}
