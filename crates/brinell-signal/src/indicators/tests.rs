use super::super::test_signals::{Noise, close, cosine};
use super::*;

fn moments(x: &[f64]) -> Moments {
    let mut moments = Moments::new();
    x.iter().for_each(|&v| moments.push(v));
    moments
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
    close(m.get(Indicator::ShapeFactor), 2.5 * root_half / mean_absolute, 1e-12);
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
    let x: Vec<f64> = (Noise::new(8).normals(5003).iter()).map(|v| 40.0 + v).collect();
    for n in [1, 3, 1024, 1027, 5003] {
        let (each, mut all) = (moments(&x[..n]), Moments::new());
        all.extend(&x[..n / 3]);
        all.extend(&x[n / 3..n]);
        assert_eq!((all.count(), all.min(), all.max()), (each.count(), each.min(), each.max()));
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
fn analytic_normal_noise() {
    let n = 1_000_000;
    let m = moments(&Noise::new(1).normals(n));
    // Four standard errors: sqrt(24/n) for kurtosis, sqrt(6/n) for skewness.
    assert!((m.get(Indicator::Kurtosis).unwrap() - 3.0).abs() < 4.0 * (24.0 / n as f64).sqrt());
    assert!(m.get(Indicator::Skewness).unwrap().abs() < 4.0 * (6.0 / n as f64).sqrt());
    close(m.get(Indicator::ShapeFactor), std::f64::consts::FRAC_PI_2.sqrt(), 3e-3);
}

#[test]
fn prop_large_mean_costs_no_digits() {
    let small = Noise::new(2).normals(20_000);
    // The shift is exact: multiples of 2^-30 below 2^23 fit in 53 bits.
    let quantum = (1u64 << 30) as f64;
    let small: Vec<f64> = small.iter().map(|v| (v * quantum).round() / quantum).collect();
    let shifted: Vec<f64> = small.iter().map(|v| v + 1e6).collect();
    for indicator in [Indicator::StandardDeviation, Indicator::Skewness, Indicator::Kurtosis] {
        let (a, b) = (moments(&small).get(indicator), moments(&shifted).get(indicator));
        assert!((a.unwrap() - b.unwrap()).abs() < 1e-8, "{indicator:?} {a:?} {b:?}");
    }
}

#[test]
fn prop_merge_equals_one_pass() {
    let x: Vec<f64> = Noise::new(3).normals(5000).iter().map(|v| 3.0 + v * v).collect();
    for cut in [0, 1, 17, 2500, 4999, 5000] {
        let merged = moments(&x[..cut]).merge(&moments(&x[cut..]));
        for indicator in Indicator::ALL {
            close(merged.get(indicator), moments(&x).get(indicator).unwrap(), 1e-12);
        }
    }
}

#[test]
fn analytic_central_moments_about_another_center() {
    let x = Noise::new(4).normals(300);
    let m = moments(&x);
    for center in [m.mean(), 0.0, -2.5] {
        for (p, found) in (2..).zip(m.central(center)) {
            let sum: f64 = x.iter().map(|v| (v - center).powi(p)).sum();
            close(Some(found), sum / 300.0, 1e-11);
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
        assert_eq!(moments(&[1.0, f64::NAN, 2.0]).get(indicator), None, "{indicator:?}");
    }
}
