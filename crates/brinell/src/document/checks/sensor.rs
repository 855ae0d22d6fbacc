//! The measurement chain.

use super::{Checker, short};
use crate::signal::decimate::FACTOR;

/// Shortest of the noise's corners, as a share of the sample rate.
const LOWEST_CORNER: f64 = 1e-9;
/// Slowest of the chain's modes, as a share of the sample rate: a second-order section at eight times that rate has six
/// digits left there.
const SLOWEST_MODE: f64 = 1e-5;

impl Checker<'_> {
    pub(super) fn sensor(&mut self) {
        let s = &self.s.sensor;
        self.frequencies();
        if let (Some(low), Some(high)) = (s.low_cut_hz, s.high_cut_hz)
            && low >= high
        {
            self.error(
                "sensor.low_cut_hz",
                "nothing is left between the ends of the band".into(),
                format!("< {}", short(high)),
                &["sensor.high_cut_hz"],
            );
        }
        if s.noise_rms_m_per_s2.is_some() && s.noise_snr_db.is_some() {
            self.error(
                "sensor.noise_snr_db",
                "the noise's level is given twice".into(),
                "either noise_rms_m_per_s2 or noise_snr_db with noise_reference_rms_m_per_s2".into(),
                &["sensor.noise_rms_m_per_s2"],
            );
        }
        self.converter();
        let voltage = s.direction_deg.is_some() || s.converter_range_mv.is_some();
        if s.sensitivity_mv_per_m_per_s2.is_some() && !voltage {
            self.warn(
                "sensor.sensitivity_mv_per_m_per_s2",
                "changes nothing: sensor_ax and sensor_ay are in m/s^2".into(),
                "with direction_deg (a channel in mV) or converter_range_mv".into(),
                &[],
            );
        }
    }

    /// All of the chain's frequencies against what a run resolves.
    fn frequencies(&mut self) {
        const RATE: &str = "simulation.sample_rate_hz";
        let s = &self.s.sensor;
        let rate = self.s.simulation.sample_rate_hz;
        let top = 0.5 * FACTOR as f64 * rate;
        let mut modes = vec![
            ("sensor.mounting_resonance_hz".to_owned(), s.mounting_resonance_hz),
            ("sensor.high_cut_hz".to_owned(), s.high_cut_hz),
        ];
        for (k, mode) in s.path.iter().enumerate() {
            modes.push((format!("sensor.path.{k}.frequency_hz"), Some(mode.frequency_hz)));
        }
        for (key, frequency) in modes {
            let Some(f) = frequency else { continue };
            if f >= top {
                self.error(
                    &key,
                    format!(
                        "above the Nyquist frequency of the internal rate, {FACTOR} times the recorded one: remove this key"
                    ),
                    format!("< {}", short(top)),
                    &[RATE],
                );
            } else if f < SLOWEST_MODE * rate {
                self.error(
                    &key,
                    "too slow for the sample rate: round-off would spoil it".into(),
                    format!(">= {}", short(SLOWEST_MODE * rate)),
                    &[RATE],
                );
            }
        }
        if let Some(low) = s.low_cut_hz
            && low >= 0.5 * rate
        {
            self.error(
                "sensor.low_cut_hz",
                "nothing of the record would be left".into(),
                format!("< {}", short(0.5 * rate)),
                &[RATE],
            );
        }
        let corner = s.noise_corner_hz;
        if corner > 0.0 && !(LOWEST_CORNER * rate..0.5 * rate).contains(&corner) {
            self.error(
                "sensor.noise_corner_hz",
                "out of reach of the sample rate".into(),
                format!(">= {} and < {}", short(LOWEST_CORNER * rate), short(0.5 * rate)),
                &[RATE],
            );
        }
    }

    fn converter(&mut self) {
        const BITS: &str = "sensor.converter_bits";
        const RANGE: &str = "sensor.converter_range_m_per_s2";
        const VOLTS: &str = "sensor.converter_range_mv";
        let s = &self.s.sensor;
        let either = || "converter_bits with converter_range_m_per_s2 or converter_range_mv".into();
        let (range, volts) = (s.converter_range_m_per_s2.is_some(), s.converter_range_mv.is_some());
        // 0 represents bits that could not be read.
        match s.converter_bits {
            Some(0) => {}
            Some(_) if !range && !volts => {
                self.error(BITS, "an ADC's steps follow from its range, which is not given".into(), either(), &[])
            }
            Some(_) if range && volts => self.error(VOLTS, "the ADC's range is given twice".into(), either(), &[RANGE]),
            None if range => self.error(RANGE, "a range without an ADC".into(), either(), &[]),
            None if volts => self.error(VOLTS, "a range without an ADC".into(), either(), &[]),
            _ => {}
        }
        if volts && self.s.sensor.sensitivity_mv_per_m_per_s2.is_none() {
            self.error(
                VOLTS,
                "a voltage means nothing without the sensor's sensitivity".into(),
                "with sensitivity_mv_per_m_per_s2; or converter_range_m_per_s2".into(),
                &[],
            );
        }
    }
}
