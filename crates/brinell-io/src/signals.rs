//! What a table of signals is, whatever the file format.

use std::collections::HashSet;
use std::fmt;
use std::path::{Path, PathBuf};

use crate::{Complete, IoError};
use serde_json::Value;

/// Keys of the metadata that a Parquet file carries.
pub mod keys {
    /// The scenario, as TOML with every default filled in. Given by the caller.
    pub const SCENARIO: &str = "brinell.scenario";
    /// The version of brinell that wrote the file. Given by the caller.
    pub const VERSION: &str = "brinell.version";
    /// The commit that this version was built from, where that is known. Given by the caller.
    pub const COMMIT: &str = "brinell.commit";
    /// The sample rate in hertz. Given by the caller.
    pub const SAMPLE_RATE_HZ: &str = "brinell.sample_rate_hz";
    /// The unit of each column, a JSON object. Filled in by the writer.
    pub const UNITS: &str = "brinell.units";
    /// The description of each column, a JSON object. Filled in by the writer.
    pub const DESCRIPTIONS: &str = "brinell.descriptions";
    /// `complete`, or `partial: ` and why. Filled in by the writer.
    pub const OUTCOME: &str = "brinell.outcome";
    /// The units once more, where pandas looks: `pandas.read_parquet(path).attrs["units"]`. Filled in by the writer.
    pub const PANDAS_ATTRS: &str = "PANDAS_ATTRS";

    /// Name and unit of each channel in a WAV file's comment, a JSON object. Filled in by the writer.
    pub const CHANNELS: &str = "brinell.channels";
    /// The text variable of MAT and NPZ files with the unit of each channel, a JSON object. Filled in by the writer.
    pub const UNITS_VARIABLE: &str = "brinell_units";

    #[cfg(feature = "parquet")]
    pub(crate) const RESERVED: [&str; 4] = [UNITS, DESCRIPTIONS, OUTCOME, PANDAS_ATTRS];
}

/// One signal of a table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// The channel's name, the same in every format.
    pub name: String,
    /// The SI unit, such as `m/s^2`; `1` where there is none; empty where a file does not tell.
    pub unit: String,
    /// What the channel is, in a few words.
    pub description: String,
}

impl Column {
    /// A column of this name, unit and description.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, description: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), description: description.into() }
    }
}

/// Facts about a whole table, in order. The keys that brinell uses are in [`keys`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    /// Key and value.
    pub pairs: Vec<(String, String)>,
}

impl Metadata {
    /// Of the program that writes the file: its version and, where known, its commit.
    pub fn made_by(version: &str, commit: Option<&str>) -> Self {
        let made = Self::default().with(keys::VERSION, version);
        match commit {
            Some(commit) => made.with(keys::COMMIT, commit),
            None => made,
        }
    }

    /// The same with one more pair.
    #[must_use]
    pub fn with(mut self, key: impl Into<String>, value: impl Into<String>) -> Self {
        self.pairs.push((key.into(), value.into()));
        self
    }

    /// The same with the sample rate in hertz.
    #[must_use]
    pub fn with_rate(self, hz: f64) -> Self {
        self.with(keys::SAMPLE_RATE_HZ, hz.to_string())
    }

    /// The sample rate in hertz, where one is given.
    pub(crate) fn sample_rate(&self) -> Option<f64> {
        let hz = self.get(keys::SAMPLE_RATE_HZ)?.trim().parse().ok()?;
        Some(hz).filter(|hz: &f64| hz.is_finite() && *hz > 0.0)
    }

    /// The sample rate in hertz, or what a file that cannot do without says.
    pub(crate) fn needed_sample_rate(&self) -> Result<f64, String> {
        self.sample_rate().ok_or_else(|| format!("it needs a sample rate, `{}`", keys::SAMPLE_RATE_HZ))
    }

    /// The scenario of the run that made the file, where it carries one.
    pub fn scenario(&self) -> Option<&str> {
        // MAT and UFF write the key's dot otherwise.
        let of = |(key, _): &&(String, String)| key.starts_with("brinell") && key.ends_with("scenario");
        self.pairs.iter().find(of).map(|(_, text)| text.as_str())
    }

    /// The value of a key: the first, should a file repeat it.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.pairs.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_str())
    }
}

/// The columns of a run's file of signals, time and its channels (name, unit, description), and what the file says of itself.
pub fn run_table<'a>(
    (scenario_toml, made_by, rate_hz): (String, Metadata, f64),
    channels: impl Iterator<Item = (&'a str, &'a str, &'a str)>,
) -> (Vec<Column>, Metadata) {
    let all = std::iter::once(("t", "s", "time")).chain(channels);
    let metadata = made_by.with(keys::SCENARIO, scenario_toml).with_rate(rate_hz);
    (all.map(|(name, unit, about)| Column::new(name, unit, about)).collect(), metadata)
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Every row that was requested is there.
    Complete,
    /// The run stopped early; the rows up to then are there. Holds the reason.
    Partial(String),
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Complete => f.write_str("complete"),
            Self::Partial(reason) => write!(f, "partial: {reason}"),
        }
    }
}

/// Takes a table row by row and makes one file of it.
///
/// After an error of the disk the writer takes no more rows and cannot be finished; dropping it leaves no file.
pub trait SignalWriter: Send {
    /// Appends one row: a value per column, in the order of the columns.
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError>;

    /// Completes the file, up to its name.
    fn complete(self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError>;

    /// Completes the file, gives it its name and returns its path.
    fn finish(self: Box<Self>, outcome: Outcome) -> Result<PathBuf, IoError> {
        self.complete(outcome)?.publish()
    }
}

/// Refuses names that some reader would take apart or take for data.
pub(crate) fn check_columns(path: &Path, columns: &[Column]) -> Result<(), IoError> {
    if columns.is_empty() {
        return Err(IoError::NoColumns { path: path.to_owned() });
    }
    let mut seen = HashSet::new();
    for Column { name, .. } in columns {
        let why = if name.is_empty() {
            "it is empty"
        } else if name.contains([',', '"']) || name.contains(char::is_control) {
            "it holds a comma, a quote or a control character"
        } else if name.trim() != name {
            "it starts or ends with a space"
        } else if name.parse::<f64>().is_ok() {
            "it reads as a number"
        } else if !seen.insert(name) {
            "another column has it"
        } else {
            continue;
        };
        return Err(IoError::ColumnName { path: path.to_owned(), name: name.clone(), why });
    }
    Ok(())
}

/// A text of each column as a JSON object.
pub(crate) fn by_column(columns: &[Column], of: fn(&Column) -> &str) -> Value {
    columns.iter().map(|c| (c.name.as_str(), of(c))).collect()
}

/// The unit of each column as a JSON object.
pub(crate) fn units_json(columns: &[Column]) -> String {
    by_column(columns, |c| &c.unit).to_string()
}

/// Where the columns to be written are: not `t`, in files that hold a start and a rate instead.
pub(crate) fn without_time(columns: &[Column]) -> Vec<usize> {
    let is_time = |c: &Column| c.name == "t" && c.unit == "s";
    (0..columns.len()).filter(|&i| !is_time(&columns[i])).collect()
}
