//! `table` of a defect: a file's name, or the numbers of one.

use serde_json::{Value as Json, json};

use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::toml_text::quote;
use super::value_type::{Misfit, ValueType, object, read_under, wrong_type};
use crate::scenario::{DefectTable, TableData};

const S: Spec = key("s_mm", "arc from the defect's centre, rising");
const DELTA: Spec = key("delta_um", "deformation, rising");
const EFFECTIVE: Spec = key("delta_eff_um", "for each s those of every delta");
const ALLOWED: &str = "\"FILE.csv\", or { s_mm = [..], delta_um = [..], delta_eff_um = [..] }";

impl ValueType for DefectTable {
    fn blank() -> Self {
        Self::File(String::new())
    }

    fn expected(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn range(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        let table = match &node.value {
            Value::Text(file) => return Ok(Self::File(file.clone())),
            Value::Table(table) => table,
            _ => return Err(wrong_type::<Self>(node, spec)),
        };
        let names: Vec<&str> = table.keys().map(String::as_str).collect();
        if names != [EFFECTIVE.name, DELTA.name, S.name] {
            return Err(Misfit::new(format!("keys {} make no table", names.join(", ")), ALLOWED));
        }
        let data = TableData {
            s_mm: read_under(&table[S.name].node, &S)?,
            delta_um: read_under(&table[DELTA.name].node, &DELTA)?,
            delta_eff_um: read_under(&table[EFFECTIVE.name].node, &EFFECTIVE)?,
        };
        match data.fault() {
            Some(fault) => Err(Misfit::new(fault, "a full grid whose s_mm and delta_um rise")),
            None => Ok(Self::Read(data)),
        }
    }

    fn write(&self) -> String {
        match self {
            Self::File(file) => quote(file),
            Self::Read(TableData { s_mm, delta_um, delta_eff_um }) => format!(
                "{{ {} = {}, {} = {}, {} = {} }}",
                S.name,
                s_mm.write(),
                DELTA.name,
                delta_um.write(),
                EFFECTIVE.name,
                delta_eff_um.write()
            ),
        }
    }

    fn schema(_: &Spec) -> Json {
        let lists = [&S, &DELTA, &EFFECTIVE];
        json!({ "oneOf": [
            { "type": "string", "description": "path of a CSV file, from the scenario's folder" },
            object(&lists, &lists.map(<Vec<f64>>::schema)),
        ] })
    }
}
