//! PNG and JPEG to one number per pixel, row by row, with the size checked before anything is decoded.

use std::io::Cursor;

use png::{ColorType, Transformations};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::error::DamageError;
use crate::kind::{FileKind, describe};
use crate::scan::{MAX_POINTS, Raw};

/// The largest image that is read: 8192 x 8192, at two bytes a pixel.
pub(crate) const MAX_PIXELS: u64 = 1 << 26;
/// Pixels along a side: one line of pixels encloses nothing, and JPEG has no longer sides.
const SIDES: std::ops::RangeInclusive<u64> = 2..=65_535;
/// What an image and the frame that it is decoded into may take, for formats that are not decoded row by row.
const MOST_BYTES: u64 = 192_000_000;
/// What a PNG decoder may take for itself, beside the picture.
const PNG_BYTES: usize = 64 << 20;

/// What to take of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Channel {
    /// Luminance; where the picture is transparent, this value shows through.
    Luminance { behind: u16 },
    /// Opacity.
    Alpha,
}

/// One number per pixel, 0 to 65535, first row on top.
#[derive(Clone)]
pub(crate) struct Pixels {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<u16>,
}

/// A picture that is filled row by row, each pixel going where a viewer shows it after the EXIF orientation.
struct Canvas {
    pixels: Pixels,
    /// Where pixel (0, 0) of the file goes, and by how much a column and a row of the file move on.
    origin: isize,
    column: isize,
    row: isize,
}

impl Canvas {
    /// For a file of `width` x `height` pixels with the EXIF orientation `turn`.
    fn new(width: usize, height: usize, turn: u8) -> Self {
        let (w, h) = (width as isize, height as isize);
        let (origin, column, row) = match turn {
            2 => (w - 1, -1, w),
            3 => (w * h - 1, -1, -w),
            4 => (w * (h - 1), 1, -w),
            5 => (0, h, 1),
            6 => (h - 1, h, -1),
            7 => (w * h - 1, -h, -1),
            8 => (h * (w - 1), -h, 1),
            _ => (0, 1, w),
        };
        let values = vec![0; width * height];
        let (width, height) = if turn >= 5 { (height, width) } else { (width, height) };
        Self { pixels: Pixels { width, height, values }, origin, column, row }
    }

    /// Row `y` of the file.
    fn put(&mut self, y: usize, row: impl Iterator<Item = u16>) {
        let mut at = self.origin + self.row * y as isize;
        for value in row {
            if let Some(pixel) = self.pixels.values.get_mut(at as usize) {
                *pixel = value;
            }
            at += self.column;
        }
    }
}

/// Decodes PNG or JPEG, upright.
pub(crate) fn decode(bytes: &[u8], channel: Channel) -> Result<Pixels, DamageError> {
    match FileKind::of_content(bytes) {
        Some(FileKind::Png) => decode_png(bytes, channel),
        Some(FileKind::Jpeg) => decode_jpeg(bytes, channel),
        _ => {
            Err(DamageError::WrongKind { what: describe(bytes), wanted: "an image", way_out: "save it as PNG or JPEG" })
        }
    }
}

/// That a picture of two bytes a pixel fits beside the `frame` bytes that it is decoded into.
fn check_frame(what: &'static str, width: usize, height: usize, frame: u64) -> Result<(), DamageError> {
    let bytes = frame.saturating_add(2 * (width * height) as u64);
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    Err(DamageError::TooLarge {
        what,
        value: format!("{width} x {height} pixels, {} MB to decode", bytes / 1_000_000),
        limit: format!("{} MB", MOST_BYTES / 1_000_000),
        way_out: "save it neither interlaced nor progressive, cut out the damage, or scale the image down and adapt the spacing",
    })
}

fn check_size(kind: FileKind, width: u64, height: u64) -> Result<(), DamageError> {
    if !SIDES.contains(&width) || !SIDES.contains(&height) {
        return Err(DamageError::Unsupported {
            at: format!("this {kind} file"),
            what: format!("an image of {width} x {height} pixels"),
            way_out: "each side has 2 to 65535 pixels; cut out the damage, or scale the image and adapt the spacing",
        });
    }
    if width * height <= MAX_PIXELS {
        return Ok(());
    }
    Err(DamageError::TooLarge {
        what: "the image",
        value: format!("{width} x {height} pixels"),
        limit: format!("{MAX_PIXELS} pixels (8192 x 8192)"),
        way_out: "cut out the damage or scale the image down, and adapt the spacing",
    })
}

fn broken(kind: FileKind, at: &str, why: impl ToString) -> DamageError {
    DamageError::Broken { kind, at: at.to_owned(), why: why.to_string() }
}

