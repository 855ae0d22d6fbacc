//! The chapters of a calibration.

use super::words::{calibration_undetermined, calibration_verdict, interval_text};
use crate::fact::Fact;
use crate::misfit::Tried;
use crate::number::{digits_beside, plural, short};
use crate::page::{Chapter, Page, Piece};
use crate::tables::Table;
use brinell::made_by::MadeBy;
use brinell_study::calibrate::identify::Direction;
use brinell_study::calibrate::search::STEP;
use brinell_study::calibrate::{Evaluation, Met, Outcome};

impl Page {
    /// What the page of a calibration shows: `calibrate.html` of `brinell calibrate`.
    pub fn of_outcome(of: &Outcome) -> Self {
        let all = &of.fit.evaluations;
        let failed: Vec<(String, String)> = (all.iter().enumerate())
            .filter(|(_, e)| e.answers.is_none())
            .map(|(k, _)| {
                let settings = of.settings(k);
                let texts: Vec<String> = settings.iter().map(|(k, v)| format!("{k} = {v}")).collect();
                let reason = of.reasons[k].clone().unwrap_or_default();
                (format!("{}: {}", k + 1, texts.join(", ")), reason)
            })
            .collect();
        let determined = of.found.iter().filter(|f| f.is_determined()).count();
        let names: Vec<&str> = of.found.iter().map(|f| f.key.name.as_str()).collect();
        let p_value = of.p_value().map_or("no degree of freedom".to_owned(), |p| format!("p-value {}", short(p, 2)));
        let mut facts = vec![
            Fact::new(
                "Chi-square",
                short(of.chi_square(), 3),
                "",
                format!("{}; {p_value}", plural(of.compared.len(), "target")),
            ),
            Fact::new("Keys determined", format!("{determined} of {}", of.found.len()), "", "by their 95 % interval"),
            Fact::new("Runs", all.len().to_string(), "", format!("the best is run {}", of.fit.best + 1)),
        ];
        if !failed.is_empty() {
            facts.push(Fact::new("Failed", failed.len().to_string(), "", "reasons below"));
        }
        let unmet = (!of.is_met()).then(|| "The targets are not met by the runs made.".to_owned());
        Self {
            title: format!("Calibration of {}", of.best.scenario.name),
            subtitle: format!("{} to {}", names.join(", "), plural(of.compared.len(), "target")),
            version: MadeBy::now().to_string(),
            warnings: unmet.into_iter().chain(of.warnings.iter().cloned()).collect(),
            lead: calibration_verdict(of).into_iter().next().unwrap_or_default(),
            facts,
            chapters: chapters(of, failed),
            footer: "All runs are in calibrate.csv, all numbers in calibrate.json; best.toml is the best scenario."
                .into(),
            ..Self::default()
        }
    }
}

fn chapters(of: &Outcome, failed: Vec<(String, String)>) -> Vec<Chapter> {
    let found = of.found.iter().map(|f| Fact::new(&f.key.name, short(f.best, 5), f.unit, interval_text(f)));
    let mut outcome = sentences(calibration_verdict(of));
    outcome.push(Piece::Facts(found.collect()));
    let mut misfits = vec![Piece::Note(MISFITS.into())];
    misfits.extend((0..of.found.len()).map(|k| Piece::Misfit(of.found[k].clone(), tried(of, k))));
    let course = Piece::Course(of.fit.evaluations.iter().map(|e| e.chi_square).collect());
    let undetermined = "What the data do not determine";
    let mut chapters = vec![
        Chapter::new("outcome", "Outcome", "Outcome", outcome),
        Chapter::new("undetermined", "Not determined", undetermined, sentences(calibration_undetermined(of))),
        Chapter::table("targets", "Targets", targets(of)),
        Chapter::new("keys", "Misfit", "Misfit over each key", misfits),
        Chapter::new("course", "Course", "Course of the search", vec![course]),
        Chapter::table("directions", "Directions", directions(of)),
    ];
    if of.found.len() > 1 {
        chapters.push(Chapter::table("correlation", "Correlation", correlation(of)));
    }
    chapters.extend(Chapter::failures("Runs that failed", "Run", failed));
    chapters.push(Chapter::new("method", "Method", "Method", sentences(method(of))));
    let scenario = vec![Piece::Code(of.best.to_toml())];
    chapters.push(Chapter::new("scenario", "Best scenario", "Best scenario", scenario));
    chapters
}

/// What the pictures of the keys show.
const MISFITS: &str = "Dots: all runs, whatever the other keys. Filled: runs that differ from the best in this key alone, \
    joined. Shaded: the 95 % interval, where the data determine the key. Upright line: the best value. A floor without a \
    hollow is a key that the data leave open.";

fn sentences(all: Vec<String>) -> Vec<Piece> {
    all.into_iter().map(Piece::Words).collect()
}

