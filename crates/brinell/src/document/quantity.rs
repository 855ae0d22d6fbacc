//! Quantities with a unit of their own, as strings: `"25 Hz"` where a key is in r/min, `"2 kN"` where it is in N.
//!
//! A unit is a product of names with powers: `N s/m`, `m/s^2`, `mV/(m/s^2)`. Hz is one turn per second, so that a
//! frequency and a speed of rotation convert into each other. `g` is the gram, and standard gravity where an
//! acceleration is wanted.

use crate::analysis::STANDARD_GRAVITY;
use crate::signal::rounded;
use std::f64::consts::{PI, TAU};

/// Powers of metre, kilogram, second, volt, radian.
type Powers = [i8; 5];

/// A unit in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unit {
    factor: f64,
    powers: Powers,
}

const LENGTH: Powers = [1, 0, 0, 0, 0];
const TIME: Powers = [0, 0, 1, 0, 0];
const FORCE: Powers = [1, 1, -2, 0, 0];
const STRESS: Powers = [-1, 1, -2, 0, 0];
const ROTATION: Powers = [0, 0, -1, 0, 1];
const ANGLE: Powers = [0, 0, 0, 0, 1];
const MASS: Powers = [0, 1, 0, 0, 0];
const VOLTAGE: Powers = [0, 0, 0, 1, 0];

const INCH: f64 = 0.0254;
/// Pound-force, N.
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// Names with their factors and powers, and whether SI's prefixes go before them.
const NAMES: [(&str, f64, Powers, bool); 17] = [
    ("m", 1.0, LENGTH, true),
    ("in", INCH, LENGTH, false),
    ("g", 1e-3, MASS, true),
    ("s", 1.0, TIME, true),
    ("min", 60.0, TIME, false),
    ("h", 3600.0, TIME, false),
    ("N", 1.0, FORCE, true),
    ("lbf", POUND_FORCE, FORCE, false),
    ("Pa", 1.0, STRESS, true),
    ("V", 1.0, VOLTAGE, true),
    ("Hz", TAU, ROTATION, true),
    ("rpm", TAU / 60.0, ROTATION, false),
    ("r", TAU, ANGLE, false),
    ("rev", TAU, ANGLE, false),
    ("rad", 1.0, ANGLE, true),
    ("deg", PI / 180.0, ANGLE, false),
    ("\u{b0}", PI / 180.0, ANGLE, false),
];

const PREFIXES: [(&str, f64); 10] = [
    ("n", 1e-9),
    ("u", 1e-6),
    ("\u{b5}", 1e-6),
    ("\u{3bc}", 1e-6),
    ("m", 1e-3),
    ("c", 1e-2),
    ("d", 1e-1),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
];

/// Examples of units for a key's, the key's own left out.
const EXAMPLES: [(Powers, &[&str]); 8] = [
    (LENGTH, &["nm", "um", "mm", "m", "in"]),
    (TIME, &["us", "ms", "s", "min"]),
    (FORCE, &["N", "kN", "lbf"]),
    (STRESS, &["MPa", "GPa"]),
    (ROTATION, &["r/min", "rpm", "Hz", "kHz", "rad/s"]),
    (ANGLE, &["deg", "rad"]),
    (MASS, &["g", "kg"]),
    (VOLTAGE, &["mV", "V"]),
];

/// Whether strings with a unit are read where `unit` is a key's.
pub(super) fn is_convertible(unit: &str) -> bool {
    product(unit).is_some()
}

/// What a string may hold where a key is in `unit`, as a regular expression of JSON Schema.
pub(super) const PATTERN: &str = r"^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*[^0-9\s.].*$";

/// Units that a key in `unit` is often given in.
pub(super) fn examples(unit: &str) -> Vec<&'static str> {
    let powers = product(unit).map(|u| u.powers);
    let of = EXAMPLES.iter().find(|(of, _)| Some(*of) == powers);
    let names = of.map_or(&[][..], |(_, names)| names).iter().copied();
    names.filter(|name| *name != unit).collect()
}

/// The number of a string where a key is in `wanted`; `None` where no quantity is expected there or the text begins with
/// no number.
pub(super) fn converted(text: &str, wanted: &str) -> Option<Result<f64, String>> {
    (begins(text) && is_convertible(wanted)).then(|| read(text, wanted))
}

