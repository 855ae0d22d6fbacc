//! How the lines of a text file are made, from the first of them.

use super::cells;
use super::clock;
use super::format::{Decimal, Delimiter, TextFormat};
use super::lvm::{self, Lvm};
use super::number::{may_be_grouped, number};
use crate::read::channel::names_a_rate;
use crate::read::fault::{Fault, damaged, unsupported};

/// How a file's lines are made.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) delimiter: Delimiter,
    /// `None` where the sample shows neither; then both are taken.
    pub(super) decimal: Option<Decimal>,
    pub(super) columns: Vec<Column>,
    /// Where the first line of numbers begins, and which line it is, from 1.
    pub(super) start: u64,
    pub(super) first_line: u64,
    /// From a header that states it, with what it is called there.
    pub(super) rate: Option<(f64, String)>,
    /// A LabVIEW file, in which a further segment may begin.
    pub(super) is_lvm: bool,
    /// What is no number counts as a value that is missing, and a further segment as the end.
    pub(super) lenient: bool,
}

/// One field of every line.
#[derive(Debug, Default)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) unit: Option<String>,
    /// What it holds instead of numbers, in words.
    pub(super) words: Option<String>,
    /// Without a name and always empty, as behind a trailing delimiter.
    pub(super) absent: bool,
    /// The abscissa, which has no sample rate.
    pub(super) is_x: bool,
    /// Of this column alone, from a LabVIEW header.
    pub(super) rate_hz: Option<f64>,
    /// What stands behind each of its numbers, as ` g` does; not part of them.
    pub(super) suffix: String,
    /// A column of date-times: the day from which its seconds count.
    pub(super) clock: Option<i64>,
}

impl Column {
    /// A field's number, or NaN where it is empty; `None` for anything else.
    pub(super) fn value(&self, field: &[u8], decimal: Option<Decimal>) -> Option<f64> {
        match self.clock {
            Some(first) => clock::read(field).map(|(day, seconds)| (day - first) as f64 * 86_400.0 + seconds),
            None if self.suffix.is_empty() => number(field, decimal),
            None => number(cells::without(field, &self.suffix)?, decimal),
        }
    }
}

struct Line<'a> {
    start: usize,
    number: u64,
    text: &'a [u8],
    comment: bool,
}

pub(super) const ORDER: [Delimiter; 4] = [Delimiter::Tab, Delimiter::Semicolon, Delimiter::Comma, Delimiter::Blanks];
/// Lines of numbers that are looked at.
const LOOK: usize = 200;

/// Finds the layout in the first lines of a file, all of them whole.
pub(super) fn find(sample: &[u8]) -> Result<Layout, Fault> {
    let mut sample = sample.to_vec();
    let suffixes = cells::blank_units(&mut sample);
    let lines = lines(&sample);
    let lvm = lvm::header(&lines.iter().map(|l| l.text).collect::<Vec<_>>());
    let from = lvm.as_ref().map_or(0, |lvm| lvm.lines);
    let format = lvm.as_ref().map_or(TextFormat::default(), |lvm| lvm.format);
    let plain: Vec<&Line> = lines[from..].iter().filter(|l| !l.comment).collect();
    let (first, delimiter) = first_data(&plain, &format).ok_or_else(|| match plain[..] {
        // A table without rows is sound.
        [_] => unsupported("its only line is no numbers: a table without rows holds no signal"),
        _ => damaged("no line of numbers among its first lines"),
    })?;
    let all: Vec<&[u8]> = plain[first..].iter().map(|l| l.text).collect();
    let data = &all[..all.len().min(LOOK)];
    let start = plain[first];
    let mut rates = lines[from..].iter().take_while(|l| l.start < start.start).filter_map(|l| rate(l.text));
    let mut rate = rates.next();
    if rates.any(|other| rate.as_ref().is_some_and(|rate| rate.0 != other.0)) {
        rate = None;
    }
    let above: Vec<&[u8]> = plain[..first].iter().map(|l| l.text).filter(|l| self::rate(l).is_none()).collect();
    let delimiter = comma_or_fraction(delimiter, &format, &above, data)?;
    let decimal = decimal(delimiter, &format, &all);
    if decimal == Some(Decimal::Comma) {
        sure_of_thousands(delimiter, &all)?;
    }
    match (format.decimal, decimal) {
        (None, Some(Decimal::Comma)) => sure_of_fractions(delimiter, &all, b',')?,
        (None, Some(Decimal::Point)) if delimiter != Delimiter::Comma => sure_of_fractions(delimiter, &all, b'.')?,
        _ => {}
    }
    let mut columns = columns(delimiter, decimal, data)?;
    let comment = lines[from..]
        .iter()
        .rfind(|l| l.comment && l.start < start.start && self::rate(l.text).is_none())
        .map(|l| l.text.trim_ascii_start().get(1..).unwrap_or_default());
    name(&mut columns, delimiter, &above, comment, lvm.is_some());
    if let Some(lvm) = &lvm {
        rate = None;
        dress(&mut columns, lvm);
    }
    for (column, suffix) in columns.iter_mut().zip(suffixes.into_iter().flatten()) {
        column.unit = Some(suffix.clone()).filter(|unit| !unit.is_empty()).or(column.unit.take());
        column.suffix = suffix;
    }
    let (start, first_line) = (start.start as u64, start.number);
    Ok(Layout { delimiter, decimal, columns, start, first_line, rate, is_lvm: lvm.is_some(), lenient: false })
}

