//! How well a comb of lines tells the mean rate of impacts whose rate wanders slowly.

use super::LineFrequency;
use crate::error::require;
use crate::spectrum::hann;
use crate::{Band, Estimate, SignalError, envelope, scatter};
use realfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Pieces of the record at most, and periods of one at least: the shortest record that is searched has eight pieces.
const PIECES: f64 = 16.0;
const PERIODS: f64 = 3.0;
/// Harmonics whose phases tell the impacts' delay, and steps of a turn in which it is sought.
const HARMONICS: usize = 8;
const STEPS: i32 = 4096;

/// Standard uncertainty, Hz, of the line found in the envelope of a signal of the band (Hz) as an estimate of the mean rate
/// over the signal. [`LineFrequency::uncertainty`] of one segment is that of noise and independent timing errors alone.
///
/// The harmonics of up to sixteen pieces of the record are taken; by how much the impacts of one come late beside those of
/// the piece before, all harmonics together, says the mean rate between. How these rates scatter about their mean,
/// autocorrelation and Student's t included ([`scatter()`]), and what their mean lies from the line are added: a comb of
/// many harmonics settles on the stretch in which the rate was steadiest.
///
/// # Errors
/// As [`envelope()`]; where the line's frequency is not between 0 and half the sample rate.
pub fn mean_rate_uncertainty(x: &[f64], fs: f64, band: Band, line: &LineFrequency) -> Result<f64, SignalError> {
    let envelope = envelope(x, fs, band)?;
    let within = line.frequency > 0.0 && line.frequency < 0.5 * fs;
    require(within, "frequency of the line (Hz)", line.frequency, "above 0 and below half the sample rate")?;
    let periods = x.len() as f64 * line.frequency / fs;
    let length = x.len() / (periods / PERIODS).clamp(1.0, PIECES) as usize;
    let window = hann(length);
    let mean = envelope.iter().sum::<f64>() / envelope.len() as f64;
    let harmonics = (1..=HARMONICS).take_while(|h| (*h as f64 + 0.5) * line.frequency < 0.5 * fs);
    let turns: Vec<f64> = harmonics.map(|h| -TAU * h as f64 * line.frequency / fs).collect();
    let of = |(piece, values): (usize, &[f64])| -> Vec<Complex<f64>> {
        let windowed: Vec<f64> = window.iter().zip(values).map(|(w, v)| w * (v - mean)).collect();
        let phasor = |turn: f64, i: usize| Complex::cis(turn * (piece * length + i) as f64);
        turns.iter().map(|turn| windowed.iter().enumerate().map(|(i, v)| phasor(*turn, i) * v).sum()).collect()
    };
    let pieces: Vec<Vec<Complex<f64>>> = envelope.chunks_exact(length).enumerate().map(of).collect();
    // The phase of the fundamental that explains how all harmonics have turned from one piece to the next.
    let turned = |pair: &[Vec<Complex<f64>>]| {
        let crossed: Vec<Complex<f64>> = pair[0].iter().zip(&pair[1]).map(|(a, b)| b * a.conj()).collect();
        let agreement = |phase: f64| -> f64 {
            let terms = crossed.iter().enumerate();
            terms.map(|(k, c)| (c * Complex::cis(-(k as f64 + 1.0) * phase)).re).sum()
        };
        let phases = (-STEPS / 2..STEPS / 2).map(|k| TAU * f64::from(k) / f64::from(STEPS));
        phases.max_by(|a, b| agreement(*a).total_cmp(&agreement(*b))).unwrap_or(0.0)
    };
    let per_radian = fs / (TAU * length as f64);
    let rates: Vec<f64> = pieces.windows(2).map(|pair| line.frequency + turned(pair) * per_radian).collect();
    let mean = rates.iter().sum::<f64>() / rates.len() as f64;
    let Some(of_mean) = Estimate::signed(mean, scatter(&rates)).interval else {
        return Ok(line.uncertainty);
    };
    Ok(line.uncertainty.hypot(of_mean.standard_uncertainty()).hypot(line.frequency - mean))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use crate::{LineSearch, line_frequency};

    const FS: f64 = 25_600.0;
    const BAND: Band = Band { low: 2000.0, high: f64::INFINITY };

    /// Impacts whose rate wanders by `share` about 250 Hz with a correlation time of 50 ms; and the mean rate.
    fn wandering(seconds: f64, share: f64, seed: u64) -> (Vec<f64>, f64) {
        let mut random = Random::new(seed);
        let n = (seconds * FS) as usize;
        let (mut x, mut phase, mut off) = (vec![0.0; n], random.uniform(), random.normal());
        let keep = (-1.0 / (0.05 * FS)).exp();
        let first = phase;
        for i in 0..n {
            off = keep * off + (1.0 - keep * keep).sqrt() * random.normal();
            let before = phase;
            phase += 250.0 * (1.0 + share * off) / FS;
            if phase.floor() > before.floor() {
                for (k, value) in x[i..].iter_mut().take(150).enumerate() {
                    let t = k as f64 / FS;
                    *value += (-t / 6e-4).exp() * (TAU * 4000.0 * t).sin();
                }
            }
        }
        (x.iter().map(|v| v + 0.02 * random.normal()).collect(), (phase - first) / seconds)
    }

    /// Of mean rates that are known, about as many lie within the uncertainty as should, in records of 50 to 1000 periods.
    #[test]
    fn analytic_the_uncertainty_of_a_mean_rate_covers_it() {
        for (seconds, share) in [(0.2, 0.003), (0.5, 0.003), (1.0, 0.003), (4.0, 0.003), (1.0, 0.0)] {
            let (mut within, mut noise_alone, mut narrow) = (0, 0, 0);
            for seed in 0..40 {
                let (x, rate) = wandering(seconds, share, seed);
                let line = line_frequency(&x, FS, BAND, &LineSearch::new(250.0)).unwrap();
                let error = (line.frequency - rate).abs();
                let uncertainty = mean_rate_uncertainty(&x, FS, BAND, &line).unwrap();
                within += usize::from(error < 1.96 * uncertainty);
                noise_alone += usize::from(error < 1.96 * line.uncertainty);
                narrow += usize::from(uncertainty < 2.0 * share * 250.0 + 0.02);
            }
            assert!(within >= 36, "{seconds} s, {share}: {within} of 40");
            assert!(share == 0.0 || noise_alone < 30, "{seconds} s: {noise_alone} of 40");
            assert!(narrow >= 36, "{seconds} s, {share}: {narrow} of 40");
        }
    }

    #[test]
    fn regress_a_line_without_a_frequency_is_refused() {
        let (x, _) = wandering(0.2, 0.0, 1);
        let line = line_frequency(&x, FS, BAND, &LineSearch::new(250.0)).unwrap();
        for frequency in [f64::NAN, 0.0, -250.0, 1e9] {
            let bad = crate::LineFrequency { frequency, ..line };
            assert!(mean_rate_uncertainty(&x, FS, BAND, &bad).is_err(), "{frequency}");
        }
    }
}
