//! Levels that machines do not have: unit or sensitivity may be wrong.

use crate::diagnosis::Diagnosis;
use crate::measurement::Measurement;
use brinell::analysis::{Quantity, STANDARD_GRAVITY};
use brinell::signal::{Indicator, short};

/// Acceleration above which a machine hardly vibrates, RMS, m/s²: ten times the most of 62 analyses of measured accelerations of
/// three test rigs, 0.0115 to 2.14 g.
const MOST_RMS: f64 = 20.0 * STANDARD_GRAVITY;

/// RMS velocity from 10 to 1000 Hz below which no running machine is expected, m/s: less than half the least of the same records, 0.124 to
/// 1.29 mm/s.
const LEAST_VELOCITY: f64 = 5e-5;

/// Speeds from which that is said, Hz: a slower shaft moves a machine less.
const LEAST_SHAFT: f64 = 10.0;

/// A warning, where a measured level is far from those of machines, so that unit or sensitivity may be wrong. A factor of ten either way is
/// mostly not noticed: levels of sound machines differ by more.
pub(crate) fn improbable(measurement: &Measurement, of: &Diagnosis) -> Option<String> {
    let (unit, a) = (&measurement.unit.value, &of.analysis);
    if measurement.run.is_some() || unit.quantity != Quantity::Acceleration {
        return None;
    }
    let rms = a.indicator(Indicator::Rms)?.value * unit.to_si;
    let velocity = of.levels.velocity.as_ref().ok().map(|v| v.value);
    let (level, than) = match velocity {
        _ if rms > MOST_RMS => (
            format!("an RMS of {} g", short(rms / STANDARD_GRAVITY, 3)),
            "far above those of machines, as a rule up to a few g",
        ),
        Some(v) if v < LEAST_VELOCITY && a.shaft >= LEAST_SHAFT => (
            format!("an RMS velocity of {} mm/s", short(1e3 * v, 2)),
            "below those of running machines, as a rule 0.1 mm/s and more",
        ),
        _ => return None,
    };
    Some(format!("{level} is {than}: are unit and sensitivity right?"))
}
