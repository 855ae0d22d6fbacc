//! One run: from its draw to a row of the data set.

use crate::dataset::campaign::Campaign;
use crate::dataset::columns::STATUS;
use crate::dataset::simulated::{Run, Short};
use crate::listener::Listener;
use brinell_io::Cell;

/// A finished run.
pub(crate) struct Row {
    pub(crate) cells: Vec<Cell>,
    /// Why it failed.
    pub(crate) failed: Option<String>,
}

/// Runs `index` and makes its row; nothing where it was broken off. A run that cannot be is a row with its reason.
pub(crate) fn make(campaign: &Campaign, index: usize, listener: &dyn Listener) -> Option<Row> {
    let mut run = Run::new(campaign.draws(), index);
    match run.go(campaign.try_scenario(index), campaign.signals(), listener) {
        Ok(()) => {}
        Err(Short::Failed(reason)) => run.failed = Some(reason),
        Err(Short::Stopped) => return None,
    }
    let cells = campaign.columns().iter().map(|column| column.cell(&mut run));
    Some(Row { cells: cells.collect(), failed: run.failed })
}

/// Whether a row's file of its own says that the run failed.
pub(crate) fn is_failed(cells: &[Cell]) -> bool {
    cells.get(STATUS) == Some(&Cell::Words("failed".into()))
}
