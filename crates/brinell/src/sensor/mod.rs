//! From the outer ring's acceleration to what an accelerometer and its data logger hold of it: `[sensor]` of a
//! scenario.
//!
//! In this order: the transfer path, the mounting's resonance, the amplifier's band; all linear, at the fast grid's
//! rate, before the anti-alias filter removes what lies above half the sample rate, so a resonance beyond that still
//! shows in what is left below. Then, at the sample rate, noise and the ADC. Along x and y (and along the sensor's own
//! direction, if it has one) are sensors of one kind, with noise of their own.
//!
//! The path is that of a point on a structure whose foot moves with the ring: its acceleration over the ring's is 1 -
//! sum g_k s^2 / (s^2 + 2 zeta_k w_k s + w_k^2), the modes of a proportionally damped structure on a moving foot (R. W.
//! Clough and J. Penzien, Dynamics of structures, 2nd ed. (1993), section 12-5). It is 1 at low frequencies; one mode
//! with g = 1 is a mass on a spring and a damper. SI throughout.

mod adc;
mod filter;
mod noise;

use std::f64::consts::FRAC_1_SQRT_2;

use realfft::num_complex::Complex;

use crate::scenario::{Range, Sensor};
use crate::signal::decimate::{FACTOR, PASSBAND};
use adc::Adc;
use filter::{Mode, Passes, Running, low_cut, low_cut_response};
use noise::{Level, Noise};

/// Name of the channel along the sensor's own direction.
pub(crate) const OWN_CHANNEL: &str = "sensor_out";

/// A scenario's sensor, ready for runs at a sample rate.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Unit vector of the sensor's own direction, where it has one.
    direction: Option<[f64; 2]>,
    /// mV for each m/s^2, on the sensor's own channel.
    sensitivity: Option<f64>,
    /// Participation and mode of each part of the path.
    path: Vec<(f64, Mode)>,
    /// In series: mounting, upper end of the band.
    modes: Vec<Mode>,
    /// Hz.
    low_cut: Option<f64>,
    noise: Option<Level>,
    adc: Option<Adc>,
    rate: f64,
}

impl Chain {
    /// `None` where the scenario asks for nothing: the signal is then the ring's own.
    pub fn new(sensor: &Sensor, sample_rate: f64) -> Option<Self> {
        if !sensor.is_on() {
            return None;
        }
        let deflection = |frequency, damping| Mode { frequency, damping, passes: Passes::Deflection };
        let mounting = sensor.mounting_resonance_hz.map(|f| deflection(f, sensor.mounting_damping_ratio));
        let high_cut = sensor.high_cut_hz.map(|f| deflection(f, FRAC_1_SQRT_2));
        let path = sensor.path.iter().map(|m| {
            let mode = Mode { frequency: m.frequency_hz, damping: m.damping_ratio, passes: Passes::Transmitted };
            (m.gain, mode)
        });
        Some(Self {
            direction: sensor.direction_deg.map(|d| {
                let angle = d.to_radians();
                [angle.cos(), angle.sin()]
            }),
            sensitivity: sensor.sensitivity_mv_per_m_per_s2,
            path: path.collect(),
            modes: mounting.into_iter().chain(high_cut).collect(),
            low_cut: sensor.low_cut_hz,
            noise: sensor.noise_rms().map(|rms| Level {
                rms,
                colour: sensor.noise_colour,
                corner: sensor.noise_corner_hz,
                seed: sensor.noise_seed,
            }),
            adc: sensor.converter().map(|(bits, range)| {
                let full_scale = match range {
                    Range::Acceleration(a) => a,
                    Range::Voltage(mv) => mv / sensor.sensitivity_mv_per_m_per_s2.unwrap_or(1.0),
                };
                Adc::new(bits, full_scale)
            }),
            rate: sample_rate,
        })
    }

    /// Channels: x, y, and the sensor's own if it has a direction.
    pub fn channels(&self) -> usize {
        2 + usize::from(self.direction.is_some())
    }

    /// Unit of the sensor's own channel; along x and y it is m/s^2.
    pub fn own_unit(&self) -> &'static str {
        own_unit(self.sensitivity)
    }

    /// What the sensor's own direction makes of the ring's acceleration, m/s^2.
    pub fn along(&self, [x, y]: [f64; 2]) -> Option<f64> {
        self.direction.map(|[cos, sin]| cos * x + sin * y)
    }

    /// Response at `f` Hz from the ring's acceleration to the sensor's, both in m/s^2; the anti-alias filter is not in
    /// it.
    pub fn response(&self, f: f64) -> Complex<f64> {
        let path: Complex<f64> = self.path.iter().map(|(gain, mode)| (mode.response(f) - 1.0) * *gain).sum();
        let modes: Complex<f64> = self.modes.iter().map(|mode| mode.response(f)).product();
        let low = self.low_cut.map_or(Complex::new(1.0, 0.0), |cut| low_cut_response(cut, f));
        (path + 1.0) * modes * low
    }

    /// Whether [`response`](Self::response) is anything but 1.
    pub fn shapes_the_signal(&self) -> bool {
        !self.path.is_empty() || !self.modes.is_empty() || self.low_cut.is_some()
    }

    /// Standard deviation of the noise, m/s^2.
    pub fn noise_rms(&self) -> Option<f64> {
        Some(self.noise.as_ref()?.rms)
    }

    /// The converter's step, m/s^2.
    pub fn step(&self) -> Option<f64> {
        Some(self.adc.as_ref()?.step())
    }
}

