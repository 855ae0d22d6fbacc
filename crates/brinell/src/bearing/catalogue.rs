//! Bearings that work out of the box (stand-in with NN3007 alone).

use std::sync::LazyLock;

/// One bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Designation.
    pub name: String,
    /// What it is.
    pub title: String,
    /// Scenario keys and their values.
    pub values: Vec<Value>,
}

/// One number with its source.
#[derive(Debug, Clone, PartialEq)]
pub struct Value {
    /// Scenario path, `bearing.pitch_diameter_mm`.
    pub key: String,
    /// The value.
    pub value: Datum,
    /// Where it comes from.
    pub source: String,
    /// True where it is estimated.
    pub estimated: bool,
}

/// A value as it would stand in a scenario file.
#[derive(Debug, Clone, PartialEq)]
pub enum Datum {
    /// A float.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// A string.
    Text(String),
}

static ENTRIES: LazyLock<Vec<Entry>> = LazyLock::new(|| {
    let value = |key: &str, value: Datum, estimated: bool| Value {
        key: key.into(),
        value,
        source: "Li et al. 2023".into(),
        estimated,
    };
    let number = |key: &str, x: f64| value(key, Datum::Number(x), false);
    let guess = |key: &str, x: f64| value(key, Datum::Number(x), true);
    vec![Entry {
        name: "NN3007".into(),
        title: "double-row cylindrical roller bearing, 35 x 62 x 20 mm".into(),
        values: vec![
            number("bearing.inner_raceway_diameter_mm", 43.0),
            number("bearing.outer_raceway_diameter_mm", 55.0),
            number("bearing.pitch_diameter_mm", 49.0),
            number("bearing.roller_diameter_mm", 6.0),
            number("bearing.roller_length_mm", 6.0),
            value("bearing.rollers_per_row", Datum::Integer(19), false),
            value("bearing.rows", Datum::Integer(2), false),
            guess("bearing.row_stagger_deg", 9.473684210526315),
            number("bearing.radial_clearance_um", 10.0),
            number("bearing.inner_ring_mass_kg", 0.1010),
            number("bearing.outer_ring_mass_kg", 0.0791),
            number("bearing.roller_mass_kg", 0.0013),
            number("cage.mass_kg", 0.0148),
            number("cage.inner_diameter_mm", 45.0),
            number("cage.outer_diameter_mm", 53.0),
            number("cage.pocket_clearance_mm", 0.09),
            value("cage.guidance", Datum::Text("outer-ring".into()), false),
            number("cage.guide_clearance_mm", 1.0),
            number("cage.guide_width_mm", 6.0),
            guess("cage.contact_stiffness_n_per_m", 1e7),
            guess("cage.contact_damping_ns_per_m", 20.0),
            number("contact.inner_stiffness", 1.828e8),
            number("contact.outer_stiffness", 1.898e8),
            number("contact.damping_ns_per_m", 200.0),
        ],
    }]
});

/// Every bearing.
pub fn all() -> &'static [Entry] {
    &ENTRIES
}

/// The bearing of that name, whatever its case.
pub fn find(name: &str) -> Option<&'static Entry> {
    all()
        .iter()
        .find(|entry| entry.name.eq_ignore_ascii_case(name))
}
