//! Numbers as files hold them, made f64.

use std::io::Read;
use std::ops::ControlFlow;

use super::fault::Fault;

/// Takes the values of one channel piece by piece, in the file's order.
pub(crate) type Sink<'a> = &'a mut dyn FnMut(&[f64]) -> ControlFlow<()>;

/// Values decoded at a time.
const PIECE: usize = 8 << 10;

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Number {
    I8,
    U8,
    I16,
    U16,
    /// Three bytes, as in WAV.
    I24,
    I32,
    U32,
    I64,
    U64,
    F16,
    F32,
    F64,
}

impl Number {
    /// Bytes of one number.
    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 | Self::F16 => 2,
            Self::I24 => 3,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// Whether it has no fraction.
    #[cfg(feature = "hdf5")]
    pub(crate) fn is_whole(self) -> bool {
        !matches!(self, Self::F16 | Self::F32 | Self::F64)
    }

    /// NumPy's word for it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::I8 => "int8",
            Self::U8 => "uint8",
            Self::I16 => "int16",
            Self::U16 => "uint16",
            Self::I24 => "int24",
            Self::I32 => "int32",
            Self::U32 => "uint32",
            Self::I64 => "int64",
            Self::U64 => "uint64",
            Self::F16 => "float16",
            Self::F32 => "float32",
            Self::F64 => "float64",
        }
    }

    /// Appends the numbers in `bytes`, a whole number of them, to `out`.
    pub fn decode(self, big_endian: bool, bytes: &[u8], out: &mut Vec<f64>) {
        macro_rules! each {
            ($kind:ty, $to:expr) => {{
                let chunks = bytes.as_chunks::<{ size_of::<$kind>() }>().0.iter();
                if big_endian {
                    out.extend(chunks.map(|b| $to(<$kind>::from_be_bytes(*b))));
                } else {
                    out.extend(chunks.map(|b| $to(<$kind>::from_le_bytes(*b))));
                }
            }};
        }
        match self {
            Self::I8 => each!(i8, f64::from),
            Self::U8 => each!(u8, f64::from),
            Self::I16 => each!(i16, f64::from),
            Self::U16 => each!(u16, f64::from),
            Self::I32 => each!(i32, f64::from),
            Self::U32 => each!(u32, f64::from),
            Self::I64 => each!(i64, |v| v as f64),
            Self::U64 => each!(u64, |v| v as f64),
            Self::F16 => each!(u16, half),
            Self::F32 => each!(f32, f64::from),
            Self::F64 => each!(f64, |v| v),
            Self::I24 => out.extend(bytes.as_chunks::<3>().0.iter().map(|&[a, b, c]| {
                let wide = if big_endian { [0, c, b, a] } else { [0, a, b, c] };
                f64::from(i32::from_le_bytes(wide) >> 8)
            })),
        }
    }

    /// Reads `count` numbers and hands them on; never holds more than a piece of them.
    pub(crate) fn stream(
        self,
        big_endian: bool,
        reader: &mut (impl Read + ?Sized),
        mut count: u64,
        sink: Sink<'_>,
    ) -> Result<(), Fault> {
        let mut bytes = vec![0; PIECE * self.bytes()];
        let mut values = Vec::with_capacity(PIECE);
        while count > 0 {
            let now = usize::try_from(count).map_or(PIECE, |c| c.min(PIECE));
            let piece = &mut bytes[..now * self.bytes()];
            reader.read_exact(piece)?;
            values.clear();
            self.decode(big_endian, piece, &mut values);
            give(sink, &values)?;
            count -= now as u64;
        }
        Ok(())
    }
}

/// Hands values on.
pub(crate) fn give(sink: Sink<'_>, values: &[f64]) -> Result<(), Fault> {
    match sink(values) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Fault::Stopped),
    }
}

/// IEEE 754 binary16.
pub(crate) fn half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let fraction = f64::from(bits & 0x3ff);
    let size = match bits >> 10 & 31 {
        0 => fraction * (-24f64).exp2(),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        e => (1024.0 + fraction) * (f64::from(e) - 25.0).exp2(),
    };
    sign * size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_numbers_of_every_kind() {
        let decode = |kind: Number, big, bytes: &[u8]| {
            let mut out = Vec::new();
            kind.decode(big, bytes, &mut out);
            out
        };
        assert_eq!(decode(Number::I8, false, &[0xff, 1]), [-1.0, 1.0]);
        assert_eq!(decode(Number::I16, true, &[0xff, 0xfe]), [-2.0]);
        assert_eq!(decode(Number::I24, false, &[0xff, 0xff, 0xff, 0, 0, 0x80]), [-1.0, -8_388_608.0]);
        assert_eq!(decode(Number::I24, true, &[0, 1, 0]), [256.0]);
        assert_eq!(decode(Number::U64, false, &[1, 0, 0, 0, 0, 0, 0, 0]), [1.0]);
        let halves = [0x3c00u16, 0xc000, 0x0001, 0x7bff, 0x7c00].map(u16::to_le_bytes);
        assert_eq!(
            decode(Number::F16, false, halves.as_flattened()),
            [1.0, -2.0, (-24f64).exp2(), 65504.0, f64::INFINITY]
        );
    }
}
