//! Histories: machines whose damage begins, grows and reaches the length of failure.

use super::{SECRET, draws, refusals};
use brinell::channel::Frame;
use brinell::defect::Angles;
use brinell::observe::passes::Passes;
use brinell::scenario::{Scenario, Shape, Surface};
use brinell::simulate::{Observer, Simulation};
use brinell_study::design::{Draw, Draws, Part, Snapshot, State};

/// Short, and long enough for eight turns of the shaft.
const BASE: &str = r#"name = "base"
[bearing]
preset = "NU206"
[operation]
speed_rpm = 6000.0
load_n = [300.0, 0.0]
[simulation]
laws = "li2023"
duration_s = 0.12
"#;

const PLAN: &str = r#"base = "base.toml"
machines = 6
snapshots = 5
seed = 5

[history]
every_h = 250
law = "power"
exponent = 2
begins_mm = 1.0
fails_mm = 5.0
life_h = 1000
begins_at = 0.5

[history.snapshot]
operation.load_n = [{ uniform = [200, 400] }, 0.0]

[vary]
lubricant.viscosity_pa_s = { uniform = [0.01, 0.1] }

[[classes]]
name = "outer"
[[classes.defects]]
on = "outer-raceway"
center_deg = 20.0
depth_um = 40
shape.random = { length_mm = 2, width_mm = 3, roughness = 0.9 }

[[classes]]
name = "inner"
[[classes.defects]]
on = "inner-raceway"
depth_um = 40
shape.random = { length_mm = 2, width_mm = 3, roughness = 0.9 }
"#;

fn made(draws: &Draws, base: &str, run: usize) -> (Scenario, Draw) {
    let (loaded, draw) = draws.scenario(base, run).unwrap_or_else(|(problems, _)| panic!("{problems:?}"));
    (loaded.scenario, draw)
}

fn snapshot(draws: &Draws, run: usize) -> Snapshot {
    *made(draws, BASE, run).1.snapshot.unwrap()
}

#[test]
fn analytic_lengths_of_each_law_at_given_times_without_scatter() {
    let at = |plan: &str| {
        let draws = draws(plan);
        (0..5).map(|run| snapshot(&draws, run)).collect::<Vec<_>>()
    };
    let power = at(PLAN);
    assert_eq!(power.iter().map(|s| s.time_h).collect::<Vec<_>>(), [0.0, 250.0, 500.0, 750.0, 1000.0]);
    // 1 + 4 x^2 from 500 h on.
    assert_eq!(power.iter().map(|s| s.length_mm).collect::<Vec<_>>(), [0.0, 0.0, 1.0, 2.0, 5.0]);
    let states = [State::Healthy, State::Healthy, State::Damaged, State::Damaged, State::Failed];
    assert_eq!(power.iter().map(Snapshot::state).collect::<Vec<_>>(), states);
    assert_eq!(power.iter().map(|s| s.remaining().unwrap()).collect::<Vec<_>>(), [1000.0, 750.0, 500.0, 250.0, 0.0]);
    // 6000 r/min for 250 h and more.
    assert_eq!(power.iter().map(|s| s.turns.unwrap()[0]).collect::<Vec<_>>(), [0.0, 9e7, 1.8e8, 2.7e8, 3.6e8]);
    assert_eq!(power.iter().map(|s| s.turns.unwrap()[1]).collect::<Vec<_>>(), [0.0, 0.0, 0.0, 9e7, 1.8e8]);
    let exponential = at(&PLAN.replace("law = \"power\"\nexponent = 2", "law = \"exponential\"\nrate = 4"));
    let middle = 1.0 + 4.0 / (2_f64.exp() + 1.0);
    assert!((exponential[3].length_mm - middle).abs() < 1e-8);
    // A logistic function is symmetric about the middle of the time.
    let logistic = at(&PLAN.replace("law = \"power\"\nexponent = 2", "law = \"logistic\"\nrate = 9"));
    assert_eq!((logistic[3].length_mm, logistic[4].length_mm), (3.0, 5.0));
}

