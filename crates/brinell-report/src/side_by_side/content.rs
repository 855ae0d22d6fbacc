//! The chapters of a comparison.

use super::curves::{called, entry_and_exit, envelope, over_defect, spectrum, waveform};
use super::headline::{Headline, compared_headline};
use crate::fact::Fact;
use crate::frame::THINNED;
use crate::number::{capital, raised, short, shown_unit, twelve_digits};
use crate::page::{Chapter, Page};
use crate::quantity::value_text;
use crate::tables::Table;
use brinell::document::Loaded;
use brinell::made_by::MadeBy;
use brinell::observe::passes::place;
use brinell::plausibility::after;
use brinell::result::{Quantity, RunResult};
use brinell::signal::ratio::Ratio;
use brinell_study::campaign::{
    self, BANDWIDTHS, Beforehand, Compared, Differing, Level, Misses, Side, band_of, bandwidth, count, of_results,
};

/// Longest value in the table of what differs.
const LONGEST: usize = 60;

impl Page {
    /// What the page of a comparison shows: `compare.html` of `brinell compare`. `spread`: of each side but the baseline its ratios with their
    /// bands by what is assumed, empty where that was not asked. `warnings`: those of [`beforehand`] and [`doubts`].
    ///
    /// # Panics
    /// Without a run, or with more or fewer sides than runs.
    pub fn of_runs(
        sides: &[Side],
        runs: &[&RunResult],
        compared: &[Compared],
        spread: &[Vec<Level>],
        warnings: Vec<String>,
    ) -> Self {
        assert!(!runs.is_empty() && runs.len() == sides.len(), "{} sides of {} runs", sides.len(), runs.len());
        let names: Vec<String> = sides.iter().map(|side| side.label.clone()).collect();
        let chapter = |id: &str, title: &str, pieces| Chapter::new(id, title, title, pieces);
        let mut chapters = vec![Chapter::table("differences", "What differs", differing(sides))];
        if !spread.is_empty() {
            chapters.push(Chapter::table("spread", "What is assumed", bands(&names, spread)).folded());
        }
        chapters.extend([
            chapter("waveform", "Sensor acceleration", vec![waveform(&names, runs)]),
            chapter("spectrum", "Spectrum", vec![spectrum(&names, runs)]),
            chapter("envelope-spectrum", "Envelope spectrum", vec![envelope(&names, runs)]),
        ]);
        let defects = runs.iter().map(|run| run.scenario.defects.len()).max();
        for defect in 0..defects.unwrap_or(0) {
            let (n, called) = (defect + 1, called(runs, defect));
            chapters.push(Chapter::new(
                &format!("defect{n}"),
                &format!("Over defect {n}"),
                &format!("Over {called}"),
                over_defect(&names, runs, defect),
            ));
            chapters.push(Chapter::new(
                &format!("defect{n}-ends"),
                &format!("Entry and exit, defect {n}"),
                &format!("Entry and exit, {called}"),
                entry_and_exit(&names, runs, defect),
            ));
        }
        for (id, title, wanted) in TABLES {
            let rows: Vec<&Compared> = compared.iter().filter(|c| wanted(&c.name)).collect();
            if !rows.is_empty() {
                chapters.push(Chapter::table(id, title, numbers((id, title), &names, &rows, !spread.is_empty())));
            }
        }
        let headlines = compared_headline(sides, compared);
        Self {
            title: names.join(", "),
            subtitle: format!("{} runs, each over the baseline {}", names.len(), names[0]),
            version: MadeBy::now().to_string(),
            warnings,
            lead: lead(&names, &headlines, spread),
            facts: facts(&names, &headlines, spread),
            chapters,
            footer: THINNED.into(),
            ..Self::default()
        }
    }
}

/// A table's place in links, its heading, and which numbers are in it.
type Wanted = (&'static str, &'static str, fn(&str) -> bool);

/// The table whose numbers are of channels, some of them anti-aliased.
const INDICATORS: &str = "indicators";
/// The table whose numbers are the solver's own: their ratios say nothing of a bearing.
const AUDITS: &str = "audits";

