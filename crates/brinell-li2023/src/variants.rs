//! What the paper does not state, and where the baseline departs from what it does (start, film): one change at a time, in
//! every case.

use crate::outline::Outline;
use crate::reading::Reading;

/// One assumption made otherwise, in every case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Variant {
    /// How files call it.
    pub id: &'static str,
    /// Which assumption it is about, as tables say it.
    pub about: &'static str,
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
    /// Whether it changes one assumption: not none, and not more than what it is about.
    pub(crate) fn changes_one(&self) -> bool {
        let none = self.settings.is_empty() && self.outline == Outline::Joined && self.reading == Reading::USUAL;
        !none && self.about != SEVERAL && !MORE.contains(&self.id)
    }

    const fn outlined(self, outline: Outline) -> Self {
        Self { outline, ..self }
    }

    const fn read(self, reading: Reading) -> Self {
        Self { reading, ..self }
    }
}

const fn v(
    id: &'static str,
    about: &'static str,
    words: &'static str,
    settings: &'static [(&'static str, &'static str)],
) -> Variant {
    Variant { id, about, words, settings, outline: Outline::Joined, reading: Reading::USUAL }
}

const FROM_START: Reading = Reading::USUAL.over_start(285);

/// What variants of several assumptions are about.
const SEVERAL: &str = "several at once";

/// Variants that change another assumption with the one that they are about.
const MORE: [&str; 3] = ["start-rest-no-ramp", "outer-hard", "law-conservative"];

/// The film of Eq. (42).
pub(crate) const PRINTED_FILM: (&str, &str) = ("cage.guidance_film", "quasi-static");

/// The lumped model prescribes how rollers turn and has none.
pub(crate) const EDGE: &str = "contact.edge_reaction";

const RAMP: &str = "operation.load_ramp_s";
const START: &str = "simulation.start";
const CAGE_K: &str = "cage.contact_stiffness_n_per_m";
const CAGE_C: &str = "cage.contact_damping_ns_per_m";
const SLIP: &str = "friction.slip_velocity_m_per_s";

