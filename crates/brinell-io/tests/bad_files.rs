//! Files that are cut, mislabelled, empty, or claim what they do not have: each gets its own words, and none gets
//! memory.

use std::io::Write;
use std::path::{Path, PathBuf};

use brinell_io::{IoError, open};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

struct Here(tempfile::TempDir);

impl Here {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    /// What opening and reading every channel says, without the folder.
    fn says(&self, name: &str, bytes: impl AsRef<[u8]>) -> String {
        let path = self.file(name, bytes);
        let result = open(&path).and_then(|mut file| {
            let names: Vec<String> = file.channels().iter().map(|c| c.name.clone()).collect();
            names.iter().try_for_each(|n| file.read(n).map(drop))
        });
        let folder = format!("{}/", self.0.path().display());
        result.unwrap_err().to_string().replace(&folder, "")
    }
}

#[test]
fn regress_mislabelled_files_name_both() {
    let here = Here::new();
    let bytes = |name| std::fs::read(data(name)).unwrap();
    assert_eq!(
        here.says("a.mat", bytes("f8.npy")),
        "a.mat: named like MATLAB, but the content is NumPy npy; rename it or save it again"
    );
    assert_eq!(
        here.says("a.csv", bytes("cwru_v5.mat")),
        "a.csv: named like text, but the content is MATLAB v5/v7; rename it or save it again"
    );
    assert_eq!(
        here.says("a.wav", "1,2\n3,4\n"),
        "a.wav: named like WAV, but the content is text; rename it or save it again"
    );
    assert_eq!(
        here.says("a.mat", bytes("v4.mat")),
        "a.mat: named like MATLAB, but the content is no known format (perhaps MATLAB v4; save it again as v7); rename it or save it again"
    );
    assert_eq!(
        here.says("a.dat", b"\x1f\x8b\x08\0\0\0\0"),
        "a.dat: cannot read: a gzip archive; known are csv and other text, parquet, mat, hdf5, npy, npz, wav, uff and tdms"
    );
    assert_eq!(here.says("a.csv", ""), "a.csv: the file is empty");
    assert!(matches!(open(here.0.path()), Err(IoError::NotAFileName { .. })));
    assert!(matches!(open("nowhere.csv"), Err(IoError::Read { .. })));
}

/// A file without an ending of that kind is known by its content.
#[test]
fn regress_content_decides_where_the_name_is_silent() {
    let here = Here::new();
    for name in ["cwru_v7.mat", "f8.npy", "ascii.uff", "f32.wav", "xjtu.csv"] {
        let path = here.file("signal.bin", std::fs::read(data(name)).unwrap());
        assert_eq!(open(&path).unwrap().kind(), open(data(name)).unwrap().kind());
    }
}

#[test]
fn regress_claims_without_bytes_are_refused() {
    let here = Here::new();
    let mut npy = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    npy.extend(format!("{:<117}\n", "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000,), }").bytes());
    npy.extend([0; 64]);
    assert_eq!(
        here.says("a.npy", npy),
        "a.npy: damaged NumPy npy file: the header promises 8000000000000 bytes of values and 64 are there"
    );
    let mut wav = std::fs::read(data("f64.wav")).unwrap();
    let at = wav.windows(4).position(|w| w == b"data").unwrap();
    wav[at + 4..at + 8].copy_from_slice(&0xf000_0000u32.to_le_bytes());
    assert!(here.says("a.wav", wav).contains("promises 4026531840 bytes"));
    let mut mat = std::fs::read(data("cwru_v5.mat")).unwrap();
    mat[132..136].copy_from_slice(&0x7fff_ffffu32.to_le_bytes());
    assert!(here.says("a.mat", mat).contains("claims 2147483647 bytes"));
    let uff = std::fs::read_to_string(data("ascii.uff")).unwrap();
    let uff = uff.replacen("       300", "2000000000", 1);
    assert!(here.says("a.uff", uff).contains("claims 2000000000 values"));
}

