//! Writers of signals, one file per format; CSV is beside its own reader, in `csv.rs`.

#[cfg(feature = "parquet-write")]
pub(crate) mod parquet;
