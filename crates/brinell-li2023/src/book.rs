//! The reproduction as a chapter's text: Markdown, pictures beside it.

use crate::outcome::{Outcome, counts, not_counted, ours};
use crate::reproduction::Reproduction;
use brinell_report::{Study, StudyPiece, Table};
use std::fmt::Write as _;
use std::path::Path;

/// The text. Pictures are linked as from the folder above `book`, where the file that includes this one is.
pub(crate) fn text(study: &Study, reproduction: &Reproduction, book: &Path) -> String {
    let folder = book.file_name().map_or(String::new(), |name| format!("{}/", name.to_string_lossy()));
    let mut text = String::from("<!-- Written by `brinell reproduce --book`; edits are lost. -->\n\n");
    let counts: Vec<String> =
        counts(&reproduction.outcomes).iter().map(|(verdict, n)| format!("{} {n}", verdict.words())).collect();
    let rest = not_counted(&reproduction.outcomes);
    let _ = writeln!(text, "{}. Claims: {}.{rest}\n", study.subtitle, counts.join(", "));
    for warning in &study.warnings {
        let _ = writeln!(text, "> {warning}\n");
    }
    for chapter in &study.chapters {
        let _ = writeln!(text, "## {}\n", chapter.title);
        for piece in &chapter.pieces {
            match piece {
                StudyPiece::Words(words) | StudyPiece::Note(words) => {
                    let _ = writeln!(text, "{words}\n");
                }
                StudyPiece::Claims(_) => claims(&mut text, &reproduction.outcomes),
                StudyPiece::Table(one) => table(&mut text, one),
                StudyPiece::Curves(one, _) => picture(&mut text, &folder, &one.name, &one.title),
                StudyPiece::Stack(one) => {
                    picture(&mut text, &folder, &one.name, &one.title);
                    if !one.note.is_empty() {
                        let _ = writeln!(text, "{}\n", one.note);
                    }
                }
                StudyPiece::Plan(name, view) => picture(&mut text, &folder, name, &view.plan_title),
                StudyPiece::Trend(plot) => picture(&mut text, &folder, &plot.name, &plot.label),
                StudyPiece::Code(toml) => {
                    let _ = writeln!(text, "```toml\n{toml}```\n");
                }
                // What a reproduction has not; its failures are among its warnings.
                StudyPiece::Map(_)
                | StudyPiece::Misfit(..)
                | StudyPiece::Course(_)
                | StudyPiece::Facts(_)
                | StudyPiece::Failures(..) => {}
            }
        }
    }
    text
}

fn picture(text: &mut String, folder: &str, name: &str, words: &str) {
    let _ = writeln!(text, "![{words}]({folder}{name}.svg)\n");
}

fn cell(words: &str) -> String {
    words.replace('|', "\\|").replace(['\n', '\r'], " ")
}

fn claims(text: &mut String, all: &[Outcome]) {
    text.push_str("| The paper | Verdict | Printed | Ours |\n| --- | --- | --- | --- |\n");
    for outcome in all {
        let mut lines = Vec::new();
        for (words, verdict, found) in outcome.statements() {
            lines.push(format!("{words} — {}: {}", verdict.words(), ours(found)));
        }
        if !outcome.claim.note.is_empty() {
            lines.push(outcome.claim.note.to_owned());
        }
        let mut verdict = outcome.judged.words(outcome.claim);
        let depends = outcome.depends();
        if !depends.is_empty() {
            verdict = format!("{verdict}; depends on {depends}");
        }
        let _ = writeln!(
            text,
            "| {} ({}) | {} | {} | {} |",
            cell(outcome.claim.sentence),
            outcome.claim.place,
            cell(&verdict),
            cell(outcome.claim.paper),
            lines.iter().map(|o| cell(o)).collect::<Vec<_>>().join("<br>")
        );
    }
    text.push('\n');
}

fn table(text: &mut String, table: &Table) {
    let _ = writeln!(text, "### {}\n", table.title);
    let heads: Vec<String> = table.columns.iter().map(|c| cell(c.trim_start_matches('#'))).collect();
    let rule = |c: &String| if c.starts_with('#') { "---:" } else { "---" };
    let rules: Vec<&str> = table.columns.iter().map(rule).collect();
    let _ = writeln!(text, "| {} |\n| {} |", heads.join(" | "), rules.join(" | "));
    for row in &table.rows {
        let cells: Vec<String> = row.iter().map(|c| cell(c)).collect();
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text.push('\n');
    if !table.note.is_empty() {
        let _ = writeln!(text, "{}\n", table.note);
    }
}
