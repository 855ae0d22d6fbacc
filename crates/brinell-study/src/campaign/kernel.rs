//! Runs of one kernel: a folder that others computed is not gone on with.

use brinell::kernel::Kernel;
use std::fmt::Display;

/// Name of the instructions that this process computes with.
pub(crate) fn kernel() -> &'static str {
    Kernel::chosen().map_or("", Kernel::name)
}

/// That runs between kernels are no longer the same runs.
pub(crate) const DIFFER: &str = "runs differ wholly between kernels, as impacts amplify round-off";

/// That `one` (a data set, a sweep) in `at` holds runs of another kernel, with words for what to do.
pub(crate) fn other_kernel(at: impl Display, one: &str, theirs: &str, mine: &str) -> String {
    format!(
        "{at} holds runs of the kernel {theirs}, and these are of {mine}: {DIFFER}, so one {one} has one kernel; set \
         BRINELL_KERNEL={theirs} on every machine that makes it, or choose another folder"
    )
}
