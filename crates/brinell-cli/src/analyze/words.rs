//! What is printed of an analysis.

use super::diagnosis::{Against, Diagnosis};
use super::json::whole_indicators;
use crate::say::{self, say, short};
use brinell::analysis::{Analysis, COLUMNS, HEADLINES, headline};
use brinell_report::{level_lines, ratio, shaft_lines};
use std::path::PathBuf;

/// What is found at each defect frequency, in columns.
fn families(a: &Analysis) {
    let heads = COLUMNS.map(|c| c.trim_start_matches('#').to_owned());
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

/// Of each bearing the verdict, of the signal the rest: `result` is one of them.
pub(super) fn tell(results: &[Diagnosis], result: &Diagnosis, written: &[PathBuf]) {
    let (m, a) = (&result.measured, &result.analysis);
    say!("{}, channel {}: {:.3} s, {} samples", m.path.display(), m.channel, a.duration(), a.samples);
    for note in &m.notes {
        say!("  {note}");
    }
    say!("  {}; {}", result.speed, shaft_lines(a));
    for one in results {
        say!("  bearing: {}", one.bearing);
    }
    for (k, one) in results.iter().enumerate() {
        let of = match results.len() {
            1 => String::new(),
            n => format!("Bearing {} of {n}, {}: ", k + 1, one.name),
        };
        say!("\n{of}{}\n", one.verdict_text());
        families(&one.analysis);
        if let (Some(rest), Some(last)) = (&one.rest, &one.last) {
            say!("\nThe last {} samples, from {:.1} s on: {}", last.samples, rest.last_start, last.verdict());
        }
    }
    indicators(a, &m.unit.name);
    for line in level_lines(&result.levels, &m.unit.name) {
        say!("  {line}");
    }
    if let Some(rest) = &result.rest {
        let whole: Vec<String> =
            whole_indicators(rest).map(|(name, v)| format!("{} {}", name.replace('_', " "), short(v, 4))).collect();
        say!("  of all {} samples: {}", rest.samples, whole.join(", "));
    }
    if let Some(other) = &result.against {
        against(other, &m.unit.name);
    }
    say::wrote(written);
}

/// The indicators that are headlines, in one line.
fn indicators(a: &Analysis, unit: &str) {
    let rows: Vec<String> = (a.indicators.iter())
        .filter(|(i, _)| HEADLINES.contains(i))
        .map(|(i, e)| {
            let unit = if i.has_unit() { format!(" {}", unit) } else { String::new() };
            // Averages over revolutions; the largest of all samples is on the page.
            format!("{} {}{unit}", headline(*i), short(e.value, 4))
        })
        .collect();
    say!("  {}", rows.join(", "));
}

/// This signal beside the other.
fn against(other: &Against, unit: &str) {
    say!(
        "  against {}, channel {}: {}",
        other.measured.path.display(),
        other.measured.channel,
        other.analysis.verdict()
    );
    for note in &other.measured.notes {
        say!("    {note}");
    }
    let (mean, rms) = other.comparison.level_db;
    say!("  third octaves: this one is {:+.1} dB from the other on average, {rms:.1} dB RMS", 0.0 - mean);
    say!("    {:<16} {:>12} {:>12}  this over the other", "", "this", "the other");
    for d in &other.comparison.indicators {
        say!(
            "    {:<16} {:>12} {:>12}  {}{}",
            d.indicator.name(),
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
