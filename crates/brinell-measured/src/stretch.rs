//! Samples out of a file: a stretch, or all of a long signal in bounded memory.

use crate::called::Called;
use crate::problem::Problem;
use crate::request::MOST;
use brinell::signal::Moments;
use brinell_io::{IoError, SignalFile};
use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::thread::JoinHandle;

/// What follows so many samples of a channel, and how many at most.
#[derive(Clone, Copy)]
pub(crate) struct Part {
    pub(crate) skip: usize,
    pub(crate) most: usize,
    /// Hz.
    pub(crate) rate: f64,
    pub(crate) called: Called,
}

impl Part {
    /// What chooses a stretch without the sample `at` after the part's first, in words.
    pub(crate) fn without(self, at: usize) -> String {
        let from = (self.skip + at + 1) as f64 / self.rate;
        format!("{}, {} what follows", self.before(at), self.called.number("start", from))
    }

    /// What chooses that before it.
    fn before(self, at: usize) -> String {
        let start = self.skip as f64 / self.rate;
        let start = if start > 0.0 { format!("{} ", self.called.number("start", start)) } else { String::new() };
        let duration = self.called.number("duration", at as f64 / self.rate);
        format!("{start}{duration} takes what is before it")
    }
}

/// The part's samples, and whether there are more. Lines of a text file that hold no number may lie about it, with a
/// warning.
pub(crate) fn stretch(
    file: &mut SignalFile,
    name: &str,
    part: Part,
    warnings: &mut Vec<String>,
) -> Result<(Vec<f64>, bool), Problem> {
    let error = match samples(part, |sink| file.read_pieces(name, sink)) {
        Err(error) if error.is_of_a_line() => error,
        read => return read.map_err(Problem::from),
    };
    let read = samples(part, |sink| file.read_around(name, sink))?;
    match read.0.iter().position(|v| !v.is_finite()) {
        None => {
            warnings.push(format!("{error}; that lies beyond the stretch which is analysed"));
            Ok(read)
        }
        Some(at) => {
            let nothing_follows = matches!(error, IoError::Segment { .. });
            let options = if nothing_follows { part.before(at) } else { part.without(at) };
            Err(Problem::Signal(format!("{error}; {options}")))
        }
    }
}

type Sink<'a> = &'a mut dyn FnMut(&[f64]) -> ControlFlow<()>;

