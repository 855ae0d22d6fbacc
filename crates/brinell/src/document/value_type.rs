//! Kinds of value that a key can hold: how each is read, written and described.

use crate::did_you_mean::{did_you_mean, left_out, other_word};
use crate::scenario::{Choice, Unset};
use serde_json::{Value as Json, json};

use super::quantity;
use super::source::{Node, Value, override_value};
use super::spec::Spec;
use super::toml_text::quote;

/// A value that does not fit its key.
#[derive(Debug)]
pub struct Misfit {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub allowed: String,
    /// The element at fault, where the value is a list.
    pub element: Option<Box<Node>>,
    /// Path of the key at fault below the one that is read, where that holds keys of any name.
    pub under: String,
}

impl Misfit {
    /// Of the whole value.
    pub fn new(message: impl Into<String>, allowed: impl Into<String>) -> Misfit {
        Misfit { message: message.into(), allowed: allowed.into(), element: None, under: String::new() }
    }

    /// Of a key below this one.
    pub fn under(mut self, name: &str) -> Misfit {
        self.under = match self.under.as_str() {
            "" => name.to_owned(),
            rest => format!("{name}.{rest}"),
        };
        self
    }

    /// Of an element of a list.
    pub fn in_element(mut self, node: &Node) -> Misfit {
        self.element.get_or_insert_with(|| Box::new(node.clone()));
        self
    }
}

/// The value of one key.
pub trait ValueType: Sized + Clone + Unset {
    /// What the key expects, with its article.
    fn expected(spec: &Spec) -> String;
    /// The value of a node.
    ///
    /// # Errors
    /// Where it does not fit.
    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit>;
    /// The value as a node, without a place. Either this or [`ValueType::write`] is given; the other follows.
    fn node(&self) -> Node {
        let text = self.write();
        override_value(&text).unwrap_or(Node::unplaced(Value::Text(text)))
    }
    /// The value as TOML.
    fn write(&self) -> String {
        self.node().text()
    }
    /// The values accepted, as a JSON Schema.
    fn schema(spec: &Spec) -> Json;
    /// Values accepted, in the words of the template.
    fn range(spec: &Spec) -> String {
        let _ = spec;
        String::new()
    }
    /// Whether a computed default is usable.
    fn fits(&self, _spec: &Spec) -> bool {
        true
    }
    /// False for what comes of computing with values that could not be read.
    fn is_defined(&self) -> bool {
        true
    }
}

pub(super) fn wrong_type<T: ValueType>(node: &Node, spec: &Spec) -> Misfit {
    expected_another(T::expected(spec), node, T::range(spec))
}

/// Compiled once, not for each type.
fn expected_another(expected: String, node: &Node, range: String) -> Misfit {
    Misfit::new(format!("expected {expected}, found {}", node.kind()), range)
}

/// The value of a key of a table that is itself a value.
pub(super) fn read_under<T: ValueType>(node: &Node, spec: &Spec) -> Result<T, Misfit> {
    T::read(node, spec).map_err(|misfit| misfit.in_element(node).under(spec.name))
}

/// Schema of a table with these keys and no others.
pub(super) fn object(specs: &[&Spec], schemas: &[Json]) -> Json {
    let mut properties = serde_json::Map::new();
    for (spec, schema) in specs.iter().zip(schemas) {
        let mut schema = schema.clone();
        schema["description"] = format!("{} ({})", spec.doc, spec.unit).into();
        properties.insert(spec.name.into(), schema);
    }
    let required: Vec<&str> = specs.iter().map(|spec| spec.name).collect();
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": false })
}

pub(super) fn in_unit(what: &str, spec: &Spec) -> String {
    match spec.unit {
        "" => what.to_string(),
        unit => format!("{what} in {unit}"),
    }
}

fn number_schema(kind: &str, spec: &Spec) -> Json {
    let mut schema = json!({ "type": kind });
    if let Some((low, closed)) = spec.range.low {
        schema[if closed { "minimum" } else { "exclusiveMinimum" }] = json_number(low);
    }
    if let Some((high, closed)) = spec.range.high {
        schema[if closed { "maximum" } else { "exclusiveMaximum" }] = json_number(high);
    }
    schema
}

fn json_number(x: f64) -> Json {
    if x.fract() == 0.0 && x.abs() < 1e15 { (x as i64).into() } else { x.into() }
}

fn not_a_quantity(words: String, spec: &Spec) -> Misfit {
    let others = quantity::examples(spec.unit).join(", ");
    let allowed = match others.as_str() {
        "" => format!("a number, or a string with a unit that converts to {}", spec.unit),
        _ => format!("a number, or a string with a unit: {}, {others}", spec.unit),
    };
    Misfit::new(words, allowed)
}

