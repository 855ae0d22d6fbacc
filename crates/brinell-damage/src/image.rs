//! A photo or a mask, read as outlines of what is damaged.

use crate::blur::gaussian;
use crate::contour::{Field, Outlines};
use crate::direction::turn;
use crate::error::{DamageError, check_range};
use crate::geometry::{Polygons, signed_area};
use crate::pieces::{Piece, pieces};
use crate::pixels::{Channel, Pixels, decode};
use crate::region;
use crate::segment::{Pieces, Wanted, find};
use crate::threshold::otsu;
use brinell::scenario::{ImageEdges, ImageFile, ImagePieces};
use brinell::signal::short;

/// The full scale of a pixel.
const FULL: f64 = 65535.0;
/// Below this share of variance between the two groups, the level found is hardly a boundary.
const CLEAR_SEPARATION: f64 = 0.6;

/// Whether the level is known without looking at the picture.
fn has_level(options: &ImageFile) -> bool {
    options.threshold.is_some() || options.use_alpha
}

/// Which pieces are damage: where nobody says, the largest of a photo; of a mask (alpha, or along pixel edges) or with
/// a stated threshold all.
fn wanted_pieces(options: &ImageFile) -> Pieces {
    let mask = has_level(options) || options.edges == ImageEdges::PixelEdges;
    match (options.at_px, options.pieces) {
        (Some(at), _) => Pieces::At(at),
        (None, Some(ImagePieces::All)) => Pieces::All,
        (None, None) if mask => Pieces::All,
        _ => Pieces::Largest,
    }
}

/// Standard deviation of the blur before, pixels; 0 along pixel edges.
fn blur(options: &ImageFile) -> f64 {
    match options.edges {
        ImageEdges::SubPixel => options.blur_px.unwrap_or(0.0),
        ImageEdges::PixelEdges => 0.0,
    }
}

/// Damage in a picture, and where it lies in it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Traced {
    /// What [`read_image`] gives.
    pub polygons: Polygons,
    /// The same outlines in pixels of the picture as a viewer shows it, from its upper left corner.
    pub rings_px: Vec<Vec<[f64; 2]>>,
    /// Columns and rows of the picture.
    pub size_px: [usize; 2],
}

/// Reads the damaged areas of a PNG or JPEG image (up to 2^26 pixels) as polygons.
///
/// # Errors
/// What is no such image; options outside their range; no damage, or nothing but damage.
pub fn read_image(bytes: &[u8], options: &ImageFile) -> Result<Polygons, DamageError> {
    trace_image(bytes, options).map(|traced| traced.polygons)
}

/// [`read_image`], with the outlines in pixels too.
///
/// # Errors
/// As [`read_image`].
pub fn trace_image(bytes: &[u8], options: &ImageFile) -> Result<Traced, DamageError> {
    check(options)?;
    let channel = if options.use_alpha {
        Channel::Alpha
    } else {
        Channel::Luminance { behind: if options.invert { 0 } else { u16::MAX } }
    };
    let whole = decode(bytes, channel)?;
    let size_px = [whole.width, whole.height];
    let (mut pixels, corner) = region::cut(whole, options.region_px)?;
    if options.edges == ImageEdges::SubPixel {
        gaussian(&mut pixels, blur(options));
    }
    let mut said = Said::default();
    let (pixels, level) = told_apart(pixels, corner, options, &mut said)?;
    let field = Field {
        width: pixels.width,
        height: pixels.height,
        values: &pixels.values,
        level,
        rim: 0.5,
        sub_pixel: options.edges != ImageEdges::PixelEdges,
    };
    let pixel_mm2 = options.mm_per_pixel * options.mm_per_pixel;
    let outlines = field.outlines(options.speck_mm2 / pixel_mm2)?;
    if outlines.rings.is_empty() {
        return Err(too_small(&outlines, options));
    }
    let specks = said.specks + outlines.specks;
    if specks + outlines.filled > 0 {
        said.notes.push(format!(
            "dropped {} and filled {} that enclose less than {} mm^2",
            counted(specks, "speck"),
            counted(outlines.filled, "hole"),
            options.speck_mm2
        ));
    }
    let mut rings = outlines.rings;
    let holes: Vec<f64> = rings.iter().map(|ring| -signed_area(ring)).filter(|area| *area > 0.0).collect();
    if !holes.is_empty() {
        said.notes.push(format!(
            "kept {} in the damage as sound surface, the largest of {} mm^2: where that is a glint, a larger `speck_mm2` fills it",
            counted(holes.len(), "hole"),
            short(holes.iter().fold(0.0, |a: f64, b| a.max(*b)) * pixel_mm2, 2)
        ));
    }
    let border = [pixels.width as f64, pixels.height as f64];
    let cut = |p: &[f64; 2]| p[0] <= 0.0 || p[1] <= 0.0 || p[0] >= border[0] || p[1] >= border[1];
    if rings.iter().flatten().any(cut) {
        said.warnings.push(format!(
            "the damage reaches the {} border and is cut there; it may continue outside",
            if options.region_px.is_some() { "region's" } else { "image's" }
        ));
    }
    for point in rings.iter_mut().flatten() {
        *point = [point[0] + corner[0] as f64, point[1] + corner[1] as f64];
    }
    let mut polygons = Polygons {
        polygons_mm: in_mm(&rings, size_px, options),
        warnings: said.warnings,
        notes: said.notes,
        threshold: said.threshold,
    };
    if options.center {
        polygons.centre();
    }
    Ok(Traced { polygons, rings_px: rings, size_px })
}

