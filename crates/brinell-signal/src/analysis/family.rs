//! A defect frequency with its harmonics, all of one slip, in all bands together: the evidence that a verdict rests on.
//!
//! A family has
//! - a score, the sum over five harmonics of ln(power over floor), in which a harmonic counts no more than any below
//!   it: lines from the fundamental up make it, and lines that another family happens to share do not;
//! - a modulation, the depth to which its lines and their sidebands modulate the envelopes: what a longer record does
//!   not change. A sideband counts up to its carrier.
//!
//! In measured records of sound bearings families are present too, some of them high, and none of them modulates; of
//! those that do, none is high. So damage takes both ([`Family::is_damage`]). The limits were set on 72 public records
//! of three rigs (docs/src/results/analyze-evidence.md): of 31 of sound bearings none scores more than 10.1 or, at a score
//! beyond noise, modulates by more than 18 %.

#[cfg(test)]
mod replay;

use super::Options;
use super::frequencies::Component;
use super::together::{HARMONICS, Highest, Place, Together};
use crate::Interval;
use serde::Serialize;

/// Score from which a family that modulates by [`FAINT`] is damage. In a record of fewer than
/// [`REVOLUTIONS`](super::together::REVOLUTIONS) true lines are less high over the noise, and chance lines hardly
/// less: the limit does not fall with them. Of several such records chance lines are lower, and it does ([`high`]).
pub(super) const SCORE: f64 = 14.5;
/// Score below which lines are not told from noise, however long the record: bands that one impact excites are not
/// independent.
const LEAST_SCORE: f64 = 5.0;
/// Modulation below which lines are no damage, however high they are: a sound machine has them too.
pub(super) const FAINT: f64 = 0.14;
/// Modulation from which a family is damage that is merely clear of the noise.
pub(super) const DEEP: f64 = 0.25;
/// Lines that have to be detected, and how many of them have to be harmonics. A harmonic that shaft or mains hide is
/// given the benefit of the doubt; a pair of sidebands counts as one.
const FEWEST: (usize, usize) = (3, 2);
/// Of so many first harmonics one is detected: where lines of the shaft hide them, higher ones may be another family's.
const FIRST: usize = 2;
/// Score beyond the limit from which evidence is very clear, where it is deep too.
const VERY_CLEAR: f64 = 6.0;
/// Sidebands to either side of a harmonic that are looked at.
const SIDEBANDS: i32 = 2;
/// Rates of an element and of the cage lie above pure rolling by less than this, relative: they slip, and do not run
/// ahead. A contact angle of 15 degrees, from an axial load, raises them by 0.9 % at most where elements are a fifth of
/// the pitch diameter or less.
pub(super) const AHEAD: f64 = 0.01;
/// So many times the tolerance a cage may slip where speed and bearing are exact.
const SLIPS: f64 = 3.0;
/// How far slip of the cage moves BPFO and 2 BSF down, and BPFI up, at most, relative.
const SLIP: f64 = 0.05;
/// FTF over the shaft's frequency where nobody said.
const USUAL_FTF: f64 = 0.4;

/// One harmonic of a family.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Harmonic {
    /// 1 is the fundamental.
    pub order: usize,
    /// Where it is, Hz.
    #[serde(rename = "frequency_hz")]
    pub frequency: f64,
    /// Power over the noise floor about it, averaged over the bands, dB; `None` where a line of shaft or mains hides
    /// it.
    pub snr_db: Option<f64>,
    /// Whether it is detected: over the noise by 3 dB at least.
    pub detected: bool,
}

/// The sidebands of a family's harmonics.
#[derive(Debug, Clone, PartialEq)]
pub struct Sidebands {
    /// Distance between them, Hz.
    pub spacing: f64,
    /// Those that are detected: of which harmonic, and how many distances above it.
    pub detected: Vec<(usize, i32)>,
    /// Of how many that were looked at.
    pub of: usize,
}

