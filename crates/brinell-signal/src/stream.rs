//! The spectra of a stream: amplitudes, envelope, and the precise rates of impacts, all from the same segments.
//!
//! Segments overlap by half; an incomplete last segment is dropped. A stream shorter than one segment is taken whole,
//! as one segment of its own length (and so with bins farther apart), not padded with zeros. One segment is held, with
//! the room for its transforms: some 9 MB for the longest, however long the stream is.

use super::band::{Band, Demodulator, remove_weighted_mean};
use super::envelope::EnvelopeSpectrum;
use super::frequency::{Comb, LineAverage, LineFrequency, LineSearch, Padded};
use super::spectrum::{FEWEST_SAMPLES, PowerAverage, SegmentTransform, Spectrum, hann};

/// Longest segment of a stream, samples.
pub const LONGEST_SEGMENT: usize = 65_536;

/// What came out of a stream.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectra {
    /// By Welch's method under Hann's window; `None` with fewer than 8 samples.
    pub spectrum: Option<Spectrum>,
    /// Each segment demodulated by itself, the window-weighted mean taken off, then as `spectrum`; `None` with fewer
    /// than 8 samples.
    pub envelope: Option<EnvelopeSpectrum>,
    /// One a search: the mean over the segments in which a comb is clear of the noise; `None` where none does, or a
    /// segment is too short to tell.
    pub lines: Vec<Option<LineFrequency>>,
}

/// Makes [`Spectra`] of a stream, sample by sample.
pub struct StreamSpectra {
    fs: f64,
    band: Band,
    searches: Vec<LineSearch>,
    segmenter: Segmenter,
    segments: SegmentSpectra,
}

impl StreamSpectra {
    /// For samples at `fs` Hz in segments of `length` samples (8 to 65536). The envelope is
    /// that of `band`, and so are the combs of the `searches`.
    ///
    /// # Panics
    /// Where `length` or a search is out of range, or the band does not satisfy 0 <= low < high and low < fs / 2.
    pub fn new(fs: f64, length: usize, band: Band, searches: &[LineSearch]) -> Self {
        StreamSpectra {
            fs,
            band,
            searches: searches.to_vec(),
            segmenter: Segmenter::new(length),
            segments: SegmentSpectra::new(fs, length, band, searches),
        }
    }

    /// Of a slice.
    ///
    /// # Panics
    /// As [`StreamSpectra::new`].
    pub fn of(x: &[f64], fs: f64, length: usize, band: Band, searches: &[LineSearch]) -> Spectra {
        let mut stream = Self::new(fs, length, band, searches);
        x.iter().for_each(|x| stream.push(*x));
        stream.finish()
    }

    /// Takes one sample.
    pub fn push(&mut self, x: f64) {
        if let Some(segment) = self.segmenter.push(x) {
            self.segments.add(segment);
        }
    }

    /// What came together.
    pub fn finish(self) -> Spectra {
        if self.segments.power.segments > 0 {
            drop(self.segmenter);
            return self.segments.finish();
        }
        let rest = self.segmenter.rest();
        if rest.len() < FEWEST_SAMPLES {
            return Spectra { spectrum: None, envelope: None, lines: vec![None; self.searches.len()] };
        }
        drop(self.segments);
        let mut whole = SegmentSpectra::new(self.fs, rest.len(), self.band, &self.searches);
        whole.add(rest);
        whole.finish()
    }
}

/// The repetition frequency in the envelope of a whole signal sampled at `fs` Hz, taken as one segment. The `band`, Hz,
/// is to hold the resonances that the impacts ring. `None` where the signal lasts fewer than 24 periods of the nominal
/// frequency, where no comb inside the range is clear of the noise (false-alarm probability of white noise below 1e-4),
/// or one of its harmonics alone is, and not the fundamental (of the others, at a level of 1e-2). For a long run use [`StreamSpectra`].
///
/// This measures a rate that is known to be there; whether it is, [`analyze`](crate::analysis::analyze) asks. Another
/// train of impacts or a shaft with two harmonics within the range of two of the comb's is taken for it.
///
/// # Panics
/// Where the search is out of range (see [`LineSearch`] and [`Band`]).
pub fn line_frequency(x: &[f64], fs: f64, band: Band, search: &LineSearch) -> Option<LineFrequency> {
    search.fits(x.len(), fs).then(|| {
        let mut spectra = SegmentSpectra::new(fs, x.len(), band, &[*search]);
        spectra.add(x);
        spectra.finish().lines[0]
    })?
}

