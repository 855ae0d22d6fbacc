//! Which signal, and which stretch of a run's record, a root mean square is taken from.

use serde::Deserialize;

/// The stretch of a record.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Record {
    /// From a turn after the load ramp on: the program's own statistics, with intervals.
    #[default]
    Steady,
    /// From t = 0 on, over so many ms. There is one start-up in a record, so its statistics have no interval.
    FromStart(u32),
}

/// Lengths of the records from t = 0 whose statistics are kept, ms.
pub(crate) const WINDOWS_MS: &[u32] = &[100, 200, 285, 300, 500, 800];

/// How RMS and peak to peak are read off a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Reading {
    /// Whether the outer ring's accelerations are those behind the anti-alias filter.
    pub filtered: bool,
    /// The stretch.
    pub record: Record,
}

impl Reading {
    /// The program's own: instantaneous accelerations, the steady part.
    pub(crate) const USUAL: Self = Self { filtered: false, record: Record::Steady };

    /// The same record behind the filter.
    #[must_use]
    pub(crate) const fn behind_filter(self) -> Self {
        Self { filtered: true, ..self }
    }

    /// The same signal from t = 0 over `ms` milliseconds.
    #[must_use]
    pub(crate) const fn over_start(self, ms: u32) -> Self {
        Self { record: Record::FromStart(ms), ..self }
    }
}

impl Record {
    /// As tables say it.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Steady => "steady part".into(),
            Self::FromStart(ms) => format!("0 to {} s", f64::from(ms) / 1e3),
        }
    }
}

/// Name of an indicator (`rms`, `peak_to_peak`) of a channel over a record from t = 0: `outer_ax.first_285ms.rms`.
pub(crate) fn from_start_name(channel: &str, ms: u32, indicator: &str) -> String {
    format!("{channel}.first_{ms}ms.{indicator}")
}