fn samples(part: Part, read: impl FnOnce(Sink<'_>) -> Result<(), IoError>) -> Result<(Vec<f64>, bool), IoError> {
    let (mut values, mut passed, mut more) = (Vec::new(), 0, false);
    read(&mut |piece| {
        let from = part.skip.saturating_sub(passed).min(piece.len());
        passed += piece.len();
        let room = part.most - values.len();
        let rest = &piece[from..];
        more = rest.len() > room;
        values.extend_from_slice(&rest[..rest.len().min(room)]);
        if more { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    Ok((values, more))
}

/// From a file's numbers to the signal's unit.
pub(crate) fn scale(values: &mut [f64], factor: f64) {
    if factor != 1.0 {
        values.iter_mut().for_each(|v| *v *= factor);
    }
}

/// The whole of a signal longer than [`MOST`] samples.
pub struct Rest {
    /// Samples of the whole, from the first one analysed on.
    pub samples: u64,
    /// Their moments, less the mean of the first of them.
    pub moments: Moments,
    /// Those that are not finite numbers.
    pub missing: u64,
    /// The last [`MOST`] samples: of less than twice as many, some belong to the first as well.
    pub last: Vec<f64>,
    /// Where those begin, s.
    pub last_start: f64,
}

/// A long signal beyond its first [`MOST`] samples, not read yet.
pub(crate) struct Beyond {
    pub(crate) file: SignalFile,
    pub(crate) name: String,
    /// Samples before the first one analysed.
    pub(crate) skip: usize,
    pub(crate) rate: f64,
    /// The signal's unit over the file's numbers.
    pub(crate) factor: f64,
}

/// The same while a thread reads it.
pub(crate) struct Reading(JoinHandle<Result<Rest, IoError>>);

impl Beyond {
    /// Begins to read, beside whatever else is done.
    pub(crate) fn start(mut self) -> Reading {
        Reading(std::thread::spawn(move || whole(&mut self.file, &self.name, self.skip, self.rate, self.factor)))
    }
}

impl Reading {
    /// Waits for the end of the file.
    pub(crate) fn finish(self) -> Result<Rest, Problem> {
        let read = self.0.join();
        read.unwrap_or_else(|panic| std::panic::resume_unwind(panic)).map_err(Problem::from)
    }
}

/// All samples after the first `skip`, in one pass, and the last [`MOST`] of them.
fn whole(file: &mut SignalFile, name: &str, skip: usize, rate: f64, factor: f64) -> Result<Rest, IoError> {
    let (mut passed, mut scaled) = (0, Vec::new());
    let mut rest = Rest { samples: 0, moments: Moments::new(), missing: 0, last: Vec::new(), last_start: 0.0 };
    let (mut last, mut mean) = (VecDeque::new(), None);
    file.read_pieces(name, |piece| {
        let from = skip.saturating_sub(passed).min(piece.len());
        passed += piece.len();
        scaled.clear();
        scaled.extend_from_slice(&piece[from..]);
        scale(&mut scaled, factor);
        let piece = &scaled[..];
        let mut finite: Vec<f64> = piece.iter().copied().filter(|v| v.is_finite()).collect();
        rest.missing += (piece.len() - finite.len()) as u64;
        if !finite.is_empty() {
            // As of the stretch that is judged, but for what the mean moves from piece to piece.
            let mean = *mean.get_or_insert_with(|| finite.iter().sum::<f64>() / finite.len() as f64);
            finite.iter_mut().for_each(|v| *v -= mean);
            rest.moments.extend(&finite);
        }
        rest.samples += piece.len() as u64;
        let kept = &piece[piece.len().saturating_sub(MOST)..];
        let gone = (last.len() + kept.len()).saturating_sub(MOST);
        last.drain(..gone);
        last.extend(kept);
        ControlFlow::Continue(())
    })?;
    rest.last = last.into();
    rest.last_start = (skip as u64 + rest.samples - rest.last.len() as u64) as f64 / rate;
    Ok(rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brinell::signal::Indicator;
    use brinell_io::open;

    /// The end of a long signal is its last samples, and its moments are those of all, from the first one wanted on.
    #[test]
    fn prop_the_end_and_the_whole_of_a_long_signal() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long.npy");
        for (more, skip) in [(1000, 0), (MOST + 12_345, 777)] {
            let n = MOST + more + skip;
            let value = |i: usize| (i % 30_011) as i16 - 11;
            let head = format!("{{'descr': '<i2', 'fortran_order': False, 'shape': ({n},), }}\n");
            let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
            bytes.extend((head.len() as u16).to_le_bytes());
            bytes.extend(head.as_bytes());
            bytes.extend((0..n).flat_map(|i| value(i).to_le_bytes()));
            std::fs::write(&path, bytes).unwrap();
            let mut file = open(&path).unwrap();
            let rest = whole(&mut file, "array", skip, 100.0, 2.0).unwrap();
            assert_eq!(rest.samples, (n - skip) as u64);
            assert_eq!(rest.missing, 0);
            let first = n - MOST;
            assert_eq!(rest.last_start, first as f64 / 100.0);
            assert_eq!(rest.last.len(), MOST);
            assert!((first..n).zip(&rest.last).all(|(i, v)| *v == 2.0 * f64::from(value(i))));
            let count = rest.samples as f64;
            let all = || (skip..n).map(|i| 2.0 * f64::from(value(i)));
            let mean = all().sum::<f64>() / count;
            let deviation = (all().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt();
            let found = rest.moments.get(Indicator::StandardDeviation).unwrap();
            assert!((found / deviation - 1.0).abs() < 1e-6, "{found} {deviation}");
        }
    }
}