/// What is said of a family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finding {
    /// High and deep enough for damage.
    Damage,
    /// The same, but its lines are accounted for by the damage of this name.
    Shared(&'static str),
    /// Its lines modulate the envelope as damage does, and are not clear of the noise by enough to be sure.
    Open,
    /// Its lines are present, faintly, as in sound machines.
    Faint,
    /// The same, or open, and at least twice as deep as in a record of the healthy machine.
    Grown,
    /// Damage by itself, and half as deep or more in a record of the healthy machine.
    AsBefore,
    /// Nothing.
    Silent,
}

impl Finding {
    /// In files: `damage`, `shared`, `cannot_tell`, `faint`, `grown`, `as_before`, `nothing`.
    pub fn key(self) -> &'static str {
        match self {
            Finding::Damage => "damage",
            Finding::Shared(_) => "shared",
            Finding::Open => "cannot_tell",
            Finding::Faint => "faint",
            Finding::Grown => "grown",
            Finding::AsBefore => "as_before",
            Finding::Silent => "nothing",
        }
    }
}

/// A defect frequency with its harmonics in all bands together.
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    /// Which part.
    pub component: Component,
    /// `BPFO`, `BPFI`, `2 BSF` or `FTF`.
    pub name: &'static str,
    /// Where pure rolling has it, Hz.
    pub expected: f64,
    /// Where its lines are highest, Hz.
    pub frequency: f64,
    /// 95 % interval of that as the mean rate of its impacts over the record: of damage, where there is one record at a speed that
    /// was not followed.
    pub interval: Option<Interval>,
    /// Sum of ln(power over floor) over the harmonics, none counting more than those below it.
    pub score: f64,
    /// The score from which a record of this length shows damage.
    pub limit: f64,
    /// The score that noise alone hardly reaches.
    pub noise: f64,
    /// The modulation that it takes at that score.
    faint: f64,
    /// Depth to which it modulates the envelopes, in the root mean square over all bands: amplitude over mean.
    pub modulation: f64,
    /// Its harmonics.
    pub harmonics: Vec<Harmonic>,
    /// Its sidebands; `None` where its source does not turn through the load.
    pub sidebands: Option<Sidebands>,
    /// Whether it lies at the end of what was searched and its lines are higher beyond: they are somebody else's.
    pub is_skirt: bool,
    /// Whether its lines lie where those of the shaft or the mains do, and were read nonetheless: nothing tells them
    /// apart.
    pub masked: bool,
    /// Distance of its sidebands, Hz, where it would lead and they are those of a shaft at another speed.
    pub other_spacing: Option<f64>,
    /// Of an outer race or element that would lead: the slip of the cage at which the other's lines lie where its own
    /// do, where that is no more than two tolerances.
    pub others_slip: Option<f64>,
    /// Modulation over that of a record of the healthy machine, where there is one.
    pub growth: Option<f64>,
    /// What is said of it.
    pub finding: Finding,
}

impl Family {
    /// Shift from pure rolling, relative: slip, contact angle or an inexact speed.
    pub fn shift(&self) -> f64 {
        self.frequency / self.expected - 1.0
    }

    /// How many harmonics are detected.
    pub fn detected_harmonics(&self) -> usize {
        self.harmonics.iter().filter(|h| h.detected).count()
    }

    /// How many harmonics a line of shaft or mains hides.
    pub fn hidden_harmonics(&self) -> usize {
        (self.harmonics.iter()).filter(|h| h.snr_db.is_none()).count()
    }

    /// How many sidebands are detected.
    pub fn detected_sidebands(&self) -> usize {
        self.sidebands.as_ref().map_or(0, |s| s.detected.len())
    }

    /// The highest harmonic, dB over the floor.
    pub fn highest_db(&self) -> f64 {
        let levels = self.harmonics.iter().filter_map(|h| h.snr_db);
        levels.fold(0.0, f64::max)
    }

    /// The highest of its lines that are detected.
    pub(super) fn highest_line(&self) -> Option<&Harmonic> {
        let detected = self.harmonics.iter().filter(|h| h.detected);
        detected.max_by(|a, b| a.snr_db.unwrap_or(0.0).total_cmp(&b.snr_db.unwrap_or(0.0)))
    }

