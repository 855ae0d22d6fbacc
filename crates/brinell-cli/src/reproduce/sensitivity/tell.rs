//! The sensitivity and the search as files and the page show them.

use super::{BEST, Candidate, SEED, Sensitivity};
use crate::say::short;
use brinell::paper::{Judged, RANGES, SEARCHED, Values, Variant, Verdict, claims};
use brinell_report::{Chapter, StudyPiece, Table};
use serde_json::{Value, json};

impl Sensitivity {
    pub(in super::super) fn json(&self) -> Value {
        let candidate = |c: &Candidate| {
            let settings: serde_json::Map<String, Value> = c
                .draw
                .settings
                .iter()
                .map(|(k, v)| (k.clone(), v.as_str().into()))
                .collect();
            json!({
                "draw": c.draw.number, "settings": settings, "behind_filter": c.draw.filtered, "claims_held": c.held(),
                "claims_checkable": c.checkable(), "rms_distance": c.distance.rms, "rms_m_per_s2": c.distance.values,
                "frequency_off_hz": c.distance.frequency,
                "verdicts": c.judged.iter().map(|(claim, j)| (claim.id.to_owned(), j.verdict.words().into())).collect::<serde_json::Map<_, Value>>(),
            })
        };
        let variant = |(v, judged): &(&Variant, Vec<Judged>)| {
            let verdicts = claims().zip(judged);
            json!({
                "id": v.id, "about": v.aspect.words(), "is": v.words,
                "settings": v.settings.iter().map(|(k, x)| ((*k).to_owned(), (*x).into())).collect::<serde_json::Map<_, Value>>(),
                "verdicts": verdicts.map(|(c, j)| (c.id.to_owned(), j.verdict.words().into())).collect::<serde_json::Map<_, Value>>(),
            })
        };
        json!({
            "turns": self.turns, "variants": self.variants.iter().map(variant).collect::<Vec<_>>(),
            "search": { "design": "Latin hypercube, particle swarm, Levenberg-Marquardt, as in `brinell calibrate`", "seed": SEED, "draws": self.drawn, "cases": SEARCHED,
                "best": self.candidates.iter().map(candidate).collect::<Vec<_>>() },
        })
    }

    /// The page's chapters.
    pub(in super::super) fn chapters(&self) -> Vec<Chapter> {
        vec![
            Chapter {
                id: "sensitivity".into(),
                short: "Sensitivity".into(),
                title: "What the claims depend on".into(),
                pieces: vec![
                    StudyPiece::Words(format!(
                        "Each unstated assumption made otherwise, one at a time, in every case; {} turns a run, so that more is undecided \
                         than in the claims table. A claim depends on an assumption where its verdict turns: what held no longer does, or \
                         holds in part alone, or the other way round. Undecided turns nothing.",
                        self.turns
                    )),
                    StudyPiece::Table(self.legend()),
                    StudyPiece::Table(self.matrix()),
                ],
            },
            Chapter {
                id: "search".into(),
                short: "Search".into(),
                title: "Is there one set of assumptions?".into(),
                pieces: self.search(),
            },
        ]
    }

    fn legend(&self) -> Table {
        let rows = self.variants.iter().enumerate().map(|(k, (v, judged))| {
            let held = judged
                .iter()
                .filter(|j| j.verdict == Verdict::Holds)
                .count();
            let number = k.to_string();
            vec![
                number,
                v.aspect.words().into(),
                v.words.into(),
                held.to_string(),
            ]
        });
        Table {
            title: "Assumptions".into(),
            columns: ["#No.", "About", "Assumed (instead of)", "#Claims that hold"]
                .map(str::to_owned)
                .to_vec(),
            rows: rows.collect(),
            note: String::new(),
        }
    }

    fn matrix(&self) -> Table {
        let mut columns = vec!["Claim".to_owned()];
        columns.extend((0..self.variants.len()).map(|k| k.to_string()));
        let rows = claims()
            .enumerate()
            .filter(|(_, c)| !c.statements.is_empty());
        let rows = rows.map(|(k, claim)| {
            let marks = self
                .variants
                .iter()
                .map(|(_, judged)| mark(judged[k].verdict));
            [claim.id.to_owned()]
                .into_iter()
                .chain(marks.map(str::to_owned))
                .collect()
        });
        Table {
            title: "Verdicts under each".into(),
            columns,
            rows: rows.collect(),
            note: "Numbers as above. + holds, − does not hold, ± holds in part, ? undecided, · not computed.".into(),
        }
    }