fn out_of_range(x: f64, spec: &Spec) -> Misfit {
    let allowed = spec.range.to_string();
    if x.is_finite() { Misfit::new("out of range", allowed) } else { Misfit::new("not a finite number", allowed) }
}

impl ValueType for f64 {
    fn expected(spec: &Spec) -> String {
        in_unit("a number", spec)
    }

    fn read(node: &Node, spec: &Spec) -> Result<f64, Misfit> {
        let x = match &node.value {
            Value::Float(x) => *x,
            Value::Integer(n) => *n as f64,
            Value::HugeInteger(_) => {
                return Err(Misfit::new("number too large", spec.range.to_string()));
            }
            Value::Text(text) => match quantity::converted(text, spec.unit) {
                Some(number) => number.map_err(|words| not_a_quantity(words, spec))?,
                None => return Err(wrong_type::<f64>(node, spec)),
            },
            _ => return Err(wrong_type::<f64>(node, spec)),
        };
        if spec.range.contains(x) { Ok(x) } else { Err(out_of_range(x, spec)) }
    }

    fn node(&self) -> Node {
        Node::unplaced(Value::Float(*self))
    }

    fn schema(spec: &Spec) -> Json {
        let mut schema = number_schema("number", spec);
        if quantity::is_convertible(spec.unit) {
            // Bounds are about numbers, the pattern about strings.
            schema["type"] = ["number", "string"].into();
            schema["pattern"] = quantity::PATTERN.into();
        }
        schema
    }

    fn range(spec: &Spec) -> String {
        spec.range.to_string()
    }

    fn fits(&self, spec: &Spec) -> bool {
        spec.range.contains(*self)
    }

    fn is_defined(&self) -> bool {
        self.is_finite()
    }
}

impl ValueType for usize {
    fn expected(spec: &Spec) -> String {
        in_unit("a whole number", spec)
    }

    fn read(node: &Node, spec: &Spec) -> Result<usize, Misfit> {
        match &node.value {
            Value::Integer(n) => match usize::try_from(*n) {
                Ok(count) if spec.range.contains(*n as f64) => Ok(count),
                _ => Err(out_of_range(*n as f64, spec)),
            },
            Value::HugeInteger(_) => Err(out_of_range(0.0, spec)),
            _ => Err(wrong_type::<usize>(node, spec)),
        }
    }

    fn node(&self) -> Node {
        Node::whole(*self as u64)
    }

    fn schema(spec: &Spec) -> Json {
        number_schema("integer", spec)
    }

    fn range(spec: &Spec) -> String {
        spec.range.to_string()
    }

    fn fits(&self, spec: &Spec) -> bool {
        spec.range.contains(*self as f64)
    }
}

impl ValueType for bool {
    fn expected(_: &Spec) -> String {
        "true or false".into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<bool, Misfit> {
        match &node.value {
            Value::Boolean(value) => Ok(*value),
            _ => Err(wrong_type::<bool>(node, spec)),
        }
    }

    fn node(&self) -> Node {
        Node::unplaced(Value::Boolean(*self))
    }

    fn schema(_: &Spec) -> Json {
        json!({ "type": "boolean" })
    }

    fn range(_: &Spec) -> String {
        "true | false".into()
    }
}

impl ValueType for String {
    fn expected(_: &Spec) -> String {
        "a string in quotes".into()
    }

    fn read(node: &Node, spec: &Spec) -> Result<String, Misfit> {
        match &node.value {
            Value::Text(text) => Ok(text.clone()),
            // The word of an override, which no quotes are around: `--set bearing.preset=6205`.
            Value::Integer(n) if node.span.is_none() => Ok(n.to_string()),
            _ => Err(wrong_type::<String>(node, spec)),
        }
    }

    fn node(&self) -> Node {
        Node::unplaced(Value::Text(self.clone()))
    }

    fn schema(_: &Spec) -> Json {
        json!({ "type": "string" })
    }
}

pub(super) fn elements<'a, T: ValueType>(node: &'a Node, spec: &Spec) -> Result<&'a [Node], Misfit> {
    match &node.value {
        Value::Array(items) => Ok(items),
        _ => Err(wrong_type::<T>(node, spec)),
    }
}

pub(super) fn read_each<T: ValueType>(items: &[Node], spec: &Spec) -> Result<Vec<T>, Misfit> {
    items.iter().map(|item| T::read(item, spec).map_err(|misfit| misfit.in_element(item))).collect()
}

pub(super) fn each<T: ValueType>(items: &[T]) -> Node {
    Node::unplaced(Value::Array(items.iter().map(ValueType::node).collect()))
}