const TABLES: [Wanted; 3] = [
    (INDICATORS, "Indicators", |name| {
        let of = ["sensor_a", "inner_a", "outer_a", "cage1_a"];
        let which = [".rms", ".peak_to_peak", ".kurtosis", ".crest_factor"];
        of.iter().any(|o| name.starts_with(o))
            && which.iter().any(|w| name.ends_with(w))
            && !name.contains("anti_aliased")
    }),
    ("defects", "Defects, envelope and slip", |name| {
        ["defect", "envelope.", "row"].iter().any(|o| name.starts_with(o))
    }),
    (AUDITS, "Audits and work", |name| ["audit.", "work."].iter().any(|o| name.starts_with(o))),
];

/// The first number in a sentence: "RMS of sensor_ax in b is 0.368 (0.363 to 0.373), in c 1.2 (1.1 to 1.3) times that in a."
fn lead(names: &[String], headlines: &[Headline], spread: &[Vec<Level>]) -> String {
    let told = headlines.iter().find_map(|one| {
        let ratios = names.iter().enumerate().zip(&one.ratios);
        let told = |ratio: Ratio, k: usize| match band(spread, k, &one.name) {
            Some(band) => format!("{} ({band})", short(ratio.value, 3)),
            None => with_interval(ratio),
        };
        let ratios: Vec<_> = ratios.filter_map(|((k, name), ratio)| Some((name, told((*ratio)?, k)))).collect();
        let ([(name, first), rest @ ..], words) = (&ratios[..], &one.words) else {
            return None;
        };
        let more: String = rest.iter().map(|(name, ratio)| format!(", in {name} {ratio}")).collect();
        let only = if spread.is_empty() { " (95 %, scatter only; by what is assumed: `compare --spread`)" } else { "" };
        Some(format!("{} in {name} is {first}{more} times that in {}{only}.", capital(words), names[0]))
    });
    told.unwrap_or_default()
}

/// The band of a run's ratio in words.
fn band(spread: &[Vec<Level>], run: usize, name: &str) -> Option<String> {
    let [low, high] = band_of(spread, run, name)?.band.map(|end| short(end, 3));
    Some(format!("{low} to {high} by what is assumed"))
}

/// What assumed values do to the ratios of each run.
fn bands(names: &[String], spread: &[Vec<Level>]) -> Table {
    let row = |name: &String, level: &Level| {
        let [low, high] = level.band.map(|end| short(end, 3));
        let first = level.bars.first().map_or("–".into(), |bar| bar.key.clone());
        vec![level.name.clone(), name.clone(), short(level.value, 3), low, high, level.beside_one().into(), first]
    };
    let of = |(name, levels): (&String, &Vec<Level>)| {
        // Frequencies hold: their ratios are 1.
        let levels = levels.iter().filter(|level| !level.name.ends_with("frequency"));
        levels.map(|level| row(name, level)).collect::<Vec<_>>()
    };
    Table::new(
        "What assumed values do to the ratios",
        ["Number", "Run", "#Ratio", "#From", "#To", "The band lies", "Largest effect"],
        names.iter().skip(1).zip(spread).flat_map(of),
        format!(
            "Over {}: every assumed value at both ends of its plausible range in both runs at once, one value at a time. The band adds their changes as squares of \
             logarithms; it is no confidence interval, for the ranges are judgement.",
            names[0]
        ),
    )
}

