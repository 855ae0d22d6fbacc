//! Text to the terminal, quiet where nobody reads on (a closed pipe is no failure).

use std::fmt::Arguments;
use std::io::Write;

/// Writes one line to standard output.
pub(crate) fn line(text: Arguments) {
    let mut out = std::io::stdout().lock();
    let _ = writeln!(out, "{text}");
}

/// Writes one line to standard error.
pub(crate) fn complaint(text: Arguments) {
    let mut out = std::io::stderr().lock();
    let _ = writeln!(out, "{text}");
}

/// `println!` that survives a closed pipe.
macro_rules! say {
    ($($arg:tt)*) => { crate::say::line(format_args!($($arg)*)) };
}
pub(crate) use say;

/// `eprintln!` that survives a closed pipe.
macro_rules! complain {
    ($($arg:tt)*) => { crate::say::complaint(format_args!($($arg)*)) };
}
pub(crate) use complain;

/// A number with `digits` significant digits, plain where that is short.
pub(crate) fn short(x: f64, digits: usize) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return x.to_string();
    }
    let exponent = x.abs().log10().floor() as i32;
    if (-4..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        format!("{x:.decimals$}")
    } else {
        format!("{x:.*e}", digits - 1)
    }
}

/// A value with its interval after it: `1.35 [1.30, 1.40]`.
pub(crate) fn bracketed(value: String, interval: Option<(f64, f64)>) -> String {
    match interval {
        Some((low, high)) => format!("{value} [{}, {}]", short(low, 3), short(high, 3)),
        None => value,
    }
}

/// [`short`], with 0 for what is the solver's error beside `scale`.
pub(crate) fn significant(x: f64, scale: f64, digits: usize) -> String {
    // The static balance leaves 1e-10 of the forces over.
    const ROUND_OFF: f64 = 1e-9;
    short(
        if x.abs() < ROUND_OFF * scale.abs() {
            0.0
        } else {
            x
        },
        digits,
    )
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn regress_numbers_keep_their_digits() {
        assert_eq!(short(250.1020, 6), "250.102");
        assert_eq!(short(1.898e8, 4), "1.898e8");
        assert_eq!(short(-0.001234, 3), "-0.00123");
        assert_eq!(short(0.0, 3), "0");
    }
}
