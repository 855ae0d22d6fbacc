//! A message's bytes: JSON, then arrays that it refers to.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What a message holds: an answer as it is put together, or a request as it was read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Arrays(Vec<u8>);

/// Offsets of arrays, and the JSON's end, are multiples of this.
const ALIGNMENT: usize = 8;

/// What stands for an array in the JSON.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reference<'a> {
    /// Kind, offset and count.
    #[serde(rename = "$", borrow)]
    place: (&'a str, usize, usize),
}

impl Arrays {
    fn put(&mut self, kind: &'static str, count: usize, bytes: impl Iterator<Item = u8>) -> Reference<'static> {
        let offset = self.0.len();
        self.0.extend(bytes);
        self.0.resize(self.0.len().next_multiple_of(ALIGNMENT), 0);
        Reference { place: (kind, offset, count) }
    }

    /// Appends numbers in single precision; gives what stands for them in the JSON.
    pub fn singles(&mut self, x: impl ExactSizeIterator<Item = f32>) -> Reference<'static> {
        self.put("f32", x.len(), x.flat_map(f32::to_le_bytes))
    }

    /// The same of numbers in double precision, rounded to single.
    pub fn rounded(&mut self, x: &[f64]) -> Reference<'static> {
        self.singles(x.iter().map(|x| *x as f32))
    }

    /// Appends bytes.
    pub fn bytes(&mut self, x: &[u8]) -> Reference<'static> {
        self.put("u8", x.len(), x.iter().copied())
    }

    fn piece(&self, of: &Value, kind: &str, width: usize) -> Option<&[u8]> {
        let Reference { place: (of_kind, offset, count) } = Deserialize::deserialize(of).ok()?;
        let end = offset.checked_add(count.checked_mul(width)?)?;
        self.0.get(offset..end).filter(|_| of_kind == kind)
    }

    /// Numbers in double precision that the JSON refers to.
    pub fn doubles(&self, of: &Value) -> Option<Vec<f64>> {
        let (groups, _) = self.piece(of, "f64", 8)?.as_chunks();
        Some(groups.iter().map(|b| f64::from_le_bytes(*b)).collect())
    }

    /// Bytes that the JSON refers to.
    pub fn octets(&self, of: &Value) -> Option<&[u8]> {
        self.piece(of, "u8", 1)
    }
}

/// One message.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// What it says.
    pub json: Value,
    /// What that refers to.
    pub arrays: Arrays,
}

impl Message {
    /// From its bytes.
    ///
    /// # Errors
    /// In words, where they are no message.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let cut = || "the message is cut off".to_owned();
        let (length, rest) = bytes.split_first_chunk::<4>().ok_or_else(cut)?;
        let length = u32::from_le_bytes(*length) as usize;
        let text = rest.get(..length).ok_or_else(cut)?;
        let json = serde_json::from_slice(text).map_err(|e| format!("not JSON: {e}"))?;
        let start = (4 + length).next_multiple_of(ALIGNMENT);
        let arrays = bytes.get(start..).unwrap_or_default().to_vec();
        Ok(Self { json, arrays: Arrays(arrays) })
    }

    /// As bytes.
    pub fn bytes(&self) -> Vec<u8> {
        let text = self.json.to_string();
        let mut bytes = Vec::with_capacity(text.len() + self.arrays.0.len() + 16);
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(text.as_bytes());
        bytes.resize(bytes.len().next_multiple_of(ALIGNMENT), 0);
        bytes.extend(&self.arrays.0);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn prop_arrays_come_back_and_bad_references_are_none() {
        let mut arrays = Arrays::default();
        let octets = arrays.bytes(&[1, 2, 3]);
        let singles = arrays.rounded(&[0.5, -2.0]);
        let json = json!({ "a": octets, "b": singles });
        assert_eq!(json["b"]["$"], json!(["f32", 8, 2]));
        let message = Message { json, arrays };
        let back = Message::read(&message.bytes()).unwrap();
        assert_eq!(back, message);
        assert_eq!(back.arrays.octets(&back.json["a"]), Some(&[1, 2, 3][..]));
        let wrong = json!([
            { "$": ["u8", 0, 1_000_000] },
            { "$": ["u8", u64::MAX, 2] },
            { "$": ["f64", 0, u64::MAX] },
            { "$": ["u8", -1, 2] },
            { "$": ["u8", 0] },
            { "$": ["u8", 0, 1, 2] },
            7,
        ]);
        for wrong in wrong.as_array().unwrap() {
            assert_eq!(back.arrays.octets(wrong), None, "{wrong}");
            assert_eq!(back.arrays.doubles(wrong), None, "{wrong}");
        }
        let whole = message.bytes();
        for length in 0..whole.len().min(20) {
            assert!(Message::read(&whole[..length]).is_err());
        }
    }
}
