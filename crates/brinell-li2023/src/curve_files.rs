//! The curves of runs as files, so that pictures need no second run.

use crate::curves::Curves;
use crate::{Error, FromStart, Request, entry_drop};
use brinell::channel::Frame;
use brinell::result::{Quantity, RunResult, Spread};
use brinell::simulate::{Observer, Simulation};
use brinell_io::atomic_write;
use std::collections::HashSet;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// The folder `curves` of the results: one file for each run of which pictures show more than numbers.
#[derive(Debug, Clone)]
pub struct CurveFiles {
    folder: PathBuf,
    /// Fingerprints of the runs whose curves are kept.
    keep: HashSet<String>,
}

impl CurveFiles {
    /// Of a request whose results go to `folder`.
    pub fn new(folder: &Path, request: &Request) -> Self {
        Self {
            folder: folder.join("curves"),
            keep: request.with_curves().map(|p| p.task.fingerprint.clone()).collect(),
        }
    }

    fn path(&self, fingerprint: &str) -> PathBuf {
        let name = format!("{}.json", &fingerprint[..fingerprint.len().min(16)]);
        self.folder.join(name)
    }

    /// The curves of a finished run; `None` where there are none that can be read.
    pub(crate) fn curves(&self, fingerprint: &str) -> Option<Curves> {
        let bytes = std::fs::read(self.path(fingerprint)).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    /// Whether a run has the curves that pictures need of it, if they need any.
    pub fn is_complete(&self, fingerprint: &str) -> bool {
        !self.keep.contains(fingerprint) || self.curves(fingerprint).is_some()
    }

    /// Observes the run of a point, and keeps its curves where pictures need them.
    pub fn observer(&self, fingerprint: &str, simulation: &Simulation) -> CaseObserver {
        let keep = self.keep.contains(fingerprint);
        CaseObserver { from_start: FromStart::new(simulation), curves: keep.then(|| self.path(fingerprint)) }
    }
}

/// Observes what is recorded of a case's run beside its findings.
#[derive(Debug, Clone)]
pub struct CaseObserver {
    from_start: FromStart,
    /// Where its curves go, if they are kept.
    curves: Option<PathBuf>,
}

impl CaseObserver {
    /// Writes the curves of a complete run, and gives the numbers that its findings do not hold.
    ///
    /// # Errors
    /// Where the curves cannot be written.
    pub fn finish(&self, finished: &RunResult) -> Result<Vec<Quantity>, Error> {
        if let Some(path) = &self.curves {
            make_folder(path.parent().unwrap_or(Path::new("")))?;
            let curves = Curves::of(finished, self.from_start.pocket_forces());
            atomic_write(path, serde_json::to_string(&curves).unwrap_or_default())?;
        }
        let drop = finished.findings.passes.best().first().and_then(|pass| {
            let defect = &finished.simulation.model().defects[pass.defect];
            let (first, last) = defect.shape.arc();
            entry_drop(&pass.points, (last - first) / defect.radius)
        });
        let energy = &finished.outcome.energy;
        let parametric = energy.parametric / energy.flows.contact.abs();
        let mut all = self.from_start.quantities(&finished.findings);
        for (name, value) in [
            ("defect1.entry_drop", drop),
            // Positive where damage puts energy into the bearing.
            ("parametric_share", Some(parametric).filter(|share| share.is_finite())),
        ] {
            all.push(Quantity { name: name.into(), unit: "1".into(), value, spread: Spread::Without });
        }
        Ok(all)
    }
}

impl Observer for CaseObserver {
    fn sample(&mut self, index: u64, frame: &Frame) {
        self.from_start.sample(index, frame);
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.from_start.row(index, row, filtered)
    }
}

pub(crate) fn make_folder(folder: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(folder).map_err(|source| Error::Folder { folder: folder.to_path_buf(), source })
}
