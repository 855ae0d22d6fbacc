//! A reproduction from its request to its files: which runs it needs, what they decide, and what is written of that.

use crate::curve_files::{CurveFiles, make_folder};
use crate::models::{OtherRuns, OtherVerdicts};
use crate::outcome::Outcome;
use crate::points::numbers;
use crate::sensitivity::{Plan, Sensitivity};
use crate::{
    BASE, Case, EXPERIMENTS, Error, Experiment, Length, Numbers, Outline, Point, Runs, Stage, book, case, claims,
    judge, outcome, page,
};
use brinell::scenario::Scenario;
use brinell_io::atomic_write;
use brinell_report::{DamageView, Picture, Study};
use serde_json::json;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// What is to be reproduced.
pub struct Request {
    pub(crate) experiments: Vec<&'static Experiment>,
    pub(crate) points: Vec<Point>,
    pub(crate) length: Length,
    /// Whether it is all of section 4.
    whole: bool,
    plan: Option<Plan>,
    models: Option<OtherRuns>,
}

impl Request {
    /// Some figures of the paper, or all where `figures` is empty; runs last `length`.
    ///
    /// # Errors
    /// Where a case is no scenario.
    pub fn new(figures: &[u32], length: Length) -> Result<Self, Error> {
        let wanted = |e: &&Experiment| figures.is_empty() || e.figures.iter().any(|f| figures.contains(f));
        let experiments: Vec<&Experiment> = EXPERIMENTS.iter().filter(wanted).collect();
        let mut cases: Vec<&'static Case> = Vec::new();
        for id in experiments.iter().flat_map(|e| &e.cases) {
            match case(id) {
                Some(case) if !cases.contains(&case) => cases.push(case),
                _ => {}
            }
        }
        let points = cases.into_iter().map(|case| Point::new(case, &[], Outline::Joined, length));
        Ok(Self {
            whole: figures.is_empty(),
            points: points.collect::<Result<_, Error>>()?,
            experiments,
            length,
            plan: None,
            models: None,
        })
    }

    /// The same with every unstated assumption varied, and searches for the set of assumptions that agrees best.
    ///
    /// # Errors
    /// Where a variant of a case is no scenario.
    pub fn with_sensitivity(self, quick: bool) -> Result<Self, Error> {
        Ok(Self { plan: Some(Plan::new(quick)?), ..self })
    }

    /// The same with every case also in slices and with tilting, the verdicts side by side.
    ///
    /// # Errors
    /// Where a case is no scenario of those models.
    pub fn with_tilting(self) -> Result<Self, Error> {
        let cases: Vec<_> = self.points.iter().map(|point| point.case).collect();
        Ok(Self { models: Some(OtherRuns::new(&cases, self.length)?), ..self })
    }

    /// Points of which pictures show curves.
    pub(crate) fn with_curves(&self) -> impl Iterator<Item = &Point> {
        let has_curves = |e: &&&Experiment| e.figures[0] <= 15 || e.figures[0] == 20;
        self.points.iter().filter(move |p| {
            let mut experiments = self.experiments.iter().filter(has_curves);
            experiments.any(|e| e.cases.contains(&p.case.id))
        })
    }
}

/// What came out of a [`Request`].
pub struct Reproduction {
    pub(crate) request: Request,
    pub(crate) numbers: Numbers,
    pub(crate) sensitivity: Option<Sensitivity>,
    pub(crate) models: Option<OtherVerdicts>,
    /// The claims that it decides, in the paper's order.
    pub outcomes: Vec<Outcome>,
    /// Case and reason of each run that failed.
    pub failures: Vec<(String, String)>,
    /// Whether runs are missing because they were interrupted.
    pub interrupted: bool,
}

impl Reproduction {
    /// Has all runs made, and decides the claims.
    ///
    /// # Errors
    /// Those of `runs`.
    pub fn run<R: Runs>(request: Request, runs: &mut R) -> Result<Self, R::Error> {
        let plan = request.plan.as_ref();
        let varied = plan.into_iter().flat_map(Plan::points);
        let others = request.models.iter().flat_map(OtherRuns::points);
        let points = request.points.iter().chain(varied).chain(others);
        let points: Vec<&Point> = points.collect();
        let mut flow = runs.make(&points, Stage::Cases)?;
        let mut sensitivity = None;
        if let (Some(plan), ControlFlow::Continue(())) = (plan, flow) {
            sensitivity = plan.run(runs)?;
            if sensitivity.is_none() {
                flow = ControlFlow::Break(());
            }
        }
        Ok(Self::decided(request, runs, sensitivity, flow.is_break()))
    }

