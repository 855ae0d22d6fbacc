//! How rollers and cages run: rolling under load, slipping out of it (section 13).

use crate::common::cases::{healthy, rectangle};
use brinell::channel::Frame;
use brinell::defect::Side;
use brinell::derived::Passing;
use brinell::model::Model;
use brinell::observe::passes::Passes;
use brinell::scenario::{Scenario, Speed, Start, Surface};
use brinell::simulate::{End, Observer, Simulation};

const DURATION_S: f64 = 0.5;

/// Means over 20 to 70 ms (0) and over the last 100 ms (1).
#[derive(Default)]
struct Speeds {
    cage: [(f64, u32); 2],
    loaded_orbit: (f64, u32),
    loaded_surface: (f64, u32),
}

fn push(mean: &mut (f64, u32), value: f64) {
    mean.0 += value;
    mean.1 += 1;
}

fn mean((sum, count): (f64, u32)) -> f64 {
    assert!(count > 0);
    sum / f64::from(count)
}

impl Observer for Speeds {
    fn sample(&mut self, _: u64, f: &Frame) {
        let l = &f.model.layout;
        let dof = l.dof();
        let rolling = 82.707;
        let window = if (0.02..0.07).contains(&f.t) {
            0
        } else if f.t >= DURATION_S - 0.1 {
            1
        } else {
            return;
        };
        for row in 0..l.rows {
            push(&mut self.cage[window], 1.0 - f.y[dof + l.cage(row) + 2] / rolling);
        }
        if window == 0 {
            return;
        }
        let inner = &f.ws.contacts[Side::Inner as usize];
        let surface = 60.0 * std::f64::consts::PI * 21.5e-3;
        // Those in the middle of the load zone: at its ends rollers still take up speed.
        let heaviest = inner.force.iter().copied().fold(0.0, f64::max);
        for slot in 0..l.rollers() {
            if inner.force[slot] > 0.6 * heaviest {
                let orbit = f.y[dof + l.theta() + slot];
                push(&mut self.loaded_orbit, 1.0 - orbit / rolling);
                push(&mut self.loaded_surface, (inner.slip[slot] / surface).abs());
            }
        }
    }
}

fn watched(s: &Scenario) -> Speeds {
    let mut speeds = Speeds::default();
    let outcome = Simulation::new(s).unwrap().run(&mut speeds);
    assert_eq!(outcome.end, End::Complete);
    speeds
}

#[test]
fn lit_loaded_rollers_roll_and_the_cage_settles() {
    let mut s = healthy();
    assert_eq!(s.friction.raceway_coefficient, 0.02);
    assert_eq!(s.operation.load_n, [300.0, 0.0], "150 N a row");
    s.simulation.duration_s = DURATION_S;
    s.simulation.start = Start::Rolling;
    s.simulation.record = vec!["cage1_speed".into()];
    let speeds = watched(&s);
    let [early, late] = speeds.cage.map(mean);
    let (orbit, surface) = (mean(speeds.loaded_orbit), mean(speeds.loaded_surface));
    println!(
        "cage slip {:.3} % early, {:.3} % late; loaded rollers {:.4} % in orbit, {:.4} % at the surface",
        100.0 * early,
        100.0 * late,
        100.0 * orbit,
        100.0 * surface
    );
    // Section 13 says "less than 0.03 %": here 0.024 to 0.036 %, by the window and by the load from which a roller
    // counts as loaded.
    assert!(orbit.abs() < 4.5e-4, "loaded rollers slip {orbit:e}");
    assert!(surface < 4.5e-4, "loaded rollers' surfaces slip {surface:e}");
    // "Starts with 1 % and settles to about 0.1 %". Its means over 0.1 s wander between 0.03 and 0.35 % from 0.25 s on,
    // whatever the accuracy, so half a digit is what can be asked.
    assert!((5e-3..2e-2).contains(&early), "cage slip {early:e} at first");
    assert!((3e-4..4e-3).contains(&late), "cage slip {late:e} after half a second");
}

/// Signs of du/dt over the passes of a run's first defect.
struct Ways {
    passes: Passes,
    along: Option<f64>,
}

impl Observer for Ways {
    fn step(&mut self, frame: &Frame) {
        self.passes.take(frame, true, true);
        if let Some(pass) = self.passes.best().first() {
            let [first, .., last] = pass.points[..] else { panic!("{} points", pass.points.len()) };
            self.along = Some((last.angle - first.angle).signum());
        }
    }
}

#[test]
fn analytic_rollers_pass_damage_the_way_that_is_told() {
    let towards = |plus: bool| if plus { Passing::TowardsPlus } else { Passing::TowardsMinus };
    for (surface, plus) in [(Surface::OuterRaceway, true), (Surface::InnerRaceway, false), (Surface::Roller(1), true)] {
        let mut s = rectangle();
        s.defects[0].on = surface;
        s.simulation.duration_s = 0.012;
        s.operation.load_ramp_s = 0.0;
        for (rpm, plus) in [(1800.0, plus), (-1800.0, !plus)] {
            s.operation.speed_rpm = Speed::Constant(rpm);
            let model = Model::new(&s).unwrap();
            let mut ways = Ways { passes: Passes::new(&model), along: None };
            assert_eq!(Simulation::new(&s).unwrap().run(&mut ways).end, End::Complete);
            assert_eq!(ways.along, Some(if plus { 1.0 } else { -1.0 }), "{surface:?}, {rpm} r/min");
            assert_eq!(Passing::of(&model, surface), towards(plus), "{surface:?}, {rpm} r/min");
        }
        let mut of = |points: &[[f64; 2]]| {
            s.operation.speed_rpm = Speed::Profile(points.to_vec());
            Passing::of(&Model::new(&s).unwrap(), surface)
        };
        assert_eq!(of(&[[0.0, 0.0], [1.0, 600.0]]), towards(plus));
        assert_eq!(of(&[[0.0, -600.0], [1.0, 600.0]]), Passing::Both { plus_at_positive: plus });
        assert_eq!(of(&[[0.0, 0.0], [1.0, 0.0]]), Passing::Never);
    }
}
