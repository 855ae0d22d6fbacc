//! HDF5, read: MATLAB v7.3 files and those of h5py and others.
//!
//! The `hdf5-pure` crate reads the structure; the values are read here, chunk by chunk, for that crate takes a vector
//! whole. HDF5 lists a MATLAB array's dimensions last to first; they are turned here, so a shape is what MATLAB shows.

use std::collections::HashSet;
use std::io::{Read, Seek, SeekFrom};
use std::ops::ControlFlow;

use flate2::read::ZlibDecoder;
use hdf5_pure::{DType, Dataset, File as Hdf5, Group, Layout, Object, ReadSeekSource};

use super::attributes::{self, Packing};
use super::channel::{Channel, Rate, lend_labels, lend_rates, names_a_rate};
use super::contents::Contents;
use super::fault::{Fault, damaged, unsupported};
use super::increments::{is_increment, lend_increments};
use super::listing::{Listing, Source};
use super::numbers::{Number, Sink, give};
use super::soft_links::WithoutSoftLinks;
use crate::Metadata;

const MAX_DEPTH: usize = 24;
const MAX_CHANNELS: usize = 200_000;
/// Members of one struct array or cell.
const MAX_MEMBERS: u64 = 100_000;
const MAX_TEXT: u64 = 64 << 10;
/// The longest chunk, and the longest dataset that is stored within a header.
const MAX_CHUNK: u64 = 64 << 20;
/// Deflate makes at most 1032 bytes of one.
const MOST: u64 = 1032;
const DEFLATE: u16 = 1;
const SHUFFLE: u16 = 2;
const FLETCHER: u16 = 3;

/// An array of numbers of the file.
struct Array {
    dataset: Dataset,
    stored: Number,
    big_endian: bool,
    packing: Packing,
}

struct Source5 {
    contents: Contents,
    arrays: Vec<Option<Array>>,
}

struct Walk {
    matlab: bool,
    channels: Vec<Channel>,
    arrays: Vec<Option<Array>>,
    metadata: Metadata,
    /// The most bytes of values that the file may hold.
    most: u64,
    /// Groups and references looked at: a file may lead round in circles.
    visits: usize,
    /// Where values of the groups around lie: a group with the same ones is one of them.
    around: Vec<Option<u64>>,
    /// The sample rates that the groups around state.
    rates: Vec<Option<Rate>>,
}

impl From<hdf5_pure::Error> for Fault {
    fn from(error: hdf5_pure::Error) -> Self {
        damaged(error.to_string())
    }
}

pub(super) fn list(mut contents: Contents) -> Result<Listing, Fault> {
    let mut head = [0; 19];
    contents.read_exact(&mut head)?;
    let source = ReadSeekSource::new(WithoutSoftLinks(contents.clone())).map_err(|e| damaged(e.to_string()))?;
    let tree = Hdf5::from_source(source)?;
    let mut walk = Walk {
        matlab: &head == b"MATLAB 7.3 MAT-file",
        channels: Vec::new(),
        arrays: Vec::new(),
        metadata: Metadata::default(),
        most: contents.length().saturating_mul(MOST),
        visits: 0,
        around: Vec::new(),
        rates: Vec::new(),
    };
    walk.group(&tree.root(), "", 0)?;
    let mut source = Source5 { contents, arrays: walk.arrays };
    let (mut rates, mut steps) = (Vec::new(), Vec::new());
    for (index, channel) in walk.channels.iter().enumerate() {
        let (is_rate, is_step) = (names_a_rate(&channel.name), is_increment(&channel.name));
        if channel.length == Some(1) && (is_rate || is_step) && channel.unreadable.is_none() {
            let list = if is_rate { &mut rates } else { &mut steps };
            source.stream(index, &mut |v: &[f64]| {
                list.extend(v.iter().map(|&hz| (channel.name.clone(), hz)));
                ControlFlow::Continue(())
            })?;
        }
    }
    lend_rates(&mut walk.channels, &rates);
    if walk.matlab {
        lend_labels(&mut walk.channels, &walk.metadata.pairs);
        lend_increments(&mut walk.channels, &steps, &walk.metadata.pairs);
    }
    Ok(Listing { channels: walk.channels, metadata: walk.metadata, source: Box::new(source) })
}

impl Walk {
    fn visit(&mut self, depth: usize) -> Result<(), Fault> {
        self.visits += 1;
        if depth > MAX_DEPTH || self.visits > MAX_CHANNELS || self.channels.len() > MAX_CHANNELS {
            return Err(damaged("it goes too deep, or in circles"));
        }
        Ok(())
    }

