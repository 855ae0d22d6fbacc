//! Photos under uneven light, with noise, JPEG, glints, grinding marks and specks, against the area that was drawn.

use crate::common::photos::{Photo, photo};
use brinell::scenario::{ImageFile, ImagePieces};
use brinell_damage::{DamageError, read_image};

/// Photos of a set with a spall, and all of them.
const SPALLED: usize = 50;
const ALL: usize = 60;
/// Error of an area that is right.
const TOLERANCE: f64 = 0.05;

fn options(photo: &Photo) -> ImageFile {
    ImageFile { mm_per_pixel: photo.mm_per_pixel, ..Default::default() }
}

/// The area that was read, 0 where the answer is that there is no spall.
fn area(photo: &Photo) -> f64 {
    match read_image(&photo.bytes, &options(photo)) {
        Ok(found) => found.area_mm2(),
        Err(DamageError::NoSpall { .. } | DamageError::NothingDamaged { .. }) => 0.0,
        Err(other) => panic!("{}: {other}", photo.name),
    }
}

/// Photos whose area is right, and photos without a spall in which one was found.
fn score(seed: u64) -> (usize, usize) {
    let (mut right, mut false_spalls) = (0, 0);
    for k in 0..ALL {
        let photo = photo(seed, k);
        let found = area(&photo);
        let error = found / photo.area_mm2 - 1.0;
        let is_right = match k < SPALLED {
            true => error.abs() <= TOLERANCE,
            false => found == 0.0,
        };
        right += usize::from(is_right);
        false_spalls += usize::from(k >= SPALLED && !is_right);
        let word = if is_right { "right" } else { "WRONG" };
        println!("{word} {}: {found:.4} of {:.4} mm^2", photo.name, photo.area_mm2);
    }
    println!("seed {seed}: {right} of {ALL} right, {false_spalls} false spalls");
    (right, false_spalls)
}

#[test]
fn analytic_areas_of_spalls_in_sixty_photos() {
    let (right, false_spalls) = score(1);
    assert!(right >= 55, "{right} of {ALL}");
    assert_eq!(false_spalls, 0);
}

/// A second set, looked at once, when the reader was done.
#[test]
fn analytic_areas_of_spalls_in_sixty_photos_that_the_reader_was_not_written_with() {
    let (right, false_spalls) = score(2);
    assert!(right >= 55, "{right} of {ALL}");
    assert_eq!(false_spalls, 0);
}

#[test]
fn analytic_a_light_spall_is_reported_and_read_with_invert() {
    let photo = photo(1, 0);
    let decoded = |invert: bool| ImageFile { invert, ..options(&photo) };
    // The photo's negative.
    let negative = crate::common::negative_png(&photo.bytes);
    let said = read_image(&negative, &decoded(false)).unwrap_err().to_string();
    assert!(said.starts_with("no spall found") && said.contains("give `invert = true`"), "{said}");
    let found = read_image(&negative, &decoded(true)).unwrap().area_mm2();
    assert!((found / photo.area_mm2 - 1.0).abs() < TOLERANCE, "{found}");
}

#[test]
fn prop_a_region_and_a_point_choose_the_piece() {
    // Two discs of radius 30 and 20 px under a gradient.
    let disc = |x: usize, y: usize, at: [f64; 2], r: f64| (x as f64 - at[0]).hypot(y as f64 - at[1]) < r;
    let image = crate::common::grey_png(300, 200, |x, y| {
        let dark = disc(x, y, [80.0, 100.0], 30.0) || disc(x, y, [220.0, 100.0], 20.0);
        (0.4 + 0.4 * x as f64 / 300.0) * if dark { 0.5 } else { 1.0 }
    });
    let area = |options: ImageFile| read_image(&image, &options).unwrap().area_mm2();
    let plain = ImageFile { mm_per_pixel: 0.02, ..Default::default() };
    let disc_mm2 = |r: f64| std::f64::consts::PI * (0.02 * r) * (0.02 * r);
    let near = |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 0.02, "{found} {wanted}");
    near(area(plain.clone()), disc_mm2(30.0));
    near(area(ImageFile { at_px: Some([220.0, 95.0]), ..plain.clone() }), disc_mm2(20.0));
    near(area(ImageFile { pieces: Some(ImagePieces::All), ..plain.clone() }), disc_mm2(30.0) + disc_mm2(20.0));
    let region = Some([150.0, 20.0, 150.0, 160.0]);
    near(area(ImageFile { region_px: region, ..plain.clone() }), disc_mm2(20.0));
    let outside = ImageFile { region_px: Some([150.0, 20.0, 151.0, 160.0]), ..plain.clone() };
    assert!(read_image(&image, &outside).unwrap_err().to_string().contains("`region_px` is [150, 20, 151, 160]"));
    let nowhere = ImageFile { at_px: Some([150.0, 20.0]), ..plain };
    assert!(read_image(&image, &nowhere).unwrap_err().to_string().contains("at_px"));
}
