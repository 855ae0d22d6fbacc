//! The two pages, and the same in one column for a phone.

use super::flow::{Block, Column, Setting};
use super::words::{BASIS, grade, headline, kind, limits, not_said, steps, sure};
use super::{CustomerReport, Judged};
use crate::analysis::{close_of_size, envelope_of_size};
use crate::chart::Size;
use crate::font;
use crate::layout::PX_PER_MM;
use crate::picture::{Anchor, Paint, Picture, Text, ink};
use brinell::analysis::Verdict;

/// A4, mm.
const PAPER: (f64, f64) = (210.0, 297.0);
/// Left and right, and above and below, px.
const MARGIN: (f64, f64) = (60.0, 46.0);
/// Room for the line at the foot, px.
const FOOT: f64 = 30.0;
/// Height of a picture on paper, px: at most, and what is tried at least.
const FIGURE: (f64, f64) = (360.0, 195.0);
/// How a page is set, the widest first: size of text (px, a quarter mm), and lines of a paragraph at most.
const SETTINGS: [(f64, usize); 7] = [(13.4, 12), (12.8, 12), (12.2, 12), (11.6, 8), (11.2, 5), (10.8, 3), (10.4, 2)];
/// On a phone: width, margin, size of text and height of a picture, px.
const PHONE: (f64, f64, f64, f64) = (360.0, 14.0, 13.0, 260.0);
/// Rows of the table of channels.
const CHANNELS: usize = 7;
/// Remarks on the record.
const REMARKS: usize = 4;

/// Words that were given, or that they were not.
fn given(words: &str) -> String {
    if words.trim().is_empty() { "not stated".into() } else { words.to_owned() }
}

impl CustomerReport {
    /// Its title, given or not.
    pub(super) fn title(&self) -> &str {
        match self.heading.title.trim() {
            "" => "Vibration report: rolling bearing",
            title => title,
        }
    }

    /// The two pages.
    pub fn pages(&self) -> [Picture; 2] {
        [self.fitted(1, &self.first()), self.fitted(2, &self.second())]
    }

    /// Both in one column.
    pub(super) fn column(&self) -> Picture {
        let (width, margin, body, figure) = PHONE;
        let set = Setting { body, figure, lines: 0, wide: false };
        let mut picture = Picture::new("report", self.title(), width, 0.0);
        let mut column = Column { picture: &mut picture, set, left: margin, width: width - 2.0 * margin, y: margin };
        column.draw(&self.first());
        column.draw(&self.second());
        picture.height = column.y + margin;
        picture
    }

    /// A page in the widest setting in which all of it has room.
    fn fitted(&self, number: usize, blocks: &[Block]) -> Picture {
        let (width, height) = (PX_PER_MM * PAPER.0, PX_PER_MM * PAPER.1);
        let bottom = height - MARGIN.1 - FOOT;
        let draw = |set: Setting| {
            let mut picture = Picture::new(&format!("page-{number}"), self.title(), width, height);
            picture.print_mm = Some(PAPER.0);
            let room = width - 2.0 * MARGIN.0;
            let mut column = Column { picture: &mut picture, set, left: MARGIN.0, width: room, y: MARGIN.1 };
            column.draw(blocks);
            let end = column.y;
            (picture, end)
        };
        let (most, least) = FIGURE;
        // The last without a picture: its text has room whatever it says.
        let settings = SETTINGS.map(|(body, lines)| Setting { body, figure: least, lines, wide: true });
        let last = Setting { figure: 0.0, ..settings[settings.len() - 1] };
        let fits = settings.into_iter().find_map(|set| {
            let (_, end) = draw(set);
            (end <= bottom).then(|| Setting { figure: (set.figure + bottom - end).min(most), ..set })
        });
        let (mut picture, _) = draw(fits.unwrap_or(last));
        self.foot(&mut picture, number, (bottom + FOOT, width));
        picture
    }