    fn group(&mut self, group: &Group, path: &str, depth: usize) -> Result<(), Fault> {
        // No name is that long: a circle of links.
        if depth > MAX_DEPTH {
            return Ok(());
        }
        self.visit(depth)?;
        let within = |name: &str| match (path, self.matlab) {
            ("", _) => name.to_owned(),
            (_, true) => format!("{path}.{name}"),
            (_, false) => format!("{path}/{name}"),
        };
        let datasets: Vec<(String, Dataset)> =
            group.iter_datasets()?.map(|(name, dataset)| (within(&name), dataset)).collect();
        // What MATLAB hides: the targets of references, and objects of its own.
        let groups: Vec<(String, Group)> = group
            .iter_groups()?
            .filter(|(name, _)| !name.starts_with('#'))
            .map(|(name, group)| (within(&name), group))
            .collect();
        let lies_at = |(_, dataset): &(String, Dataset)| match dataset.layout() {
            Ok(Layout::Contiguous { address, .. }) => address,
            _ => None,
        };
        let at = datasets.iter().find_map(lies_at);
        if at.is_some() && self.around.contains(&at) {
            return Ok(());
        }
        self.around.push(at);
        self.rates.push(attributes::rate(&group.attrs().unwrap_or_default()));
        let mut seen = HashSet::new();
        for (name, dataset) in datasets {
            if seen.insert(name.clone()) {
                self.dataset(dataset, name, depth)?;
            }
        }
        for (name, group) in groups {
            if seen.insert(name.clone()) {
                self.group(&group, &name, depth + 1)?;
            }
        }
        self.around.pop();
        self.rates.pop();
        Ok(())
    }

    fn dataset(&mut self, dataset: Dataset, name: String, depth: usize) -> Result<(), Fault> {
        self.visit(depth)?;
        let mut shape = dataset.shape()?;
        if self.matlab {
            shape.reverse();
        }
        let count = shape.iter().copied().fold(1, u64::saturating_mul);
        let bytes = count.saturating_mul(dataset.element_size()?);
        if bytes > self.most {
            return Err(damaged(format!("`{name}` claims {bytes} bytes of values, more than the file can hold")));
        }
        let attributes = dataset.attrs().unwrap_or_default();
        let class = attributes::text(&attributes, "MATLAB_class");
        let empty = attributes.contains_key("MATLAB_empty");
        if class.as_deref() == Some("char") && !empty {
            return self.text(&dataset, name, count);
        }
        let kind = dataset.dtype()?;
        let stored = match kind {
            DType::ObjectReference if !empty => return self.members(&dataset, &name, count, depth),
            DType::String | DType::VariableLengthString => {
                if count <= 1
                    && let Ok(texts) = dataset.read_string()
                {
                    self.metadata.pairs.extend(texts.into_iter().map(|t| (name.clone(), t)));
                    return Ok(());
                }
                None
            }
            ref kind => number(kind),
        };
        let mut channel = Channel::array(name, shape, stored.unwrap_or(Number::U8));
        channel.column_major = self.matlab;
        channel.unit = ["units", "unit", "Units", "Unit"]
            .iter()
            .find_map(|key| attributes::text(&attributes, key))
            .filter(|unit| !unit.is_empty());
        channel.rate = attributes::rate(&attributes).or_else(|| self.rates.iter().rev().find_map(Clone::clone));
        let packing = Packing::of(&attributes, channel.unit.is_some() && stored.is_some_and(Number::is_whole));
        channel.unreadable = packing.as_ref().err().cloned();
        if empty {
            channel.length = Some(0);
            channel.shape = vec![0, 0];
        }
        let stored = stored.filter(|_| !empty);
        if stored.is_none() {
            channel.stored_as = "other";
            channel.unreadable = Some(if empty { "is empty".into() } else { "holds no real numbers".into() });
        }
        let big_endian = is_big_endian(&dataset)?;
        self.channels.push(channel);
        let packing = packing.unwrap_or_default();
        self.arrays.push(stored.map(|stored| Array { dataset, stored, big_endian, packing }));
        Ok(())
    }

    /// MATLAB keeps text as 16-bit units.
    fn text(&mut self, dataset: &Dataset, name: String, count: u64) -> Result<(), Fault> {
        if count <= MAX_TEXT && matches!(dataset.dtype()?, DType::U16) {
            let units = dataset.read_u16()?;
            self.metadata.pairs.push((name, String::from_utf16_lossy(&units)));
        }
        Ok(())
    }

