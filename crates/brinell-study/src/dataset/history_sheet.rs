//! One machine's history to look at.

use crate::dataset::error::DatasetError;
use crate::dataset::sheet::{Opened, SheetRun, number, numbers, run_of, spread, words};
use brinell_io::Cell;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

/// How far the envelope's line may be from the frequency in pure rolling: slip.
const SLIP: f64 = 0.015;

/// A machine's history.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HistorySheet {
    /// Name of the data set.
    pub name: String,
    /// Version, commit and kernel of brinell that made it.
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
}

impl HistorySheet {
    /// In how many snapshots a length is told, and how many intervals hold the true one, and why it is not told.
    pub fn told(&self) -> String {
        let (damaged, healthy): (Vec<_>, Vec<_>) =
            self.snapshots.iter().filter(|s| s.size.is_some()).partition(|s| s.length_mm.is_some());
        let told = |of: &[&SheetSnapshot]| of.iter().filter(|s| matches!(s.size, Some(Ok(_)))).count();
        let holds = |s: &&&SheetSnapshot| match (&s.size, s.length_mm) {
            (Some(Ok([low, _, high])), Some(mm)) => (*low..=*high).contains(&mm),
            _ => false,
        };
        // Reasons that differ in numbers alone are one.
        let mut why = BTreeMap::<String, (usize, &str, bool)>::new();
        for reason in damaged.iter().filter_map(|s| s.size.as_ref()?.as_ref().err()) {
            let reason = reason.split(':').next().unwrap_or_default();
            let kind = reason.replace(|c: char| c.is_ascii_digit() || c == '.', "");
            let (count, first, differ) = why.entry(kind).or_insert((0, reason, false));
            *count += 1;
            *differ |= *first != reason;
        }
        let of_first = |differ: bool| if differ { " (the numbers of the first of them)" } else { "" };
        let words = |(count, reason, differ): &(usize, &str, bool)| {
            format!("{count} time{} {reason}{}", if *count == 1 { "" } else { "s" }, of_first(*differ))
        };
        let why: Vec<String> = why.values().map(words).collect();
        let mut said = vec![format!(
            "told in {} of {} snapshots with damage; {} of these intervals hold the true length",
            told(&damaged),
            damaged.len(),
            damaged.iter().filter(holds).count()
        )];
        said.extend((!why.is_empty()).then(|| format!("not told: {}", why.join(", "))));
        let healthy = (told(&healthy), healthy.len());
        if damaged.is_empty() {
            said = vec!["no snapshot has damage of known length".into()];
        }
        said.extend(
            (healthy.0 > 0).then(|| format!("told of damage that is not there in {} of {}", healthy.0, healthy.1)),
        );
        said.join("; ")
    }
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
    /// Lower end of a 95 % interval of the length, the length and the upper end, mm, as the signal tells them, or why it does not; `None` without a signal.
    pub size: Option<Size>,
}

/// See [`SheetSnapshot::size`].
pub type Size = Result<[f64; 3], String>;

/// What the length of the damage is estimated from.
#[derive(Debug)]
pub struct WholeSignal<'a> {
    /// All samples from the end of the start on.
    pub samples: Vec<f64>,
    /// Hz.
    pub rate_hz: f64,
    /// Their unit.
    pub unit: &'a str,
    /// Speed of the shaft, r/min, where it is constant.
    pub speed_rpm: Option<f64>,
    /// The scenario, TOML; empty where it is held out.
    pub scenario: String,
}

/// What is read of a snapshot beside what a contact sheet reads of a run.
const COLUMNS: &str = "status class snapshot time_h state life_h remaining_life_h damage_begins_h damage_fails_mm outline_s_mm outline_z_mm \
                       edge_pressure_mpa scenario";

/// The history of machine `machine` of the data set in `folder`; signals of at most `each` snapshots are shown. `size` estimates
/// the length of the damage from each; one at a time is in memory.
///
/// # Errors
/// Where there is no such machine, the data set has none, or it cannot be read.
pub fn history(
    folder: impl AsRef<Path>,
    machine: usize,
    each: usize,
    size: impl Fn(WholeSignal) -> Size,
) -> Result<HistorySheet, DatasetError> {
    let opened = Opened::new(folder.as_ref())?;
    let place = opened.folder.root.display().to_string();
    let Some(histories) = &opened.about.histories else {
        return Err(DatasetError::Refused(format!(
            "{place}: its runs are no histories of machines; `brinell dataset sheet` without --machine shows them"
        )));
    };
    let columns: Vec<&str> = opened.columns().chain(COLUMNS.split(' ')).collect();
    let mut sheet = HistorySheet { machine, ..HistorySheet::default() };
    let mut snapshots = Vec::new();
    for path in &opened.parts {
        let mut on = None;
        let mut are_of = Vec::new();
        opened.each_row(
            path,
            &["machine", "defect_on"],
            |_| true,
            |row| {
                let is_of = row["machine"] == Cell::Whole(machine as i64);
                are_of.push(is_of);
                if let Cell::WordsList(words) = &row["defect_on"]
                    && is_of
                {
                    on = on.take().or_else(|| words.first().cloned());
                }
            },
        )?;
        sheet.on = on.unwrap_or(sheet.on);
        let is_wanted = |row: usize| are_of.get(row).is_some_and(|is_of| *is_of);
        opened.each_row(path, &columns, is_wanted, |row| {
            let mut snapshot = snapshot(&row, &opened.signal, &sheet.on);
            snapshot.size = whole(&row, &opened, &snapshot.run).map(&size);
            sheet.class = words(&row, "class");
            sheet.life_h = number(&row, "life_h");
            sheet.begins_h = number(&row, "damage_begins_h");
            sheet.fails_mm = number(&row, "damage_fails_mm");
            snapshots.push((if let Cell::Whole(k) = row["snapshot"] { k } else { i64::MAX }, snapshot));
        })?;
    }
    if snapshots.is_empty() {
        return Err(DatasetError::Refused(format!(
            "{place}: no rows of machine {machine}; machines of this data set are 0 to {}",
            histories.machines.saturating_sub(1)
        )));
    }
    snapshots.sort_by_key(|(number, _)| *number);
    sheet.snapshots = snapshots.into_iter().map(|(_, snapshot)| snapshot).collect();
    sheet.assumed = histories.assumed.clone();
    let with_signal = |snapshot: &&mut SheetSnapshot| !snapshot.run.stretch.is_empty();
    let mut seen: Vec<&mut SheetSnapshot> = sheet.snapshots.iter_mut().filter(with_signal).collect();
    for k in spread(seen.len(), each) {
        seen[k].is_shown = true;
    }
    (sheet.signal, sheet.unit) = (opened.signal, opened.unit);
    (sheet.version, sheet.name) = (opened.about.made_by(), opened.about.name);
    Ok(sheet)
}

/// The row's signal from the end of the start on, where it has one.
fn whole<'a>(row: &HashMap<&str, Cell>, opened: &'a Opened, run: &SheetRun) -> Option<WholeSignal<'a>> {
    let Cell::Signal(x) = &row[&*opened.signal] else { return None };
    let rate_hz = 1.0 / run.dt_s;
    let from = (run.analysed_from_s * rate_hz).round() as usize;
    let samples = x.iter().skip(from).map(|x| f64::from(*x)).collect();
    Some(WholeSignal {
        samples,
        rate_hz,
        unit: &opened.unit,
        speed_rpm: run.speed_rpm,
        scenario: words(row, "scenario"),
    })
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
        size: None,
    }
}
