//! How bearing B differs from bearing A: found damage and ratios of indicators, in words.

use crate::answers::{self, Differing, Reply};
use crate::report::{Answer, Trouble};
use brinell::analysis::{HEADLINES, indicator_words};
use brinell::signal::ratio::{Ratio, ratio};
use brinell::signal::{Estimate, Indicator, Interval};
use serde_json::Value;

/// `differ`: of two answers of `verdict`.
pub(crate) fn differ(request: &Value) -> Answer<Reply> {
    let [a, b] = ["a", "b"].map(|key| &request[key]);
    for (key, side) in [("a", a), ("b", b)] {
        if !side["damage"].is_array() || !side["indicators"].is_array() {
            return Err(Trouble::of(format!("\"{key}\" must be a verdict")));
        }
    }
    let compared = |i: Indicator| Some((indicator_words(i), ratio(&of(b, i.name())?, &of(a, i.name())?)?));
    let ratios: Vec<(String, Ratio)> = HEADLINES.into_iter().filter_map(compared).collect();
    let apart = |r: &Ratio| r.interval.is_some_and(|(low, high)| low > 1.0 || high < 1.0);
    let headline = format!("B against A: {}; {}.", damage(a, b), levels(&ratios, apart));
    let one = |(name, r): (String, Ratio)| {
        let (low, high) = r.interval.unzip();
        answers::Ratio { name, value: r.value, apart: apart(&r), low, high }
    };
    Ok(Reply::Differ(Differing { headline, ratios: ratios.into_iter().map(one).collect() }))
}

/// An indicator of a verdict.
fn of(side: &Value, name: &str) -> Option<Estimate> {
    let found = side["indicators"].as_array()?;
    let found = found.iter().find(|i| i["name"] == name)?;
    let interval = || {
        Some(Interval {
            low: found["low"].as_f64()?,
            high: found["high"].as_f64()?,
            freedom: u32::try_from(found["freedom"].as_u64()?).ok()?.max(1),
        })
    };
    Some(Estimate { value: found["value"].as_f64()?, interval: interval() })
}

/// Families that are damage in one of them or in both.
fn damage(a: &Value, b: &Value) -> String {
    let names = |side: &Value| -> Vec<String> {
        let found = side["damage"].as_array().into_iter().flatten();
        found.filter_map(|f| f["name"].as_str().map(str::to_owned)).collect()
    };
    let (a, b) = (names(a), names(b));
    let without = |these: &[String], those: &[String]| -> Vec<String> {
        let alone = these.iter().filter(|name| !those.contains(name));
        alone.cloned().collect()
    };
    let (only_a, only_b) = (without(&a, &b), without(&b, &a));
    let both = without(&a, &only_a);
    let said: Vec<String> = [(only_b, "B alone"), (only_a, "A alone"), (both, "both")]
        .into_iter()
        .filter(|(names, _)| !names.is_empty())
        .map(|(names, place)| format!("damage at {} in {place}", names.join(" and ")))
        .collect();
    match &said[..] {
        [] => "no damage found in either".to_owned(),
        all => all.join(", "),
    }
}

/// The ratios, those apart from 1 first.
fn levels(ratios: &[(String, Ratio)], apart: impl Fn(&Ratio) -> bool) -> String {
    let word = |(name, r): &(String, Ratio)| match r.interval {
        Some((low, high)) => {
            let [value, low, high] = [r.value, low, high].map(rounded);
            format!("{name} × {value} ({low} to {high})")
        }
        None => format!("{name} × {} (too short for an interval)", rounded(r.value)),
    };
    let listed = |wanted: bool| -> Vec<String> {
        let chosen = ratios.iter().filter(|(_, r)| apart(r) == wanted);
        chosen.map(word).collect()
    };
    match (&listed(true)[..], &listed(false)[..]) {
        ([], []) => "no indicator of both to compare".to_owned(),
        ([], same) => format!("no difference of level is clear: {}", same.join(", ")),
        (differ, []) => differ.join(", "),
        (differ, same) => format!("{}; not clear: {}", differ.join(", "), same.join(", ")),
    }
}

/// Three digits.
fn rounded(x: f64) -> String {
    let digits = 2 - x.abs().log10().floor().clamp(-6.0, 2.0) as i32;
    format!("{x:.*}", digits.clamp(0, 8) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn verdict(damage: &[&str], rms: [f64; 3]) -> Value {
        let damage: Vec<Value> = damage.iter().map(|name| json!({ "name": name })).collect();
        json!({ "damage": damage, "indicators": [
            { "name": "rms", "value": rms[0], "low": rms[1], "high": rms[2], "freedom": 20 },
            { "name": "kurtosis", "value": 3.0, "low": 2.7, "high": 3.3, "freedom": 20 },
        ]})
    }

    fn said(a: &Value, b: &Value) -> String {
        let Ok(Reply::Differ(Differing { headline, .. })) = differ(&json!({ "a": a, "b": b })) else {
            panic!("two verdicts differ in some way");
        };
        headline
    }

    /// Intervals of +-5 % each on a logarithmic scale make one of sqrt(2) times that; Student's t with 40 for 20
    /// degrees of freedom narrows it.
    #[test]
    fn analytic_the_ratio_has_the_interval_of_both() {
        let a = verdict(&[], [2.0, 2.0 / 1.05, 2.0 * 1.05]);
        let b = verdict(&["BPFO"], [6.0, 6.0 / 1.05, 6.0 * 1.05]);
        let widened = 2.0_f64.sqrt() * 2.021 / 2.086;
        let half = 1.05_f64.ln() * widened;
        let [low, high] = [3.0 * (-half).exp(), 3.0 * half.exp()].map(|x| format!("{x:.2}"));
        let half = 0.5 * (3.3_f64 / 2.7).ln() * widened;
        let (below, above) = ((-half).exp(), half.exp());
        assert_eq!(
            said(&a, &b),
            format!(
                "B against A: damage at BPFO in B alone; RMS × 3.00 ({low} to {high}); not clear: kurtosis × 1.00 ({below:.3} to {above:.2})."
            )
        );
    }

    #[test]
    fn prop_alike_bearings_are_not_distinguished() {
        let one = verdict(&["BPFI"], [2.0, 1.9, 2.1]);
        let words = said(&one, &one);
        assert!(words.contains("damage at BPFI in both; no difference of level is clear"), "{words}");
        let none = json!({ "damage": [], "indicators": [] });
        assert!(said(&none, &one).contains("damage at BPFI in B alone; no indicator"));
        assert!(differ(&json!({ "a": none })).is_err());
    }
}
