//! Why a verdict is open, in words.

use super::super::drift::Drift;
use super::super::elsewhere::Nearest;
use super::super::family::{Family, Finding, reach};
use super::super::together::{MAINS_HZ, REVOLUTIONS};
use super::super::{Analysis, Component, Elsewhere, Unexplained};
use super::evidence::{evidence_of, within_range};
use crate::digits;

/// What is open of the verdict, and why.
pub(super) fn cannot_tell(analysis: &Analysis, text: &mut Vec<String>) {
    let grown = (analysis.families.iter()).filter(|f| f.finding == Finding::Grown);
    for family in grown {
        text.push(format!(
            "Cannot tell which part: the lines of the {} have grown, {:.1} times as deep as when the machine was healthy: {}.",
            family.component.words(),
            family.growth.unwrap_or(1.0),
            evidence_of(family),
        ));
    }
    if let Some(family) = &analysis.at_given {
        let (lines, given) = (60.0 * analysis.shaft, 60.0 * analysis.options.shaft);
        text.push(format!(
            "Cannot tell: at the {given:.0} r/min given this would be {} damage ({}), but lines of a shaft lie at {lines:.0} r/min, and at that speed it is none. \
             Is the speed right, or does a second shaft turn so fast?{}",
            family.component.words(),
            evidence_of(family),
            record_of_speed(analysis),
        ));
        return;
    }
    match &analysis.elsewhere {
        Some(comb) if analysis.has_no_bearing() => text.push(of_unknown(analysis, comb)),
        Some(elsewhere) => text.push(other_lines(analysis, elsewhere)),
        None if analysis.has_no_bearing() => text.push(
            "Cannot tell: no bearing is given, and no comb of lines is as high and as deep as damage of a race makes it. Damage of a rolling element or the \
             cage is not sought without a bearing."
                .into(),
        ),
        None => {}
    }
    text.extend(analysis.hiding_drift().map(|drift| hidden_by(analysis, drift)));
    let open = || (analysis.families.iter()).filter(|f| f.finding == Finding::Open);
    let hides = |family: &&Family| analysis.elsewhere.is_some() && family.is_damage();
    // Where slip of the cage may put the comb, the bearing's own frequencies are not where pure rolling has them.
    let may_slip = analysis.elsewhere.and_then(|e| e.nearest).is_some_and(|n| n.slip.is_some());
    let hidden: Vec<String> =
        open().filter(hides).map(|f| format!("{} damage ({})", f.component.words(), evidence_of(f))).collect();
    if !hidden.is_empty() && !may_slip {
        text.push(format!("By its own frequencies alone the verdict would be {}.", hidden.join(", and ")));
    }
    // Where the one that leads is open, those that would be damage beside it are not the question.
    let led = open().any(Family::may_be_anothers);
    let asked = open().filter(|f| !hides(f) && (f.may_be_anothers() || !led || !f.is_damage()));
    text.extend(asked.map(|family| undecided(analysis, family)));
    text.extend(analysis.unexplained().map(|what| not_explained(analysis, what)));
}

/// What shows in the signal itself, and what may cause it.
fn not_explained(analysis: &Analysis, what: Unexplained) -> String {
    match what {
        Unexplained::Impacts(kurtosis, above) => format!(
            "{} (kurtosis {}{}, {}) that {}",
            match analysis.has_no_bearing() {
                true => "The record has impacts",
                false => "Cannot tell: the record has impacts",
            },
            digits::short(kurtosis, 3),
            above.map_or(String::new(), |low| format!(" above {low:.0} Hz")),
            match analysis.kurtosis_beside {
                Some([_, healthy]) => format!("{} in the healthy record", digits::short(healthy, 3)),
                None => "3 for noise".into(),
            },
            match analysis.has_no_bearing() {
                true => "no comb explains.",
                false =>
                    "no line of this bearing explains: damage too weak to call, another part, another bearing than the one given, or a wrong speed.",
            }
        ),
        Unexplained::Level(growth) => format!(
            "Cannot tell: the RMS{} is {growth:.1} times that of the healthy record ({:+.0} dB), and no line of this bearing explains it: another load, \
             speed or part, or damage too weak to call.",
            within_range(analysis),
            20.0 * growth.log10()
        ),
    }
}

/// A speed that changes so that damage may be missed.
fn hidden_by(analysis: &Analysis, drift: &Drift) -> String {
    let record = record_of_speed(analysis);
    if drift.is_lost() {
        format!("Cannot tell: the speed changes, farther or faster than lines can be followed.{record}")
    } else if drift.by != "shaft" {
        format!("Cannot tell: the speed changes, and no line of the shaft tells how.{record}")
    } else {
        format!(
            "Cannot tell: the speed drifts between {:.0} and {:.0} r/min, so that lines of order 10 smear over {:.0} bins; following it by the shaft's \
             own lines shows no more.{record}",
            60.0 * drift.lowest().1,
            60.0 * drift.highest().1,
            drift.smear
        )
    }
}

