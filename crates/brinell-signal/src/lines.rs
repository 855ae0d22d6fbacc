//! Spectral lines against the noise around them: harmonics of a frequency.
//!
//! The noise at a line is the median power of its neighbourhood, the line itself and its skirt left out, over the
//! median of chi-square with the spectrum's degrees of freedom: other lines hardly move a median. Under Gaussian noise
//! the line's power over that floor follows F, with the spectrum's degrees of freedom above and the floor's own
//! below; its tail is the false-alarm probability of one bin.

use super::distribution::{chi_square_quantile, f_tail};
use super::error::{SignalError, require};
use super::spectrum::{Spectrum, peak_near};

/// Bins to either side of a line that make its neighbourhood.
const NEIGHBOURHOOD: usize = 40;
/// Bins to one side that make a floor where the spectrum ends on the other.
const FEWEST_BINS: usize = 16;
/// Bins to either side of a place that its line may fill: four for Hann, and flat top needs five.
const SKIRT: usize = 4;
/// Lowest floor, as a share of the spectrum's strongest power: the round-off of a noiseless signal.
const LOWEST_FLOOR: f64 = 1e-24;

/// A line sought at a place of the spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Order of the harmonic.
    pub order: i32,
    /// Where it was sought, Hz.
    pub expected: f64,
    /// Where the spectrum is highest about there, Hz; interpolated between bins where it is a maximum.
    pub frequency: f64,
    /// Peak amplitude there, in the signal's unit.
    pub amplitude: f64,
    /// Amplitude of the noise about it: root mean square over bins of what noise alone shows.
    pub floor: f64,
    /// Signal to noise: power over that of the floor, in decibels; 0 is what noise shows on average.
    pub snr_db: f64,
    /// Chance that the largest of the bins searched is as high under Gaussian noise.
    pub false_alarm: f64,
}

/// Harmonics 1 to `count` of `frequency`, known to within +- `tolerance` (both Hz), in a spectrum.
///
/// Harmonic h is sought within h `tolerance` of h `frequency`, and within half a bin at the least. For a tolerance that
/// makes neighbouring searches meet, the fundamental is uncertain beyond use. In order of frequency; those beyond the
/// spectrum or too near zero frequency are missing, as are orders beyond the number of its bins.
///
/// # Errors
/// [`SignalError::OutOfRange`] where the frequency is not positive, the tolerance is negative or reaches half the
/// frequency, or the spectrum has too few bins for a floor.
pub fn harmonics(spectrum: &Spectrum, frequency: f64, tolerance: f64, count: usize) -> Result<Vec<Line>, SignalError> {
    require(frequency > 0.0 && frequency.is_finite(), "frequency (Hz)", frequency, "above 0")?;
    require((0.0..0.5 * frequency).contains(&tolerance), "tolerance (Hz)", tolerance, "0 to below half the frequency")?;
    let floor = Floor::new(spectrum)?;
    let line = |h: usize| floor.line(h as i32, h as f64 * frequency, h as f64 * tolerance);
    // The last bin is no line's.
    let last = (spectrum.amplitude.len() as f64 * spectrum.frequency_step / frequency) as usize;
    Ok((1..=count.min(last).min(spectrum.amplitude.len())).filter_map(line).collect())
}

/// The noise of a spectrum, place by place.
struct Floor<'a> {
    spectrum: &'a Spectrum,
    freedom: f64,
    /// Median of chi-square over its degrees of freedom.
    median: f64,
    /// Neighbouring bins from one independent power to the next.
    correlation: f64,
    lowest: f64,
}

/// Power of noise at a place, and how well it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Level {
    /// Square of an amplitude.
    power: f64,
    /// Degrees of freedom that it rests on.
    freedom: f64,
}

