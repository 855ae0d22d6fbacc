//! The page's tables and tiles: facts, indicators, assumptions.

use std::fmt::Write as _;

use crate::data::{Estimate, IndicatorRow, IndicatorTable};
use crate::fact::{Fact, Value};
use crate::font;
use crate::frame::{none, unit_html};
use crate::markup::{breakable, escape, prose};
use crate::number::{minus, raised, short, significant, twelve_digits, with_interval};
use brinell::document::Provenance;

/// A cell with more characters than this is taken for a sentence.
const SENTENCE: usize = 100;

/// A table of words and numbers as they are to be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Heading; empty under another one.
    pub title: String,
    /// Heads of the columns. The cells under a head that begins with `#` are numbers, those under `Unit` units.
    pub columns: Vec<String>,
    /// Rows, a cell for each column.
    pub rows: Vec<Vec<String>>,
    /// Under it; may be empty.
    pub note: String,
}

impl Table {
    /// A table of its parts.
    pub fn new(
        title: impl Into<String>,
        columns: impl IntoIterator<Item = impl Into<String>>,
        rows: impl IntoIterator<Item = Vec<String>>,
        note: impl Into<String>,
    ) -> Self {
        let columns = columns.into_iter().map(Into::into).collect();
        Self { title: title.into(), columns, rows: rows.into_iter().collect(), note: note.into() }
    }
}

/// Columns that a phone has room for side by side.
const COLUMNS: usize = 4;
/// Characters of a name that is not broken.
const NAME: usize = 40;

/// Text that is seen of a cell.
fn text(html: &str) -> String {
    let mut within = false;
    let seen = |c: &char| {
        within = (within || *c == '<') && *c != '>';
        !within && *c != '>'
    };
    html.chars().filter(seen).collect()
}

/// Characters that are seen of a cell.
fn seen(html: &str) -> usize {
    text(html).chars().count()
}

/// On a narrow phone: room for a table, what a column of words and what a name has of it at least, and what lies
/// between columns, px.
const ROOM: f64 = 330.0;
const WORDS: f64 = 125.0;
const NAMES: f64 = 140.0;
const BETWEEN: f64 = 10.0;
/// Size of the text in tables, px.
const SIZE: f64 = 14.5;

/// The least width that a table has on a phone.
fn width(heads: &[&str], rows: &[Vec<String>]) -> f64 {
    let wide = |text: &str| font::width(text, SIZE, false);
    let column = |(k, head): (usize, &&str)| {
        let name = wide(head.trim_start_matches('#'));
        let cells = || rows.iter().filter_map(|row| row.get(k)).map(|cell| wide(&text(cell)));
        let widest = cells().fold(0.0, f64::max);
        let least = match *head {
            _ if k == 0 => widest.min(NAMES),
            head if head.starts_with('#') || head == "Unit" => widest,
            _ if widest > 0.0 => WORDS,
            _ => 0.0,
        };
        least.max(name) + BETWEEN
    };
    heads.iter().enumerate().map(column).sum()
}

