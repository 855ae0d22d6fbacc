//! How severe a vibration is, whatever causes it: RMS velocity from 10 to 1000 Hz and its zone by ISO 20816-3; levels
//! of the band demodulated.

use super::{Quantity, Unit};
use crate::integrate::{Motion, fade};
use crate::{Band, Blocks, Estimate, Indicator, SignalError, band_pass, envelope, velocity_rms};

/// The band of ISO 20816-3 for shafts of 600 r/min and more, Hz.
pub const SEVERITY_BAND: Band = Band { low: 10.0, high: 1000.0 };
/// Periods of the band's lower edge that a record has to hold.
const PERIODS: f64 = 10.0;
/// Speeds that the zones are for, r/min. Below 600 the standard measures from 2 Hz.
const SPEEDS: (f64, f64, f64) = (120.0, 600.0, 30_000.0);

/// Why no velocity is told.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoVelocity {
    /// It does not follow from the signal.
    #[error("not known, as a signal in {0} is neither an acceleration nor a velocity")]
    Unit(String),
    /// The signal ends below the band's upper edge.
    #[error(
        "not known, as sampled at {0} Hz the signal ends at {half} Hz: it takes more than 2000 Hz", half = 0.5 * .0
    )]
    Rate(f64),
    /// Too short for the lower edge.
    #[error("not known, as {0:.3} s are too short for 10 Hz: it takes 1 s or more")]
    Length(f64),
    /// The samples are no signal.
    #[error("not known: {0}")]
    Signal(#[from] SignalError),
}

/// RMS velocity in [`SEVERITY_BAND`], m/s, of a signal in `unit` sampled at `fs` Hz; intervals are of whole revolutions
/// of `shaft` Hz.
///
/// # Errors
/// [`NoVelocity`] says why there is none.
pub fn severity(x: &[f64], unit: &Unit, fs: f64, shaft: f64) -> Result<Estimate, NoVelocity> {
    let from = match unit.quantity {
        Quantity::Acceleration => Motion::Acceleration,
        Quantity::Velocity => Motion::Velocity,
        _ => return Err(NoVelocity::Unit(unit.name.clone())),
    };
    if fs <= 2.0 * SEVERITY_BAND.high {
        return Err(NoVelocity::Rate(fs));
    }
    let seconds = x.len() as f64 / fs;
    if seconds < PERIODS / SEVERITY_BAND.low {
        return Err(NoVelocity::Length(seconds));
    }
    Ok(velocity_rms(&unit.in_si(x), fs, from, SEVERITY_BAND, 1.0 / shaft)?)
}

/// A class of machines of ISO 20816-3.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MachineClass {
    /// Above 300 kW to 50 MW, or a shaft height of 315 mm and more; rigid support.
    LargeRigid,
    /// The same on a flexible support.
    LargeFlexible,
    /// Above 15 to 300 kW, or a shaft height of 160 to below 315 mm; rigid support.
    MediumRigid,
    /// The same on a flexible support.
    MediumFlexible,
}

/// What a vibration means for a machine of a class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zone {
    /// As of newly commissioned machines.
    A,
    /// Acceptable for unrestricted long-term operation.
    B,
    /// Unsatisfactory for long-term operation.
    C,
    /// Severe enough to damage the machine.
    D,
}

/// Why no zone is told.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoZone {
    /// The standard's band begins lower.
    #[error(
        "not known, as for shafts below 600 r/min the standard measures from 2 Hz, and this one turns at {0:.0} r/min"
    )]
    Slow(f64),
    /// No zone is for it.
    #[error("not known, as the standard is for 120 to 30000 r/min, and this shaft turns at {0:.0} r/min")]
    Speed(f64),
    /// The level is none.
    #[error("not known, as {0} m/s is no RMS velocity")]
    Velocity(f64),
    /// No running machine is so quiet.
    #[error("not known, as no running machine vibrates as little as {} mm/s: is the unit of the signal right?", crate::short(1e3 * .0, 3))]
    Quiet(f64),
}

/// RMS velocity below which no zone is told, m/s: a twelfth of the least of 62 measured records, healthy and damaged (those of docs/src/measured.md).
/// A signal in g that is called one in mm/s^2 lies 9807 times lower.
const QUIETEST: f64 = 1e-5;

impl MachineClass {
    /// All, in the order of the standard's tables.
    pub const ALL: [Self; 4] = [Self::LargeRigid, Self::LargeFlexible, Self::MediumRigid, Self::MediumFlexible];

    /// How it is given, for a sentence, and boundaries A/B, B/C and C/D, mm/s RMS, of ISO 20816-3.
    fn row(self) -> (&'static str, &'static str, [f64; 3]) {
        match self {
            Self::LargeRigid => ("1-rigid", "group 1, rigid support", [2.3, 4.5, 7.1]),
            Self::LargeFlexible => ("1-flexible", "group 1, flexible support", [3.5, 7.1, 11.0]),
            Self::MediumRigid => ("2-rigid", "group 2, rigid support", [1.4, 2.8, 4.5]),
            Self::MediumFlexible => ("2-flexible", "group 2, flexible support", [2.3, 4.5, 7.1]),
        }
    }

