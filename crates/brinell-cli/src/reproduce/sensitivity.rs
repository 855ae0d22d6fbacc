//! The claims under each unstated assumption, and the search for a set of assumptions that agrees best.

use super::points::{FromPaper, Point, numbers, point};
use crate::campaign::{Ledger, Task};
use crate::failure::Failure;
use crate::say::short;
use brinell::paper::{
    Aspect, CASES, Claim, Design, Distance, Draw, Hypercube, Judged, Length, Numbers, RANGES,
    SEARCHED, VARIANTS, Values, Variant, Verdict, case, claims, distance, judge,
};
use brinell_report::{Chapter, StudyPiece, Table};
use serde_json::{Value, json};

/// The search is a fixed one.
const SEED: u64 = 2023;
/// Sets that are looked at on all cases.
const BEST: usize = 3;

/// An assumption that turns a verdict.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flip {
    pub(super) variant: &'static Variant,
    pub(super) verdict: Verdict,
}

/// A variant's points; that of the filter has none of its own.
struct Varied {
    variant: &'static Variant,
    points: Vec<Point>,
}

/// Everything that the sensitivity needs to run.
pub(super) struct Plan {
    varied: Vec<Varied>,
    drawn: Vec<(Draw, Vec<Point>)>,
    length: Length,
}

/// A set of assumptions, looked at on all cases.
pub(super) struct Candidate {
    draw: Draw,
    /// Whether the outer ring is looked at behind the anti-alias filter.
    filtered: bool,
    distance: Distance,
    judged: Vec<(&'static Claim, Judged)>,
}

impl Candidate {
    fn held(&self) -> usize {
        let holds = |j: &&(_, Judged)| j.1.verdict == Verdict::Holds;
        self.judged.iter().filter(holds).count()
    }

    fn checkable(&self) -> usize {
        let checkable = |j: &&(_, Judged)| j.1.verdict != Verdict::NotCheckable;
        self.judged.iter().filter(checkable).count()
    }
}

/// What came out.
pub(super) struct Sensitivity {
    /// Each variant with the verdict of every claim.
    variants: Vec<(&'static Variant, Vec<Judged>)>,
    /// The best sets of the search, best first.
    candidates: Vec<Candidate>,
    /// Sets that were drawn.
    drawn: usize,
    turns: u32,
}

impl Plan {
    pub(super) fn new(quick: bool) -> Result<Self, Failure> {
        let length = if quick {
            Length::QUICK_VARIANT
        } else {
            Length::VARIANT
        };
        let varied = VARIANTS.iter().map(|variant| {
            let settings = owned(variant.settings);
            let points = CASES.iter().map(|case| point(case, &settings, length));
            Ok(Varied {
                variant,
                points: points.collect::<Result<_, Failure>>()?,
            })
        });
        let varied = varied.collect::<Result<_, Failure>>()?;
        let draws = Hypercube::new(if quick { 12 } else { 48 }, SEED).propose(&[]);
        let drawn = draws.into_iter().map(|draw| {
            let searched = SEARCHED.iter().filter_map(|id| case(id));
            let points = searched.map(|case| point(case, &draw.settings, length));
            let points = points.collect::<Result<_, Failure>>()?;
            Ok((draw, points))
        });
        Ok(Self {
            varied,
            drawn: drawn.collect::<Result<_, Failure>>()?,
            length,
        })
    }

    /// What runs first: variants and the cheap part of the search.
    pub(super) fn tasks(&self) -> impl Iterator<Item = &Task> {
        let varied = self.varied.iter().flat_map(|v| &v.points);
        let drawn = self.drawn.iter().flat_map(|d| &d.1);
        varied.chain(drawn).map(|point| &point.task)
    }

    /// The best sets so far, on all cases: what runs then. A set counts once, with the better reading of the filter.
    pub(super) fn finalists(&self, ledger: &Ledger) -> Result<Vec<Finalist>, Failure> {
        let mut scored: Vec<(f64, usize, bool)> = Vec::new();
        for (k, (_, points)) in self.drawn.iter().enumerate() {
            let plain = numbers(points, ledger);
            let both = [(plain.clone(), false), (plain.behind_filter(), true)];
            let scores = both
                .iter()
                .filter_map(|(n, filtered)| Some((score(n)?, k, *filtered)));
            scored.extend(scores.min_by(|a, b| a.0.total_cmp(&b.0)));
        }
        scored.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let best = scored.into_iter().take(BEST);
        best.map(|(_, k, filtered)| {
            let draw = self.drawn[k].0.clone();
            let points = CASES
                .iter()
                .map(|case| point(case, &draw.settings, self.length));
            Ok(Finalist {
                points: points.collect::<Result<_, Failure>>()?,
                draw,
                filtered,
            })
        })
        .collect()
    }

