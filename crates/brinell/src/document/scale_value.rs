//! `image.scale_bar`: a length in a picture.

use crate::scenario::Unset;
use serde_json::Value as Json;

use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::value_type::{Misfit, ValueType, object, read_under, wrong_type};

/// A length that is known in a picture.
#[derive(Clone, Copy)]
pub(super) struct ScaleBar {
    px: f64,
    mm: f64,
}

impl ScaleBar {
    /// The side of a pixel, mm.
    pub(super) fn mm_per_pixel(self) -> f64 {
        self.mm / self.px
    }
}

const PX: Spec = key("px", "its length in the picture").above(0.0).to(1e5).unit("px");
const MM: Spec = key("mm", "its length").above(0.0).to(1e4).unit("mm");
const ALLOWED: &str = "{ px = 412, mm = 5 }";

impl Unset for ScaleBar {
    fn unset() -> Self {
        Self { px: f64::NAN, mm: f64::NAN }
    }
}

impl ValueType for ScaleBar {
    fn expected(_: &Spec) -> String {
        format!("a table such as {ALLOWED}")
    }

    fn range(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        let Value::Table(table) = &node.value else {
            return Err(wrong_type::<Self>(node, spec));
        };
        let names: Vec<&str> = table.keys().map(String::as_str).collect();
        if names != [MM.name, PX.name] {
            let message = format!("keys {} make no scale bar", names.join(", "));
            return Err(Misfit::new(message, ALLOWED));
        }
        let value = |spec: &Spec| read_under(&table[spec.name].node, spec);
        Ok(Self { px: value(&PX)?, mm: value(&MM)? })
    }

    fn node(&self) -> Node {
        Node::record([(PX.name, self.px.node()), (MM.name, self.mm.node())])
    }

    fn schema(_: &Spec) -> Json {
        object(&[&PX, &MM], &[f64::schema(&PX), f64::schema(&MM)])
    }

    fn is_defined(&self) -> bool {
        self.px.is_finite() && self.mm.is_finite()
    }
}
