//! Files of other programs, read. `validation/readers/make_files.py` made them with SciPy, h5py, hdf5storage, NumPy,
//! pyarrow and pyuff.

use std::path::PathBuf;

use brinell_io::{Channel, FileKind, RateSource, SignalFile, open};

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn opened(name: &str) -> SignalFile {
    open(data(name)).unwrap_or_else(|e| panic!("{e}"))
}

/// Channel k, as `signal` in make_files.py.
fn signal(k: i64) -> Vec<f64> {
    (0..300).map(|i| ((i * (37 + k) + 11 * k) % 101 - 50) as f64 / 8.0).collect()
}

fn eighths(k: i64) -> Vec<f64> {
    signal(k).into_iter().map(|v| 8.0 * v).collect()
}

fn names(file: &SignalFile) -> Vec<&str> {
    file.channels().iter().map(|c| c.name.as_str()).collect()
}

fn channel<'a>(file: &'a SignalFile, name: &str) -> &'a Channel {
    let found = file.channels().iter().find(|c| c.name == name);
    found.unwrap_or_else(|| panic!("no {name} in {:?}", names(file)))
}

fn rate(channel: &Channel) -> Option<(f64, &RateSource)> {
    channel.rate.as_ref().map(|r| (r.hz, &r.source))
}

#[track_caller]
fn holds(file: &mut SignalFile, name: &str, values: &[f64]) {
    let got = file.read(name).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(got, values, "{name}");
}

#[test]
fn xval_mat_like_cwru() {
    for name in ["cwru_v5.mat", "cwru_v7.mat"] {
        let mut file = opened(name);
        assert_eq!(file.kind(), FileKind::Mat5);
        assert_eq!(names(&file), ["X097_DE_time", "X097_FE_time", "X097RPM"]);
        let first = channel(&file, "X097_DE_time");
        assert_eq!((first.shape.as_slice(), first.length), (&[300, 1][..], Some(300)));
        assert_eq!((first.rate.as_ref(), first.unit.as_ref()), (None, None));
        holds(&mut file, "X097_DE_time", &signal(0));
        holds(&mut file, "X097_FE_time", &signal(1));
        holds(&mut file, "X097_FE_time(:,1)", &signal(1));
        holds(&mut file, "X097RPM", &[1796.0]);
        let error = file.only_signal().unwrap_err().to_string();
        assert!(
            error.ends_with("several channels may be the signal; name one of X097_DE_time, X097_FE_time"),
            "{error}"
        );
    }
}

#[test]
fn xval_mat_like_mfpt_and_paderborn() {
    let mut file = opened("mfpt.mat");
    assert_eq!(names(&file), ["bearing.sr", "bearing.gs", "bearing.load", "bearing.rate"]);
    assert_eq!(rate(file.only_signal().unwrap()), Some((97656.0, &RateSource::Variable("bearing.sr".into()))));
    holds(&mut file, "bearing.gs", &signal(2));
    holds(&mut file, "bearing.rate", &[25.0]);

    for name in ["paderborn.mat", "paderborn_v6.mat"] {
        let mut file = opened(name);
        let top = "N09_M07_F10_K001_1";
        holds(&mut file, &format!("{top}.X[2].Data"), &signal(4));
        holds(&mut file, &format!("{top}.Y[2].Data"), &signal(6));
        let text = |key: &str| file.metadata().get(&format!("{top}.{key}"));
        assert_eq!(text("Y[2].Name"), Some("vibration_1"));
        // The name inside serves as well.
        let label = channel(&file, &format!("{top}.Y[2].Data")).label.as_deref();
        assert_eq!(label, Some("vibration_1"));
        assert_eq!(text("Info.Application"), Some("made up"));
        holds(&mut file, "vibration_1", &signal(6));
    }
}

