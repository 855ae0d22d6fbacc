//! Kinds of value that only shapes have: points, polygons, and seeds.

use serde_json::{Value as Json, json};

use super::source::{Node, Value};
use super::spec::Spec;
use super::value_type::{Misfit, ValueType, elements, in_unit, read_each, write_each, wrong_type};

impl ValueType for u64 {
    fn blank() -> u64 {
        0
    }

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

    fn write(&self) -> String {
        self.to_string()
    }

    fn schema(_: &Spec) -> Json {
        json!({ "type": "integer", "minimum": 0 })
    }
}

/// A list of points, and a list of such lists: polygons.
macro_rules! list_of {
    ($item:ty, $what:literal, $least:literal) => {
        impl ValueType for Vec<$item> {
            fn blank() -> Vec<$item> {
                Vec::new()
            }

            fn expected(spec: &Spec) -> String {
                in_unit($what, spec)
            }

            fn read(node: &Node, spec: &Spec) -> Result<Vec<$item>, Misfit> {
                let items = elements::<Vec<$item>>(node, spec)?;
                if let Some(item) = items.iter().find(|i| !matches!(i.value, Value::Array(_))) {
                    return Err(wrong_type::<$item>(item, spec).in_element(item));
                }
                read_each(items, spec)
            }

            fn write(&self) -> String {
                write_each(self)
            }

            fn schema(spec: &Spec) -> Json {
                json!({ "type": "array", "items": <$item>::schema(spec), "minItems": $least })
            }

            fn range(spec: &Spec) -> String {
                spec.range.to_string()
            }
        }
    };
}

list_of!([f64; 2], "a list of points [s, z]", 3);
list_of!(Vec<[f64; 2]>, "a list of polygons [[s, z], ...]", 1);
