//! Which of several candidate frequencies stand out of a spectrum, and how likely noise alone would show as much.
//!
//! A candidate is a repetition frequency known to within a tolerance, such as a defect frequency whose slip is unknown.
//! Its lines are harmonics of one common frequency f, so they are judged together: with p_h the chance that noise shows
//! as much at harmonic h f (see [`lines`](super::lines)), Fisher's statistic
//!
//! S(f) = -2 sum over h of ln max(p_h, 1e-5)
//!
//! follows chi-square with twice as many degrees of freedom as harmonics if there is only noise, or lies below it
//! (R. A. Fisher, "Statistical methods for research workers", section 21.1). The cap keeps one strong line, which
//! may be anybody's, from making a family. The largest S over the tolerance counts; its chance times the number of
//! distinct places tried times the number of candidates is the false-alarm probability (Bonferroni), an upper bound.
//!
//! Sources make more lines than their first harmonics: a candidate's comb goes on, and where its sidebands stand they
//! reach further and surround zero frequency too, at multiples of their spacing. A candidate all of whose lines lie on the
//! combs of better ones is explained by them, if so many coincidences are unlikely (5 %) for lines that lie anywhere. In a
//! short record combs with close sidebands cover much of the spectrum and explain little; a longer record tells more.
//!
//! What it means: where the spectrum is that of noise whose level changes little over 80 bins, the chance that *any*
//! candidate of the list is said to stand is at most the level chosen. It does not say that a candidate that stands is
//! the cause: other sources make lines too. Candidates that claim the same lines are therefore named with each other.

mod account;
mod comb;
mod sidebands;

use self::account::explain;
pub use self::account::without;
use self::comb::{Best, Sought};
pub use self::sidebands::SidebandEvidence;
use self::sidebands::about;
use super::error::{SignalError, require};
use super::lines::{Floor, Line, LineSet};
use super::spectrum::Spectrum;

/// Smallest chance that a single line contributes.
const CAP: f64 = 1e-5;
/// A single line stands where noise would show as much less often than this.
const LINE_LEVEL: f64 = 1e-3;
/// Sidebands are told from their carrier from this many bins on.
const CLOSEST_SIDEBAND: f64 = 5.0;
/// Sidebands that make a family of a single harmonic.
const FEWEST_SIDEBANDS: usize = 3;
/// Powers below this share of the strongest line's are no evidence: skirts of lines that slip smears, and round-off.
const RANGE: f64 = 1e-3;
/// Bins to either side of a place that its line fills: Hann's main lobe.
const REACH: f64 = 2.0;

/// A frequency to look for.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Name, for the reader.
    pub name: String,
    /// Expected repetition frequency, Hz.
    pub frequency: f64,
    /// Half the range that it may lie in, Hz; below half the frequency.
    pub tolerance: f64,
    /// Distance of the sidebands that would come with it, Hz: the speed at which the source passes through the load or the
    /// transmission path.
    pub sideband_spacing: Option<f64>,
}

impl Candidate {
    fn check(&self) -> Result<(), SignalError> {
        require(
            self.frequency > 0.0 && self.frequency.is_finite(),
            "frequency (Hz)",
            self.frequency,
            "above 0",
        )?;
        require(
            (0.0..0.5 * self.frequency).contains(&self.tolerance),
            "tolerance (Hz)",
            self.tolerance,
            "0 to below half the frequency",
        )
    }
}

/// What to look for about each candidate, and how sure to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiagnosisOptions {
    /// Harmonics of each candidate, the fundamental included; 2 or more.
    pub harmonics: usize,
    /// Sidebands to either side of each harmonic.
    pub sidebands: usize,
    /// Largest false-alarm probability, over all candidates, at which one is said to stand; above 0 to below 1.
    pub level: f64,
    /// Noise as weak as this share of a candidate's strongest line, in power, hides what would crowd it: other lines hardly above that do not put
    /// it in doubt. 0: any may.
    pub rival: f64,
}

