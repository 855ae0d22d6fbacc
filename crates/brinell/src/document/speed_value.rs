//! The speed of the shaft as a key's value: a number, or points of a profile.

use serde_json::{Value as Json, json};

use super::quantity;
use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::value_type::{Misfit, ValueType, each, wrong_type};
use crate::scenario::Speed;

/// The first number of a point.
const TIME: Spec = key("t_s", "time");

impl ValueType for Speed {
    fn expected(spec: &Spec) -> String {
        format!("{} or a list of points [t in s, speed in {}]", f64::expected(spec), spec.unit)
    }

    fn read(node: &Node, spec: &Spec) -> Result<Speed, Misfit> {
        match &node.value {
            Value::Array(items) => {
                let point = |item: &Node| match &item.value {
                    Value::Array(pair) if pair.len() == 2 => {
                        let read = |node, spec| f64::read(node, spec).map_err(|misfit| misfit.in_element(node));
                        Ok([read(&pair[0], &TIME)?, read(&pair[1], spec)?])
                    }
                    Value::Array(_) => <[f64; 2]>::read(item, spec),
                    _ => Err(wrong_type::<Speed>(item, spec)),
                };
                let points = items.iter().map(|item| point(item).map_err(|misfit| misfit.in_element(item)));
                Ok(Speed::Profile(points.collect::<Result<_, _>>()?))
            }
            Value::Text(text) if !quantity::begins(text) => Err(wrong_type::<Speed>(node, spec)),
            Value::Integer(_) | Value::HugeInteger(_) | Value::Float(_) | Value::Text(_) => {
                f64::read(node, spec).map(Speed::Constant)
            }
            _ => Err(wrong_type::<Speed>(node, spec)),
        }
    }

    fn node(&self) -> Node {
        match self {
            Speed::Constant(speed) => speed.node(),
            Speed::Profile(points) => each(points),
        }
    }

    fn schema(spec: &Spec) -> Json {
        json!({ "oneOf": [
            f64::schema(spec),
            { "type": "array", "items": <[f64; 2]>::schema(spec), "minItems": 1 },
        ] })
    }
}
