//! Why there is no result: one error above those of the modules.

use crate::document::{Problem, Severity};
use crate::model::ModelError;
use crate::signal::rounded;
use crate::statics::NoBalance;

/// Why a run ended before its time, or never began.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// The text, or what was built in code, is no valid scenario: every problem, errors first, each with key, value, allowed range,
    /// unit, and line of a text.
    #[error("{}", lines(.0))]
    Scenario(Vec<Problem>),
    /// The scenario makes no model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// There is no equilibrium to start from.
    #[error("start = \"equilibrium\": {0}")]
    NoBalance(#[from] NoBalance),
    /// The recorded channels do not fit in memory.
    #[error(
        "the recorded channels take {:.1} GB; record fewer (simulation.record), or run shorter",
        *.bytes as f64 * 1e-9
    )]
    TooLarge {
        /// What they take, bytes.
        bytes: u128,
    },
    /// The state stopped being finite.
    #[error("the state stopped being finite at t = {t:.9} s: {body}; {contact}")]
    NonFinite {
        /// Time of the last good state, s.
        t: f64,
        /// Body and coordinate.
        body: String,
        /// The contact that went first or is pressed hardest.
        contact: String,
    },
    /// No step is short enough for the tolerance.
    #[error("no step is short enough at t = {t:.9} s: {body} changes too fast for the tolerance; {contact}")]
    StepVanished {
        /// Time of the last good state, s.
        t: f64,
        /// Body and coordinate.
        body: String,
        /// The contact that is pressed hardest.
        contact: String,
    },
    /// The run would take more steps than `simulation.most_steps` allows.
    #[error(
        "simulation.most_steps = {most:e}: the run would take about {:e} steps of {} us, set by {held}; run shorter, soften what makes steps so short, \
         or allow as many",
        round_up(*.steps),
        rounded(1e6 * *.step, 2)
    )]
    TooLong {
        /// What it would take.
        steps: f64,
        /// What it may take.
        most: f64,
        /// Mean step so far seen, s.
        step: f64,
        /// What sets their length, in words.
        held: String,
    },
    /// The observer stopped the run.
    #[error("stopped before its end")]
    Stopped,
}

impl Error {
    /// Whether the scenario is at fault, and not the run: the command then exits with code 2, and with 1 after a failed
    /// run.
    ///
    /// ```
    /// let error = brinell::Scenario::from_toml("[bearing]\npreset = \"NN3007\"").unwrap_err();
    /// assert!(error.is_bad_input());
    /// assert!(error.to_string().contains("operation.speed_rpm"));
    /// ```
    pub fn is_bad_input(&self) -> bool {
        matches!(
            self,
            Self::Scenario(_) | Self::Model(_) | Self::NoBalance(_) | Self::TooLarge { .. } | Self::TooLong { .. }
        )
    }
}

/// Refuses the errors among problems.
pub(crate) fn refuse(mut problems: Vec<Problem>) -> Result<(), Error> {
    problems.retain(|problem| problem.severity == Severity::Error);
    if problems.is_empty() { Ok(()) } else { Err(Error::Scenario(problems)) }
}

impl From<Vec<Problem>> for Error {
    fn from(problems: Vec<Problem>) -> Self {
        Self::Scenario(problems)
    }
}

/// To one digit, up.
fn round_up(x: f64) -> f64 {
    let unit = 10_f64.powf(x.log10().floor());
    rounded((x / unit).ceil() * unit, 2)
}

fn lines(problems: &[Problem]) -> String {
    let lines: Vec<String> = problems.iter().map(ToString::to_string).collect();
    lines.join("\n")
}