/// Whether a point is within a polygon, or beyond it by less than two nanometres.
fn holds(polygon: &[[f64; 2]], [s, z]: [f64; 2]) -> bool {
    let sides = || polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed =
        sides().filter(|(p, q)| (p[1] > z) != (q[1] > z) && s < p[0] + (z - p[1]) / (q[1] - p[1]) * (q[0] - p[0]));
    let beside = |p: &[f64; 2], q: &[f64; 2]| {
        let (u, v) = ([q[0] - p[0], q[1] - p[1]], [s - p[0], z - p[1]]);
        let along = ((u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
        (v[0] - along * u[0]).hypot(v[1] - along * u[1]) < 2e-6
    };
    crossed.count() % 2 == 1 || sides().any(|(p, q)| beside(p, q))
}

fn outline(scenario: &Scenario) -> Vec<[f64; 2]> {
    match scenario.defects.first().map(|defect| &defect.shape) {
        Some(Shape::Outline { polygons_mm }) => polygons_mm.concat(),
        None => Vec::new(),
        Some(other) => panic!("{other:?}"),
    }
}

#[test]
fn prop_every_outline_holds_the_one_before_and_never_shrinks() {
    let scattered = PLAN
        .replace("snapshots = 5", "snapshots = 14\n")
        .replace("every_h = 250", "every_h = 77")
        .replace("begins_at = 0.5", "begins_at = { uniform = [0, 0.3] }\nscatter = 1.0");
    let shapes = [
        "random = { length_mm = 2, width_mm = 3, roughness = 0.9 }",
        "rectangle = { length_mm = 2, width_mm = 1 }",
        "circle = { diameter_mm = 2 }",
        "outline = { polygons_mm = [[[-1, -1], [1, -1], [1, 1], [0.2, 0.1], [-1, 0.9]], [[1.2, 0.5], [1.6, 0.5], [1.4, 0.8]]] }",
    ];
    let edges = ["trailing", "leading", "both"];
    for (shape, edge) in
        shapes.into_iter().zip(edges.into_iter().cycle()).chain([(shapes[0], "both"), (shapes[3], "trailing")])
    {
        for widest in ["", "widest_mm = 3.0\n"] {
            let plan =
                scattered.replace(shapes[0], shape).replace("law = ", &format!("edge = {edge:?}\n{widest}law = "));
            let draws = draws(&plan);
            for machine in 0..4 {
                let mut before: (Vec<[f64; 2]>, f64) = (Vec::new(), 0.0);
                for run in 14 * machine..14 * (machine + 1) {
                    let (scenario, draw) = made(&draws, BASE, run);
                    let (now, length) = (outline(&scenario), draw.snapshot.unwrap().length_mm);
                    assert!(length >= before.1);
                    let s = || now.iter().map(|p| p[0]);
                    let span = s().fold(f64::NEG_INFINITY, f64::max) - s().fold(f64::INFINITY, f64::min);
                    assert!(now.is_empty() || (span - length).abs() < 2e-6, "{shape}, {edge}: {span} for {length}");
                    let z = now.iter().map(|p| p[1].abs()).fold(0.0, f64::max);
                    assert!(widest.is_empty() || z < 1.5 + 2e-6);
                    // Corners, and places between them.
                    let sides = before.0.iter().zip(before.0.iter().cycle().skip(1));
                    for (p, q) in sides {
                        for share in [0.0, 0.3, 0.7] {
                            let point = [0, 1].map(|k| p[k] + share * (q[k] - p[k]));
                            assert!(holds(&now, point), "{shape}, {edge}: run {run} lacks {point:?}");
                        }
                    }
                    before = (now, length);
                }
                assert_eq!(before.1, 5.0);
            }
        }
    }
}

/// Where along the damage rolling elements come onto it, and leave it: s of each event, mm.
struct Ends<'a> {
    passes: Passes,
    simulation: &'a Simulation,
    found: [Vec<f64>; 2],
}

impl Observer for Ends<'_> {
    fn step(&mut self, frame: &Frame) {
        self.passes.take(frame, false, false);
        let defect = &self.simulation.model().defects[0];
        let ring = self.simulation.model().rotation.at(frame.t).1;
        while let Some(event) = self.passes.events.pop_front() {
            let orbit = frame.ws.sin[event.slot].atan2(frame.ws.cos[event.slot]);
            let angles = Angles { orbit, spin: 0.0, ring };
            let s = 1e3 * defect.radius * defect.local_angle(&angles, event.side);
            self.found[usize::from(!event.enters)].push(s);
        }
    }
}

