//! What files say beside their numbers, followed or refused. Those in HDF5 and TDMS are made by
//! `validation/readers/make_files.py`.

use brinell_io::{Channel, RateSource, SignalFile, open, open_bytes};

fn text(name: &str, text: impl AsRef<[u8]>) -> SignalFile {
    open_bytes(name, text.as_ref().to_vec()).unwrap_or_else(|e| panic!("{e}"))
}

fn refusal(name: &str, bytes: impl AsRef<[u8]>) -> String {
    open_bytes(name, bytes.as_ref().to_vec()).unwrap_err().to_string()
}

fn channel<'a>(file: &'a SignalFile, name: &str) -> &'a Channel {
    file.channels().iter().find(|c| c.name == name).unwrap_or_else(|| panic!("no {name} in {file:?}"))
}

/// Name, unit and rate of every channel that may be a signal.
fn signals(file: &SignalFile) -> Vec<(&str, Option<&str>, Option<f64>)> {
    let may_be = file.channels().iter().filter(|c| c.may_be_signal());
    may_be.map(|c| (c.name.as_str(), c.unit.as_deref(), c.rate.as_ref().map(|r| r.hz))).collect()
}

fn lvm(columns: &str, header: &[&str], rows: &[&str]) -> String {
    let head = "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\nMulti_Headings\tYes\n";
    let [header, rows] = [header, rows].map(|lines| lines.join("\n"));
    format!("{head}X_Columns\t{columns}\n***End_of_Header***\t\n\t\n{header}\n***End_of_Header***\n{rows}\n")
}

/// National Instruments, "Specification for the LabVIEW Measurement File": with several columns of X the cells of a
/// header stand above the columns of Y.
#[test]
fn lit_cells_of_a_labview_header_stand_above_their_columns() {
    let header = [
        "Channels\t3",
        "Samples\t3\t\t3\t\t3",
        "Y_Unit_Label\tVolts\t\tg\t\tm/s^2",
        "X_Dimension\tTime\t\tTime\t\tTime",
    ];
    let rows =
        ["X_Value\tU\tX_Value\tA\tX_Value\tB\tComment", "0\t1\t0\t2\t0\t3", "0\t1\t0\t2\t0\t4", "0\t1\t0\t2\t0\t5"];
    let expected = |steps: [Option<f64>; 3]| {
        let units = [("U", "Volts"), ("A", "g"), ("B", "m/s^2")].into_iter().zip(steps);
        units.map(|((name, unit), hz)| (name, Some(unit), hz)).collect::<Vec<_>>()
    };
    // A raster of its own.
    let even = [&header[..], &["Delta_X\t0.001\t\t0.001\t\t0.002"]].concat();
    let mut file = text("a.lvm", lvm("Multi", &even, &rows));
    let found: Vec<_> = signals(&file).into_iter().filter(|c| !c.0.starts_with("X_Value")).collect();
    assert_eq!(found, expected([Some(1000.0), Some(1000.0), Some(500.0)]));
    assert_eq!(file.read("B").unwrap(), [3.0, 4.0, 5.0]);
    // Units one after the other, without a cell above the abscissae.
    let dense = ["Channels\t3", "Y_Unit_Label\tVolts\tg\tm/s^2", "X_Dimension\tTime", "Delta_X\t0.001\t0.001\t0.001"];
    let file = text("a.lvm", lvm("Multi", &dense, &rows));
    let found: Vec<_> = signals(&file).into_iter().filter(|c| !c.0.starts_with("X_Value")).collect();
    assert_eq!(found, expected([Some(1000.0); 3]));
}

#[test]
fn lit_an_unused_channel_of_a_labview_file_says_nothing_of_the_others() {
    let header =
        ["Channels\t3", "Samples\t2\t0\t2", "Y_Unit_Label\tg\t\tV", "X_Dimension\tTime", "Delta_X\t0.001\t1.0\t0.001"];
    let file = text("a.lvm", lvm("One", &header, &["X_Value\ta\tb\tc\tComment", "0\t1\t\t2", "0\t3\t\t4"]));
    assert_eq!(signals(&file)[1..], [("a", Some("g"), Some(1000.0)), ("c", Some("V"), Some(1000.0))]);
    assert_eq!(channel(&file, "b").unreadable.as_deref(), Some("has 0 samples, as its header says"));
}

