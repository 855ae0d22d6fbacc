//! Numbers as text: comma, semicolon, tab or blanks between them, point or comma in them, with or without a line of
//! names.
//!
//! The layout is taken from the first lines (`layout.rs`); a column is then read in one pass, a line at a time, in a
//! buffer of fixed size (`lines.rs`). Lines that begin with `#` or `%` are comments. An empty field is NaN, an empty
//! line is passed over; in a file of one column both end what is read, and none but such may follow. Where commas are decimal, points are signs between thousands; between commas such a number is in
//! quotes, `"0,5","-1,2"`. A line above the numbers such as `Sample rate: 12000 Hz` states the rate.

mod cell;
mod format;
mod layout;
mod lines;
mod lvm;
mod number;

use std::io::{Read, Seek, SeekFrom};

use super::channel::{Channel, Rate, RateSource};
use super::contents::Contents;
use super::fault::{Fault, damaged};
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

pub(super) fn list(mut contents: Contents) -> Result<Listing, Fault> {
    let mut sample = Vec::new();
    (&mut contents).take(SAMPLE).read_to_end(&mut sample)?;
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
            rate: (layout.rate.clone().filter(|_| !column.is_x))
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
    fn cell(&mut self, index: usize, value: u64) -> Option<(u64, String)> {
        self.contents.seek(SeekFrom::Start(self.layout.start)).ok()?;
        cell::find(&mut self.contents, &self.layout, self.fields[index], value)
    }
}
