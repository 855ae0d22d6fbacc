//! Photos and masks against closed forms.
#![cfg(feature = "image")]

use std::f64::consts::PI;
use std::time::Instant;

use crate::common::{Noise, cover, grey_bytes, grey_png, holds, peak_mb, png, width_at};
use brinell_damage::{DamageError, Direction, FileKind, ImageOptions, Smooth, read_image};
use png::{BitDepth, ColorType};
use proptest::prelude::*;

const PIXEL: f64 = 0.02;

fn options(smooth: Smooth) -> ImageOptions {
    ImageOptions {
        mm_per_pixel: PIXEL,
        smooth,
        ..Default::default()
    }
}

const EDGES: Smooth = Smooth::PixelEdges;
const SHARP: Smooth = Smooth::SubPixel { blur_px: 0.0 };

#[test]
fn analytic_rectangle_on_pixel_edges_is_exact() {
    let image = grey_png(250, 300, |x, y| {
        if (50..200).contains(&x) && (40..240).contains(&y) {
            0.1
        } else {
            0.8
        }
    });
    let damage = read_image(&image, &options(EDGES)).unwrap();
    assert_eq!(damage.polygons_mm.len(), 1);
    assert_eq!(damage.polygons_mm[0].len(), 4);
    assert!((damage.area_mm2() - 12.0).abs() < 1e-9);
    assert!((width_at(&damage.polygons_mm, 0.3) - 4.0).abs() < 1e-9);
    // Between pixel centres it loses an eighth of a pixel at each corner.
    let damage = read_image(&image, &options(SHARP)).unwrap();
    assert!((damage.area_mm2() - 12.0).abs() <= 0.5 * PIXEL * PIXEL + 1e-9);
    // Otsu's level is known to half a bin of 256.
    assert!((width_at(&damage.polygons_mm, 0.3) - 4.0).abs() < 0.01 * PIXEL);
}

#[test]
fn analytic_circle_has_its_area_and_chords_within_the_resolution() {
    let (middle, radius) = (120.3, 100.0);
    let disc = |x: f64, y: f64| (x - middle).hypot(y - middle) < radius;
    let soft = grey_png(240, 240, |x, y| 1.0 - cover(x, y, disc));
    let hard = grey_png(240, 240, |x, y| {
        if disc(x as f64 + 0.5, y as f64 + 0.5) {
            0.0
        } else {
            1.0
        }
    });
    let true_area = PI * (radius * PIXEL).powi(2);
    for (name, image, smooth, area_bound, pixels) in [
        ("hard mask, edges", &hard, EDGES, 5e-3, 1.0),
        ("hard mask, sub-pixel", &hard, SHARP, 5e-3, 0.75),
        ("soft mask, sub-pixel", &soft, SHARP, 5e-4, 0.1),
        (
            "soft mask, blurred",
            &soft,
            Smooth::SubPixel { blur_px: 1.5 },
            1e-3,
            0.15,
        ),
    ] {
        let damage = read_image(image, &options(smooth)).unwrap();
        let error = damage.area_mm2() / true_area - 1.0;
        assert!(error.abs() < area_bound, "{name}: area off by {error:e}");
        for s in [-1.2_f64, -0.501, 0.0, 0.777, 1.5] {
            let chord = 2.0 * (4.0 - s * s).sqrt();
            let slope = 4.0 / chord;
            let error = (width_at(&damage.polygons_mm, s) - chord).abs();
            assert!(
                error < 2.0 * slope * pixels * PIXEL,
                "{name}, s = {s}: {error}"
            );
        }
    }
}

/// An L: the long stroke on the left, the short one at the bottom to the right.
fn letter(x: usize, y: usize) -> bool {
    (2..4).contains(&x) && (1..9).contains(&y) || (2..7).contains(&x) && (7..9).contains(&y)
}

