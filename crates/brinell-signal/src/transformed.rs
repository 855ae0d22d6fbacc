//! Envelopes in many bands of one signal, from one transform of it, thinned out as they come.
//!
//! What is sought in an envelope lies far below the band's own frequencies: means over some neighbours are all that is
//! kept of it.
//!
//! The analytic signal a(t) of a band of b bins is a sum of b turning values, so a transform of any length M of b or
//! more gives it exactly at M times: no more are taken than the band's width asks for. |a|^2 holds nothing above the
//! width B, and of |a| itself what lies beyond falls off fast: of Gaussian noise with correlation r, that of |a| goes
//! as 1 + r^2 / 4 + r^4 / 64 + ..., and r^2 ends at B, r^4 at 2 B. Tones need more than noise: two of them, f apart,
//! make a modulus with lines at k f, and f reaches B. Taken at 4 B (`AMPLE`), the fourth line is the first that folds
//! back onto the lowest frequencies: 3.2 % of the mean where both are equally strong, less where they are not (2 / (4
//! k^2 - 1), the series of |cos|). The envelope of a band as wide as the spectrum is taken at every sample, as
//! everybody takes it.

use std::sync::{Mutex, PoisonError};

use realfft::num_complex::Complex;
use rustfft::FftPlanner;

use super::band::{Band, bins, moduli};
use super::error::{SignalError, check};
use super::fft;
use super::lengths::fast_from;
use super::spectrum::FEWEST_SAMPLES;
use crate::random::Random;

/// Times at which an envelope is taken, over the bins of its band, where there are so many samples.
const AMPLE: f64 = 4.0;

/// An envelope thinned out.
#[derive(Debug, Clone, PartialEq)]
pub struct Thinned {
    /// Mean of the whole envelope, in the signal's unit.
    pub mean: f64,
    /// One for each of so many equal stretches of the signal, in the signal's unit: where several samples lie in one,
    /// means over it and the next, each weighted by a triangle about where the two meet, and over the last alone. So
    /// what folds back has been brought down twice.
    pub values: Vec<f64>,
}

/// A signal transformed once, whose envelopes in many bands are wanted.
pub struct Transformed {
    fs: f64,
    bins: Vec<Complex<f64>>,
    length: usize,
    /// Keeps what transforms of one length share.
    planner: Mutex<FftPlanner<f64>>,
}

impl Transformed {
    /// Of `x`, sampled at `fs` Hz. Takes as much memory as `x`, and several times as much while it is made.
    ///
    /// # Errors
    /// [`SignalError`] with fewer than [`FEWEST_SAMPLES`] samples or samples that are not finite.
    pub fn of(x: &[f64], fs: f64) -> Result<Self, SignalError> {
        check(x, fs, FEWEST_SAMPLES, "an envelope")?;
        Ok(Transformed::unchecked(x, fs))
    }

    pub(super) fn unchecked(x: &[f64], fs: f64) -> Self {
        let bins = fft::bins(&mut x.to_vec());
        Transformed { fs, bins, length: x.len(), planner: Mutex::new(FftPlanner::new()) }
    }

    /// The same with white noise of `relative` times the signal's RMS, and of the RMS `noise` in the signal's unit, by
    /// a seed of its own. Where a signal holds nothing, as a computed tone between its lines, there is round-off, whose
    /// pattern no chance explains.
    #[must_use]
    pub fn dithered(mut self, relative: f64, noise: f64) -> Self {
        let power: f64 = self.bins.iter().map(Complex::norm_sqr).sum();
        let samples = self.samples() as f64;
        // Noise of unit RMS has bins whose parts have a variance of half the samples; that of +-1 is a third.
        let of_signal = relative * (3.0 * power / samples).sqrt();
        let most = of_signal.hypot(noise * (1.5 * samples).sqrt());
        let mut random = Random::new(1);
        let mut part = || most * (2.0 * random.part() - 1.0);
        for bin in &mut self.bins {
            *bin += Complex::new(part(), part());
        }
        self
    }

