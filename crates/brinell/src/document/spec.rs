//! What a key is called, means and may hold.

use crate::did_you_mean::did_you_mean;
use crate::signal::rounded;
use std::fmt;

/// Name, meaning, unit and range of one key.
#[derive(Debug, Clone, Copy)]
pub struct Spec {
    pub(crate) name: &'static str,
    pub(crate) doc: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) range: Range,
    pub(crate) plausible: Option<Plausible>,
}

/// Where the value of a key may lie that neither its author nor a source states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Plausible {
    /// So many times the default.
    Times([f64; 2]),
    /// Between two values, and at the default where that is beyond.
    Between([f64; 2]),
}

/// Digits that a reader types.
const TYPED: usize = 6;

impl Plausible {
    /// Both ends about a value, within what the key may hold.
    pub(crate) fn about(self, value: f64, range: &Range) -> [f64; 2] {
        let [low, high] = match self {
            Self::Times(factors) => factors.map(|factor| rounded(factor * value, TYPED)),
            Self::Between([low, high]) => [low.min(value), high.max(value)],
        };
        let inside = |x: f64| if range.contains(x) { x } else { value };
        [inside(low.min(high)), inside(high.max(low))]
    }
}

impl fmt::Display for Plausible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Times([low, high]) => write!(f, "{low} to {high} times the default"),
            Self::Between([low, high]) => write!(f, "{low} to {high}"),
        }
    }
}

/// A key without a range; its unit is the one in its name.
pub const fn key(name: &'static str, doc: &'static str) -> Spec {
    Spec { name, doc, unit: unit_of(name), range: Range::ANY, plausible: None }
}

impl Spec {
    /// What it is called.
    pub const fn name(&self) -> &'static str {
        self.name
    }

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

    /// Where it is assumed, plausible from `low` to `high` times the default.
    pub const fn plausible_times(mut self, low: f64, high: f64) -> Spec {
        self.plausible = Some(Plausible::Times([low, high]));
        self
    }

    /// Where it is assumed, plausible between `low` and `high`.
    pub const fn plausible(mut self, low: f64, high: f64) -> Spec {
        self.plausible = Some(Plausible::Between([low, high]));
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
    unit_suffix(name).1
}

/// A key's name without its unit; `None` where it has none.
pub(super) fn without_unit(name: &str) -> Option<&str> {
    let suffix = unit_suffix(name).0;
    (!suffix.is_empty()).then(|| &name[..name.len() - suffix.len()])
}

/// The suffix of a key's name that is a unit, and the unit.
const fn unit_suffix(name: &str) -> (&'static str, &'static str) {
    const SUFFIXES: [(&str, &str); 27] = [
        ("_nms_per_rad", "N m s/rad"),
        ("_nm_per_rad", "N m/rad"),
        ("_mv_per_m_per_s2", "mV/(m/s^2)"),
        ("_kg_per_m3", "kg/m^3"),
        ("_kg_m2", "kg m^2"),
        ("_g_mm", "g mm"),
        ("_mrad", "mrad"),
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
        ("_us", "us"),
        ("_s", "s"),
        ("_h", "h"),
    ];
    let mut i = 0;
    while i < SUFFIXES.len() {
        if ends_with(name.as_bytes(), SUFFIXES[i].0.as_bytes()) {
            return SUFFIXES[i];
        }
        i += 1;
    }
    ("", "")
}

/// The unit that a key's path carries in its name, an element of a list having its list's; empty where there is none.
pub fn unit_of_key(path: &str) -> &'static str {
    path.rsplit('.').find(|part| is_name(part)).map_or("", unit_of)
}

/// Whether a part of a path is a name, and not a place in a list.
fn is_name(part: &str) -> bool {
    !part.bytes().all(|b| b.is_ascii_digit())
}

/// The key that a misspelt one is near, also where it lacks its unit.
pub(super) fn key_meant<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    // Keys named after rollers are a ball's too.
    let of_rollers = name.replace("ball", "roller");
    if let Some(known) = known.iter().find(|known| name.contains("ball") && **known == of_rollers) {
        return Some(known);
    }
    let bare = |known: &&&str| did_you_mean(name, without_unit(known).into_iter()).is_some();
    did_you_mean(name, known.iter().copied()).or_else(|| known.iter().find(bare).copied())
}

/// What a key's path is of, in words, without tables and unit: "length" of `defects.0.shape.rectangle.length_mm`, "load.1" of `operation.load_n.1`.
pub fn quantity_of_key(path: &str) -> String {
    let parts: Vec<&str> = path.split('.').collect();
    let at = parts.iter().rposition(|part| is_name(part)).unwrap_or(0);
    let name = without_unit(parts[at]).unwrap_or(parts[at]).replace('_', " ");
    [&[name.as_str()], &parts[at + 1..]].concat().join(".")
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