#[test]
fn prop_rolling_elements_enter_where_damage_stays_and_leave_where_it_grows() {
    for speed in ["6000.0", "-6000.0"] {
        let base = BASE.replace("6000.0", speed);
        let draws = draws(PLAN);
        for (first, on) in [(0, Surface::OuterRaceway), (5, Surface::InnerRaceway)] {
            let ends = [3, 4].map(|snapshot| {
                let (scenario, _) = made(&draws, &base, first + snapshot);
                assert_eq!(scenario.defects[0].on, on);
                let simulation = Simulation::new(&scenario).unwrap();
                let mut ends =
                    Ends { passes: Passes::new(simulation.model()), simulation: &simulation, found: [vec![], vec![]] };
                simulation.run(&mut ends);
                let outline = outline(&scenario);
                let s = || outline.iter().map(|p| p[0]);
                let span = [s().fold(f64::INFINITY, f64::min), s().fold(f64::NEG_INFINITY, f64::max)];
                let mean = ends.found.map(|all| {
                    assert!(all.len() > 10, "{speed}, {on:?}: {} events", all.len());
                    all.iter().sum::<f64>() / all.len() as f64
                });
                (mean, span)
            });
            let [(before, _), (after, span)] = ends;
            // The place of an event is that of a step's end: within the way of a step.
            assert!((before[0] - after[0]).abs() < 0.1, "{speed}, {on:?}: entries at {before:?}, {after:?}");
            // From 2 to 5 mm.
            assert!(
                ((before[1] - after[1]).abs() - 3.0).abs() < 0.2,
                "{speed}, {on:?}: exits at {before:?}, {after:?}"
            );
            let towards_plus = (on == Surface::OuterRaceway) == (speed == "6000.0");
            let leading = if towards_plus { span[0] } else { span[1] };
            assert!((after[0] - leading).abs() < 0.1, "{speed}, {on:?}: {after:?} of {span:?}");
        }
    }
}

#[test]
fn prop_a_machine_is_drawn_once_and_its_snapshots_each() {
    let plan = PLAN
        .replace("life_h = 1000", "life_h = { log = [100, 1000] }")
        .replace("every_h = 250", "every_h = { uniform = [20, 25] }")
        .replace("exponent = 2", "exponent = 2\nscatter = 0.5");
    let few = draws(&plan);
    let of = |draws: &Draws, run: usize, key: &str| {
        let k = draws.parameters().iter().position(|p| p.key == key).unwrap();
        made(draws, BASE, run).1.values[k].clone().unwrap().number.unwrap()
    };
    // Runs of each machine, one after the other.
    let rows = |draws: &Draws| {
        let mut all: Vec<Vec<usize>> = Vec::new();
        for run in 0..draws.runs() {
            let machine = snapshot(draws, run).machine;
            all.resize(all.len().max(machine + 1), Vec::new());
            all[machine].push(run);
        }
        all
    };
    let machines = rows(&few);
    assert_eq!(machines.len(), 6);
    for runs in &machines {
        let all = |key: &str| runs.iter().map(|run| of(&few, *run, key)).collect::<Vec<_>>();
        for once in ["lubricant.viscosity_pa_s", "history.life_h", "history.every_h"] {
            assert!(all(once).windows(2).all(|pair| pair[0] == pair[1]), "{once}");
        }
        let mut anew = all("operation.load_n.0");
        anew.sort_by(f64::total_cmp);
        anew.dedup();
        assert_eq!(anew.len(), runs.len());
    }
    // What machine k is at snapshot j depends on plan, seed, k and j: more machines change nothing.
    let many = draws(&plan.replace("machines = 6", "machines = 11"));
    for run in 0..few.runs() {
        assert_eq!(made(&few, BASE, run), made(&many, BASE, run));
    }
    assert_ne!(snapshot(&few, machines[0][0]).life_h, snapshot(&few, machines[1][0]).life_h);
}

#[test]
fn prop_the_rows_up_to_now_tell_nothing_of_the_life() {
    let plan = |life: &str, observed: &str| {
        PLAN.replace("every_h = 250", "every_h = { uniform = [60, 120] }")
            .replace("life_h = 1000", &format!("life_h = {life}\nobserved = {observed}"))
            .replace("snapshots = 5", "snapshots = 20")
            .replace("exponent = 2", "exponent = 2\nscatter = 0.5")
    };
    let times = |life: &str, observed: &str| {
        let draws = draws(&plan(life, observed));
        let mut all = vec![Vec::new(); 6];
        for run in 0..draws.runs() {
            let of = snapshot(&draws, run);
            assert_eq!(of.number, all[of.machine].len());
            all[of.machine].push(of.time_h);
        }
        (all, draws.to_the_end())
    };
    let (short, to_the_end) = times("600", "1");
    let (long, none) = times("60000", "1");
    let (middle, part) = times("1200", "0.7");
    assert_eq!([to_the_end, none, part], [6, 0, 0]);
    for k in 0..6 {
        // At failure one more; the others are as if it lived for ever.
        assert_eq!(short[k].last(), Some(&600.0));
        let regular = short[k].len() - 1;
        assert!((5..=10).contains(&regular), "{regular}");
        assert_eq!(short[k][..regular], long[k][..regular]);
        assert_eq!(long[k].len(), 20);
        assert_eq!(middle[k][..], long[k][..middle[k].len()]);
        assert!(middle[k].iter().all(|h| *h < 840.0) && long[k][middle[k].len()] >= 840.0);
    }
    // The end of a machine that is out of rows tells nothing either: its failure is not seen.
    let draws = draws(&plan("60000", "1"));
    assert!((0..draws.runs()).all(|run| snapshot(&draws, run).is_censored()));
}

