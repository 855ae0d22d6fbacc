//! Mutated files against all readers: no bytes and no options may make one panic or hang. A program of its own: an
//! abort ends no other test.
//!
//! A few seconds in the suite; `BRINELL_FUZZ_SECONDS=600` for longer, `BRINELL_FUZZ_SEED` for other mutations. A file
//! that makes a reader panic is kept in `tests/corpus/` and replayed from then on. `BRINELL_FUZZ_WRITE=1` writes the
//! made seeds there.

mod common;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use brinell::scenario::{
    FirstRow, ImageEdges, ImageFile, ImagePieces, RollingDirection, ScanFile, ScanFill, ScanForm, ScanUnit, ScanZero,
    SvgFile,
};
use brinell_damage::*;
use common::photos::photo;
use common::surfaces::{cloud, sdf_binary, sdf_text, sur, x3p};
use common::{Noise, grey_bytes, grey_png, npy, npy_f8, png};
use png::{BitDepth, ColorType};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus")
}

fn made_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let spot = |x: usize, y: usize| {
        if (x as f64 - 10.0).hypot(y as f64 - 9.0) < 6.0 { 0.2 } else { 0.8 }
    };
    let rgba: Vec<u8> = (0..400).flat_map(|i| [9, 9, 9, if i % 7 < 3 { 255 } else { 0 }]).collect();
    let wide: Vec<u8> = (0..400_u16).flat_map(|i| (30_000 + i * 7 % 900).to_be_bytes()).collect();
    let jpeg = |progressive| {
        let mut bytes = Vec::new();
        let mut encoder = jpeg_encoder::Encoder::new(&mut bytes, 60);
        encoder.set_progressive(progressive);
        encoder.encode(&grey_bytes(20, 20, spot), 20, 20, jpeg_encoder::ColorType::Luma).unwrap();
        bytes
    };
    let head = r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="20mm" height="10mm" viewBox="0 0 20 10">"#;
    let svg = |inside: &str| format!("{head}{inside}</svg>").into_bytes();
    let i2: Vec<u8> = (0..48_i16).flat_map(|i| (i % 9 - 20).to_le_bytes()).collect();
    let f4: Vec<u8> = (0..48).flat_map(|i| (if i % 11 == 3 { f32::NAN } else { i as f32 }).to_be_bytes()).collect();
    let pit = |column: usize, row: usize| match (column, row) {
        (2..=4, 3..=6) => -20.0 + column as f64,
        (6, 1) => f64::NAN,
        _ => 0.1,
    };
    vec![
        (
            "shapes.svg",
            svg(
                r##"<defs><path id="p" d="M1 1h2v2z"/></defs><g transform="rotate(3 1 2) skewX(4)"><use xlink:href="#p" x="1"/><ellipse cx="4" cy="5" rx="2" ry="1"/></g><rect x="1" y="1" width="3" height="2" rx=".5"/>"##,
            ),
        ),
        (
            "curves.svg",
            svg(
                r#"<path id="a" fill-rule="evenodd" d="M1 1C2 2 3 1 4 4S5 5 6 2Q7 7 8 2T9 9A3 2 10 1 0 3 3Zm1 1 2 0 0 2z"/>"#,
            ),
        ),
        (
            "styled.svg",
            svg(
                r#"<style>.a{fill:none;stroke:red} #b,.c{display:none}</style><path class="a" d="M0 0H4V4Z"/><polygon id="b" points="0,0 4,4 4,0 0,4"/>"#,
            ),
        ),
        ("grey.png", grey_png(20, 20, spot)),
        ("alpha.png", png(20, 20, ColorType::Rgba, BitDepth::Eight, &rgba)),
        ("height.png", png(20, 20, ColorType::Grayscale, BitDepth::Sixteen, &wide)),
        ("bits.png", png(16, 4, ColorType::Grayscale, BitDepth::One, &[0x0f, 0xf0, 0x3c, 0x18, 0, 0xff, 7, 9])),
        ("base.jpg", jpeg(false)),
        ("progressive.jpg", jpeg(true)),
        ("plain.csv", b"# um\n0,0.1,0,0\n0,-9,-8.5,0\n0,-9,,0\n0,0,nan,0\n".to_vec()),
        ("decimal.csv", "\u{feff}a;b;c;\r\n0,1;0;1e-3;\r\n0;-22,5;0;\r\n".as_bytes().to_vec()),
        ("blank.txt", b"0 0 0\n0 -5 0\n0 0 0\n".to_vec()),
        ("float.npy", npy_f8(8, 9, |r, c| if r > 2 && c > 3 && r < 6 { -20.0 } else { 0.1 * c as f64 })),
        ("short.npy", npy("<i2", true, [6, 8], &i2)),
        ("big.npy", npy(">f4", false, [8, 6], &f4)),
        ("text.sdf", sdf_text(8, 9, 100.0, &pit)),
        ("binary.sdf", sdf_binary(8, 9, 100.0, &pit)),
        ("plain.sur", sur(8, 9, 100.0, &pit, false)),
        ("packed.sur", sur(8, 9, 100.0, &pit, true)),
        ("stored.x3p", x3p(8, 9, 100.0, &pit, false)),
        ("deflated.x3p", x3p(8, 9, 100.0, &pit, true)),
        ("cloud.xyz", cloud(8, 9, 100.0, &pit, "x_mm,y_mm,z_um\n")),
        ("uneven.jpg", photo(1, 5).bytes),
    ]
}