#[test]
fn xval_mat_numbers_of_every_kind() {
    let mut file = opened("kinds.mat");
    for name in ["i8", "i16", "i32", "i64"] {
        holds(&mut file, name, &eighths(0));
    }
    let shifted: Vec<f64> = eighths(0).iter().map(|v| v + 64.0).collect();
    for name in ["u8", "u16", "u32", "u64"] {
        holds(&mut file, name, &shifted);
    }
    holds(&mut file, "single", &signal(0));
    let logical: Vec<f64> = signal(0).iter().map(|&v| f64::from(v > 0.0)).collect();
    holds(&mut file, "logical", &logical);
    holds(&mut file, "matrix(:,2)", &signal(2));
    holds(&mut file, "matrix(3,:)", &[1, 2, 3].map(|k| signal(k)[2]));
    holds(&mut file, "cell[1]", &signal(7));
    holds(&mut file, "empty", &[]);
    assert_eq!(file.metadata().get("title"), Some("Prüfstand"));
    assert_eq!(file.metadata().get("cell[2]"), Some("a word"));
    assert_eq!(rate(channel(&file, "single")), Some((25600.0, &RateSource::Variable("fs".into()))));
    for (name, why) in [
        ("complex", "`complex` holds complex numbers"),
        ("sparse", "`sparse` is a sparse matrix"),
        ("matrix", "choose a column such as `matrix(:,1)`"),
        ("nothing", "there is no `nothing`; there are i8, u8,"),
    ] {
        let error = file.read(name).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
}

#[cfg(feature = "hdf5")]
#[test]
fn xval_mat_v73() {
    let mut file = opened("v73.mat");
    assert_eq!(file.kind(), FileKind::Hdf5);
    assert_eq!(channel(&file, "acc").shape, [300, 1]);
    assert_eq!(rate(channel(&file, "acc")), Some((25600.0, &RateSource::Variable("fs".into()))));
    holds(&mut file, "acc", &signal(0));
    holds(&mut file, "row", &signal(1));
    holds(&mut file, "counts", &eighths(2));
    assert_eq!(channel(&file, "matrix").shape, [300, 2]);
    holds(&mut file, "matrix(:,1)", &signal(3));
    holds(&mut file, "matrix(:,2)", &signal(4));
    holds(&mut file, "matrix(7,:)", &[3, 4].map(|k| signal(k)[6]));
    holds(&mut file, "bearing.gs", &signal(5));
    assert_eq!(rate(channel(&file, "bearing.gs")), Some((97656.0, &RateSource::Variable("bearing.sr".into()))));
    holds(&mut file, "Y[1].Data", &signal(6));
    holds(&mut file, "Y[2].Data", &signal(7));
    holds(&mut file, "cell", &signal(6));
    assert_eq!(file.metadata().get("Y[2].Name"), Some("vibration_1"));
    assert_eq!(file.metadata().get("title"), Some("Prüfstand"));
    assert!(file.read("none").is_err());
    let mut file = opened("v73_hdf5storage.mat");
    holds(&mut file, "acc", &signal(0));
    holds(&mut file, "fs", &[25600.0]);
}

#[cfg(feature = "hdf5")]
#[test]
fn xval_hdf5_of_h5py() {
    let mut file = opened("latest.h5");
    let acc = channel(&file, "run/acc");
    assert_eq!(acc.unit.as_deref(), Some("m/s^2"));
    assert_eq!(rate(acc), Some((51200.0, &RateSource::Variable("run/fs".into()))));
    holds(&mut file, "run/acc", &signal(0));
    holds(&mut file, "run/big", &signal(1));
    holds(&mut file, "run/growing", &signal(2));
    holds(&mut file, "run/matrix(:,2)", &signal(4));
    let error = file.read("run/half").unwrap_err().to_string();
    assert!(error.contains("values from 10 on were never written"), "{error}");
}

#[cfg(feature = "hdf5")]
#[test]
fn xval_hdf5_of_h5py_in_groups() {
    let mut file = opened("groups.h5");
    // Soft links add nothing, and links in circles once what lies outside the circle.
    assert_eq!(names(&file)[..5], ["fast/acc", "fast/time", "slow/acc", "slow/half", "slow/time"]);
    assert_eq!(names(&file)[5..], ["slow/top/fast/acc", "slow/top/fast/time"]);
    holds(&mut file, "fast/acc", &signal(0));
    holds(&mut file, "slow/half", &signal(4));
    for group in ["fast", "slow"] {
        let acc = channel(&file, &format!("{group}/acc")).clone();
        assert_eq!(file.times_of(&acc).unwrap().unwrap().name, format!("{group}/time"));
    }
}

#[test]
fn xval_numpy_arrays() {
    for (name, values) in [("f8.npy", signal(0)), ("i2_big.npy", eighths(3)), ("f2.npy", signal(4))] {
        let mut file = opened(name);
        assert_eq!(file.kind(), FileKind::Npy);
        holds(&mut file, "array", &values);
    }
    let mut file = opened("f4_matrix.npy");
    holds(&mut file, "array(:,1)", &signal(1));
    holds(&mut file, "array(:,2)", &signal(2));
}

#[cfg(feature = "npz")]
#[test]
fn xval_numpy_archives() {
    let mut file = opened("plain.npz");
    assert_eq!(names(&file), ["acc", "pair", "fs"]);
    assert_eq!(rate(channel(&file, "acc")), Some((25600.0, &RateSource::Variable("fs".into()))));
    assert_eq!(file.metadata().get("title"), Some("Prüfstand"));
    holds(&mut file, "acc", &signal(0));
    holds(&mut file, "pair(:,2)", &signal(2));
    let mut file = opened("packed.npz");
    holds(&mut file, "acc", &signal(0));
    holds(&mut file, "number", &[3.0]);
    assert!(file.read("z").unwrap_err().to_string().contains("not real numbers"));
}

#[test]
fn xval_wav_of_every_width() {
    for (name, hz, k) in [
        ("u8.wav", 12000.0, 8.0),
        ("i16.wav", 12000.0, 8.0),
        ("i24.wav", 12000.0, 8.0),
        ("i32.wav", 12000.0, 8.0),
        ("extensible.wav", 12000.0, 8.0),
        ("f32.wav", 48000.0, 1.0),
        ("f64.wav", 48000.0, 1.0),
    ] {
        let mut file = opened(name);
        assert_eq!(names(&file), ["channel1", "channel2"], "{name}");
        let source = RateSource::Header("WAV sample rate".into());
        assert_eq!(rate(&file.channels()[1]), Some((hz, &source)));
        for (channel, at) in [("channel1", 0), ("channel2", 1)] {
            let values: Vec<f64> = signal(at).iter().map(|v| k * v).collect();
            holds(&mut file, channel, &values);
        }
    }
}

#[test]
fn xval_uff_of_pyuff() {
    for name in ["ascii.uff", "binary.uff"] {
        let mut file = opened(name);
        let acc = channel(&file, "acc x");
        assert_eq!(acc.unit.as_deref(), Some("m/s^2"));
        let source = RateSource::Header("UFF 58 abscissa increment".into());
        assert_eq!(rate(acc), Some((25600.0, &source)));
        holds(&mut file, "acc x", &signal(0));
        holds(&mut file, "uneven", &signal(2));
        let x = file.read("uneven.x").unwrap();
        assert!(x.iter().zip(0..).all(|(x, i)| (x - f64::from(i) / 25600.0).abs() < 1e-6));
        assert!(file.read("complex").is_err());
        if name == "ascii.uff" {
            let near = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-4);
            assert!(near(file.read("acc y").unwrap(), signal(1)));
            assert!(near(file.read("single").unwrap(), signal(3)));
        }
    }
}