/// The runs over the key with this index.
fn tried(of: &Outcome, key: usize) -> Vec<Tried> {
    let best = &of.fit.evaluations[of.fit.best].place;
    let one = |e: &Evaluation| Tried {
        value: of.plan.keys[key].value(e.place[key]),
        chi_square: e.chi_square,
        alone: (0..best.len()).all(|other| other == key || e.place[other] == best[other]),
    };
    of.fit.evaluations.iter().map(one).collect()
}

fn targets(of: &Outcome) -> Table {
    let row = |c: &Met| {
        // Both to the same place, that of the smaller uncertainty.
        let finest = if c.own > 0.0 { c.own.min(c.uncertainty) } else { c.uncertainty };
        let shown = |x: f64| short(x, digits_beside(x, finest));
        let own = if c.own > 0.0 { format!(" ± {}", short(c.own, 2)) } else { String::new() };
        vec![
            c.name.clone(),
            c.unit.clone(),
            format!("{} ± {}", shown(c.target), short(c.uncertainty, 2)),
            c.value.map_or("–".into(), |v| format!("{}{own}", shown(v))),
            format!("{:+.1}", c.residual),
        ]
    };
    Table::new(
        "Targets and the best run",
        ["Target", "Unit", "#Wanted", "#Best run", "#Residual"],
        of.compared.iter().map(row),
        "Uncertainties are standard ones (one sigma). A residual is the difference over the target's uncertainty and the runs' own together, \
         the latter being the median over the best few runs, the same for all, so that no run is preferred for being uncertain.",
    )
}

fn correlation(of: &Outcome) -> Table {
    let identified = &of.fit.identified;
    let count = of.found.len();
    let mut columns = vec!["Key".to_owned()];
    columns.extend((1..=count).map(|n| format!("#{n}")));
    let row = |a: usize| {
        let mut row = vec![format!("{}: {}", a + 1, of.found[a].key.name)];
        row.extend((0..count).map(|b| format!("{:.2}", identified.correlation[(a, b)])));
        row
    };
    Table::new(
        "Correlation of the estimates",
        columns,
        (0..count).map(row),
        "Columns are the keys by their numbers. Near 1 or -1 only a combination of the two is determined.",
    )
}

/// A column a direction: keys have long names.
fn directions(of: &Outcome) -> Table {
    let all = &of.fit.identified.directions;
    let mut columns = vec!["Direction".to_owned()];
    columns.extend((1..=all.len()).map(|n| format!("#{n}")));
    let row = |head: &str, cell: &dyn Fn(&Direction) -> String| {
        let cells = all.iter().map(cell);
        [head.to_owned()].into_iter().chain(cells).collect::<Vec<_>>()
    };
    let keys = of.found.iter().enumerate();
    let mut rows: Vec<_> = keys.map(|(k, f)| row(&f.key.name, &|d| format!("{:.2}", d.vector[k]))).collect();
    rows.push(row("Singular value", &|d| short(d.singular_value, 3)));
    rows.push(row("Noise", &|d| short(d.noise, 2)));
    let half = |d: &Direction| if d.half_width.is_finite() { short(d.half_width, 2) } else { "∞".into() };
    rows.push(row("Half 95 % interval", &half));
    rows.push(row("Determined", &|d| if d.is_determined() { "yes" } else { "no" }.into()));
    Table::new(
        "Directions, from the best to the least determined",
        columns,
        rows,
        "A column a direction: how much of each key is in it, as a share of the key's range, and what is known along it. The singular value is how many standard uncertainties the targets change by over one \
         range along the direction; noise is what the runs' own uncertainty alone would show.",
    )
}

fn method(of: &Outcome) -> Vec<String> {
    let steps: Vec<String> = (of.found.iter().zip(&of.fit.steps))
        .map(|(f, s)| format!("{} {} %", f.key.name, short(200.0 * s, 2)))
        .collect();
    let mut all = vec![
        format!(
            "Latin hypercube, particle swarm, then Levenberg and Marquardt's method from the best places; seed {}, {} of at most {} runs.",
            of.plan.settings.seed,
            of.fit.evaluations.len(),
            of.plan.settings.budget
        ),
        format!(
            "The Jacobian is made of differences around run {}, over these shares of the ranges: {}. Within {} % a difference would be below the \
             scatter of runs, whose impacts amplify round-off.",
            of.fit.centre + 1,
            steps.join(", "),
            200.0 * STEP
        ),
        "Intervals hold where the targets depend nearly linearly on the keys over the interval, and where the model is right: what it leaves out \
         is in no interval."
            .into(),
    ];
    let inflation = of.fit.identified.inflation;
    if inflation > 1.0 {
        all.push(format!(
            "The misfit is larger than the uncertainties explain; they were multiplied by {} for the intervals.",
            short(inflation, 3)
        ));
    }
    all
}
