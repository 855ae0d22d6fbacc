//! Numbers as people read them: ticks at round values, true minus signs, units with raised exponents, symbols with
//! lowered indices.

pub use brinell::signal::short;
use std::f64::consts::TAU;

/// A value with its interval after it: `1.35 (1.30 to 1.40)`; without one it has so many significant digits.
pub(crate) fn bracketed(value: f64, digits: usize, interval: Option<(f64, f64)>) -> String {
    match interval {
        Some(ends) => {
            let [value, low, high] = beside(value, ends);
            format!("{value} ({low} to {high})")
        }
        None => short(value, digits),
    }
}

/// A value and the ends of its interval: each with three significant digits, and more down to the second digit of half
/// the interval's width.
pub(crate) fn beside(value: f64, (low, high): (f64, f64)) -> [String; 3] {
    let half_width = 0.5 * (high - low);
    [value, low, high].map(|x| short(x, if half_width > 0.0 { digits_beside(x, half_width).max(3) } else { 4 }))
}

/// Text of numbers as it is set: with minus signs, also in what the file has as hyphens.
pub(crate) fn minus(text: &str) -> String {
    let mut set = String::with_capacity(text.len() + 4);
    let mut before = ' ';
    for (at, c) in text.char_indices() {
        let number = text[at + c.len_utf8()..].starts_with(|next: char| next.is_ascii_digit());
        let sign = c == '-' && number && (before.is_whitespace() || matches!(before, '(' | '['));
        set.push(if sign { '−' } else { c });
        before = c;
    }
    set
}

/// Squares and cubes of a unit within a text.
pub(crate) fn raised(text: &str) -> String {
    text.replace("^2", "²").replace("^3", "³")
}

/// A number to 12 digits, without what computing leaves behind them: 0.165, not 0.16499999999999998.
pub fn twelve_digits(x: f64) -> f64 {
    brinell::signal::rounded(x, 12)
}

/// "1 run", "2 runs".
pub fn plural(n: usize, word: &str) -> String {
    format!("{n} {word}{}", if n == 1 { "" } else { "s" })
}

/// A unit as people read it: a plain number has none; keys and files write u for µ, and deg for °.
pub fn shown_unit(unit: &str) -> &str {
    match unit {
        "1" => "",
        "um" => "µm",
        "us" => "µs",
        "uJ" => "µJ",
        "deg" => "°",
        unit => unit,
    }
}

/// A text that begins with a capital.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    first + letters.as_str()
}

/// A number with about `digits` significant digits: "1 800", "0.0123", "1.9×10⁸"; "not available" for NaN.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return "not available".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "−∞" }.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = digits.max(1);
    // Round first: 9.9996 is a two-digit number once it has four digits.
    let scientific = format!("{:.*e}", digits - 1, value);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..7).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        let text = trim_zeros(&format!("{value:.decimals$}"));
        return group_thousands(&text).replace('-', "−");
    }
    format!("{}×10{}", trim_zeros(mantissa), superscript(exponent)).replace('-', "−")
}

/// Significant digits of a value down to the second one of its uncertainty: 2 to 12.
pub fn digits_beside(value: f64, uncertainty: f64) -> usize {
    let place = |x: f64| x.abs().log10().floor();
    let digits = place(value) - place(uncertainty) + 2.0;
    if digits.is_finite() { digits.clamp(2.0, 12.0) as usize } else { 2 }
}

/// A value and the ends of its interval, with as many decimals as half the interval's width deserves (two significant
/// digits).
pub(crate) fn with_interval(value: f64, low: f64, high: f64) -> [String; 3] {
    let all = [value, low, high];
    let half_width = 0.5 * (high - low);
    if all.iter().any(|x| !x.is_finite() || x.abs() >= 1e7) || half_width < 1e-8 {
        return all.map(|x| significant(x, 4));
    }
    let decimals = (1 - half_width.log10().floor() as i32).clamp(0, 12) as usize;
    all.map(|x| group_thousands(without_minus_zero(&format!("{x:.decimals$}"))).replace('-', "−"))
}

