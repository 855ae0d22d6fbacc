//! Damage across a groove, slice by slice.

use super::extent::{Extent, slice_borders};
use super::track::{Track, settled};

/// Damage across a groove: ranges of z in ascending order, each with what damage covers of it and how deep, along s.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Across {
    pub(super) ranges: Vec<([f64; 2], Track)>,
    /// Whether the ranges are those of z >= 0 and the other side is alike.
    pub(super) mirrored: bool,
    /// Height of the highest raised edge, m.
    pub(super) raised: f64,
}

impl Across {
    /// From the tracks of slices; `mirrored` where they are those of one side.
    pub(super) fn of_slices(
        tracks: Vec<Track>,
        (slices, extent): (usize, Extent),
        mirrored: bool,
        raised: f64,
    ) -> Self {
        let ranges = tracks.into_iter().map(|track| {
            let [low, high] = slice_borders(track.slice, slices, extent);
            ([if mirrored { low.max(0.0) } else { low }, high], track)
        });
        Self { ranges: ranges.collect(), mirrored, raised }
    }

    /// Of damage that is as deep at every z between two: the slices that it covers from end to end are one. `of` gives
    /// the track of a slice by the fraction that is covered.
    pub(super) fn of_rectangle(
        [low, high]: [f64; 2],
        (slices, extent): (usize, Extent),
        of: impl Fn(f64) -> Option<Track>,
    ) -> Self {
        let mut ranges: Vec<([f64; 2], Track)> = Vec::new();
        let mut last_is_whole = false;
        for k in 0..slices {
            let [from, to] = slice_borders(k, slices, extent);
            let phi = settled((high.min(to) - low.max(from)) / (to - from));
            let is_whole = phi == 1.0;
            match ranges.last_mut() {
                Some((range, _)) if is_whole && last_is_whole => range[1] = to,
                _ if phi > 0.0 => ranges.extend(of(phi).map(|track| ([from, to], track))),
                _ => {}
            }
            last_is_whole = is_whole;
        }
        Self { ranges, mirrored: false, raised: 0.0 }
    }

    /// First and last s of each range, m.
    pub(super) fn spans(&self) -> impl Iterator<Item = (f64, f64)> {
        self.ranges.iter().map(|(_, track)| track.span())
    }
}
