//! The paper's claims under other laws than its own: verdicts and numbers beside those under the paper's, claim by claim.
//! Left out is what no number decides.

use crate::outcome::Outcome;
use crate::recorded::{Recorded, RecordedStatement, UNDER_LI2023};
use crate::{Claim, Error, Numbers, judge};
use brinell_io::{Cells, Column};
use brinell_report::Table;
use std::path::{Path, PathBuf};

/// A claim under both sets of laws.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Joined {
    /// The claim.
    pub claim: &'static Claim,
    /// Under the paper's laws, as kept.
    pub paper: &'static Recorded,
    /// Under the others, the bearing as there.
    pub own: Recorded,
    /// Under the others with their default values.
    pub defaults: Recorded,
}

/// What becomes of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Change {
    /// It is the same.
    Same,
    /// What held does not, or the other way round.
    TurnsOver,
    /// It is another, but not the opposite.
    Changes,
    /// The intervals decide nothing.
    NotDecided,
    /// A number is missing.
    Missing,
}

impl Change {
    /// From a verdict's words to another's, both with what they are conditional on.
    pub(crate) fn between(from: &str, to: &str) -> Self {
        let plain = |words: &str| words.split([',', ':']).next().unwrap_or_default().to_owned();
        match (plain(from).as_str(), plain(to).as_str()) {
            (_, "undecided") => Self::NotDecided,
            (_, "not computed") => Self::Missing,
            (from, to) if from == to => Self::Same,
            ("holds", "does not hold") | ("does not hold", "holds") => Self::TurnsOver,
            _ => Self::Changes,
        }
    }

    /// As tables say it.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::TurnsOver => "reversed",
            Self::Changes => "changes",
            Self::NotDecided => "not decided",
            Self::Missing => "not computed",
        }
    }
}

impl Joined {
    /// What becomes of the claim's verdict.
    pub(crate) fn change(&self) -> Change {
        Change::between(&self.paper.verdict, &self.own.verdict)
    }

    /// Each statement under the paper's laws, under the others, and with their default values.
    fn statements(&self) -> impl Iterator<Item = [&RecordedStatement; 3]> {
        let both = self.paper.statements.iter().zip(&self.own.statements);
        both.zip(&self.defaults.statements).map(|((paper, own), defaults)| [paper, own, defaults])
    }
}

/// The claims of `outcomes` beside those that are kept; `defaults` has the numbers with the laws' default values.
pub(crate) fn join(outcomes: &[Outcome], defaults: &Numbers) -> Vec<Joined> {
    let checked = outcomes.iter().filter(|outcome| !outcome.claim.statements.is_empty());
    let one = |outcome: &Outcome| {
        let claim = outcome.claim;
        let judged = judge(claim, defaults);
        Some(Joined {
            claim,
            paper: UNDER_LI2023.iter().find(|kept| kept.claim == claim.id)?,
            own: Recorded::of(outcome),
            defaults: Recorded::of(&Outcome { claim, judged, flips: vec![], unchanged: None }),
        })
    };
    checked.filter_map(one).collect()
}

/// How many verdicts are the same, and which are not, in a sentence.
pub(crate) fn found(all: &[Joined]) -> String {
    let count = |wanted: Change| all.iter().filter(|joined| joined.change() == wanted).count();
    let mut text = format!(
        "Of {} sentences that numbers decide {} keep the verdict that they have under the paper’s laws",
        all.len(),
        count(Change::Same)
    );
    for change in [Change::TurnsOver, Change::Changes, Change::NotDecided, Change::Missing] {
        let mine = all.iter().filter(|joined| joined.change() == change);
        let ids: Vec<&str> = mine.map(|joined| joined.claim.id).collect();
        if !ids.is_empty() {
            text += &format!("; {}: {} ({})", change.words(), ids.len(), ids.join(", "));
        }
    }
    text + "."
}

/// Numbers as short as a table of both sets of laws has them: "15.62 [15.49, 15.74]", the ratio alone where there is
/// one, of several their values one after the other.
pub(crate) fn brief(ours: &str) -> String {
    let value = |part: &str| {
        let words = part.split(' ').skip_while(|word| *word != "–" && word.parse::<f64>().is_err());
        words.collect::<Vec<_>>().join(" ")
    };
    let parts: Vec<&str> = ours.split("; ").collect();
    match parts.as_slice() {
        [.., ratio] if ratio.starts_with("ratio ") => value(ratio),
        [others @ .., last] => {
            let others = others.iter().map(|part| value(part).trim_end_matches(" m/s²").to_owned());
            others.chain([value(last)]).collect::<Vec<_>>().join("; ")
        }
        [] => String::new(),
    }
}

/// "holds: ratio 2.0 [1.8, 2.2]".
fn cell(one: &RecordedStatement) -> String {
    let ratio = if one.ours.contains("; ratio ") { "ratio " } else { "" };
    format!("{}: {ratio}{}", one.verdict, brief(&one.ours))
}

/// Both sets of laws side by side: a row a claim, and one for each of its statements below.
pub(crate) fn table(all: &[Joined]) -> Table {
    let columns = ["The paper", "Printed", "li2023", "mechanics", "Change", "mechanics, default values"];
    let mut rows = Vec::new();
    for joined in all {
        let Joined { claim, paper, own, defaults } = joined;
        rows.push(vec![
            format!("{} ({})", claim.sentence, claim.place),
            claim.paper.to_owned(),
            paper.verdict.clone(),
            own.verdict.clone(),
            joined.change().words().to_owned(),
            defaults.verdict.clone(),
        ]);
        rows.extend(joined.statements().map(|[paper, own, defaults]| {
            let change = Change::between(&paper.verdict, &own.verdict);
            let words = format!("– {}", own.statement);
            vec![words, String::new(), cell(paper), cell(own), change.words().to_owned(), cell(defaults)]
        }));
    }
    Table::new(
        "Verdicts and numbers side by side",
        columns,
        rows,
        "A row a sentence of the paper, below it what is checked of it, with 95 % intervals. li2023: the whole reproduction under the paper’s \
         laws, as the book has it. mechanics: the same bearing, other laws. Default values: those of these laws in place of what the paper states or the \
         baseline assumes; one start a case, so intervals across the load are too narrow.",
    )
}

