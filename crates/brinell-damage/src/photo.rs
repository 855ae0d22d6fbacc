//! Photos with the outline that was read from them, small enough for a page.

use std::path::Path;

use brinell::scenario::{ImageFile, Scenario, Shape};

use crate::error::DamageError;
use crate::image::trace_image;
use crate::pixels::{Channel, Pixels, decode};
use crate::resolve::bytes_of;

/// Pixels along the longer side of a photo on a page.
const LONGEST: usize = 800;

/// A photo on a page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Photo {
    /// Its file, as the scenario names it.
    pub file: String,
    /// Pixels across.
    pub columns: usize,
    /// Grey, 0 black to 255 white, row by row from the top.
    pub grey: Vec<u8>,
    /// The side of a pixel.
    pub mm_per_pixel: f64,
    /// Outlines of the damage, pixels from the upper left corner.
    pub rings_px: Vec<Vec<[f64; 2]>>,
    /// How they were found, in sentences.
    pub notes: Vec<String>,
}

/// Reads a photo and the outline in it; the photo comes back with at most 800 pixels along a side.
///
/// # Errors
/// As [`crate::read_image`].
pub fn photo(bytes: &[u8], options: &ImageFile) -> Result<Photo, DamageError> {
    let traced = trace_image(bytes, options)?;
    let channel = match options.use_alpha {
        true => Channel::Alpha,
        false => Channel::Luminance { behind: u16::MAX },
    };
    let pixels = decode(bytes, channel)?;
    let factor = pixels.width.max(pixels.height).div_ceil(LONGEST);
    let small = |p: &[f64; 2]| p.map(|v| v / factor as f64);
    let rings = traced.rings_px.iter();
    Ok(Photo {
        file: String::new(),
        columns: pixels.width.div_ceil(factor),
        grey: shrunk(&pixels, factor),
        mm_per_pixel: options.mm_per_pixel * factor as f64,
        rings_px: rings.map(|ring| ring.iter().map(small).collect()).collect(),
        notes: traced.polygons.notes,
    })
}

/// Means of squares of pixels.
fn shrunk(pixels: &Pixels, factor: usize) -> Vec<u8> {
    let (columns, rows) = (pixels.width.div_ceil(factor), pixels.height.div_ceil(factor));
    let mut grey = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        let lines = row * factor..((row + 1) * factor).min(pixels.height);
        for column in 0..columns {
            let (from, to) = (column * factor, ((column + 1) * factor).min(pixels.width));
            let (mut sum, mut count) = (0_u64, 0_u64);
            for y in lines.clone() {
                let line = &pixels.values[y * pixels.width + from..y * pixels.width + to];
                sum += line.iter().map(|&v| u64::from(v)).sum::<u64>();
                count += line.len() as u64;
            }
            grey.push((sum / count.max(1) / 257) as u8);
        }
    }
    grey
}

/// The photo of each defect of a scenario whose files are not read yet; `None` where there is none, or it cannot be
/// read.
pub fn photos(scenario: &Scenario, folder: &Path) -> Vec<Option<Photo>> {
    let of = |shape: &Shape| {
        let Shape::Image(image) = shape else {
            return None;
        };
        let bytes = bytes_of(shape, folder).ok()?;
        let photo = photo(&bytes, image).ok()?;
        Some(Photo { file: image.file.clone(), ..photo })
    };
    scenario.defects.iter().map(|d| of(&d.shape)).collect()
}
