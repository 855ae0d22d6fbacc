//! What every page is: chapters of pieces, under a heading, with the result first. One renderer writes all of them and
//! draws their pictures for files.

use std::fmt::{self, Write as _};
use std::sync::Arc;

use crate::claims::{ClaimCard, claim};
use crate::damage::{DamageView, damage_plan};
use crate::data::Tone;
use crate::embedded::Plot;
use crate::fact::Fact;
use crate::frame::{alert, close, code, contents, details, figure, folded, lead, none, open, section, unit_html};
use crate::layout::Layout;
use crate::markup::{escape, prose};
use crate::misfit::{Tried, course_plot, embed_course, embed_key, key_plot};
use crate::overlay::{Overlay, overlay, stacked};
use crate::picture::Picture;
use crate::sweep::{self, HeatMap, IndicatorPlot, heat_map, indicator_plot};
use crate::tables::{Table, fact_table, facts, failures, table};
use brinell_study::calibrate::Found;

/// A piece of a chapter.
#[derive(Clone, Debug)]
pub enum Piece {
    /// A paragraph.
    Words(String),
    /// A paragraph in grey: what marks mean, or why something is missing.
    Note(String),
    /// What must not be overlooked, after a few words in bold.
    Alert(&'static str, String),
    /// The verdict in its colour.
    Verdict(Tone, String),
    /// A heading within the chapter.
    Heading(String),
    /// Points of a list.
    List(Vec<String>),
    /// A picture of its own.
    Figure(Figure),
    /// Small pictures of one thing, under words that are markup.
    Tile(String, Vec<Figure>),
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
    /// Headline numbers.
    Headline(Vec<Fact>),
    /// What failed, and why. First what one of them is called: "File".
    Failures(String, Vec<(String, String)>),
    /// Text as written in a file.
    Code(String),
    /// Claims.
    Claims(Vec<ClaimCard>),
    /// What a reader opens.
    Folded(Folded),
    /// Markup with a form of its own.
    Markup(String),
}

impl Piece {
    /// What `write` puts on a page.
    pub(crate) fn written(write: impl FnOnce(&mut String)) -> Self {
        let mut markup = String::new();
        write(&mut markup);
        Self::Markup(markup)
    }

    /// Facts, or words where there are none.
    pub(crate) fn facts(all: &[Fact], absent: &str) -> Self {
        match all {
            [] => Self::Note(absent.into()),
            _ => Self::Facts(all.to_vec()),
        }
    }
}

/// Writes what the page's script needs.
type Embed = Arc<dyn Fn(&mut String) + Send + Sync>;

/// A picture, drawn whenever a page or a file needs it.
#[derive(Clone)]
pub struct Figure {
    id: String,
    /// Markup.
    caption: String,
    draw: Arc<dyn Fn(Layout) -> Picture + Send + Sync>,
    /// What the page's script redraws it with.
    embed: Option<Embed>,
    shown: bool,
    saved: bool,
}

impl fmt::Debug for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Figure").field(&self.id).finish()
    }
}

impl Figure {
    /// A picture of data, with a caption in markup.
    pub(crate) fn still<T: Send + Sync + 'static>(
        id: impl Into<String>,
        caption: impl Into<String>,
        of: &Arc<T>,
        draw: impl Fn(&T, Layout) -> Picture + Send + Sync + 'static,
    ) -> Self {
        let (id, caption, of) = (id.into(), caption.into(), Arc::clone(of));
        let draw = Arc::new(move |layout| draw(&of, layout));
        Self { id, caption, draw, embed: None, shown: true, saved: true }
    }

    /// A plot of data that the script may redraw.
    pub(crate) fn plot<T: Send + Sync + 'static>(
        id: impl Into<String>,
        caption: impl Into<String>,
        of: &Arc<T>,
        draw: for<'a> fn(&'a T, Layout) -> Plot<'a>,
    ) -> Self {
        let data = Arc::clone(of);
        let embed: Embed = Arc::new(move |page| draw(&data, Layout::Wide).embed(page));
        Self { embed: Some(embed), ..Self::still(id, caption, of, move |of, layout| draw(of, layout).picture()) }
    }

    /// For files alone.
    pub(crate) fn unseen(self) -> Self {
        Self { shown: false, ..self }
    }

    /// For the page alone.
    pub(crate) fn unsaved(self) -> Self {
        Self { saved: false, ..self }
    }

    fn embed(&self, page: &mut String) {
        if let Some(embed) = &self.embed {
            embed(page);
        }
    }
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

