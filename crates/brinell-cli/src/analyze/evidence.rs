//! The verdicts on a page of several signals, and what they rest on: of those that say most.

use super::rows::{Each, Row};
use brinell_report::{Chapter, Evidence, Piece, Table, Tone};

/// Signals whose envelope spectrum the page has.
const MOST: usize = 8;

/// Rows with evidence: damage first, the highest score at the head, then what cannot be told, then the others.
fn most_telling(rows: &[Row]) -> Vec<(usize, &Evidence)> {
    let all = rows.iter().enumerate().filter_map(|(k, row)| Some((k, row.found.as_ref().ok()?.evidence.as_deref()?)));
    let mut all: Vec<(usize, &Evidence)> = all.collect();
    all.sort_by(|a, b| a.1.before(b.1));
    all
}

/// Lets go of what the page will not show.
pub(super) fn keep_most_telling(rows: &mut [Row]) {
    let left: Vec<usize> = most_telling(rows).into_iter().skip(MOST).map(|(k, _)| k).collect();
    for k in left {
        if let Ok(found) = &mut rows[k].found {
            found.evidence = None;
        }
    }
}

/// Each verdict in words, and of those that say most what it rests on; `called` is what the table calls a row.
pub(super) fn chapter(rows: &[Row], each: Each, called: impl Fn(usize) -> String) -> Option<Chapter> {
    let shown = most_telling(rows);
    let is_shown = |k: usize| shown.iter().any(|(shown, _)| *shown == k);
    let told = rows.iter().enumerate().filter_map(|(k, row)| Some((k, row.found.as_ref().ok()?)));
    let (mut left, mut others) = (0, Vec::new());
    for (k, found) in told.filter(|(k, _)| !is_shown(*k)) {
        left += usize::from(!found.too_short);
        others.extend(found.sentences.iter().map(|sentence| vec![called(k), sentence.clone()]));
    }
    let mut pieces = Vec::new();
    if left > 0 {
        pieces.push(Piece::Note(format!(
            "Of {}, the {} whose verdicts say most have their envelope spectrum here: damage by its score, then what cannot be told, then what has lines at a defect frequency. That of another one: {}.",
            shown.len() + left,
            shown.len(),
            each.alone()
        )));
    }
    if !shown.is_empty() {
        pieces.push(Evidence::note());
    }
    for (place, (k, evidence)) in shown.iter().enumerate() {
        let tone = evidence.tone();
        let sentences = rows[*k].found.iter().flat_map(|found| &found.sentences);
        pieces.push(Piece::Heading(called(*k)));
        pieces.push(Piece::Verdict(tone, sentences.cloned().collect::<Vec<_>>().join(" ")));
        pieces.push(evidence.folded(k + 1, place == 0 && tone == Tone::Bad));
    }
    if !others.is_empty() {
        let title = if shown.is_empty() { "" } else { "Other verdicts" };
        pieces.push(Piece::Table(Table::new(title, [each.heading(), "Verdict"], others, "")));
    }
    (!pieces.is_empty()).then(|| Chapter::new("verdicts", "Verdicts", "Verdicts", pieces))
}
