//! Distributions of a key's values: from a place in the unit interval to a value.

use crate::campaign::{Axis, PlanError};
use brinell::document::reading::{Misfit, Node, Toml, comparable, in_unit_of};
use brinell::signal::distribution::{normal_quantile, normal_tail};
use brinell::signal::rounded;
use std::collections::HashMap;

/// Significant digits of a drawn number: finer ones mean nothing, and the last bit of a logarithm is not the same on
/// every machine.
const DIGITS: usize = 9;
/// Values of a `whole` distribution and of a grid at most.
const MOST_VALUES: f64 = 1e9;

/// One value: TOML, and a number where it is one.
#[derive(Debug, Clone, PartialEq)]
pub struct Value {
    /// As a scenario file has it.
    pub toml: String,
    /// The same as a number.
    pub number: Option<f64>,
}

impl Value {
    fn float(x: f64) -> Self {
        let x = rounded(x, DIGITS);
        Self { toml: format!("{x:?}"), number: Some(x) }
    }

    fn of(node: &Node) -> Self {
        Self {
            toml: node.text(),
            number: match &node.value {
                Toml::Integer(n) => Some(*n as f64),
                Toml::Float(x) => Some(*x),
                _ => None,
            },
        }
    }

    /// The words of a string, anything else as TOML.
    pub fn words(&self) -> &str {
        let inner = self.toml.strip_prefix('"').and_then(|t| t.strip_suffix('"'));
        inner.filter(|t| !t.contains('\\')).unwrap_or(&self.toml)
    }
}

