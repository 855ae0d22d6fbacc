//! One machine's history to look at.

use crate::dataset::error::DatasetError;
use crate::dataset::sheet::{Opened, SheetRun, number, numbers, run_of, spread, words};
use brinell_io::{Cell, read_records};
use std::collections::HashMap;
use std::path::Path;

/// How far the envelope's line may be from the frequency in pure rolling: slip.
const SLIP: f64 = 0.015;

/// A machine's history.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HistorySheet {
    /// Name of the data set.
    pub name: String,
    /// The version of brinell that made it.
    pub version: String,
    /// Number of the machine.
    pub machine: usize,
    /// Its class.
    pub class: String,
    /// Damaged part, sooner or later; empty of a machine that stays healthy.
    pub on: String,
    /// The signal's column.
    pub signal: String,
    /// Its unit.
    pub unit: String,
    /// Running time until failure, h; likewise of the next two.
    pub life_h: Option<f64>,
    /// Running time until damage begins, h.
    pub begins_h: Option<f64>,
    /// Length at which it fails, mm.
    pub fails_mm: Option<f64>,
    /// What of it is assumed.
    pub assumed: String,
    /// In the order of time.
    pub snapshots: Vec<SheetSnapshot>,
    /// Size of the damage as a signal tells it; none where nothing estimated it.
    pub estimates: Vec<SizeEstimate>,
}

/// One snapshot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetSnapshot {
    /// Running time, h.
    pub time_h: f64,
    /// healthy, damaged or failed.
    pub state: String,
    /// True length of the damage, mm; `None` without.
    pub length_mm: Option<f64>,
    /// Running time until failure, h.
    pub remaining_h: Option<f64>,
    /// Corners (s, z) of the damage, mm.
    pub outline_mm: Vec<[f64; 2]>,
    /// Largest pressure over the damage, MPa.
    pub edge_mpa: Option<f64>,
    /// Amplitude of the envelope at the frequency of the damaged part.
    pub level: Option<f64>,
    /// The run; of a failed one nothing of a signal.
    pub run: SheetRun,
    /// Whether its signal is shown.
    pub is_shown: bool,
}

/// Length of damage, with a 95 % interval, that was found in a snapshot's signal.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SizeEstimate {
    /// Running time of the snapshot, h.
    pub time_h: f64,
    /// Lower end, value and upper end, mm.
    pub length_mm: [f64; 3],
}

/// What is read of a snapshot beside what a contact sheet reads of a run.
const COLUMNS: &str = "status class snapshot time_h state life_h remaining_life_h damage_begins_h damage_fails_mm outline_s_mm outline_z_mm \
                       edge_pressure_mpa";

/// The history of machine `machine` of the data set in `folder`; signals of at most `each` snapshots are shown.
///
/// # Errors
/// Where there is no such machine, the data set has none, or it cannot be read.
pub fn history(folder: impl AsRef<Path>, machine: usize, each: usize) -> Result<HistorySheet, DatasetError> {
    let opened = Opened::new(folder.as_ref())?;
    let place = opened.folder.root.display().to_string();
    let Some(histories) = &opened.about.histories else {
        return Err(DatasetError::Refused(format!(
            "{place}: its runs are no histories of machines; `brinell dataset sheet` without --machine shows them"
        )));
    };
    let columns: Vec<&str> = opened.columns().chain(COLUMNS.split(' ')).collect();
    let mut rows: Vec<HashMap<&str, Cell>> = Vec::new();
    for path in &opened.parts {
        let numbers = read_records(path, &["machine"], |_| true)?;
        let is_wanted =
            |row: usize| numbers.get(row).and_then(|cells| cells.first()) == Some(&Cell::Whole(machine as i64));
        let found = read_records(path, &columns, is_wanted)?;
        rows.extend(found.into_iter().map(|cells| columns.iter().copied().zip(cells).collect()));
    }
    if rows.is_empty() {
        return Err(DatasetError::Refused(format!(
            "{place}: no rows of machine {machine}; machines of this data set are 0 to {}",
            histories.machines.saturating_sub(1)
        )));
    }
    rows.sort_by_key(|row| if let Cell::Whole(k) = row["snapshot"] { k } else { i64::MAX });
    let on = rows.iter().find_map(|row| match &row["defect_on"] {
        Cell::WordsList(on) => on.first().cloned(),
        _ => None,
    });
    let on = on.unwrap_or_default();
    let first = &rows[0];
    let mut sheet = HistorySheet {
        machine,
        class: words(first, "class"),
        signal: opened.signal.clone(),
        unit: opened.unit.clone(),
        life_h: number(first, "life_h"),
        begins_h: number(first, "damage_begins_h"),
        fails_mm: number(first, "damage_fails_mm"),
        assumed: histories.assumed.clone(),
        snapshots: rows.iter().map(|row| snapshot(row, &opened.signal, &on)).collect(),
        on,
        ..HistorySheet::default()
    };
    let with_signal = |snapshot: &&mut SheetSnapshot| !snapshot.run.stretch.is_empty();
    let mut seen: Vec<&mut SheetSnapshot> = sheet.snapshots.iter_mut().filter(with_signal).collect();
    for k in spread(seen.len(), each) {
        seen[k].is_shown = true;
    }
    (sheet.name, sheet.version) = (opened.about.name, opened.about.brinell);
    Ok(sheet)
}

fn snapshot(row: &HashMap<&str, Cell>, signal: &str, on: &str) -> SheetSnapshot {
    let (_, run) = run_of(row, signal);
    let frequency = match on {
        "outer-raceway" => number(row, "bpfo_hz"),
        "inner-raceway" => number(row, "bpfi_hz"),
        "roller" => number(row, "bsf_hz").map(|bsf| 2.0 * bsf),
        _ => None,
    };
    let level = frequency.filter(|_| run.df_hz > 0.0).map(|hz| {
        let [from, to] = [hz * (1.0 - SLIP) / run.df_hz, hz * (1.0 + SLIP) / run.df_hz];
        let lines = run.envelope.iter().enumerate().skip(from.round() as usize);
        lines.take_while(|(k, _)| *k as f64 <= to.round()).map(|(_, level)| *level).fold(0.0, f64::max)
    });
    let outline = numbers(row, "outline_s_mm").iter().zip(numbers(row, "outline_z_mm"));
    SheetSnapshot {
        time_h: number(row, "time_h").unwrap_or(f64::NAN),
        state: words(row, "state"),
        length_mm: run.defects.first().map(|defect| defect.length_mm),
        remaining_h: number(row, "remaining_life_h"),
        outline_mm: outline.map(|(s, z)| [*s, *z]).collect(),
        edge_mpa: number(row, "edge_pressure_mpa"),
        level,
        run,
        is_shown: false,
    }
}
