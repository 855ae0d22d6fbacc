//! The reproduction as one page.

use crate::cases::{RAMP_MS, under};
use crate::curves::Curves;
use crate::outcome::{self, Outcome, card, counts};
use crate::reproduction::Reproduction;
use crate::request::Request;
use crate::{BASE, Basis, EXPERIMENTS, Length, Verdict};
use crate::{believe, figures, survives};
use brinell::made_by::MadeBy;
use brinell::scenario::{Laws, Scenario};
use brinell_report::{Chapter, DamageView, Fact, Page, Piece, Table, capital};

/// How verdicts come about, in words, after what intervals are.
const RULES: [&str; 8] = [
    "“A exceeds B” is decided by the interval of the ratio of the two means: it holds where that excludes equality, however near to 1 it lies, \
     does not hold where it lies at or below it, and is undecided otherwise. “Near” holds where the interval lies wholly within the stated \
     bounds, and does not hold where it lies wholly outside. Trends are decided by the ratios of neighbours: a step whose interval includes \
     equality may go either way, and a trend holds where it holds whichever way such steps go, does not hold where it fails whichever way \
     they go.",
    "A claim holds where all its statements do, in part where some hold and others do not, and does not hold where none does. What is \
     undecided leaves the claim undecided where it could change that: beside statements that do not hold, the claim holds in part at most. \
     Where the paper names no direction and no speed, both directions and all its speeds are judged; the three RMS values of section 4.5 and \
     what compares them are taken in x. Each interval is for one comparison; of twenty true \
     equalities one is expected to look decided. What is read off a shape has no interval.",
    "An interval of one start, as those under assumptions, with other models and with --quick, knows of no motion slower than its run. Along the \
     load it holds; across it is too narrow. Of 128 runs of 240 turns, eight starts of each case with the full model, 95 % intervals of one \
     start held the mean over the eight in 120 and 121 for the RMS of outer and inner ring in x, in 112 and 102 in y, and in 101 for entry \
     peaks; of 71 runs of 8 s, 4 to 10 a case with loads that differ by 10⁻⁵, in 69 and 69 in x, 59 and 61 in y. Each run is part of the \
     mean that it is held against, which flatters these counts by one to three in a hundred. So a crosswise verdict of \
     one start near equality may turn with the start.",
    "A claim that does not hold as it is read first, and does under another reading of what the paper leaves open, is undecided, and the verdict \
     says what it hangs on. A verdict that rests on our reading of the paper’s Ref. [43] says so: the paper describes that model and defect no \
     further, and another reading may give another verdict.",
    "What is taken from t = 0 on contains one start-up, and a run has one. Such values have no interval, and comparing two of them decides \
     whichever is larger.",
    "“Significant”, “greatly” and the like are read as a factor of 1.5, and where that is not so the claim says why.",
    "Baseline: the printed stiffness with n = 10/9, 10 µm of clearance at the inner contact, a point-like roller path, the law of effective \
     contact length, a start in pure rolling, a load ramp of 20 ms, the dynamic film instead of the printed Eq. (42), instantaneous \
     accelerations of the outer ring; supports, viscosity, cage contact and stagger are the program’s defaults, since the paper states none. \
     Start and film are departures from section 4.1, which starts from rest and prints Eq. (42).",
    "Two choices were made knowing what the paper prints. The runs of section 4.1 start rolling, as the paper’s later ones do, because from rest \
     with the dynamic film the defect lines lie 4 % below the printed ones. The cases “from t = 0” were chosen knowing the RMS values. Nothing \
     else was tuned to agree.",
];

/// What is said of intervals of one start, and of the baseline, of [`RULES`]: that of the paper's laws alone.
const OF_LI2023: [usize; 3] = [2, 6, 7];

/// What the laws of mechanics are here.
const MECHANICS: [&str; 3] = [
    "Laws: simulation.laws = \"mechanics\", that is exact geometry, damage as on elastic steel, contacts damped by a time, Palmgren’s stiffness in place \
     of the printed one, oiled cage walls, rolling resistance. All else is as under li2023: of the paper the bearing’s dimensions, masses and clearance, \
     speed, load and damage, the start in pure rolling, and a cage that the outer ring guides with a film, the dynamic one in place of Eq. (42); of the \
     baseline the supports with their damping, an outer ring without a housing, viscosity and stagger. So what differs is the laws’ doing. The reference model is the \
     paper’s and has its laws under either set. n = 1, a reading of the printed stiffness in the cases from t = 0, is left out: a half-space is a line \
     contact’s.",
    "Default values: the same cases with nothing set but the laws. Then the outer ring carries a housing of 20 times its mass, supports are damped by a \
     tenth of critical, and the cage is guided by its rollers, without a film. Each case has one start.",
    "The verdicts under li2023 are those of the whole reproduction, kept with the program. Sentences that no number decides, and those that find again \
     what goes in, as contact by effective length does under the paper’s laws, are left out. A verdict is reversed where what held does not, or the other \
     way round; it is not decided where intervals include both.",
];

