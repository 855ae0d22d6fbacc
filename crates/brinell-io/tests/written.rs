//! Files that brinell writes, read back by its own readers. Other people's read them in
//! validation/readers/check_written.py.

use std::path::Path;

use crate::common::{any_table, columns, names_in, numbered, sampled, within_floats, write};
use brinell_io::{Column, Format, IoError, Metadata, Outcome, RateSource, keys, open};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// The same tables at every run.
fn with_tables(mut check: impl FnMut(Vec<Vec<f64>>)) {
    let config = Config { failure_persistence: None, ..Config::with_cases(64) };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(config, rng);
    for _ in 0..64 {
        let tree = any_table().new_tree(&mut runner).unwrap();
        check(proptest::strategy::ValueTree::current(&tree));
    }
}

fn same(read: &[f64], rows: &[Vec<f64>], column: usize) {
    assert_eq!(read.len(), rows.len());
    for (value, row) in read.iter().zip(rows) {
        assert_eq!(value.to_bits(), row[column].to_bits());
    }
}

fn round_trip(format: Format) {
    with_tables(|rows| {
        let folder = tempfile::tempdir().unwrap();
        let columns = numbered(rows[0].len());
        let mut writer = format.create(folder.path(), &columns, &sampled()).unwrap();
        write(&mut *writer, &rows).unwrap();
        let path = writer.finish(Outcome::Complete).unwrap();
        let mut file = open(&path).unwrap();
        for (i, column) in columns.iter().enumerate() {
            let channel = file.channels().iter().find(|c| c.name == column.name);
            let channel = channel.unwrap();
            assert_eq!(channel.unit.as_deref(), Some("m"));
            assert!(rows.len() < 2 || channel.rate.as_ref().unwrap().hz == 25600.0);
            same(&file.read(&column.name).unwrap(), &rows, i);
        }
        assert_eq!(names_in(folder.path()), [format.file_name()]);
    });
}

#[test]
fn prop_mat_gives_back_every_bit() {
    round_trip(Format::Mat);
}

#[cfg(feature = "npz")]
#[test]
fn prop_npz_gives_back_every_bit() {
    round_trip(Format::Npz);
}

#[test]
fn prop_uff_gives_back_every_bit() {
    round_trip(Format::Uff58);
}

#[cfg(feature = "parquet")]
#[test]
fn prop_parquet_gives_back_every_bit_by_the_common_reader() {
    round_trip(Format::Parquet);
}

#[test]
fn prop_csv_gives_back_every_number_by_the_common_reader() {
    with_tables(|rows| {
        let folder = tempfile::tempdir().unwrap();
        let mut writer = Format::Csv.create(folder.path(), &numbered(rows[0].len()), &sampled()).unwrap();
        write(&mut *writer, &rows).unwrap();
        let mut file = open(writer.finish(Outcome::Complete).unwrap()).unwrap();
        for i in 0..rows[0].len() {
            let read = file.read(&format!("channel_{i}")).unwrap();
            assert_eq!(read.len(), rows.len());
            for (value, row) in read.iter().zip(&rows) {
                assert!(value.to_bits() == row[i].to_bits() || value.is_nan() && row[i].is_nan());
            }
        }
    });
}

#[test]
fn prop_wav_gives_back_floats_names_and_units() {
    with_tables(|rows| {
        let rows = within_floats(&rows);
        let folder = tempfile::tempdir().unwrap();
        let columns = numbered(rows[0].len());
        let metadata = sampled().with(keys::SCENARIO, "name = \"Prüfstand\"\n");
        let mut writer = Format::Wav.create(folder.path(), &columns, &metadata).unwrap();
        write(&mut *writer, &rows).unwrap();
        let path = writer.finish(Outcome::Partial("interrupted".into())).unwrap();
        let mut file = open(&path).unwrap();
        for (i, column) in columns.iter().enumerate() {
            assert_eq!(file.channels()[i].unit.as_deref(), Some("m"));
            let read = file.read(&column.name).unwrap();
            assert_eq!(read.len(), rows.len());
            for (value, row) in read.iter().zip(&rows) {
                assert!(*value == f64::from(row[i] as f32) || value.is_nan() && row[i].is_nan());
            }
        }
        let comment = file.metadata().get("ICMT").unwrap();
        assert!(comment.contains("Prüfstand") && comment.contains("partial: interrupted"));
    });
}

