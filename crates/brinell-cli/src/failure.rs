//! What can go wrong, and how it is reported.

use crate::say::complain;
use brinell::document::{Problem, render_diagnostics};
use brinell::model::ModelError;
use brinell_io::IoError;
use std::path::PathBuf;
use std::process::ExitCode;

/// Exit code of bad input.
pub(crate) const BAD_INPUT: u8 = 2;
/// Exit code of an interrupted run: 128 + SIGINT, as shells have it.
pub(crate) const INTERRUPTED: u8 = 130;

/// Why the command did not do what was asked.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The scenario is bad; its text and name are for pointing at lines.
    Scenario { name: String, text: String, problems: Vec<Problem> },
    /// Anything else that the user got wrong.
    Usage(String),
    /// A file cannot be read.
    Read(PathBuf, std::io::Error),
    /// A result cannot be written.
    Write(IoError),
    /// A picture cannot be drawn.
    Picture(brinell_report::Error),
    /// The run failed.
    Run(brinell::Error),
    /// A page cannot be shown; why.
    NotOpened(String),
    /// Standard output does not take what is said; why.
    Output(String),
}

impl Failure {
    /// [`BAD_INPUT`], or 1 for a failed run.
    pub(crate) fn code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Scenario { .. } | Self::Usage(_) | Self::Read(..) => BAD_INPUT,
            Self::Run(error) if error.is_bad_input() => BAD_INPUT,
            // The place is wrong, not the writing.
            Self::Write(
                IoError::NoFolder { .. }
                | IoError::NotAFileName { .. }
                | IoError::Busy { .. }
                | IoError::Journal { .. },
            ) => BAD_INPUT,
            Self::Write(_) | Self::Picture(_) | Self::Run(_) | Self::NotOpened(_) | Self::Output(_) => 1,
        })
    }

    /// In words, without the lines of the file; problems of a scenario one after the other.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Scenario { problems, .. } => {
                let texts: Vec<String> = problems.iter().map(ToString::to_string).collect();
                texts.join("\n")
            }
            Self::Usage(message) | Self::NotOpened(message) => message.clone(),
            Self::Read(path, error) => format!("cannot read {}: {error}", path.display()),
            Self::Write(error) => error.to_string(),
            Self::Picture(error) => error.to_string(),
            Self::Run(error) => error.to_string(),
            Self::Output(why) => format!("cannot write to standard output: {why}"),
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
            Self::Read(..) | Self::Output(_) => complain!("error: {}", self.words()),
            other => complain!("error: {of}{}", other.words()),
        }
    }
}

impl From<brinell::Error> for Failure {
    fn from(error: brinell::Error) -> Self {
        Self::Run(error)
    }
}

impl From<ModelError> for Failure {
    fn from(error: ModelError) -> Self {
        Self::Run(error.into())
    }
}

impl From<IoError> for Failure {
    fn from(error: IoError) -> Self {
        Self::Write(error)
    }
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
    use std::io::ErrorKind;

    /// As the help says: 1 for a result that could not be written, 2 for a place that is none.
    #[test]
    fn regress_a_place_without_permission_is_a_failed_write() {
        let (path, source) = (|| PathBuf::from("out"), || ErrorKind::PermissionDenied.into());
        let code = |error: IoError| format!("{:?}", Failure::from(error).code());
        assert_eq!(code(IoError::NotPermitted { path: path(), source: source() }), format!("{:?}", ExitCode::from(1)));
        assert_eq!(code(IoError::NotAFileName { path: path() }), format!("{:?}", ExitCode::from(BAD_INPUT)));
    }
}
