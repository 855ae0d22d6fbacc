//! A record beside one of the same machine when it was healthy: what has grown since, and what was there before.

use super::family::{Family, Finding};
use super::{Analysis, AnalysisError, Options, Side, analyze, bands};
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
    /// Families are compared in the range that both sample rates hold. How high their lines are goes by modulation
    /// times the signal's RMS. A level that has merely risen says nothing of the part: load, speed and other parts
    /// raise it.
    ///
    /// # Errors
    /// As [`analyze()`].
    pub fn beside_healthy(&mut self, x: &[f64], healthy: Side) -> Result<(), AnalysisError> {
        let top = 0.5 * self.sample_rate.min(healthy.analysis.sample_rate);
        let rms = |a: &Analysis| a.indicator(Indicator::Rms).map_or(1.0, |e| e.value);
        let growth = rms(self) / rms(healthy.analysis);
        self.level_growth = Some(growth);
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
            family.finding = match family.finding {
                Finding::Damage if healthy.is_damage() && BEFORE * louder * ratio < 1.0 => Finding::AsBefore,
                Finding::Faint | Finding::Open if family.is_whole() && ratio >= GROWN => Finding::Grown,
                other => other,
            };
        }
        Ok(())
    }
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