/// More rows than a block of the spool holds, in several columns.
#[test]
fn prop_long_tables_keep_their_order() {
    let folder = tempfile::tempdir().unwrap();
    let columns: Vec<Column> = (0..40).map(|i| Column::new(format!("c{i}"), "m", "")).collect();
    let rows = 120_000;
    for format in [Format::Mat, Format::Uff58] {
        let mut writer = format.create(folder.path(), &columns, &sampled()).unwrap();
        let mut row = vec![0.0; 40];
        for i in 0..rows {
            for (j, value) in row.iter_mut().enumerate() {
                *value = f64::from(i) + 1e-3 * j as f64;
            }
            writer.write_row(&row).unwrap();
        }
        let mut file = open(writer.finish(Outcome::Complete).unwrap()).unwrap();
        for j in [0, 17, 39] {
            let read = file.read(&format!("c{j}")).unwrap();
            assert_eq!(read.len(), rows as usize);
            let wanted = |i: i32| f64::from(i) + 1e-3 * j as f64;
            assert!(read.iter().zip(0..).all(|(v, i)| *v == wanted(i)));
        }
    }
}

#[test]
fn regress_time_gives_way_to_start_and_rate() {
    let folder = tempfile::tempdir().unwrap();
    for format in [Format::Uff58, Format::Wav] {
        let mut writer = format.create(folder.path(), &columns(), &sampled()).unwrap();
        writer.write_row(&[0.5, 1.0]).unwrap();
        writer.write_row(&[0.5 + 1.0 / 25600.0, 2.0]).unwrap();
        let mut file = open(writer.finish(Outcome::Complete).unwrap()).unwrap();
        let only = file.only_signal().unwrap();
        assert_eq!((only.name.as_str(), only.unit.as_deref()), ("outer_ax", Some("m/s^2")));
        let rate = only.rate.clone().unwrap();
        assert!(rate.hz == 25600.0 && matches!(rate.source, RateSource::Header(_)));
        assert_eq!(file.read("outer_ax").unwrap(), [1.0, 2.0]);
    }
}

#[test]
fn regress_what_a_format_cannot_hold_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let say = |format: Format, columns: &[Column], metadata: &Metadata| {
        let path = Path::new(format.file_name());
        let error = format.create(folder.path(), columns, metadata).map(drop);
        let text = error.unwrap_err().to_string();
        let at = text.find(path.to_str().unwrap()).unwrap();
        text[at..].to_owned()
    };
    let none = Metadata::default();
    assert_eq!(
        say(Format::Wav, &columns(), &none),
        "signals.wav: WAV cannot hold this: it needs a sample rate, `brinell.sample_rate_hz`"
    );
    assert_eq!(
        say(Format::Uff58, &columns(), &none),
        "signals.uff: UFF 58 cannot hold this: it needs a sample rate, `brinell.sample_rate_hz`"
    );
    let odd = Metadata::default().with(keys::SAMPLE_RATE_HZ, "1234.5");
    assert_eq!(
        say(Format::Wav, &columns(), &odd),
        "signals.wav: WAV cannot hold this: its sample rate is a whole number of hertz, and not 1234.5"
    );
    let time = &columns()[..1];
    assert_eq!(
        say(Format::Uff58, time, &sampled()),
        "signals.uff: UFF 58 cannot hold this: there is no channel but the time"
    );
    let mut wav = Format::Wav.create(folder.path(), &columns(), &sampled()).unwrap();
    let mut row = vec![0.0; columns().len()];
    (row[0], row[1]) = (1e300, f64::from(f32::MAX));
    // Time is not written.
    wav.write_row(&row).unwrap();
    row[1] = -1e300;
    let told = wav.write_row(&row).unwrap_err().to_string();
    let name = &columns()[1].name;
    let why = format!("signals.wav: WAV cannot hold this: {name} is -1e300 in row 2, and 32-bit floats end at 3.4e38");
    assert!(told.ends_with(&why), "{told}");
    drop(wav);
    for name in ["outer ax", "fs", "brinell_units", "_x"] {
        let columns = [Column::new(name, "", "")];
        let error = Format::Mat.create(folder.path(), &columns, &none).map(drop);
        assert!(matches!(error, Err(IoError::ColumnName { .. })), "{name}");
    }
    assert!(names_in(folder.path()).is_empty());
}
