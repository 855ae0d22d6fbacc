//! NumPy's archive of arrays, read: a zip file, stored or deflated.
//!
//! A small archive may inflate to a huge one. Values are streamed, so that costs no memory; and an array may not claim
//! more bytes than deflate can make of what is stored.

use std::io::{self, BufReader, Read};

use zip::ZipArchive;
use zip::result::ZipError;

use super::channel::{Channel, lend_rates, lend_units, names_a_rate};
use super::contents::Contents;
use super::fault::{Fault, damaged, unsupported};
use super::kind::OFFICE;
use super::listing::{Listing, Source};
use super::npy::{Array, header};
use super::numbers::{Number, Sink};
use crate::{Metadata, keys};

/// Deflate makes at most 1032 bytes of one.
const MOST: u64 = 1032;
const MAX_ENTRIES: usize = 100_000;
const MAX_TEXT: usize = 1 << 20;

struct Npz {
    archive: ZipArchive<BufReader<Contents>>,
    /// Where each channel is in the archive.
    entries: Vec<usize>,
}

impl From<ZipError> for Fault {
    fn from(error: ZipError) -> Self {
        match error {
            ZipError::Io(error) => error.into(),
            ZipError::UnsupportedArchive(why) => Self::Unsupported(why.to_string()),
            error => Self::Damaged(error.to_string()),
        }
    }
}

pub(super) fn list(contents: Contents) -> Result<Listing, Fault> {
    let mut archive = ZipArchive::new(BufReader::new(contents))?;
    if archive.len() > MAX_ENTRIES {
        return Err(damaged(format!("it claims {} arrays", archive.len())));
    }
    let is_office = |name: &str| name == "[Content_Types].xml" || name == "content.xml";
    for index in 0..archive.len() {
        if is_office(&archive.by_index_raw(index)?.name()?) {
            return Err(unsupported(OFFICE));
        }
    }
    let (mut channels, mut entries, mut rates) = (Vec::<Channel>::new(), Vec::new(), Vec::new());
    let mut metadata = Metadata::default();
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index)?;
        let name = entry.name()?.into_owned();
        let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else {
            continue;
        };
        let most = entry.compressed_size().saturating_mul(MOST);
        let array = header(&mut entry, &name)?;
        if array.bytes > most && array.stored.is_some() {
            return Err(damaged(format!(
                "`{name}` claims {} bytes of values, more than its {} stored bytes can hold",
                array.bytes,
                entry.compressed_size()
            )));
        }
        if let Some(text) = text(&array, &mut entry)? {
            metadata.pairs.push((name, text));
            continue;
        }
        if array.channel.length == Some(1)
            && names_a_rate(&name)
            && let Some(number) = array.stored
        {
            number.stream(array.big_endian, &mut entry, 1, &mut |v| {
                rates.extend(v.iter().map(|&hz| (name.clone(), hz)));
                std::ops::ControlFlow::Continue(())
            })?;
        }
        channels.push(array.channel);
        entries.push(index);
    }
    lend_rates(&mut channels, &rates);
    lend_units(&mut channels, &metadata, keys::UNITS_VARIABLE);
    Ok(Listing { channels, metadata, source: Box::new(Npz { archive, entries }) })
}

/// A single text, NumPy's kinds `U` and `S`.
fn text(array: &Array, reader: &mut impl Read) -> Result<Option<String>, Fault> {
    let single = array.channel.length == Some(1);
    let kind = array.channel.unreadable.as_deref().unwrap_or_default();
    let word = kind.split('`').nth(1).unwrap_or_default();
    let width = |sign| {
        let digits = word.trim_start_matches(['<', '>', '|', '=']).strip_prefix(sign)?;
        digits.parse::<usize>().ok().filter(|&n| n <= MAX_TEXT / 4)
    };
    let bytes = |reader: &mut dyn Read, n: usize| -> Result<Vec<u8>, Fault> {
        let mut bytes = vec![0; n];
        reader.read_exact(&mut bytes)?;
        Ok(bytes)
    };
    let text = if !single {
        return Ok(None);
    } else if let Some(n) = width('U') {
        let to_char = |b: &[u8; 4]| {
            let code = if array.big_endian { u32::from_be_bytes(*b) } else { u32::from_le_bytes(*b) };
            char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)
        };
        bytes(reader, 4 * n)?.as_chunks::<4>().0.iter().map(to_char).collect()
    } else if let Some(n) = width('S') {
        String::from_utf8_lossy(&bytes(reader, n)?).into_owned()
    } else {
        return Ok(None);
    };
    Ok(Some(text.trim_end_matches('\0').to_owned()))
}

impl Source for Npz {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        let mut entry = self.archive.by_index(self.entries[index])?;
        let array = header(&mut entry, "")?;
        let count = array.channel.length.unwrap_or(0);
        // Numbers of their own width again: the header may have been another at the second look.
        let number: Number = array.stored.ok_or_else(|| damaged("no numbers"))?;
        number.stream(array.big_endian, &mut entry, count, sink)?;
        // The checksum is held against what was read at the end.
        match io::copy(&mut entry, &mut io::sink()) {
            Err(e) if e.kind() == io::ErrorKind::InvalidData => {
                Err(damaged("the checksum of an array does not match its bytes"))
            }
            read => Ok(read.map(drop)?),
        }
    }
}
