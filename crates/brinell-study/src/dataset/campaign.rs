//! A plan with its base scenario: everything that the runs are made from.

use crate::campaign::{BALANCED, Beforehand, Misses, count, fingerprint};
use crate::dataset::columns::{DataColumn, columns};
use crate::dataset::document::Document;
use crate::dataset::error::DatasetError;
use crate::dataset::refusal::refused;
use crate::dataset::signals::Signals;
use crate::design::{Draw, Draws, Part, Plan, Repeats, Survey, place_in_plan, unsaid};
use brinell::channel::matches;
use brinell::document::{Loaded, Problem, canonical, locate};
use brinell::made_by::digest;
use brinell::many;
use brinell::simulate::Simulation;
use brinell_damage::resolve_loaded;
use brinell_io::Column;
use std::collections::HashSet;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Runs that are looked at before any runs; of longer plans every second, third, ... one.
const SURVEYED: usize = 100_000;
/// First runs that are asked which channels there are, where the bearing varies; and that are tried before a plan
/// counts as impossible.
const ASKED: usize = 64;

/// A plan that can be run.
pub struct Campaign {
    sources: Sources,
    files: Files,
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

/// What first runs say of all.
#[derive(Default)]
struct FirstRuns {
    /// The first that can be simulated.
    first: Option<Loaded>,
    /// Why one makes no scenario.
    failure: Option<DatasetError>,
    /// The first that cannot begin, and why.
    unable: Option<(usize, brinell::Error)>,
    /// Channels of any of them.
    signals: Signals,
    /// Patterns of `signals` that match no channel of any.
    idle: Option<HashSet<String>>,
}

/// Which runs lie in which file: those of one part together, each part in files of its own, in the runs' order.
struct Files {
    runs: Vec<usize>,
    /// Of each file: what its runs are for, and which of `runs` they are.
    files: Vec<(Part, Range<usize>)>,
}

impl Files {
    fn new(draws: &Draws) -> Self {
        let most = draws.plan().runs_per_file;
        let (mut runs, mut files) = (Vec::with_capacity(draws.runs()), Vec::new());
        for part in Part::ALL {
            let mut from = runs.len();
            runs.extend((0..draws.runs()).filter(|run| draws.part(*run) == part));
            while from < runs.len() {
                // Whole machines: the last one that ends within the file, or else the first.
                let ends = |k: &usize| *k == runs.len() || draws.unit_of(runs[*k]) != draws.unit_of(runs[*k - 1]);
                let end = (from + most).min(runs.len());
                let last = (from + 1..=end).rev().find(ends);
                let to = last.or_else(|| (end..=runs.len()).find(ends)).unwrap_or(runs.len());
                files.push((part, from..to));
                from = to;
            }
        }
        Self { runs, files }
    }
}

impl Campaign {
    /// Reads a plan file and the scenario that it names, and draws the first runs.
    ///
    /// # Errors
    /// Where a file cannot be read, the plan is bad or impossible, or no first run can be made.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, DatasetError> {
        let plan = Document::open(path.as_ref())?;
        let read = Plan::read(&plan.text)
            .map_err(|problems| plan.scenario_in_place().unwrap_or_else(|| plan.problems(problems)))?;
        let folder = plan.path.parent().unwrap_or(Path::new(""));
        let base = Document::open(&folder.join(&read.base)).map_err(|error| match error {
            // The file is the plan's to name.
            error @ DatasetError::Read { .. } => plan.problem_of("base", &read.base, &error.to_string()),
            other => other,
        })?;
        let draws = Draws::new(read).map_err(|problems| {
            let placed = problems.into_iter().map(|problem| draws_problem(problem, &plan.text));
            plan.problems(placed.collect())
        })?;
        let mut meaning = Vec::new();
        for document in [&plan, &base] {
            meaning.push(canonical(&document.text).map_err(|problems| document.problems(problems))?);
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
        self.files.files.len()
    }

    /// Runs of a file, by index.
    pub fn runs_of(&self, part: usize) -> &[usize] {
        &self.files.runs[self.files.files[part].1.clone()]
    }

