//! A reproduction's verdicts as they are kept and read: words and numbers of each claim and statement. Those of the whole
//! reproduction under the paper's laws are in `verdicts.json`, which `brinell reproduce --book` writes into the book.

use crate::outcome::{Outcome, ours};
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// A claim's verdict.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Recorded {
    /// The claim's name.
    pub claim: String,
    /// Its verdict, with what it is conditional on.
    pub verdict: String,
    /// Of each statement, those of another reading last.
    pub statements: Vec<RecordedStatement>,
}

/// A statement's verdict.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RecordedStatement {
    /// What is checked.
    pub statement: String,
    /// Its verdict.
    pub verdict: String,
    /// Our numbers with their intervals.
    pub ours: String,
}

/// Of the whole reproduction under the paper's laws: the one that the book shows.
pub(crate) static UNDER_LI2023: LazyLock<Vec<Recorded>> = LazyLock::new(|| {
    let text = include_str!("verdicts.json");
    serde_json::from_str(text).unwrap_or_else(|fault| panic!("verdicts.json: {fault}"))
});

impl Recorded {
    /// What is kept of an outcome.
    pub(crate) fn of(outcome: &Outcome) -> Self {
        let statements = outcome.statements().into_iter().map(|(statement, verdict, found)| RecordedStatement {
            statement,
            verdict: verdict.words().to_owned(),
            ours: ours(found),
        });
        Self {
            claim: outcome.claim.id.to_owned(),
            verdict: outcome.judged.words(outcome.claim),
            statements: statements.collect(),
        }
    }
}

/// The file of it.
pub(crate) fn text(all: &[Recorded]) -> String {
    serde_json::to_string_pretty(all).unwrap_or_default() + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims;

    #[test]
    fn prop_the_kept_verdicts_are_of_every_claim_and_statement() {
        assert_eq!(UNDER_LI2023.len(), claims().count());
        for (kept, claim) in UNDER_LI2023.iter().zip(claims()) {
            assert_eq!(kept.claim, claim.id);
            let other = claim.otherwise.iter();
            let other = other.flat_map(|o| o.statements.iter().map(move |s| format!("{}: {}", o.words, s.words)));
            let own = claim.statements.iter().map(|s| s.words.to_owned());
            let words: Vec<String> = own.chain(other).collect();
            assert!(kept.statements.iter().map(|s| &s.statement).eq(&words), "{}", claim.id);
        }
        assert_eq!(text(&UNDER_LI2023), include_str!("verdicts.json"));
    }

    #[test]
    fn prop_the_kept_verdicts_are_the_books() {
        let book = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reproduction");
        if !book.is_dir() {
            eprintln!("skipped: the book is not beside the crate");
            return;
        }
        let again = "copy docs/src/reproduction/verdicts.json, which the whole reproduction writes";
        let read = |name: &str| std::fs::read_to_string(book.join(name)).unwrap();
        assert_eq!(read("verdicts.json"), include_str!("verdicts.json"), "{again}");
        let chapter = read("../reproduction.md");
        for statement in UNDER_LI2023.iter().flat_map(|kept| &kept.statements) {
            let RecordedStatement { statement, verdict, ours } = statement;
            let words = format!("{statement} — {verdict}: {ours}").replace('|', "\\|");
            assert!(chapter.contains(&words), "{again}\n{words}");
        }
    }
}
