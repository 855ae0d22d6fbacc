//! The keys of `[sensor]`. All are optional: what is not given is not there.

use super::keys::{Keys, assumed, stated};
use super::spec::key;
use crate::scenario::{NoiseColour, PathMode, Sensor, Unset};

/// Largest share of critical damping; a mode beyond is no resonance, and its equations here need one below 1.
const MOST_DAMPED: f64 = 0.95;

pub(super) fn sensor(k: &mut Keys, s: &mut Sensor) {
    k.optional(
        key("direction_deg", "an axis of its own, counter-clockwise from +x: adds the channel sensor_out"),
        &mut s.direction_deg,
    );
    k.optional(
        key("sensitivity_mv_per_m_per_s2", "of sensor_out, which is then in mV, and of converter_range_mv").above(0.0),
        &mut s.sensitivity_mv_per_m_per_s2,
    );
    k.optional(
        key("mounting_resonance_hz", "of the sensor on its stud, glue or magnet; damped").above(0.0),
        &mut s.mounting_resonance_hz,
    );
    let mounted = s.mounting_resonance_hz.is_some();
    k.key_where(
        key("mounting_damping_ratio", "share of critical damping").plausible(0.005, 0.1).above(0.0).to(MOST_DAMPED),
        (mounted, "mounting_resonance_hz is given"),
        assumed(0.02, "a lightly damped sensor"),
        &mut s.mounting_damping_ratio,
    );
    k.optional(key("low_cut_hz", "lower end of the band, -3 dB, first order").above(0.0), &mut s.low_cut_hz);
    k.optional(
        key("high_cut_hz", "upper end of the band, -3 dB, Butterworth of second order").above(0.0),
        &mut s.high_cut_hz,
    );
    noise(k, s);
    k.optional(key("converter_bits", "whole steps: 2^bits of them").from(2.0).to(32.0), &mut s.converter_bits);
    k.optional(key("converter_range_m_per_s2", "its ends, plus and minus").above(0.0), &mut s.converter_range_m_per_s2);
    k.optional(key("converter_range_mv", "the same as a voltage").above(0.0), &mut s.converter_range_mv);
    k.tables(key("path", "modes of the structure between ring and sensor"), &mut s.path, PathMode::unset, path_mode);
    // A key without a meaning holds nothing, so that a scenario equals the one it reads back to.
    let silent = s.noise_rms_m_per_s2.is_none() && s.noise_snr_db.is_none();
    if !mounted {
        s.mounting_damping_ratio = 0.0;
    }
    if s.noise_snr_db.is_none() {
        s.noise_reference_rms_m_per_s2 = 0.0;
    }
    if silent || s.noise_colour == NoiseColour::White {
        s.noise_corner_hz = 0.0;
    }
}

fn noise(k: &mut Keys, s: &mut Sensor) {
    k.optional(key("noise_rms_m_per_s2", "standard deviation of the noise").from(0.0), &mut s.noise_rms_m_per_s2);
    k.optional(
        key("noise_snr_db", "instead: a signal of the reference RMS over the noise").from(-200.0).to(400.0),
        &mut s.noise_snr_db,
    );
    k.only_where(
        key("noise_reference_rms_m_per_s2", "the signal that the ratio refers to").above(0.0),
        s.noise_snr_db.is_some(),
        "noise_snr_db is given",
        &mut s.noise_reference_rms_m_per_s2,
    );
    const NOISY: &str = "noise_rms_m_per_s2 or noise_snr_db is given";
    let noisy = s.noise_rms_m_per_s2.is_some() || s.noise_snr_db.is_some();
    k.key_where(
        key("noise_colour", "its spectrum"),
        (noisy, NOISY),
        assumed(NoiseColour::White, "the usual model of electronic noise"),
        &mut s.noise_colour,
    );
    k.key_where(
        key("noise_corner_hz", "below it the density is flat").above(0.0),
        (noisy && s.noise_colour != NoiseColour::White, "noise_colour is pink or brown"),
        assumed(1.0, "slower than any shaft of interest"),
        &mut s.noise_corner_hz,
    );
    k.key_where(key("noise_seed", "which noise"), (noisy, NOISY), stated(1, "the first"), &mut s.noise_seed);
}

fn path_mode(k: &mut Keys, m: &mut PathMode) {
    use super::keys::Fallback::Required;
    k.key(key("frequency_hz", "undamped natural frequency").above(0.0), Required, &mut m.frequency_hz);
    k.key(
        key("damping_ratio", "share of critical damping").plausible(0.005, 0.1).above(0.0).to(MOST_DAMPED),
        assumed(0.02, "steel, bolted together"),
        &mut m.damping_ratio,
    );
    k.key(
        key("gain", "participation at the sensor; one mode with 1 is a mass on a spring").from(-100.0).to(100.0),
        Required,
        &mut m.gain,
    );
}