/// What there is to say of a picture.
#[derive(Default)]
struct Said {
    warnings: Vec<String>,
    notes: Vec<String>,
    threshold: Option<f64>,
    specks: usize,
}

/// From pixels to mm about the picture's middle.
fn in_mm(rings: &[Vec<[f64; 2]>], size_px: [usize; 2], options: &ImageFile) -> Vec<Vec<[f64; 2]>> {
    let half = size_px.map(|n| 0.5 * n as f64);
    let place = |p: &[f64; 2]| {
        let x = (p[0] - half[0]) * options.mm_per_pixel;
        let y = (p[1] - half[1]) * options.mm_per_pixel;
        turn(options.rolling_direction, x, y)
    };
    // The outlines run clockwise on the screen.
    rings.iter().map(|ring| ring.iter().rev().map(place).collect()).collect()
}

/// The picture with damage above a level, and nothing but the damage that is wanted above it.
fn told_apart(
    mut pixels: Pixels,
    corner: [usize; 2],
    options: &ImageFile,
    said: &mut Said,
) -> Result<(Pixels, f64), DamageError> {
    let wanted = Wanted {
        bright: options.invert,
        pieces: match wanted_pieces(options) {
            Pieces::At([x, y]) => Pieces::At([x - corner[0] as f64, y - corner[1] as f64]),
            other => other,
        },
        smallest: options.speck_mm2 / options.mm_per_pixel.powi(2),
        blur_px: blur(options),
    };
    if !has_level(options) && options.edges != ImageEdges::PixelEdges {
        let all_mm2 = pixels.values.len() as f64 * options.mm_per_pixel.powi(2);
        if all_mm2 < options.speck_mm2 {
            return Err(DamageError::NothingDamaged {
                why: format!(
                    "the whole picture is {all_mm2:.3e} mm^2, less than `speck_mm2` = {}; check `mm_per_pixel` = {}",
                    options.speck_mm2, options.mm_per_pixel
                ),
            });
        }
        let found = find(&pixels, wanted)?;
        let Some(mut found) = found else {
            return Err(no_spall(&pixels, wanted, options));
        };
        let shown = match found.share_of_light {
            Some(share) => share,
            None if options.invert => found.level / FULL,
            None => 1.0 - found.level / FULL,
        };
        match found.share_of_light {
            Some(_) => {
                said.threshold = Some(shown.clamp(0.0, 1.0));
                said.notes.push(format!(
                "the light was evened out; the border is where the brightness is {shown:.3} of that of the sound surface"
                ));
            }
            None => {
                said.threshold = Some(shown);
                said.notes.push(format!("the threshold was found as {shown:.3}"));
            }
        }
        said.specks = found.specks;
        leave_out(&mut found.pixels, &found.left_out, options, said);
        without(&mut found.pixels, found.level, wanted.smallest)?;
        return Ok((found.pixels, found.level));
    }
    // Damage is above the level from here on: what shows through transparent places is sound.
    let flip = options.use_alpha == options.invert;
    if flip {
        pixels.values.iter_mut().for_each(|v| *v = u16::MAX - *v);
    }
    let level = level(&pixels, options, flip, said)?;
    all_or_nothing(&pixels, level)?;
    if wanted.pieces != Pieces::All {
        let (mut all, specks) = pieces(&pixels, level, wanted.smallest.max(1.0))?;
        said.specks = specks;
        take(&mut all, wanted.pieces, options)?;
        leave_out(&mut pixels, &all, options, said);
        without(&mut pixels, level, wanted.smallest)?;
    }
    Ok((pixels, level))
}

/// Takes the piece that is wanted out of all of them.
fn take(all: &mut Vec<Piece>, wanted: Pieces, options: &ImageFile) -> Result<(), DamageError> {
    let place = match wanted {
        Pieces::At(at) => {
            let at = at.map(|v| v.max(0.0) as usize);
            all.iter().position(|piece| piece.holds(at))
        }
        _ => (!all.is_empty()).then_some(0),
    };
    let place = place.ok_or_else(|| DamageError::NoSpall {
        why: match wanted_pieces(options) {
            Pieces::At([x, y]) => {
                format!("no damage lies at `at_px` = [{x}, {y}]; check it, or `threshold`")
            }
            _ => format!("nothing is as large as `speck_mm2` = {} mm^2", options.speck_mm2),
        },
    })?;
    all.remove(place);
    Ok(())
}

