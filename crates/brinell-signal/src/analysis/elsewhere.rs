//! A comb of lines at no frequency of the bearing: another machine part's, another bearing's, or of another speed.

use super::family::{DEEP, FAINT, Family, SCORE, by_lines, cage, lag, lines, score, score_by};
use super::frequencies::Component;
use super::options::Options;
use super::together::{HARMONICS, Highest, Together};
use serde::Serialize;

/// So many times the tolerance off, a comb may be the bearing's at another speed.
const FARTHER: f64 = 3.0;
/// A comb elsewhere may have so much less than the score of the family that leads.
const HARDLY: f64 = 3.0;
/// Depth over that of the family that leads from which such a comb counts: the sidebands of a turning source may be as
/// deep as its own lines.
const DEEPER: f64 = 1.25;
/// And this score at least: of some ten thousand places the highest shows as much by chance.
const LEAST_ELSEWHERE: f64 = 8.0;
/// The lowest fundamental of such a comb, over the shaft's frequency. No raceway is passed more slowly.
const LOWEST: f64 = 1.5;
/// Harmonics of such a comb that the spectrum holds.
const FEWEST_HARMONICS: f64 = 3.0;
/// Of a comb so many times as slow at most, a race's lines may be every second, third...
pub(super) const SLOWER: usize = 8;
/// Multiples of the shaft's or the cage's frequency about the harmonics of damage that are its own.
pub(super) const SIDES: i32 = 3;
/// Bins within which two combs are one.
const WIDTH: f64 = 3.0;

/// A comb of lines that is deeper than any of the bearing's, where the bearing has no frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elsewhere {
    /// Its fundamental, Hz.
    pub frequency: f64,
    /// Its score.
    pub score: f64,
    /// Depth to which its lines modulate the envelopes, in the root mean square over all bands.
    pub modulation: f64,
    /// The frequency of the bearing that lies nearest, where that is within three tolerances.
    pub nearest: Option<Nearest>,
    /// Where the lines of the race that leads are every second, third... of its own: which race's, and which.
    pub every: Option<(&'static str, usize)>,
}

/// A frequency of the bearing near a comb, farther off than the tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Nearest {
    /// Whose.
    pub component: Component,
    /// `BPFO`, `BPFI` or `2 BSF`.
    pub name: &'static str,
    /// By how much the comb lies above it, relative.
    pub shift: f64,
    /// The shaft speed at which it would be there, Hz.
    #[serde(rename = "shaft_hz_if_its")]
    pub shaft: f64,
    /// The slip of the cage at which it would be, relative, where that is one.
    #[serde(rename = "slip_if_its")]
    pub slip: Option<f64>,
}

/// Where such a comb is sought.
pub(super) struct Search<'a> {
    pub(super) together: &'a Together,
    /// Shaft speed, Hz.
    pub(super) shaft: f64,
    /// Whether lines of the shaft told it.
    pub(super) by_lines: bool,
    pub(super) options: &'a Options,
}