#[test]
fn prop_machines_go_to_one_split_with_all_their_snapshots() {
    let plan = PLAN.replace("machines = 6", "machines = 40");
    let split = "[split]\nvalidation = 0.2\ntest = 0.3\n\n[history]";
    let held = format!("held_out = 0.25\n{SECRET}\nseed = 5\n");
    for (split, held) in [(split, "seed = 5\n"), ("[history]", &held), (split, &held)] {
        let draws = draws(&plan.replace("[history]\n", &format!("{split}\n")).replace("seed = 5\n", held));
        for machine in 0..40 {
            let mut parts = (5 * machine..5 * (machine + 1)).map(|run| draws.part(run));
            let first = parts.next().unwrap();
            assert!(parts.all(|part| part == first));
        }
        let runs = |part| (0..200).filter(|run| draws.part(*run) == part).count();
        let apart = runs(Part::HeldOut);
        assert_eq!(apart > 0, held.starts_with("held"));
        if split.contains("test") {
            let open = (200 - apart) as f64;
            assert!((runs(Part::Test) as f64 / open - 0.3).abs() < 0.05);
            assert!((runs(Part::Validation) as f64 / open - 0.2).abs() < 0.05);
        }
    }
}

#[test]
fn prop_machines_that_are_not_seen_until_they_fail_are_censored() {
    let healthy = "[[classes]]\nname = \"healthy\"\ndefects = []\n";
    let plan = PLAN.replace("begins_at = 0.5", "begins_at = 0.5\nobserved = 0.8") + healthy;
    let draws = draws(&plan);
    // 0, 250, 500 and 750 h.
    let all: Vec<Snapshot> = (0..12).map(|run| snapshot(&draws, run)).collect();
    assert!(all.iter().all(Snapshot::is_censored) && all[3].time_h == 750.0 && all[3].remaining() == Some(250.0));
    // The third machine stays healthy: it has no life.
    assert!(all[8..].iter().all(|s| s.state() == State::Healthy && s.life().is_none() && s.remaining().is_none()));
    assert!(
        snapshot(&super::draws(PLAN), 4).state() == State::Failed && !snapshot(&super::draws(PLAN), 4).is_censored()
    );
}

