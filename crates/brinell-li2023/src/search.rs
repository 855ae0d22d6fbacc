//! A search for one set of assumptions: a unit cube over [`crate::RANGES`], what [`brinell_study::calibrate::fit`] is
//! to meet in it, and how far a set stays from the paper's figures.

use crate::numbers::Numbers;
use crate::outline::Outline;
use crate::ranges::{RANGES, READ_AS, RECORDS, Values};
use crate::reading::{Reading, Record};
use crate::{Verdict, claims, judge};
use brinell_study::calibrate::{Answer, Target};

/// Cases that every draw runs: the paper's three RMS values, at a seventh of the cost of all cases.
pub(crate) const SEARCHED: &[&str] = &["irregular", "simplified", "reference-simplified"];

/// The paper's RMS of each of [`SEARCHED`], m/s^2 (section 4.5).
pub(crate) const RMS: [f64; 3] = [30.414, 32.06, 29.01];
/// The paper's simulated defect frequency of the irregular shape, Hz (section 4.1.3).
pub(crate) const FREQUENCY: f64 = 249.40;

/// One set of assumptions.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Draw {
    /// Its number, from 1.
    pub number: usize,
    /// Where it lies in the unit cube.
    pub place: Vec<f64>,
    /// Key and value over every case.
    pub settings: Vec<(String, String)>,
    /// How Eq. (27) is read.
    pub outline: Outline,
    /// How RMS and peak to peak are read off the runs.
    pub reading: Reading,
}

/// Axes of the cube that is searched: one for each of [`RANGES`], in their order, one for the reading of Eq. (27), one
/// for the filter, and one for the record unless that is `fixed`.
pub(crate) fn axes(fixed: Option<Record>) -> usize {
    RANGES.len() + 2 + usize::from(fixed.is_none())
}

/// The set at a place of the unit cube, the `number`th that is looked at. Numbers carry four digits: that is what a
/// table shows, and what is run.
///
/// # Panics
/// Where the place has not as many coordinates as there are [`axes`].
pub(crate) fn draw(number: usize, place: &[f64], fixed: Option<Record>) -> Draw {
    assert_eq!(place.len(), axes(fixed));
    let (places, others) = place.split_at(RANGES.len());
    let mut settings = Vec::new();
    for (range, place) in RANGES.iter().zip(places) {
        let values: Vec<String> = match &range.values {
            Values::Between(low, high) => {
                let x = low * (high / low).powf(*place);
                vec![format!("{x:.3e}"); range.keys.len()]
            }
            Values::OneOf(choices) => {
                let chosen = chosen(choices, *place);
                chosen.iter().map(|value| (*value).to_owned()).collect()
            }
        };
        let keys = range.keys.iter().map(|key| (*key).to_owned());
        settings.extend(keys.zip(values));
    }
    let record = fixed.or_else(|| others.get(2).map(|u| *chosen(RECORDS, *u)));
    Draw {
        number,
        place: place.to_vec(),
        settings,
        outline: *chosen(READ_AS, others[0]),
        reading: Reading { filtered: others[1] >= 0.5, record: record.unwrap_or(Record::Steady) },
    }
}

fn chosen<T>(choices: &[T], place: f64) -> &T {
    let k = (place * choices.len() as f64) as usize;
    &choices[k.min(choices.len() - 1)]
}

/// What the search is to meet: the logarithms of the paper's RMS values, to 5 %, its frequency, to the 0.4 % that model
/// and paper differ by at most in any case, and every statement about these cases, a tenth of them being worth as much
/// as 5 % of an RMS value.
pub(crate) fn targets() -> Vec<Target> {
    let rms = SEARCHED.iter().zip(RMS).map(|(case, rms)| Target {
        name: format!("ln outer_ax.rms, {case}"),
        value: rms.ln(),
        uncertainty: 0.05,
    });
    let frequency =
        Target { name: "defect1.frequency, irregular".into(), value: FREQUENCY, uncertainty: 0.004 * FREQUENCY };
    let held = Target { name: "statements that hold".into(), value: 1.0, uncertainty: 0.1 };
    rms.chain([frequency, held]).collect()
}

/// What a set's runs have for the [`targets`]; `None` where one of them failed.
pub(crate) fn answers(numbers: &Numbers) -> Option<Vec<Answer>> {
    let distance = distance(numbers)?;
    let answer = |value: Option<f64>| Answer { value, uncertainty: 0.0 };
    let rms = distance.values.iter().map(|rms| answer(Some(rms.ln())));
    let frequency = distance.frequency.map(|off| FREQUENCY + off);
    let held = answer(Some(held(numbers)));
    Some(rms.chain([answer(frequency), held]).collect())
}

/// Share of the statements about the searched cases alone that hold.
pub(crate) fn held(numbers: &Numbers) -> f64 {
    let mut verdicts: Vec<Verdict> = Vec::new();
    for claim in claims().filter(|claim| claim.counts()) {
        let judged = judge(claim, numbers).statements;
        let about = claim.statements.iter().zip(judged).filter(|(statement, _)| {
            let cases = statement.check.cases();
            cases.iter().all(|case| SEARCHED.contains(case))
        });
        verdicts.extend(about.map(|(_, (verdict, _))| verdict));
    }
    let held = verdicts.iter().filter(|v| **v == Verdict::Holds).count();
    held as f64 / verdicts.len().max(1) as f64
}