impl Default for DiagnosisOptions {
    /// Five harmonics, two sidebands to either side, 1 %, any lines in doubt.
    fn default() -> Self {
        DiagnosisOptions {
            harmonics: 5,
            sidebands: 2,
            level: 0.01,
            rival: 0.0,
        }
    }
}

/// What speaks for a candidate.
#[derive(Debug, Clone, PartialEq)]
pub struct Evidence {
    /// Index in the list of candidates.
    pub candidate: usize,
    /// Frequency at which its harmonics stand highest together, Hz.
    pub frequency: f64,
    /// Its harmonics there.
    pub harmonics: LineSet,
    /// How many of them stand by themselves (chance under noise below 1e-3).
    pub standing: usize,
    /// Orders of harmonics whose places were taken out of the spectrum with somebody else's lines, and that have sidebands standing to
    /// both sides: of them the spectrum cannot tell more.
    pub carried: Vec<i32>,
    /// Upper bound of the chance that noise alone shows such harmonics for any candidate of the list; 1 where none of its
    /// lines lies within the spectrum. Its complement is the confidence that there is more than noise.
    pub false_alarm: f64,
    /// By how much lines at frequencies that nobody asked for, and that are not sidebands of this one's, stand higher than
    /// noise would show them: 1 in noise. The logarithm of the chance has been divided by it.
    pub crowding: f64,
    /// Its sidebands, where it has a spacing wide enough to resolve.
    pub sidebands: Option<SidebandEvidence>,
    /// Whether it stands: false alarm at most the level, at least two harmonics stand by themselves or are carried by their sidebands,
    /// and it lies within the tolerance.
    pub stands: bool,
    /// Other candidates that stand and on whose combs standing harmonics of this one lie: index, and how many of them.
    pub alternatives: Vec<(usize, usize)>,
    /// Candidates of better rank whose combs together hold every standing harmonic of this one, by more than coincidence:
    /// there is no need for this one. Empty where it has lines of its own, or cannot be told.
    pub explained_by: Vec<usize>,
}

impl Evidence {
    /// Sum of ln(power over noise) over its standing lines, sidebands included: number and strength in one.
    fn weight(&self) -> f64 {
        (self.lines().filter(|l| l.false_alarm <= LINE_LEVEL))
            .map(|l| l.snr_db * 0.1 * std::f64::consts::LN_10)
            .sum()
    }

    /// Power of its standing lines, sidebands included: the sum of half their squared amplitudes.
    pub fn power(&self) -> f64 {
        (self.lines().filter(|l| l.false_alarm <= LINE_LEVEL))
            .map(|l| 0.5 * l.amplitude * l.amplitude)
            .sum()
    }

    /// Amplitude of one line with the power of its standing harmonics, or of the standing sidebands of those that are carried: over the
    /// envelope's mean, the depth of modulation.
    pub fn modulation(&self) -> f64 {
        let standing = self.harmonics.standing(LINE_LEVEL);
        (standing.chain(self.carrying()))
            .map(|l| l.amplitude.powi(2))
            .sum::<f64>()
            .sqrt()
    }

    /// The standing sidebands of the harmonics that are carried.
    pub fn carrying(&self) -> impl Iterator<Item = &Line> {
        let sidebands = self.sidebands.iter().flat_map(|s| s.standing_lines());
        (sidebands.filter(|(h, _)| self.carried.contains(h))).map(|(_, line)| line)
    }

    /// Harmonics that stand, or that their sidebands stand for.
    pub fn shown(&self) -> usize {
        self.standing + self.carried.len()
    }

    fn lines(&self) -> impl Iterator<Item = &Line> {
        let sidebands = self.sidebands.iter().flat_map(|s| &s.lines);
        self.harmonics.lines.iter().chain(sidebands)
    }
}

