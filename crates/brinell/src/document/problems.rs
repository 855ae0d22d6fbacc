//! Problems as they are gathered: the first of each kind, and how many more there are. A file of a megabyte can have a
//! million of them.

use super::problem::{Place, Problem, Severity};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

/// Problems of a kind that are reported.
pub const MOST_OF_A_KIND: usize = 20;
/// Kinds that are distinguished; those after them count as one.
const MOST_KINDS: usize = 50;

/// Problems of one text.
#[derive(Debug, Clone)]
pub struct Problems<'a> {
    /// Where places count from.
    text: &'a str,
    list: Vec<Problem>,
    kinds: BTreeMap<Cow<'static, str>, Kind>,
}

/// What is known of the problems of a kind.
#[derive(Debug, Clone)]
struct Kind {
    severity: Severity,
    count: usize,
    /// Of the last one that is reported.
    name: String,
}

/// A message without its numbers: two of one kind have the same.
pub fn numberless(message: &str) -> String {
    message.replace(|c: char| c.is_ascii_digit() || ".e+-".contains(c), "")
}

impl<'a> Problems<'a> {
    /// None yet, of a text in which places are looked up.
    pub fn of(text: &'a str) -> Self {
        Self { text, list: Vec::new(), kinds: BTreeMap::new() }
    }

    /// Counts one more of a kind. It is made where it is one of the first alone.
    pub fn add_of(
        &mut self,
        severity: Severity,
        kind: impl Into<Cow<'static, str>>,
        make: impl FnOnce() -> (Problem, Option<Range<usize>>),
    ) {
        let mut kind = kind.into();
        if self.kinds.len() >= MOST_KINDS && !self.kinds.contains_key(&kind) {
            kind = Cow::Borrowed("");
        }
        let kind = self.kinds.entry(kind).or_insert_with(|| Kind { severity, count: 0, name: String::new() });
        kind.count += 1;
        if kind.count > MOST_OF_A_KIND {
            return;
        }
        let (problem, span) = make();
        let problem = match span {
            Some(span) => problem.at(Some(Place::new(self.text, span))),
            None => problem,
        };
        // What is before the first `;` or `:` of a message says what is wrong.
        let what = problem.message.split([';', ':']).next().unwrap_or_default();
        kind.name = match (&*problem.key, problem.line) {
            ("", Some(line)) => format!("line {line}: {what}"),
            (key, _) => format!("{key}: {what}"),
        };
        self.list.push(problem);
    }

    /// Adds a problem at a place; those that differ in numbers alone are of a kind.
    pub(crate) fn add(&mut self, problem: Problem, span: Option<Range<usize>>) {
        let kind = numberless(&problem.key) + &numberless(&problem.message);
        self.add_of(problem.severity, kind, || (problem, span));
    }

    /// Takes back what was added of a key with a message that begins so.
    pub(crate) fn withdraw(&mut self, key: &str, begins: &str) {
        self.list.retain(|problem| problem.key != key || !problem.message.starts_with(begins));
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// In the order of the text, errors first; how many more there are after those of the same severity.
    pub fn finish(mut self) -> Vec<Problem> {
        for kind in self.kinds.into_values() {
            if let Some(more @ 1..) = kind.count.checked_sub(MOST_OF_A_KIND) {
                let message = format!("and {more} more like {}", kind.name);
                let mut rest = Problem::new(kind.severity, "", message);
                rest.count = more;
                self.list.push(rest);
            }
        }
        self.list.sort_by_key(Problem::order);
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_twenty_of_a_kind_are_made_and_the_rest_counted() {
        let text = "a\n".repeat(5000);
        let mut problems = Problems::of(&text);
        let mut made = 0;
        for k in 0..2000 {
            problems.add_of(Severity::Warning, "odd", || {
                made += 1;
                let problem = Problem::new(Severity::Warning, format!("k{k}"), "odd; very");
                (problem, Some(2 * k..2 * k + 1))
            });
        }
        assert_eq!((made, problems.kinds.values().map(|kind| kind.count).sum::<usize>()), (MOST_OF_A_KIND, 2000));
        problems.add(Problem::error("b", "wrong"), None);
        let reported = problems.finish();
        let words: Vec<String> = reported.iter().map(ToString::to_string).collect();
        assert_eq!(words[0], "error: b: wrong");
        assert_eq!(words[1], "warning, line 1: k0: odd; very");
        assert_eq!(words[21], "warning: and 1980 more like k19: odd");
        assert_eq!(reported.iter().map(|p| p.count).sum::<usize>(), 2001);
        assert_eq!(reported.len(), 22);
    }

    #[test]
    fn prop_kinds_without_end_are_few() {
        let mut problems = Problems::of("");
        for a in 'A'..='Z' {
            for b in 'A'..='Z' {
                problems.add(Problem::error(format!("{a}{b}x"), "wrong"), None);
            }
        }
        let reported = problems.finish();
        assert!(reported.len() <= MOST_KINDS + MOST_OF_A_KIND + 1);
        assert_eq!(reported.iter().map(|p| p.count).sum::<usize>(), 26 * 26);
    }
}