/// A variable of zeros that inflates a thousandfold, and one that claims to inflate further.
#[test]
fn regress_compressed_bombs_cost_no_memory() {
    use flate2::{Compression, write::ZlibEncoder};
    let here = Here::new();
    let bomb = |claimed: u32, zeros: usize| {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        let values = claimed - 56;
        let words = [14, claimed, 6, 8, 6, 0, 5, 8, values / 8, 1, 1, 1, u32::from(b'x'), 0, 9, values];
        for word in words {
            encoder.write_all(&word.to_le_bytes()).unwrap();
        }
        encoder.write_all(&vec![0; zeros]).unwrap();
        let packed = encoder.finish().unwrap();
        let mut mat = std::fs::read(data("cwru_v7.mat")).unwrap()[..128].to_vec();
        mat.extend(15u32.to_le_bytes());
        mat.extend((packed.len() as u32).to_le_bytes());
        mat.extend(packed);
        mat
    };
    let said = here.says("a.mat", bomb(56 + (1 << 30), 1 << 16));
    assert!(said.contains("more than its"), "{said}");
    // An honest one can be read piece by piece.
    let path = here.file("b.mat", bomb(56 + (32 << 20), 32 << 20));
    let mut count = 0;
    let sum = |v: &[f64]| {
        count += v.len();
        std::ops::ControlFlow::Continue(())
    };
    open(path).unwrap().read_pieces("x", sum).unwrap();
    assert_eq!(count, 4 << 20);
}

/// Every file, cut at many places: an error or fewer channels, and no panic.
#[test]
fn prop_cut_files_are_errors() {
    let here = Here::new();
    for entry in std::fs::read_dir(data("")).unwrap() {
        let path = entry.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        for i in 0..40 {
            let cut = here.file(name, &bytes[..bytes.len() * i / 40]);
            let Ok(mut file) = open(&cut) else { continue };
            let names: Vec<String> = file.channels().iter().map(|c| c.name.clone()).collect();
            for name in names {
                let _ = file.read(&name);
            }
        }
    }
}

#[test]
fn regress_bad_text_gets_the_line() {
    let here = Here::new();
    assert_eq!(
        here.says("a.csv", "t,x\n0,1\n1,2\n2\n"),
        "a.csv: line 4 has 1 values where the first line of numbers has 2"
    );
    assert_eq!(here.says("a.csv", "t,x\n0,1\n1,2\n2,two\n"), "a.csv: line 4, column `x`: `two` is not a number");
    assert_eq!(
        here.says("a.txt", "nothing\nbut words\n"),
        "a.txt: damaged text file: no line of numbers among its first lines"
    );
    // As Format::Csv writes a table without rows.
    assert_eq!(
        here.says("a.csv", "t,x\n"),
        "a.csv: cannot read: its only line is no numbers: a table without rows holds no signal"
    );
    assert_eq!(
        here.says("a.txt", "0,5\n1,25\n"),
        "a.txt: cannot read: `0,5` may be two whole numbers or one with a decimal comma; write a decimal point, or name the columns in a line above"
    );
    assert_eq!(
        here.says("a.csv", "when;x\n10:15;1\n10:16;2\n"),
        "a.csv: cannot read: `when` holds words such as `10:15`"
    );
}

