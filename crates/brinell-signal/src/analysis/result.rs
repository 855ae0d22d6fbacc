//! What an analysis found.

use super::bands::BandChoice;
use super::drift::Drift;
use super::family::{Family, Finding};
use super::frequencies::Component;
use super::options::Options;
use super::soundness::Flaw;
use super::verdict::Elsewhere;
use crate::{Band, Estimate, Indicator, Kurtogram, KurtogramBand, Spectrum};

/// Rollers that enter the load of a healthy bearing strike the resting race at the same rate as its damage is struck
/// (varying compliance), which simulations without noise show. Evidence that modulates by less is weak there; some
/// healthy single-row bearings go beyond.
const PASSING: f64 = 0.4;
/// What the families amount to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// A part is damaged.
    Damage,
    /// Something is there that more or other data would decide.
    CannotTell,
    /// No damage was found. Not the same as "healthy".
    NothingFound,
}

impl Verdict {
    /// In files: `damage`, `cannot_tell`, `nothing_found`.
    pub fn key(self) -> &'static str {
        match self {
            Verdict::Damage => "damage",
            Verdict::CannotTell => "cannot_tell",
            Verdict::NothingFound => "nothing_found",
        }
    }
}

/// An envelope spectrum.
#[derive(Debug, Clone)]
pub struct View {
    /// The band demodulated.
    pub band: Band,
    /// Why this one.
    pub choice: BandChoice,
    /// Its envelope's spectrum, up to where lines were sought; peak amplitudes in the signal's unit.
    pub spectrum: Spectrum,
    /// Mean of the envelope, in the signal's unit.
    pub mean: f64,
}

/// Everything that was found.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// What was asked.
    pub options: Options,
    /// Sample rate, Hz.
    pub sample_rate: f64,
    /// Samples analysed.
    pub samples: usize,
    /// Mean that was removed.
    pub mean: f64,
    /// Shaft speed, Hz, as refined from lines at its harmonics, or as given.
    pub shaft: f64,
    /// Whether it is known: from lines of the signal, or as it was followed.
    pub shaft_found: bool,
    /// What is wrong with the record itself.
    pub flaws: Vec<Flaw>,
    /// How the speed changes during the record, where lines tell it and nobody said so.
    pub drift: Option<Drift>,
    /// Harmonics of the shaft whose lines told its speed; none where it was given or followed.
    pub shaft_lines: Vec<usize>,
    /// Indicators of the signal less its mean over whole revolutions, with intervals; peaks are those of a revolution.
    pub indicators: Vec<(Indicator, Estimate)>,
    /// Largest |x| of the record less its mean; it grows with the record's length.
    pub record_peak: f64,
    /// The most impulsive band, where there is one.
    pub kurtogram: Option<KurtogramBand>,
    /// The kurtogram it was found in, unless the band was given.
    pub map: Option<Kurtogram>,
    /// The envelope spectrum to show.
    pub view: View,
    /// Bands whose envelope spectra were averaged.
    pub bands: usize,
    /// Each defect frequency with its harmonics, over all bands together: damage first, the part that leads before
    /// others.
    pub families: Vec<Family>,
    /// Where no damage is called: a comb deeper than any of the bearing's, where the bearing has no frequency.
    pub elsewhere: Option<Elsewhere>,
    /// What would be damage at the speed given, where no damage is called at the speed by the shaft's lines, and that
    /// lies farther off than the tolerance: the speed given is wrong, or the lines are another shaft's.
    pub at_given: Option<Family>,
    /// Whether the outer race was judged beside the same run without damage ([`Analysis::beside_healthy_run`]).
    pub passing_known: bool,
    /// RMS over that of a record of the healthy machine, where there is one.
    pub level_growth: Option<f64>,
    /// The range in which that is, where it is not the whole.
    pub level_range: Option<Band>,
}

impl Analysis {
    /// Families that are damage, the one that leads before others.
    pub fn causes(&self) -> impl Iterator<Item = &Family> {
        (self.families.iter()).filter(|f| f.finding == Finding::Damage)
    }

    /// One of the indicators.
    pub fn indicator(&self, wanted: Indicator) -> Option<Estimate> {
        let found = self.indicators.iter().find(|(i, _)| *i == wanted);
        found.map(|(_, estimate)| *estimate)
    }

    /// The crest factor as instruments show it: the record's peak over its RMS. [`Indicator::CrestFactor`] has the mean
    /// of the revolutions' peaks, which does not grow with the record.
    pub fn record_crest_factor(&self) -> Option<f64> {
        let crest = self.record_peak / self.indicator(Indicator::Rms)?.value;
        crest.is_finite().then_some(crest)
    }

    /// Whether the speed was given as a record of it, whether it varies or not.
    pub(super) fn has_record_of_speed(&self) -> bool {
        self.options.rotation.is_some() && !self.drift.as_ref().is_some_and(|d| d.followed)
            || self.options.measured_speed
    }

    /// What it amounts to.
    pub fn conclusion(&self) -> Verdict {
        let open = (self.families.iter()).any(|f| match f.finding {
            Finding::Open | Finding::Grown => true,
            Finding::AsBefore => !self.passing_known,
            _ => false,
        });
        if self.causes().next().is_some() {
            Verdict::Damage
        } else if open || self.elsewhere.is_some() || self.at_given.is_some() || self.hiding_drift().is_some() {
            Verdict::CannotTell
        } else {
            Verdict::NothingFound
        }
    }

    /// Whether the rollers of a healthy bearing may show as much, where nothing drowns them ([`Options::silent`]).
    pub fn may_be_passing(&self, family: &Family) -> bool {
        let outer = family.component == Component::OuterRace;
        self.options.silent.is_some() && !self.passing_known && outer && family.modulation < PASSING
    }

    /// A drift for which damage may be missed.
    pub(super) fn hiding_drift(&self) -> Option<&Drift> {
        self.drift.as_ref().filter(|d| d.may_hide())
    }

    /// How many impacts a turn of the shaft would look like a race's, where nothing tells the shaft's speed.
    pub(super) fn impacts_a_turn(&self, family: &Family) -> Option<f64> {
        let options = &self.options;
        let times = (family.frequency / options.shaft).round();
        let off = family.frequency / (options.shaft * times) - 1.0;
        (family.name.starts_with("BPF") && !self.speed_is_told() && off.abs() <= options.tolerance).then_some(times)
    }

    /// Whether something but the one who asks tells the shaft's speed: its lines, a record of it, or a simulation.
    pub(super) fn speed_is_told(&self) -> bool {
        let options = &self.options;
        !self.shaft_lines.is_empty() || options.rotation.is_some() || options.measured_speed || options.exact
    }

    /// Length of what was analysed, s.
    pub fn duration(&self) -> f64 {
        self.samples as f64 / self.sample_rate
    }
}
