use super::super::test_signals::{Noise, cosine, integer_sequence};
use super::*;

fn moments(x: &[f64]) -> Moments {
    let mut moments = Moments::new();
    x.iter().for_each(|&v| moments.push(v));
    moments
}

fn close(value: Option<f64>, expected: f64, relative: f64) {
    let value = value.expect("defined");
    assert!(
        (value - expected).abs() <= relative * expected.abs(),
        "{value} for {expected}"
    );
}

#[test]
fn analytic_sine() {
    let m = moments(&cosine(100_000, 1000.0, 10.0, 2.5, 0.0));
    let root_half = 0.5f64.sqrt();
    close(m.get(Indicator::Rms), 2.5 * root_half, 1e-12);
    close(m.get(Indicator::Peak), 2.5, 1e-12);
    close(m.get(Indicator::PeakToPeak), 5.0, 1e-12);
    close(m.get(Indicator::CrestFactor), 2f64.sqrt(), 1e-12);
    close(m.get(Indicator::Kurtosis), 1.5, 1e-11);
    // Mean |cos| over 100 samples a period: (cot(pi/100)) / 50.
    let mean_absolute = 2.5 / (std::f64::consts::PI / 100.0).tan() / 50.0;
    close(
        m.get(Indicator::ShapeFactor),
        2.5 * root_half / mean_absolute,
        1e-12,
    );
    close(m.get(Indicator::ImpulseFactor), 2.5 / mean_absolute, 1e-12);
    assert!(m.get(Indicator::Skewness).unwrap().abs() < 1e-12);
    assert!(m.get(Indicator::Mean).unwrap().abs() < 1e-14);
}

#[test]
fn analytic_small_sample() {
    // 0, 0, 0, 4: mean 1, central moments 3, 6, 21.
    let m = moments(&[0.0, 0.0, 0.0, 4.0]);
    close(m.get(Indicator::Mean), 1.0, 0.0);
    close(m.get(Indicator::StandardDeviation), 3f64.sqrt(), 1e-15);
    close(m.get(Indicator::Rms), 2.0, 1e-15);
    close(m.get(Indicator::Skewness), 6.0 / 27f64.sqrt(), 1e-15);
    close(m.get(Indicator::Kurtosis), 21.0 / 9.0, 1e-15);
}

#[test]
fn prop_many_at_once_are_one_by_one() {
    let x: Vec<f64> = (Noise::new(8).normals(5003).iter())
        .map(|v| 40.0 + v)
        .collect();
    for n in [1, 3, 1024, 1027, 5003] {
        let (each, mut all) = (moments(&x[..n]), Moments::new());
        all.extend(&x[..n / 3]);
        all.extend(&x[n / 3..n]);
        assert_eq!(
            (all.count(), all.min(), all.max()),
            (each.count(), each.min(), each.max())
        );
        for i in Indicator::ALL {
            assert_eq!(all.get(i).is_some(), each.get(i).is_some(), "{n} {i:?}");
            if let Some(value) = each.get(i) {
                close(all.get(i), value, 1e-11);
            }
        }
    }
    let mut constant = Moments::new();
    constant.extend(&[0.1; 3000]);
    assert_eq!(constant.standard_deviation(), 0.0);
    assert_eq!(constant.get(Indicator::Kurtosis), None);
    let mut holes = Moments::new();
    holes.extend(&[1.0, f64::NAN, 2.0]);
    assert_eq!(holes.get(Indicator::Rms), None);
}

#[test]
fn prop_blocks_of_a_slice_end_where_pushed_ones_do() {
    let x = Noise::new(9).normals(10_000);
    for samples in [0.5, 1.0, 1.3, 77.7, 1706.6, 9999.5, 20_000.0] {
        let (all, mut one) = (Blocks::of(&x, samples), Blocks::new());
        let mut end = f64::max(samples, 1.0);
        for (i, v) in x.iter().enumerate() {
            one.push(*v);
            if (i + 1) as f64 >= end {
                one.end_block();
                end += f64::max(samples, 1.0);
            }
        }
        let counts = |b: &Blocks| -> Vec<u64> {
            let (closed, periods) = b.whole_blocks();
            (closed.iter().map(Moments::count))
                .chain([periods, b.open.count()])
                .collect()
        };
        assert_eq!(counts(&all), counts(&one), "{samples}");
    }
}

#[test]
fn analytic_normal_noise() {
    let n = 1_000_000;
    let m = moments(&Noise::new(1).normals(n));
    // Four standard errors: sqrt(24/n) for kurtosis, sqrt(6/n) for skewness.
    assert!((m.get(Indicator::Kurtosis).unwrap() - 3.0).abs() < 4.0 * (24.0 / n as f64).sqrt());
    assert!(m.get(Indicator::Skewness).unwrap().abs() < 4.0 * (6.0 / n as f64).sqrt());
    close(
        m.get(Indicator::ShapeFactor),
        std::f64::consts::FRAC_PI_2.sqrt(),
        3e-3,
    );
}