#[test]
fn xval_text_like_public_data_sets() {
    let mut file = opened("xjtu.csv");
    let both = ["Horizontal_vibration_signals", "Vertical_vibration_signals"];
    assert_eq!(names(&file), both);
    assert_eq!(file.channels()[0].length, None);
    holds(&mut file, both[1], &signal(1));

    let mut file = opened("ims.txt");
    assert_eq!(file.channels().len(), 8);
    for k in 0..8 {
        let values: Vec<f64> = signal(k);
        holds(&mut file, &format!("column{}", k + 1), &values);
    }
    for name in ["femto.csv", "femto_semicolon.csv"] {
        let mut file = opened(name);
        assert_eq!(file.channels().len(), 6);
        holds(&mut file, "column5", &signal(0));
        holds(&mut file, "column6", &signal(1));
    }
}

#[test]
fn xval_text_of_instruments() {
    let mut file = opened("comma.csv");
    let units: Vec<_> = file.channels().iter().map(|c| c.unit.as_deref()).collect();
    assert_eq!(units, [Some("s"), Some("m/s²"), None]);
    holds(&mut file, "Kanal 1 [m/s²]", &signal(0));
    let mut file = opened("units.csv");
    let units: Vec<_> = file.channels().iter().map(|c| c.unit.as_deref()).collect();
    assert_eq!(units, [Some("s"), Some("g"), Some("g")]);
    holds(&mut file, "acc y", &signal(1));
    let mut file = opened("blanks.dat");
    assert_eq!(names(&file), ["x", "y"]);
    holds(&mut file, "y", &signal(1));
    let mut file = opened("labview.lvm");
    assert_eq!(names(&file), ["Acceleration", "Voltage"]);
    let acc = channel(&file, "Acceleration");
    assert_eq!(acc.unit.as_deref(), Some("m/s^2"));
    let source = RateSource::Header("Delta_X".into());
    assert_eq!(rate(acc), Some((25000.0, &source)));
    holds(&mut file, "Voltage", &signal(1));
}