fn facts(names: &[String], headlines: &[Headline], spread: &[Vec<Level>]) -> Vec<Fact> {
    let mut facts = Vec::new();
    for one in headlines.iter().take(8) {
        let ratios = names.iter().enumerate().zip(one.ratios.iter().zip(&one.over));
        let ratios: Vec<(String, Ratio, Option<String>)> = ratios
            .filter_map(|((k, name), (ratio, over))| {
                let over = over.as_ref().map_or(String::new(), |(of, to)| format!(" ({of} over {to})"));
                Some((format!("{name}{over}"), (*ratio)?, band(spread, k, &one.name)))
            })
            .collect();
        let [(name, first, assumed), rest @ ..] = &ratios[..] else {
            continue;
        };
        let mut note = format!("of {}", names[0]);
        let value = short(first.value, 3);
        if let Some(ends) = first.interval {
            let [low, high] = [ends.0, ends.1].map(|end| short(end, 3));
            note = format!("{note}; 95 %, scatter only: {low} to {high}");
        }
        note.extend(assumed.iter().map(|band| format!("; {band}")));
        for (name, more, assumed) in rest {
            note = format!("{note}; {name}: {}", with_interval(*more));
            note.extend(assumed.iter().map(|band| format!(", {band}")));
        }
        facts.push(Fact::new(&one.words, format!("{name}: {value} ×"), "", note));
    }
    facts
}

/// What the results should be warned of: each kind of problem once, and what makes runs hard to hold against each other.
pub fn doubts(sides: &[Side], runs: &[&RunResult]) -> Vec<String> {
    let of = |(k, run): (usize, &&RunResult)| {
        let RunResult { scenario, simulation, outcome, findings } = run;
        (k, after(scenario, simulation, outcome, findings))
    };
    let told = of_results(runs.iter().enumerate().map(of), "run", |k| &sides[k].label);
    [told, unlike(sides, runs)].concat()
}

/// What the scenarios should be warned of before they run: each kind of problem once.
pub fn beforehand(sides: &[Side]) -> Vec<String> {
    let (known, mut all) = (Beforehand::default(), Vec::new());
    for (k, side) in sides.iter().enumerate() {
        let warnings = known.warnings(&side.loaded.scenario);
        warnings.into_iter().for_each(|warning| count(&mut all, warning, k));
    }
    all.iter().map(|miss: &Misses| miss.words(sides.len(), "run", &sides[miss.run].label)).collect()
}

/// What makes curves hard to hold against each other.
fn unlike(sides: &[Side], runs: &[&RunResult]) -> Vec<String> {
    let mut all = Vec::new();
    let mut warn = |words: &str| all.push(format!("warning: {words}"));
    let ends = |side: &Side| bandwidth(&side.loaded.scenario);
    if sides.iter().any(|side| ends(side) != ends(&sides[0])) {
        warn(BANDWIDTHS);
    }
    let first = &sides[0].loaded.scenario;
    let both_differ = |side: &Side| {
        let own = &side.loaded.scenario;
        own.simulation.laws != first.simulation.laws
            && (&own.defects, &own.bearing, &own.operation, own.simulation.model)
                != (&first.defects, &first.bearing, &first.operation, first.simulation.model)
    };
    if sides.iter().any(both_differ) {
        warn(
            "the runs' sets of laws differ (simulation.laws), and not they alone: a ratio is of laws and of what else differs together; \
             --set simulation.laws=mechanics puts all runs under one",
        );
    }
    let duration = |side: &Side| side.loaded.scenario.simulation.duration_s;
    if sides.iter().any(|side| duration(side) != duration(&sides[0])) {
        warn(
            "the runs' durations differ: the largest of a whole run (record_*) grows with it; everything else compares",
        );
    }
    if runs.iter().any(|run| run.findings.sensor != runs[0].findings.sensor) {
        warn(
            "the loads point along different axes: curves show each run's own, the one nearer its load, with the channel in the legend; the headline numbers of the \
             sensor compare these axes, and so do levels of the envelope and peaks of entries and exits; the tables compare every other channel with the same one",
        );
    }
    let exponent = |run: &RunResult| run.scenario.contact.exponent;
    if runs.iter().any(|run| exponent(run) != exponent(runs[0])) {
        warn("the contacts' exponents n differ: stiffnesses in N/m^n have different units and no ratio");
    }
    let band = |run: &RunResult| run.findings.envelope.as_ref().map(|(_, band)| (band.low, band.high));
    let mut bands = runs.iter().filter_map(|run| band(run));
    if let Some(first) = bands.next()
        && bands.any(|other| other != first)
    {
        warn("the envelopes' bands differ: levels of their lines are of different bands");
    }
    let most = runs.iter().map(|run| run.simulation.model().defects.len()).max();
    for defect in 0..most.unwrap_or(0) {
        let here = |run: &&RunResult| run.simulation.model().defects.get(defect).map(place);
        let mut places: Vec<String> = runs.iter().filter_map(here).collect();
        places.dedup();
        if places.len() > 1 {
            warn(&format!(
                "defect {} is not in the same place in all runs ({}): its passes and ratios are of different contacts",
                defect + 1,
                places.join("; ")
            ));
        }
    }
    all
}