fn decode_png(bytes: &[u8], channel: Channel) -> Result<Pixels, DamageError> {
    let mut canvas: Option<Canvas> = None;
    let (mut plain, mut y) = (false, 0);
    png_rows(bytes, |sheet, row, samples, wide| {
        let pixel = |sample: usize| -> u16 {
            if wide { u16::from_be_bytes([row[2 * sample], row[2 * sample + 1]]) } else { u16::from(row[sample]) * 257 }
        };
        let step = if wide { 2 * samples } else { samples };
        plain |= channel == Channel::Alpha && samples % 2 == 1;
        let canvas = canvas.get_or_insert_with(|| Canvas::new(sheet.width, sheet.height, sheet.turn));
        let row = (0..row.len() / step).map(|x| {
            let at = |i: usize| pixel(x * samples + i);
            let grey = || match samples {
                1 | 2 => at(0),
                _ => luminance(at(0), at(1), at(2)),
            };
            let alpha = if samples % 2 == 0 { at(samples - 1) } else { u16::MAX };
            match channel {
                Channel::Alpha => alpha,
                Channel::Luminance { behind } => over(grey(), alpha, behind),
            }
        });
        canvas.put(y, row);
        y += 1;
    })?;
    match canvas {
        Some(canvas) if !plain => Ok(canvas.pixels),
        _ => Err(no_alpha(FileKind::Png)),
    }
}

fn no_alpha(kind: FileKind) -> DamageError {
    DamageError::Unsupported {
        at: format!("this {kind} file"),
        what: "`use_alpha` without an alpha channel".to_owned(),
        way_out: "leave `use_alpha` out, or save the mask as a PNG with transparency",
    }
}

/// Rec. 709 weights on the encoded values, in 1/65536.
fn luminance(r: u16, g: u16, b: u16) -> u16 {
    let sum = 13_933 * u64::from(r) + 46_871 * u64::from(g) + 4_732 * u64::from(b);
    (sum >> 16) as u16
}

fn over(value: u16, alpha: u16, behind: u16) -> u16 {
    let full = u64::from(u16::MAX);
    let alpha = u64::from(alpha);
    ((u64::from(value) * alpha + u64::from(behind) * (full - alpha)) / full) as u16
}

/// Size of a decoded PNG and the EXIF turn that shows it upright.
pub(crate) struct Sheet {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) turn: u8,
    /// Bits of a sample in the file.
    pub(crate) bits: u8,
}

/// Gives `take` every row from the top: the sheet, the row's bytes, samples per pixel, and whether a sample has two
/// bytes.
pub(crate) fn png_rows(bytes: &[u8], mut take: impl FnMut(&Sheet, &[u8], usize, bool)) -> Result<Sheet, DamageError> {
    let fault = |at: &str, error: png::DecodingError| broken(FileKind::Png, at, error);
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: PNG_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let info = decoder.read_header_info().map_err(|e| fault("its header", e))?;
    check_size(FileKind::Png, u64::from(info.width), u64::from(info.height))?;
    let mut reader = decoder.read_info().map_err(|e| fault("its header", e))?;
    let (color, depth) = reader.output_color_type();
    let samples = match color {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb => 3,
        ColorType::Rgba => 4,
        ColorType::Indexed => return Err(broken(FileKind::Png, "its palette", "not expanded")),
    };
    let wide = depth == png::BitDepth::Sixteen;
    let info = reader.info();
    let sheet = Sheet {
        width: info.width as usize,
        height: info.height as usize,
        turn: info.exif_metadata.as_deref().map_or(1, exif_orientation),
        bits: info.bit_depth as u8,
    };
    if info.interlaced {
        let size = reader.output_buffer_size().unwrap_or(usize::MAX);
        check_frame("the interlaced image", sheet.width, sheet.height, size as u64)?;
        let mut frame = vec![0; size];
        let line = reader.next_frame(&mut frame).map_err(|e| fault("its pixels", e))?.line_size;
        for row in frame.chunks_exact(line.max(1)).take(sheet.height) {
            take(&sheet, row, samples, wide);
        }
    } else {
        for y in 0..sheet.height {
            let at = || format!("pixel row {}", y + 1);
            match reader.next_row().map_err(|e| fault(&at(), e))? {
                Some(row) => take(&sheet, row.data(), samples, wide),
                None => return Err(broken(FileKind::Png, &at(), "it ends here")),
            }
        }
    }
    Ok(sheet)
}

/// The grey levels of a PNG as numbers; transparent points are missing.
pub(crate) fn heights(bytes: &[u8]) -> Result<Raw, DamageError> {
    let mut raw = Raw::default();
    let mut colour = false;
    let sheet = png_rows(bytes, |_, row, samples, wide| {
        colour |= samples > 2;
        if colour {
            return;
        }
        let size = if wide { 2 } else { 1 };
        raw.values.extend(row.chunks_exact(samples * size).map(|pixel| {
            let sample = |i: usize| match pixel[i * size..] {
                [high, low, ..] if wide => u16::from_be_bytes([high, low]),
                [value, ..] => u16::from(value),
                [] => 0,
            };
            if samples == 2 && sample(1) == 0 { f64::NAN } else { f64::from(sample(0)) }
        }));
    })?;
    if colour {
        return Err(DamageError::Unsupported {
            at: "this PNG file".to_owned(),
            what: "a colour picture as a depth map".to_owned(),
            way_out: "save the heights as 16-bit grey, or read it with `image` as an outline",
        });
    }
    (raw.width, raw.height) = (sheet.width, sheet.height);
    if raw.values.len() > MAX_POINTS {
        return Err(Raw::too_large(format!("{} x {}", raw.width, raw.height)));
    }
    if sheet.bits < 16 {
        raw.warnings.push(format!("the PNG has {} bits: {} steps of depth at most", sheet.bits, 1_u32 << sheet.bits));
    }
    Ok(raw)
}

