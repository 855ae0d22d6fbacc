//! A plan's file or its base's, as it was read, and what is wrong with it.

use crate::dataset::error::DatasetError;
use crate::design::{FileKind, kind_of};
use brinell::document::{Problem, locate};
use brinell_io::read_text;
use std::fs::File;
use std::path::{Path, PathBuf};

/// A file that was read.
pub(crate) struct Document {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

impl Document {
    pub(crate) fn open(path: &Path) -> Result<Self, DatasetError> {
        let bytes = File::open(path).and_then(read_text);
        let bytes = bytes.map_err(|error| DatasetError::Read { path: path.to_owned(), error })?;
        let text = String::from_utf8(bytes).map_err(|_| {
            DatasetError::Refused(format!("{}: not a text file in UTF-8, as TOML must be", path.display()))
        })?;
        Ok(Self { path: path.to_owned(), text })
    }

    /// What is wrong with a value of its own.
    pub(crate) fn problem_of(&self, key: &str, value: &str, why: &str) -> DatasetError {
        let problem = Problem::of_file(key, value, why);
        self.problems(vec![problem.at(locate(&self.text, key))])
    }

    /// That the file is a scenario, where it is one.
    pub(crate) fn scenario_in_place(&self) -> Option<DatasetError> {
        (kind_of(&self.text) == Some(FileKind::Scenario)).then(|| {
            DatasetError::Refused(format!(
                "{} is a scenario and no plan of a data set: a plan names its scenario (`base`), how many `runs` and what is drawn for each; `brinell init plan.toml --template data-set` writes one",
                self.path.display()
            ))
        })
    }

    pub(crate) fn problems(&self, problems: Vec<Problem>) -> DatasetError {
        DatasetError::Document { name: self.path.display().to_string(), text: self.text.clone(), problems }
    }
}
