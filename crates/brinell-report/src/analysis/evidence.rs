//! On a page of several signals: what the verdict on one of them rests on.

use std::cmp::Ordering;
use std::sync::Arc;

use super::content::LANES;
use super::page::envelope;
use super::{AnalysisReport, Findings};
use crate::data::Tone;
use crate::embedded::Plot;
use crate::frame::THINNED;
use crate::layout::Layout;
use crate::markup::escape;
use crate::page::{Figure, Folded, Piece};
use crate::tables::Table;
use brinell::analysis::{Analysis, Finding, Verdict};

/// Lines that an envelope spectrum keeps for zooming.
const KEPT: usize = 4096;

/// The highest score of a damage.
pub(crate) fn highest_score(a: &Analysis) -> Option<f64> {
    a.causes().map(|family| family.score).max_by(f64::total_cmp)
}

/// How much a verdict says: damage by its score, then what cannot be told.
pub(crate) fn weight(score: Option<f64>, verdict: Verdict) -> (f64, bool) {
    (score.unwrap_or(f64::NEG_INFINITY), verdict == Verdict::CannotTell)
}

/// A signal's envelope spectrum with its marks, and its lines, without its samples.
#[derive(Clone, Debug)]
pub struct Evidence {
    report: Arc<AnalysisReport>,
    weight: (f64, bool),
    /// The highest score of lines that are present, damage or not.
    present: f64,
}

impl Evidence {
    /// That of the bearing that leads.
    pub fn of(findings: &Findings) -> Self {
        let a = findings.signal.analysis;
        let present = a.families.iter().filter(|family| family.finding != Finding::Silent);
        Self {
            report: Arc::new(AnalysisReport::evidence(findings)),
            weight: weight(highest_score(a), a.conclusion()),
            present: present.map(|family| family.score).fold(0.0, f64::max),
        }
    }

    /// Whether its verdict is good, bad or neither.
    pub fn tone(&self) -> Tone {
        self.report.tone
    }

    /// Damage before what cannot be told before what has none, the highest score first, and then what has lines.
    pub fn before(&self, other: &Self) -> Ordering {
        let ((a, a_open), (b, b_open)) = (self.weight, other.weight);
        b.total_cmp(&a).then(b_open.cmp(&a_open)).then(other.present.total_cmp(&self.present))
    }

    /// How all of them are read.
    pub fn note() -> Piece {
        Piece::Note(format!("Each has a scale of its own. {LANES} {THINNED}"))
    }

    /// Under a line that opens it; `number` tells its picture from those of the others.
    pub fn folded(&self, number: usize, open: bool) -> Piece {
        let note = self.report.envelopes.first().map_or(String::new(), |s| escape(&s.note));
        let of = Arc::new((Arc::clone(&self.report), number));
        let id = format!("envelope-{number}");
        let spectrum = Figure::plot(id, note, &of, |(report, number), layout| numbered(report, *number, layout));
        let lines = self.report.tables.iter().map(|table| Table { title: String::new(), ..table.clone() });
        Piece::Folded(Folded {
            title: "Envelope spectrum and defect frequencies".into(),
            open,
            pieces: std::iter::once(Piece::Figure(spectrum)).chain(lines.map(Piece::Table)).collect(),
        })
    }
}

fn numbered(report: &AnalysisReport, number: usize, layout: Layout) -> Plot<'_> {
    let mut plot = envelope(report, layout);
    plot.id = format!("envelope-{number}");
    plot.spec.name = format!("envelope-spectrum-{number}");
    plot.spec.title = format!("Envelope spectrum: {}", report.names.first().map_or("", |name| name));
    Plot { most: KEPT, ..plot }
}
