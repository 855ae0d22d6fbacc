//! The reproduction as a chapter's text: Markdown, pictures beside it.

use crate::outcome::{Outcome, counts, not_counted, ours};
use crate::reproduction::Reproduction;
use brinell_report::{Chapter, Page, Piece, Table};
use std::fmt::Write as _;
use std::path::Path;

/// How the text's first line begins, and its last line: a page that has both holds it between them.
const BEGIN: &str = "<!-- Written by `brinell reproduce";
const END: &str = "<!-- End of what is written. -->\n";

/// A page with the text in the place of the one that it holds; `None` of a page that holds none.
pub(crate) fn within(page: &str, text: &str) -> Option<String> {
    let (before, rest) = page.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{text}{after}"))
}

/// The text. Pictures are linked as from the folder above `book`, where the page that holds it is.
pub(crate) fn text(study: &Page, reproduction: &Reproduction, book: &Path) -> String {
    let folder = book.file_name().map_or(String::new(), |name| format!("{}/", name.to_string_lossy()));
    let beside = reproduction.beside.is_some();
    let laws = if beside { " --laws mechanics" } else { "" };
    let mut text = format!("{BEGIN}{laws} --book`; edits are lost. -->\n\n");
    let counts: Vec<String> =
        counts(&reproduction.outcomes).iter().map(|(verdict, n)| format!("{} {n}", verdict.words())).collect();
    let rest = not_counted(&reproduction.outcomes);
    let _ = match beside {
        // Its chapter counts by itself.
        true => writeln!(text, "{}.\n", study.subtitle),
        false => writeln!(text, "{}. Claims: {}.{rest}\n", study.subtitle, counts.join(", ")),
    };
    for warning in &study.warnings {
        let _ = writeln!(text, "> {warning}\n");
    }
    // The chapter on other laws has no figures.
    let shown = |chapter: &&Chapter| !beside || ["survives", "beside", "rules"].contains(&chapter.id.as_str());
    for chapter in study.chapters.iter().filter(shown) {
        if !chapter.title.is_empty() {
            let _ = writeln!(text, "## {}\n", chapter.title);
        }
        for piece in &chapter.pieces {
            match piece {
                Piece::Words(words) | Piece::Note(words) => {
                    let _ = writeln!(text, "{words}\n");
                }
                Piece::Claims(_) => claims(&mut text, &reproduction.outcomes),
                Piece::Table(one) => table(&mut text, one),
                Piece::Curves(one, _) => picture(&mut text, &folder, &one.name, &one.title),
                Piece::Stack(one) => {
                    picture(&mut text, &folder, &one.name, &one.title);
                    if !one.note.is_empty() {
                        let _ = writeln!(text, "{}\n", one.note);
                    }
                }
                Piece::Plan(name, view) => picture(&mut text, &folder, name, &view.plan_title),
                Piece::Trend(plot) => picture(&mut text, &folder, &plot.name, &plot.label),
                Piece::Code(toml) => {
                    let _ = writeln!(text, "```toml\n{toml}```\n");
                }
                // What a reproduction has not; its failures are among its warnings.
                // The chapter has no other pieces.
                _ => {}
            }
        }
    }
    text.push_str(END);
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

#[cfg(test)]
mod tests {
    use super::{cell, table, within};
    use crate::figures::figures;
    use crate::sensitivity::{intro, ranges};
    use crate::{BASE, EXPERIMENTS, Length, Request, VARIANTS, claims, page};
    use brinell::scenario::Laws;
    use brinell_report::Table;

    /// The book's chapter; `None` where the book is not beside the crate.
    fn chapter() -> Option<String> {
        let book = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src");
        book.is_dir().then(|| std::fs::read_to_string(book.join("reproduction.md")).unwrap())
    }

    fn written(one: &Table) -> String {
        let mut text = String::new();
        table(&mut text, one);
        text
    }

    /// What the program writes without a run, piece by piece.
    fn pieces() -> Vec<String> {
        let mut all: Vec<String> =
            page::rules(Length::FULL, Laws::Li2023).iter().map(|words| format!("\n{words}\n")).collect();
        all.push(format!("```toml\n{BASE}```\n"));
        all.push(format!("\n{}\n", intro(Length::VARIANT)));
        all.push(written(&ranges()));
        all.push(written(&page::runs(&Request::new(&[], Length::FULL, Laws::Li2023).unwrap())));
        for experiment in EXPERIMENTS.iter() {
            all.push(format!("\n## {}: {}\n\n{}\n", figures(experiment), experiment.title, experiment.words));
        }
        for (k, variant) in VARIANTS.iter().enumerate() {
            all.push(format!("\n| {k} | {} | {} | ", cell(variant.about), cell(variant.words)));
        }
        all
    }

    #[test]
    fn prop_a_page_takes_the_text_between_its_marks() {
        let page = "# Title\n\n<!-- Written by `brinell reproduce --book`; edits are lost. -->\n\nold\n\n<!-- End of what is written. -->\n\n## More\n";
        assert_eq!(within(page, "new\n").as_deref(), Some("# Title\n\nnew\n\n## More\n"));
        assert_eq!(within("# Title\n", "new\n"), None);
        // The book's own has marks.
        assert!(chapter().is_none_or(|page| within(&page, "").is_some()));
    }

    #[test]
    fn prop_the_books_chapter_is_what_the_program_writes() {
        let Some(text) = chapter() else {
            eprintln!("skipped: the book is not beside the crate");
            return;
        };
        let again = "write it again: brinell reproduce --sensitivity --book docs/src/reproduction";
        let mut missing = pieces();
        missing.retain(|piece| !text.contains(piece));
        let rows = text.split("## The paper’s claims").nth(1).and_then(|rest| rest.split("\n## ").next()).unwrap();
        let rows: Vec<&str> = rows.lines().filter(|line| line.starts_with("| ")).skip(2).collect();
        assert_eq!(rows.len(), claims().count(), "{again}");
        for (row, claim) in rows.into_iter().zip(claims()) {
            assert!(row.starts_with(&format!("| {} ({}) | ", cell(claim.sentence), claim.place)), "{again}\n{row}");
            let other = claim.otherwise.iter().flat_map(|other| &other.statements);
            let statements = claim.statements.iter().chain(other).map(|statement| format!("{} — ", statement.words));
            let parts = statements.chain([claim.note.to_owned(), format!(" | {} | ", claim.paper)]);
            let parts = parts.filter(|part| !(row.contains(&cell(part)) || row.contains(part)));
            missing.extend(parts.map(|part| format!("{}: {part}", claim.id)));
        }
        assert!(missing.is_empty(), "{again}\n{}", missing.join("\n"));
    }
}
