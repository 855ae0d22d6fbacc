//! What is kept of a run, fed with motions that are known: the bearing in motion, cage orbits, slip over time and
//! place.

use crate::common::cases::{healthy, rectangle};
use brinell::channel::Frame;
use brinell::defect::{Side, wrap};
use brinell::model::{Model, Workspace};
use brinell::observe::load_zone::{BINS, LoadZone, Places};
use brinell::observe::motion::{FRAMES, Motion};
use brinell::observe::orbit::{CageOrbit, TURNS};
use brinell::observe::passes::Passes;
use brinell::observe::slip::Slip;
use brinell::observe::slip_course::{STRETCHES, SlipCourse};
use brinell::scenario::{Guidance, ModelKind, Scenario, Speed};
use std::f64::consts::{PI, TAU};

const RATE: f64 = 25_600.0;

/// Goes through `samples` instants of a state that `set` fills: (t, y, workspace).
fn go(model: &Model, samples: u64, mut set: impl FnMut(f64, &mut [f64], &mut Workspace), mut take: impl FnMut(&Frame)) {
    let mut ws = Workspace::new(model);
    let mut y = vec![0.0; 2 * model.layout.dof()];
    let a = vec![0.0; model.layout.dof()];
    for index in 0..samples {
        let t = index as f64 / RATE;
        set(t, &mut y, &mut ws);
        take(&Frame { model, t, y: &y, a: &a, ws: &ws });
    }
}

fn model(change: impl FnOnce(&mut Scenario)) -> Model {
    let mut scenario = healthy();
    change(&mut scenario);
    Model::new(&scenario).unwrap()
}

fn speed(model: &Model) -> f64 {
    model.rotation.at(0.0).0
}

/// Rates of the cages, the orbits and the spins that slip by these shares.
fn slipping(model: &Model, y: &mut [f64], cage: f64, orbit: f64, spin: f64) {
    let l = &model.layout;
    let (rolling, spinning) = (model.rolling_orbit_speed(speed(model)), model.rolling_spin_speed(speed(model)));
    let dof = l.dof();
    for row in 0..l.rows {
        y[dof + l.cage(row) + 2] = (1.0 - cage) * rolling;
    }
    for slot in 0..l.rollers() {
        y[dof + l.theta() + slot] = (1.0 - orbit) * rolling;
        y[dof + l.phi() + slot] = (1.0 - spin) * spinning;
    }
}

#[test]
fn analytic_slip_over_time_is_the_mean_of_each_stretch() {
    let model = model(|_| ());
    let mut course = SlipCourse::new(&model.layout);
    // 3000 samples do not fit one by one: two by two, and then four by four.
    let samples = 3000;
    let ramp = |t: f64| 1e-5 * t * RATE;
    go(
        &model,
        samples,
        |t, y, _| slipping(&model, y, ramp(t), -0.5 * ramp(t), 0.01),
        |f| course.take(f, Places::default().at(f), false),
    );
    assert_eq!(course.samples_per_stretch(), 4);
    for row in 0..model.layout.rows {
        let slip = course.over_time(row);
        assert_eq!(slip.cage.len(), 750);
        assert!(slip.cage.len() <= STRETCHES);
        for (k, value) in slip.cage.iter().enumerate() {
            let mean = 1e-5 * (4.0 * k as f64 + 1.5);
            assert!((value - mean).abs() < 1e-12, "{k}: {value} {mean}");
            assert!((slip.orbit[k] + 0.5 * mean).abs() < 1e-12);
            assert!((slip.spin[k] - 0.01).abs() < 1e-12);
        }
        // Nothing had settled: no place was counted.
        assert!(course.over_angle(row).orbit.is_empty());
    }
}

