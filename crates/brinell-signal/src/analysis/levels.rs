//! Levels of a signal, whatever the verdict: RMS velocity with its zone, kurtosis and envelope of the band shown; and
//! as JSON.

use super::{Analysis, BandLevel, MachineClass, NoVelocity, NoZone, Unit, Zone, band_level, severity, shares};
use crate::{Estimate, InUnit, Written};
use serde_json::{Value, json};

/// Levels of one signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Levels {
    /// RMS velocity, m/s.
    pub velocity: Result<Estimate, NoVelocity>,
    /// The class that was given.
    pub class: Option<MachineClass>,
    /// Where class and velocity are known.
    pub zone: Option<Result<Zone, NoZone>>,
    /// Of the band shown.
    pub band: Option<BandLevel>,
}

impl Levels {
    /// Of the records in `unit` that were analysed: RMS values are root mean squares of theirs, others means.
    pub fn of(records: &[&[f64]], unit: &Unit, analysis: &Analysis, class: Option<MachineClass>) -> Self {
        let (fs, shaft) = (analysis.sample_rate, analysis.shaft);
        let shares = shares(records);
        let velocities = records.iter().zip(&shares).map(|(x, share)| Ok((severity(x, unit, fs, shaft)?, *share)));
        let velocity = velocities.collect::<Result<Vec<_>, _>>().map(|each| Estimate::pooled(&each, 2));
        let bands = records.iter().map(|x| band_level(x, fs, analysis.view.band, shaft));
        let band = bands.collect::<Option<Vec<BandLevel>>>().map(|each| {
            let pooled = |exponent, of: fn(&BandLevel) -> Estimate| {
                Estimate::pooled(&each.iter().map(of).zip(shares.iter().copied()).collect::<Vec<_>>(), exponent)
            };
            BandLevel {
                band: analysis.view.band,
                kurtosis: pooled(1, |b| b.kurtosis),
                envelope_rms: pooled(2, |b| b.envelope_rms),
                envelope_peak: pooled(1, |b| b.envelope_peak),
            }
        });
        let zone = |v: &Estimate, class: MachineClass| class.zone(v.value, 60.0 * shaft);
        Levels { zone: velocity.as_ref().ok().zip(class).map(|(v, c)| zone(v, c)), velocity, class, band }
    }

    /// The zone's letter, where it is known.
    pub fn letter(&self) -> Option<&'static str> {
        self.zone?.ok().map(Zone::name)
    }

    /// As `severity` of the JSON; `unit` is the signal's.
    pub fn to_json(&self, unit: &Unit) -> Value {
        let of =
            |e: &Estimate, factor: f64, unit: &str| json!(InUnit { number: Written::from(*e).times(factor), unit });
        let velocity = match &self.velocity {
            Ok(v) => of(v, 1e3, "mm/s"),
            Err(why) => json!({ "value": null, "why": why.to_string() }),
        };
        json!({
            "velocity_rms_10_1000_hz": velocity,
            "iso_20816_3": self.class.map(|class| json!({
                "machine_class": class.name(),
                "boundaries_mm_per_s": class.boundaries(),
                "zone": self.letter(),
                "why": match (&self.velocity, self.zone) {
                    (Err(why), _) => Some(why.to_string()),
                    (_, zone) => zone.and_then(Result::err).map(|why| why.to_string()),
                },
            })),
            "band_shown": self.band.map(|b| json!({
                "low_hz": b.band.low,
                "high_hz": b.band.high,
                "kurtosis": of(&b.kurtosis, 1.0, ""),
                "envelope_rms": of(&b.envelope_rms, 1.0, &unit.name),
                "envelope_peak": of(&b.envelope_peak, 1.0, &unit.name),
            })),
        })
    }
}
