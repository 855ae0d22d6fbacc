//! From families to a verdict: which of them is damage, and which merely shares another's lines.

use super::family::{Family, Standing, cage, read};
use super::frequencies::Component;
use super::together::{Envelopes, Shaft, Together};
use super::{AnalysisError, Options};

/// Lead in score that an element needs over the races: its sidebands at the cage's frequency reach most lines.
const LEAD: f64 = 2.0;
/// Multiples of shaft and cage about the first's harmonics that are taken out before a second one is sought.
const SIDES: i32 = 3;
/// So many times the tolerance is looked through where nothing stands within it.
const FARTHER: f64 = 3.0;
/// Turns of the cage from which sidebands at its frequency are told from other lines: in a shorter record they fill the spectrum.
const TELLING: f64 = 20.0;

/// A family near a defect frequency, but farther from it than the tolerance: no verdict, a reason to doubt the speed or the bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Beyond {
    /// Its lines; `expected` is where pure rolling has it at the speed given.
    pub family: Family,
    /// The shaft speed at which the lines would be the component's in pure rolling, Hz.
    pub shaft: f64,
}

/// What was looked at and how long it is.
pub(super) struct Record<'a> {
    pub(super) together: Together,
    pub(super) revolutions: f64,
    /// Shaft speed, Hz.
    pub(super) shaft: f64,
    pub(super) options: &'a Options,
}

impl<'a> Record<'a> {
    pub(super) fn of(
        envelopes: &Envelopes,
        known: Shaft,
        options: &'a Options,
    ) -> Result<Self, AnalysisError> {
        let samples = envelopes.each.first().map_or(0, |(_, e)| e.values.len());
        let seconds = samples as f64 / envelopes.rate;
        Ok(Record {
            together: Together::of(envelopes, known, options)?,
            revolutions: seconds * known.hz,
            shaft: known.hz,
            options,
        })
    }

    fn read(&self, tolerance: f64) -> Vec<Family> {
        let Record {
            together,
            revolutions,
            shaft,
            options,
        } = self;
        read(together, *revolutions, *shaft, tolerance, options)
    }

    /// All families: those that are damage first, the one that leads before the others; what else stands after it.
    pub(super) fn families(&mut self) -> Vec<Family> {
        let mut all = self.read(self.options.tolerance);
        if self.is_short() {
            let elements = all.iter_mut().filter(|f| f.component == Component::Element);
            for element in elements.filter(|f| f.standing == Standing::Damage) {
                element.standing = Standing::Open;
            }
        }
        let Some(lead) = leading(&all) else {
            all.sort_by(|a, b| b.score.total_cmp(&a.score));
            return all;
        };
        let lead = all.remove(lead);
        self.take_out(lead.frequency);
        let left = self.read(self.options.tolerance);
        // Frequencies that slip may bring together are not told apart.
        let apart =
            |f: &Family| (f.expected / lead.expected - 1.0).abs() > 2.0 * self.options.tolerance;
        for family in &mut all {
            let own = left.iter().find(|f| f.name == family.name);
            let stays = own.is_some_and(Family::is_damage) && apart(family);
            let gone = own.is_none_or(|f| f.standing_harmonics() == 0);
            let shared = match family.standing {
                Standing::Damage | Standing::Open => family.component == Component::Cage || !stays,
                _ => gone && family.standing_harmonics() > 0,
            };
            if shared {
                family.standing = Standing::Shared(lead.name);
            }
        }
        let rank = |f: &Family| match f.standing {
            Standing::Damage => 0,
            _ => 1,
        };
        all.sort_by(|a, b| rank(a).cmp(&rank(b)).then(b.score.total_cmp(&a.score)));
        all.insert(0, lead);
        // What strikes once a turn of the cage is one element on its way through the load, more often than the cage.
        if all[0].component == Component::Cage && self.options.orders.bsf.is_some() {
            all[0].component = Component::Element;
        }
        all
    }

    /// A family of damage farther off than the tolerance. The cage's is left out: three times its tolerance holds too much else.
    pub(super) fn beyond(&self) -> Option<Beyond> {
        let wide = self.read(FARTHER * self.options.tolerance);
        let far = wide.into_iter().filter(|f| {
            f.component != Component::Cage
                && f.is_damage()
                && f.shift().abs() > self.options.tolerance
        });
        let family = far.max_by(|a, b| a.score.total_cmp(&b.score))?;
        Some(Beyond {
            shaft: self.shaft * family.frequency / family.expected,
            family,
        })
    }

    /// Whether the record holds so few turns of the cage that a rolling element's sidebands are not told from other lines.
    fn is_short(&self) -> bool {
        self.revolutions * cage(self.shaft, self.options) < TELLING * self.shaft
    }

    /// Harmonics of a frequency and their sidebands are nobody's from now on.
    fn take_out(&mut self, frequency: f64) {
        let cage = cage(self.shaft, self.options);
        let most = self.together.top();
        let mut k = 0.0;
        while k * frequency < most + f64::from(SIDES) * (self.shaft + cage) {
            for a in -SIDES..=SIDES {
                for b in -SIDES..=SIDES {
                    let at = k * frequency + f64::from(a) * self.shaft + f64::from(b) * cage;
                    if (0.0..most).contains(&at) {
                        self.together.hide(at);
                    }
                }
            }
            k += 1.0;
        }
    }
}

/// The family that leads: the highest score; an element's or the cage's only with a lead over the races'.
fn leading(all: &[Family]) -> Option<usize> {
    let highest = |of: &dyn Fn(Component) -> bool| {
        let these = (all.iter().enumerate())
            .filter(|(_, f)| f.standing == Standing::Damage && of(f.component));
        these.max_by(|a, b| a.1.score.total_cmp(&b.1.score))
    };
    let race = highest(&|c| matches!(c, Component::OuterRace | Component::InnerRace));
    let turning = highest(&|c| matches!(c, Component::Element | Component::Cage));
    match (race, turning) {
        (Some(race), Some(turning)) if turning.1.score > race.1.score + LEAD => Some(turning.0),
        (Some(race), _) => Some(race.0),
        (None, turning) => turning.map(|t| t.0),
    }
}
