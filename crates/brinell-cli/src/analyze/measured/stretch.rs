//! Samples out of a file: a stretch, or all of a long signal in bounded memory.

use super::{MOST, bad};
use crate::failure::Failure;
use brinell::signal::Moments;
use brinell_io::SignalFile;
use std::ops::ControlFlow;

/// Up to `most` samples after the first `skip`, and whether there are more.
pub(super) fn stretch(
    file: &mut SignalFile,
    name: &str,
    skip: usize,
    most: usize,
) -> Result<(Vec<f64>, bool), Failure> {
    let (mut values, mut passed, mut more) = (Vec::new(), 0, false);
    file.read_pieces(name, |piece| {
        let from = skip.saturating_sub(passed).min(piece.len());
        passed += piece.len();
        let room = most - values.len();
        let rest = &piece[from..];
        more = rest.len() > room;
        values.extend_from_slice(&rest[..rest.len().min(room)]);
        if more {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .map_err(bad)?;
    Ok((values, more))
}

/// What lies beyond the first [`MOST`] samples of a long signal.
pub(crate) struct Rest {
    /// Samples of the whole, from the first one analysed on.
    pub(crate) samples: u64,
    /// Their moments.
    pub(crate) moments: Moments,
    /// Those that are not finite numbers.
    pub(crate) missing: u64,
    /// The last [`MOST`] samples that do not belong to the first, or as many as there are.
    pub(crate) last: Vec<f64>,
    /// Where those begin, s.
    pub(crate) last_start: f64,
}

/// All samples after the first `skip`, in one pass: the first [`MOST`] of them, and what lies beyond.
pub(super) fn whole(
    file: &mut SignalFile,
    name: &str,
    skip: usize,
    rate: f64,
) -> Result<(Vec<f64>, Option<Rest>), Failure> {
    let (mut first, mut passed) = (Vec::new(), 0);
    let mut rest = Rest {
        samples: 0,
        moments: Moments::new(),
        missing: 0,
        last: Vec::new(),
        last_start: 0.0,
    };
    // A ring; `at` is its oldest sample once it is full.
    let mut at = 0;
    file.read_pieces(name, |piece| {
        let from = skip.saturating_sub(passed).min(piece.len());
        passed += piece.len();
        for value in &piece[from..] {
            rest.samples += 1;
            if value.is_finite() {
                rest.moments.push(*value);
            } else {
                rest.missing += 1;
            }
            if first.len() < MOST {
                first.push(*value);
            } else if rest.last.len() < MOST {
                rest.last.push(*value);
            } else {
                rest.last[at] = *value;
                at = (at + 1) % MOST;
            }
        }
        ControlFlow::Continue(())
    })
    .map_err(bad)?;
    rest.last.rotate_left(at);
    rest.last_start = (skip as u64 + rest.samples - rest.last.len() as u64) as f64 / rate;
    let long = !rest.last.is_empty();
    Ok((first, long.then_some(rest)))
}
