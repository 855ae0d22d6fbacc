//! What is kept of a point: its settings, which scenario it was, and its numbers or why there are none.

use brinell::made_by::digest;
use brinell::result::{Quantity, by_name, named};
use brinell::scenario::Scenario;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A point that is done.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Key and value of what the point sets.
    pub settings: Vec<(String, String)>,
    /// [`fingerprint`] of its scenario.
    pub scenario: String,
    /// Version of the program that ran it.
    pub version: String,
    /// Its numbers, or why it failed.
    pub result: Result<Vec<Quantity>, String>,
    /// What it shows that its reader should know.
    pub warnings: Vec<String>,
}

/// Which scenario it is: SHA-256 of its text with every key given, in hexadecimal. Scenarios that mean the same have
/// the same, however their files were written; files of damage count by what was read from them.
pub fn fingerprint(scenario: &Scenario) -> String {
    digest(&scenario.to_toml())
}

/// A row as its journal has it.
#[derive(Serialize, Deserialize)]
struct Line {
    settings: Map<String, Value>,
    scenario: String,
    brinell: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    values: Option<Map<String, Value>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    failed: Option<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

/// As JSON.
pub(crate) fn in_json(of: &impl Serialize) -> Value {
    serde_json::to_value(of).unwrap_or_default()
}

/// Key and value of what is set, as one JSON object.
pub(crate) fn settings_json(settings: &[(String, String)]) -> Map<String, Value> {
    settings.iter().map(|(key, value)| (key.clone(), value.as_str().into())).collect()
}

impl Row {
    /// As one JSON object. Numbers come back bit for bit from a parser that rounds correctly.
    pub fn to_json(&self) -> Value {
        in_json(&Line {
            settings: settings_json(&self.settings),
            scenario: self.scenario.clone(),
            brinell: self.version.clone(),
            values: self.result.as_ref().ok().map(|numbers| by_name(numbers)),
            failed: self.result.as_ref().err().cloned(),
            warnings: self.warnings.clone(),
        })
    }

    /// From what [`Row::to_json`] gave; `None` where it is not that.
    pub fn from_json(value: &Value) -> Option<Row> {
        let Line { settings, scenario, brinell: version, values, failed, warnings } = Line::deserialize(value).ok()?;
        let settings = settings.iter().map(|(key, value)| Some((key.clone(), value.as_str()?.to_owned())));
        let result = match failed {
            Some(reason) => Err(reason),
            None => Ok(named(&values?)?),
        };
        Some(Row { settings: settings.collect::<Option<_>>()?, scenario, version, result, warnings })
    }

    /// A number of the row by its name.
    pub fn quantity(&self, name: &str) -> Option<&Quantity> {
        let quantities = self.result.as_ref().ok()?;
        quantities.iter().find(|q| q.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brinell::result::Spread;
    use brinell::signal::Interval;

    fn quantity(name: &str, value: Option<f64>, spread: Spread) -> Quantity {
        Quantity { name: name.into(), unit: "m/s^2".into(), value, spread }
    }

    #[test]
    fn prop_rows_come_back_from_json_bit_for_bit() {
        let mut row = Row {
            settings: vec![("b".into(), "[1, 0]".into()), ("a".into(), "x \"y\"".into())],
            scenario: "ab12".into(),
            version: "0.1.0".into(),
            result: Err("the state stopped being finite\nat t = 1 s".into()),
            warnings: vec![],
        };
        let back = |row: &Row| {
            let text = row.to_json().to_string();
            assert!(!text.contains('\n'));
            Row::from_json(&serde_json::from_str(&text).unwrap())
        };
        assert_eq!(back(&row), Some(row.clone()));
        // Awkward numbers: every one a double that a careless parser misses by a digit.
        let mut seed = 0x9E37_79B9_7F4A_7C15_u64;
        let quantities = (0..2000).map(|k| {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let x = f64::from_bits(seed);
            let x = if x.is_finite() { x } else { -0.0 };
            let spread = match k % 3 {
                0 => Spread::Without,
                1 => Spread::Unknown,
                _ => Spread::Interval(Interval { low: -x, high: 0.1 * x, freedom: 7 }),
            };
            quantity(&format!("q{k}"), (k % 7 > 0).then_some(x), spread)
        });
        row.result = Ok(quantities.collect());
        row.warnings = vec!["not settled: \"x\"".into(), "y".into()];
        let again = back(&row).unwrap();
        assert_eq!(again, row);
        let bits = |row: &Row| -> Vec<u64> {
            let values = row.result.as_ref().unwrap().iter().filter_map(|q| q.value);
            values.map(f64::to_bits).collect()
        };
        assert_eq!(bits(&again), bits(&row));
    }

    #[test]
    fn regress_what_is_no_row() {
        for text in [
            "{}",
            "[]",
            r#"{"settings":{},"scenario":"a","brinell":"1"}"#,
            r#"{"settings":{"a":1},"scenario":"a","brinell":"1","failed":"x"}"#,
            r#"{"settings":{},"scenario":"a","brinell":"1","values":{"a":{"unit":1,"value":2}}}"#,
            r#"{"settings":{},"scenario":"a","brinell":"1","values":{"a":{"unit":"m","value":"2"}}}"#,
            r#"{"settings":{},"scenario":"a","brinell":"1","values":{},"warnings":[1]}"#,
        ] {
            assert_eq!(Row::from_json(&serde_json::from_str(text).unwrap()), None, "{text}");
        }
    }
}