    /// The members of a cell, or of one field of a struct array.
    fn members(&mut self, dataset: &Dataset, name: &str, count: u64, depth: usize) -> Result<(), Fault> {
        if count > MAX_MEMBERS {
            return Err(damaged(format!("`{name}` claims {count} members")));
        }
        // MATLAB's path of a field of a struct array puts the index before the field: Y[2].Data.
        let numbered = |i: usize| match name.rsplit_once('.') {
            Some((item, field)) if count > 1 => format!("{item}[{}].{field}", i + 1),
            _ if count == 1 => name.to_owned(),
            _ => format!("{name}[{}]", i + 1),
        };
        for (i, object) in dataset.dereference()?.into_iter().enumerate() {
            match object {
                Object::Dataset(dataset) => self.dataset(*dataset, numbered(i), depth + 1)?,
                Object::Group(group) => self.group(&group, &numbered(i), depth + 1)?,
                _ => {}
            }
        }
        Ok(())
    }
}

impl Source for Source5 {
    fn stream(&mut self, index: usize, sink: Sink<'_>) -> Result<(), Fault> {
        let Some(array) = &self.arrays[index] else {
            return Ok(());
        };
        let packing = array.packing;
        let (mut unpacked, stored) = (Vec::new(), sink);
        let mut unpack = |values: &[f64]| {
            unpacked.clear();
            unpacked.extend(values.iter().map(|v| packing.value(*v)));
            stored(&unpacked)
        };
        let sink: Sink<'_> = &mut unpack;
        let shape = array.dataset.shape()?;
        let count = shape.iter().copied().fold(1, u64::saturating_mul);
        match array.dataset.layout()? {
            Layout::Contiguous { address: Some(address), .. } => {
                self.contents.seek(SeekFrom::Start(address))?;
                array.stored.stream(array.big_endian, &mut self.contents, count, sink)
            }
            Layout::Contiguous { address: None, .. } if count > 0 => Err(unsupported("the values were never written")),
            Layout::Chunked { chunk_shape, .. } => {
                let chunk = chunk_shape.iter().copied().fold(1, u64::saturating_mul);
                let bytes = chunk.saturating_mul(array.stored.bytes() as u64);
                if bytes > MAX_CHUNK || bytes == 0 || chunk_shape.len() != shape.len() {
                    return Err(damaged(format!("a chunk of {bytes} bytes")));
                }
                let known = [DEFLATE, SHUFFLE, FLETCHER];
                let filters = array.dataset.filters();
                let long = shape.iter().filter(|&&n| n > 1).count();
                if long <= 1 && filters.iter().all(|f| known.contains(f)) {
                    vector(&mut self.contents, array, &shape, &chunk_shape, sink)
                } else {
                    // The crate takes memory for a stored chunk before it looks for its end.
                    let length = self.contents.length();
                    for chunk in array.dataset.chunks()? {
                        if chunk.storage_size > length.saturating_sub(chunk.address) {
                            return Err(damaged("a chunk reaches past the end of the file"));
                        }
                    }
                    rows(array, &shape, chunk_shape.first().copied().unwrap_or(1), sink)
                }
            }
            Layout::Virtual => Err(unsupported("a virtual dataset, whose values are elsewhere")),
            _ => rows(array, &shape, 1, sink),
        }
    }
}

/// Streams an array along its first dimension.
fn rows(array: &Array, shape: &[u64], chunk: u64, sink: Sink<'_>) -> Result<(), Fault> {
    let rows = shape.first().copied().unwrap_or(1);
    let inner = shape.iter().skip(1).copied().fold(1, u64::saturating_mul);
    let row_bytes = inner.saturating_mul(array.stored.bytes() as u64).max(1);
    let step = (MAX_CHUNK / 8 / row_bytes).max(chunk).max(1);
    if row_bytes.saturating_mul(step.min(rows)) > 4 * MAX_CHUNK {
        return Err(unsupported(format!("rows of {row_bytes} bytes are too long to be read one by one")));
    }
    let mut at = 0;
    while at < rows {
        let bytes = array.dataset.read_raw_rows(at, step.min(rows - at))?;
        let count = (bytes.len() / array.stored.bytes()) as u64;
        if count == 0 {
            return Err(damaged("rows are missing"));
        }
        array.stored.stream(array.big_endian, &mut &bytes[..], count, sink)?;
        at += step;
    }
    Ok(())
}

