//! What is printed of an analysis.

use crate::say::{self, say, short};
use brinell::analysis::{Analysis, COLUMNS, indicator_words, level_words};
use brinell_measured::{Against, Findings, whole_indicators};
use brinell_report::{level_lines, orders_in_hz, ratio};
use std::path::PathBuf;

/// What is found at each defect frequency, in columns.
fn families(a: &Analysis) {
    let heads = COLUMNS.map(|c| c.trim_start_matches('#').to_owned());
    // Of no bearing there are none.
    if a.families.is_empty() {
        return;
    }
    let rows: Vec<_> = [heads].into_iter().chain(a.rows()).collect();
    let width = |i: usize| rows.iter().map(|r| r[i].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..COLUMNS.len()).map(width).collect();
    for row in &rows {
        let cells = (row.iter().zip(COLUMNS).zip(&widths)).map(|((cell, head), w)| match head.starts_with('#') {
            true => format!("{cell:>w$}"),
            false => format!("{cell:<w$}"),
        });
        say!("  {}", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    say!("");
}

/// Of each bearing the verdict, of the signal the rest.
pub(super) fn tell(found: &Findings, written: &[PathBuf]) {
    let (results, result, m) = (&found.bearings, found.lead(), &found.measurement);
    let (a, unit) = (&result.analysis, &m.unit.value.name);
    let others = if a.records > 1 { format!(" and {} more", a.records - 1) } else { String::new() };
    say!("{}{others}, channel {}: {:.3} s, {} samples", m.path.display(), m.channel.value, a.duration(), a.samples);
    for note in &found.notes {
        say!("  {note}");
    }
    say!("  {}; {}", found.speed, a.shaft_words());
    if let Some(orders) = orders_in_hz(a) {
        say!("  {orders}");
    }
    for one in results {
        say!("  bearing: {}", one.said_of_bearing());
    }
    for (k, one) in results.iter().enumerate() {
        let of = match results.len() {
            1 => String::new(),
            n => format!("Bearing {} of {n}, {}: ", k + 1, one.name),
        };
        say!("\n{of}{}\n", one.verdict_text());
        families(&one.analysis);
        if let (Some(rest), Some(last)) = (&found.rest, &one.last) {
            say!("\nThe last {} samples, from {:.1} s on: {}", last.samples, rest.last_start, last.verdict());
        }
    }
    say!("  {}", a.headlines(unit).join(", "));
    for line in level_lines(&result.levels, unit) {
        say!("  {line}");
    }
    if let Some(rest) = &found.rest {
        let whole: Vec<String> =
            whole_indicators(rest).map(|(i, name, v)| level_words(&name.replace('_', " "), i, v, unit)).collect();
        say!("  of all {} samples: {}", rest.samples, whole.join(", "));
    }
    if let Some(other) = &result.against {
        against(other, unit);
    }
    say::wrote(written);
}

/// This signal beside the other.
fn against(other: &Against, unit: &str) {
    say!(
        "  against {}, channel {}: {}",
        other.measurement.path.display(),
        other.measurement.channel.value,
        other.analysis.verdict()
    );
    for note in other.measurement.notes() {
        say!("    {note}");
    }
    let (mean, rms) = other.comparison.level_db;
    say!("  third octaves, each of equal weight: this one is {mean:+.1} dB from the other on average, {rms:.1} dB RMS");
    let width = other.comparison.indicators.iter().map(|d| indicator_words(d.indicator).len()).max().unwrap_or(0);
    let within = other.comparison.range.map_or(String::new(), |range| {
        format!(", of {:.0} to {:.0} Hz, which both are compared in", range.low, range.high)
    });
    say!("    {:<width$} {:>12} {:>12}  this over the other{within}", "", "this", "the other");
    for d in &other.comparison.indicators {
        say!(
            "    {:<width$} {:>12} {:>12}  {}{}",
            indicator_words(d.indicator),
            short(d.first, 4),
            short(d.second, 4),
            ratio(d).map_or("-".into(), |r| format!("x {r}")),
            match d.indicator.has_unit() {
                true => format!(", in {}", unit),
                false => String::new(),
            }
        );
    }
}
