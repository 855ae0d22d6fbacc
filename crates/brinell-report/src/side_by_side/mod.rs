//! The page of several runs side by side: overlays of their curves, and tables. `content.rs` says what the sections of a
//! comparison are, `curves.rs` which curves they show.

mod content;
mod curves;
mod overlay;

use std::fmt::Write as _;

use crate::data::{Along, Marker};
use crate::fact::Fact;
use crate::frame::{THINNED, close, figure, lead, none, open, plain};
use crate::layout::Layout;
use crate::markup::escape;
use crate::picture::Picture;
use crate::tables::{Table, facts, table};
pub use content::{compared_headline, unsettled};
pub use overlay::overlay;
pub(crate) use overlay::{embed, stacked};

/// One run's curve.
#[derive(Clone, Debug, PartialEq)]
pub struct OverlaidCurve {
    /// Which of the page's names it belongs to, from 0.
    pub of: usize,
    /// Where its values are.
    pub along: Along,
    /// The values; NaN is a gap.
    pub values: Vec<f64>,
}

/// How the y axis is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Vertical {
    /// Around the values.
    #[default]
    Around,
    /// From zero up.
    FromZero,
    /// Decades of what is largest.
    Decades,
}

/// Curves of several runs in one plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// Name of the picture's file.
    pub name: String,
    /// Over the plot; may be empty.
    pub title: String,
    /// Quantity on the x axis.
    pub x_label: String,
    /// Its unit; may be empty.
    pub x_unit: String,
    /// Ends of the x axis; all that the curves have where there are none.
    pub x_range: Option<(f64, f64)>,
    /// Quantity on the y axis.
    pub y_label: String,
    /// Its unit; may be empty.
    pub y_unit: String,
    /// The y axis.
    pub vertical: Vertical,
    /// The curves, the first lowest.
    pub curves: Vec<OverlaidCurve>,
    /// Frequencies marked above the plot.
    pub markers: Vec<Marker>,
    /// Under it; may be empty.
    pub note: String,
}

impl Overlay {
    /// Of these curves; labels with their units.
    pub fn new(
        name: impl Into<String>,
        (x_label, x_unit): (&str, &str),
        (y_label, y_unit): (&str, &str),
        curves: Vec<OverlaidCurve>,
    ) -> Self {
        Self {
            name: name.into(),
            x_label: x_label.into(),
            x_unit: x_unit.into(),
            y_label: y_label.into(),
            y_unit: y_unit.into(),
            curves,
            ..Self::default()
        }
    }
}

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
