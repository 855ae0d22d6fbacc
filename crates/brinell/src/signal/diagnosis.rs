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

use super::distribution::chi_square_tail;
use super::error::{SignalError, require};
use super::lines::{Floor, Line, LineSet, harmonics, sidebands};
use super::spectrum::Spectrum;

/// Smallest chance that a single line contributes.
const CAP: f64 = 1e-5;
/// A single line stands where noise would show as much less often than this.
const LINE_LEVEL: f64 = 1e-3;
/// Lines closer than this, in bins, are one.
const SAME_LINE: f64 = 1.5;
/// Orders of harmonics and sidebands to which a comb is followed when it comes to whose a line may be.
const FARTHEST_ORDER: i32 = 20;
/// Lines are explained where they would lie on the combs by chance less often than this.
const COINCIDENCE: f64 = 0.05;
/// Sidebands are told from their carrier from this many bins on.
const CLOSEST_SIDEBAND: f64 = 5.0;

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

/// What to look for about each candidate, and how sure to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiagnosisOptions {
    /// Harmonics of each candidate, the fundamental included; 2 or more.
    pub harmonics: usize,
    /// Sidebands to either side of each harmonic.
    pub sidebands: usize,
    /// Largest false-alarm probability, over all candidates, at which one is said to stand; above 0 to below 1.
    pub level: f64,
}

impl Default for DiagnosisOptions {
    /// Five harmonics, two sidebands to either side, 1 %.
    fn default() -> Self {
        DiagnosisOptions {
            harmonics: 5,
            sidebands: 2,
            level: 0.01,
        }
    }
}

/// Sidebands of a candidate's harmonics.
#[derive(Debug, Clone, PartialEq)]
pub struct SidebandEvidence {
    /// Distance, Hz.
    pub spacing: f64,
    /// About each harmonic in turn; those that fall on the candidate's own harmonics are left out.
    pub lines: Vec<Line>,
    /// How many stand by themselves (chance under noise below 1e-3).
    pub standing: usize,
    /// Chance that noise shows as much in all of them together, for any candidate of the list.
    pub false_alarm: f64,
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
    /// Upper bound of the chance that noise alone shows such harmonics for any candidate of the list; 1 where none of its
    /// lines lies within the spectrum. Its complement is the confidence that there is more than noise.
    pub false_alarm: f64,
    /// Its sidebands, where it has a spacing wide enough to resolve.
    pub sidebands: Option<SidebandEvidence>,
    /// Whether it stands: false alarm at most the level, and at least two harmonics stand by themselves.
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
        let sidebands = self.sidebands.iter().flat_map(|s| &s.lines);
        (self.harmonics.lines.iter().chain(sidebands))
            .filter(|l| l.false_alarm <= LINE_LEVEL)
            .map(|l| l.snr_db * 0.1 * std::f64::consts::LN_10)
            .sum()
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
    let floor = Floor::new(spectrum)?;
    let count = candidates.len() as f64;
    let mut evidence = Vec::with_capacity(candidates.len());
    for (index, candidate) in candidates.iter().enumerate() {
        // Checks the candidate, too.
        harmonics(spectrum, candidate.frequency, candidate.tolerance, 1)?;
        evidence.push(examine(spectrum, &floor, index, candidate, options, count)?);
    }
    let mut ranking: Vec<usize> = (0..evidence.len())
        .filter(|i| evidence[*i].stands)
        .collect();
    ranking.sort_by(|a, b| evidence[*b].weight().total_cmp(&evidence[*a].weight()));

    explain(&mut evidence, &ranking, spectrum, options);
    Ok(Diagnosis {
        level: options.level,
        evidence,
        ranking,
    })
}

