//! Universal File Format, dataset 58, read: functions at nodes, as text or binary (58b). Other datasets are passed
//! over.
//!
//! Layout: University of Cincinnati, SDRL, "Universal File Datasets Summary", 58 and 58b. Real functions are read,
//! evenly spaced or not; the abscissa of an uneven one is a channel of its own, `NAME.x`.

use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};

use super::channel::{Channel, Rate, RateSource};
use super::contents::Contents;
use super::fault::{Fault, damaged, unsupported};
use super::listing::{Listing, Source};
use super::numbers::{Number, Sink, give};
use crate::Metadata;

const MAX_LINE: u64 = 64 << 10;
const MAX_FUNCTIONS: usize = 100_000;
/// Other datasets that a message names.
const MAX_NAMED: usize = 20;
/// Values handed on at a time.
const PIECE: usize = 8 << 10;

/// How the values of a function are in the file.
#[derive(Clone, Copy, Debug)]
struct Function {
    start: u64,
    count: u64,
    binary: bool,
    big_endian: bool,
    double: bool,
    even: bool,
    /// Whether the abscissae are singles among doubles.
    short_x: bool,
}

struct Uff {
    contents: Contents,
    /// The function of each channel, and whether its abscissa is meant.
    functions: Vec<(Function, bool)>,
}

/// The lines of a file, with where each begins.
struct Lines {
    reader: BufReader<Contents>,
    at: u64,
    number: u64,
}

impl Lines {
    /// The next line without its end; `None` after the last.
    fn next(&mut self) -> Result<Option<String>, Fault> {
        let mut bytes = Vec::new();
        let got = (&mut self.reader).take(MAX_LINE).read_until(b'\n', &mut bytes)?;
        self.at += got as u64;
        self.number += 1;
        if got as u64 == MAX_LINE {
            return Err(damaged(format!("line {} has no end", self.number)));
        }
        let text = String::from_utf8_lossy(&bytes);
        Ok((got > 0).then(|| text.trim_end_matches(['\n', '\r']).to_owned()))
    }

    fn expect(&mut self) -> Result<String, Fault> {
        self.next()?.ok_or_else(|| damaged("the file ends within a dataset"))
    }

    fn go(&mut self, to: u64) -> Result<(), Fault> {
        self.reader.seek(SeekFrom::Start(to))?;
        self.at = to;
        Ok(())
    }
}

/// A field of a line of fixed columns.
fn field(line: &str, from: usize, width: usize) -> &str {
    let end = line.len().min(from + width);
    line.get(from.min(end)..end).unwrap_or_default().trim()
}

fn integer(line: &str, from: usize, width: usize, what: &str) -> Result<i64, Fault> {
    let text = field(line, from, width);
    text.parse().map_err(|_| damaged(format!("`{text}` is no {what}")))
}

pub(super) fn list(contents: Contents) -> Result<Listing, Fault> {
    let length = contents.length();
    let mut lines = Lines { reader: BufReader::new(contents), at: 0, number: 0 };
    let (mut channels, mut functions) = (Vec::new(), Vec::new());
    let mut metadata = Metadata::default();
    let mut others = Vec::new();
    // Outside of datasets; each begins and ends with a line of -1.
    while let Some(line) = lines.next()? {
        if line.trim() != "-1" {
            continue;
        }
        let Some(head) = lines.next()? else { break };
        let binary = head.get(6..7) == Some("b");
        if field(&head, 0, 6) != "58" {
            let number = field(&head, 0, 6).to_owned();
            if others.len() < MAX_NAMED && !others.contains(&number) {
                others.push(number);
            }
            while lines.expect()?.trim_end() != "    -1" {}
            continue;
        }
        if functions.len() >= MAX_FUNCTIONS {
            return Err(damaged("it has too many functions"));
        }
        let (function, channel) = function(&mut lines, &head, binary, length, &mut metadata)?;
        if !function.even {
            let mut abscissa = channel.clone();
            abscissa.name += ".x";
            abscissa.unit = None;
            channels.push(abscissa);
            functions.push((function, true));
        }
        channels.push(channel);
        functions.push((function, false));
    }
    if channels.is_empty() {
        return Err(match others.is_empty() {
            true => damaged("it has no dataset"),
            false => unsupported(format!(
                "a universal file without functions (dataset 58), so no signal is in it: datasets {}",
                others.join(", ")
            )),
        });
    }
    Ok(Listing { channels, metadata, source: Box::new(Uff { contents: lines.reader.into_inner(), functions }) })
}

