//! The tree of values that a scenario is read from: the TOML text with the overrides laid over it.

use std::collections::BTreeMap;
use std::ops::Range;

use serde_json::Value as Json;
use toml::de::{DeTable, DeValue};

use super::broken::{bare_value, bracket_before};
use super::problem::{Place, Problem, Severity, cut};
use super::problems::{MOST_OF_A_KIND, Problems};
use super::toml_text::{float, key_text, quote};

/// Tables and lists within each other, and parts of a key's path, at most: a scenario's own have eight. What is deeper
/// would end on the stack.
pub(crate) const DEEPEST: usize = 32;
/// Values and tables of a text at most: parsed, a value takes two hundred bytes and a table two kilobytes.
const MOST_VALUES: usize = 500_000;
const MOST_TABLES: usize = 50_000;
/// Bytes of a text up to which every syntax error is looked for; of a longer one the first is reported.
const MOST_RECOVERED: usize = 256 << 10;

/// The override of a key that is to have its default, as if it were not given; no text of TOML.
#[doc(hidden)]
pub const NOT_GIVEN: &str = "\0";

/// A value and where it is in the file; an override is nowhere.
#[derive(Debug, Clone)]
pub struct Node {
    /// The value.
    pub value: Value,
    /// Bytes of the text.
    pub span: Option<Range<usize>>,
}

/// A TOML value.
#[derive(Debug, Clone)]
pub enum Value {
    /// A string.
    Text(String),
    /// A whole number.
    Integer(i64),
    /// A whole number that no 64 bits hold.
    HugeInteger(String),
    /// A decimal number.
    Float(f64),
    /// True or false.
    Boolean(bool),
    /// A date or time.
    Datetime(String),
    /// A list.
    Array(Vec<Node>),
    /// A table.
    Table(Table),
}

/// Keys of a table with their values.
pub type Table = BTreeMap<String, Entry>;

/// A key of a table.
#[derive(Debug, Clone)]
pub struct Entry {
    pub(crate) key_span: Option<Range<usize>>,
    /// Its value.
    pub node: Node,
}

impl Node {
    pub(crate) fn unplaced(value: Value) -> Node {
        Node { value, span: None }
    }

    /// A whole number.
    pub(crate) fn whole(number: u64) -> Node {
        let small = i64::try_from(number).map(Value::Integer);
        Node::unplaced(small.unwrap_or_else(|_| Value::HugeInteger(number.to_string())))
    }

    /// A table of these keys.
    pub(crate) fn record<const N: usize>(keys: [(&str, Node); N]) -> Node {
        Node::table(keys.into_iter().map(|(key, node)| (key.to_owned(), Entry { key_span: None, node })).collect())
    }

    /// A value of the catalogue.
    pub(crate) fn of_catalogue(value: &Json) -> Node {
        Node::unplaced(match value {
            Json::String(text) => Value::Text(text.clone()),
            number => number.as_i64().map_or_else(|| Value::Float(number.as_f64().unwrap_or(f64::NAN)), Value::Integer),
        })
    }

    /// # Errors
    /// Where tables and lists lie in each other deeper than [`DEEPEST`], from `depth` on: the place of the first.
    fn from_toml(value: &toml::Spanned<DeValue<'_>>, placed: bool, depth: usize) -> Result<Node, Range<usize>> {
        if depth > DEEPEST {
            return Err(value.span());
        }
        let inner = match value.get_ref() {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(number) => match i64::from_str_radix(number.as_str(), number.radix()) {
                Ok(n) => Value::Integer(n),
                Err(_) => Value::HugeInteger(number.to_string()),
            },
            DeValue::Float(number) => Value::Float(number.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(truth) => Value::Boolean(*truth),
            DeValue::Datetime(time) => Value::Datetime(time.to_string()),
            DeValue::Array(items) => Value::Array(
                items.iter().map(|item| Node::from_toml(item, placed, depth + 1)).collect::<Result<_, _>>()?,
            ),
            DeValue::Table(table) => Value::Table(convert_table(table, placed, depth)?),
        };
        Ok(Node { value: inner, span: placed.then(|| value.span()) })
    }

    /// The TOML type with its article.
    pub fn kind(&self) -> &'static str {
        match self.value {
            Value::Text(_) => "a string",
            Value::Integer(_) | Value::HugeInteger(_) => "a whole number",
            Value::Float(_) => "a decimal number",
            Value::Boolean(_) => "true or false",
            Value::Datetime(_) => "a date or time",
            Value::Array(_) => "a list",
            Value::Table(_) => "a table",
        }
    }

    /// A table without a place.
    pub fn table(table: Table) -> Node {
        Node::unplaced(Value::Table(table))
    }

