//! Many runs with a journal: what is finished is on the disk, and is not run again.
//!
//! A [`Ledger`] is the journal of a folder. [`run()`] makes the runs of [`Task`]s; a [`Work`] says what their scenarios
//! are and what is kept of them. [`GridPoints`] reads the points of a grid; [`estimate`] tries a few
//! for what they will cost.

mod cost;
mod grid_points;
mod ledger;
mod recorder;
mod run;

#[doc(hidden)]
pub use cost::{Forecast, estimate, forecast, mean_pace};
pub use grid_points::{GridPoints, State};
#[doc(hidden)]
pub use ledger::JOURNAL;
pub use ledger::{Kept, Ledger};
#[doc(hidden)]
pub use recorder::{Make, Recorder};
pub use run::{Beside, Task, Work, run, to_run};
pub(crate) use run::{observed, side_by_side};

use crate::campaign::other_kernel;
use brinell_io::IoError;
use serde_json::Value;

/// Why runs cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum RunnerError {
    /// The folder's journal is of something else: what its head says, or null.
    #[error("the folder holds the journal of something else")]
    OtherCampaign(Value),
    /// Another kernel computed the folder's finished points.
    #[error("{}", other_kernel("the folder", .one, .theirs, .mine))]
    OtherKernel {
        /// What the folder holds.
        one: &'static str,
        /// The kernel of its points.
        theirs: String,
        /// The kernel of this process.
        mine: &'static str,
    },
    /// A scenario is no longer what it was.
    #[error(
        "a file of the scenario changed since the campaign began; the same command begins anew with what it holds now"
    )]
    Changed,
    /// A file cannot be written or read.
    #[error(transparent)]
    Io(#[from] IoError),
}
