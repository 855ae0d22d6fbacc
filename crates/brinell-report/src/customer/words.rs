//! What the report says in words: verdict, severity, and what to do next.

use super::{CustomerReport, Judged};
use brinell::analysis::{Component, Verdict, Zone};

/// Of which a part's damage is a damage: `the outer race`.
fn part(component: Component) -> &'static str {
    match component {
        Component::OuterRace => "the outer race",
        Component::InnerRace => "the inner race",
        Component::Element => "a rolling element",
        // An element that strikes once a turn of the cage looks the same.
        Component::Cage => "a rolling element or the cage",
    }
}

fn parts(judged: &Judged) -> String {
    let mut names: Vec<&str> = judged.parts.iter().map(|component| part(*component)).collect();
    names.dedup();
    names.join(" and ")
}

/// The verdict in a few words.
pub(super) fn headline(judged: &Judged) -> String {
    match judged.verdict {
        Verdict::Damage if judged.clarity == "weak" => format!("Signs of damage of {}", parts(judged)),
        Verdict::Damage => {
            let are = if judged.parts.len() > 1 { "are" } else { "is" };
            crate::number::capital(&format!("{} {are} damaged", parts(judged)))
        }
        Verdict::CannotTell => "Cannot tell".into(),
        Verdict::NothingFound => "No damage found".into(),
    }
}

/// How often the damage of a part strikes.
pub(super) fn rate(component: Component) -> &'static str {
    match component {
        Component::OuterRace => "rolling elements pass one place of the outer race",
        Component::InnerRace => "rolling elements pass one place of the inner race",
        Component::Element => "one rolling element strikes the races",
        Component::Cage => "the cage turns",
    }
}

/// How sure the verdict is.
pub(super) fn sure(judged: &Judged) -> String {
    let words = match (judged.verdict, judged.clarity) {
        (Verdict::Damage, "very clear") => {
            "very clear, the highest of three grades. Of the measured records that the program was checked on, and its limits were set on, every verdict of this grade was right, 26 of 26."
        }
        (Verdict::Damage, "clear") => {
            return format!(
                "clear, the second of three grades: the evidence is that of damage, and {}. Of the same measured records every verdict of this grade was right, 5 of 5.",
                judged.less_than_very_clear.unwrap_or("it is less strong than in most")
            );
        }
        (Verdict::Damage, _) => "weak, the lowest of three grades: something healthy may look the same.",
        (Verdict::CannotTell, _) if judged.has_no_bearing() => {
            "open. Without the bearing's name nothing tells its lines from those of other parts."
        }
        (Verdict::CannotTell, _) => {
            "open. The record holds too little, or something that this bearing does not explain."
        }
        (Verdict::NothingFound, _) => {
            "this is no proof of a healthy bearing. Small damage, poor lubrication or damage far from the sensor may not show; some measured records of damaged bearings look the same."
        }
    };
    words.to_owned()
}

/// How bad it is: a few words, and on what they rest.
pub(super) fn grade(of: &CustomerReport) -> (&'static str, String) {
    let damaged = of.lead.verdict == Verdict::Damage;
    let whole = |zone: Zone| format!("the machine as a whole vibrates in zone {}", zone.name());
    match (damaged, of.whole.zone) {
        (true, Some(zone @ Zone::D)) => ("Severe:", format!("{}.", whole(zone))),
        (true, Some(zone @ Zone::C)) => ("Elevated:", format!("{}.", whole(zone))),
        (true, Some(zone)) => (
            "Not graded:",
            format!(
                "the bearing shows the damage, the vibration of the machine as a whole does not (zone {}). That is no sign that the damage is small.",
                zone.name()
            ),
        ),
        (true, None) => ("Not graded:", "the record gives no zone of ISO 20816-3.".into()),
        (false, Some(zone @ (Zone::C | Zone::D))) => {
            ("Not by the bearing,", format!("as far as the record shows: {}.", whole(zone)))
        }
        (false, _) if of.heading.kind.is_some() => {
            ("Not graded:", "damage was seen that this record does not show; how far it has gone the eye tells.".into())
        }
        (false, Some(zone)) if of.lead.verdict == Verdict::CannotTell => {
            ("Not graded:", format!("it is open whether the bearing is damaged; {}.", whole(zone)))
        }
        (false, Some(zone)) => ("Inconspicuous:", format!("{}, and no damage is shown.", whole(zone))),
        (false, None) if of.lead.verdict == Verdict::CannotTell => (
            "Not graded:",
            "it is open whether the bearing is damaged, and the record gives no zone of ISO 20816-3.".into(),
        ),
        (false, None) => ("Not graded:", "no damage is shown, and the record gives no zone of ISO 20816-3.".into()),
    }
}

/// What the severity cannot say.
pub(super) fn limits(several: bool) -> &'static str {
    match several {
        true => {
            "Limits: early damage of a bearing hardly shows in the velocity: a low one says little of the bearing. The largest of the channels was taken; the standard means the largest over all places and directions."
        }
        false => {
            "Limits: early damage of a bearing hardly shows in the velocity: a low one says little of the bearing. One place and direction was measured; the standard means the largest over all."
        }
    }
}