#[test]
fn prop_large_mean_costs_no_digits() {
    let small = Noise::new(2).normals(20_000);
    // The shift is exact: multiples of 2^-30 below 2^23 fit in 53 bits.
    let quantum = (1u64 << 30) as f64;
    let small: Vec<f64> = small
        .iter()
        .map(|v| (v * quantum).round() / quantum)
        .collect();
    let shifted: Vec<f64> = small.iter().map(|v| v + 1e6).collect();
    for indicator in [
        Indicator::StandardDeviation,
        Indicator::Skewness,
        Indicator::Kurtosis,
    ] {
        let (a, b) = (
            moments(&small).get(indicator),
            moments(&shifted).get(indicator),
        );
        assert!(
            (a.unwrap() - b.unwrap()).abs() < 1e-8,
            "{indicator:?} {a:?} {b:?}"
        );
    }
}

#[test]
fn prop_merge_equals_one_pass() {
    let x: Vec<f64> = Noise::new(3)
        .normals(5000)
        .iter()
        .map(|v| 3.0 + v * v)
        .collect();
    for cut in [0, 1, 17, 2500, 4999, 5000] {
        let merged = moments(&x[..cut]).merge(&moments(&x[cut..]));
        for indicator in Indicator::ALL {
            close(
                merged.get(indicator),
                moments(&x).get(indicator).unwrap(),
                1e-12,
            );
        }
    }
}

#[test]
fn prop_undefined_is_none() {
    let constant = moments(&[0.0; 5]);
    assert_eq!(constant.get(Indicator::Rms), Some(0.0));
    assert_eq!(constant.get(Indicator::Kurtosis), None);
    assert_eq!(constant.get(Indicator::CrestFactor), None);
    for indicator in Indicator::ALL {
        assert_eq!(Moments::new().get(indicator), None);
        assert_eq!(
            moments(&[1.0, f64::NAN, 2.0]).get(indicator),
            None,
            "{indicator:?}"
        );
    }
}

#[test]
fn xval_scipy_moments() {
    // SciPy 1.17.1: stats.kurtosis(x, fisher=False), stats.skew(x).
    let m = moments(&integer_sequence(600));
    close(m.get(Indicator::Kurtosis), 6.822885324720851, 1e-13);
    close(m.get(Indicator::Skewness), 1.3743278656114082, 1e-13);
}

#[test]
fn xval_scipy_student_t() {
    // SciPy 1.17.1: stats.t.ppf(0.975, freedom).
    for (freedom, t) in [
        (1, 12.706204736174694),
        (2, 4.302652729749462),
        (3, 3.1824463052837078),
        (4, 2.7764451051977934),
        (5, 2.5705818356363146),
        (14, 2.144786687917804),
        (31, 2.039513446396408),
        (63, 1.998340542520741),
    ] {
        close(Some(student_t_quantile(0.975, freedom)), t, 1e-12);
    }
}

#[test]
fn analytic_student_t() {
    let p: f64 = 0.995;
    let cauchy = (std::f64::consts::PI * (p - 0.5)).tan();
    close(Some(student_t_quantile(p, 1)), cauchy, 1e-12);
    let two = (2.0 * p - 1.0) / (2.0 * p * (1.0 - p)).sqrt();
    close(Some(student_t_quantile(p, 2)), two, 1e-12);
    close(Some(student_t_quantile(1.0 - p, 2)), -two, 1e-12);
}

#[test]
fn prop_blocks_stay_bounded_and_lose_nothing() {
    let x = Noise::new(4).normals(20_000);
    let mut blocks = Blocks::new();
    for (i, &v) in x.iter().enumerate() {
        blocks.push(v);
        if i % 10 == 9 {
            blocks.end_block();
        }
        assert!(blocks.closed.len() <= Blocks::MOST);
    }
    // 2000 periods: 32 to a block is the first power of two that needs no more than 64.
    let (closed, periods) = blocks.whole_blocks();
    assert_eq!((closed.len(), periods), (62, 32));
    assert!(closed.iter().all(|block| block.count() == 320));
    assert_eq!(blocks.whole().count(), 20_000);
    for (i, block) in closed.iter().enumerate() {
        close(
            Some(block.rms()),
            moments(&x[320 * i..320 * (i + 1)]).rms(),
            1e-13,
        );
    }
    close(
        blocks.whole().get(Indicator::Kurtosis),
        moments(&x).get(Indicator::Kurtosis).unwrap(),
        1e-12,
    );
}

#[test]
fn prop_too_few_blocks_give_no_interval() {
    let mut blocks = Blocks::new();
    for expected in [false, false, true] {
        (0..10).for_each(|i| blocks.push(f64::from(i)));
        blocks.end_block();
        assert_eq!(
            blocks.estimate(Indicator::Rms).unwrap().interval.is_some(),
            expected
        );
    }
    assert_eq!(Blocks::new().estimate(Indicator::Rms), None);
}

#[test]
fn analytic_interval_covers_the_truth_95_times_in_100() {
    // RMS of white noise, 15 blocks as in half a second at 1800 r/min; the bias of a block's RMS is 1/(4n).
    let (mut covered, trials) = (0, 2000);
    let mut noise = Noise::new(5);
    for _ in 0..trials {
        let mut blocks = Blocks::new();
        for _ in 0..15 {
            (0..200).for_each(|_| blocks.push(noise.normal()));
            blocks.end_block();
        }
        let interval = blocks.estimate(Indicator::Rms).unwrap().interval.unwrap();
        if interval.low <= 1.0 && 1.0 <= interval.high {
            covered += 1;
        }
    }
    let share = f64::from(covered) / f64::from(trials);
    // Four standard errors of a binomial share: 0.0195.
    assert!((share - 0.95).abs() < 0.0195, "covered {share}");
}
