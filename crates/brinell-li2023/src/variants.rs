//! What the paper does not state: one change at a time, in every case.

use crate::outline::Outline;
use crate::reading::Reading;

/// Which unstated assumption a variant changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Aspect {
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
    /// The stretch of the record that a root mean square is taken over.
    Record,
    /// State at t = 0 and load ramp.
    Start,
    /// The film of the cage's guidance.
    Film,
    /// How Eq. (27) is read.
    Outline,
    /// Stiffness and damping of the cage's contacts.
    Cage,
    /// Where friction saturates.
    Slip,
    /// Several at once: what meets the paper's three RMS values.
    Together,
}

impl Aspect {
    /// As tables say it.
    pub(crate) fn words(self) -> &'static str {
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
            Self::Record => "record",
            Self::Start => "start",
            Self::Film => "cage's film",
            Self::Outline => "Eq. (27)",
            Self::Cage => "cage contact",
            Self::Slip => "slip velocity",
            Self::Together => "several at once",
        }
    }
}

/// One assumption made otherwise, in every case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Variant {
    /// How files call it.
    pub id: &'static str,
    /// Which assumption it is about.
    pub aspect: Aspect,
    /// In words.
    pub words: &'static str,
    /// Key and value.
    pub settings: &'static [(&'static str, &'static str)],
    /// How Eq. (27) is read.
    pub outline: Outline,
    /// How RMS and peak to peak are read off the runs.
    pub reading: Reading,
}

impl Variant {
    const fn outlined(self, outline: Outline) -> Self {
        Self { outline, ..self }
    }

    const fn read(self, reading: Reading) -> Self {
        Self { reading, ..self }
    }
}

const fn v(
    id: &'static str,
    aspect: Aspect,
    words: &'static str,
    settings: &'static [(&'static str, &'static str)],
) -> Variant {
    Variant { id, aspect, words, settings, outline: Outline::Joined, reading: Reading::USUAL }
}

const FROM_START: Reading = Reading::USUAL.over_start(285);

const RAMP: &str = "operation.load_ramp_s";
const START: &str = "simulation.start";
const CAGE_K: &str = "cage.contact_stiffness_n_per_m";
const CAGE_C: &str = "cage.contact_damping_ns_per_m";
const SLIP: &str = "friction.slip_velocity_m_per_s";