/// A line such as `Sample rate: 12000 Hz` or `# fs = 25.6 kHz`: hertz, and what the rate is called there.
pub(super) fn rate(line: &[u8]) -> Option<(f64, String)> {
    let line = text(line);
    let line = line.trim_start_matches(['#', '%', '/']);
    let (name, value) = line.split_once([':', '=', ';', ',', '\t'])?;
    let bare = name.split(['[', '(']).next().unwrap_or_default().trim();
    let is_rate = names_a_rate(&bare.replace([' ', '-'], "_"));
    let value = value.trim().trim_end_matches([',', ';', '\t']).trim();
    let end = value.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(value.len());
    let (number, unit) = value.split_at(end);
    let factor = match (unit.trim(), name.trim().strip_prefix(bare).map(|unit| self::bare(unit.trim())).as_deref()) {
        ("Hz" | "S/s", _) | ("", Some("" | "Hz" | "S/s")) => 1.0,
        ("kHz" | "kS/s", _) | ("", Some("kHz" | "kS/s")) => 1e3,
        _ => return None,
    };
    let hz = factor * number.parse::<f64>().ok()?;
    (is_rate && hz > 0.0 && hz.is_finite()).then(|| (hz, bare.to_owned()))
}

fn lines(sample: &[u8]) -> Vec<Line<'_>> {
    let mut start = if sample.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let mut lines = Vec::new();
    for (i, text) in sample[start..].split(|&b| b == b'\n').enumerate() {
        let length = text.len();
        let text = text.strip_suffix(b"\r").unwrap_or(text);
        let trimmed = text.trim_ascii();
        if !trimmed.is_empty() {
            lines.push(Line {
                start,
                number: i as u64 + 1,
                text,
                comment: matches!(trimmed[0], b'#' | b'%') || trimmed.starts_with(b"//"),
            });
        }
        start += length + 1;
    }
    lines
}

pub(super) fn split(line: &[u8], delimiter: Delimiter) -> Vec<&[u8]> {
    delimiter.fields(line).map(<[u8]>::trim_ascii).collect()
}

/// How many fields are numbers, and how many are neither numbers nor empty.
pub(super) fn score(line: &[u8], delimiter: Delimiter, format: &TextFormat) -> (usize, usize) {
    // Between commas, a decimal one is in quotes.
    let decimal = |f: &[u8]| match delimiter == Delimiter::Comma && !f.starts_with(b"\"") {
        true => Some(Decimal::Point),
        false => format.decimal,
    };
    split(line, delimiter).iter().filter(|f| !f.is_empty()).fold((0, 0), |(good, bad), f| match number(f, decimal(f)) {
        Some(_) => (good + 1, bad),
        None if clock::read(f).is_some() => (good, bad),
        None => (good, bad + 1),
    })
}

fn holds(line: &[u8], delimiter: Delimiter) -> bool {
    match delimiter {
        Delimiter::Comma | Delimiter::Semicolon => delimiter.fields(line).nth(1).is_some(),
        Delimiter::Tab => line.trim_ascii().contains(&b'\t'),
        Delimiter::Blanks => true,
    }
}

