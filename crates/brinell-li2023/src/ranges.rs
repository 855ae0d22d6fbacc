//! What the paper does not state, and start and film, which it states for section 4.1: ranges to draw whole sets from. They
//! are in `ranges.toml`.

use crate::outline::Outline;
use crate::reading::Record;
use serde::Deserialize;
use std::sync::LazyLock;

/// A key that a search draws.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Range {
    /// The keys that get the value.
    pub keys: Vec<&'static str>,
    /// Smallest and largest value, drawn evenly in the logarithm, or the values to choose from.
    pub values: Values,
    /// Why this range.
    pub why: &'static str,
}

/// What a search may choose.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Values {
    /// Between two positive numbers, evenly in the logarithm.
    Between(f64, f64),
    /// One of these: for each key a value.
    OneOf(#[serde(borrow)] Vec<Vec<&'static str>>),
}

/// What a search varies together; beside these keys it chooses one of [`READ_AS`], one of [`RECORDS`], and whether a
/// filter is before.
pub(crate) static RANGES: LazyLock<Vec<Range>> = LazyLock::new(|| {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, bound(deserialize = "'de: 'static"))]
    struct File {
        range: Vec<Range>,
    }
    let file: File = crate::data("ranges.toml", include_str!("ranges.toml"));
    file.range
});

/// Readings of Eq. (27) that a search chooses from.
pub(crate) const READ_AS: &[Outline] = &[
    Outline::Joined,
    Outline::ThirdArc,
    Outline::LastArc,
    Outline::PrintedAngles,
    Outline::Factor16,
    Outline::Inverted,
    Outline::Depth,
];

/// Stretches of the record that a search chooses from.
pub(crate) const RECORDS: &[Record] =
    &[Record::Steady, Record::FromStart(100), Record::FromStart(200), Record::FromStart(285)];
