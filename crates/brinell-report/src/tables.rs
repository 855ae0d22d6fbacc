//! The page's tables and tiles: facts, indicators, assumptions.

use std::fmt::Write as _;

use crate::data::{Estimate, IndicatorTable};
use crate::fact::{Fact, Value};
use crate::frame::{none, unit_html};
use crate::markup::escape;
use crate::number::{short, significant, twelve_digits, with_interval};
use brinell::document::Provenance;

/// Characters from which a cell holds sentences.
const SENTENCE: usize = 100;

/// A table of words and numbers as they are to be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Heading.
    pub title: String,
    /// Heads of the columns; one that begins with `#` is set as numbers, `Unit` as units.
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

/// A table up to its rows; heads as [`Table::columns`]. `stack` has narrow pages set the cells of a row one below the
/// other.
pub(crate) fn open_table(page: &mut String, stack: bool, heads: &[impl AsRef<str>]) {
    let class = if stack { " class=\"stack\"" } else { "" };
    let _ = write!(page, "<div class=\"scroll\"><table{class}><thead><tr>");
    for head in heads.iter().map(AsRef::as_ref) {
        let class = if head.starts_with('#') { " class=\"number\"" } else { "" };
        let _ = write!(page, "<th{class}>{}</th>", escape(head.trim_start_matches('#')));
    }
    page.push_str("</tr></thead><tbody>\n");
}

pub(crate) fn close_table(page: &mut String) {
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
        let value = escape(&fact.value.words(4));
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
            let _ = write!(page, "<dd class=\"note\">{}</dd>", escape(&fact.note));
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
    open_table(page, true, &["Quantity", "#Value", "Unit", "Note"]);
    for fact in facts {
        let _ = write!(page, "<tr><th scope=\"row\">{}</th>", escape(&fact.label));
        value_cells(page, &fact.value, &fact.unit);
        let _ = write!(page, "<td class=\"note\">{}", unit_html(&fact.note));
        if let Some(ok) = fact.ok {
            let _ = write!(page, " {}", judged(ok));
        }
        page.push_str("</td></tr>\n");
    }
    close_table(page);
}

fn value_cells(page: &mut String, value: &Value, unit: &str) {
    let (value, unit) = (escape(&value.words(6)), unit_html(unit));
    let _ = write!(page, "<td class=\"number\">{value}</td> <td class=\"unit\">{unit}</td>");
}

pub(crate) fn indicators(page: &mut String, table: &IndicatorTable) {
    if table.rows.is_empty() {
        return none(page, "No indicators were computed.");
    }
    let columns = table.columns.iter().map(|column| format!("#{column}"));
    let heads: Vec<String> = ["Channel", "Signal"].map(String::from).into_iter().chain(columns).collect();
    open_table(page, false, &heads);
    for row in &table.rows {
        let _ = write!(
            page,
            "<tr><th scope=\"row\"><code>{}</code></th><td>{}</td>",
            escape(&row.channel),
            escape(&row.kind)
        );
        for cell in
            row.cells.iter().map(Some).chain(std::iter::repeat(None)).take(table.columns.len().max(row.cells.len()))
        {
            let _ = write!(page, "<td class=\"number\">{}</td>", cell.map_or_else(|| "–".to_owned(), estimate));
        }
        page.push_str("</tr>\n");
    }
    close_table(page);
    if !table.note.is_empty() {
        none(page, &escape(&table.note));
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

pub(crate) fn assumptions(page: &mut String, all: &[Provenance]) {
    if all.is_empty() {
        return none(page, "No assumptions are listed.");
    }
    let estimated = all.iter().filter(|a| a.assumed).count();
    let _ = writeln!(
        page,
        "<p>{estimated} of {} values were assumed or estimated; the others were stated by the source named. What the assumed ones do to the levels: \
         <code>brinell run --spread</code>; how far to trust a number: <code>docs/src/trust.md</code>.</p>",
        all.len()
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
    open_table(page, true, &["Key", "#Value", "Unit", "Source or reason"]);
    for assumption in all {
        let _ = write!(page, "<tr><th scope=\"row\"><code>{}</code></th>", escape(&assumption.key));
        value_cells(page, &plain(&assumption.value).into(), assumption.unit);
        let tag = match assumption.assumed {
            true => "<span class=\"tag assumed\">assumed</span> ",
            false => "",
        };
        let _ = writeln!(page, "<td class=\"note\">{tag}{}</td></tr>", escape(&assumption.reason()));
    }
    close_table(page);
}

pub(crate) fn table(page: &mut String, table: &Table) {
    let _ = writeln!(page, "<section>\n<h2>{}</h2>", escape(&table.title));
    // Beside sentences, which a narrow page has no room for in a column.
    let stack = table.rows.iter().flatten().any(|cell| cell.chars().count() > SENTENCE);
    open_table(page, stack, &table.columns);
    let class = |i: usize| match table.columns.get(i).and_then(|head| head.strip_prefix('#')) {
        Some(head) if stack => format!(" class=\"number\" data-head=\"{}\"", escape(head)),
        Some(_) => " class=\"number\"".into(),
        None => String::new(),
    };
    for row in &table.rows {
        page.push_str("<tr>");
        for (i, cell) in row.iter().enumerate() {
            let set = match table.columns.get(i).map(String::as_str) {
                Some("Unit") => unit_html(cell),
                _ => escape(cell),
            };
            let _ = write!(page, "<td{}>{set}</td>", class(i));
        }
        page.push_str("</tr>\n");
    }
    close_table(page);
    if !table.note.is_empty() {
        let _ = writeln!(page, "<p class=\"none\">{}</p>", escape(&table.note));
    }
    page.push_str("</section>\n");
}

/// What failed, and why. `each` is what one of them is called: "Point".
pub(crate) fn failures(page: &mut String, each: &str, all: &[(String, String)]) {
    open_table(page, true, &[each, "Why"]);
    for (name, reason) in all {
        let _ = writeln!(
            page,
            "<tr><th scope=\"row\">{}</th><td class=\"note\">{}</td></tr>",
            escape(name),
            escape(reason)
        );
    }
    close_table(page);
}