    /// Whether it says damage by itself: high, and deeper than a sound machine's; or deep, and beyond noise.
    pub fn is_damage(&self) -> bool {
        self.has_height_of_damage() && self.is_whole()
    }

    fn has_height_of_damage(&self) -> bool {
        let high = self.score >= self.limit && self.modulation >= self.faint;
        let deep = self.score >= self.noise && self.modulation >= DEEP;
        high || deep
    }

    /// Whether it would be damage, were its lines not higher beyond the end of what was searched.
    pub(super) fn is_damage_beyond(&self) -> bool {
        self.is_skirt && self.has_height_of_damage() && self.has_lines()
    }

    /// Whether enough of its lines are detected, and where they belong.
    pub(super) fn is_whole(&self) -> bool {
        !self.is_skirt && !self.masked && self.has_lines()
    }

    fn has_lines(&self) -> bool {
        let detected = self.detected_harmonics();
        let hidden = self.hidden_harmonics();
        !self.lacks_sidebands()
            && detected + hidden + self.detected_sidebands() / 2 >= FEWEST.0
            && detected >= FEWEST.1
            && self.harmonics[..FIRST].iter().any(|h| h.detected)
    }

    /// An element passes through the load once for each turn of the cage: lines at its rate without sidebands are
    /// somebody else's, of slip in BPFO most often.
    pub(super) fn lacks_sidebands(&self) -> bool {
        self.component == Component::Element && self.detected_sidebands() < self.detected_harmonics()
    }

    /// Whether it would lead, but for what may have its lines as well: the other part that slip of the cage puts there,
    /// or a part at another speed.
    pub(super) fn may_be_anothers(&self) -> bool {
        self.others_slip.is_some() || self.other_spacing.is_some()
    }

    /// Whether its lines have the sidebands of an element, `spacing` Hz apart.
    pub(super) fn could_be_elements(&self, together: &Together, spacing: f64) -> bool {
        let Lines { harmonics, sidebands, .. } = lines(together, self.frequency, Some(spacing));
        !Family { component: Component::Element, harmonics, sidebands, ..self.clone() }.lacks_sidebands()
    }

    /// Whether its evidence is both high and deep.
    pub fn is_very_clear(&self) -> bool {
        self.is_damage() && self.score >= self.limit + VERY_CLEAR && self.modulation >= DEEP
    }

    /// What is said of it where nothing else is.
    fn alone(&self) -> Finding {
        if self.is_damage() {
            Finding::Damage
        } else if self.is_skirt {
            Finding::Silent
        } else if self.modulation >= DEEP && self.score >= 0.5 * self.noise {
            Finding::Open
        } else if self.score >= self.noise && self.detected_harmonics() >= 1 {
            Finding::Faint
        } else {
            Finding::Silent
        }
    }
}

/// By how much the cage lags pure rolling where that moves the lines of a part beyond the tolerance, by `shift`: the slip
/// s makes BPFO and 2 BSF (1 - s), and BPFI (1 + s f_c / (f_s - f_c)).
pub(super) fn lag(component: Component, shift: f64, options: &Options) -> Option<f64> {
    let turns = options.orders.ftf.unwrap_or(USUAL_FTF);
    let (moved, lag) = match component {
        Component::OuterRace | Component::Element => (-shift, -shift),
        Component::InnerRace => (shift, shift * (1.0 - turns) / turns),
        Component::Cage => return None,
    };
    (moved > options.tolerance && moved <= SLIP).then_some(lag)
}

/// The cage's frequency, Hz.
pub(super) fn cage(shaft: f64, options: &Options) -> f64 {
    options.orders.ftf.unwrap_or(USUAL_FTF) * shaft
}

/// Each family at the slip at which its score is highest, up to the tolerance from pure rolling.
pub(super) fn read(together: &Together, shaft: f64, options: &Options) -> Vec<Family> {
    // Damage on an element meets both races, twice a turn; on a ball that turns about another axis, one, at lines that
    // 2 BSF has as well.
    let all = (options.orders.defect_frequencies()).filter(|(_, name, _)| *name != "BSF");
    all.map(|(component, name, order)| {
        let (behind, ahead) = reach(component, options);
        let mut family = within(together, shaft, options, (component, name, order * shaft), (behind, ahead));
        family.finding = family.alone();
        family
    })
    .collect()
}

