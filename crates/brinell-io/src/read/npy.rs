//! One NumPy array, read. Layout: NumPy's `numpy.lib.format`, versions 1 to 3.

use std::io::{BufReader, Read, Seek, SeekFrom};

use super::channel::Channel;
use super::contents::Contents;
use super::fault::{Fault, damaged};
use super::listing::{Listing, Source};
use super::numbers::{Number, Sink};
use crate::Metadata;

/// NumPy itself refuses longer headers.
const MAX_HEADER: usize = 64 << 10;

/// What the header of an array says.
pub(super) struct Array {
    pub(super) channel: Channel,
    /// `None` where the values cannot be read; the channel says why.
    pub(super) stored: Option<Number>,
    pub(super) big_endian: bool,
    /// Bytes of the values.
    pub(super) bytes: u64,
}

/// Reads the header; the reader then is at the values.
pub(super) fn header(reader: &mut impl Read, name: &str) -> Result<Array, Fault> {
    let mut start = [0; 8];
    reader.read_exact(&mut start)?;
    if !start.starts_with(b"\x93NUMPY") {
        return Err(damaged(format!("`{name}` is no NumPy array")));
    }
    let length = if start[6] == 1 {
        let mut size = [0; 2];
        reader.read_exact(&mut size)?;
        usize::from(u16::from_le_bytes(size))
    } else {
        let mut size = [0; 4];
        reader.read_exact(&mut size)?;
        u32::from_le_bytes(size) as usize
    };
    if length > MAX_HEADER {
        return Err(damaged(format!("a header of {length} bytes is no header")));
    }
    let mut text = vec![0; length];
    reader.read_exact(&mut text)?;
    let text = String::from_utf8_lossy(&text);
    let after = |key: &str| npy_entry(&text, key).ok_or_else(|| damaged(format!("the header has no '{key}'")));
    let column_major = after("fortran_order")?.starts_with("True");
    let shape = npy_tuple(after("shape")?).ok_or_else(|| damaged("the header's shape is no tuple"))?;
    let shape: Vec<u64> = npy_sides(shape).ok_or_else(|| damaged(format!("`{shape}` is no shape")))?;
    let word = npy_word(after("descr")?);
    let stored = word.and_then(npy_number).map(|(number, _)| number);
    // Of texts too.
    let big_endian = word.is_some_and(|word| word.starts_with('>'));
    let mut channel = Channel::array(name, shape, stored.unwrap_or(Number::U8));
    channel.column_major = column_major;
    if stored.is_none() {
        channel.stored_as = "other";
        let what = word.map_or("records".into(), |w| format!("`{w}`"));
        channel.unreadable = Some(format!("holds {what}, not real numbers"));
    }
    // Saturated products mean more than any file holds.
    let bytes = channel.length.unwrap_or(u64::MAX).saturating_mul(stored.map_or(1, Number::bytes) as u64);
    Ok(Array { channel, stored, big_endian, bytes })
}

/// What follows a key of a header, a Python dictionary of three known keys.
pub fn npy_entry<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    ['\'', '"'].into_iter().find_map(|quote| {
        let (_, rest) = header.split_once(&format!("{quote}{key}{quote}"))?;
        Some(rest.trim_start().strip_prefix(':')?.trim_start())
    })
}

/// What is within the brackets of a shape.
pub fn npy_tuple(shape: &str) -> Option<&str> {
    Some(shape.strip_prefix('(')?.split_once(')')?.0)
}

/// The sizes within them.
pub fn npy_sides(inside: &str) -> Option<Vec<u64>> {
    let sides = inside.split(',').map(str::trim).filter(|side| !side.is_empty());
    sides.map(|side| side.trim_end_matches('L').parse().ok()).collect()
}

/// The word of a type, where it is one and no list of fields.
pub fn npy_word(descr: &str) -> Option<&str> {
    ['\'', '"'].into_iter().find_map(|quote| Some(descr.strip_prefix(quote)?.split_once(quote)?.0))
}

/// How the numbers of a type's word are stored, where they are real ones, and whether their highest byte comes first.
pub fn npy_number(word: &str) -> Option<(Number, bool)> {
    let (order, kind) = word.split_at_checked(1)?;
    if !matches!(order, "<" | ">" | "|" | "=") {
        return None;
    }
    let number = match kind {
        "i1" => Number::I8,
        "u1" | "b1" => Number::U8,
        "i2" => Number::I16,
        "u2" => Number::U16,
        "i4" => Number::I32,
        "u4" => Number::U32,
        "i8" => Number::I64,
        "u8" => Number::U64,
        "f2" => Number::F16,
        "f4" => Number::F32,
        "f8" => Number::F64,
        _ => return None,
    };
    Some((number, order == ">"))
}

struct Npy {
    contents: Contents,
    start: u64,
    array: Array,
}

pub(super) fn list(contents: Contents) -> Result<Listing, Fault> {
    let length = contents.length();
    let mut reader = BufReader::new(contents);
    let array = header(&mut reader, "array")?;
    let start = reader.stream_position()?;
    if array.stored.is_some() && array.bytes > length - start {
        return Err(damaged(format!(
            "the header promises {} bytes of values and {} are there",
            array.bytes,
            length - start
        )));
    }
    Ok(Listing {
        channels: vec![array.channel.clone()],
        metadata: Metadata::default(),
        source: Box::new(Npy { contents: reader.into_inner(), start, array }),
    })
}

impl Source for Npy {
    fn stream(&mut self, _: usize, sink: Sink<'_>) -> Result<(), Fault> {
        self.contents.seek(SeekFrom::Start(self.start))?;
        let count = self.array.channel.length.unwrap_or(0);
        match self.array.stored {
            Some(stored) => stored.stream(self.array.big_endian, &mut self.contents, count, sink),
            None => Ok(()),
        }
    }
}