/// Unit of a sensor's own channel.
pub(crate) fn own_unit(sensitivity: Option<f64>) -> &'static str {
    if sensitivity.is_some() { "mV" } else { "m/s^2" }
}

/// What became of one channel of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ChannelRecord {
    /// Samples beyond the ADC's full scale, over the whole run.
    pub clipped: u64,
    /// Samples since statistics began.
    pub counted: u64,
    /// Sum of the squares of those before noise and ADC, (m/s^2)^2.
    signal_square: f64,
    /// The same of the noise that was added.
    noise_square: f64,
    /// What the ADC read first, m/s^2.
    first: Option<f64>,
    /// Whether it read anything else later.
    varies: bool,
}

impl ChannelRecord {
    /// Whether the ADC read one value throughout: its step is larger than the signal. False without an ADC.
    pub fn is_constant(&self) -> bool {
        self.first.is_some() && !self.varies
    }

    /// RMS before noise and ADC, m/s^2; `None` before statistics begin.
    pub fn signal_rms(&self) -> Option<f64> {
        self.rms(self.signal_square)
    }

    /// RMS of the noise in the record, m/s^2: of coloured noise in a short record it may be far from the level asked for.
    pub fn noise_rms(&self) -> Option<f64> {
        self.rms(self.noise_square)
    }

    /// RMS of the signal over that of the noise, dB; `None` where there is none of either.
    pub fn signal_to_noise_db(&self) -> Option<f64> {
        let (signal, noise) = (self.signal_rms()?, self.noise_rms()?);
        (signal > 0.0 && noise > 0.0).then(|| 20.0 * (signal / noise).log10())
    }

    fn rms(&self, square: f64) -> Option<f64> {
        (self.counted > 0).then(|| (square / self.counted as f64).sqrt())
    }
}

/// Filters of one channel.
#[derive(Debug, Clone)]
struct Line {
    /// Of the path: gain of what goes straight through, then gain and filter of each mode.
    direct: f64,
    path: Vec<(f64, Running)>,
    series: Vec<Running>,
}

impl Line {
    fn push(&mut self, x: f64) -> f64 {
        let mut y = self.direct * x;
        for (gain, mode) in &mut self.path {
            y += *gain * mode.push(x);
        }
        self.series.iter_mut().fold(y, |y, filter| filter.push(y))
    }
}

/// The chain during one run. Nothing is allocated after the start.
#[derive(Debug, Clone)]
pub(crate) struct Sensing {
    lines: Vec<Line>,
    noise: Vec<Noise>,
    adc: Option<Adc>,
    sensitivity: f64,
    records: Vec<ChannelRecord>,
}

impl Sensing {
    /// At rest before t = 0.
    pub(crate) fn new(chain: &Chain) -> Self {
        let fast = chain.rate * FACTOR as f64;
        let run = |mode: &Mode| Running::new(mode.section(fast, PASSBAND * chain.rate));
        let line = Line {
            direct: 1.0 - chain.path.iter().map(|(gain, _)| gain).sum::<f64>(),
            path: chain.path.iter().map(|(g, mode)| (*g, run(mode))).collect(),
            series: chain.modes.iter().map(run).chain(chain.low_cut.map(|f| Running::new(low_cut(f, fast)))).collect(),
        };
        let channels = chain.channels();
        Self {
            lines: vec![line; channels],
            noise: chain.noise.map_or(Vec::new(), |level| {
                let one = |channel| Noise::new(level, chain.rate, channel);
                (0..channels as u64).map(one).collect()
            }),
            adc: chain.adc.clone(),
            sensitivity: chain.sensitivity.unwrap_or(1.0),
            records: vec![ChannelRecord::default(); channels],
        }
    }

    /// One instant of the fast grid: accelerations of the ring, one for each channel, become those at the sensor.
    pub(crate) fn fast(&mut self, channels: &mut [f64]) {
        for (line, x) in self.lines.iter_mut().zip(channels) {
            *x = line.push(*x);
        }
    }

    /// One sample, behind the anti-alias filter: adds noise and converts. `counts` where statistics do.
    pub(crate) fn sample(&mut self, channels: &mut [f64], counts: bool) {
        for (k, (record, x)) in self.records.iter_mut().zip(channels).enumerate() {
            if counts {
                record.counted += 1;
                record.signal_square += *x * *x;
            }
            if let Some(noise) = self.noise.get_mut(k) {
                let added = noise.next();
                *x += added;
                if counts {
                    record.noise_square += added * added;
                }
            }
            if let Some(adc) = &self.adc {
                let (read, clipped) = adc.read(*x);
                *x = read;
                record.clipped += u64::from(clipped);
                record.varies |= *record.first.get_or_insert(read) != read;
            }
            if k >= 2 {
                *x *= self.sensitivity;
            }
        }
    }

