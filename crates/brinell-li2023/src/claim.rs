//! Claims as data: a sentence, and what is checked of it. They are in `claims.toml`.

use crate::verdict::Trend;
use serde::Deserialize;
use std::sync::LazyLock;

/// How a statement is checked. Names are those of [`brinell::result::quantities`].
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Check {
    /// A number of a case lies within `share` of the paper's.
    Near {
        /// The case.
        case: &'static str,
        /// The number.
        name: &'static str,
        /// The paper's figure.
        paper: f64,
        /// How far off it may be, relative to the paper's.
        share: f64,
    },
    /// A number of one case exceeds one of another.
    Greater {
        /// Case and number that is said to be larger.
        of: (&'static str, &'static str),
        /// Case and number that is said to be smaller.
        than: (&'static str, &'static str),
    },
    /// The ratio of two numbers lies between bounds.
    Ratio {
        /// Case and number above.
        of: (&'static str, &'static str),
        /// Case and number below.
        to: (&'static str, &'static str),
        /// Least ratio.
        low: f64,
        /// Greatest ratio.
        high: f64,
    },
    /// A number follows a trend along cases.
    Follows {
        /// The trend.
        trend: Trend,
        /// The cases, in order.
        cases: Vec<&'static str>,
        /// The number.
        name: &'static str,
    },
    /// Two numbers differ by a factor of `times` or more, whichever is larger.
    Differs {
        /// Case and number.
        of: (&'static str, &'static str),
        /// Case and number.
        from: (&'static str, &'static str),
        /// Least ratio of the larger to the smaller.
        times: f64,
    },
    /// A number's largest value along cases exceeds its smallest by so much.
    Apart {
        /// The cases.
        cases: Vec<&'static str>,
        /// The number.
        name: &'static str,
        /// Least difference, in the number's unit.
        least: f64,
    },
    /// A number's largest value along cases is at least `times` its smallest.
    Changes {
        /// The cases.
        cases: Vec<&'static str>,
        /// The number.
        name: &'static str,
        /// Least ratio.
        times: f64,
    },
}

/// One checkable statement.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Statement {
    /// In words.
    pub words: &'static str,
    /// How it is decided.
    pub check: Check,
}

/// What a verdict is a finding about.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// The motion of the bearing.
    #[default]
    Dynamics,
    /// The shapes that go in, before anything moves.
    Shapes,
    /// Geometry, speed and the cage's slip.
    Kinematics,
    /// What goes in, found again: no evidence, and not counted.
    Given,
}

impl Basis {
    /// As tables say it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Dynamics => "dynamics",
            Self::Shapes => "shapes alone",
            Self::Kinematics => "kinematics and slip",
            Self::Given => "what goes in",
        }
    }
}

/// Another reading of a sentence, under which it may hold.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Otherwise {
    /// "if the RMS includes the start-up".
    pub words: &'static str,
    /// What is checked.
    pub statements: Vec<Statement>,
}

/// A sentence of the paper.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// What its verdict is about.
    #[serde(default)]
    pub basis: Basis,
    /// What the verdict is conditional on, after a comma; may be empty.
    #[serde(default)]
    pub under: &'static str,
    /// Another reading. Where the sentence does not hold as read first and does under this one, it is undecided.
    pub otherwise: Option<Otherwise>,
    /// How tables call it.
    pub id: &'static str,
    /// Where it is: "4.3, Fig. 17".
    pub place: &'static str,
    /// Its words, shortened at most.
    pub sentence: &'static str,
    /// The paper's figures, where it prints any.
    #[serde(default)]
    pub paper: &'static str,
    /// What is checked; none where no number decides the sentence.
    #[serde(default)]
    pub statements: Vec<Statement>,
    /// What to know about it: how it was read, or why it cannot be checked and what was looked at instead.
    #[serde(default)]
    pub note: &'static str,
}

static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(|| {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, bound(deserialize = "'de: 'static"))]
    struct File {
        claim: Vec<Claim>,
    }
    let file: File = crate::data("claims.toml", include_str!("claims.toml"));
    file.claim
});

/// Every claim, in the paper's order.
pub(crate) fn claims() -> impl Iterator<Item = &'static Claim> {
    CLAIMS.iter()
}

impl Check {
    /// Cases that it needs.
    pub fn cases(&self) -> Vec<&'static str> {
        match self {
            Self::Near { case, .. } => vec![*case],
            Self::Greater { of, than } => vec![of.0, than.0],
            Self::Ratio { of, to, .. } => vec![of.0, to.0],
            Self::Differs { of, from, .. } => vec![of.0, from.0],
            Self::Follows { cases, .. } | Self::Changes { cases, .. } | Self::Apart { cases, .. } => cases.clone(),
        }
    }
}

impl Claim {
    /// Whether its verdict is one of those that are counted.
    pub(crate) fn counts(&self) -> bool {
        self.basis != Basis::Given
    }

    /// Cases that it needs.
    pub fn cases(&self) -> Vec<&'static str> {
        let other = self.otherwise.iter().flat_map(|o| &o.statements);
        let mut all: Vec<_> = self.statements.iter().chain(other).flat_map(|s| s.check.cases()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

#[cfg(test)]
mod tests {
    use super::claims;

    /// The paper's running text on one line, without emphasis and the captions that are between its lines. `None` where
    /// it is not beside the project, of which it is no part.
    fn paper() -> Option<String> {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/paper.txt");
        let text = std::fs::read_to_string(path).ok()?;
        let running = |line: &str| match line.trim_start().strip_prefix("Fig. ") {
            Some(_) => String::new(),
            // A caption that follows the end of a column.
            None => match line.find("Fig. 10 Comparisons") {
                Some(at) => line[..at].to_owned(),
                None => line.to_owned(),
            },
        };
        let lines: Vec<String> = text.lines().map(running).collect();
        let text = lines.join(" ").replace('*', "");
        let words: Vec<&str> = text.split_whitespace().collect();
        // Broken at a line's end.
        Some(words.join(" ").replace("inner/ outer", "inner/outer"))
    }

    /// What a sentence quotes: everything but what is in brackets, unless that is a number, as in "Ref. [43]".
    fn quoted(sentence: &str) -> Vec<String> {
        let mut pieces = vec![String::new()];
        for (k, part) in sentence.split('[').enumerate() {
            let (inside, after) = part.split_once(']').unwrap_or(("", part));
            let last = pieces.len() - 1;
            if k == 0 {
                pieces[last].push_str(part);
            } else if inside.bytes().all(|b| b.is_ascii_digit()) {
                pieces[last].push_str(&format!("[{part}"));
            } else {
                pieces.push(after.to_owned());
            }
        }
        let pieces = pieces.iter().map(|piece| piece.trim());
        let said = pieces.filter(|piece| piece.contains(char::is_alphanumeric));
        said.map(str::to_owned).collect()
    }

    #[test]
    fn lit_sentences_are_the_papers_to_the_letter() {
        assert_eq!(quoted("a [x] b [43] c [...], [our words]."), ["a", "b [43] c"]);
        let Some(paper) = paper() else {
            eprintln!("skipped: the paper's text is not beside the project");
            return;
        };
        for claim in claims() {
            let pieces = quoted(claim.sentence);
            assert!(!pieces.is_empty(), "{}", claim.id);
            for piece in pieces {
                assert!(paper.contains(&piece), "{}: {piece:?}", claim.id);
            }
        }
    }
}
