//! Which set of laws holds where a file does not say.

use super::choices::{Laws, ModelKind};

impl Laws {
    /// The set of a file that names none: the one place that decides it.
    pub const DEFAULT: Laws = Laws::Mechanics;

    /// The same of a file with these equations: the lumped model is the paper's.
    pub fn default_of(model: ModelKind) -> Laws {
        match model {
            ModelKind::Lumped => Laws::Li2023,
            ModelKind::Full | ModelKind::Tilting => Laws::DEFAULT,
        }
    }
}