#[test]
fn regress_odd_and_sound_text() {
    let here = Here::new();
    let read = |text: &str, name: &str| {
        let path = here.file("a.csv", text);
        let mut file = open(path).unwrap_or_else(|e| panic!("{e}"));
        let names: Vec<String> = file.channels().iter().map(|c| c.name.clone()).collect();
        let values = file.read(name).unwrap_or_else(|e| panic!("{e} {names:?}"));
        (names.join("|"), values)
    };
    let (names, values) = read("\u{feff}\"a, b\",x\r\n1,\r\n,2\r\n", "a, b");
    assert_eq!(names, "a, b|x");
    assert!(values[0] == 1.0 && values[1].is_nan());
    // Trailing delimiters make no column; a constant and a NaN are values like others.
    let (names, values) = read("a;b;\n1;nan;\n1;NaN;\n", "a");
    assert_eq!((names.as_str(), values.as_slice()), ("a|b", &[1.0, 1.0][..]));
    assert_eq!(read("x\n0,5\n1,5\n", "x").1, [0.5, 1.5]);
    assert_eq!(read("a,a\n1,2\n3,4\n", "a#2").1, [2.0, 4.0]);
    // A number that the file itself gives a column is not given again.
    assert_eq!(read("a#2,a,a,a\n1,2,3,4\n5,6,7,8\n", "a#3"), ("a#2|a|a#3|a#4".to_owned(), vec![3.0, 7.0]));
    assert_eq!(read("7", "column1").1, [7.0]);
    assert_eq!(read("0,1  0,2\n-1,5e-3 +2\n", "column2").1, [0.2, 2.0]);
    assert_eq!(read("% c\n1\t2\n# c\n3\t4", "column2").1, [2.0, 4.0]);
    assert_eq!(read("Rig;7\nDate;today\nx;y\n1;2\n3;4\n", "y").1, [2.0, 4.0]);
}

/// A column of decimal commas says what a point in another one is: never a decimal point.
#[test]
fn regress_points_beside_decimal_commas_are_thousands_or_refused() {
    let here = Here::new();
    let read = |name: &str, text: &str| open(here.file(name, text)).unwrap().read("acc [mg]").unwrap();
    // As written by a German Excel: mg, thousands with a point.
    let head = "Zeit [s];acc [mg]\n0,00000000;9\n0,00008333;424\n";
    let values = read("de.csv", &format!("{head}0,00016667;-1.332\n0,00025000;1.024.768\n"));
    assert_eq!(values, [9.0, 424.0, -1332.0, 1_024_768.0]);
    // Where the first lines show no point.
    let whole: String = (0..300).map(|i| format!("0,{i:05};{}\n", i % 900)).collect();
    let values = read("late.csv", &format!("Zeit [s];acc [mg]\n{whole}0,00300;-1.332\n"));
    assert_eq!(values.last(), Some(&-1332.0));
    assert_eq!(
        here.says("mixed.csv", format!("{head}0,00016667;0.853\n")),
        "mixed.csv: line 4, column `acc [mg]`: `0.853` has a decimal point, and the file has decimal commas; write one of them throughout"
    );
    // 2.499 V or 2499: nothing in the column says.
    assert!(
        here.says("open.csv", "t [s];acc [V]\n0,003250;2.499\n0,003333;2.501\n")
            .contains("`2.499` beside decimal commas may be a fraction or have a point between thousands")
    );
    // Thousands of the other kind are no decimal commas.
    let mut file = open(here.file("en.csv", "t [s];acc [mg]\n0.001;9\n0.002;1,332\n")).unwrap();
    assert_eq!(file.read("t [s]").unwrap(), [0.001, 0.002]);
    assert!(file.read("acc [mg]").unwrap_err().to_string().contains("`1,332` is not a number"));
}

