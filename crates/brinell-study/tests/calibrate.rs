//! The search finds known optima within its budget, and neither interruption nor repetition changes what it asks for.

use brinell_study::calibrate::search::latin_hypercube;
use brinell_study::calibrate::{Answer, Fit, Settings, Target, Unfit, fit, least_budget};
use std::collections::HashMap;

fn targets(values: &[f64], uncertainty: f64) -> Vec<Target> {
    let one = |(k, value): (usize, &f64)| Target { name: format!("t{k}"), value: *value, uncertainty };
    values.iter().enumerate().map(one).collect()
}

fn answers(values: Vec<f64>) -> Option<Vec<Answer>> {
    let one = |value| Answer { value: Some(value), uncertainty: 0.0 };
    Some(values.into_iter().map(one).collect())
}

fn search(keys: usize, targets: &[Target], settings: Settings, model: impl Fn(&[f64]) -> Option<Vec<Answer>>) -> Fit {
    fit(keys, targets, settings, &mut |points| Ok(points.iter().map(|p| model(p)).collect())).unwrap()
}

/// Rosenbrock's valley over [-2, 2]^2, as two residuals: its optimum is (1, 1).
fn rosenbrock(unit: &[f64]) -> Vec<f64> {
    let (x, y) = (4.0 * unit[0] - 2.0, 4.0 * unit[1] - 2.0);
    vec![10.0 * (y - x * x), 1.0 - x]
}

#[test]
fn prop_the_valley_of_rosenbrock_is_followed_to_its_end() {
    for seed in 0..8 {
        let settings = Settings { seed, budget: 150 };
        let fit = search(2, &targets(&[0.0; 2], 1.0), settings, |p| answers(rosenbrock(p)));
        let best = &fit.evaluations[fit.best];
        assert!(fit.evaluations.len() <= 150);
        for unit in &best.place {
            assert!((unit - 0.75).abs() < 0.01, "seed {seed}: {best:?}");
        }
    }
}

/// A damped oscillation's frequency and decay, from its samples: the sum of squares has many hollows.
#[test]
fn prop_the_right_one_of_many_hollows_is_found() {
    let course = |unit: &[f64]| -> Vec<f64> {
        let (frequency, decay) = (1.0 + 7.0 * unit[0], 3.0 * unit[1]);
        let at = |k: u32| {
            let t = f64::from(k) / 40.0;
            (-decay * t).exp() * (std::f64::consts::TAU * frequency * t).sin()
        };
        (0..40).map(at).collect()
    };
    let truth = [0.62, 0.3];
    let targets = targets(&course(&truth), 0.05);
    for seed in 0..8 {
        let settings = Settings { seed, budget: 120 };
        let fit = search(2, &targets, settings, |p| answers(course(p)));
        let best = &fit.evaluations[fit.best];
        for (unit, truth) in best.place.iter().zip(truth) {
            assert!((unit - truth).abs() < 0.01, "seed {seed}: {best:?}");
        }
        assert!(fit.identified.directions.iter().all(|d| d.is_determined()));
    }
}

/// A key that acts by its distance from 0.4 alone has two solutions, 0.2 and 0.6, and one that acts up to 0.3 has none:
/// differences about the best run see neither. A line has one.
#[test]
fn prop_a_run_elsewhere_that_meets_the_targets_as_well_is_told() {
    for seed in 0..8 {
        let settings = Settings { seed, budget: 40 };
        let found = |course: fn(f64) -> f64, target: f64| {
            let fit = search(1, &targets(&[target], 0.01), settings, |p| answers(vec![course(p[0])]));
            let half_width = fit.identified.half_widths[0];
            let rival = fit.rival(0).map(|run| fit.evaluations[run].place[0]);
            (fit.evaluations[fit.best].place[0], half_width, rival)
        };
        let (best, half_width, rival) = found(|x| (x - 0.4).powi(2), 0.04);
        let rival = rival.unwrap_or(f64::NAN);
        assert!(
            half_width < 0.1 && (best + rival - 0.8).abs() < 0.1 && (best - rival).abs() > 0.3,
            "{seed}: {best} {rival}"
        );
        let (best, half_width, rival) = found(|x| x.min(0.3), 0.3);
        assert!(2.0 * half_width > 0.75 || rival.is_some(), "{seed}: {best} +- {half_width}");
        let (best, half_width, rival) = found(|x| x, 0.4);
        assert!((best - 0.4).abs() < 0.01 && half_width < 0.03 && rival.is_none(), "{seed}: {best} {rival:?}");
    }
}

/// Targets that depend linearly on four keys: the covariance is that of linear least squares.
#[test]
fn analytic_a_linear_problem_has_its_known_uncertainty() {
    let model = |p: &[f64]| {
        vec![
            10.0 * p[0] + 2.0 * p[1],
            -3.0 * p[1] + 8.0 * p[2],
            5.0 * p[0] - 4.0 * p[2],
            6.0 * p[1],
            p[0] + p[1] + p[2],
        ]
    };
    let truth = [0.4, 0.7, 0.55];
    let settings = Settings { seed: 3, budget: 60 };
    let fit = search(3, &targets(&model(&truth), 0.1), settings, |p| answers(model(p)));
    let zero = model(&[0.0; 3]);
    let jacobian = nalgebra::DMatrix::from_fn(5, 3, |row, column| {
        let mut unit = [0.0; 3];
        unit[column] = 1.0;
        (model(&unit)[row] - zero[row]) / 0.1
    });
    let covariance = (jacobian.transpose() * &jacobian).try_inverse().unwrap();
    for k in 0..3 {
        let expected = covariance[(k, k)].sqrt();
        let found = fit.identified.deviations[k];
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        assert!((fit.evaluations[fit.best].place[k] - truth[k]).abs() < 0.02);
    }
}

