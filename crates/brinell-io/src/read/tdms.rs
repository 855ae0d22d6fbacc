//! LabVIEW TDMS, read: channels of raw numbers, whole or interleaved, with their waveform properties and linear
//! scaling.
//!
//! Layout: National Instruments, "TDMS File Format Internal Structure". Of the raw data of DAQmx and of other scalings
//! a channel says that it is not read.

use std::collections::HashMap;
use std::io::{Read, Seek, SeekFrom};

use super::channel::{Channel, Rate, RateSource, hertz};
use super::contents::Contents;
use super::fault::{Fault, damaged, unsupported};
use super::listing::{Listing, Source};
use super::numbers::{Number, Sink};
use super::times::seconds_in;
use crate::Metadata;

const LEAD: u64 = 28;
/// Objects, properties and segments that a file may have.
const MOST: u32 = 1_000_000;
const MAX_TEXT: u32 = 1 << 20;
/// Bytes of a segment's metadata that are held.
const MAX_HEAD: u64 = 256 << 20;
const MOST_SCALES: u32 = 100;
/// Bytes of interleaved rows read at a time.
const BLOCK: usize = 1 << 20;
const HAS_META: u32 = 1 << 1;
const NEW_LIST: u32 = 1 << 2;
const HAS_RAW: u32 = 1 << 3;
const INTERLEAVED: u32 = 1 << 5;
const BIG_ENDIAN: u32 = 1 << 6;
const HAS_DAQMX: u32 = 1 << 7;
/// Where nothing of a channel's values follows, and where all is as before.
const NO_RAW: u32 = 0xffff_ffff;
const AS_BEFORE: u32 = 0;
const DAQMX: u32 = 0x1269;
const DAQMX_DIGITAL: u32 = 0x1369;
const DAQMX_WHY: &str = "holds raw data of DAQmx, which are not read; save it as CSV or MAT";

#[derive(Clone, Debug)]
enum Property {
    Number(f64),
    Text(String),
}

/// What a segment has of an object: how values are stored, how many, and their bytes.
#[derive(Clone, Copy, Debug)]
struct Index {
    stored: Option<Number>,
    count: u64,
    bytes: u64,
}

#[derive(Debug, Default)]
struct Object {
    properties: HashMap<String, Property>,
    /// As the last segment has it that says so.
    index: Option<Index>,
    stored: Option<Number>,
    count: u64,
    /// Where its values lie.
    parts: Vec<Part>,
    unreadable: Option<String>,
}

/// Values of one channel one after the other, with as many bytes between the beginnings of two.
#[derive(Clone, Copy, Debug)]
struct Part {
    start: u64,
    count: u64,
    stride: u64,
    big_endian: bool,
}

/// Values are stored times the slope plus the intercept.
struct Stored {
    stored: Number,
    parts: Vec<Part>,
    slope: f64,
    intercept: f64,
}

struct Tdms {
    contents: Contents,
    channels: Vec<Option<Stored>>,
}

pub(super) fn list(mut contents: Contents) -> Result<Listing, Fault> {
    let length = contents.length();
    let mut walk = Walk { objects: HashMap::new(), order: Vec::new(), active: Vec::new() };
    let (mut at, mut segments) = (0, 0);
    while at + LEAD <= length {
        segments += 1;
        if segments > MOST {
            return Err(damaged("it has too many segments"));
        }
        at = walk.segment(&mut contents, at, length)?;
    }
    let (mut channels, mut sources) = (Vec::new(), Vec::new());
    let mut metadata = Metadata::default();
    for path in &walk.order {
        let Some(object) = walk.objects.get(path) else { continue };
        let names = names(path);
        for (key, property) in &object.properties {
            if let (Property::Text(text), true) = (property, names.len() < 2) {
                let path: Vec<&str> = names.iter().chain([key]).map(String::as_str).collect();
                metadata.pairs.push((path.join("/"), text.clone()));
            }
        }
        if names.len() == 2 {
            let (channel, source) = object.channel(names.join("/"));
            channels.push(channel);
            sources.push(source);
        }
    }
    metadata.pairs.sort();
    Ok(Listing { channels, metadata, source: Box::new(Tdms { contents, channels: sources }) })
}

/// Group and channel of `/'group'/'channel'`, in which a quote is doubled.
fn names(path: &str) -> Vec<String> {
    let (mut names, mut chars) = (Vec::new(), path.chars().peekable());
    while let Some(sign) = chars.next() {
        if sign != '\'' {
            continue;
        }
        let mut name = String::new();
        while let Some(sign) = chars.next() {
            if sign == '\'' && chars.next_if_eq(&'\'').is_none() {
                break;
            }
            name.push(sign);
        }
        names.push(name);
    }
    names
}

