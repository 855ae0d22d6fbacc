//! `housing.modes`: the name of a file, or the modes themselves; and matrices, lists of rows.

use serde_json::{Value as Json, json};

use super::source::{Node, Value};
use super::spec::{Spec, key};
use super::value_type::{Listed, Misfit, ValueType, each, object, read_under, wrong_type};
use crate::scenario::{HousingMode, HousingModes, Unset};

/// Fastest mode of a structure, Hz: a loaded element's own, of some 40 kHz, sets the step then.
pub(super) const FASTEST_HZ: f64 = 2e4;
/// Modes of a housing at most.
const MOST: usize = 500;

const FREQUENCY: Spec = key("frequency_hz", "undamped").from(0.0).to(FASTEST_HZ);
const DAMPING: Spec = key("damping_ratio", "share of critical damping").from(0.0).to(0.95);
const SEATS: Spec = key("seats", "[x, y] at each seat, of modal mass 1 kg");
const SENSORS: Spec = key("sensors", "at each sensor along its direction, likewise");
const ALLOWED: &str =
    "\"FILE\", or [{ frequency_hz = 300.0, damping_ratio = 0.02, seats = [[0.0, 0.3], ..], sensors = [0.3, ..] }, ..]";

impl Listed for Vec<f64> {
    const LIST: &'static str = "a list of rows [..]";
    const LISTS: Option<usize> = Some(1);
}

impl Unset for HousingModes {
    fn unset() -> Self {
        Self::Read(Vec::new())
    }
}

fn mode(node: &Node, spec: &Spec) -> Result<HousingMode, Misfit> {
    let Value::Table(table) = &node.value else {
        return Err(wrong_type::<HousingModes>(node, spec).in_element(node));
    };
    let known = [FREQUENCY.name, DAMPING.name, SEATS.name, SENSORS.name];
    if let Some((name, entry)) = table.iter().find(|(name, _)| !known.contains(&name.as_str())) {
        return Err(Misfit::new("unknown key", known.join(", ")).in_element(&entry.node).under(name));
    }
    let of = |spec: &Spec| {
        let entry = table.get(spec.name);
        entry
            .map(|entry| &entry.node)
            .ok_or_else(|| Misfit::new(format!("missing: `{}`", spec.name), ALLOWED).in_element(node))
    };
    // Without a sensor on it there is nothing to say.
    let sensors =
        table.get(SENSORS.name).map_or(Ok(Vec::new()), |entry| read_under::<Vec<f64>>(&entry.node, &SENSORS))?;
    let seats = of(&SEATS)?;
    let Value::Array(pairs) = &seats.value else {
        return Err(Misfit::new("expected a list of [x, y]", ALLOWED).in_element(seats).under(SEATS.name));
    };
    Ok(HousingMode {
        frequency_hz: read_under::<f64>(of(&FREQUENCY)?, &FREQUENCY)?,
        damping_ratio: read_under::<f64>(of(&DAMPING)?, &DAMPING)?,
        seats: pairs.iter().map(|pair| read_under::<[f64; 2]>(pair, &SEATS)).collect::<Result<_, _>>()?,
        sensors,
    })
}

impl ValueType for HousingModes {
    fn expected(_: &Spec) -> String {
        format!("one of {ALLOWED}")
    }

    fn range(_: &Spec) -> String {
        ALLOWED.into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        match &node.value {
            Value::Text(file) if file.trim().is_empty() => Err(Misfit::new("no name of a file", ALLOWED)),
            Value::Text(file) => Ok(Self::File(file.clone())),
            Value::Array(modes) if modes.len() > MOST => {
                Err(Misfit::new(format!("there are {} modes", modes.len()), format!("at most {MOST} of them")))
            }
            Value::Array(modes) if !modes.is_empty() => {
                Ok(Self::Read(modes.iter().map(|one| mode(one, spec)).collect::<Result<_, _>>()?))
            }
            _ => Err(wrong_type::<Self>(node, spec)),
        }
    }

    fn node(&self) -> Node {
        let one = |mode: &HousingMode| {
            Node::record([
                (FREQUENCY.name, mode.frequency_hz.node()),
                (DAMPING.name, mode.damping_ratio.node()),
                (SEATS.name, each(&mode.seats)),
                (SENSORS.name, mode.sensors.node()),
            ])
        };
        match self {
            Self::File(file) => file.node(),
            Self::Read(modes) => Node::unplaced(Value::Array(modes.iter().map(one).collect())),
        }
    }

    fn schema(_: &Spec) -> Json {
        let pairs = json!({ "type": "array", "items": { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 } });
        let schemas = [f64::schema(&FREQUENCY), f64::schema(&DAMPING), pairs, <Vec<f64>>::schema(&SENSORS)];
        let mut mode = object(&[&FREQUENCY, &DAMPING, &SEATS, &SENSORS], &schemas);
        mode["required"] = json!([FREQUENCY.name, DAMPING.name, SEATS.name]);
        json!({ "oneOf": [
            { "type": "string", "description": "CSV with frequency_hz, damping_ratio, bearing1_x, bearing1_y, ... and the names of the sensors, from the scenario's folder" },
            { "type": "array", "items": mode, "minItems": 1 },
        ] })
    }
}