    /// Sample rate, Hz.
    pub fn sample_rate(&self) -> f64 {
        self.fs
    }

    /// How many samples there were.
    pub fn samples(&self) -> usize {
        self.length
    }

    /// As [`envelope()`](super::envelope()), in means over `count` equal stretches, each of samples as close as the
    /// band's width asks for: with as many stretches as there were samples, the envelope sample by sample.
    ///
    /// # Panics
    /// Where the band does not satisfy 0 <= low < high and low < fs / 2, or `count` is 0 or above that of the samples.
    pub fn envelope(&self, band: Band, count: usize) -> Thinned {
        assert!((1..=self.samples()).contains(&count), "{count} stretches of {} samples", self.samples());
        let band = bins(self.fs, self.samples(), band);
        let ample = (AMPLE * band.len() as f64 / count as f64).ceil() as usize;
        let every = fast_from(ample.min(self.samples().div_ceil(count)));
        let plan = {
            let mut planner = self.planner.lock().unwrap_or_else(PoisonError::into_inner);
            planner.plan_fft_inverse(count * every)
        };
        let mut taken = Vec::new();
        fft::backward(&*plan, &self.bins, band, &mut taken, |_, bin| bin);
        let rises = 1.0 / every as f64;
        // Sums over each stretch, and with weights that rise over it.
        let mut here = vec![0.0; every];
        let sums: Vec<[f64; 2]> = taken
            .chunks_exact(every)
            .map(|stretch| {
                moduli(stretch, &mut here);
                let rising = here.iter().enumerate().map(|(at, modulus)| (at as f64 + 0.5) * rises * modulus);
                [here.iter().sum(), rising.sum()]
            })
            .collect();
        // The analytic signal has the band's positive frequencies twice and nothing else.
        let each = 2.0 / self.samples() as f64 * rises;
        let whole: f64 = sums.iter().map(|[all, _]| all).sum();
        let mut values: Vec<f64> = (sums.windows(2))
            .map(|two| match every {
                1 => two[0][0],
                _ => two[0][1] + two[1][0] - two[1][1],
            })
            .chain(sums.last().map(|[all, _]| *all))
            .collect();
        values.iter_mut().for_each(|v| *v *= each);
        Thinned { mean: each * whole / count as f64, values }
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_signals::Noise;
    use super::super::{Segments, envelope, psd};
    use super::*;

    const FS: f64 = 25_600.0;

    #[test]
    fn prop_dither_is_as_strong_as_it_says_and_alike_in_every_band() {
        let n = 48_000;
        // Whole periods: nothing leaks out of their bin.
        let step = std::f64::consts::TAU * 2300.0 / f64::from(n);
        let x: Vec<f64> = (0..n).map(|i| (step * f64::from(i)).sin()).collect();
        // A millionth of the tone's RMS, and as much again by its own measure.
        let part = 1e-6 * 0.5f64.sqrt();
        let dithered = Transformed::of(&x, FS).unwrap().dithered(1e-6, part);
        // The envelope of noise in a fraction b of the spectrum has a mean of RMS sqrt(b pi / 2).
        let rms = part.hypot(part);
        for low in [4000.0, 8000.0] {
            let mean = dithered.envelope(Band::between(low, low + 3200.0), n as usize).mean;
            let expected = rms * (0.25 * std::f64::consts::FRAC_PI_2).sqrt();
            assert!((mean / expected - 1.0).abs() < 0.05, "{mean:e} {expected:e}");
        }
    }

    #[test]
    fn prop_stretches_are_means_of_the_envelope_where_it_is_taken() {
        // With 0.08 bins for each sample: stretches, samples to one, and samples from one taken to the next.
        let band = Band::between(1000.0, 3048.0);
        for n in [48_000, 15 << 17] {
            let x = Noise::new(5).normals(n);
            let transformed = Transformed::of(&x, FS).unwrap();
            for (count, every, apart) in [(n, 1, 1), (n / 2, 1, 2), (n / 4, 2, 2), (n / 6, 2, 3), (n / 12, 4, 3)] {
                {
                    let whole = envelope(&x, FS, band).unwrap();
                    let thinned = transformed.envelope(band, count);
                    assert_eq!(thinned.values.len(), count);
                    let taken: Vec<f64> = whole.iter().step_by(apart).copied().collect();
                    let mean = taken.iter().sum::<f64>() / taken.len() as f64;
                    assert!((thinned.mean / mean - 1.0).abs() < 1e-12, "{n}");
                    for (value, two) in thinned.values.iter().zip(taken.windows(2 * every).step_by(every)) {
                        let weight = |i: usize| {
                            let side = i.min(2 * every - 1 - i);
                            (side as f64 + 0.5) / (every * every) as f64
                        };
                        let expected = match every {
                            1 => two[0],
                            _ => two.iter().enumerate().map(|(i, v)| weight(i) * v).sum(),
                        };
                        assert!((value - expected).abs() < 1e-12, "{n} {every}");
                    }
                    let end = &taken[taken.len() - every..];
                    let expected = end.iter().sum::<f64>() / every as f64;
                    assert!((thinned.values[count - 1] - expected).abs() < 1e-12);
                }
            }
        }
    }

    /// Two tones, however far apart in the band: what is present where nothing should be, is the fourth line of their
    /// beat and those beyond.
    #[test]
    fn analytic_beats_fold_back_as_little_as_said() {
        let (n, count) = (1 << 17, 1 << 13);
        let band = Band::between(2000.0, 5000.0);
        let rate = FS * count as f64 / n as f64;
        let turn = |hz: f64, i: i32| (std::f64::consts::TAU * hz * f64::from(i) / FS).cos();
        let mut highest = [0.0_f64; 2];
        for apart in (1..=60).map(|k| 50.0 * f64::from(k) - 7.0) {
            for (weaker, highest) in [1.0, 0.6].into_iter().zip(&mut highest) {
                let x: Vec<f64> = (0..n).map(|i| turn(2003.0, i) + weaker * turn(2003.0 + apart, i)).collect();
                let thinned = Transformed::of(&x, FS).unwrap().envelope(band, count);
                let spectrum = psd(&thinned.values, rate, &Segments::of(count)).unwrap();
                let low = (20.0 / spectrum.frequency_step) as usize;
                // Below the lowest line of the beat itself, and where the triangles have taken 98 % off what folds back
                // onto there.
                let end = (0.9 * apart.min(0.1 * rate) / spectrum.frequency_step) as usize;
                let there = spectrum.amplitude.get(low..end).unwrap_or_default();
                let most = there.iter().fold(0.0, |m: f64, a| m.max(*a));
                *highest = highest.max(most / thinned.mean);
            }
        }
        let series = 2.0 / (4.0 * 16.0 - 1.0);
        assert!(highest[0] < 1.02 * series, "{highest:?}");
        assert!(highest[1] < 0.01, "{highest:?}");
    }

    /// What folds back is below 2 % of the envelope's noise at low frequencies, as the series says; each level scatters
    /// by 1 %.
    #[test]
    fn analytic_the_noise_of_an_envelope_is_that_of_every_sample() {
        let (n, count) = (1_440_000, 200_000);
        let transformed = Transformed::of(&Noise::new(6).normals(n), FS).unwrap();
        // From one sample to a stretch to four.
        for high in [2100.0, 4200.0, 7000.0] {
            let band = Band::between(1000.0, high);
            let level = |count: usize| {
                let thinned = transformed.envelope(band, count);
                let rate = FS * count as f64 / n as f64;
                let spectrum = psd(&thinned.values, rate, &Segments::of(count / 100)).unwrap();
                // From half a hundredth to a tenth of the rate of stretches, where a triangle takes less than 1 % off
                // the RMS.
                spectrum.band_rms(20.0, 350.0)
            };
            let ratio = level(count) / level(n);
            assert!((ratio - 1.0).abs() < 0.02, "{high}: {ratio}");
        }
    }
}
