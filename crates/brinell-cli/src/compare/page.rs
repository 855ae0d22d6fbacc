//! A comparison as its page shows it.

use super::sides::Side;
use crate::say::short;
use crate::sweep::words;
use brinell::campaign::{Compared, Finished, Quantity};
use brinell::observe::impacts::{Impacts, impacts};
use brinell::observe::passes::{PassPoint, place};
use brinell::signal::ratio::Ratio;
use brinell_report::{
    Along, Fact, OverlaidCurve, Overlay, Part, Piece, SideBySide, Table, Value, Vertical,
};

/// Longest value in the table of what differs.
const LONGEST: usize = 60;

pub(super) fn report(sides: &[Side], runs: &[&Finished], compared: &[Compared]) -> SideBySide {
    let names: Vec<String> = sides.iter().map(|side| side.label.clone()).collect();
    let mut parts = vec![
        part("What differs", vec![Piece::Table(differing(sides))]),
        part(
            "Measured acceleration",
            vec![Piece::Overlay(waveform(runs))],
        ),
        part("Spectrum", vec![spectrum(runs)]),
        part("Envelope spectrum", vec![envelope(sides, runs)]),
    ];
    let defects = runs.iter().map(|run| run.scenario.defects.len()).max();
    for defect in 0..defects.unwrap_or(0) {
        parts.push(part(
            &format!("Over {}", called(runs, defect)),
            over_defect(runs, defect),
        ));
        parts.push(part(
            &format!("Entry and exit, {}", called(runs, defect)),
            entry_and_exit(runs, defect),
        ));
    }
    for (title, wanted) in TABLES {
        let rows: Vec<&Compared> = compared.iter().filter(|c| wanted(&c.name)).collect();
        if !rows.is_empty() {
            parts.push(part(
                title,
                vec![Piece::Table(numbers(title, &names, &rows))],
            ));
        }
    }
    SideBySide {
        title: names.join(" and "),
        subtitle: format!("{} runs, each held against {}", names.len(), names[0]),
        version: brinell::VERSION.into(),
        warnings: warnings(sides, runs),
        facts: facts(&names, compared),
        names,
        parts,
    }
}