/// Pieces under a line that opens and closes them.
#[derive(Clone, Debug, Default)]
pub struct Folded {
    /// The line.
    pub title: String,
    /// Whether it is open to begin with.
    pub open: bool,
    /// In this order.
    pub pieces: Vec<Piece>,
}

/// A heading and what is under it.
#[derive(Clone, Debug, Default)]
pub struct Chapter {
    /// Its place in links: letters, digits, hyphens.
    pub id: String,
    /// In the list of contents.
    pub short: String,
    /// The heading; empty where a table brings its own.
    pub title: String,
    /// In this order.
    pub pieces: Vec<Piece>,
    /// Whether a reader opens it first.
    pub folded: bool,
}

impl Chapter {
    /// With its pieces.
    pub fn new(id: &str, short: &str, title: &str, pieces: Vec<Piece>) -> Self {
        Self { id: id.into(), short: short.into(), title: title.into(), pieces, folded: false }
    }

    /// The same, under a heading that opens it.
    #[must_use]
    pub fn folded(self) -> Self {
        Self { folded: true, ..self }
    }

    /// A table and no more, under its own heading.
    pub fn table(id: &str, short: &str, table: Table) -> Self {
        Self::new(id, short, "", vec![Piece::Table(table)])
    }

    /// Of one piece, its heading in the list of contents too.
    pub(crate) fn of(id: &str, title: &str, piece: Piece) -> Self {
        Self::new(id, title, title, vec![piece])
    }

    /// What failed, where anything did: name and reason of each. `each` is what one of them is called: "File".
    pub fn failures(title: &str, each: &str, all: Vec<(String, String)>) -> Option<Self> {
        let some = !all.is_empty();
        some.then(|| Self::new("failures", "Failed", title, vec![Piece::Failures(each.into(), all)]))
    }
}

/// Everything that a page shows.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// Heading of the page.
    pub title: String,
    /// One line under it.
    pub subtitle: String,
    /// Whether signals were analysed; else runs were simulated.
    pub analysed: bool,
    /// The version of the program, and what else made the page.
    pub version: String,
    /// Why the run ended early, where it did.
    pub partial: Option<String>,
    /// The result in a sentence; may be empty.
    pub lead: String,
    /// What deserves attention.
    pub warnings: Vec<String>,
    /// Headline numbers.
    pub facts: Vec<Fact>,
    /// The chapters.
    pub chapters: Vec<Chapter>,
    /// At the end.
    pub footer: String,
    /// What the page runs beside what every page does.
    pub script: &'static str,
}

/// The page's pictures, for saving as files.
pub fn pictures(page: &Page, layout: Layout) -> Vec<Picture> {
    let chapters = page.chapters.iter().flat_map(|chapter| &chapter.pieces);
    layout.finished(chapters.flat_map(unfolded).filter_map(|piece| draw(piece, layout)).collect())
}

/// A piece, or those folded in it.
fn unfolded(piece: &Piece) -> Vec<&Piece> {
    match piece {
        Piece::Folded(folded) => folded.pieces.iter().flat_map(unfolded).collect(),
        one => vec![one],
    }
}