impl Search<'_> {
    /// The deepest comb that is deeper than the family that leads and hardly lower in score, at no frequency of the
    /// bearing: then the bearing or the speed is not the one given, or the lines are another machine part's. Without a
    /// family that leads, one that would be damage.
    ///
    /// A simulation has nothing else that turns.
    pub(super) fn comb(&self, lead: Option<&Family>) -> Option<Elsewhere> {
        if self.options.orders.is_empty() {
            return self.of_unknown();
        }
        if self.options.exact {
            return None;
        }
        if let Some(slower) = lead.and_then(|lead| self.slower(lead)) {
            return Some(slower);
        }
        let together = self.together;
        let least = lead.map_or(SCORE, |l| (l.score - HARDLY).max(LEAST_ELSEWHERE));
        // A cage modulates whatever rolls, as deep as that goes: its depth says nothing against others.
        let shallow = match lead {
            Some(lead) if lead.component != Component::Cage => DEEPER * lead.modulation,
            Some(_) => DEEP,
            None => FAINT,
        };
        // Measured alike: with sidebands where the leading family has any.
        let spacing = lead.and_then(|l| l.sidebands.as_ref()).map(|s| s.spacing);
        let depth = |f: f64| lines(together, f, spacing).modulation;
        let places = self.places().filter(|f| score(together, *f) >= least && !self.is_explained(*f, lead));
        let highest = Highest::of(places, depth).filter(|h| h.height > shallow)?;
        let (frequency, modulation) = (by_lines(together, highest.middle()), highest.height);
        let (score, nearest) = (score(together, frequency), self.nearest(frequency));
        Some(Elsewhere { frequency, score, modulation, nearest, every: None })
    }

    /// Where a comb may have its fundamental.
    fn places(&self) -> impl Iterator<Item = f64> + use<> {
        let step = 0.25 * self.together.step() / HARMONICS as f64;
        let (lowest, top) = (LOWEST * self.shaft, self.together.top() / (FEWEST_HARMONICS + 0.5));
        (0..).map(move |k| lowest + f64::from(k) * step).take_while(move |f| *f < top)
    }

    /// Where the bearing is not known: of the combs that would be damage of a race the one whose product of score and depth is highest. (The
    /// deepest may be one of sidebands, k (f - f_shaft); the one that scores highest every second line of the race's.)
    fn of_unknown(&self) -> Option<Elsewhere> {
        let together = self.together;
        let depth = |f: f64| lines(together, f, None).modulation;
        let may_be = |f: &f64| score(together, *f) >= SCORE && depth(*f) > FAINT;
        let highest = Highest::of(self.places().filter(may_be), |f| score(together, f) * depth(f))?;
        let frequency = by_lines(together, highest.middle());
        let (score, modulation) = (score(together, frequency), depth(frequency));
        Some(Elsewhere { frequency, score, modulation, nearest: None, every: None })
    }

    /// The comb of which a race's lines are every second, third... and which scores hardly less: nothing that excites a
    /// race at equal distances leaves the lines between so high. (Where elements differ the cage's lines are there
    /// too: in measured records at most three quarters as high in score.)
    ///
    /// The shaft itself impacts at every fifth of BPFI where that is near five times its speed: where no lines told the
    /// speed, its own lines may be anywhere within the tolerance, and those that are hidden about the speed given
    /// count.
    fn slower(&self, lead: &Family) -> Option<Elsewhere> {
        let races = [Component::OuterRace, Component::InnerRace];
        if !races.contains(&lead.component) {
            return None;
        }
        let together = self.together;
        let height = |f: f64| match !self.by_lines && (f / self.shaft - 1.0).abs() <= self.options.tolerance {
            true => score_by(f, |f| together.unhidden(f)),
            false => score(together, f),
        };
        slower_comb(lead, SLOWER, height).map(|(frequency, score)| Elsewhere {
            frequency,
            score,
            modulation: lines(together, frequency, None).modulation,
            nearest: None,
            every: Some((lead.name, (lead.frequency / frequency).round() as usize)),
        })
    }

    fn nearest(&self, frequency: f64) -> Option<Nearest> {
        (self.options.orders.impacts())
            .map(|(component, name, order)| {
                let shift = frequency / (order * self.shaft) - 1.0;
                Nearest { component, name, shift, shaft: frequency / order, slip: lag(component, shift, self.options) }
            })
            .filter(|n| n.shift.abs() <= FARTHER * self.options.tolerance)
            .min_by(|a, b| a.shift.abs().total_cmp(&b.shift.abs()))
    }

    /// Whether a comb lies at a frequency of the bearing, or at lines that the damage of the family that leads has.
    fn is_explained(&self, frequency: f64, lead: Option<&Family>) -> bool {
        let width = WIDTH * self.together.step();
        let near = |at: f64| (frequency - at).abs() <= width;
        let own = |order: f64| {
            let at = order * self.shaft;
            (frequency - at).abs() <= self.options.tolerance * at + self.together.step()
        };
        let mut all = self.options.orders.defect_frequencies();
        let cage = cage(self.shaft, self.options);
        all.any(|(_, _, order)| own(order))
            || lead.is_some_and(|lead| {
                let f = lead.frequency;
                (2..=HARMONICS).any(|m| {
                    let m = m as f64;
                    near(m * f) || near(f / m)
                }) || near(f)
                    || lead.component == Component::Element
                        && (1..=SIDES).any(|k| {
                            let aside = f64::from(k) * cage;
                            near(f + aside) || near(f - aside)
                        })
            })
    }
}

/// The comb of which a family's lines are every second, third... to `most`th, and which scores hardly less: its
/// fundamental and score.
pub(super) fn slower_comb(family: &Family, most: usize, score: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
    let combs = (2..=most).map(|m| family.frequency / m as f64).map(|f| (f, score(f)));
    combs.rev().find(|(_, score)| *score >= family.score - HARDLY)
}