/// The outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The level asked for.
    pub level: f64,
    /// Of every candidate, in the order given.
    pub evidence: Vec<Evidence>,
    /// Candidates that stand, the best first: by number and strength of their lines.
    pub ranking: Vec<usize>,
}

impl Diagnosis {
    /// Whether no candidate stands.
    pub fn nothing_stands_out(&self) -> bool {
        self.ranking.is_empty()
    }

    /// Candidates that stand and that no better one explains, the best first.
    pub fn causes(&self) -> impl Iterator<Item = &Evidence> {
        (self.ranking.iter())
            .map(|i| &self.evidence[*i])
            .filter(|e| e.explained_by.is_empty())
    }
}

/// Looks for every candidate in a spectrum: an envelope spectrum, for damage.
///
/// The bins should be finer than a third of the closest distance between lines that matter (a cage's sidebands), but not
/// so fine that slip smears a line over several bins.
///
/// # Errors
/// [`SignalError::OutOfRange`] where a frequency, tolerance, spacing, level or number of harmonics is out of range, or the
/// spectrum has fewer than 27 bins.
pub fn diagnose(
    spectrum: &Spectrum,
    candidates: &[Candidate],
    options: &DiagnosisOptions,
) -> Result<Diagnosis, SignalError> {
    diagnose_beside(spectrum, candidates, options, &[])
}

/// The same in a spectrum from which lines at the places `aside` (Hz) were taken out, as somebody else's.
///
/// At such a place nothing can be seen: a candidate's harmonic there neither stands nor is missed. Where its sidebands stand to both
/// sides they stand for it: a rolling element whose 2 BSF is four times the shaft's frequency shows by its cage sidebands alone.
///
/// # Errors
/// As [`diagnose`].
pub fn diagnose_beside(
    spectrum: &Spectrum,
    candidates: &[Candidate],
    options: &DiagnosisOptions,
    aside: &[f64],
) -> Result<Diagnosis, SignalError> {
    require(
        options.level > 0.0 && options.level < 1.0,
        "level",
        options.level,
        "above 0 to below 1",
    )?;
    require(
        (2..=100).contains(&options.harmonics),
        "number of harmonics",
        options.harmonics as f64,
        "2 to 100",
    )?;
    for candidate in candidates {
        candidate.check()?;
    }
    let floor = Floor::within(spectrum, RANGE)?;
    let mut evidence = (0..candidates.len())
        .map(|index| examine(&floor, index, candidates, options, aside))
        .collect::<Result<Vec<Evidence>, _>>()?;
    let mut ranking: Vec<usize> = (0..evidence.len())
        .filter(|i| evidence[*i].stands)
        .collect();
    ranking.sort_by(|a, b| {
        let (a, b) = (&evidence[*a], &evidence[*b]);
        (a.false_alarm.total_cmp(&b.false_alarm)).then(b.weight().total_cmp(&a.weight()))
    });

    explain(&mut evidence, &ranking, spectrum, options);
    Ok(Diagnosis {
        level: options.level,
        evidence,
        ranking,
    })
}

