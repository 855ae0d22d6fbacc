//! A few runs of each class to look at: what the contact sheet shows.

use crate::dataset::about::{About, Class};
use crate::dataset::error::DatasetError;
use crate::dataset::folder::{Folder, TRUTH};
use brinell::channel::SENSOR;
use brinell::observe::envelope_band_above;
use brinell::scenario::Operation;
use brinell::signal::{Segments, envelope_spectrum};
use brinell_io::{Cell, each_record, read_records};
use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};

/// Turns of the shaft that the waveform shows, at the record's end.
const TURNS: f64 = 2.0;
/// The same where the speed varies, s.
const STRETCH_S: f64 = 0.1;

/// A data set's runs to look at.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sheet {
    /// Name of the data set.
    pub name: String,
    /// Version, commit and kernel of brinell that made it.
    pub version: String,
    /// The signal's column: the sensor along the load of the first run, or the first that there is.
    pub signal: String,
    /// Its unit.
    pub unit: String,
    /// In the order of their labels.
    pub classes: Vec<SheetClass>,
}

/// Runs of one class.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetClass {
    /// Its name.
    pub name: String,
    /// Its number.
    pub label: usize,
    /// Complete runs of it whose labels are open.
    pub runs: usize,
    /// Some of them.
    pub shown: Vec<SheetRun>,
}

/// One run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetRun {
    /// Its number.
    pub run: i64,
    /// What it is for.
    pub split: String,
    /// Speed of the shaft, r/min, where it is constant.
    pub speed_rpm: Option<f64>,
    /// Load [x, y], N.
    pub load_n: Vec<f64>,
    /// Its damage.
    pub defects: Vec<SheetDefect>,
    /// The ground truth counts from here on, s: so do RMS and envelope.
    pub analysed_from_s: f64,
    /// RMS of the signal less its mean, from `analysed_from_s` on.
    pub rms: f64,
    /// Kurtosis of the same: 3 of Gaussian noise.
    pub kurtosis: f64,
    /// Time of the first sample of `stretch`, s.
    pub from_s: f64,
    /// Sample interval, s.
    pub dt_s: f64,
    /// The signal's last two turns of the shaft; 0.1 s where the speed varies.
    pub stretch: Vec<f64>,
    /// Band of the envelope, Hz: as on a run's page.
    pub band_hz: (f64, f64),
    /// Distance of the envelope spectrum's lines, Hz.
    pub df_hz: f64,
    /// Amplitude of each line, from 0 Hz; empty where the record is too short for one.
    pub envelope: Vec<f64>,
    /// Up to where the spectrum says something of the bearing, Hz: 4.5 times the highest frequency of a raceway.
    pub top_hz: f64,
}

/// Damage of a run, as its labels have it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetDefect {
    /// outer-raceway, inner-raceway or roller.
    pub on: String,
    /// Place, degrees counter-clockwise from +x.
    pub center_deg: f64,
    /// Extent along s, mm.
    pub length_mm: f64,
    /// Along the axis, mm.
    pub width_mm: f64,
    /// Largest depth, um.
    pub depth_um: f64,
    /// Its ball-pass frequency, Hz; `None` where the speed varies.
    pub frequency_hz: Option<f64>,
}

/// A run that may be shown: which file, which row of it, which class.
struct Place {
    part: usize,
    row: usize,
    label: usize,
}

/// At most `each` runs of each class of the data set in `folder`, spread over its files. Runs that failed, and runs
/// whose labels are held out, are left out.
///
/// # Errors
/// Where there is no data set, or it cannot be read.
pub fn sheet(folder: impl AsRef<Path>, each: usize) -> Result<Sheet, DatasetError> {
    let opened = Opened::new(folder.as_ref())?;
    let class =
        |(label, class): (usize, &Class)| SheetClass { name: class.name.clone(), label, ..SheetClass::default() };
    let mut classes: Vec<SheetClass> = opened.about.classes.iter().enumerate().map(class).collect();
    let mut chosen = BTreeSet::new();
    for class in &mut classes {
        let of_class = opened.places.iter().filter(|place| place.label == class.label);
        let of_class: Vec<&Place> = of_class.collect();
        class.runs = of_class.len();
        let spread = spread(of_class.len(), each).map(|k| (of_class[k].part, of_class[k].row));
        chosen.extend(spread);
    }
    let columns: Vec<&str> = opened.columns().collect();
    for (part, path) in opened.parts.iter().enumerate() {
        let is_chosen = |row: usize| chosen.contains(&(part, row));
        opened.each_row(path, &columns, is_chosen, |row| {
            let (label, run) = run_of(&row, &opened.signal);
            if let Some(class) = classes.get_mut(label) {
                class.shown.push(run);
            }
        })?;
    }
    let Opened { about, signal, unit, .. } = opened;
    Ok(Sheet { version: about.made_by(), name: about.name, signal, unit, classes })
}