/// Every variant; the first changes nothing, at the length of the others. Those of filter and record need no run of
/// their own.
pub(crate) const VARIANTS: &[Variant] = &[
    v("baseline", Aspect::Supports, "as in the claims table, shorter runs", &[]),
    v("filter", Aspect::Filter, "outer ring behind the anti-alias filter", &[]).read(Reading::USUAL.behind_filter()),
    v("record-100", Aspect::Record, "from t = 0 over 0.1 s", &[]).read(Reading::USUAL.over_start(100)),
    v("record-200", Aspect::Record, "from t = 0 over 0.2 s", &[]).read(Reading::USUAL.over_start(200)),
    v("record-285", Aspect::Record, "from t = 0 over 0.285 s", &[]).read(FROM_START),
    v("record-500", Aspect::Record, "from t = 0 over 0.5 s", &[]).read(Reading::USUAL.over_start(500)),
    v("record-800", Aspect::Record, "from t = 0 over 0.8 s", &[]).read(Reading::USUAL.over_start(800)),
    v("start-no-ramp", Aspect::Start, "no load ramp (20 ms)", &[(RAMP, "0.0")]),
    v("start-8ms", Aspect::Start, "load ramp 8 ms (20 ms)", &[(RAMP, "0.008")]),
    v("start-rest", Aspect::Start, "from rest (rolling)", &[(START, "rest")]),
    v("start-rest-no-ramp", Aspect::Start, "from rest, no load ramp", &[(START, "rest"), (RAMP, "0.0")]),
    v(
        "start-equilibrium",
        Aspect::Start,
        "in balance under the load (rolling, ramp)",
        &[(START, "equilibrium"), (RAMP, "0.0")],
    ),
    v(
        "together-start-up",
        Aspect::Together,
        "from t = 0 over 0.285 s, n = 1, ramp 8 ms, filter",
        &[("contact.exponent", "1.0"), (RAMP, "0.008")],
    )
    .read(FROM_START.behind_filter()),
    v(
        "together-palmgren",
        Aspect::Together,
        "the same with Palmgren's stiffness, 8.54e8 N/m^(10/9)",
        &[("contact.inner_stiffness", "8.54e8"), ("contact.outer_stiffness", "8.54e8"), (RAMP, "0.008")],
    )
    .read(FROM_START.behind_filter()),
    v("together-no-ramp", Aspect::Together, "from t = 0 over 0.3 s, no load ramp", &[(RAMP, "0.0")])
        .read(Reading::USUAL.over_start(300)),
    v("outer-soft", Aspect::Supports, "outer ring on 1e5 N/m (1e6)", &[("support.outer_stiffness_n_per_m", "1e5")]),
    v("outer-stiff", Aspect::Supports, "outer ring on 1e7 N/m (1e6)", &[("support.outer_stiffness_n_per_m", "1e7")]),
    v(
        "outer-hard",
        Aspect::Supports,
        "outer ring on 1e8 N/m, 100 N s/m: it carries the load",
        &[("support.outer_stiffness_n_per_m", "1e8"), ("support.outer_damping_ns_per_m", "100.0")],
    ),
    v("inner-soft", Aspect::Supports, "inner ring on 1e7 N/m (5e7)", &[("support.inner_stiffness_n_per_m", "1e7")]),
    v("inner-stiff", Aspect::Supports, "inner ring on 2e8 N/m (5e7)", &[("support.inner_stiffness_n_per_m", "2e8")]),
    v(
        "damping-low",
        Aspect::Damping,
        "supports 100 N s/m (500)",
        &[("support.inner_damping_ns_per_m", "100.0"), ("support.outer_damping_ns_per_m", "100.0")],
    ),
    v(
        "damping-high",
        Aspect::Damping,
        "supports 2000 N s/m (500)",
        &[("support.inner_damping_ns_per_m", "2000.0"), ("support.outer_damping_ns_per_m", "2000.0")],
    ),
    v(
        "clearance-half",
        Aspect::Clearance,
        "10 um is the diametral clearance",
        &[("bearing.radial_clearance_um", "5.0")],
    ),
    v("clearance-twice", Aspect::Clearance, "C_r at both contacts, as Eq. (24)", &[("bearing.outer_gap_um", "10.0")]),
    v("stiffness-linear", Aspect::Stiffness, "printed values with n = 1", &[("contact.exponent", "1.0")]),
    v(
        "stiffness-palmgren",
        Aspect::Stiffness,
        "Palmgren's, 8.54e8 N/m^(10/9)",
        &[("contact.inner_stiffness", "8.54e8"), ("contact.outer_stiffness", "8.54e8")],
    ),
    v("viscosity-low", Aspect::Viscosity, "0.003 Pa s (0.01)", &[("lubricant.viscosity_pa_s", "0.003")]),
    v("viscosity-high", Aspect::Viscosity, "0.1 Pa s (0.01)", &[("lubricant.viscosity_pa_s", "0.1")]),
    v("stagger-none", Aspect::Stagger, "rows aligned (half a pitch)", &[("bearing.row_stagger_deg", "0.0")]),
    v("stagger-quarter", Aspect::Stagger, "a quarter of a pitch (half)", &[("bearing.row_stagger_deg", "4.7368421")]),
    v("row-2", Aspect::Row, "row 2 (1)", &[("defects.0.row", "2")]),
    v("path-envelope", Aspect::Path, "envelope (point)", &[("contact.roller_path", "envelope")]),
    v("law-sliced", Aspect::Law, "sliced, 30 slices (ecl)", &[("contact.law", "sliced")]),
    v("law-sliced-300", Aspect::Law, "sliced, 300 slices", &[("contact.law", "sliced"), ("contact.slices", "300")]),
    v("outline-third", Aspect::Outline, Outline::ThirdArc.words(), &[]).outlined(Outline::ThirdArc),
    v("outline-last", Aspect::Outline, Outline::LastArc.words(), &[]).outlined(Outline::LastArc),
    v("outline-angles", Aspect::Outline, Outline::PrintedAngles.words(), &[]).outlined(Outline::PrintedAngles),
    v("outline-factor", Aspect::Outline, Outline::Factor16.words(), &[]).outlined(Outline::Factor16),
    v("outline-inverted", Aspect::Outline, Outline::Inverted.words(), &[]).outlined(Outline::Inverted),
    v("outline-depth", Aspect::Outline, Outline::Depth.words(), &[]).outlined(Outline::Depth),
    v(
        "film-quasi-static",
        Aspect::Film,
        "quasi-static, Eq. (42) as printed (dynamic)",
        &[("cage.guidance_film", "quasi-static")],
    ),
    v("cage-soft", Aspect::Cage, "1e5 N/m (1e7)", &[(CAGE_K, "1e5")]),
    v("cage-stiff", Aspect::Cage, "1e8 N/m (1e7)", &[(CAGE_K, "1e8")]),
    v("cage-undamped", Aspect::Cage, "0 N s/m (20)", &[(CAGE_C, "0.0")]),
    v("cage-damped", Aspect::Cage, "200 N s/m (20)", &[(CAGE_C, "200.0")]),
    v("slip-low", Aspect::Slip, "0.01 m/s (0.05)", &[(SLIP, "0.01")]),
    v("slip-high", Aspect::Slip, "0.2 m/s (0.05)", &[(SLIP, "0.2")]),
];
