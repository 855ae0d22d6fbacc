//! A trend on the terminal and on its page.

use crate::say::{say, short};
use brinell_measured::{Followed, Level, Trend};
use brinell_report::{Chapter, IndicatorLine, IndicatorPlot, IndicatorPoint, Piece, Table, Tone};

/// The table of levels in the folder of results.
pub(super) const TABLE: &str = "trend.csv";

/// Where times come from, and how sure a change is.
fn lead(trend: &Trend) -> String {
    let span =
        [trend.times.at.first(), trend.times.at.last()].map(|at| at.map_or(String::new(), |at| trend.times.text(*at)));
    format!(
        "{} records, {} to {}, by {}. A change is said where scatter alone gives one in any of the levels with a probability of {} % at most, so of each with {} %; that scatter of one record is like that of the record before is allowed for",
        trend.records.len(),
        span[0],
        span[1],
        trend.times.source,
        100.0 * brinell_measured::ALPHA,
        short(100.0 * trend.alpha, 2),
    )
}

/// Name, first and last value, and what is said: of each level.
fn rows(trend: &Trend, name: impl Fn(&Level) -> String) -> impl Iterator<Item = [String; 4]> {
    trend.levels.iter().map(move |of| {
        let compared = of.level.points.iter().zip(&trend.records).filter(|(_, record)| record.apart.is_none());
        let mut points = compared.filter_map(|(point, _)| point.as_ref());
        let value = |v: f64| [short(v, 3), of.level.unit.clone()].join(" ").trim_end().to_owned();
        let first = points.next().map_or("-".into(), |p| value(p.value));
        let last = points.next_back().map_or("-".into(), |p| value(p.value));
        [name(&of.level), first, last, trend.words(of)]
    })
}

/// On the terminal, under the table of records.
pub(super) fn tell(trend: &Trend) {
    say!("\n{}\n{}.", trend.summary(), lead(trend));
    let rows: Vec<[String; 4]> = rows(trend, Level::called).collect();
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0).max(5);
    let widths = [width(0), width(1), width(2)];
    let [a, b, c] = widths;
    say!("{:<a$} {:>b$} {:>c$}  trend", "level", "first", "last");
    for [name, first, last, words] in &rows {
        say!("{name:<a$} {first:>b$} {last:>c$}  {words}");
    }
    for words in trend.levels.iter().flat_map(|of| trend.limit_words(of)) {
        say!("limit {words}");
    }
}

/// What the marks mean.
const MARKS: &str = "Bars: 95 % intervals; rings: values without one; crosses on the axis: no value. Above each plot the verdict of each record. Shaded: \
    the 95 % interval of the place of a change, with its most likely place dashed. Dashed across: limits. A verdict, not the height of a score, says whether a part is damaged.";

/// Of the page: what changed, and the levels over time.
pub(super) fn chapters(trend: &Trend) -> Vec<Chapter> {
    let limits: Vec<String> = trend.levels.iter().map(|of| trend.limit_words(of).join("; ")).collect();
    let columns = if limits.iter().all(String::is_empty) { 4 } else { 5 };
    let name = |level: &Level| format!("{} ({})", level.label, level.name);
    let changes =
        rows(trend, name).zip(limits).map(|(row, limits)| row.into_iter().chain([limits]).take(columns).collect());
    let note = lead(trend)
        + ". When a limit is reached is an extrapolation, which holds if growth goes on as it is: no forecast of life.";
    let headings = ["Level", "#First", "#Last", "Trend", "Limits"];
    let table = Table::new("What changed", headings.into_iter().take(columns), changes, note);
    let mut pieces = vec![Piece::Note(MARKS.into())];
    let (scores, levels): (Vec<&Followed>, Vec<&Followed>) = trend.levels.iter().partition(|of| !of.level.by_factors);
    pieces.extend(levels.into_iter().map(|of| plot(trend, &of.level.name, &of.level.label, &[of])).map(Piece::Trend));
    if !scores.is_empty() {
        pieces.push(Piece::Trend(plot(trend, "score", "Detection score", &scores)));
    }
    vec![
        Chapter::table("changes", "What changed", table),
        Chapter::new("trend", "Levels over time", "Levels over time", pieces),
    ]
}

fn plot(trend: &Trend, name: &str, label: &str, of: &[&Followed]) -> IndicatorPlot {
    let line = |of: &&Followed| IndicatorLine {
        label: of.level.label.clone(),
        points: (of.level.points.iter().zip(&trend.times.at))
            .map(|(point, at)| IndicatorPoint {
                x: *at,
                value: point.map_or(f64::NAN, |p| p.value),
                interval: point.and_then(|p| p.interval),
            })
            .collect(),
    };
    let changes = of.iter().flat_map(|of| of.outcome.iter().flat_map(|found| &found.changes));
    let changes = changes.map(|change| [change.between.0, change.at, change.between.1]);
    let limits =
        of.iter().flat_map(|of| of.limits.iter().map(|limit| (limit.value, format!("limit {}", limit.text()))));
    let lane = |says: &str, words: &str, tone| {
        let at = trend.records.iter().zip(&trend.times.at).filter(|(record, _)| record.says == says).map(|(_, at)| *at);
        (words.to_owned(), tone, at.collect::<Vec<f64>>())
    };
    let lanes = [
        lane("damage", "damage", Tone::Bad),
        lane("cannot_tell", "cannot tell", Tone::Open),
        lane("nothing_found", "none found", Tone::Good),
    ];
    let dated = trend.times.first.is_some();
    IndicatorPlot {
        name: format!("trend-{}", name.replace('_', "-")),
        label: label.into(),
        unit: of.first().map_or(String::new(), |of| of.level.unit.clone()),
        x_label: if dated {
            "Date".into()
        } else if trend.times.unit.is_some() {
            "Time".into()
        } else {
            "Record".into()
        },
        x_unit: trend.times.unit.filter(|_| !dated).map_or(String::new(), |unit| unit.name().into()),
        x_ticks: trend.times.ticks(),
        in_place: true,
        lines: of.iter().map(line).collect(),
        limits: limits.collect(),
        changes: changes.collect(),
        lanes: lanes.into_iter().filter(|lane| !lane.2.is_empty()).collect(),
        ..IndicatorPlot::default()
    }
}
