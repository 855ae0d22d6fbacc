//! The few files of a zip archive that a reader asks for; sizes are checked before anything is unpacked.

use super::broken;
use crate::error::DamageError;
use crate::kind::FileKind;
use std::io::{Cursor, Read};
use zip::ZipArchive;

const KIND: FileKind = FileKind::X3p;

/// An archive's directory.
pub(super) struct Archive<'a>(ZipArchive<Cursor<&'a [u8]>>);

impl<'a> Archive<'a> {
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, DamageError> {
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|e| broken(KIND, "its archive", e.to_string()))?;
        Ok(Self(archive))
    }

    /// Unpacks a file of at most `largest` bytes.
    pub(super) fn file(&mut self, name: &str, largest: usize) -> Result<Vec<u8>, DamageError> {
        let fault = |why: String| broken(KIND, name, why);
        let wanted = plain(name);
        let stored = self.0.file_names().find_map(|stored| stored.ok().filter(|stored| plain(stored) == wanted));
        let stored = stored.ok_or_else(|| fault("it is missing".into()))?.into_owned();
        let file = self.0.by_name(&stored).map_err(|e| fault(e.to_string()))?;
        let size = file.size();
        if size > largest as u64 {
            return Err(DamageError::TooLarge {
                what: "a file of the archive",
                value: format!("{size} bytes"),
                limit: format!("{largest} bytes"),
                way_out: "cut out the damage or thin the scan out",
            });
        }
        let mut unpacked = Vec::new();
        // What the directory says of its size may be wrong.
        file.take(size + 1).read_to_end(&mut unpacked).map_err(|e| fault(e.to_string()))?;
        match unpacked.len() as u64 == size {
            true => Ok(unpacked),
            false => Err(fault(format!("it does not hold the {size} bytes that the directory says"))),
        }
    }
}

/// A name to compare: forward slashes, lower case, from the archive's root.
fn plain(name: &str) -> String {
    let name = name.replace('\\', "/").to_ascii_lowercase();
    name.trim_start_matches("./").trim_start_matches('/').to_owned()
}
