//! The cage's guidance film: published coefficients, its integral, what it dissipates, and how cages whirl in it.

use crate::common::cases::{Random, raceway_film};
use crate::common::simulate;
use brinell::accuracy::settings;
use brinell::cage::{Guide, HalfFilm, LandLaw, MAX_ECCENTRICITY};
use brinell::model::{Model, Motion};
use brinell::scenario::{Accuracy, Guidance, GuidanceFilm, RacewayFilm, Scenario};
use brinell::solver::Stepper;
use brinell::start;
use std::f64::consts::{PI, TAU};

/// The bearing of Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines (2010), Example 5.5.1, whose oil is
/// 0.1 Pa s.
const BEARING: Guide = Guide {
    film: Some(GuidanceFilm::Dynamic),
    viscosity: 0.1,
    clearance: 1e-4,
    width: 0.03,
    radius: 0.05,
    land_stiffness: 0.0,
    land_damping: 0.0,
    wall: LandLaw::Linear,
};
/// Its shaft's speed: 1500 r/min.
const SPEED: f64 = 1500.0 * TAU / 60.0;

fn film(guide: &Guide, offset: [f64; 2], velocity: [f64; 2]) -> [f64; 2] {
    guide.force(offset, velocity, SPEED, 0.0).film
}

/// The load that the film carries at rest at the eccentricity ratio `eps`, N, and its eight coefficients: stiffness
/// (N/m) and damping (N s/m), uu, uv, vu, vv with v along the load and u turned from it by -90 degrees.
fn coefficients(eps: f64) -> (f64, [f64; 4], [f64; 4]) {
    let at = [eps * BEARING.clearance, 0.0];
    let force = film(&BEARING, at, [0.0; 2]);
    let load = force[0].hypot(force[1]);
    let v = [-force[0] / load, -force[1] / load];
    let u = [v[1], -v[0]];
    let along = |f: [f64; 2], axis: [f64; 2]| f[0] * axis[0] + f[1] * axis[1];
    // Central differences over a millionth of the gap, and of its speed around it.
    let step = 1e-6 * BEARING.clearance;
    let mut stiffness = [0.0; 4];
    let mut damping = [0.0; 4];
    for (column, axis) in [u, v].into_iter().enumerate() {
        let moved = |share: f64| {
            let x = [at[0] + share * step * axis[0], at[1] + share * step * axis[1]];
            film(&BEARING, x, [0.0; 2])
        };
        let pushed = |share: f64| {
            let w = [share * step * SPEED * axis[0], share * step * SPEED * axis[1]];
            film(&BEARING, at, w)
        };
        for (row, felt) in [u, v].into_iter().enumerate() {
            let slope = |up: [f64; 2], down: [f64; 2]| along(up, felt) - along(down, felt);
            stiffness[2 * row + column] = -slope(moved(1.0), moved(-1.0)) / (2.0 * step);
            damping[2 * row + column] = -slope(pushed(1.0), pushed(-1.0)) / (2.0 * step * SPEED);
        }
    }
    (load, stiffness, damping)
}

/// The short bearing's coefficients over load / c and load / (c speed): Friswell et al. (2010), Section 5.5.1; the same
/// in Lund and Thomsen (1978) and Childs (1993).
fn published(eps: f64) -> ([f64; 4], [f64; 4]) {
    let (e2, p2) = (eps * eps, PI * PI);
    let root = (1.0 - e2).sqrt();
    let h0 = (p2 * (1.0 - e2) + 16.0 * e2).powf(-1.5);
    let cross = -8.0 * h0 * (p2 * (1.0 + 2.0 * e2) - 16.0 * e2);
    let stiffness = [
        4.0 * h0 * (p2 * (2.0 - e2) + 16.0 * e2),
        h0 * PI * (p2 * (1.0 - e2).powi(2) - 16.0 * e2 * e2) / (eps * root),
        -h0 * PI * (p2 * (1.0 - e2) * (1.0 + 2.0 * e2) + 32.0 * e2 * (1.0 + e2)) / (eps * root),
        4.0 * h0 * (p2 * (1.0 + 2.0 * e2) + 32.0 * e2 * (1.0 + e2) / (1.0 - e2)),
    ];
    let damping = [
        h0 * TAU * root * (p2 * (1.0 + 2.0 * e2) - 16.0 * e2) / eps,
        cross,
        cross,
        h0 * TAU * (p2 * (1.0 - e2).powi(2) + 48.0 * e2) / (eps * root),
    ];
    (stiffness, damping)
}