    fn foot(&self, picture: &mut Picture, number: usize, (y, width): (f64, f64)) {
        const SIZE: f64 = 10.5;
        let line = y - 1.6 * SIZE;
        picture.path(&[(MARGIN.0, line), (width - MARGIN.0, line)], Paint::line(ink::GRID, 1.0));
        let page = format!("brinell {} · page {number} of 2", self.version);
        let room = width - 2.0 * MARGIN.0 - font::width(&page, SIZE, false) - 20.0;
        let machine = self.heading.machine.trim();
        let of = if machine.is_empty() { self.title().to_owned() } else { format!("{} · {machine}", self.title()) };
        let of: Vec<&str> = of.split_whitespace().collect();
        let of = font::fitted(&of.join(" "), SIZE, false, room);
        picture.text(Text::new(MARGIN.0, y, SIZE, Anchor::Start, &of).color(ink::FAINT));
        picture.text(Text::new(width - MARGIN.0, y, SIZE, Anchor::End, &page).color(ink::FAINT));
    }

    /// For who decides: what, how sure, how bad, what next.
    fn first(&self) -> Vec<Block<'_>> {
        let (heading, lead) = (&self.heading, &self.lead);
        let mut facts = vec![
            ("Machine".to_owned(), given(&heading.machine)),
            ("Measured".to_owned(), given(&heading.date)),
            ("Measuring point".to_owned(), given(&heading.point)),
            ("Author".to_owned(), given(&heading.author)),
            ("Bearing".to_owned(), lead.bearing.clone()),
            ("Shaft speed".to_owned(), lead.speed.clone()),
        ];
        if !self.all.rows.is_empty() {
            facts.push(("Channel that leads".to_owned(), lead.channel.clone()));
        }
        let mut said = vec![("", lead.reason.clone()), ("How sure:", sure(lead).to_owned())];
        if lead.simulated {
            said.push(("Simulated:", "no machine was measured; a simulation made this record.".to_owned()));
        }
        match lead.report.warnings.len() {
            0 => {}
            1 => said.push(("Note:", "there is a remark on the record; see page 2.".to_owned())),
            count => said.push(("Note:", format!("there are {count} remarks on the record; see page 2."))),
        }
        let of = if lead.bearings.len() > 1 { format!("{}: ", lead.bearing) } else { String::new() };
        let clearest = match !self.all.rows.is_empty() && lead.verdict == Verdict::Damage {
            true => format!(", clearest at {}", lead.channel),
            false => String::new(),
        };
        let mut blocks = vec![
            Block::Title(self.title().to_owned()),
            Block::Facts(facts),
            Block::Result { tone: lead.tone(), headline: of + &headline(lead) + &clearest, said },
        ];
        let remark = heading.remark.trim();
        if !remark.is_empty() {
            blocks.push(text("Remark of the author:", remark.to_owned()));
        }
        if !self.all.rows.is_empty() {
            blocks.push(Block::Table { table: self.all.clone(), most: CHANNELS });
        }
        let (first, words) = grade(self);
        let graded = text(first, words);
        let mut severity = vec![Block::Heading("How severe it is"), graded, led(&self.whole.words)];
        severity.extend(lead.severity.iter().map(|words| led(words)));
        severity.push(led(limits(!self.all.rows.is_empty())));
        let mut next = vec![
            Block::Heading("What to do next"),
            Block::List { items: steps(self).into_iter().map(str::to_owned).collect(), numbered: true },
            Block::Small { words: BASIS.into(), most: 3 },
        ];
        next.extend(kind(self).map(|words| text("Kind of damage:", words)));
        blocks.push(Block::Beside(severity, next));
        blocks.push(Block::Heading("What the verdict rests on"));
        blocks.push(Block::Figure { draw: Box::new(|size| envelope(lead, size)), caption: caption(lead).into() });
        blocks
    }

    /// For who checks: evidence, method, where it comes from.
    fn second(&self) -> Vec<Block<'_>> {
        let lead = &self.lead;
        let close = Block::Figure {
            draw: Box::new(|size| close_of_size(&lead.report, size).picture()),
            caption: "The signal in the middle of the record, about ten periods of the rate that leads.".into(),
        };
        let levels = vec![Block::Heading("Levels"), Block::Table { table: lead.levels.clone(), most: 8 }];
        let open = vec![
            Block::Heading("What the verdict does not say"),
            Block::List { items: not_said(lead).map(str::to_owned).to_vec(), numbered: false },
        ];
        let source = vec![Block::Heading("Where it comes from"), Block::Facts(lead.provenance.clone())];
        let mut method =
            vec![Block::Heading("Method"), Block::Text { first: "", words: lead.method.clone(), most: 12 }];
        let warnings = &lead.report.warnings;
        if !warnings.is_empty() {
            let more = warnings.len().saturating_sub(REMARKS);
            let mut items: Vec<String> = warnings[..warnings.len() - more].to_vec();
            if more > 0 {
                items.push(format!("And {more} more."));
            }
            method.push(Block::Heading("Remarks on the record"));
            method.push(Block::List { items, numbered: false });
        }
        let words = Block::Text { first: "In the program's words:", words: lead.report.verdict.clone(), most: 8 };
        let mut blocks = vec![Block::Heading("Evidence"), words];
        if !lead.has_no_bearing() {
            blocks.push(Block::Table { table: lead.evidence.clone(), most: 6 });
        }
        blocks.extend([
            Block::Heading("The signal"),
            close,
            Block::Beside(levels, open),
            Block::Beside(method, source),
        ]);
        blocks
    }
}