/// How a type's numbers are stored, and its bytes; none of either where it holds no numbers.
fn number(kind: u32) -> (Option<Number>, u64) {
    let number = match kind {
        1 => Number::I8,
        2 => Number::I16,
        3 => Number::I32,
        4 => Number::I64,
        5 | 0x21 => Number::U8,
        6 => Number::U16,
        7 => Number::U32,
        8 => Number::U64,
        9 | 0x19 => Number::F32,
        10 | 0x1a => Number::F64,
        0x44 | 0x0010_000d => return (None, 16),
        0x0008_000c => return (None, 8),
        _ => return (None, 0),
    };
    (Some(number), number.bytes() as u64)
}

/// The metadata of a segment.
struct Head<'a> {
    bytes: &'a [u8],
    big_endian: bool,
}

impl Head<'_> {
    fn take(&mut self, count: usize) -> Result<&[u8], Fault> {
        let (taken, rest) = self.bytes.split_at_checked(count).ok_or_else(|| damaged("its metadata ends early"))?;
        self.bytes = rest;
        Ok(taken)
    }

    fn u32(&mut self) -> Result<u32, Fault> {
        let big_endian = self.big_endian;
        let bytes = *self.take(4)?.first_chunk().unwrap_or(&[0; 4]);
        Ok(if big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    }

    fn u64(&mut self) -> Result<u64, Fault> {
        let big_endian = self.big_endian;
        let bytes = *self.take(8)?.first_chunk().unwrap_or(&[0; 8]);
        Ok(if big_endian { u64::from_be_bytes(bytes) } else { u64::from_le_bytes(bytes) })
    }

    fn text(&mut self) -> Result<String, Fault> {
        let length = self.u32()?;
        if length > MAX_TEXT {
            return Err(damaged(format!("a text of {length} bytes")));
        }
        Ok(String::from_utf8_lossy(self.take(length as usize)?).into_owned())
    }

    fn property(&mut self) -> Result<Option<Property>, Fault> {
        let kind = self.u32()?;
        if kind == 0x20 {
            return Ok(Some(Property::Text(self.text()?)));
        }
        let (number, bytes) = number(kind);
        if bytes == 0 {
            return Err(unsupported(format!("a property of type {kind:#x}")));
        }
        let big_endian = self.big_endian;
        let bytes = self.take(bytes as usize)?;
        let mut value = Vec::new();
        if let Some(number) = number {
            number.decode(big_endian, bytes, &mut value);
        }
        Ok(value.first().map(|v| Property::Number(*v)))
    }
}

struct Walk {
    objects: HashMap<String, Object>,
    order: Vec<String>,
    /// Those with values in the segment, in the order of these.
    active: Vec<String>,
}

impl Walk {
    /// One segment, and where the next begins.
    fn segment(&mut self, contents: &mut Contents, at: u64, length: u64) -> Result<u64, Fault> {
        contents.seek(SeekFrom::Start(at))?;
        let mut lead = [0; LEAD as usize];
        contents.read_exact(&mut lead)?;
        if &lead[..4] != b"TDSm" {
            return Err(damaged(format!("no segment begins at byte {at}")));
        }
        let contents_of = u32::from_le_bytes([lead[4], lead[5], lead[6], lead[7]]);
        let big_endian = contents_of & BIG_ENDIAN != 0;
        let mut offsets = Head { bytes: &lead[12..], big_endian };
        let (next, raw) = (offsets.u64()?, offsets.u64()?);
        // A writer that was stopped leaves the last segment open: it reaches to the end.
        let end = if next == u64::MAX { length } else { (at + LEAD).saturating_add(next) };
        let values = (at + LEAD).saturating_add(raw);
        if values > end || end > length {
            return Err(damaged(format!("the segment at byte {at} reaches to byte {end}, and the file has {length}")));
        }
        if contents_of & NEW_LIST != 0 {
            self.active.clear();
        }
        if contents_of & HAS_META != 0 {
            if raw > MAX_HEAD {
                return Err(damaged(format!("metadata of {raw} bytes at byte {at}")));
            }
            let mut bytes = vec![0; raw as usize];
            contents.read_exact(&mut bytes)?;
            self.objects(&mut Head { bytes: &bytes, big_endian }, contents_of & HAS_DAQMX != 0)?;
        }
        if contents_of & HAS_RAW != 0 && end > values {
            self.values(values, end, contents_of & INTERLEAVED != 0, big_endian)?;
        }
        Ok(end)
    }

