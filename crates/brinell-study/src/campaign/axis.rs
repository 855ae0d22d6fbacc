//! One axis of a plan: the settings of one key, or of several that change together. Read from text such as
//! `operation.speed_rpm=1000:5000:500` or `bearing.radial_clearance_um=5,10,20`.

use super::error::{MOST_POINTS, PlanError};
use brinell::document::reading::text_in_unit_of;
use serde::Serialize;
use std::collections::HashSet;

/// Settings that are tried one after the other.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Axis {
    keys: Vec<String>,
    /// Setting after setting, a value for each key: TOML, a bare word being a string; quantities as numbers in the
    /// key's unit.
    settings: Vec<Vec<String>>,
}

/// What a list of values may be.
const VALUES: &str = "a list (5,10,20), a range (1000:5000:500, FROM:TO:STEP; TO is in it where a step reaches it), or both mixed; values are TOML, a bare word is a \
                      string";

impl Axis {
    /// `KEY=VALUES`, VALUES being values and ranges separated by commas.
    ///
    /// # Errors
    /// Where the text is not that.
    pub fn vary(text: &str) -> Result<Self, PlanError> {
        let (key, values) = one(text)?;
        Self::new(vec![key], values.into_iter().map(|value| vec![value]).collect())
    }

    /// `KEY=VALUES; KEY=VALUES; ...`: the first values of all keys, then the second ones, and so on.
    ///
    /// # Errors
    /// Where the text is not that, or the lists differ in length.
    pub fn together(text: &str) -> Result<Self, PlanError> {
        let parts = split(text, ';')
            .into_iter()
            .filter(|part| !part.trim().is_empty())
            .map(one)
            .collect::<Result<Vec<_>, _>>()?;
        let [first, others @ ..] = &parts[..] else {
            return Err(syntax(text, "KEY=VALUES; KEY=VALUES"));
        };
        if others.is_empty() {
            return Err(syntax(text, "two keys or more: KEY=VALUES; KEY=VALUES"));
        }
        let length = first.1.len();
        if let Some(other) = others.iter().find(|other| other.1.len() != length) {
            return Err(PlanError::Refused(format!(
                "{} and {} have {length} and {} values; keys that vary together have equally many",
                first.0,
                other.0,
                other.1.len()
            )));
        }
        let settings = (0..length).map(|k| parts.iter().map(|part| part.1[k].clone()).collect()).collect();
        Self::new(parts.iter().map(|part| part.0.clone()).collect(), settings)
    }

    /// Of keys and their settings: each has a value for each key. A value with a unit of its own becomes a number in
    /// the key's.
    ///
    /// # Errors
    /// Where a setting has not as many values as there are keys, or one comes twice.
    pub fn new(keys: Vec<String>, mut settings: Vec<Vec<String>>) -> Result<Self, PlanError> {
        let joined = keys.join(", ");
        let wrong = |setting: &[String], why: &str| PlanError::Value {
            key: joined.clone(),
            value: setting.join(", "),
            why: why.into(),
            allowed: VALUES.into(),
        };
        if settings.is_empty() {
            return Err(wrong(&[], "there is no value"));
        }
        let mut seen = HashSet::new();
        for setting in &mut settings {
            if setting.len() != keys.len() {
                return Err(wrong(setting, "not a value for each key"));
            }
            let given = setting.clone();
            for (key, value) in keys.iter().zip(&mut *setting) {
                if let Some(number) = text_in_unit_of(key, value) {
                    *value = number;
                }
            }
            // Numbers by what they mean: 1200 and 20 Hz are one speed.
            let meant = |value: &String| parsed(value).map_or_else(|| value.clone(), |x| format!("{x:?}"));
            if !seen.insert(setting.iter().map(meant).collect::<Vec<_>>()) {
                return Err(wrong(&given, "comes twice"));
            }
        }
        Ok(Self { keys, settings })
    }

    /// The keys, dotted paths.
    pub fn keys(&self) -> &[String] {
        &self.keys
    }

    /// The settings: a value for each key.
    pub fn settings(&self) -> &[Vec<String>] {
        &self.settings
    }
}

pub(crate) fn syntax(text: &str, expected: &str) -> PlanError {
    PlanError::Refused(format!("`{}`: expected {expected}", text.trim()))
}

/// A key and what is behind its equals sign.
pub(crate) fn assigned<'a>(text: &'a str, expected: &str) -> Result<(&'a str, &'a str), PlanError> {
    let sound = |part: &str| !part.is_empty() && !part.contains(char::is_whitespace);
    match text.split_once('=').map(|(key, rest)| (key.trim(), rest)) {
        Some((key, rest)) if key.split('.').all(sound) && !key.contains([',', ';', '"']) => Ok((key, rest)),
        _ => Err(syntax(text, expected)),
    }
}

/// A finite number; `what` it is, is said to `wrong`.
pub(crate) fn number(what: &str, text: &str, wrong: impl Fn(String) -> PlanError) -> Result<f64, PlanError> {
    let number = parsed(text).filter(|x| x.is_finite());
    number.ok_or_else(|| wrong(format!("the {what}, `{text}`, is not a number")))
}

