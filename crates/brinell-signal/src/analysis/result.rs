//! What an analysis found.

use super::bands::BandChoice;
use super::drift::Drift;
use super::elsewhere::Elsewhere;
use super::family::{Family, Finding, lag};
use super::frequencies::Component;
use super::options::Options;
use super::soundness::Flaw;
use crate::{Band, Estimate, Indicator, Kurtogram, KurtogramBand, Spectrum};

/// Rollers that enter the load of a healthy bearing strike the resting race at the same rate as its damage is struck
/// (varying compliance), which simulations without noise show. Evidence that modulates by less is weak there; some
/// healthy single-row bearings go beyond.
const PASSING: f64 = 0.4;
/// Kurtosis from which a record has impacts: of the sound machines among the records of results/analyze-evidence.md it is 2.8 to
/// 3.8, of the sound bearings beside a damaged one up to 13.
const IMPULSIVE: f64 = 5.0;
/// Kurtosis of noise.
const OF_NOISE: f64 = 3.0;
/// Kurtosis above that of noise, over the healthy record's, from which impacts are new.
const NEW: f64 = 2.0;
/// Change of the RMS since the machine was healthy that is said.
pub(super) const CHANGED: f64 = 2.0;

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

/// What shows in the signal itself and in no line of the bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unexplained {
    /// Impacts, by this kurtosis, of what lies above a frequency, Hz, or of the whole record.
    Impacts(f64, Option<f64>),
    /// An RMS so many times that of the healthy machine's record.
    Level(f64),
}

impl Unexplained {
    /// In files: `impacts`, `level`.
    pub fn key(self) -> &'static str {
        match self {
            Unexplained::Impacts(..) => "impacts",
            Unexplained::Level(_) => "level",
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
    /// Records analysed together.
    pub records: usize,
    /// Length of the shortest of them, s.
    pub shortest: f64,
    /// Samples analysed, of all records.
    pub samples: usize,
    /// Mean that was removed.
    pub mean: f64,
    /// Shaft speed, Hz, as refined from lines at its harmonics, or as given.
    pub shaft: f64,
    /// Whether it is known: from lines of the signal, or as it was followed.
    pub shaft_found: bool,
    /// What is wrong with a record itself, and with which, counted from 0.
    pub flaws: Vec<(usize, Flaw)>,
    /// How the speed changes during the record, where lines tell it and nobody said so.
    pub drift: Option<Drift>,
    /// Harmonics of the shaft whose lines told its speed; none where it was given or followed.
    pub shaft_lines: Vec<usize>,
    /// Indicators of the signal less its mean (of several records: means of theirs, of the RMS the mean of squares) over whole revolutions, with intervals; peaks are those of a revolution.
    pub indicators: Vec<(Indicator, Estimate)>,
    /// Largest |x| of a record less its mean; it grows with the record's length.
    pub record_peak: f64,
    /// The most impulsive band, where there is one.
    pub kurtogram: Option<KurtogramBand>,
    /// The kurtogram it was found in, that of the first record, unless the band was given.
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
    /// Kurtosis in that range, and of the healthy machine's record there.
    pub kurtosis_beside: Option<[f64; 2]>,
    /// Kurtosis of what lies in the band shown, and the band's lower edge, Hz, where no damage is called.
    pub kurtosis_above: Option<(f64, f64)>,
    /// Whether another bearing of the machine is damaged: impacts and level may be its own.
    pub beside_damage: bool,
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
        match self.by_lines() {
            Verdict::NothingFound if self.unexplained().is_some() || self.has_no_bearing() => Verdict::CannotTell,
            by_lines => by_lines,
        }
    }

    /// Whether the bearing is not known: its lines are sought as a comb of any frequency.
    pub fn has_no_bearing(&self) -> bool {
        self.options.orders.is_empty()
    }

    /// Impacts or a level that no line explains, where lines leave nothing open.
    pub fn unexplained(&self) -> Option<Unexplained> {
        let may_be = self.by_lines() == Verdict::NothingFound && !self.beside_damage;
        self.impacts_or_level().filter(|_| may_be)
    }

    fn by_lines(&self) -> Verdict {
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

    /// Impacts, or a level that has risen, whatever explains them. A simulation has nothing that is not known.
    pub fn impacts_or_level(&self) -> Option<Unexplained> {
        let whole = self.indicator(Indicator::Kurtosis)?.value;
        // Unbalance hides impacts from the kurtosis of the whole record.
        let ([own, healthy], above) = match (self.kurtosis_beside, self.kurtosis_above) {
            (Some(both), _) => (both, None),
            (None, Some((kurtosis, low))) if kurtosis > whole => ([kurtosis, OF_NOISE], Some(low)),
            _ => ([whole, OF_NOISE], None),
        };
        let is_new = own >= IMPULSIVE && own - OF_NOISE >= NEW * (healthy - OF_NOISE);
        let impacts = is_new.then_some(Unexplained::Impacts(own, above));
        let level = self.level_growth.filter(|g| *g >= CHANGED).map(Unexplained::Level);
        impacts.or(level).filter(|_| !self.options.exact)
    }

    /// Whether the rollers of a healthy bearing may show as much, where nothing drowns them ([`Options::silent`]).
    pub fn may_be_passing(&self, family: &Family) -> bool {
        let outer = family.component == Component::OuterRace;
        self.options.silent.is_some() && !self.passing_known && outer && family.modulation < PASSING
    }

    /// By how much the cage lags, relative, where that and nothing else puts a family beyond the tolerance.
    pub(super) fn slips(&self, family: &Family) -> Option<f64> {
        lag(family.component, family.shift(), &self.options).filter(|_| !self.options.exact)
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