#[test]
fn analytic_an_l_is_turned_and_never_mirrored() {
    let image = grey_png(10, 12, |x, y| if letter(x, y) { 0.0 } else { 1.0 });
    for (direction, top, foot, empty) in [
        (Direction::Right, [-1.5, 3.0], [2.0, -3.0], [2.0, 3.0]),
        (Direction::Up, [3.0, 1.5], [-3.0, -2.0], [3.0, -2.0]),
        (Direction::Left, [1.5, -3.0], [-2.0, 3.0], [-2.0, -3.0]),
        (Direction::Down, [-3.0, -1.5], [3.0, 2.0], [-3.0, 2.0]),
    ] {
        let options = ImageOptions {
            mm_per_pixel: 1.0,
            rolling_direction: direction,
            speck_mm2: 0.0,
            ..options(EDGES)
        };
        let damage = read_image(&image, &options).unwrap();
        assert!(
            (damage.area_mm2() - 22.0).abs() < 1e-9,
            "outer rings counter-clockwise"
        );
        assert!(holds(&damage.polygons_mm, top), "{direction:?}");
        assert!(holds(&damage.polygons_mm, foot), "{direction:?}");
        assert!(!holds(&damage.polygons_mm, empty), "{direction:?}");
        // Without centring, pixel (3, 2) of the long stroke is 1.5 left of and 3.5 above the image's centre.
        let there = ImageOptions {
            center: false,
            ..options
        };
        let damage = read_image(&image, &there).unwrap();
        let point = match direction {
            Direction::Right => [-1.5, 3.5],
            Direction::Up => [3.5, 1.5],
            Direction::Left => [1.5, -3.5],
            Direction::Down => [-3.5, -1.5],
        };
        assert!(holds(&damage.polygons_mm, point), "{direction:?}");
    }
}

proptest! {
    #[test]
    fn prop_outlines_hold_exactly_the_damaged_pixels(
        width in 2..14_usize, values in prop::collection::vec(0..5_u8, 4..170), level in 1..5_u8,
    ) {
        let height = values.len() / width;
        prop_assume!(height > 1);
        let damaged = |x: usize, y: usize| values[y * width + x] >= level;
        let count = (0..width * height).filter(|i| damaged(i % width, i / width)).count();
        let image = grey_png(width, height, |x, y| 1.0 - 0.2 * f64::from(values[y * width + x]));
        for smooth in [EDGES, SHARP] {
            let options = ImageOptions {
                mm_per_pixel: 1.0,
                threshold: Some(1.1 - 0.2 * f64::from(level)),
                center: false,
                speck_mm2: 0.0,
                ..options(smooth)
            };
            let damage = match read_image(&image, &options) {
                Ok(damage) => damage,
                Err(DamageError::NothingDamaged { .. }) => {
                    prop_assert_eq!(count, 0);
                    continue;
                }
                Err(DamageError::AllDamaged { .. }) => {
                    prop_assert_eq!(count, width * height);
                    continue;
                }
                Err(other) => return Err(TestCaseError::fail(other.to_string())),
            };
            if smooth == EDGES {
                prop_assert!((damage.area_mm2() - count as f64).abs() < 1e-9);
            }
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let s = x as f64 + 0.5 - 0.5 * width as f64;
                let z = 0.5 * height as f64 - y as f64 - 0.5;
                // Not on a vertex of an outline that passes near the centre.
                prop_assert_eq!(holds(&damage.polygons_mm, [s + 1e-7, z + 1e-7]), damaged(x, y));
            }
        }
    }
}

#[test]
fn analytic_holes_stay_and_specks_go() {
    let mut noise = Noise(7);
    let specks: Vec<[usize; 2]> = (0..60)
        .map(|_| [noise.below(300), noise.below(30)])
        .collect();
    let image = grey_png(300, 300, |x, y| {
        let r = (x as f64 - 149.5).hypot(y as f64 - 160.0);
        let dark = (50.0..100.0).contains(&r) || specks.contains(&[x, y]) || (x, y) == (149, 85);
        // A light speck within the dark ring, a dark one in its hole.
        if (x, y) == (149, 235) || !dark {
            0.9
        } else {
            0.2
        }
    });
    let damage = read_image(&image, &options(EDGES)).unwrap();
    assert_eq!(damage.polygons_mm.len(), 2);
    let area = PI * (100.0_f64.powi(2) - 50.0_f64.powi(2)) * PIXEL * PIXEL;
    assert!((damage.area_mm2() / area - 1.0).abs() < 5e-3);
    let said = damage.notes.join("\n");
    assert!(said.contains("the threshold was found as 0.5"), "{said}");
    assert!(
        said.contains("and filled 1 hole that enclose less than 0.02 mm^2"),
        "{said}"
    );
}

