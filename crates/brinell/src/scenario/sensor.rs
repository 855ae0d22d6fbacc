//! `[sensor]`: what is between the outer ring and the record.

use super::choices::NoiseColour;
use super::unset::{sections, unset};

sections! {
    /// One mode of the structure between ring and sensor.
    pub struct PathMode {
        /// Undamped natural frequency, Hz.
        pub frequency_hz: f64,
        /// Share of critical damping.
        pub damping_ratio: f64,
        /// Participation at the sensor: 1 and one mode is a mass on a spring; negative moves against the ring.
        pub gain: f64,
    }
}

/// `[sensor]`: what is between the outer ring's acceleration and the record. What is not given is not there.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// The axis of a channel of its own, degrees counter-clockwise from +X.
    pub direction_deg: Option<f64>,
    /// mV for each m/s^2, of that channel and of the ADC.
    pub sensitivity_mv_per_m_per_s2: Option<f64>,
    /// Resonance of the sensor on its mounting, Hz.
    pub mounting_resonance_hz: Option<f64>,
    /// Its share of critical damping.
    pub mounting_damping_ratio: f64,
    /// Lower end of the band, Hz, -3 dB, first order.
    pub low_cut_hz: Option<f64>,
    /// Upper end of the band, Hz, -3 dB, second-order Butterworth.
    pub high_cut_hz: Option<f64>,
    /// Standard deviation of the noise, m/s^2; or the next two.
    pub noise_rms_m_per_s2: Option<f64>,
    /// Level of a signal of the next key's RMS over the noise, dB.
    pub noise_snr_db: Option<f64>,
    /// The RMS that the ratio refers to, m/s^2.
    pub noise_reference_rms_m_per_s2: f64,
    /// Its colour.
    pub noise_colour: NoiseColour,
    /// Below this the noise's density is flat, Hz; white noise does not use it.
    pub noise_corner_hz: f64,
    /// Which noise.
    pub noise_seed: u64,
    /// Bits of the ADC.
    pub converter_bits: Option<usize>,
    /// Its ends, plus and minus, m/s^2; or the next one.
    pub converter_range_m_per_s2: Option<f64>,
    /// Its ends, mV.
    pub converter_range_mv: Option<f64>,
    /// Modes between ring and sensor.
    pub path: Vec<PathMode>,
}

/// The full scale of an ADC, plus and minus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// m/s^2.
    Acceleration(f64),
    /// mV.
    Voltage(f64),
}

impl Sensor {
    /// No sensor: the record is the ring's own acceleration.
    pub fn off() -> Self {
        Self {
            direction_deg: None,
            sensitivity_mv_per_m_per_s2: None,
            mounting_resonance_hz: None,
            mounting_damping_ratio: 0.0,
            low_cut_hz: None,
            high_cut_hz: None,
            noise_rms_m_per_s2: None,
            noise_snr_db: None,
            noise_reference_rms_m_per_s2: 0.0,
            noise_colour: NoiseColour::White,
            noise_corner_hz: 0.0,
            noise_seed: 0,
            converter_bits: None,
            converter_range_m_per_s2: None,
            converter_range_mv: None,
            path: Vec::new(),
        }
    }

    /// Whether there is anything between ring and record.
    pub fn is_on(&self) -> bool {
        // No `..`: a key that is added makes a difference by itself, or its `_` says with which it does.
        let Self {
            direction_deg,
            sensitivity_mv_per_m_per_s2: _, // the direction's, the converter's
            mounting_resonance_hz,
            mounting_damping_ratio: _,
            low_cut_hz,
            high_cut_hz,
            noise_rms_m_per_s2: _, // noise_rms()
            noise_snr_db: _,
            noise_reference_rms_m_per_s2: _,
            noise_colour: _,
            noise_corner_hz: _,
            noise_seed: _,
            converter_bits: _, // converter()
            converter_range_m_per_s2: _,
            converter_range_mv: _,
            path,
        } = self;
        let filters = [mounting_resonance_hz, low_cut_hz, high_cut_hz];
        direction_deg.is_some()
            || filters.iter().any(|filter| filter.is_some())
            || self.noise_rms().is_some()
            || self.converter().is_some()
            || !path.is_empty()
    }

    /// Standard deviation of the noise, m/s^2, whichever way it is given.
    pub fn noise_rms(&self) -> Option<f64> {
        let below = |db: f64| self.noise_reference_rms_m_per_s2 * 10f64.powf(-db / 20.0);
        self.noise_rms_m_per_s2.or(self.noise_snr_db.map(below))
    }

    /// Bits and full scale of the ADC, where there is one.
    pub fn converter(&self) -> Option<(usize, Range)> {
        let volts = self.converter_range_mv.map(Range::Voltage);
        self.converter_bits.zip(self.converter_range_m_per_s2.map(Range::Acceleration).or(volts))
    }
}

unset! {
    Sensor: Self::off();
}