/// One dataset 58; the lines then are behind it.
fn function(
    lines: &mut Lines,
    head: &str,
    binary: bool,
    length: u64,
    metadata: &mut Metadata,
) -> Result<(Function, Channel), Fault> {
    let mut records = Vec::new();
    for _ in 0..11 {
        records.push(lines.expect()?);
    }
    let name = match records[0].trim() {
        "" | "NONE" => format!("function at byte {}", lines.at),
        name => name.to_owned(),
    };
    let numbers = &records[6];
    let data_type = integer(numbers, 0, 10, "data type")?;
    let count = integer(numbers, 10, 10, "number of values")?;
    let count = u64::try_from(count).map_err(|_| damaged(format!("{count} values")))?;
    let even = integer(numbers, 20, 10, "spacing")? == 1;
    let double = matches!(data_type, 4 | 6);
    let complex = matches!(data_type, 5 | 6);
    if !matches!(data_type, 2 | 4 | 5 | 6) {
        return Err(damaged(format!("`{name}` has data of type {data_type}")));
    }
    let mut function = Function { start: lines.at, count, binary, big_endian: false, double, even, short_x: false };
    if binary {
        function.pass_binary(lines, head, &name, complex, length)?;
    } else {
        function.pass_text(lines, &name, length)?;
    }
    let keys = ["name", "description", "date", "id4", "id5"];
    for (i, key) in keys.iter().enumerate().skip(1) {
        let text = records[i].trim();
        if !text.is_empty() && text != "NONE" {
            metadata.pairs.push((format!("{name}.{key}"), text.to_owned()));
        }
    }
    let channel = channel(name, &records, &function, complex);
    Ok((function, channel))
}

impl Function {
    /// Passes over the values of a binary function, and finds how they lie.
    fn pass_binary(
        &mut self,
        lines: &mut Lines,
        head: &str,
        name: &str,
        complex: bool,
        length: u64,
    ) -> Result<(), Fault> {
        let per = if complex { 2 } else { 1 };
        self.big_endian = integer(head, 7, 6, "byte order")? == 2;
        if integer(head, 13, 6, "kind of floats")? != 2 {
            return Err(damaged("its numbers are not IEEE 754"));
        }
        let bytes = integer(head, 31, 12, "number of bytes")?;
        let bytes = u64::try_from(bytes).map_err(|_| damaged(format!("{bytes} bytes")))?;
        let width = if self.double { 8 } else { 4 };
        // The standard's uneven doubles have single abscissae, pyuff's have double ones.
        self.short_x = self.double && !self.even && self.count.saturating_mul(per * width + 4) == bytes;
        let x_width = match (self.even, self.short_x) {
            (true, _) => 0,
            (false, true) => 4,
            (false, false) => width,
        };
        // pyuff counts the bytes of real, even functions for every kind.
        let bytes = bytes.max(self.count.saturating_mul(per * width + x_width));
        if bytes > length.saturating_sub(lines.at) {
            return Err(damaged(format!("`{name}` claims {} values, more than are there", self.count)));
        }
        lines.go(self.start + bytes)?;
        // The line of values may or may not end before the closing -1.
        while lines.expect()?.trim() != "-1" {}
        Ok(())
    }

    fn pass_text(&self, lines: &mut Lines, name: &str, length: u64) -> Result<(), Fault> {
        if self.count > length - lines.at.min(length) {
            return Err(damaged(format!("`{name}` claims {} values, more than are there", self.count)));
        }
        while lines.expect()?.trim_end() != "    -1" {}
        Ok(())
    }
}

