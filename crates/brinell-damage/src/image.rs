//! A photo or a mask, read as outlines of what is damaged.

use crate::blur::gaussian;
use crate::contour::Field;
use crate::direction::Direction;
use crate::error::{DamageError, check_range};
use crate::geometry::Polygons;
use crate::pixels::{Channel, Pixels, decode};
use crate::threshold::otsu;

/// The full scale of a pixel.
const FULL: f64 = 65535.0;
/// Below this share of variance between the two groups, the level found is hardly a boundary.
const CLEAR_SEPARATION: f64 = 0.6;

/// How an outline runs between the pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Smooth {
    /// Along pixel edges: for masks drawn pixel by pixel. Damaged pixels that only touch at a corner are apart.
    PixelEdges,
    /// Between pixel centres, where the brightness crosses the threshold (marching squares), after a Gaussian blur
    /// of this standard deviation in pixels (0 to 20): for photos and soft-edged masks. A corner loses up to 1/8 pixel.
    SubPixel {
        /// Standard deviation of the blur, pixels; 0 for none.
        blur_px: f64,
    },
}

/// How to read an image.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageOptions {
    /// The side of a pixel, mm.
    pub mm_per_pixel: f64,
    /// Between 0 and 1: darker than this is damage (with `use_alpha`: more opaque than this). `None`: 0.5 for alpha; else
    /// the level that divides the picture's brightness best (Otsu), which is then said in the warnings.
    pub threshold: Option<f64>,
    /// The mask is the alpha channel: what is drawn is damage, whatever its colour.
    pub use_alpha: bool,
    /// Lighter (with `use_alpha`: more transparent) is damage.
    pub invert: bool,
    /// Where the roller passes to, in the picture as a viewer shows it (after its EXIF orientation).
    pub rolling_direction: Direction,
    /// Puts the damage's bounding box at the origin; else the image's centre is the origin.
    pub center: bool,
    /// How outlines run between pixels.
    pub smooth: Smooth,
    /// Spots that enclose less than this are dropped, and holes smaller than this filled, mm^2.
    pub speck_mm2: f64,
}

impl Default for ImageOptions {
    /// A photo at 0.01 mm per pixel; blur of 1.5 pixels, specks below 0.02 mm^2.
    fn default() -> Self {
        Self {
            mm_per_pixel: 0.01,
            threshold: None,
            use_alpha: false,
            invert: false,
            rolling_direction: Direction::Right,
            center: true,
            smooth: Smooth::SubPixel { blur_px: 1.5 },
            speck_mm2: 0.02,
        }
    }
}

/// Reads the damaged areas of a PNG or JPEG image (up to 2^26 pixels) as polygons.
pub fn read_image(bytes: &[u8], options: &ImageOptions) -> Result<Polygons, DamageError> {
    check(options)?;
    // Damage is above the level from here on: what shows through transparent places is sound.
    let dark_is_damage = !options.use_alpha && !options.invert;
    let channel = if options.use_alpha {
        Channel::Alpha
    } else {
        Channel::Luminance {
            behind: if options.invert { 0 } else { u16::MAX },
        }
    };
    let mut pixels = decode(bytes, channel)?;
    let flip = dark_is_damage || (options.use_alpha && options.invert);
    if flip {
        pixels.values.iter_mut().for_each(|v| *v = u16::MAX - *v);
    }
    if let Smooth::SubPixel { blur_px } = options.smooth {
        gaussian(&mut pixels, blur_px);
    }
    let mut warnings = Vec::new();
    let (level, found) = level(&pixels, options, flip, &mut warnings)?;
    let field = Field {
        width: pixels.width,
        height: pixels.height,
        values: &pixels.values,
        level,
        rim: 0.5,
        sub_pixel: options.smooth != Smooth::PixelEdges,
    };
    all_or_nothing(&pixels, level)?;
    let pixel_mm2 = options.mm_per_pixel * options.mm_per_pixel;
    let outlines = field.outlines(options.speck_mm2 / pixel_mm2)?;
    if outlines.specks + outlines.filled > 0 {
        warnings.push(format!(
            "dropped {} and filled {} that enclose less than {} mm^2",
            counted(outlines.specks, "speck"),
            counted(outlines.filled, "hole"),
            options.speck_mm2
        ));
    }
    if outlines.rings.is_empty() {
        return Err(DamageError::NothingDamaged {
            why: format!(
                "the largest of {} encloses {:.3e} mm^2, less than `speck_mm2` = {}; check `mm_per_pixel` = {}",
                counted(outlines.specks, "spot"),
                outlines.largest_speck * pixel_mm2,
                options.speck_mm2,
                options.mm_per_pixel
            ),
        });
    }
    if touches_border(&pixels, level) {
        warnings.push(
            "the damage reaches the image's border and is cut there; it may continue outside"
                .to_owned(),
        );
    }
    let (half_width, half_height) = (0.5 * pixels.width as f64, 0.5 * pixels.height as f64);
    let mut result = Polygons {
        polygons_mm: outlines.rings,
        warnings,
        threshold: found,
    };
    for ring in &mut result.polygons_mm {
        for point in ring.iter_mut() {
            let x = (point[0] - half_width) * options.mm_per_pixel;
            let y = (point[1] - half_height) * options.mm_per_pixel;
            *point = options.rolling_direction.turn(x, y);
        }
        // The outlines run clockwise on the screen.
        ring.reverse();
    }
    if options.center {
        result.centre();
    }
    Ok(result)
}

