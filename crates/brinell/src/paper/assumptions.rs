//! What the paper does not state: one change at a time, and ranges to draw whole sets from.

/// Which unstated assumption a variant changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aspect {
    /// Stiffness of the rings' supports.
    Supports,
    /// Damping of the rings' supports.
    Damping,
    /// What C_r is subtracted from.
    Clearance,
    /// What the printed stiffness means.
    Stiffness,
    /// Viscosity of the oil.
    Viscosity,
    /// Angle between the rows.
    Stagger,
    /// The row that the defect is in.
    Row,
    /// Whether a roller's size counts.
    Path,
    /// Force of a damaged contact.
    Law,
    /// Whether accelerations pass an anti-alias filter.
    Filter,
}

impl Aspect {
    /// As tables say it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Supports => "supports",
            Self::Damping => "damping",
            Self::Clearance => "clearance",
            Self::Stiffness => "contact stiffness",
            Self::Viscosity => "viscosity",
            Self::Stagger => "row stagger",
            Self::Row => "defect's row",
            Self::Path => "roller's path",
            Self::Law => "contact law",
            Self::Filter => "filter",
        }
    }
}

/// One assumption made otherwise, in every case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variant {
    /// How files call it.
    pub id: &'static str,
    /// Which assumption it is about.
    pub aspect: Aspect,
    /// In words.
    pub words: &'static str,
    /// Key and value.
    pub settings: &'static [(&'static str, &'static str)],
}

const fn v(
    id: &'static str,
    aspect: Aspect,
    words: &'static str,
    settings: &'static [(&'static str, &'static str)],
) -> Variant {
    Variant {
        id,
        aspect,
        words,
        settings,
    }
}

/// Every variant; the first changes nothing, at the length of the others. That of the filter needs no run of its own and has no settings
/// either.
pub const VARIANTS: &[Variant] = &[
    v(
        "baseline",
        Aspect::Supports,
        "as in the claims table, shorter runs",
        &[],
    ),
    v(
        "filter",
        Aspect::Filter,
        "outer ring behind the anti-alias filter",
        &[],
    ),
    v(
        "outer-soft",
        Aspect::Supports,
        "outer ring on 1e5 N/m (1e6)",
        &[("support.outer_stiffness_n_per_m", "1e5")],
    ),
    v(
        "outer-stiff",
        Aspect::Supports,
        "outer ring on 1e7 N/m (1e6)",
        &[("support.outer_stiffness_n_per_m", "1e7")],
    ),
    v(
        "inner-soft",
        Aspect::Supports,
        "inner ring on 1e7 N/m (5e7)",
        &[("support.inner_stiffness_n_per_m", "1e7")],
    ),
    v(
        "inner-stiff",
        Aspect::Supports,
        "inner ring on 2e8 N/m (5e7)",
        &[("support.inner_stiffness_n_per_m", "2e8")],
    ),
    v(
        "damping-low",
        Aspect::Damping,
        "supports 100 N s/m (500)",
        &[
            ("support.inner_damping_ns_per_m", "100.0"),
            ("support.outer_damping_ns_per_m", "100.0"),
        ],
    ),
    v(
        "damping-high",
        Aspect::Damping,
        "supports 2000 N s/m (500)",
        &[
            ("support.inner_damping_ns_per_m", "2000.0"),
            ("support.outer_damping_ns_per_m", "2000.0"),
        ],
    ),
    v(
        "clearance-half",
        Aspect::Clearance,
        "10 um is the diametral clearance",
        &[("bearing.radial_clearance_um", "5.0")],
    ),
    v(
        "clearance-twice",
        Aspect::Clearance,
        "C_r at both contacts, as Eq. (24)",
        &[("bearing.outer_gap_um", "10.0")],
    ),
    v(
        "stiffness-linear",
        Aspect::Stiffness,
        "printed values with n = 1",
        &[("contact.exponent", "1.0")],
    ),
    v(
        "stiffness-palmgren",
        Aspect::Stiffness,
        "Palmgren's, 8.54e8 N/m^(10/9)",
        &[
            ("contact.inner_stiffness", "8.54e8"),
            ("contact.outer_stiffness", "8.54e8"),
        ],
    ),
    v(
        "viscosity-low",
        Aspect::Viscosity,
        "0.003 Pa s (0.01)",
        &[("lubricant.viscosity_pa_s", "0.003")],
    ),
    v(
        "viscosity-high",
        Aspect::Viscosity,
        "0.1 Pa s (0.01)",
        &[("lubricant.viscosity_pa_s", "0.1")],
    ),
    v(
        "stagger-none",
        Aspect::Stagger,
        "rows aligned (half a pitch)",
        &[("bearing.row_stagger_deg", "0.0")],
    ),
    v(
        "stagger-quarter",
        Aspect::Stagger,
        "a quarter of a pitch (half)",
        &[("bearing.row_stagger_deg", "4.7368421")],
    ),
    v("row-2", Aspect::Row, "row 2 (1)", &[("defects.0.row", "2")]),
    v(
        "path-envelope",
        Aspect::Path,
        "envelope (point)",
        &[("contact.roller_path", "envelope")],
    ),
    v(
        "law-sliced",
        Aspect::Law,
        "sliced (ecl)",
        &[("contact.law", "sliced")],
    ),
];

/// A key that a search draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The keys that get the value.
    pub keys: &'static [&'static str],
    /// Smallest and largest value, drawn evenly in the logarithm, or the values to choose from.
    pub values: Values,
    /// Why this range.
    pub why: &'static str,
}

/// What a search may choose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Values {
    /// Between two positive numbers, evenly in the logarithm.
    Between(f64, f64),
    /// One of these: for each key a value.
    OneOf(&'static [&'static [&'static str]]),
}

/// What a search varies together. The filter is not a key: each draw is looked at with and without it.
pub const RANGES: &[Range] = &[
    Range {
        keys: &["support.outer_stiffness_n_per_m"],
        values: Values::Between(1e5, 2e7),
        why: "soft enough that the rollers carry the load: k_o C_r < F, below 3e7 N/m at 300 N",
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
    Range {
        keys: &["support.inner_damping_ns_per_m"],
        values: Values::Between(50.0, 5000.0),
        why: "likewise",
    },
    Range {
        keys: &["bearing.radial_clearance_um"],
        values: Values::OneOf(&[&["5.0"], &["10.0"]]),
        why: "10 um on one side, or on the diameter",
    },
    Range {
        keys: &[
            "contact.exponent",
            "contact.inner_stiffness",
            "contact.outer_stiffness",
        ],
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
];