#[test]
fn lit_short_bearing_stiffness_and_damping_at_five_eccentricities() {
    for eps in [0.1, 0.3, 0.5, 0.7, 0.9] {
        let (load, stiffness, damping) = coefficients(eps);
        let (a, b) = published(eps);
        let scales = [load / BEARING.clearance, load / (BEARING.clearance * SPEED)];
        for (own, theirs, scale, what) in [(stiffness, a, scales[0], "stiffness"), (damping, b, scales[1], "damping")] {
            let size = theirs.iter().fold(0.0f64, |s, x| s.max(x.abs()));
            for (own, theirs) in own.into_iter().zip(theirs) {
                // What central differences leave: (1e-6 / (1 - eps))^2, and round-off over 1e-6.
                assert!(
                    (own / scale - theirs).abs() < 1e-8 * size,
                    "eps {eps}: {what} {} against {theirs}",
                    own / scale
                );
            }
        }
    }
}

/// Friswell et al. (2010), Example 5.5.1: 525 N at 1500 r/min; its four digits.
#[test]
fn lit_short_bearing_example_of_friswell() {
    // The eccentricity that carries the load, by bisection.
    let (mut low, mut high) = (0.0, 0.9);
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if coefficients(middle).0 < 525.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    println!("eccentricity ratio {low:.4}");
    let (_, stiffness, damping) = coefficients(low);
    let printed = [12.81e6, 16.39e6, -25.06e6, 8.815e6];
    for (own, printed) in stiffness.into_iter().zip(printed) {
        assert!((own / printed - 1.0).abs() < 5e-4, "{own} N/m, printed {printed}");
    }
    let printed = [232.9e3, -81.92e3, -81.92e3, 294.9e3];
    for (own, printed) in damping.into_iter().zip(printed) {
        assert!((own / printed - 1.0).abs() < 5e-4, "{own} N s/m, printed {printed}");
    }
}

/// A random guide and a state of it: offset up to 1.3 gaps, velocities from far below to far above what rotation gives,
/// both speeds.
fn random_state(random: &mut Random) -> (Guide, [f64; 2], [f64; 2], f64, f64) {
    let mut within = |low: f64, high: f64| low + (high - low) * 0.5 * (1.0 + random.signed());
    let guide = Guide {
        film: Some(GuidanceFilm::Dynamic),
        viscosity: within(1e-3, 0.3),
        clearance: within(2e-5, 1e-3),
        width: within(2e-3, 2e-2),
        radius: within(0.01, 0.1),
        land_stiffness: 1e7,
        land_damping: 20.0,
        wall: LandLaw::Linear,
    };
    let (angle, e) = (within(-PI, PI), within(0.0, 1.3) * guide.clearance);
    let (toward, speeds) = (within(-PI, PI), [within(-300.0, 300.0), within(-300.0, 300.0)]);
    let speed = 100.0 * guide.clearance * 10f64.powf(within(-3.0, 2.0));
    (guide, [e * angle.cos(), e * angle.sin()], [speed * toward.cos(), speed * toward.sin()], speeds[0], speeds[1])
}

/// v* of section 6: the velocity seen in the frame that turns at half the sum of both speeds.
fn squeeze(offset: [f64; 2], velocity: [f64; 2], sum: f64) -> [f64; 2] {
    [velocity[0] + 0.5 * sum * offset[1], velocity[1] - 0.5 * sum * offset[0]]
}

/// The force as section 6 states it, by the midpoint rule: what a Gauss rule in `cage/film.rs` shows for the integrals
/// alone.
fn by_quadrature(g: &Guide, offset: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    const POINTS: usize = 20_000;
    let e = offset[0].hypot(offset[1]);
    let held = (MAX_ECCENTRICITY * g.clearance / e).min(1.0);
    let middle = v[1].atan2(v[0]);
    let mut sum = [0.0; 2];
    for k in 0..POINTS {
        let angle = middle + PI * ((k as f64 + 0.5) / POINTS as f64 - 0.5);
        let (sin, cos) = angle.sin_cos();
        let h = g.clearance - held * (offset[0] * cos + offset[1] * sin);
        let share = (v[0] * cos + v[1] * sin) / h.powi(3);
        sum[0] += share * cos;
        sum[1] += share * sin;
    }
    let scale = -g.viscosity * g.radius * g.width.powi(3) * PI / POINTS as f64;
    sum.map(|s| scale * s)
}

