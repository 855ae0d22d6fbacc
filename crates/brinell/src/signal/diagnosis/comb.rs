//! How high the lines of a comb stand together, at the best place within a tolerance; and how high any comb does.

use super::super::distribution::chi_square_tail;
use super::super::lines::Floor;
use super::super::lines::LineSet;
use super::super::spectrum::Spectrum;
use super::{CAP, CLOSEST_SIDEBAND, Candidate, LINE_LEVEL, REACH, SidebandEvidence, mark};

/// Combs at other frequencies are tried from this share of the candidate's frequency to its inverse: an octave and a bit.
const FARTHEST: f64 = 0.62;
/// Of those, at most so many.
const MOST: usize = 40;
/// Fewest that say anything.
const FEWEST: usize = 8;
/// Quantile of what they show.
const QUANTILE: f64 = 0.75;

/// Power over noise from which a line counts among those that stand.
const STANDS: f64 = 9.0;
/// A comb dwarfs another with so many times its power.
const DWARFED: f64 = 2.0;
/// Share of the distance between harmonics within which lines surround one.
const CLOSE: f64 = 0.2;

/// A comb: harmonics, and the nearest sidebands of each.
#[derive(Clone, Copy)]
pub(super) struct Sought {
    pub(super) frequency: f64,
    pub(super) tolerance: f64,
    pub(super) spacing: Option<f64>,
    pub(super) harmonics: usize,
}

/// The best place.
pub(super) struct Best {
    /// Hz.
    pub(super) frequency: f64,
    /// Chance that noise shows as much at any of the places tried.
    pub(super) chance: f64,
    /// Power of its lines that stand above the noise, sidebands included.
    pub(super) power: f64,
}

/// A line of the comb and the bins in which it may lie.
struct Row {
    order: f64,
    /// Distance from its harmonic, Hz.
    offset: f64,
    first: usize,
    /// -2 ln p of each bin, p capped; NaN where the bin is hidden.
    scores: Vec<f64>,
    /// Power over noise of each bin.
    ratios: Vec<f64>,
    /// Power of the noise.
    noise: f64,
}

impl Row {
    fn new(floor: &Floor, sought: &Sought, order: f64, offset: f64) -> Option<Self> {
        let step = floor.step();
        let (middle, reach) = (
            order * sought.frequency + offset,
            order * sought.tolerance + 0.5 * step,
        );
        let first = floor.bin(middle - reach)?;
        let last = floor.bin(middle + reach)?;
        let level = floor.level(first, last);
        let chance = floor.chance(level);
        let powers = (first..=last).map(|k| floor.power(k));
        Some(Row {
            order,
            offset,
            first,
            scores: (first..=last)
                .map(|k| match floor.hides(k) {
                    true => f64::NAN,
                    false => -2.0 * chance(floor.power(k)).max(CAP).ln(),
                })
                .collect(),
            ratios: powers.map(|p| p / level.power).collect(),
            noise: level.power,
        })
    }

    /// The place of the bin nearest to the line of the comb of `frequency`.
    fn place(&self, frequency: f64, step: f64) -> usize {
        let bin = ((self.order * frequency + self.offset) / step).round() as usize;
        bin.saturating_sub(self.first).min(self.scores.len() - 1)
    }
}