/// What to do next.
pub(super) fn steps(of: &CustomerReport) -> Vec<&'static str> {
    let mut steps = Vec::new();
    let high = matches!(of.whole.zone, Some(Zone::C | Zone::D));
    if of.whole.zone == Some(Zone::D) {
        steps
            .push("Zone D: act at once by the plant's own rule for it; vibration of this zone may damage the machine.");
    }
    // What somebody saw outranks what a record does not show.
    let is_seen = of.heading.kind.is_some() && of.lead.verdict != Verdict::Damage;
    if is_seen {
        steps.extend([
            "Damage was seen: act on what was seen, and not on this record, which does not show it.",
            "Have the bearing looked at again and exchanged by what is found; keep it, as its tracks tell the cause.",
        ]);
    }
    match (of.lead.verdict, of.lead.clarity) {
        (Verdict::Damage, "weak") => steps.extend([
            "Do not exchange the bearing on this record alone. Check the speed and the bearing's designation first: where one is wrong, something healthy may look like this.",
            "Measure again soon: longer, nearer to the bearing, at the same speed and load. A record from when the machine was healthy would decide most.",
            "Measure at shorter intervals until that is settled.",
        ]),
        (Verdict::Damage, _) => steps.extend([
            if of.heading.kind.is_some() {
                "Damage was seen, and the record shows it: no further record is needed to confirm it."
            } else {
                "Confirm within days: measure again at the same place, speed and load; check noise, temperature and lubricant."
            },
            if high {
                "Order the bearing now and bring its exchange forward: do not wait for the next planned stop without a further look at the machine."
            } else {
                "Order the bearing and plan its exchange for the next suitable stop."
            },
            "Until then measure at shorter intervals, weekly or closer, and stop if level, noise or temperature rises fast.",
            "Keep the old bearing and have it looked at: its tracks tell kind and cause of the damage, without which the new one may fail likewise.",
        ]),
        _ if is_seen => steps.push(
            "Check place, direction and mounting of the sensor, the speed and the bearing's designation: seen damage should show, unless it is small or far from the sensor.",
        ),
        (Verdict::CannotTell, _) => steps.extend([
            match (of.lead.has_no_bearing(), of.lead.speed_is_confirmed) {
                (true, _) => "Find out which bearing it is (parts list, housing, maker of the machine) and have the record judged with it; check other bearings, gears and couplings nearby.",
                (_, true) => "Settle what is open: check the designation of the bearing, and other bearings, gears and couplings nearby. The record confirms the speed.",
                _ => "Settle what is open: check the speed (best with a tachometer), the sample rate, the designation of the bearing, and other bearings, gears and couplings nearby.",
            },
            match of.lead.is_ample {
                true => "Measure again on the bearing's housing, for twice as long and at another speed: lines of other parts move apart from the bearing's. A record from when the machine was healthy would decide most.",
                false => "Measure again on the bearing's housing: sixty turns of the shaft or more at steady speed, sampled at 10 kHz or more.",
            },
            "Do not exchange the bearing on this record alone; measure at shorter intervals until it is settled.",
        ]),
        (Verdict::NothingFound, _) => {
            if !high {
                steps.push("Go on with the usual interval of measurement.");
            }
            steps.extend([
                "Keep this record: beside it, later changes show sooner than by any limit.",
                "Follow other signs where there are any: noise, heat or metal in the lubricant count for more than this record.",
            ]);
        }
    }
    if high && of.lead.verdict != Verdict::Damage && !is_seen {
        steps.push(
            "Look for the cause of the machine's vibration elsewhere: unbalance, misalignment, looseness, resonance.",
        );
    }
    steps
}

/// On what that rests.
pub(super) const BASIS: &str =
    "By common practice in condition monitoring. No remaining life is given: one record does not tell it.";

/// What kind of damage it is, as far as anybody says.
/// `None` where there is no damage to be of a kind.
pub(super) fn kind(of: &CustomerReport) -> Option<String> {
    match of.heading.kind {
        Some(kind) => Some(format!(
            "as seen and stated by the author: {}. Vibration tells the part, not the kind.",
            kind.words()
        )),
        None if of.lead.verdict == Verdict::Damage => Some(
            "not stated. Vibration tells the part, not the kind (fatigue, wear, corrosion, current, ...). To know it, look at the bearing; ISO 15243 names the kinds.".into(),
        ),
        None => None,
    }
}

/// What a verdict leaves open.
pub(super) fn not_said(lead: &Judged) -> [&'static str; 4] {
    [
        "How long the bearing will last, and what caused the damage.",
        match lead.has_no_bearing() {
            false if lead.bearings.len() > 1 => {
                "Faults of other parts: the frequencies of these bearings alone were looked for. As a rule the stronger of two damaged parts is named."
            }
            true => {
                "Which part it is: no bearing was given. Damage of a rolling element or the cage was not looked for."
            }
            false => {
                "Faults of other parts: the frequencies of this bearing alone were looked for. As a rule the stronger of two damaged parts is named."
            }
        },
        "Whether speed, sample rate and bearing were right (if not, every line lies elsewhere; most such errors are noticed), and unit and sensitivity (if not, every level and zone is wrong; that is noticed only where a level is far from those of machines).",
        "Whether a bearing without a finding is healthy: it may not be.",
    ]
}

#[cfg(test)]
mod tests {
    use super::super::DamageKind;

    #[test]
    fn lit_kinds_of_iso_15243() {
        let all: Vec<DamageKind> = DamageKind::all().collect();
        assert_eq!(all.len(), 14);
        let named = |name: &str| all.iter().find(|kind| kind.name() == name).unwrap().words();
        assert_eq!(named("false-brinelling"), "false brinelling (ISO 15243:2017, 5.3.3.3)");
        assert_eq!(named("overload"), "overload deformation (true brinelling) (ISO 15243:2017, 5.5.2)");
        assert_eq!(named("current-leakage"), "current leakage erosion (ISO 15243:2017, 5.4.3)");
    }
}
