//! MATLAB v5, v6 and v7 files, read: arrays, structs and cells at any depth, plain or compressed.
//!
//! Own code: of the crates, `matfile` has no structs and `matrw` takes whole files into memory and trusts their sizes.
//! Here a variable is walked through as a stream, once to list it and once for each read, so memory stays small
//! whatever a header claims. Layout: MathWorks, "MAT-File Format", version 5.

mod input;
mod walk;

use std::io::{Read, Seek, SeekFrom};

use super::channel::{lend_labels, lend_rates, lend_units};
use super::contents::Contents;
use super::fault::{Fault, damaged};
use super::increments::lend_increments;
use super::listing::{Listing, Source};
use super::numbers::Sink;
use crate::{Metadata, keys};
use input::{COMPRESSED, Input, MATRIX};
use walk::{Aim, Found, Walk};

const HEADER: u64 = 128;
/// Deflate makes at most 1032 bytes of one.
const MOST: u64 = 1032;
const MAX_VARIABLES: usize = 100_000;

/// A variable of the file.
#[derive(Clone, Copy)]
struct Place {
    /// Of its first byte behind the tag.
    start: u64,
    bytes: u64,
    compressed: bool,
}

struct Mat5 {
    contents: Contents,
    big_endian: bool,
    /// The variable of each channel, and the channel's number within it.
    places: Vec<(Place, usize)>,
}

pub(super) fn list(mut contents: Contents) -> Result<Listing, Fault> {
    let length = contents.length();
    let mut header = [0; HEADER as usize];
    contents.read_exact(&mut header)?;
    let big_endian = &header[126..] == b"MI";
    let mut found = Found::default();
    let mut mat = Mat5 { contents, big_endian, places: Vec::new() };
    let mut at = HEADER;
    let mut variables = 0;
    while at < length {
        mat.contents.seek(SeekFrom::Start(at))?;
        let mut tag = [0; 8];
        mat.contents.read_exact(&mut tag).map_err(|_| damaged(format!("it ends within the tag at byte {at}")))?;
        let number = |b: [u8; 4]| {
            if big_endian { u32::from_be_bytes(b) } else { u32::from_le_bytes(b) }
        };
        let kind = number([tag[0], tag[1], tag[2], tag[3]]);
        let bytes = u64::from(number([tag[4], tag[5], tag[6], tag[7]]));
        let start = at + 8;
        if bytes > length - start {
            return Err(damaged(format!(
                "the variable at byte {at} claims {bytes} bytes and {} are there",
                length - start
            )));
        }
        variables += 1;
        if variables > MAX_VARIABLES {
            return Err(damaged("it has too many variables"));
        }
        if kind == MATRIX || kind == COMPRESSED {
            let place = Place { start, bytes, compressed: kind == COMPRESSED };
            let before = found.channels.len();
            mat.walk(place, Aim::List(&mut found))?;
            mat.places.extend((0..found.channels.len() - before).map(|leaf| (place, leaf)));
        }
        at = start + bytes;
    }
    let Found { mut channels, rates, steps, texts } = found;
    lend_rates(&mut channels, &rates);
    let metadata = Metadata { pairs: texts };
    lend_units(&mut channels, &metadata, keys::UNITS_VARIABLE);
    lend_labels(&mut channels, &metadata.pairs);
    lend_increments(&mut channels, &steps, &metadata.pairs);
    Ok(Listing { channels, metadata, source: Box::new(mat) })
}

impl Mat5 {
    fn walk(&mut self, place: Place, aim: Aim<'_>) -> Result<(), Fault> {
        self.contents.seek(SeekFrom::Start(place.start))?;
        let mut input = if place.compressed {
            Input::inflate(&mut self.contents, place.bytes, self.big_endian)
        } else {
            Input::plain(&mut self.contents, place.bytes, self.big_endian)
        };
        let mut bytes = place.bytes;
        if place.compressed {
            let tag = input.tag()?;
            if tag.kind != MATRIX {
                return Ok(());
            }
            bytes = tag.bytes;
            if bytes > place.bytes.saturating_mul(MOST) {
                return Err(damaged(format!(
                    "a variable claims {bytes} bytes, more than its {} stored bytes can hold",
                    place.bytes
                )));
            }
        }
        Walk { input: &mut input, aim, leaf: 0 }.variable(bytes)
    }
}

impl Source for Mat5 {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        let (place, leaf) = self.places[index];
        self.walk(place, Aim::Read { leaf, sink })
    }
}
