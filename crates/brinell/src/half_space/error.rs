//! Why a table is not made.

use crate::effective::table::TableError;

/// Why there is no table.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// Nothing to build from.
    #[error("{what} is {value:e} m; it must be finite and above 0")]
    NotPositive {
        /// What.
        what: &'static str,
        /// Its value, m.
        value: f64,
    },
    /// It has to be made first.
    #[error("not made yet")]
    NotAtHand,
    /// The flag was set.
    #[error("stopped before its end")]
    Stopped,
    /// It would take more memory than a table may.
    #[error(
        "at a deformation of {:.2} um a table of {:.1} mm of it fills the memory that one may take, of damage as ragged as this one",
        1e6 * delta, 1e3 * reached
    )]
    TooFine {
        /// Its length along the surface that fills that memory, m.
        reached: f64,
        /// The deformation, m.
        delta: f64,
    },
    /// The solutions make no table.
    #[error(transparent)]
    Table(#[from] TableError),
}