#[test]
fn analytic_a_mask_drawn_in_the_alpha_channel() {
    let drawn = |x: usize, y: usize| (10..40).contains(&x) && (5..25).contains(&y);
    let rgba: Vec<u8> = (0..50 * 30)
        .flat_map(|i| [200, 30, 30, if drawn(i % 50, i / 50) { 255 } else { 0 }])
        .collect();
    let image = png(50, 30, ColorType::Rgba, BitDepth::Eight, &rgba);
    for (use_alpha, invert, area) in [
        (true, false, 600.0),
        (true, true, 900.0),
        (false, false, 600.0),
    ] {
        let options = ImageOptions {
            mm_per_pixel: 1.0,
            use_alpha,
            invert,
            ..options(EDGES)
        };
        let damage = read_image(&image, &options).unwrap();
        assert!(
            (damage.area_mm2() - area).abs() < 1e-9,
            "{use_alpha} {invert}"
        );
    }
    let grey = grey_png(4, 4, |_, _| 0.5);
    let with_alpha = ImageOptions {
        use_alpha: true,
        ..options(EDGES)
    };
    assert!(
        read_image(&grey, &with_alpha)
            .unwrap_err()
            .to_string()
            .contains("without an alpha channel")
    );
}

#[test]
fn xval_every_kind_of_png_gives_the_same_outline() {
    let dark = |i: usize| (i % 16 > 3 && i % 16 < 12) && (i / 16 > 2 && i / 16 < 9);
    let expand = |pixel: fn(u8) -> Vec<u8>| -> Vec<u8> {
        (0..256)
            .flat_map(|i| pixel(if dark(i) { 40 } else { 220 }))
            .collect()
    };
    let bits: Vec<u8> = (0..32)
        .map(|i| (0..8).fold(0, |b, k| b << 1 | u8::from(!dark(8 * i + k))))
        .collect();
    let images = [
        png(
            16,
            16,
            ColorType::Grayscale,
            BitDepth::Eight,
            &expand(|v| vec![v]),
        ),
        png(16, 16, ColorType::Grayscale, BitDepth::One, &bits),
        png(
            16,
            16,
            ColorType::Grayscale,
            BitDepth::Sixteen,
            &expand(|v| vec![v, 7]),
        ),
        png(
            16,
            16,
            ColorType::GrayscaleAlpha,
            BitDepth::Eight,
            &expand(|v| vec![v, 255]),
        ),
        png(
            16,
            16,
            ColorType::Rgb,
            BitDepth::Eight,
            &expand(|v| vec![v, v, v]),
        ),
        png(
            16,
            16,
            ColorType::Rgba,
            BitDepth::Sixteen,
            &expand(|v| vec![v, 0, v, 0, v, 0, 255, 255]),
        ),
    ];
    let options = ImageOptions {
        speck_mm2: 0.0,
        ..options(EDGES)
    };
    let read = |image: &[u8]| read_image(image, &options).unwrap().polygons_mm;
    for image in &images[1..] {
        assert_eq!(read(image), read(&images[0]));
    }
}

#[test]
fn prop_jpeg_quality_moves_the_outline_by_little() {
    let (middle, radius) = (100.0, 70.0);
    let mut noise = Noise(11);
    let grain: Vec<f64> = (0..200 * 200).map(|_| 0.03 * noise.normal()).collect();
    let photo = |x: usize, y: usize| {
        let inside = cover(x, y, |u, v| (u - middle).hypot(v - middle) < radius);
        (0.7 - 0.45 * inside + grain[y * 200 + x]).clamp(0.0, 1.0)
    };
    let grey = grey_bytes(200, 200, photo);
    let true_area = PI * (radius * PIXEL).powi(2);
    for (quality, bound) in [(95, 2e-3), (75, 3e-3), (50, 4e-3), (25, 8e-3), (10, 2e-2)] {
        for progressive in [false, true] {
            let mut jpeg = Vec::new();
            let mut encoder = jpeg_encoder::Encoder::new(&mut jpeg, quality);
            encoder.set_progressive(progressive);
            encoder
                .encode(&grey, 200, 200, jpeg_encoder::ColorType::Luma)
                .unwrap();
            let damage = read_image(&jpeg, &options(Smooth::SubPixel { blur_px: 1.5 })).unwrap();
            let error = (damage.area_mm2() / true_area - 1.0).abs();
            println!("quality {quality}, progressive {progressive}: area off by {error:.1e}");
            assert!(error < bound, "quality {quality}: {error:e}");
            assert_eq!(damage.polygons_mm.len(), 1);
        }
    }
}

#[test]
fn analytic_the_drawn_photo_has_its_length_and_width() {
    let photo = include_bytes!("../../../examples/photo-spall.png");
    let options = ImageOptions {
        mm_per_pixel: PIXEL,
        ..Default::default()
    };
    let damage = read_image(photo, &options).unwrap();
    let [low, high] = damage.bounds_mm().unwrap();
    println!(
        "{:?} area {} {:?}",
        [low, high],
        damage.area_mm2(),
        damage.warnings
    );
    assert_eq!(damage.polygons_mm.len(), 1);
    // See examples/draw_examples.rs; a soft edge and Otsu's level move it by a pixel or so.
    assert!((high[0] - low[0] - 3.0).abs() < 3.0 * PIXEL);
    assert!((high[1] - low[1] - 4.0).abs() < 3.0 * PIXEL);
}

