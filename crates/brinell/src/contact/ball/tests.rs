use super::*;

const STEEL: f64 = 206e9 / (1.0 - 0.09);

/// The 6205 of section 17: 7.94 mm balls on 39.04 mm, conformity 0.52.
fn of_6205() -> [Ellipse; 2] {
    [31.1e-3, -46.98e-3].map(|raceway| Ellipse::new(Curvature::new(7.94e-3, raceway, 0.52), STEEL).unwrap())
}

fn radii(along: f64, across: f64) -> Ellipse {
    Ellipse::new(Curvature { along, across }, STEEL).unwrap()
}

#[test]
fn lit_curvatures_of_harris_209() {
    // Harris, Rolling Bearing Analysis, examples on the 209: 12.7 mm balls, raceways of 52.291 and 77.706 mm, both
    // grooves 0.52.
    for (raceway, sum, difference) in [(52.291e-3, 0.2018, 0.9400), (-77.706e-3, 0.1378, 0.9121)] {
        let of = Curvature::new(12.7e-3, raceway, 0.52);
        assert!((1e-3 / of.radius() - sum).abs() < 1e-4, "{}", of.radius());
        assert!((of.difference() - difference).abs() < 1e-4);
    }
}

#[test]
fn lit_6205_of_the_models_description() {
    let [inner, outer] = of_6205();
    for (ours, given) in [
        (inner.stiffness, 2.53251e10),
        (outer.stiffness, 2.68371e10),
        (inner.kappa, 9.3412),
        (outer.kappa, 7.2653),
        (1e3 * inner.across, 75.122),
        (1e3 * outer.across, 73.241),
    ] {
        assert!((ours / given - 1.0).abs() < 1e-5, "{ours} against {given}");
    }
}

#[test]
fn lit_elliptic_integrals_of_tables() {
    // Abramowitz and Stegun, table 17.1: K and E at m = 0.5 and m = 0.99.
    for (m, k, e) in [
        (0.0_f64, FRAC_PI_2, FRAC_PI_2),
        (0.5, 1.854_074_677_301_372, 1.350_643_881_047_675_5),
        (0.99, 3.695_637_362_989_874_7, 1.015_993_545_025_224),
    ] {
        let [first, second] = elliptic_integrals(1.0 / (1.0 - m).sqrt());
        assert!((first / k - 1.0).abs() < 1e-13, "K({m}) = {first}");
        assert!((second / e - 1.0).abs() < 1e-13, "E({m}) = {second}");
    }
}

#[test]
fn analytic_sphere_on_a_plane_is_a_circle() {
    // Hertz: Q = (4/3) E* sqrt(R) delta^1.5 with E* = E'/2, a^2 = R delta.
    let ball = radii(4e-3, 4e-3);
    assert_eq!(ball.kappa, 1.0);
    let hertz = 4.0 / 3.0 * 0.5 * STEEL * 4e-3_f64.sqrt();
    assert!((ball.stiffness / hertz - 1.0).abs() < 1e-14);
    assert!((2.0 * ball.across / 4e-3 - 1.0).abs() < 1e-14);
    let [a, b] = ball.half_axes(100.0);
    assert_eq!(a, b);
    let pressure = (6.0 * 100.0 * (0.5 * STEEL).powi(2) / (PI.powi(3) * 4e-3 * 4e-3)).cbrt();
    assert!((ball.pressure(100.0) / pressure - 1.0).abs() < 1e-13);
}

#[test]
fn prop_axes_change_places_with_the_radii() {
    for ratio in [1.2, 3.0, 20.0, 50.0] {
        let a = radii(1e-3, ratio * 1e-3);
        let b = radii(ratio * 1e-3, 1e-3);
        assert!((a.kappa * b.kappa - 1.0).abs() < 1e-9, "{ratio}");
        assert!((a.stiffness / b.stiffness - 1.0).abs() < 1e-9, "{ratio}");
        // Hamrock and Brewe's approximation: within 5 %.
        assert!((a.kappa / ratio.powf(2.0 / PI) - 1.0).abs() < 0.05, "{ratio}");
    }
}

#[test]
fn analytic_half_axis_is_hamrocks() {
    let [inner, _] = of_6205();
    let radius = Curvature::new(7.94e-3, 31.1e-3, 0.52).radius();
    let second = elliptic_integrals(inner.kappa)[1];
    let force = 120.0;
    let half = (6.0 * inner.kappa.powi(2) * second * force * radius / (PI * STEEL)).cbrt();
    assert!((inner.half_axes(force)[1] / half - 1.0).abs() < 1e-13);
}
