//! A plan with its base scenario: everything that the runs are made from.

use crate::columns::{DataColumn, columns};
use crate::error::DatasetError;
use brinell::campaign::{digest, fingerprint};
use brinell::design::{Draw, Draws, Plan, Survey, place_in_plan};
use brinell::document::{Loaded, Problem, canonical, locate};
use brinell::many;
use brinell::simulate::Simulation;
use brinell_io::Column;
use std::collections::HashSet;
use std::io::Read;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Largest plan or scenario read, bytes: nobody writes longer ones, and a device file never ends.
const LARGEST: u64 = 64 << 20;
/// Runs that are looked at before any runs; of longer plans every second, third, ... one.
const SURVEYED: usize = 100_000;
/// Where the bearing varies, first runs that are asked which channels there are.
const ASKED: usize = 64;

/// A plan that can be run.
pub struct Campaign {
    sources: Sources,
    identity: String,
    signals: Vec<Column>,
    columns: Vec<DataColumn>,
    first: Loaded,
}

/// Where runs come from.
struct Sources {
    draws: Draws,
    plan: Document,
    base: Document,
}

/// A file that was read.
struct Document {
    path: PathBuf,
    text: String,
}

impl Document {
    fn open(path: &Path) -> Result<Self, DatasetError> {
        let failed = |error| DatasetError::Read {
            path: path.to_owned(),
            error,
        };
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(failed)?;
        file.take(LARGEST + 1)
            .read_to_end(&mut bytes)
            .map_err(failed)?;
        if bytes.len() as u64 > LARGEST {
            return Err(DatasetError::Refused(format!(
                "{}: larger than {} MiB; a plan or a scenario is a text file of a few kilobytes",
                path.display(),
                LARGEST >> 20
            )));
        }
        let text = String::from_utf8(bytes).map_err(|_| {
            DatasetError::Refused(format!(
                "{}: not a text file in UTF-8, as TOML must be",
                path.display()
            ))
        })?;
        Ok(Self {
            path: path.to_owned(),
            text,
        })
    }

    fn problems(&self, problems: Vec<Problem>) -> DatasetError {
        DatasetError::Document {
            name: self.path.display().to_string(),
            text: self.text.clone(),
            problems,
        }
    }
}

impl Campaign {
    /// Reads a plan file and the scenario that it names, and draws the first runs.
    ///
    /// # Errors
    /// Where a file cannot be read, the plan is bad or impossible, or no first run can be made.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, DatasetError> {
        let plan = Document::open(path.as_ref())?;
        let read = Plan::read(&plan.text).map_err(|problems| plan.problems(problems))?;
        let folder = plan.path.parent().unwrap_or(Path::new(""));
        let base = Document::open(&folder.join(&read.base))?;
        let draws = Draws::new(read).map_err(|problems| {
            let placed = problems
                .into_iter()
                .map(|problem| draws_problem(problem, &plan.text));
            plan.problems(placed.collect())
        })?;
        let mut meaning = Vec::new();
        for document in [&plan, &base] {
            meaning
                .push(canonical(&document.text).map_err(|problems| document.problems(problems))?);
        }
        Sources { draws, plan, base }.settle(meaning)
    }

    /// The runs.
    pub fn draws(&self) -> &Draws {
        &self.sources.draws
    }

    /// The plan.
    pub fn plan(&self) -> &Plan {
        self.sources.draws.plan()
    }

    /// Name and text of the plan file.
    pub fn plan_file(&self) -> (&Path, &str) {
        (&self.sources.plan.path, &self.sources.plan.text)
    }

    /// Name and text of the base scenario's file.
    pub fn base_file(&self) -> (&Path, &str) {
        (&self.sources.base.path, &self.sources.base.text)
    }

    /// What tells this campaign from others, however its files are written: SHA-256 in hexadecimal.
    pub fn identity(&self) -> &str {
        &self.identity
    }

    /// The signals of every run.
    pub fn signals(&self) -> &[Column] {
        &self.signals
    }

    /// The columns of the files.
    pub fn columns(&self) -> &[DataColumn] {
        &self.columns
    }

    /// The first run that makes a scenario.
    pub(crate) fn first(&self) -> &Loaded {
        &self.first
    }

    /// Files of the data set.
    pub fn parts(&self) -> usize {
        self.draws().runs().div_ceil(self.plan().runs_per_file)
    }

    /// Runs of a file, by index.
    pub fn runs_of(&self, part: usize) -> std::ops::Range<usize> {
        let each = self.plan().runs_per_file;
        part * each..((part + 1) * each).min(self.draws().runs())
    }

    /// Looks at what the runs draw: all of them, or of more than 100000 every second, third, ... one.
    pub fn survey(&self) -> Survey {
        let draws = self.draws();
        let step = NonZeroUsize::new(draws.runs().div_ceil(SURVEYED)).unwrap_or(NonZeroUsize::MIN);
        let threads = many::threads(usize::MAX);
        Survey::of(draws, &self.sources.base.text, step, threads)
    }

    /// A run's scenario with its files of damage read, and what it drew.
    ///
    /// # Errors
    /// Where its values make no scenario.
    pub fn scenario(&self, run: usize) -> Result<(Loaded, Draw), DatasetError> {
        self.sources.scenario(run)
    }

    pub(crate) fn try_scenario(
        &self,
        run: usize,
    ) -> Result<(Loaded, Draw), (Vec<Problem>, Option<Draw>)> {
        self.sources.try_scenario(run)
    }
}

