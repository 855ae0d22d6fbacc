//! `bearing.waviness`: a table of an amplitude, its exponent and the waves of a turn.

use serde_json::Value as Json;

use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::value_type::{Misfit, ValueType, object, read_under, wrong_type};
use crate::scenario::Waviness;

const AMPLITUDE: Spec = key("amplitude_um", "A_1").from(0.0);
const EXPONENT: Spec = key("exponent", "q of A_k = A_1 k^-q");
const WAVES: Spec = key("waves", "first and last k, waves in a turn").from(1.0).to(5000.0);
const ALLOWED: &str = "{ amplitude_um = A, exponent = 1.5, waves = [2, 300] }";

impl ValueType for Waviness {
    fn blank() -> Self {
        Self { amplitude_um: 0.0, exponent: 1.5, waves: [2, 300] }
    }

    fn expected(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn range(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        let Value::Table(table) = &node.value else {
            return Err(wrong_type::<Self>(node, spec));
        };
        let known = [AMPLITUDE.name, EXPONENT.name, WAVES.name];
        if let Some(other) = table.keys().find(|name| !known.contains(&name.as_str())) {
            return Err(Misfit::new(format!("{other} is no key of a waviness"), ALLOWED));
        }
        let Some(amplitude) = table.get(AMPLITUDE.name) else {
            return Err(Misfit::new("no amplitude_um", ALLOWED));
        };
        let blank = Self::blank();
        let waves = match table.get(WAVES.name) {
            None => blank.waves,
            Some(entry) => {
                let waves: Vec<f64> = read_under(&entry.node, &WAVES)?;
                match waves[..] {
                    [first, last] if first <= last && first.fract() == 0.0 && last.fract() == 0.0 => {
                        [first as u32, last as u32]
                    }
                    _ => return Err(Misfit::new("not two whole numbers that rise", "[first, last]").under(WAVES.name)),
                }
            }
        };
        Ok(Self {
            amplitude_um: read_under(&amplitude.node, &AMPLITUDE)?,
            exponent: match table.get(EXPONENT.name) {
                None => blank.exponent,
                Some(entry) => read_under(&entry.node, &EXPONENT)?,
            },
            waves,
        })
    }

    fn write(&self) -> String {
        let Self { amplitude_um, exponent, waves: [first, last] } = self;
        format!(
            "{{ {} = {}, {} = {}, {} = [{first}, {last}] }}",
            AMPLITUDE.name,
            amplitude_um.write(),
            EXPONENT.name,
            exponent.write(),
            WAVES.name
        )
    }

    fn schema(_: &Spec) -> Json {
        let mut schema = object(
            &[&AMPLITUDE, &EXPONENT, &WAVES],
            &[f64::schema(&AMPLITUDE), f64::schema(&EXPONENT), <Vec<f64>>::schema(&WAVES)],
        );
        schema["required"] = serde_json::json!([AMPLITUDE.name]);
        schema
    }
}
