//! `defects.table`: the name of a file, or the table itself.

use serde_json::{Value as Json, json};

use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::value_type::{Misfit, ValueType, object, read_under, wrong_type};
use crate::scenario::{DefectTable, OfList, TableData, TableValues};

const S: Spec = key("s_mm", "s, rising");
const DELTA: Spec = key("delta_um", "delta, rising");
const DELTA_EFF: Spec = key("delta_eff_um", "delta_eff, at every delta_um of the first s_mm, then of the next");
const ENERGY: Spec = key("energy_j", "E, in place of delta_eff");
const ALLOWED: &str = "\"FILE\", { s_mm = [..], delta_um = [..], delta_eff_um = [..] }, the same with energy_j = [..] in place of delta_eff_um";

impl ValueType for DefectTable {
    fn expected(_: &Spec) -> String {
        format!("one of {ALLOWED}")
    }

    fn range(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        let table = match &node.value {
            Value::Text(file) if file.trim().is_empty() => return Err(Misfit::new("no name of a file", ALLOWED)),
            Value::Text(file) => return Ok(Self::File(file.clone())),
            Value::Table(table) => table,
            _ => return Err(wrong_type::<Self>(node, spec)),
        };
        let names: Vec<&str> = table.keys().map(String::as_str).collect();
        let has = |value: &Spec| names.len() == 3 && [&S, &DELTA, value].iter().all(|spec| names.contains(&spec.name));
        let kinds: [(&Spec, OfList); 2] = [(&DELTA_EFF, TableValues::DeltaEffUm), (&ENERGY, TableValues::EnergyJ)];
        let Some((value, of)) = kinds.into_iter().find(|(value, _)| has(value)) else {
            return Err(Misfit::new(format!("keys {} make no table", names.join(", ")), ALLOWED));
        };
        let list = |spec: &Spec| read_under::<Vec<f64>>(&table[spec.name].node, spec);
        let data = TableData { values: of(list(value)?), s_mm: list(&S)?, delta_um: list(&DELTA)? };
        data.check().map_err(|fault| Misfit::new(fault.message, fault.allowed))?;
        Ok(Self::Read(data))
    }

    fn node(&self) -> Node {
        match self {
            Self::File(file) => file.node(),
            Self::Read(TableData { s_mm, delta_um, values }) => Node::record([
                (S.name, s_mm.node()),
                (DELTA.name, delta_um.node()),
                (values.name(), values.list().to_vec().node()),
            ]),
        }
    }

    fn schema(_: &Spec) -> Json {
        json!({ "oneOf": [
            { "type": "string", "description": "CSV with the columns s_mm, delta_um, delta_eff_um or energy_j, from the scenario's folder" },
            object(&[&S, &DELTA, &DELTA_EFF], &[&S, &DELTA, &DELTA_EFF].map(<Vec<f64>>::schema)),
            object(&[&S, &DELTA, &ENERGY], &[&S, &DELTA, &ENERGY].map(<Vec<f64>>::schema)),
        ] })
    }
}
