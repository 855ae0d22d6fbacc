//! Finished runs to a file of the data set.

use crate::campaign::{in_json, kernel};
use crate::dataset::about::{Facts, PartFacts};
use crate::dataset::campaign::Campaign;
use crate::dataset::columns::{DataColumn, Table, is_failed};
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{CAMPAIGN, FAILED, Folder, KERNEL, NAME, PART, TALLY, truth_path};
use crate::dataset::tally::{Places, Tally};
use crate::design::Part;
use brinell::made_by;
use brinell_io::{Cell, Metadata, RecordColumn, RecordWriter, keys, read_row_file};
use serde_json::{Map, Value};

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

    /// Of the runs, so many failed.
    fn finish(mut self, failed: u64, tally: Option<Tally>) -> Result<Facts, DatasetError> {
        self.flush()?;
        let written = self.writer.finish()?;
        let (rows, bytes, sha256) = (self.rows, written.bytes, written.sha256);
        Ok(Facts { rows, failed: Some(failed), bytes, sha256, tally, ..Facts::default() })
    }
}

fn metadata(campaign: &Campaign, columns: &[&DataColumn], part: usize, failed: u64, tally: Option<&Tally>) -> Metadata {
    let descriptions: Map<String, Value> =
        columns.iter().map(|c| (c.record.column.name.clone(), c.record.column.description.as_str().into())).collect();
    let plan = campaign.plan();
    let metadata = Metadata::made_by(brinell::VERSION, made_by::commit())
        .with(NAME, &plan.name)
        .with(CAMPAIGN, campaign.identity())
        .with(PART, part.to_string())
        .with(FAILED, failed.to_string())
        .with(KERNEL, kernel())
        .with("brinell.licence", &plan.licence)
        .with(keys::DESCRIPTIONS, Value::from(descriptions).to_string());
    match tally {
        None => metadata,
        Some(tally) => metadata.with(TALLY, in_json(tally).to_string()),
    }
}

/// Writes file `part` from its finished runs; `None` where one of them is not there, or not whole.
pub(crate) fn write(campaign: &Campaign, folder: &Folder, part: usize) -> Result<Option<PartFacts>, DatasetError> {
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
    let are_held_out = campaign.split_of(part) == Part::HeldOut;
    // By class it would tell labels.
    let tally = (!are_held_out).then_some(tally);
    let all: Vec<&DataColumn> = campaign.columns().iter().collect();
    let start = |path, columns: &[&DataColumn]| -> Result<Rows, DatasetError> {
        let records: Vec<RecordColumn> = columns.iter().map(|c| c.record.clone()).collect();
        Ok(Rows {
            writer: RecordWriter::create(path, &records, &metadata(campaign, columns, part, failed, tally.as_ref()))?,
            waiting: Vec::new(),
            bytes: 0,
            rows: 0,
        })
    };
    let among = |is_there: &dyn Fn(&DataColumn) -> bool| -> Vec<usize> {
        (0..all.len()).filter(|k| is_there(all[*k])).collect()
    };
    let (with_runs, apart) = (among(&DataColumn::is_with_runs), among(&|column| column.is_apart(are_held_out)));
    let chosen = |places: &[usize]| -> Vec<&DataColumn> { places.iter().map(|k| all[*k]).collect() };
    let path = truth_path(part, are_held_out);
    let mut rows = start(folder.part(part), &chosen(&with_runs))?;
    let mut truth = start(folder.root.join(&path), &chosen(&apart))?;
    for run in campaign.runs_of(part) {
        let Some(mut cells) = read(*run) else {
            return Ok(None);
        };
        truth.push(apart.iter().map(|k| cells[*k].clone()).collect())?;
        let of_run = with_runs.iter().map(|k| match are_held_out && all[*k].table == Table::Labels {
            true => Cell::Empty,
            false => std::mem::replace(&mut cells[*k], Cell::Empty),
        });
        rows.push(of_run.collect())?;
    }
    // The truth first: once the file of the runs is there, the part counts as finished.
    let truth = Facts { path, failed: None, ..truth.finish(0, None)? };
    let facts = PartFacts { runs: rows.finish(failed, tally)?, truth: Some(truth) };
    folder.write_facts(part, &facts)?;
    Ok(Some(facts))
}
