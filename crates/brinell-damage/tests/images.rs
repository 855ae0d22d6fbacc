//! Photos and masks against closed forms.

use std::f64::consts::PI;

use crate::common::{Noise, cover, grey_bytes, grey_png, holds, png, width_at};
use brinell::scenario::{ImageEdges, ImageFile, RollingDirection};
use brinell_damage::{DamageError, read_image};
use png::{BitDepth, ColorType};
use proptest::prelude::*;

const PIXEL: f64 = 0.02;

/// How an outline runs, and the blur before, pixels.
type Edges = (ImageEdges, f64);

pub(crate) fn options((edges, blur_px): Edges) -> ImageFile {
    ImageFile { mm_per_pixel: PIXEL, edges, blur_px: Some(blur_px), ..Default::default() }
}

pub(crate) const EDGES: Edges = (ImageEdges::PixelEdges, 0.0);
pub(crate) const SHARP: Edges = (ImageEdges::SubPixel, 0.0);
pub(crate) const BLURRED: Edges = (ImageEdges::SubPixel, 1.5);

#[test]
fn analytic_rectangle_on_pixel_edges_is_exact() {
    let image = grey_png(250, 300, |x, y| if (50..200).contains(&x) && (40..240).contains(&y) { 0.1 } else { 0.8 });
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
    let hard = grey_png(240, 240, |x, y| if disc(x as f64 + 0.5, y as f64 + 0.5) { 0.0 } else { 1.0 });
    let true_area = PI * (radius * PIXEL).powi(2);
    for (name, image, smooth, area_bound, pixels) in [
        ("hard mask, edges", &hard, EDGES, 5e-3, 1.0),
        ("hard mask, sub-pixel", &hard, SHARP, 5e-3, 0.75),
        ("soft mask, sub-pixel", &soft, SHARP, 5e-4, 0.1),
        ("soft mask, blurred", &soft, BLURRED, 1e-3, 0.15),
    ] {
        let damage = read_image(image, &options(smooth)).unwrap();
        let error = damage.area_mm2() / true_area - 1.0;
        assert!(error.abs() < area_bound, "{name}: area off by {error:e}");
        for s in [-1.2_f64, -0.501, 0.0, 0.777, 1.5] {
            let chord = 2.0 * (4.0 - s * s).sqrt();
            let slope = 4.0 / chord;
            let error = (width_at(&damage.polygons_mm, s) - chord).abs();
            assert!(error < 2.0 * slope * pixels * PIXEL, "{name}, s = {s}: {error}");
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
        (RollingDirection::Right, [-1.5, 3.0], [2.0, -3.0], [2.0, 3.0]),
        (RollingDirection::Up, [3.0, 1.5], [-3.0, -2.0], [3.0, -2.0]),
        (RollingDirection::Left, [1.5, -3.0], [-2.0, 3.0], [-2.0, -3.0]),
        (RollingDirection::Down, [-3.0, -1.5], [3.0, 2.0], [-3.0, 2.0]),
    ] {
        let options = ImageFile { mm_per_pixel: 1.0, rolling_direction: direction, speck_mm2: 0.0, ..options(EDGES) };
        let damage = read_image(&image, &options).unwrap();
        assert!((damage.area_mm2() - 22.0).abs() < 1e-9, "outer rings counter-clockwise");
        assert!(holds(&damage.polygons_mm, top), "{direction:?}");
        assert!(holds(&damage.polygons_mm, foot), "{direction:?}");
        assert!(!holds(&damage.polygons_mm, empty), "{direction:?}");
        // Without centring, pixel (3, 2) of the long stroke is 1.5 left of and 3.5 above the image's centre.
        let there = ImageFile { center: false, ..options };
        let damage = read_image(&image, &there).unwrap();
        let point = match direction {
            RollingDirection::Right => [-1.5, 3.5],
            RollingDirection::Up => [3.5, 1.5],
            RollingDirection::Left => [1.5, -3.5],
            RollingDirection::Down => [-3.5, -1.5],
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
            let options = ImageFile {
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
    let specks: Vec<[usize; 2]> = (0..60).map(|_| [noise.below(300), noise.below(30)]).collect();
    let image = grey_png(300, 300, |x, y| {
        let r = (x as f64 - 149.5).hypot(y as f64 - 160.0);
        let dark = (50.0..100.0).contains(&r) || specks.contains(&[x, y]) || (x, y) == (149, 85);
        // A light speck within the dark ring, a dark one in its hole.
        if (x, y) == (149, 235) || !dark { 0.9 } else { 0.2 }
    });
    let damage = read_image(&image, &options(EDGES)).unwrap();
    assert_eq!(damage.polygons_mm.len(), 2);
    let area = PI * (100.0_f64.powi(2) - 50.0_f64.powi(2)) * PIXEL * PIXEL;
    assert!((damage.area_mm2() / area - 1.0).abs() < 5e-3);
    let said = damage.notes.join("\n");
    assert!(said.contains("the threshold was found as 0.5"), "{said}");
    assert!(said.contains("and filled 1 hole that enclose less than 0.02 mm^2"), "{said}");
    // The ring's own, of 50 pixels' radius: 3.14 mm^2.
    assert!(said.contains("kept 1 hole in the damage as sound surface, the largest of 3.1 mm^2"), "{said}");
    let whole = read_image(&image, &ImageFile { speck_mm2: 3.2, ..options(EDGES) }).unwrap();
    assert_eq!(whole.polygons_mm.len(), 1);
    assert!(!whole.notes.join("\n").contains("kept"), "{:?}", whole.notes);
}

#[test]
fn analytic_a_mask_drawn_in_the_alpha_channel() {
    let drawn = |x: usize, y: usize| (10..40).contains(&x) && (5..25).contains(&y);
    let rgba: Vec<u8> = (0..50 * 30).flat_map(|i| [200, 30, 30, if drawn(i % 50, i / 50) { 255 } else { 0 }]).collect();
    let image = png(50, 30, ColorType::Rgba, BitDepth::Eight, &rgba);
    for (use_alpha, invert, area) in [(true, false, 600.0), (true, true, 900.0), (false, false, 600.0)] {
        let options = ImageFile { mm_per_pixel: 1.0, use_alpha, invert, ..options(EDGES) };
        let damage = read_image(&image, &options).unwrap();
        assert!((damage.area_mm2() - area).abs() < 1e-9, "{use_alpha} {invert}");
    }
    let grey = grey_png(4, 4, |_, _| 0.5);
    let with_alpha = ImageFile { use_alpha: true, ..options(EDGES) };
    assert!(read_image(&grey, &with_alpha).unwrap_err().to_string().contains("without an alpha channel"));
}

#[test]
fn xval_every_kind_of_png_gives_the_same_outline() {
    let dark = |i: usize| (i % 16 > 3 && i % 16 < 12) && (i / 16 > 2 && i / 16 < 9);
    let expand = |pixel: fn(u8) -> Vec<u8>| -> Vec<u8> {
        (0..256).flat_map(|i| pixel(if dark(i) { 40 } else { 220 })).collect()
    };
    let bits: Vec<u8> = (0..32).map(|i| (0..8).fold(0, |b, k| b << 1 | u8::from(!dark(8 * i + k)))).collect();
    let images = [
        png(16, 16, ColorType::Grayscale, BitDepth::Eight, &expand(|v| vec![v])),
        png(16, 16, ColorType::Grayscale, BitDepth::One, &bits),
        png(16, 16, ColorType::Grayscale, BitDepth::Sixteen, &expand(|v| vec![v, 7])),
        png(16, 16, ColorType::GrayscaleAlpha, BitDepth::Eight, &expand(|v| vec![v, 255])),
        png(16, 16, ColorType::Rgb, BitDepth::Eight, &expand(|v| vec![v, v, v])),
        png(16, 16, ColorType::Rgba, BitDepth::Sixteen, &expand(|v| vec![v, 0, v, 0, v, 0, 255, 255])),
    ];
    let options = ImageFile { speck_mm2: 0.0, ..options(EDGES) };
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
            encoder.encode(&grey, 200, 200, jpeg_encoder::ColorType::Luma).unwrap();
            let damage = read_image(&jpeg, &options(BLURRED)).unwrap();
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
    let options = ImageFile { mm_per_pixel: PIXEL, ..Default::default() };
    let damage = read_image(photo, &options).unwrap();
    let [low, high] = damage.bounds_mm().unwrap();
    println!("{:?} area {} {:?}", [low, high], damage.area_mm2(), damage.warnings);
    assert_eq!(damage.polygons_mm.len(), 1);
    // See examples/draw_examples.rs; a soft edge and Otsu's level move it by a pixel or so.
    assert!((high[0] - low[0] - 3.0).abs() < 3.0 * PIXEL);
    assert!((high[1] - low[1] - 4.0).abs() < 3.0 * PIXEL);
}
