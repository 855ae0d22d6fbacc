//! The vocabulary in which [`super::sections`] lists the keys of a scenario, once.
//!
//! A listing is a walk: it names each key with its meaning, unit, range and default, and hands over the field that
//! holds its value. Whoever implements [`Keys`] decides what the walk does: read the field from TOML, write it, or
//! describe it. Keys are visited in order, so a default may be computed from the fields before it.

use std::fmt;

use super::value_type::ValueType;
use crate::bearing::clearance::ClearanceClass;

/// Name, meaning, unit and range of one key.
#[derive(Debug, Clone, Copy)]
pub struct Spec {
    pub(crate) name: &'static str,
    pub(crate) doc: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) range: Range,
}

/// A key without a range; its unit is the one in its name.
pub const fn key(name: &'static str, doc: &'static str) -> Spec {
    Spec { name, doc, unit: unit_of(name), range: Range::ANY }
}

impl Spec {
    /// Another meaning.
    pub const fn doc(mut self, doc: &'static str) -> Spec {
        self.doc = doc;
        self
    }

    /// A unit that the name does not carry.
    pub const fn unit(mut self, unit: &'static str) -> Spec {
        self.unit = unit;
        self
    }

    /// Greater than `low`.
    pub const fn above(mut self, low: f64) -> Spec {
        self.range.low = Some((low, false));
        self
    }

    /// At least `low`.
    pub const fn from(mut self, low: f64) -> Spec {
        self.range.low = Some((low, true));
        self
    }

    /// At most `high`.
    pub const fn to(mut self, high: f64) -> Spec {
        self.range.high = Some((high, true));
        self
    }
}

/// The unit in a key's name: its longest suffix that is one.
pub(crate) const fn unit_of(name: &str) -> &'static str {
    const SUFFIXES: [(&str, &str); 22] = [
        ("_nms_per_rad", "N m s/rad"),
        ("_nm_per_rad", "N m/rad"),
        ("_mv_per_m_per_s2", "mV/(m/s^2)"),
        ("_kg_per_m3", "kg/m^3"),
        ("_ns_per_m", "N s/m"),
        ("_m_per_s2", "m/s^2"),
        ("_n_per_m", "N/m"),
        ("_m_per_s", "m/s"),
        ("_pa_s", "Pa s"),
        ("_gpa", "GPa"),
        ("_deg", "deg"),
        ("_rpm", "r/min"),
        ("_mm2", "mm^2"),
        ("_mm", "mm"),
        ("_um", "um"),
        ("_kg", "kg"),
        ("_hz", "Hz"),
        ("_mv", "mV"),
        ("_db", "dB"),
        ("_px", "px"),
        ("_n", "N"),
        ("_s", "s"),
    ];
    let mut i = 0;
    while i < SUFFIXES.len() {
        if ends_with(name.as_bytes(), SUFFIXES[i].0.as_bytes()) {
            return SUFFIXES[i].1;
        }
        i += 1;
    }
    ""
}

/// The unit that a key's path carries in its name, an element of a list having its list's; empty where there is none.
pub fn unit_of_key(path: &str) -> &'static str {
    let named = |part: &&str| !part.bytes().all(|b| b.is_ascii_digit());
    path.rsplit('.').find(named).map_or("", unit_of)
}

const fn ends_with(name: &[u8], suffix: &[u8]) -> bool {
    if name.len() < suffix.len() {
        return false;
    }
    let mut i = 0;
    while i < suffix.len() {
        if name[name.len() - suffix.len() + i] != suffix[i] {
            return false;
        }
        i += 1;
    }
    true
}

/// Interval of finite numbers; each bound says whether it belongs to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    pub(crate) low: Option<(f64, bool)>,
    pub(crate) high: Option<(f64, bool)>,
}

impl Range {
    pub(crate) const ANY: Range = Range { low: None, high: None };

    pub(crate) fn contains(&self, x: f64) -> bool {
        x.is_finite()
            && self.low.is_none_or(|(low, closed)| x > low || (closed && x == low))
            && self.high.is_none_or(|(high, closed)| x < high || (closed && x == high))
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = |closed, open: &'static str, shut: &'static str| if closed { shut } else { open };
        let text = |x: f64| {
            if x.abs() >= 1e6 { format!("{x:e}") } else { x.to_string() }
        };
        let low = self.low.map(|(low, closed)| (text(low), closed));
        let high = self.high.map(|(high, closed)| (text(high), closed));
        match (low, high) {
            (None, None) => write!(f, "any finite number"),
            (Some((low, closed)), None) => write!(f, "{} {low}", sign(closed, ">", ">=")),
            (None, Some((high, closed))) => write!(f, "{} {high}", sign(closed, "<", "<=")),
            (Some((low, true)), Some((high, true))) => write!(f, "{low} to {high}"),
            (Some((low, a)), Some((high, b))) => {
                write!(f, "{} {low} and {} {high}", sign(a, ">", ">="), sign(b, "<", "<="))
            }
        }
    }
}