const WORDS: [&str; 28] = [
    "0",
    "-1",
    "1e308",
    "1e-308",
    "nan",
    "inf",
    "99999999999999999999",
    ",",
    ";",
    "\n",
    "\"",
    "\t",
    "(",
    ")",
    "<g>",
    "</g>",
    "<!--",
    "<path d=\"M0 0L1 1\"/>",
    "A1 1 0 0 1 9 9",
    "Z",
    "e9",
    "%",
    "mm",
    "&lt;",
    "\0",
    "\u{fffd}",
    "'shape': (4294967295, 2)",
    "True",
];

fn mutate(noise: &mut Noise, seed: &[u8], other: &[u8]) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + noise.below(6) {
        let at = noise.below(bytes.len() + 1);
        let end = (at + noise.below(24)).min(bytes.len());
        match noise.below(9) {
            0 | 1 if at < bytes.len() => bytes[at] ^= 1 << noise.below(8),
            2 if at < bytes.len() => bytes[at] = [0, 0xff, 0x7f, 0x80, b'9', b'-', b'e'][noise.below(7)],
            3 => drop(bytes.drain(at..end)),
            4 => {
                let copy = bytes[at..end].to_vec();
                let to = noise.below(bytes.len() + 1);
                drop(bytes.splice(to..to, copy));
            }
            5 | 6 => {
                let word = WORDS[noise.below(WORDS.len())].bytes();
                drop(bytes.splice(at..if noise.below(2) == 0 { at } else { end }, word));
            }
            7 => {
                let from = noise.below(other.len());
                let to = (from + noise.below(60)).min(other.len());
                drop(bytes.splice(at..end, other[from..to].iter().copied()));
            }
            _ if noise.below(6) == 0 => bytes.truncate(at),
            _ => {}
        }
    }
    if noise.below(4) > 0 {
        mend_png(&mut bytes);
    }
    bytes
}

/// Sets a PNG's checksums right, so that mutations get past them.
fn mend_png(bytes: &mut [u8]) {
    if !bytes.starts_with(b"\x89PNG") {
        return;
    }
    let mut at = 8;
    while let Some(head) = bytes.get(at..at + 4) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let end = at + 8 + length.min(1 << 24);
        let Some(body) = bytes.get(at + 4..end) else {
            return;
        };
        let crc = body.iter().fold(!0_u32, |crc, &byte| {
            (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { c >> 1 ^ 0xEDB8_8320 } else { c >> 1 })
        });
        let Some(slot) = bytes.get_mut(end..end + 4) else {
            return;
        };
        slot.copy_from_slice(&(!crc).to_be_bytes());
        at = end + 4;
    }
}

/// A usual number for most files; now and then one that no reader takes.
fn number(noise: &mut Noise, usual: f64) -> f64 {
    match noise.below(40) {
        0 => [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300, 1e-300][noise.below(6)],
        1 => usual * 10.0,
        2 => usual * 1e-4,
        _ => usual,
    }
}

