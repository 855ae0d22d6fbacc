//! Through the arrays of one variable, structs and cells included.

use std::ops::ControlFlow;

use super::input::{Input, MATRIX, Tag};
use crate::read::channel::{Channel, names_a_rate};
use crate::read::fault::{Fault, damaged};
use crate::read::increments::is_increment;
use crate::read::numbers::{Number, Sink};

const MAX_DEPTH: usize = 24;
const MAX_LEAVES: usize = 200_000;
const MAX_NAMES: u64 = 1 << 20;
const MAX_TEXT: u64 = 256 << 10;
const MAX_TEXTS: usize = 10_000;

/// What a walk is for.
pub(super) enum Aim<'a> {
    /// To see what is there.
    List(&'a mut Found),
    /// To read one array, by its number among the variable's arrays.
    Read { leaf: usize, sink: Sink<'a> },
}

/// What a listing finds.
#[derive(Default)]
pub(super) struct Found {
    pub(super) channels: Vec<Channel>,
    pub(super) texts: Vec<(String, String)>,
    /// Paths and values of single numbers that are called like a sample rate.
    pub(super) rates: Vec<(String, f64)>,
    /// Likewise of those that are the step of abscissae.
    pub(super) steps: Vec<(String, f64)>,
}

pub(super) struct Walk<'w, 'f, 'a> {
    pub(super) input: &'w mut Input<'f>,
    pub(super) aim: Aim<'a>,
    pub(super) leaf: usize,
}

/// The head of an array.
struct Head {
    complex: bool,
    shape: Vec<u64>,
    /// Where the array ends.
    end: u64,
}

