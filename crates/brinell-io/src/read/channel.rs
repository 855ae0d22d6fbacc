//! What a file says of its channels.

use super::numbers::Number;
use crate::Metadata;
use serde_json::Value;
use std::collections::{HashMap, HashSet};

/// A sample rate that a file states.
#[derive(Clone, Debug, PartialEq)]
pub struct Rate {
    /// Samples per second.
    pub hz: f64,
    /// Where the file says so.
    pub source: RateSource,
}

/// Where a sample rate comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RateSource {
    /// The format has a field for it; holds the field's name.
    Header(String),
    /// A variable beside the channel is called like a sample rate; holds its name. The format gives that name no
    /// meaning, so a caller should show it.
    Variable(String),
}

/// One array of numbers in a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Channel {
    /// The name that [`crate::SignalFile::read`] takes: a column of a table, a path such as `bearing.gs` or
    /// `Y[2].Data`. Indices count from 1, as in MATLAB.
    pub name: String,
    /// What the file calls it besides: the text `Y[2].Name` that lies beside `Y[2].Data`. [`crate::SignalFile::read`]
    /// takes it too, where it is one channel's only.
    pub label: Option<String>,
    /// The size along each dimension, rows first. Empty for a single number, and for a text file, whose length nobody
    /// knows before it is read.
    pub shape: Vec<u64>,
    /// The number of values; `None` for a text file.
    pub length: Option<u64>,
    /// How the file stores a value, in NumPy's words: `float64`, `int16`, `text`.
    pub stored_as: &'static str,
    /// The unit, as the file spells it. Never a guess.
    pub unit: Option<String>,
    /// The sample rate. Never a guess.
    pub rate: Option<Rate>,
    /// Why this channel cannot be read, where that is so: complex numbers, a column of words.
    pub unreadable: Option<String>,
    /// Whether the first index runs fastest in the file.
    pub(crate) column_major: bool,
}

impl Channel {
    /// A readable array.
    pub(crate) fn array(name: impl Into<String>, shape: Vec<u64>, stored: Number) -> Self {
        Self {
            name: name.into(),
            length: Some(shape.iter().copied().fold(1, u64::saturating_mul)),
            shape,
            stored_as: stored.name(),
            ..Self::default()
        }
    }

    /// The dimensions longer than 1, or all where there are no more than two.
    pub(crate) fn plane(&self) -> Vec<u64> {
        if self.shape.len() <= 2 {
            self.shape.clone()
        } else {
            self.shape.iter().copied().filter(|&n| n != 1).collect()
        }
    }

    /// Whether the values lie along one dimension, so that their order is the order in time.
    pub fn is_vector(&self) -> bool {
        self.shape.contains(&0) || self.shape.iter().filter(|&&n| n != 1).count() <= 1
    }

    /// Whether it has rows and columns, and more than one of each.
    pub fn is_matrix(&self) -> bool {
        self.shape.len() == 2 && self.shape.iter().all(|n| *n > 1)
    }

    /// Its name, with its label where it has one, for a message.
    pub fn with_label(&self) -> String {
        match &self.label {
            Some(label) => format!("{} ({label})", self.name),
            None => self.name.clone(),
        }
    }

    /// Its name as the file has it, without the number that [tells it apart](tell_apart).
    pub(crate) fn own_name(&self) -> &str {
        match self.name.rsplit_once('#') {
            Some((name, number)) if number.parse::<usize>().is_ok() => name,
            _ => &self.name,
        }
    }

    /// Whether this may be a signal: readable, and more than one value.
    pub fn may_be_signal(&self) -> bool {
        self.unreadable.is_none() && self.length.is_none_or(|n| n > 1)
    }
}

/// Names that people give to a variable with the sample rate in hertz, in lower case.
const RATE_NAMES: [&str; 11] = [
    "fs",
    "sr",
    "fs_hz",
    "fsamp",
    "samplerate",
    "sample_rate",
    "sample_rate_hz",
    "sampling_rate",
    "samplingrate",
    "sampling_frequency",
    "samplingfrequency",
];

