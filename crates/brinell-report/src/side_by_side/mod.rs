//! The page of several runs side by side: overlays of their curves, and tables. `content.rs` says what the sections of a
//! comparison are, `curves.rs` which curves they show.

mod content;
mod curves;
mod overlay;

use std::fmt::Write as _;

use crate::fact::Fact;
use crate::frame::{THINNED, close, figure, lead, none, open, plain};
use crate::layout::Layout;
use crate::markup::escape;
use crate::picture::Picture;
use crate::tables::{Table, facts, table};
pub use content::{compared_headline, unsettled};
pub use overlay::{OverlaidCurve, Overlay, Vertical, overlay};
pub(crate) use overlay::{embed, stacked};

/// A piece of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// Curves.
    Overlay(Overlay),
    /// Words and numbers.
    Table(Table),
    /// A sentence where something is missing.
    Words(String),
}

/// A heading and what is under it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The heading.
    pub title: String,
    /// In this order; a table's title is a heading of its own.
    pub pieces: Vec<Piece>,
}

/// Everything that the page shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SideBySide {
    /// Heading of the page.
    pub title: String,
    /// One line under it.
    pub subtitle: String,
    /// The version of the program.
    pub version: String,
    /// What deserves attention.
    pub warnings: Vec<String>,
    /// Names of the runs, in the order of colours.
    pub names: Vec<String>,
    /// Headline numbers.
    pub facts: Vec<Fact>,
    /// The sections.
    pub parts: Vec<Part>,
}

/// The page's pictures, for saving as files.
pub fn side_by_side_pictures(report: &SideBySide, layout: Layout) -> Vec<Picture> {
    let pieces = report.parts.iter().flat_map(|part| &part.pieces);
    let overlays = pieces.filter_map(|piece| match piece {
        Piece::Overlay(one) => Some(overlay(one, &report.names, layout)),
        _ => None,
    });
    layout.finished(overlays.collect())
}

/// The self-contained page.
pub fn side_by_side_html(report: &SideBySide) -> String {
    let mut page = open(&report.title, &report.subtitle, ("Simulated", &report.version), plain(&report.warnings));
    page.push_str("<main>\n");
    lead(&mut page, &report.facts.first().map_or(String::new(), Fact::words));
    facts(&mut page, &report.facts);
    let mut count = 0;
    for part in &report.parts {
        // A lone table brings its own heading.
        let headed = !matches!(&part.pieces[..], [Piece::Table(table)] if table.title == part.title);
        let _ = writeln!(page, "<section>");
        if headed {
            let _ = writeln!(page, "<h2>{}</h2>", escape(&part.title));
        }
        for piece in &part.pieces {
            match piece {
                Piece::Overlay(one) => {
                    if !one.title.is_empty() {
                        let _ = writeln!(page, "<h3>{}</h3>", escape(&one.title));
                    }
                    count += 1;
                    let draw = |layout| overlay(one, &report.names, layout);
                    figure(&mut page, &format!("overlay{count}"), draw, &escape(&one.note));
                    embed(&mut page, one, &report.names);
                }
                Piece::Table(one) => table(&mut page, one),
                Piece::Words(words) => none(&mut page, &escape(words)),
            }
        }
        page.push_str("</section>\n");
    }
    close(page, THINNED, &[])
}