#[test]
fn analytic_slip_through_rest_is_that_of_the_way() {
    // Half a turn forward, half a turn back, and three at -10 a second.
    let model = model(|s| s.operation.speed_rpm = Speed::Profile(vec![[0.0, 600.0], [0.2, -600.0]]));
    let l = &model.layout;
    let dof = l.dof();
    let mut slip = Slip::new(l);
    let extra = 0.3;
    go(
        &model,
        (0.501 * RATE) as u64,
        |t, y, _| {
            let rolling = model.rolling_orbit_speed(model.rotation.at(t).0);
            for row in 0..l.rows {
                y[dof + l.cage(row) + 2] = 0.98 * rolling + extra;
            }
            y[dof + l.theta()..][..l.rollers()].fill(0.98 * rolling + extra);
        },
        |f| slip.take(f),
    );
    let way = 4.0 * TAU * model.rolling_orbit_speed(1.0);
    let exact = 0.02 - extra * (0.1 - 0.4) / way;
    for row in &slip.rows {
        for found in [row.cage(), row.unloaded_orbit()] {
            let value = found.unwrap().value;
            assert!((value / exact - 1.0).abs() < 1e-3, "{value} {exact}");
        }
    }
}

#[test]
fn analytic_slip_over_the_place_is_found_where_it_was() {
    let model = model(|_| ());
    let l = &model.layout;
    let mut course = SlipCourse::new(l);
    let mut zone = LoadZone::new(l);
    let slip = |orbit: f64| 0.02 + 0.01 * (orbit - 0.3).cos();
    let dof = l.dof();
    let turn = |t: f64| 1.7 * TAU * t * RATE / 4000.0;
    go(
        &model,
        4000,
        |t, y, ws| {
            slipping(&model, y, 0.0, 0.0, 0.0);
            for slot in 0..l.rollers() {
                let orbit = model.pocket_angle[slot] + turn(t);
                y[l.theta() + slot] = orbit;
                y[dof + l.theta() + slot] *= 1.0 - slip(orbit);
                ws.contacts[Side::Outer as usize].force[slot] = 40.0 + 30.0 * orbit.cos();
            }
        },
        |f| {
            course.take(f, Places::default().at(f), true);
            zone.take(f, Places::default().at(f));
        },
    );
    for row in 0..l.rows {
        let there = course.over_angle(row);
        assert_eq!(there.orbit.len(), BINS);
        let force = zone.rows[row].mean();
        for bin in 0..BINS {
            // Uneven within a bin, so half a bin's change at most.
            let middle = (bin as f64 + 0.5) * TAU / BINS as f64;
            let half = 0.5 * TAU / BINS as f64;
            assert!((there.orbit[bin] - slip(middle)).abs() < 0.01 * half, "{bin}");
            assert!(there.spin[bin].abs() < 1e-12);
            let expected = 40.0 + 30.0 * middle.cos();
            assert!((force[bin] - expected).abs() < 30.0 * half, "{bin}");
            assert!(zone.rows[row].max[bin] >= force[bin]);
        }
    }
}

/// While the shaft is at rest, or hardly turns, slip says nothing; of the kinematic model it never does.
#[test]
fn analytic_slip_is_missing_where_there_is_no_speed_to_compare_with() {
    let from_rest = model(|s| {
        s.operation.speed_rpm = Speed::Profile(vec![[0.0, 0.0], [0.1, 0.0], [0.2, 1800.0]]);
    });
    let mut course = SlipCourse::new(&from_rest.layout);
    go(&from_rest, 500, |_, _, _| (), |f| course.take(f, Places::default().at(f), true));
    assert!(course.over_time(0).cage.is_empty());
    go(&from_rest, 6000, |_, _, _| (), |f| course.take(f, Places::default().at(f), true));
    let slip = course.over_time(0);
    // Cage and rollers are at rest all the time: NaN before the shaft turns, then all of its speed is missing.
    assert!(slip.cage[0].is_nan() && slip.orbit[0].is_nan());
    assert_eq!(slip.cage.last(), Some(&1.0));
    assert_eq!(slip.spin.last(), Some(&1.0));

    let lumped = model(|s| s.simulation.model = ModelKind::Lumped);
    let mut course = SlipCourse::new(&lumped.layout);
    let mut orbit = CageOrbit::new(&lumped, 0.1, RATE);
    go(
        &lumped,
        500,
        |_, _, _| (),
        |f| {
            course.take(f, Places::default().at(f), true);
            orbit.take(f);
        },
    );
    assert!(course.over_time(0).cage.is_empty());
    assert_eq!(orbit.rows(), 0);
}

