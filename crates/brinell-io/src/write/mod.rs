//! Writers of signals, one file per format.

pub(crate) mod csv;
pub(crate) mod mat;
#[cfg(feature = "npz")]
pub(crate) mod npz;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
#[cfg(feature = "parquet")]
pub(crate) mod records;
mod spool;
pub(crate) mod uff;
pub(crate) mod wav;
