//! What is tried in turn until one shows damage: the speed that the shaft's own lines tell, the speed as given, a speed
//! that drifts, and the lower parts of the range.

use super::drift::{self, Drift};
use super::family::{Family, Finding};
use super::known_lines::ShaftLines;
use super::together::{Envelopes, Paced, Shaft};
use super::verdict::Record;
use super::{AnalysisError, Options, bands};
use crate::Band;

/// How well the shaft's own lines tell its speed, relative: no less in a short record, where a comb placed within a bin
/// would slide onto lines of damage at its higher orders.
const SHAFT_KNOWN: f64 = 0.002;

/// What the samples tell of the speed.
pub(super) struct SpeedEvidence {
    /// By lines at the shaft's harmonics.
    pub(super) lines: Option<ShaftLines>,
    /// By the shaft's lines over time.
    pub(super) drift: Option<Drift>,
    /// Whether it may drift: it is not followed, and nothing is missing.
    pub(super) may_drift: bool,
}

/// The hypothesis that shows damage, or the first.
pub(super) struct Best {
    pub(super) record: Record,
    /// Of the range in which it was found.
    pub(super) envelopes: Envelopes,
    /// Harmonics of the shaft whose lines told the speed.
    pub(super) shaft_lines: Vec<usize>,
    pub(super) drift: Option<Drift>,
    /// What would be damage at the speed given, where the shaft's lines tell one beyond the tolerance.
    pub(super) at_given: Option<Family>,
}

/// Tries them.
pub(super) fn best(records: &[Paced], evidence: SpeedEvidence, options: &Options) -> Result<Best, AnalysisError> {
    let range = bands::range(records[0].0.sample_rate(), options)?;
    let (shaft, tolerance, shaft_lines) = match evidence.lines {
        Some(found) => (found.speed, SHAFT_KNOWN * found.speed, found.orders),
        None => (options.shaft, 0.0, Vec::new()),
    };
    let known = Shaft { hz: shaft, tolerance };
    let envelopes = Envelopes::of(records, range, shaft, options)?;
    let drift = match evidence.drift {
        None if shaft_lines.is_empty() && evidence.may_drift => drift::by_families(&envelopes, options),
        drift => drift,
    };
    let mut best =
        Best { record: Record::of(&envelopes, known, options)?, envelopes, shaft_lines, drift, at_given: None };
    if !best.shaft_lines.is_empty() && !best.record.is_damage() {
        best.try_as_given(options)?;
    }
    best.try_drift(options)?;
    if options.band.is_none() && !options.exact && !best.record.is_damage() {
        best.try_lower(records, range, tolerance)?;
    }
    Ok(best)
}

impl Best {
    /// Lines that agree by chance, or another shaft's, may have told a wrong speed. At a speed that is off, lines of
    /// the shaft are not hidden: only what is very clear counts. Where they lie beyond the tolerance, either the speed
    /// given is wrong or the lines are another shaft's: what would be damage is said.
    fn try_as_given(&mut self, options: &Options) -> Result<(), AnalysisError> {
        let given = Shaft { hz: options.shaft, tolerance: 0.0 };
        let as_given = Record::of(&self.envelopes, given, options)?;
        if options.is_other_speed(self.record.shaft) {
            self.at_given = as_given.lead().cloned();
            return Ok(());
        }
        let clear = |f: &Family| f.finding == Finding::Damage && f.is_very_clear();
        if as_given.families.iter().any(clear) {
            self.shaft_lines.clear();
            self.record = as_given;
        }
        Ok(())
    }

    /// Where the speed drifts, at equal angles of the shaft.
    fn try_drift(&mut self, options: &Options) -> Result<(), AnalysisError> {
        let Some(drift) = &mut self.drift else {
            return Ok(());
        };
        drift.smear = self.record.together.smear(&drift.course);
        // Lines of the bearing alone do not make up for a course that is wrong.
        if drift.leaves && drift.by != "shaft" {
            return Ok(());
        }
        let followed = Options { rotation: Some(drift.rotation()?), ..options.clone() };
        let known = Shaft { hz: drift.mean(), tolerance: SHAFT_KNOWN * drift.mean() };
        let at_angles = Record::of(&self.envelopes, known, &followed)?;
        if at_angles.evidence() > self.record.evidence() {
            drift.followed = true;
            self.record = at_angles;
        }
        Ok(())
    }

    /// At a high sample rate bands of mere noise hide those in which impacts ring.
    fn try_lower(&mut self, records: &[Paced], range: Band, tolerance: f64) -> Result<(), AnalysisError> {
        let known = Shaft { hz: self.record.shaft, tolerance };
        for part in bands::lower(range) {
            let envelopes = Envelopes::of(records, part, known.hz, &self.record.options)?;
            let record = Record::of(&envelopes, known, &self.record.options)?;
            if record.is_damage() {
                (self.record, self.envelopes) = (record, envelopes);
                break;
            }
        }
        Ok(())
    }
}
