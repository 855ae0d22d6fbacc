//! Which format a file has, by its content; names only confirm.

use std::fmt;

/// A format that a reader here knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A vector drawing.
    Svg,
    /// A PNG image: a photo, a mask, or heights in 16-bit grey.
    Png,
    /// A JPEG photo.
    Jpeg,
    /// Numbers in text.
    Csv,
    /// A NumPy array.
    Npy,
    /// A surface after ISO 25178-71, in text or binary.
    Sdf,
    /// A surface after ISO 5436-2.
    X3p,
    /// A surface of MountainsMap.
    Sur,
}

impl FileKind {
    /// The format that the content shows.
    pub fn of_content(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            return Some(Self::Png);
        }
        if bytes.starts_with(b"\xff\xd8\xff") {
            return Some(Self::Jpeg);
        }
        if bytes.starts_with(b"\x93NUMPY") {
            return Some(Self::Npy);
        }
        if [&b"aISO-1.0"[..], b"bISO-1.0", b"aBCR-1.0", b"bBCR-1.0"].iter().any(|m| bytes.starts_with(m)) {
            return Some(Self::Sdf);
        }
        if bytes.starts_with(b"DIGITAL SURF") || bytes.starts_with(b"DSCOMPRESSED") {
            return Some(Self::Sur);
        }
        if bytes.starts_with(b"PK\x03\x04") && has_main(bytes) {
            return Some(Self::X3p);
        }
        let head = &bytes[..bytes.len().min(4096)];
        let text = match std::str::from_utf8(head) {
            Ok(text) => text,
            // The cut may fall within a character.
            Err(error) if error.error_len().is_none() => {
                std::str::from_utf8(&head[..error.valid_up_to()]).unwrap_or_default()
            }
            Err(_) => return None,
        };
        let text = text.trim_start_matches('\u{feff}').trim_start();
        if text.starts_with('<') {
            return (text.contains("<svg") || text.contains(":svg")).then_some(Self::Svg);
        }
        let plain = |c: char| !c.is_control() || matches!(c, '\n' | '\r' | '\t');
        (!text.is_empty() && text.chars().all(plain)).then_some(Self::Csv)
    }

    /// The format that a file's name claims.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        match extension.to_ascii_lowercase().as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            "jpg" | "jpeg" => Some(Self::Jpeg),
            "csv" | "txt" | "tsv" | "asc" | "xyz" | "dat" => Some(Self::Csv),
            "npy" => Some(Self::Npy),
            "sdf" => Some(Self::Sdf),
            "x3p" => Some(Self::X3p),
            "sur" => Some(Self::Sur),
            _ => None,
        }
    }
}

/// Whether an archive's directory, at its end, names the file that every X3P has.
fn has_main(bytes: &[u8]) -> bool {
    let end = &bytes[bytes.len().saturating_sub(100_000)..];
    end.windows(8).any(|w| w.eq_ignore_ascii_case(b"main.xml"))
}

/// What unknown content looks like, in words.
pub(crate) fn describe(bytes: &[u8]) -> String {
    match FileKind::of_content(bytes) {
        Some(kind) => kind.to_string(),
        None if bytes.is_empty() => "an empty file".to_owned(),
        None if bytes.starts_with(b"PK") => "a zip archive (such as npz or xlsx)".to_owned(),
        None if bytes.starts_with(b"GIF8") => "a GIF image".to_owned(),
        None if bytes.starts_with(b"II*\0") || bytes.starts_with(b"MM\0*") => "a TIFF image".to_owned(),
        None if bytes.starts_with(b"BM") => "a BMP image".to_owned(),
        None if bytes.starts_with(b"%PDF") => "a PDF document".to_owned(),
        None if bytes.get(4..8) == Some(b"ftyp") => "a HEIC or AVIF photo".to_owned(),
        None if bytes.get(8..12) == Some(b"WEBP") => "a WebP image".to_owned(),
        None if bytes.starts_with(&[0x1f, 0x8b]) => "a gzip file (such as svgz; unpack it first)".to_owned(),
        None => "content of an unknown format".to_owned(),
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Svg => "SVG",
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Csv => "CSV",
            Self::Npy => "NPY",
            Self::Sdf => "SDF",
            Self::X3p => "X3P",
            Self::Sur => "SUR",
        })
    }
}