#[test]
fn analytic_a_product_leaves_its_factors_undetermined() {
    // In logarithms a product is a sum: nothing tells the factors apart.
    let model = |p: &[f64]| vec![(p[0] + p[1]).exp(), 2.0 * (p[0] + p[1])];
    let settings = Settings { seed: 1, budget: 40 };
    let fit = search(2, &targets(&model(&[0.5, 0.4]), 0.01), settings, |p| answers(model(p)));
    let sum: f64 = fit.evaluations[fit.best].place.iter().sum();
    assert!((sum - 0.9).abs() < 0.01);
    let free = &fit.identified.directions[1];
    assert!(!free.is_determined());
    assert!((free.vector[0] + free.vector[1]).abs() < 1e-6, "{free:?}");
    assert!(fit.identified.directions[0].is_determined());
}

/// A rough model whose runs state their own uncertainty, and fail in a corner.
fn rough(point: &[f64]) -> Option<Vec<Answer>> {
    let [x, y] = [point[0], point[1]];
    if x > 0.9 && y > 0.9 {
        return None;
    }
    let noise = |k: f64| 0.05 * (1000.0 * (k + x + 3.0 * y)).sin();
    let value = |k: f64, v: f64| Answer { value: (v > -5.0).then_some(v + noise(k)), uncertainty: 0.05 };
    Some(vec![value(1.0, 5.0 * x * x), value(2.0, 3.0 * x + y), value(3.0, (4.0 * y).sin())])
}

fn same(a: &Fit, b: &Fit) {
    assert_eq!(format!("{a:?}"), format!("{b:?}"));
}

#[test]
fn prop_interruptions_change_nothing() {
    let targets = targets(&[1.5, 2.2, 0.9], 0.05);
    let settings = Settings { seed: 11, budget: 60 };
    let whole = search(2, &targets, settings, rough);
    assert!(whole.evaluations.len() <= 60);
    // Each attempt answers so many new points and is then stopped, in the middle of a batch too; what was answered is
    // remembered.
    for patience in [1, 3, 7, 25] {
        let mut known: HashMap<Vec<u64>, Option<Vec<Answer>>> = HashMap::new();
        let mut attempts = 0;
        let again = loop {
            attempts += 1;
            let mut left = patience;
            let result = fit(2, &targets, settings, &mut |points| {
                let one = |p: &Vec<f64>| {
                    let bits: Vec<u64> = p.iter().map(|x| x.to_bits()).collect();
                    if !known.contains_key(&bits) {
                        if left == 0 {
                            return Err(Unfit::Interrupted);
                        }
                        left -= 1;
                        known.insert(bits.clone(), rough(p));
                    }
                    Ok(known[&bits].clone())
                };
                points.iter().map(one).collect()
            });
            match result {
                Ok(fit) => break fit,
                Err(error) => assert_eq!(error, Unfit::Interrupted),
            }
        };
        assert_eq!(attempts, whole.evaluations.len().div_ceil(patience));
        same(&whole, &again);
    }
}

#[test]
fn prop_a_run_weighs_with_its_own_uncertainty() {
    let fit = search(2, &targets(&[1.5, 2.2, 0.9], 0.12), Settings { seed: 5, budget: 50 }, rough);
    for (sigma, own) in fit.sigma.iter().zip(&fit.own) {
        assert!((own - 0.05).abs() < 1e-12 && (sigma - 0.13).abs() < 1e-12);
    }
}

#[test]
fn prop_the_start_has_one_point_in_each_slice() {
    for (seed, keys, count) in [(0, 1, 1), (1, 3, 17), (9, 5, 40)] {
        let points = latin_hypercube(seed, keys, count);
        for axis in 0..keys {
            let mut slices: Vec<usize> = points.iter().map(|p| (p[axis] * count as f64) as usize).collect();
            slices.sort_unstable();
            assert_eq!(slices, (0..count).collect::<Vec<_>>());
        }
        assert_eq!(points, latin_hypercube(seed, keys, count));
    }
}

#[test]
fn regress_what_no_run_can_answer_is_said() {
    let targets = targets(&[1.0, 2.0], 0.1);
    let settings = Settings { seed: 1, budget: least_budget(1) };
    let failed = fit(1, &targets, settings, &mut |p| Ok(vec![None; p.len()]));
    assert_eq!(failed.unwrap_err(), Unfit::AllFailed(4));
    let without = fit(1, &targets, settings, &mut |p| {
        let mut one = answers(vec![1.0, 1.0]).unwrap();
        one[1].value = None;
        Ok(vec![Some(one); p.len()])
    });
    assert_eq!(without.unwrap_err().to_string(), "t1: none of the 4 runs spread over the bounds has a value of it");
    // The fewest runs suffice for an answer.
    let fit = search(1, &targets, settings, |p| answers(vec![p[0] * 2.0, 2.0]));
    assert!(fit.evaluations.len() <= settings.budget);
}
