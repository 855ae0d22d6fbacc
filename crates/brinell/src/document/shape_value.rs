//! Kinds of value that only shapes have: points, polygons, and seeds.

use serde_json::{Value as Json, json};

use super::source::{Node, Value};
use super::spec::Spec;
use super::value_type::{Listed, Misfit, ValueType, in_unit, wrong_type};

impl ValueType for u64 {
    fn expected(spec: &Spec) -> String {
        in_unit("a whole number, 0 or more", spec)
    }

    fn read(node: &Node, spec: &Spec) -> Result<u64, Misfit> {
        let number = match &node.value {
            Value::Integer(n) => u64::try_from(*n).ok(),
            Value::HugeInteger(text) => text.parse().ok(),
            _ => return Err(wrong_type::<u64>(node, spec)),
        };
        number.ok_or_else(|| Misfit::new("out of range", "0 to 2^64 - 1"))
    }

    fn node(&self) -> Node {
        Node::whole(*self)
    }

    fn schema(_: &Spec) -> Json {
        json!({ "type": "integer", "minimum": 0 })
    }
}

impl Listed for [f64; 2] {
    const LIST: &'static str = "a list of points [s, z]";
    const LISTS: Option<usize> = Some(3);
}

impl Listed for Vec<[f64; 2]> {
    const LIST: &'static str = "a list of polygons [[s, z], ...]";
    const LISTS: Option<usize> = Some(1);
}
