//! Values with a unit of their own as numbers in the unit that a key's name carries, for whoever compares values before
//! a scenario is read.

use super::quantity;
use super::source::{Node, Value, override_value};
use super::spec::unit_of_key;

/// A value of a key: its quantities, those of lists and tables too, as numbers in their keys' unit. What is no quantity
/// of its key stays, so that the scenario's reader says what is wrong with it.
pub fn in_unit_of(key: &str, node: &Node) -> Node {
    in_unit(unit_of_key(key), node)
}

fn in_unit(unit: &str, node: &Node) -> Node {
    let value = match &node.value {
        Value::Text(text) => quantity::converted(text, unit).and_then(Result::ok).map(Value::Float),
        Value::Array(items) => Some(Value::Array(items.iter().map(|item| in_unit(unit, item)).collect())),
        Value::Table(table) => {
            let mut table = table.clone();
            table.iter_mut().for_each(|(name, entry)| entry.node = in_unit_of(name, &entry.node));
            Some(Value::Table(table))
        }
        _ => None,
    };
    Node { value: value.unwrap_or_else(|| node.value.clone()), span: node.span.clone() }
}

/// [`in_unit_of`] for the text of an override; `None` where it holds no quantity.
pub fn text_in_unit_of(key: &str, text: &str) -> Option<String> {
    // Quantities are strings, and every other value is quicker left alone.
    let holds_words = text.contains(|c: char| c.is_alphabetic() || c == '\u{b0}');
    let node = holds_words.then(|| override_value(text).ok()).flatten()?;
    let (before, after) = (node.text(), in_unit_of(key, &node).text());
    (before != after).then_some(after)
}

/// A value as values are compared: two that mean the same numbers give the same.
pub fn comparable(node: &Node) -> String {
    match &node.value {
        Value::Integer(n) => format!("{:?}", *n as f64),
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(comparable).collect();
            format!("[{}]", items.join(", "))
        }
        Value::Table(table) => {
            let entries: Vec<String> =
                table.iter().map(|(name, entry)| format!("{name:?} = {}", comparable(&entry.node))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
        Value::Float(x) => format!("{x:?}"),
        _ => node.text(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_quantities_are_numbers_of_their_keys_and_the_rest_stays() {
        for (key, text, converted) in [
            ("operation.speed_rpm", "20 Hz", Some("1200.0")),
            ("operation.speed_rpm", "\"20 Hz\"", Some("1200.0")),
            ("operation.load_n", "[0, \"2 kN\"]", Some("[0, 2000.0]")),
            ("operation.load_n.1", "2kN", Some("2000.0")),
            (
                "defects.0.shape",
                "{ circle = { diameter_mm = \"20 um\" } }",
                Some("{ circle = { diameter_mm = 0.02 } }"),
            ),
            // Numbers, words, and what the reader refuses.
            ("operation.speed_rpm", "1e3", None),
            ("operation.speed_rpm", "20 mm", None),
            ("operation.speed_rpm", "[\"20 Hz\"", None),
            ("bearing.preset", "6205", None),
            ("bearing.preset", "6205 N", None),
            ("simulation.model", "full", None),
        ] {
            assert_eq!(text_in_unit_of(key, text).as_deref(), converted, "{key} = {text}");
        }
        let same = |text: &str| comparable(&override_value(text).unwrap());
        assert_eq!(same("[1200, { a = 5 }]"), same("[1.2e3, { a = 5.0 }]"));
        assert_ne!(same("1200"), same("\"1200\""));
    }
}