/// Says of those that stand whose lines theirs may be.
fn explain(
    evidence: &mut [Evidence],
    ranking: &[usize],
    spectrum: &Spectrum,
    options: &DiagnosisOptions,
) {
    let (step, bins) = (spectrum.frequency_step, spectrum.amplitude.len());
    // Harmonics alone cover little and so explain more; then with sidebands.
    let combs: [Vec<Vec<bool>>; 2] = [false, true].map(|wide| {
        let of = |i: &usize| comb(&evidence[*i], spectrum, options, wide);
        ranking.iter().map(of).collect()
    });
    for (rank, &i) in ranking.iter().enumerate() {
        let mine: Vec<usize> = (evidence[i].harmonics.standing(LINE_LEVEL))
            .map(|l| ((l.frequency / step).round() as usize).min(bins - 1))
            .collect();
        let held = |marks: &[bool]| mine.iter().filter(|bin| marks[**bin]).count();
        let others = (ranking.iter().zip(&combs[1])).map(|(j, marks)| (*j, held(marks)));
        let alternatives = others.filter(|(j, held)| *j != i && *held > 0).collect();
        let end = mine.iter().max().map_or(0, |bin| bin + 1);
        let explained = combs.iter().find_map(|combs| {
            let better = (0..rank)
                .filter(|r| evidence[ranking[*r]].explained_by.is_empty() && held(&combs[*r]) > 0);
            let by: Vec<usize> = better.collect();
            let marked = |bin: usize| by.iter().any(|r| combs[*r][bin]);
            let covered = (0..end).filter(|bin| marked(*bin)).count() as f64 / end.max(1) as f64;
            let unlikely = covered.powi(mine.len() as i32) <= COINCIDENCE;
            (unlikely && mine.iter().all(|bin| marked(*bin)))
                .then(|| by.iter().map(|r| ranking[*r]).collect())
        });
        evidence[i].alternatives = alternatives;
        evidence[i].explained_by = explained.unwrap_or_default();
    }
}

/// The bins that a candidate's comb may fill, its sidebands among them if `wide`.
fn comb(
    evidence: &Evidence,
    spectrum: &Spectrum,
    options: &DiagnosisOptions,
    wide: bool,
) -> Vec<bool> {
    let mut marks = vec![false; spectrum.amplitude.len()];
    let mut mark = |frequency: f64| {
        let at = frequency / spectrum.frequency_step;
        let first = (at - SAME_LINE).ceil().max(0.0) as usize;
        let end = ((at + SAME_LINE).floor() + 1.0).clamp(0.0, marks.len() as f64) as usize;
        if first < end {
            marks[first..end].fill(true);
        }
    };
    (1..=FARTHEST_ORDER).for_each(|h| mark(f64::from(h) * evidence.frequency));
    let sidebands = evidence.sidebands.as_ref();
    if let Some(sidebands) = sidebands.filter(|s| wide && s.false_alarm <= options.level) {
        for h in 0..=options.harmonics {
            for m in -FARTHEST_ORDER..=FARTHEST_ORDER {
                mark(h as f64 * evidence.frequency + f64::from(m) * sidebands.spacing);
            }
        }
    }
    marks
}

fn examine(
    spectrum: &Spectrum,
    floor: &Floor,
    index: usize,
    candidate: &Candidate,
    options: &DiagnosisOptions,
    candidates: f64,
) -> Result<Evidence, SignalError> {
    let step = spectrum.frequency_step;
    let scores = Scores::new(floor, candidate, options.harmonics, step);
    let (place, chance) = scores.best(candidate, step);
    let found = harmonics(spectrum, place, 0.0, options.harmonics)?;
    let standing = found.standing(LINE_LEVEL).count();
    let frequency = common_frequency(&found).unwrap_or(place);
    let false_alarm = (chance * candidates).min(1.0);
    let spacing = candidate.sideband_spacing.filter(|_| options.sidebands > 0);
    let sidebands = match spacing {
        Some(spacing) => about(spectrum, frequency, spacing, options, candidates)?,
        None => None,
    };
    Ok(Evidence {
        candidate: index,
        frequency,
        standing,
        false_alarm,
        stands: false_alarm <= options.level && standing >= 2,
        harmonics: found,
        sidebands,
        alternatives: Vec::new(),
        explained_by: Vec::new(),
    })
}

fn about(
    spectrum: &Spectrum,
    frequency: f64,
    spacing: f64,
    options: &DiagnosisOptions,
    candidates: f64,
) -> Result<Option<SidebandEvidence>, SignalError> {
    let step = spectrum.frequency_step;
    let mut lines = Vec::new();
    for h in 1..=options.harmonics {
        let carrier = h as f64 * frequency;
        let tolerance = step.min(0.4 * spacing);
        let set = sidebands(spectrum, carrier, spacing, tolerance, options.sidebands)?;
        lines.extend(set.lines.into_iter().filter(|l| {
            let order = (l.expected / frequency).round();
            (l.expected - order * frequency).abs() >= CLOSEST_SIDEBAND * step
        }));
    }
    if lines.is_empty() {
        return Ok(None);
    }
    let statistic: f64 = lines
        .iter()
        .map(|l| -2.0 * l.false_alarm.max(CAP).ln())
        .sum();
    let chance = chi_square_tail(statistic, 2.0 * lines.len() as f64);
    Ok(Some(SidebandEvidence {
        spacing,
        standing: lines.iter().filter(|l| l.false_alarm <= LINE_LEVEL).count(),
        lines,
        false_alarm: (chance * candidates).min(1.0),
    }))
}