    /// The whole value as TOML, on one line.
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.render(&mut text, usize::MAX);
        text
    }

    /// The value on one short line, for messages.
    pub(crate) fn brief(&self) -> String {
        const LONGEST: usize = 60;
        let mut text = String::new();
        // Characters of several bytes are counted below.
        self.render(&mut text, 4 * LONGEST);
        cut(&text, LONGEST).into_owned()
    }

    fn render(&self, out: &mut String, enough: usize) {
        match &self.value {
            Value::Text(text) => out.push_str(&quote(text)),
            Value::Integer(n) => out.push_str(&n.to_string()),
            Value::HugeInteger(text) | Value::Datetime(text) => out.push_str(text),
            Value::Float(x) => out.push_str(&float(*x)),
            Value::Boolean(truth) => out.push_str(&truth.to_string()),
            Value::Array(items) => {
                out.push('[');
                for (i, item) in items.iter().enumerate() {
                    if out.len() > enough {
                        return;
                    }
                    out.push_str(if i == 0 { "" } else { ", " });
                    item.render(out, enough);
                }
                out.push(']');
            }
            Value::Table(table) => {
                out.push_str("{ ");
                for (i, (name, entry)) in table.iter().enumerate() {
                    if out.len() > enough {
                        return;
                    }
                    out.push_str(if i == 0 { "" } else { ", " });
                    out.push_str(&key_text(name));
                    out.push_str(" = ");
                    entry.node.render(out, enough);
                }
                out.push_str(" }");
            }
        }
    }
}

fn convert_table(table: &DeTable<'_>, placed: bool, depth: usize) -> Result<Table, Range<usize>> {
    table
        .iter()
        .map(|(key, value)| {
            let entry =
                Entry { key_span: placed.then(|| key.span()), node: Node::from_toml(value, placed, depth + 1)? };
            Ok((key.get_ref().to_string(), entry))
        })
        .collect()
}

/// The parts of a key's dotted path.
///
/// # Errors
/// Where there are more than 32.
pub fn path_parts(path: &str) -> Result<Vec<&str>, String> {
    let parts: Vec<&str> = path.split('.').map(str::trim).collect();
    match parts.len() {
        0..=DEEPEST => Ok(parts),
        count => Err(format!("the path of a key has {count} parts; there are at most {DEEPEST}")),
    }
}

/// A path in a message.
pub fn brief_path(path: &str) -> String {
    cut(path, 80).into_owned()
}

/// Parses `text` and lays `overrides` over it. Every syntax error is reported.
pub fn parse(text: &str, overrides: &[(String, String)]) -> Result<Table, Vec<Problem>> {
    let mut problems = Problems::of(text);
    let mut root = Node::unplaced(Value::Table(Table::new()));
    if let Some(message) = too_much(text) {
        problems.add(Problem::error("", message), None);
        return Err(problems.finish());
    }
    match DeTable::parse(text) {
        Ok(table) => match convert_table(table.get_ref(), true, 0) {
            Ok(table) => root.value = Value::Table(table),
            Err(span) => problems.add(Problem::error("", too_deep()), Some(span)),
        },
        Err(first) => {
            let mut errors = match text.len() {
                0..=MOST_RECOVERED => DeTable::parse_recoverable(text).1,
                _ => vec![first],
            };
            errors.sort_by_key(|error| error.span().map_or(0, |span| span.start));
            let mut before = None;
            for (k, error) in errors.iter().enumerate() {
                // A broken line often breaks in several ways: the first says enough.
                let start = error.span().map(|span| span.start.min(text.len()));
                let same_line = match (before, start) {
                    (Some(before), Some(start)) => !text.as_bytes()[before..start].contains(&b'\n'),
                    _ => false,
                };
                before = start;
                // All that follow are of the one bracket.
                if let (0..MOST_OF_A_KIND, Some(start)) = (k, start)
                    && let Some(at) = bracket_before(text, start)
                {
                    problems.add(not_closed(text, at, start), Some(at..at + 1));
                    break;
                }
                if !same_line {
                    problems.add_of(Severity::Error, "not valid TOML", || {
                        let why = start.and_then(|start| bare_value(text, start));
                        let message = format!("not valid TOML: {}", why.as_deref().unwrap_or(error.message()));
                        (Problem::error("", message), error.span())
                    });
                }
            }
        }
    }
    for (path, value) in overrides {
        if let Err(problem) = lay_over(&mut root, path, value) {
            problems.add(*problem, None);
        }
    }
    match root.value {
        Value::Table(table) if problems.is_empty() => Ok(table),
        _ => Err(problems.finish()),
    }
}

/// That the bracket at `at` is not closed before the line at `next`.
fn not_closed(text: &str, at: usize, next: usize) -> Problem {
    let (open, close) = if text[at..].starts_with('{') { ('{', '}') } else { ('[', ']') };
    let line = Place::new(text, next..next).line;
    Problem::error(
        "",
        format!("not valid TOML: this `{open}` is not closed before line {line}; its `{close}` is missing"),
    )
}