/// Keys with different values.
fn differing(sides: &[Side]) -> Table {
    let loaded: Vec<&Loaded> = sides.iter().map(|side| &side.loaded).collect();
    let mut rows = Vec::new();
    for Differing { key, unit, values } in campaign::differing(&loaded).into_iter().filter(|d| d.key != "name") {
        let mut row = vec![if unit.is_empty() { key.to_owned() } else { format!("{key} ({unit})") }];
        row.extend(values.into_iter().map(|p| p.map_or("–".into(), |p| cut(&p.value))));
        rows.push(row);
    }
    let note = if rows.is_empty() {
        "No key differs: the runs are the same."
    } else {
        "Every key that has not the same value in all runs, derived ones included."
    };
    let mut columns = vec!["Key".to_owned()];
    columns.extend(sides.iter().map(|side| side.label.clone()));
    Table::new("What differs", columns, rows, note)
}

/// A value as it is shown: numbers without the round-off of a change of unit, long texts cut.
fn cut(text: &str) -> String {
    if let Ok(x) = text.parse::<f64>() {
        return twelve_digits(x).to_string();
    }
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let cut: String = text.chars().take(LONGEST).collect();
    cut + "…"
}

/// Values of each run, and ratios to the baseline's.
fn numbers((id, title): (&str, &str), names: &[String], rows: &[&Compared], has_bands: bool) -> Table {
    let (of_channels, measured) = (id == INDICATORS, id != AUDITS);
    let mut columns = vec!["Quantity".to_owned()];
    columns.extend(of_channels.then(|| "Signal".to_owned()));
    columns.push("Unit".to_owned());
    columns.extend(names.iter().map(|name| format!("#{name}")));
    if measured {
        columns.extend(names.iter().skip(1).map(|name| format!("#{name} / {}", names[0])));
    }
    let rows = rows.iter().map(|c| {
        let mut row = vec![c.name.clone()];
        row.extend(of_channels.then(|| signal(&c.name).to_owned()));
        row.push(raised(shown_unit(&c.unit)));
        let value = |q: &Option<Quantity>| q.as_ref().map_or("–".into(), value_text);
        row.extend(c.of.iter().map(value));
        let ratio = |r: &Option<Ratio>| r.map_or("–".into(), with_interval);
        if measured {
            row.extend(c.ratios.iter().skip(1).map(ratio));
        }
        row
    });
    if !measured {
        return Table::new(
            title,
            columns,
            rows,
            "What the laws of conservation leave over, and the solver's work, of each run.",
        );
    }
    let mut note = format!(
        "Averages over whole revolutions (of impacts: over instants), in brackets 95 % intervals, scatter only: what is assumed is not in them ({}); peaks are those of a revolution. \
         Ratios are of the values beside them; their intervals suppose runs that scatter independently.",
        if has_bands { "the table of what is assumed has it" } else { "`brinell compare --spread`" }
    );
    if of_channels {
        note += " The anti-alias filter takes away what lies above half the sample rate: instantaneous values hold all of it.";
    }
    Table::new(title, columns, rows, note)
}

/// What a channel's numbers are of, in the words of a run's page.
fn signal(name: &str) -> &'static str {
    match name.starts_with("sensor_") || name.contains(".anti_aliased.") {
        true => "anti-aliased",
        false => "instantaneous",
    }
}

fn with_interval(ratio: Ratio) -> String {
    let value = short(ratio.value, 3);
    ratio.interval.map_or(value.clone(), |(low, high)| format!("{value} ({} to {})", short(low, 3), short(high, 3)))
}