fn decode_jpeg(bytes: &[u8], channel: Channel) -> Result<Pixels, DamageError> {
    if channel == Channel::Alpha {
        return Err(no_alpha(FileKind::Jpeg));
    }
    let options = DecoderOptions::default()
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX))
        .jpeg_set_out_colorspace(ColorSpace::Luma)
        // A photo that is cut off must not pass as one with a grey lower half.
        .set_strict_mode(true);
    let mut decoder = JpegDecoder::new_with_options(Cursor::new(bytes), options);
    let fault = |at: &str, error| broken(FileKind::Jpeg, at, format!("{error:?}"));
    decoder.decode_headers().map_err(|e| fault("its header", e))?;
    let info = decoder.info().ok_or_else(|| broken(FileKind::Jpeg, "its header", "no size"))?;
    let (width, height) = (usize::from(info.width), usize::from(info.height));
    check_size(FileKind::Jpeg, width as u64, height as u64)?;
    // Of a progressive file the decoder holds two bytes a pixel and component; its type for that has no public name.
    let held = match format!("{:?}", info.sof).starts_with("Progressive") {
        true => 2 * u64::from(info.components).max(1) - 1,
        false => 1,
    };
    check_frame("the JPEG", width, height, held * (width * height) as u64)?;
    let grey = decoder.decode().map_err(|e| fault("its pixels", e))?;
    if grey.len() != width * height {
        return Err(broken(FileKind::Jpeg, "its pixels", "its colours cannot be read as grey; save it as PNG"));
    }
    let turn = decoder.exif().map_or(1, |exif| exif_orientation(exif));
    let mut canvas = Canvas::new(width, height, turn);
    for (y, row) in grey.chunks_exact(width).enumerate() {
        canvas.put(y, row.iter().map(|&v| u16::from(v) * 257));
    }
    Ok(canvas.pixels)
}

/// The EXIF orientation, 1 to 8; 1 where there is none.
fn exif_orientation(exif: &[u8]) -> u8 {
    orientation_entry(exif).filter(|v| (1..=8).contains(v)).unwrap_or(1)
}

fn orientation_entry(exif: &[u8]) -> Option<u8> {
    const ORIENTATION: u16 = 0x0112;
    let exif = exif.strip_prefix(b"Exif\0\0").unwrap_or(exif);
    let little = match exif.get(..2)? {
        b"II" => true,
        b"MM" => false,
        _ => return None,
    };
    let short = |at: usize| -> Option<u16> {
        let b: [u8; 2] = exif.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if little { u16::from_le_bytes(b) } else { u16::from_be_bytes(b) })
    };
    let long: [u8; 4] = exif.get(4..8)?.try_into().ok()?;
    let first = if little { u32::from_le_bytes(long) } else { u32::from_be_bytes(long) } as usize;
    let entries = usize::from(short(first)?);
    for entry in 0..entries {
        let at = first.checked_add(2 + 12 * entry)?;
        if short(at)? == ORIENTATION {
            return u8::try_from(short(at.checked_add(8)?)?).ok();
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_exif_orientation_shows_the_letter_f_upright() {
        // The stored rows of an F after Adam Kennedy's well-known table, for orientations 1 to 8.
        const UPRIGHT: [&str; 5] = ["111", "100", "110", "100", "100"];
        let stored: [&[&str]; 8] = [
            &["111", "100", "110", "100", "100"],
            &["111", "001", "011", "001", "001"],
            &["001", "001", "011", "001", "111"],
            &["100", "100", "110", "100", "111"],
            &["11111", "10100", "10000"],
            &["10000", "10100", "11111"],
            &["00001", "00101", "11111"],
            &["11111", "00101", "00001"],
        ];
        for (turn, rows) in (1..).zip(stored) {
            let mut canvas = Canvas::new(rows[0].len(), rows.len(), turn);
            for (y, row) in rows.iter().enumerate() {
                canvas.put(y, row.bytes().map(|b| u16::from(b - b'0')));
            }
            let shown = canvas.pixels;
            let text: String = shown.values.iter().map(u16::to_string).collect();
            assert_eq!((shown.width, text), (3, UPRIGHT.concat()), "orientation {turn}");
        }
    }

    #[test]
    fn analytic_exif_orientation_is_found_in_both_byte_orders() {
        let little = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0";
        let big = b"Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x08\0\0";
        assert_eq!(exif_orientation(little), 6);
        assert_eq!(exif_orientation(big), 8);
        assert_eq!(exif_orientation(b"II*\0\xff\xff\xff\xff"), 1);
    }
}
