//! A signal as levels that can be compared with another's: its spectrum in octaves, and its envelope spectrum at defect
//! frequencies.
//!
//! Levels are decibels of a root mean square against one unit of the signal. The logarithm lets a weak band count like
//! a strong one. The signal is cut into segments that do not overlap; the mean square of a level is their mean, and its
//! standard uncertainty follows from their scatter. Both signals have the same rate and the same segments, so that what
//! a window smears, it smears alike.

use brinell::analysis::HARMONICS;
use brinell::signal::decimate::PASSBAND;
use brinell::signal::spectrum::FEWEST_SAMPLES;
use brinell::signal::{Band, Detrend, Segments, SignalError, envelope, psd};

/// Segments of the shorter signal.
const SEGMENTS: usize = 4;
/// Octaves at most; the highest one ends where the anti-alias filter's passband does.
const OCTAVES: i32 = 6;
/// An octave has so many bins at least.
const FEWEST_BINS: f64 = 8.0;
/// Half the band about a harmonic, as a share of its frequency: what slip may do. Two bins at least, which is a line's
/// width.
const SLIP: f64 = 0.02;
const LINE_BINS: f64 = 2.0;

/// What is taken from a signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Signature {
    rate: f64,
    segment: usize,
    band: Band,
    octaves: Vec<(f64, f64)>,
    /// Name, and band about it.
    lines: Vec<(String, f64, f64)>,
}

/// One level.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// `signature.octave_2560_5120_hz`, `signature.envelope_bpfo_x1`.
    pub name: String,
    /// Decibels.
    pub decibels: f64,
    /// Standard uncertainty, decibels; 0 where there is one segment only.
    pub uncertainty: f64,
}

/// Decibels of a relative standard uncertainty of an amplitude.
pub fn decibels(relative: f64) -> f64 {
    20.0 * (1.0 + relative).log10()
}

impl Signature {
    /// For signals at `rate` Hz of which the shorter has `samples`; the envelope is that of `band`, and `lines` are
    /// defect frequencies with their names, Hz.
    ///
    /// # Errors
    /// Where the shorter signal is too short to be cut.
    pub fn new(rate: f64, samples: usize, band: Band, lines: &[(&str, f64)]) -> Result<Self, SignalError> {
        let segment = samples / SEGMENTS / 2 * 2;
        if segment < FEWEST_SAMPLES {
            return Err(SignalError::TooShort { what: "a signature", have: samples, need: SEGMENTS * FEWEST_SAMPLES });
        }
        let bin = rate / segment as f64;
        let octaves = (0..OCTAVES)
            .map(|k| (PASSBAND * rate * 0.5_f64.powi(k + 1), PASSBAND * rate * 0.5_f64.powi(k)))
            .filter(|(low, high)| high - low >= FEWEST_BINS * bin);
        let mut bands = Vec::new();
        for (name, frequency) in lines {
            for n in 1..=HARMONICS {
                let at = frequency * n as f64;
                let half = (SLIP * at).max(LINE_BINS * bin);
                // Two harmonics in one band would say one thing twice.
                if half < 0.5 * frequency && at + half < 0.5 * rate {
                    let name = format!("signature.envelope_{name}_x{n}");
                    bands.push((name, at - half, at + half));
                }
            }
        }
        Ok(Self { rate, segment, band, octaves: octaves.collect(), lines: bands })
    }

