//! A sweep as its page shows it: which key lies on the x axis, which points make a line.

use super::points::Points;
use super::table::{count, number};
use crate::say::{plural, shown_unit};
use brinell::document::quantity_of_key;
use brinell::made_by::MadeBy;
use brinell::result::Quantity;
use brinell::scenario::Surface;
use brinell_report::{
    Chapter, Fact, HeatMap, IndicatorLine, IndicatorPlot, IndicatorPoint, Page, Piece, Table, sweep_lead, sweep_legend,
    value_text, words,
};
use brinell_study::campaign::Axis;
use brinell_study::runner::State;
use std::collections::{BTreeSet, HashMap};

/// Points and failures that the page lists; beyond that, the table is the place.
const LISTED: usize = 1000;
/// Lines of one picture; more go to further pictures.
const LINES: usize = 12;
/// Settings of each key from which on two keys make a map.
const GRID: usize = 3;
/// Pictures of one indicator; lines beyond them are in the tables alone.
const PICTURES: usize = 4;

/// RMS, peak to peak and kurtosis of the sensor's acceleration along the axis nearer the load, the envelope's lines of the surfaces that are
/// damaged in any point, RMS of the rings; of `names` that are there.
pub(super) fn usual(points: &Points, names: &[String]) -> Vec<String> {
    let scenario = &points.example;
    let axis = ["x", "y"][scenario.operation.axis_of_load()];
    let mut usual = Vec::new();
    if let Some(machine) = &scenario.machine {
        let shown = machine.sensors.iter().map(|sensor| machine.channel_of(sensor));
        usual.extend(shown.flat_map(|of| [format!("{of}.rms"), format!("{of}.kurtosis")]));
    }
    usual.extend(["rms", "peak_to_peak", "kurtosis"].map(|indicator| format!("sensor_a{axis}.{indicator}")));
    let own = scenario.defects.iter().map(|defect| match defect.on {
        Surface::OuterRaceway => "outer-raceway",
        Surface::InnerRaceway => "inner-raceway",
        Surface::Roller(_) => "roller",
    });
    // Each value of an axis once, and not for each point.
    let varied = points.read.grid.axes().iter().flat_map(|axis| {
        let keys = axis.keys();
        axis.settings().iter().flat_map(move |values| keys.iter().zip(values))
    });
    let moved = varied.filter(|(key, _)| key.starts_with("defects.") && key.ends_with(".on"));
    let moved = moved.map(|(_, on)| on.trim_matches('"'));
    let lines = own.chain(moved).filter_map(|on| match on {
        "outer-raceway" => Some("envelope.bpfo"),
        "inner-raceway" => Some("envelope.bpfi"),
        "roller" => Some("envelope.2bsf"),
        _ => None,
    });
    let lines: BTreeSet<&str> = lines.collect();
    usual.extend(lines.into_iter().map(String::from));
    usual.extend(["inner", "outer"].map(|ring| format!("{ring}_a{axis}.rms")));
    usual.retain(|name| names.is_empty() || names.contains(name));
    usual
}

pub(super) fn report(points: &Points, states: &[State], plots: &[String], warnings: Vec<String>) -> Page {
    let [complete, failed, missing] = ["complete", "failed", "not run"].map(|word| count(states, word));
    let axes: Vec<String> = points.read.grid.axes().iter().map(|axis| axis.keys().join(" with ")).collect();
    let varied: Vec<String> = points.read.grid.keys().map(|key| short(points, key)).collect();
    let fact = |label: &str, n: usize, note: &str| Fact::new(label, n.to_string(), "", note);
    let mut facts = vec![fact("Points", states.len(), &varied.join(" × "))];
    facts.push(fact("Complete", complete, ""));
    if failed > 0 {
        facts.push(fact("Failed", failed, "reasons below"));
    }
    if missing > 0 {
        facts.push(fact("Not run", missing, "the sweep was interrupted"));
    }
    let (axis, _) = x_axis(points);
    let lines = states.len() / points.read.grid.axes()[axis].settings().len();
    if lines > LINES * PICTURES {
        let text = format!("{} of {lines}", LINES * PICTURES);
        facts.push(Fact::new("Lines drawn", text, "", "all are in sweep.csv"));
    }
    let drawn: Vec<IndicatorPlot> = plots.iter().flat_map(|name| pictures(points, states, name)).collect();
    let incomplete =
        format!("This sweep is incomplete. {} not run yet; the same command resumes.", plural(missing, "point"));
    Page {
        title: format!("Sweep of {}", points.example.name),
        subtitle: format!("{} over {}", plural(states.len(), "point"), axes.join(" × ")),
        version: MadeBy::now().to_string(),
        warnings: (missing > 0).then_some(incomplete).into_iter().chain(warnings).collect(),
        lead: sweep_lead(&drawn),
        facts,
        chapters: chapters(points, states, plots, drawn),
        footer: "The whole table, with every indicator, is in sweep.csv and sweep.parquet beside this page.".into(),
        ..Page::default()
    }
}