/// Every variant; the first changes nothing, at the length of the others. Those of filter and record need no run of
/// their own.
pub(crate) const VARIANTS: &[Variant] = &[
    v("baseline", "supports", "as in the claims table, shorter runs", &[]),
    v("filter", "filter", "outer ring behind the anti-alias filter", &[]).read(Reading::USUAL.behind_filter()),
    v("record-100", "record", "from t = 0 over 0.1 s", &[]).read(Reading::USUAL.over_start(100)),
    v("record-200", "record", "from t = 0 over 0.2 s", &[]).read(Reading::USUAL.over_start(200)),
    v("record-285", "record", "from t = 0 over 0.285 s", &[]).read(FROM_START),
    v("record-500", "record", "from t = 0 over 0.5 s", &[]).read(Reading::USUAL.over_start(500)),
    v("record-800", "record", "from t = 0 over 0.8 s", &[]).read(Reading::USUAL.over_start(800)),
    v("start-no-ramp", "start", "no load ramp (20 ms)", &[(RAMP, "0.0")]),
    v("start-8ms", "start", "load ramp 8 ms (20 ms)", &[(RAMP, "0.008")]),
    v("start-rest", "start", "from rest (rolling)", &[(START, "rest")]),
    v("start-rest-no-ramp", "start", "from rest, no load ramp", &[(START, "rest"), (RAMP, "0.0")]),
    v(
        "start-equilibrium",
        "start",
        "in balance under the load (rolling, ramp)",
        &[(START, "equilibrium"), (RAMP, "0.0")],
    ),
    // Chosen knowing the paper's three RMS values; what it gives is in the tables.
    v(
        "together-start-up",
        SEVERAL,
        "from t = 0 over 0.285 s, n = 1, ramp 8 ms, filter",
        &[("contact.exponent", "1.0"), (RAMP, "0.008")],
    )
    .read(FROM_START.behind_filter()),
    v(
        "together-palmgren",
        SEVERAL,
        "the same with Palmgren's stiffness, 8.54e8 N/m^(10/9)",
        &[("contact.inner_stiffness", "8.54e8"), ("contact.outer_stiffness", "8.54e8"), (RAMP, "0.008")],
    )
    .read(FROM_START.behind_filter()),
    v("together-no-ramp", SEVERAL, "from t = 0 over 0.3 s, no load ramp", &[(RAMP, "0.0")])
        .read(Reading::USUAL.over_start(300)),
    v("outer-soft", "supports", "outer ring on 1e5 N/m (1e6)", &[("support.outer_stiffness_n_per_m", "1e5")]),
    v("outer-stiff", "supports", "outer ring on 1e7 N/m (1e6)", &[("support.outer_stiffness_n_per_m", "1e7")]),
    v(
        "outer-hard",
        "supports",
        "outer ring on 1e8 N/m, 100 N s/m: it carries the load",
        &[("support.outer_stiffness_n_per_m", "1e8"), ("support.outer_damping_ns_per_m", "100.0")],
    ),
    v("inner-soft", "supports", "inner ring on 1e7 N/m (5e7)", &[("support.inner_stiffness_n_per_m", "1e7")]),
    v("inner-stiff", "supports", "inner ring on 2e8 N/m (5e7)", &[("support.inner_stiffness_n_per_m", "2e8")]),
    v(
        "damping-low",
        "damping",
        "supports 100 N s/m (500)",
        &[("support.inner_damping_ns_per_m", "100.0"), ("support.outer_damping_ns_per_m", "100.0")],
    ),
    v(
        "damping-high",
        "damping",
        "supports 2000 N s/m (500)",
        &[("support.inner_damping_ns_per_m", "2000.0"), ("support.outer_damping_ns_per_m", "2000.0")],
    ),
    v("clearance-half", "clearance", "10 um is the diametral clearance", &[("bearing.radial_clearance_um", "5.0")]),
    v("clearance-twice", "clearance", "C_r at both contacts, as Eq. (24)", &[("bearing.outer_gap_um", "10.0")]),
    v("stiffness-linear", "contact stiffness", "printed values with n = 1", &[("contact.exponent", "1.0")]),
    v(
        "stiffness-palmgren",
        "contact stiffness",
        "Palmgren's, 8.54e8 N/m^(10/9)",
        &[("contact.inner_stiffness", "8.54e8"), ("contact.outer_stiffness", "8.54e8")],
    ),
    v("viscosity-low", "viscosity", "0.003 Pa s (0.01)", &[("lubricant.viscosity_pa_s", "0.003")]),
    v("viscosity-high", "viscosity", "0.1 Pa s (0.01)", &[("lubricant.viscosity_pa_s", "0.1")]),
    v("stagger-none", "row stagger", "rows aligned (half a pitch)", &[("bearing.row_stagger_deg", "0.0")]),
    v("stagger-quarter", "row stagger", "a quarter of a pitch (half)", &[("bearing.row_stagger_deg", "4.7368421")]),
    v("row-2", "defect's row", "row 2 (1)", &[("defects.0.row", "2")]),
    v("path-envelope", "roller's path", "envelope (point)", &[("contact.roller_path", "envelope")]),
    v("law-sliced", "contact law", "sliced, 30 slices (ecl)", &[("contact.law", "sliced")]),
    v("law-sliced-300", "contact law", "sliced, 300 slices", &[("contact.law", "sliced"), ("contact.slices", "300")]),
    v(
        "law-conservative",
        "contact law",
        "sliced, 300 slices, envelope, slopes that push back: no parametric work",
        &[
            ("contact.law", "sliced"),
            ("contact.slices", "300"),
            ("contact.roller_path", "envelope"),
            (EDGE, "conservative"),
        ],
    ),
    v("outline-third", "Eq. (27)", Outline::ThirdArc.words(), &[]).outlined(Outline::ThirdArc),
    v("outline-last", "Eq. (27)", Outline::LastArc.words(), &[]).outlined(Outline::LastArc),
    v("outline-angles", "Eq. (27)", Outline::PrintedAngles.words(), &[]).outlined(Outline::PrintedAngles),
    v("outline-factor", "Eq. (27)", Outline::Factor16.words(), &[]).outlined(Outline::Factor16),
    v("outline-inverted", "Eq. (27)", Outline::Inverted.words(), &[]).outlined(Outline::Inverted),
    v("outline-depth", "Eq. (27)", Outline::Depth.words(), &[]).outlined(Outline::Depth),
    v("film-quasi-static", "cage's film", "quasi-static, Eq. (42) as printed (dynamic)", &[PRINTED_FILM]),
    v(
        "paper-4-1",
        SEVERAL,
        "section 4.1 as the paper states it: from rest, with Eq. (42) as printed",
        &[(START, "rest"), PRINTED_FILM],
    ),
    v("cage-soft", "cage contact", "1e5 N/m (1e7)", &[(CAGE_K, "1e5")]),
    v("cage-stiff", "cage contact", "1e8 N/m (1e7)", &[(CAGE_K, "1e8")]),
    v("cage-undamped", "cage contact", "0 N s/m (20)", &[(CAGE_C, "0.0")]),
    v("cage-damped", "cage contact", "200 N s/m (20)", &[(CAGE_C, "200.0")]),
    v("slip-low", "slip velocity", "0.01 m/s (0.05)", &[(SLIP, "0.01")]),
    v("slip-high", "slip velocity", "0.2 m/s (0.05)", &[(SLIP, "0.2")]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_variants_of_none_or_several_changes_are_known() {
        let others = VARIANTS.iter().filter(|variant| !variant.changes_one());
        let wanted = [
            "baseline",
            "start-rest-no-ramp",
            "together-start-up",
            "together-palmgren",
            "together-no-ramp",
            "outer-hard",
            "law-conservative",
            "paper-4-1",
        ];
        assert_eq!(others.map(|variant| variant.id).collect::<Vec<_>>(), wanted);
    }
}
