//! WAV, read: RIFF and RF64, PCM of 8, 16, 24 and 32 bits, floats of 32 and 64 bits, plain or `WAVE_FORMAT_EXTENSIBLE`.
//!
//! Own code, for `hound` has no 64-bit floats, no RF64 and no comments. PCM values are counts, as stored, not scaled to
//! 1: what a count is worth is not in the file. 8-bit PCM is unsigned with its zero at 128, which is taken off. Layout:
//! Microsoft "Multiple Channel Audio Data and WAVE Files"; RF64: EBU Tech 3306.

use std::io::{BufReader, Read, Seek, SeekFrom};

use serde_json::{Map, Value};

use super::channel::{Channel, Rate, RateSource};
use super::contents::Contents;
use super::fault::{Fault, damaged, unsupported};
use super::listing::{Listing, Source};
use super::numbers::{Number, Sink, give};
use crate::{Metadata, keys};

/// Longest comment that is kept.
const MAX_TEXT: u64 = 1 << 20;
/// Frames decoded at a time.
const FRAMES: usize = 4 << 10;
const NO_SIZE: u64 = 0xffff_ffff;
/// What follows the tag in the GUID of an extensible WAV, where it is one of plain WAV's.
const SUBTYPE: [u8; 14] = [0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71];

struct Wav {
    contents: Contents,
    stored: Number,
    channels: usize,
    start: u64,
    frames: u64,
}

struct Layout {
    stored: Number,
    channels: u16,
    rate: u32,
}

pub(super) fn list(contents: Contents) -> Result<Listing, Fault> {
    let length = contents.length();
    let mut reader = BufReader::new(contents);
    let Chunks { layout, start, bytes, streamed, mut metadata } = chunks(&mut reader, length)?;
    let frame = u64::from(layout.channels) * layout.stored.bytes() as u64;
    let frames = bytes / frame;
    // A recorder that was cut off ends anywhere, and some count the byte that makes a chunk even.
    if !matches!((bytes % frame, streamed), (0, _) | (_, true) | (1, _)) {
        return Err(damaged(format!(
            "its {bytes} bytes of samples end within a frame of {frame} bytes: bytes are missing or the header is another file's; \
             write it again with whole frames"
        )));
    }
    let comment = comment(&metadata);
    let brinell = comment.as_ref().map(names_and_units).unwrap_or_default();
    // What brinell's comment says of the table is beside it, as in its other formats.
    let said = comment.iter().flat_map(|c| c.iter());
    let said = said.filter_map(|(key, value)| Some((key.clone(), value.as_str()?.to_owned())));
    metadata.pairs.extend(said);
    let channels = (0..layout.channels)
        .map(|i| {
            let mut channel = Channel::array(format!("channel{}", i + 1), vec![frames], layout.stored);
            if let Some((name, unit)) = brinell.get(usize::from(i)) {
                channel.name.clone_from(name);
                channel.unit = Some(unit.clone()).filter(|u| !u.is_empty());
            }
            channel.rate = (layout.rate > 0)
                .then(|| Rate { hz: f64::from(layout.rate), source: RateSource::Header("WAV sample rate".into()) });
            channel
        })
        .collect();
    Ok(Listing {
        channels,
        metadata,
        source: Box::new(Wav {
            contents: reader.into_inner(),
            stored: layout.stored,
            channels: usize::from(layout.channels),
            start,
            frames,
        }),
    })
}

/// What the chunks of a file say.
struct Chunks {
    layout: Layout,
    /// Of the samples, in bytes.
    start: u64,
    bytes: u64,
    /// Whether the header states no size, as where the file was written to a pipe.
    streamed: bool,
    metadata: Metadata,
}

fn chunks(reader: &mut BufReader<Contents>, length: u64) -> Result<Chunks, Fault> {
    let mut word = [0; 12];
    reader.read_exact(&mut word)?;
    let (mut layout, mut data, mut long_data, mut streamed) = (None, None, None, false);
    let mut metadata = Metadata::default();
    let mut at = 12u64;
    // The last chunk may lack its padding, and some writers stop before its end.
    while at + 8 <= length {
        reader.seek(SeekFrom::Start(at))?;
        let mut head = [0; 8];
        reader.read_exact(&mut head)?;
        let (name, size) = head.split_at(4);
        let mut size = u64::from(u32::from_le_bytes([size[0], size[1], size[2], size[3]]));
        match name {
            b"ds64" => {
                let mut sizes = [0; 16];
                reader.read_exact(&mut sizes)?;
                long_data = sizes.as_chunks::<8>().0.last().map(|b| u64::from_le_bytes(*b));
            }
            b"fmt " if layout.is_some() => return Err(unsupported("it has several `fmt ` chunks; one is expected")),
            b"fmt " => layout = Some(format(reader, size)?),
            b"data" if data.is_some() => return Err(unsupported("it has several `data` chunks; one is expected")),
            b"data" => {
                streamed = size == NO_SIZE && long_data.is_none();
                if size == NO_SIZE {
                    size = long_data.unwrap_or(length - at - 8);
                }
                if size > length - at - 8 {
                    return Err(damaged(format!(
                        "the header promises {size} bytes of samples and {} are there",
                        length - at - 8
                    )));
                }
                data = Some((at + 8, size));
            }
            b"LIST" => info(reader, size.min(length - at - 8), &mut metadata)?,
            _ => {}
        }
        at = at.saturating_add(8 + size + size % 2);
    }
    let layout = layout.ok_or_else(|| damaged("it has no `fmt ` chunk"))?;
    let (start, bytes) = data.ok_or_else(|| damaged("it has no `data` chunk"))?;
    Ok(Chunks { layout, start, bytes, streamed, metadata })
}