/// How far a set of assumptions stays from the paper's figures.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Distance {
    /// Root mean square of ln(ours / paper's) over the three RMS values; 0.05 is 5 %.
    pub rms: f64,
    /// Ours, m/s^2, in the order of [`SEARCHED`].
    pub values: [f64; 3],
    /// Ours less the paper's simulated frequency, Hz, where a line was found.
    pub frequency: Option<f64>,
}

/// Of the outer ring's x accelerations; `None` where a run has none.
pub(crate) fn distance(numbers: &Numbers) -> Option<Distance> {
    let mut values = [0.0; 3];
    for (value, case) in values.iter_mut().zip(SEARCHED) {
        *value = numbers.get(case, "outer_ax.rms")?.value;
    }
    if values.iter().any(|value| *value <= 0.0) {
        return None;
    }
    let squares = values.iter().zip(RMS).map(|(x, paper)| (x / paper).ln().powi(2));
    let frequency = numbers.get("irregular", "defect1.frequency");
    Some(Distance {
        rms: (squares.sum::<f64>() / 3.0).sqrt(),
        values,
        frequency: frequency.map(|f| f.value - FREQUENCY),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::owned;
    use crate::numbers::exact;
    use crate::reading::WINDOWS_MS;
    use crate::{BASE, CASES, VARIANTS};
    use std::collections::BTreeSet;

    #[test]
    fn prop_every_place_is_a_sound_scenario_and_every_choice_has_one() {
        let n = 12;
        let along = |axis: usize, k: usize| {
            let mut place = vec![0.5; axes(None)];
            place[axis] = k as f64 / n as f64;
            draw(1, &place, None)
        };
        for (axis, range) in RANGES.iter().enumerate() {
            let all: Vec<Draw> = (0..=n).map(|k| along(axis, k)).collect();
            for draw in &all {
                brinell::document::read(BASE, &draw.settings).unwrap_or_else(|e| panic!("{e:?}"));
            }
            let of = |draw: &Draw| {
                let settings = draw.settings.iter();
                let mine = settings.filter(|(k, _)| range.keys.contains(&k.as_str()));
                mine.map(|(_, v)| v.clone()).collect::<Vec<_>>()
            };
            let seen: BTreeSet<Vec<String>> = all.iter().map(of).collect();
            match &range.values {
                Values::Between(low, high) => {
                    let ends = [&all[0], &all[n]].map(|draw| of(draw)[0].parse::<f64>().unwrap());
                    assert!((ends[0] / low - 1.0).abs() < 1e-3 && (ends[1] / high - 1.0).abs() < 1e-3);
                    assert_eq!(seen.len(), n + 1);
                }
                Values::OneOf(choices) => assert_eq!(seen.len(), choices.len(), "{:?}", range.keys),
            }
        }
        let (outline, filter, record) = (RANGES.len(), RANGES.len() + 1, RANGES.len() + 2);
        assert!(!along(filter, 0).reading.filtered && along(filter, n).reading.filtered);
        assert!(READ_AS.iter().all(|o| (0..=n).any(|k| along(outline, k).outline == *o)));
        let seen = |r: &Record| (0..=n).any(|k| along(record, k).reading.record == *r);
        assert!(RECORDS.iter().all(seen));
        let fixed = draw(1, &vec![0.5; axes(Some(Record::Steady))], Some(Record::Steady));
        assert_eq!(fixed.reading.record, Record::Steady);
    }

    #[test]
    fn prop_variants_are_sound_scenarios() {
        for variant in VARIANTS.iter() {
            let settings = owned(&variant.settings);
            for case in CASES.iter() {
                brinell::document::read(BASE, &case.over(&settings, variant.outline))
                    .unwrap_or_else(|e| panic!("{}, {}: {e:?}", variant.id, case.id));
            }
            if let Record::FromStart(ms) = variant.reading.record {
                assert!(WINDOWS_MS.contains(&ms), "{}", variant.id);
            }
        }
    }

    #[test]
    fn analytic_distance() {
        let mut numbers = Numbers::default();
        assert_eq!(distance(&numbers), None);
        for (case, paper) in SEARCHED.iter().zip(RMS) {
            numbers.insert(case, "outer_ax.rms", exact(paper * 0.1_f64.exp()));
        }
        numbers.insert("irregular", "defect1.frequency", exact(250.4));
        let far = distance(&numbers).unwrap();
        assert!((far.rms - 0.1).abs() < 1e-12);
        assert!((far.frequency.unwrap() - 1.0).abs() < 1e-12);
        let residuals: Vec<f64> = (targets().iter().zip(answers(&numbers).unwrap()))
            .map(|(t, a)| (a.value.unwrap() - t.value) / t.uncertainty)
            .collect();
        assert!(residuals[..3].iter().all(|r| (r - 2.0).abs() < 1e-12));
        assert!((residuals[3] - 1.0 / (0.004 * 249.4)).abs() < 1e-12);
    }
}