/// What lists of any length hold.
pub(super) trait Listed: ValueType {
    /// Such a list, with its article.
    const LIST: &'static str;
    /// Where it holds lists: how many at least.
    const LISTS: Option<usize> = None;
}

impl Listed for f64 {
    const LIST: &'static str = "a list of numbers";
}

impl Listed for String {
    const LIST: &'static str = "a list of strings";
}

impl<T: Listed> ValueType for Vec<T> {
    fn expected(spec: &Spec) -> String {
        in_unit(T::LIST, spec)
    }

    fn read(node: &Node, spec: &Spec) -> Result<Vec<T>, Misfit> {
        let items = elements::<Vec<T>>(node, spec)?;
        let wrong = items.iter().find(|item| T::LISTS.is_some() && !matches!(item.value, Value::Array(_)));
        match wrong {
            Some(item) => Err(wrong_type::<T>(item, spec).in_element(item)),
            None => read_each(items, spec),
        }
    }

    fn node(&self) -> Node {
        each(self)
    }

    fn schema(spec: &Spec) -> Json {
        let mut schema = json!({ "type": "array", "items": T::schema(spec) });
        if let Some(least) = T::LISTS {
            schema["minItems"] = least.into();
        }
        schema
    }

    fn range(spec: &Spec) -> String {
        T::range(spec)
    }
}

impl<const N: usize> ValueType for [f64; N] {
    fn expected(spec: &Spec) -> String {
        match N {
            2 => in_unit("a list [x, y] of two numbers", spec),
            _ => in_unit(&format!("a list of {N} numbers"), spec),
        }
    }

    fn read(node: &Node, spec: &Spec) -> Result<Self, Misfit> {
        let items = elements::<Self>(node, spec)?;
        let numbers: Vec<f64> = read_each(items, spec)?;
        numbers.try_into().map_err(|numbers: Vec<f64>| {
            let expected = Self::expected(spec);
            let message = format!("expected {expected}, found {} of them", numbers.len());
            Misfit::new(message, Self::range(spec))
        })
    }

    fn node(&self) -> Node {
        each(self)
    }

    fn schema(spec: &Spec) -> Json {
        json!({ "type": "array", "items": f64::schema(spec), "minItems": N, "maxItems": N })
    }

    fn range(spec: &Spec) -> String {
        spec.range.to_string()
    }
}

/// A word and what it means.
type Word = (&'static str, &'static str);

/// The words of a closed choice, without its type, so that what follows is compiled once.
fn words_of<T: Choice>() -> Vec<Word> {
    T::WORDS.iter().map(|(word, _, meaning)| (*word, *meaning)).collect()
}

fn word_list(words: &[Word]) -> String {
    let words: Vec<String> = words.iter().map(|(word, _)| quote(word)).collect();
    words.join(", ")
}

fn one_of_words(words: &[Word]) -> String {
    match words {
        [(word, _)] => quote(word),
        _ => format!("one of {}", word_list(words)),
    }
}

/// Number of the word that a node says.
fn word_at(node: &Node, words: &[Word]) -> Result<usize, Misfit> {
    let Value::Text(text) = &node.value else {
        return Err(expected_another(one_of_words(words), node, word_list(words)));
    };
    words.iter().position(|(word, _)| word == text).ok_or_else(|| {
        let known = words.iter().map(|(word, _)| *word);
        let other = other_word(text).filter(|other| known.clone().any(|word| word == *other));
        let near = other.or_else(|| did_you_mean(text, known));
        let hint = match (near, left_out(text)) {
            (Some(word), _) => format!("; did you mean {}?", quote(word)),
            (None, Some(why)) => format!("; {why}"),
            (None, None) => String::new(),
        };
        Misfit::new(format!("unknown word{hint}"), word_list(words))
    })
}

fn schema_of_words(words: &[Word]) -> Json {
    let words: Vec<Json> =
        words.iter().map(|(word, meaning)| json!({ "const": word, "description": meaning })).collect();
    json!({ "type": "string", "oneOf": words })
}

fn words_explained(words: &[Word]) -> String {
    let words: Vec<String> = words.iter().map(|(word, meaning)| format!("{} ({meaning})", quote(word))).collect();
    words.join(" | ")
}

impl<T: Choice> ValueType for T {
    fn expected(_: &Spec) -> String {
        one_of_words(&words_of::<T>())
    }

    fn read(node: &Node, _: &Spec) -> Result<T, Misfit> {
        Ok(T::WORDS[word_at(node, &words_of::<T>())?].1)
    }

    fn node(&self) -> Node {
        Node::unplaced(Value::Text(self.word().into()))
    }

    fn schema(_: &Spec) -> Json {
        schema_of_words(&words_of::<T>())
    }

    fn range(_: &Spec) -> String {
        words_explained(&words_of::<T>())
    }
}
