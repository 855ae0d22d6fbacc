//! From an ADC's numbers to a vibration: full scale and sensitivity, as data sheets state them.

use super::{AnalysisError, Quantity, Unit};

/// What a sensor puts out for one unit of vibration: 100 mV/g.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// Output for one of `of`, in `output`.
    pub value: f64,
    /// V, mV, uV, A or mA.
    pub output: Unit,
    /// What the sensor measures.
    pub of: Unit,
}

impl Sensitivity {
    /// Spellings that are taken.
    pub const FORMS: &str = "100mV/g, 10.2mV/(m/s2), 0.1V/g, 4mV/(mm/s), 7.87V/mm, 0.08mA/(mm/s)";

    /// Reads `100mV/g`.
    ///
    /// # Errors
    /// [`AnalysisError::NoSensitivity`] for anything but a number above 0, a unit of voltage or current, and one of
    /// vibration.
    pub fn given(text: &str) -> Result<Self, AnalysisError> {
        let read = || {
            let (value, units) = number(text)?;
            let (output, of) = units.split_once('/')?;
            let of = of.trim();
            let of = of.strip_prefix('(').map_or(Some(of), |o| o.strip_suffix(')'))?;
            let (output, of) = (Unit::given(output).ok()?, Unit::given(of).ok()?);
            (output.quantity.is_electrical() && of.quantity.is_vibration()).then_some(Sensitivity { value, output, of })
        };
        read().ok_or_else(|| AnalysisError::NoSensitivity { text: text.trim().to_owned(), forms: Self::FORMS })
    }

    /// What a signal in `unit` is multiplied by to be in [`Sensitivity::of`]; `None` where `unit` is not of the
    /// output's kind.
    pub fn factor(&self, unit: &Unit) -> Option<f64> {
        (unit.quantity == self.output.quantity).then(|| unit.to_si / (self.value * self.output.to_si))
    }

    /// As a data sheet has it: `100 mV/g`, `4 mV/(mm/s)`.
    pub fn words(&self) -> String {
        let (value, output, of) = (self.value, &self.output.name, &self.of.name);
        match of.contains('/') {
            true => format!("{value} {output}/({of})"),
            false => format!("{value} {output}/{of}"),
        }
    }
}

/// What an ADC's largest number stands for: 5 V, or 10 g.
#[derive(Debug, Clone, PartialEq)]
pub struct FullScale {
    /// In `unit`.
    pub value: f64,
    /// V, g and so on.
    pub unit: Unit,
}

impl FullScale {
    /// Reads `5V`.
    ///
    /// # Errors
    /// [`AnalysisError::NoFullScale`] for anything but a number above 0 and a unit of voltage, current or vibration.
    pub fn given(text: &str) -> Result<Self, AnalysisError> {
        let read = || {
            let (value, unit) = number(text)?;
            let unit = Unit::given(unit).ok()?;
            let known = unit.quantity.is_electrical() || unit.quantity.is_vibration();
            known.then_some(FullScale { value, unit })
        };
        read().ok_or_else(|| AnalysisError::NoFullScale { text: text.trim().to_owned() })
    }
}

/// A number above 0 at the beginning, and the rest.
fn number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let of_number = |c: char| c.is_ascii_digit() || ".+-eE".contains(c);
    let most = text.find(|c| !of_number(c)).unwrap_or(text.len());
    // All of these characters are one byte long.
    (1..=most).rev().find_map(|end| {
        let value: f64 = text[..end].parse().ok()?;
        (value > 0.0 && value.is_finite()).then(|| (value, text[end..].trim()))
    })
}

impl Quantity {
    /// A sensor's output.
    fn is_electrical(self) -> bool {
        matches!(self, Quantity::Voltage | Quantity::Current)
    }

    /// Motion.
    fn is_vibration(self) -> bool {
        use Quantity::{Acceleration, Displacement, Velocity};
        matches!(self, Acceleration | Velocity | Displacement)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_volts_over_sensitivity_are_vibration() {
        for (text, unit, factor, of) in [
            ("100mV/g", "V", 10.0, "g"),
            ("100 mV/g", "mV", 0.01, "g"),
            ("0.1V/g", "V", 10.0, "g"),
            ("1e2mV/g", "V", 10.0, "g"),
            ("10mV/(m/s2)", "V", 100.0, "m/s^2"),
            ("10mV/m/s^2", "V", 100.0, "m/s^2"),
            ("10 mV / (m/s²)", "V", 100.0, "m/s^2"),
            ("4mV/mm/s", "mV", 0.25, "mm/s"),
            ("7.5V/mm", "V", 1.0 / 7.5, "mm"),
            ("0.5mA/(mm/s)", "mA", 2.0, "mm/s"),
        ] {
            let sensitivity = Sensitivity::given(text).unwrap();
            let found = sensitivity.factor(&Unit::of(unit)).unwrap();
            assert!((found / factor - 1.0).abs() < 1e-12, "{text}: {found}");
            assert_eq!(sensitivity.of.name, of);
        }
        let words = Sensitivity::given("4mV/mm/s").unwrap().words();
        assert_eq!(words, "4 mV/(mm/s)");
    }

    #[test]
    fn prop_what_is_no_sensitivity_is_refused() {
        for text in ["100", "100mV", "mV/g", "-1mV/g", "0V/g", "100g/mV", "1V/V", "1V/(g", ""] {
            let words = Sensitivity::given(text).unwrap_err().to_string();
            assert!(words.contains("100mV/g, 10.2mV/(m/s2)"), "{text}: {words}");
        }
        for text in ["5", "V", "-5V", "5 furlong", "5counts", ""] {
            let words = FullScale::given(text).unwrap_err().to_string();
            assert!(words.contains("5V"), "{text}: {words}");
        }
        assert_eq!(Sensitivity::given("1V/g").unwrap().factor(&Unit::of("g")), None);
        assert_eq!(Sensitivity::given("1V/g").unwrap().factor(&Unit::of("counts")), None);
        assert_eq!(FullScale::given("10 g").unwrap().unit.name, "g");
    }

    #[test]
    fn prop_every_form_that_is_listed_is_taken() {
        for form in Sensitivity::FORMS.split(", ") {
            assert!(Sensitivity::given(form).is_ok(), "{form}");
        }
    }
}