/// A decimal number as text; what was rounded to zero has no sign.
fn without_minus_zero(text: &str) -> &str {
    match text.strip_prefix('-') {
        Some(positive) if positive.bytes().all(|b| matches!(b, b'0' | b'.')) => positive,
        _ => text,
    }
}

fn trim_zeros(text: &str) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text.to_owned() }
}

/// Thin spaces between groups of three digits before the decimal point, from five digits on.
fn group_thousands(text: &str) -> String {
    let (sign, rest) = text.strip_prefix('-').map_or(("", text), |rest| ("-", rest));
    let (whole, fraction) = rest.split_once('.').map_or((rest, None), |(w, f)| (w, Some(f)));
    let mut grouped = String::with_capacity(text.len() + 4);
    grouped.push_str(sign);
    for (place, digit) in whole.chars().enumerate() {
        if whole.len() > 4 && place > 0 && (whole.len() - place) % 3 == 0 {
            grouped.push('\u{2009}');
        }
        grouped.push(digit);
    }
    if let Some(fraction) = fraction {
        grouped.push('.');
        grouped.push_str(fraction);
    }
    grouped
}

pub(crate) fn superscript(exponent: i32) -> String {
    exponent
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => char::from_u32(0x2070 + digit as u32 - '0' as u32).unwrap_or(digit),
        })
        .collect()
}

/// Where a run of text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Height {
    /// On the line.
    Line,
    /// As in the unit `N/m^(10/9)`.
    Raised,
    /// As in the symbol `L_e`.
    Lowered,
}

/// A run of text at one height.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) text: String,
    pub(crate) height: Height,
}

/// Splits text at `^`: what follows, in brackets or up to the next character that is no letter, digit or sign, is
/// raised. Squares and cubes become the characters made for them. At `_` after a single letter, what follows up to the
/// next character that is no letter or digit is lowered; longer names with `_` are names.
pub(crate) fn runs(text: &str) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let put = |runs: &mut Vec<Run>, text: &str, height: Height| match runs.last_mut() {
        _ if text.is_empty() => {}
        Some(last) if last.height == height => last.text.push_str(text),
        _ => runs.push(Run { text: text.to_owned(), height }),
    };
    let push = |runs: &mut Vec<Run>, text: &str, raised: bool| {
        if raised {
            return put(runs, text, Height::Raised);
        }
        let mut rest = text;
        while let Some((line, index, tail)) = symbol(rest) {
            put(runs, line, Height::Line);
            put(runs, index, Height::Lowered);
            rest = tail;
        }
        put(runs, rest, Height::Line);
    };
    let mut rest = text;
    while let Some(at) = rest.find('^') {
        push(&mut runs, &rest[..at], false);
        let after = &rest[at + 1..];
        let (exponent, tail) = match after.strip_prefix('(').and_then(|inner| inner.split_once(')')) {
            Some(pair) => pair,
            None => {
                let end =
                    after.find(|c: char| !(c.is_ascii_alphanumeric() || c == '-' || c == '−')).unwrap_or(after.len());
                after.split_at(end)
            }
        };
        match exponent {
            "2" => push(&mut runs, "²", false),
            "3" => push(&mut runs, "³", false),
            "" => push(&mut runs, "^", false),
            _ => push(&mut runs, &exponent.replace('-', "−"), true),
        }
        rest = tail;
    }
    push(&mut runs, rest, false);
    runs
}

/// The first symbol with an index: the text up to and with its letter, the index, and what follows.
fn symbol(text: &str) -> Option<(&str, &str, &str)> {
    text.match_indices('_').find_map(|(at, _)| {
        let mut before = text[..at].chars().rev();
        let alone = before.next().is_some_and(|c| c.is_ascii_alphabetic())
            && before.next().is_none_or(|c| !c.is_alphanumeric() && c != '_');
        let after = &text[at + 1..];
        let end = after.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(after.len());
        let name = after[end..].starts_with('_');
        (alone && end > 0 && !name).then(|| (&text[..at], &after[..end], &after[end..]))
    })
}