    fn objects(&mut self, head: &mut Head<'_>, has_daqmx: bool) -> Result<(), Fault> {
        for _ in 0..head.u32()? {
            let path = head.text()?;
            if !self.objects.contains_key(&path) {
                if self.order.len() >= MOST as usize {
                    return Err(damaged("it has too many objects"));
                }
                self.order.push(path.clone());
            }
            let object = self.objects.entry(path.clone()).or_default();
            let kind = head.u32()?;
            match kind {
                NO_RAW => {}
                AS_BEFORE if object.index.is_none() => {
                    return Err(damaged(format!("`{path}` is as before, and nothing is before")));
                }
                AS_BEFORE => {}
                DAQMX | DAQMX_DIGITAL => {
                    daqmx(head, if kind == DAQMX { 20 } else { 17 })?;
                    object.unreadable = Some(DAQMX_WHY.into());
                    object.index = Some(Index { stored: None, count: 0, bytes: 0 });
                }
                _ => object.index = Some(index(head, kind)?),
            }
            if kind != NO_RAW && !self.active.contains(&path) {
                self.active.push(path);
            }
            for _ in 0..head.u32()? {
                let name = head.text()?;
                if let Some(property) = head.property()? {
                    object.properties.insert(name, property);
                }
            }
        }
        if has_daqmx {
            for path in &self.active {
                self.objects.entry(path.clone()).or_default().unreadable.get_or_insert(DAQMX_WHY.into());
            }
        }
        Ok(())
    }

    /// The values of a segment from `at` to `end`: the channels' one after the other, again and again.
    fn values(&mut self, at: u64, end: u64, interleaved: bool, big_endian: bool) -> Result<(), Fault> {
        let indices: Vec<(String, Index)> =
            (self.active.iter()).filter_map(|path| Some((path.clone(), self.objects.get(path)?.index?))).collect();
        let chunk: u64 = indices.iter().map(|(_, index)| index.bytes).fold(0, u64::saturating_add);
        if chunk == 0 {
            return Ok(());
        }
        let row: u64 = indices.iter().filter_map(|(_, i)| Some(i.stored?.bytes() as u64)).sum();
        let mut from = at;
        while from < end {
            // The last may be cut.
            let (mut place, room) = (from, chunk.min(end - from));
            for (path, index) in &indices {
                let (Some(object), Some(stored)) = (self.objects.get_mut(path), index.stored) else {
                    place += index.bytes;
                    continue;
                };
                let width = stored.bytes() as u64;
                let (stride, most) = if interleaved {
                    (row, (room / row).min(index.count))
                } else {
                    // Of one value a time all lie a chunk apart.
                    (
                        if index.count == 1 { chunk } else { width },
                        ((from + room).saturating_sub(place) / width).min(index.count),
                    )
                };
                object.keep(stored, Part { start: place, count: most, stride, big_endian });
                place += if interleaved { width } else { index.bytes };
            }
            from += chunk;
        }
        Ok(())
    }
}

/// The raw-data index of an object.
fn index(head: &mut Head<'_>, length: u32) -> Result<Index, Fault> {
    let (kind, dimension, count) = (head.u32()?, head.u32()?, head.u64()?);
    if dimension != 1 {
        return Err(damaged(format!("values of {dimension} dimensions")));
    }
    let (stored, width) = number(kind);
    // Texts say how long they are.
    let bytes = if length >= 28 { head.u64()? } else { count.saturating_mul(width) };
    Ok(Index { stored, count, bytes })
}

/// Passes over the index of DAQmx, of so many bytes a scaler.
fn daqmx(head: &mut Head<'_>, scaler: usize) -> Result<(), Fault> {
    head.take(4 + 4 + 8)?;
    for size in [scaler, 4] {
        let count = head.u32()?.min(MOST) as usize;
        head.take(count * size)?;
    }
    Ok(())
}

impl Object {
    fn keep(&mut self, stored: Number, part: Part) {
        if self.stored.is_some_and(|before| before != stored) {
            self.unreadable = Some("changes how its values are stored".into());
        }
        self.stored = Some(stored);
        self.count += part.count;
        if let Some(last) = self.parts.last_mut() {
            let follows = last.stride == part.stride && last.start + last.count * last.stride == part.start;
            if follows && last.big_endian == part.big_endian {
                last.count += part.count;
                return;
            }
        }
        self.parts.push(part);
    }

    fn text(&self, key: &str) -> Option<String> {
        match self.properties.get(key)? {
            Property::Text(text) => Some(text.trim().to_owned()).filter(|text| !text.is_empty()),
            Property::Number(_) => None,
        }
    }

