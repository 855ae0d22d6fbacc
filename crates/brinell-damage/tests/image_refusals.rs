//! Photos and masks that are refused, and the memory that the largest take.

use std::time::Instant;

use crate::common::{grey_bytes, grey_png, peak_mb};
use crate::images::{BLURRED, EDGES, SHARP, options};
use brinell::scenario::{ImageEdges, ImageFile};
use brinell_damage::{FileKind, read_image};

#[test]
fn prop_unusable_images_are_refused_in_words() {
    let default = options(EDGES);
    let refuse = |bytes: &[u8], options: &ImageFile| read_image(bytes, options).unwrap_err().to_string();
    let flat = grey_png(20, 20, |_, _| 0.5);
    let at = |threshold| ImageFile { threshold: Some(threshold), ..default.clone() };
    assert!(refuse(&flat, &default).contains("one brightness only"));
    assert!(refuse(&flat, &at(0.4)).starts_with("there is no damage in it"));
    assert!(refuse(&flat, &at(0.6)).starts_with("all of it would be damage"));
    let dot = grey_png(20, 20, |x, y| if (x, y) == (4, 4) { 0.0 } else { 1.0 });
    assert!(refuse(&dot, &default).contains("the largest of 1 spot encloses"));
    for (options, words) in [
        (at(1.0), "`threshold` is 1; it must be a number above 0 and below 1"),
        (at(f64::NAN), "`threshold` is NaN"),
        (ImageFile { mm_per_pixel: 0.0, ..default.clone() }, "`mm_per_pixel` is 0"),
        (ImageFile::default(), "`mm_per_pixel` is NaN"),
        (ImageFile { mm_per_pixel: 1e9, ..default.clone() }, "`mm_per_pixel` is 1000000000"),
        (options((ImageEdges::SubPixel, -1.0)), "`blur_px` is -1"),
        (ImageFile { speck_mm2: f64::INFINITY, ..default.clone() }, "`speck_mm2` is inf"),
    ] {
        let said = refuse(&dot, &options);
        assert!(said.starts_with(words), "{said}");
    }
    assert_eq!(refuse(b"II*\0", &default), "a TIFF image cannot be read as an image; save it as PNG or JPEG");
    let error = FileKind::check("photo.JPG", &dot).unwrap_err();
    assert_eq!(
        error.to_string(),
        "this should be JPEG, but its content is PNG; correct the name or choose the right file"
    );
    // Cut off.
    let mut jpeg = Vec::new();
    let grey = grey_bytes(64, 64, |x, y| ((x * y) % 97) as f64 / 97.0);
    jpeg_encoder::Encoder::new(&mut jpeg, 90).encode(&grey, 64, 64, jpeg_encoder::ColorType::Luma).unwrap();
    read_image(&jpeg, &ImageFile { speck_mm2: 0.0, ..default.clone() }).unwrap();
    let noisy = grey_png(64, 64, |x, y| ((x * y) % 97) as f64 / 97.0);
    for (file, kind) in [(&jpeg, "JPEG"), (&noisy, "PNG")] {
        let said = refuse(&file[..file.len() / 2], &default);
        assert!(said.starts_with(&format!("this {kind} file is broken at")), "{said}");
    }
}

#[test]
fn prop_twenty_thousand_pixels_square_are_refused_at_once() {
    let mut image = grey_png(8, 8, |_, _| 0.5);
    image[16..20].copy_from_slice(&20_000_u32.to_be_bytes());
    image[20..24].copy_from_slice(&20_000_u32.to_be_bytes());
    let checksum = crc32(&image[12..29]).to_be_bytes();
    image[29..33].copy_from_slice(&checksum);
    let mut jpeg = Vec::new();
    jpeg_encoder::Encoder::new(&mut jpeg, 90).encode(&[9; 64], 8, 8, jpeg_encoder::ColorType::Luma).unwrap();
    let frame = jpeg.windows(2).position(|w| w == [0xff, 0xc0]).unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x4e, 0x20, 0x4e, 0x20]);
    for bytes in [image, jpeg] {
        let begin = Instant::now();
        let said = read_image(&bytes, &options(EDGES)).unwrap_err().to_string();
        assert!(said.starts_with("the image is 20000 x 20000 pixels, more than the 67108864 pixels"), "{said}");
        assert!(begin.elapsed().as_millis() < 200);
    }
}

