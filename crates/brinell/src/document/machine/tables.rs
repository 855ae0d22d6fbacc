//! A machine's file as the files of its bearings: each has the keys of a scenario of one bearing, of which some are shared.

use super::super::problem::Problem;
use super::super::source::{Entry, Node, Table, Value};
use super::super::spec::key_meant;
use crate::bearing::catalogue;
use crate::scenario::{Choice, Element, LoadOn, ModelKind, Start};

/// Sections that a bearing of a machine has within its table.
pub(in super::super) const OF_A_BEARING: [&str; 6] = ["cage", "contact", "friction", "lubricant", "support", "defects"];
/// Of them those that may stand at the top of the file for all bearings.
pub(in super::super) const SHARED: [&str; 4] = ["cage", "contact", "friction", "lubricant"];
/// Sections that all bearings have in common.
pub(in super::super) const OF_ALL: [&str; 2] = ["operation", "simulation"];
/// Keys of `[operation]` that one bearing has and a machine does not: its loads are the shaft's.
pub(in super::super) const OF_THE_SHAFT: [&str; 3] = ["load_n", "load_on", "load_offset_mm"];
/// Keys of where a bearing is.
pub(super) const OF_A_SEAT: [&str; 6] =
    ["at_mm", "housing", "offset_um", "misalignment_mrad", "fit_stiffness_n_per_m", "fit_damping_ns_per_m"];
/// What a machine records where it does not say.
const RECORD: [&str; 4] = ["bearing*.outer_*", "bearing*.cage*", "shaft.*", "housing*"];

/// Whether a file is of a machine.
pub(in super::super) fn is_machine(root: &Table) -> bool {
    let bearings = root.get("bearing").is_some_and(|entry| matches!(entry.node.value, Value::Array(_)));
    bearings || root.contains_key("shaft")
}

/// The tables `[[bearing]]`.
pub(super) fn bearings(root: &Table) -> &[Node] {
    match root.get("bearing").map(|entry| &entry.node.value) {
        Some(Value::Array(nodes)) => nodes,
        _ => &[],
    }
}

pub(super) fn table_of(node: &Node) -> Option<&Table> {
    match &node.value {
        Value::Table(table) => Some(table),
        _ => None,
    }
}

fn unplaced(node: Node) -> Entry {
    Entry { key_span: None, node }
}

/// Puts a key that the file does not give into a section.
fn give(root: &mut Table, section: &str, name: &str, value: Value) {
    let entry = root.entry(section.into()).or_insert_with(|| unplaced(Node::table(Table::new())));
    if let Value::Table(table) = &mut entry.node.value {
        table.entry(name.into()).or_insert_with(|| unplaced(Node::unplaced(value)));
    }
}

/// A key that a bearing's table should not have: what it may have in a machine beside the keys of a bearing.
pub(super) fn with_keys_of_a_seat(problem: &mut Problem) {
    let name = problem.key.strip_prefix("bearing.").filter(|name| !name.contains('.'));
    let (Some(name), "unknown key") = (name, &*problem.message) else { return };
    match key_meant(name, &OF_A_SEAT) {
        Some(known) => {
            problem.message = format!("unknown key; did you mean `{known}`?");
            problem.allowed = None;
        }
        None => {
            let keys = [&OF_A_SEAT[..], &OF_A_BEARING].concat().join(", ");
            problem.allowed = problem.allowed.take().map(|of_a_bearing| format!("{keys}, {of_a_bearing}"));
        }
    }
}

/// The file of one bearing, on supports that do not hold its inner ring.
pub(super) fn alone(root: &Table, bearing: &Node) -> Table {
    let mut alone = Table::new();
    for name in OF_ALL.iter().chain(&SHARED) {
        if let Some(entry) = root.get(*name) {
            alone.insert((*name).into(), entry.clone());
        }
    }
    let mut own = bearing.clone();
    if let Value::Table(table) = &mut own.value {
        table.retain(|name, _| !OF_A_SEAT.contains(&name.as_str()));
        for name in OF_A_BEARING {
            let Some(mut section) = table.remove(name) else { continue };
            // What the bearing says of a section goes before what all bearings have of it.
            if let (Value::Table(own), Some(Entry { node: Node { value: Value::Table(shared), .. }, .. })) =
                (&mut section.node.value, alone.get(name))
            {
                for (key, entry) in shared {
                    own.entry(key.clone()).or_insert_with(|| entry.clone());
                }
            }
            alone.insert(name.into(), section);
        }
    }
    let has_balls = has_balls(&own);
    alone.insert("bearing".into(), unplaced(own));
    let text = |word: &str| Value::Text(word.into());
    // Balls have no ends that could tilt: beside rollers that do they stay in the plane.
    if let Some(Value::Table(simulation)) = alone.get_mut("simulation").map(|entry| &mut entry.node.value)
        && has_balls
        && matches!(simulation.get("model").map(|of| &of.node.value), Some(Value::Text(word)) if word == ModelKind::Tilting.word())
    {
        simulation.insert("model".into(), unplaced(Node::unplaced(text(ModelKind::Full.word()))));
    }
    // Which way, for what is where the load is if nothing else is said; how much, the balance finds.
    let load = direction(root).map(|f| Node::unplaced(Value::Float(f)));
    give(&mut alone, "operation", "load_n", Value::Array(load.to_vec()));
    give(&mut alone, "operation", "load_on", text(LoadOn::InnerRing.word()));
    give(&mut alone, "simulation", "start", text(Start::Equilibrium.word()));
    let record = RECORD.map(|pattern| Node::unplaced(text(pattern)));
    give(&mut alone, "simulation", "record", Value::Array(record.to_vec()));
    for name in ["inner_stiffness_n_per_m", "inner_damping_ns_per_m"] {
        give(&mut alone, "support", name, Value::Float(0.0));
    }
    give(&mut alone, "housing", "mass_kg", Value::Float(0.0));
    alone
}