fn parsed(text: &str) -> Option<f64> {
    text.replace('_', "").parse().ok()
}

/// `KEY=VALUES`.
fn one(text: &str) -> Result<(String, Vec<String>), PlanError> {
    const EXAMPLE: &str =
        "KEY=VALUES, for instance operation.speed_rpm=1000:5000:500 or bearing.radial_clearance_um=5,10,20";
    let (key, values) = assigned(text, EXAMPLE)?;
    let mut all = Vec::new();
    for item in split(values, ',') {
        expand(key, item.trim(), &mut all)?;
    }
    Ok((key.into(), all))
}

/// The parts between separators that no bracket and no quote holds.
pub fn split(text: &str, separator: char) -> Vec<&str> {
    let (mut depth, mut quote, mut from) = (0_i32, None, 0);
    let mut parts = Vec::new();
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some('"'), '\\') if !escaped => {
                escaped = true;
                continue;
            }
            (Some(open), c) if c == open && !escaped => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth -= 1,
            (None, c) if c == separator && depth <= 0 => {
                parts.push(&text[from..at]);
                from = at + c.len_utf8();
            }
            _ => {}
        }
        escaped = false;
    }
    parts.push(&text[from..]);
    parts
}

/// One value, or a range of them.
fn expand(key: &str, item: &str, all: &mut Vec<String>) -> Result<(), PlanError> {
    let wrong = |why: String| PlanError::Value { key: key.into(), value: item.into(), why, allowed: VALUES.into() };
    if item.is_empty() {
        return Err(wrong("a value is missing".into()));
    }
    let parts: Vec<&str> = item.split(':').map(str::trim).collect();
    let dash = item.rfind('-').filter(|at| item[..*at].ends_with(|c: char| c.is_ascii_digit()));
    if dash.is_some_and(|at| item[..at].parse::<f64>().is_ok() && item[at + 1..].parse::<f64>().is_ok()) {
        return Err(wrong("a range is FROM:TO:STEP".into()));
    }
    if parts.len() == 1 || parsed(parts[0]).is_none() {
        all.push(item.into());
        return Ok(());
    }
    let &[from, to, step] = &parts[..] else {
        return Err(wrong("a range has three parts, FROM:TO:STEP".into()));
    };
    let read = |what: &str, text: &str| number(what, text, wrong);
    let (a, b, d) = (read("range's start", from)?, read("range's end", to)?, read("range's step", step)?);
    if d == 0.0 {
        return Err(wrong("the range's step is zero".into()));
    }
    if (b - a) * d < 0.0 {
        // FROM:STEP:TO, as MATLAB has it.
        if (d - a) * b > 0.0 && b.abs() < (d - a).abs() {
            return Err(wrong(format!("a range is FROM:TO:STEP; did you mean {from}:{step}:{to}?")));
        }
        return Err(wrong(format!(
            "the range's step leads away from its end; a step of {} would reach it",
            if let Some(positive) = step.strip_prefix('-') {
                positive.to_owned()
            } else {
                format!("-{}", step.trim_start_matches('+'))
            }
        )));
    }
    // A hair of room: 0:1:0.1 holds its end.
    let steps = (b - a) / d * (1.0 + 1e-12);
    if steps >= MOST_POINTS as f64 {
        return Err(wrong(format!("the range has more than {MOST_POINTS} values")));
    }
    let exact = [from, to, step].map(decimal);
    for k in 0..=steps.floor() as i64 {
        all.push(match exact {
            [Some(from), Some(_), Some(step)] => decimal_at(from, step, k),
            _ => format!("{:?}", a + k as f64 * d),
        });
    }
    Ok(())
}

/// A plain decimal as a whole number of 10^-digits; `None` where it has an exponent or too many digits.
fn decimal(text: &str) -> Option<(i128, u32)> {
    let text = text.replace('_', "");
    let (whole, part) = text.split_once('.').unwrap_or((&text, ""));
    if part.len() > 15 || whole.len() > 18 {
        return None;
    }
    let digits = format!("{whole}{part}").parse().ok()?;
    Some((digits, part.len() as u32))
}