#[test]
fn analytic_film_is_the_integral_of_its_pressure_in_any_motion() {
    let mut random = Random::new(5);
    for _ in 0..500 {
        let (guide, offset, velocity, cage, ring) = random_state(&mut random);
        let own = guide.force(offset, velocity, cage, ring).film;
        let sum = by_quadrature(&guide, offset, squeeze(offset, velocity, cage + ring));
        let off = (own[0] - sum[0]).hypot(own[1] - sum[1]) / sum[0].hypot(sum[1]);
        // The midpoint rule's, (pi / 20000)^2 times the integrand's slope at the ends, up to 20 of it where the gap is
        // 0.05 C.
        assert!(off < 1e-6, "{off:e} of {sum:?} N: {guide:?} {offset:?} {velocity:?}");
    }
}

#[test]
fn analytic_resting_centres_feel_the_papers_film() {
    let mut random = Random::new(6);
    for _ in 0..2000 {
        let (guide, offset, _, cage, ring) = random_state(&mut random);
        // Beyond 0.95 C_g v* turns with the whole e, and the paper's force is that of 0.95 C_g.
        let e = offset[0].hypot(offset[1]);
        if e > MAX_ECCENTRICITY * guide.clearance {
            continue;
        }
        let paper = Guide { film: Some(GuidanceFilm::QuasiStatic), ..guide };
        let dynamic = guide.force(offset, [0.0; 2], cage, ring);
        let paper = paper.force(offset, [0.0; 2], cage, ring);
        let size = paper.film[0].hypot(paper.film[1]);
        for k in 0..2 {
            assert!((dynamic.film[k] - paper.film[k]).abs() <= 1e-13 * size, "{dynamic:?} {paper:?}");
        }
        assert_eq!(dynamic.moment, paper.moment);
    }
}

#[test]
fn prop_film_only_dissipates_in_its_rotating_frame() {
    let mut random = Random::new(7);
    for _ in 0..100_000 {
        let (guide, offset, velocity, cage, ring) = random_state(&mut random);
        let v = squeeze(offset, velocity, cage + ring);
        let f = guide.force(offset, velocity, cage, ring);
        let power = f.film[0] * v[0] + f.film[1] * v[1];
        assert!(power < 0.0, "{power} W: {guide:?} {offset:?} {velocity:?}");
        // And no direction is damped by more than the solver assumes: -dF/dv is the matrix of the integrals.
        assert!(f.film[0].hypot(f.film[1]) <= f.damping * v[0].hypot(v[1]) * (1.0 + 1e-12));
    }
}

#[test]
fn prop_film_is_continuous_through_the_centre_and_about_it() {
    // Both ways round the centre and across it the integrals approach those of a film of even thickness, pi/2 each.
    for k in 0..16 {
        let angle = f64::from(k) * PI / 8.0;
        for eps in [0.0, 1e-15, 1e-9, 1e-6] {
            let half = HalfFilm::at(eps * angle.cos(), eps * angle.sin());
            let off = (half.along - 0.5 * PI).abs() + (half.across - 0.5 * PI).abs() + half.mixed.abs();
            assert!(off <= 1e-14 + 12.0 * eps, "{eps}: {half:?}");
        }
    }
}

/// How a cage moved about the ring that guides it.
struct Whirl {
    /// Turns of its centre over its own.
    ratio: f64,
    /// Mean eccentricity over the guide's clearance.
    eccentricity: f64,
}