    /// What a file's runs are for.
    pub fn split_of(&self, part: usize) -> Part {
        self.files.files[part].0
    }

    /// Looks at what the runs draw: all of them, or of more than 100000 every second, third, ... one; once `stop` is
    /// set, at no further ones. Of a plan that may be run the first [`BALANCED`] also find their static balance.
    pub fn survey(&self, stop: &AtomicBool) -> Survey {
        let mut survey = survey(self.draws(), &self.sources.base.text, stop);
        if survey.is_sound(self.plan().out_of_range) {
            self.balance(&mut survey, stop);
        }
        survey
    }

    /// Adds the warnings that first runs have before they begin.
    fn balance(&self, survey: &mut Survey, stop: &AtomicBool) {
        let (known, runs) = (Beforehand::default(), BALANCED.min(self.draws().runs()));
        let warnings = |run| {
            let stopped = stop.load(Ordering::Relaxed);
            let loaded = (!stopped).then(|| self.try_scenario(run).ok()).flatten();
            loaded.map(|(loaded, _)| known.warnings(&loaded.scenario))
        };
        let found = many::map(runs, many::threads(runs), warnings);
        survey.balanced = found.iter().flatten().count();
        for (run, warnings) in found.into_iter().enumerate() {
            warnings.into_iter().flatten().for_each(|warning| count(&mut survey.before, warning, run));
        }
    }

    /// What the plan's author should know, by what a survey found.
    pub fn warnings(&self, survey: &Survey) -> Vec<String> {
        let words = |misses: &[Misses], looked| -> Vec<String> {
            misses.iter().map(|miss| miss.words(looked, "run", miss.run)).collect()
        };
        let of_runs = [words(&survey.warnings, survey.runs), words(&survey.before, survey.balanced)].concat();
        let repeats = Repeats::of(&survey.prints, |run| self.draws().part(run));
        let repeats = repeats.map(|repeats| repeats.words(survey.runs));
        let plan = self.plan();
        let is_idle = plan.history.is_some() && survey.damaged == 0 && survey.is_sound(plan.out_of_range);
        let idle = is_idle.then(|| {
            "[history] grows nothing: no snapshot has damage; give classes `defects`, history.observed above history.begins_at, and snapshots times history.every_h of more than the time until damage begins".to_owned()
        });
        let notes = idle.into_iter().chain(repeats).chain(self.draws().notes());
        of_runs.into_iter().chain(notes.map(|note| format!("warning: {note}"))).collect()
    }

    /// That the plan may be run, by what a survey found.
    ///
    /// # Errors
    /// Each kind of problem once, at the plan's line, and how often.
    pub fn sound(&self, survey: &Survey) -> Result<(), DatasetError> {
        refused(self.draws(), &self.sources.plan, survey)
    }

    /// A run's scenario with its files of damage read, and what it drew.
    ///
    /// # Errors
    /// Where its values make no scenario.
    pub fn scenario(&self, run: usize) -> Result<(Loaded, Draw), DatasetError> {
        self.sources.scenario(run)
    }