/// As a spreadsheet of a country with decimal commas writes them between commas (RFC 4180).
#[test]
fn regress_decimal_commas_in_quotes_between_commas() {
    let here = Here::new();
    let read = |name: &str, text: &str| open(here.file(name, text)).unwrap().read("a, [g]").unwrap();
    let head = "\"t [s]\",\"a, [g]\"\n\"0,0001\",\"-1,25\"\n";
    assert_eq!(read("quoted.csv", &format!("{head}\"0,0002\",3\n\"0,0003\",\"1.332,5\"\n")), [-1.25, 3.0, 1332.5]);
    let mut one = open(here.file("one.csv", "\"a\"\n\"0,5\"\n\"-1,25\"\n")).unwrap();
    assert_eq!(one.read("a").unwrap(), [0.5, -1.25]);
    // Text in quotes that looks like such a number, beside numbers with a point, and signs of inches.
    let mut file = open(here.file("point.csv", "t,note,a\n0.5,\"1,5\",0.25\n0.75,\"1,6\",0.5\n")).unwrap();
    assert_eq!(file.read("a").unwrap(), [0.25, 0.5]);
    assert!(file.read("note").unwrap_err().to_string().contains("holds words such as `1,5`"));
    let mut file = open(here.file("inch.csv", "t,d1,d2,a\n0.0,2\",3\",0.5\n0.1,2\",3\",0.75\n")).unwrap();
    assert_eq!(file.read("a").unwrap(), [0.5, 0.75]);
    // Thousands of the other kind are no decimal commas.
    let mut file = open(here.file("en.csv", "t,\"a, [g]\"\n0.001,\"1,332\"\n0.002,\"2,500\"\n")).unwrap();
    assert_eq!(file.read("t").unwrap(), [0.001, 0.002]);
    assert!(file.read("a, [g]").unwrap_err().to_string().contains("holds words such as `1,332`"));
}

/// One bit of one value is another: what the format keeps a checksum of is refused.
#[cfg(all(feature = "hdf5", feature = "npz"))]
#[test]
fn regress_checksums_are_held_against_the_values() {
    let here = Here::new();
    for (name, value, says) in [
        ("plain.npz", -6.25f64, "a.npz: damaged NumPy npz file: the checksum of an array does not match its bytes"),
        (
            "groups.h5",
            -6.25,
            "a.h5: damaged HDF5 (MATLAB v7.3) file: a chunk's checksum does not match, at its value 0",
        ),
    ] {
        let mut bytes = std::fs::read(data(name)).unwrap();
        let value = value.to_le_bytes();
        let at = bytes.windows(8).position(|b| b == value).unwrap();
        bytes[at + 6] ^= 1;
        let extension = name.rsplit('.').next().unwrap();
        assert_eq!(here.says(&format!("a.{extension}"), bytes), says);
    }
}

#[test]
fn regress_a_wav_that_says_two_things_is_refused() {
    let here = Here::new();
    let chunk = |name: &[u8], bytes: &[u8]| [name, &(bytes.len() as u32).to_le_bytes(), bytes].concat();
    let says = |chunks: &[Vec<u8>]| {
        let body = [b"WAVE".to_vec(), chunks.concat()].concat();
        here.says("a.wav", chunk(b"RIFF", &body)).replace("a.wav: ", "")
    };
    let plain: Vec<u8> = [1u16, 2, 12_000, 0, 48_000, 0, 4, 16].iter().flat_map(|v| v.to_le_bytes()).collect();
    let (format, data) = (chunk(b"fmt ", &plain), chunk(b"data", &[0; 400]));
    let twice = says(&[format.clone(), data.clone(), data.clone()]);
    assert_eq!(twice, "cannot read: it has several `data` chunks; one is expected");
    let twice = says(&[format.clone(), data.clone(), format.clone()]);
    assert_eq!(twice, "cannot read: it has several `fmt ` chunks; one is expected");
    let cut = says(&[format, chunk(b"data", &[0; 402])]);
    assert_eq!(
        cut,
        "damaged WAV file: its 402 bytes of samples end within a frame of 4 bytes: bytes are missing or the header is another file's; write it again with whole frames"
    );
    let foreign = [&[0xfe, 0xff], &plain[2..], &[22, 0, 16, 0, 0, 0, 0, 0, 1, 0], &[0xff; 14]].concat();
    let foreign = says(&[chunk(b"fmt ", &foreign), data]);
    assert_eq!(foreign, "cannot read: extensible WAV of a kind of its own; PCM and floats are read");
}
