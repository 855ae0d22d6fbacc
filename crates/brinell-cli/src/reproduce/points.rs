//! Cases as tasks, and what is kept of their runs.

use super::curves::Curves;
use crate::campaign::{Ledger, Task, Work};
use crate::failure::Failure;
use brinell::campaign::{Finished, Quantity, Spread, fingerprint};
use brinell::document;
use brinell::paper::{BASE, Case, Length, Numbers, entry_drop};
use brinell::scenario::Scenario;
use brinell_io::atomic_write;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// A case under assumptions, ready to run.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) case: &'static Case,
    pub(super) task: Task,
}

/// A case with `more` settings over its own. What it sets itself, its shape or its load, stays.
pub(super) fn point(
    case: &'static Case,
    more: &[(String, String)],
    length: Length,
) -> Result<Point, Failure> {
    let own = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
    let mut settings: Vec<(String, String)> = more.to_vec();
    settings.extend(case.settings.iter().map(own));
    let duration = length.duration_s(case.rpm);
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

    fn finished(
        &self,
        task: &Task,
        finished: &Finished,
        _: &[f64],
    ) -> Result<Vec<Quantity>, Failure> {
        if self.keep.contains(&task.fingerprint) {
            let path = self.path(&task.fingerprint);
            crate::run::make_folder(path.parent().unwrap_or(Path::new("")))?;
            atomic_write(&path, Curves::of(finished).to_json().to_string().as_bytes())?;
        }
        let drop = finished.findings.passes.best().first().and_then(|pass| {
            let defect = &finished.simulation.model().defects[pass.defect];
            let (first, last) = defect.shape.arc();
            entry_drop(&pass.points, (last - first) / defect.radius)
        });
        Ok(vec![Quantity {
            name: "defect1.entry_drop".into(),
            unit: "1".into(),
            value: drop,
            spread: Spread::Without,
        }])
    }
}