impl Sources {
    /// What follows from first runs: the signals, the columns, and what tells this campaign from others.
    fn settle(self, mut meaning: Vec<String>) -> Result<Campaign, DatasetError> {
        let draws = &self.draws;
        let varies = |p: &brinell::design::Parameter| p.key.starts_with("bearing.");
        let asked = match draws.parameters().iter().any(varies) {
            true => ASKED.min(draws.runs()),
            false => 1,
        };
        // The first run of each class as well: its files of damage are part of what the campaign is.
        let mut runs: Vec<usize> = (0..asked).collect();
        for class in 0..draws.plan().classes.len() {
            let first = (0..draws.runs()).find(|run| draws.class(*run) == class);
            runs.extend(first.filter(|run| *run >= asked));
        }
        let (mut first, mut failure, mut signals) = (None, None, Vec::new());
        let (mut known, mut seen) = (HashSet::new(), HashSet::new());
        for run in runs {
            let loaded = match self.scenario(run) {
                Ok((loaded, _)) => loaded,
                Err(error) => {
                    failure.get_or_insert(error);
                    continue;
                }
            };
            if seen.insert(draws.class(run)) {
                meaning.push(fingerprint(&loaded.scenario));
            }
            if let Ok(simulation) = Simulation::new(&loaded.scenario) {
                for channel in simulation.channels() {
                    if known.insert(channel.name.clone()) {
                        signals.push(Column::new(
                            &channel.name,
                            channel.unit,
                            &channel.description,
                        ));
                    }
                }
            }
            first.get_or_insert(loaded);
        }
        let first = match (first, failure) {
            (Some(first), _) if !signals.is_empty() => first,
            (None, Some(failure)) => return Err(failure),
            _ => {
                return Err(DatasetError::Refused(format!(
                    "signals = {:?}: no channel of the first runs has such a name\n  allowed: channels as in `simulation.record`, \
                     such as \"measured_ax\"",
                    draws.plan().signals
                )));
            }
        };
        Ok(Campaign {
            columns: columns(draws, &signals),
            identity: digest(&meaning.join("\n")),
            signals,
            first,
            sources: self,
        })
    }

    fn scenario(&self, run: usize) -> Result<(Loaded, Draw), DatasetError> {
        let made = self.try_scenario(run);
        made.map_err(|(problems, _)| self.problems(run, problems))
    }

    /// Problems of a run, said of the plan where that sets what is wrong, and of the base elsewhere.
    fn problems(&self, run: usize, problems: Vec<Problem>) -> DatasetError {
        let plan = &self.plan;
        let place = |p: &Problem| place_in_plan(&self.draws, &plan.text, run, p);
        let is_placed = problems
            .iter()
            .any(|p| p.line.is_none() && place(p).is_some());
        if !is_placed {
            return self.base.problems(problems);
        }
        let of_plan = problems.into_iter().filter_map(|p| {
            let at = place(&p)?;
            Some(p.placed(Some(at)))
        });
        plan.problems(of_plan.collect())
    }

    fn try_scenario(&self, run: usize) -> Result<(Loaded, Draw), (Vec<Problem>, Option<Draw>)> {
        let (mut loaded, draw) = self.draws.scenario(&self.base.text, run)?;
        let folder = self.base.path.parent().unwrap_or(Path::new(""));
        let defects = loaded.scenario.defects.iter();
        let files: Vec<Option<String>> =
            defects.map(|d| d.shape.file().map(str::to_owned)).collect();
        match brinell_damage::resolve(&mut loaded.scenario, folder) {
            Ok(_) => {
                for (defect, file) in files.iter().enumerate() {
                    if let Some(file) = file {
                        loaded.read_from(defect, file);
                    }
                }
                Ok((loaded, draw))
            }
            Err(errors) => {
                let problem =
                    |e: &brinell_damage::Unresolved| Problem::of_file(&e.key, &e.file, &e.message);
                Err((errors.iter().map(problem).collect(), Some(draw)))
            }
        }
    }
}

/// A problem of the plan as a whole, at the line of its key.
fn draws_problem(problem: Problem, text: &str) -> Problem {
    let place = locate(text, &problem.key);
    problem.placed(place)
}
