//! What the paper does not state, and start and film, which it states for section 4.1: ranges to draw whole sets from.

use crate::outline::Outline;
use crate::reading::Record;

/// A key that a search draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Range {
    /// The keys that get the value.
    pub keys: &'static [&'static str],
    /// Smallest and largest value, drawn evenly in the logarithm, or the values to choose from.
    pub values: Values,
    /// Why this range.
    pub why: &'static str,
}

/// What a search may choose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Values {
    /// Between two positive numbers, evenly in the logarithm.
    Between(f64, f64),
    /// One of these: for each key a value.
    OneOf(&'static [&'static [&'static str]]),
}

/// What a search varies together; beside these keys it chooses one of [`READ_AS`], one of [`RECORDS`], and whether a
/// filter is before.
pub(crate) const RANGES: &[Range] = &[
    Range {
        keys: &["support.outer_stiffness_n_per_m"],
        values: Values::Between(1e5, 1e8),
        why: "below 3e7 N/m the rollers carry the load (k_o C_r < F at 300 N), above it the support does",
    },
    Range {
        keys: &["support.inner_stiffness_n_per_m"],
        values: Values::Between(1e7, 5e8),
        why: "a shaft of 35 mm on its bearings",
    },
    Range {
        keys: &["support.outer_damping_ns_per_m"],
        values: Values::Between(50.0, 3000.0),
        why: "2 to 30 % of critical at the stiffnesses above, and beyond",
    },
    Range { keys: &["support.inner_damping_ns_per_m"], values: Values::Between(50.0, 5000.0), why: "likewise" },
    Range {
        keys: &["bearing.radial_clearance_um", "bearing.outer_gap_um"],
        values: Values::OneOf(&[&["5.0", "0.0"], &["10.0", "0.0"], &["10.0", "10.0"]]),
        why: "10 um on the diameter, on one side, or at both contacts as Eq. (24)",
    },
    Range {
        keys: &["contact.exponent", "contact.inner_stiffness", "contact.outer_stiffness"],
        values: Values::OneOf(&[
            &["1.1111111111111112", "1.828e8", "1.898e8"],
            &["1.0", "1.828e8", "1.898e8"],
            &["1.1111111111111112", "8.54e8", "8.54e8"],
        ]),
        why: "the three readings of the printed stiffness",
    },
    Range {
        keys: &["lubricant.viscosity_pa_s"],
        values: Values::Between(0.003, 0.1),
        why: "thin oil at temperature to thick oil when cold",
    },
    Range {
        keys: &["bearing.row_stagger_deg"],
        values: Values::OneOf(&[&["0.0"], &["4.7368421"], &["9.473684210526315"]]),
        why: "none, a quarter, half a pitch",
    },
    Range {
        keys: &["contact.roller_path"],
        values: Values::OneOf(&[&["point"], &["envelope"]]),
        why: "the paper's, and the roller's size taken into account",
    },
    Range {
        keys: &["contact.law"],
        values: Values::OneOf(&[&["ecl"], &["sliced"]]),
        why: "the paper's, and ISO/TS 16281's",
    },
    Range {
        keys: &["simulation.start", "operation.load_ramp_s"],
        values: Values::OneOf(&[
            &["rolling", "0.0"],
            &["rolling", "0.002"],
            &["rolling", "0.004"],
            &["rolling", "0.008"],
            &["rolling", "0.02"],
            &["rest", "0.0"],
            &["rest", "0.02"],
            &["equilibrium", "0.0"],
        ]),
        why: "rolling is the paper's in section 4.2 and later, rest in 4.1; no ramp is stated",
    },
    Range {
        keys: &["cage.guidance_film"],
        values: Values::OneOf(&[&["dynamic"], &["quasi-static"]]),
        why: "a film for any motion of the centres, and the paper's Eq. (42)",
    },
    Range {
        keys: &["cage.contact_stiffness_n_per_m"],
        values: Values::Between(1e5, 1e8),
        why: "from a plastic cage's pocket to a steel one's",
    },
    Range {
        keys: &["cage.contact_damping_ns_per_m"],
        values: Values::Between(1.0, 200.0),
        why: "nearly none to ten times the default",
    },
    Range {
        keys: &["friction.slip_velocity_m_per_s"],
        values: Values::Between(0.01, 0.2),
        why: "a regularisation; slip stays small at either end",
    },
];

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