/// How the values of a key are spread.
#[derive(Debug, Clone, PartialEq)]
pub enum Distribution {
    /// Evenly over [low, high).
    Uniform {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// Evenly in the logarithm.
    Log {
        /// Lower end, above 0.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// Normal, cut off at `within`.
    Normal {
        /// Mean, before it is cut off.
        mean: f64,
        /// Standard deviation, before it is cut off.
        deviation: f64,
        /// Ends of what is left of it.
        within: Option<(f64, f64)>,
        /// Values beyond are moved to the nearer end.
        clip: Option<(f64, f64)>,
    },
    /// Whole numbers, each equally often, both ends included.
    Whole {
        /// Least.
        low: i64,
        /// Largest.
        high: i64,
    },
    /// One of a list, by weight.
    Choice {
        /// What there is.
        values: Vec<Value>,
        /// Sums of the weights up to and with each value, the last one being 1.
        sums: Vec<f64>,
    },
    /// Each value of a list in turn; grids of several keys are crossed.
    Grid {
        /// What there is.
        values: Vec<Value>,
    },
}

/// The key that makes a table a distribution.
pub(super) const KINDS: [&str; 6] = ["uniform", "log", "normal", "whole", "choice", "grid"];

impl Distribution {
    /// Reads a table that has one of the distributions' names as its key; `None` where it has none: it is no
    /// distribution. `key` is whose values they are: quantities become numbers in its unit.
    pub(super) fn read(key: &str, node: &Node) -> Option<Result<Self, Misfit>> {
        let Toml::Table(table) = &node.value else {
            return None;
        };
        let mut kinds = KINDS.iter().filter(|kind| table.contains_key(**kind));
        let kind = *kinds.next()?;
        if let Some(other) = kinds.next() {
            let message = format!("`{kind}` and `{other}` at once; a value has one distribution");
            return Some(Err(Misfit::new(message, KINDS.join(" | ")).in_element(node)));
        }
        let options: &[&str] = match kind {
            "normal" => &["within", "clip"],
            "choice" => &["weights"],
            _ => &[],
        };
        let known = |name: &&String| name.as_str() == kind || options.contains(&name.as_str());
        if let Some(name) = table.keys().find(|name| !known(name)) {
            let message = format!("`{kind}` has no option `{name}`");
            let allowed = match options {
                [] => "no option".to_owned(),
                options => options.join(", "),
            };
            return Some(Err(Misfit::new(message, allowed).in_element(node)));
        }
        let get = |name: &str| table.get(name).map(|entry| &entry.node);
        let get = (key, get);
        Some(Self::of_kind(kind, &table[kind].node, get).map_err(|m| m.in_element(node)))
    }

    fn of_kind<'a>(
        kind: &str,
        node: &Node,
        (key, get): (&str, impl Fn(&str) -> Option<&'a Node>),
    ) -> Result<Self, Misfit> {
        Ok(match kind {
            "uniform" => {
                let (low, high) = ends(kind, node)?;
                Self::Uniform { low, high }
            }
            "log" => {
                let (low, high) = ends(kind, node)?;
                if low <= 0.0 {
                    return Err(Misfit::new("a logarithm needs ends above 0", "log = [low, high] with low > 0"));
                }
                Self::Log { low, high }
            }
            "normal" => Self::normal(node, get)?,
            "whole" => {
                let (low, high) = ends(kind, node)?;
                let whole = |x: f64| x.fract() == 0.0 && x.abs() <= MOST_VALUES;
                if !whole(low) || !whole(high) {
                    return Err(Misfit::new(
                        "the ends are not whole numbers",
                        "whole = [least, largest], both included, within 1e9 of 0",
                    ));
                }
                Self::Whole { low: low as i64, high: high as i64 }
            }
            "grid" => Self::Grid { values: grid(key, node)? },
            _ => Self::choice(key, node, get)?,
        })
    }

    fn normal<'a>(node: &Node, get: impl Fn(&str) -> Option<&'a Node>) -> Result<Self, Misfit> {
        let [mean, deviation] = pair("normal = [mean, standard deviation]", node)?;
        if deviation <= 0.0 {
            return Err(Misfit::new(
                "the standard deviation is not positive",
                "normal = [mean, standard deviation] with a deviation > 0",
            ));
        }
        let within = get("within").map(|node| ends("within", node)).transpose()?;
        let clip = get("clip").map(|node| ends("clip", node)).transpose()?;
        if let Some((low, high)) = within {
            let share = normal_tail((low - mean) / deviation) - normal_tail((high - mean) / deviation);
            if share < 1e-6 {
                return Err(Misfit::new(
                    "less than a millionth of the distribution is within these ends",
                    "ends with more of the distribution between them",
                ));
            }
        }
        Ok(Self::Normal { mean, deviation, within, clip })
    }

    /// Values with their weights.
    fn choice<'a>(key: &str, node: &Node, get: impl Fn(&str) -> Option<&'a Node>) -> Result<Self, Misfit> {
        let values = values("choice", key, node)?;
        let weights = match get("weights") {
            None => vec![1.0; values.len()],
            Some(node) => numbers("weights = [...], one for each value of choice", node)?,
        };
        let total: f64 = weights.iter().sum();
        let sound = weights.len() == values.len() && weights.iter().all(|w| *w >= 0.0 && w.is_finite()) && total > 0.0;
        if !sound {
            return Err(Misfit::new(
                format!("{} values and the weights {weights:?}", values.len()),
                "a weight of 0 or more for each value, not all of them 0",
            ));
        }
        let mut sum = 0.0;
        let mut sums: Vec<f64> = weights
            .iter()
            .map(|w| {
                sum += w / total;
                sum
            })
            .collect();
        // Round-off must not leave the last values without a place.
        let last = weights.iter().rposition(|w| *w > 0.0).unwrap_or(0);
        sums[last..].fill(1.0);
        Ok(Self::Choice { values, sums })
    }

    /// The value at a place of [0, 1). Of a grid the place counts as well, for those who draw from it.
    pub fn value(&self, place: f64) -> Value {
        match self {
            Self::Uniform { low, high } => Value::float(low + place * (high - low)),
            Self::Log { low, high } => Value::float((low.ln() + place * (high / low).ln()).exp()),
            Self::Normal { mean, deviation, within, clip } => {
                let place = match within {
                    Some((low, high)) => {
                        let [a, b] = [low, high].map(|x| normal_tail((mean - x) / deviation));
                        a + place * (b - a)
                    }
                    None => place,
                };
                let x = mean + deviation * normal_quantile(place);
                let x = within.map_or(x, |(low, high)| x.clamp(low, high));
                Value::float(clip.map_or(x, |(low, high)| x.clamp(low, high)))
            }
            Self::Whole { low, high } => {
                let count = (high - low + 1) as f64;
                let n = low + ((place * count) as i64).min(high - low);
                Value { toml: n.to_string(), number: Some(n as f64) }
            }
            Self::Choice { values, sums } => {
                let k = sums.iter().position(|sum| place < *sum);
                values[k.unwrap_or(values.len() - 1)].clone()
            }
            Self::Grid { values } => values[((place * values.len() as f64) as usize).min(values.len() - 1)].clone(),
        }
    }