/// The first line of numbers and what is between them: first a line that is all numbers and not alone, then one that
/// has some.
fn first_data(lines: &[&Line], format: &TextFormat) -> Option<(usize, Delimiter)> {
    let choices: Vec<Delimiter> = match format.delimiter {
        Some(delimiter) => vec![delimiter],
        None => ORDER.to_vec(),
    };
    let pure = |line: &[u8], d| {
        let (good, bad) = score(line, d, format);
        good > 0 && bad == 0
    };
    let fits = |line: &[u8], d| holds(line, d) || format.delimiter.is_some();
    for (i, line) in lines.iter().enumerate() {
        let found = choices.iter().find(|&&d| fits(line.text, d) && pure(line.text, d));
        if let Some(&d) = found {
            let count = split(line.text, d).len();
            let follows = |next: &&Line| split(next.text, d).len() == count && pure(next.text, d);
            if lines.get(i + 1).is_none_or(follows) {
                return Some((i, d));
            }
        }
    }
    let some = |line: &[u8], d| score(line, d, format).0;
    for (i, line) in lines.iter().enumerate() {
        let candidates = choices.iter().filter(|&&d| fits(line.text, d));
        // On a tie the earlier in `ORDER` stays.
        let best = candidates.rev().max_by_key(|&&d| some(line.text, d));
        if let Some(&d) = best.filter(|&&d| some(line.text, d) > 0) {
            let count = split(line.text, d).len();
            let alike = |next: &&Line| split(next.text, d).len() == count && some(next.text, d) > 0;
            if lines.get(i + 1).is_none_or(alike) {
                return Some((i, d));
            }
        }
    }
    None
}

/// `1,5` may be two numbers or one; what decides is the format given, or the line of names. Otherwise it is refused.
fn comma_or_fraction(
    delimiter: Delimiter,
    format: &TextFormat,
    above: &[&[u8]],
    data: &[&[u8]],
) -> Result<Delimiter, Fault> {
    if delimiter != Delimiter::Comma || format.delimiter.is_some() {
        return Ok(delimiter);
    }
    if format.decimal == Some(Decimal::Comma) {
        return Ok(Delimiter::Blanks);
    }
    let open = |line: &&[u8]| {
        let commas = line.iter().filter(|&&b| b == b',').count();
        commas == 1 && !line.contains(&b'.') && !line.trim_ascii().contains(&b' ') && !line.trim_ascii().ends_with(b",")
    };
    if format.decimal == Some(Decimal::Point) || !data.iter().all(open) {
        return Ok(delimiter);
    }
    match above.last() {
        Some(names) if names.contains(&b',') => Ok(Delimiter::Comma),
        Some(_) => Ok(Delimiter::Blanks),
        None => Err(unsupported(format!(
            "`{}` may be two whole numbers or one with a decimal comma; write a decimal point, or name the columns in a line above",
            String::from_utf8_lossy(data.first().unwrap_or(&&b""[..])).trim()
        ))),
    }
}

/// Where points and commas are both there, the comma is decimal if it is no sign between thousands anywhere: a point
/// beside it is no decimal point then, and what is no number with points between thousands is refused.
pub(super) fn decimal(delimiter: Delimiter, format: &TextFormat, data: &[&[u8]]) -> Option<Decimal> {
    let fields = || data.iter().flat_map(|line| split(line, delimiter));
    let shows = |sign: u8, decimal| fields().any(|f| f.contains(&sign) && number(f, Some(decimal)).is_some());
    let is_point =
        |f: &[u8]| f.contains(&b'.') && number(f, Some(Decimal::Point)).is_some() && !may_be_grouped(f, b'.');
    let is_fraction = |f: &[u8]| f.contains(&b',') && number(f, Some(Decimal::Comma)).is_some();
    format.decimal.or_else(|| {
        let comma = fields().any(|f| is_fraction(f) && !may_be_grouped(f, b','));
        // Between commas only numbers in quotes can have decimal ones, and then none has a point.
        let may = delimiter != Delimiter::Comma || !fields().any(is_point);
        if comma && may {
            Some(Decimal::Comma)
        } else if delimiter == Delimiter::Comma || shows(b'.', Decimal::Point) {
            Some(Decimal::Point)
        } else if shows(b',', Decimal::Comma) {
            Some(Decimal::Comma)
        } else {
            None
        }
    })
}

