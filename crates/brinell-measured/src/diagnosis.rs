//! What is found in a signal, and its verdict in words.

use crate::known::Known;
use crate::measurement::Measurement;
use crate::size::Length;
use crate::stretch::Rest;
use brinell::analysis::{Analysis, Comparison, Component, DefectOrders, Family, Levels};
use brinell::bearing::KnownBearing;
use brinell::document::Loaded;
use brinell::scenario::Surface;
use brinell::signal::VelocityBands;

/// Everything that is found in a measured signal.
pub struct Findings {
    /// The signal; its warnings are [those of all](Findings::warnings).
    pub measurement: Measurement,
    /// The shaft's speed and where it comes from, in words.
    pub speed: String,
    /// What lies beyond the stretch, where the signal is longer than one analysis takes.
    pub rest: Option<Rest>,
    /// Bands of ISO 15242, where the signal is one acceleration.
    pub velocity: Option<VelocityBands>,
    /// Of each bearing that was asked about, or of one: at least one.
    pub bearings: Vec<Diagnosis>,
    /// Where channel, rate and unit come from, and what else is said.
    pub notes: Vec<String>,
    /// What deserves attention, each once.
    pub warnings: Vec<String>,
}

/// What is found at the frequencies of one bearing.
pub struct Diagnosis {
    /// The bearing's name, where one was given.
    pub name: String,
    /// Its orders.
    pub bearing: Known<DefectOrders>,
    /// Families, indicators and the verdict.
    pub analysis: Analysis,
    /// Levels of the signal.
    pub levels: Levels,
    /// How long the damage that leads is, where that is asked.
    pub size: Option<Length>,
    /// What is to be said in view of the machine's other bearings.
    pub beside: Option<String>,
    /// The other bearing whose lines these are, where they are no frequency of this one.
    pub lines_of: Option<String>,
    /// That damage is called which the run that made the signal had not.
    pub(crate) wrong: Option<String>,
    /// The end of a long signal.
    pub last: Option<Analysis>,
    /// What it is compared with.
    pub against: Option<Against>,
}

/// What the signal is laid over, in the signal's unit.
pub struct Against {
    /// The other signal.
    pub measurement: Measurement,
    /// What is found in it.
    pub analysis: Analysis,
    /// The one beside the other.
    pub comparison: Comparison,
}

impl Diagnosis {
    pub(crate) fn new(name: &str, bearing: Known<DefectOrders>, analysis: Analysis, levels: Levels) -> Self {
        Self {
            name: name.to_owned(),
            bearing,
            analysis,
            levels,
            size: None,
            beside: None,
            lines_of: None,
            wrong: None,
            last: None,
            against: None,
        }
    }

    /// Where the defect frequencies come from.
    pub fn said_of_bearing(&self) -> String {
        self.bearing.notes.join("; ")
    }

    /// Its highest-scoring damage.
    pub fn call(&self) -> Option<&Family> {
        self.analysis.causes().max_by(|a, b| a.score.total_cmp(&b.score))
    }

    /// The verdict, and what is to be said beside it.
    pub fn verdict_text(&self) -> String {
        let mut said = vec![self.analysis.verdict()];
        said.extend(self.struck_alike());
        // What answers the question comes first.
        let at = if self.lines_of.is_some() { 0 } else { 1 };
        said.splice(at..at, self.beside.clone());
        said.extend(self.size_words().map(|words| format!("Size: {words}")));
        said.extend(self.wrong.clone());
        said.join(" ")
    }

    /// Where the bearing is not known, those known by name that have its comb.
    pub fn struck_alike(&self) -> Option<String> {
        /// What is read at a glance.
        const SHOWN: usize = 6;
        let a = &self.analysis;
        let order = a.elsewhere.filter(|_| a.has_no_bearing())?.frequency / a.shaft;
        let all = KnownBearing::struck_at(&[order], a.options.tolerance);
        let (first, rest) = all.split_at(all.len().min(SHOWN));
        let per_cent = a.options.tolerance_percent();
        if first.is_empty() {
            return Some(format!("No bearing known by name has a frequency within {per_cent} % of it."));
        }
        // One order was asked for.
        let words = |(known, found): &(KnownBearing, Vec<(&str, f64)>)| {
            found.first().map(|(name, own)| format!("{} ({name} {own:.3})", known.name()))
        };
        let first: Vec<String> = first.iter().filter_map(words).collect();
        let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
        Some(format!("Known by name with such a frequency, within {per_cent} %: {}{more}.", first.join(", ")))
    }

    /// The length of the damage in words, where it was asked.
    pub fn size_words(&self) -> Option<String> {
        Some(match self.size.as_ref()? {
            Ok(told) => format!(
                "{:.1} mm along the rolling direction, 95 % of simulated damage within {:.1} to {:.1} mm, if shorter than {:.1} mm.",
                told.value, told.interval.low, told.interval.high, told.most
            ),
            Err(why) => format!("cannot tell: {why}."),
        })
    }

    /// That parts are named which the run that made the signal had no damage on: the verdict itself knows nothing of
    /// it.
    pub(crate) fn contradicted(analysis: &Analysis, run: &Loaded) -> Option<String> {
        let bearings = run.scenario.bearings();
        let is_damaged = |component: Component| {
            let on = |surface: Surface| match component {
                Component::OuterRace => surface == Surface::OuterRaceway,
                Component::InnerRace => surface == Surface::InnerRaceway,
                Component::Element => matches!(surface, Surface::Roller(_)),
                Component::Cage => false,
            };
            bearings.iter().flat_map(|bearing| &bearing.defects).any(|d| on(d.on))
        };
        let mut wrong: Vec<&str> =
            (analysis.causes()).filter(|f| !is_damaged(f.component)).map(|f| f.component.words()).collect();
        wrong.dedup();
        (!wrong.is_empty()).then(|| {
            format!("Wrong: in the run that made the signal nothing was damaged on the {}.", wrong.join(" and the "))
        })
    }
}
