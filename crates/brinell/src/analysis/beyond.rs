//! Where nothing stands within the tolerance: what stands beyond it, which a wrong speed would explain.

use super::frequencies::Component;
use super::verdict::LINE_LEVEL;
use super::view::{View, candidates, looking, side_by_side};
use super::{AnalysisError, Options};
use crate::signal::{Evidence, diagnose_beside};

/// So many times the tolerance is looked through.
const FARTHER: f64 = 3.0;
/// Modulation below which lines say nothing: the load on a healthy race changes with every element, and a long record shows that.
const FAINT: f64 = 0.015;
/// Fewest harmonics that say anything: two lines in so wide a range are soon somebody's.
const FEWEST: usize = 3;

/// A family of lines near a defect frequency, but farther from it than the tolerance: no verdict, a reason to doubt the speed or
/// the bearing.
#[derive(Debug, Clone)]
pub struct Beyond {
    /// What would be struck.
    pub component: Component,
    /// Name of its frequency: `BPFO`.
    pub name: &'static str,
    /// Where pure rolling has it, Hz.
    pub expected: f64,
    /// Its lines; `frequency` is where they stand.
    pub evidence: Evidence,
    /// Chance that noise alone shows as much anywhere that was searched: an upper bound.
    pub false_alarm: f64,
    /// The shaft speed at which the lines would be the component's in pure rolling, Hz.
    pub shaft: f64,
}

impl Beyond {
    /// Distance from the expected frequency, relative.
    pub fn distance(&self) -> f64 {
        self.evidence.frequency / self.expected - 1.0
    }

    /// Orders of the harmonics that stand.
    pub fn standing(&self) -> impl Iterator<Item = i32> {
        (self.evidence.harmonics.standing(LINE_LEVEL)).map(|l| l.order)
    }
}

/// What stands most clearly in a search of [`FARTHER`] times the tolerance, outside of it.
///
/// The cage's frequency is left out: three times its tolerance holds too much else.
pub(super) fn find(
    views: &[View],
    shaft: f64,
    options: &Options,
) -> Result<Option<Beyond>, AnalysisError> {
    let within = candidates(shaft, options);
    let wide = Options {
        tolerance: FARTHER * options.tolerance,
        ..options.clone()
    };
    let sought: Vec<_> = candidates(shaft, &wide).into_iter().map(|c| c.2).collect();
    let looking = looking(options, views.len() as f64);
    let mut best: Option<Beyond> = None;
    let diagnoses = side_by_side(views, |view| {
        Ok(diagnose_beside(
            &view.searched,
            &sought,
            &looking,
            &view.removed,
        )?)
    })?;
    for (view, diagnosis) in views.iter().zip(diagnoses) {
        for evidence in diagnosis.causes() {
            let (component, name, near) = &within[evidence.candidate];
            let off = (evidence.frequency - near.frequency).abs();
            let faint = evidence.modulation() < FAINT * view.mean;
            let few = evidence.standing < FEWEST;
            if *component == Component::Cage || off <= near.tolerance || faint || few {
                continue;
            }
            let false_alarm = (evidence.false_alarm * views.len() as f64).min(1.0);
            if best.as_ref().is_none_or(|b| false_alarm < b.false_alarm) {
                best = Some(Beyond {
                    component: *component,
                    name,
                    expected: near.frequency,
                    false_alarm,
                    shaft: shaft * evidence.frequency / near.frequency,
                    evidence: evidence.clone(),
                });
            }
        }
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    use super::super::{NamedBearing, analyze};
    use super::*;
    use crate::signal::test_signals::ImpactTrain;

    const SHAFT_HZ: f64 = 30.0;
    const BPFO: f64 = 3.5848;

    fn signal(height: f64, seed: u64) -> Vec<f64> {
        let train = ImpactTrain {
            fs: 12_000.0,
            rate: BPFO * SHAFT_HZ,
            jitter: 0.01,
            resonance: 3_000.0,
            decay: 4e-4,
            noise: 0.1 / height,
        };
        train.generate(12_000, seed)
    }

    fn options(shaft: f64) -> Options {
        Options::new(shaft, NamedBearing::find("6205-2RS").unwrap().orders())
    }

    #[test]
    fn prop_a_wrong_speed_is_pointed_to_and_blamed_on_nobody() {
        for (k, wrong) in [0.96, 0.97, 1.03, 1.04].into_iter().enumerate() {
            let x = signal(1.0, k as u64);
            let told = analyze(&x, 12_000.0, &options(wrong * SHAFT_HZ)).unwrap();
            assert!(told.causes().next().is_none(), "{}", told.verdict());
            let beyond = told.beyond.as_ref().expect("lines beyond the tolerance");
            assert_eq!(beyond.name, "BPFO");
            assert!((beyond.shaft / SHAFT_HZ - 1.0).abs() < 5e-3, "{beyond:?}");
            assert!((beyond.distance() * wrong - (1.0 - wrong)).abs() < 5e-3);
            assert!(told.verdict().contains("is the speed right"));
        }
    }

    #[test]
    fn prop_noise_has_nothing_beyond_and_neither_has_what_was_found() {
        // Of 60 records of noise at a level of 1 %, more than four by chance would be one in 100 000.
        let noise = (0..60).filter(|seed| {
            let x = signal(1e-6, 100 + seed);
            let told = analyze(&x, 12_000.0, &options(SHAFT_HZ)).unwrap();
            told.beyond.is_some()
        });
        assert!(noise.count() <= 4);
        let found = analyze(&signal(1.0, 0), 12_000.0, &options(SHAFT_HZ)).unwrap();
        assert!(found.causes().next().is_some() && found.beyond.is_none());
    }
}
