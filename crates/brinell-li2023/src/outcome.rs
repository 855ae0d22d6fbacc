//! The claims as the page, the tables and the book show them.

use crate::Error;
use crate::figures::with_interval;
use crate::sensitivity::Flip;
use crate::{Basis, Claim, Found, Judged, Verdict};
use brinell::made_by::MadeBy;
use brinell::signal::objects;
use brinell_io::{Cells, Column, Table};
use brinell_report::{ClaimCard, ClaimPart, Tagged, Tone};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A claim with what came out, and which assumptions turn it.
pub struct Outcome {
    /// The claim.
    pub claim: &'static Claim,
    /// What the numbers decide.
    pub judged: Judged,
    pub(crate) flips: Vec<Flip>,
    /// Its verdict in the shorter runs that the flips are compared with, where assumptions were varied.
    pub(crate) unchanged: Option<Verdict>,
}

impl Outcome {
    /// The verdict, "depends" where an assumption turns it.
    pub fn words(&self) -> &'static str {
        if self.flips.is_empty() { self.judged.verdict.words() } else { "depends" }
    }

    /// Each statement with its verdict and its numbers; those of another reading after that reading's words.
    pub(crate) fn statements(&self) -> Vec<(String, Verdict, &[Found])> {
        let own = self.claim.statements.iter().zip(&self.judged.statements);
        let mut all: Vec<(String, Verdict, &[Found])> =
            own.map(|(s, (verdict, found))| (s.words.to_owned(), *verdict, found.as_slice())).collect();
        if let (Some(other), Some((_, judged))) = (&self.claim.otherwise, &self.judged.otherwise) {
            let more = other.statements.iter().zip(judged);
            all.extend(
                more.map(|(s, (verdict, found))| (format!("{}: {}", other.words, s.words), *verdict, found.as_slice())),
            );
        }
        all
    }

    /// Assumptions that turn it, by their ids: "outer-soft; path-envelope". Empty too where that is not known.
    fn turned_by(&self) -> String {
        self.flips.iter().map(|flip| flip.variant.id).collect::<Vec<_>>().join("; ")
    }

    /// "supports (outer ring on 1e5 N/m: does not hold); ...": what turns it, and the verdict that it turns where that
    /// is another than the claim's. Where the shorter runs decide nothing it says so.
    pub(crate) fn depends(&self) -> String {
        match self.unchanged {
            Some(Verdict::Undecided) if self.judged.plain != Verdict::Undecided => {
                return "what is not known: the shorter runs leave it undecided".into();
            }
            _ if self.flips.is_empty() => return String::new(),
            _ => {}
        }
        let one = |flip: &Flip| format!("{} ({}: {})", flip.variant.about, flip.variant.words, flip.verdict.words());
        let all = self.flips.iter().map(one).collect::<Vec<_>>().join("; ");
        match self.unchanged.filter(|verdict| *verdict != self.judged.plain) {
            Some(verdict) => format!("{all}; in the shorter runs, nothing changed: {}", verdict.words()),
            None => all,
        }
    }
}

/// A verdict with its colour.
pub(crate) fn tagged(verdict: Verdict) -> Tagged {
    Tagged {
        word: verdict.words().into(),
        tone: match verdict {
            Verdict::Holds => Tone::Good,
            Verdict::Fails => Tone::Bad,
            _ => Tone::Open,
        },
    }
}

