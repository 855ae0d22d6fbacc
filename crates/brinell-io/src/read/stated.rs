//! What a file states beside its signals: a shaft's speed, and the sample rate once more.

use super::SignalFile;
use super::channel::{Channel, RateSource};
use super::times::{Clock, NoRate};
use crate::IoError;
use std::fmt;
use std::ops::ControlFlow;

/// Two rates may differ by so much, relative, before it is worth a word.
pub(super) const DIFFERS: f64 = 1e-4;

impl fmt::Display for RateSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RateSource::Header(field) => write!(f, "the file's header ({field})"),
            RateSource::Variable(name) => write!(f, "the variable `{name}` in the file"),
        }
    }
}

impl NoRate {
    /// In words, with steps as `digits` writes them.
    pub fn words(&self, digits: impl Fn(f64) -> String) -> String {
        match *self {
            NoRate::TooFew => "it has fewer than three values".into(),
            NoRate::NotIncreasing => "its values do not increase".into(),
            NoRate::Missing { after } => format!("its value {} is missing or infinite", after + 1),
            NoRate::Uneven { step, after, usual } => {
                let (step, usual) = (digits(step), digits(usual));
                format!("its steps are uneven ({step} after {after} values, where {usual} is usual)")
            }
        }
    }
}

impl Channel {
    /// The rate that the file states of it, Hz, and where.
    pub fn stated_rate(&self) -> Option<(f64, String)> {
        self.rate.as_ref().map(|rate| (rate.hz, rate.source.to_string()))
    }
}

impl SignalFile {
    /// The rate, Hz, that a column of times in units of `seconds` gives.
    ///
    /// # Errors
    /// Where it cannot be read; within, where its times are not even.
    pub fn rate_of(&mut self, times: &str, seconds: f64) -> Result<Result<f64, NoRate>, IoError> {
        let mut clock = Clock::new();
        match self.read_pieces(times, |piece| clock.take(piece)) {
            // Times up to the end of a table have its rate, whatever follows.
            Err(error) if error.is_of_a_row() => {
                clock = Clock::new();
                self.read_around(times, |piece| {
                    let end = piece.iter().position(|t| !t.is_finite());
                    let more = clock.take(&piece[..end.unwrap_or(piece.len())]);
                    if end.is_some() { ControlFlow::Break(()) } else { more }
                })?;
            }
            read => read?,
        }
        Ok(clock.rate(seconds))
    }

    /// What a channel's column of times whose unit the file states says of the rate: hertz, or what is wrong with the
    /// times; and the column's name.
    fn rate_by_times(&mut self, of: &Channel) -> Option<(Result<f64, NoRate>, String)> {
        let times = self.times_of(of).ok()??;
        let (unit, name) = (times.seconds_in_time_unit()?, times.name);
        Some((self.rate_of(&name, unit).ok()?, name))
    }

    /// A warning, where the rate that was given for a channel, Hz, differs from what the file states. `asked` is what was
    /// given in words, without the unit; steps of times are written by `digits`.
    pub fn other_rate(&mut self, of: &Channel, asked: &str, hz: f64, digits: impl Fn(f64) -> String) -> Option<String> {
        let (other, place) = match of.stated_rate() {
            Some(stated) => stated,
            None => match self.rate_by_times(of)? {
                (Ok(other), name) => (other, format!("the column `{name}`")),
                (Err(why), name) => {
                    let why = why.words(digits);
                    return Some(format!("{asked} Hz was taken, but the times in `{name}` give no rate: {why}"));
                }
            },
        };
        ((other / hz - 1.0).abs() > DIFFERS).then(|| format!("{asked} Hz was taken, but {place} says {other} Hz"))
    }

    /// The single number that is called like the speed of the shaft of a signal, as `X097RPM` beside `X097_DE_time`.
    /// The format gives that name no meaning, so a caller should show it.
    pub fn speed_variable(&self, signal: &str) -> Option<String> {
        let prefix: String = signal.chars().take_while(char::is_ascii_alphanumeric).collect();
        let single = |c: &&Channel| c.length == Some(1) && c.unreadable.is_none();
        let named: Vec<&str> = (self.channels().iter().filter(single).map(|c| c.name.as_str()))
            .filter(|n| n.to_lowercase().trim_end_matches("_").ends_with("rpm"))
            .collect();
        let mine: Vec<&str> = (named.iter().copied()).filter(|n| n.starts_with(&prefix)).collect();
        match (&mine[..], &named[..]) {
            ([only], _) | (_, [only]) => Some((*only).to_owned()),
            _ => None,
        }
    }

    /// Its value, taken as r/min, and where that comes from, in words; `None` where it is no number.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn stated_rpm(&mut self, signal: &str) -> Result<Option<(f64, String)>, IoError> {
        let Some(name) = self.speed_variable(signal) else {
            return Ok(None);
        };
        let mut first = None;
        self.read_pieces(&name, |piece| {
            first = piece.first().copied();
            ControlFlow::Break(())
        })?;
        let rpm = first.filter(|v| v.is_finite());
        Ok(rpm.map(|rpm| (rpm, format!("{}, taken as r/min", RateSource::Variable(name)))))
    }
}