/// A table's heading, and which numbers are in it.
type Wanted = (&'static str, fn(&str) -> bool);

const TABLES: [Wanted; 3] = [
    ("Indicators", |name| {
        let of = ["measured_a", "inner_a", "outer_a", "cage1_a"];
        let which = [".rms", ".peak_to_peak", ".kurtosis", ".crest_factor"];
        of.iter().any(|o| name.starts_with(o))
            && which.iter().any(|w| name.ends_with(w))
            && !name.contains("anti_aliased")
    }),
    ("Defects, envelope and slip", |name| {
        ["defect", "envelope.", "row"]
            .iter()
            .any(|o| name.starts_with(o))
    }),
    ("Audits and work", |name| {
        ["audit.", "work."].iter().any(|o| name.starts_with(o))
    }),
];

/// Names of the numbers that say most, of those that are there.
pub(super) fn headline(compared: &[Compared]) -> Vec<&str> {
    let names = compared.iter().map(|c| c.name.as_str());
    let wanted = |name: &&str| {
        let of_acceleration = name.starts_with("measured_a")
            && [".rms", ".peak_to_peak", ".kurtosis"]
                .iter()
                .any(|w| name.ends_with(w));
        of_acceleration || name.ends_with("entry_peak") || name.ends_with("exit_peak")
    };
    names.filter(wanted).collect()
}

fn part(title: &str, pieces: Vec<Piece>) -> Part {
    Part {
        title: title.into(),
        pieces,
    }
}

fn facts(names: &[String], compared: &[Compared]) -> Vec<Fact> {
    let mut facts = Vec::new();
    for name in headline(compared).into_iter().take(8) {
        let Some(one) = compared.iter().find(|c| c.name == name) else {
            continue;
        };
        let ratios: Vec<String> = names
            .iter()
            .zip(&one.ratios)
            .filter_map(|(name, ratio)| Some(format!("{name}: {}", with_interval((*ratio)?))))
            .collect();
        let [first, rest @ ..] = &ratios[..] else {
            continue;
        };
        let (value, interval) = first.split_once(" [").unwrap_or((first, ""));
        let mut note = format!("of {}", names[0]);
        if !interval.is_empty() {
            note = format!("{note}; 95 %: [{interval}");
        }
        for more in rest {
            note = format!("{note}; {more}");
        }
        facts.push(Fact::new(
            words(name),
            Value::Text(format!("{value} ×")),
            "",
            note,
        ));
    }
    facts
}

/// What makes curves hard to hold against each other.
fn warnings(sides: &[Side], runs: &[&Finished]) -> Vec<String> {
    let mut all = Vec::new();
    let rate = |run: &Finished| run.simulation.sample_rate();
    if runs.iter().any(|run| rate(run) != rate(runs[0])) {
        all.push("The runs' sample rates differ: what lies above half the lower one is in one of them alone.".into());
    }
    let duration = |side: &Side| side.loaded.scenario.simulation.duration_s;
    if sides
        .iter()
        .any(|side| duration(side) != duration(&sides[0]))
    {
        all.push(
            "The runs' durations differ: compare means over blocks, not extremes of whole runs."
                .into(),
        );
    }
    let axis = |run: &Finished| run.findings.axis;
    if runs.iter().any(|run| axis(run) != axis(runs[0])) {
        all.push("The loads point along different axes: curves show each run's own, the one nearer its load.".into());
    }
    all
}

/// Keys with different values.
fn differing(sides: &[Side]) -> Table {
    let value = |side: &Side, key: &str| {
        let entry = side.loaded.provenance.iter().find(|p| p.key == key)?;
        Some((entry.value.clone(), entry.unit))
    };
    let mut keys: Vec<&str> = Vec::new();
    for p in sides.iter().flat_map(|side| &side.loaded.provenance) {
        if !keys.contains(&p.key.as_str()) {
            keys.push(&p.key);
        }
    }
    let mut rows = Vec::new();
    for key in keys {
        let values: Vec<_> = sides.iter().map(|side| value(side, key)).collect();
        if values.windows(2).all(|pair| pair[0] == pair[1]) || key == "name" {
            continue;
        }
        let unit = values.iter().flatten().map(|v| v.1).next().unwrap_or("");
        let mut row = vec![if unit.is_empty() {
            key.to_owned()
        } else {
            format!("{key} ({unit})")
        }];
        row.extend(
            values
                .into_iter()
                .map(|v| v.map_or("–".into(), |v| cut(&v.0))),
        );
        rows.push(row);
    }
    let note = if rows.is_empty() {
        "No key differs: the runs are the same."
    } else {
        "Every key that has not the same value in all runs, derived ones included."
    };
    let mut columns = vec!["Key".to_owned()];
    columns.extend(sides.iter().map(|side| side.label.clone()));
    Table {
        title: "What differs".into(),
        columns,
        rows,
        note: note.into(),
    }
}

fn cut(text: &str) -> String {
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let cut: String = text.chars().take(LONGEST).collect();
    cut + "…"
}

/// Name of the acceleration that a run's curves show.
fn acceleration(run: &Finished) -> String {
    format!(
        "measured_a{}",
        if run.findings.axis == 0 { "x" } else { "y" }
    )
}

/// A stretch of the waveforms, five strikes long, from where all are analysed.
fn waveform(runs: &[&Finished]) -> Overlay {
    let kept = |run: &Finished| {
        let (first, values) = run.findings.waveform.latest();
        (first as f64 / run.simulation.sample_rate(), values)
    };
    let begin = |run: &&Finished| run.findings.from.max(kept(run).0);
    let from = runs.iter().map(begin).fold(0.0, f64::max);
    let strike = |run: &&Finished| {
        let model = run.simulation.model();
        let k = model.kinematics(model.rotation.max_speed());
        let struck = model.defects.iter().map(|d| k.struck_by(d.surface).1);
        struck.fold(k.bpfo, f64::max)
    };
    let quickest = runs.iter().map(strike).fold(0.0, f64::max);
    let width = if quickest > 0.0 { 5.0 / quickest } else { 0.02 };
    let curves = runs.iter().enumerate().map(|(of, run)| {
        let (first, values) = kept(run);
        let step = 1e3 / run.simulation.sample_rate();
        let along = Along::Even {
            first: 1e3 * first,
            step,
        };
        OverlaidCurve { of, along, values }
    });
    Overlay {
        name: "waveform".into(),
        x_label: "Time".into(),
        x_unit: "ms".into(),
        x_range: Some((1e3 * from, 1e3 * (from + width))),
        y_label: acceleration(runs[0]),
        y_unit: "m/s^2".into(),
        curves: curves.collect(),
        note: "The first strikes of the analysed time. Impacts amplify small differences: later the runs drift apart even where their \
               statistics agree."
            .into(),
        ..Overlay::default()
    }
}

fn spectrum(runs: &[&Finished]) -> Piece {
    let curves = runs.iter().enumerate().filter_map(|(of, run)| {
        let s = run.findings.spectrum.as_ref()?;
        Some(even(of, s.frequency_step, s.amplitude.clone()))
    });
    let curves: Vec<_> = curves.collect();
    if curves.is_empty() {
        return Piece::Words("The runs are too short for a spectrum.".into());
    }
    Piece::Overlay(Overlay {
        name: "spectrum".into(),
        x_label: "Frequency".into(),
        x_unit: "Hz".into(),
        y_label: format!("Amplitude of {}", acceleration(runs[0])),
        y_unit: "m/s^2".into(),
        vertical: Vertical::Decades,
        curves,
        note: "Peak amplitude, Hann window, whole analysed time.".into(),
        ..Overlay::default()
    })
}

fn even(of: usize, step: f64, values: Vec<f64>) -> OverlaidCurve {
    let along = Along::Even { first: 0.0, step };
    OverlaidCurve { of, along, values }
}

fn envelope(sides: &[Side], runs: &[&Finished]) -> Piece {
    let curves = runs.iter().enumerate().filter_map(|(of, run)| {
        let (e, _) = run.findings.envelope.as_ref()?;
        let mut values = e.spectrum.amplitude.clone();
        // The line at 0 Hz is the envelope's mean and says nothing about damage.
        if let Some(mean) = values.first_mut() {
            *mean = f64::NAN;
        }
        Some(even(of, e.spectrum.frequency_step, values))
    });
    let curves: Vec<_> = curves.collect();
    let Some((_, band)) = runs.iter().find_map(|run| run.findings.envelope.as_ref()) else {
        return Piece::Words("The runs are too short for an envelope spectrum.".into());
    };
    let markers = crate::page::defect_markers(&runs[0].scenario, runs[0].simulation.model());
    let top = markers.iter().filter(|m| m.present).map(|m| m.frequency_hz);
    let top = top.fold(0.0, f64::max);
    Piece::Overlay(Overlay {
        name: "envelope-spectrum".into(),
        x_label: "Frequency".into(),
        x_unit: "Hz".into(),
        x_range: (top > 0.0).then_some((0.0, 8.5 * top)),
        y_label: "Envelope amplitude".into(),
        y_unit: "m/s^2".into(),
        vertical: Vertical::FromZero,
        curves,
        note: format!(
            "Envelope of {} between {:.1} and {:.1} kHz. Marked: the defect frequencies of {} in pure rolling.",
            acceleration(runs[0]),
            1e-3 * band.low,
            1e-3 * band.high,
            sides[0].label
        ),
        markers,
        ..Overlay::default()
    })
}

/// "defect 1 (outer raceway, row 1)".
fn called(runs: &[&Finished], defect: usize) -> String {
    let of = |run: &&Finished| run.simulation.model().defects.get(defect).map(place);
    let place = runs.iter().find_map(of).unwrap_or_default();
    format!("defect {} ({place})", defect + 1)
}

/// Contact length, stiffness and force of the heaviest pass of each run.
fn over_defect(runs: &[&Finished], defect: usize) -> Vec<Piece> {
    let passes: Vec<_> = runs
        .iter()
        .map(|run| {
            run.findings
                .passes
                .best()
                .into_iter()
                .find(|p| p.defect == defect)
        })
        .collect();
    if passes.iter().all(Option::is_none) {
        return vec![Piece::Words("No roller passed it from end to end.".into())];
    }
    let exponent = runs[0].scenario.contact.exponent;
    let stiffness = if (exponent - 10.0 / 9.0).abs() < 1e-9 {
        "N/m^(10/9)"
    } else {
        "N/m^n"
    };
    let quantities: [(&str, &str, &str, fn(&PassPoint) -> f64); 3] = [
        ("length", "Effective contact length", "mm", |p| {
            1e3 * p.length
        }),
        ("stiffness", "Contact stiffness", stiffness, |p| p.stiffness),
        ("force", "Contact force", "N", |p| p.force),
    ];
    let overlay = |(name, label, unit, value): (&str, &str, &str, fn(&PassPoint) -> f64)| {
        let curves = passes.iter().enumerate().filter_map(|(of, pass)| {
            let points = &pass.as_ref()?.points;
            let degrees = points.iter().map(|p| p.angle.to_degrees());
            Some(OverlaidCurve {
                of,
                along: Along::At(degrees.collect()),
                values: points.iter().map(value).collect(),
            })
        });
        Piece::Overlay(Overlay {
            name: format!("defect{}-{name}", defect + 1),
            x_label: "Angle from the defect’s centre".into(),
            x_unit: "°".into(),
            y_label: label.into(),
            y_unit: unit.into(),
            vertical: Vertical::FromZero,
            curves: curves.collect(),
            ..Overlay::default()
        })
    };
    let mut pieces: Vec<Piece> = quantities.into_iter().map(overlay).collect();
    pieces.push(Piece::Words(
        "The pass with the largest contact force of each run, step by step of the solver.".into(),
    ));
    pieces
}

/// The mean acceleration around the instants at which rollers come onto the defect and leave it.
fn entry_and_exit(runs: &[&Finished], defect: usize) -> Vec<Piece> {
    let all: Vec<Vec<Impacts>> = runs
        .iter()
        .map(|run| impacts(&run.simulation, &run.findings))
        .collect();
    let mut pieces = Vec::new();
    for (enters, word) in [(true, "entry"), (false, "exit")] {
        let mut counts = Vec::new();
        let mut curves = Vec::new();
        for (of, impacts) in all.iter().enumerate() {
            let mine = |i: &&Impacts| i.defect == defect && i.enters == enters;
            let Some(one) = impacts.iter().find(mine).filter(|i| i.count > 0) else {
                continue;
            };
            counts.push(one.count.to_string());
            let along = Along::Even {
                first: 1e3 * one.from,
                step: 1e3 * one.step,
            };
            let values = one.mean.clone();
            curves.push(OverlaidCurve { of, along, values });
        }
        if curves.is_empty() {
            let words = format!("No {word} lies within the waveform that was kept.");
            pieces.push(Piece::Words(words));
            continue;
        }
        pieces.push(Piece::Overlay(Overlay {
            name: format!("defect{}-{word}", defect + 1),
            x_label: format!("Time from the {word}"),
            x_unit: "ms".into(),
            y_label: format!("Mean {}", acceleration(runs[0])),
            y_unit: "m/s^2".into(),
            curves,
            note: format!(
                "Measured acceleration averaged over {} instants of {word}: what they have in common.",
                counts.join(" and ")
            ),
            ..Overlay::default()
        }));
    }
    pieces
}

/// Values of each run, and ratios to the first.
fn numbers(title: &str, names: &[String], rows: &[&Compared]) -> Table {
    let mut columns = vec!["Quantity".to_owned(), "Unit".to_owned()];
    columns.extend(names.iter().map(|name| format!("#{name}")));
    columns.extend(
        names
            .iter()
            .skip(1)
            .map(|name| format!("#{name} / {}", names[0])),
    );
    let rows = rows.iter().map(|c| {
        let mut row = vec![
            c.name.clone(),
            if c.unit == "1" {
                String::new()
            } else {
                c.unit.clone()
            },
        ];
        let told = |q: &Option<Quantity>| q.as_ref().map_or("–".into(), told);
        row.extend(c.of.iter().map(told));
        let ratio = |r: &Option<Ratio>| r.map_or("–".into(), with_interval);
        row.extend(c.ratios.iter().skip(1).map(ratio));
        row
    });
    Table {
        title: title.into(),
        columns,
        rows: rows.collect(),
        note: "In brackets 95 % intervals. Values are of whole runs; ratios with an interval are of the means over blocks of whole \
               revolutions (of impacts: over instants), and suppose runs that scatter independently."
            .into(),
    }
}

fn told(quantity: &Quantity) -> String {
    let value = quantity.value.map_or("–".to_owned(), |x| short(x, 4));
    match quantity.interval() {
        Some((low, high)) => format!("{value} [{}, {}]", short(low, 3), short(high, 3)),
        None => value,
    }
}

fn with_interval(ratio: Ratio) -> String {
    let value = short(ratio.value, 3);
    match ratio.interval {
        Some((low, high)) => format!("{value} [{}, {}]", short(low, 3), short(high, 3)),
        None => value,
    }
}