#[cfg(feature = "parquet")]
#[test]
fn xval_parquet_of_pyarrow() {
    for codec in ["gzip", "lz4", "snappy"] {
        let mut file = opened(&format!("{codec}.parquet"));
        assert_eq!(names(&file), ["acc", "count", "single"], "{codec}");
        holds(&mut file, "acc", &signal(0));
        holds(&mut file, "count", &eighths(1));
        holds(&mut file, "single", &signal(2));
    }
    let mut file = opened("brotli.parquet");
    let error = file.read("acc").unwrap_err().to_string();
    assert!(
        error.ends_with(
            "cannot read: `acc` is compressed with Brotli, which is not supported here: save the file with zstd, snappy, lz4 or gzip"
        ),
        "{error}"
    );
}

#[cfg(feature = "parquet")]
#[test]
fn xval_parquet_with_half_precision_and_decimals() {
    let mut file = opened("numbers.parquet");
    holds(&mut file, "half", &signal(0));
    holds(&mut file, "decimal", &signal(1));
    holds(&mut file, "wide", &signal(1));
    let whole: Vec<f64> = eighths(2).iter().map(|v| v.abs() + 4e9).collect();
    holds(&mut file, "whole", &whole);
    let error = file.read("day").unwrap_err().to_string();
    let why = "`day` is of the type BOOLEAN, which is not supported here: save it as double";
    assert!(error.ends_with(why), "{error}");
    holds(&mut opened("integers.parquet"), "decimal", &signal(1));
}

#[cfg(feature = "parquet")]
#[test]
fn xval_parquet_with_nested_columns() {
    let mut file = opened("nested.parquet");
    assert_eq!(names(&file), ["label", "load", "acc", "bearing.bore", "bearing.name"]);
    holds(&mut file, "load", &[100.0, 200.0]);
    for (name, why) in [
        ("acc", "is nested, a list in each row, which is not supported here: save one row as a table"),
        ("bearing.bore", "is nested, which is not supported here: save it as a flat column"),
        ("label", "does not hold numbers"),
    ] {
        let error = file.read(name).unwrap_err();
        assert!(matches!(error, brinell_io::IoError::Unsupported { .. }));
        assert!(error.to_string().contains(why), "{error}");
    }
}