/// What an interval is in runs of a length.
fn intervals(length: Length) -> String {
    let of = "Intervals are at 95 %, of averages over whole turns of the shaft, peaks those of a turn, from a turn after the load ramp on.";
    match length.starts() {
        1 => format!("{of} Each is of one start: it is made from how the run’s blocks of turns scatter."),
        n => format!(
            "{of} Each case is run from {n} starts, with load ramps of {} ms; a number is the mean over them, and its interval Student’s, from \
             how they scatter. Cases from t = 0 have one start.",
            (0..n).map(|k| (RAMP_MS - k).to_string()).collect::<Vec<_>>().join(", ")
        ),
    }
}

/// Everything that is said of how verdicts come about.
pub(crate) fn rules(length: Length, laws: Laws) -> Vec<String> {
    let own = RULES.iter().enumerate().filter(|(k, _)| laws == Laws::Li2023 || !OF_LI2023.contains(k));
    let more: &[&str] = if laws == Laws::Li2023 { &[] } else { &MECHANICS };
    let all = own.map(|(_, words)| words).chain(more);
    [intervals(length)].into_iter().chain(all.map(|words| (*words).to_owned())).collect()
}

pub(crate) fn study(
    reproduction: &Reproduction,
    curves: impl Fn(&str) -> Option<Curves>,
    plan: impl Fn(&Scenario) -> Option<DamageView>,
) -> Page {
    let request = &reproduction.request;
    let mut chapters = match &reproduction.beside {
        Some(all) => survives::chapters(all),
        None => {
            let mut all =
                vec![Chapter::new("believe", "What to believe", "What to believe", believe::pieces(reproduction))];
            all.extend(by_verdict(&reproduction.outcomes));
            all
        }
    };
    let figures =
        request.experiments.iter().map(|e| figures::chapter(e, request.laws, &reproduction.numbers, &curves, &plan));
    // Figures that were asked for are what the page is opened for.
    match request.experiments.len() < EXPERIMENTS.len() {
        true => chapters = figures.chain(chapters).collect(),
        false => chapters.extend(figures.map(Chapter::folded)),
    }
    if let Some(sensitivity) = &reproduction.sensitivity {
        chapters.extend(sensitivity.chapters());
    }
    chapters.extend(reproduction.models.as_ref().map(|models| models.chapter()));
    let mut rules: Vec<Piece> = rules(request.length, request.laws).into_iter().map(Piece::Words).collect();
    rules.push(Piece::Table(runs(request)));
    chapters.push(Chapter::new("rules", "Rules", "How verdicts come about", rules).folded());
    let scenario = vec![Piece::Code(BASE.into())];
    chapters.push(Chapter::new("scenario", "Base scenario", "Base scenario", scenario).folded());
    let mut warnings = Vec::new();
    if reproduction.interrupted {
        warnings.push("Interrupted: some runs are missing. The same command resumes.".into());
    }
    for (case, reason) in &reproduction.failures {
        warnings.push(format!("{case} failed: {reason}"));
    }
    let facts = facts(reproduction);
    Page {
        title: match request.laws {
            Laws::Li2023 => "Li et al. (2023), reproduced".into(),
            Laws::Mechanics => "Li et al. (2023) under the laws of mechanics".into(),
        },
        subtitle: format!(
            "Section 4 of “Dynamic modeling and vibration analysis of double row cylindrical roller bearings with irregular-shaped defects”; \
             {} a run{}",
            request.length.words(),
            match request.length.starts() {
                1 => String::new(),
                n => format!(", {n} starts a case"),
            }
        ),
        version: MadeBy::now().to_string(),
        warnings,
        lead: lead(request, &reproduction.outcomes),
        facts,
        chapters,
        footer: "Curves are thinned to the pixels of the page. Every statement with its numbers is in claims.csv and claims.json beside this \
                 page."
            .into(),
        ..Page::default()
    }
}

/// "3 of 4": how many of the dynamic claims hold.
fn dynamics(outcomes: &[Outcome]) -> String {
    let (holds, all) = outcome::held(outcomes, Basis::Dynamics);
    format!("{holds} of {all}")
}