/// Streams the chunks of an array with one long dimension.
fn vector(
    contents: &mut Contents,
    array: &Array,
    shape: &[u64],
    chunk_shape: &[u64],
    sink: Sink<'_>,
) -> Result<(), Fault> {
    let width = array.stored.bytes();
    let axis = shape.iter().position(|&n| n != 1).unwrap_or(0);
    let length = shape.get(axis).copied().unwrap_or(1);
    let along = chunk_shape.get(axis).copied().unwrap_or(1).max(1);
    // Within a chunk, neighbours along the axis are this many values apart.
    let step = chunk_shape.iter().skip(axis + 1).product::<u64>().max(1) as usize;
    let chunk_bytes = chunk_shape.iter().product::<u64>() as usize * width;
    let filters = array.dataset.filters();
    let mut chunks = array.dataset.chunks()?;
    chunks.sort_by_key(|c| c.offset.get(axis).copied());
    let (mut stored, mut raw, mut one, mut values) = (vec![], vec![], vec![], vec![]);
    let mut at = 0;
    for chunk in &chunks {
        if at >= length {
            break;
        }
        if chunk.offset.get(axis).copied().unwrap_or(0) != at {
            return Err(unsupported(format!("values from {at} on were never written")));
        }
        if chunk.storage_size > 2 * MAX_CHUNK {
            return Err(damaged("a chunk is too long"));
        }
        contents.seek(SeekFrom::Start(chunk.address))?;
        stored.clear();
        contents.take(chunk.storage_size).read_to_end(&mut stored)?;
        for (bit, filter) in filters.iter().enumerate().rev() {
            if chunk.filter_mask >> bit & 1 == 1 {
                continue;
            }
            match *filter {
                DEFLATE => {
                    raw.clear();
                    ZlibDecoder::new(&stored[..]).take(chunk_bytes as u64 + 4).read_to_end(&mut raw)?;
                    std::mem::swap(&mut raw, &mut stored);
                }
                SHUFFLE => {
                    unshuffle(&stored, width, &mut raw);
                    std::mem::swap(&mut raw, &mut stored);
                }
                _ => {
                    let sum = stored.split_off(stored.len().saturating_sub(4));
                    if sum != fletcher32(&stored).to_le_bytes() {
                        return Err(damaged(format!("a chunk's checksum does not match, at its value {at}")));
                    }
                }
            }
        }
        if stored.len() < chunk_bytes {
            return Err(damaged("a chunk ends early"));
        }
        let count = along.min(length - at) as usize;
        one.clear();
        if step == 1 {
            one.extend_from_slice(&stored[..count * width]);
        } else {
            for value in stored.chunks_exact(width).step_by(step).take(count) {
                one.extend_from_slice(value);
            }
        }
        values.clear();
        array.stored.decode(array.big_endian, &one, &mut values);
        give(sink, &values)?;
        at += along;
    }
    if at < length {
        return Err(unsupported(format!("values from {at} on were never written")));
    }
    Ok(())
}

/// The checksum of HDF5's filter of that name, over 16-bit words, the high byte first (`H5_checksum_fletcher32`).
fn fletcher32(bytes: &[u8]) -> u32 {
    let fold = |sum: u32| (sum & 0xffff) + (sum >> 16);
    let (mut low, mut high) = (0, 0);
    // As many words as a sum of 32 bits holds.
    for block in bytes.chunks(720) {
        for word in block.chunks(2) {
            low += u32::from(word[0]) << 8 | word.get(1).map_or(0, |b| u32::from(*b));
            high += low;
        }
        (low, high) = (fold(low), fold(high));
    }
    fold(high) << 16 | fold(low)
}

/// HDF5's shuffle filter put all first bytes first.
fn unshuffle(bytes: &[u8], width: usize, out: &mut Vec<u8>) {
    let count = bytes.len() / width;
    out.clear();
    out.resize(bytes.len(), 0);
    for (k, plane) in bytes[..count * width].chunks_exact(count.max(1)).enumerate() {
        for (i, &byte) in plane.iter().enumerate() {
            out[i * width + k] = byte;
        }
    }
    out[count * width..].copy_from_slice(&bytes[count * width..]);
}

/// How a type's numbers are stored, where they are real numbers.
fn number(kind: &DType) -> Option<Number> {
    Some(match kind {
        DType::I8 => Number::I8,
        DType::U8 => Number::U8,
        DType::I16 => Number::I16,
        DType::U16 => Number::U16,
        DType::I32 => Number::I32,
        DType::U32 => Number::U32,
        DType::I64 => Number::I64,
        DType::U64 => Number::U64,
        DType::F32 => Number::F32,
        DType::F64 => Number::F64,
        DType::Other(other) if is_half(other) => Number::F16,
        _ => return None,
    })
}

/// Whether a type is the half-precision float of IEEE 754, which the crate has no name for.
fn is_half(kind: &hdf5_pure::Datatype) -> bool {
    matches!(kind, hdf5_pure::Datatype::FloatingPoint { size: 2, layout, .. } if layout.exponent_size == 5)
}

fn is_big_endian(dataset: &Dataset) -> Result<bool, Fault> {
    use hdf5_pure::{Datatype as T, DatatypeByteOrder as Order};
    Ok(match dataset.datatype()? {
        T::FixedPoint { byte_order, .. } | T::FloatingPoint { byte_order, .. } => byte_order == Order::BigEndian,
        _ => false,
    })
}
