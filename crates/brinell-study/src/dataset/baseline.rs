//! What a simple classifier tells of a data set's runs: how hard it is, for its card.

use crate::dataset::about::About;
use crate::dataset::error::DatasetError;
use crate::dataset::sheet::{Opened, number, rms_and_kurtosis, words};
use crate::design::Part;
use brinell::signal::estimate::NORMAL;
use brinell::signal::{Band, Segments, Spectrum, envelope_spectrum};
use brinell_io::Cell;
use nalgebra::{DMatrix, DVector};
use std::collections::HashMap;
use std::path::Path;

/// Parts of the runs, where the plan makes none for testing: each is told by a classifier that learned from the others.
const FOLDS: usize = 5;
/// Of a class so many runs are needed at least, to learn from and to be told.
const LEAST: usize = FOLDS;
/// Harmonics of a frequency whose lines are looked at.
const HARMONICS: usize = 3;
/// What is read of a run beside its signal; none of it is truth.
const COLUMNS: &str = "run split status class label speed_rpm sample_rate_hz analysed_from_s bpfo_hz bpfi_hz bsf_hz";

/// What is known of a run: its class, and its features by family.
struct Known {
    run: i64,
    label: usize,
    /// For testing, as the plan has it.
    is_test: bool,
    features: [Vec<f64>; FAMILIES.len()],
}

/// The families of features, as the card names them.
pub(crate) const FAMILIES: [&str; 3] = [
    "level: log of RMS, kurtosis and speed",
    "envelope: lines at BPFO, BPFI and 2 BSF over the noise beside them",
    "both",
];
/// The envelope is that of everything above so many times the highest of its frequencies: the broad band of `brinell analyze`.
const ABOVE: f64 = 3.0;

/// Scores of the families.
pub(crate) struct Baselines {
    /// The column.
    pub(crate) signal: String,
    /// Whether the plan's split `test` was told by what was learned from `train`; else folds of all open runs.
    pub(crate) by_split: bool,
    /// Runs that have no features.
    pub(crate) without: usize,
    /// Of each family and each class: runs that were told rightly, and how many there are; `None` where a class has too few to learn from.
    pub(crate) right: Option<[Vec<[usize; 2]>; FAMILIES.len()]>,
}

/// Scores of the runs in a folder whose files are all there; `None` where there are no classes to tell, or rows are snapshots of machines, whose class
/// says what will be damaged.
///
/// # Errors
/// Where a file cannot be read.
pub(crate) fn baselines(folder: &Path, about: &About) -> Result<Option<Baselines>, DatasetError> {
    let classes = about.classes.len();
    if about.histories.is_some() || classes < 2 || !about.columns.iter().any(|column| column.is_signal()) {
        return Ok(None);
    }
    let opened = Opened::new(folder)?;
    let columns: Vec<&str> = COLUMNS.split(' ').chain([&*opened.signal]).collect();
    let (mut known, mut without) = (Vec::new(), 0);
    for path in &opened.parts {
        opened.each_row(
            path,
            &columns,
            |_| true,
            |row| {
                let (Cell::Whole(run), Cell::Whole(label)) = (&row["run"], &row["label"]) else {
                    return; // held out
                };
                if words(&row, "status") != "complete" {
                    return;
                }
                let (run, label) = (*run, *label as usize);
                let split = Part::ALL.into_iter().find(|part| part.word() == words(&row, "split"));
                match features(&row, &opened.signal) {
                    Some(_) if split == Some(Part::Validation) => {}
                    Some(features) => {
                        known.push(Known { run, label, is_test: split == Some(Part::Test), features });
                    }
                    None => without += 1,
                }
            },
        )?;
    }
    known.sort_by_key(|known| known.run);
    let by_split = known.iter().any(|known| known.is_test);
    let fold = folds(&known, classes, by_split);
    let of_class = |class: usize, is_test: Option<bool>| {
        known.iter().filter(|k| k.label == class && is_test.is_none_or(|is| k.is_test == is)).count()
    };
    let enough = |class| match by_split {
        true => of_class(class, Some(false)) >= LEAST && of_class(class, Some(true)) > 0,
        false => of_class(class, None) >= LEAST,
    };
    let right = (0..classes).all(enough).then(|| [0, 1, 2].map(|family| scores(&known, &fold, family, classes)));
    Ok(Some(Baselines { signal: opened.signal, by_split, without, right }))
}

/// Of each run the part in which it is told; `None` of those that are learned from alone.
fn folds(known: &[Known], classes: usize, by_split: bool) -> Vec<Option<usize>> {
    let mut seen = vec![0; classes];
    let mut fold = |known: &Known| match by_split {
        true => known.is_test.then_some(0),
        // Each class in turn, so that every part has all of them.
        false => {
            seen[known.label] += 1;
            Some((seen[known.label] - 1) % FOLDS)
        }
    };
    known.iter().map(&mut fold).collect()
}