/// Beside decimal commas, a column in which every number has one point and three digits behind it may hold thousands or
/// fractions.
fn sure_of_thousands(delimiter: Delimiter, data: &[&[u8]]) -> Result<(), Fault> {
    let one_point = |f: &[u8]| f.iter().filter(|b| **b == b'.').count() == 1 && may_be_grouped(f, b'.');
    let mut open: Vec<Option<&[u8]>> = data.first().map_or(Vec::new(), |line| {
        split(line, delimiter).into_iter().map(|f| Some(f).filter(|f| one_point(f))).collect()
    });
    for line in data {
        for (column, field) in open.iter_mut().zip(split(line, delimiter)) {
            *column = column.filter(|_| field.is_empty() || one_point(field));
        }
    }
    match open.into_iter().flatten().next() {
        None => Ok(()),
        Some(field) => Err(unsupported(format!(
            "`{0}` beside decimal commas may be a fraction or have a point between thousands, as has every number of its column; \
             write it with a comma, or without the point",
            String::from_utf8_lossy(field)
        ))),
    }
}

/// Where every fraction of a file has three digits, `2,143` may also be thousands: so in a column where shorter numbers
/// have no fraction at all, and no longer one lacks the sign.
fn sure_of_fractions(delimiter: Delimiter, data: &[&[u8]], sign: u8) -> Result<(), Fault> {
    let is_fraction = |f: &[u8]| f.contains(&sign) && !may_be_grouped(f, sign) && number(f, None).is_some();
    let fields = || data.iter().flat_map(|line| split(line, delimiter));
    if !fields().any(|f| f.contains(&sign)) || fields().any(is_fraction) {
        return Ok(());
    }
    // Of each column a number with the sign, whether there are short ones without it, and whether there are others.
    let mut seen: Vec<(Option<&[u8]>, bool, bool)> = Vec::new();
    for line in data {
        for (i, field) in split(line, delimiter).into_iter().enumerate().filter(|(_, f)| !f.is_empty()) {
            seen.resize(seen.len().max(i + 1), (None, false, false));
            let (with, short, other) = &mut seen[i];
            let digits = field.strip_prefix(b"-").or(field.strip_prefix(b"+")).unwrap_or(field);
            match may_be_grouped(field, sign) {
                true => _ = with.get_or_insert(field),
                // A dropout says nothing.
                false if digits == b"0" => {}
                false if digits.len() <= 3 && digits.iter().all(u8::is_ascii_digit) => *short = true,
                false => *other = true,
            }
        }
    }
    let open = seen.into_iter().find_map(|(with, short, other)| with.filter(|_| short && !other));
    match open {
        None => Ok(()),
        Some(field) => Err(unsupported(format!(
            "`{}` may be a fraction or have a {} between thousands, as every longer number of its column; \
             write all of them without it, or all with as many decimals",
            String::from_utf8_lossy(field),
            if sign == b',' { "comma" } else { "point" }
        ))),
    }
}

/// The columns by what the lines of numbers hold, not yet named.
fn columns(delimiter: Delimiter, decimal: Option<Decimal>, data: &[&[u8]]) -> Result<Vec<Column>, Fault> {
    let Some(first) = data.first() else {
        return Err(damaged("it has no numbers"));
    };
    let fields = split(first, delimiter);
    let mut columns: Vec<Column> = fields
        .iter()
        .map(|field| {
            let clock = clock::read(field).map(|(day, _)| day);
            let words = (number(field, decimal).is_none() && clock.is_none()).then(|| held(field, decimal));
            Column { words, clock, absent: true, ..Column::default() }
        })
        .collect();
    for line in data {
        for (column, field) in columns.iter_mut().zip(split(line, delimiter)) {
            column.absent &= field.is_empty();
        }
    }
    Ok(columns)
}

/// What a field holds that is no number.
fn held(field: &[u8], decimal: Option<Decimal>) -> String {
    let words: String = text(field).chars().take(40).collect();
    match decimal == Some(Decimal::Comma) && number(field, Some(Decimal::Point)).is_some() {
        true => format!("holds `{words}`, with a decimal point where other columns have decimal commas"),
        false => format!("holds words such as `{words}`"),
    }
}

/// UTF-8, or else Latin-1, where a µ is one byte.
pub(super) fn text(bytes: &[u8]) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    };
    text.trim().trim_matches('"').trim().to_owned()
}