/// Why a family is neither damage nor none.
fn undecided(analysis: &Analysis, family: &Family) -> String {
    let (part, evidence) = (family.component.words(), evidence_of(family));
    let head = format!("Cannot tell whether the {part} is damaged: {evidence}");
    if family.masked {
        let others = masking(analysis, family);
        return format!("{head}, with lines where {others}. A record of the healthy machine would tell.");
    }
    if let Some(spacing) = family.other_spacing {
        return format!(
            "{head}. Its strongest sidebands lie {spacing:.2} Hz apart, as of a shaft at {:.0} r/min: neither shaft nor \
             cage turns so fast at the speed given. {}",
            60.0 * spacing,
            if analysis.has_record_of_speed() {
                doubt_of_speed(analysis)
            } else {
                "Is it right? A record of the speed would tell."
            }
        );
    }
    if let Some(slip) = family.others_slip {
        let (name, other) = match family.component {
            Component::OuterRace => ("2 BSF", Component::Element.words()),
            _ => ("BPFO", Component::OuterRace.words()),
        };
        return format!(
            "Cannot tell which part is damaged, the {part} or the {other}: {evidence}; where the cage slips by {:.1} %, the lines of {name} lie \
             there. A record of the cage's speed would tell, or a larger load, at which it slips less.",
            100.0 * slip.max(0.0)
        );
    }
    if family.is_skirt {
        let (behind, ahead) = reach(family.component, &analysis.options);
        let is_turning = matches!(family.component, Component::Element | Component::Cage);
        let end = match family.shift() > 0.0 {
            true if is_turning && ahead < analysis.options.tolerance => {
                format!("{:.1} % above pure rolling (elements and cage slip, and hardly run ahead)", 100.0 * ahead)
            }
            true => format!("{:.1} % above pure rolling", 100.0 * ahead),
            false => format!("{:.1} % below pure rolling", 100.0 * behind),
        };
        let doubt = doubt_of_speed(analysis);
        return format!("{head}, sought up to {end}, beyond which lines are higher. {doubt}");
    }
    let lacks = if family.is_damage() {
        "lines at distances of the cage's frequency, which so short a record does not separate from others"
    } else if family.score < family.noise {
        "lines hardly above what noise shows in a record of this length"
    } else if family.lacks_sidebands() {
        "fewer sidebands than damage that turns has"
    } else if family.is_whole() {
        "lines lower or shallower than those of damage"
    } else {
        "fewer harmonics than damage has"
    };
    format!("{head}, with {lacks}. A longer record, another sensor or a record of the healthy machine would decide.")
}

/// What has lines where a family's are, and what parts them.
fn masking(analysis: &Analysis, family: &Family) -> String {
    let times = |of: f64| (family.frequency / of).round();
    let off = |of: f64| (family.frequency - times(of) * of).abs();
    let mains = MAINS_HZ.into_iter().min_by(|a, b| off(*a).total_cmp(&off(*b)));
    match mains.filter(|hz| off(*hz) < off(analysis.shaft)) {
        Some(hz) => format!("{hz:.0} Hz mains would have theirs: at another speed they part"),
        None => {
            let others = format!(
                "{:.0} impacts a turn of the shaft (blades, jaws of a coupling) have theirs",
                times(analysis.shaft)
            );
            // Segments are no longer than that.
            match analysis.duration() * analysis.shaft < REVOLUTIONS {
                true => format!(
                    "{others}: in a record of {REVOLUTIONS:.0} turns those of a bearing that slips may part from them"
                ),
                false => others,
            }
        }
    }
}

/// A comb of lines where nobody knows the bearing.
fn of_unknown(analysis: &Analysis, comb: &Elsewhere) -> String {
    format!(
        "Cannot tell which part: no bearing is given. A comb of lines (one and its multiples) lies at {:.2} Hz, {:.3} times the shaft's speed, modulating by {:.0} %, as damage of a \
         race would; blades, gears or a coupling may have one too.",
        comb.frequency,
        comb.frequency / analysis.shaft,
        100.0 * comb.modulation,
    )
}

