//! `bearing.profile`: a word, or a table with the numbers of a crown or of a measured profile.

use serde_json::{Value as Json, json};

use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::value_type::{Misfit, ValueType, object, read_under, wrong_type};
use crate::scenario::RollerProfile;

const RADIUS: Spec = key("crowned_radius_mm", "R_c").above(0.0);
const Z: Spec = key("z_mm", "z, rising");
const DROP: Spec = key("drop_um", "p at each z").from(0.0);
const ALLOWED: &str = "\"straight\", \"logarithmic\", { crowned_radius_mm = R }, { z_mm = [..], drop_um = [..] }";

impl ValueType for RollerProfile {
    fn expected(_: &Spec) -> String {
        format!("one of {ALLOWED}")
    }

    fn range(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        let table = match &node.value {
            Value::Text(word) => {
                return match word.as_str() {
                    "straight" => Ok(Self::Straight),
                    "logarithmic" => Ok(Self::Logarithmic),
                    _ => Err(Misfit::new("unknown word", ALLOWED)),
                };
            }
            Value::Table(table) => table,
            _ => return Err(wrong_type::<Self>(node, spec)),
        };
        let names: Vec<&str> = table.keys().map(String::as_str).collect();
        match names[..] {
            ["crowned_radius_mm"] => {
                Ok(Self::Crowned { crowned_radius_mm: read_under(&table[RADIUS.name].node, &RADIUS)? })
            }
            ["drop_um", "z_mm"] => {
                let z_mm: Vec<f64> = read_under(&table[Z.name].node, &Z)?;
                let drop_um: Vec<f64> = read_under(&table[DROP.name].node, &DROP)?;
                if z_mm.len() != drop_um.len() || z_mm.is_empty() {
                    let lengths = format!("{} z and {} drops", z_mm.len(), drop_um.len());
                    return Err(Misfit::new(lengths, "one drop for each z, one or more"));
                }
                if z_mm.windows(2).any(|pair| pair[0] >= pair[1]) {
                    return Err(Misfit::new("z does not rise", "z_mm rising").under(Z.name));
                }
                Ok(Self::Table { z_mm, drop_um })
            }
            _ => Err(Misfit::new(format!("keys {} make no profile", names.join(", ")), ALLOWED)),
        }
    }

    fn node(&self) -> Node {
        let word = |word: &str| Node::unplaced(Value::Text(word.into()));
        match self {
            Self::Straight => word("straight"),
            Self::Logarithmic => word("logarithmic"),
            Self::Crowned { crowned_radius_mm } => Node::record([(RADIUS.name, crowned_radius_mm.node())]),
            Self::Table { z_mm, drop_um } => Node::record([(Z.name, z_mm.node()), (DROP.name, drop_um.node())]),
        }
    }

    fn schema(_: &Spec) -> Json {
        json!({ "oneOf": [
            { "const": "straight", "description": "none" },
            { "const": "logarithmic", "description": "ISO/TS 16281's" },
            object(&[&RADIUS], &[f64::schema(&RADIUS)]),
            object(&[&Z, &DROP], &[<Vec<f64>>::schema(&Z), <Vec<f64>>::schema(&DROP)]),
        ] })
    }
}