    pub(super) fn finish(&self, finalists: Vec<Finalist>, ledger: &Ledger) -> Sensitivity {
        let judged = |n: &Numbers| claims().map(|claim| judge(claim, n)).collect();
        let variants = self.varied.iter().map(|v| {
            let plain = numbers(&v.points, ledger);
            let numbers = match v.variant.aspect {
                Aspect::Filter => plain.behind_filter(),
                _ => plain,
            };
            (v.variant, judged(&numbers))
        });
        let candidates = finalists.into_iter().filter_map(|f| {
            let plain = numbers(&f.points, ledger);
            let numbers = if f.filtered {
                plain.behind_filter()
            } else {
                plain
            };
            Some(Candidate {
                distance: distance(&numbers)?,
                judged: claims()
                    .map(|claim| (claim, judge(claim, &numbers)))
                    .collect(),
                draw: f.draw,
                filtered: f.filtered,
            })
        });
        let mut candidates: Vec<Candidate> = candidates.collect();
        candidates.sort_by(|a, b| {
            let by_distance = a.distance.rms.total_cmp(&b.distance.rms);
            b.held().cmp(&a.held()).then(by_distance)
        });
        Sensitivity {
            variants: variants.collect(),
            candidates,
            drawn: self.drawn.len(),
            turns: self.length.turns,
        }
    }
}

/// A set of assumptions on its way to all cases.
pub(super) struct Finalist {
    draw: Draw,
    filtered: bool,
    pub(super) points: Vec<Point>,
}

fn owned(settings: &[(&str, &str)]) -> Vec<(String, String)> {
    let own = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
    settings.iter().map(own).collect()
}

/// Share of the statements that do not hold, of those that the searched cases decide, plus the distance from the paper's RMS values.
fn score(numbers: &Numbers) -> Option<f64> {
    let distance = distance(numbers)?;
    let searched = |claim: &&Claim| claim.cases().iter().all(|case| SEARCHED.contains(case));
    let verdicts: Vec<Verdict> = claims()
        .filter(searched)
        .flat_map(|claim| judge(claim, numbers).statements)
        .map(|(verdict, _)| verdict)
        .collect();
    let off = verdicts.iter().filter(|v| **v != Verdict::Holds).count();
    Some(off as f64 / verdicts.len().max(1) as f64 + distance.rms)
}

impl Sensitivity {
    /// Assumptions under which a claim that held fails, or one that failed holds.
    pub(super) fn flips(&self, place: usize, verdict: Verdict) -> Vec<Flip> {
        let turned = |other: Verdict| {
            use Verdict::{Fails, Holds, Partly};
            matches!(
                (verdict, other),
                (Holds, Fails | Partly) | (Fails, Holds | Partly) | (Partly, Holds | Fails)
            )
        };
        let all = self.variants.iter().filter_map(|(variant, judged)| {
            let other = judged[place].verdict;
            turned(other).then_some(Flip {
                variant,
                verdict: other,
            })
        });
        all.collect()
    }

    pub(super) fn json(&self) -> Value {
        let candidate = |c: &Candidate| {
            let settings: serde_json::Map<String, Value> = c
                .draw
                .settings
                .iter()
                .map(|(k, v)| (k.clone(), v.as_str().into()))
                .collect();
            json!({
                "draw": c.draw.number, "settings": settings, "behind_filter": c.filtered, "claims_held": c.held(),
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
            "search": { "design": "Latin hypercube", "seed": SEED, "draws": self.drawn, "cases": SEARCHED,
                "best": self.candidates.iter().map(candidate).collect::<Vec<_>>() },
        })
    }

    /// The page's chapters.
    pub(super) fn chapters(&self) -> Vec<Chapter> {
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

    pub(super) fn legend(&self) -> Table {
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

    pub(super) fn matrix(&self) -> Table {
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
            "{} sets of assumptions from a Latin hypercube over the ranges below (seed {SEED}), each run in three cases: the full model with \
             the irregular and with the simplified defect, the reference model with the simplified one. Scored by the share of statements \
             about these cases that do not hold, plus the root mean square of ln(ours/paper's) over the three RMS values, with and without \
             the anti-alias filter. The best {BEST} were run in all cases.",
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
            if c.filtered { "yes" } else { "no" }.into()
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
    pub(super) fn found(&self) -> String {
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

/// Points whose signals nobody asks for: only their numbers are kept.
pub(super) fn open<'a>(
    tasks: impl Iterator<Item = &'a Task>,
    work: &FromPaper,
    ledger: &Ledger,
    already: &mut Vec<Task>,
) {
    for task in tasks {
        let known = already.iter().any(|t| t.fingerprint == task.fingerprint);
        if !known && !work.is_done(task, ledger) {
            already.push(task.clone());
        }
    }
}
