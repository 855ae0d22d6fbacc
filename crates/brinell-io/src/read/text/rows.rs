//! Signals that lie along a line each, where others have a column.

use super::format::{Delimiter, TextFormat};
use super::layout::{ORDER, bracketed, decimal, rate, score, split, text};
use super::number::number;
use crate::Metadata;
use crate::read::channel::{Channel, Rate, RateSource};
use crate::read::fault::Fault;
use crate::read::listing::{Listing, Source};
use crate::read::numbers::{Sink, give};

/// Numbers that make a line a signal, where a file has so few lines.
const FEWEST: usize = 100;
const MOST_SIGNALS: usize = 4;
/// Lines of a file that are looked at, with those of a title.
pub(super) const MOST_LINES: usize = 12;

struct Rows(Vec<Vec<f64>>);

impl Source for Rows {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        give(sink, &self.0[index])
    }
}

/// The signals of a whole file, each a line of numbers, which may begin with a name; `None` where it is no such file.
pub(super) fn list(whole: &[u8]) -> Option<Listing> {
    let whole = whole.strip_prefix(b"\xef\xbb\xbf").unwrap_or(whole);
    let lines: Vec<&[u8]> = whole.split(|b| *b == b'\n').filter(|l| !l.trim_ascii().is_empty()).collect();
    if lines.len() > MOST_LINES {
        return None;
    }
    let (mut channels, mut values) = (Vec::new(), Vec::new());
    let stated = lines.iter().find_map(|line| rate(line));
    for line in lines {
        let fields = |d: &Delimiter| split(line, *d).len();
        let Some(delimiter) =
            ORDER.into_iter().filter(|d| fields(d) >= FEWEST).max_by_key(|d| score(line, *d, &TextFormat::default()).0)
        else {
            continue;
        };
        let decimal = decimal(delimiter, &TextFormat::default(), &[line]);
        let mut cells = split(line, delimiter);
        if cells.last().is_some_and(|cell| cell.is_empty()) {
            cells.pop();
        }
        let label = cells.first().filter(|cell| number(cell, decimal).is_none()).map(|cell| text(cell));
        let numbers = cells.iter().skip(usize::from(label.is_some())).map(|cell| number(cell, decimal));
        // Else a table of many columns.
        let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
        let name = label.unwrap_or_else(|| format!("row{}", channels.len() + 1));
        channels.push(Channel {
            unit: bracketed(&name),
            name,
            shape: vec![numbers.len() as u64],
            length: Some(numbers.len() as u64),
            stored_as: "text",
            ..Channel::default()
        });
        values.push(numbers);
    }
    if channels.is_empty() || channels.len() > MOST_SIGNALS {
        return None;
    }
    for channel in channels.iter_mut().filter(|c| !c.is_time()) {
        channel.rate = stated.clone().map(|(hz, name)| Rate { hz, source: RateSource::Header(name) });
    }
    Some(Listing { channels, metadata: Metadata::default(), source: Box::new(Rows(values)) })
}