fn read_all(noise: &mut Noise, bytes: &[u8]) -> usize {
    let directions = [RollingDirection::Right, RollingDirection::Up, RollingDirection::Left, RollingDirection::Down];
    let svg = SvgFile {
        path_id: (noise.below(4) == 0).then(|| ["a", "b", "p"][noise.below(3)].to_owned()),
        mm_per_unit: (noise.below(3) == 0).then(|| number(noise, 0.3)),
        tolerance_mm: number(noise, 0.01),
        center: noise.below(2) == 0,
        ..SvgFile::default()
    };
    let image = ImageFile {
        mm_per_pixel: number(noise, 0.1),
        threshold: (noise.below(3) == 0).then(|| number(noise, 0.5)),
        use_alpha: noise.below(4) == 0,
        invert: noise.below(3) == 0,
        rolling_direction: directions[noise.below(4)],
        center: noise.below(2) == 0,
        edges: [ImageEdges::PixelEdges, ImageEdges::SubPixel][noise.below(2)],
        blur_px: Some(number(noise, 1.0)),
        speck_mm2: number(noise, 0.01),
        region_px: (noise.below(4) == 0).then(|| [0.0, number(noise, 2.0), number(noise, 10.0), 9.0]),
        pieces: [None, Some(ImagePieces::Largest), Some(ImagePieces::All)][noise.below(3)],
        at_px: (noise.below(4) == 0).then(|| [number(noise, 9.0), 8.0]),
        ..ImageFile::default()
    };
    let depth = ScanFile {
        ds_mm: (noise.below(2) == 0).then(|| number(noise, 0.1)),
        dz_mm: Some(number(noise, 0.1)).filter(|_| noise.below(2) == 0),
        unit: [ScanUnit::Um, ScanUnit::Mm, ScanUnit::M, ScanUnit::Counts][noise.below(4)],
        nm_per_count: Some(number(noise, 10.0)),
        height_positive_up: noise.below(2) == 0,
        missing: (noise.below(3) == 0).then(|| number(noise, 0.0)),
        fill: [ScanFill::None, ScanFill::Neighbours][noise.below(3).min(1)],
        remove_form: [ScanForm::None, ScanForm::Plane, ScanForm::Cylinder, ScanForm::Torus][noise.below(4)],
        radius_mm: (noise.below(2) == 0).then(|| number(noise, 20.0)),
        zero: [ScanZero::AsIs, ScanZero::RimMedian, ScanZero::Percentile][noise.below(3)],
        zero_percentile: Some(number(noise, 50.0)),
        first_row: [FirstRow::Top, FirstRow::Bottom][noise.below(2)],
        rolling_direction: directions[noise.below(4)],
        threshold_um: number(noise, 1.0),
        speck_mm2: number(noise, 0.001),
        center: noise.below(2) == 0,
        ..ScanFile::default()
    };
    let sound = |polygons: Polygons| {
        assert!(!polygons.polygons_mm.is_empty());
        assert!(polygons.polygons_mm.iter().all(|ring| ring.len() >= 3));
        assert!(polygons.polygons_mm.iter().flatten().flatten().all(|v| v.is_finite()));
    };
    let mut read = 0;
    read += usize::from(read_svg(bytes, &svg).map(sound).is_ok());
    read += usize::from(read_image(bytes, &image).map(sound).is_ok());
    if let Ok(DepthMap { grid, .. }) = read_depth_map(bytes, None, &depth) {
        read += 1;
        assert_eq!(grid.depth_um.len(), grid.columns * grid.rows);
        assert!(grid.depth_um.iter().all(|d| d.is_finite()));
        assert!(grid.damaged_bounds().is_some());
    }
    read
}

#[test]
fn prop_no_bytes_make_a_reader_panic() {
    let seconds = std::env::var("BRINELL_FUZZ_SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(4);
    let seed = std::env::var("BRINELL_FUZZ_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1_u64);
    let mut seeds: Vec<Vec<u8>> = Vec::new();
    for (name, bytes) in made_seeds() {
        if std::env::var_os("BRINELL_FUZZ_WRITE").is_some() {
            std::fs::write(folder().join(name), &bytes).unwrap();
        }
    }
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder()).unwrap().map(|f| f.unwrap().path()).collect();
    names.sort();
    for name in names {
        seeds.push(std::fs::read(name).unwrap());
    }
    let mut noise = Noise(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let begin = Instant::now();
    let (mut runs, mut readable, mut panics) = (0_u64, 0_usize, 0);
    let mut slowest = Duration::ZERO;
    while runs < 20 * seeds.len() as u64 || begin.elapsed() < Duration::from_secs(seconds) {
        let pick = &seeds[runs as usize % seeds.len()];
        // Each seed as it is at first, under several options.
        let bytes = if runs < 20 * seeds.len() as u64 {
            pick.clone()
        } else {
            let other = noise.below(seeds.len());
            mutate(&mut noise, pick, &seeds[other])
        };
        let options = noise.0;
        let started = Instant::now();
        match catch_unwind(AssertUnwindSafe(|| read_all(&mut noise, &bytes))) {
            Ok(read) => readable += read,
            Err(_) => {
                panics += 1;
                std::fs::write(folder().join(format!("panic-{options:016x}")), &bytes).unwrap();
            }
        }
        let took = started.elapsed();
        if took > slowest {
            slowest = took;
            if took > Duration::from_secs(5) {
                std::fs::write(folder().join(format!("slow-{options:016x}")), &bytes).unwrap();
            }
        }
        runs += 1;
    }
    println!("{runs} files, {readable} readable, {panics} panics, slowest {slowest:?}, {:?}", begin.elapsed());
    assert_eq!(panics, 0);
    assert!(slowest < Duration::from_secs(30), "{slowest:?}");
}