/// Round values inside [lo, hi], about `target` of them.
pub(crate) fn linear_ticks(lo: f64, hi: f64, target: usize) -> Vec<f64> {
    let span = hi - lo;
    if !span.is_finite() || span <= 0.0 {
        return vec![];
    }
    let step = nice_step(span / target.max(1) as f64);
    let first = (lo / step - 1e-9).ceil();
    let last = (hi / step + 1e-9).floor();
    let count = (last - first).clamp(-1.0, 100.0) as i64;
    (0..=count).map(|i| (first + i as f64) * step).map(|tick| if tick == 0.0 { 0.0 } else { tick }).collect()
}

fn nice_step(raw: f64) -> f64 {
    let magnitude = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * magnitude >= raw * (1.0 - 1e-9)).unwrap_or(10.0);
    step * magnitude
}

/// Ticks at 1, 10, 100, ... with every `skip`-th decade kept.
pub(crate) fn log_ticks(lo: f64, hi: f64, target: usize) -> Vec<f64> {
    if !(lo > 0.0 && hi > lo) {
        return vec![];
    }
    let first = (lo.log10() - 1e-9).ceil() as i32;
    let last = (hi.log10() + 1e-9).floor() as i32;
    let skip = (((last - first).max(0) as usize) / target.max(1) + 1) as i32;
    (first..=last).filter(|decade| decade.rem_euclid(skip) == 0).map(|decade| 10f64.powi(decade)).collect()
}

