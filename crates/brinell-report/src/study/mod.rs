//! The page of several runs or signals: chapters of curves, trends, tables, and claims with their verdicts. What they are
//! is the caller's.

use std::fmt::Write as _;

use crate::damage::{DamageView, damage_plan};
use crate::data::Tone;
use crate::fact::Fact;
use crate::frame::{close, code, contents, figure, lead, none, open, plain, section, unit_html};
use crate::layout::Layout;
use crate::markup::escape;
use crate::misfit::{Tried, course_plot, embed_course, embed_key, key_plot};
use crate::overlay::{Overlay, overlay, stacked};
use crate::picture::Picture;
use crate::sweep::{self, HeatMap, IndicatorPlot, heat_map, indicator_plot};
use crate::tables::{Table, fact_table, facts, failures, table};
use brinell_study::calibrate::Found;

/// A word with its colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tagged {
    /// "holds".
    pub word: String,
    /// Its colour.
    pub tone: Tone,
}

/// A statement under a claim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClaimPart {
    /// What came out.
    pub verdict: Tagged,
    /// What is stated.
    pub words: String,
    /// The numbers behind the verdict.
    pub ours: String,
}

/// A sentence, compared with numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClaimCard {
    /// Where it is.
    pub place: String,
    /// Its words.
    pub sentence: String,
    /// What its author prints; may be empty.
    pub printed: String,
    /// What came out.
    pub verdict: Tagged,
    /// What it depends on; may be empty.
    pub depends: String,
    /// What was checked.
    pub parts: Vec<ClaimPart>,
    /// What to know; may be empty.
    pub note: String,
}

/// A piece of a chapter.
#[derive(Clone, Debug, PartialEq)]
pub enum StudyPiece {
    /// A paragraph.
    Words(String),
    /// A paragraph in grey: what marks mean, or why something is missing.
    Note(String),
    /// Curves, and the names that they belong to.
    Curves(Overlay, Vec<String>),
    /// Plots one below the other.
    Stack(Stack),
    /// Damage from above, under the name of the picture's file.
    Plan(String, Box<DamageView>),
    /// Numbers with intervals against a quantity.
    Trend(IndicatorPlot),
    /// Numbers over two quantities.
    Map(HeatMap),
    /// The misfit of the runs of a calibration over a key.
    Misfit(Found, Vec<Tried>),
    /// The misfit of the runs of a calibration in their order.
    Course(Vec<f64>),
    /// Words and numbers; its title is a heading.
    Table(Table),
    /// Numbers, a line each, with what is to be said of them.
    Facts(Vec<Fact>),
    /// What failed, and why. First what one of them is called: "File".
    Failures(String, Vec<(String, String)>),
    /// Text as written in a file.
    Code(String),
    /// Claims.
    Claims(Vec<ClaimCard>),
}

/// Plots one below the other: curves that would hide one another, or the panels of one figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stack {
    /// Name of the picture's file.
    pub name: String,
    /// Over all of them.
    pub title: String,
    /// The plots, each under its title.
    pub panels: Vec<Overlay>,
    /// What the curves belong to.
    pub names: Vec<String>,
    /// Whether all have the same axes.
    pub alike: bool,
    /// Under them; may be empty.
    pub note: String,
}

/// A heading and what is under it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chapter {
    /// Its place in links: letters, digits, hyphens.
    pub id: String,
    /// In the list of contents.
    pub short: String,
    /// The heading; empty where a table brings its own.
    pub title: String,
    /// In this order.
    pub pieces: Vec<StudyPiece>,
}

impl Chapter {
    /// With its pieces.
    pub fn new(id: &str, short: &str, title: &str, pieces: Vec<StudyPiece>) -> Self {
        Self { id: id.into(), short: short.into(), title: title.into(), pieces }
    }

    /// A table and no more, under its own heading.
    pub fn table(id: &str, short: &str, table: Table) -> Self {
        Self::new(id, short, "", vec![StudyPiece::Table(table)])
    }

    /// What failed, where anything did: name and reason of each. `each` is what one of them is called: "File".
    pub fn failures(title: &str, each: &str, all: Vec<(String, String)>) -> Option<Self> {
        let some = !all.is_empty();
        some.then(|| Self::new("failures", "Failed", title, vec![StudyPiece::Failures(each.into(), all)]))
    }
}

