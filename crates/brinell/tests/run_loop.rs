//! A run in slices, and a run that goes on in another simulation.

use crate::common::li2023;
use brinell::result::record;
use brinell::scenario::{Accuracy, Speed};
use brinell::simulate::{End, Observer, Run, Signals, Simulation, cost};
use brinell::{Error, Scenario};
use std::ops::ControlFlow;

const BEARING: &str = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n";
const SPALL: &str = "[[defects]]\non = \"outer-raceway\"\ncenter_deg = 0\ndepth_um = 20\n\
    shape = { rectangle = { length_mm = 3, width_mm = 4 } }\n";

fn simulation(more: &str) -> Simulation {
    let scenario = li2023(&format!("{BEARING}{more}"));
    Simulation::new(&scenario).unwrap()
}

/// The first channel behind the anti-alias filter.
#[derive(Default)]
struct Sensor(Vec<f64>);

impl Observer for Sensor {
    fn row(&mut self, index: u64, _: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        assert_eq!(index as usize, self.0.len());
        self.0.push(filtered[0]);
        ControlFlow::Continue(())
    }
}

fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64).sqrt()
}

const OPEN: &str = include_str!("open-audit.toml");

#[test]
fn prop_a_run_whose_audit_stays_open_is_made_again_as_at_reference() {
    let standard = Scenario::from_toml(OPEN).unwrap();
    let (again, signals) = record(&standard).unwrap();
    let open = Simulation::new(&standard).unwrap().run(&mut ()).energy.left_open();
    assert!(open.is_some() && again.outcome.refined == open, "{open:?}, {:?}", again.outcome.refined);
    let mut reference = standard.clone();
    reference.simulation.accuracy = Accuracy::Reference;
    let (known, expected) = record(&reference).unwrap();
    assert_eq!(signals, expected);
    assert_eq!((known.outcome.refined, again.outcome.energy), (None, known.outcome.energy));
    assert!(known.outcome.energy.left_open().is_none());
}

#[test]
fn prop_a_run_of_more_steps_than_allowed_is_refused() {
    let mut scenario = li2023(&format!("{BEARING}{SPALL}[simulation]\nduration_s = 0.2\n"));
    let cost = cost(&Simulation::new(&scenario).unwrap()).unwrap();
    let steps = Simulation::new(&scenario).unwrap().run(&mut ()).work.solver.steps;
    assert!((0.5..2.0).contains(&(cost.steps / steps as f64)), "{cost:?} for {steps} steps");
    scenario.simulation.most_steps = 0.5 * steps as f64;
    let outcome = Simulation::new(&scenario).unwrap().run(&mut ());
    let End::Failed(error @ Error::TooLong { most, .. }) = outcome.end else { panic!("{:?}", outcome.end) };
    assert!(error.is_bad_input() && most == 0.5 * steps as f64 && error.to_string().contains("simulation.most_steps"));
    assert!(outcome.work.solver.steps as f64 <= most + 32.0);
}

#[test]
fn prop_however_a_run_is_cut_its_bits_are_the_same() {
    let sensor = "[sensor]\nmounting_resonance_hz = 9000\nnoise_rms_m_per_s2 = 0.1\n[simulation]\nduration_s = 0.02\n";
    let simulation = simulation(&format!("{SPALL}{sensor}"));
    let mut whole = Sensor::default();
    let outcome = simulation.run(&mut whole);
    assert_eq!(whole.0.len() as u64, simulation.samples());
    for slice in [1, 37, 100_000] {
        let mut run = Run::new(&simulation);
        let mut parts = Sensor::default();
        let end = loop {
            let before = run.rows();
            match run.advance(slice, &mut parts) {
                Some(end) => break end,
                None => assert_eq!(run.rows(), before + slice),
            }
        };
        assert_eq!(run.outcome(end), outcome);
        assert_eq!(parts.0, whole.0);
    }
}

/// A healthy bearing's signal hardly depends on how it is stepped: over 20 samples the two stay together.
#[test]
fn prop_a_run_that_goes_on_in_the_same_simulation_stays_on_its_way() {
    let simulation = simulation("");
    let mut runs = [Run::new(&simulation), Run::new(&simulation)];
    let mut sensors = [Sensor::default(), Sensor::default()];
    for (run, sensor) in runs.iter_mut().zip(&mut sensors) {
        assert_eq!(run.advance(1500, sensor), None);
    }
    assert!(runs[1].go_on_in(&simulation));
    for (run, sensor) in runs.iter_mut().zip(&mut sensors) {
        assert_eq!(run.advance(20, sensor), None);
    }
    let [stayed, went] = sensors.map(|s| s.0);
    assert_eq!(stayed[..1500], went[..1500]);
    let difference: Vec<f64> = stayed.iter().zip(&went).map(|(a, b)| a - b).collect();
    assert!(rms(&difference[1500..]) < 0.02 * rms(&stayed[1300..]));
}