/// Numbers behind a verdict, on one line.
pub(crate) fn ours(found: &[Found]) -> String {
    let one = |f: &Found| {
        // Lengths read better in millimetres.
        let (scale, unit) = match f.unit {
            "m" => (1e3, " mm"),
            "m/s^2" => (1.0, " m/s²"),
            "N" => (1.0, " N"),
            "Hz" => (1.0, " Hz"),
            _ => (1.0, ""),
        };
        let interval = f.interval.map(|(low, high)| (scale * low, scale * high));
        format!("{} {}{unit}", f.what, with_interval(f.value.map(|x| scale * x), interval))
    };
    found.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// As the page shows it.
pub(crate) fn card(outcome: &Outcome) -> ClaimCard {
    let statements = outcome.statements();
    let parts = statements.iter();
    ClaimCard {
        place: format!("{} · {}", outcome.claim.id, outcome.claim.place),
        sentence: outcome.claim.sentence.into(),
        printed: outcome.claim.paper.into(),
        verdict: Tagged { word: outcome.judged.words(outcome.claim), ..tagged(outcome.judged.verdict) },
        depends: outcome.depends(),
        parts: parts
            .map(|(words, verdict, found)| ClaimPart {
                verdict: tagged(*verdict),
                words: words.clone(),
                ours: ours(found),
            })
            .collect(),
        note: outcome.claim.note.into(),
    }
}

/// Verdicts and how many claims have each, in a fixed order; without those that hold by construction.
pub(crate) fn counts(all: &[Outcome]) -> Vec<(Verdict, usize)> {
    use Verdict::{Fails, Holds, Missing, NotCheckable, Partly, Undecided};
    [Holds, Partly, Fails, Undecided, Missing, NotCheckable]
        .into_iter()
        .map(|v| (v, all.iter().filter(|t| t.claim.counts() && t.judged.verdict == v).count()))
        .filter(|(_, count)| *count > 0)
        .collect()
}

/// "2 others are trivial, as they find again what goes in, and not counted": empty where there are none.
pub(crate) fn not_counted(all: &[Outcome]) -> String {
    match all.iter().filter(|t| !t.claim.counts()).count() {
        0 => String::new(),
        1 => " One other is trivial, as it finds again what goes in, and not counted.".into(),
        n => format!(" {n} others are trivial, as they find again what goes in, and not counted."),
    }
}

/// Claims with a verdict of a basis: how many of them hold.
pub(crate) fn held(all: &[Outcome], basis: Basis) -> (usize, usize) {
    let mine = || all.iter().filter(move |t| t.claim.basis == basis && !t.claim.statements.is_empty());
    let holds = mine().filter(|t| t.judged.verdict == Verdict::Holds);
    (holds.count(), mine().count())
}

/// claims.csv and claims.json.
pub(crate) fn write(all: &[Outcome], claims: &Claims, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let csv = table(all).write_csv(folder.join("claims.csv"))?;
    let path = folder.join("claims.json");
    let text = serde_json::to_string_pretty(claims).unwrap_or_default() + "\n";
    brinell_io::atomic_write(&path, text.as_bytes())?;
    Ok(vec![csv, path])
}

objects! {
    /// claims.json.
    Claims {
        brinell: &'static str, made_by: MadeBy, length: String, starts: u32, base_toml: &'static str, interval: &'static str,
        #[serde(skip_serializing_if = "Option::is_none")] sensitivity: Option<Value>,
        #[serde(skip_serializing_if = "Option::is_none")] laws: Option<&'static str>,
        claims: Vec<Judgement>,
    }
    /// A claim of `claims.json`.
    Judgement {
        id: &'static str, place: &'static str, sentence: &'static str, paper: &'static str, verdict: &'static str,
        in_words: String, about: &'static str, depends_on: Vec<Turning>, statements: Vec<Stated>, note: &'static str,
    }
    /// An assumption that turns it, and what it then is.
    Turning { assumption: &'static str, about: &'static str, is: &'static str, verdict: &'static str }
    /// A statement with the numbers behind it.
    Stated { statement: String, verdict: &'static str, ours: Vec<Ours> }
    /// One of them with its 95 % interval.
    Ours { what: String, value: Option<f64>, low: Option<f64>, high: Option<f64>, unit: &'static str }
}

pub(crate) fn judgement(outcome: &Outcome) -> Judgement {
    let Outcome { claim, judged, flips, .. } = outcome;
    let ours = |f: &Found| {
        let (low, high) = f.interval.unzip();
        Ours { what: f.what.clone(), value: f.value, low, high, unit: f.unit }
    };
    let stated = |(statement, verdict, all): (String, Verdict, &[Found])| Stated {
        statement,
        verdict: verdict.words(),
        ours: all.iter().map(ours).collect(),
    };
    let turning = |Flip { variant, verdict }: &Flip| Turning {
        assumption: variant.id,
        about: variant.about,
        is: variant.words,
        verdict: verdict.words(),
    };
    Judgement {
        id: claim.id,
        place: claim.place,
        sentence: claim.sentence,
        paper: claim.paper,
        verdict: judged.verdict.words(),
        in_words: judged.words(claim),
        about: claim.basis.words(),
        depends_on: flips.iter().map(turning).collect(),
        statements: outcome.statements().into_iter().map(stated).collect(),
        note: claim.note,
    }
}

/// A row a statement; a claim without any has one too.
fn table(all: &[Outcome]) -> Table {
    let mut columns: [Vec<Option<String>>; 10] = Default::default();
    for outcome in all {
        let claim = outcome.claim;
        let statements = outcome.statements();
        for k in 0..statements.len().max(1) {
            let one = statements.get(k);
            let cells = [
                Some(claim.id.to_owned()),
                Some(claim.place.to_owned()),
                Some(claim.sentence.to_owned()),
                Some(claim.paper.to_owned()),
                Some(outcome.judged.words(claim)),
                Some(claim.basis.words().to_owned()).filter(|_| one.is_some()),
                one.map(|s| s.0.clone()),
                one.map(|s| s.1.words().to_owned()),
                one.map(|s| ours(s.2)),
                Some(outcome.turned_by()),
            ];
            for (column, cell) in columns.iter_mut().zip(cells) {
                column.push(cell.filter(|text| !text.is_empty()));
            }
        }
    }
    let heads = [
        ("claim", "its name here"),
        ("place", "section and figure of the paper"),
        ("sentence", "the paper's words"),
        ("paper", "what it prints"),
        ("claim_verdict", "of all statements together, and what it is conditional on"),
        ("about", "what the verdict is a finding about"),
        ("statement", "what is checked"),
        ("verdict", "of the statement"),
        ("ours", "numbers with 95 % intervals"),
        ("depends_on", "ids of assumptions that turn the claim's verdict; none where that is not known"),
    ];
    let mut table = Table::default();
    for ((name, about), cells) in heads.into_iter().zip(columns) {
        table.push(Column::new(name, "", about), Cells::Words(cells));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Numbers, VARIANTS, claims, judge};

    #[test]
    fn prop_files_name_what_turns_a_claim_by_ids_alone() {
        let claim = claims().find(|claim| !claim.statements.is_empty()).unwrap();
        let outcome = |unchanged, flips: &[usize]| {
            let flip = |k: &usize| Flip { variant: &VARIANTS[*k], verdict: Verdict::Fails };
            let judged = Judged { plain: Verdict::Holds, ..judge(claim, &Numbers::default()) };
            Outcome { claim, judged, flips: flips.iter().map(flip).collect(), unchanged: Some(unchanged) }
        };
        let unknown = outcome(Verdict::Undecided, &[]);
        assert!(unknown.depends().starts_with("what is not known"));
        assert_eq!(unknown.turned_by(), "");
        assert!(judgement(&unknown).depends_on.is_empty());
        let known = outcome(Verdict::Holds, &[1, 2]);
        assert_eq!(known.turned_by(), "filter; record-100");
        let table = table(&[unknown, known]);
        let n = table.rows() / 2;
        let cells = [vec![None; n], vec![Some("filter; record-100".to_owned()); n]].concat();
        assert_eq!(table.cells.last(), Some(&Cells::Words(cells)));
    }
}