/// laws.csv: a row a statement.
pub(crate) fn write(all: &[Joined], folder: &Path) -> Result<PathBuf, Error> {
    let mut columns: [Vec<Option<String>>; 13] = Default::default();
    for joined in all {
        for [paper, own, defaults] in joined.statements() {
            let cells = [
                joined.claim.id,
                joined.claim.place,
                joined.claim.paper,
                &joined.paper.verdict,
                &joined.own.verdict,
                joined.change().words(),
                &own.statement,
                &paper.verdict,
                &paper.ours,
                &own.verdict,
                &own.ours,
                &defaults.verdict,
                &defaults.ours,
            ];
            for (column, cell) in columns.iter_mut().zip(cells) {
                column.push(Some(cell.to_owned()).filter(|text| !text.is_empty()));
            }
        }
    }
    let heads = [
        ("claim", "its name here"),
        ("place", "section and figure of the paper"),
        ("paper", "what it prints"),
        ("claim_li2023", "the claim's verdict under the paper's laws, as the book has it"),
        ("claim_mechanics", "under the laws of mechanics, the bearing as there"),
        ("change", "from the one to the other"),
        ("statement", "what is checked"),
        ("li2023_verdict", "of the statement, under the paper's laws"),
        ("li2023", "numbers with 95 % intervals"),
        ("mechanics_verdict", "under the laws of mechanics"),
        ("mechanics", "numbers with 95 % intervals"),
        ("defaults_verdict", "with the default values of the laws of mechanics"),
        ("defaults", "numbers with 95 % intervals of one start"),
    ];
    let mut table = brinell_io::Table::default();
    for ((name, about), cells) in heads.into_iter().zip(columns) {
        table.push(Column::new(name, "", about), Cells::Words(cells));
    }
    Ok(table.write_csv(folder.join("laws.csv"))?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims;
    use crate::numbers::exact;

    fn outcome(id: &str, numbers: &Numbers) -> Outcome {
        let claim = claims().find(|claim| claim.id == id).unwrap();
        Outcome { claim, judged: judge(claim, numbers), flips: vec![], unchanged: None }
    }

    #[test]
    fn prop_two_records_are_joined_by_claim() {
        let mut numbers = Numbers::default();
        for (case, rms) in [("simplified", 2.0), ("irregular", 1.0)] {
            for name in ["outer_ax.rms", "outer_ay.rms", "outer_ax.peak_to_peak", "outer_ay.peak_to_peak"] {
                numbers.insert(case, name, exact(rms));
            }
        }
        let ids = ["simplified-acceleration", "familiar", "load-outer-x"];
        let outcomes = ids.map(|id| outcome(id, &numbers));
        let all = join(&outcomes, &Numbers::default());
        // What is not checkable is left out.
        assert_eq!(all.iter().map(|j| j.claim.id).collect::<Vec<_>>(), ["simplified-acceleration", "load-outer-x"]);
        for joined in &all {
            assert_eq!((joined.claim.id, joined.claim.id), (&*joined.paper.claim, &*joined.own.claim));
            assert!(joined.statements().all(|[a, b, c]| a.statement == b.statement && b.statement == c.statement));
            assert_eq!(joined.defaults.verdict, "not computed");
        }
        assert_eq!((all[0].change(), all[1].change()), (Change::Same, Change::Missing));
        assert_eq!(table(&all).rows.len(), 2 + 4 + 1);
        assert_eq!(table(&all).rows[1][3], "holds: ratio 2.000");
        assert_eq!(
            found(&all),
            "Of 2 sentences that numbers decide 1 keep the verdict that they have under the paper’s laws; not computed: 1 (load-outer-x)."
        );
    }

    #[test]
    fn prop_changes_of_a_verdict() {
        for (from, to, change) in [
            ("holds", "holds, under our reading of Ref. [43]", Change::Same),
            ("holds", "does not hold", Change::TurnsOver),
            ("does not hold, by x", "holds", Change::TurnsOver),
            ("holds", "holds in part", Change::Changes),
            ("undecided", "holds", Change::Changes),
            ("undecided", "undecided: in part at most", Change::NotDecided),
            ("holds", "undecided", Change::NotDecided),
            ("holds", "not computed", Change::Missing),
        ] {
            assert_eq!(Change::between(from, to), change, "{from} to {to}");
        }
    }

    #[test]
    fn prop_numbers_in_brief() {
        for (ours, wanted) in [
            ("a: x.rms 2.0 [1.9, 2.1] m/s²; b: x.rms 1.0 m/s²; ratio 2.0 [1.8, 2.2]", "2.0 [1.8, 2.2]"),
            ("a: x.rms 2.0 [1.9, 2.1] m/s²; b: x.rms 1.0 m/s²", "2.0 [1.9, 2.1]; 1.0 m/s²"),
            ("a: defect1.frequency 246.9 [246.9, 247.0] Hz", "246.9 [246.9, 247.0] Hz"),
            ("speed5000 / speed1000: x.rms 6.2 [6.1, 6.3]", "6.2 [6.1, 6.3]"),
            ("a: x.rms –", "–"),
        ] {
            assert_eq!(brief(ours), wanted, "{ours}");
        }
    }
}
