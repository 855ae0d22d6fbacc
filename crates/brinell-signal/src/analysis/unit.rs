//! Units of vibration signals.

use super::error::AnalysisError;
use super::options::MACHINE_NOISE;
use std::borrow::Cow;

/// Standard gravity, the unit g, m/s^2.
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// What a signal is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Acceleration.
    Acceleration,
    /// Velocity.
    Velocity,
    /// Displacement.
    Displacement,
    /// A sensor's voltage, whose scale to vibration nobody stated.
    Voltage,
    /// A sensor's current, likewise.
    Current,
    /// Anything else.
    Other,
}

impl Quantity {
    /// For axes and headings.
    pub fn words(self) -> &'static str {
        match self {
            Quantity::Acceleration => "Acceleration",
            Quantity::Velocity => "Velocity",
            Quantity::Displacement => "Displacement",
            Quantity::Voltage => "Voltage",
            Quantity::Current => "Current",
            Quantity::Other => "Signal",
        }
    }
}

/// A unit as written, and what it is in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// As the file or the user spells it, tidied where it is a known one.
    pub name: String,
    /// What it measures.
    pub quantity: Quantity,
    /// SI units in one of it: 9.80665 for g. 1 where the unit is not known.
    pub to_si: f64,
}

impl Unit {
    /// Units that a user may name; the last line is of raw signals, whose scale to vibration nobody states.
    pub const KNOWN: &str = "m/s^2, mm/s^2, g, mg, in/s^2; m/s, mm/s, in/s; m, mm, um; or, of a raw signal, V, mV, uV, A, mA, N, Pa, counts";

    /// What a simulation's sensor lacks of a machine's white noise ([`MACHINE_NOISE`]), RMS in
    /// this unit, where its own, if it has one, has the RMS `own`, m/s^2: both together are as strong. `None` where it
    /// lacks nothing; 0 for what is no acceleration, of which nothing is known.
    pub fn missing_noise(&self, own: Option<f64>) -> Option<f64> {
        let own = own.unwrap_or(0.0);
        let missing = (MACHINE_NOISE.powi(2) - own * own).max(0.0).sqrt();
        (missing > 0.0).then_some(match self.quantity {
            Quantity::Acceleration => missing / self.to_si,
            _ => 0.0,
        })
    }

    /// Of a file's spelling; one that is not known stays as it is and measures [`Quantity::Other`].
    pub fn of(spelling: &str) -> Self {
        Unit::known(spelling).unwrap_or_else(|| Unit {
            name: spelling.trim().to_owned(),
            quantity: Quantity::Other,
            to_si: 1.0,
        })
    }

    /// Of a spelling that also says how amplitudes are read, such as `g pk` or `mm/s RMS`: the unit alone.
    pub fn of_amplitude(spelling: &str) -> Option<Self> {
        const READINGS: [&str; 9] = ["pk", "peak", "0-pk", "0-p", "pk-pk", "p-p", "pp", "rms", "eff"];
        let text = spelling.trim().trim_end_matches(')');
        let (unit, reading) = text.rsplit_once([' ', '_', '('])?;
        READINGS.iter().any(|known| reading.eq_ignore_ascii_case(known)).then(|| Self::known(unit))?
    }

    /// Of a user's spelling, who shall hear of a slip.
    ///
    /// # Errors
    /// [`AnalysisError::UnknownUnit`] for any that is not of [`Unit::KNOWN`].
    pub fn given(spelling: &str) -> Result<Self, AnalysisError> {
        Unit::known(spelling)
            .ok_or_else(|| AnalysisError::UnknownUnit { spelling: spelling.trim().to_owned(), known: Unit::KNOWN })
    }