    fn number(&self, key: &str) -> Option<f64> {
        match self.properties.get(key)? {
            Property::Number(number) => Some(*number),
            Property::Text(_) => None,
        }
    }

    fn channel(&self, name: String) -> (Channel, Option<Stored>) {
        let mut channel = Channel::array(name, vec![self.count], self.stored.unwrap_or(Number::U8));
        channel.unit = self.text("unit_string").or_else(|| self.text("NI_UnitDescription"));
        let step = self.number("wf_increment").filter(|step| *step > 0.0 && step.is_finite());
        let is_time = self.text("wf_xunit_string").is_none_or(|unit| seconds_in(&unit) == Some(1.0));
        channel.rate = step
            .filter(|_| is_time)
            .map(|step| Rate { hz: hertz(step), source: RateSource::Header("wf_increment".into()) });
        let scaling = self.scaling();
        channel.unreadable = (self.unreadable.clone()).or_else(|| scaling.as_ref().err().cloned());
        let Some(stored) = self.stored else {
            if channel.unreadable.is_none() && self.index.is_some_and(|index| index.count > 0) {
                channel.unreadable = Some("holds no real numbers".into());
            }
            return (channel, None);
        };
        let source =
            scaling.ok().map(|(slope, intercept)| Stored { stored, parts: self.parts.clone(), slope, intercept });
        (channel, source)
    }

    /// Slope and intercept of the scalings that follow each other, each of the one before or of the raw values.
    fn scaling(&self) -> Result<(f64, f64), String> {
        let listed = (0..MOST_SCALES).take_while(|k| self.text(&format!("NI_Scale[{k}]_Scale_Type")).is_some()).count();
        let count = self.number("NI_Number_Of_Scales").unwrap_or(0.0).clamp(0.0, f64::from(MOST_SCALES));
        let is_scaled = self.text("NI_Scaling_Status").is_some_and(|status| status == "scaled");
        let (mut slope, mut intercept) = (1.0, 0.0);
        if is_scaled {
            return Ok((slope, intercept));
        }
        for k in 0..(count as u32).max(listed as u32) {
            let key = |what: &str| format!("NI_Scale[{k}]_{what}");
            let kind = self.text(&key("Scale_Type")).unwrap_or_else(|| "unknown".into());
            let number = |what: &str| self.number(&key(what));
            let input = number(&format!("{kind}_Input_Source"));
            let first = k == 0 && input.is_none_or(|from| from == f64::from(NO_RAW) || from == 0.0);
            let (a, b) = match (kind.as_str(), number("Linear_Slope"), number("Linear_Y_Intercept")) {
                ("Linear", Some(a), Some(b)) if first || input == k.checked_sub(1).map(f64::from) => (a, b),
                _ => {
                    return Err(format!(
                        "is scaled by `{kind}`, of which only `Linear` is read; save it as CSV or MAT"
                    ));
                }
            };
            (slope, intercept) = (a * slope, a * intercept + b);
        }
        Ok((slope, intercept))
    }
}

impl Source for Tdms {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        let Some(Stored { stored, parts, slope, intercept }) = &self.channels[index] else {
            return Ok(());
        };
        let mut scaled = Vec::new();
        let mut scale = |values: &[f64]| {
            scaled.clear();
            // As it is, where nothing scales it: -0 too.
            let is_scaled = (*slope, *intercept) != (1.0, 0.0);
            scaled.extend(values.iter().map(|v| if is_scaled { slope * v + intercept } else { *v }));
            sink(&scaled)
        };
        for part in parts {
            self.contents.seek(SeekFrom::Start(part.start))?;
            let width = stored.bytes() as u64;
            if part.stride == width {
                stored.stream(part.big_endian, &mut self.contents, part.count, &mut scale)?;
                continue;
            }
            let rows = (BLOCK as u64 / part.stride).max(1);
            let (mut done, mut bytes, mut own) = (0, Vec::new(), Vec::new());
            while done < part.count {
                let now = rows.min(part.count - done);
                // Of the last row only the value itself has to be there.
                bytes.resize(((now - 1) * part.stride + width) as usize, 0);
                self.contents.seek(SeekFrom::Start(part.start + done * part.stride))?;
                self.contents.read_exact(&mut bytes)?;
                own.clear();
                bytes.chunks(part.stride as usize).for_each(|row| own.extend_from_slice(&row[..width as usize]));
                stored.stream(part.big_endian, &mut &own[..], now, &mut scale)?;
                done += now;
            }
        }
        Ok(())
    }
}