/// The one writer of tables: heads as [`Table::columns`], where `Note`, `Why` and `Source or reason` are set in grey; cells are HTML. On a
/// narrow page each row of a table with many columns, with sentences, or too wide for it is a card.
pub(crate) fn rows(page: &mut String, heads: &[impl AsRef<str>], rows: impl IntoIterator<Item = Vec<String>>) {
    let heads: Vec<&str> = heads.iter().map(AsRef::as_ref).collect();
    let rows: Vec<Vec<String>> = rows.into_iter().collect();
    let stack =
        heads.len() > COLUMNS || rows.iter().flatten().any(|cell| seen(cell) > SENTENCE) || width(&heads, &rows) > ROOM;
    let class = if stack { " class=\"stack\"" } else { "" };
    let _ = write!(page, "<div class=\"scroll\"><table{class}><thead><tr>");
    for head in &heads {
        let class = if head.starts_with('#') { " class=\"number\"" } else { "" };
        let _ = write!(page, "<th{class}>{}</th>", breakable(&escape(&raised(head.trim_start_matches('#')))));
    }
    page.push_str("</tr></thead><tbody>\n");
    let numbers = heads.iter().filter(|head| head.starts_with('#')).count();
    for row in rows {
        page.push_str("<tr>");
        for (k, cell) in row.iter().enumerate() {
            let head = heads.get(k).copied().unwrap_or_default();
            let name = raised(head.trim_start_matches('#'));
            // A first cell says itself what it is, unless it is a number; a unit beside one number is that number's.
            let labelled = stack
                && match head {
                    _ if k == 0 => head.starts_with('#'),
                    _ => numbers > 1 || !(head.starts_with('#') || head == "Unit"),
                };
            let label = if labelled { format!(" data-head=\"{}\"", escape(&name)) } else { String::new() };
            let _ = match head {
                _ if k == 0 && seen(cell) <= NAME => {
                    write!(page, "<th scope=\"row\"{label}>{}</th>", breakable(cell))
                }
                _ if k == 0 => write!(page, "<td{label}>{}</td>", breakable(cell)),
                "Unit" => write!(page, " <td class=\"unit\"{label}>{cell}</td>"),
                "Note" | "Why" | "Source or reason" => write!(page, "<td class=\"note\">{cell}</td>"),
                _ if head.starts_with('#') => write!(page, "<td class=\"number\"{label}>{cell}</td>"),
                _ => write!(page, "<td{label}>{cell}</td>"),
            };
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody></table></div>\n");
}

pub(crate) fn facts(page: &mut String, facts: &[Fact]) {
    if facts.is_empty() {
        return;
    }
    page.push_str("<dl class=\"facts\">\n");
    for fact in facts {
        let class = match &fact.value {
            Value::Number(number) if number.is_finite() => "value",
            _ => "value words",
        };
        let value = minus(&escape(&fact.value.words(4)));
        let _ = write!(page, "<div><dt>{}</dt><dd class=\"{class}\">{value}", escape(&fact.label));
        if !fact.unit.is_empty() {
            let gap = if fact.unit == "°" { "" } else { " " };
            let unit = unit_html(&fact.unit);
            let _ = write!(page, "{gap}<span class=\"unit\">{unit}</span>");
        }
        page.push_str("</dd>");
        if let Some(ok) = fact.ok {
            let _ = write!(page, "<dd>{}</dd>", judged(ok));
        }
        if !fact.note.is_empty() {
            let _ = write!(page, "<dd class=\"note\">{}</dd>", minus(&escape(&fact.note)));
        }
        page.push_str("</div>\n");
    }
    page.push_str("</dl>\n");
}

fn judged(ok: bool) -> &'static str {
    if ok {
        "<span class=\"tag good\">within its limit</span>"
    } else {
        "<span class=\"tag bad\">outside its limit</span>"
    }
}

pub(crate) fn fact_table(page: &mut String, facts: &[Fact]) {
    let row = |fact: &Fact| {
        let ok = fact.ok.map_or(String::new(), |ok| format!(" {}", judged(ok)));
        let [value, unit] = value_cells(&fact.value, &fact.unit);
        vec![escape(&fact.label), minus(&value), unit, minus(&unit_html(&fact.note)) + &ok]
    };
    rows(page, &["Quantity", "#Value", "Unit", "Note"], facts.iter().map(row));
}

fn value_cells(value: &Value, unit: &str) -> [String; 2] {
    [escape(&value.words(6)), unit_html(unit)]
}

pub(crate) fn indicators(page: &mut String, table: &IndicatorTable) {
    if table.rows.is_empty() {
        return none(page, "No indicators were computed.");
    }
    let columns = table.columns.iter().map(|column| format!("#{column}"));
    let heads: Vec<String> = ["Channel", "Signal"].map(String::from).into_iter().chain(columns).collect();
    let of = |row: &IndicatorRow| {
        let missing = table.columns.len().saturating_sub(row.cells.len());
        let names = [format!("<code>{}</code>", escape(&row.channel)), escape(&row.kind)];
        let cells = row.cells.iter().map(estimate).chain(std::iter::repeat_n("–".to_owned(), missing));
        names.into_iter().chain(cells).collect()
    };
    rows(page, &heads, table.rows.iter().map(of));
    if !table.note.is_empty() {
        none(page, &prose(&table.note));
    }
}

fn estimate(cell: &Estimate) -> String {
    let unit = match &cell.unit[..] {
        unit if !unit.is_empty() && cell.value.is_finite() => format!(" {}", unit_html(unit)),
        _ => String::new(),
    };
    match cell.interval {
        Some((low, high)) if cell.value.is_finite() => {
            let [value, low, high] = with_interval(cell.value, low, high);
            format!("{value}{unit} <span class=\"half\">({low} to {high})</span>")
        }
        _ => significant(cell.value, 4) + &unit,
    }
}

pub(crate) fn assumptions(page: &mut String, all: &[Provenance], has_spread: bool) {
    if all.is_empty() {
        return none(page, "No assumptions are listed.");
    }
    let estimated = all.iter().filter(|a| a.assumed).count();
    let _ = writeln!(
        page,
        "<p>{estimated} of {} values were assumed or estimated; the others were stated by the source named. What the assumed ones do to the levels: \
         {}; how far to trust a number: the page <em>How far to trust a number</em> of the documentation.</p>",
        all.len(),
        if has_spread { "the section before this one" } else { "<code>brinell run --spread</code>" }
    );
    let part = |estimated: bool| all.iter().filter(move |a| a.assumed == estimated);
    if estimated > 0 {
        values(page, part(true));
    }
    if estimated < all.len() {
        let _ = writeln!(page, "<details><summary>{} stated values</summary>", all.len() - estimated);
        values(page, part(false));
        page.push_str("</details>\n");
    }
}

/// A value without what a change of its unit, or a quotient, leaves behind its digits; the scenario below has them all.
/// A whole number, as a seed is, stays as it is.
fn plain(value: &str) -> String {
    if value.parse::<i128>().is_ok() {
        return value.to_owned();
    }
    match value.parse::<f64>() {
        Ok(x) if twelve_digits(x).to_string().len() > LONGEST_NUMBER => short(x, 6),
        Ok(x) if value.len() > LONGEST_NUMBER => twelve_digits(x).to_string(),
        _ => value.to_owned(),
    }
}

/// Longest number that is shown as it was stated.
const LONGEST_NUMBER: usize = 9;

fn values<'a>(page: &mut String, all: impl Iterator<Item = &'a Provenance>) {
    let row = |of: &Provenance| {
        let tag = if of.assumed { "<span class=\"tag assumed\">assumed</span> " } else { "" };
        let [value, unit] = value_cells(&plain(&of.value).into(), of.unit);
        vec![format!("<code>{}</code>", escape(&of.key)), value, unit, format!("{tag}{}", escape(&of.reason()))]
    };
    rows(page, &["Key", "#Value", "Unit", "Source or reason"], all.map(row));
}