#[test]
fn prop_what_takes_more_than_its_pixels_to_decode_is_refused_before_it_is() {
    // 8192 x 8192 at three bytes a pixel; 8000 x 8000 at seven, as the decoder holds two of each colour of a
    // progressive file.
    for (progressive, size, megabytes) in [(false, [0x20, 0x00], 201), (true, [0x1f, 0x40], 448)] {
        let mut jpeg = Vec::new();
        let mut encoder = jpeg_encoder::Encoder::new(&mut jpeg, 80);
        encoder.set_progressive(progressive);
        encoder.encode(&[9; 192], 8, 8, jpeg_encoder::ColorType::Rgb).unwrap();
        let marker = [0xff, if progressive { 0xc2 } else { 0xc0 }];
        let frame = jpeg.windows(2).position(|at| at == marker).unwrap();
        for at in [5, 7] {
            jpeg[frame + at..frame + at + 2].copy_from_slice(&size);
        }
        let read = read_image(&jpeg, &options(EDGES)).map(drop);
        let said = read.unwrap_err().to_string();
        let expected = format!("{megabytes} MB to decode, more than the 192 MB");
        assert!(said.contains(&expected), "{said}");
        assert!(said.contains("neither interlaced nor progressive"), "{said}");
    }
}

#[test]
#[ignore = "half a gigabyte and some seconds; `-- --ignored --nocapture --test-threads 1` by hand"]
fn prop_the_largest_images_stay_within_a_gigabyte() {
    let side = 8192;
    let middle = 4000.0;
    let disc = |x: usize, y: usize| (x as f64 - middle).hypot(y as f64 - middle) < 3000.0;
    let photo = grey_png(side, side, |x, y| if disc(x, y) { 0.2 } else { 0.8 });
    let texture = grey_png(side, side, |x, y| f64::from(((x * 7919) ^ (y * 104_729)) as u8) / 255.0);
    let mut jpeg = Vec::new();
    let mut encoder = jpeg_encoder::Encoder::new(&mut jpeg, 80);
    encoder.set_progressive(true);
    let tile = grey_bytes(side, 4096, |x, y| if disc(x, y) { 0.2 } else { 0.8 });
    encoder.encode(&tile, side as u16, 4096, jpeg_encoder::ColorType::Luma).unwrap();
    drop(tile);
    println!("before reading: {:.0} MB", peak_mb());
    for (name, image) in [("disc", photo), ("texture", texture), ("half a disc, progressive JPEG", jpeg)] {
        for smooth in [EDGES, SHARP, BLURRED] {
            let begin = Instant::now();
            let options = ImageFile { speck_mm2: 0.0, ..options(smooth) };
            let result = read_image(&image, &options).map(|d| d.polygons_mm.len());
            println!("{name}, {smooth:?}: {:?}, peak {:.0} MB, {result:?}", begin.elapsed(), peak_mb());
        }
    }
    assert!(peak_mb() < 1000.0);
}

/// The header alone: nothing of the pixels is there to be decoded.
#[test]
fn regress_an_image_of_one_line_of_pixels_is_refused_from_its_header() {
    for (width, height) in [(1, 1 << 26), (1 << 26, 1), (2, 1 << 25), (1, 1), (65_536, 2)] {
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

/// The checksum of a PNG's header: CRC-32, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| (c >> 1) ^ (0xEDB8_8320 & (c & 1).wrapping_neg()))
    };
    !bytes.iter().fold(u32::MAX, step)
}
