//! What the readers of all formats give.

use super::channel::Channel;
use super::fault::Fault;
use super::numbers::Sink;
use crate::Metadata;

/// What a format's reader gives.
pub(super) struct Listing {
    pub(super) channels: Vec<Channel>,
    pub(super) metadata: Metadata,
    pub(super) source: Box<dyn Source>,
}

/// A format's way to the values of a channel.
pub(super) trait Source: Send {
    /// Hands on every value of the channel of this index, in the file's order.
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault>;

    /// Whether what is no number in a text file is handed on as missing.
    fn set_lenient(&mut self, _lenient: bool) {}

    /// The line of a text file with a value of a channel (from 0), counted from 1, and what is written there.
    fn cell(&mut self, _index: usize, _value: u64) -> Option<(u64, String)> {
        None
    }
}