/// Of each class: runs that are told rightly, and how many are told.
fn scores(known: &[Known], fold: &[Option<usize>], family: usize, classes: usize) -> Vec<[usize; 2]> {
    let mut right = vec![[0, 0]; classes];
    let last = fold.iter().flatten().max().copied().unwrap_or(0);
    for part in 0..=last {
        let pairs = known.iter().zip(fold);
        let learned = pairs.clone().filter(|(_, of)| **of != Some(part));
        let learned: Vec<(usize, &[f64])> = learned.map(|(k, _)| (k.label, &*k.features[family])).collect();
        let Some(rule) = Discriminant::of(&learned, classes) else { continue };
        for (k, _) in pairs.filter(|(_, of)| **of == Some(part)) {
            right[k.label][0] += usize::from(rule.tell(&k.features[family]) == k.label);
            right[k.label][1] += 1;
        }
    }
    right
}

/// Features of all families; `None` where a run has not all of them.
fn features(row: &HashMap<&str, Cell>, signal: &str) -> Option<[Vec<f64>; FAMILIES.len()]> {
    let of = |name: &str| number(row, name);
    let frequencies = [of("bpfo_hz")?, of("bpfi_hz")?, 2.0 * of("bsf_hz")?].map(f64::abs);
    let Cell::Signal(x) = &row[signal] else { return None };
    let rate = of("sample_rate_hz")?;
    let start = (of("analysed_from_s").unwrap_or(0.0) * rate).round() as usize;
    let settled: Vec<f64> = x.iter().skip(start).map(|x| f64::from(*x)).collect();
    let [rms, kurtosis] = rms_and_kurtosis(&settled);
    let level = vec![rms.ln(), kurtosis.ln(), of("speed_rpm")?.abs().ln()];
    let band = Band::above(ABOVE * frequencies.into_iter().fold(0.0, f64::max));
    let envelope = envelope_spectrum(&settled, rate, band, &Segments::of(settled.len())).ok()?.spectrum;
    let lines = frequencies.map(|f| {
        let harmonics = (1..=HARMONICS).map(|k| line(&envelope, k as f64 * f));
        harmonics.sum::<f64>() / HARMONICS as f64
    });
    let all = [level.clone(), lines.to_vec(), [level, lines.to_vec()].concat()];
    all[2].iter().all(|x| x.is_finite()).then_some(all)
}

/// How far the envelope's line near `hz` is above the noise beside it, in nepers: cages slip, so it is looked for within 2 %
/// and 3 Hz.
fn line(envelope: &Spectrum, hz: f64) -> f64 {
    let (mut top, mut beside) = (0.0_f64, Vec::new());
    for (k, amplitude) in envelope.amplitude.iter().enumerate().skip(1) {
        let off = (k as f64 * envelope.frequency_step - hz).abs();
        if off < 0.02 * hz + 3.0 {
            top = top.max(*amplitude);
        } else if off < 0.2 * hz + 20.0 {
            beside.push(*amplitude);
        }
    }
    beside.sort_by(f64::total_cmp);
    beside.get(beside.len() / 2).map_or(f64::NAN, |median| (top / median).ln())
}

/// Linear discriminant analysis (Fisher 1936) of classes that are equally likely: Gaussian features with one covariance.
struct Discriminant {
    /// Of each class: weights of the features, and an offset.
    rules: Vec<(DVector<f64>, f64)>,
}

impl Discriminant {
    /// Learned from labels with features; `None` where a class has none, or the features are not independent.
    fn of(learned: &[(usize, &[f64])], classes: usize) -> Option<Self> {
        let size = learned.first()?.1.len();
        let mut means = vec![(DVector::zeros(size), 0.0); classes];
        for (label, x) in learned {
            means[*label].0 += DVector::from_column_slice(x);
            means[*label].1 += 1.0;
        }
        let means: Vec<DVector<f64>> = means.into_iter().map(|(sum, count)| sum / count).collect();
        let mut covariance = DMatrix::zeros(size, size);
        for (label, x) in learned {
            let off = DVector::from_column_slice(x) - &means[*label];
            covariance += &off * off.transpose();
        }
        let spread = covariance / learned.len().checked_sub(classes).filter(|free| *free > 0)? as f64;
        let inverse = spread.cholesky()?;
        let rule = |mean: &DVector<f64>| {
            let weights = inverse.solve(mean);
            let offset = -0.5 * weights.dot(mean);
            (weights, offset)
        };
        let rules: Vec<(DVector<f64>, f64)> = means.iter().map(rule).collect();
        rules.iter().all(|(_, offset)| offset.is_finite()).then_some(Self { rules })
    }

    fn tell(&self, x: &[f64]) -> usize {
        let x = DVector::from_column_slice(x);
        let score = |class: &usize| self.rules[*class].0.dot(&x) + self.rules[*class].1;
        let classes = 0..self.rules.len();
        classes.max_by(|a, b| score(a).total_cmp(&score(b))).unwrap_or(0)
    }
}

/// Share of `right` in `of`, with its 95 % interval (Wilson 1927): [low, share, high].
fn share(right: usize, of: usize) -> [f64; 3] {
    let (n, p) = (of as f64, right as f64 / of as f64);
    let z = NORMAL * NORMAL / n;
    let middle = (p + z / 2.0) / (1.0 + z);
    let half = (z * (p * (1.0 - p) + z / 4.0)).sqrt() / (1.0 + z);
    [middle - half, p, middle + half]
}

