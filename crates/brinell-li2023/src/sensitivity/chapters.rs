//! The sensitivity and the search as files and the page show them.

use super::{BEST, Candidate, Nearest, SEED, Sensitivity, Tried};
use crate::{Length, RANGES, READ_AS, RECORDS, RMS, SEARCHED, Values, Verdict, claims};
use brinell::signal::objects;
use brinell_report::short;
use brinell_report::{Chapter, Piece, Table};
use serde_json::Value;

objects! {
    /// `sensitivity` of claims.json.
    Written { length: String, variants: Vec<Variant>, search: Search }
    /// The claims under one assumption made otherwise.
    Variant {
        id: &'static str, about: &'static str, is: &'static str, eq_27: &'static str, behind_filter: bool,
        record: String, rms_m_per_s2: Vec<Option<f64>>, settings: Value, verdicts: Value,
    }
    /// A search for one set of assumptions.
    Search {
        design: &'static str, seed: u64, draws: usize, cases: &'static [&'static str], by_record: Vec<Near>, best: Vec<Set>,
    }
    /// The set that is nearest to the paper's RMS values, by the stretch of the record.
    Near {
        record: String, sets: usize, draw: Option<usize>, rms_distance: Option<f64>,
        rms_m_per_s2: Option<[f64; 3]>,
    }
    /// A set of assumptions that was run in all cases.
    Set {
        draw: usize, settings: Value, behind_filter: bool, record: String, eq_27: &'static str,
        claims_held: usize, claims_checkable: usize, rms_distance: f64, rms_m_per_s2: [f64; 3],
        frequency_off_hz: Option<f64>, verdicts: Value,
    }
}

/// In files.
fn variant(Tried { variant: v, judged, numbers }: &Tried) -> Variant {
    let read = numbers.read(v.reading);
    let rms = SEARCHED.iter().map(|case| read.get(case, "outer_ax.rms").map(|n| n.value));
    Variant {
        id: v.id,
        about: v.about,
        is: v.words,
        eq_27: v.outline.words(),
        behind_filter: v.reading.filtered,
        record: v.reading.record.words(),
        rms_m_per_s2: rms.collect(),
        settings: v.settings.iter().copied().collect(),
        verdicts: claims().zip(judged).map(|(claim, j)| (claim.id, j.plain.words())).collect(),
    }
}

/// In files.
fn set(c: &Candidate) -> Set {
    Set {
        draw: c.draw.number,
        settings: c.draw.settings.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect(),
        behind_filter: c.draw.reading.filtered,
        record: c.draw.reading.record.words(),
        eq_27: c.draw.outline.words(),
        claims_held: c.held(),
        claims_checkable: c.checkable(),
        rms_distance: c.distance.rms,
        rms_m_per_s2: c.distance.values,
        frequency_off_hz: c.distance.frequency,
        verdicts: c.judged.iter().map(|(claim, j)| (claim.id, j.verdict.words())).collect(),
    }
}

impl Sensitivity {
    pub(crate) fn json(&self) -> Value {
        let near = |Nearest { record, sets, best }: &Nearest| Near {
            record: record.words(),
            sets: *sets,
            draw: best.as_ref().map(|b| b.0),
            rms_distance: best.as_ref().map(|b| b.1.rms),
            rms_m_per_s2: best.as_ref().map(|b| b.1.values),
        };
        let written = Written {
            length: self.length.words(),
            variants: self.variants.iter().map(variant).collect(),
            search: Search {
                design: "Latin hypercube, particle swarm, Levenberg-Marquardt, as in `brinell calibrate`",
                seed: SEED,
                draws: self.drawn,
                cases: SEARCHED,
                by_record: self.nearest.iter().map(near).collect(),
                best: self.candidates.iter().map(set).collect(),
            },
        };
        serde_json::to_value(written).unwrap_or_default()
    }

    /// The page's chapters.
    pub(crate) fn chapters(&self) -> Vec<Chapter> {
        let pieces = vec![
            Piece::Words(intro(self.length)),
            Piece::Table(self.three_rms()),
            Piece::Table(self.legend()),
            Piece::Table(self.matrix()),
        ];
        vec![
            Chapter::new("sensitivity", "Sensitivity", "What the claims depend on", pieces),
            Chapter::new("search", "Search", "Is there one set of assumptions?", self.search()),
        ]
    }

    fn legend(&self) -> Table {
        let rows = self.variants.iter().enumerate().map(|(k, tried)| {
            vec![k.to_string(), tried.variant.about.into(), tried.variant.words.into(), tried.held().to_string()]
        });
        Table::new("Assumptions", ["#No.", "About", "Assumed (instead of)", "#Claims that hold"], rows, "")
    }

    fn matrix(&self) -> Table {
        let mut columns = vec!["Claim".to_owned()];
        columns.extend((0..self.variants.len()).map(|k| k.to_string()));
        let rows = claims().enumerate().filter(|(_, c)| !c.statements.is_empty());
        let rows = rows.map(|(k, claim)| {
            let marks = self.variants.iter().map(|tried| mark(tried.judged[k].plain));
            [claim.id.to_owned()].into_iter().chain(marks.map(str::to_owned)).collect()
        });
        Table::new(
            "Verdicts under each",
            columns,
            rows,
            "Numbers as above. + holds, − does not hold, ± holds in part, ? undecided, · not computed.",
        )
    }

    fn search(&self) -> Vec<Piece> {
        let words = format!(
            "{} sets of assumptions, looked for as `brinell calibrate` does (a Latin hypercube over the ranges below, a swarm, then downhill; \
             seed {SEED}) to meet the paper's three RMS values, its defect frequency and the statements about three cases: the full model with \
             the irregular and with the simplified defect, the reference model with the simplified one, 0.3 s each. One search chooses the \
             stretch of the record with everything else; a second keeps to the steady part. All were then scored by the share of statements \
             about these cases that do not hold, plus the root mean square of ln(ours/paper's) over the three RMS values. The best {BEST} were \
             run in all cases.",
            self.drawn
        );
        vec![
            Piece::Words(words),
            Piece::Words(self.found()),
            Piece::Table(self.by_record()),
            Piece::Table(self.best_sets()),
            Piece::Table(ranges()),
        ]
    }

    /// What the search says, in a sentence or two.
    pub(crate) fn found(&self) -> String {
        let Some(best) = self.candidates.first() else {
            return "No set came through the search.".into();
        };
        let (held, of) = (best.held(), best.checkable());
        let single = self.variants.iter().filter(|tried| tried.variant.changes_one());
        let single = single.map(|tried| (tried.held(), tried.variant));
        let single = single.max_by_key(|(held, _)| *held).filter(|(most, _)| *most >= held);
        let most = 2 * held > of;
        let near = best.distance.rms < 0.05;
        let head = match (most, near) {
            (true, true) => {
                "A set was found under which most of the checkable claims hold and the RMS values are met within 5 %"
            }
            (true, false) => {
                "A set was found under which most of the checkable claims hold, but not one that meets the RMS values within 5 %"
            }
            (false, _) => "Under no set of the search do most of the checkable claims hold; the one with most of them",
        };
        let values: Vec<String> = best.distance.values.iter().map(|x| short(*x, 4)).collect();
        let [irregular, simplified, reference] = RMS;
        let mut text = format!(
            "{head}: set {}, {held} of {of} claims, RMS {} m/s² against {irregular}, {simplified} and {reference} (distance {}).",
            best.draw.number,
            values.join(", "),
            short(best.distance.rms, 3)
        );
        if let Some((held, variant)) = single {
            text += &format!(" With one assumption changed {held} hold: {}, {}.", variant.about, variant.words);
        }
        let off: Vec<&str> = best
            .judged
            .iter()
            .filter(|(_, j)| matches!(j.plain, Verdict::Fails | Verdict::Partly))
            .map(|(claim, _)| claim.id)
            .collect();
        if !off.is_empty() {
            text +=
                &format!(" Under set {} these do not hold, or in part alone: {}.", best.draw.number, off.join(", "));
        }
        text
    }
}

/// What the tables are of, in runs of a length.
pub(crate) fn intro(length: Length) -> String {
    format!(
        "Each assumption made otherwise, one at a time, in every case. Start and film are among them: the paper states both for section 4.1, and \
         the baseline departs from it. {} a run and one start, so that more is undecided than in the claims table. A claim depends on an \
         assumption where its verdict is another than under number 0, which changes nothing in runs of this length: what held no longer does, \
         or holds in part alone, or the other way round. Undecided counts neither as holding nor as failing: where number 0 or the other is \
         undecided, nothing is said to depend, so that a list of what turns a claim can be too short. It can be too long as well: across the load \
         an interval of one start is too narrow (How verdicts come about). Where RMS and peak to peak are of a record from t = 0 there is no \
         interval: such verdicts compare single values.",
        length.words()
    )
}

fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "+",
        Verdict::Fails => "−",
        Verdict::Partly => "±",
        Verdict::Undecided => "?",
        Verdict::Missing | Verdict::NotCheckable => "·",
    }
}

pub(crate) fn ranges() -> Table {
    let rows = RANGES.iter().map(|range| {
        let values = match &range.values {
            Values::Between(low, high) => format!("{low:e} to {high:e}"),
            Values::OneOf(all) => {
                let one = |values: &Vec<&str>| values.join(", ");
                all.iter().map(one).collect::<Vec<_>>().join(" | ")
            }
        };
        vec![range.keys.join(", "), values, range.why.into()]
    });
    let mut rows: Vec<Vec<String>> = rows.collect();
    let others = [
        (
            "Eq. (27)",
            READ_AS.iter().map(|o| o.words().to_owned()).collect::<Vec<_>>(),
            "what is printed, mended or not",
        ),
        ("RMS over", RECORDS.iter().map(|r| r.words()).collect(), "the paper states no record"),
        ("Filter", vec!["none".into(), "anti-alias".into()], "likewise"),
    ];
    rows.extend(others.map(|(key, all, why)| vec![key.into(), all.join(" | "), why.into()]));
    Table::new("Ranges of the search", ["Key", "Range", "Why"], rows, "Ranges are drawn from evenly in the logarithm.")
}
