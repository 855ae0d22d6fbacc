//! Samples out of a file: a stretch, or all of a long signal in bounded memory.

use super::{MOST, bad};
use crate::failure::Failure;
use brinell::signal::Moments;
use brinell_io::{IoError, SignalFile};
use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::thread::JoinHandle;

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

/// A long signal beyond its first [`MOST`] samples, not read yet.
pub(crate) struct Beyond {
    pub(super) file: SignalFile,
    pub(super) name: String,
    /// Samples before the first one analysed.
    pub(super) skip: usize,
    pub(super) rate: f64,
}

/// The same while a thread reads it.
pub(crate) struct Reading(JoinHandle<Result<Rest, IoError>>);

impl Beyond {
    /// Begins to read, beside whatever else is done.
    pub(crate) fn start(mut self) -> Reading {
        Reading(std::thread::spawn(move || {
            whole(&mut self.file, &self.name, self.skip, self.rate)
        }))
    }
}

impl Reading {
    /// Waits for the end of the file.
    pub(crate) fn finish(self) -> Result<Rest, Failure> {
        let read = self.0.join();
        read.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            .map_err(bad)
    }
}

/// All samples after the first `skip`, in one pass; of those beyond the first [`MOST`], the last.
fn whole(file: &mut SignalFile, name: &str, skip: usize, rate: f64) -> Result<Rest, IoError> {
    let mut passed = 0;
    let mut rest = Rest {
        samples: 0,
        moments: Moments::new(),
        missing: 0,
        last: Vec::new(),
        last_start: 0.0,
    };
    let mut last = VecDeque::new();
    file.read_pieces(name, |piece| {
        let from = skip.saturating_sub(passed).min(piece.len());
        passed += piece.len();
        let piece = &piece[from..];
        if piece.iter().all(|v| v.is_finite()) {
            rest.moments.extend(piece);
        } else {
            let finite: Vec<f64> = piece.iter().copied().filter(|v| v.is_finite()).collect();
            rest.moments.extend(&finite);
            rest.missing += (piece.len() - finite.len()) as u64;
        }
        let first = (MOST as u64).saturating_sub(rest.samples);
        rest.samples += piece.len() as u64;
        let beyond = &piece[piece.len().min(first as usize)..];
        let beyond = &beyond[beyond.len().saturating_sub(MOST)..];
        let gone = (last.len() + beyond.len()).saturating_sub(MOST);
        last.drain(..gone);
        last.extend(beyond);
        ControlFlow::Continue(())
    })?;
    rest.last = last.into();
    rest.last_start = (skip as u64 + rest.samples - rest.last.len() as u64) as f64 / rate;
    Ok(rest)
}