/// Everything turns at speeds of its own: the frames hold the last turn of the shaft, evenly spaced, with the angles
/// and forces of their times.
#[test]
fn analytic_motion_keeps_the_last_turn_of_the_shaft() {
    let model = model(|_| ());
    let l = &model.layout;
    let duration = 0.5;
    let samples = (duration * RATE) as u64;
    let mut motion = Motion::new(&model, duration, RATE);
    let orbit = |slot: usize, t: f64| model.pocket_angle[slot] + 80.0 * t;
    let spin = |slot: usize, t: f64| -700.0 * t + 0.1 * slot as f64;
    let force = |slot: usize, t: f64| 10.0 + slot as f64 + 5.0 * t;
    go(
        &model,
        samples,
        |t, y, ws| {
            for slot in 0..l.rollers() {
                y[l.theta() + slot] = orbit(slot, t);
                y[l.phi() + slot] = spin(slot, t);
                ws.contacts[Side::Inner as usize].force[slot] = force(slot, t);
                ws.contacts[Side::Outer as usize].force[slot] = 2.0 * force(slot, t);
            }
            for row in 0..l.rows {
                y[l.cage(row) + 2] = 79.0 * t - row as f64;
            }
        },
        |f| motion.take(f),
    );
    let frames = motion.len();
    assert_eq!(frames, FRAMES);
    let step = motion.time(1) - motion.time(0);
    let span = motion.time(frames - 1) - motion.time(0);
    let turn = TAU / speed(&model);
    // A whole number of samples from frame to frame: a turn within a frame's rounding.
    assert!((span + step - turn).abs() < 0.5 * FRAMES as f64 / RATE, "{span}");
    assert!(motion.time(frames - 1) + step > (samples - 1) as f64 / RATE);
    let same = |kept: f32, angle: f64| wrap(f64::from(kept) - angle).abs() < 1e-6;
    for frame in 0..frames {
        let t = motion.time(frame);
        assert!((t - motion.time(0) - frame as f64 * step).abs() < 1e-9);
        assert!(same(motion.ring(frame), speed(&model) * t));
        for (row, cage) in motion.cages(frame).iter().enumerate() {
            assert!(same(*cage, 79.0 * t - row as f64));
        }
        let rollers = motion.rollers(frame);
        assert_eq!(rollers.len(), l.rollers());
        for (slot, roller) in rollers.iter().enumerate() {
            assert!(same(roller.orbit, orbit(slot, t)) && same(roller.spin, spin(slot, t)));
            assert!(roller.orbit.abs() <= PI as f32);
            assert_eq!(roller.inner_force, force(slot, t) as f32);
            assert_eq!(roller.outer_force, (2.0 * force(slot, t)) as f32);
        }
    }
}

#[test]
fn prop_motion_is_in_order_and_bounded_at_any_length() {
    for (duration, rpm) in [(1e-4, 1800.0), (0.01, 1800.0), (0.2, -600.0), (0.3, 20_000.0), (0.1, 0.0)] {
        let model = model(|s| s.operation.speed_rpm = Speed::Constant(rpm));
        let mut motion = Motion::new(&model, duration, RATE);
        let mut orbit = CageOrbit::new(&model, duration, RATE);
        assert!(motion.is_empty());
        let samples = (duration * RATE).ceil() as u64 + 1;
        go(
            &model,
            samples,
            |_, _, _| (),
            |f| {
                motion.take(f);
                orbit.take(f);
            },
        );
        let case = format!("{duration} s at {rpm} r/min");
        assert!((1..=FRAMES).contains(&motion.len()), "{case}");
        let times: Vec<f64> = (0..motion.len()).map(|k| motion.time(k)).collect();
        assert!(times.windows(2).all(|w| w[0] < w[1]), "{case}");
        let end = (samples - 1) as f64 / RATE;
        assert!(times.last().is_some_and(|t| *t <= end), "{case}");
        for row in 0..orbit.rows() {
            let times: Vec<f64> = orbit.points(row).map(|p| p.0).collect();
            assert!(!times.is_empty() && times.len() <= TURNS * 256, "{case}");
            assert!(times.windows(2).all(|w| w[0] < w[1]), "{case}");
        }
    }
}