/// Its header would be read as samples: `Samples 2` is a line of two cells.
#[test]
fn lit_a_further_segment_of_a_labview_file_is_refused() {
    let header = ["Channels\t1", "Samples\t2", "X_Dimension\tTime", "Delta_X\t0.001"];
    for columns in ["No", "One"] {
        let first = lvm(columns, &header, &["X_Value\ta\tComment", "\t1.5", "\t2.5"]);
        let more = ["", "Channels\t1", "Samples\t2", "***End_of_Header***", "X_Value\ta\tComment", "\t3.5"].join("\n");
        let mut file = text("a.lvm", format!("{first}{more}"));
        let said = file.read("a").unwrap_err().to_string();
        assert!(said.starts_with("a.lvm: on line 18 a second segment begins"), "{said}");
        let mut got = Vec::new();
        let all = |piece: &[f64]| {
            got.extend_from_slice(piece);
            std::ops::ControlFlow::Continue(())
        };
        file.read_around("a", all).unwrap();
        assert!(got[..2] == [1.5, 2.5] && got[2].is_nan() && got.len() == 3, "{got:?}");
    }
}

#[test]
fn analytic_units_within_cells_are_those_of_the_columns() {
    for (name, rows) in [
        ("a.csv", "Time,Acc\n0.00 s,0.5 g\n0.01 s,-1.5e0 g\n0.02 s,2.25 g\n0.03 s,0.5 g\n"),
        ("b.csv", "Time;Acc\n0,00 s;0,5 g\n0,01 s;-1,5 g\n0,02 s;2,25 g\n0,03 s;0,5 g\n"),
        ("c.csv", "Time\tAcc\n0.00s\t0.5g\n0.01s\t-1.5g\n0.02s\t2.25g\n0.03s\t0.5g\n"),
    ] {
        let mut file = text(name, rows);
        assert_eq!(signals(&file), [("Time", Some("s"), None), ("Acc", Some("g"), None)], "{name}");
        assert_eq!(file.read("Acc").unwrap(), [0.5, -1.5, 2.25, 0.5], "{name}");
        assert_eq!(file.rate_of("Time", 1.0).unwrap().unwrap().round(), 100.0);
    }
    // Another unit further down is no number of the column's.
    let mut file = text("d.csv", "t,a\n0 s,1 g\n1 s,2 g\n2 s,3 g\n3 s,4 mg\n");
    assert_eq!(file.read("a").unwrap_err().to_string(), "d.csv: line 5, column `a`: `4 mg` is not a number");
}

#[test]
fn analytic_dates_with_times_are_a_column_of_times() {
    let rows = |stamp: &dyn Fn(usize) -> String, delimiter: &str| {
        let lines: Vec<String> = (0..50).map(|i| format!("{}{delimiter}{}.5", stamp(i), i % 7)).collect();
        format!("stamp{delimiter}acc\n{}\n", lines.join("\n"))
    };
    let iso = |i: usize| format!("2024-02-28T23:59:{:06.3}Z", 59.0 + 0.004 * i as f64);
    let local = |i: usize| format!("05.03.2024 10:11:{:06.3}", 12.0 + 0.004 * i as f64);
    let clock = |i: usize| format!("10:11:{:06.3}", 12.0 + 0.004 * i as f64);
    let over_midnight = |i: usize| match i {
        0..25 => format!("2024-02-29 23:59:{:06.3}", 59.9 + 0.004 * i as f64),
        _ => format!("2024-03-01 00:00:{:06.3}", 0.004 * (i - 25) as f64),
    };
    for (stamp, delimiter) in
        [(&iso as &dyn Fn(usize) -> String, ","), (&local, ";"), (&clock, "\t"), (&over_midnight, ",")]
    {
        let mut file = text("a.csv", rows(stamp, delimiter));
        let acc = channel(&file, "acc").clone();
        let times = file.times_of(&acc).unwrap().unwrap();
        assert_eq!(times.name, "stamp");
        let hz = file.rate_of("stamp", times.seconds_in_unit().unwrap()).unwrap().unwrap();
        assert!((hz - 250.0).abs() < 1e-6, "{hz}");
        assert_eq!(file.read("acc").unwrap()[8], 1.5);
    }
}