impl Baselines {
    /// The section of the card; `classes` are their names.
    pub(crate) fn section(&self, classes: &[String]) -> String {
        let Some(right) = &self.right else {
            let told = if self.by_split { ", and one in the split `test`" } else { "" };
            let learned = if self.by_split { " in the split `train`" } else { "" };
            return format!("\n## Baselines\n\nToo few runs: each class needs {LEAST}{learned} to learn from{told}.\n");
        };
        let how = match self.by_split {
            true => "Learned from the split `train`, told of the split `test`.".to_owned(),
            false => {
                format!("Each of {FOLDS} parts of the open runs is told by a rule that is learned from the others.")
            }
        };
        let without = match self.without {
            0 => String::new(),
            1 => " Of one run a feature is missing; it is left out.".to_owned(),
            count => format!(" Of {count} runs a feature is missing; they are left out."),
        };
        let heads: String = classes.iter().map(|name| format!(" {name} |")).collect();
        let mut section = format!(
            "\n## Baselines\n\nLinear discriminant analysis of a few features of `{}`, from `analysed_from_s` on: how hard these runs are to tell apart. It says \
             nothing of a measured machine. The envelope is that of everything above {ABOVE} times the highest of its frequencies. {how}{without}\n\n| features | right | 95 % |{heads}\n| --- | --- | --- |{}\n| none: guessing | {:.0} % | |{}\n",
            self.signal,
            " --- |".repeat(classes.len()),
            100.0 / classes.len() as f64,
            " |".repeat(classes.len())
        );
        for (family, right) in FAMILIES.iter().zip(right) {
            let [all, of] = right.iter().fold([0, 0], |[a, b], [right, of]| [a + right, b + of]);
            let [low, p, high] = share(all, of).map(|x| 100.0 * x);
            let each: String = right.iter().map(|[right, of]| format!(" {right} of {of} |")).collect();
            section += &format!("| {family} | {p:.0} % | {low:.0} to {high:.0} % |{each}\n");
        }
        section
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_wilson_interval_of_a_share() {
        // Newcombe (1998), Table I, method 3: 81 of 263 and 15 of 148.
        let near = |found: [f64; 3], low: f64, high: f64| {
            assert!((found[0] - low).abs() < 5e-5 && (found[2] - high).abs() < 5e-5, "{found:?}");
        };
        near(share(81, 263), 0.2553, 0.3662);
        near(share(15, 148), 0.0624, 0.1605);
    }

    #[test]
    fn analytic_two_gaussian_classes_are_parted_at_the_plane_between_their_means() {
        // Means (0, 0) and (2, 0), the same correlated spread: the plane of w = S^-1 (2, 0) through (1, 0).
        let around = [[1.0, 0.5], [-1.0, -0.5], [0.5, 1.0], [-0.5, -1.0]];
        let points: Vec<(usize, Vec<f64>)> =
            [0.0, 2.0].iter().enumerate().flat_map(|(k, x)| around.map(|[a, b]| (k, vec![x + a, b]))).collect();
        let learned: Vec<(usize, &[f64])> = points.iter().map(|(k, x)| (*k, &**x)).collect();
        let rule = Discriminant::of(&learned, 2).unwrap();
        // S is proportional to [[2.5, 2], [2, 2.5]], so w to (2.5, -2): on the plane 2.5 (x - 1) = 2 y.
        for (x, y) in [(1.0, 0.0), (1.8, 1.0), (0.2, -1.0)] {
            assert_eq!([rule.tell(&[x - 1e-6, y]), rule.tell(&[x + 1e-6, y])], [0, 1], "{x} {y}");
        }
        assert!(Discriminant::of(&learned[..4], 2).is_none(), "a class without runs");
    }

    #[test]
    fn prop_every_part_tells_runs_of_every_class_and_learns_from_all_others() {
        let known = |k: usize, is_test| Known {
            run: k as i64,
            label: k % 3,
            is_test,
            features: [vec![(k % 3) as f64 * 10.0 + (k % 7) as f64], vec![(k % 5) as f64], vec![0.0]],
        };
        let all: Vec<Known> = (0..60).map(|k| known(k, false)).collect();
        let fold = folds(&all, 3, false);
        for part in 0..FOLDS {
            let labels: Vec<usize> = (0..60).filter(|k| fold[*k] == Some(part)).map(|k| k % 3).collect();
            assert_eq!([0, 1, 2].map(|label| labels.iter().filter(|x| **x == label).count()), [4, 4, 4]);
        }
        // Classes 10 apart with a spread of 6 are told, and features that have nothing to do with the class are not.
        assert_eq!(scores(&all, &fold, 0, 3), [[20, 20]; 3]);
        assert!(scores(&all, &fold, 1, 3).iter().map(|[right, _]| right).sum::<usize>() < 35);
        let split: Vec<Known> = (0..60).map(|k| known(k, k >= 45)).collect();
        assert_eq!(scores(&split, &folds(&split, 3, true), 0, 3), [[5, 5]; 3]);
    }
}