/// What replaces a key that the file leaves out.
#[derive(Debug, Clone)]
pub enum Fallback<T> {
    /// Nothing: the key must be given.
    Required,
    /// Only a catalogue bearing.
    Catalogued,
    /// Nothing in the present case; says which case that is.
    Needed(&'static str),
    /// Computed from earlier keys; always an assumption.
    Derived {
        /// The value.
        value: T,
        /// The formula in words.
        how: &'static str,
    },
    /// Computed from another key that represents this one; it outranks the catalogue bearing.
    Instead {
        /// The value.
        value: T,
        /// From what, in words.
        how: &'static str,
        /// True where that key leaves a range.
        assumed: bool,
    },
    /// A fixed value.
    Fixed {
        /// The value.
        value: T,
        /// Why this one.
        why: &'static str,
        /// True where no source states it.
        assumed: bool,
    },
}

pub(crate) fn derived<T>(value: T, how: &'static str) -> Fallback<T> {
    Fallback::Derived { value, how }
}

/// A default that was not given: it goes on the assumption sheet.
pub(crate) fn assumed<T>(value: T, why: &'static str) -> Fallback<T> {
    Fallback::Fixed { value, why, assumed: true }
}

/// A default that the source of the model states, or that is no statement about the bearing.
pub fn stated<T>(value: T, why: &'static str) -> Fallback<T> {
    Fallback::Fixed { value, why, assumed: false }
}

impl<T> Fallback<T> {
    /// The same with another value, where there is one.
    pub(crate) fn map<U>(self, change: impl FnOnce(T) -> U) -> Fallback<U> {
        match self {
            Self::Required => Fallback::Required,
            Self::Catalogued => Fallback::Catalogued,
            Self::Needed(case) => Fallback::Needed(case),
            Self::Derived { value, how } => Fallback::Derived { value: change(value), how },
            Self::Instead { value, how, assumed } => Fallback::Instead { value: change(value), how, assumed },
            Self::Fixed { value, why, assumed } => Fallback::Fixed { value: change(value), why, assumed },
        }
    }

    /// The value, where there is one.
    pub(crate) fn value(self) -> Option<T> {
        match self {
            Self::Derived { value, .. } | Self::Instead { value, .. } | Self::Fixed { value, .. } => Some(value),
            Self::Required | Self::Catalogued | Self::Needed(_) => None,
        }
    }
}

/// One of the alternatives of [`Keys::one_of`].
pub struct Variant<T> {
    pub(crate) name: &'static str,
    pub(crate) doc: &'static str,
    pub(crate) blank: fn() -> T,
    /// Whether a value is this alternative.
    pub(crate) is: fn(&T) -> bool,
}

/// The alternative that `value` is.
pub(crate) fn variant_of<T>(variants: &'static [Variant<T>], value: &T) -> &'static Variant<T> {
    variants.iter().find(|variant| (variant.is)(value)).unwrap_or(&variants[0])
}

/// A walk over the keys of a scenario.
pub trait Keys: Sized {
    /// A key with one value.
    fn key<T: ValueType>(&mut self, spec: Spec, fallback: Fallback<T>, value: &mut T);

    /// A key that may be absent, which then means something of its own.
    fn optional<T: ValueType>(&mut self, spec: Spec, value: &mut Option<T>);

    /// A key that is required where `wanted`, and has no meaning elsewhere; `case` says where.
    fn only_where<T: ValueType>(&mut self, spec: Spec, wanted: bool, case: &'static str, value: &mut T);

    /// A key with a default where `wanted`, and without a meaning elsewhere; the words say where.
    fn key_where<T: ValueType>(
        &mut self,
        spec: Spec,
        wanted: (bool, &'static str),
        fallback: Fallback<T>,
        value: &mut T,
    );

    /// A key of one case, with a default; elsewhere it has no effect, which is said of a file that gives it. The words
    /// say where it has one.
    fn key_acting_where<T: ValueType>(
        &mut self,
        spec: Spec,
        wanted: (bool, &'static str),
        fallback: Fallback<T>,
        value: &mut T,
    ) {
        self.key_where(spec, wanted, fallback, value);
    }

    /// The value of a key of a later section, before the walk is there: `None` where it is known already or the file
    /// does not give it.
    fn foretold<T: ValueType>(&mut self, _section: &str, _name: &'static str) -> Option<T> {
        None
    }

    /// The key that names the catalogue bearing, whose values replace keys left out after it.
    fn preset(&mut self, spec: Spec, value: &mut Option<String>) {
        self.optional(spec, value);
    }

    /// The class of clearance that the catalogue bearing's name gives.
    fn named_clearance(&self) -> Option<ClearanceClass> {
        None
    }

    /// A table of keys.
    fn section(&mut self, spec: Spec, keys: impl FnMut(&mut Self));

    /// Any number of tables.
    fn tables<T>(&mut self, spec: Spec, items: &mut Vec<T>, blank: fn() -> T, keys: impl FnMut(&mut Self, &mut T));

    /// A table with exactly one of several keys, each a table.
    fn one_of<T: 'static>(
        &mut self,
        spec: Spec,
        variants: &'static [Variant<T>],
        value: &mut T,
        keys: impl FnMut(&mut Self, &mut T),
    );
}