/// Labels for evenly spaced ticks, and the power of ten that they leave to the axis label (0 mostly).
pub(crate) fn tick_labels(ticks: &[f64]) -> (Vec<String>, i32) {
    let largest = ticks.iter().fold(0.0f64, |m, t| m.max(t.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return (ticks.iter().map(|_| "0".to_owned()).collect(), 0);
    }
    let order = largest.log10().floor() as i32;
    let power = if (-3..5).contains(&order) { 0 } else { order.div_euclid(3) * 3 };
    let scale = 10f64.powi(-power);
    let step = ticks.windows(2).map(|w| (w[1] - w[0]).abs() * scale).fold(f64::INFINITY, f64::min);
    let step = if step.is_finite() && step > 0.0 { step } else { largest * scale };
    let decimals = (-(step * (1.0 + 1e-9)).log10().floor()).clamp(0.0, 9.0) as usize;
    let labels = ticks
        .iter()
        .map(|t| {
            let text = format!("{:.*}", decimals, t * scale);
            let text =
                if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') { "0".into() } else { text };
            group_thousands(&text).replace('-', "−")
        })
        .collect();
    (labels, power)
}

/// Middles of equal bins around the circle, degrees.
pub(crate) fn bin_centres(bins: usize) -> Vec<f64> {
    (0..bins).map(|bin| ((bin as f64 + 0.5) * TAU / bins as f64).to_degrees()).collect()
}

/// What is no number becomes 0.
pub(crate) fn finite(value: f32) -> f64 {
    if value.is_finite() { f64::from(value) } else { 0.0 }
}

/// 1, 2 or 5 times a power of ten: the largest such number up to this one.
pub(crate) fn round_below(largest: f64) -> f64 {
    let decade = 10f64.powf(largest.log10().floor());
    [5.0, 2.0, 1.0].map(|m| m * decade).into_iter().find(|f| *f <= largest).unwrap_or(decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_value_is_as_fine_as_its_uncertainty() {
        for (value, uncertainty, digits) in
            [(107.64, 8.9e-5, 9), (24.842, 0.42, 4), (30.0, 1.0, 3), (3.0, 300.0, 2), (0.0, 1.0, 2), (1.0, 0.0, 2)]
        {
            assert_eq!(digits_beside(value, uncertainty), digits, "{value} {uncertainty}");
        }
    }

    #[test]
    fn regress_an_interval_is_as_fine_as_it_is_narrow() {
        for (value, ends, text) in [
            (249.683, (249.581, 249.784), "249.68 (249.58 to 249.78)"),
            (5.7912, (5.6812, 5.9012), "5.79 (5.68 to 5.90)"),
            (99.9, (98.1, 101.7), "99.9 (98.1 to 101.7)"),
            (1.792, (0.498, 6.44), "1.79 (0.498 to 6.44)"),
            (5.666_051e-6, (5.666_011e-6, 5.666_090e-6), "5.666051e-6 (5.666011e-6 to 5.666090e-6)"),
            (2.0, (2.0, 2.0), "2.000 (2.000 to 2.000)"),
            (-0.000_126_1, (-0.000_145, -0.000_108), "-0.000126 (-0.000145 to -0.000108)"),
        ] {
            assert_eq!(bracketed(value, 4, Some(ends)), text);
        }
        assert_eq!(bracketed(249.683, 4, None), "249.7");
    }

    #[test]
    fn regress_minus_signs_are_those_of_numbers() {
        for (given, set) in [
            ("-0.0126 (-1 to -9.7e-5)", "−0.0126 (−1 to −9.7e-5)"),
            (
                "[0.0, -300]; 2026-01-01, r-5, --speed, pure-rolling",
                "[0.0, −300]; 2026-01-01, r-5, --speed, pure-rolling",
            ),
        ] {
            assert_eq!(minus(given), set);
        }
    }

    #[test]
    fn regress_numbers_read_well() {
        for (value, text) in [
            (250.102, "250.1"),
            (0.0, "0"),
            (-3.5, "−3.5"),
            (500_000.0, "500\u{2009}000"),
            (1.898e8, "1.898×10⁸"),
            (1.2e-9, "1.2×10⁻⁹"),
            (0.012_34, "0.01234"),
            (9.9999, "10"),
            (f64::NAN, "not available"),
            (f64::NEG_INFINITY, "−∞"),
        ] {
            assert_eq!(significant(value, 4), text);
        }
        assert_eq!(with_interval(22.913, 22.5, 23.3426), ["22.91", "22.50", "23.34"]);
        assert_eq!(with_interval(1234.5, 1200.0, 1274.0), ["1234", "1200", "1274"]);
        // No bound is minus zero.
        assert_eq!(with_interval(2.1, -0.04, 4.24), ["2.1", "0.0", "4.2"]);
        assert_eq!(with_interval(30.0, -0.4, 60.4), ["30", "0", "60"]);
        assert_eq!(with_interval(1.0, -0.06, 2.06), ["1.0", "−0.1", "2.1"]);
    }

    #[test]
    fn regress_units_are_split_at_exponents() {
        let of = |height: Height| move |t: &str| Run { text: t.into(), height };
        let (plain, raised, lowered) = (of(Height::Line), of(Height::Raised), of(Height::Lowered));
        assert_eq!(
            runs("h_I / h_a^2, sensor_ax, a_b_c, x_"),
            [plain("h"), lowered("I"), plain(" / h"), lowered("a"), plain("², sensor_ax, a_b_c, x_")]
        );
        assert_eq!(runs("m/s^2"), [plain("m/s²")]);
        assert_eq!(runs("N/m^(10/9)"), [plain("N/m"), raised("10/9")]);
        assert_eq!(runs("N/m^n, outer"), [plain("N/m"), raised("n"), plain(", outer")]);
        assert_eq!(runs("a^"), [plain("a^")]);
        assert_eq!(runs("^(2"), [plain("^(2")]);
    }

    #[test]
    fn regress_ticks_are_round_and_inside() {
        assert_eq!(linear_ticks(-1.0, 1.0, 4), [-1.0, -0.5, 0.0, 0.5, 1.0]);
        assert_eq!(
            tick_labels(&[0.0, 5e7, 1e8, 1.5e8]),
            (vec!["0".into(), "50".into(), "100".into(), "150".into()], 6)
        );
        assert_eq!(tick_labels(&[-0.5, 0.0, 0.5]), (vec!["−0.5".into(), "0".into(), "0.5".into()], 0));
        assert!(linear_ticks(0.0, 0.0, 5).is_empty());
        assert_eq!(log_ticks(1e-3, 1.0, 5), [1e-3, 1e-2, 1e-1, 1.0]);
    }

    #[test]
    fn regress_numbers_keep_their_digits() {
        assert_eq!(short(250.1020, 6), "250.102");
        assert_eq!(short(1.898e8, 4), "1.898e8");
        assert_eq!(short(-0.001234, 3), "-0.00123");
        assert_eq!(short(0.0, 3), "0");
    }
}
