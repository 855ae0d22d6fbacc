//! Surface files made for the tests: heights in um of `columns` x `rows` points, `step` um apart, NaN where missing.

use std::io::{Cursor, Write as _};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// A height in um at (column, row).
pub type Height<'a> = &'a dyn Fn(usize, usize) -> f64;

fn all(columns: usize, rows: usize, um: Height<'_>) -> Vec<f64> {
    (0..columns * rows).map(|i| um(i % columns, i / columns)).collect()
}

/// ISO 25178-71 in text.
pub fn sdf_text(columns: usize, rows: usize, step: f64, um: Height<'_>) -> Vec<u8> {
    let word = |v: &f64| {
        if v.is_nan() { "BAD".to_owned() } else { v.to_string() }
    };
    let words: Vec<String> = all(columns, rows, um).iter().map(word).collect();
    format!(
        "aISO-1.0\nManufacID = none\nCreateDate = 010120260000\nModDate = 010120260000\nNumPoints = {columns}\nNumProfiles = {rows}\n\
         Xscale = {x:e}\nYscale = {x:e}\nZscale = 1e-6\nZresolution = -1\nCompression = 0\nDataType = 7\nCheckType = 0\n*\n{}\n*\n",
        words.join(" "),
        x = 1e-6 * step
    )
    .into_bytes()
}

/// ISO 25178-71 in whole numbers of 1 nm.
pub fn sdf_binary(columns: usize, rows: usize, step: f64, um: Height<'_>) -> Vec<u8> {
    let mut bytes = b"bISO-1.0none      010120260000010120260000".to_vec();
    bytes.extend((columns as u16).to_le_bytes());
    bytes.extend((rows as u16).to_le_bytes());
    for scale in [1e-6 * step, 1e-6 * step, 1e-9, -1.0] {
        bytes.extend(f64::to_le_bytes(scale));
    }
    bytes.extend([0, 6, 0]);
    for v in all(columns, rows, um) {
        let count = if v.is_nan() { i32::MIN } else { (1e3 * v).round() as i32 };
        bytes.extend(count.to_le_bytes());
    }
    bytes
}

/// MountainsMap's, in whole numbers of 1 nm; plain or packed.
pub fn sur(columns: usize, rows: usize, step: f64, um: Height<'_>, packed: bool) -> Vec<u8> {
    const LEAST: i32 = -1_000_000;
    let mut head = vec![0_u8; 512];
    let mut put = |at: usize, bytes: &[u8]| head[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, if packed { b"DSCOMPRESSED" } else { b"DIGITAL SURF" });
    put(14, &1_i16.to_le_bytes());
    put(18, &2_i16.to_le_bytes());
    put(86, &1_i16.to_le_bytes());
    put(98, &32_i16.to_le_bytes());
    put(100, &LEAST.to_le_bytes());
    put(108, &(columns as i32).to_le_bytes());
    put(112, &(rows as i32).to_le_bytes());
    put(120, &(step as f32).to_le_bytes());
    put(124, &(step as f32).to_le_bytes());
    put(128, &1_f32.to_le_bytes());
    put(180, b"\xb5m              ");
    put(196, b"\xb5m              ");
    put(212, b"nm              ");
    let numbers = all(columns, rows, um).into_iter();
    let data: Vec<u8> =
        numbers.flat_map(|v| if v.is_nan() { LEAST - 2 } else { (1e3 * v).round() as i32 }.to_le_bytes()).collect();
    if packed {
        let stream = miniz_oxide::deflate::compress_to_vec_zlib(&data, 6);
        for number in [1, data.len() as u32, stream.len() as u32] {
            head.extend(number.to_le_bytes());
        }
        head.extend(stream);
    } else {
        head.extend(data);
    }
    head
}

/// ISO 5436-2 with the heights in a file of their own, in 64-bit floats of m.
pub fn x3p(columns: usize, rows: usize, step: f64, um: Height<'_>, packed: bool) -> Vec<u8> {
    let axis = |name: &str, kind: &str, more: &str| format!("<{name}><AxisType>{kind}</AxisType>{more}</{name}>");
    let increment = format!("<DataType>D</DataType><Increment>{:e}</Increment><Offset>0</Offset>", 1e-6 * step);
    let main = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\"><Record1>\
         <Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>{}{}{}</Axes></Record1><Record3><MatrixDimension>\
         <SizeX>{columns}</SizeX><SizeY>{rows}</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink>\
         <PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>",
        axis("CX", "I", &increment),
        axis("CY", "I", &increment),
        axis("CZ", "A", "<DataType>D</DataType>"),
    );
    let data: Vec<u8> = all(columns, rows, um).iter().flat_map(|v| (1e-6 * v).to_le_bytes()).collect();
    zip(&[("main.xml", main.as_bytes()), ("bindata/data.bin", &data)], packed)
}

/// An archive; its checksums are left out.
pub fn zip(files: &[(&str, &[u8])], packed: bool) -> Vec<u8> {
    let method = if packed { CompressionMethod::Deflated } else { CompressionMethod::Stored };
    let options = SimpleFileOptions::default().compression_method(method);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        archive.start_file(*name, options).unwrap();
        archive.write_all(content).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// A point cloud, in columns.
pub fn cloud(columns: usize, rows: usize, step: f64, um: Height<'_>, names: &str) -> Vec<u8> {
    let mut text = names.to_owned();
    for (i, v) in all(columns, rows, um).iter().enumerate() {
        // Rows come from the top, y points up.
        let (x, y) = ((i % columns) as f64, (rows - 1 - i / columns) as f64);
        if !v.is_nan() {
            text += &format!("{:.5},{:.5},{v}\n", 1e-3 * step * x, 1e-3 * step * y);
        }
    }
    text.into_bytes()
}
