//! Cases as tasks, and what is kept of their runs.

use super::curves::Curves;
use crate::campaign::{Beside, Ledger, Task, Work};
use crate::failure::Failure;
use crate::run::make_folder;
use brinell::campaign::{Finished, Quantity, Spread, fingerprint};
use brinell::channel::Frame;
use brinell::document;
use brinell::scenario::Scenario;
use brinell::simulate::{Observer, Simulation};
use brinell_io::atomic_write;
use brinell_li2023::{BASE, Case, FromStart, Length, Numbers, Outline, entry_drop, length_of};
use std::collections::HashSet;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// A case under assumptions, ready to run.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) case: &'static Case,
    pub(super) task: Task,
}

/// A case with `more` settings below its own, its irregular defect in a reading of Eq. (27). What it sets itself, its shape or its load, stays.
pub(super) fn point(
    case: &'static Case,
    more: &[(String, String)],
    outline: Outline,
    length: Length,
) -> Result<Point, Failure> {
    let mut settings = case.over(more, outline);
    let duration = length_of(case, length).duration_s(case.rpm);
    settings.push(("simulation.duration_s".into(), format!("{duration:?}")));
    let scenario = read(&settings)?;
    Ok(Point {
        case,
        task: Task {
            fingerprint: fingerprint(&scenario),
            duration_s: duration,
            settings,
        },
    })
}

/// The scenario of a case as it stands.
pub(super) fn scenario(case: &Case) -> Result<Scenario, Failure> {
    read(&case.over(&[], Outline::Joined))
}

fn read(settings: &[(String, String)]) -> Result<Scenario, Failure> {
    let loaded = document::read(BASE, settings).map_err(|problems| Failure::Scenario {
        name: "the paper's scenario".into(),
        text: BASE.into(),
        problems,
    })?;
    Ok(loaded.scenario)
}

/// Numbers of all points that are finished.
pub(super) fn numbers<'a>(points: impl IntoIterator<Item = &'a Point>, ledger: &Ledger) -> Numbers {
    let mut numbers = Numbers::default();
    for point in points {
        if let Some(row) = ledger.kept.row(&point.task.fingerprint) {
            numbers.add(point.case.id, row);
        }
    }
    numbers
}

/// Runs points, and keeps the curves of some.
pub(super) struct FromPaper {
    pub(super) folder: PathBuf,
    /// Fingerprints of the runs whose curves are kept.
    pub(super) keep: HashSet<String>,
}

impl FromPaper {
    pub(super) fn path(&self, fingerprint: &str) -> PathBuf {
        let name = format!("{}.json", &fingerprint[..fingerprint.len().min(16)]);
        self.folder.join("curves").join(name)
    }

    /// The curves of a finished run; `None` where there are none that can be read.
    pub(super) fn curves(&self, fingerprint: &str) -> Option<Curves> {
        let bytes = std::fs::read(self.path(fingerprint)).ok()?;
        Curves::from_json(&serde_json::from_slice(&bytes).ok()?)
    }

    /// Whether nothing is left to do for a task.
    pub(super) fn is_done(&self, task: &Task, ledger: &Ledger) -> bool {
        ledger.kept.row(&task.fingerprint).is_some_and(|row| {
            row.result.is_err()
                || !self.keep.contains(&task.fingerprint)
                || self.curves(&task.fingerprint).is_some()
        })
    }
}

impl Work for FromPaper {
    fn scenario(&self, task: &Task) -> Result<Scenario, Failure> {
        read(&task.settings)
    }

    fn beside(&self, task: &Task, simulation: &Simulation) -> Option<Box<dyn Beside>> {
        let keep = self.keep.contains(&task.fingerprint);
        Some(Box::new(Watched {
            from_start: FromStart::new(simulation),
            curves: keep.then(|| self.path(&task.fingerprint)),
        }))
    }
}

/// What a case's run needs beside its findings.
struct Watched {
    from_start: FromStart,
    /// Where its curves go, if they are kept.
    curves: Option<PathBuf>,
}

impl Observer for Watched {
    fn sample(&mut self, index: u64, frame: &Frame) {
        self.from_start.sample(index, frame);
    }

    fn row(&mut self, index: u64, row: &[f64], filtered: &[f64]) -> ControlFlow<()> {
        self.from_start.row(index, row, filtered)
    }
}

impl Beside for Watched {
    fn finished(self: Box<Self>, finished: &Finished) -> Result<Vec<Quantity>, Failure> {
        if let Some(path) = &self.curves {
            make_folder(path.parent().unwrap_or(Path::new("")))?;
            let curves = Curves::of(finished, self.from_start.pocket_forces());
            atomic_write(path, curves.to_json().to_string().as_bytes())?;
        }
        let drop = finished.findings.passes.best().first().and_then(|pass| {
            let defect = &finished.simulation.model().defects[pass.defect];
            let (first, last) = defect.shape.arc();
            entry_drop(&pass.points, (last - first) / defect.radius)
        });
        let mut all = self.from_start.quantities(&finished.findings);
        all.push(Quantity {
            name: "defect1.entry_drop".into(),
            unit: "1".into(),
            value: drop,
            spread: Spread::Without,
        });
        Ok(all)
    }
}