#[test]
fn prop_unusable_images_are_refused_in_words() {
    let default = options(EDGES);
    let refuse =
        |bytes: &[u8], options: &ImageOptions| read_image(bytes, options).unwrap_err().to_string();
    let flat = grey_png(20, 20, |_, _| 0.5);
    let at = |threshold| ImageOptions {
        threshold: Some(threshold),
        ..default.clone()
    };
    assert!(refuse(&flat, &default).contains("one brightness only"));
    assert!(refuse(&flat, &at(0.4)).starts_with("there is no damage in it"));
    assert!(refuse(&flat, &at(0.6)).starts_with("all of it would be damage"));
    let dot = grey_png(20, 20, |x, y| if (x, y) == (4, 4) { 0.0 } else { 1.0 });
    assert!(refuse(&dot, &default).contains("the largest of 1 spot encloses"));
    for (options, words) in [
        (
            at(1.0),
            "`threshold` is 1; it must be a number above 0 and below 1",
        ),
        (at(f64::NAN), "`threshold` is NaN"),
        (
            ImageOptions {
                mm_per_pixel: 0.0,
                ..default.clone()
            },
            "`mm_per_pixel` is 0",
        ),
        (
            ImageOptions {
                mm_per_pixel: 1e9,
                ..default.clone()
            },
            "`mm_per_pixel` is 1000000000",
        ),
        (
            ImageOptions {
                smooth: Smooth::SubPixel { blur_px: -1.0 },
                ..default.clone()
            },
            "`blur_px` is -1",
        ),
        (
            ImageOptions {
                speck_mm2: f64::INFINITY,
                ..default.clone()
            },
            "`speck_mm2` is inf",
        ),
    ] {
        let said = refuse(&dot, &options);
        assert!(said.starts_with(words), "{said}");
    }
    assert_eq!(
        refuse(b"II*\0", &default),
        "a TIFF image cannot be read as an image; save it as PNG or JPEG"
    );
    let error = FileKind::check("photo.JPG", &dot).unwrap_err();
    assert_eq!(
        error.to_string(),
        "this should be JPEG, but its content is PNG; correct the name or choose the right file"
    );
    // Cut off.
    let mut jpeg = Vec::new();
    let grey = grey_bytes(64, 64, |x, y| ((x * y) % 97) as f64 / 97.0);
    jpeg_encoder::Encoder::new(&mut jpeg, 90)
        .encode(&grey, 64, 64, jpeg_encoder::ColorType::Luma)
        .unwrap();
    read_image(
        &jpeg,
        &ImageOptions {
            speck_mm2: 0.0,
            ..default.clone()
        },
    )
    .unwrap();
    let noisy = grey_png(64, 64, |x, y| ((x * y) % 97) as f64 / 97.0);
    for (file, kind) in [(&jpeg, "JPEG"), (&noisy, "PNG")] {
        let said = refuse(&file[..file.len() / 2], &default);
        assert!(
            said.starts_with(&format!("this {kind} file is broken at")),
            "{said}"
        );
    }
}

#[test]
fn prop_twenty_thousand_pixels_square_are_refused_at_once() {
    let mut image = grey_png(8, 8, |_, _| 0.5);
    image[16..20].copy_from_slice(&20_000_u32.to_be_bytes());
    image[20..24].copy_from_slice(&20_000_u32.to_be_bytes());
    // The header's checksum: PNG's CRC-32, bit by bit.
    let crc = image[12..29].iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| {
            if c & 1 == 1 {
                c >> 1 ^ 0xEDB8_8320
            } else {
                c >> 1
            }
        })
    });
    image[29..33].copy_from_slice(&(!crc).to_be_bytes());
    let mut jpeg = Vec::new();
    jpeg_encoder::Encoder::new(&mut jpeg, 90)
        .encode(&[9; 64], 8, 8, jpeg_encoder::ColorType::Luma)
        .unwrap();
    let frame = jpeg.windows(2).position(|w| w == [0xff, 0xc0]).unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x4e, 0x20, 0x4e, 0x20]);
    for bytes in [image, jpeg] {
        let begin = Instant::now();
        let said = read_image(&bytes, &options(EDGES)).unwrap_err().to_string();
        assert!(
            said.starts_with("the image is 20000 x 20000 pixels, more than the 67108864 pixels"),
            "{said}"
        );
        assert!(begin.elapsed().as_millis() < 200);
    }
}