/// Lines that no frequency of this bearing explains.
fn other_lines(analysis: &Analysis, elsewhere: &Elsewhere) -> String {
    // The shaft's own lines tell its speed.
    let order = elsewhere.frequency / analysis.shaft;
    if (order - 1.0).abs() <= analysis.options.tolerance {
        return format!(
            "Cannot tell: a comb of lines as high lies at {:.2} Hz, once a turn of the shaft if that is its speed, {:.1} r/min, and a frequency of the bearing is a multiple of it. \
             Looseness, rub or a coupling has such lines.{}",
            elsewhere.frequency,
            60.0 * elsewhere.frequency,
            record_of_speed(analysis),
        );
    }
    let recorded = analysis.has_record_of_speed();
    let of_record = "Is it this bearing, and the recorded speed its shaft's?";
    let (at, hz) = (format!("{order:.3} times the shaft's speed"), elsewhere.frequency);
    let deepest = |near: String| {
        let depth = 100.0 * elsewhere.modulation;
        format!(
            "the deepest comb of lines lies at {hz:.2} Hz, {at}, modulating by {depth:.0} %, and this bearing has no frequency there.{near}"
        )
    };
    let (comb, doubt) = match elsewhere.every {
        Some((name, which)) => (
            format!(
                "the lines of {name} are one in {which} of a comb at {hz:.2} Hz, {at}, and this bearing has no frequency there."
            ),
            if recorded { of_record } else { "Are speed, sample rate and bearing right?" },
        ),
        None if lines_agree(analysis) => (
            deepest(nearest_frequency(elsewhere, false)),
            "Is it this bearing? The shaft's own lines agree with the speed.",
        ),
        None if recorded => (deepest(nearest_frequency(elsewhere, true)), of_record),
        None => (
            deepest(format!(" {}", speeds_if_its(analysis, elsewhere))),
            "Is one of these the speed, or the sample rate another, and is it this bearing?",
        ),
    };
    let record = if recorded { "" } else { ", and a record of the speed" };
    format!("Cannot tell: {comb} {doubt} The frequencies of the machine's other bearings and gears would tell{record}.")
}

/// How far off the frequency of the bearing is that lies nearest, and at which speed it would be there where that is open.
fn nearest_frequency(elsewhere: &Elsewhere, speed_is_open: bool) -> String {
    elsewhere.nearest.map_or(String::new(), |n| {
        let at = match speed_is_open {
            true => format!(": at {:.0} r/min{} it would be there", 60.0 * n.shaft, slipping(n)),
            false => slipping(n),
        };
        let direction = if n.shift > 0.0 { "lower" } else { "higher" };
        format!(" {} is {:.2} % {direction}{at}.", n.name, 100.0 * n.shift.abs())
    })
}

/// Whether the shaft's own lines agree with the speed given.
fn lines_agree(analysis: &Analysis) -> bool {
    !analysis.shaft_lines.is_empty() && !analysis.options.is_other_speed(analysis.shaft)
}

impl Analysis {
    /// Whether a record of the speed or the shaft's own lines say that it is the one given.
    pub fn speed_is_confirmed(&self) -> bool {
        self.has_record_of_speed() || lines_agree(self)
    }

    /// At which speeds a comb at no frequency of the bearing would be one of damage, in a sentence; `None` where something tells the speed.
    pub fn speeds_of_comb(&self) -> Option<String> {
        let elsewhere = self.elsewhere.as_ref().filter(|e| e.every.is_none())?;
        if self.speed_is_confirmed() || self.has_no_bearing() {
            return None;
        }
        Some(speeds_if_its(self, elsewhere))
    }
}

/// At which speeds each frequency of damage would be there.
fn speeds_if_its(analysis: &Analysis, elsewhere: &Elsewhere) -> String {
    let speeds = analysis.options.orders.impacts().map(|(component, name, order)| {
        let slip = elsewhere.nearest.filter(|n| n.component == component).map_or(String::new(), slipping);
        format!("{name} at {:.0} r/min{slip}", 60.0 * elsewhere.frequency / order)
    });
    format!("It would be {}.", speeds.collect::<Vec<_>>().join(", "))
}

/// The slip of the cage that would do the same as another speed.
fn slipping(nearest: Nearest) -> String {
    nearest.slip.map_or(String::new(), |slip| format!(" (or with a cage that slips by {:.1} %)", 100.0 * slip))
}

/// What is asked for where the speed is not sure: a record of it, unless there is one.
fn record_of_speed(analysis: &Analysis) -> &'static str {
    match analysis.has_record_of_speed() {
        true => "",
        false => " A record of the speed would tell.",
    }
}

/// The same of a speed that does not fit.
fn doubt_of_speed(analysis: &Analysis) -> &'static str {
    match analysis.has_record_of_speed() {
        true => "Is the recorded speed this shaft's, and the bearing the one given?",
        false => "Is the speed right? A record of the speed would tell.",
    }
}