/// The centres circle about a ring that moves itself and, where it can, tilts: what is kept is the circle, its last
/// turns, in time's order.
#[test]
fn analytic_a_cage_orbit_is_seen_from_the_land_that_guides_it() {
    for (guidance, kind) in [
        (Guidance::OuterRing, ModelKind::Full),
        (Guidance::InnerRing, ModelKind::Full),
        (Guidance::OuterRing, ModelKind::Tilting),
        (Guidance::InnerRing, ModelKind::Tilting),
    ] {
        let model = model(|s| {
            s.cage.guidance = guidance;
            s.simulation.model = kind;
        });
        let l = &model.layout;
        let duration = 1.0;
        let mut orbit = CageOrbit::new(&model, duration, RATE);
        let whirl = model.rolling_orbit_speed(speed(&model));
        let ring = |t: f64| [3e-5 * (900.0 * t).sin(), -2e-5 * (700.0 * t).cos()];
        let slope = |t: f64| [2e-3 * (800.0 * t).cos(), 1e-3 * (600.0 * t).sin()];
        let radius = |row: usize| 1e-4 * (row + 1) as f64;
        let centre = |row: usize, t: f64| {
            let (sin, cos) = (whirl * t).sin_cos();
            [radius(row) * cos, radius(row) * sin]
        };
        let mut places = [(l.outer(), l.outer_tilt()), (l.inner(), l.inner_tilt())];
        if guidance == Guidance::InnerRing {
            places.reverse();
        }
        let [(guide, tilt), (other, _)] = places;
        go(
            &model,
            (duration * RATE) as u64,
            |t, y, _| {
                for k in 0..2 {
                    y[guide + k] = ring(t)[k];
                    y[other + k] = 1.0;
                    for row in 0..l.rows {
                        let aside = model.tilt.as_ref().map_or(0.0, |of| of.rows[row] * slope(t)[k]);
                        y[l.cage(row) + k] = ring(t)[k] + aside + centre(row, t)[k];
                    }
                    if model.tilt.is_some() {
                        y[tilt + k] = slope(t)[k];
                    }
                }
            },
            |f| orbit.take(f),
        );
        assert_eq!(orbit.rows(), l.rows);
        for row in 0..l.rows {
            let points: Vec<(f64, [f64; 2])> = orbit.points(row).collect();
            assert_eq!(points.len(), TURNS * 256);
            for (t, [x, y]) in &points {
                let [cx, cy] = centre(row, *t);
                assert!((x - cx).abs() < 1e-15 && (y - cy).abs() < 1e-15);
                assert!((x.hypot(*y) - radius(row)).abs() < 1e-15);
            }
            let (first, last) = (points[0].0, points[points.len() - 1].0);
            let turns = (last - first) * whirl / TAU;
            assert!((turns / TURNS as f64 - 1.0).abs() < 0.07, "{turns}");
            assert!(last > duration - 2.0 * (last - first) / points.len() as f64);
        }
    }
}

/// The rollers turn by a pitch, from the middle of the damage to its middle: the first leaves it without having come
/// onto it, and the last comes onto it.
#[test]
fn analytic_a_roller_that_is_on_damage_at_the_start_has_no_entry() {
    let model = model(|s| s.defects = rectangle().defects);
    let (l, defect) = (&model.layout, &model.defects[0]);
    let of_row: Vec<usize> = (0..l.rollers()).filter(|slot| l.row(*slot) == defect.row).collect();
    let pitch = TAU / of_row.len() as f64;
    let (first, last) = defect.shape.arc();
    let half = 0.5 * (last - first) / defect.radius;
    let samples = 1000;
    let mut passes = Passes::new(&model);
    go(
        &model,
        samples,
        |t, y, ws| {
            let turned = pitch * t * RATE / samples as f64;
            for slot in 0..l.rollers() {
                let orbit = defect.center + model.pocket_angle[slot] - model.pocket_angle[of_row[0]] + turned;
                y[l.theta() + slot] = orbit;
                (ws.sin[slot], ws.cos[slot]) = orbit.sin_cos();
            }
        },
        |f| passes.take(f, false, false),
    );
    let events: Vec<_> = passes.events.iter().map(|e| (e.slot, e.enters, (e.t * RATE).round() as u64)).collect();
    // The first sample at which it is beyond the edge, and the first at which the next one is on the damage.
    let left = (half / pitch * samples as f64).ceil() as u64;
    let came = ((1.0 - half / pitch) * samples as f64).ceil() as u64;
    let next = of_row[of_row.len() - 1];
    assert_eq!(events, [(of_row[0], false, left), (next, true, came)]);
}
