//! The bytes of one variable, plain or inflated as they are requested.

use std::io::{self, BufReader, Read, Take};

use flate2::bufread::ZlibDecoder;

use crate::read::contents::Contents;
use crate::read::fault::{Fault, damaged};

/// Reads one variable from front to back.
pub(super) struct Input<'a> {
    body: Body<'a>,
    pub(super) big_endian: bool,
    /// Bytes read or skipped.
    pub(super) at: u64,
    /// Bytes that a plain variable has.
    end: u64,
}

enum Body<'a> {
    Plain(BufReader<&'a mut Contents>),
    Inflate(Box<ZlibDecoder<BufReader<Take<&'a mut Contents>>>>),
}

/// Kind of an element that is an array.
pub(super) const MATRIX: u32 = 14;
/// Kind of an element that holds another one, deflated.
pub(super) const COMPRESSED: u32 = 15;

/// The head of a data element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tag {
    pub(super) kind: u32,
    pub(super) bytes: u64,
    /// Up to four bytes of data may be within the tag.
    pub(super) small: Option<[u8; 4]>,
}

impl<'a> Input<'a> {
    pub(super) fn plain(contents: &'a mut Contents, bytes: u64, big_endian: bool) -> Self {
        Self { body: Body::Plain(BufReader::with_capacity(32 << 10, contents)), big_endian, at: 0, end: bytes }
    }

    pub(super) fn inflate(contents: &'a mut Contents, bytes: u64, big_endian: bool) -> Self {
        let stored = BufReader::with_capacity(32 << 10, contents.take(bytes));
        Self { body: Body::Inflate(Box::new(ZlibDecoder::new(stored))), big_endian, at: 0, end: u64::MAX }
    }

    pub(super) fn number(&self, bytes: [u8; 4]) -> u32 {
        if self.big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) }
    }

    pub(super) fn tag(&mut self) -> Result<Tag, Fault> {
        let mut bytes = [0; 8];
        self.read_exact(&mut bytes)?;
        let (head, tail) = bytes.as_chunks::<4>().0.split_at(1);
        let (kind, tail) = (self.number(head[0]), tail[0]);
        if kind >> 16 != 0 {
            let count = kind >> 16;
            if count > 4 {
                return Err(damaged("a small element of more than four bytes"));
            }
            return Ok(Tag { kind: kind & 0xffff, bytes: u64::from(count), small: Some(tail) });
        }
        Ok(Tag { kind, bytes: u64::from(self.number(tail)), small: None })
    }

    /// The data of a short element, its padding taken too.
    pub(super) fn data(&mut self, tag: Tag, most: u64, what: &str) -> Result<Vec<u8>, Fault> {
        if tag.bytes > most {
            return Err(damaged(format!("{what} of {} bytes", tag.bytes)));
        }
        let count = tag.bytes as usize;
        if let Some(small) = tag.small {
            return Ok(small[..count].to_vec());
        }
        let mut data = vec![0; count];
        self.read_exact(&mut data)?;
        self.skip(padding(tag.bytes))?;
        Ok(data)
    }

    pub(super) fn skip(&mut self, bytes: u64) -> Result<(), Fault> {
        if bytes > self.end - self.at {
            return Err(damaged("an array reaches past the end of its variable"));
        }
        match &mut self.body {
            Body::Plain(reader) => {
                reader.seek_relative(bytes as i64)?;
            }
            Body::Inflate(reader) => {
                if io::copy(&mut reader.take(bytes), &mut io::sink())? < bytes {
                    return Err(damaged("a compressed variable ends early"));
                }
            }
        }
        self.at += bytes;
        Ok(())
    }
}

/// Elements begin at multiples of eight bytes.
pub(super) fn padding(bytes: u64) -> u64 {
    bytes.next_multiple_of(8) - bytes
}

impl Read for Input<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let most = usize::try_from(self.end - self.at).unwrap_or(usize::MAX);
        let most = most.min(buffer.len());
        let buffer = &mut buffer[..most];
        let count = match &mut self.body {
            Body::Plain(reader) => reader.read(buffer)?,
            Body::Inflate(reader) => reader.read(buffer)?,
        };
        self.at += count as u64;
        Ok(count)
    }
}