#[test]
fn prop_a_spall_in_a_running_bearing_raises_the_rms_and_the_run_has_no_end() {
    let healthy = simulation("[simulation]\nduration_s = 0.1\n");
    let damaged = simulation(&format!("{SPALL}[simulation]\nduration_s = 0.1\n"));
    let mut run = Run::new(&healthy);
    let mut sensor = Sensor::default();
    assert_eq!(run.advance(u64::MAX, &mut sensor), Some(End::Complete));
    let before = sensor.0.len();
    assert!(run.go_on_in(&damaged));
    assert_eq!(run.advance(2560, &mut sensor), None);
    let (quiet, damaged) = (&sensor.0[before / 2..before], &sensor.0[before..]);
    assert!(rms(damaged) > 1.5 * rms(quiet), "{} {}", rms(damaged), rms(quiet));
    let outcome = run.outcome(End::Stopped);
    assert!(outcome.energy.residual().abs() < 0.01 * outcome.energy.turnover());
}

#[test]
fn prop_a_run_goes_on_only_where_the_states_correspond() {
    let simulation_ = simulation("");
    let mut run = Run::new(&simulation_);
    let one_row = Simulation::new(&li2023(&BEARING.replace("NN3007", "NU206"))).unwrap();
    assert!(!run.go_on_in(&one_row));
    let faster = simulation("[simulation]\nsample_rate_hz = 51200\n");
    assert!(!run.go_on_in(&faster));
    let tilting = simulation("[simulation]\nmodel = \"tilting\"\n");
    assert!(!run.go_on_in(&tilting));
    let more = simulation("[simulation]\nrecord = [\"cage1_ay\"]\n");
    assert!(!run.go_on_in(&more));
    assert_eq!(run.advance(3, &mut ()), None);
}

/// One built in code has no file that was read.
#[test]
fn regress_a_scenario_built_in_code_is_held_to_what_a_file_is() {
    let sound = li2023(&format!("{BEARING}{SPALL}[simulation]\nduration_s = 0.001\n"));
    let bad = |change: fn(&mut Scenario)| {
        let mut scenario = sound.clone();
        change(&mut scenario);
        scenario
    };
    let all = [
        ("operation.speed_rpm", bad(|s| s.operation.speed_rpm = Speed::Profile(Vec::new()))),
        ("bearing.rows", bad(|s| s.bearing.rows = 1 << 40)),
        ("depth_um", bad(|s| s.defects[0].depth_um = f64::NAN)),
    ];
    for (key, scenario) in all {
        let error = brinell::simulate(&scenario).unwrap_err();
        assert!(matches!(error, Error::Scenario(_)) && error.to_string().contains(key), "{key}: {error}");
    }
    assert!(brinell::simulate(&sound).is_ok());
}

/// What a file would be refused for, and what would end in a panic or in numbers of nothing.
#[test]
fn prop_a_scenario_changed_in_code_is_held_to_what_a_file_is() {
    type Change = fn(&mut Scenario);
    let changes: [(&str, Change); 6] = [
        ("depth_um", |s| s.defects[0].depth_um = f64::NAN),
        ("center_deg", |s| s.defects[0].center_deg = f64::NAN),
        ("radial_clearance_um", |s| s.bearing.radial_clearance_um = f64::NAN),
        ("speed_rpm", |s| s.operation.speed_rpm = Speed::Profile(Vec::new())),
        ("duration_s", |s| s.simulation.duration_s = 1e300),
        ("rollers_per_row", |s| s.bearing.rollers_per_row = 1 << 40),
    ];
    for (key, change) in changes {
        let mut scenario = li2023(&format!("{BEARING}{SPALL}"));
        change(&mut scenario);
        let Err(error) = Simulation::new(&scenario) else { panic!("{key} is taken") };
        assert!(error.is_bad_input() && error.to_string().contains(key), "{key}: {error}");
    }
}

/// Every channel of 240 rollers, 350 TB and more than an address reaches: a column by itself is not.
#[test]
fn prop_signals_beyond_any_memory_are_refused_as_a_whole() {
    let text = "[bearing]\nrows = 2\nrollers_per_row = 120\nroller_diameter_mm = 6\nroller_length_mm = 6\npitch_diameter_mm = 500\ninner_raceway_diameter_mm = 494\nouter_raceway_diameter_mm = 506\n\
        [operation]\nspeed_rpm = 600\nload_n = [300, 0]\n\
        [simulation]\nduration_s = 1e4\nsample_rate_hz = 999999\nrecord = [\"*\"]\n";
    let long = Simulation::new(&li2023(text)).unwrap();
    assert!(matches!(Signals::new(&long), Err(Error::TooLarge { bytes }) if bytes > 1 << 48));
}
