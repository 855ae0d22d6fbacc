//! The signal library on simulated runs, whose damage is known: does it find what is there?

use std::ops::ControlFlow;

use brinell::analysis::{Component, MACHINE_NOISE, Options, Verdict, analyze};
use brinell::bearing::orders_of;
use brinell::random::Random;
use brinell::result::{Stretch, beside_healthy};
use brinell::scenario::{Law, Scenario, Shape, Speed, Surface, Tables};
use brinell::signal::Rotation;
use brinell::simulate::{End, Observer, Simulation};

const FS: f64 = 51_200.0;
/// After the load's ramp and the cages' first slip, s.
const SETTLED: f64 = 0.2;

/// Samples, and the axis that they are of.
struct Sensor(Vec<f64>, usize);

impl Observer for Sensor {
    fn row(&mut self, _: u64, _: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.0.push(filtered[self.1]);
        ControlFlow::Continue(())
    }
}

/// Settled part of the sensor acceleration along the load.
fn run(s: &mut Scenario) -> Vec<f64> {
    recorded(s, FS, 2.2, SETTLED)
}

/// The same of a run of `seconds`, from `start` on, at `rate` Hz.
fn recorded(s: &mut Scenario, rate: f64, seconds: f64, start: f64) -> Vec<f64> {
    s.simulation.duration_s = seconds;
    s.simulation.sample_rate_hz = rate;
    let simulation = Simulation::new(s).unwrap();
    let load = s.operation.load_n;
    let mut sensor = Sensor(Vec::new(), usize::from(load[1].abs() > load[0].abs()));
    let outcome = simulation.run(&mut sensor);
    assert_eq!(outcome.end, End::Complete);
    sensor.0.split_off((start * rate) as usize)
}

fn damaged(on: Surface) -> Scenario {
    let mut s = crate::common::example();
    s.defects[0].on = on;
    s.defects[0].depth_um = 20.0;
    s.defects[0].shape = Shape::Rectangle { length_mm: 3.0, width_mm: 4.0 };
    s
}

