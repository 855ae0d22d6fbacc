//! Whether the paper's claims change with the model: the same cases on a half-space and with tilting, verdicts side by side.

use crate::cases::owned;
use crate::outcome::Outcome;
use crate::points::points;
use crate::runs::numbers;
use crate::{Case, Error, Length, Numbers, Outline, Point, Runs, Verdict, judge};
use brinell_io::{Cells, Column};
use brinell_report::{Chapter, Piece, Table};
use std::path::{Path, PathBuf};

/// A model that all cases are made with.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OtherModel {
    id: &'static str,
    words: &'static str,
    settings: &'static [(&'static str, &'static str)],
}

/// In the plane first, so that what the law changes is not put down to tilting. The lumped cases keep their model.
const TILTING: [OtherModel; 2] = [
    OtherModel {
        id: "half-space",
        words: "planar, half-space",
        settings: &[("contact.law", "half-space"), ("simulation.geometry", "exact")],
    },
    OtherModel {
        id: "tilting",
        words: "tilting",
        settings: &[("contact.law", "half-space"), ("simulation.geometry", "exact"), ("simulation.model", "tilting")],
    },
];

/// The runs of all cases with the other models.
pub(crate) struct OtherRuns {
    sets: Vec<(OtherModel, Vec<Point>)>,
}

/// What the other models decide.
pub(crate) struct OtherVerdicts {
    models: Vec<OtherModel>,
    /// Of each claim, in the order of the outcomes: the baseline's verdict, then each model's.
    rows: Vec<(&'static str, &'static str, Vec<Verdict>)>,
}

impl OtherRuns {
    /// # Errors
    /// Where a case is no scenario of a model.
    pub(crate) fn new(cases: &[&'static Case], length: Length) -> Result<Self, Error> {
        let set = |model: OtherModel| {
            let cases = cases.iter().copied();
            Ok((model, points(cases, &owned(model.settings), Outline::Joined, length)?))
        };
        let sets = TILTING.into_iter().map(set).collect::<Result<_, Error>>()?;
        Ok(Self { sets })
    }

    pub(crate) fn points(&self) -> impl Iterator<Item = &Point> {
        self.sets.iter().flat_map(|(_, points)| points)
    }

    pub(crate) fn verdicts(&self, outcomes: &[Outcome], runs: &impl Runs) -> OtherVerdicts {
        let all = self.sets.iter().map(|(_, points)| numbers(points, runs));
        let all: Vec<Numbers> = all.collect();
        let row = |outcome: &Outcome| {
            let others = all.iter().map(|n| judge(outcome.claim, n).verdict);
            let verdicts = std::iter::once(outcome.judged.verdict).chain(others);
            (outcome.claim.id, outcome.claim.sentence, verdicts.collect())
        };
        OtherVerdicts {
            models: self.sets.iter().map(|(model, _)| *model).collect(),
            rows: outcomes.iter().map(row).collect(),
        }
    }
}

impl OtherVerdicts {
    /// How many verdicts of the last model differ from those of the same cases in the plane, in a sentence.
    pub(crate) fn found(&self) -> String {
        let changed: Vec<&str> =
            self.rows.iter().filter(|(_, _, verdicts)| verdicts[1] != verdicts[2]).map(|(id, ..)| *id).collect();
        match changed.len() {
            0 => "Tilting changes no verdict that the half-space alone leaves.".into(),
            n => format!(
                "Tilting changes {n} of {} verdicts that the half-space alone leaves: {}.",
                self.rows.len(),
                changed.join(", ")
            ),
        }
    }

    pub(crate) fn chapter(&self) -> Chapter {
        let columns = ["The paper", "planar, effective length"];
        let columns = columns.into_iter().chain(self.models.iter().map(|m| m.words));
        let rows = self.rows.iter().map(|(_, sentence, verdicts)| {
            let words = verdicts.iter().map(|v| v.words().to_owned());
            std::iter::once((*sentence).to_owned()).chain(words).collect()
        });
        let table = Table::new(
            "Verdicts side by side",
            columns,
            rows,
            "The same cases, all else alike. What tilts has damage as on a half-space and exact geometry, so that law in the plane is between both.",
        );
        let pieces = vec![Piece::Words(self.found()), Piece::Table(table)];
        Chapter::new("models", "Tilting", "With rollers and rings that tilt", pieces)
    }

    /// models.csv.
    pub(crate) fn write(&self, folder: &Path) -> Result<PathBuf, Error> {
        let mut table = brinell_io::Table::default();
        let mut push = |name: &str, about: &str, cells: Vec<String>| {
            let cells = cells.into_iter().map(Some).collect();
            table.push(Column::new(name, "", about), Cells::Words(cells));
        };
        let ids = self.rows.iter().map(|row| row.0.to_owned());
        push("claim", "its name here", ids.collect());
        let verdicts = |k: usize| self.rows.iter().map(move |row| row.2[k].words().to_owned());
        push("ecl", "verdict in the plane, by effective length", verdicts(0).collect());
        for (k, model) in self.models.iter().enumerate() {
            push(model.id, model.words, verdicts(k + 1).collect());
        }
        Ok(table.write_csv(folder.join("models.csv"))?)
    }
}
