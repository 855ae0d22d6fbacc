//! Claims with their verdicts, as cards.

use std::fmt::Write as _;

use crate::data::Tone;
use crate::markup::escape;

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

fn tag(tagged: &Tagged) -> String {
    let class = match tagged.tone {
        Tone::Open => String::new(),
        tone => format!(" {}", tone.class()),
    };
    format!("<span class=\"tag{class}\">{}</span>", escape(&tagged.word))
}

pub(crate) fn claim(page: &mut String, card: &ClaimCard) {
    let _ = write!(
        page,
        "<details class=\"claim\">\n<summary><span class=\"place\">{} {}</span>\n<blockquote>{}</blockquote></summary>\n",
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
    page.push_str("</details>\n");
}