#[test]
fn analytic_signals_along_lines() {
    let values: Vec<f64> = (0..300).map(|i| f64::from(i * 37 % 101 - 50) / 8.0).collect();
    let words = |values: &[f64], sign: &str| values.iter().map(f64::to_string).collect::<Vec<_>>().join(sign);
    let times: Vec<f64> = (0..300).map(|i| f64::from(i) / 1000.0).collect();
    for sign in [",", ";", "\t", " "] {
        let mut file = text("a.txt", words(&values, sign));
        assert_eq!(signals(&file), [("row1", None, None)]);
        assert_eq!(file.read("row1").unwrap(), values, "{sign}");
    }
    let two = format!("fs: 1000 Hz\nTime [s],{}\nacc [g],{}\n", words(&times, ","), words(&values, ","));
    let mut file = text("a.csv", two);
    assert_eq!(signals(&file), [("Time [s]", Some("s"), None), ("acc [g]", Some("g"), Some(1000.0))]);
    assert_eq!(file.read("acc [g]").unwrap(), values);
    // More than the lines that decide the layout of a table.
    let long: Vec<f64> = values.iter().cycle().take(200_000).copied().collect();
    assert_eq!(text("a.csv", words(&long, ",")).read("row1").unwrap(), long);
}

#[test]
fn analytic_text_in_utf_16() {
    let table = "t [s]\tacc [µg]\r\n0\t0.5\r\n1\t-1.5\r\n2\t2.5\r\n";
    let units = || [0xfeff].into_iter().chain(table.encode_utf16());
    let (little, big) = (units().flat_map(u16::to_le_bytes), units().flat_map(u16::to_be_bytes));
    for bytes in [little.collect::<Vec<u8>>(), big.collect()] {
        let mut file = text("a.txt", bytes);
        assert_eq!(channel(&file, "acc [µg]").unit.as_deref(), Some("µg"));
        assert_eq!(file.read("acc [µg]").unwrap(), [0.5, -1.5, 2.5]);
    }
}

#[test]
fn regress_what_is_not_read_is_called_by_its_name() {
    let known = "; known are csv and other text, parquet, mat, hdf5, npy, npz, wav, uff and tdms";
    for json in ["{\"fs\": 4000, \"data\": [1, 2]}", " [ [0.1, 2], [3, 4]]", "[{\"a\": 1}]"] {
        let said = refusal("a.dat", json);
        assert_eq!(
            said,
            format!("a.dat: cannot read: JSON, which is not read; save the numbers as CSV, a column each{known}")
        );
    }
    // A row of units in brackets is none.
    assert_eq!(text("a.csv", "[s],[g]\n1,2\n3,4\n").channels().len(), 2);
    let uff = "    -1\n   151\nmodel\n    -1\n    -1\n    15\n         1\n    -1\n";
    assert_eq!(
        refusal("a.unv", uff),
        "a.unv: cannot read: a universal file without functions (dataset 58), so no signal is in it: datasets 151, 15"
    );
}

/// A word among the numbers is refused with its line; what lies before and after it can be read.
#[test]
fn prop_a_word_is_passed_as_missing_where_that_is_wanted() {
    let mut rows: Vec<String> = (0..40).map(|i| format!("{i},{i}.5")).collect();
    rows[20] = "20,Overload".into();
    rows.push("End of data".into());
    let mut file = text("a.csv", format!("t [s],a\n{}\n", rows.join("\n")));
    let error = file.read("a").unwrap_err();
    assert_eq!(error.to_string(), "a.csv: line 22, column `a`: `Overload` is not a number");
    assert!(error.is_of_a_line());
    let mut got = Vec::new();
    let all = |piece: &[f64]| {
        got.extend_from_slice(piece);
        std::ops::ControlFlow::Continue(())
    };
    file.read_around("a", all).unwrap();
    assert_eq!(got.len(), 41);
    assert!(got.iter().enumerate().all(|(i, v)| if [20, 40].contains(&i) { v.is_nan() } else { *v == i as f64 + 0.5 }));
    // A line below the table says nothing against its rate.
    assert_eq!(file.rate_of("t [s]", 1.0).unwrap(), Ok(1.0));
    assert!(file.read("a").is_err(), "strict again");
}

