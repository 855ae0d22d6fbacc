//! Data sets: a plan to Parquet files of labelled signals with ground truth.
//!
//! A [`Campaign`] is a plan with its base scenario. [`run`] does a [`Shard`] of it into a folder: each finished run
//! goes to the disk whole, and as soon as all runs of a file are there, they become that file. The same files come out,
//! byte for byte, whatever the threads, the shards and the interruptions, of one version and one kernel; what is there already is not touched.
//! [`merge`] joins folders in which shards ran apart, [`verify`] checks one.
//!
//! In a folder:
//!
//! | path | what |
//! | --- | --- |
//! | `runs/part-00000.parquet`, ... | one row a run, in their order |
//! | `truth/part-00000.parquet`, ... | of the same rows what tells the label, or no sensor tells |
//! | `held_out/part-00000.parquet`, ... | labels and truth of the runs whose labels the plan holds out |
//! | `dataset.json` | geometry, units, rate, licence, columns, checksums; written when all files are there |
//! | `README.md`, `croissant.json` | the data set's card, as Hugging Face and other tools read it |
//! | `bearing_datasets/` | what the Python package bearing-datasets builds its form of the data set with |
//! | `work/` | which campaign it is, a checksum for each file, finished runs of unfinished files |

mod about;
mod baseline;
mod bearing_datasets;
mod campaign;
mod card;
mod columns;
mod document;
mod error;
mod folder;
mod history_sheet;
mod merge;
mod part;
mod pressures;
mod refusal;
mod run;
mod scenario_of;
mod sheet;
mod sidecar;
mod signals;
mod simulated;
mod tally;
mod truth;
mod verify;

pub use campaign::Campaign;
pub use columns::{DataColumn, Table};
pub use error::DatasetError;
pub use history_sheet::{HistorySheet, SheetSnapshot, Size, WholeSignal, history};
pub use merge::{Merged, merge};
pub use run::{Shard, ShardSummary, run};
pub use scenario_of::scenario_of;
pub use sheet::{Sheet, SheetClass, SheetDefect, SheetRun, sheet};
pub use tally::Tally;
pub use verify::{Verified, verify};