    /// As it is given: `1-rigid`.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// For a sentence.
    pub fn words(self) -> &'static str {
        self.row().1
    }

    /// Boundaries A/B, B/C and C/D, mm/s RMS, of ISO 20816-3.
    pub fn boundaries(self) -> [f64; 3] {
        self.row().2
    }

    /// The zone of an RMS velocity (m/s) of a machine whose shaft turns at `rpm`.
    ///
    /// # Errors
    /// [`NoZone`] where the standard is not for that speed, or the velocity is negative, not finite, or below that of any running machine.
    pub fn zone(self, velocity: f64, rpm: f64) -> Result<Zone, NoZone> {
        let (least, from_ten, most) = SPEEDS;
        match rpm {
            _ if !(least..=most).contains(&rpm) => return Err(NoZone::Speed(rpm)),
            _ if rpm < from_ten => return Err(NoZone::Slow(rpm)),
            _ if !(velocity >= 0.0 && velocity.is_finite()) => return Err(NoZone::Velocity(velocity)),
            _ if velocity < QUIETEST => return Err(NoZone::Quiet(velocity)),
            _ => {}
        }
        let beyond = self.boundaries().iter().filter(|b| 1e3 * velocity > **b).count();
        Ok(Zone::ALL[beyond.min(3)])
    }
}

impl Zone {
    const ALL: [Self; 4] = [Self::A, Self::B, Self::C, Self::D];

    /// A to D.
    pub fn name(self) -> &'static str {
        ["A", "B", "C", "D"][self as usize]
    }

    /// What the standard says of it, in short.
    pub fn words(self) -> &'static str {
        match self {
            Self::A => "as of newly commissioned machines",
            Self::B => "acceptable for unrestricted long-term operation",
            Self::C => "unsatisfactory for long-term operation",
            Self::D => "severe enough to damage the machine",
        }
    }
}

/// Levels of one band, in the signal's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandLevel {
    /// The band, Hz.
    pub band: Band,
    /// Kurtosis of what lies within it: 3 for noise.
    pub kurtosis: Estimate,
    /// RMS of the envelope.
    pub envelope_rms: Estimate,
    /// Peak of the envelope, that of a revolution.
    pub envelope_peak: Estimate,
}

/// Of a signal sampled at `fs` Hz; averages are over whole revolutions of `shaft` Hz. The envelope is the modulus of
/// the analytic signal: an amplitude A has an envelope A. Six periods of the band's lower edge at either end are left
/// out, or a fifth of the signal: the ends are faded, so that a strong line below the band is not in it, where the signal holds
/// sixty periods of the edge. `None` where nothing lies within the band.
pub fn band_level(x: &[f64], fs: f64, band: Band, shaft: f64) -> Option<BandLevel> {
    let mut faded = x.to_vec();
    let end = fade(&mut faded, fs, band.low);
    let envelope = Blocks::of(&envelope(&faded, fs, band).ok()?[end..x.len() - end], fs / shaft);
    Some(BandLevel {
        band,
        kurtosis: kurtosis_within((&faded, end), fs, band, shaft)?,
        envelope_rms: envelope.estimate(Indicator::Rms)?,
        envelope_peak: envelope.estimate(Indicator::Peak)?,
    })
}

/// [`BandLevel::kurtosis`] alone.
pub(super) fn band_kurtosis(x: &[f64], fs: f64, band: Band, shaft: f64) -> Option<Estimate> {
    let mut faded = x.to_vec();
    let end = fade(&mut faded, fs, band.low);
    kurtosis_within((&faded, end), fs, band, shaft)
}

