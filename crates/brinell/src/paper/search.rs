//! A search for one set of assumptions: a Latin hypercube over [`super::RANGES`], seeded, and how far a set stays from the paper's figures.
//! What proposes sets is behind [`Design`]; an optimiser can take its place, since all that it needs is the score of earlier draws.

use super::assumptions::{RANGES, Values};
use super::numbers::Numbers;
use crate::random::Random;

/// Cases that every draw runs: the paper's three RMS values, at a seventh of the cost of all cases.
pub const SEARCHED: &[&str] = &["irregular", "simplified", "reference-simplified"];

/// The paper's RMS of each of [`SEARCHED`], m/s^2 (section 4.5).
const RMS: [f64; 3] = [30.414, 32.06, 29.01];
/// The paper's simulated defect frequency of the irregular shape, Hz (section 4.1.3).
const FREQUENCY: f64 = 249.40;

/// One set of assumptions.
#[derive(Debug, Clone, PartialEq)]
pub struct Draw {
    /// Its number, from 1.
    pub number: usize,
    /// Key and value over every case.
    pub settings: Vec<(String, String)>,
}

/// What proposes sets of assumptions.
pub trait Design {
    /// Sets to try, given the scores of those tried before (lower is better); none where it is done.
    fn propose(&mut self, scores: &[f64]) -> Vec<Draw>;
}

/// One Latin hypercube: every range is cut into as many strata as there are draws, and each stratum is drawn from once.
#[derive(Debug, Clone)]
pub struct Hypercube {
    draws: usize,
    seed: u64,
}

impl Hypercube {
    /// Of `draws` sets.
    pub fn new(draws: usize, seed: u64) -> Self {
        Self { draws, seed }
    }
}

impl Design for Hypercube {
    fn propose(&mut self, scores: &[f64]) -> Vec<Draw> {
        if scores.is_empty() {
            draws(self.draws, self.seed)
        } else {
            Vec::new()
        }
    }
}

fn shuffled(random: &mut Random, n: usize) -> Vec<usize> {
    let mut all: Vec<usize> = (0..n).collect();
    for k in (1..n).rev() {
        all.swap(k, (random.part() * (k + 1) as f64) as usize);
    }
    all
}

/// The sets of a Latin hypercube. Numbers carry four digits: that is what a table shows, and what is run.
pub fn draws(count: usize, seed: u64) -> Vec<Draw> {
    let mut random = Random::new(seed);
    let mut all: Vec<Draw> = (1..=count)
        .map(|number| Draw {
            number,
            settings: Vec::new(),
        })
        .collect();
    for range in RANGES {
        let strata = shuffled(&mut random, count);
        for (draw, stratum) in all.iter_mut().zip(strata) {
            let place = (stratum as f64 + random.part()) / count as f64;
            let values: Vec<String> = match range.values {
                Values::Between(low, high) => {
                    let x = low * (high / low).powf(place);
                    vec![format!("{x:.3e}"); range.keys.len()]
                }
                Values::OneOf(choices) => {
                    let k = (place * choices.len() as f64) as usize;
                    let chosen = choices[k.min(choices.len() - 1)];
                    chosen.iter().map(|value| (*value).to_owned()).collect()
                }
            };
            let keys = range.keys.iter().map(|key| (*key).to_owned());
            draw.settings.extend(keys.zip(values));
        }
    }
    all
}

/// How far a set of assumptions stays from the paper's figures.
#[derive(Debug, Clone, PartialEq)]
pub struct Distance {
    /// Root mean square of ln(ours / paper's) over the three RMS values; 0.05 is 5 %.
    pub rms: f64,
    /// Ours, m/s^2, in the order of [`SEARCHED`].
    pub values: [f64; 3],
    /// Ours less the paper's simulated frequency, Hz, where a line was found.
    pub frequency: Option<f64>,
}

/// Of the outer ring's x accelerations; `None` where a run has none.
pub fn distance(numbers: &Numbers) -> Option<Distance> {
    let mut values = [0.0; 3];
    for (value, case) in values.iter_mut().zip(SEARCHED) {
        *value = numbers.get(case, "outer_ax.rms")?.value;
    }
    if values.iter().any(|value| *value <= 0.0) {
        return None;
    }
    let squares = values
        .iter()
        .zip(RMS)
        .map(|(x, paper)| (x / paper).ln().powi(2));
    let frequency = numbers.get("irregular", "defect1.frequency");
    Some(Distance {
        rms: (squares.sum::<f64>() / 3.0).sqrt(),
        values,
        frequency: frequency.map(|f| f.value - FREQUENCY),
    })
}

#[cfg(test)]
mod tests {
    use super::super::{BASE, Number, VARIANTS};
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn prop_draws_are_sound_scenarios_and_fill_every_stratum() {
        let n = 30;
        let all = draws(n, 7);
        assert_eq!(all, draws(n, 7));
        assert_ne!(all, draws(n, 8));
        for draw in &all {
            crate::document::read(BASE, &draw.settings).unwrap_or_else(|e| panic!("{e:?}"));
        }
        for range in RANGES {
            let of = |draw: &Draw| {
                let found = draw.settings.iter().find(|(key, _)| key == range.keys[0]);
                found.unwrap().1.clone()
            };
            match range.values {
                Values::Between(low, high) => {
                    let stratum = |draw| {
                        let x: f64 = of(draw).parse().unwrap();
                        let place = (x / low).ln() / (high / low).ln();
                        // Four digits may round into the neighbour: look at the middle of it.
                        (place * n as f64).floor() as i64
                    };
                    let strata: BTreeSet<i64> = all.iter().map(stratum).collect();
                    assert!(strata.len() >= n - 2, "{:?}: {}", range.keys, strata.len());
                }
                Values::OneOf(choices) => {
                    let seen: BTreeSet<Vec<String>> = all
                        .iter()
                        .map(|draw| {
                            let mine = draw
                                .settings
                                .iter()
                                .filter(|(k, _)| range.keys.contains(&k.as_str()));
                            mine.map(|(_, v)| v.clone()).collect()
                        })
                        .collect();
                    assert_eq!(seen.len(), choices.len(), "{:?}", range.keys);
                }
            }
        }
    }

    #[test]
    fn prop_variants_are_sound_scenarios() {
        for variant in VARIANTS {
            let settings: Vec<_> = variant
                .settings
                .iter()
                .map(|(k, v)| ((*k).to_owned(), (*v).to_owned()))
                .collect();
            crate::document::read(BASE, &settings)
                .unwrap_or_else(|e| panic!("{}: {e:?}", variant.id));
        }
    }

    #[test]
    fn analytic_distance() {
        let mut numbers = Numbers::default();
        assert_eq!(distance(&numbers), None);
        for (case, paper) in SEARCHED.iter().zip(RMS) {
            numbers.insert(case, "outer_ax.rms", Number::exact(paper * 0.1_f64.exp()));
        }
        numbers.insert("irregular", "defect1.frequency", Number::exact(250.4));
        let far = distance(&numbers).unwrap();
        assert!((far.rms - 0.1).abs() < 1e-12);
        assert!((far.frequency.unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(Hypercube::new(3, 1).propose(&[1.0]), []);
        assert_eq!(Hypercube::new(3, 1).propose(&[]).len(), 3);
    }
}
