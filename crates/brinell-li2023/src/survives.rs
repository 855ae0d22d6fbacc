//! "What survives": ten sentences to quote, what the paper's sentences come to under other laws than its own. Their
//! numbers and verdicts are taken from what was computed; what was not is left out.

use crate::beside::{Change, Joined, brief, found, table};
use brinell_report::{Chapter, Piece};

/// The chapters: the sentences, and the table behind them.
pub(crate) fn chapters(all: &[Joined]) -> Vec<Chapter> {
    let mut pieces = vec![Piece::Words(found(all))];
    let sentences = Facts(all).sentences();
    if sentences.is_empty() {
        pieces.push(Piece::Words("Too little was run for a sentence.".into()));
    }
    let numbered = sentences.iter().enumerate().map(|(k, words)| format!("{}. {words}", k + 1));
    pieces.extend(numbered.map(Piece::Words));
    vec![
        Chapter::new("survives", "What survives", "What survives", pieces),
        Chapter::table("beside", "Side by side", table(all)),
    ]
}

struct Facts<'a>(&'a [Joined]);

/// Statements of two directions of the rings.
const OUTER_X: &str = "RMS of the outer ring, x";
const OUTER_Y: &str = "RMS of the outer ring, y";
const LARGEST: &str = "RMS of the outer ring, x: largest at least 1.5 times the smallest";