/// Whether a text may be a quantity: a number is first.
pub(super) fn begins(text: &str) -> bool {
    let text = text.trim();
    text[..end_of_number(text)].parse::<f64>().is_ok()
}

/// The number of a quantity in `wanted`, rounded to 14 digits.
///
/// # Errors
/// In words, what is wrong with it.
pub fn read(text: &str, wanted: &str) -> Result<f64, String> {
    let text = text.trim();
    let (number, unit) = text.split_at(end_of_number(text));
    let no_number = |_| "a string in the place of a number must begin with one".to_owned();
    let value: f64 = number.parse().map_err(no_number)?;
    let unit = unit.trim();
    if unit.is_empty() {
        return Err(format!("no unit: a string needs one; without quotes the number is in {wanted}"));
    }
    let to = product(wanted).ok_or_else(|| format!("{wanted} has no other units"))?;
    let from = match product(unit) {
        Some(from) if from.powers == to.powers => Some(from),
        // As gravity, where the gram does not fit.
        known => product(&unit.replace('g', "gravity")).filter(|from| from.powers == to.powers).or(known),
    };
    let Some(from) = from else {
        return Err(format!("unknown unit {unit:?}"));
    };
    if from.powers != to.powers {
        return Err(format!("{unit:?} does not convert to {wanted}"));
    }
    // What conversion adds in the last digits is gone.
    Ok(rounded(value * (from.factor / to.factor), 14))
}

/// Where a number that begins a text ends.
fn end_of_number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    while digit(end) || bytes.get(end) == Some(&b'.') {
        end += 1;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let mut power = end + 1 + sign(end + 1);
        if digit(power) {
            while digit(power) {
                power += 1;
            }
            end = power;
        }
    }
    end
}

/// A whole unit: names with powers, one `/` at most, after which all divide; in brackets after it one more.
fn product(text: &str) -> Option<Unit> {
    quotient(text, |bracketed| quotient(bracketed, |_| None))
}

/// Names with powers, one `/` at most; `bracketed` reads what is in brackets after it.
fn quotient(text: &str, bracketed: impl Fn(&str) -> Option<Unit>) -> Option<Unit> {
    // Common spellings of r/min and Hz that name no turns.
    match text {
        "1/min" | "min^-1" | "min-1" | "RPM" | "U/min" | "tr/min" => return named("rpm"),
        "1/s" | "s^-1" => return named("Hz"),
        _ => {}
    }
    let Some((above, below)) = text.split_once('/') else {
        return factors(text);
    };
    let below = below.trim();
    let inner = below.strip_prefix('(').and_then(|b| b.strip_suffix(')'));
    let below = inner.map_or_else(|| factors(below), bracketed)?;
    let above = factors(above)?;
    above.joined(above.factor / below.factor, below.powers, i8::checked_sub)
}

impl Unit {
    /// With other powers added or subtracted; none where they or the factor are beyond what numbers here reach.
    fn joined(self, factor: f64, others: Powers, join: fn(i8, i8) -> Option<i8>) -> Option<Unit> {
        let mut powers = self.powers;
        for (power, other) in powers.iter_mut().zip(others) {
            *power = join(*power, other)?;
        }
        factor.is_normal().then_some(Unit { factor, powers })
    }
}

/// Names with powers, between spaces or points.
fn factors(text: &str) -> Option<Unit> {
    let mut names = text.split([' ', '*', '\u{b7}']).filter(|n| !n.is_empty());
    let first = power(names.next()?)?;
    names.try_fold(first, |unit, name| {
        let one = power(name)?;
        unit.joined(unit.factor * one.factor, one.powers, i8::checked_add)
    })
}

/// A name with a power: `m`, `s^2`, `mm\u{b2}`.
fn power(text: &str) -> Option<Unit> {
    let text = text.replace('\u{b2}', "^2").replace('\u{b3}', "^3");
    let (name, power) = match text.split_once('^') {
        Some((name, power)) => (name, power.parse::<i8>().ok()?),
        // As keys have it: kg/m3.
        None => match text.strip_suffix(['2', '3']) {
            Some(name) => (name, if text.ends_with('2') { 2 } else { 3 }),
            None => (&text[..], 1),
        },
    };
    let unit = named(name).filter(|_| (-3..=3).contains(&power))?;
    Some(Unit { factor: unit.factor.powi(power.into()), powers: unit.powers.map(|p| p * power) })
}