fn format(reader: &mut impl Read, size: u64) -> Result<Layout, Fault> {
    let mut bytes = [0; 40];
    let size = usize::try_from(size).map_or(40, |s| s.min(40));
    if size < 16 {
        return Err(damaged("its `fmt ` chunk is too short"));
    }
    reader.read_exact(&mut bytes[..size])?;
    let u16_at = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let (mut tag, channels, bits) = (u16_at(0), u16_at(2), u16_at(14));
    let rate = u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]);
    if tag == 0xfffe {
        if size < 40 || bytes[26..] != SUBTYPE {
            return Err(unsupported("extensible WAV of a kind of its own; PCM and floats are read"));
        }
        tag = u16_at(24);
    }
    let stored = match (tag, bits) {
        (1, 8) => Number::U8,
        (1, 16) => Number::I16,
        (1, 24) => Number::I24,
        (1, 32) => Number::I32,
        (3, 32) => Number::F32,
        (3, 64) => Number::F64,
        _ => {
            return Err(unsupported(format!(
                "WAV of kind {tag} with {bits} bits; PCM of 8, 16, 24, 32 bits and floats of 32, 64 bits are read"
            )));
        }
    };
    if channels == 0 {
        return Err(damaged("it claims no channels"));
    }
    if usize::from(u16_at(12)) != usize::from(channels) * stored.bytes() {
        return Err(damaged(format!("a frame of {channels} channels of {bits} bits cannot have {} bytes", u16_at(12))));
    }
    Ok(Layout { stored, channels, rate })
}

/// The texts of a `LIST` chunk of kind `INFO`.
fn info(reader: &mut impl Read, size: u64, metadata: &mut Metadata) -> Result<(), Fault> {
    let mut bytes = Vec::new();
    reader.take(size.min(MAX_TEXT)).read_to_end(&mut bytes)?;
    let Some(mut rest) = bytes.strip_prefix(b"INFO") else {
        return Ok(());
    };
    while let Some((head, tail)) = rest.split_at_checked(8) {
        let size = u32::from_le_bytes([head[4], head[5], head[6], head[7]]) as usize;
        let Some(text) = tail.get(..size) else {
            break;
        };
        let text = String::from_utf8_lossy(text);
        metadata.pairs.push((String::from_utf8_lossy(&head[..4]).into_owned(), text.trim_end_matches('\0').to_owned()));
        rest = tail.get(size + size % 2..).unwrap_or_default();
    }
    Ok(())
}

/// Brinell's own comment.
fn comment(metadata: &Metadata) -> Option<Map<String, Value>> {
    let comment: Map<String, Value> = serde_json::from_str(metadata.get("ICMT")?).ok()?;
    comment.contains_key(keys::CHANNELS).then_some(comment)
}

/// Name and unit of each channel from that.
fn names_and_units(comment: &Map<String, Value>) -> Vec<(String, String)> {
    let parse = || -> Option<Vec<(String, String)>> {
        let pairs = comment.get(keys::CHANNELS)?.as_array()?.iter();
        let text = |v: &Value, i: usize| Some(v.get(i)?.as_str()?.to_owned());
        pairs.map(|v| Some((text(v, 0)?, text(v, 1)?))).collect()
    };
    parse().unwrap_or_default()
}

impl Source for Wav {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        self.contents.seek(SeekFrom::Start(self.start))?;
        let width = self.stored.bytes();
        let frame = width * self.channels;
        let per_piece = FRAMES.min((1 << 22) / frame).max(1);
        let mut bytes = vec![0; per_piece * frame];
        let (mut one, mut values) = (Vec::new(), Vec::new());
        let mut left = self.frames;
        while left > 0 {
            let now = usize::try_from(left).map_or(per_piece, |l| l.min(per_piece));
            let piece = &mut bytes[..now * frame];
            self.contents.read_exact(piece)?;
            one.clear();
            values.clear();
            for frame in piece.chunks_exact(frame) {
                one.extend_from_slice(&frame[index * width..(index + 1) * width]);
            }
            self.stored.decode(false, &one, &mut values);
            if self.stored == Number::U8 {
                values.iter_mut().for_each(|v| *v -= 128.0);
            }
            give(sink, &values)?;
            left -= now as u64;
        }
        Ok(())
    }
}