fn chapters(points: &Points, states: &[State], plots: &[String], drawn: Vec<IndicatorPlot>) -> Vec<Chapter> {
    let name = |k: usize| {
        let settings = points.read.grid.settings(k);
        let texts: Vec<String> = settings.iter().map(|(k, v)| format!("{k} = {v}")).collect();
        format!("{}: {}", k + 1, texts.join(", "))
    };
    let failures = states.iter().enumerate();
    let failures = failures.filter_map(|(k, s)| Some((name(k), s.failure()?.to_owned())));
    let maps: Vec<Piece> = plots.iter().filter_map(|name| map(points, states, name)).map(Piece::Map).collect();
    let mut indicators = vec![Piece::Note(sweep_legend(&drawn))];
    indicators.extend(drawn.into_iter().map(Piece::Trend));
    let mut chapters = Vec::new();
    if !maps.is_empty() {
        chapters.push(Chapter::new("maps", "Over both keys", "Over both keys", maps));
    }
    chapters.push(Chapter::new("indicators", "Indicators", "Indicators", indicators));
    chapters.extend(Chapter::failures("Points that failed", "Point", failures.take(LISTED).collect()));
    chapters.push(Chapter::table("points", "Points", table(points, states, plots)));
    let base = vec![Piece::Code(points.source.text())];
    chapters.push(Chapter::new("scenario", "Base scenario", "Base scenario", base));
    chapters
}

/// The axis along x: the first one with a key of numbers that takes several values, or else the first.
fn x_axis(points: &Points) -> (usize, usize) {
    let axes = points.read.grid.axes();
    for (a, axis) in axes.iter().enumerate() {
        for key in 0..axis.keys().len() {
            let all = axis.settings().iter().all(|s| number(&s[key]).is_some());
            if all && axis.settings().len() > 1 {
                return (a, key);
            }
        }
    }
    (0, 0)
}

/// A varied key where there is little room: what it is of, or the whole of it where another one is of the same.
fn short(points: &Points, key: &str) -> String {
    let words = quantity_of_key(key);
    let alike = points.read.grid.keys().filter(|other| quantity_of_key(other) == words).count();
    if alike > 1 { key.to_owned() } else { words }
}

/// The same with its unit.
fn headed(points: &Points, key: &str) -> String {
    let words = short(points, key);
    match points.read.units.get(key) {
        Some(unit) if !unit.is_empty() => format!("{words} ({})", shown_unit(unit)),
        _ => words,
    }
}

/// An indicator's pictures: one, or several where there are many lines.
fn pictures(points: &Points, states: &[State], name: &str) -> Vec<IndicatorPlot> {
    let (axis, key) = x_axis(points);
    let along = &points.read.grid.axes()[axis];
    let values: Vec<&str> = along.settings().iter().map(|s| s[key].as_str()).collect();
    let numeric: Option<Vec<f64>> = values.iter().map(|v| number(v)).collect();
    let others: Vec<usize> = (0..points.read.grid.axes().len()).filter(|a| *a != axis).collect();
    let mut lines: Vec<IndicatorLine> = Vec::new();
    let mut line_of: HashMap<Vec<usize>, usize> = HashMap::new();
    let mut unit = "";
    for (k, state) in states.iter().enumerate() {
        let place = points.read.grid.place(k);
        let rest: Vec<usize> = others.iter().map(|a| place[*a]).collect();
        let quantity = state.row().and_then(|row| row.quantity(name));
        if let Some(q) = quantity {
            unit = shown_unit(&q.unit);
        }
        let x = numeric.as_ref().map_or(place[axis] as f64, |numbers| numbers[place[axis]]);
        let point = point(x, quantity);
        let line = *line_of.entry(rest).or_insert_with_key(|rest| {
            lines.push(IndicatorLine { label: label(points, &others, rest), points: Vec::new() });
            lines.len() - 1
        });
        lines[line].points.push(point);
    }
    for line in &mut lines {
        line.points.sort_by(|a, b| a.x.total_cmp(&b.x));
    }
    let x_key = &along.keys()[key];
    let axis_words =
        |a: &usize| points.read.grid.axes()[*a].keys().iter().map(|key| headed(points, key)).collect::<Vec<_>>();
    let legend: Vec<String> = others.iter().map(|a| axis_words(a).join(" with ")).collect();
    let parts = lines.chunks(LINES).take(PICTURES).enumerate();
    parts
        .map(|(part, lines)| IndicatorPlot {
            name: match part {
                0 => name.to_owned(),
                part => format!("{name}-{}", part + 1),
            },
            label: words(name),
            unit: unit.to_owned(),
            x_label: short(points, x_key),
            x_unit: points.read.units.get(x_key).copied().map_or("", shown_unit).into(),
            x_names: match numeric {
                Some(_) => Vec::new(),
                None => values.iter().map(|v| (*v).to_owned()).collect(),
            },
            legend: legend.join(", "),
            lines: lines.to_vec(),
            ..IndicatorPlot::default()
        })
        .collect()
}