    /// Of a signal at the rate.
    ///
    /// # Errors
    /// Where the signal is shorter than a segment, or not finite.
    pub fn of(&self, x: &[f64]) -> Result<Vec<Level>, SignalError> {
        let segments = |detrend| Segments { detrend, ..Segments::of(self.segment) };
        if x.len() < self.segment {
            return Err(SignalError::TooShort { what: "a signature", have: x.len(), need: self.segment });
        }
        let spectra = |x: &[f64]| {
            let pieces = x.chunks_exact(self.segment);
            let spectra = pieces.map(|piece| psd(piece, self.rate, &segments(Detrend::Mean)));
            spectra.collect::<Result<Vec<_>, _>>()
        };
        let level = |name: String, low: f64, high: f64, of: &[brinell::signal::Spectrum]| {
            let squares: Vec<f64> = of.iter().map(|s| s.band_rms(low, high).powi(2)).collect();
            let n = squares.len() as f64;
            let mean = squares.iter().sum::<f64>() / n;
            let scatter = squares.iter().map(|s| (s - mean).powi(2)).sum::<f64>();
            let relative = if n > 1.0 && mean > 0.0 { (scatter / (n * (n - 1.0))).sqrt() / mean } else { 0.0 };
            // A mean square's relative uncertainty is twice an amplitude's.
            Level {
                name,
                decibels: 10.0 * mean.max(f64::MIN_POSITIVE).log10(),
                uncertainty: 10.0 / std::f64::consts::LN_10 * relative,
            }
        };
        let plain = spectra(x)?;
        let demodulated = envelope(x, self.rate, self.band)?;
        let demodulated = spectra(&demodulated)?;
        let octaves = self.octaves.iter().map(|(low, high)| {
            let name = format!("signature.octave_{low:.0}_{high:.0}_hz");
            level(name, *low, *high, &plain)
        });
        let lines = (self.lines.iter()).map(|(name, low, high)| level(name.clone(), *low, *high, &demodulated));
        Ok(octaves.chain(lines).collect())
    }

    /// Everything that it depends on, as text: two signatures with the same say the same of a signal.
    pub fn describe(&self) -> String {
        format!("{self:?}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A carrier at 5 kHz whose amplitude follows 1 + m cos(2 pi f t).
    fn modulated(amplitude: f64, depth: f64, frequency: f64, samples: usize) -> Vec<f64> {
        (0..samples)
            .map(|k| {
                let t = k as f64 / 25600.0;
                amplitude * (1.0 + depth * (TAU * frequency * t).cos()) * (TAU * 5000.0 * t).cos()
            })
            .collect()
    }

    fn signature(lines: &[(&str, f64)]) -> Signature {
        Signature::new(25600.0, 8192, Band::between(2000.0, 11000.0), lines).unwrap()
    }

    #[test]
    fn analytic_levels_of_a_modulated_carrier() {
        let (amplitude, depth) = (3.0, 0.4);
        let levels = signature(&[("bpfo", 200.0)]).of(&modulated(amplitude, depth, 200.0, 8192)).unwrap();
        let find = |name: &str| levels.iter().find(|l| l.name == name).unwrap().decibels;
        // Mean square of the carrier with both sidebands, all within one octave; of the envelope's line.
        let all = 10.0 * (0.5 * amplitude * amplitude * (1.0 + 0.5 * depth * depth)).log10();
        assert!((find("signature.octave_2560_5120_hz") - all).abs() < 0.3);
        let line = 10.0 * (0.5 * (amplitude * depth).powi(2)).log10();
        let found = find("signature.envelope_bpfo_x1");
        assert!((found - line).abs() < 0.1, "{found} {line}");
        assert!(find("signature.envelope_bpfo_x2") < line - 30.0);
    }

    #[test]
    fn prop_a_factor_shifts_every_level_by_as_much() {
        // Something in every octave: elsewhere a pure tone leaves round-off.
        let rough = |k: usize| 1e-3 * ((k * k) as f64 * 0.37).sin();
        let of = |factor: f64| {
            let signal = modulated(1.0, 0.3, 150.0, 9000).into_iter().enumerate();
            let signal: Vec<f64> = signal.map(|(k, x)| factor * (x + rough(k))).collect();
            signature(&[("bpfi", 150.0)]).of(&signal).unwrap()
        };
        for (a, b) in of(1.0).iter().zip(of(10.0)) {
            assert_eq!(a.name, b.name);
            assert!((b.decibels - a.decibels - 20.0).abs() < 1e-6, "{}", a.name);
        }
    }

    #[test]
    fn regress_a_short_signal_is_refused() {
        let error = Signature::new(25600.0, 20, Band::above(2000.0), &[]).unwrap_err();
        assert!(error.to_string().contains("20"), "{error}");
        assert!(signature(&[]).of(&[0.0; 100]).is_err());
    }
}
