//! Levels of a signal, whatever the verdict: RMS velocity with its zone, kurtosis and envelope of the band shown; and
//! as JSON.

use super::{Analysis, BandLevel, MachineClass, NoVelocity, NoZone, Unit, Zone, band_level, severity, shares};
use crate::{Band, Estimate, InUnit, Written, objects};
use serde::Serialize;
use serde_json::Value;

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

objects! {
    /// [`Levels`] in the JSON.
    Severity<'a> {
        velocity_rms_10_1000_hz: Velocity<'a>, iso_20816_3: Option<InClass>, band_shown: Option<BandShown<'a>>,
    }
    /// The zone of a machine of this class, or why it has none.
    InClass {
        machine_class: &'static str, boundaries_mm_per_s: [f64; 3], zone: Option<&'static str>, why: Option<String>,
    }
    /// [`BandLevel`] with units.
    BandShown<'a> {
        #[serde(flatten)] band: Band,
        kurtosis: InUnit<'a>, envelope_rms: InUnit<'a>, envelope_peak: InUnit<'a>,
    }
}

/// RMS velocity, or why there is none.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum Velocity<'a> {
    Known(InUnit<'a>),
    Unknown { value: (), why: String },
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
        let of = |e: Estimate, unit| InUnit { number: e.into(), unit };
        let why = match (&self.velocity, self.zone) {
            (Err(why), _) => Some(why.to_string()),
            (_, zone) => zone.and_then(Result::err).map(|why| why.to_string()),
        };
        let severity = Severity {
            velocity_rms_10_1000_hz: match &self.velocity {
                Ok(v) => Velocity::Known(InUnit { number: Written::from(*v).times(1e3), unit: "mm/s" }),
                Err(why) => Velocity::Unknown { value: (), why: why.to_string() },
            },
            iso_20816_3: self.class.map(|class| InClass {
                machine_class: class.name(),
                boundaries_mm_per_s: class.boundaries(),
                zone: self.letter(),
                why,
            }),
            band_shown: self.band.map(|b| BandShown {
                band: b.band,
                kurtosis: of(b.kurtosis, ""),
                envelope_rms: of(b.envelope_rms, &unit.name),
                envelope_peak: of(b.envelope_peak, &unit.name),
            }),
        };
        serde_json::to_value(severity).unwrap_or_default()
    }
}
