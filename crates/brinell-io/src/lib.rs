//! Signals in and out of files.
//!
//! A writer takes rows one at a time and streams them: its memory does not grow with the number of rows beyond
//! a few bytes per megabyte written. A file appears whole or not at all: rows go to `NAME.partial` beside it,
//! which [`SignalWriter::finish`] forces to the disk and renames to `NAME`. A writer dropped before that removes
//! its partial file; only a killed process leaves one behind, and the next run of the same name replaces it.
//!
//! ```
//! use brinell_io::{Column, Format, Metadata, Outcome};
//!
//! # let folder = tempfile::tempdir()?;
//! # let folder = folder.path();
//! let columns = [
//!     Column::new("t", "s", "time"),
//!     Column::new("outer_ax", "m/s^2", "outer ring, acceleration along x"),
//! ];
//! let mut writer = Format::Csv.create(folder, &columns, &Metadata::default())?;
//! writer.write_row(&[0.0, 1.5])?;
//! let path = writer.finish(Outcome::Complete)?;
//! assert_eq!(std::fs::read_to_string(path)?, "t,outer_ax\n0.0,1.5\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`open`] reads what others measured: it finds the format from the content, lists the channels with the unit and the
//! sample rate that the file states, and then streams one of them as `f64`.
//!
//! ```
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("run.csv");
//! std::fs::write(&path, "time [s];acc [g]\n0,0;1,5\n0,1;-2,25\n")?;
//! let mut file = brinell_io::open(&path)?;
//! assert_eq!(file.channels()[1].unit.as_deref(), Some("g"));
//! assert_eq!(file.channels()[1].rate, None);
//! assert_eq!(file.read("acc [g]")?, [1.5, -2.25]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Without a file system, as in a browser, [`open_bytes`] reads and [`Format::in_memory`] writes: the same readers and
//! writers, the same bytes. For `wasm32-unknown-unknown` leave out the feature `parquet`, which needs a
//! C compiler.

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod atomic;
mod error;
mod file_kind;
mod format;
mod journal;
mod read;
#[cfg(feature = "parquet")]
mod records;
mod signals;
mod table;
mod text;
mod write;

#[doc(hidden)]
pub use atomic::{Complete, atomic_copy, atomic_prepare, atomic_write, lock};
pub use error::{IoError, why_unread};
pub use file_kind::FileKind;
pub use format::{Format, MemoryWriter};
#[doc(hidden)]
pub use journal::Journal;
#[cfg(feature = "parquet")]
#[doc(hidden)]
pub use read::records::{each_record, read_records};
pub use read::{Channel, NoRate, NoTimes, NotNamed, Rate, RateSource, SignalFile, open, open_bytes, seconds_in};
#[doc(hidden)]
pub use read::{MAX_VALUES, Number, names, npy_entry, npy_number, npy_sides, npy_tuple, npy_word};
#[cfg(feature = "parquet")]
#[doc(hidden)]
pub use records::{Cell, Kind, RecordColumn, hexadecimal, read_row_file, sha256_of, write_row_file};
#[doc(hidden)]
pub use signals::keys;
pub use signals::{Column, Metadata, Outcome, SignalWriter, run_table};
#[doc(hidden)]
pub use table::{Cells, Table};
#[doc(hidden)]
pub use text::{LARGEST_TEXT, read_text};
#[doc(hidden)]
pub use write::csv::CsvWriter;
#[cfg(feature = "parquet")]
#[doc(hidden)]
pub use write::parquet::ParquetWriter;
#[cfg(feature = "parquet")]
#[doc(hidden)]
pub use write::records::{RecordFacts, RecordWriter, Written, record_facts};