/// Whether the last part of a path is a usual name of a sample rate.
pub(crate) fn names_a_rate(path: &str) -> bool {
    let last = path.rsplit(['.', '/']).next().unwrap_or(path);
    RATE_NAMES.contains(&last.to_ascii_lowercase().as_str())
}

/// Gives every signal the rate that lies beside it, where exactly one does. `rates` holds paths and values.
pub(crate) fn lend_rates(channels: &mut [Channel], rates: &[(String, f64)]) {
    let folder = |path: &str| path.rfind(['.', '/']).map_or(0, |at| at + 1);
    for channel in channels {
        if channel.rate.is_some() || !channel.may_be_signal() {
            continue;
        }
        let mine = &channel.name[..folder(&channel.name)];
        let mut beside = rates.iter().filter(|(path, hz)| &path[..folder(path)] == mine && hz.is_finite() && *hz > 0.0);
        if let (Some((path, hz)), None) = (beside.next(), beside.next()) {
            channel.rate = Some(Rate { hz: *hz, source: RateSource::Variable(path.clone()) });
        }
    }
}

/// Gives the channels the units that brinell writes beside them, a JSON object under `key`.
pub(crate) fn lend_units(channels: &mut [Channel], metadata: &Metadata, key: &str) {
    let units: Option<Value> = metadata.get(key).and_then(|text| serde_json::from_str(text).ok());
    for channel in channels {
        let unit = units.as_ref().and_then(|units| units.get(&channel.name)?.as_str());
        channel.unit = unit.filter(|unit| !unit.is_empty()).map(str::to_owned);
    }
}

/// Gives every signal what lies beside it as texts called `Name` and `Unit`, where it is the only signal there. `texts`
/// holds paths and texts.
pub(crate) fn lend_labels(channels: &mut [Channel], texts: &[(String, String)]) {
    let called = |names: &[&str]| -> HashMap<&str, &str> {
        let named = texts.iter().filter_map(|(path, text)| {
            let (folder, last) = path.rsplit_once('.')?;
            let is_called = names.iter().any(|name| last.eq_ignore_ascii_case(name));
            (is_called && !text.trim().is_empty()).then_some((folder, text.trim()))
        });
        named.collect()
    };
    let (labels, units) = (called(&["name"]), called(&["unit", "units"]));
    let folder = |c: &Channel| c.name.rsplit_once('.').map(|(folder, _)| folder.to_owned());
    let mut signals = HashMap::<String, usize>::new();
    for channel in channels.iter().filter(|c| c.may_be_signal()) {
        *signals.entry(folder(channel).unwrap_or_default()).or_default() += 1;
    }
    for channel in channels.iter_mut().filter(|c| c.may_be_signal()) {
        if let Some(folder) = folder(channel)
            && signals.get(&folder) == Some(&1)
        {
            channel.label = labels.get(folder.as_str()).map(|&l| l.to_owned());
            channel.unit = channel.unit.take().or_else(|| units.get(folder.as_str()).map(|&u| u.to_owned()));
        }
    }
}

/// 1/0.0001 is 10000 but for the last digit.
pub(crate) fn hertz(step_s: f64) -> f64 {
    let hz = 1.0 / step_s;
    let round = hz.round();
    if (hz / round - 1.0).abs() < 1e-12 { round } else { hz }
}

/// Makes names unique: the second `a` becomes `a#2`, or the next number that no channel of the file has.
pub(crate) fn tell_apart(channels: &mut [Channel]) {
    let mut taken: HashSet<String> = channels.iter().map(|c| c.name.clone()).collect();
    // Of each name the number that its last channel got.
    let mut seen = HashMap::<String, usize>::new();
    for channel in channels {
        let Some(count) = seen.get_mut(&channel.name) else {
            seen.insert(channel.name.clone(), 1);
            continue;
        };
        channel.name = loop {
            *count += 1;
            let name = format!("{}#{count}", channel.name);
            if taken.insert(name.clone()) {
                break name;
            }
        };
    }
}
