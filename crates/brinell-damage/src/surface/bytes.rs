//! Little-endian numbers at a place in a file.

/// Bytes that are there.
pub(super) fn at<const N: usize>(bytes: &[u8], place: usize) -> Option<[u8; N]> {
    bytes.get(place..place.checked_add(N)?)?.try_into().ok()
}

pub(super) fn u16(bytes: &[u8], place: usize) -> Option<u16> {
    at(bytes, place).map(u16::from_le_bytes)
}

pub(super) fn u32(bytes: &[u8], place: usize) -> Option<u32> {
    at(bytes, place).map(u32::from_le_bytes)
}

pub(super) fn i16(bytes: &[u8], place: usize) -> Option<i16> {
    at(bytes, place).map(i16::from_le_bytes)
}

pub(super) fn i32(bytes: &[u8], place: usize) -> Option<i32> {
    at(bytes, place).map(i32::from_le_bytes)
}

pub(super) fn f32(bytes: &[u8], place: usize) -> Option<f32> {
    at(bytes, place).map(f32::from_le_bytes)
}

pub(super) fn f64(bytes: &[u8], place: usize) -> Option<f64> {
    at(bytes, place).map(f64::from_le_bytes)
}

/// The type of the numbers of an array.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Number {
    U8,
    U16,
    U32,
    F32,
    I8,
    I16,
    I32,
    F64,
}

impl Number {
    pub(super) fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::F32 | Self::I32 => 4,
            Self::F64 => 8,
        }
    }

    /// Of as many bytes as it takes; NaN of fewer.
    pub(super) fn value(self, item: &[u8]) -> f64 {
        let value = match self {
            Self::U8 => item.first().map(|&v| f64::from(v)),
            Self::I8 => item.first().map(|&v| f64::from(v as i8)),
            Self::U16 => u16(item, 0).map(f64::from),
            Self::I16 => i16(item, 0).map(f64::from),
            Self::U32 => u32(item, 0).map(f64::from),
            Self::I32 => i32(item, 0).map(f64::from),
            Self::F32 => f32(item, 0).map(f64::from),
            Self::F64 => f64(item, 0),
        };
        value.unwrap_or(f64::NAN)
    }
}