    pub(crate) fn try_scenario(&self, run: usize) -> Result<(Loaded, Draw), (Vec<Problem>, Option<Draw>)> {
        self.sources.try_scenario(run)
    }
}

impl Sources {
    /// Makes scenarios of the first runs, of one where no bearing varies; `meaning` gets a scenario of each class.
    fn first_runs(&self, meaning: &mut Vec<String>) -> FirstRuns {
        let draws = &self.draws;
        let varies = |p: &crate::design::Parameter| p.key.starts_with("bearing.");
        let examined = match draws.parameters().iter().any(varies) {
            true => ASKED.min(draws.runs()),
            false => 1,
        };
        // The first run of each class as well: its files of damage are part of what the campaign is.
        let mut runs: Vec<usize> = (0..examined).collect();
        for class in 0..draws.plan().classes.len() {
            let first = (0..draws.runs()).find(|run| draws.class(*run) == class);
            runs.extend(first.filter(|run| *run >= examined));
        }
        let mut found = FirstRuns::default();
        let mut seen = HashSet::new();
        // Where none of these makes a scenario, some later one may.
        let further = examined..ASKED.min(draws.runs());
        let examined = runs.len();
        for (k, run) in runs.into_iter().chain(further).enumerate() {
            if k >= examined && found.first.is_some() {
                break;
            }
            let loaded = match self.scenario(run) {
                Ok((loaded, _)) => loaded,
                Err(error) => {
                    found.failure.get_or_insert(error);
                    continue;
                }
            };
            if seen.insert(draws.class(run)) {
                meaning.push(fingerprint(&loaded.scenario));
            }
            let simulation = match Simulation::planned(&loaded.scenario) {
                Ok(simulation) => simulation,
                Err(error) => {
                    found.unable.get_or_insert((run, error));
                    continue;
                }
            };
            let these = simulation.idle_patterns().iter().cloned();
            found.idle = Some(match found.idle.take() {
                None => these.collect(),
                Some(idle) => these.filter(|pattern| idle.contains(pattern)).collect(),
            });
            found.signals.take(simulation.channels().iter(), draws, run);
            found.first.get_or_insert(loaded);
        }
        found.signals.take_sensors(draws, &self.base.text);
        found
    }

    /// What follows from first runs: the signals, the columns, and what tells this campaign from others.
    fn settle(self, mut meaning: Vec<String>) -> Result<Campaign, DatasetError> {
        let draws = &self.draws;
        let FirstRuns { first, failure, unable, signals, idle } = self.first_runs(&mut meaning);
        let Some(first) = first else {
            if let Some((run, error)) = unable {
                return Err(DatasetError::Refused(format!(
                    "{}: none of the first runs can begin; run {run}: {error}",
                    self.plan.path.display()
                )));
            }
            // Said of all runs, where that can be: which keys, and of how many runs.
            let survey = survey(draws, &self.base.text, &AtomicBool::new(false));
            refused(draws, &self.plan, &survey)?;
            return Err(failure.unwrap_or_else(|| DatasetError::Refused("no run of the plan makes a scenario".into())));
        };
        let Signals { columns: signals, clash, .. } = signals;
        if let Some((channel, why)) = clash {
            return Err(self.plan.problem_of("signals", &channel, &why));
        }
        if let Some(pattern) = idle.iter().flatten().find(|p| !signals.iter().any(|c| matches(p, &c.name))) {
            return Err(self.plan.problem_of(
                "signals",
                pattern,
                &format!(
                    "no channel of the first runs has such a name; channels are those of `simulation.record`, such as signals = [\"{}\"]",
                    first.scenario.shown_channel()
                ),
            ));
        }
        Ok(Campaign {
            columns: columns(draws, &signals, first.scenario.machine.is_some()),
            files: Files::new(draws),
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
        let is_placed = problems.iter().any(|p| p.line.is_none() && place(p).is_some());
        if !is_placed {
            return self.base.problems(problems);
        }
        let of_plan = problems.into_iter().filter_map(|mut p| {
            let at = place(&p)?;
            p.message = unsaid(&p.message);
            Some(p.at(Some(at)))
        });
        plan.problems(of_plan.collect())
    }

    fn try_scenario(&self, run: usize) -> Result<(Loaded, Draw), (Vec<Problem>, Option<Draw>)> {
        let (mut loaded, draw) = self.draws.scenario(&self.base.text, run)?;
        let folder = self.base.path.parent().unwrap_or(Path::new(""));
        match resolve_loaded(&mut loaded, &self.base.text, &draw.settings, folder) {
            Ok(_) => Ok((loaded, draw)),
            Err(problems) => Err((problems, Some(draw))),
        }
    }
}

fn survey(draws: &Draws, base: &str, stop: &AtomicBool) -> Survey {
    let step = NonZeroUsize::new(draws.runs().div_ceil(SURVEYED)).unwrap_or(NonZeroUsize::MIN);
    Survey::of(draws, base, step, many::threads(usize::MAX), stop)
}

/// A problem of the plan as a whole, at the line of its key.
fn draws_problem(problem: Problem, text: &str) -> Problem {
    let place = locate(text, &problem.key);
    problem.at(place)
}