/// Gives the columns the names and units that are above them.
fn name(columns: &mut [Column], delimiter: Delimiter, above: &[&[u8]], comment: Option<&[u8]>, more_names: bool) {
    let fits = |line: &[u8]| -> Option<Vec<String>> {
        let mut fields: Vec<String> = split(line, delimiter).into_iter().map(text).collect();
        // Blanks are between the words of a name, where nothing else is between numbers.
        if columns.len() == 1 && delimiter == Delimiter::Blanks && bracketed(&text(line)).is_some() {
            fields = vec![text(line)];
        }
        let enough = fields.len() == columns.len() || more_names && fields.len() > columns.len();
        enough.then_some(fields)
    };
    let mut lines = above.iter().rev().map_while(|line| fits(line));
    let (last, before) = (lines.next(), lines.next());
    let (names, units) = match (last, before) {
        (Some(units), Some(names)) if are_units(&units, &names) => (names, units),
        (Some(names), _) => (names, Vec::new()),
        (None, _) => {
            let words = |names: &Vec<String>| names.iter().all(|n| n.parse::<f64>().is_err());
            let names = comment.and_then(fits).filter(words);
            (names.unwrap_or_default(), Vec::new())
        }
    };
    for (i, column) in columns.iter_mut().enumerate() {
        let given = names.get(i).cloned().unwrap_or_default();
        column.absent &= given.is_empty();
        let own = bracketed(&given);
        let below = units.get(i).map(|u| bare(u)).filter(|u| !u.is_empty());
        column.unit = below.or(own);
        column.name = if given.is_empty() { format!("column{}", i + 1) } else { given };
        if column.clock.is_some() {
            column.unit = Some("s".into());
        }
    }
}

/// The text within brackets around all of it.
fn bare(unit: &str) -> String {
    let inner = unit
        .strip_prefix('[')
        .and_then(|u| u.strip_suffix(']'))
        .or_else(|| unit.strip_prefix('(').and_then(|u| u.strip_suffix(')')));
    inner.unwrap_or(unit).trim().to_owned()
}

/// The unit in `name [unit]`, or in `name (unit)` where it is a known one.
pub(super) fn bracketed(name: &str) -> Option<String> {
    let (_, square) = name.strip_suffix(']').and_then(|n| n.rsplit_once('[')).unzip();
    let (_, round) = name.strip_suffix(')').and_then(|n| n.rsplit_once('(')).unzip();
    square.or(round.filter(|u| KNOWN.contains(&u.trim()))).map(|u| u.trim().to_owned()).filter(|u| !u.is_empty())
}

/// Spellings that make a row of units.
const KNOWN: [&str; 54] = [
    "s", "sec", "ms", "us", "µs", "m", "mm", "um", "µm", "m/s", "mm/s", "in/s", "m/s^2", "m/s2", "m/s²", "m/s**2",
    "mm/s^2", "in/s^2", "in/s2", "ips", "g", "G", "mg", "gn", "V", "mV", "A", "mA", "N", "kN", "Nm", "N m", "Pa",
    "kPa", "MPa", "bar", "Hz", "kHz", "rpm", "RPM", "1/min", "r/min", "min-1", "U/min", "tr/min", "1/s", "r/s", "rps",
    "rad", "rad/s", "deg", "°", "°C", "K",
];

/// Whether a row has the units of the names above it: all are, or two of three, where none of those names is one.
fn are_units(units: &[String], names: &[String]) -> bool {
    let known = |all: &[String]| all.iter().filter(|text| KNOWN.contains(&text.as_str())).count();
    units.iter().all(|u| is_unit(u)) || 3 * known(units) >= 2 * units.len() && known(names) == 0
}

fn is_unit(text: &str) -> bool {
    let brackets = text.len() > 1
        && (text.starts_with('[') && text.ends_with(']') || text.starts_with('(') && text.ends_with(')'));
    text.is_empty() || text == "-" || text == "1" || brackets || KNOWN.contains(&text)
}

/// Adds what a LabVIEW header says of the columns.
fn dress(columns: &mut [Column], lvm: &Lvm) {
    let is_x: Vec<bool> = columns.iter().map(|c| c.name == "X_Value" || c.name.starts_with("X_Value")).collect();
    for ((column, said), is_x) in columns.iter_mut().zip(lvm.columns(&is_x)).zip(is_x) {
        column.is_x = is_x;
        if column.name == "Comment" {
            column.absent = true;
        } else if is_x {
            // Empty where `X_Columns` says that there are none.
            column.absent = lvm.no_x;
            column.unit = column.unit.take().or_else(|| lvm.seconds.then(|| "s".into()));
        } else {
            (column.unit, column.rate_hz) = (said.unit, said.rate_hz);
            if said.is_unused {
                column.words = Some("has 0 samples, as its header says".into());
            }
        }
    }
}