/// A data set whose files are read, and the signal that is shown of it.
pub(super) struct Opened {
    pub(super) folder: Folder,
    pub(super) about: About,
    pub(super) parts: Vec<PathBuf>,
    places: Vec<Place>,
    pub(super) signal: String,
    pub(super) unit: String,
}

impl Opened {
    pub(super) fn new(folder: &Path) -> Result<Self, DatasetError> {
        let folder = Folder::new(folder);
        let about = match folder.described()? {
            Some((about, _)) => about,
            None => folder.about()?.ok_or_else(|| folder.no_data_set())?,
        };
        let parts = folder.parts_there()?;
        if parts.is_empty() {
            return Err(DatasetError::Refused(format!(
                "{}: no file of runs is there (runs/part-*.parquet)",
                folder.root.display()
            )));
        }
        let places = places(&parts)?;
        let along = along_the_load(&parts, &places)?;
        let signals = || about.columns.iter().filter(|c| c.is_signal());
        let Some(signal) = signals().find(|c| c.name == along).or_else(|| signals().next()) else {
            let message = format!("{}: no column is a signal", folder.root.display());
            return Err(DatasetError::Refused(message));
        };
        let (signal, unit) = (signal.name.clone(), signal.unit.clone());
        Ok(Self { folder, about, parts, places, signal, unit })
    }

    /// Hands on each wanted row of a file of runs, with what the file of truth beside it says: without that file these cells
    /// are empty.
    pub(super) fn each_row<'a>(
        &self,
        path: &Path,
        columns: &[&'a str],
        is_wanted: impl Fn(usize) -> bool,
        mut each: impl FnMut(HashMap<&'a str, Cell>),
    ) -> Result<(), DatasetError> {
        let is_apart = |name: &str| self.about.columns.iter().any(|c| c.name == name && c.table == TRUTH);
        let (apart, with_runs): (Vec<&str>, Vec<&str>) = columns.iter().partition(|name| is_apart(name));
        let beside = self.folder.root.join(TRUTH).join(path.file_name().unwrap_or_default());
        let truth = match !apart.is_empty() && beside.exists() {
            true => read_records(&beside, &apart, &is_wanted)?,
            false => Vec::new(),
        };
        let mut truth = truth.into_iter();
        each_record(path, &with_runs, is_wanted, |cells| {
            let of_truth = truth.next().unwrap_or_else(|| vec![Cell::Empty; apart.len()]);
            let cells = with_runs.iter().copied().zip(cells).chain(apart.iter().copied().zip(of_truth));
            each(cells.collect());
        })?;
        Ok(())
    }

    /// What is read of a run.
    pub(super) fn columns(&self) -> impl Iterator<Item = &str> {
        COLUMNS.split(' ').chain([&*self.signal])
    }
}

fn places(parts: &[PathBuf]) -> Result<Vec<Place>, DatasetError> {
    let mut places = Vec::new();
    for (part, path) in parts.iter().enumerate() {
        let rows = read_records(path, &["status", "label"], |_| true)?;
        for (row, cells) in rows.iter().enumerate() {
            if let [Cell::Words(status), Cell::Whole(label)] = cells.as_slice()
                && status == "complete"
            {
                let label = *label as usize;
                places.push(Place { part, row, label });
            }
        }
    }
    Ok(places)
}

/// The sensor's column along the load of the first of the runs.
fn along_the_load(parts: &[PathBuf], places: &[Place]) -> Result<&'static str, DatasetError> {
    let Some(first) = places.first() else {
        return Ok("");
    };
    let rows = read_records(&parts[first.part], &["load_n"], |row| row == first.row)?;
    Ok(match rows.first().and_then(|cells| cells.first()) {
        Some(Cell::Numbers(load)) if load.len() == 2 => SENSOR[Operation::axis_along([load[0], load[1]])],
        _ => SENSOR[0],
    })
}

/// At most `each` of `count` places, the first and the last among them.
pub(super) fn spread(count: usize, each: usize) -> impl Iterator<Item = usize> {
    let shown = each.min(count);
    (0..shown).map(move |k| match shown {
        1 => 0,
        _ => k * (count - 1) / (shown - 1),
    })
}

/// What is read of a run beside its signal.
const COLUMNS: &str = "label run split speed_rpm load_n sample_rate_hz bpfo_hz bpfi_hz bsf_hz defect_on defect_center_deg \
                       defect_length_mm defect_width_mm defect_depth_um defect_frequency_hz analysed_from_s";

