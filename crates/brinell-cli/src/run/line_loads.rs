//! `brinell run --line-loads`: the load along the rollers at chosen instants, as a table.

use crate::args::RunArgs;
use crate::failure::Failure;
use brinell::channel::Frame;
use brinell::observe::line_load::{LineLoadRow, LineLoads};
use brinell::simulate::{Observer, Simulation};
use brinell_io::{Cells, Column, Complete, Table};
use std::ops::ControlFlow;
use std::path::Path;

/// File in the folder of a run.
pub(super) const FILE: &str = "line_loads.csv";

/// What the instants requested are read with; `None` where none are.
pub(super) fn requested(args: &RunArgs, simulation: &Simulation, end: f64) -> Result<Option<Reading>, Failure> {
    let instants = &args.line_loads;
    if instants.is_empty() {
        return Ok(None);
    }
    if let Some(t) = instants.iter().find(|t| !(0.0..=end).contains(*t)) {
        return Err(Failure::Usage(format!("--line-loads {t}: the run goes from 0 to {end} s")));
    }
    match LineLoads::new(simulation.model(), instants, simulation.sample_rate()) {
        None => Err(Failure::Usage(
            "--line-loads: the load along straight rollers in the plane is even, so there is nothing to write; it needs simulation.model = \"tilting\" or a \
             bearing.profile other than \"straight\""
                .into(),
        )),
        some => Ok(some.map(Reading)),
    }
}

/// Reads the load at the samples of a run.
pub(super) struct Reading(pub(super) LineLoads);

impl Observer for Reading {
    fn again(&mut self, _: &Simulation) -> ControlFlow<()> {
        self.0.rows.clear();
        ControlFlow::Continue(())
    }

    fn sample(&mut self, index: u64, frame: &Frame) {
        self.0.take(index, frame);
    }
}

/// The table as a file of `folder`, up to its name.
pub(super) fn ready(Reading(loads): &Reading, folder: &Path) -> Result<Complete, Failure> {
    let rows = &loads.rows;
    let numbers = |of: &dyn Fn(&LineLoadRow) -> f64| Cells::Numbers(rows.iter().map(|row| Some(of(row))).collect());
    let side = |row: &LineLoadRow| Some(row.side.word().to_owned());
    let mut table = Table::default();
    let mut push = |name, unit, what, cells| table.push(Column::new(name, unit, what), cells);
    push("t", "s", "time", numbers(&|row| row.t));
    let row = numbers(&|row| row.roller.0 as f64);
    push("row", "", "row, from 1", row);
    let roller = numbers(&|row| row.roller.1 as f64);
    push("roller", "", "roller, from 1", roller);
    let sides = Cells::Words(rows.iter().map(side).collect());
    push("raceway", "", "inner or outer", sides);
    let z = numbers(&|row| row.z);
    push("z", "m", "middle of the slice along the roller", z);
    let load = numbers(&|row| row.line_load);
    push("line_load", "N/m", "load along the roller, with its damping", load);
    Ok(table.prepare_csv(folder.join(FILE))?)
}
