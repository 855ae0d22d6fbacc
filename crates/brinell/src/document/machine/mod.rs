//! The file of a machine: `[shaft]`, `[[bearing]]`, `[[housing]]`, `[[sensor]]`. Each bearing is read as the file of one bearing that
//! [`tables`] makes of it, so that there is one list of its keys, one reader and one set of checks; [`keys`] lists what is around them.

mod checks;
pub(super) mod keys;
pub(super) mod tables;

use super::alone::{self, Loaded};
use super::checks::Finder;
use super::known_keys::keys_of_machine;
use super::problem::{Problem, Severity};
use super::provenance::{Provenance, by_key};
use super::reader::Reader;
use super::recorded::{self, SECTION};
use super::schema::schema_of;
use super::source::{Entry, Node, Table, Value};
use super::tree::Tree;
use super::writer::{Part, Style, Writer};
use super::{scenario_schema, sections};
use crate::scenario::{Machine, Scenario, Unset};
use serde_json::{Value as Json, json};
use tables::given;
pub(super) use tables::is_machine;

/// Reads the tree of a machine's file.
///
/// # Errors
/// Every problem of it, of each bearing and of what is around them.
pub(super) fn read(text: &str, root: &Table) -> Result<Loaded, Vec<Problem>> {
    let mut machine = Machine::unset();
    let around = tables::around(root);
    let mut reader = Reader::with_vocabulary(text, &around, keys_of_machine());
    reader.read_recorded();
    keys::machine(&mut reader, &mut machine);
    reader.finish();
    let finder = Finder::new(text, &reader.found, &reader.provenance);
    let mut problems = checks::check(&machine, &finder, reader.problems).finish();
    let mut bearings = Vec::new();
    let mut provenance = Vec::new();
    for (k, node) in tables::bearings(root).iter().enumerate().take(checks::MOST_BEARINGS) {
        let mut own = tables::alone(root, node);
        own.extend(root.get("name").map(|name| ("name".to_owned(), name.clone())));
        own.extend(recorded_of(root, k).map(|entry| (SECTION.to_owned(), entry)));
        let rename = |key: &str| name_in_machine(root, node, k, key);
        let seated = machine.seats.get(k).is_some_and(|seat| machine.housing_of(seat.housing).is_some());
        // What the machine decides is no matter of the bearing's file.
        let concerns = |key: &str| {
            let given = ![
                "operation.load_n",
                "operation.load_on",
                "simulation.record",
                "simulation.start",
                "housing.",
                "sensor.",
            ]
            .iter()
            .any(|own| key.starts_with(own));
            given && !(key.starts_with("support.inner") || seated && key.starts_with("support.outer"))
        };
        let mut told = |found: Vec<Problem>, all: bool| {
            for mut problem in found {
                if !all && !concerns(&problem.key) {
                    continue;
                }
                tables::with_keys_of_a_seat(&mut problem);
                problem.key = rename(&problem.key);
                problem.also.iter_mut().for_each(|(key, _)| *key = rename(key));
                if !problems.contains(&problem) {
                    problems.push(problem);
                }
            }
        };
        match alone::read(text, &own) {
            Ok(loaded) => {
                told(loaded.warnings, false);
                // Its load is the shaft's.
                let mut bearing = loaded.scenario;
                bearing.operation.load_n = [0.0; 2];
                bearings.push(bearing);
                let given_here = loaded.provenance.into_iter().filter(|p| concerns(&p.key) || given(root, &p.key));
                for mut entry in given_here {
                    entry.key = rename(&entry.key);
                    if !provenance.iter().any(|there: &Provenance| there.key == entry.key) {
                        provenance.push(entry);
                    }
                }
            }
            Err(found) => told(found, true),
        }
    }
    checks::of_bearings(root, (&machine, &bearings), text, &mut problems);
    problems.sort_by_key(Problem::order);
    if problems.iter().any(|problem| problem.severity == Severity::Error) {
        return Err(problems);
    }
    provenance.extend(reader.provenance);
    machine.lead = bearings.iter().position(|bearing| !bearing.defects.is_empty()).unwrap_or(0);
    let mut scenario = bearings.remove(machine.lead);
    machine.others = bearings;
    scenario.machine = Some(Box::new(machine));
    Ok(Loaded { scenario, provenance, warnings: problems })
}

/// The key of the machine's file that a key of a bearing's own is there.
fn name_in_machine(root: &Table, bearing: &Node, k: usize, key: &str) -> String {
    let nested = |key: &str| tables::table_of(bearing).is_some_and(|own| given(own, key));
    tables::key_in_machine(k, key, nested, |key| given(root, key))
}

/// What the file's `[provenance]` says of the keys of a bearing.
fn recorded_of(root: &Table, k: usize) -> Option<Entry> {
    let mut entry = root.get(SECTION)?.clone();
    if let Value::Table(section) = &mut entry.node.value
        && let Some(Entry { node: Node { value: Value::Array(items), .. }, .. }) = section.get_mut("assumed")
    {
        let renamed = |mut item: Node| {
            let Value::Table(table) = &mut item.value else { return Some(item) };
            let Some(Entry { node: Node { value: Value::Text(key), .. }, .. }) = table.get_mut("key") else {
                return Some(item);
            };
            *key = tables::key_of_bearing(k, key)?;
            Some(item)
        };
        *items = std::mem::take(items).into_iter().filter_map(renamed).collect();
    }
    Some(entry)
}

