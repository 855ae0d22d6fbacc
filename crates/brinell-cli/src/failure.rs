//! What can go wrong, and how it is reported.

use crate::say::complain;
use brinell::document::{Problem, on_one_line, one_line, render_diagnostics};
use brinell::model::ModelError;
use brinell_io::{IoError, why_unread};
use std::path::PathBuf;

/// What the command ends with: the number is for the process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ExitCode(pub(crate) u8);

impl ExitCode {
    pub(crate) const SUCCESS: Self = Self(0);
    /// The run failed, or a result could not be written.
    pub(crate) const FAILURE: Self = Self(1);
    pub(crate) const BAD_INPUT: Self = Self(2);
    /// 128 + SIGINT, as shells have it.
    pub(crate) const INTERRUPTED: Self = Self(130);
}

impl From<brinell_measured::Problem> for Failure {
    fn from(problem: brinell_measured::Problem) -> Self {
        Self::Usage(problem.to_string())
    }
}

/// Why the command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The scenario is bad; its text and name are for pointing at lines. In words, without these lines: the problems
    /// one after the other.
    #[error("{}", in_lines(.problems))]
    Scenario { name: String, text: String, problems: Vec<Problem> },
    /// Anything else that the user got wrong.
    #[error("{0}")]
    Usage(String),
    /// A file cannot be read.
    #[error("cannot read {}: {why}", .0.display(), why = why_unread(.1))]
    Read(PathBuf, std::io::Error),
    /// A result cannot be written.
    #[error(transparent)]
    Write(#[from] IoError),
    /// A picture cannot be drawn.
    #[error(transparent)]
    Picture(#[from] brinell_report::Error),
    /// The run failed.
    #[error(transparent)]
    Run(#[from] brinell::Error),
    /// A page cannot be shown; why.
    #[error("{0}")]
    NotOpened(String),
    /// The protocol of `brinell mcp` could not begin or go on; why.
    #[error("cannot serve: {0}")]
    NotServed(String),
    /// Standard output does not take what is said; why.
    #[error("cannot write to standard output: {0}")]
    Output(String),
}

impl Failure {
    /// Of bad input, or of a failed run.
    pub(crate) fn code(&self) -> ExitCode {
        match self {
            Self::Scenario { .. } | Self::Usage(_) | Self::Read(..) => ExitCode::BAD_INPUT,
            Self::Run(error) if error.is_bad_input() => ExitCode::BAD_INPUT,
            // The place is wrong, not the writing.
            Self::Write(
                IoError::NoFolder { .. }
                | IoError::NotAFileName { .. }
                | IoError::Busy { .. }
                | IoError::Journal { .. },
            ) => ExitCode::BAD_INPUT,
            Self::Write(_)
            | Self::Picture(_)
            | Self::Run(_)
            | Self::NotOpened(_)
            | Self::NotServed(_)
            | Self::Output(_) => ExitCode::FAILURE,
        }
    }

    /// On one line, as tables and reasons have it.
    pub(crate) fn on_one_line(&self) -> String {
        match self {
            Self::Scenario { problems, .. } => on_one_line(problems),
            other => one_line(&other.to_string()),
        }
    }

    /// To standard error.
    pub(crate) fn print(&self) {
        self.print_of("");
    }

    /// To standard error, with the scenario `of` in front where the message does not name it itself.
    pub(crate) fn print_of(&self, of: &str) {
        let of = if of.is_empty() { String::new() } else { format!("{of}: ") };
        match self {
            Self::Scenario { name, text, problems } => print_problems(name, text, problems),
            Self::Read(..) | Self::Output(_) => complain!("error: {self}"),
            other => complain!("error: {of}{other}"),
        }
    }
}

impl From<ModelError> for Failure {
    fn from(error: ModelError) -> Self {
        Self::Run(error.into())
    }
}

fn in_lines(problems: &[Problem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Each problem with the line that it is about.
pub(crate) fn print_problems(name: &str, text: &str, problems: &[Problem]) {
    if !problems.is_empty() {
        complain!("{}", render_diagnostics(name, text, problems));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As the help says: 1 for a result that could not be written, 2 for a place that is none.
    #[test]
    fn regress_a_place_without_permission_is_a_failed_write() {
        let (path, source) = (|| PathBuf::from("out"), || std::io::ErrorKind::PermissionDenied.into());
        let code = |error: IoError| Failure::from(error).code();
        assert_eq!(code(IoError::NotPermitted { path: path(), source: source() }), ExitCode::FAILURE);
        assert_eq!(code(IoError::NotAFileName { path: path() }), ExitCode::BAD_INPUT);
    }
}