    /// What became of the channels: x, y, and the sensor's own if it has a direction.
    pub(crate) fn records(&self) -> &[ChannelRecord] {
        &self.records
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::PathMode;
    use crate::simulate::Decimator;
    use std::f64::consts::TAU;

    const RATE: f64 = 25_600.0;

    fn sensor() -> Sensor {
        Sensor {
            direction_deg: Some(30.0),
            mounting_resonance_hz: Some(18_000.0),
            mounting_damping_ratio: 0.03,
            low_cut_hz: Some(2.0),
            high_cut_hz: Some(9_000.0),
            path: vec![
                PathMode { frequency_hz: 900.0, damping_ratio: 0.04, gain: 0.6 },
                PathMode { frequency_hz: 4_100.0, damping_ratio: 0.02, gain: -0.3 },
            ],
            ..Sensor::off()
        }
    }

    #[test]
    fn analytic_the_whole_chain_has_the_response_stated() {
        let chain = Chain::new(&sensor(), RATE).unwrap();
        for f in [40.0, 880.0, 900.0, 2_000.0, 4_100.0, 9_000.0] {
            let mut sensing = Sensing::new(&chain);
            let mut decimator = Decimator::new(3);
            // The path's slowest part decays within 0.1 s; the low cut's own 0.08 s five times over.
            let (settle, n) = (20_000, 5_120);
            let mut sum = Complex::new(0.0, 0.0);
            let mut k = 0;
            for i in 0.. {
                let t = f64::from(i) / (8.0 * RATE);
                let x = (TAU * f * t).cos();
                let mut frame = [x, 0.0, chain.along([x, 0.0]).unwrap()];
                sensing.fast(&mut frame);
                let Some(out) = decimator.push(&frame) else {
                    continue;
                };
                assert_eq!(out[1], 0.0);
                assert!((out[2] - 30f64.to_radians().cos() * out[0]).abs() < 1e-9);
                if k >= settle {
                    // n samples are 0.2 s: whole periods of every frequency here.
                    let turn = TAU * f * f64::from(k) / RATE;
                    sum += Complex::from_polar(2.0 / f64::from(n), -turn) * out[0];
                }
                k += 1;
                if k == settle + n {
                    break;
                }
            }
            let exact = chain.response(f);
            let error = (sum - exact).norm() / exact.norm();
            // The path's parts of velocity are the coarsest; the anti-alias filter's ripple is 1e-4.
            assert!(error < 3e-3, "{f} Hz: {sum} against {exact}: {error:e}");
        }
    }

    #[test]
    fn analytic_one_full_mode_is_a_mass_on_a_moved_foot() {
        let chain = Chain::new(
            &Sensor { path: vec![PathMode { frequency_hz: 500.0, damping_ratio: 0.1, gain: 1.0 }], ..Sensor::off() },
            RATE,
        )
        .unwrap();
        for f in [0.0f64, 100.0, 500.0, 2f64.sqrt() * 500.0, 3_000.0] {
            let r = f / 500.0;
            let viscous = (0.2 * r).powi(2);
            let exact = ((1.0 + viscous) / ((1.0 - r * r).powi(2) + viscous)).sqrt();
            assert!((chain.response(f).norm() / exact - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn analytic_noise_converter_and_sensitivity() {
        let sensor = Sensor {
            direction_deg: Some(90.0),
            sensitivity_mv_per_m_per_s2: Some(10.0),
            noise_rms_m_per_s2: Some(0.5),
            converter_bits: Some(12),
            converter_range_mv: Some(20.48),
            ..Sensor::off()
        };
        let chain = Chain::new(&sensor, RATE).unwrap();
        assert_eq!(chain.own_unit(), "mV");
        assert_eq!(chain.step(), Some(1e-3));
        let mut sensing = Sensing::new(&chain);
        let (mut square, n) = (0.0, 50_000);
        for k in 0..n {
            let mut frame = [5.0, 0.0, 0.0];
            sensing.sample(&mut frame, k >= 1000);
            assert!((frame[2] / 0.01).fract().abs().min(1.0 - (frame[2] / 0.01).fract().abs()) < 1e-6);
            square += frame[2].powi(2);
        }
        let [x, y, own] = sensing.records() else { panic!("three channels") };
        // 5 m/s^2 is 50 mV, of which 20.48 are held.
        assert_eq!((x.clipped, x.counted, x.signal_rms()), (n, n - 1000, Some(5.0)));
        assert!(x.is_constant() && !y.is_constant());
        // Four standard deviations are reached by 4 samples in 100 000.
        assert!(y.clipped < 12 && own.signal_rms() == Some(0.0));
        let rms = (square / n as f64).sqrt();
        assert!((rms / 5.0 - 1.0).abs() < 4.0 / (2.0 * n as f64).sqrt(), "{rms}");
        assert_eq!(Chain::new(&Sensor::off(), RATE), None);
    }
}
