use super::super::test_signals::{Noise, close};
use super::*;

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
    // Far out, by the probability that is left.
    for q in [1e-3, 2e-4, 1e-4, 9e-5, 1e-6, 1e-9, 1e-12, 1e-50_f64] {
        let cauchy = -1.0 / (std::f64::consts::PI * q).tan();
        close(Some(student_t_quantile(q, 1) / cauchy), 1.0, 1e-10);
        let two = (2.0 * q - 1.0) / (2.0 * q * (1.0 - q)).sqrt();
        close(Some(student_t_quantile(q, 2) / two), 1.0, 1e-10);
        close(Some(student_t_quantile(1.0 - q.max(1e-9), 2) / student_t_quantile(q.max(1e-9), 2)), -1.0, 1e-7);
    }
    // Where the expansion about the normal quantile begins, within (1.959 966 356 814: its density, integrated), and without end.
    for (p, many) in [(0.3, 10_000), (0.975, 10_000), (1e-3, 10_000), (1e-50, 1_000_000)] {
        close(Some(student_t_quantile(p, many + 1) / student_t_quantile(p, many)), 1.0, 1e-6);
        close(Some(student_t_quantile(p, u32::MAX) / super::normal_quantile(p)), 1.0, 1e-6);
    }
    close(Some(student_t_quantile(0.975, 1_000_000)), 1.959_966_356_814, 1e-12);
    for (p, freedom) in [(0.5, 0), (0.0, 3), (1.0, 3), (-1.0, 3), (f64::NAN, 3)] {
        assert!(student_t_quantile(p, freedom).is_nan(), "{p} {freedom}");
    }
}

/// z_i = rho z_(i-1) + noise of variance 1, from its stationary distribution on.
fn autoregressive(noise: &mut Noise, n: usize, rho: f64) -> Vec<f64> {
    let mut z = noise.normal() / (1.0 - rho * rho).sqrt();
    (0..n)
        .map(|_| {
            z = rho * z + noise.normal();
            z
        })
        .collect()
}

#[test]
fn analytic_a_cosine_of_the_basis_has_its_amplitude() {
    // z_i = cos(pi 3 (i - 1/2) / n) has c_3 = sqrt(n / 2) and no other.
    let n = 40;
    let z: Vec<f64> = (0..n).map(|i| (std::f64::consts::PI * 3.0 * (f64::from(i) + 0.5) / 40.0).cos()).collect();
    close(Some(cosine(&z, 3)), 20f64.sqrt(), 1e-12);
    for k in [1, 2, 4, 7, 39] {
        assert!(cosine(&z, k).abs() < 1e-12, "{k}");
    }
    let found = scatter(&z).unwrap();
    assert_eq!(found.freedom, 4);
    close(Some(found.error), (20.0 / 4.0 / 40.0_f64).sqrt(), 1e-12);
}

#[test]
fn analytic_interval_of_a_correlated_mean_covers_the_truth_95_times_in_100() {
    // First-order autoregression: S = 1 / (1 - rho)^2, while the variance of one value is 1 / (1 - rho^2). Treating
    // values as independent would cover 74 % at rho = 0.5 and nearly all at -0.5.
    let trials = 4000;
    for (n, rho, least, most) in [
        (13, 0.0, 0.935, 0.965),
        (13, -0.5, 0.935, 0.985),
        // 13 values are few for a correlation over 2.
        (13, 0.5, 0.90, 0.965),
        (60, 0.0, 0.935, 0.965),
        (60, 0.5, 0.93, 0.965),
        (60, -0.5, 0.935, 0.97),
        (128, 0.8, 0.925, 0.965),
    ] {
        let mut noise = Noise::new(21);
        let (mut covered, mut freedom) = (0, 0);
        for _ in 0..trials {
            let z = autoregressive(&mut noise, n, rho);
            let mean = z.iter().sum::<f64>() / n as f64;
            let scatter = scatter(&z).unwrap();
            freedom = scatter.freedom;
            covered += usize::from(mean.abs() <= scatter.half_width());
        }
        let share = covered as f64 / f64::from(trials);
        assert!((least..most).contains(&share), "{n} values, rho {rho}: {share} with {freedom} degrees of freedom");
    }
}

#[test]
fn prop_too_short_or_not_finite_has_no_scatter() {
    let z: Vec<f64> = (0..8).map(f64::from).collect();
    assert!(scatter(&z).is_some());
    assert_eq!(scatter(&z[..6]).unwrap().freedom, 3);
    assert_eq!(scatter(&z[..5]), None);
    assert_eq!(scatter(&[f64::NAN; 9]), None);
    assert_eq!(scatter(&[0.1; 30]).unwrap().error, 0.0);
    // A constant beside the series changes nothing.
    let shifted: Vec<f64> = z.iter().map(|z| z + 1024.0).collect();
    assert_eq!(scatter(&shifted), scatter(&z));
}

#[test]
fn analytic_drift_is_called_when_there_is_one() {
    let trials = 2000;
    let mut noise = Noise::new(22);
    for (n, rho) in [(20, 0.0), (60, 0.5), (128, 0.8)] {
        let mut called = [0; 2];
        for _ in 0..trials {
            let z = autoregressive(&mut noise, n, rho);
            called[0] += usize::from(drift(&z).is_some());
            // Settles with a time constant of a tenth of the record, from 30 standard errors of its mean.
            let height = 30.0 / (1.0 - rho) / (n as f64).sqrt();
            let settling = z.iter().enumerate();
            let settling: Vec<f64> = settling.map(|(i, z)| z + height * (-10.0 * i as f64 / n as f64).exp()).collect();
            called[1] += usize::from(drift(&settling).is_some_and(|by| by > 0.0));
        }
        // One in 500 by its own account; a beginning that is correlated with itself is called a little more often.
        assert!(called[0] < trials / 100, "{n} {rho}: {called:?}");
        // Of 20 values the last half leaves 4 degrees of freedom, and less power.
        assert!(called[1] > trials / 3, "{n} {rho}: {called:?}");
    }
    assert_eq!(drift(&[1.0, 9.0]), None);
    assert_eq!(drift(&[3.0; 40]), None);
}

/// What drifts all along, and by the same law to the end, inflates the scatter of the last half as well.
#[test]
fn analytic_a_drift_that_goes_on_is_called() {
    let mut noise = Noise::new(23);
    for n in [20, 60, 400] {
        for constant in [0.3, 1.0, 10.0] {
            let z = autoregressive(&mut noise, n, 0.5);
            let decaying: Vec<f64> = (z.iter().enumerate())
                .map(|(i, z)| 0.01 * z + 3.0 * (-(i as f64) / (constant * n as f64)).exp())
                .collect();
            assert!(drift(&decaying).is_some_and(|by| by > 0.0), "{n} {constant}");
        }
    }
}