impl Facts<'_> {
    fn sentences(&self) -> Vec<String> {
        let all = [
            self.acceleration(),
            self.impacts(),
            self.size(),
            self.entry_and_exit(),
            self.width(),
            self.directions(),
            self.frequency(),
            self.speed(),
            self.load(),
            self.models(),
        ];
        all.into_iter().flatten().collect()
    }

    fn joined(&self, id: &str) -> Option<&Joined> {
        self.0.iter().find(|joined| joined.claim.id == id)
    }

    /// "it is reversed and does not hold (li2023: holds; with default values: holds in part)".
    fn verdict(&self, id: &str) -> Option<String> {
        let Joined { paper, own, defaults, .. } = self.joined(id)?;
        Some(changed(&paper.verdict, &own.verdict, &defaults.verdict))
    }

    /// A statement's place in its claim.
    fn place(&self, id: &str, statement: &str) -> Option<(&Joined, usize)> {
        let joined = self.joined(id)?;
        let at = joined.own.statements.iter().position(|s| s.statement == statement)?;
        Some((joined, at))
    }

    /// Numbers of a statement, and those under the paper's laws: "18.5 [18.3, 18.7] (li2023: 15.6 [15.5, 15.7])".
    fn numbers(&self, id: &str, statement: &str) -> Option<String> {
        let (joined, at) = self.place(id, statement)?;
        let [paper, own] = [joined.paper, &joined.own].map(|all| brief(&all.statements[at].ours));
        Some(format!("{own} (li2023: {paper})"))
    }

    /// Those under the laws of mechanics alone.
    fn own(&self, id: &str, statement: &str) -> Option<String> {
        let (joined, at) = self.place(id, statement)?;
        Some(brief(&joined.own.statements[at].ours))
    }

    /// The same with the default values of the laws.
    fn defaults(&self, id: &str, statement: &str) -> Option<String> {
        let (joined, at) = self.place(id, statement)?;
        Some(brief(&joined.defaults.statements[at].ours))
    }

    fn statement_verdict(&self, id: &str, statement: &str) -> Option<String> {
        let (joined, at) = self.place(id, statement)?;
        let [paper, own, defaults] =
            [joined.paper, &joined.own, &joined.defaults].map(|all| &all.statements[at].verdict);
        Some(changed(paper, own, defaults))
    }

    fn acceleration(&self) -> Option<String> {
        let id = "simplified-acceleration";
        Some(format!(
            "The outer ring’s RMS with the simplified shape is along the load {} times that with the irregular one, across it {} times. That the \
             simplified shape gives more (4.2): {}.",
            self.numbers(id, OUTER_X)?,
            self.numbers(id, OUTER_Y)?,
            self.verdict(id)?
        ))
    }

    fn impacts(&self) -> Option<String> {
        let id = "impact-peak";
        Some(format!(
            "A roller’s impact is with the simplified shape after entry {} times as high, after exit {} times. That the simplified shape’s peak is the \
             greater (4.2): {}.",
            self.numbers(id, "mean peak after entry")?,
            self.numbers(id, "mean peak after exit")?,
            self.verdict(id)?
        ))
    }

    fn size(&self) -> Option<String> {
        let (id, size) = ("reference-defect-higher", "by 0 to 10 %, as the printed 5.4 %");
        let defaults = self.defaults(id, size)?;
        let apart = match (interval(&self.own(id, size)?), interval(&defaults)) {
            (Some(a), Some(b)) => a.0 > b.1 || b.0 > a.1,
            _ => false,
        };
        let end = if apart { " What the ring is mounted in sets the size: quote none without it." } else { "" };
        Some(format!(
            "That factor, printed as 1.054 (4.5), is {} with the outer ring alone on its support, and {defaults} with the default values of these laws, \
             among them a housing of 20 times the ring’s mass. That it lies within 10 %: {}.{end}",
            self.numbers(id, size)?,
            self.statement_verdict(id, size)?
        ))
    }

    fn entry_and_exit(&self) -> Option<String> {
        let id = "entry-exit-similar";
        Some(format!(
            "The peak after entry is {} times that after exit with the simplified shape, {} times with the irregular one. Similar (4.2): {}; \
             different (conclusion 3): {}.",
            self.numbers(id, "simplified: mean peaks after entry and exit within a factor of 1.5")?,
            self.numbers(id, "irregular: mean peaks after entry and exit within a factor of 1.5")?,
            self.verdict(id)?,
            self.verdict("entry-exit-different")?
        ))
    }

    fn width(&self) -> Option<String> {
        let id = "width-rms";
        Some(format!(
            "From 3 to 4 to 5 mm of greatest width the outer ring’s RMS along the load is {}, across it {}. That the rings’ RMS rises with the width \
             (4.3): {}.",
            self.own(id, OUTER_X)?,
            self.own(id, OUTER_Y)?,
            self.verdict(id)?
        ))
    }

    fn directions(&self) -> Option<String> {
        let id = "x-above-y";
        Some(format!(
            "With the 4 mm defect the RMS along the load is {} times that across it for the outer ring, {} times for the inner one. That it is the \
             larger at every width (4.3): {}.",
            self.numbers(id, "RMS of the outer ring, 4 mm")?,
            self.numbers(id, "RMS of the inner ring, 4 mm")?,
            self.verdict(id)?
        ))
    }

    fn frequency(&self) -> Option<String> {
        let id = "frequency";
        Some(format!(
            "The defect frequency with the irregular shape is {}, where the paper simulates 249.40 Hz and measures 250.21 Hz; {} with the cage guided \
             by its rollers, without a film, the default of these laws. That all six agree within 0.55 % (4.1): {}; that the shapes’ lie half a hertz \
             apart: {}.",
            self.numbers(id, "irregular: within 0.55 % of the simulated 249.40 Hz")?,
            self.defaults(id, "irregular: within 0.55 % of the simulated 249.40 Hz")?,
            self.verdict(id)?,
            self.verdict("frequency-differences")?
        ))
    }

    fn speed(&self) -> Option<String> {
        let id = "speed-rings";
        Some(format!(
            "At 1000, 2000, 3000, 4000 and 5000 r/min the outer ring’s RMS along the load is {}, largest over smallest {}. That the rings’ rises and \
             then falls (4.4): {}; that the cage’s rises: {}.",
            self.own(id, OUTER_X)?,
            self.numbers("speed-matters", LARGEST)?,
            self.verdict(id)?,
            self.verdict("speed-cage")?
        ))
    }

    fn load(&self) -> Option<String> {
        let id = "load-outer-x";
        Some(format!(
            "At 500, 1000, 1500, 2000 and 2500 N the outer ring’s RMS along the load is {}, largest over smallest {}. That it rises and then falls \
             (4.4): {}; that the one across rises: {}; that the inner ring’s rise: {}; that the cage’s rise and then fall: {}.",
            self.own(id, OUTER_X)?,
            self.numbers("load-matters", LARGEST)?,
            self.verdict(id)?,
            self.verdict("load-outer-y")?,
            self.verdict("load-inner")?,
            self.verdict("load-cage")?
        ))
    }

    fn models(&self) -> Option<String> {
        let id = "full-above-reference";
        Some(format!(
            "The outer ring’s RMS along the load by the full model is {} times that by the reference model, which has the paper’s laws under either \
             set, each with its own defect, and {} times with the irregular defect in both. That the full model gives more (4.5): {}.",
            self.numbers(id, "larger, each with its own defect")?,
            self.numbers(id, "larger, both with the irregular defect")?,
            self.verdict(id)?
        ))
    }
}