/// As a file holds it.
fn draw(piece: &Piece, layout: Layout) -> Option<Picture> {
    match piece {
        Piece::Figure(figure) => figure.saved.then(|| (figure.draw)(layout)),
        Piece::Curves(one, names) => Some(overlay(one, names, layout).picture()),
        Piece::Stack(s) => Some(stacked(&s.name, &s.title, &s.panels, &s.names, s.alike, layout)),
        Piece::Plan(name, view) => {
            let mut picture = damage_plan(view, 0, layout);
            picture.name.clone_from(name);
            Some(picture)
        }
        Piece::Trend(plot) => Some(indicator_plot(plot, layout)),
        Piece::Map(map) => heat_map(map, layout),
        Piece::Misfit(key, tried) => Some(key_plot(key, tried, layout)),
        Piece::Course(chi_squares) => Some(course_plot(chi_squares, layout)),
        _ => None,
    }
}

/// The self-contained page.
pub fn html(page: &Page) -> String {
    let done = if page.analysed { "Analysed" } else { "Simulated" };
    let partial = page.partial.as_deref().map(|why| ("This run is partial.", why));
    let mut html = open(&page.title, &page.subtitle, (done, &page.version), partial);
    // Pictures for files alone have a chapter without a name.
    let shown = || page.chapters.iter().filter(|chapter| !chapter.short.is_empty());
    contents(&mut html, shown().map(|chapter| (&*chapter.id, &*chapter.short)));
    lead(&mut html, &page.lead);
    page.warnings.iter().for_each(|words| alert(&mut html, "", unprefixed(words)));
    facts(&mut html, &page.facts);
    let mut count = 0;
    for chapter in shown() {
        let write = if chapter.folded { folded } else { section };
        write(&mut html, &chapter.id, &chapter.title, &mut |html| {
            chapter.pieces.iter().for_each(|piece| write_piece(html, piece, &mut count));
        });
    }
    close(html, &page.footer, &[page.script])
}

/// A warning without the word that lines of a terminal begin with: the box says it.
fn unprefixed(words: &str) -> &str {
    ["warning: ", "warning, "].iter().find_map(|prefix| words.strip_prefix(prefix)).unwrap_or(words)
}