/// A number; what stands in brackets after it, mostly its interval, is on a line of its own.
fn number(cell: &str) -> String {
    let cell = minus(&escape(cell));
    match cell.split_once(" (") {
        Some((value, interval)) if interval.ends_with(')') => {
            format!("{value} <span class=\"half\">({interval}</span>")
        }
        _ => cell,
    }
}

pub(crate) fn table(page: &mut String, table: &Table) {
    page.push_str("<section>\n");
    if !table.title.is_empty() {
        let _ = writeln!(page, "<h2>{}</h2>", escape(&table.title));
    }
    let cell = |(k, cell): (usize, &String)| match table.columns.get(k).map(String::as_str) {
        Some("Unit") => unit_html(cell),
        Some(head) if head.starts_with('#') => number(cell),
        _ => escape(cell),
    };
    rows(page, &table.columns, table.rows.iter().map(|row| row.iter().enumerate().map(cell).collect()));
    if !table.note.is_empty() {
        none(page, &prose(&table.note));
    }
    page.push_str("</section>\n");
}

/// What failed, and why. `each` is what one of them is called: "Point".
pub(crate) fn failures(page: &mut String, each: &str, all: &[(String, String)]) {
    rows(page, &[each, "Why"], all.iter().map(|(name, reason)| vec![escape(name), escape(reason)]));
}