impl<'a> Floor<'a> {
    fn new(spectrum: &'a Spectrum) -> Result<Self, SignalError> {
        require(
            spectrum.amplitude.len() > FEWEST_BINS + 2 * SKIRT + 2,
            "bins of the spectrum",
            spectrum.amplitude.len() as f64,
            "27 or more",
        )?;
        let freedom = spectrum.degrees_of_freedom;
        let strongest = spectrum.amplitude.iter().fold(0.0, |m: f64, a| m.max(*a));
        require(strongest.is_finite(), "amplitude of the spectrum", strongest, "finite")?;
        Ok(Floor {
            spectrum,
            freedom,
            median: chi_square_quantile(0.5, freedom) / freedom,
            correlation: spectrum.noise_bandwidth / spectrum.frequency_step,
            lowest: LOWEST_FLOOR * strongest * strongest,
        })
    }

    /// The bin of a frequency; `None` outside the spectrum, or where the line would merge with zero frequency.
    fn bin(&self, frequency: f64) -> Option<usize> {
        let bin = (frequency / self.spectrum.frequency_step).round();
        let last = self.spectrum.amplitude.len() - 2;
        (bin >= SKIRT as f64 && bin <= last as f64).then_some(bin as usize)
    }

    fn power(&self, bin: usize) -> f64 {
        self.spectrum.amplitude[bin].powi(2)
    }

    /// Noise about the bins `first` to `last`, those and their skirts left out.
    fn level(&self, first: usize, last: usize) -> Level {
        let top = self.spectrum.amplitude.len() - 2;
        let below = first.saturating_sub(SKIRT).saturating_sub(1);
        let above = (top + 1).saturating_sub(last + SKIRT + 1);
        // As far on either side, so that a slope cancels; beyond an end of the spectrum only a few bins of the other
        // side.
        let reach = below.min(above).clamp(FEWEST_BINS, NEIGHBOURHOOD);
        let (take_below, take_above) = (below.min(reach), above.min(reach));
        let start_below = first.saturating_sub(SKIRT) - take_below;
        let start_above = last + SKIRT + 1;
        let mut powers: Vec<f64> = (start_below..start_below + take_below)
            .chain(start_above..start_above + take_above)
            .map(|k| self.power(k))
            .collect();
        if powers.is_empty() {
            return Level { power: self.lowest, freedom: 1.0 };
        }
        let middle = powers.len() / 2;
        let (_, median, _) = powers.select_nth_unstable_by(middle, f64::total_cmp);
        let power = (*median / self.median).max(self.lowest).max(f64::MIN_POSITIVE);
        // A median of n values is as good as a mean of about 2 n / pi; exactly so for many degrees of freedom, and
        // with two (exponential powers) of ln(2)^2 n.
        let efficiency = if self.freedom < 4.0 { 0.48 } else { 0.6 };
        let independent = powers.len() as f64 / self.correlation;
        Level { power, freedom: self.freedom * independent * efficiency }
    }

    /// False-alarm probability of a power in a bin, over noise at `level`.
    fn false_alarm(&self, level: Level) -> impl Fn(f64) -> f64 {
        let freedom = self.freedom;
        move |power| f_tail(power / level.power, freedom, level.freedom)
    }