    /// A signal in this unit, in SI units.
    pub fn in_si<'a>(&self, x: &'a [f64]) -> Cow<'a, [f64]> {
        match self.to_si {
            1.0 => x.into(),
            to_si => x.iter().map(|v| v * to_si).collect(),
        }
    }

    fn known(spelling: &str) -> Option<Self> {
        use Quantity::{Acceleration, Current, Displacement, Other, Velocity, Voltage};
        let plain: String = (spelling.chars().filter(|c| !c.is_whitespace()))
            .map(|c| if c == '²' { '2' } else { c })
            .filter(|c| *c != '^' && *c != '*')
            .flat_map(char::to_lowercase)
            .collect();
        let (name, quantity, to_si) = match plain.as_str() {
            "m/s2" | "m/s/s" | "ms-2" | "m/sec2" => ("m/s^2", Acceleration, 1.0),
            "mm/s2" => ("mm/s^2", Acceleration, 1e-3),
            "in/s2" => ("in/s^2", Acceleration, 0.0254),
            "g" | "gn" | "g0" => ("g", Acceleration, STANDARD_GRAVITY),
            "mg" => ("mg", Acceleration, 1e-3 * STANDARD_GRAVITY),
            "m/s" => ("m/s", Velocity, 1.0),
            "mm/s" => ("mm/s", Velocity, 1e-3),
            "in/s" | "ips" => ("in/s", Velocity, 0.0254),
            "m" => ("m", Displacement, 1.0),
            "mm" => ("mm", Displacement, 1e-3),
            "um" | "µm" | "μm" => ("µm", Displacement, 1e-6),
            "v" | "volt" | "volts" => ("V", Voltage, 1.0),
            "mv" => ("mV", Voltage, 1e-3),
            "uv" | "µv" | "μv" => ("µV", Voltage, 1e-6),
            "a" => ("A", Current, 1.0),
            "ma" => ("mA", Current, 1e-3),
            "n" => ("N", Other, 1.0),
            "pa" => ("Pa", Other, 1.0),
            "count" | "counts" => ("counts", Other, 1.0),
            _ => return None,
        };
        Some(Unit { name: name.to_owned(), quantity, to_si })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_spellings() {
        for (text, name, si) in [
            ("m/s²", "m/s^2", 1.0),
            ("m/s^2", "m/s^2", 1.0),
            ("G", "g", 9.80665),
            ("mm/s", "mm/s", 1e-3),
            ("V", "V", 1.0),
            ("furlong", "furlong", 1.0),
        ] {
            let unit = Unit::of(text);
            assert_eq!((unit.name.as_str(), unit.to_si), (name, si));
        }
        assert_eq!(Unit::of("V").quantity, Quantity::Voltage);
        for (text, name) in [("g pk", "g"), ("mm/s RMS", "mm/s"), ("m/s^2 (peak)", "m/s^2"), ("g_p-p", "g")] {
            assert_eq!(Unit::of_amplitude(text), Some(Unit::of(name)), "{text}");
        }
        for text in ["g", "pk", "furlong pk", "m s", "g 2"] {
            assert_eq!(Unit::of_amplitude(text), None, "{text}");
        }
        assert_eq!(Unit::of("furlong").quantity, Quantity::Other);
    }

    #[test]
    fn prop_every_unit_that_is_listed_is_known_and_others_are_refused() {
        let listed = Unit::KNOWN.replace("or, of a raw signal, ", "");
        for name in listed.split([',', ';']) {
            assert!(Unit::given(name).is_ok(), "{name}");
        }
        let refused = Unit::given(" furlong ").unwrap_err().to_string();
        assert!(refused.starts_with("no unit is called `furlong`; known are m/s^2"));
    }

    #[test]
    fn analytic_missing_noise_and_a_sensors_own_make_a_machines() {
        let unit = |name: &str| Unit::of(name);
        let missing = unit("m/s^2").missing_noise(Some(0.3)).unwrap();
        assert!((missing.hypot(0.3) - 0.5).abs() < 1e-15);
        assert_eq!(unit("g").missing_noise(None), Some(0.5 / 9.80665));
        assert_eq!(unit("m/s^2").missing_noise(Some(0.5)), None);
        assert_eq!(unit("um").missing_noise(None), Some(0.0));
    }
}
