//! A record beside one of the same machine when it was healthy: what has grown since, and what was there before.

use super::family::{Family, Standing};
use super::{Analysis, AnalysisError, Options, analyze, bands};
use crate::signal::Band;

/// Growth of the modulation from which lines that are no damage by themselves are told.
const GROWN: f64 = 2.0;
/// Part of the modulation that the healthy record shows already, from which lines say nothing of damage.
const BEFORE: f64 = 0.5;

/// A signal, its sample rate in Hz, and what is known of it.
#[derive(Debug, Clone, Copy)]
pub struct Signal<'a> {
    /// Samples.
    pub x: &'a [f64],
    /// Sample rate, Hz.
    pub fs: f64,
    /// Speed, bearing, tolerance.
    pub options: &'a Options,
}

impl Analysis {
    /// Judges again what was found in `own`, in view of a record of the `healthy` machine: damage whose lines modulate half as deep there is none
    /// ([`Standing::AsBefore`]), and lines that have at least doubled their modulation have grown ([`Standing::Grown`]).
    ///
    /// Families are compared in the range that both sample rates hold.
    ///
    /// # Errors
    /// As [`analyze()`].
    pub fn beside_healthy(&mut self, own: Signal, healthy: Signal) -> Result<(), AnalysisError> {
        let top = 0.5 * own.fs.min(healthy.fs);
        let [own, healthy] = [own, healthy].map(|signal| {
            let mut options = signal.options.clone();
            let low = bands::BROAD * bands::highest(&options);
            options.band = (options.band).or((low < top).then(|| Band::between(low, top)));
            analyze(signal.x, signal.fs, &options).map(|a| a.families)
        });
        let (own, healthy) = (own?, healthy?);
        let of = |families: &[Family], name| families.iter().find(|f| f.name == name).cloned();
        for family in &mut self.families {
            let both = of(&own, family.name).zip(of(&healthy, family.name));
            let Some((own, healthy)) = both else {
                continue;
            };
            let ratio = own.modulation / healthy.modulation.max(f64::MIN_POSITIVE);
            family.growth = Some(ratio);
            family.standing = match family.standing {
                Standing::Damage if healthy.is_damage() && ratio * BEFORE < 1.0 => {
                    Standing::AsBefore
                }
                Standing::Faint | Standing::Open if family.is_whole() && ratio >= GROWN => {
                    Standing::Grown
                }
                other => other,
            };
        }
        Ok(())
    }
}
