//! A table as bytes, to be kept: its nodes and what stands there, little-endian, with a checksum.

use super::table::Table;
use crate::random::mix;

const MAGIC: u64 = 0x6272_696e_7462_6c31;

fn checksum(words: &[u64]) -> u64 {
    words.iter().fold(MAGIC, |sum, word| mix(sum ^ word))
}

impl Table {
    /// All of it.
    pub fn to_bytes(&self) -> Vec<u8> {
        let (s, delta) = (self.s_nodes(), self.delta_nodes());
        let mut words = vec![MAGIC, s.len() as u64, delta.len() as u64];
        words.extend(s.iter().chain(delta).map(|x| x.to_bits()));
        words.extend(self.values().iter().flatten().map(|x| x.to_bits()));
        words.push(checksum(&words));
        words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    /// Read back; `None` of what is no table, or not whole.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (words, rest) = bytes.as_chunks::<8>();
        let words: Vec<u64> = words.iter().map(|word| u64::from_le_bytes(*word)).collect();
        let (sum, words) = words.split_last()?;
        if !rest.is_empty() || *sum != checksum(words) {
            return None;
        }
        let [MAGIC, s, delta, numbers @ ..] = words else {
            return None;
        };
        let numbers: Vec<f64> = numbers.iter().map(|word| f64::from_bits(*word)).collect();
        let (s, rest) = numbers.split_at_checked(usize::try_from(*s).ok()?)?;
        let (delta, values) = rest.split_at_checked(usize::try_from(*delta).ok()?)?;
        let (values, rest) = values.as_chunks();
        rest.is_empty().then(|| Self::from_values([s, delta], values.to_vec()))?
    }
}