/// A family at the slip that another one's lines say, to within its resolution: what lies beside it is somebody else's.
pub(super) fn at_slip(together: &Together, shaft: f64, options: &Options, family: &Family, slip: f64) -> Family {
    let own = (family.component, family.name, family.expected);
    let resolved = 0.5 * together.step() / (HARMONICS as f64 * family.expected);
    let mut family = within(together, shaft, options, own, (resolved - slip, resolved + slip));
    family.is_skirt = false;
    family.finding = family.alone();
    family
}

/// What a family's score and modulation are held against.
struct Limits {
    noise: f64,
    limit: f64,
    faint: f64,
}

/// The score from which lines are high, where they rise over the noise by `rise` times what they do in long segments:
/// that of lines which would reach [`SCORE`] there.
fn high(rise: f64) -> f64 {
    let each = SCORE / HARMONICS as f64;
    if rise < 1.0 { HARMONICS as f64 * (rise * each.exp_m1()).ln_1p() } else { SCORE }
}

/// Those of a part, where noise reaches a score of `of_noise`.
fn limits(component: Component, of_noise: f64, rise: f64, options: &Options) -> Limits {
    let noise = of_noise.max(LEAST_SCORE);
    let faint = match component {
        Component::Cage => f64::INFINITY,
        // Rollers that enter the load strike the race of a healthy bearing too, and little drowns them in a simulation.
        Component::OuterRace if options.silent.is_some() || options.exact => DEEP,
        _ => FAINT,
    };
    Limits { noise, limit: high(rise).max(noise), faint }
}