    fn search(&self) -> Vec<StudyPiece> {
        let mut pieces = vec![StudyPiece::Words(format!(
            "{} sets of assumptions, looked for as `brinell calibrate` does (a Latin hypercube over the ranges below, a swarm, then downhill; \
             seed {SEED}) to meet the paper's three RMS values and its defect frequency, the outer ring seen with or without the anti-alias \
             filter. Each was run in three cases: the full model with the irregular and with the simplified defect, the reference model with the \
             simplified one. All were then scored by the share of statements about these cases that do not hold, plus the root mean square of \
             ln(ours/paper's) over the three RMS values. The best {BEST} were run in all cases.",
            self.drawn
        ))];
        pieces.push(StudyPiece::Words(self.found()));
        let mut columns = vec!["Quantity".to_owned(), "#Paper".to_owned()];
        columns.extend(
            self.candidates
                .iter()
                .map(|c| format!("#Set {}", c.draw.number)),
        );
        let mut rows = Vec::new();
        let mut row = |name: &str, paper: &str, of: &dyn Fn(&Candidate) -> String| {
            let mut row = vec![name.to_owned(), paper.to_owned()];
            row.extend(self.candidates.iter().map(of));
            rows.push(row);
        };
        row("Claims that hold, of the checkable", "", &|c| {
            format!("{} of {}", c.held(), c.checkable())
        });
        row("RMS full, irregular (m/s²)", "30.414", &|c| {
            short(c.distance.values[0], 4)
        });
        row("RMS full, simplified (m/s²)", "32.06", &|c| {
            short(c.distance.values[1], 4)
        });
        row("RMS reference, simplified (m/s²)", "29.01", &|c| {
            short(c.distance.values[2], 4)
        });
        row("Distance of the three RMS", "0", &|c| {
            short(c.distance.rms, 3)
        });
        row("Defect frequency less 249.40 Hz", "0", &|c| {
            c.distance.frequency.map_or("–".into(), |f| short(f, 3))
        });
        row("Outer ring behind the filter", "", &|c| {
            if c.draw.filtered { "yes" } else { "no" }.into()
        });
        for range in RANGES {
            for key in range.keys {
                let of = |c: &Candidate| {
                    let found = c.draw.settings.iter().find(|(k, _)| k == key);
                    found.map_or("–".into(), |(_, v)| v.clone())
                };
                row(key, "", &of);
            }
        }
        pieces.push(StudyPiece::Table(Table {
            title: "The nearest sets".into(),
            columns,
            rows,
            note: "Distance: root mean square of ln(ours/paper's); 0.05 is 5 %.".into(),
        }));
        pieces.push(StudyPiece::Table(ranges()));
        pieces
    }

    /// What the search says, in a sentence or two.
    pub(in super::super) fn found(&self) -> String {
        let Some(best) = self.candidates.first() else {
            return "No set came through the search.".into();
        };
        let (held, of) = (best.held(), best.checkable());
        let most = 2 * held > of;
        let near = best.distance.rms < 0.05;
        let head = match (most, near) {
            (true, true) => {
                "A set was found under which most of the checkable claims hold and the RMS values are met within 5 %"
            }
            (true, false) => {
                "A set was found under which most of the checkable claims hold, but not one that meets the RMS values within 5 %"
            }
            (false, _) => {
                "No set was found under which most of the checkable claims hold; the nearest is this one"
            }
        };
        let values: Vec<String> = best.distance.values.iter().map(|x| short(*x, 4)).collect();
        let mut text = format!(
            "{head}: set {}, {held} of {of} claims, RMS {} m/s² against 30.414, 32.06 and 29.01 (distance {}).",
            best.draw.number,
            values.join(", "),
            short(best.distance.rms, 3)
        );
        let off: Vec<&str> = best
            .judged
            .iter()
            .filter(|(_, j)| matches!(j.verdict, Verdict::Fails | Verdict::Partly))
            .map(|(claim, _)| claim.id)
            .collect();
        if !off.is_empty() {
            text += &format!(
                " Under it these do not hold, or in part alone: {}.",
                off.join(", ")
            );
        }
        text
    }
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

fn ranges() -> Table {
    let rows = RANGES.iter().map(|range| {
        let values = match range.values {
            Values::Between(low, high) => format!("{low:e} to {high:e}"),
            Values::OneOf(all) => {
                let one = |values: &&[&str]| values.join(", ");
                all.iter().map(one).collect::<Vec<_>>().join(" | ")
            }
        };
        vec![range.keys.join(", "), values, range.why.into()]
    });
    Table {
        title: "Ranges of the search".into(),
        columns: ["Key", "Range", "Why"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
        note: "Ranges are drawn from evenly in the logarithm.".into(),
    }
}