/// The channel of a function.
fn channel(name: String, records: &[String], function: &Function, complex: bool) -> Channel {
    let stored = if function.double { Number::F64 } else { Number::F32 };
    let mut channel = Channel::array(name, vec![function.count], stored);
    if complex {
        channel.unreadable = Some("holds complex numbers".into());
    }
    let unit = field(&records[8], 47, 20);
    channel.unit = Some(unit.to_owned()).filter(|u| !u.is_empty() && u != "NONE");
    let step: f64 = field(&records[6], 43, 13).parse().unwrap_or(0.0);
    // Type 17 of an abscissa is time.
    if function.even && step.is_finite() && step > 0.0 && field(&records[7], 0, 10) == "17" {
        let hz = 1.0 / step;
        let round = hz.round();
        // The step has six digits, or thirteen characters.
        let near = (hz / round - 1.0).abs() < 1e-5 && round >= 1.0;
        channel.rate = Some(Rate {
            hz: if near { round } else { hz },
            source: RateSource::Header("UFF 58 abscissa increment".into()),
        });
    }
    channel
}

impl Source for Uff {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        let (function, want_x) = self.functions[index];
        self.contents.seek(SeekFrom::Start(function.start))?;
        let mut reader = BufReader::with_capacity(256 << 10, &mut self.contents);
        // Abscissa and value alternate.
        let mut is_x = true;
        let mut picked = Vec::new();
        let mut pick = |values: &[f64]| {
            if function.even {
                return sink(values);
            }
            picked.clear();
            for &value in values {
                if is_x == want_x {
                    picked.push(value);
                }
                is_x = !is_x;
            }
            sink(&picked)
        };
        let total = function.count * if function.even { 1 } else { 2 };
        if function.short_x {
            mixed(&mut reader, function, &mut pick)
        } else if function.binary {
            let stored = if function.double { Number::F64 } else { Number::F32 };
            stored.stream(function.big_endian, &mut reader, total, &mut pick)
        } else {
            text(&mut reader, function, total, &mut pick)
        }
    }
}

/// Numbers in fixed columns, which may touch.
fn text(reader: &mut impl BufRead, function: Function, total: u64, sink: Sink<'_>) -> Result<(), Fault> {
    let widths: &[usize] = match (function.double, function.even) {
        (false, _) => &[13],
        (true, true) => &[20],
        (true, false) => &[13, 20],
    };
    let mut left = total;
    let mut values = Vec::with_capacity(PIECE);
    let mut line = Vec::new();
    while left > 0 {
        line.clear();
        if reader.take(MAX_LINE).read_until(b'\n', &mut line)? == 0 {
            return Err(damaged("the values end early"));
        }
        if line.trim_ascii() == b"-1" && line.starts_with(b"    -1") {
            return Err(damaged(format!("{left} values are missing at the end")));
        }
        let row = line.trim_ascii_end();
        let before = values.len();
        let mut at = 0;
        for width in widths.iter().cycle() {
            if at >= row.len() || (values.len() - before) as u64 == left {
                break;
            }
            let end = (at + width).min(row.len());
            match fast_float2::parse::<f64, _>(row[at..end].trim_ascii()) {
                Ok(value) => values.push(value),
                Err(_) => {
                    let text = String::from_utf8_lossy(&row[at..end]);
                    return Err(damaged(format!("`{}` is not a number", text.trim())));
                }
            }
            at = end;
        }
        left -= (values.len() - before) as u64;
        if values.len() >= PIECE {
            give(sink, &values)?;
            values.clear();
        }
    }
    give(sink, &values)
}

/// Binary pairs of a single and a double.
fn mixed(reader: &mut impl Read, function: Function, sink: Sink<'_>) -> Result<(), Fault> {
    let (mut pair, mut values) = ([0; 12], Vec::with_capacity(PIECE));
    for _ in 0..function.count {
        reader.read_exact(&mut pair)?;
        Number::F32.decode(function.big_endian, &pair[..4], &mut values);
        Number::F64.decode(function.big_endian, &pair[4..], &mut values);
        if values.len() >= PIECE {
            give(sink, &values)?;
            values.clear();
        }
    }
    give(sink, &values)
}