/// The common frequency at which the lines stand highest together: the harmonics alone, or with their sidebands. `None` where
/// most of them are hidden at every place, or none lies within the spectrum.
pub(super) fn best(floor: &Floor, sought: &Sought) -> Option<Best> {
    let step = floor.step();
    let mut rows: Vec<Row> = (1..=sought.harmonics)
        .filter_map(|h| Row::new(floor, sought, h as f64, 0.0))
        .collect();
    let harmonics = rows.len();
    let highest = rows.last().map(|r| r.order)?;
    if let Some(spacing) = sought.spacing.filter(|s| *s >= CLOSEST_SIDEBAND * step) {
        for h in 1..=harmonics {
            for offset in [-spacing, spacing] {
                // One that lies on a harmonic says nothing of its own.
                let at = h as f64 + offset / sought.frequency;
                let apart = (at - at.round()).abs() * sought.frequency;
                if apart >= CLOSEST_SIDEBAND * step {
                    rows.extend(Row::new(floor, sought, h as f64, offset));
                }
            }
        }
    }
    // Half a bin at the highest harmonic from one place to the next.
    let steps = (sought.tolerance * highest / (0.5 * step)).ceil();
    let mut places: Vec<(f64, Vec<usize>)> = (-(steps as i64)..=steps as i64)
        .map(|i| sought.frequency + sought.tolerance * i as f64 / steps.max(1.0))
        .map(|f| (f, rows.iter().map(|r| r.place(f, step)).collect()))
        .collect();
    places.dedup_by(|a, b| a.1 == b.1);
    let sum = |place: &(f64, Vec<usize>), count: usize, values: fn(&Row) -> &[f64]| -> f64 {
        (rows.iter().zip(&place.1).take(count))
            .map(|(row, bin)| values(row)[*bin])
            .sum()
    };
    let of = |count: usize| {
        // The highest sum for each number of lines that are not hidden: fewer than half say nothing of the comb.
        let mut tops: Vec<Option<(f64, f64)>> = vec![None; count + 1];
        for place in &places {
            let scores = (rows.iter().zip(&place.1).take(count)).map(|(r, bin)| r.scores[*bin]);
            let (seen, score) = (scores.filter(|s| !s.is_nan()))
                .fold((0, 0.0), |(n, sum), score| (n + 1, sum + score));
            let top = &mut tops[seen];
            if 2 * seen >= count && top.is_none_or(|t| score >= t.0) {
                *top = Some((score, place.0));
            }
        }
        let (chance, top) = (tops.iter().enumerate())
            .filter_map(|(n, top)| top.map(|t| (chi_square_tail(t.0, 2.0 * n as f64), t)))
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        // The cap makes neighbouring places equal: of those within a bin, the one with the most power.
        let finest = (places.iter())
            .filter(|p| (p.0 - top.1).abs() <= step)
            .map(|p| (sum(p, count, |r| &r.ratios), p.0))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        Some(Best {
            frequency: finest.map_or(top.1, |f| f.1),
            chance,
            power: 0.0,
        })
    };
    let alone = of(harmonics);
    let wide = (rows.len() > harmonics).then(|| of(rows.len())).flatten();
    let ways = if wide.is_some() { 2.0 } else { 1.0 };
    let better = [alone, wide]
        .into_iter()
        .flatten()
        .min_by(|a, b| a.chance.total_cmp(&b.chance));
    better.map(|b| {
        // Of so many tries, taken as independent; exact for the small chances too.
        let tries = ways * places.len() as f64;
        let any = -(tries * (-b.chance.min(1.0 - 1e-15)).ln_1p()).exp_m1();
        Best {
            frequency: b.frequency,
            chance: any.clamp(f64::MIN_POSITIVE, 1.0),
            power: (rows.iter())
                .map(|r| (r.ratios[r.place(b.frequency, step)], r.noise))
                .filter(|(ratio, _)| *ratio >= STANDS)
                .map(|(ratio, noise)| ratio * noise)
                .sum(),
        }
    })
}

/// A spectrum without what lies close to the harmonics of a frequency (Hz): whatever modulates damage surrounds its lines, and
/// not all that does is known. Brought down to the median of the rest.
pub(super) fn beside(mut spectrum: Spectrum, frequency: f64) -> Spectrum {
    let step = spectrum.frequency_step;
    let close = |bin: usize| {
        let order = bin as f64 * step / frequency;
        order > 0.5 && (order - order.round()).abs() <= CLOSE
    };
    let mut rest: Vec<f64> = (spectrum.amplitude.iter().enumerate())
        .filter(|(bin, _)| !close(*bin))
        .map(|(_, a)| *a)
        .collect();
    if rest.is_empty() {
        return spectrum;
    }
    let middle = rest.len() / 2;
    let median = *rest.select_nth_unstable_by(middle, f64::total_cmp).1;
    for (bin, a) in spectrum.amplitude.iter_mut().enumerate() {
        if close(bin) {
            *a = a.min(median);
        }
    }
    spectrum
}

