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
