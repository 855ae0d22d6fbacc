//! Any valid scenario, drawn at random from the schema of scenario files: it is refused with a key, or it runs as foretold.
//!
//! More of them, from another seed: `BRINELL_DRAWN=1000..3000 cargo test --release -p brinell --test all -- any_valid --nocapture`.

mod draw;

use brinell::document::{self, Loaded, Severity};
use brinell::many;
use brinell::result::finish;
use brinell::simulate::{Cost, End, Observer, Simulation, cost};
use std::ops::{ControlFlow, Range};

/// Longer runs are not made here: that they would be long is known.
const LONG: f64 = 5e4;

/// Whether all numbers of a run's rows are finite.
struct Finite(bool);

impl Observer for Finite {
    fn again(&mut self, _: &Simulation) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn row(&mut self, _: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.0 &= row.iter().chain(filtered).all(|x| x.is_finite());
        ControlFlow::Continue(())
    }
}

/// What became of one.
#[derive(Debug)]
#[expect(dead_code, reason = "printed")]
enum Fate {
    /// With every key of its errors left out it is none still.
    NoScenario,
    /// It has no model, or no balance to start from.
    NoModel(String),
    /// Too long for this test.
    Long(f64),
    /// The solver gave up, with a reason.
    Failed(String),
    /// To its end: what it was to cost, its steps, and what its audit was first left open by.
    Ran { cost: Cost, steps: u64, refined: Option<f64> },
}

/// Lines that hold a text together; any other one may go.
fn is_kept(line: &str) -> bool {
    const NEEDED: [&str; 14] = [
        "[",
        "element",
        "inner_race",
        "outer_race",
        "roller_d",
        "roller_l",
        "rollers_p",
        "speed",
        "load_n",
        "duration",
        "sample",
        "on =",
        "center",
        "shape",
    ];
    NEEDED.iter().any(|start| line.starts_with(start))
}

/// The scenario of a text, without the lines that its errors name.
fn scenario(mut text: String) -> Option<Loaded> {
    loop {
        let problems = match document::read(&text, &[]) {
            Ok(loaded) => return Some(loaded),
            Err(problems) => problems,
        };
        let errors = problems.iter().filter(|p| p.severity == Severity::Error);
        assert!(errors.clone().all(|p| !p.key.is_empty()), "an error without its key: {problems:?}\n{text}");
        let named: Vec<usize> = errors.filter_map(|p| p.line).collect();
        let goes = |(k, line): (usize, &str)| named.contains(&(k + 1)) && !is_kept(line);
        let left: Vec<&str> = text.lines().enumerate().filter(|&line| !goes(line)).map(|(_, line)| line).collect();
        if left.len() == text.lines().count() {
            return None;
        }
        text = left.join("\n");
    }
}

fn fate(seed: u64) -> Fate {
    let Some(loaded) = scenario(draw::scenario(seed)) else { return Fate::NoScenario };
    let written = loaded.to_toml();
    let again = document::read(&written, &[])
        .unwrap_or_else(|e| panic!("{seed}: what was written is refused: {e:?}\n{written}"));
    assert_eq!(again.scenario, loaded.scenario, "{seed}: what was written is another scenario");
    let simulation = match Simulation::unchecked(&loaded.scenario) {
        Ok(simulation) => simulation,
        Err(error) => {
            assert!(error.is_bad_input(), "{seed}: {error}\n{written}");
            return Fate::NoModel(error.to_string());
        }
    };
    let cost = match cost(&simulation) {
        Ok(cost) if cost.steps <= LONG => cost,
        Ok(cost) => return Fate::Long(cost.steps),
        Err(error) => return Fate::Failed(error.to_string()),
    };
    let mut finite = Finite(true);
    let outcome = finish(loaded.scenario, simulation, &mut finite).outcome;
    assert!(finite.0, "{seed}: a number is not finite\n{written}");
    match outcome.end {
        End::Complete => {}
        End::Failed(error) => return Fate::Failed(error.to_string()),
        End::Stopped => unreachable!("nobody stops it"),
    }
    let open = outcome.energy.left_open();
    assert!(
        open.is_none(),
        "{seed}: the energy audit is left open by {open:?}, first by {:?}\n{written}",
        outcome.refined
    );
    Fate::Ran { cost, steps: outcome.work.solver.steps, refined: outcome.refined }
}

/// Two hundred, or those that `BRINELL_DRAWN` names.
fn seeds() -> Range<u64> {
    let named = std::env::var("BRINELL_DRAWN").ok();
    let ends = named.as_deref().and_then(|text| text.split_once(".."));
    ends.map_or(1..201, |(from, to)| from.parse().unwrap()..to.parse().unwrap())
}

#[test]
fn prop_any_valid_scenario_runs_to_finite_numbers_and_a_closed_audit_as_foretold() {
    let seeds = seeds();
    let count = (seeds.end - seeds.start) as usize;
    let fates = many::map(count, many::threads(2), |k| fate(seeds.start + k as u64));
    let mut ran = 0;
    for (seed, fate) in seeds.zip(&fates) {
        println!("{seed} {fate:?}");
        let Fate::Ran { cost, steps, refined } = fate else { continue };
        ran += 1;
        let passes = if refined.is_some() { 12.0 } else { 1.0 };
        // Impacts and damage after the first steps, or a start that is stiffer than what follows.
        let ratio = *steps as f64 / cost.steps;
        assert!((0.4..3.0 * passes).contains(&ratio), "{seed}: {steps} steps, foretold {cost:?}");
    }
    assert!(2 * ran > fates.len(), "{ran} of {} ran", fates.len());
}
