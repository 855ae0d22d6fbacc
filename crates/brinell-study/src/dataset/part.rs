//! Finished runs to a file of the data set.

use crate::campaign::kernel;
use crate::dataset::campaign::Campaign;
use crate::dataset::columns::{DataColumn, is_failed};
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{CAMPAIGN, FAILED, Folder, KERNEL, NAME, PART, TALLY, facts_of};
use crate::dataset::tally::{Places, Tally};
use crate::design::Part;
use brinell_io::{Cell, Metadata, RecordColumn, RecordWriter, Written, keys, read_row_file};
use serde_json::{Map, Value, json};

/// Cells of a row group, in bytes: what is in memory at once of a file that is written.
const GROUP_BYTES: usize = 8 << 20;

/// Rows that wait until they make a row group.
struct Rows {
    writer: RecordWriter,
    waiting: Vec<Vec<Cell>>,
    bytes: usize,
    rows: u64,
}

impl Rows {
    fn push(&mut self, row: Vec<Cell>) -> Result<(), DatasetError> {
        self.bytes += row.iter().map(Cell::size).sum::<usize>();
        self.waiting.push(row);
        self.rows += 1;
        // A group's rows follow from the rows alone, so that the same rows make the same bytes.
        if self.bytes >= GROUP_BYTES {
            self.flush()?;
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<(), DatasetError> {
        if !self.waiting.is_empty() {
            self.writer.write_group(&self.waiting)?;
        }
        self.waiting.clear();
        self.bytes = 0;
        Ok(())
    }

    fn finish(mut self) -> Result<(Written, u64), DatasetError> {
        self.flush()?;
        Ok((self.writer.finish()?, self.rows))
    }
}

fn metadata(campaign: &Campaign, columns: &[&DataColumn], part: usize, failed: u64, tally: &Value) -> Metadata {
    let descriptions: Map<String, Value> =
        columns.iter().map(|c| (c.record.column.name.clone(), c.record.column.description.as_str().into())).collect();
    let plan = campaign.plan();
    let metadata = Metadata::default()
        .with(keys::VERSION, brinell::VERSION)
        .with(NAME, &plan.name)
        .with(CAMPAIGN, campaign.identity())
        .with(PART, part.to_string())
        .with(FAILED, failed.to_string())
        .with(KERNEL, kernel())
        .with("brinell.licence", &plan.licence)
        .with(keys::DESCRIPTIONS, Value::from(descriptions).to_string());
    match tally {
        Value::Null => metadata,
        tally => metadata.with(TALLY, tally.to_string()),
    }
}

/// Writes file `part` from its finished runs; `None` where one of them is not there, or not whole.
pub(crate) fn write(campaign: &Campaign, folder: &Folder, part: usize) -> Result<Option<Value>, DatasetError> {
    let records: Vec<RecordColumn> = campaign.columns().iter().map(|c| c.record.clone()).collect();
    let read = |run: usize| read_row_file(folder.row(part, run), &records);
    // Read twice rather than held: how many failed is in the footer, which a writer is given at its beginning.
    let (mut failed, mut tally) = (0, Tally::of(campaign.plan().classes.len()));
    let places = Places::of(&records);
    for run in campaign.runs_of(part).iter().copied() {
        match read(run) {
            Some(cells) => {
                failed += u64::from(is_failed(&cells));
                tally.add(&cells, &places);
            }
            None => {
                // Not a whole row: the run is to be done again.
                let _ = std::fs::remove_file(folder.row(part, run));
                return Ok(None);
            }
        }
    }
    // By class it would tell labels.
    let tally = if campaign.split_of(part) == Part::HeldOut { Value::Null } else { tally.to_json() };
    let all: Vec<&DataColumn> = campaign.columns().iter().collect();
    let start = |path, columns: &[&DataColumn]| -> Result<Rows, DatasetError> {
        let records: Vec<RecordColumn> = columns.iter().map(|c| c.record.clone()).collect();
        Ok(Rows {
            writer: RecordWriter::create(path, &records, &metadata(campaign, columns, part, failed, &tally))?,
            waiting: Vec::new(),
            bytes: 0,
            rows: 0,
        })
    };
    let mut rows = start(folder.part(part), &all)?;
    let apart: Vec<usize> = (0..all.len()).filter(|k| all[*k].record.column.name == "run" || all[*k].tells).collect();
    let mut labels = match campaign.split_of(part) == Part::HeldOut {
        true => {
            let columns: Vec<&DataColumn> = apart.iter().map(|k| all[*k]).collect();
            Some(start(folder.held_out(part), &columns)?)
        }
        false => None,
    };
    for run in campaign.runs_of(part) {
        let Some(mut cells) = read(*run) else {
            return Ok(None);
        };
        if let Some(labels) = &mut labels {
            labels.push(apart.iter().map(|k| cells[*k].clone()).collect())?;
            for (cell, column) in cells.iter_mut().zip(&all) {
                if column.tells {
                    *cell = Cell::Empty;
                }
            }
        }
        rows.push(cells)?;
    }
    // The labels first: once the file of the runs is there, the part counts as finished.
    let labels = labels.map(Rows::finish).transpose()?;
    let (written, count) = rows.finish()?;
    let of = |(written, rows): &(Written, u64)| facts_of(*rows, 0, written.bytes, &written.sha256, Value::Null);
    let facts = json!({
        "runs": facts_of(count, failed, written.bytes, &written.sha256, tally),
        "held_out": labels.as_ref().map_or(Value::Null, of),
    });
    folder.write_facts(part, &facts)?;
    Ok(Some(facts))
}