/// The interval behind a value: "18.5 [18.3, 18.7]".
fn interval(numbers: &str) -> Option<(f64, f64)> {
    let (_, rest) = numbers.split_once('[')?;
    let (low, rest) = rest.split_once(", ")?;
    let (high, _) = rest.split_once(']')?;
    Some((low.parse().ok()?, high.parse().ok()?))
}

/// A verdict and what becomes of it, and what it is with default values where that is another: "holds, as under li2023".
fn changed(paper: &str, own: &str, defaults: &str) -> String {
    let decided = |words: &str| words.replacen("undecided", "not decided", 1);
    let more = match Change::between(own, defaults) {
        Change::Same => String::new(),
        _ if decided(own) == decided(defaults) => String::new(),
        _ => format!("; with default values: {}", decided(defaults)),
    };
    let own_words = decided(own);
    match Change::between(paper, own) {
        Change::Same => format!("{own_words}, as under li2023{more}"),
        Change::TurnsOver => format!("it is reversed and {own_words} (li2023: {paper}{more})"),
        Change::Changes | Change::NotDecided => format!("{own_words} (li2023: {}{more})", decided(paper)),
        Change::Missing => "not computed".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beside::join;
    use crate::numbers::exact;
    use crate::outcome::Outcome;
    use crate::{Numbers, claims, judge};

    #[test]
    fn prop_ten_sentences_each_with_its_numbers_and_its_verdict() {
        let mut numbers = Numbers::default();
        let cases = claims().flat_map(|claim| claim.cases()).collect::<std::collections::BTreeSet<_>>();
        for case in cases {
            for channel in ["outer_ax", "outer_ay", "inner_ax", "inner_ay", "cage1_ax", "cage1_ay"] {
                for indicator in ["rms", "peak_to_peak"] {
                    numbers.insert(case, &format!("{channel}.{indicator}"), exact(3.25));
                }
            }
            for name in ["entry_peak", "exit_peak", "frequency"] {
                numbers.insert(case, &format!("defect1.{name}"), exact(3.25));
            }
        }
        let outcome = |claim| Outcome { claim, judged: judge(claim, &numbers), flips: vec![], unchanged: None };
        let all: Vec<Outcome> = claims().map(outcome).collect();
        let sentences = Facts(&join(&all, &numbers)).sentences();
        assert_eq!(sentences.len(), 10);
        for sentence in &sentences {
            assert!(sentence.contains("li2023") && !sentence.contains("–"), "{sentence}");
        }
        assert!(
            sentences[0].contains("is along the load 1.000 (li2023: 15.62 [15.49, 15.74]) times"),
            "{}",
            sentences[0]
        );
        assert!(sentences[0].ends_with("it is reversed and does not hold (li2023: holds)."), "{}", sentences[0]);
        assert!(Facts(&[]).sentences().is_empty());
        assert_eq!(interval("18.5 [18.3, 18.7]"), Some((18.3, 18.7)));
        assert_eq!(interval("18.5"), None);
        assert_eq!(
            changed("holds", "undecided: in part", "fails"),
            "not decided: in part (li2023: holds; with default values: fails)"
        );
    }
}
