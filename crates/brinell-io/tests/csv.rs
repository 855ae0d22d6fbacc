//! CSV: exact numbers, a plain header.

use crate::common::{columns, names_in, write};
use brinell_io::{Column, CsvWriter, IoError, Outcome, SignalWriter, open_bytes};

#[test]
fn regress_csv_is_a_header_and_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = Box::new(CsvWriter::create(folder.path().join("signals.csv"), &columns()).unwrap());
    let rows = [vec![0.0, -0.0], vec![3.90625e-5, 1e-7], vec![5e-324, f64::MAX], vec![f64::NAN, f64::NEG_INFINITY]];
    write(&mut *writer, &rows).unwrap();
    let path = writer.finish(Outcome::Partial("interrupted".into())).unwrap();
    assert_eq!(
        std::fs::read_to_string(path).unwrap(),
        "t,outer_ax\n0.0,-0.0\n0.0000390625,1e-7\n5e-324,1.7976931348623157e+308\nNaN,-inf\n"
    );
    assert_eq!(names_in(folder.path()), ["signals.csv"]);
}

#[test]
fn regress_csv_of_others_is_read() {
    let text = "\u{feff}t, \"force, N\"\r\n0,1\r\n\r\n 1e-3 ,+2.5\r\n";
    let mut file = open_bytes("theirs.csv", text).unwrap();
    assert_eq!(file.read("force, N").unwrap(), [1.0, 2.5]);
    assert_eq!(file.read("t").unwrap(), [0.0, 1e-3]);
    assert!(file.read("force").is_err());
}

/// One column: a name of several words is one where a unit ends it; other words above it are no name.
#[test]
fn regress_a_column_by_itself_keeps_its_name_and_unit() {
    for (head, name, unit) in [
        ("acc [g]", "acc [g]", Some("g")),
        ("Motor DE (m/s^2)", "Motor DE (m/s^2)", Some("m/s^2")),
        ("# acc [g]", "acc [g]", Some("g")),
        ("\"acc [g]\"", "acc [g]", Some("g")),
        ("acc\n[g]", "acc", Some("g")),
        ("Measured on Monday", "column1", None),
    ] {
        let mut file = open_bytes("one.csv", format!("{head}\n1.5\n-2.5\n\n")).unwrap();
        let channel = &file.channels()[0];
        assert_eq!((channel.name.as_str(), channel.unit.as_deref()), (name, unit), "{head}");
        assert_eq!(file.read(name).unwrap(), [1.5, -2.5]);
    }
}

/// A line above the numbers states the rate where name and unit are clear, and all such lines agree.
#[test]
fn regress_a_line_above_the_numbers_states_the_rate() {
    for (head, rate) in [
        ("Sample rate: 12000 Hz\nacc [g]", Some(12_000.0)),
        ("# fs=12000\nacc [g]", Some(12_000.0)),
        ("fs = 25.6 kHz\nacc [g]", Some(25_600.0)),
        ("Sampling frequency [kHz];12.8\nacc [g]", Some(12_800.0)),
        ("Sampling rate (Hz),12800\nacc [g]", Some(12_800.0)),
        ("fs=12000\nSample rate: 12 kHz\nacc [g]", Some(12_000.0)),
        ("fs=12000\nSample rate: 25.6 kHz\nacc [g]", None),
        ("Sample rate: 12,000 Hz\nacc [g]", None),
        ("Sample rate: 12000 per minute\nacc [g]", None),
        ("Speed: 1500 r/min\nacc [g]", None),
        ("acc [g]", None),
    ] {
        let file = open_bytes("rate.csv", format!("{head}\n1.5\n-2.5\n")).unwrap();
        let channel = &file.channels()[0];
        assert_eq!(channel.rate.as_ref().map(|r| r.hz), rate, "{head}");
        assert_eq!(channel.name, "acc [g]", "{head}");
    }
    let file = open_bytes("two.csv", "% Sample rate: 12000 Hz\nt [s],acc [g]\n0,1.5\n1,-2.5\n").unwrap();
    assert_eq!(file.channels()[1].rate.as_ref().map(|r| r.hz), Some(12_000.0));
}

#[test]
fn regress_names_that_csv_would_break_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |names: &[&str]| {
        let columns: Vec<Column> = names.iter().map(|&n| Column::new(n, "", "")).collect();
        CsvWriter::create(folder.path().join("a.csv"), &columns).map(drop).unwrap_err()
    };
    assert!(matches!(refused(&[]), IoError::NoColumns { .. }));
    for names in [&["a,b"][..], &["a\n"], &["\"a"], &[""], &[" a"], &["1.5"], &["t", "t"]] {
        assert!(matches!(refused(names), IoError::ColumnName { .. }), "{names:?}");
    }
    assert!(names_in(folder.path()).is_empty());
}

#[test]
fn regress_a_row_of_the_wrong_length_is_refused_and_the_file_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = Box::new(CsvWriter::create(folder.path().join("a.csv"), &columns()).unwrap());
    let error = writer.write_row(&[1.0]).unwrap_err();
    assert!(error.to_string().ends_with("a row has 1 values for 2 columns"));
    writer.write_row(&[1.0, 2.0]).unwrap();
    let path = writer.finish(Outcome::Complete).unwrap();
    assert_eq!(std::fs::read_to_string(path).unwrap(), "t,outer_ax\n1.0,2.0\n");
}

/// What cannot be told apart is refused: `2,143` beside `853` may be 2143 or 2.143.
#[test]
fn prop_fractions_that_may_be_thousands_are_refused() {
    let column = |cells: &[&str], between: char| {
        let lines: Vec<String> = cells.iter().map(|cell| format!("{cell}{between}1")).collect();
        format!("a{between}b\n{}\n", lines.join("\n"))
    };
    let read = |text: String| open_bytes("a.csv", text.into_bytes()).and_then(|mut file| file.read("a"));
    for between in ['\t', ';'] {
        let refused = read(column(&["-118", "2,143", "-43,626"], between)).unwrap_err().to_string();
        assert!(refused.contains("`2,143` may be a fraction or have a comma between thousands"), "{refused}");
        let refused = read(column(&["-118", "2.143", "-43.626"], between)).unwrap_err().to_string();
        assert!(refused.contains("`2.143` may be a fraction or have a point between thousands"), "{refused}");
        for (cells, values) in [
            (["0,123", "1,728", "2"], [0.123, 1.728, 2.0]),
            (["1,234", "43,728", "2,000"], [1.234, 43.728, 2.0]),
            (["1,5", "1,728", "2"], [1.5, 1.728, 2.0]),
            (["1234", "1,728", "2"], [1234.0, 1.728, 2.0]),
        ] {
            assert_eq!(read(column(&cells, between)).unwrap(), values);
            let pointed = cells.map(|cell| cell.replace(',', "."));
            assert_eq!(read(column(&pointed.each_ref().map(String::as_str), between)).unwrap(), values);
        }
    }
}

#[test]
fn regress_a_line_without_a_number_in_a_column_is_refused() {
    let read = |text: &str| open_bytes("a.csv", text.as_bytes().to_vec()).unwrap().read("acc");
    assert_eq!(read("# by hand\nacc\n\n1.5\n2.5\n\n\n").unwrap(), [1.5, 2.5]);
    for (line, what) in [("", "blank"), ("# later", "a comment")] {
        let error = read(&format!("acc\n1.5\n{line}\n2.5\n")).unwrap_err().to_string();
        assert!(error.contains(&format!("line 3 is {what}, among numbers")), "{error}");
    }
}
