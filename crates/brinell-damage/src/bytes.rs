//! Little-endian numbers at a place in a file.

/// Bytes that are there.
fn at<const N: usize>(bytes: &[u8], place: usize) -> Option<[u8; N]> {
    bytes.get(place..place.checked_add(N)?)?.try_into().ok()
}

pub(crate) fn u16(bytes: &[u8], place: usize) -> Option<u16> {
    at(bytes, place).map(u16::from_le_bytes)
}

pub(crate) fn u32(bytes: &[u8], place: usize) -> Option<u32> {
    at(bytes, place).map(u32::from_le_bytes)
}

pub(crate) fn i16(bytes: &[u8], place: usize) -> Option<i16> {
    at(bytes, place).map(i16::from_le_bytes)
}

pub(crate) fn i32(bytes: &[u8], place: usize) -> Option<i32> {
    at(bytes, place).map(i32::from_le_bytes)
}

pub(crate) fn f32(bytes: &[u8], place: usize) -> Option<f32> {
    at(bytes, place).map(f32::from_le_bytes)
}

pub(crate) fn f64(bytes: &[u8], place: usize) -> Option<f64> {
    at(bytes, place).map(f64::from_le_bytes)
}

/// The type of the numbers of an array, the lowest byte first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Number {
    kind: Kind,
    /// Bytes of one.
    pub(crate) size: usize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Unsigned,
    Signed,
    Float,
}

impl Number {
    pub(crate) const U8: Self = Self { kind: Kind::Unsigned, size: 1 };
    pub(crate) const U16: Self = Self { kind: Kind::Unsigned, size: 2 };
    pub(crate) const U32: Self = Self { kind: Kind::Unsigned, size: 4 };
    pub(crate) const I8: Self = Self { kind: Kind::Signed, size: 1 };
    pub(crate) const I16: Self = Self { kind: Kind::Signed, size: 2 };
    pub(crate) const I32: Self = Self { kind: Kind::Signed, size: 4 };
    pub(crate) const F32: Self = Self { kind: Kind::Float, size: 4 };
    pub(crate) const F64: Self = Self { kind: Kind::Float, size: 8 };

    /// Of a kind and so many bytes, where there is such a type.
    pub(crate) fn new(kind: Kind, size: usize) -> Option<Self> {
        let sizes: &[usize] = if kind == Kind::Float { &[4, 8] } else { &[1, 2, 4, 8] };
        sizes.contains(&size).then_some(Self { kind, size })
    }

    /// Of as many bytes as it takes; NaN of fewer.
    pub(crate) fn value(self, item: &[u8]) -> f64 {
        let Some(item) = item.get(..self.size) else {
            return f64::NAN;
        };
        let mut bits = [0; 8];
        bits[..self.size].copy_from_slice(item);
        let bits = u64::from_le_bytes(bits);
        let unused = 64 - 8 * self.size as u32;
        match (self.kind, self.size) {
            (Kind::Float, 4) => f64::from(f32::from_bits(bits as u32)),
            (Kind::Float, _) => f64::from_bits(bits),
            // Shifted up and back, the sign comes along.
            (Kind::Signed, _) => ((bits << unused) as i64 >> unused) as f64,
            (Kind::Unsigned, _) => bits as f64,
        }
    }
}