impl Walk<'_, '_, '_> {
    /// A whole variable of this many bytes.
    pub(super) fn variable(&mut self, bytes: u64) -> Result<(), Fault> {
        match self.matrix(bytes, None, 0) {
            // What the aim was is there; the rest need not be read.
            Err(Fault::Stopped) => Ok(()),
            other => other,
        }
    }

    fn matrix(&mut self, bytes: u64, path: Option<String>, depth: usize) -> Result<(), Fault> {
        if bytes == 0 {
            return Ok(());
        }
        if depth > MAX_DEPTH {
            return Err(damaged("structs within structs go too deep"));
        }
        let end = self.input.at.saturating_add(bytes);
        let tag = self.input.tag()?;
        let flags = self.input.data(tag, 8, "array flags")?;
        let Some(&flags) = flags.first_chunk::<4>() else {
            return Err(damaged("array flags are missing"));
        };
        let flags = self.input.number(flags);
        let (class, complex) = ((flags & 0xff) as u8, flags & 0x800 != 0);
        if class == 17 {
            // Strings and tables of newer MATLABs: no dimensions follow.
            return self.out_of_reach(path.unwrap_or("unnamed".into()), "is a MATLAB object", end);
        }
        let tag = self.input.tag()?;
        let sizes = self.input.data(tag, 4 * 32, "dimensions")?;
        let sizes = sizes.as_chunks::<4>().0.iter();
        let shape: Vec<u64> = sizes.map(|&b| u64::from(self.input.number(b))).collect();
        let tag = self.input.tag()?;
        let name = self.input.data(tag, MAX_NAMES, "a name")?;
        let name = match path {
            Some(path) => path,
            None if name.is_empty() => "unnamed".into(),
            None => String::from_utf8_lossy(&name).into_owned(),
        };
        let head = Head { complex, shape, end };
        match class {
            6..=15 => self.numbers(name, &head, depth)?,
            4 => self.text(name, &head)?,
            1 => self.cell(&name, &head, depth)?,
            2 => self.structure(&name, &head, depth)?,
            3 => {
                let tag = self.input.tag()?;
                self.input.data(tag, MAX_NAMES, "a class name")?;
                self.structure(&name, &head, depth)?;
            }
            5 => return self.out_of_reach(name, "is a sparse matrix", end),
            _ => return self.out_of_reach(name, "is no array of numbers", end),
        }
        self.to(end)
    }

    /// On to the end of an array.
    fn to(&mut self, end: u64) -> Result<(), Fault> {
        match end.checked_sub(self.input.at) {
            Some(rest) => self.input.skip(rest),
            None => Err(damaged("an array is longer than it says")),
        }
    }

    fn numbers(&mut self, name: String, head: &Head, depth: usize) -> Result<(), Fault> {
        let tag = self.input.tag()?;
        let stored = match tag.kind {
            1 => Number::I8,
            2 => Number::U8,
            3 => Number::I16,
            4 => Number::U16,
            5 => Number::I32,
            6 => Number::U32,
            7 => Number::F32,
            9 => Number::F64,
            12 => Number::I64,
            13 => Number::U64,
            kind => return Err(damaged(format!("`{name}` holds numbers of kind {kind}"))),
        };
        let count = head.shape.iter().copied().fold(1, u64::saturating_mul);
        if count.checked_mul(stored.bytes() as u64) != Some(tag.bytes) {
            return Err(damaged(format!("`{name}` claims {count} values and has {} bytes of them", tag.bytes)));
        }
        // The data with its tag must lie within the array.
        if tag.small.is_none() && tag.bytes > head.end.saturating_sub(self.input.at) {
            return Err(damaged(format!("`{name}` is longer than it says")));
        }
        let this = self.leaf;
        self.leaf += 1;
        match &mut self.aim {
            Aim::List(found) => {
                if found.channels.len() >= MAX_LEAVES {
                    return Err(damaged("it has too many arrays"));
                }
                let mut channel = Channel::array(&name, head.shape.clone(), stored);
                channel.column_major = true;
                if head.complex {
                    channel.unreadable = Some("holds complex numbers".into());
                }
                found.channels.push(channel);
                if count == 1 && (names_a_rate(&name) || is_increment(&name)) {
                    let mut value = 0.0;
                    values(self.input, stored, tag, &mut |v: &[f64]| {
                        value = v[0];
                        ControlFlow::Continue(())
                    })?;
                    let list = if is_increment(&name) { &mut found.steps } else { &mut found.rates };
                    list.push((name, value));
                } else if depth == 0 {
                    // Nothing follows that a listing needs, so a compressed one is not inflated.
                    return Err(Fault::Stopped);
                }
            }
            Aim::Read { leaf, sink } if *leaf == this => {
                values(self.input, stored, tag, *sink)?;
                return Err(Fault::Stopped);
            }
            Aim::Read { .. } => {}
        }
        Ok(())
    }

    /// Text in one row is kept; more rows are none.
    fn text(&mut self, name: String, head: &Head) -> Result<(), Fault> {
        let tag = self.input.tag()?;
        let Aim::List(found) = &mut self.aim else {
            return Ok(());
        };
        let one_row = head.shape.first() == Some(&1) || head.shape.contains(&0);
        if !one_row || tag.bytes > MAX_TEXT || found.texts.len() >= MAX_TEXTS {
            return Ok(());
        }
        let big_endian = self.input.big_endian;
        let bytes = self.input.data(tag, MAX_TEXT, "text")?;
        let text = match tag.kind {
            4 | 17 => {
                let units = bytes
                    .as_chunks::<2>()
                    .0
                    .iter()
                    .map(|&b| if big_endian { u16::from_be_bytes(b) } else { u16::from_le_bytes(b) });
                char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
            }
            18 => return Ok(()),
            _ => String::from_utf8_lossy(&bytes).into_owned(),
        };
        if let Aim::List(found) = &mut self.aim {
            found.texts.push((name, text));
        }
        Ok(())
    }

    fn cell(&mut self, name: &str, head: &Head, depth: usize) -> Result<(), Fault> {
        let count = head.shape.iter().copied().fold(1, u64::saturating_mul);
        for i in 1..=count {
            self.member(format!("{name}[{i}]"), head.end, depth)?;
        }
        Ok(())
    }

    fn structure(&mut self, name: &str, head: &Head, depth: usize) -> Result<(), Fault> {
        let tag = self.input.tag()?;
        let width = self.input.data(tag, 8, "a length of names")?;
        let width = width.first_chunk::<4>().map_or(0, |&b| self.input.number(b));
        let width = (width as usize).clamp(1, 4096);
        let tag = self.input.tag()?;
        let fields = self.input.data(tag, MAX_NAMES, "field names")?;
        let fields: Vec<String> = fields
            .chunks(width)
            .map(|f| {
                let end = f.iter().position(|&b| b == 0).unwrap_or(f.len());
                String::from_utf8_lossy(&f[..end]).into_owned()
            })
            .collect();
        let count = head.shape.iter().copied().fold(1, u64::saturating_mul);
        if fields.is_empty() {
            return Ok(());
        }
        for i in 1..=count {
            let item = if count == 1 { name.to_owned() } else { format!("{name}[{i}]") };
            for field in &fields {
                self.member(format!("{item}.{field}"), head.end, depth)?;
            }
        }
        Ok(())
    }

    /// One array within another.
    fn member(&mut self, path: String, end: u64, depth: usize) -> Result<(), Fault> {
        let tag = self.input.tag()?;
        if tag.kind != MATRIX || tag.bytes > end.saturating_sub(self.input.at) {
            return Err(damaged(format!("`{path}` is not where it should be")));
        }
        self.matrix(tag.bytes, Some(path), depth + 1)
    }

    /// An array that is listed and not read.
    fn out_of_reach(&mut self, name: String, why: &str, end: u64) -> Result<(), Fault> {
        self.leaf += 1;
        if let Aim::List(found) = &mut self.aim {
            if found.channels.len() >= MAX_LEAVES {
                return Err(damaged("it has too many arrays"));
            }
            found.channels.push(Channel {
                name,
                length: Some(0),
                stored_as: "other",
                unreadable: Some(why.into()),
                ..Channel::default()
            });
        }
        self.to(end)
    }
}

fn values(input: &mut Input<'_>, stored: Number, tag: Tag, sink: Sink<'_>) -> Result<(), Fault> {
    let big_endian = input.big_endian;
    let count = tag.bytes / stored.bytes() as u64;
    match tag.small {
        Some(small) => stored.stream(big_endian, &mut &small[..], count, sink),
        None => stored.stream(big_endian, input, count, sink),
    }
}
