//! What is printed of an analysis.

use super::{HEADLINES, Result_, whole_indicators};
use crate::say::{say, short};
use brinell::analysis::{Analysis, COLUMNS, Difference, Family, Verdict};
use brinell::signal::Indicator;
use std::path::PathBuf;

/// Lines this far, relative, from the speed given may be another shaft's: a tachometer is better than that.
const SHAFT_DOUBT: f64 = 0.005;

/// This over the other, where that says anything: skewness lies about zero.
pub(super) fn ratio(d: &Difference) -> Option<String> {
    let ratio = d.first / d.second;
    (d.indicator != Indicator::Skewness).then(|| match d.indicator.has_unit() {
        true => format!("{} ({:+.1} dB)", short(ratio, 3), 20.0 * ratio.log10()),
        false => short(ratio, 3),
    })
}

/// What the signal's own lines say of the shaft's speed.
pub(super) fn shaft_lines(a: &Analysis) -> String {
    match &a.drift {
        Some(drift) if drift.followed => drift.words(),
        Some(drift) => format!("{}; {}: give --speed-channel", own_lines(a), drift.words()),
        None => own_lines(a),
    }
}

fn own_lines(a: &Analysis) -> String {
    if a.options.rotation.is_some() {
        return "followed as stated".into();
    }
    if a.shaft_lines.is_empty() {
        return "no two lines at its harmonics agree on it".into();
    }
    let orders: Vec<String> = a.shaft_lines.iter().map(usize::to_string).collect();
    let off = a.shaft / a.options.shaft - 1.0;
    let doubt = if off.abs() > SHAFT_DOUBT {
        ", if they are this shaft's: another's, as fast to within the tolerance, would show the same"
    } else {
        ""
    };
    format!(
        "lines at its harmonics {} say {:.2} r/min ({:+.2} %){doubt}",
        orders.join(", "),
        60.0 * a.shaft,
        100.0 * off
    )
}

/// The damaged parts in a word or two each, or what is said instead.
pub(super) fn called(a: &Analysis) -> String {
    let part = |f: &Family| format!("{}, {}", f.component.words(), a.clarity(f));
    let parts: Vec<String> = a.causes().map(part).collect();
    match a.conclusion() {
        Verdict::Damage => parts.join("; "),
        Verdict::CannotTell => "cannot tell".into(),
        Verdict::NothingFound => "no damage found".into(),
    }
}

/// What is at each defect frequency, in columns.
fn families(a: &Analysis) {
    let heads = COLUMNS.map(|c| c.trim_start_matches('#').to_owned());
    let rows: Vec<_> = [heads].into_iter().chain(a.rows()).collect();
    let width = |i: usize| rows.iter().map(|r| r[i].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..COLUMNS.len()).map(width).collect();
    for row in &rows {
        let cells = (row.iter().zip(COLUMNS).zip(&widths)).map(|((cell, head), w)| {
            match head.starts_with('#') {
                true => format!("{cell:>w$}"),
                false => format!("{cell:<w$}"),
            }
        });
        say!("  {}", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    say!("");
}

/// Of each bearing the verdict, of the signal the rest: `result` is one of them.
pub(super) fn tell(results: &[Result_], result: &Result_, written: &[PathBuf]) {
    let (m, a) = (&result.measured, &result.analysis);
    say!(
        "{}, channel {}: {:.3} s, {} samples",
        m.path.display(),
        m.channel,
        a.duration(),
        a.samples
    );
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
        say!("\n{of}{}\n", one.told());
        families(&one.analysis);
        if let (Some(rest), Some(last)) = (&one.rest, &one.last) {
            say!(
                "\nThe last {} samples, from {:.1} s on: {}",
                last.samples,
                rest.last_start,
                last.verdict()
            );
        }
    }
    let rows: Vec<String> = (a.indicators.iter())
        .filter(|(i, _)| HEADLINES.contains(i))
        .map(|(i, e)| {
            let unit = if i.has_unit() {
                format!(" {}", m.unit.name)
            } else {
                String::new()
            };
            // Averages over revolutions; the largest of all samples is on the page.
            let name = match i {
                Indicator::Peak => "peak of a revolution".into(),
                i => i.name().replace('_', " "),
            };
            format!("{name} {}{unit}", short(e.value, 4))
        })
        .collect();
    say!("  {}", rows.join(", "));
    for line in result.level.lines(&m.unit.name) {
        say!("  {line}");
    }
    if let Some(rest) = &result.rest {
        let whole: Vec<String> = whole_indicators(rest)
            .map(|(name, v)| format!("{} {}", name.replace('_', " "), short(v, 4)))
            .collect();
        say!("  of all {} samples: {}", rest.samples, whole.join(", "));
    }
    if let Some(other) = &result.against {
        say!(
            "  against {}, channel {}: {}",
            other.measured.path.display(),
            other.measured.channel,
            other.analysis.verdict()
        );
        let (mean, rms) = other.comparison.level_db;
        say!(
            "  third octaves: this one is {:+.1} dB from the other on average, {rms:.1} dB RMS",
            0.0 - mean
        );
        say!(
            "    {:<16} {:>12} {:>12}  this over the other",
            "",
            "this",
            "the other"
        );
        for d in &other.comparison.indicators {
            say!(
                "    {:<16} {:>12} {:>12}  {}{}",
                d.indicator.name(),
                short(d.first, 4),
                short(d.second, 4),
                ratio(d).map_or("-".into(), |r| format!("x {r}")),
                match d.indicator.has_unit() {
                    true => format!(", in {}", m.unit.name),
                    false => String::new(),
                }
            );
        }
    }
    for path in written {
        say!("  wrote {}", path.display());
    }
}