    /// Least and largest value; infinite where nothing bounds them, and of words.
    pub fn ends(&self) -> [f64; 2] {
        match self {
            Self::Uniform { low, high } | Self::Log { low, high } => [*low, *high],
            Self::Whole { low, high } => [*low as f64, *high as f64],
            Self::Normal { within, clip, .. } => {
                clip.or(*within).map_or([f64::NEG_INFINITY, f64::INFINITY], |(low, high)| [low, high])
            }
            Self::Choice { values, .. } | Self::Grid { values } => {
                let numbers = || values.iter().map(|value| value.number.unwrap_or(f64::INFINITY));
                [numbers().fold(f64::INFINITY, f64::min), numbers().fold(f64::NEG_INFINITY, f64::max)]
            }
        }
    }

    /// Whether every value is a number.
    pub fn is_numeric(&self) -> bool {
        match self {
            Self::Choice { values, .. } | Self::Grid { values } => values.iter().all(|value| value.number.is_some()),
            _ => true,
        }
    }
}

fn numbers(what: &str, node: &Node) -> Result<Vec<f64>, Misfit> {
    let number = |item: &Node| match item.value {
        Toml::Integer(n) => Some(n as f64),
        Toml::Float(x) if x.is_finite() => Some(x),
        _ => None,
    };
    let all: Option<Vec<f64>> = match &node.value {
        Toml::Array(items) => items.iter().map(number).collect(),
        _ => None,
    };
    all.ok_or_else(|| Misfit::new("expected a list of numbers", what))
}

fn pair(what: &str, node: &Node) -> Result<[f64; 2], Misfit> {
    let all = numbers(what, node)?;
    let count = all.len();
    all.try_into().map_err(|_| Misfit::new(format!("expected two numbers, found {count} of them"), what))
}

/// [low, high] with low < high.
fn ends(name: &str, node: &Node) -> Result<(f64, f64), Misfit> {
    let what = format!("{name} = [low, high] with low < high");
    let [low, high] = pair(&what, node)?;
    if low < high || (name == "whole" && low == high) {
        return Ok((low, high));
    }
    let why = if low > high {
        format!("the ends are reversed; [{high:?}, {low:?}] is meant")
    } else {
        "the ends are equal; give the value itself".into()
    };
    Err(Misfit::new(why, what))
}

/// Values that mean the same are written the same, so that they are one condition.
fn values(name: &str, key: &str, node: &Node) -> Result<Vec<Value>, Misfit> {
    match &node.value {
        Toml::Array(items) if !items.is_empty() => {
            let mut first = HashMap::new();
            let value = |item: &Node| {
                let item = in_unit_of(key, item);
                first.entry(comparable(&item)).or_insert_with(|| Value::of(&item)).clone()
            };
            Ok(items.iter().map(value).collect())
        }
        _ => Err(Misfit::new("expected a list of values", format!("{name} = [...] with one value or more"))),
    }
}

/// A list, or a range as a sweep has it.
fn grid(key: &str, node: &Node) -> Result<Vec<Value>, Misfit> {
    let Toml::Text(text) = &node.value else {
        return values("grid", key, node);
    };
    // Only its unit counts here, and a quoted key may be anything.
    let name = key.rsplit('.').next().filter(|name| !name.is_empty());
    let plain = |name: &&str| name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
    let axis = Axis::vary(&format!("{}={text}", name.filter(plain).unwrap_or("grid")));
    let axis = axis.map_err(|error| {
        let why = match error {
            PlanError::Value { why, .. } => why,
            other => other.to_string(),
        };
        Misfit::new(why, "a list, or a range \"FROM:TO:STEP\"")
    })?;
    let of = |setting: &Vec<String>| Value { number: setting[0].parse().ok(), toml: setting[0].clone() };
    Ok(axis.settings().iter().map(of).collect())
}