#[test]
fn prop_what_takes_more_than_its_pixels_to_decode_is_refused_before_it_is() {
    // 8192 x 8192 at three bytes a pixel; 8000 x 8000 at seven, as the decoder holds two of each colour of a progressive file.
    for (progressive, size, megabytes) in [(false, [0x20, 0x00], 201), (true, [0x1f, 0x40], 448)] {
        let mut jpeg = Vec::new();
        let mut encoder = jpeg_encoder::Encoder::new(&mut jpeg, 80);
        encoder.set_progressive(progressive);
        encoder
            .encode(&[9; 192], 8, 8, jpeg_encoder::ColorType::Rgb)
            .unwrap();
        let marker = [0xff, if progressive { 0xc2 } else { 0xc0 }];
        let frame = jpeg.windows(2).position(|at| at == marker).unwrap();
        for at in [5, 7] {
            jpeg[frame + at..frame + at + 2].copy_from_slice(&size);
        }
        let read = read_image(&jpeg, &options(EDGES)).map(drop);
        let said = read.unwrap_err().to_string();
        let expected = format!("{megabytes} MB to decode, more than the 192 MB");
        assert!(said.contains(&expected), "{said}");
        assert!(
            said.contains("neither interlaced nor progressive"),
            "{said}"
        );
    }
}

#[test]
#[ignore = "half a gigabyte and some seconds; `-- --ignored --nocapture --test-threads 1` by hand"]
fn prop_the_largest_images_stay_within_a_gigabyte() {
    let side = 8192;
    let middle = 4000.0;
    let disc = |x: usize, y: usize| (x as f64 - middle).hypot(y as f64 - middle) < 3000.0;
    let photo = grey_png(side, side, |x, y| if disc(x, y) { 0.2 } else { 0.8 });
    let texture = grey_png(side, side, |x, y| {
        f64::from(((x * 7919) ^ (y * 104_729)) as u8) / 255.0
    });
    let mut jpeg = Vec::new();
    let mut encoder = jpeg_encoder::Encoder::new(&mut jpeg, 80);
    encoder.set_progressive(true);
    let tile = grey_bytes(side, 4096, |x, y| if disc(x, y) { 0.2 } else { 0.8 });
    encoder
        .encode(&tile, side as u16, 4096, jpeg_encoder::ColorType::Luma)
        .unwrap();
    drop(tile);
    println!("before reading: {:.0} MB", peak_mb());
    for (name, image) in [
        ("disc", photo),
        ("texture", texture),
        ("half a disc, progressive JPEG", jpeg),
    ] {
        for smooth in [EDGES, SHARP, Smooth::SubPixel { blur_px: 1.5 }] {
            let begin = Instant::now();
            let options = ImageOptions {
                speck_mm2: 0.0,
                ..options(smooth)
            };
            let result = read_image(&image, &options).map(|d| d.polygons_mm.len());
            println!(
                "{name}, {smooth:?}: {:?}, peak {:.0} MB, {result:?}",
                begin.elapsed(),
                peak_mb()
            );
        }
    }
    assert!(peak_mb() < 1000.0);
}

/// The header alone: nothing of the pixels is there to be decoded.
#[test]
fn regress_an_image_of_one_line_of_pixels_is_refused_from_its_header() {
    for (width, height) in [
        (1, 1 << 26),
        (1 << 26, 1),
        (2, 1 << 25),
        (1, 1),
        (65_536, 2),
    ] {
        let whole = grey_png(2, 2, |_, _| 0.5);
        let mut head = whole[..33].to_vec();
        head[16..20].copy_from_slice(&u32::to_be_bytes(width));
        head[20..24].copy_from_slice(&u32::to_be_bytes(height));
        let checksum = crc32(&head[12..29]).to_be_bytes();
        head[29..33].copy_from_slice(&checksum);
        let error = read_image(&head, &options(EDGES)).unwrap_err();
        let expected = format!(
            "this PNG file: an image of {width} x {height} pixels is not understood; each side has 2 to 65535 pixels"
        );
        assert!(error.to_string().starts_with(&expected), "{error}");
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| {
            (c >> 1) ^ (0xEDB8_8320 & (c & 1).wrapping_neg())
        })
    };
    !bytes.iter().fold(u32::MAX, step)
}