#[test]
fn regress_what_does_not_fit_a_history_is_refused_with_what_would_do() {
    let refused = |was: &str, is: &str| refusals(&PLAN.replace(was, is)).join("\n").replace("\n  allowed", "; allowed");
    for (was, is, says) in [
        (
            "fails_mm = 5.0",
            "fails_mm = 0.8",
            "history.fails_mm = 0.8: damage begins with up to 1 mm, so that its size would shrink",
        ),
        ("exponent = 2", "exponent = -2", "history.exponent = -2: out of range; allowed: > 0 and <= 100"),
        (
            "exponent = 2",
            "rate = 2",
            "history.rate = 2: has a meaning only where `law` is \"exponential\" or \"logistic\"",
        ),
        ("begins_at = 0.5", "begins_at = 1.5", "history.begins_at = 1.5: out of range; allowed: 0 to 1"),
        (
            "begins_at = 0.5",
            "begins_at = { uniform = [0.5, 1.5] }",
            "draws values up to 1.5: out of range; allowed: 0 to 1",
        ),
        (
            "begins_at = 0.5",
            "begins_at = { uniform = [-0.5, 0.5] }",
            "draws values from -0.5: out of range; allowed: 0 to 1",
        ),
        (
            "begins_at = 0.5",
            "begins_at = 1",
            "history.begins_at = 1: damage would begin at failure, with the length that it has then: nothing grows; allowed: < 1",
        ),
        (
            "begins_mm = 1.0",
            "begins_mm = 1e300",
            "history.fails_mm = 5: damage begins with up to 1e300 mm, so that its size would shrink until it fails; allowed: > 1e300 mm",
        ),
        ("life_h = 1000", "life_h = 1e8", "history.life_h = 1e8: out of range; allowed: > 0 and <= 1e7 h"),
        (
            "every_h = 250\n",
            "",
            "history.every_h: missing: a number in h or a distribution is required where `machines` is given",
        ),
        (
            "[vary]",
            "[vary]\nhistory.life_h = { uniform = [1, 2] }",
            "vary.history.life_h: how damage grows is no key of a scenario; allowed: this key in [history]",
        ),
        (
            "life_h = 1000",
            "life_h = { normal = [1000, 200] }",
            "the distribution has no ends; allowed: within = [low, high]",
        ),
        (
            "life_h = 1000\n",
            "",
            "history.life_h: missing: a number in h or a distribution is required where `machines` is given",
        ),
        ("machines = 6", "machines = 6\nruns = 30", "runs = 30: has a meaning only where `machines` is not given"),
        (
            "machines = 6\nsnapshots = 5",
            "runs = 6",
            "history.law = \"power\": has a meaning only where `machines` is given",
        ),
        ("seed = 5", "out_of_range = \"redraw\"", "a snapshot that is drawn again would be of another machine"),
        ("operation.load_n", "bearing.radial_clearance_um", "a machine keeps its bearing"),
        ("[vary]", "[vary]\noperation.speed_rpm = { uniform = [-100, 100] }", "speeds of one sign"),
        ("[vary]", "[vary]\noperation.load_n = [100, 0]", "drawn once for each machine too"),
        (
            "[[classes]]\nname = \"inner\"",
            "[[classes.defects]]\non = \"roller\"\n[[classes]]\nname = \"inner\"",
            "a history grows one defect, and this class has 2",
        ),
    ] {
        let found = refused(was, is);
        assert!(found.contains(says), "{is}: {found}");
    }
    let section = "[history.snapshot]\noperation.load_n = [{ uniform = [200, 400] }, 0.0]\n";
    let found = refusals(&PLAN.replace(section, "snapshot = 5\n"));
    assert!(found.len() == 1 && found[0].contains("expected a section [history.snapshot]"), "{found:?}");
    // Of the damage itself: at failure it goes around, or its depths would be lost.
    let refused = |was: &str, is: &str| {
        let draws = super::draws(&PLAN.replace(was, is));
        let (problems, draw) = draws.scenario(BASE, 3).unwrap_err();
        // What the snapshot should have been is known.
        assert_eq!(draw.unwrap().snapshot.map(|s| s.state()), (was == "fails_mm = 5.0").then_some(State::Damaged));
        problems[0].to_string().replace("\n  allowed", "; allowed")
    };
    let found = refused("fails_mm = 5.0", "fails_mm = 500.0");
    assert!(
        found.contains("history.fails_mm = 500: damage of this length goes once around the outer raceway; allowed: < "),
        "{found}"
    );
    let profile = "shape.profile = { arc_mm = [0, 1, 2, 3], depth_um = [0, 30, 20, 0], width_mm = [2, 2, 2, 2] }";
    let found = refused("shape.random = { length_mm = 2, width_mm = 3, roughness = 0.9 }", profile);
    assert!(
        found.contains("the depths of this profile over its arc would be lost; allowed: a profile without `depth_um`"),
        "{found}"
    );
    let draws = super::draws(PLAN);
    let found = draws.scenario(&BASE.replace("0.12", "0.05"), 0).unwrap_err().0;
    let found = found[0].to_string().replace("\n  allowed", "; allowed");
    assert!(found.contains("simulation.duration_s = 0.05: a snapshot of 2 turns of the shaft from the end of its start on at the slowest speed, 6000 r/min; allowed: >= 0.11 s: 8 turns after the start; or a higher speed"), "{found}");
    assert!(draws.notes()[0].starts_with("history.scatter = 0: the lengths of all 6 machines follow the law"));
}

#[test]
fn regress_an_outline_that_crosses_itself_is_warned_of() {
    let bow = "shape.outline = { polygons_mm = [[[-1, -1], [1, 1], [1, -1], [-1, 1]]] }";
    let plan = PLAN.replace("shape.random = { length_mm = 2, width_mm = 3, roughness = 0.9 }", bow);
    let draws = draws(&plan);
    let warnings = |run| draws.scenario(BASE, run).unwrap().0.warnings;
    assert!(warnings(3).iter().any(|w| w.message.contains("crosses itself")), "{:?}", warnings(3));
    assert!(warnings(0).is_empty(), "no damage yet: {:?}", warnings(0));
}