/// A number of a row.
pub(super) fn number(cells: &HashMap<&str, Cell>, name: &str) -> Option<f64> {
    match cells[name] {
        Cell::Number(x) => Some(x),
        _ => None,
    }
}

/// Numbers of a row; none where there is no list.
pub(super) fn numbers<'a>(cells: &'a HashMap<&str, Cell>, name: &str) -> &'a [f64] {
    match &cells[name] {
        Cell::Numbers(x) => x.as_slice(),
        _ => &[],
    }
}

/// Words of a row.
pub(super) fn words(cells: &HashMap<&str, Cell>, name: &str) -> String {
    match &cells[name] {
        Cell::Words(words) => words.clone(),
        _ => String::new(),
    }
}

/// A run from its cells, and its label.
pub(super) fn run_of(cells: &HashMap<&str, Cell>, signal: &str) -> (usize, SheetRun) {
    let whole = |name: &str| match cells[name] {
        Cell::Whole(x) => x,
        _ => -1,
    };
    let number = |name: &str| number(cells, name);
    let numbers = |name: &str| numbers(cells, name);
    let on: &[String] = match &cells["defect_on"] {
        Cell::WordsList(words) => words,
        _ => &[],
    };
    let defects = on.iter().enumerate().map(|(d, on)| {
        let of = |name: &str| numbers(name).get(d).copied();
        SheetDefect {
            on: on.clone(),
            center_deg: of("defect_center_deg").unwrap_or(f64::NAN),
            length_mm: of("defect_length_mm").unwrap_or(f64::NAN),
            width_mm: of("defect_width_mm").unwrap_or(f64::NAN),
            depth_um: of("defect_depth_um").unwrap_or(f64::NAN),
            frequency_hz: of("defect_frequency_hz"),
        }
    });
    let raceways = [number("bpfo_hz"), number("bpfi_hz"), number("bsf_hz").map(|bsf| 2.0 * bsf)];
    let highest = raceways.into_iter().flatten().fold(0.0, f64::max);
    let mut run = SheetRun {
        run: whole("run"),
        split: words(cells, "split"),
        speed_rpm: number("speed_rpm"),
        load_n: numbers("load_n").to_vec(),
        defects: defects.collect(),
        analysed_from_s: number("analysed_from_s").unwrap_or(0.0),
        rms: f64::NAN,
        kurtosis: f64::NAN,
        dt_s: number("sample_rate_hz").map_or(f64::NAN, |rate| 1.0 / rate),
        df_hz: f64::NAN,
        top_hz: 4.5 * highest,
        ..SheetRun::default()
    };
    if let Cell::Signal(x) = &cells[signal] {
        run.take(x, highest);
    }
    (whole("label").max(0) as usize, run)
}

/// RMS of a signal less its mean, and its kurtosis.
pub(super) fn rms_and_kurtosis(x: &[f64]) -> [f64; 2] {
    let count = x.len() as f64;
    let mean = x.iter().sum::<f64>() / count;
    let square = x.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    let fourth = x.iter().map(|x| (x - mean).powi(4)).sum::<f64>();
    [(square / count).sqrt(), fourth * count / (square * square)]
}

impl SheetRun {
    /// What is shown of the signal; `highest` is the highest defect frequency, Hz.
    fn take(&mut self, signal: &[f32], highest: f64) {
        let x: Vec<f64> = signal.iter().map(|x| f64::from(*x)).collect();
        let rate = 1.0 / self.dt_s;
        let turn = self.speed_rpm.map(|rpm| TURNS * 60.0 / rpm.abs());
        let wanted = turn.filter(|s| s.is_finite()).unwrap_or(STRETCH_S) * rate;
        let from = x.len().saturating_sub(wanted.max(2.0) as usize);
        self.from_s = from as f64 * self.dt_s;
        self.stretch = x[from..].to_vec();
        let start = (self.analysed_from_s * rate).round() as usize;
        let settled = &x[start.min(x.len())..];
        [self.rms, self.kurtosis] = rms_and_kurtosis(settled);
        let band = envelope_band_above(highest, rate);
        self.band_hz = (band.low, band.high);
        if let Ok(found) = envelope_spectrum(settled, rate, band, &Segments::of(settled.len())) {
            self.df_hz = found.spectrum.frequency_step;
            self.envelope = found.spectrum.amplitude;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_runs_are_spread_over_all_that_there_are() {
        let of = |count, each| spread(count, each).collect::<Vec<_>>();
        assert_eq!(of(10, 4), [0, 3, 6, 9]);
        assert_eq!(of(3, 4), [0, 1, 2]);
        assert_eq!(of(5, 1), [0]);
        assert!(of(0, 4).is_empty());
    }
}