/// Refuses a text with too many values, by what is between them, before anything is made of it.
fn too_much(text: &str) -> Option<String> {
    let (mut values, mut tables) = (0, 0);
    let mut before = b'\n';
    for &byte in text.as_bytes() {
        values += usize::from(matches!(byte, b',' | b'=' | b'[' | b'{'));
        tables += usize::from(byte == b'{' || (byte == b'[' && before == b'\n'));
        before = byte;
    }
    // Each dot of a key may represent a table that nobody writes: `a.b = 1`, `[a.b]`, `{ a.b = 1 }`. Those of numbers
    // have digits after them.
    for line in text.lines() {
        let header = line.trim_start().starts_with('[') && !line.contains(',');
        let (key, value) = match line.split_once('=') {
            Some(parts) => parts,
            None if header => (line, ""),
            None => ("", line),
        };
        let in_value = value.as_bytes().windows(2);
        // Every other piece of a key between quotes is a name, dots and all.
        let bare = key.split(['"', '\'']).step_by(2);
        tables += bare.map(|piece| piece.matches('.').count()).sum::<usize>()
            + in_value.filter(|w| w[0] == b'.' && !w[1].is_ascii_digit()).count();
    }
    let (count, what, most) = match tables > MOST_TABLES {
        true => (tables, "tables", MOST_TABLES),
        false => (values, "values", MOST_VALUES),
    };
    (count > most).then(|| format!("some {count} {what} are more than the {most} of a document"))
}

fn too_deep() -> String {
    format!("tables and lists are nested more than {DEEPEST} levels deep")
}

/// A document without what means nothing: comments, spaces, the order of keys. Two texts that say the same have the
/// same.
///
/// # Errors
/// Where the text is no TOML.
pub fn canonical(text: &str) -> Result<String, Vec<Problem>> {
    Ok(Node::table(parse(text, &[])?).text())
}

/// Where a key is in a scenario's text: a path as in [`Problem::key`]. `None` where the text does not hold it or is not
/// TOML.
pub fn locate(text: &str, key: &str) -> Option<Place> {
    let mut node = Node::table(parse(text, &[]).ok()?);
    for step in key.split('.') {
        node = match node.value {
            Value::Table(mut table) => table.remove(step)?.node,
            Value::Array(items) => items.into_iter().nth(step.parse().ok()?)?,
            _ => return None,
        };
    }
    Some(Place::new(text, node.span?))
}

fn lay_over(root: &mut Node, path: &str, text: &str) -> Result<(), Box<Problem>> {
    let wrong = |message: String| Box::new(Problem::error(brief_path(path), message).value(brief_text(text)));
    let parts = path_parts(path).map_err(wrong)?;
    if text == NOT_GIVEN {
        take_away(root, &parts);
        return Ok(());
    }
    let value = override_value(text).map_err(wrong)?;
    let mut node = root;
    let mut walked = String::new();
    for segment in parts {
        if segment.is_empty() {
            return Err(wrong("an override names its key by a dotted path, such as operation.speed_rpm".into()));
        }
        let kind = node.kind();
        node = match &mut node.value {
            Value::Table(table) => {
                &mut table
                    .entry(segment.to_string())
                    .or_insert_with(|| Entry { key_span: None, node: Node::unplaced(Value::Table(Table::new())) })
                    .node
            }
            Value::Array(items) => {
                let count = items.len();
                let index = segment.parse::<usize>().ok().filter(|i| *i <= count);
                let Some(index) = index else {
                    return Err(wrong(format!(
                        "{walked} has {count} elements, counted from 0; \
                         `{segment}` is neither one of them nor the next"
                    )));
                };
                if index == count {
                    items.push(Node::unplaced(Value::Table(Table::new())));
                }
                &mut items[index]
            }
            _ => return Err(wrong(format!("{walked} is {kind} and has no keys"))),
        };
        if !walked.is_empty() {
            walked.push('.');
        }
        walked.push_str(segment);
    }
    *node = value;
    Ok(())
}

/// Removes a key, where it is given.
fn take_away(node: &mut Node, path: &[&str]) {
    match (path, &mut node.value) {
        ([key], Value::Table(table)) => drop(table.remove(*key)),
        ([key, rest @ ..], Value::Table(table)) => {
            if let Some(entry) = table.get_mut(*key) {
                take_away(&mut entry.node, rest);
            }
        }
        ([index, rest @ ..], Value::Array(items)) => {
            if let Some(item) = index.parse().ok().and_then(|index: usize| items.get_mut(index)) {
                take_away(item, rest);
            }
        }
        _ => {}
    }
}

/// A TOML value; a bare word is a string.
pub(crate) fn override_value(text: &str) -> Result<Node, String> {
    match DeValue::parse(text.trim()) {
        Ok(value) => Node::from_toml(&value, false, 0).map_err(|_| too_deep()),
        Err(error) if text.trim_start().starts_with(['[', '{', '"', '\'']) => {
            // `on="roller",roller=2`.
            let another = text.split_once(',').is_some_and(|(_, rest)| rest.contains('='));
            let hint = if another && !text.starts_with(['[', '{']) { "; keys are parted by `;`" } else { "" };
            Err(format!("not a TOML value: {}{hint}", error.message()))
        }
        Err(_) => Ok(Node::unplaced(Value::Text(text.trim().to_string()))),
    }
}

fn brief_text(text: &str) -> String {
    Node::unplaced(Value::Text(text.to_string())).brief()
}
