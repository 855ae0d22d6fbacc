//! The scenarios behind the paper's figures. They are in `cases.toml`.

use crate::outline::Outline;
use brinell::scenario::Laws;
use serde::Deserialize;
use std::sync::LazyLock;

/// The scenario that every case changes (TOML).
pub const BASE: &str = include_str!("nn3007.toml");

/// The set of laws, which [`BASE`] names.
const LAWS: &str = "simulation.laws";

/// Keys that the lumped model has not: it knows the paper's laws, of them the law `ecl` alone, and no exact geometry.
const NOT_LUMPED: [&str; 3] = ["contact.law", "simulation.geometry", LAWS];

/// Keys of cases that the laws of mechanics have not: n = 1 is a reading of the printed stiffness, and a half-space is a
/// line contact's.
const NOT_MECHANICS: [&str; 1] = ["contact.exponent"];

/// What the paper states, or the baseline assumes for it, and the laws of mechanics have another default for: the outer
/// ring alone on its support, both supports' damping, and the cage with its film on the outer ring.
const KEPT: [(&str, &str); 5] = [
    ("housing.mass_kg", "0.0"),
    ("support.inner_damping_ns_per_m", "500.0"),
    ("support.outer_damping_ns_per_m", "500.0"),
    ("cage.guidance", "outer-ring"),
    ("cage.guide_clearance_mm", "1.0"),
];

/// One scenario: [`BASE`] with settings over it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// How claims and files call it.
    pub id: &'static str,
    /// How legends call it.
    pub label: &'static str,
    /// Speed of the inner ring, r/min.
    pub rpm: f64,
    /// Key and value over [`BASE`].
    #[serde(default)]
    pub settings: Vec<(&'static str, &'static str)>,
    /// Greatest width of its irregular defect, mm; `None` where its defect is another.
    pub irregular_width_mm: Option<f64>,
}

impl Case {
    /// Whether it is of the reference model.
    pub(crate) fn is_lumped(&self) -> bool {
        self.settings.contains(&("simulation.model", "lumped"))
    }

    /// Everything that it sets over [`BASE`], `more` below its own, its irregular defect in a reading of Eq. (27). What
    /// its model has not is left out.
    pub fn over(&self, more: &[(String, String)], outline: Outline) -> Vec<(String, String)> {
        let mut settings = [more, &owned(&self.settings)].concat();
        if self.is_lumped() {
            settings.retain(|(key, _)| !NOT_LUMPED.contains(&key.as_str()));
        } else if more.contains(&(LAWS.to_owned(), Laws::Mechanics.word().to_owned())) {
            settings.retain(|(key, _)| !NOT_MECHANICS.contains(&key.as_str()));
        }
        if let Some(shape) = self.irregular_width_mm.and_then(|mm| outline.shape(mm)) {
            settings.retain(|(key, _)| key != SHAPE);
            settings.push((SHAPE.to_owned(), shape));
        }
        settings
    }
}

/// How long a case runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// So many turns of the inner ring whose statistics count, and [`Length::SHORTEST_S`] at least.
    Turns(u32),
    /// So long, s.
    Seconds(f64),
}

impl Length {
    /// For the whole reproduction.
    pub const FULL: Self = Self::Turns(240);
    /// With wider intervals.
    pub const QUICK: Self = Self::Turns(40);
    /// For variants of assumptions, each of which needs every case.
    pub const VARIANT: Self = Self::Turns(24);
    /// The same, quick.
    pub const QUICK_VARIANT: Self = Self::Turns(12);
    /// Starts of a case in runs as long as [`Length::FULL`]: one start's interval knows of no motion slower than its
    /// run. Shorter runs have one.
    pub(crate) const STARTS: u32 = 8;
    /// Holds a record of 0.3 s from t = 0.
    pub const SHORTEST_S: f64 = 0.301;
    /// For cases about the start, and for sets of a search.
    pub const START: Self = Self::Seconds(Self::SHORTEST_S);

    /// Simulated time at a speed, s. Statistics begin a turn after the load ramp, 0.02 s.
    pub fn duration_s(self, rpm: f64) -> f64 {
        let turns = match self {
            Self::Turns(turns) => turns,
            Self::Seconds(seconds) => return seconds,
        };
        let turn = 60.0 / rpm;
        // A hair more, so that the last turn is whole in spite of round-off and sampling.
        let exact = 0.02 + (f64::from(turns) + 1.05) * turn;
        ((1e3 * exact).ceil() / 1e3).max(Self::SHORTEST_S)
    }

    /// Starts of a case.
    pub(crate) fn starts(self) -> u32 {
        match (self, Self::FULL) {
            (Self::Turns(turns), Self::Turns(full)) if turns >= full => Self::STARTS,
            _ => 1,
        }
    }

    /// "240 turns of the shaft".
    pub fn words(self) -> String {
        match self {
            Self::Turns(turns) => format!("{turns} turns of the shaft"),
            Self::Seconds(seconds) => format!("{seconds} s"),
        }
    }
}

/// Settings as the reader of scenarios takes them.
pub(crate) fn owned(settings: &[(&str, &str)]) -> Vec<(String, String)> {
    let own = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
    settings.iter().map(own).collect()
}

/// What a set of laws sets over [`BASE`], whose set is the paper's: the laws, all else as there.
pub(crate) fn under(laws: Laws) -> Vec<(String, String)> {
    match laws {
        Laws::Li2023 => vec![],
        Laws::Mechanics => [defaults(laws), owned(&KEPT)].concat(),
    }
}