/// A family where its score is highest, from so far below to so far above pure rolling, relative.
fn within(
    together: &Together,
    shaft: f64,
    options: &Options,
    (component, name, expected): (Component, &'static str, f64),
    (behind, ahead): (f64, f64),
) -> Family {
    let Limits { noise, limit, faint } =
        limits(component, HARMONICS as f64 * together.noise.ln(), together.rise, options);
    let step = 0.25 * together.step() / (HARMONICS as f64 * expected);
    let steps = ((ahead + behind) / step) as usize;
    let places = (0..=steps).map(|k| expected * (1.0 - behind + k as f64 * step));
    let highest = Highest::of(places, |f| score(together, f));
    let highest = highest.unwrap_or(Highest { from: expected, to: expected, height: 0.0 });
    let score = highest.height;
    let (low, high) = (expected * (1.0 - behind), expected * (1.0 + ahead));
    let told = by_lines(together, highest.middle());
    let frequency = told.clamp(low, high);
    let spacing = match component {
        Component::InnerRace => Some(shaft),
        Component::Element => Some(cage(shaft, options)),
        Component::OuterRace | Component::Cage => None,
    };
    let lines = lines(together, frequency, spacing);
    // On the skirt of a line farther off, or of one within a bin of the end that lies beyond it.
    let next = match frequency > expected {
        true => highest.to + 4.0 * step * expected,
        false => highest.from - 4.0 * step * expected,
    };
    let outside = next < low || next > high;
    Family {
        component,
        name,
        expected,
        frequency,
        interval: None,
        score,
        limit,
        noise,
        faint,
        modulation: lines.modulation,
        harmonics: lines.harmonics,
        sidebands: lines.sidebands,
        is_skirt: (told - frequency).abs() > 0.5 * together.step() / HARMONICS as f64
            || outside && self::score(together, next) > score,
        masked: false,
        other_spacing: None,
        others_slip: None,
        growth: None,
        finding: Finding::Silent,
    }
}

/// How far below and above pure rolling a rate may lie, relative. Where speed and bearing are exact, what goes farther
/// is slip: a cage that lags takes BPFO with it, and raises BPFI.
pub(super) fn reach(component: Component, options: &Options) -> (f64, f64) {
    let tolerance = options.tolerance;
    let slips = if options.exact { SLIPS * tolerance } else { tolerance };
    // What the same slip of the cage makes of BPFI.
    let turns = options.orders.ftf.unwrap_or(USUAL_FTF);
    let raised = (slips * turns / (1.0 - turns)).max(tolerance);
    match component {
        Component::OuterRace => (slips, tolerance),
        Component::Cage => (slips, AHEAD.min(tolerance)),
        Component::InnerRace => (tolerance, raised),
        Component::Element => (tolerance, AHEAD.min(tolerance)),
    }
}

/// The fundamental that the detected lines of a comb say: least squares, weighted by what they count for in the score;
/// the comb's own where it has less of these lines.
pub(super) fn by_lines(together: &Together, frequency: f64) -> f64 {
    let detected = |k: &f64| together.at(k * frequency).ratio.is_some_and(|r| r >= together.detection_level());
    let line = |k: f64| Some((k, together.line(k * frequency)?));
    let lines: Vec<(f64, f64)> = (1..=HARMONICS).map(|k| k as f64).filter(detected).filter_map(line).collect();
    let height = |k: f64, f: f64| together.at(k * f).ratio.unwrap_or(1.0).max(f64::MIN_POSITIVE).ln();
    let sum = |of: &dyn Fn(f64, f64) -> f64| lines.iter().map(|(k, line)| of(*k, *line)).sum::<f64>();
    let told = sum(&|k, line| height(k, frequency) * k * line) / sum(&|k, _| height(k, frequency) * k * k);
    // Without lines it is no number.
    if sum(&|k, _| height(k, told)) >= sum(&|k, _| height(k, frequency)) && told > 0.0 { told } else { frequency }
}

/// Of the comb of a frequency.
pub(super) fn score(together: &Together, frequency: f64) -> f64 {
    score_by(frequency, |f| together.at(f).ratio)
}

/// The same by the power over floor at each line; `None` where nothing is seen.
pub(super) fn score_by(frequency: f64, ratio: impl Fn(f64) -> Option<f64>) -> f64 {
    let (mut least, mut sum) = (f64::INFINITY, 0.0);
    for k in 1..=HARMONICS {
        // What is hidden neither counts nor limits.
        if let Some(ratio) = ratio(k as f64 * frequency) {
            least = least.min(ratio.max(f64::MIN_POSITIVE).ln());
            sum += least;
        }
    }
    sum
}

/// The lines on the comb of a frequency.
pub(super) struct Lines {
    harmonics: Vec<Harmonic>,
    sidebands: Option<Sidebands>,
    /// How deep they modulate.
    pub(super) modulation: f64,
}

/// The comb of a frequency, with sidebands at a distance of `spacing` Hz where it has any.
pub(super) fn lines(together: &Together, frequency: f64, spacing: Option<f64>) -> Lines {
    let detected = |place: Place| place.ratio.is_some_and(|r| r >= together.detection_level());
    let mut sidebands = spacing.map(|spacing| Sidebands { spacing, detected: Vec::new(), of: 0 });
    let mut depth = 0.0;
    let mut harmonics = Vec::with_capacity(HARMONICS);
    for order in 1..=HARMONICS {
        let at = order as f64 * frequency;
        let carrier = together.at(at);
        depth += carrier.depth;
        harmonics.push(Harmonic {
            order,
            frequency: at,
            snr_db: carrier.ratio.map(|r| 10.0 * r.log10()),
            detected: detected(carrier),
        });
        let Some(sidebands) = &mut sidebands else {
            continue;
        };
        for side in (-SIDEBANDS..=SIDEBANDS).filter(|s| *s != 0) {
            let line = together.at(at + f64::from(side) * sidebands.spacing);
            sidebands.of += 1;
            if detected(line) {
                sidebands.detected.push((order, side));
            }
            depth += line.depth.min(carrier.depth);
        }
    }
    Lines { harmonics, sidebands, modulation: (2.0 * depth).sqrt() }
}