fn text<'a>(first: &'static str, words: String) -> Block<'a> {
    Block::Text { first, words, most: 8 }
}

/// A sentence that begins with one of these words and a colon, which becomes bold.
fn led<'a>(words: &str) -> Block<'a> {
    let known = ["Machine:", "Bearing:", "Length:", "Limits:"].into_iter().find(|first| words.starts_with(first));
    let first = known.unwrap_or_default();
    text(first, words[first.len()..].trim_start().to_owned())
}

/// The envelope spectrum; of what is damaged the lanes of other parts are left out.
fn envelope(lead: &Judged, size: Size) -> Picture {
    let mut plot = envelope_of_size(&lead.report, size);
    if plot.spec.lanes.iter().any(|lane| lane.through) {
        plot.spec.lanes.retain(|lane| lane.through);
    }
    // No script redraws it.
    plot.id = String::new();
    plot.picture()
}

fn caption(lead: &Judged) -> &'static str {
    let found = lead.report.markers.iter().any(|marker| marker.present);
    match (found, lead.verdict) {
        (true, Verdict::Damage) if lead.report.markers.iter().all(|marker| marker.sidebands.is_empty()) => {
            "Spectrum of the vibration's envelope: a peak is something that recurs so many times a second. Dashed: the rate that was found and its multiples; peaks there are the evidence. Other peaks are the shaft's or come from elsewhere."
        }
        (true, Verdict::Damage) => {
            "Spectrum of the vibration's envelope: a peak is something that recurs so many times a second. Dashed: the rate that was found and its multiples; peaks there are the evidence. Short marks above: sidebands. Other peaks are the shaft's or come from elsewhere."
        }
        (true, _) if lead.has_no_bearing() => {
            "Spectrum of the vibration's envelope: a peak is something that recurs so many times a second. Dashed: the rate of the strongest regular impacts and its multiples."
        }
        (true, _) => {
            "Spectrum of the vibration's envelope: a peak is something that recurs so many times a second. Dashed: the rate of the strongest regular impacts and its multiples, which is none of this bearing's."
        }
        (false, _) if lead.has_no_bearing() => {
            "Spectrum of the vibration's envelope: a peak is something that recurs so many times a second. No rate and its multiples stand out as damage of a race would make them."
        }
        (false, _) => {
            "Spectrum of the vibration's envelope: a peak is something that recurs so many times a second. Marks above: where damage of each part would have its peaks. High peaks without a mark are the shaft's or the mains', or come from elsewhere."
        }
    }
}
