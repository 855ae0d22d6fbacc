//! What was found of a family, and where levels are compared, in words.

use super::super::Analysis;
use super::super::family::Family;

/// Its frequency, harmonics, sidebands and modulation.
pub(super) fn evidence_of(family: &Family) -> String {
    let sidebands = match &family.sidebands {
        Some(s) if s.detected.len() >= 2 => {
            format!(", with {} sidebands {:.2} Hz apart", s.detected.len(), s.spacing)
        }
        _ => String::new(),
    };
    let interval = family.interval.map_or(String::new(), |i| format!("95 %: {:.2} to {:.2} Hz; ", i.low, i.high));
    format!(
        "{} at {:.2} Hz ({interval}{:+.2} % of pure rolling), {} up to {:.0} dB over noise{sidebands}, modulating by {:.0} %",
        family.name,
        family.frequency,
        100.0 * family.shift(),
        harmonics(family),
        family.highest_db(),
        100.0 * family.modulation,
    )
}

fn harmonics(family: &Family) -> String {
    let detected = family.harmonics.iter().filter(|h| h.detected);
    let orders: Vec<String> = detected.map(|h| h.order.to_string()).collect();
    match orders.as_slice() {
        [] => "no harmonic".into(),
        [one] => format!("harmonic {one}"),
        orders => format!("harmonics {}", orders.join(", ")),
    }
}

/// The range in which a level is compared with the healthy machine's, where it is not the whole.
pub(super) fn within_range(analysis: &Analysis) -> String {
    analysis.level_range.map_or(String::new(), |range| {
        format!(" from {:.0} to {:.0} Hz, which both records hold,", range.low, range.high)
    })
}