/// Each cage from `from` to `to`, s. The centre's angle is unwrapped from step to step: half a turn of the cage takes
/// thousands.
fn whirl(s: &Scenario, from: f64, to: f64) -> Vec<Whirl> {
    let model = Model::new(s).unwrap();
    let mut motion = Motion::new(&model);
    let y = start::state(&model).unwrap();
    let mut stepper = Stepper::new(&mut motion, settings(&model, Accuracy::Standard), 0.0, &y);
    while stepper.t() < from {
        stepper.step(&mut motion).unwrap();
    }
    let (l, land) = (&model.layout, model.land());
    let offset = |y: &[f64], row: usize| {
        let at = l.cage(row);
        let ring = land.centre(row, y);
        [y[at] - ring[0], y[at + 1] - ring[1]]
    };
    let mut before = stepper.y().to_vec();
    let begun = before.clone();
    let begin = stepper.t();
    let mut turned = vec![0.0; l.rows];
    let mut aside = vec![0.0; l.rows];
    while stepper.t() < to {
        let t = stepper.t();
        stepper.step(&mut motion).unwrap();
        let y = stepper.y();
        for row in 0..l.rows {
            let (a, b) = (offset(&before, row), offset(y, row));
            turned[row] += (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
            aside[row] += (stepper.t() - t) * b[0].hypot(b[1]);
        }
        before.copy_from_slice(y);
    }
    (0..l.rows)
        .map(|row| {
            let own = l.cage(row) + 2;
            Whirl {
                ratio: turned[row] / (before[own] - begun[own]),
                eccentricity: aside[row] / ((stepper.t() - begin) * model.guide.clearance),
            }
        })
        .collect()
}

/// A healthy catalogue bearing under 300 N at 1800 r/min, every other key at its default.
fn healthy(preset: &str, guidance: Guidance, film: GuidanceFilm) -> Scenario {
    let text = format!(
        "[bearing]\npreset = \"{preset}\"\n[operation]\nspeed_rpm = 1800.0\nload_n = [300.0, 0.0]\nload_on = \"outer-ring\"\n"
    );
    let mut s = crate::common::read_li2023(&text, &[]).unwrap().scenario;
    s.cage.guidance = guidance;
    s.cage.guidance_film = film;
    s
}

/// The cages from 0.1 to 0.5 s, printed.
fn told(name: &str, s: &Scenario) -> Vec<Whirl> {
    let cages = whirl(s, 0.1, 0.5);
    for w in &cages {
        println!(
            "{name}, guided by {:?}, {:?}: whirl {:.3} of the cage's speed, eccentricity {:.3} of the gap",
            s.cage.guidance, s.cage.guidance_film, w.ratio, w.eccentricity
        );
    }
    cages
}

/// A plain film's centre whirls at half the sum of its surfaces' speeds at most: there v* vanishes, and with it the
/// force.
#[test]
fn lit_cages_whirl_at_most_half_as_fast_as_they_turn() {
    use Guidance::{InnerRing, OuterRing};
    for (preset, guidance) in
        [("NN3007", OuterRing), ("N205", OuterRing), ("N205", InnerRing), ("NU206", OuterRing), ("NU206", InnerRing)]
    {
        let mut s = healthy(preset, guidance, GuidanceFilm::Dynamic);
        if preset != "NN3007" {
            // As of a cage that runs on a ring; theirs are guided by rollers.
            s.cage.guide_clearance_mm = 0.2;
        }
        for w in told(preset, &s) {
            assert!(w.ratio.abs() <= 0.5, "{preset}, {guidance:?}: {}", w.ratio);
        }
    }
}

/// What the paper's film does instead, and why it is not the default.
#[test]
fn regress_quasi_static_film_makes_a_cage_whirl_faster_than_it_turns() {
    let s = healthy("NN3007", Guidance::OuterRing, GuidanceFilm::QuasiStatic);
    for w in told("NN3007", &s) {
        assert!(w.ratio > 1.0, "{}", w.ratio);
    }
}

/// Rollers of a slow bearing fall from the outer to the inner raceway where nothing presses them; without oil each fall
/// is an impact on steel.
#[test]
fn prop_the_raceway_film_cushions_rollers_that_fall() {
    let mut s = raceway_film();
    s.simulation.duration_s = 0.5;
    let level = |film: RacewayFilm| {
        let mut s = s.clone();
        s.lubricant.raceway_film = film;
        let (rows, _) = simulate(&s);
        let x = &rows.column("outer_ay")[rows.column("outer_ay").len() / 5..];
        (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt()
    };
    let [dry, oiled] = [RacewayFilm::None, RacewayFilm::Squeeze].map(level);
    println!("outer_ay: {dry:.3} m/s^2 dry, {oiled:.3} m/s^2 oiled");
    assert!(oiled < 0.5 * dry, "{dry} {oiled}");
}
