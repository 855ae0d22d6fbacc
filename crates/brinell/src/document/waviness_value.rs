//! `bearing.waviness`, `bearing.element_waviness`: a table with the spectrum of a surface's waves.

use serde_json::{Value as Json, json};

use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::value_type::{Misfit, ValueType, each, read_under, wrong_type};
use crate::scenario::{Unset, Waviness};

const AMPLITUDE: Spec = key("amplitude_um", "A_1").from(0.0).to(1000.0);
const EXPONENT: Spec = key("exponent", "q of A_k = A_1 k^-q").from(0.0).to(10.0);
/// Waves per turn at most: those of 1 mm on a bearing of 3 m.
const MOST_WAVES: usize = 10_000;
const ALLOWED: &str = "{ amplitude_um = 0.1, exponent = 1.5, waves = [2, 300] }";
const WAVES: &str = "waves";

/// q where a table leaves it out.
const USUAL_EXPONENT: f64 = 1.5;
/// Waves where a table leaves them out: from ovality on; one wave is a ring out of its centre.
const USUAL_WAVES: [usize; 2] = [2, 300];

fn waves(node: &Node) -> Result<[usize; 2], Misfit> {
    let allowed = format!("[fewest, most], whole numbers of 1 to {MOST_WAVES}, the second no less than the first");
    let whole = |node: &Node| match node.value {
        Value::Integer(n) => usize::try_from(n).ok().filter(|n| (1..=MOST_WAVES).contains(n)),
        _ => None,
    };
    let pair = match &node.value {
        Value::Array(items) if items.len() == 2 => whole(&items[0]).zip(whole(&items[1])),
        _ => None,
    };
    let pair = pair.filter(|(first, last)| first <= last);
    let (first, last) =
        pair.ok_or_else(|| Misfit::new("no two numbers of waves", allowed).in_element(node).under(WAVES))?;
    Ok([first, last])
}

impl Unset for Waviness {
    fn unset() -> Self {
        Self { amplitude_um: f64::NAN, exponent: USUAL_EXPONENT, waves: USUAL_WAVES }
    }
}

impl ValueType for Waviness {
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
        let known = [AMPLITUDE.name, EXPONENT.name, WAVES];
        if let Some((name, entry)) = table.iter().find(|(name, _)| !known.contains(&name.as_str())) {
            return Err(Misfit::new("unknown key", known.join(", ")).in_element(&entry.node).under(name));
        }
        let Some(amplitude) = table.get(AMPLITUDE.name) else {
            return Err(Misfit::new(format!("{} is required", AMPLITUDE.name), ALLOWED));
        };
        let amplitude_um = read_under(&amplitude.node, &AMPLITUDE)?;
        let exponent = table.get(EXPONENT.name).map_or(Ok(USUAL_EXPONENT), |e| read_under(&e.node, &EXPONENT))?;
        let waves = table.get(WAVES).map_or(Ok(USUAL_WAVES), |entry| waves(&entry.node))?;
        Ok(Self { amplitude_um, exponent, waves })
    }

    fn node(&self) -> Node {
        let waves = each(&self.waves);
        Node::record([
            (AMPLITUDE.name, self.amplitude_um.node()),
            (EXPONENT.name, self.exponent.node()),
            (WAVES, waves),
        ])
    }

    fn schema(_: &Spec) -> Json {
        let described = |spec: &Spec, unit: &str| {
            let mut schema = f64::schema(spec);
            schema["description"] = format!("{}{unit}", spec.doc).into();
            schema
        };
        let mut exponent = described(&EXPONENT, "");
        exponent["default"] = USUAL_EXPONENT.into();
        json!({
            "type": "object",
            "properties": {
                AMPLITUDE.name: described(&AMPLITUDE, " (um)"),
                EXPONENT.name: exponent,
                WAVES: {
                    "type": "array", "items": { "type": "integer", "minimum": 1, "maximum": MOST_WAVES }, "minItems": 2, "maxItems": 2, "default": USUAL_WAVES,
                    "description": "waves per turn, the fewest and the most",
                },
            },
            "required": [AMPLITUDE.name],
            "additionalProperties": false,
        })
    }

    fn is_defined(&self) -> bool {
        self.amplitude_um.is_finite()
    }
}