fn examine(
    floor: &Floor,
    index: usize,
    candidates: &[Candidate],
    options: &DiagnosisOptions,
    aside: &[f64],
) -> Result<Evidence, SignalError> {
    let candidate = &candidates[index];
    let spacing = candidate.sideband_spacing.filter(|_| options.sidebands > 0);
    let sought = Sought {
        frequency: candidate.frequency,
        tolerance: candidate.tolerance,
        spacing,
        harmonics: options.harmonics,
    };
    let best = comb::best(floor, &sought).unwrap_or(Best {
        frequency: candidate.frequency,
        chance: 1.0,
        power: 0.0,
    });
    let reach = REACH * floor.step();
    let unseen = |l: &Line| {
        let near = |a: &f64| (a - l.expected).abs() <= reach || (a - l.frequency).abs() <= reach;
        aside.iter().any(near)
    };
    let lines = (1..=options.harmonics)
        .filter_map(|h| floor.line(h as i32, h as f64 * best.frequency, 0.0))
        .map(|l| match unseen(&l) {
            // What is left there is the noise about it, or a remainder of what was taken out.
            true => Line {
                false_alarm: 1.0,
                ..l
            },
            false => l,
        });
    let found = LineSet {
        lines: lines.collect(),
    };
    let standing = found.standing(LINE_LEVEL).count();
    let frequency = common_frequency(&found, |l| l.frequency).unwrap_or(best.frequency);
    let many = candidates.len() as f64;
    let sidebands = spacing.and_then(|s| about(floor, frequency, s, options, many, &unseen));
    // What any other frequency shows, in place of noise alone: less what this one accounts for.
    let crowding = match best.chance * many <= options.level {
        true if !comb::dwarfs(floor, &sought, candidates, best.power) => {
            let left = without(floor.spectrum(), frequency, spacing.as_slice())?;
            let left = comb::beside(left, frequency);
            let strongest = (found.standing(LINE_LEVEL).chain(
                sidebands
                    .iter()
                    .flat_map(|s| s.standing_lines().map(|l| l.1)),
            ))
            .fold(0.0, |m: f64, l| m.max(l.amplitude));
            let left = || -> Result<Floor, SignalError> {
                Ok(Floor::within(&left, RANGE)?.at_least(options.rival * strongest.powi(2)))
            };
            let floor = left()?;
            let shown = |floor: &Floor| comb::crowding(floor, &sought, candidates);
            let family = comb::family(&floor, frequency, &found, sidebands.as_ref());
            let apart = shown(&left()?.hiding(&family));
            // Where its family leaves too little to compare with, all of the rest, its own remains included.
            apart.or_else(|| shown(&floor)).unwrap_or(1.0)
        }
        _ => 1.0,
    };
    let chance = (best.chance.ln() / crowding).exp();
    let false_alarm = (chance * many).min(1.0);
    let beside = sidebands.as_ref().map_or(0, |s| s.standing);
    let low = (found.standing(LINE_LEVEL)).any(|l| l.order <= 2);
    let carried: Vec<i32> = (sidebands.iter().filter(|s| s.false_alarm <= options.level))
        .flat_map(|s| s.carry(&found, aside, reach))
        .collect();
    // A peak beyond the tolerance may lend its skirt to a comb within: what counts is where the peaks are.
    let peaks = common_frequency(&found, |l| floor.summit(l.frequency, REACH));
    let within = (peaks.unwrap_or(frequency) - candidate.frequency).abs()
        <= candidate.tolerance + 0.5 * floor.step();
    Ok(Evidence {
        candidate: index,
        frequency,
        standing,
        false_alarm,
        crowding,
        stands: false_alarm <= options.level
            && within
            && (standing + carried.len() >= 2 || low && beside >= FEWEST_SIDEBANDS),
        carried,
        harmonics: found,
        sidebands,
        alternatives: Vec::new(),
        explained_by: Vec::new(),
    })
}

/// Marks the bins within `reach` bins of a place.
fn mark(marks: &mut [bool], middle: f64, reach: f64) {
    let first = (middle - reach).ceil().max(0.0) as usize;
    let end = ((middle + reach).floor() + 1.0).clamp(0.0, marks.len() as f64) as usize;
    if first < end {
        marks[first..end].fill(true);
    }
}

/// The fundamental by least squares from the harmonics that stand, `at` certain frequencies, each weighted by its power over noise.
fn common_frequency(found: &LineSet, at: impl Fn(&Line) -> f64) -> Option<f64> {
    let (mut above, mut below) = (0.0, 0.0);
    for line in found.standing(LINE_LEVEL) {
        let (order, weight) = (f64::from(line.order), 10f64.powf(0.1 * line.snr_db));
        above += weight * order * at(line);
        below += weight * order * order;
    }
    (below > 0.0).then(|| above / below)
}

#[cfg(test)]
mod tests;