    /// The line within `tolerance` of `expected`, both Hz.
    fn line(&self, order: i32, expected: f64, tolerance: f64) -> Option<Line> {
        let step = self.spectrum.frequency_step;
        let nearest = self.bin(expected)?;
        let first = self.bin(expected - tolerance).map_or(nearest, |b| b.min(nearest));
        let last = self.bin(expected + tolerance).map_or(nearest, |b| b.max(nearest));
        let top = (first..=last).max_by(|&a, &b| self.power(a).total_cmp(&self.power(b))).unwrap_or(nearest);
        let level = self.level(first, last);
        let power = self.power(top);
        // Interpolated where it is a maximum of its own; the skirt of a line outside is taken as it is.
        let peak = peak_near(self.spectrum, top as f64 * step, 0.5 * step)
            .filter(|p| (p.frequency - top as f64 * step).abs() <= step);
        let one = self.false_alarm(level)(power);
        let trials = ((last - first + 1) as f64).max(1.0);
        Some(Line {
            order,
            expected,
            frequency: peak.map_or(top as f64 * step, |p| p.frequency),
            amplitude: peak.map_or(power.sqrt(), |p| p.amplitude),
            floor: level.power.sqrt(),
            snr_db: 10.0 * (power / level.power).max(f64::MIN_POSITIVE).log10(),
            false_alarm: -(trials * (-one).ln_1p()).exp_m1(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::psd::{Segments, psd};
    use super::super::test_signals::{Noise, cosine};
    use super::*;

    const FS: f64 = 4096.0;

    fn comb(noise: f64, seed: u64) -> Vec<f64> {
        let n = 32_768;
        let mut x: Vec<f64> = (Noise::new(seed).normals(n).iter()).map(|v| noise * v).collect();
        for (f, a) in [(100.3, 1.0), (200.6, 0.5), (300.9, 0.25)] {
            x.iter_mut().zip(cosine(n, FS, f, a, f)).for_each(|(x, c)| *x += c);
        }
        x
    }

    #[test]
    fn analytic_amplitudes_floor_and_signal_to_noise() {
        let sigma = 0.2;
        let s = psd(&comb(sigma, 1), FS, &Segments::of(8192)).unwrap();
        let lines = harmonics(&s, 100.0, 0.5, 4).unwrap();
        assert_eq!(lines.len(), 4);
        // Mean square amplitude of noise: its density over the noise bandwidth, twice for a peak value.
        let noise = 2.0 * (2.0 * sigma * sigma / FS) * s.noise_bandwidth;
        for (line, (f, a)) in lines.iter().zip([(100.3, 1.0), (200.6, 0.5), (300.9, 0.25)]) {
            assert!((line.frequency - f).abs() < 0.02, "{line:?}");
            assert!((line.amplitude / a - 1.0).abs() < 0.05, "{line:?}");
            assert!((line.floor / noise.sqrt() - 1.0).abs() < 0.15, "{line:?}");
            assert!(line.false_alarm < 1e-9);
            let db = 10.0 * (a * a / noise).log10();
            assert!((line.snr_db - db).abs() < 2.0, "{line:?} {db}");
        }
        assert!(lines[3].false_alarm > 1e-3 && lines[3].snr_db < 7.0);
    }

    #[test]
    fn analytic_false_alarms_come_as_often_as_they_say() {
        // Each p-value is uniform under noise: shares below 0.1 and 0.01, of 3000 lines (correlated ones among them).
        for segments in [Segments::of(4096), Segments::of(512)] {
            let mut values = Vec::new();
            for seed in 0..150 {
                let x = Noise::new(1000 + seed).normals(4096);
                let s = psd(&x, FS, &segments).unwrap();
                let lines = harmonics(&s, 93.0, 0.0, 20).unwrap();
                values.extend(lines.iter().map(|l| l.false_alarm));
            }
            for (level, slack) in [(0.1, 0.25), (0.01, 0.6)] {
                let share = values.iter().filter(|p| **p <= level).count() as f64;
                let ratio = share / values.len() as f64 / level;
                assert!((ratio - 1.0).abs() < slack, "{segments:?} {level} {ratio}");
            }
        }
    }

    #[test]
    fn prop_odd_input_is_an_error_or_empty() {
        let s = psd(&comb(0.1, 2), FS, &Segments::of(1024)).unwrap();
        assert!(harmonics(&s, -1.0, 0.0, 3).is_err());
        assert!(harmonics(&s, 100.0, 60.0, 3).is_err());
        assert!(harmonics(&s, f64::NAN, 0.0, 3).is_err());
        assert!(harmonics(&s, 5000.0, 1.0, 3).unwrap().is_empty());
        // As many as the spectrum holds, and no search beyond its end.
        assert_eq!(harmonics(&s, 100.0, 1.0, usize::MAX).unwrap().len(), 20);
        let short = psd(&[1.0; 16], FS, &Segments::of(16)).unwrap();
        assert!(harmonics(&short, 500.0, 1.0, 3).is_err());
        let zero = psd(&[0.0; 1024], FS, &Segments::of(1024)).unwrap();
        let lines = harmonics(&zero, 500.0, 1.0, 3).unwrap();
        assert!(lines.iter().all(|l| l.amplitude.is_finite() && l.false_alarm == 1.0));
    }
}