/// The way of the shaft's loads together, or of its weight, as 1 N; nothing where there is neither.
fn direction(root: &Table) -> [f64; 2] {
    let pair = |node: Option<&Node>| match node.map(|node| &node.value) {
        Some(Value::Array(items)) if items.len() == 2 => [0, 1].map(|k: usize| match items[k].value {
            Value::Float(x) => x,
            Value::Integer(x) => x as f64,
            _ => 0.0,
        }),
        _ => [0.0; 2],
    };
    let loads = match at(root, "shaft.load").map(|node| &node.value) {
        Some(Value::Array(loads)) => &loads[..],
        _ => &[],
    };
    let each = loads.iter().map(|load| pair(table_of(load).and_then(|load| at(load, "force_n"))));
    let sum = each.fold([0.0; 2], |sum: [f64; 2], f| [sum[0] + f[0], sum[1] + f[1]]);
    let of = if sum == [0.0; 2] { pair(at(root, "operation.gravity_m_per_s2")) } else { sum };
    let size = of[0].hypot(of[1]);
    if size > 0.0 && size.is_finite() { of.map(|f| f / size) } else { [0.0; 2] }
}

/// Whether a bearing's table is of balls, as far as it can be told.
fn has_balls(bearing: &Node) -> bool {
    let Some(table) = table_of(bearing) else { return false };
    let word = |name: &str| match table.get(name).map(|entry| &entry.node.value) {
        Some(Value::Text(word)) => Some(word.as_str()),
        _ => None,
    };
    let of_preset = || word("preset").and_then(catalogue::find).is_some_and(catalogue::Entry::has_balls);
    word("element").map_or_else(of_preset, |element| element == Element::Ball.word())
}

/// What of the file is the machine's own: shaft, seats, housings, sensors, and keys that nobody knows.
pub(super) fn around(root: &Table) -> Table {
    let mut around = root.clone();
    around.retain(|name, _| name != "name" && !OF_ALL.contains(&name.as_str()) && !SHARED.contains(&name.as_str()));
    if let Some(Entry { node: Node { value: Value::Array(nodes), .. }, .. }) = around.get_mut("bearing") {
        for node in nodes {
            if let Value::Table(table) = &mut node.value {
                table.retain(|name, _| OF_A_SEAT.contains(&name.as_str()));
            }
        }
    }
    around
}

/// The key of a machine's file that the key of a bearing's own is there; `nested`: whether the bearing's table gives that section.
pub(super) fn key_in_machine(
    k: usize,
    key: &str,
    nested: impl Fn(&str) -> bool,
    shared: impl Fn(&str) -> bool,
) -> String {
    let section = key.split('.').next().unwrap_or_default();
    match section {
        "bearing" => format!("bearing.{k}{}", &key["bearing".len()..]),
        _ if OF_A_BEARING.contains(&section) && (nested(key) || !shared(key)) => format!("bearing.{k}.{key}"),
        _ => key.to_owned(),
    }
}

/// The other way round: the key of bearing `k`'s own file; `None` of another bearing and of what is around them.
pub(super) fn key_of_bearing(k: usize, key: &str) -> Option<String> {
    let Some(rest) = key.strip_prefix("bearing.") else {
        let section = key.split('.').next().unwrap_or_default();
        return (OF_ALL.contains(&section) || SHARED.contains(&section)).then(|| key.to_owned());
    };
    let (number, rest) = rest.split_once('.')?;
    if number.parse() != Ok(k) {
        return None;
    }
    let section = rest.split('.').next().unwrap_or_default();
    Some(if OF_A_BEARING.contains(&section) { rest.to_owned() } else { format!("bearing.{rest}") })
}

/// What a table holds at a path.
pub(super) fn at<'a>(table: &'a Table, path: &str) -> Option<&'a Node> {
    let (name, rest) = path.split_once('.').map_or((path, None), |(name, rest)| (name, Some(rest)));
    let node = &table.get(name)?.node;
    match rest {
        None => Some(node),
        Some(rest) => at(table_of(node)?, rest),
    }
}

/// Whether the file gives a key.
pub(super) fn given(root: &Table, key: &str) -> bool {
    at(root, key).is_some()
}
