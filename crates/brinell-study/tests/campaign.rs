//! Many runs as one piece of work: company changes nothing, names are known beforehand, and numbers say what findings
//! say.

use brinell::document::read;
use brinell::scenario::Scenario;
use brinell::signal::Indicator;
use brinell::simulate::Simulation;
use brinell::{Error, RunResult, simulate};
use brinell_study::campaign;
use brinell_study::listener::{Listener, RunListener, Silent};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

fn scenario(settings: &[(&str, &str)]) -> Scenario {
    let text = include_str!("../../../examples/single-row.toml");
    let mut overrides = vec![("simulation.duration_s", "0.32"), ("simulation.laws", "li2023")];
    overrides.extend(settings);
    let overrides: Vec<(String, String)> =
        overrides.into_iter().map(|(key, value)| (key.into(), value.into())).collect();
    read(text, &overrides).expect("it is sound").scenario
}

/// Breaks off the first run.
struct StopFirst;

impl Listener for StopFirst {
    fn begin(&self, run: usize, _: f64) -> RunListener<'_> {
        Box::new(move |_| if run == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}

#[test]
fn prop_runs_side_by_side_are_those_of_each_alone() {
    let list = [scenario(&[]), scenario(&[("simulation.model", "lumped")]), scenario(&[("defects", "[]")])];
    let all = campaign::run_all(&list, NonZeroUsize::new(3).unwrap(), &Silent);
    let mut finished = Vec::new();
    for (one, result) in list.iter().zip(all) {
        let together = result.expect("it runs");
        let alone = simulate(one).unwrap();
        assert_eq!(together.quantities(), alone.quantities());
        finished.push(together);
    }
    for run in &finished {
        let simulation = Simulation::new(&run.scenario).unwrap();
        let names: Vec<String> = run.quantities().into_iter().map(|q| q.name).collect();
        assert_eq!(brinell::result::names(&run.scenario, &simulation), names);
        let mut once = names.clone();
        once.sort();
        once.dedup();
        assert_eq!(once.len(), names.len(), "every name is there once");
    }

    // Numbers are those of the findings.
    let [full, lumped, healthy] = &finished[..] else { panic!("three runs") };
    let quantity = |run: &RunResult, name: &str| run.quantity(name).expect("it is told");
    let sensor = &full.findings.channels;
    let sensor = sensor.iter().find(|c| c.name == "sensor_ay").unwrap();
    let rms = sensor.blocks.estimate(Indicator::Rms).unwrap();
    assert_eq!(quantity(full, "sensor_ay.rms").value, Some(rms.value));
    let interval = rms.interval.map(|i| (i.low, i.high));
    assert!(interval.is_some());
    assert_eq!(quantity(full, "sensor_ay.rms").interval(), interval);
    // The lumped model's motion is kinematic: it has no slip to tell.
    assert!(quantity(full, "row1.cage_slip").value.is_some());
    assert_eq!(quantity(lumped, "row1.cage_slip").value, None);
    let peak = quantity(full, "sensor_ay.peak").value.unwrap();
    for name in ["defect1.entry_peak", "defect1.exit_peak"] {
        let impact = quantity(full, name).value.unwrap();
        assert!(0.0 < impact && impact <= peak, "{name} {impact}, {peak}");
    }
    assert!(healthy.quantities().iter().all(|q| !q.name.starts_with("defect")));

    // Against each other: what one run lacks has no ratio, and the first has none.
    let compared = campaign::compare(&[full, lumped, healthy]);
    let one = |name: &str| compared.iter().find(|c| c.name == name).unwrap();
    let rms = one("sensor_ay.rms");
    assert_eq!(rms.ratios[0], None);
    let quieter = rms.ratios[2].expect("both rings move");
    assert!(quieter.value < 1.0 && quieter.interval.is_some());
    // The lumped model holds the outer ring where the load is on the inner one: nothing is measured, and nothing has no
    // ratio.
    assert_eq!(rms.of[1].as_ref().and_then(|q| q.value), Some(0.0));
    assert_eq!(rms.ratios[1], None);
    assert!(one("inner_ay.rms").ratios[1].is_some());
    assert_eq!(one("defect1.entry_peak").of[2], None);
    assert_eq!(one("defect1.entry_peak").ratios[2], None);
}

#[test]
fn prop_a_run_that_is_broken_off_is_none() {
    let list = [scenario(&[]), scenario(&[])];
    let results = campaign::run_all(&list, NonZeroUsize::MIN, &StopFirst);
    assert!(matches!(results[0], Err(Error::Stopped)));
    assert!(results[1].is_ok());
}

#[test]
fn prop_scenarios_that_mean_the_same_have_one_fingerprint() {
    let plain = campaign::fingerprint(&scenario(&[]));
    let same = scenario(&[("operation.speed_rpm", "1500"), ("bearing.radial_clearance_um", "5")]);
    assert_eq!(campaign::fingerprint(&same), plain);
    let other = scenario(&[("bearing.radial_clearance_um", "5.000000000000001")]);
    assert_ne!(campaign::fingerprint(&other), plain);
    // FIPS 180-2, appendix B.1.
    assert_eq!(brinell::made_by::digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