    fn decided(request: Request, runs: &impl Runs, sensitivity: Option<Sensitivity>, interrupted: bool) -> Self {
        let numbers = numbers(&request.points, runs);
        let has = |id: &str| request.points.iter().any(|p| p.case.id == id);
        let outcomes = claims().enumerate().filter_map(|(place, claim)| {
            let cases = claim.cases();
            // What cannot be checked belongs to the whole.
            let wanted = cases.iter().all(|id| has(id)) && (request.whole || !cases.is_empty());
            let judged = judge(claim, &numbers);
            let flips = sensitivity.as_ref().map_or(Vec::new(), |s| s.flips(place, judged.plain));
            wanted.then_some(Outcome { claim, judged, flips })
        });
        let failures = request.points.iter().filter_map(|point| {
            let row = runs.row(&point.task.fingerprint)?;
            let reason = row.result.as_ref().err()?;
            Some((point.case.label.to_owned(), reason.clone()))
        });
        let outcomes: Vec<Outcome> = outcomes.collect();
        let models = request.models.as_ref();
        Self {
            models: models.map(|others| others.verdicts(&outcomes, runs)),
            outcomes,
            failures: failures.collect(),
            request,
            numbers,
            sensitivity,
            interrupted,
        }
    }

    /// What the search for a set of assumptions found, in a sentence or two, where there was one.
    pub fn search_result(&self) -> Option<String> {
        self.sensitivity.as_ref().map(Sensitivity::found)
    }

    /// What tilting changes, in a sentence, where that was requested.
    pub fn tilting_result(&self) -> Option<String> {
        self.models.as_ref().map(OtherVerdicts::found)
    }

    /// The page. `plan` gives the view from above of a scenario's first defect.
    pub fn study(&self, files: &CurveFiles, plan: impl Fn(&Scenario) -> Option<DamageView>) -> Study {
        let curves = |id: &str| {
            let point = self.request.points.iter().find(|p| p.case.id == id)?;
            files.curves(&point.task.fingerprint)
        };
        page::study(self, curves, plan)
    }

    /// Writes `claims.csv`, `claims.json` and, with other models, `models.csv` into a folder, which exists.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn write_claims(&self, folder: &Path) -> Result<Vec<PathBuf>, Error> {
        let mut header = json!({
            "brinell": brinell::VERSION, "length": self.request.length.words(), "base_toml": BASE,
            "interval": "95 % of the value, an average over whole revolutions of the inner ring; peaks are those of a revolution",
        });
        if let Some(sensitivity) = &self.sensitivity {
            header["sensitivity"] = sensitivity.json();
        }
        let mut written = outcome::write(&self.outcomes, &header, folder)?;
        if let Some(models) = &self.models {
            written.push(models.write(folder)?);
        }
        Ok(written)
    }

    /// Writes `reproduction.md`, the book's chapter, and its pictures into the folder `book`.
    ///
    /// # Errors
    /// Where the folder cannot be made or a file cannot be written.
    pub fn write_book(&self, study: &Study, pictures: &[Picture], book: &Path) -> Result<Vec<PathBuf>, Error> {
        make_folder(book)?;
        let text = book::text(study, self, book);
        let mut written = vec![put(book, "reproduction.md", &text)?];
        for picture in pictures {
            written.push(put(book, &format!("{}.svg", picture.name), &picture.svg())?);
        }
        Ok(written)
    }
}

/// Writes `reproduce.html`, the page, into a folder, which exists.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_page(study: &Study, folder: &Path) -> Result<PathBuf, Error> {
    put(folder, "reproduce.html", &brinell_report::study_html(study))
}

fn put(folder: &Path, name: &str, text: &str) -> Result<PathBuf, Error> {
    let path = folder.join(name);
    atomic_write(&path, text.as_bytes())?;
    Ok(path)
}
