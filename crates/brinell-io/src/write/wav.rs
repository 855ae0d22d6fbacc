//! WAV, written: 32-bit floats, all channels, in the channels' own units.
//!
//! A sound file has no place for a unit, so nothing is scaled: 1.0 is one unit of the channel, m/s^2 mostly, and a
//! player that takes 1.0 for full scale will clip. The comment (LIST INFO, ICMT) holds a JSON object with name and unit
//! of each channel, the metadata and the outcome. Floats of 32 bits keep seven digits. Past 4 GiB the file becomes an
//! RF64 (EBU Tech 3306).

use serde_json::{Map, Value};

use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::{check_columns, without_time};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter, keys};

const BUFFER_BYTES: usize = 256 << 10;
/// Where the chunk that keeps room for the long sizes begins, and where the data's size is.
const ROOM: u64 = 12;
const FACT: u64 = 12 + 36 + 26;
const DATA: u64 = FACT + 12;
const IEEE_FLOAT: u16 = 3;

/// Writes a table as WAV.
pub(crate) struct WavWriter {
    file: PartialFile,
    columns: Vec<Column>,
    metadata: Metadata,
    /// Where the columns to be written are.
    kept: Vec<usize>,
    buffer: Vec<u8>,
    rows: u64,
}

impl WavWriter {
    /// Starts the file. The metadata must hold [`keys::SAMPLE_RATE_HZ`], a whole number; a column `t` in seconds is not
    /// written.
    pub(crate) fn at(destination: Destination<'_>, columns: &[Column], metadata: &Metadata) -> Result<Self, IoError> {
        let path = destination.path();
        check_columns(path, columns)?;
        let refused = |why: String| IoError::NotWritable { path: path.to_owned(), format: "WAV", why };
        let rate = metadata.needed_sample_rate().map_err(refused)?;
        if rate.fract() != 0.0 || rate > f64::from(u32::MAX / 4) {
            return Err(refused(format!("its sample rate is a whole number of hertz, and not {rate}")));
        }
        let kept = without_time(columns);
        if kept.is_empty() || kept.len() > 16_383 {
            return Err(refused(format!("it takes 1 to 16383 channels, and not {}", kept.len())));
        }
        let (count, rate, frame) = (kept.len() as u16, rate as u32, 4 * kept.len() as u32);
        let mut head = b"RIFF\0\0\0\0WAVEJUNK".to_vec();
        head.extend_from_slice(&28u32.to_le_bytes());
        head.extend_from_slice(&[0; 28]);
        head.extend_from_slice(b"fmt \x12\0\0\0");
        head.extend_from_slice(&IEEE_FLOAT.to_le_bytes());
        head.extend_from_slice(&count.to_le_bytes());
        head.extend_from_slice(&rate.to_le_bytes());
        head.extend_from_slice(&rate.saturating_mul(frame).to_le_bytes());
        head.extend_from_slice(&(frame as u16).to_le_bytes());
        head.extend_from_slice(&32u16.to_le_bytes());
        head.extend_from_slice(&[0; 2]);
        head.extend_from_slice(b"fact\x04\0\0\0\0\0\0\0data\0\0\0\0");
        let mut file = PartialFile::at(destination)?;
        file.append(&head)?;
        Ok(Self {
            file,
            columns: columns.to_vec(),
            metadata: metadata.clone(),
            buffer: Vec::with_capacity(BUFFER_BYTES + 4 * kept.len()),
            kept,
            rows: 0,
        })
    }

    fn comment(&self, outcome: &Outcome) -> String {
        let channels = self.kept.iter().map(|&i| &self.columns[i]);
        let mut object = Map::new();
        object.insert(keys::CHANNELS.into(), channels.map(|c| [c.name.as_str(), c.unit.as_str()]).collect());
        object.insert("brinell.scale".into(), "1.0 is one unit of the channel".into());
        object.insert(keys::OUTCOME.into(), outcome.to_string().into());
        for (key, value) in &self.metadata.pairs {
            object.entry(key).or_insert(value.as_str().into());
        }
        Value::Object(object).to_string()
    }
}

/// A chunk, padded to an even length.
fn chunk(name: &[u8; 4], body: &[u8]) -> Vec<u8> {
    let mut chunk = name.to_vec();
    // A comment of 4 GiB is no comment.
    chunk.extend_from_slice(&(body.len() as u32).to_le_bytes());
    chunk.extend_from_slice(body);
    chunk.resize(chunk.len().next_multiple_of(2), 0);
    chunk
}

impl SignalWriter for WavWriter {
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.file.check_row(self.columns.len(), row)?;
        let beyond = |&&i: &&usize| row[i].is_finite() && (row[i] as f32).is_infinite();
        if let Some(&i) = self.kept.iter().find(beyond) {
            let (name, value, row) = (&self.columns[i].name, row[i], self.rows + 1);
            let why = format!("{name} is {value:e} in row {row}, and 32-bit floats end at {:.1e}", f32::MAX);
            return Err(IoError::NotWritable { path: self.file.path().to_owned(), format: "WAV", why });
        }
        for &i in &self.kept {
            self.buffer.extend_from_slice(&(row[i] as f32).to_le_bytes());
        }
        self.rows += 1;
        if self.buffer.len() >= BUFFER_BYTES {
            self.file.append(&self.buffer)?;
            self.buffer.clear();
        }
        Ok(())
    }

    fn complete(mut self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError> {
        self.file.append(&self.buffer)?;
        let mut text = self.comment(&outcome).into_bytes();
        text.push(0);
        let mut info = b"INFO".to_vec();
        info.extend_from_slice(&chunk(b"ICMT", &text));
        info.extend_from_slice(&chunk(b"ISFT", b"brinell\0"));
        let list = chunk(b"LIST", &info);
        self.file.append(&list)?;
        let data = 4 * self.kept.len() as u64 * self.rows;
        // Of the file, less the 8 bytes before the size; as many are of the data's chunk before the data.
        let total = DATA + data + list.len() as u64;
        match u32::try_from(total) {
            Ok(total) => {
                self.file.patch(4, &total.to_le_bytes())?;
                self.file.patch(FACT + 8, &(self.rows as u32).to_le_bytes())?;
                self.file.patch(DATA + 4, &(data as u32).to_le_bytes())?;
            }
            Err(_) => {
                self.file.patch(0, b"RF64\xff\xff\xff\xff")?;
                let mut long = b"ds64\x1c\0\0\0".to_vec();
                for size in [total, data, self.rows] {
                    long.extend_from_slice(&size.to_le_bytes());
                }
                self.file.patch(ROOM, &long)?;
                self.file.patch(FACT + 8, &[0xff; 4])?;
                self.file.patch(DATA + 4, &[0xff; 4])?;
            }
        }
        self.file.complete()
    }
}
