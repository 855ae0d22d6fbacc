//! Numbers to some digits: rounded, and in sentences.

/// A number to `digits` significant digits, at least 1, without what computing leaves behind them: 0.165, not 0.16499999999999998.
pub fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}

/// A number with `digits` significant digits, plain where that is short: "1800", "0.0123", "1.90e8". For text that is
/// copied or searched, so without spaces and raised digits.
pub fn short(x: f64, digits: usize) -> String {
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
