//! What sections 3 to 5 say, sentence by sentence.

mod defects;
mod models;
mod operation;

use crate::claim::{Check, Claim, Statement};
use crate::verdict::Trend;

/// Every claim, in the paper's order.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    let operation = operation::CLAIMS.iter().chain(models::CLAIMS);
    defects::CLAIMS.iter().chain(operation)
}

const fn so(words: &'static str, check: Check) -> Statement {
    Statement { words, check }
}

/// A trend of a number.
const fn trend(
    words: &'static str,
    name: &'static str,
    trend: Trend,
    cases: &'static [&'static str],
) -> Statement {
    so(words, Check::Follows { trend, cases, name })
}

const fn greater(
    words: &'static str,
    of: (&'static str, &'static str),
    than: (&'static str, &'static str),
) -> Statement {
    so(words, Check::Greater { of, than })
}

#[cfg(test)]
mod tests {
    use super::claims;

    /// The paper's running text on one line, without emphasis and the captions that stand between its lines. `None` where it is not beside the
    /// project, of which it is no part.
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

    /// What a sentence quotes: everything but what stands in brackets, unless that is a number, as in "Ref. [43]".
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
        assert_eq!(
            quoted("a [x] b [43] c [...], [our words]."),
            ["a", "b [43] c"]
        );
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