/// Every key of a machine, as its file would give it.
pub(super) fn tree_of(scenario: &Scenario, machine: &Machine) -> Table {
    let mut tree = Tree::default();
    keys::machine(&mut tree, &mut machine.clone());
    let mut root = tree.table;
    let mut seats = match root.remove("bearing").map(|entry| entry.node.value) {
        Some(Value::Array(seats)) => seats,
        _ => Vec::new(),
    };
    for ((_, mut of), seat) in machine.each(scenario).zip(&mut seats) {
        let mut own = Tree::default();
        sections::scenario(&mut own, &mut of);
        let mut own = own.table;
        let Value::Table(seat) = &mut seat.value else { continue };
        if let Some(Entry { node: Node { value: Value::Table(bearing), .. }, .. }) = own.remove("bearing") {
            seat.extend(bearing);
        }
        for name in tables::OF_A_BEARING {
            seat.extend(own.remove(name).map(|entry| (name.to_owned(), entry)));
        }
        own.retain(|name, _| name == "name" || tables::OF_ALL.contains(&name.as_str()));
        if let Some(Entry { node: Node { value: Value::Table(operation), .. }, .. }) = own.get_mut("operation") {
            operation.retain(|name, _| !tables::OF_THE_SHAFT.contains(&name.as_str()));
        }
        root.extend(own);
    }
    let mut of_all = Tree::default();
    sections::scenario(&mut of_all, &mut Scenario { simulation: scenario.of_all(), ..scenario.clone() });
    root.extend(of_all.table.remove("simulation").map(|entry| ("simulation".to_owned(), entry)));
    root.insert("bearing".into(), Entry { key_span: None, node: Node::unplaced(Value::Array(seats)) });
    root
}

/// The machine's file with every default filled in.
pub(super) fn write(scenario: &Scenario, machine: &Machine, provenance: &[Provenance]) -> String {
    let mut text = part(Part::Name, provenance, scenario);
    let mut around = Writer::of_part(style(provenance), Part::Around);
    keys::machine(&mut around, &mut machine.clone());
    let [shaft, rest] = around.finish_at_bearings();
    text.push_str(&shaft);
    for (k, (seat, alone)) in machine.each(scenario).enumerate() {
        let own: Vec<Provenance> = provenance
            .iter()
            .filter_map(|entry| Some(Provenance { key: tables::key_of_bearing(k, &entry.key)?, ..entry.clone() }))
            .collect();
        let mut writer = Writer::of_part(style(provenance), Part::Seat(k));
        keys::machine(&mut writer, &mut Machine { seats: vec![seat.clone()], ..Machine::unset() });
        text.push_str(&writer.finish());
        text.push_str(&part(Part::Bearing, &own, &alone));
    }
    text.push_str(&rest);
    let of_all = Scenario { simulation: scenario.of_all(), ..scenario.clone() };
    text.push_str(&part(Part::OfAll, provenance, &of_all));
    text
}

fn style(provenance: &[Provenance]) -> Style<'_> {
    Style { provenance: by_key(provenance), template: false }
}

/// A part of the file of one bearing.
fn part(part: Part, provenance: &[Provenance], scenario: &Scenario) -> String {
    let mut writer = Writer::of_part(style(provenance), part);
    sections::scenario(&mut writer, &mut scenario.clone());
    writer.finish()
}

/// JSON Schema (draft 2020-12) of the file of a machine; TOML tables are objects.
pub fn machine_schema() -> Json {
    let doc = "one run of a machine with rolling bearings, completely described";
    let mut schema = schema_of("brinell machine", doc, |walk| {
        keys::machine(walk, &mut Machine::unset());
        recorded::provenance(walk, &mut None);
    });
    let mut of_one = scenario_schema::json_schema();
    let mut section = |name: &str| of_one["properties"][name].take();
    let mut bearing = section("bearing");
    let seat = schema["properties"]["bearing"]["items"].take();
    for (name, of) in seat["properties"].as_object().into_iter().flatten() {
        bearing["properties"][name] = of.clone();
    }
    bearing["required"] = seat["required"].clone();
    for name in tables::OF_A_BEARING {
        bearing["properties"][name] = section(name);
    }
    for name in tables::SHARED {
        schema["properties"][name] = bearing["properties"][name].clone();
    }
    schema["properties"]["bearing"] =
        json!({ "type": "array", "items": bearing, "description": "the bearings, in any order" });
    for name in tables::OF_ALL {
        schema["properties"][name] = section(name);
    }
    for name in tables::OF_THE_SHAFT {
        if let Some(keys) = schema["properties"]["operation"]["properties"].as_object_mut() {
            keys.remove(name);
        }
    }
    schema["properties"]["operation"]["required"] = json!(["speed_rpm"]);
    schema["properties"]["name"] = section("name");
    schema["required"] = json!(["shaft", "bearing", "operation"]);
    schema
}
