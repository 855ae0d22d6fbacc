//! One column of a text file, streamed.

use std::io::Read;

use memchr::{memchr, memchr_iter, memchr2, memrchr};

use super::decimal::decimal;
use super::layout::Layout;
use super::{Decimal, Delimiter};
use crate::read::fault::{Fault, damaged};
use crate::read::numbers::{Sink, give};

const BUFFER: usize = 1 << 20;
/// A longer line is no line of a table.
const MAX_LINE: usize = 16 << 20;
/// Values handed on at a time.
const PIECE: usize = 16 << 10;

/// Streams the values of one field of every line from where `reader` stands.
pub(super) fn column(
    reader: &mut impl Read,
    layout: &Layout,
    field: usize,
    sink: Sink<'_>,
) -> Result<(), Fault> {
    let mut buffer = vec![0; BUFFER];
    let (mut filled, mut line) = (0, layout.first_line);
    let mut values = Vec::with_capacity(PIECE);
    loop {
        let got = reader.read(&mut buffer[filled..]).map_err(Fault::Io)?;
        filled += got;
        // Whole lines; at the end of the file what is left is one.
        let whole = match memrchr(b'\n', &buffer[filled - got..filled]) {
            Some(end) => filled - got + end + 1,
            None => 0,
        };
        let mut rest = &buffer[..whole];
        while !rest.is_empty() {
            let length = match plain(rest, layout, field) {
                Some((value, length)) => {
                    values.push(value);
                    length
                }
                None => {
                    let end = memchr(b'\n', rest).unwrap_or(rest.len() - 1);
                    row(&rest[..end], layout, field, line, &mut values)?;
                    end + 1
                }
            };
            rest = &rest[length..];
            line += 1;
            if values.len() >= PIECE {
                give(sink, &values)?;
                values.clear();
            }
        }
        if got == 0 {
            row(&buffer[..filled], layout, field, line, &mut values)?;
            return give(sink, &values);
        }
        buffer.copy_within(whole..filled, 0);
        filled -= whole;
        if filled == buffer.len() {
            if filled >= MAX_LINE {
                return Err(damaged(format!("line {line} has no end")));
            }
            buffer.resize(2 * filled, 0);
        }
    }
}

/// The wanted value of a line that is as plain as nearly all are, and the length of the line with its end: numbers with a point and
/// nothing about them. `text` begins with the line and goes on to the end of some line. `None` says nothing: see [`row`].
fn plain(text: &[u8], layout: &Layout, field: usize) -> Option<(f64, usize)> {
    let columns = layout.columns.len();
    let delimiter = match layout.delimiter {
        // Runs of blanks are `row`'s business.
        Delimiter::Blanks if columns > 1 => return None,
        other => other.sign(),
    };
    if layout.decimal == Some(Decimal::Comma) || matches!(text[0], b'#' | b'%') {
        return None;
    }
    let to_delimiter = |from: usize| {
        let at = from + memchr2(delimiter, b'\n', &text[from..])?;
        (text[at] == delimiter).then_some(at + 1)
    };
    let start = (0..field).try_fold(0, |at, _| to_delimiter(at))?;
    let number = &text[start..];
    let (value, length) = decimal(number).or_else(|| fast_float2::parse_partial(number).ok())?;
    let end = start + length;
    let last = match columns - 1 - field {
        0 => end,
        after if text[end] == delimiter => {
            let last = (1..after).try_fold(end + 1, |at, _| to_delimiter(at))?;
            last + memchr2(delimiter, b'\n', &text[last..])?
        }
        _ => return None,
    };
    match &text[last..] {
        [b'\n', ..] => Some((value, last + 1)),
        [b'\r', b'\n', ..] => Some((value, last + 2)),
        _ => None,
    }
}

fn row(
    bytes: &[u8],
    layout: &Layout,
    field: usize,
    line: u64,
    values: &mut Vec<f64>,
) -> Result<(), Fault> {
    let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
    let mut wanted = None;
    let mut count = 0;
    let mut take = |piece| {
        if count == field {
            wanted = Some(piece);
        }
        count += 1;
    };
    match layout.delimiter {
        Delimiter::Blanks => bytes
            .split(|&b| b == b' ' || b == b'\t')
            .filter(|piece| !piece.is_empty())
            .for_each(take),
        single => {
            let mut start = 0;
            for end in memchr_iter(single.sign(), bytes) {
                take(&bytes[start..end]);
                start = end + 1;
            }
            take(&bytes[start..]);
        }
    }
    let value = wanted.and_then(|text| number(text, layout.decimal));
    if let Some(value) = value
        && count == layout.columns.len()
        && !matches!(bytes.first(), Some(b'#' | b'%'))
    {
        values.push(value);
        return Ok(());
    }
    let trimmed = bytes.trim_ascii();
    if trimmed.is_empty() || matches!(trimmed[0], b'#' | b'%') {
        return Ok(());
    }
    if count != layout.columns.len() {
        return Err(Fault::Row {
            line,
            expected: layout.columns.len(),
            got: count,
        });
    }
    let text = String::from_utf8_lossy(wanted.unwrap_or_default());
    Err(Fault::Number {
        line,
        column: layout.columns[field].name.clone(),
        text: text.trim().chars().take(40).collect(),
    })
}

/// A number, or NaN for an empty field; `None` for anything else.
pub(super) fn number(text: &[u8], decimal: Option<Decimal>) -> Option<f64> {
    if decimal != Some(Decimal::Comma)
        && let Ok(value) = fast_float2::parse::<f64, _>(text)
    {
        return Some(value);
    }
    let mut text = text.trim_ascii();
    if let Some(inner) = text.strip_prefix(b"\"").and_then(|t| t.strip_suffix(b"\"")) {
        text = inner.trim_ascii();
    }
    if text.is_empty() {
        return Some(f64::NAN);
    }
    let comma = memchr(b',', text).filter(|_| decimal != Some(Decimal::Point));
    match comma {
        Some(at) if text.len() <= 64 && memchr(b'.', text).is_none() => {
            let mut pointed = [0; 64];
            pointed[..text.len()].copy_from_slice(text);
            pointed[at] = b'.';
            fast_float2::parse(&pointed[..text.len()]).ok()
        }
        Some(_) => None,
        None if decimal == Some(Decimal::Comma) && memchr(b'.', text).is_some() => None,
        None => fast_float2::parse(text).ok(),
    }
}