/// Everything that the page shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Study {
    /// Heading of the page.
    pub title: String,
    /// One line under it.
    pub subtitle: String,
    /// Whether signals were analysed; else runs were simulated.
    pub analysed: bool,
    /// The version of the program.
    pub version: String,
    /// What deserves attention.
    pub warnings: Vec<String>,
    /// The result in a sentence; may be empty.
    pub lead: String,
    /// Headline numbers.
    pub facts: Vec<Fact>,
    /// The chapters.
    pub chapters: Vec<Chapter>,
    /// At the end.
    pub footer: String,
}

/// The page's pictures, for saving as files.
pub fn study_pictures(study: &Study, layout: Layout) -> Vec<Picture> {
    let pieces = study.chapters.iter().flat_map(|chapter| &chapter.pieces);
    layout.finished(pieces.filter_map(|piece| draw(piece, layout)).collect())
}

fn draw(piece: &StudyPiece, layout: Layout) -> Option<Picture> {
    match piece {
        StudyPiece::Curves(one, names) => Some(overlay(one, names, layout).picture()),
        StudyPiece::Stack(s) => {
            let panels = stacked(&s.name, &s.title, &s.panels, &s.names, s.alike, layout);
            Some(panels)
        }
        StudyPiece::Plan(name, view) => {
            let mut picture = damage_plan(view, 0, layout);
            picture.name.clone_from(name);
            Some(picture)
        }
        StudyPiece::Trend(plot) => Some(indicator_plot(plot, layout)),
        StudyPiece::Map(map) => heat_map(map, layout),
        StudyPiece::Misfit(key, tried) => Some(key_plot(key, tried, layout)),
        StudyPiece::Course(chi_squares) => Some(course_plot(chi_squares, layout)),
        StudyPiece::Words(_)
        | StudyPiece::Note(_)
        | StudyPiece::Table(_)
        | StudyPiece::Facts(_)
        | StudyPiece::Failures(..)
        | StudyPiece::Code(_)
        | StudyPiece::Claims(_) => None,
    }
}

/// The self-contained page.
pub fn study_html(study: &Study) -> String {
    let done = if study.analysed { "Analysed" } else { "Simulated" };
    let mut page = open(&study.title, &study.subtitle, (done, &study.version), plain(&study.warnings));
    contents(&mut page, study.chapters.iter().map(|chapter| (&*chapter.id, &*chapter.short)));
    lead(&mut page, &study.lead);
    facts(&mut page, &study.facts);
    let mut count = 0;
    for chapter in &study.chapters {
        section(&mut page, &chapter.id, &chapter.title, |page| {
            for piece in &chapter.pieces {
                count += 1;
                write_piece(page, piece, count);
            }
        });
    }
    close(page, &study.footer, &[])
}

fn write_piece(page: &mut String, piece: &StudyPiece, count: usize) {
    let (title, caption) = match piece {
        StudyPiece::Words(words) => {
            let _ = writeln!(page, "<p>{}</p>", escape(words));
            return;
        }
        StudyPiece::Note(words) => return none(page, &escape(words)),
        StudyPiece::Table(one) => return table(page, one),
        StudyPiece::Facts(all) => return fact_table(page, all, ""),
        StudyPiece::Failures(each, all) => return failures(page, each, all),
        StudyPiece::Code(text) => return code(page, text),
        StudyPiece::Claims(cards) if cards.is_empty() => {
            return none(page, "No claim belongs to what was run.");
        }
        StudyPiece::Claims(cards) => return cards.iter().for_each(|card| claim(page, card)),
        StudyPiece::Curves(one, _) => (escape(&one.title), escape(&one.note)),
        StudyPiece::Stack(stack) => (escape(&stack.title), escape(&stack.note)),
        // Its title is in the picture.
        StudyPiece::Plan(..) => (String::new(), String::new()),
        StudyPiece::Trend(plot) => (escape(&plot.label), String::new()),
        StudyPiece::Map(map) if map.unit.is_empty() => (escape(&map.label), String::new()),
        StudyPiece::Map(map) => (format!("{} ({})", escape(&map.label), unit_html(&map.unit)), String::new()),
        StudyPiece::Misfit(key, _) => (format!("<code>{}</code>", escape(&key.key.name)), String::new()),
        StudyPiece::Course(_) => {
            (String::new(), "Dots: each run in the order requested. Line: the best so far.".into())
        }
    };
    if !title.is_empty() {
        let _ = writeln!(page, "<h3>{title}</h3>");
    }
    let draw = |layout| draw(piece, layout).unwrap_or_else(|| Picture::new("", "", 0.0, 0.0));
    figure(page, &format!("study{count}"), draw, &caption);
    match piece {
        StudyPiece::Curves(one, names) => overlay(one, names, Layout::Wide).embed(page),
        StudyPiece::Trend(plot) => sweep::embed(page, plot),
        StudyPiece::Misfit(key, tried) => embed_key(page, key, tried),
        StudyPiece::Course(chi_squares) => embed_course(page, chi_squares),
        _ => {}
    }
}

