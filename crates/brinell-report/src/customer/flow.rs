//! Text, tables and pictures one below the other, on a page of any width.
//!
//! What is given by others may be of any length: it is broken where there is no space, and ends with an ellipsis where it
//! has no more lines.

use crate::chart::Size;
use crate::data::Tone;
use crate::font;
use crate::number::minus;
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text, ink};
use crate::tables::Table;

/// What stands on a page.
pub(super) enum Block<'a> {
    /// The heading of all, over a few lines.
    Title(String),
    /// Pairs of label and words, two pairs side by side where there is room.
    Facts(Vec<(String, String)>),
    /// The result: in a few words, and what is said of it, some with a word in front.
    Result { tone: Tone, headline: String, said: Vec<(&'static str, String)> },
    /// The heading of a part.
    Heading(&'static str),
    /// A paragraph of so many lines at most, with a word in bold in front, which may be empty.
    Text { first: &'static str, words: String, most: usize },
    /// Small print of so many lines at most.
    Small { words: String, most: usize },
    /// Numbered or with dots.
    List { items: Vec<String>, numbered: bool },
    /// Of a table so many rows, and how many there are beside.
    Table { table: Table, most: usize },
    /// A picture of any size, with words under it.
    Figure { draw: Box<dyn Fn(Size) -> Picture + 'a>, caption: String },
    /// Two columns; one below the other where there is no room.
    Beside(Vec<Block<'a>>, Vec<Block<'a>>),
}

/// How a page is set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    /// Size of text.
    pub(super) body: f64,
    /// Height of each picture.
    pub(super) figure: f64,
    /// Lines of a paragraph, an item or a cell at most.
    pub(super) lines: usize,
    /// Whether columns stand side by side.
    pub(super) wide: bool,
}

/// Line to line, over the size of the text.
const LINE: f64 = 1.36;
/// Small print over the size of text.
const SMALL: f64 = 0.86;
/// Between two columns, px.
const GUTTER: f64 = 28.0;
/// A column wider than this has facts in pairs, px.
const PAIRS: f64 = 500.0;

/// Where the next block goes.
pub(super) struct Column<'p> {
    pub(super) picture: &'p mut Picture,
    pub(super) set: Setting,
    pub(super) left: f64,
    pub(super) width: f64,
    pub(super) y: f64,
}

/// How a text looks.
#[derive(Clone, Copy)]
struct Face {
    size: f64,
    bold: bool,
    color: &'static str,
}

impl Face {
    fn new(size: f64, color: &'static str) -> Self {
        Self { size, bold: false, color }
    }

    fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    fn width(self, text: &str) -> f64 {
        font::width(text, self.size, self.bold)
    }
}

/// `text` on at most `most` lines of `room`, the first of them shorter by `indent`.
fn lines(text: &str, face: Face, room: f64, indent: f64, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let room_of = |line: usize| if line == 0 { room - indent } else { room };
    for word in text.split_whitespace() {
        let at = lines.len() - 1;
        let longer = if lines[at].is_empty() { word.to_owned() } else { format!("{} {word}", lines[at]) };
        if face.width(&longer) <= room_of(at) {
            lines[at] = longer;
            continue;
        }
        if !lines[at].is_empty() || (at == 0 && indent > 0.0 && face.width(word) <= room) {
            lines.push(String::new());
        }
        let mut used = 0.0;
        for letter in word.chars() {
            let (at, own) = (lines.len() - 1, face.width(letter.encode_utf8(&mut [0; 4])));
            if used > 0.0 && used + own > room_of(at) {
                lines.push(letter.to_string());
                used = own;
            } else {
                lines[at].push(letter);
                used += own;
            }
            if lines.len() > most.saturating_add(1) {
                break;
            }
        }
        if lines.len() > most.saturating_add(1) {
            break;
        }
    }
    if lines.len() > most {
        lines.truncate(most);
        if let Some(last) = lines.last_mut() {
            while !last.is_empty() && face.width(&format!("{last}…")) > room_of(most - 1) {
                last.pop();
            }
            *last = format!("{}…", last.trim_end());
        }
    }
    lines
}

impl Column<'_> {
    /// Draws blocks one below the other.
    pub(super) fn draw(&mut self, blocks: &[Block]) {
        for block in blocks {
            self.block(block);
        }
    }

    fn body(&self) -> Face {
        Face::new(self.set.body, ink::TEXT)
    }

    fn small(&self) -> Face {
        Face::new(SMALL * self.set.body, ink::FAINT)
    }

    fn gap(&mut self, share: f64) {
        self.y += share * self.set.body;
    }

    /// Lines from here on, `into` the column.
    fn text(&mut self, text: &str, face: Face, (into, indent): (f64, f64), most: usize) {
        let most = self.most(most);
        for (k, line) in lines(text, face, self.width - into, indent, most).iter().enumerate() {
            self.y += LINE * face.size;
            let x = self.left + into + if k == 0 { indent } else { 0.0 };
            self.put(line, face, (x, self.y), Anchor::Start);
        }
    }

    /// So many lines at most; a column that has no end has room for all.
    fn most(&self, most: usize) -> usize {
        if self.set.wide { most.min(self.set.lines) } else { usize::MAX }
    }

    fn put(&mut self, line: &str, face: Face, (x, y): (f64, f64), anchor: Anchor) {
        if line.is_empty() {
            return;
        }
        let text = Text::new(x, y - 0.3 * face.size, face.size, anchor, line).color(face.color);
        self.picture.text(if face.bold { text.bold() } else { text });
    }

    /// A word in bold, and words that begin beside it.
    fn led(&mut self, first: &str, words: &str, face: Face, into: f64, most: usize) {
        let bold = Face { color: ink::BLACK, ..face.bold() };
        let mut indent = 0.0;
        if !first.is_empty() {
            let y = self.y + LINE * face.size;
            self.put(first, bold, (self.left + into, y), Anchor::Start);
            indent = bold.width(first) + 0.35 * face.size;
        }
        self.text(words, face, (into, indent), most);
    }

    fn block(&mut self, block: &Block) {
        let (body, small) = (self.body(), self.small());
        match block {
            Block::Title(words) => {
                let face = Face::new(1.9 * body.size, ink::BLACK).bold();
                self.text(words, face, (0.0, 0.0), 2);
                self.gap(0.5);
            }
            Block::Facts(facts) => self.facts(facts),
            Block::Result { tone, headline, said } => self.result(*tone, headline, said),
            Block::Heading(words) => {
                self.gap(0.95);
                self.text(words, Face::new(1.12 * body.size, ink::BLACK).bold(), (0.0, 0.0), 1);
                self.gap(0.12);
            }
            Block::Text { first, words, most } => {
                self.led(first, words, body, 0.0, *most);
                self.gap(0.3);
            }
            Block::Small { words, most } => {
                self.text(words, small, (0.0, 0.0), *most);
                self.gap(0.2);
            }
            Block::List { items, numbered } => {
                for (k, item) in items.iter().enumerate() {
                    let mark = if *numbered { format!("{}.", k + 1) } else { "•".into() };
                    let y = self.y + LINE * body.size;
                    self.put(&mark, body, (self.left, y), Anchor::Start);
                    self.text(item, body, (1.35 * body.size, 0.0), 4);
                    self.gap(0.18);
                }
            }
            Block::Table { table, most } if self.set.wide => self.table(table, *most),
            Block::Table { table, most } => self.cards(table, *most),
            Block::Figure { draw, caption } => self.figure(draw, caption),
            Block::Beside(one, other) => self.beside(one, other),
        }
    }

    fn facts(&mut self, facts: &[(String, String)]) {
        let across = if self.width > PAIRS { 2 } else { 1 };
        let cell = (self.width - GUTTER * (across - 1) as f64) / across as f64;
        let (left, width) = (self.left, self.width);
        let label = Face::new(self.set.body, ink::FAINT);
        let words = Face::new(self.set.body, ink::BLACK);
        let room = facts.iter().map(|(name, _)| label.width(name)).fold(0.0, f64::max).min(0.4 * cell) + 10.0;
        for row in facts.chunks(across) {
            let top = self.y;
            let mut bottom = top;
            for (k, (name, said)) in row.iter().enumerate() {
                (self.left, self.width, self.y) = (left + k as f64 * (cell + GUTTER), cell, top);
                let y = top + LINE * label.size;
                self.put(&font::fitted(name, label.size, false, room - 10.0), label, (self.left, y), Anchor::Start);
                self.text(said, words, (room, 0.0), if across == 2 { 2 } else { 4 });
                bottom = bottom.max(self.y);
            }
            self.y = bottom + 0.12 * label.size;
        }
        (self.left, self.width) = (left, width);
        self.gap(0.8);
    }

    fn result(&mut self, tone: Tone, headline: &str, said: &[(&'static str, String)]) {
        let color = match tone {
            Tone::Bad => ink::VERMILLION,
            Tone::Open => ink::ORANGE,
            Tone::Good => ink::GREEN,
        };
        let (left, width, top) = (self.left, self.width, self.y);
        // The box lies under its words.
        let at = self.picture.shapes.len();
        let inside = 1.2 * self.set.body;
        (self.left, self.width) = (left + inside + 5.0, width - 2.0 * inside - 5.0);
        self.gap(0.55);
        self.text(headline, Face::new(1.5 * self.set.body, ink::BLACK).bold(), (0.0, 0.0), 2);
        self.gap(0.25);
        for (first, words) in said {
            self.led(first, words, Face::new(1.04 * self.set.body, ink::BLACK), 0.0, 4);
            self.gap(0.2);
        }
        self.gap(0.6);
        (self.left, self.width) = (left, width);
        let place = Rect { left, top, right: left + width, bottom: self.y };
        let corners = |r: Rect| vec![(r.left, r.top), (r.right, r.top), (r.right, r.bottom), (r.left, r.bottom)];
        let filled = |rect, opacity| Shape::Path {
            lines: vec![corners(rect)],
            close: true,
            paint: Paint::fill(color, opacity),
            clip: None,
        };
        self.picture.shapes.splice(at..at, [filled(place, 0.1), filled(Rect { right: left + 5.0, ..place }, 1.0)]);
        self.gap(0.6);
    }

    fn figure(&mut self, draw: &dyn Fn(Size) -> Picture, caption: &str) {
        if self.set.figure < 60.0 {
            return;
        }
        self.gap(0.35);
        let size = Size { width: self.width, height: self.set.figure, font: 0.8 * self.set.body };
        let picture = draw(size);
        self.picture.shapes.push(Shape::Figure(format!("{}. {caption}", picture.title)));
        let height = picture.height;
        self.picture.place(picture, self.left, self.y);
        self.picture.shapes.push(Shape::Close);
        self.y += height;
        self.text(caption, self.small(), (0.0, 0.0), 3);
        self.gap(0.2);
    }

    fn beside(&mut self, one: &[Block], other: &[Block]) {
        if !self.set.wide {
            self.draw(one);
            self.draw(other);
            return;
        }
        let (left, width, top) = (self.left, self.width, self.y);
        self.width = 0.5 * (width - GUTTER);
        self.draw(one);
        let bottom = self.y;
        (self.left, self.y) = (left + self.width + GUTTER, top);
        self.draw(other);
        (self.left, self.width, self.y) = (left, width, self.y.max(bottom));
    }

    /// Rows of cells on as many lines as they need.
    fn table(&mut self, table: &Table, most: usize) {
        let (face, head) = (Face::new(0.92 * self.set.body, ink::TEXT), self.small().bold());
        let heads: Vec<&str> = table.columns.iter().map(|head| head.trim_start_matches('#')).collect();
        let right: Vec<bool> = table.columns.iter().map(|head| head.starts_with('#')).collect();
        let shown = &table.rows[..table.rows.len().min(most)];
        let widths = self.widths(&heads, shown, (face, head));
        let row = |column: &mut Self, cells: &[&str], face: Face| {
            let (top, mut bottom, mut x) = (column.y, column.y, column.left);
            for ((cell, width), right) in cells.iter().zip(&widths).zip(&right) {
                let room = width - 10.0;
                for (k, line) in lines(cell, face, room, 0.0, column.set.lines.min(3)).iter().enumerate() {
                    let y = top + (k + 1) as f64 * LINE * face.size;
                    let (at, anchor) = if *right { (x + room, Anchor::End) } else { (x, Anchor::Start) };
                    column.put(line, face, (at, y), anchor);
                    bottom = bottom.max(y);
                }
                x += width;
            }
            column.y = bottom + 0.22 * face.size;
            let (left, end) = (column.left, column.left + column.width);
            column.picture.path(&[(left, column.y), (end, column.y)], Paint::line(ink::GRID, 1.0));
            column.y += 0.1 * face.size;
        };
        row(self, &heads, head);
        for cells in shown {
            row(self, &cells.iter().map(String::as_str).collect::<Vec<_>>(), face);
        }
        self.under(table, shown.len());
    }

    /// What stands under a table.
    fn under(&mut self, table: &Table, shown: usize) {
        let more = table.rows.len() - shown;
        let mut words = if more > 0 { format!("And {more} more. ") } else { String::new() };
        words += &table.note;
        if !words.is_empty() {
            self.gap(0.1);
            self.text(&words, self.small(), (0.0, 0.0), 3);
        }
        self.gap(0.3);
    }

    /// Of each column: as much as its longest word takes, and a share of what is left by how much more it would.
    fn widths(&self, heads: &[&str], rows: &[Vec<String>], (face, head): (Face, Face)) -> Vec<f64> {
        const BETWEEN: f64 = 10.0;
        let most = 0.4 * self.width;
        let longest =
            |face: Face, text: &str| text.split_whitespace().map(|word| face.width(word)).fold(0.0, f64::max).min(most);
        // A head may take two lines.
        let head_of = |k: usize| longest(head, heads[k]).max(0.56 * head.width(heads[k]));
        let width = |k: usize, of: &dyn Fn(&str) -> f64| {
            let cells = rows.iter().filter_map(|row| row.get(k)).map(|cell| of(cell));
            cells.chain([head_of(k)]).fold(0.0, f64::max) + BETWEEN
        };
        let least: Vec<f64> = (0..heads.len()).map(|k| width(k, &|cell| longest(face, cell))).collect();
        let wanted: Vec<f64> = (0..heads.len()).map(|k| width(k, &|cell| face.width(cell)).max(least[k])).collect();
        let (sum, want) = (least.iter().sum::<f64>(), wanted.iter().sum::<f64>());
        let left = self.width - sum;
        if left < 0.0 {
            return least.iter().map(|width| width * self.width / sum).collect();
        }
        // Of more room than is wanted each gets a share.
        let each = (left - (want - sum)).max(0.0) / heads.len().max(1) as f64;
        let share = if want > sum { (left / (want - sum)).min(1.0) } else { 0.0 };
        least.iter().zip(&wanted).map(|(least, wanted)| least + share * (wanted - least) + each).collect()
    }

    /// A table where there is no room for columns: of each row its first cell, and below it each of the others that
    /// says something on a line of its own, after its head. A unit stands behind the value.
    fn cards(&mut self, table: &Table, most: usize) {
        let shown = &table.rows[..table.rows.len().min(most)];
        let (faint, face) = (Face::new(self.set.body, ink::FAINT), Face::new(self.set.body, ink::BLACK));
        let says = |cell: &str| !matches!(cell, "" | "–");
        for row in shown {
            let first = row.first().map_or("", String::as_str);
            if says(first) {
                self.text(first, face.bold(), (0.0, 0.0), 2);
            }
            let unit = table.columns.iter().zip(row).find(|(head, _)| *head == "Unit").map_or("", |(_, cell)| cell);
            let rest = table.columns.iter().zip(row).skip(1).filter(|(head, cell)| *head != "Unit" && says(cell));
            for (head, cell) in rest {
                let head = head.trim_start_matches('#');
                let said = if head == "Value" { format!("{cell} {unit}") } else { cell.clone() };
                self.put(head, faint, (self.left, self.y + LINE * faint.size), Anchor::Start);
                self.text(&minus(&said), face, (0.0, faint.width(head) + 0.5 * faint.size), 8);
            }
            let under = self.y + 0.35 * self.set.body;
            self.picture.path(&[(self.left, under), (self.left + self.width, under)], Paint::line(ink::GRID, 1.0));
            self.gap(0.5);
        }
        self.under(table, shown.len());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_no_line_is_wider_than_its_room_and_no_word_is_lost() {
        let long = "x".repeat(500);
        for text in
            ["a few words that take more than one line of so little room", &long, "漢字漢字漢字漢字漢字 漢字", ""]
        {
            for (room, indent) in [(60.0, 0.0), (60.0, 30.0), (200.0, 199.0)] {
                let face = Face::new(12.0, ink::TEXT);
                let all = lines(text, face, room, indent, usize::MAX - 1);
                for (k, line) in all.iter().enumerate() {
                    let room = if k == 0 { room - indent } else { room };
                    assert!(face.width(line) <= room || line.chars().count() == 1, "{line}");
                }
                let letters = |text: &str| text.split_whitespace().collect::<String>();
                assert_eq!(letters(&all.concat()), letters(text));
                let few = lines(text, face, room, indent, 2);
                assert!(few.len() <= 2);
                assert_eq!(few.last().is_some_and(|line| line.ends_with('…')), all.len() > 2, "{few:?}");
            }
        }
    }
}
