//! Numbers as text: comma, semicolon, tab or blanks between them, point or comma in them, with or without a line of
//! names.
//!
//! The layout is taken from the first lines (`layout.rs`); a column is then read in one pass, a line at a time, in a
//! buffer of fixed size (`lines.rs`). Lines that begin with `#` or `%` are comments. An empty field is NaN, an empty
//! line is passed over; in a file of one column both end what is read, and none but such may follow. Where commas are decimal, points are signs between thousands; between commas such a number is in
//! quotes, `"0,5","-1,2"`. A line above the numbers such as `Sample rate: 12000 Hz` states the rate.

mod cell;
mod cells;
mod clock;
mod format;
mod layout;
mod lines;
mod lvm;
mod number;
mod rows;

use std::io::{Read, Seek, SeekFrom};

use super::channel::{Channel, Rate, RateSource};
use super::contents::Contents;
use super::fault::{Fault, damaged, unsupported};
use super::listing::{Listing, Source};
use super::numbers::Sink;
use crate::Metadata;
use layout::Layout;

/// Lines that decide the layout.
const SAMPLE: u64 = 256 << 10;

struct Text {
    contents: Contents,
    layout: Layout,
    /// The field of each channel.
    fields: Vec<usize>,
}

/// The most bytes of a file whose signals lie along lines: it is held whole.
const MAX_ROWS: u64 = 64 << 20;
/// The most bytes of UTF-16, which is decoded whole.
const MAX_UTF16: u64 = 512 << 20;

/// The same as UTF-8 where a byte-order mark says that it is UTF-16, as Excel's "Unicode text" is.
pub(super) fn in_utf8(mut contents: Contents) -> Result<Contents, Fault> {
    let mut mark = Vec::new();
    (&mut contents).take(2).read_to_end(&mut mark)?;
    contents.seek(SeekFrom::Start(0))?;
    let decode = match mark[..] {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return Ok(contents),
    };
    if contents.length() > MAX_UTF16 {
        return Err(unsupported(format!("more than {} MiB of text in UTF-16; save it as UTF-8", MAX_UTF16 >> 20)));
    }
    let mut bytes = Vec::new();
    contents.read_to_end(&mut bytes)?;
    let units = bytes[2..].as_chunks::<2>().0.iter().map(|unit| decode(*unit));
    let text: String = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
    Ok(Contents::of_bytes(text.into_bytes()))
}

pub(super) fn list(mut contents: Contents) -> Result<Listing, Fault> {
    let mut sample = Vec::new();
    (&mut contents).take(SAMPLE).read_to_end(&mut sample)?;
    if sample.iter().filter(|b| **b == b'\n').count() <= rows::MOST_LINES && contents.length() <= MAX_ROWS {
        let mut whole = sample.clone();
        (&mut contents).take(MAX_ROWS).read_to_end(&mut whole)?;
        if let Some(listing) = rows::list(&whole) {
            return Ok(listing);
        }
    }
    if sample.len() as u64 == SAMPLE {
        // The last line is cut.
        match memchr::memrchr(b'\n', &sample) {
            Some(end) => sample.truncate(end + 1),
            None => return Err(damaged("its first line does not end; this is no table")),
        }
    }
    let layout = layout::find(&sample)?;
    let (mut channels, mut fields) = (Vec::new(), Vec::new());
    for (field, column) in layout.columns.iter().enumerate() {
        if column.absent {
            continue;
        }
        fields.push(field);
        channels.push(Channel {
            name: column.name.clone(),
            stored_as: "text",
            unit: column.unit.clone(),
            rate: (column.rate_hz.map(|hz| (hz, "Delta_X".into())))
                .or_else(|| layout.rate.clone().filter(|_| !column.is_x))
                .map(|(hz, name)| Rate { hz, source: RateSource::Header(name) }),
            unreadable: column.words.clone(),
            ..Channel::default()
        });
    }
    Ok(Listing { channels, metadata: Metadata::default(), source: Box::new(Text { contents, layout, fields }) })
}

impl Source for Text {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        self.contents.seek(SeekFrom::Start(self.layout.start))?;
        lines::column(&mut self.contents, &self.layout, self.fields[index], sink)
    }
    fn set_lenient(&mut self, lenient: bool) {
        self.layout.lenient = lenient;
    }

    fn cell(&mut self, index: usize, value: u64) -> Option<(u64, String)> {
        self.contents.seek(SeekFrom::Start(self.layout.start)).ok()?;
        cell::find(&mut self.contents, &self.layout, self.fields[index], value)
    }
}
