//! What the tables of damaged contacts err by: against tables of a doubled grid with twice the nodes (section 19), in the force and in the
//! accelerations of runs. Takes minutes in a release build: `cargo test --release -p brinell-damage --test all table_errors -- --ignored --nocapture`.

use brinell::Scenario;
use brinell::defect::{Defect, SIDES, Side};
use brinell::effective::Table;
use brinell::half_space::build::{Range, refined_table};
use brinell::half_space::damage::{Damage, gather};
use brinell::half_space::geometry::Geometry;
use brinell::half_space::{Shelf, keep_on};
use brinell::model::Model;
use brinell::scenario::Tables;
use brinell::simulate::{Signals, Simulation};
use std::collections::VecDeque;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

/// The four cases: examples, each with its seconds of simulation and what its RMS may differ by, %. What the small pit under a ball takes of the force
/// is some 2 % of it, so that 0.1 % of the force is 5 % of the RMS: tables as fine as these and finer give values that scatter by 3 %.
const CASES: [(&str, f64, f64); 4] =
    [("rectangle", 0.25, 1.0), ("ball-6205", 0.25, 4.0), ("photo", 0.25, 1.0), ("roller", 0.25, 1.0)];

/// Tables that the next model takes in place of making its own.
struct Instead;

static INSTEAD: Mutex<VecDeque<Vec<u8>>> = Mutex::new(VecDeque::new());

impl Shelf for Instead {
    fn take(&self, _: &str) -> Option<Vec<u8>> {
        INSTEAD.lock().unwrap().pop_front()
    }

    fn put(&self, _: &str, _: &[u8]) {}
}

fn example(name: &str) -> Scenario {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let text = std::fs::read_to_string(folder.join(name).with_extension("toml")).unwrap();
    let mut scenario = brinell::document::read(&text, &[]).unwrap().scenario;
    brinell_damage::resolve(&mut scenario, &folder).unwrap();
    scenario
}

/// The tables of the only defect, by side.
fn tables(of: &Scenario, class: Tables, refinement: u32) -> Vec<(Side, Table)> {
    let defects = Defect::all(&of.defects, &of.bearing, &of.contact).unwrap();
    let mut quick = of.clone();
    quick.contact.tables = Tables::Quick;
    let model = Model::new(&quick).unwrap();
    let met = SIDES.into_iter().filter(|side| defects[0].meets_side(*side));
    met.map(|side| {
        // Without a rim the first deformation is a tenth of the static one.
        let range = Range::of(10.0 * model.defects[0].table(side).unwrap().delta_nodes()[1]);
        (side, table_of(of, side, &range, (class, refinement)))
    })
    .collect()
}

/// The table of the only damage that meets a side.
pub(crate) fn table_of(of: &Scenario, side: Side, range: &Range, fineness: (Tables, u32)) -> Table {
    let defects = Defect::all(&of.defects, &of.bearing, &of.contact).unwrap();
    let geometry = Geometry::of_bearing(&of.bearing, &of.contact, side).unwrap();
    let groups = gather(&defects, |_| geometry.reach(range.largest));
    let damage = Damage::of(&defects, &groups[0], 1e-6 * of.contact.edge_radius_um);
    let (threads, stop) = (brinell::many::threads(usize::MAX), AtomicBool::new(false));
    refined_table(&geometry, &damage.raster, range, fineness, threads, &stop).unwrap().table
}

/// Worst and RMS difference of Q, % of the healthy Q at delta or at a tenth of the static deformation, whichever is more.
fn force_errors(model: &Model, side: Side, [one, other]: [&Table; 2]) -> [f64; 2] {
    const PLACES: [u32; 2] = [1200, 150];
    let healthy = model.healthy(side);
    let force = |delta: f64| healthy.force_and_tangent(delta.max(0.0))[0];
    let ([from, to], last, tenth) =
        (other.range_s(), other.last_delta(), model.defects[0].table(side).unwrap().delta_nodes()[1]);
    let (mut worst, mut sum) = (0.0_f64, 0.0_f64);
    for k in 0..PLACES[0] {
        let s = from + (to - from) * (f64::from(k) + 0.5) / f64::from(PLACES[0]);
        for j in 0..PLACES[1] {
            let delta = 0.2 * tenth * (last / (0.2 * tenth)).powf((f64::from(j) + 0.5) / f64::from(PLACES[1]));
            let [a, b] = [one, other].map(|table| table.at(delta, s)).map(|at| force(at.delta) * at.by_delta);
            let error = (a - b) / force(delta.max(tenth));
            worst = worst.max(error.abs());
            sum += error * error;
        }
    }
    [worst, (sum / f64::from(PLACES[0] * PLACES[1])).sqrt()].map(|error| 100.0 * error)
}

/// RMS of the outer ring's acceleration, m/s2, with these tables; `run` tells runs of one scenario apart.
fn rms(of: &Scenario, tables: &[(Side, Table)], run: u32) -> f64 {
    let mut scenario = of.clone();
    // Another length to the last digits, so that the process does not know its tables.
    scenario.contact.edge_radius_um *= 1.0 + 1e-9 * f64::from(run + 1);
    *INSTEAD.lock().unwrap() = tables.iter().map(|(_, table)| table.to_bytes()).collect();
    let simulation = Simulation::new(&scenario).unwrap();
    assert!(INSTEAD.lock().unwrap().is_empty());
    let mut signals = Signals::new(&simulation).unwrap();
    simulation.run(&mut signals);
    let square = |name: &str| {
        let all = signals.get(name).unwrap();
        let steady = &all[all.len() / 5..];
        steady.iter().map(|a| a * a).sum::<f64>() / steady.len() as f64
    };
    (square("outer_ax") + square("outer_ay")).sqrt()
}

/// Prints what the book's chapter on mechanics states.
#[test]
#[ignore = "minutes in a release build"]
fn regress_accelerations_and_forces_against_refined_tables() {
    keep_on(Box::new(Instead));
    println!("Against grid and nodes doubled:");
    for (name, seconds, most) in CASES {
        let mut scenario = example(name);
        scenario.simulation.duration_s = seconds;
        let refined = tables(&scenario, Tables::Standard, 2);
        let model = Model::new(&scenario).unwrap();
        let fine = rms(&scenario, &refined, 0);
        let mut differs = [0.0; 2];
        for (k, class) in [Tables::Standard, Tables::Coarse].into_iter().enumerate() {
            let own = tables(&scenario, class, 1);
            for ((side, one), (_, other)) in own.iter().zip(&refined) {
                let [worst, mean] = force_errors(&model, *side, [one, other]);
                println!("{name}, {side:?}, {class:?}: Q worst {worst:.2} %, RMS {mean:.3} %");
            }
            differs[k] = 100.0 * (rms(&scenario, &own, k as u32 + 1) / fine - 1.0);
        }
        println!("{name}: RMS {fine:.4} m/s2, standard {:+.3} %, coarse {:+.3} %", differs[0], differs[1]);
        assert!(differs[0].abs() < most, "{name}: {differs:?}");
    }
}