fn named(name: &str) -> Option<Unit> {
    if name == "gravity" {
        return Some(Unit { factor: STANDARD_GRAVITY, powers: [1, 0, -2, 0, 0] });
    }
    let of = |name: &str, prefix: f64| {
        let known = NAMES.iter().find(|(known, _, _, takes)| *known == name && (*takes || prefix == 1.0));
        known.map(|(_, factor, powers, _)| Unit { factor: factor * prefix, powers: *powers })
    };
    of(name, 1.0).or_else(|| {
        let mut prefixes = PREFIXES.iter();
        prefixes.find_map(|(prefix, factor)| of(name.strip_prefix(prefix)?, *factor))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_quantities_convert_to_the_keys_unit() {
        // The SI brochure's definitions; the inch, pound-force and standard gravity by international agreement.
        for (text, unit, number) in [
            ("25 Hz", "r/min", 1500.0),
            ("1500 rpm", "Hz", 25.0),
            ("1500 1/min", "r/min", 1500.0),
            ("1500 RPM", "Hz", 25.0),
            ("2 kN", "N", 2000.0),
            ("-2kN", "N", -2000.0),
            ("10 lbf", "N", 44.482_216_152_605),
            ("0.02 mm", "um", 20.0),
            ("20 \u{b5}m", "um", 20.0),
            ("1 in", "mm", 25.4),
            ("5e-1 min", "s", 30.0),
            ("90 deg", "deg", 90.0),
            ("12 g", "kg", 0.012),
            ("1 g", "m/s^2", 9.80665),
            ("100 mV/g", "mV/(m/s^2)", 10.197_162_129_779),
            ("100 N/um", "N/m", 1e8),
            ("206000 N/mm^2", "GPa", 206.0),
            ("206000 N/mm2", "GPa", 206.0),
            ("20 mPa s", "Pa s", 0.02),
            ("7.85 g/cm^3", "kg/m^3", 7850.0),
            ("2 kN s/m", "N s/m", 2000.0),
            ("0.5 mm\u{b2}", "mm^2", 0.5),
            ("3 N/(N/mm)", "mm", 3.0),
            ("5 m/(1/s)", "m s/rad", 0.795_774_715_459_48),
        ] {
            assert_eq!(read(text, unit), Ok(number), "{text} in {unit}");
        }
        let degrees = read("1 rad", "deg").unwrap();
        assert!((degrees - 180.0 / PI).abs() < 1e-12, "{degrees}");
    }

    #[test]
    fn prop_what_is_no_quantity_of_the_keys_is_reported() {
        for (text, unit, words) in [
            ("25", "r/min", "no unit"),
            ("Hz", "r/min", "begin with one"),
            ("", "N", "begin with one"),
            ("inf N", "N", "begin with one"),
            ("2,5 kN", "N", "unknown unit"),
            ("2 kN", "r/min", "does not convert to r/min"),
            ("2 parsec", "mm", "unknown unit \"parsec\""),
            ("2 g", "mm", "does not convert to mm"),
            ("1 mm/", "mm", "unknown unit"),
            ("1 mm^", "mm", "unknown unit"),
            ("1 mm^100", "mm", "unknown unit"),
        ] {
            let message = read(text, unit).unwrap_err();
            assert!(message.contains(words), "{text}: {message}");
        }
        for unit in ["", "N/m^n", "px", "%", "dB"] {
            assert!(!is_convertible(unit), "{unit}");
        }
    }

    #[test]
    fn prop_no_unit_is_too_long_or_too_deep_to_be_refused() {
        let deep = |levels: usize| format!("1 {}m{}", "m/(".repeat(levels), ")".repeat(levels));
        for levels in [2, 3, 100_000] {
            let message = read(&deep(levels), "m").unwrap_err();
            assert!(message.contains("unknown unit"), "{levels} levels: {message:.60}");
        }
        // Powers that an i8 does not hold; one more turn than it counts; a factor beyond floating-point numbers.
        for unit in [
            "m^3 ".repeat(43),
            "m ".repeat(257),
            format!("m/{}", "m^-3 ".repeat(43)),
            format!("m/{}", "m^-2 ".repeat(64)),
            format!("m {}/{}", "Gm^3 ".repeat(12), "Gm^3 ".repeat(12)),
        ] {
            let message = read(&format!("1 {unit}"), "m").unwrap_err();
            assert!(message.contains("unknown unit"), "{unit}: {message}");
        }
    }
}