/// An indicator over both keys of a grid; `None` where the sweep has not two axes of three settings or more.
fn map(points: &Points, states: &[State], name: &str) -> Option<HeatMap> {
    let [first, second] = points.read.grid.axes() else {
        return None;
    };
    if first.settings().len().min(second.settings().len()) < GRID {
        return None;
    }
    let (x, _) = x_axis(points);
    let (along, across) = match x {
        0 => (first, second),
        _ => (second, first),
    };
    let mut values = vec![f64::NAN; states.len()];
    let mut unit = "";
    for (k, state) in states.iter().enumerate() {
        let Some(quantity) = state.row().and_then(|row| row.quantity(name)) else {
            continue;
        };
        let place = points.read.grid.place(k);
        values[place[1 - x] * along.settings().len() + place[x]] = quantity.value.unwrap_or(f64::NAN);
        unit = shown_unit(&quantity.unit);
    }
    let key = |axis: &Axis| axis.keys().iter().map(|key| headed(points, key)).collect::<Vec<_>>().join(" with ");
    let names = |axis: &Axis| axis.settings().iter().map(|s| s.join(" with ")).collect();
    Some(HeatMap {
        name: format!("{name}-map"),
        label: words(name),
        unit: unit.to_owned(),
        x_label: key(along),
        x_names: names(along),
        y_label: key(across),
        y_names: names(across),
        values,
    })
}

/// What a line's points have in common.
fn label(points: &Points, others: &[usize], rest: &[usize]) -> String {
    let axes = others.iter().zip(rest);
    let parts: Vec<String> =
        axes.map(|(axis, k)| points.read.grid.axes()[*axis].settings()[*k].join(" with ")).collect();
    parts.join(", ")
}

fn point(x: f64, quantity: Option<&Quantity>) -> IndicatorPoint {
    let value = quantity.and_then(|q| q.value).unwrap_or(f64::NAN);
    IndicatorPoint { x, value, interval: quantity.and_then(Quantity::interval) }
}

/// The points with their keys and what is plotted.
fn table(points: &Points, states: &[State], plots: &[String]) -> Table {
    let mut columns = vec!["#Point".to_owned()];
    columns.extend(points.read.grid.keys().map(|key| format!("#{}", headed(points, key))));
    columns.push("Status".into());
    let unit = |name: &String| {
        let rows = states.iter().filter_map(State::row);
        let unit = rows.filter_map(|row| row.quantity(name)).next();
        unit.map_or("", |q| shown_unit(&q.unit))
    };
    for name in plots {
        let unit = match unit(name) {
            "" => String::new(),
            unit => format!(" ({unit})"),
        };
        columns.push(format!("#{}{unit}", words(name)));
    }
    let listed = states.iter().enumerate().take(LISTED);
    let rows = listed.map(|(k, state)| {
        let mut row = vec![(k + 1).to_string()];
        row.extend(points.read.grid.settings(k).into_iter().map(|(_, value)| value));
        row.push(state.word().into());
        let cell = |name: &String| {
            let quantity = state.row().and_then(|row| row.quantity(name));
            quantity.map_or("–".to_owned(), value_text)
        };
        row.extend(plots.iter().map(cell));
        row
    });
    let more = match states.len().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!("{more} more points are in sweep.csv. "),
    };
    let note = "Averages over whole revolutions, in brackets their 95 % intervals, scatter only; peaks are those of a revolution.";
    Table::new("Points", columns, rows, more + note)
}
