//! How well a comb of lines tells the mean rate of impacts whose rate wanders slowly.

use super::LineFrequency;
use crate::spectrum::hann;
use crate::{Band, Estimate, Scatter, SignalError, envelope};
use realfft::num_complex::Complex;
use std::f64::consts::TAU;

/// Pieces of the record at most, and periods of one at least: as many as Hann's main lobe has bins.
const PIECES: f64 = 8.0;
const PERIODS: f64 = 4.0;
/// The phase is that of the strongest of so many harmonics.
const HARMONICS: usize = 5;

/// Standard uncertainty, Hz, of the line found in the envelope of a signal of the band (Hz) as an estimate of the mean rate
/// over the signal. [`LineFrequency::uncertainty`] of one segment is that of noise and independent timing errors alone.
///
/// The phase of the comb's strongest harmonic is taken of up to eight pieces of the record; from one to the next it says the
/// mean rate between. What these rates scatter by, Student's t of their number included, and what their mean lies from
/// the line are added: a comb of many harmonics settles on the stretch in which the rate was steadiest. It is on the safe
/// side, in trials by a factor of three: an error of one phase moves the rates before and after it to opposite sides.
///
/// # Errors
/// As [`envelope()`].
pub fn mean_rate_uncertainty(x: &[f64], fs: f64, band: Band, line: &LineFrequency) -> Result<f64, SignalError> {
    let envelope = envelope(x, fs, band)?;
    let periods = x.len() as f64 * line.frequency / fs;
    let length = x.len() / (periods / PERIODS).clamp(1.0, PIECES) as usize;
    let window = hann(length);
    let mean = envelope.iter().sum::<f64>() / envelope.len() as f64;
    let phasors = |harmonic: usize| -> Vec<Complex<f64>> {
        let turn = -TAU * harmonic as f64 * line.frequency / fs;
        let of = |(piece, values): (usize, &[f64])| {
            let phasor =
                |(i, v): (usize, &f64)| Complex::cis(turn * (piece * length + i) as f64) * (window[i] * (v - mean));
            values.iter().enumerate().map(phasor).sum()
        };
        envelope.chunks_exact(length).enumerate().map(of).collect()
    };
    let power = |of: &[Complex<f64>]| of.iter().map(Complex::norm_sqr).sum::<f64>();
    let harmonics = (1..=HARMONICS).take_while(|h| (*h as f64 + 0.5) * line.frequency < 0.5 * fs);
    let combs = harmonics.map(|h| (h, phasors(h)));
    let strongest = combs.max_by(|a, b| power(&a.1).total_cmp(&power(&b.1)));
    let rates: Vec<f64> = strongest.map_or(Vec::new(), |(h, phasors)| {
        let per_radian = fs / (TAU * h as f64 * length as f64);
        phasors.windows(2).map(|pair| line.frequency + (pair[1] * pair[0].conj()).arg() * per_radian).collect()
    });
    let n = rates.len() as f64;
    let mean = rates.iter().sum::<f64>() / n;
    let squares: f64 = rates.iter().map(|rate| (rate - mean).powi(2)).sum();
    let freedom = (rates.len() as u32).saturating_sub(1).max(1);
    let scatter = Scatter { error: (squares / (n * f64::from(freedom))).sqrt(), freedom };
    let of_mean = Estimate::signed(mean, Some(scatter)).interval.map_or(0.0, |i| i.standard_uncertainty());
    Ok(line.uncertainty.hypot(of_mean).hypot(if n > 0.0 { line.frequency - mean } else { 0.0 }))
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
}