/// CF Metadata Conventions, 8.1: a value is `scale_factor` times the number stored, plus `add_offset`.
#[test]
#[cfg(feature = "hdf5")]
fn xval_packed_numbers_of_hdf5_are_unpacked() {
    let mut file = made("packed.h5");
    assert_eq!(
        channel(&file, "acc").rate.as_ref().map(|r| (r.hz, &r.source)),
        Some((4000.0, &RateSource::Header("sample_rate".into())))
    );
    assert_eq!(channel(&file, "acc").unit.as_deref(), Some("g"));
    let signal: Vec<f64> = (0..300).map(|i| f64::from(i * 37 % 101 - 50)).collect();
    let acc: Vec<f64> = signal.iter().map(|v| 0.25 * v + 1.5).collect();
    assert_eq!(file.read("acc").unwrap(), acc);
    let missing = file.read("chunked").unwrap();
    assert!(missing[7].is_nan() && missing.iter().filter(|v| v.is_nan()).count() == 1);
    assert_eq!(missing[8], 0.25 * signal[8]);
    let said = file.read("gained").unwrap_err().to_string();
    assert!(said.contains("an attribute `gain`"), "{said}");
    // Without a unit the user says what the numbers are.
    assert_eq!(file.read("counts").unwrap(), signal);
}

fn made(name: &str) -> SignalFile {
    open(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name))
        .unwrap_or_else(|e| panic!("{e}"))
}

/// A struct with a vector of times for each raster, and channels that have names and units beside their values.
#[test]
fn xval_channels_of_a_struct_have_units_and_times_of_their_own() {
    let mut file = made("raster.mat");
    for (label, unit, hz) in [("vibration_1", "m/s^2", 4000.0), ("speed", "rpm", 250.0)] {
        let (_, channel) = file.named(label).unwrap();
        assert_eq!(channel.unit.as_deref(), Some(unit));
        let times = file.times_of(&channel).unwrap().unwrap();
        assert_eq!(file.rate_of(&times.name, times.seconds_in_unit().unwrap()).unwrap(), Ok(hz), "{label}");
    }
}

/// Without `Unit` the index of the struct is no unit.
#[test]
fn regress_an_index_is_no_unit_of_times() {
    let file = made("paderborn.mat");
    let times = channel(&file, "N09_M07_F10_K001_1.X[2].Data");
    assert_eq!((times.time_unit(), times.is_time()), (None, false));
}

#[test]
fn xval_an_increment_of_times_is_a_rate() {
    let file = made("testlab.mat");
    let values = channel(&file, "Signal_0.y_values.values");
    let source = RateSource::Variable("Signal_0.x_values.increment".into());
    assert_eq!(values.rate.as_ref().map(|r| (r.hz, &r.source)), Some((51_200.0, &source)));
    assert_eq!(values.unit.as_deref(), Some("g"));
}

/// Made by nptdms: two segments, waveform properties, a linear scaling, one that is not read, texts, and values in turns.
#[test]
fn xval_tdms_with_its_scalings_and_segments() {
    let signal = |k: i64| (0..300).map(|i| ((i * (37 + k) + 11 * k) % 101 - 50) as f64 / 8.0).collect::<Vec<f64>>();
    let mut file = made("segments.tdms");
    let acc = channel(&file, "it's a rig/acc");
    let source = RateSource::Header("wf_increment".into());
    assert_eq!(acc.rate.as_ref().map(|r| (r.hz, &r.source)), Some((25_600.0, &source)));
    assert_eq!((acc.unit.as_deref(), acc.length), (Some("g"), Some(300)));
    assert_eq!(file.metadata().get("title"), Some("made up"));
    assert_eq!(file.read("it's a rig/acc").unwrap(), signal(0));
    let volts: Vec<f64> = signal(1).iter().map(|v| 0.125 * (8.0 * v) + 1.5).collect();
    assert_eq!(file.read("it's a rig/counts").unwrap(), volts);
    let said = file.read("it's a rig/bent").unwrap_err().to_string();
    assert!(said.contains("is scaled by `Polynomial`, of which only `Linear` is read"), "{said}");
    assert!(!channel(&file, "it's a rig/remarks").may_be_signal());
    let mut file = made("interleaved.tdms");
    assert_eq!(file.read("rig/a").unwrap(), signal(1).iter().map(|v| 8.0 * v).collect::<Vec<_>>());
    assert_eq!(file.read("rig/b").unwrap(), signal(2));
}

/// A file that was cut, and one whose segments claim more than there is.
#[test]
fn prop_damaged_tdms_files_are_refused() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/segments.tdms");
    let bytes = std::fs::read(path).unwrap();
    assert!(refusal("a.tdms", &bytes[..bytes.len() - 10]).contains("damaged TDMS file: the segment at byte"));
    assert!(refusal("a.tdms", &bytes[..100]).contains("damaged TDMS file"));
    let mut other = bytes.clone();
    other[28] = 0xff;
    assert!(refusal("a.tdms", other).contains("damaged TDMS file"));
}