/// Of a faded signal, of which so many samples at either end do not count.
fn kurtosis_within((faded, end): (&[f64], usize), fs: f64, band: Band, shaft: f64) -> Option<Estimate> {
    let inside = band_pass(faded, fs, band).ok()?;
    Blocks::of(&inside[end..faded.len() - end], fs / shaft).estimate(Indicator::Kurtosis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn sine(n: usize, fs: f64, f: f64, amplitude: f64) -> Vec<f64> {
        let at = |i: usize| amplitude * (TAU * f * i as f64 / fs).sin();
        (0..n).map(at).collect()
    }

    /// 1 g RMS at 159.155 Hz, a calibrator's, is 9.80665 mm/s.
    #[test]
    fn analytic_a_calibrator_has_its_velocity_in_every_unit() {
        let (fs, f, n) = (12_000.0, 500.0 / std::f64::consts::PI, 24_000);
        for (unit, amplitude) in [
            ("g", 2f64.sqrt()),
            ("m/s^2", 9.80665 * 2f64.sqrt()),
            ("mm/s", 9.80665 * 2f64.sqrt()),
            ("in/s", 9.80665 * 2f64.sqrt() / 25.4),
        ] {
            let x = sine(n, fs, f, amplitude);
            let found = severity(&x, &Unit::of(unit), fs, 25.0).unwrap().value;
            assert!((1e3 * found / 9.80665 - 1.0).abs() < 2e-3, "{unit}: {found}");
        }
    }

    #[test]
    fn prop_what_tells_no_velocity_says_why() {
        let x = sine(24_000, 12_000.0, 160.0, 1.0);
        let of = |x: &[f64], unit, fs| {
            let none = severity(x, &Unit::of(unit), fs, 25.0).unwrap_err();
            none.to_string()
        };
        assert!(of(&x, "V", 12_000.0).contains("a signal in V is neither"));
        assert!(of(&x, "um", 12_000.0).contains("a signal in µm is neither"));
        assert!(of(&x, "g", 2000.0).contains("sampled at 2000 Hz the signal ends at 1000 Hz"));
        assert!(of(&x[..11_000], "g", 12_000.0).contains("0.917 s are too short for 10 Hz"));
    }

    #[test]
    fn prop_a_constant_has_no_level_in_a_band() {
        for value in [0.1, 1.0, 9.81] {
            let level = band_level(&vec![value; 24_000], 12_000.0, Band::between(1000.0, 3000.0), 30.0);
            assert!(
                level.is_none_or(|level| level.envelope_peak.value == 0.0 && level.kurtosis.value.is_nan()),
                "{level:?}"
            );
        }
    }

    #[test]
    fn lit_zones_of_iso_20816_3() {
        use MachineClass::{LargeFlexible, LargeRigid, MediumFlexible, MediumRigid};
        for (class, mm_s, zone) in [
            (LargeRigid, 2.3, Zone::A),
            (LargeRigid, 2.4, Zone::B),
            (LargeRigid, 7.2, Zone::D),
            (LargeFlexible, 7.2, Zone::C),
            (LargeFlexible, 11.1, Zone::D),
            (MediumRigid, 1.4, Zone::A),
            (MediumRigid, 2.9, Zone::C),
            (MediumRigid, 4.6, Zone::D),
            (MediumFlexible, 4.4, Zone::B),
        ] {
            assert_eq!(class.zone(1e-3 * mm_s, 1500.0), Ok(zone), "{class:?} {mm_s}");
        }
        assert_eq!(LargeRigid.zone(1e-3, 500.0), Err(NoZone::Slow(500.0)));
        assert_eq!(LargeRigid.zone(1e-3, 100.0), Err(NoZone::Speed(100.0)));
        assert_eq!(LargeRigid.zone(1e-3, 31_000.0), Err(NoZone::Speed(31_000.0)));
        assert_eq!(LargeRigid.zone(1.94e-8, 1500.0), Err(NoZone::Quiet(1.94e-8)));
        assert_eq!(LargeRigid.zone(1.2e-4, 1500.0), Ok(Zone::A), "the least of a measured record");
        for none in [f64::NAN, -1e-3, f64::INFINITY] {
            assert!(matches!(LargeRigid.zone(none, 1500.0), Err(NoZone::Velocity(_))), "{none}");
        }
    }

    /// A strong line far below the band, whose ends do not meet, is not in the band: noise has a kurtosis of 3 and, by
    /// Rayleigh, an envelope of sqrt(2) times its RMS.
    #[test]
    fn analytic_a_line_below_the_band_leaves_its_noise_as_it_is() {
        let (fs, sigma) = (12_000.0, 0.03);
        let band = Band::between(500.0, 5500.0);
        for (seconds, f) in [(1, 29.7), (2, 49.3), (4, 49.3)] {
            let mut x = sine(seconds * 12_000, fs, f, 3.0);
            let noise = crate::test_signals::Noise::new(7).normals(x.len());
            x.iter_mut().zip(noise).for_each(|(x, n)| *x += sigma * n);
            let found = band_level(&x, fs, band, 25.0).unwrap();
            let rms = 2f64.sqrt() * sigma * (5000.0_f64 / 6000.0).sqrt();
            // Scatter of a second of noise: sqrt(24 / n) = 0.045, and 0.7 %.
            assert!((found.kurtosis.value - 3.0).abs() < 0.2, "{seconds} s: kurtosis {:?}", found.kurtosis);
            assert!((found.envelope_rms.value / rms - 1.0).abs() < 0.03, "{seconds} s: {:?}", found.envelope_rms);
        }
    }

    /// A sine's kurtosis is 1.5, and its envelope its amplitude.
    #[test]
    fn analytic_levels_of_a_sine_in_its_band() {
        let fs = 12_000.0;
        let mut x = sine(24_000, fs, 2900.0, 2.0);
        let other = sine(24_000, fs, 500.0, 30.0);
        x.iter_mut().zip(other).for_each(|(x, o)| *x += o);
        let found = band_level(&x, fs, Band::between(2000.0, 4000.0), 25.0).unwrap();
        assert!((found.kurtosis.value - 1.5).abs() < 1e-3);
        assert!((found.envelope_rms.value - 2.0).abs() < 1e-2);
        assert!((found.envelope_peak.value - 2.0).abs() < 1e-1);
    }
}