fn tag(tagged: &Tagged) -> String {
    let class = match tagged.tone {
        Tone::Open => String::new(),
        tone => format!(" {}", tone.class()),
    };
    format!("<span class=\"tag{class}\">{}</span>", escape(&tagged.word))
}

fn claim(page: &mut String, card: &ClaimCard) {
    let _ = write!(
        page,
        "<article class=\"claim\">\n<p class=\"place\">{} {}</p>\n<blockquote>{}</blockquote>\n",
        escape(&card.place),
        tag(&card.verdict),
        escape(&card.sentence)
    );
    if !card.printed.is_empty() {
        let _ = writeln!(page, "<p class=\"note\">Printed: {}</p>", escape(&card.printed));
    }
    if !card.depends.is_empty() {
        let _ = writeln!(page, "<p class=\"depends\">Depends on {}</p>", escape(&card.depends));
    }
    if !card.parts.is_empty() {
        page.push_str("<ul>\n");
        for part in &card.parts {
            let _ = writeln!(
                page,
                "<li>{} {}<br><span class=\"ours\">{}</span></li>",
                tag(&part.verdict),
                escape(&part.words),
                escape(&part.ours)
            );
        }
        page.push_str("</ul>\n");
    }
    if !card.note.is_empty() {
        let _ = writeln!(page, "<p class=\"note\">{}</p>", escape(&card.note));
    }
    page.push_str("</article>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_every_piece_is_on_the_page_and_nothing_is_markup() {
        let card = ClaimCard {
            place: "4.2".into(),
            sentence: "a < b & c".into(),
            verdict: Tagged { word: "holds".into(), tone: Tone::Good },
            depends: "the filter".into(),
            parts: vec![ClaimPart { words: "RMS".into(), ours: "<script>".into(), ..ClaimPart::default() }],
            ..ClaimCard::default()
        };
        let study = Study {
            title: "T".into(),
            chapters: vec![Chapter::new(
                "one",
                "One",
                "Chapter one",
                vec![
                    StudyPiece::Words("some words".into()),
                    StudyPiece::Note("x > y".into()),
                    StudyPiece::Failures("File".into(), vec![("c.csv".into(), "empty <".into())]),
                    StudyPiece::Curves(Overlay::default(), vec![]),
                    StudyPiece::Trend(IndicatorPlot::default()),
                    StudyPiece::Stack(Stack {
                        panels: vec![Overlay { title: "Panel a".into(), ..Overlay::default() }, Overlay::default()],
                        ..Stack::default()
                    }),
                    StudyPiece::Plan("seen-from-above".into(), Box::default()),
                    StudyPiece::Table(Table { title: "A table".into(), ..Table::default() }),
                    StudyPiece::Map(HeatMap { label: "Over both".into(), unit: "m/s^2".into(), ..HeatMap::default() }),
                    StudyPiece::Code("load_n = [0.0, -3e3] # <down>".into()),
                    StudyPiece::Claims(vec![card]),
                    StudyPiece::Claims(vec![]),
                ],
            )],
            ..Study::default()
        };
        let page = study_html(&study);
        for part in [
            "href=\"#one\"",
            "Chapter one",
            "some words",
            "x &gt; y",
            "empty &lt;",
            "Panel a",
            "A table",
            "Over both (m/s²)",
            "# &lt;down&gt;",
            "a &lt; b &amp; c",
            "tag good",
            "Depends on the filter",
            "&lt;script&gt;",
            "No claim belongs",
        ] {
            assert!(page.contains(part), "{part}");
        }
        let pictures = study_pictures(&study, Layout::Wide);
        assert_eq!(pictures.len(), 4);
        assert_eq!(pictures[3].name, "seen-from-above");
    }
}