/// The bins of a source's own lines, wherever they lie: of each order h that stands, and of 0, the places h f + m s with s the spacing
/// of its sidebands and m any whole number. None where nothing modulates it.
///
/// A source that turns makes lines at all of n f + m s. Without noise they stand far beyond the nearest sidebands, and a comb at
/// f' = f + k s has the very same lines: held against such combs, the source would be held against itself.
pub(super) fn family(
    floor: &Floor,
    frequency: f64,
    harmonics: &LineSet,
    sidebands: Option<&SidebandEvidence>,
) -> Vec<bool> {
    let step = floor.step();
    let mut marks = vec![false; floor.spectrum().amplitude.len()];
    let Some(sidebands) = sidebands.filter(|s| s.spacing >= CLOSEST_SIDEBAND * step) else {
        return marks;
    };
    let carriers = harmonics.standing(LINE_LEVEL).map(|l| l.expected);
    let carried = (sidebands.lines.iter())
        .filter(|l| l.false_alarm <= LINE_LEVEL)
        .map(|l| l.expected - f64::from(l.order) * sidebands.spacing);
    let mut orders: Vec<i64> = (carriers.chain(carried))
        .map(|f| (f / frequency).round() as i64)
        .chain([0])
        .collect();
    orders.sort_unstable();
    orders.dedup();
    let apart = sidebands.spacing / step;
    for order in orders {
        let lowest = (order as f64 * frequency / step).rem_euclid(apart);
        let count = (marks.len() as f64 / apart) as usize + 1;
        for middle in (0..=count).map(|m| lowest + m as f64 * apart) {
            mark(&mut marks, middle, REACH);
        }
    }
    marks
}

/// By how much combs of the same kind at frequencies that nobody asked for stand higher than in noise: the upper quartile
/// of -ln(chance) over that of noise, 1 at the least.
///
/// Other machines' lines, skirts and noise that is not smooth raise every comb. As in genomic control (B. Devlin, K. Roeder,
/// Biometrics 55 (1999) 997-1004), a candidate's evidence is deflated by what arbitrary ones show. `None` where too few can be
/// looked at.
pub(super) fn crowding(floor: &Floor, sought: &Sought, candidates: &[Candidate]) -> Option<f64> {
    let mut shown: Vec<f64> = (others(sought, candidates).iter())
        .filter_map(|other| Some(-best(floor, other)?.chance.ln()))
        .collect();
    if shown.len() < FEWEST {
        return None;
    }
    let at = (QUANTILE * (shown.len() - 1) as f64).round() as usize;
    let upper = *shown.select_nth_unstable_by(at, f64::total_cmp).1;
    Some((upper / -(1.0 - QUANTILE).ln()).max(1.0))
}

/// Whether lines of such power dwarf those of any comb of the same kind at a frequency that nobody asked for.
pub(super) fn dwarfs(floor: &Floor, sought: &Sought, candidates: &[Candidate], power: f64) -> bool {
    let around = 1.5 * sought.spacing.unwrap_or(0.0);
    let mut shown = 0;
    let all = (others(sought, candidates).iter())
        .filter(|o| (o.frequency - sought.frequency).abs() > around)
        .filter_map(|o| Some(best(floor, o)?.power))
        .inspect(|_| shown += 1)
        .all(|other| DWARFED * other <= power);
    all && shown >= FEWEST
}

/// The same comb at other frequencies, apart from each other and from every candidate.
fn others(sought: &Sought, candidates: &[Candidate]) -> Vec<Sought> {
    let relative = sought.tolerance / sought.frequency;
    let span = -2.0 * FARTHEST.ln();
    let apart = (span / MOST as f64).max(2.0 * relative);
    let count = (span / apart) as i32;
    (0..=count)
        .map(|i| sought.frequency * FARTHEST * (apart * f64::from(i)).exp())
        .filter(|f| {
            candidates
                .iter()
                .all(|c| (c.frequency - f).abs() > c.tolerance + relative * f)
        })
        .map(|frequency| Sought {
            frequency,
            tolerance: relative * frequency,
            ..*sought
        })
        .collect()
}
