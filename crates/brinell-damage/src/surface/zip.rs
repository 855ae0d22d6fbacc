//! The few files of a zip archive that a reader asks for: stored or deflated, sizes checked before anything is
//! unpacked.

use super::broken;
use crate::bytes::{u16, u32};
use crate::error::DamageError;
use crate::kind::FileKind;

const KIND: FileKind = FileKind::X3p;
/// Files of an archive that are looked at.
const MOST_FILES: usize = 1000;
/// The end record with the longest comment.
const END: usize = 22 + 65_535;

/// An archive's directory.
pub(super) struct Archive<'a> {
    bytes: &'a [u8],
    files: Vec<File>,
}

struct File {
    name: String,
    method: u16,
    packed: usize,
    size: usize,
    header: usize,
}

impl<'a> Archive<'a> {
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, DamageError> {
        let lost = || broken(KIND, "its archive", "its directory is not where it should be");
        let from = bytes.len().saturating_sub(END);
        let end = bytes[from..].windows(4).rposition(|w| w == b"PK\x05\x06").ok_or_else(lost)?;
        let end = &bytes[from + end..];
        let count = usize::from(u16(end, 10).ok_or_else(lost)?).min(MOST_FILES);
        let mut at = u32(end, 16).ok_or_else(lost)? as usize;
        let mut files = Vec::new();
        for _ in 0..count {
            let entry = bytes.get(at..).filter(|b| b.starts_with(b"PK\x01\x02")).ok_or_else(lost)?;
            let length = |place: usize| u16(entry, place).map(usize::from).ok_or_else(lost);
            let size = |place: usize| u32(entry, place).map(|n| n as usize).ok_or_else(lost);
            let (name, extra, comment) = (length(28)?, length(30)?, length(32)?);
            let name_bytes = entry.get(46..46 + name).ok_or_else(lost)?;
            files.push(File {
                name: plain(&String::from_utf8_lossy(name_bytes)),
                method: u16(entry, 10).ok_or_else(lost)?,
                packed: size(20)?,
                size: size(24)?,
                header: size(42)?,
            });
            at = at.saturating_add(46 + name + extra + comment);
        }
        Ok(Self { bytes, files })
    }

    /// Unpacks a file of at most `largest` bytes.
    pub(super) fn file(&self, name: &str, largest: usize) -> Result<Vec<u8>, DamageError> {
        let fault = |why: &str| broken(KIND, name, why);
        let wanted = plain(name);
        let file = self.files.iter().find(|f| f.name == wanted).ok_or_else(|| fault("it is missing"))?;
        let lost = || fault("it is not where the directory says");
        if file.size > largest {
            return Err(DamageError::TooLarge {
                what: "a file of the archive",
                value: format!("{} bytes", file.size),
                limit: format!("{largest} bytes"),
                way_out: "cut out the damage or thin the scan out",
            });
        }
        let local = self.bytes.get(file.header..).filter(|b| b.starts_with(b"PK\x03\x04")).ok_or_else(lost)?;
        let length = |place: usize| u16(local, place).map(usize::from).ok_or_else(lost);
        let start = 30 + length(26)? + length(28)?;
        let end = start.checked_add(file.packed).ok_or_else(lost)?;
        let packed = local.get(start..end).ok_or_else(|| fault("it is cut off"))?;
        match file.method {
            0 => Ok(packed.to_vec()),
            8 => miniz_oxide::inflate::decompress_to_vec_with_limit(packed, file.size)
                .map_err(|e| fault(&format!("{:?}", e.status))),
            _ => Err(fault("it is packed in another way than deflate")),
        }
    }
}

/// A name to compare: forward slashes, lower case, from the archive's root.
fn plain(name: &str) -> String {
    let name = name.replace('\\', "/").to_ascii_lowercase();
    name.trim_start_matches("./").trim_start_matches('/').to_owned()
}