/// The fundamental by least squares from the harmonics that stand, each weighted by its power over noise.
fn common_frequency(found: &LineSet) -> Option<f64> {
    let (mut above, mut below) = (0.0, 0.0);
    for line in found.standing(LINE_LEVEL) {
        let (order, weight) = (f64::from(line.order), 10f64.powf(0.1 * line.snr_db));
        above += weight * order * line.frequency;
        below += weight * order * order;
    }
    (below > 0.0).then(|| above / below)
}

/// A harmonic and the bins in which it may lie.
struct Row {
    order: f64,
    first: usize,
    /// -2 ln p of each bin, p capped.
    scores: Vec<f64>,
    /// Power over noise of each bin.
    ratios: Vec<f64>,
}

impl Row {
    /// The place of the bin nearest to the harmonic of `frequency`.
    fn place(&self, frequency: f64, step: f64) -> usize {
        let bin = (self.order * frequency / step).round() as usize;
        bin.saturating_sub(self.first).min(self.scores.len() - 1)
    }
}

/// Harmonics within the spectrum.
struct Scores {
    rows: Vec<Row>,
}

impl Scores {
    fn new(floor: &Floor, candidate: &Candidate, harmonics: usize, step: f64) -> Self {
        let rows = (1..=harmonics).filter_map(|h| {
            let order = h as f64;
            let (middle, reach) = (order * candidate.frequency, order * candidate.tolerance);
            let first = floor.bin(middle - reach - 0.5 * step)?;
            let last = floor.bin(middle + reach + 0.5 * step)?;
            let level = floor.level(first, last);
            let powers = (first..=last).map(|k| floor.power(k));
            Some(Row {
                order,
                first,
                scores: (powers.clone())
                    .map(|p| -2.0 * floor.chance(p, level).max(CAP).ln())
                    .collect(),
                ratios: powers.map(|p| p / level.power).collect(),
            })
        });
        Scores {
            rows: rows.collect(),
        }
    }

    /// The common frequency (Hz) at which the harmonics stand highest together, and the chance of that under noise,
    /// corrected for the places tried.
    fn best(&self, candidate: &Candidate, step: f64) -> (f64, f64) {
        let Some(highest) = self.rows.last() else {
            return (candidate.frequency, 1.0);
        };
        // Half a bin at the highest harmonic from one place to the next.
        let steps = (candidate.tolerance * highest.order / (0.5 * step)).ceil();
        let frequencies = (-(steps as i64)..=steps as i64)
            .map(|i| candidate.frequency + candidate.tolerance * i as f64 / steps.max(1.0));
        let mut places: Vec<(f64, Vec<usize>)> = frequencies
            .map(|f| (f, self.rows.iter().map(|r| r.place(f, step)).collect()))
            .collect();
        places.dedup_by(|a, b| a.1 == b.1);
        let sum = |bins: &[usize], values: fn(&Row) -> &[f64]| -> f64 {
            (self.rows.iter().zip(bins))
                .map(|(row, bin)| values(row)[*bin])
                .sum()
        };
        let score = |p: &(f64, Vec<usize>)| sum(&p.1, |r| &r.scores);
        let ratio = |p: &(f64, Vec<usize>)| sum(&p.1, |r| &r.ratios);
        let top = places.iter().max_by(|a, b| score(a).total_cmp(&score(b)));
        let Some(top) = top else {
            return (candidate.frequency, 1.0);
        };
        let chance = chi_square_tail(score(top), 2.0 * self.rows.len() as f64);
        // The cap makes neighbouring places equal: of those within a bin, the one with the most power.
        let finest = (places.iter())
            .filter(|p| (p.0 - top.0).abs() <= step)
            .max_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        (
            finest.unwrap_or(top).0,
            (chance * places.len() as f64).min(1.0),
        )
    }
}

#[cfg(test)]
mod tests;