/// Takes pieces that are not wanted out of the picture.
fn leave_out(pixels: &mut Pixels, others: &[Piece], options: &ImageFile, said: &mut Said) {
    for run in others.iter().flat_map(|piece| &piece.runs) {
        let start = run.row * pixels.width;
        pixels.values[start + run.from..start + run.to].fill(0);
    }
    if let Some(largest) = others.first() {
        said.notes.push(format!(
            "left out {} besides, of up to {:.3} mm^2 (`pieces = \"all\"` keeps what is damage for certain, `at_px` chooses one)",
            counted(others.len(), "piece"),
            largest.area as f64 * options.mm_per_pixel.powi(2)
        ));
    }
}

/// Takes spots below a size out of the picture, so that none of them counts as the damage's border.
fn without(pixels: &mut Pixels, level: f64, smallest: f64) -> Result<(), DamageError> {
    if smallest <= 1.0 {
        return Ok(());
    }
    let (all, _) = pieces(pixels, level, 1.0)?;
    for run in all.iter().filter(|p| (p.area as f64) < smallest).flat_map(|p| &p.runs) {
        let start = run.row * pixels.width;
        pixels.values[start + run.from..start + run.to].fill(0);
    }
    Ok(())
}

fn too_small(outlines: &Outlines, options: &ImageFile) -> DamageError {
    DamageError::NothingDamaged {
        why: format!(
            "the largest of {} encloses {:.3e} mm^2, less than `speck_mm2` = {}; check `mm_per_pixel` = {}",
            counted(outlines.specks, "spot"),
            outlines.largest_speck * options.mm_per_pixel.powi(2),
            options.speck_mm2,
            options.mm_per_pixel
        ),
    }
}

/// That no piece is a class of its own, with what would help.
fn no_spall(pixels: &Pixels, wanted: Wanted, options: &ImageFile) -> DamageError {
    let (first, last) = pixels.values.iter().fold((u16::MAX, 0), |(a, b), &v| (a.min(v), b.max(v)));
    if first == last {
        return DamageError::NothingDamaged {
            why: "the image has one brightness only (if the mask is its transparency, set `use_alpha`)".to_owned(),
        };
    }
    let word = if wanted.bright { "lighter" } else { "darker" };
    let mut why = match wanted_pieces(options) {
        Pieces::At([x, y]) => {
            format!("nothing at `at_px` = [{x}, {y}] is {word} than the surface around it")
        }
        _ => format!(
            "no piece of `speck_mm2` = {} mm^2 or more is clearly {word} than the surface around it",
            options.speck_mm2
        ),
    };
    let other = Wanted { bright: !wanted.bright, pieces: Pieces::Largest, ..wanted };
    if let Ok(Some(found)) = find(pixels, other) {
        let mm2 = found.chosen[0].area as f64 * options.mm_per_pixel.powi(2);
        why += &format!(
            "; a piece of {mm2:.3} mm^2 is {}: if that is the damage, give `invert = {}`",
            if wanted.bright { "darker" } else { "lighter" },
            !wanted.bright
        );
    } else {
        why += "; if there is one, state `threshold`, or cut the picture with `region_px`";
    }
    DamageError::NoSpall { why }
}

fn check(options: &ImageFile) -> Result<(), DamageError> {
    check_range("mm_per_pixel", options.mm_per_pixel, 0.0, 10.0, "a number of mm above 0, at most 10")?;
    if let Some(threshold) = options.threshold {
        check_range("threshold", threshold, 0.0, 1.0 - f64::EPSILON, "a number above 0 and below 1")?;
    }
    let speck = options.speck_mm2;
    check_range("speck_mm2", speck, -f64::MIN_POSITIVE, 1e6, "an area of 0 mm^2 or more")?;
    check_range("blur_px", blur(options), -f64::MIN_POSITIVE, 20.0, "0 to 20 pixels")
}

/// The level above which a pixel is damage: as stated, that of alpha, or Otsu's.
fn level(pixels: &Pixels, options: &ImageFile, flip: bool, said: &mut Said) -> Result<f64, DamageError> {
    let given = options.threshold.or(options.use_alpha.then_some(0.5));
    let facing = |level: f64| if flip { 1.0 - level } else { level };
    if let Some(threshold) = given {
        return Ok(FULL * facing(threshold));
    }
    let split = otsu(&pixels.values).ok_or_else(|| DamageError::NothingDamaged {
        why: "the image has one brightness only (if the mask is its transparency, set `use_alpha`)".to_owned(),
    })?;
    let shown = facing(split.level / FULL);
    said.notes.push(format!("the threshold was found as {shown:.3}"));
    said.threshold = Some(shown);
    if split.separation < CLEAR_SEPARATION {
        said.warnings.push(format!(
            "only {:.0} % of the image's contrast is between its dark and light parts; look at the outline before using it",
            100.0 * split.separation
        ));
    }
    Ok(split.level)
}

fn all_or_nothing(pixels: &Pixels, level: f64) -> Result<(), DamageError> {
    let damaged = pixels.values.iter().filter(|&&v| f64::from(v) > level).count();
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

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