/// With white noise of a share of the signal's RMS, as every sensor has.
fn with_noise(x: &[f64], share: f64) -> Vec<f64> {
    let rms = (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt();
    // Twelve uniform numbers make a nearly normal one.
    let mut random = Random::new(7);
    x.iter().map(|x| x + share * rms * ((0..12).map(|_| random.part()).sum::<f64>() - 6.0)).collect()
}

/// The damaged surface comes first in the verdict.
fn found(on: Surface, component: Component) {
    let mut s = damaged(on);
    let x = run(&mut s);
    // As the command treats runs of brinell's: nothing else turns, and a record of two seconds tells the cage's lines.
    let options = Options { exact: true, ..Options::new(30.0, orders_of(&s.bearing)) };
    let analysis = analyze(&with_noise(&x, 0.3), FS, &options).unwrap();
    println!("{on:?}: {}", analysis.verdict());
    let first = analysis.causes().next().map(|f| f.component);
    assert_eq!(first, Some(component), "{}", analysis.verdict());
}

/// A scenario under the laws that it names, else the default ones; tables as data sets have them.
fn read(text: &str) -> Scenario {
    let mut s = brinell::document::read(text, &[]).unwrap().scenario;
    if s.contact.law == Law::HalfSpace {
        s.contact.tables = Tables::Coarse;
    }
    s
}

#[test]
fn analytic_outer_race_damage() {
    found(Surface::OuterRaceway, Component::OuterRace);
}

#[test]
fn analytic_inner_race_damage() {
    found(Surface::InnerRaceway, Component::InnerRace);
}

#[test]
fn analytic_roller_damage() {
    found(Surface::Roller(2), Component::Element);
}

/// What `brinell analyze` says of runs: speeds, lengths, and no noise at all, in which sidebands of damage that turns
/// are present everywhere.
#[test]
fn regress_verdicts_on_short_runs_with_and_without_noise() {
    let rate = 25_600.0;
    let mut wrong = Vec::new();
    let (mut count, mut passings, mut missed, mut missed_inner) = (0, 0, 0, 0);
    for rpm in [1800.0, 2400.0] {
        for (on, component) in [
            (None, None),
            (Some(Surface::OuterRaceway), Some(Component::OuterRace)),
            (Some(Surface::InnerRaceway), Some(Component::InnerRace)),
            (Some(Surface::Roller(1)), Some(Component::Element)),
        ] {
            let mut s = damaged(on.unwrap_or(Surface::OuterRaceway));
            match on {
                None => s.defects.clear(),
                Some(Surface::Roller(_)) => {
                    s.defects[0].center_deg = 90.0;
                    s.defects[0].shape = Shape::Rectangle { length_mm: 1.0, width_mm: 4.0 };
                }
                _ => {}
            }
            s.operation.speed_rpm = Speed::Constant(rpm);
            let orders = orders_of(&s.bearing);
            // As the command does: after the load's ramp and a turn of the shaft.
            let x = recorded(&mut s, rate, 2.12, 0.02 + 60.0 / rpm);
            for seconds in [0.5, 0.9, 1.0, 2.0] {
                for noise in [0.0, 0.1, 0.5] {
                    let x = with_noise(&x[..(seconds * rate) as usize], noise);
                    let options = Options {
                        silent: (noise <= 0.1).then_some(MACHINE_NOISE),
                        exact: true,
                        ..Options::new(rpm / 60.0, orders)
                    };
                    let analysis = analyze(&x, rate, &options).unwrap();
                    let first = analysis.causes().next().map(|f| f.component);
                    count += 1;
                    // Where nothing else shows, the rollers of a healthy bearing show by themselves, in some runs and
                    // not in others that differ in their last digits; that may be said, but weakly.
                    let passing =
                        first.is_some() && component.is_none() && analysis.causes().all(|f| analysis.may_be_passing(f));
                    passings += usize::from(passing);
                    if first.is_none() && component.is_some() {
                        missed += 1;
                        missed_inner += usize::from(component == Some(Component::InnerRace));
                    } else if first != component && !passing {
                        let verdict = analysis.verdict();
                        wrong.push(format!("{on:?} {rpm} r/min {seconds} s {noise}: {verdict}"));
                    }
                }
            }
        }
    }
    println!(
        "{} of {count} name another part, {missed} name none and {missed_inner} of them at the inner race; {passings} of 16 healthy ones with little \
         noise weakly show how rollers pass\n{}",
        wrong.len(),
        wrong.join("\n")
    );
    // Which of these runs shows another rate hangs on the last digits of the run, as impacts amplify them: it is
    // another run with another kernel, another processor or another start. Held to are shares alone: with none of four
    // kernels any of 96 named another part.
    assert!(15 * wrong.len() <= count, "{}", wrong.join("\n"));
    // The inner ring's damage is loaded once a turn: in half a second it is mostly missed.
    assert!(15 * (missed - missed_inner) <= count, "{missed}, {missed_inner}");
}

/// The examples that a newcomer runs first, of half a second, one and two, without noise.
///
/// Impacts amplify round-off, so that another kernel or processor makes another run of the same bearing: held to are
/// shares. With each of the four kernels the damaged part came first, alone, in 17 or 18 of 18 (the inner race of half
/// a second takes a longer record), and no healthy run had any.
#[test]
fn regress_verdicts_on_the_examples() {
    let (mut right, mut wrong) = (0, Vec::new());
    for (name, component) in [
        ("healthy", None),
        ("rectangle", Some(Component::OuterRace)),
        ("circle", Some(Component::OuterRace)),
        ("irregular", Some(Component::OuterRace)),
        ("single-row", Some(Component::OuterRace)),
        ("inner-race", Some(Component::InnerRace)),
        ("roller", Some(Component::Element)),
        ("ball-6205", Some(Component::OuterRace)),
        ("ball-6205", None),
        ("single-row", None),
    ] {
        let path = format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let mut s = read(&text);
        if component.is_none() {
            s.defects.clear();
        }
        let Speed::Constant(rpm) = s.operation.speed_rpm else { panic!("a speed that varies") };
        let orders = orders_of(&s.bearing);
        let rate = s.simulation.sample_rate_hz;
        let start = s.operation.load_ramp_s + 60.0 / rpm;
        let x = recorded(&mut s, rate, 2.0, start);
        for seconds in [0.5, 1.0, 2.0] {
            let options = Options { silent: Some(MACHINE_NOISE), exact: true, ..Options::new(rpm / 60.0, orders) };
            let length = ((seconds - start) * rate) as usize;
            let analysis = analyze(&x[..length], rate, &options).unwrap();
            let verdict = format!("{name}, {seconds} s: {}", analysis.verdict());
            println!("{verdict}");
            let causes: Vec<Component> = analysis.causes().map(|f| f.component).collect();
            match component {
                Some(_) if causes == component.as_slice() => right += 1,
                _ if causes.is_empty() => {}
                _ => wrong.push(verdict),
            }
        }
    }
    assert!(wrong.len() <= 1, "{}", wrong.join("\n"));
    // Damage on a half-space is up to 17 dB quieter than under the paper's laws, where 19 were named: 14 are now, the others are not called.
    assert!(right >= 13, "{right} of 21");
}

/// Under the paper's laws rollers of a healthy NU206 with clearance C4 strike the outer race at 3600 r/min as damage would: beside the same
/// run without its damage that is none, and the template's damage stays one.
#[test]
fn regress_passing_rollers_are_no_damage() {
    for (damaged, expected) in [(false, None), (true, Some(Component::OuterRace))] {
        let defect = "[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0.0\ndepth_um = 20.0\nshape = { rectangle = { length_mm = 2.7, width_mm = 4.4 } }\n";
        let text = format!(
            "bearing = {{ preset = \"NU206/C4\" }}\noperation = {{ speed_rpm = 3600.0, load_n = [700.0, 0.0] }}\n\
             simulation = {{ laws = \"li2023\", duration_s = 1.0, sample_rate_hz = 25600.0 }}\n{}",
            if damaged { defect } else { "" }
        );
        let s = read(&text);
        let (_, signals) = brinell::record(&s).unwrap();
        let stretch = Stretch { channel: "sensor_ax", from_s: 0.1, to_si: 1.0 };
        let x = &signals.get("sensor_ax").unwrap()[2560..];
        let orders = orders_of(&s.bearing);
        let options = Options { silent: Some(MACHINE_NOISE), exact: true, ..Options::new(60.0, orders) };
        let mut analysis = analyze(x, 25_600.0, &options).unwrap();
        assert!(analysis.causes().any(|f| f.component == Component::OuterRace), "nothing to judge again");
        beside_healthy(&mut analysis, &s, stretch);
        assert_eq!(analysis.causes().next().map(|f| f.component), expected, "{}", analysis.verdict());
        if !damaged {
            assert_eq!(analysis.conclusion(), Verdict::NothingFound);
        }
    }
}

/// Its impacts on both races, turned by the cage, have lines at all frequencies of the bearing; one part is damaged.
#[test]
fn regress_a_damaged_roller_is_named_alone() {
    let text = "bearing = { preset = \"NU206\" }\noperation = { speed_rpm = 3000.0, load_n = [700.0, 0.0] }\n\
                simulation = { duration_s = 2.0, sample_rate_hz = 25600.0 }\n\
                [[defects]]\non = \"roller\"\nroller = 1\ncenter_deg = 90.0\ndepth_um = 20.0\n\
                shape = { rectangle = { length_mm = 1.0, width_mm = 4.4 } }\n";
    let s = read(text);
    let (_, signals) = brinell::record(&s).unwrap();
    let orders = orders_of(&s.bearing);
    for channel in ["sensor_ax", "sensor_ay"] {
        let x = &signals.get(channel).unwrap()[2560..];
        let options = Options { silent: Some(MACHINE_NOISE), exact: true, ..Options::new(50.0, orders) };
        let analysis = analyze(x, 25_600.0, &options).unwrap();
        let causes: Vec<_> = analysis.causes().map(|f| f.name).collect();
        assert_eq!(causes, ["2 BSF"], "{channel}: {}", analysis.verdict());
    }
}

/// Of an NU206 2 BSF lies 5 % below BPFO, where a slipping cage would have it: in a record too short for the sidebands
/// of a roller, the outer race took its lines.
#[test]
fn regress_a_roller_in_a_short_record_is_no_outer_race() {
    for (rpm, load, clearance, roller, size) in
        [(2151.6, 4538.0, 6.97, 12, [3.6, 1.39, 2.18]), (1235.2, 4986.0, 9.24, 1, [4.1, 2.04, 1.2])]
    {
        let [depth, length, width] = size;
        let text = format!(
            "bearing = {{ preset = \"NU206\", radial_clearance_um = {clearance} }}\n\
             operation = {{ speed_rpm = {rpm}, load_n = [0.0, -{load:?}] }}\n\
             simulation = {{ duration_s = 0.5, sample_rate_hz = 25600.0 }}\n\
             [[defects]]\non = \"roller\"\nroller = {roller}\ndepth_um = {depth}\n\
             shape = {{ rectangle = {{ length_mm = {length}, width_mm = {width} }} }}\n"
        );
        let s = read(&text);
        let (_, signals) = brinell::record(&s).unwrap();
        let orders = orders_of(&s.bearing);
        let options = Options { silent: Some(MACHINE_NOISE), exact: true, ..Options::new(rpm / 60.0, orders) };
        let analysis = analyze(&signals.get("sensor_ay").unwrap()[2560..], 25_600.0, &options).unwrap();
        let races = analysis.causes().filter(|f| matches!(f.component, Component::OuterRace | Component::InnerRace));
        assert_eq!(races.count(), 0, "{}", analysis.verdict());
    }
}

/// Under the paper's damping BPFI less twice the shaft's frequency lies a few per cent below BPFO, where a slip beyond the tolerance would be. Of
/// 140 such verdicts 46 named the outer race; impacts amplify round-off, so that a share is asked.
#[test]
fn regress_an_inner_race_of_balls_is_no_outer_one() {
    let (mut inner, mut outer) = (0, Vec::new());
    for preset in ["6203", "6205", "6207", "UER204"] {
        for load in [100.0, 300.0, 1000.0] {
            let text = format!(
                "bearing = {{ preset = \"{preset}\" }}\n\
                 operation = {{ speed_rpm = 600.0, load_n = [0.0, -{load:?}], load_on = \"inner-ring\" }}\n\
                 simulation = {{ laws = \"li2023\", geometry = \"exact\", duration_s = 3.0, sample_rate_hz = 25600.0, start = \"equilibrium\" }}\n\
                 [[defects]]\non = \"inner-raceway\"\ncenter_deg = -90.0\ndepth_um = 10.0\n\
                 shape = {{ rectangle = {{ length_mm = 1.0, width_mm = 1.0 }} }}\n"
            );
            let s = read(&text);
            let (_, signals) = brinell::record(&s).unwrap();
            let orders = orders_of(&s.bearing);
            let options = Options { silent: Some(MACHINE_NOISE), exact: true, ..Options::new(10.0, orders) };
            for channel in ["sensor_ax", "sensor_ay"] {
                let analysis = analyze(&signals.get(channel).unwrap()[3072..], 25_600.0, &options).unwrap();
                let named = |c| analysis.causes().any(|f| f.component == c);
                inner += usize::from(named(Component::InnerRace));
                if named(Component::OuterRace) {
                    outer.push(format!("{preset}, {load} N, {channel}: {}", analysis.verdict()));
                }
            }
        }
    }
    println!("{inner} of 24 name the inner race, {} the outer one\n{}", outer.len(), outer.join("\n"));
    assert!(outer.len() <= 2, "{}", outer.join("\n"));
    assert!(inner >= 16, "{inner} of 24");
}

/// From standstill to 1800 r/min in 0.4 s the cage lags by 4 %: followed on the shaft's known speed, the damage is
/// named.
#[test]
fn regress_the_verdict_on_the_run_up() {
    let path = format!("{}/../../examples/run-up.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let mut s = read(&text);
    let orders = orders_of(&s.bearing);
    let (rate, seconds, start) = (s.simulation.sample_rate_hz, s.simulation.duration_s, 0.02);
    let x = recorded(&mut s, rate, seconds, start);
    // 4500 (r/min)/s up to 0.4 s.
    let speeds = [(0.0, 1.5), (0.4 - start, 30.0), (seconds - start, 30.0)];
    let rotation = Rotation::from_speeds(&speeds).unwrap();
    let turns = 0.5 * (1.5 + 30.0) * (0.4 - start) + 30.0 * (seconds - 0.4);
    let options = Options {
        silent: Some(MACHINE_NOISE),
        exact: true,
        rotation: Some(rotation),
        ..Options::new(turns / (seconds - start), orders)
    };
    let analysis = analyze(&x, rate, &options).unwrap();
    let causes: Vec<Component> = analysis.causes().map(|f| f.component).collect();
    assert_eq!(causes, [Component::OuterRace], "{}", analysis.verdict());
}

/// How deep the passing rollers of healthy bearings modulate the envelope at BPFO in two seconds: what
/// docs/src/results/analyze-evidence.md says of it.
#[test]
#[ignore = "prints a table; 28 runs of two seconds"]
fn regress_bpfo_of_healthy_bearings() {
    let loads = [150.0, 250.0, 300.0, 350.0, 600.0, 1000.0, 3000.0];
    let speeds = [1800.0, 3600.0];
    for (preset, rpm) in ["NN3007", "NU206"].into_iter().flat_map(|preset| speeds.map(|rpm| (preset, rpm))) {
        for load in loads {
            let text = format!(
                "bearing.preset = \"{preset}\"\noperation = {{ speed_rpm = {rpm:?}, load_n = [{load:?}, 0.0], load_on = \"outer-ring\" }}\n"
            );
            let mut s = read(&text);
            let orders = orders_of(&s.bearing);
            let x = recorded(&mut s, 25_600.0, 2.12, 0.02 + 60.0 / rpm);
            let options = Options { silent: Some(MACHINE_NOISE), exact: true, ..Options::new(rpm / 60.0, orders) };
            let analysis = analyze(&x, 25_600.0, &options).unwrap();
            let found: Vec<String> = (analysis.causes())
                .map(|f| {
                    let depth = 100.0 * f.modulation;
                    format!("{} {depth:.0} %, {}", f.name, analysis.clarity(f))
                })
                .collect();
            println!("{preset}, {rpm} r/min, {load} N: {}", found.join("; "));
            // A single row's passing may be clear; all other lines of an undamaged bearing have to be called weak.
            assert!(
                analysis
                    .causes()
                    .all(|f| analysis.clarity(f) == "weak" || preset == "NU206" && f.component == Component::OuterRace)
            );
        }
    }
}