/// `count`: pieces up to this one.
fn write_piece(page: &mut String, piece: &Piece, count: &mut usize) {
    *count += 1;
    let (title, caption) = match piece {
        Piece::Words(words) => {
            let _ = writeln!(page, "<p>{}</p>", escape(words));
            return;
        }
        Piece::Note(words) => return none(page, &prose(words)),
        Piece::Alert(strong, words) => return alert(page, strong, words),
        Piece::Verdict(tone, words) => {
            let _ = writeln!(page, "<p class=\"verdict {}\">{}</p>", tone.class(), escape(words));
            return;
        }
        Piece::Heading(words) => {
            let _ = writeln!(page, "<h3>{}</h3>", escape(words));
            return;
        }
        Piece::List(points) => {
            page.push_str("<ul>\n");
            points.iter().for_each(|point| page.push_str(&format!("<li>{}</li>\n", escape(point))));
            page.push_str("</ul>\n");
            return;
        }
        Piece::Figure(one) if !one.shown => return,
        Piece::Figure(one) => {
            figure(page, &one.id, &*one.draw, &one.caption);
            return one.embed(page);
        }
        Piece::Tile(words, figures) => {
            let _ = writeln!(page, "<div class=\"tile\">\n<p>{words}</p>");
            for one in figures {
                let _ = writeln!(page, "<figure>{}</figure>", (one.draw)(Layout::Wide).inline(&one.id, ""));
            }
            page.push_str("</div>\n");
            return figures.iter().for_each(|one| one.embed(page));
        }
        Piece::Folded(Folded { title, open, pieces }) => {
            let write = &mut |page: &mut String| pieces.iter().for_each(|piece| write_piece(page, piece, count));
            return details(page, "h4", title, *open, write);
        }
        Piece::Markup(markup) => return page.push_str(markup),
        Piece::Table(one) => return table(page, one),
        Piece::Facts(all) => return fact_table(page, all),
        Piece::Headline(all) => return facts(page, all),
        Piece::Failures(each, all) => return failures(page, each, all),
        Piece::Code(text) => return code(page, text),
        Piece::Claims(cards) if cards.is_empty() => {
            return none(page, "No claim belongs to what was run.");
        }
        Piece::Claims(cards) => return cards.iter().for_each(|card| claim(page, card)),
        Piece::Curves(one, _) => (escape(&one.title), escape(&one.note)),
        Piece::Stack(stack) => (escape(&stack.title), escape(&stack.note)),
        // Its title is in the picture.
        Piece::Plan(..) => (String::new(), String::new()),
        Piece::Trend(plot) => (escape(&plot.label), String::new()),
        Piece::Map(map) if map.unit.is_empty() => (escape(&map.label), String::new()),
        Piece::Map(map) => (format!("{} ({})", escape(&map.label), unit_html(&map.unit)), String::new()),
        Piece::Misfit(key, _) => (format!("<code>{}</code>", escape(&key.key.name)), String::new()),
        Piece::Course(_) => (String::new(), "Dots: each run in the order requested. Line: the best so far.".into()),
    };
    if !title.is_empty() {
        let _ = writeln!(page, "<h3>{title}</h3>");
    }
    let draw = |layout| draw(piece, layout).unwrap_or_else(|| Picture::new("", "", 0.0, 0.0));
    figure(page, &format!("study{count}"), draw, &caption);
    match piece {
        Piece::Curves(one, names) => overlay(one, names, Layout::Wide).embed(page),
        Piece::Trend(plot) => sweep::embed(page, plot),
        Piece::Misfit(key, tried) => embed_key(page, key, tried),
        Piece::Course(chi_squares) => embed_course(page, chi_squares),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{ClaimPart, Tagged};

    #[test]
    fn regress_warnings_of_all_pages_begin_alike() {
        let given = ["warning: a = 1: high", "warning, line 5: b = 2: low", "refined: once more", "warnings differ"];
        let page = html(&Page { warnings: given.map(String::from).into(), ..Page::default() });
        for shown in ["a = 1: high", "line 5: b = 2: low", "refined: once more", "warnings differ"] {
            assert!(page.contains(&format!("role=\"alert\">{shown}</p>")), "{shown}");
        }
    }

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
        let study = Page {
            title: "T".into(),
            chapters: vec![Chapter::new(
                "one",
                "One",
                "Chapter one",
                vec![
                    Piece::Words("some words".into()),
                    Piece::Note("x > y".into()),
                    Piece::Failures("File".into(), vec![("c.csv".into(), "empty <".into())]),
                    Piece::Curves(Overlay::default(), vec![]),
                    Piece::Trend(IndicatorPlot::default()),
                    Piece::Stack(Stack {
                        panels: vec![Overlay { title: "Panel a".into(), ..Overlay::default() }, Overlay::default()],
                        ..Stack::default()
                    }),
                    Piece::Plan("seen-from-above".into(), Box::default()),
                    Piece::Table(Table { title: "A table".into(), ..Table::default() }),
                    Piece::Map(HeatMap { label: "Over both".into(), unit: "m/s^2".into(), ..HeatMap::default() }),
                    Piece::Code("load_n = [0.0, -3e3] # <down>".into()),
                    Piece::Claims(vec![card]),
                    Piece::Folded(Folded {
                        title: "What is < folded".into(),
                        open: false,
                        pieces: vec![
                            Piece::Words("folded words".into()),
                            Piece::Plan("folded-plan".into(), Box::default()),
                        ],
                    }),
                    Piece::Claims(vec![]),
                ],
            )],
            ..Page::default()
        };
        let page = html(&study);
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
            "<details><summary><h4>What is &lt; folded</h4></summary>\n<p>folded words</p>",
        ] {
            assert!(page.contains(part), "{part}");
        }
        let pictures = pictures(&study, Layout::Wide);
        assert_eq!(pictures.len(), 5);
        assert_eq!([&*pictures[3].name, &*pictures[4].name], ["seen-from-above", "folded-plan"]);
    }
}
