//! What the tests of the formats share.

use std::path::Path;

use brinell_io::{Column, IoError, Metadata, SignalWriter};
use proptest::prelude::*;

/// A time and an acceleration.
pub(crate) fn columns() -> Vec<Column> {
    vec![Column::new("t", "s", "time"), Column::new("outer_ax", "m/s^2", "outer ring \"along\" x")]
}

/// What every format can be written with.
pub(crate) fn sampled() -> Metadata {
    Metadata::default().with_rate(25_600.0)
}

/// Any 64 bits, the awkward ones often.
pub(crate) fn any_f64() -> impl Strategy<Value = f64> {
    const AWKWARD: [f64; 12] = [
        0.0,
        -0.0,
        5e-324,
        -2.225_073_858_507_201e-308,
        f64::MIN_POSITIVE,
        f64::MAX,
        f64::MIN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.1,
        1e23,
        9_007_199_254_740_993.0,
    ];
    prop_oneof![(0..AWKWARD.len()).prop_map(|i| AWKWARD[i]), any::<u64>().prop_map(f64::from_bits), -1e4..1e4f64,]
}

/// Rows of one length from 1 to 5.
pub(crate) fn any_table() -> impl Strategy<Value = Vec<Vec<f64>>> {
    (1..6usize).prop_flat_map(|columns| {
        prop::collection::vec(prop::collection::vec(any_f64(), columns), 0..40).prop_map(move |mut rows| {
            rows.push(vec![1.0; columns]);
            rows
        })
    })
}

pub(crate) fn numbered(columns: usize) -> Vec<Column> {
    (0..columns).map(|i| Column::new(format!("channel_{i}"), "m", "")).collect()
}

pub(crate) fn write(writer: &mut dyn SignalWriter, rows: &[Vec<f64>]) -> Result<(), IoError> {
    rows.iter().try_for_each(|row| writer.write_row(row))
}

pub(crate) fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Finite values no larger than a 32-bit float holds.
pub(crate) fn within_floats(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let most = f64::from(f32::MAX);
    let within = |v: &f64| if v.is_finite() { v.clamp(-most, most) } else { *v };
    rows.iter().map(|row| row.iter().map(within).collect()).collect()
}