/// The same with the set's own default values.
pub(crate) fn defaults(laws: Laws) -> Vec<(String, String)> {
    owned(&[(LAWS, laws.word())])
}

/// Load ramp of [`BASE`], ms: the default of the key, which it leaves out.
pub(crate) const RAMP_MS: u32 = 20;

/// What the `k`th start of a case sets: a load ramp shorter by k ms than the scenario's.
pub(crate) fn start(k: u32) -> Vec<(String, String)> {
    vec![("operation.load_ramp_s".to_owned(), format!("{:?}", f64::from(RAMP_MS - k) / 1e3))]
}

/// Whether a case is about the start: its record begins at t = 0.
pub(crate) fn about_start(case: &Case) -> bool {
    STARTS.iter().any(|start| start.id == case.id)
}

const SHAPE: &str = "defects.0.shape";
/// Every scenario of section 4, once.
pub(crate) static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| file().case);

/// The same bearing looked at from t = 0 on, start-up included.
pub(crate) static STARTS: LazyLock<Vec<Case>> = LazyLock::new(|| file().start);

/// Section 4, in its order.
pub(crate) static EXPERIMENTS: LazyLock<Vec<Experiment>> = LazyLock::new(|| file().experiment);

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "'de: 'static"))]
struct File {
    case: Vec<Case>,
    start: Vec<Case>,
    experiment: Vec<Experiment>,
}

fn file() -> File {
    crate::data("cases.toml", include_str!("cases.toml"))
}

/// A case by its id.
pub(crate) fn case(id: &str) -> Option<&'static Case> {
    CASES.iter().chain(STARTS.iter()).find(|case| case.id == id)
}

/// How long a case runs where the others run `length`: those about the start need no more than that.
pub(crate) fn length_of(case: &Case, length: Length) -> Length {
    if about_start(case) { Length::START } else { length }
}

/// What a figure or several of them show.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Experiment {
    /// The figures.
    pub figures: Vec<u32>,
    /// Heading.
    pub title: &'static str,
    /// The cases, in the order of colours and of the x axis.
    pub cases: Vec<&'static str>,
    /// Along x where the cases are steps of one quantity: its name, its unit, and its values.
    pub steps: Option<(&'static str, &'static str, Vec<f64>)>,
    /// What the paper sets, and what is here.
    pub words: &'static str,
}

/// Figures that can be reproduced.
pub const FIGURES: std::ops::RangeInclusive<u32> = 8..=20;

#[cfg(test)]
mod tests {
    use super::*;
    use brinell::document;
    use brinell::scenario::Shape;

    #[test]
    fn prop_every_case_is_a_sound_scenario_without_warnings() {
        for case in CASES.iter().chain(STARTS.iter()) {
            let settings = owned(&case.settings);
            let loaded = document::read(BASE, &settings).unwrap_or_else(|e| panic!("{}: {e:?}", case.id));
            assert_eq!(loaded.scenario.operation.speed_rpm, brinell::scenario::Speed::Constant(case.rpm));
            let width = match loaded.scenario.defects[0].shape {
                Shape::Li2023Irregular { max_width_mm } => Some(max_width_mm),
                _ => None,
            };
            assert_eq!(case.irregular_width_mm, width, "{}", case.id);
        }
    }

    #[test]
    fn analytic_load_ramp_of_the_base() {
        let base = document::read(BASE, &[]).unwrap().scenario;
        assert_eq!(base.operation.load_ramp_s, f64::from(RAMP_MS) / 1e3);
        assert_eq!(start(0), [("operation.load_ramp_s".to_owned(), "0.02".to_owned())]);
    }

    #[test]
    fn prop_experiments_name_cases_and_cover_the_figures() {
        let mut figures: Vec<u32> = Vec::new();
        for experiment in EXPERIMENTS.iter() {
            figures.extend(&experiment.figures);
            assert!(experiment.cases.iter().all(|id| case(id).is_some()));
            if let Some((_, _, values)) = &experiment.steps {
                assert_eq!(values.len(), experiment.cases.len());
            }
        }
        assert_eq!(figures, FIGURES.collect::<Vec<_>>());
        let all: Vec<&Case> = CASES.iter().chain(STARTS.iter()).collect();
        for (k, one) in all.iter().enumerate() {
            assert!(all[..k].iter().all(|other| other.id != one.id));
            assert!(EXPERIMENTS.iter().any(|e| e.cases.contains(&one.id)), "{}", one.id);
        }
    }

    #[test]
    fn analytic_lengths_hold_their_turns() {
        // The ramp of 0.02 s, the turn after it, 40 turns, and a hair.
        let duration = Length::QUICK.duration_s(1800.0);
        assert!((0.02 + 41.0 / 30.0..0.02 + 41.2 / 30.0).contains(&duration), "{duration}");
        let duration = Length::QUICK.duration_s(5000.0);
        assert!((0.02 + 41.0 * 0.012..0.02 + 41.2 * 0.012).contains(&duration));
        assert_eq!((Length::FULL.starts(), Length::QUICK.starts()), (8, 1));
        // And 12 turns at 5000 r/min would not hold a record of 0.3 s.
        assert_eq!(Length::QUICK_VARIANT.duration_s(5000.0), Length::SHORTEST_S);
    }
}
