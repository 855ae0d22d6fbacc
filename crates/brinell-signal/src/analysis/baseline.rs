//! A record beside one of the same machine when it was healthy: what has grown since, and what was there before.

use super::compare::{common_range, indicators_in};
use super::family::{Family, Finding};
use super::{Analysis, AnalysisError, Component, Options, Side, analyze, bands};
use crate::{Band, Indicator};

/// Growth of the modulation from which lines that are no damage by themselves are told.
const GROWN: f64 = 2.0;
/// Part of the modulation, and of the lines' level, that the healthy record shows already, from which lines say nothing
/// of damage.
const BEFORE: f64 = 0.5;

impl Analysis {
    /// Judges again what was found in `x`, in view of a record of the `healthy` machine in the same unit: damage whose
    /// lines modulate half as deep there, and are half as high, is none ([`Finding::AsBefore`]); lines that have at
    /// least doubled their modulation have grown ([`Finding::Grown`]).
    ///
    /// Families and levels are compared in the range that both sample rates hold. How high their lines are goes by modulation
    /// times the signal's RMS. A level that has merely risen says nothing of the part (load, speed and other parts raise
    /// it), so that it leaves the verdict open, as new impacts do ([`Analysis::unexplained`]).
    ///
    /// # Errors
    /// As [`analyze()`], and where the samples are fewer than were analysed.
    pub fn beside_healthy(&mut self, x: &[f64], healthy: Side) -> Result<(), AnalysisError> {
        [Side { x, analysis: self }, healthy].iter().try_for_each(Side::check)?;
        let top = 0.5 * self.sample_rate.min(healthy.analysis.sample_rate);
        let range = common_range(self, healthy.analysis);
        let levels = [Side { x, analysis: self }, healthy].map(|side| indicators_in(range, side));
        let both = |wanted| {
            let of = |k: usize| levels[k].iter().find(|(i, _)| *i == wanted).map(|(_, e)| e.value);
            Some([of(0)?, of(1)?])
        };
        let growth = both(Indicator::Rms).map_or(1.0, |[own, healthy]| own / healthy);
        (self.level_growth, self.level_range) = (Some(growth), range);
        self.kurtosis_beside = both(Indicator::Kurtosis);
        let louder = growth.max(1.0);
        let own = families_up_to(top, Side { x, analysis: self })?;
        let healthy = families_up_to(top, healthy)?;
        let of = |families: &[Family], name| families.iter().find(|f| f.name == name).cloned();
        for family in &mut self.families {
            let both = of(&own, family.name).zip(of(&healthy, family.name));
            let Some((own, healthy)) = both else {
                continue;
            };
            let ratio = own.modulation / healthy.modulation.max(f64::MIN_POSITIVE);
            family.growth = Some(ratio);
            let was_there = (healthy.is_damage() || healthy.masked) && !is_more(louder * ratio);
            let is_own = family.is_whole() || family.masked;
            family.finding = match family.finding {
                Finding::Damage if was_there => Finding::AsBefore,
                Finding::Open if (family.masked || family.others_slip.is_some()) && was_there => Finding::AsBefore,
                Finding::Faint | Finding::Open if is_own && ratio >= GROWN => Finding::Grown,
                other => other,
            };
        }
        Ok(())
    }

    /// Judges the outer race of a simulated bearing again, in view of the same bearing without its damage in the same
    /// unit at the same rate, `None` where nothing is damaged: rollers that enter the load strike the race at rest as
    /// often as its damage is struck (varying compliance). What is not twice as high as theirs is no damage.
    pub fn beside_healthy_run(&mut self, healthy: Option<&Analysis>) {
        let louder = healthy.map_or(1.0, |h| (rms(self) / rms(h)).max(1.0));
        for family in
            self.families.iter_mut().filter(|f| f.component == Component::OuterRace && f.finding == Finding::Damage)
        {
            let passing = match healthy {
                None => Some(family.modulation),
                Some(h) => h.families.iter().find(|f| f.name == family.name && f.is_damage()).map(|f| f.modulation),
            };
            family.growth = passing.map(|p| family.modulation / p.max(f64::MIN_POSITIVE));
            if family.growth.is_some_and(|ratio| !is_more(louder * ratio)) {
                family.finding = Finding::AsBefore;
            }
        }
        self.passing_known = true;
        let is_passing = |f: &Family| f.component == Component::OuterRace && f.finding == Finding::AsBefore;
        if let (Some(healthy), Some(passing)) = (healthy, self.families.iter().find(|f| is_passing(f)).map(|f| f.name))
        {
            // Damage that merely seemed to share the lines of passing rollers.
            let own = |f: &&mut Family| {
                f.finding == Finding::Shared(passing)
                    && f.is_damage()
                    && !healthy.families.iter().any(|h| h.name == f.name && h.is_damage())
            };
            let highest = self.families.iter_mut().filter(own).max_by(|a, b| a.score.total_cmp(&b.score));
            if let Some(family) = highest {
                family.finding = Finding::Damage;
            }
            self.families.sort_by_key(|f| f.finding != Finding::Damage);
        }
    }
}

fn rms(of: &Analysis) -> f64 {
    of.indicator(Indicator::Rms).map_or(1.0, |e| e.value)
}

/// Whether lines that are so many times as high as the healthy bearing's say something.
fn is_more(ratio: f64) -> bool {
    BEFORE * ratio >= 1.0
}

/// Families in the range up to `top` (Hz): what was found, where the signal holds no more.
fn families_up_to(top: f64, side: Side) -> Result<Vec<Family>, AnalysisError> {
    let Analysis { options, sample_rate, families, .. } = side.analysis;
    let low = bands::BROAD * bands::highest(options);
    if options.band.is_some() || 0.5 * sample_rate <= top || low >= top {
        return Ok(families.clone());
    }
    let options = Options { band: Some(Band::between(low, top)), ..options.clone() };
    Ok(analyze(side.x, *sample_rate, &options)?.families)
}