/// `from` + `k` `step`, written with the digits of the finer one: no 0.30000000000000004 in a table.
fn decimal_at(from: (i128, u32), step: (i128, u32), k: i64) -> String {
    let digits = from.1.max(step.1);
    let scaled = |(x, own): (i128, u32)| x * 10_i128.pow(digits - own);
    let x = scaled(from) + i128::from(k) * scaled(step);
    if digits == 0 {
        return x.to_string();
    }
    let unit = 10_u128.pow(digits);
    let (size, sign) = (x.unsigned_abs(), if x < 0 { "-" } else { "" });
    let width = digits as usize;
    format!("{sign}{}.{:0width$}", size / unit, size % unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        let axis = Axis::vary(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        axis.settings.into_iter().map(|mut s| s.remove(0)).collect()
    }

    #[test]
    fn regress_lists_ranges_and_toml_values() {
        for (text, expected) in [
            ("a.b=5,10, 20", vec!["5", "10", "20"]),
            ("a.b=1000:2000:500", vec!["1000", "1500", "2000"]),
            ("a.b=0:0.4:0.1", vec!["0.0", "0.1", "0.2", "0.3", "0.4"]),
            ("a.b=1:-1:-0.75", vec!["1.00", "0.25", "-0.50"]),
            ("a.b=1e3:3e3:1e3", vec!["1000.0", "2000.0", "3000.0"]),
            ("a.b=1,10:30:10,100", vec!["1", "10", "20", "30", "100"]),
            ("simulation.model=full,lumped", vec!["full", "lumped"]),
            ("o.load_n=[100,0],[200,0]", vec!["[100,0]", "[200,0]"]),
            (
                "d.0.shape={ circle = { diameter_mm = 3 } }, {rectangle={length_mm=3,width_mm=2}}",
                vec!["{ circle = { diameter_mm = 3 } }", "{rectangle={length_mm=3,width_mm=2}}"],
            ),
            (r#"name="a,b\",:1",'c,d'"#, vec![r#""a,b\",:1""#, "'c,d'"]),
            ("k=half:way", vec!["half:way"]),
        ] {
            assert_eq!(values(text), expected, "{text}");
        }
    }

    #[test]
    fn prop_values_with_a_unit_become_numbers_in_the_keys() {
        assert_eq!(values("operation.speed_rpm=20 Hz,'30 Hz',1500"), ["1200.0", "1800.0", "1500"]);
        assert_eq!(values("operation.load_n=[0,\"2 kN\"],[100,0]"), ["[0, 2000.0]", "[100,0]"]);
        assert_eq!(values("operation.speed_rpm=20 mm"), ["20 mm"], "the reader refuses it");
        let twice = Axis::vary("operation.speed_rpm=1200,20 Hz").unwrap_err().to_string();
        assert!(twice.contains("operation.speed_rpm = 20 Hz: comes twice"), "{twice}");
    }

    #[test]
    fn prop_a_range_reads_as_its_decimals() {
        // Whatever the step, texts are the decimals that were meant, and their number is that of whole steps.
        for step in 1..60_i64 {
            let all = values(&format!("k=0:7:0.{step:02}"));
            assert_eq!(all.len() as i64, 700 / step + 1);
            for (k, text) in all.iter().enumerate() {
                let hundredths = k as i64 * step;
                assert_eq!(*text, format!("{}.{:02}", hundredths / 100, hundredths % 100));
            }
        }
    }

    #[test]
    fn regress_keys_that_vary_together() {
        let axis = Axis::together("a.speed=1000:3000:1000; a.load=[1,0],[2,0],[3,0];").unwrap();
        assert_eq!(axis.keys(), ["a.speed", "a.load"]);
        assert_eq!(axis.settings(), [["1000", "[1,0]"], ["2000", "[2,0]"], ["3000", "[3,0]"]]);
    }

    #[test]
    fn regress_what_is_wrong_is_said() {
        let say = |text: &str| Axis::vary(text).unwrap_err().to_string();
        assert_eq!(
            say("operation.speed_rpm"),
            "`operation.speed_rpm`: expected KEY=VALUES, for instance operation.speed_rpm=1000:5000:500 or \
             bearing.radial_clearance_um=5,10,20"
        );
        for (text, part) in [
            ("=3", "expected KEY=VALUES"),
            ("a..b=3", "expected KEY=VALUES"),
            ("a b=3", "expected KEY=VALUES"),
            ("a.b=", "a.b = : a value is missing"),
            ("a.b=1,,2", "a value is missing"),
            ("a.b=1:5", "a range has three parts, FROM:TO:STEP"),
            ("a.b=1000-3000", "a range is FROM:TO:STEP"),
            ("a.b=900:100:1800", "a range is FROM:TO:STEP; did you mean 900:1800:100?"),
            ("a.b=1:5:0", "the range's step is zero"),
            ("a.b=5:1:2", "a.b = 5:1:2: the range's step leads away from its end; a step of -2 would reach it"),
            ("a.b=1:5:-2", "a step of 2 would reach it"),
            ("a.b=1:x:1", "the range's end, `x`, is not a number"),
            ("a.b=1:inf:1", "the range's end, `inf`, is not a number"),
            ("a.b=0:1:1e-9", "the range has more than 100000 values"),
            ("a.b=5,6,5", "a.b = 5: comes twice"),
        ] {
            assert!(say(text).contains(part), "{text}: {}", say(text));
        }
        assert!(say("a.b=1:5:0").contains("\n  allowed: a list (5,10,20), a range"));
        let say = |text: &str| Axis::together(text).unwrap_err().to_string();
        assert_eq!(say("a=1,2; b=1,2,3"), "a and b have 2 and 3 values; keys that vary together have equally many");
        assert!(say("a=1,2").contains("two keys or more"));
        assert!(say("").contains("expected KEY=VALUES; KEY=VALUES"));
    }
}
