//! A number of a plan that may be a distribution, within the range of its key.

use crate::design::distribution::{Distribution, Value};
use brinell::document::reading::{Misfit, Node, Spec, Toml, ValueType};
use brinell::scenario::Unset;
use serde_json::{Value as Json, json};
use std::fmt;

/// A number, or what it is drawn from.
#[derive(Debug, Clone, PartialEq)]
pub enum Varied {
    /// The same for all.
    Fixed(f64),
    /// Drawn for each.
    Drawn(Distribution),
}

impl Varied {
    /// Least and largest; infinite where a distribution has no ends.
    pub fn ends(&self) -> [f64; 2] {
        match self {
            Self::Fixed(x) => [*x; 2],
            Self::Drawn(distribution) => distribution.ends(),
        }
    }

    /// The next of the values drawn, or the one that it is.
    pub(super) fn number<'a>(&self, drawn: &mut impl Iterator<Item = &'a Value>) -> f64 {
        match self {
            Self::Fixed(x) => *x,
            Self::Drawn(_) => drawn.next().and_then(|value| value.number).unwrap_or(f64::NAN),
        }
    }
}

/// A number as a plan has it: without a row of noughts.
pub(in crate::design) fn short(x: f64) -> String {
    match x.abs() {
        0.0 | 1e-4..1e7 => x.to_string(),
        _ => format!("{x:e}"),
    }
}

impl fmt::Display for Varied {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, self.ends()) {
            (Self::Fixed(x), _) => f.write_str(&short(*x)),
            (Self::Drawn(_), [low, high]) => write!(f, "{} to {}", short(low), short(high)),
        }
    }
}

impl Unset for Varied {
    fn unset() -> Self {
        Self::Fixed(f64::NAN)
    }
}

impl ValueType for Varied {
    fn expected(spec: &Spec) -> String {
        format!("{} or a distribution", f64::expected(spec))
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        let Some(distribution) = Distribution::read(spec.name(), node) else {
            return f64::read(node, spec).map(Self::Fixed);
        };
        let distribution = distribution?;
        if !distribution.is_numeric() {
            return Err(Misfit::new("values that are no numbers", f64::expected(spec)).in_element(node));
        }
        for (end, way) in distribution.ends().into_iter().zip(["from", "up to"]) {
            if end.is_infinite() {
                let allowed = "within = [low, high] beside `normal`";
                return Err(Misfit::new("the distribution has no ends", allowed).in_element(node));
            }
            f64::read(&Node { value: Toml::Float(end), ..node.clone() }, spec).map_err(|m| {
                Misfit::new(format!("draws values {way} {}: {}", short(end), m.message), m.allowed).in_element(node)
            })?;
        }
        Ok(Self::Drawn(distribution))
    }

    fn write(&self) -> String {
        self.to_string()
    }

    fn schema(spec: &Spec) -> Json {
        json!({ "anyOf": [f64::schema(spec), { "$ref": "#/$defs/distribution" }] })
    }

    fn range(spec: &Spec) -> String {
        f64::range(spec)
    }
}