/// Of segments of one length.
struct SegmentSpectra {
    fs: f64,
    transform: SegmentTransform,
    demodulator: Demodulator,
    power: PowerAverage,
    envelope_power: PowerAverage,
    sum_of_means: f64,
    padded: Padded,
    /// Those that a segment is long enough for.
    combs: Vec<Comb>,
    /// One a search, with the place of its comb.
    lines: Vec<(Option<usize>, LineAverage)>,
}

impl SegmentSpectra {
    fn new(fs: f64, length: usize, band: Band, searches: &[LineSearch]) -> Self {
        let transform = SegmentTransform::new(hann(length));
        let (mut combs, mut lines) = (Vec::new(), Vec::new());
        for search in searches {
            let comb = search.fits(length, fs).then(|| {
                combs.push(Comb::new(fs, &transform.window, search));
                combs.len() - 1
            });
            lines.push((comb, LineAverage::default()));
        }
        SegmentSpectra {
            fs,
            transform,
            demodulator: Demodulator::new(fs, length, band),
            power: PowerAverage::new(length),
            envelope_power: PowerAverage::new(length),
            sum_of_means: 0.0,
            padded: Padded::new(fs, length, combs.iter().map(Comb::highest).fold(0.0, f64::max)),
            combs,
            lines,
        }
    }

    fn add(&mut self, segment: &[f64]) {
        let transform = &mut self.transform;
        self.power.add(transform.windowed(segment));
        transform.plain(segment);
        let envelope = &mut transform.input;
        self.demodulator.envelope(&transform.output, envelope);
        self.sum_of_means += remove_weighted_mean(envelope, &transform.window);
        if !self.combs.is_empty() {
            self.padded.transform(envelope, &transform.window, &mut self.demodulator);
        }
        for (comb, line) in &mut self.lines {
            if let Some(comb) = comb {
                line.add(self.combs[*comb].estimate(&self.padded));
            }
        }
        self.envelope_power.add(transform.windowed_input());
    }

    fn finish(self) -> Spectra {
        // Room that is needed no more is given back before the results take theirs.
        drop((self.demodulator, self.padded));
        let window = &self.transform.window;
        let step = window.len() / 2;
        Spectra {
            spectrum: Some(self.power.finish(self.fs, window, step)),
            envelope: Some(EnvelopeSpectrum {
                spectrum: self.envelope_power.finish(self.fs, window, step),
                mean: self.sum_of_means / self.power.segments as f64,
            }),
            lines: self.lines.iter().map(|(_, line)| line.finish()).collect(),
        }
    }
}

/// Cuts a stream into segments that overlap by half.
struct Segmenter {
    buffer: Vec<f64>,
    fill: usize,
}

impl Segmenter {
    fn new(length: usize) -> Self {
        assert!(
            (FEWEST_SAMPLES..=LONGEST_SEGMENT).contains(&length),
            "segment of {length} samples: must be {FEWEST_SAMPLES} to {LONGEST_SEGMENT}"
        );
        Segmenter { buffer: vec![0.0; length], fill: 0 }
    }

    /// Takes a sample; gives a segment whenever one is full.
    fn push(&mut self, x: f64) -> Option<&[f64]> {
        let length = self.buffer.len();
        if self.fill == length {
            self.buffer.copy_within(length / 2.., 0);
            self.fill = length - length / 2;
        }
        self.buffer[self.fill] = x;
        self.fill += 1;
        (self.fill == length).then_some(&self.buffer)
    }

    /// What has arrived since the start of the current segment.
    fn rest(&self) -> &[f64] {
        &self.buffer[..self.fill]
    }
}
