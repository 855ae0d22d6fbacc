//! Whether a file is what its name claims.

use crate::error::DamageError;
use crate::kind::{FileKind, describe};

impl FileKind {
    /// The format of `bytes`, which must not contradict `name`. A name without a known extension claims nothing.
    pub fn check(name: &str, bytes: &[u8]) -> Result<Self, DamageError> {
        let found = Self::of_content(bytes);
        match (Self::of_name(name), found) {
            (Some(expected), found) => expected.confirm(found),
            (None, Some(found)) => Ok(found),
            (None, None) => Err(DamageError::WrongKind {
                what: describe(bytes),
                wanted: "damage",
                way_out: "give an SVG, PNG, JPEG, CSV, NPY, SDF, X3P or SUR file",
            }),
        }
    }

    pub(crate) fn confirm(self, found: Option<Self>) -> Result<Self, DamageError> {
        if found == Some(self) {
            return Ok(self);
        }
        Err(DamageError::NotWhatItsNameSays { expected: self, found })
    }
}
