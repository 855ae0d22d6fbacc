//! Units of vibration signals.

/// What a signal is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Acceleration.
    Acceleration,
    /// Velocity.
    Velocity,
    /// Displacement.
    Displacement,
    /// A sensor's raw voltage, or anything else whose scale to vibration nobody stated.
    Other,
}

impl Quantity {
    /// For axes and headings.
    pub fn words(self) -> &'static str {
        match self {
            Quantity::Acceleration => "Acceleration",
            Quantity::Velocity => "Velocity",
            Quantity::Displacement => "Displacement",
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
    /// Of a spelling; one that is not known stays as it is and measures [`Quantity::Other`].
    pub fn of(spelling: &str) -> Self {
        use Quantity::{Acceleration, Displacement, Velocity};
        let text = spelling.trim();
        let plain: String = (text.chars().filter(|c| !c.is_whitespace()))
            .map(|c| if c == '²' { '2' } else { c })
            .filter(|c| *c != '^' && *c != '*')
            .flat_map(char::to_lowercase)
            .collect();
        let known = match plain.as_str() {
            "m/s2" | "m/s/s" | "ms-2" | "m/sec2" => ("m/s^2", Acceleration, 1.0),
            "mm/s2" => ("mm/s^2", Acceleration, 1e-3),
            "g" | "gn" | "g0" => ("g", Acceleration, 9.80665),
            "mg" => ("mg", Acceleration, 9.80665e-3),
            "m/s" => ("m/s", Velocity, 1.0),
            "mm/s" => ("mm/s", Velocity, 1e-3),
            "in/s" | "ips" => ("in/s", Velocity, 0.0254),
            "m" => ("m", Displacement, 1.0),
            "mm" => ("mm", Displacement, 1e-3),
            "um" | "µm" | "μm" => ("µm", Displacement, 1e-6),
            _ => (text, Quantity::Other, 1.0),
        };
        Unit {
            name: known.0.to_owned(),
            quantity: known.1,
            to_si: known.2,
        }
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
        ] {
            let unit = Unit::of(text);
            assert_eq!((unit.name.as_str(), unit.to_si), (name, si));
        }
        assert_eq!(Unit::of("V").quantity, Quantity::Other);
    }
}
