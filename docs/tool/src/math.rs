//! LaTeX to MathML, and the numbering of the paper's equations.
//!
//! `$...$` is a formula in the text, `$$...$$` one of its own; `\tag{24}` gives it the number of the paper's equation,
//! `\tag{25, 26}` two. `[[24]]` and `[[1-20]]` are links to equations. Code is left alone.

use mdbook_preprocessor::book::{Book, BookItem};
use mdbook_preprocessor::errors::{Error, Result};
use mdbook_preprocessor::{Preprocessor, PreprocessorContext};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::mathml::push_mathml;
use pulldown_latex::{Parser, Storage};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Equations of the paper: each is in the book once.
const LAST_EQUATION: u32 = 51;

pub struct Equations;

impl Preprocessor for Equations {
    fn name(&self) -> &str {
        "equations"
    }

    fn run(&self, _: &PreprocessorContext, mut book: Book) -> Result<Book> {
        let mut home: BTreeMap<u32, PathBuf> = BTreeMap::new();
        let mut problems = Vec::new();
        book.for_each_mut(|item| {
            let BookItem::Chapter(chapter) = item else {
                return;
            };
            let Some(path) = chapter.path.clone() else {
                return;
            };
            for number in tags(&chapter.content) {
                if let Some(first) = home.insert(number, path.clone()) {
                    problems.push(format!("Eq. ({number}) is in {} and in {}", first.display(), path.display()));
                }
            }
        });
        let missing = (1..=LAST_EQUATION).filter(|n| !home.contains_key(n));
        problems.extend(missing.map(|n| format!("Eq. ({n}) is missing")));
        book.for_each_mut(|item| {
            let BookItem::Chapter(chapter) = item else {
                return;
            };
            let Some(path) = chapter.path.clone() else {
                return;
            };
            let mut page = Page { path: &path, home: &home, out: String::new(), problems: &mut problems };
            page.convert(&chapter.content);
            chapter.content = page.out;
        });
        if problems.is_empty() { Ok(book) } else { Err(Error::msg(problems.join("\n"))) }
    }
}

/// Numbers in the tags of a chapter.
fn tags(text: &str) -> Vec<u32> {
    text.split("\\tag{").skip(1).filter_map(|rest| rest.split_once('}')).flat_map(|(list, _)| numbers(list)).collect()
}

/// `24`, `3, 8` or `1-20`, which gives its ends.
fn numbers(list: &str) -> Vec<u32> {
    list.split([',', '-']).filter_map(|n| n.trim().parse().ok()).collect()
}

struct Page<'a> {
    path: &'a Path,
    home: &'a BTreeMap<u32, PathBuf>,
    out: String,
    problems: &'a mut Vec<String>,
}

impl Page<'_> {
    fn convert(&mut self, text: &str) {
        let mut rest = text;
        while let Some(at) = rest.find(['`', '$', '[', '\\']) {
            self.out.push_str(&rest[..at]);
            rest = &rest[at..];
            rest = self.token(rest);
        }
        self.out.push_str(rest);
    }

    /// Converts what begins here and gives what follows it.
    fn token<'t>(&mut self, text: &'t str) -> &'t str {
        if text.starts_with('`') {
            let run = text.len() - text.trim_start_matches('`').len();
            let fence = &text[..run];
            let end = text[run..].find(fence).map_or(text.len(), |at| at + 2 * run);
            self.out.push_str(&text[..end]);
            return &text[end..];
        }
        if let Some(after) = text.strip_prefix("\\$") {
            self.out.push('$');
            return after;
        }
        if let Some((latex, after)) = text.strip_prefix("$$").and_then(|t| t.split_once("$$")) {
            self.display(latex);
            return after;
        }
        if let Some((latex, after)) = text.strip_prefix('$').and_then(|t| t.split_once('$')) {
            let math = self.mathml(latex, DisplayMode::Inline);
            // No line begins with the comma behind a formula.
            let mark = after.len() - after.trim_start_matches([')', ',', '.', ';', ':', '?']).len();
            self.out.push_str(&format!("<span class=\"inline\">{math}{}</span>", &after[..mark]));
            return &after[mark..];
        }
        if let Some((list, after)) = text.strip_prefix("[[").and_then(|t| t.split_once("]]")) {
            let all = numbers(list);
            if !all.is_empty() && list.chars().all(|c| c.is_ascii_digit() || ", -".contains(c)) {
                self.reference(list, &all);
                return after;
            }
        }
        let first = text.chars().next().map_or(0, char::len_utf8);
        self.out.push_str(&text[..first]);
        &text[first..]
    }

    fn reference(&mut self, list: &str, all: &[u32]) {
        let Some(home) = self.home.get(&all[0]) else {
            self.problems.push(format!("{}: no Eq. ({})", self.path.display(), all[0]));
            return;
        };
        let up = "../".repeat(self.path.components().count() - 1);
        let name = if all.len() == 1 { "Eq." } else { "Eqs." };
        let shown = list.replace(", ", "), (").replace('-', ")–(");
        self.out.push_str(&format!("[{name}\u{a0}({shown})]({up}{}#eq-{})", home.display(), all[0]));
    }

    fn display(&mut self, latex: &str) {
        let (formula, number) = match latex.split_once("\\tag{") {
            Some((before, rest)) => {
                let (list, after) = rest.split_once('}').unwrap_or((rest, ""));
                (format!("{before}{after}"), Some(list))
            }
            None => (latex.to_owned(), None),
        };
        let math = self.mathml(&formula, DisplayMode::Block);
        let all = number.map(numbers).unwrap_or_default();
        let anchors: String = all.iter().map(|n| format!("<span id=\"eq-{n}\"></span>")).collect();
        let shown =
            number.map_or(String::new(), |n| format!("<span class=\"number\">({})</span>", n.replace(", ", "), (")));
        self.out
            .push_str(&format!("<div class=\"equation\">{anchors}<div class=\"formula\">{math}</div>{shown}</div>"));
    }

    /// On one line, with nothing in it that Markdown would take for its own.
    fn mathml(&mut self, latex: &str, display_mode: DisplayMode) -> String {
        let storage = Storage::new();
        let mut math = String::new();
        let config = RenderConfig { display_mode, ..RenderConfig::default() };
        let done = push_mathml(&mut math, Parser::new(latex.trim(), &storage), config);
        // pulldown-latex 0.8.0 escapes the entity that it means, takes the micro sign for mu, and sets a slash as an
        // operator.
        let math = math.replace("&amp;nbsp;", "\u{a0}").replace('\u{b5}', "\u{3bc}");
        let math = math.replace("<mo>/</mo>", "<mo lspace=\"0\" rspace=\"0\">/</mo>");
        if done.is_err() || math.contains("<merror") {
            self.problems.push(format!("{}: not LaTeX that can be shown: {latex}\n{math}", self.path.display()));
        }
        let mut out = String::new();
        let mut in_tag = false;
        for c in math.chars() {
            match c {
                '<' => in_tag = true,
                '>' => in_tag = false,
                _ => {}
            }
            match c {
                '\n' => out.push(' '),
                '*' | '_' | '[' | ']' | '|' | '\\' | '~' | '`' | '!' | '#' if !in_tag => {
                    out.push_str(&format!("&#{};", c as u32))
                }
                c => out.push(c),
            }
        }
        out
    }
}
