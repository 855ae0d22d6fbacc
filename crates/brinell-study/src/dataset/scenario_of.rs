//! The scenario of one run of a data set.

use super::columns::RUN;
use super::error::DatasetError;
use super::sheet::{Opened, words};
use brinell_io::Cell;
use std::path::Path;

/// Its column in the table of truth.
const SCENARIO: &str = "scenario";

/// The scenario of run `number` of the data set in `folder`, TOML: with it the run is simulated again.
///
/// # Errors
/// Where there is no such run, its scenario is not published, or the data set cannot be read.
pub fn scenario_of(folder: impl AsRef<Path>, number: u64) -> Result<String, DatasetError> {
    let opened = Opened::new(folder.as_ref())?;
    let place = opened.folder.root.display();
    let mut found = None;
    let mut runs = 0;
    for path in &opened.parts {
        // The texts of the other runs stay unread.
        let (first, mut at) = (runs, None);
        opened.each_row(
            path,
            &[RUN],
            |_| true,
            |row| {
                if matches!(row[RUN], Cell::Whole(k) if u64::try_from(k) == Ok(number)) {
                    at = Some(runs - first);
                }
                runs += 1;
            },
        )?;
        if let Some(at) = at {
            opened.each_row(path, &[SCENARIO], |row| row == at, |row| found = Some(words(&row, SCENARIO)))?;
            break;
        }
    }
    match found {
        Some(text) if text.is_empty() => Err(DatasetError::Refused(format!(
            "{place}: the scenario of run {number} is not there: its file of truth/ is absent, or it is held out"
        ))),
        Some(text) => Ok(text),
        None => Err(DatasetError::Refused(format!("{place}: no run {number}; it has {runs} runs, numbered from 0"))),
    }
}