/// The same of the claims that are not dynamic, where there are any: "1 of 2 about shapes".
fn others(outcomes: &[Outcome]) -> Vec<String> {
    let of = |(basis, about)| {
        let (holds, all) = outcome::held(outcomes, basis);
        (all > 0).then(|| format!("{holds} of {all} about {about}"))
    };
    [(Basis::Shapes, "shapes"), (Basis::Kinematics, "kinematics and slip")].into_iter().filter_map(of).collect()
}

/// The finding, and why it is so.
fn lead(request: &Request, outcomes: &[Outcome]) -> String {
    let dynamics = dynamics(outcomes);
    let of = |verdict| {
        let mine = outcomes.iter().filter(|o| o.claim.basis == Basis::Dynamics && !o.claim.statements.is_empty());
        mine.filter(|o| o.judged.verdict == verdict).count()
    };
    let quick = match request.length.starts() {
        1 => " by these short runs (without --quick more is decided)",
        _ => "",
    };
    let others = others(outcomes);
    let others = match others.is_empty() {
        true => String::new(),
        false => format!(" Of claims that are not dynamic {} are reproduced.", others.join(" and ")),
    };
    format!(
        "{dynamics} dynamic claims reproduced: {} do not hold, {} hold in part, {} are not decided{quick}. Why: the paper does not state supports, cage \
         contact, oil film, load ramp and filter, which decide many of them, and its own sentences contradict each other in places; each claim says what \
         it hangs on.{others}{}",
        of(Verdict::Fails),
        of(Verdict::Partly),
        of(Verdict::Undecided),
        outcome::not_counted(outcomes)
    )
}

/// The claims, a chapter a verdict; those that find again what goes in are last.
fn by_verdict(outcomes: &[Outcome]) -> Vec<Chapter> {
    let chapter = |(id, title, of): (String, String, Vec<&Outcome>)| {
        let title = format!("{title}: {} claim{}", of.len(), if of.len() == 1 { "" } else { "s" });
        Chapter::new(&id, &title, &title, vec![Piece::Claims(of.into_iter().map(card).collect())])
    };
    let counted = counts(outcomes).into_iter().map(|(verdict, _)| {
        let of = outcomes.iter().filter(|o| o.claim.counts() && o.judged.verdict == verdict);
        (format!("claims-{}", verdict.words().replace(' ', "-")), capital(verdict.words()), of.collect())
    });
    let trivial: Vec<&Outcome> = outcomes.iter().filter(|o| !o.claim.counts()).collect();
    let trivial = Some(("claims-trivial".to_owned(), "Trivial: they find again what goes in".to_owned(), trivial));
    counted.chain(trivial.filter(|of| !of.2.is_empty())).map(chapter).collect()
}

/// How many claims came out how.
fn facts(reproduction: &Reproduction) -> Vec<Fact> {
    let counts = counts(&reproduction.outcomes);
    let mut facts: Vec<Fact> = counts
        .iter()
        .map(|(verdict, n)| {
            let note = if *n == 1 { "claim" } else { "claims" };
            Fact::new(capital(verdict.words()), n.to_string(), "", note)
        })
        .collect();
    if reproduction.sensitivity.is_some() {
        let n = reproduction.outcomes.iter().filter(|outcome| !outcome.flips.is_empty()).count();
        facts.push(Fact::new("Depend on an assumption", n.to_string(), "", "of the above"));
    }
    let beside = others(&reproduction.outcomes);
    let beside = if beside.is_empty() { String::new() } else { format!("and {}", beside.join(", ")) };
    facts.insert(0, Fact::new("Dynamic claims reproduced", dynamics(&reproduction.outcomes), "", beside));
    facts
}

/// Every case with its settings.
pub(crate) fn runs(request: &Request) -> Table {
    let rows = request.points.iter().map(|point| {
        // What the laws have not is left out.
        let is_set = |(k, v): &&(&str, &str)| point.task.settings.iter().any(|(key, value)| key == k && value == v);
        let own = point.case.settings.iter().filter(is_set);
        let settings: Vec<String> = own.map(|(k, v)| format!("{k} = {v}")).collect();
        vec![point.case.id.into(), point.case.label.into(), settings.join("; "), format!("{}", point.task.duration_s)]
    });
    let more = match request.laws {
        Laws::Li2023 => String::new(),
        laws => {
            let all: Vec<String> = under(laws).iter().map(|(k, v)| format!("{k} = {v}")).collect();
            format!("Every case but the reference model’s also sets {}.", all.join("; "))
        }
    };
    Table::new("Runs", ["Case", "What", "Settings over the base scenario", "#Duration (s)"], rows, more)
}