fn check(options: &ImageOptions) -> Result<(), DamageError> {
    check_range(
        "mm_per_pixel",
        options.mm_per_pixel,
        0.0,
        10.0,
        "a number of mm above 0, at most 10",
    )?;
    if let Some(threshold) = options.threshold {
        check_range(
            "threshold",
            threshold,
            0.0,
            1.0 - f64::EPSILON,
            "a number above 0 and below 1",
        )?;
    }
    let speck = options.speck_mm2;
    check_range(
        "speck_mm2",
        speck,
        -f64::MIN_POSITIVE,
        1e6,
        "an area of 0 mm^2 or more",
    )?;
    if let Smooth::SubPixel { blur_px } = options.smooth {
        check_range(
            "blur_px",
            blur_px,
            -f64::MIN_POSITIVE,
            20.0,
            "0 to 20 pixels",
        )?;
    }
    Ok(())
}

/// The level above which a pixel is damage, and the threshold where it was found.
fn level(
    pixels: &Pixels,
    options: &ImageOptions,
    flip: bool,
    warnings: &mut Vec<String>,
) -> Result<(f64, Option<f64>), DamageError> {
    let given = options.threshold.or(options.use_alpha.then_some(0.5));
    let facing = |level: f64| if flip { 1.0 - level } else { level };
    if let Some(threshold) = given {
        return Ok((FULL * facing(threshold), None));
    }
    let split = otsu(&pixels.values).ok_or_else(|| DamageError::NothingDamaged {
        why: "the image has one brightness only (if the mask is its transparency, set `use_alpha`)"
            .to_owned(),
    })?;
    let shown = facing(split.level / FULL);
    warnings.push(format!("the threshold was found as {shown:.3}"));
    if split.separation < CLEAR_SEPARATION {
        warnings.push(format!(
            "only {:.0} % of the image's contrast is between its dark and light parts; look at the outline before using it",
            100.0 * split.separation
        ));
    }
    Ok((split.level, Some(shown)))
}

fn all_or_nothing(pixels: &Pixels, level: f64) -> Result<(), DamageError> {
    let damaged = pixels
        .values
        .iter()
        .filter(|&&v| f64::from(v) > level)
        .count();
    let advice = "check `threshold`, `invert` and `use_alpha`";
    if damaged == 0 {
        return Err(DamageError::NothingDamaged {
            why: format!("no pixel is on the damage's side of the threshold; {advice}"),
        });
    }
    if damaged == pixels.values.len() {
        return Err(DamageError::AllDamaged {
            why: format!("every pixel is on the damage's side of the threshold; {advice}"),
        });
    }
    Ok(())
}

fn touches_border(pixels: &Pixels, level: f64) -> bool {
    let (w, h) = (pixels.width, pixels.height);
    let damaged = |x: usize, y: usize| f64::from(pixels.values[y * w + x]) > level;
    (0..w).any(|x| damaged(x, 0) || damaged(x, h - 1))
        || (0..h).any(|y| damaged(0, y) || damaged(w - 1, y))
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
