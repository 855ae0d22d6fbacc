//! What attributes of HDF5 say of the numbers beside them.

use std::collections::HashMap;

use hdf5_pure::AttrValue;

use super::channel::{Rate, RateSource, names_a_rate};

/// Attributes by name.
pub(super) type Attributes = HashMap<String, AttrValue>;

/// The text of one.
pub(super) fn text(attributes: &Attributes, key: &str) -> Option<String> {
    match attributes.get(key)? {
        AttrValue::String(text) | AttrValue::AsciiString(text) | AttrValue::VarLenString(text) => {
            Some(text.trim_end_matches('\0').to_owned())
        }
        _ => None,
    }
}

/// The numbers of one.
fn numbers(value: &AttrValue) -> Option<Vec<f64>> {
    use AttrValue as V;
    macro_rules! all {
        ($values:expr) => {
            $values.iter().map(|v| *v as f64).collect()
        };
    }
    Some(match value {
        V::F64(v) => vec![*v],
        V::F32(v) => vec![f64::from(*v)],
        V::I8(v) => vec![f64::from(*v)],
        V::I16(v) => vec![f64::from(*v)],
        V::I32(v) => vec![f64::from(*v)],
        V::I64(v) => vec![*v as f64],
        V::U8(v) => vec![f64::from(*v)],
        V::U16(v) => vec![f64::from(*v)],
        V::U32(v) => vec![f64::from(*v)],
        V::U64(v) => vec![*v as f64],
        V::F64Array(v) => v.clone(),
        V::F32Array(v) => all!(v),
        V::I8Array(v) => all!(v),
        V::I16Array(v) => all!(v),
        V::I32Array(v) => all!(v),
        V::I64Array(v) => all!(v),
        V::U8Array(v) => all!(v),
        V::U16Array(v) => all!(v),
        V::U32Array(v) => all!(v),
        V::U64Array(v) => all!(v),
        _ => return None,
    })
}

/// The sample rate that exactly one of them states, Hz.
pub(super) fn rate(attributes: &Attributes) -> Option<Rate> {
    let mut rates = attributes.iter().filter(|(key, _)| names_a_rate(key)).filter_map(|(key, value)| {
        let hz = single(&numbers(value)?)?;
        (hz.is_finite() && hz > 0.0).then(|| Rate { hz, source: RateSource::Header(key.clone()) })
    });
    rates.next().filter(|first| rates.all(|other| other.hz == first.hz))
}

fn single(values: &[f64]) -> Option<f64> {
    match values {
        [only] => Some(*only),
        _ => None,
    }
}

/// How physical values are packed into the numbers stored: CF Metadata Conventions, section 8.1, "Packed Data".
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Packing {
    scale: f64,
    offset: f64,
    /// Stored where a value is missing.
    missing: [f64; 2],
}

impl Default for Packing {
    fn default() -> Self {
        Self { scale: 1.0, offset: 0.0, missing: [f64::NAN; 2] }
    }
}

/// Names of factors that no convention brinell follows gives a meaning.
const FACTORS: [&str; 12] = [
    "scale",
    "scaling",
    "gain",
    "slope",
    "factor",
    "scaling_factor",
    "multiplier",
    "conversion",
    "conversion_factor",
    "calibration",
    "calibration_factor",
    "sensitivity",
];

impl Packing {
    /// What the attributes say. `are_counts`: the numbers are whole and have a unit, which a factor may belong to.
    ///
    /// # Errors
    /// Where they say what is not followed: in words that go on after the channel's name.
    pub(super) fn of(attributes: &Attributes, are_counts: bool) -> Result<Self, String> {
        let number = |key: &str, none: f64| match attributes.get(key) {
            None => Ok(none),
            Some(value) => {
                match numbers(value).as_deref().and_then(single).filter(|v| v.is_finite() || none.is_nan()) {
                    Some(number) => Ok(number),
                    None => Err(format!("has an attribute `{key}` that is no single number")),
                }
            }
        };
        let packing = Self {
            scale: number("scale_factor", 1.0)?,
            offset: number("add_offset", 0.0)?,
            missing: [number("_FillValue", f64::NAN)?, number("missing_value", f64::NAN)?],
        };
        let other = attributes.iter().find_map(|(key, value)| {
            let is_factor = FACTORS.contains(&key.to_ascii_lowercase().as_str());
            numbers(value).filter(|v| is_factor && v[..] != [1.0]).map(|_| key)
        });
        match other {
            Some(key) if are_counts && !attributes.contains_key("scale_factor") => Err(format!(
                "holds whole numbers with an attribute `{key}`, and whether its unit is theirs or that of the numbers times `{key}` is not \
                 known; store values in the unit, or call the factor `scale_factor`, as netCDF does"
            )),
            _ => Ok(packing),
        }
    }

    /// The value of a number stored.
    pub(super) fn value(self, stored: f64) -> f64 {
        match (self.scale, self.offset) {
            _ if self.missing.contains(&stored) => f64::NAN,
            // Of -0 too.
            (1.0, 0.0) => stored,
            (scale, offset) => scale * stored + offset,
        }
    }
}
