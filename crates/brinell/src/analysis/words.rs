//! Findings in words.

use super::frequencies::Component;
use super::verdict::tells_elements;
use super::view::candidates;
use super::{Analysis, Beyond, Finding};

/// What else may strike the resting race.
const PASSING: &str = "rollers that enter the load of a healthy bearing strike its race at this rate too, and modulate the envelope as much where \
                       nothing else is heard: compare with a run of the healthy bearing";

/// The verdict, one paragraph.
pub(super) fn verdict(analysis: &Analysis) -> String {
    let causes: Vec<&Finding> = analysis.causes().collect();
    let others: Vec<&Finding> = (analysis.findings.iter())
        .filter(|f| !f.is_cause())
        .collect();
    let mut text = Vec::new();
    match causes.split_first() {
        None if others.is_empty() => text.push(format!(
            "Nothing stands out: no envelope spectrum shows lines of {} above what noise shows{}.",
            searched(analysis),
            removed(analysis)
        )),
        None => text.push("Nothing stands out that would be called damage.".into()),
        Some((first, rest)) => {
            text.push(format!(
                "{} damage: {}.",
                capital(first.component.words()),
                told(analysis, first)
            ));
            text.push(format!(
                "The evidence is {}: over all bands its family scores {:.1}, and damage begins at {:.1}{}.",
                first.clarity(),
                first.score,
                first.limit,
                reserve(analysis, first)
            ));
            for other in rest {
                text.push(format!(
                    "Also the {}: {}; a second damage, or the same one seen otherwise{}.",
                    other.component.words(),
                    told(analysis, other),
                    if other.may_be_passing {
                        format!("; or {PASSING}")
                    } else {
                        String::new()
                    }
                ));
            }
        }
    }
    let untold = |f: &&Finding| {
        causes
            .first()
            .is_some_and(|c| c.untold_from.contains(&f.name))
    };
    for other in others {
        if untold(&other) && !other.explained_by.is_empty() {
            text.push(format!(
                "{} ({}) stands at {:.2} Hz and may be the cause instead.",
                other.name,
                other.component.words(),
                other.evidence.frequency
            ));
            continue;
        }
        let why = if other.explained_by.is_empty() {
            format!(
                "scores {:.1} over all bands, where damage begins at {:.1}; not called damage",
                other.score, other.limit
            )
        } else {
            format!(
                "has no line that {} does not account for",
                other.explained_by.join(" and ")
            )
        };
        text.push(format!(
            "{} ({}) stands at {:.2} Hz but {why}.",
            other.name,
            other.component.words(),
            other.evidence.frequency
        ));
    }
    if let Some(beyond) = &analysis.beyond {
        text.push(doubt(analysis, beyond));
    }
    text.join(" ")
}

/// Why evidence is weak that noise does not explain.
fn reserve(analysis: &Analysis, finding: &Finding) -> String {
    let mut text = String::new();
    if !finding.untold_from.is_empty() {
        text += if text.is_empty() { ", but " } else { "; and " };
        text += &format!(
            "the record is too short to tell it from {}, which {} as well: that takes {:.1} s",
            finding.untold_from.join(" and "),
            if finding.untold_from.len() == 1 {
                "stands"
            } else {
                "stand"
            },
            tells_elements(analysis.shaft, &analysis.options)
        );
    }
    if finding.may_be_passing {
        text += if text.is_empty() { ", but " } else { "; and " };
        text += PASSING;
    }
    text
}

/// What stands beyond the tolerance, and what would make sense of it.
fn doubt(analysis: &Analysis, beyond: &Beyond) -> String {
    let orders: Vec<String> = beyond.standing().map(|o| o.to_string()).collect();
    format!(
        "But lines stand at {:.2} Hz and its multiples ({}), {:+.1} % from {}, beyond the tolerance of {} %: is the speed right? At {:.0} r/min \
         they would be the {}'s.",
        beyond.evidence.frequency,
        orders.join(", "),
        100.0 * beyond.distance(),
        beyond.name,
        100.0 * analysis.options.tolerance,
        60.0 * beyond.shaft,
        beyond.component.words(),
    )
}

fn told(analysis: &Analysis, finding: &Finding) -> String {
    let view = &analysis.views[finding.view];
    let highest = (finding.standing().chain(finding.evidence.carrying()))
        .map(|l| l.snr_db)
        .fold(0.0, f64::max);
    let mut text = format!(
        "{} stands at {:.2} Hz ({:+.2} % of pure rolling's {:.2} Hz) in the envelope of {:.0} to {:.0} Hz, {}, \
         up to {:.0} dB above the floor, modulating the envelope by {:.0} %",
        finding.name,
        finding.evidence.frequency,
        100.0 * (finding.evidence.frequency / finding.expected - 1.0),
        finding.expected,
        view.band.band.low,
        view.band.band.high,
        lines_of(finding, analysis.options.harmonics),
        highest,
        100.0 * finding.modulation,
    );
    if let Some((count, spacing)) = finding.sidebands() {
        let whose = match finding.component {
            Component::Element => "cage",
            _ => "shaft",
        };
        text += &format!(", with {count} sidebands at the {whose}'s {spacing:.2} Hz");
    }
    text
}

/// Which of so many harmonics stand, and which stand by their sidebands alone.
fn lines_of(finding: &Finding, of: usize) -> String {
    let listed = |orders: Vec<i32>| -> String {
        let words: Vec<String> = orders.iter().map(i32::to_string).collect();
        words.join(", ")
    };
    let own = listed(finding.standing().map(|l| l.order).collect());
    let carried = listed(finding.evidence.carried.clone());
    match (own.is_empty(), carried.is_empty()) {
        (false, true) => format!("harmonics {own} of {of}"),
        (false, false) => {
            format!(
                "harmonics {own} of {of}, and {carried} by their sidebands, as their places are the shaft's or the mains'"
            )
        }
        _ => format!(
            "harmonics {carried} of {of} by their sidebands alone, as their places are the shaft's or the mains'"
        ),
    }
}

fn searched(analysis: &Analysis) -> String {
    let names: Vec<String> = (candidates(analysis.shaft, &analysis.options).iter())
        .map(|(_, name, c)| format!("{name} ({:.1} Hz)", c.frequency))
        .collect();
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

fn removed(analysis: &Analysis) -> String {
    match analysis.view().removed.len() {
        0 => String::new(),
        n => format!(" ({n} lines of shaft or mains were set aside)"),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
