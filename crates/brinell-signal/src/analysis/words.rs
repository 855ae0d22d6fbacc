//! Families in words.

mod evidence;
mod open;

use super::bands::LOWEST_TOP;
use super::drift::Drift;
use super::family::{FAINT, Family, Finding};
use super::result::CHANGED;
use super::verdict::{TELLING, TELLING_CAGE};
use super::{Analysis, Flaw, Unexplained, Verdict};
use crate::Indicator;
use crate::digits;

/// What a row of [`Analysis::rows`] holds; a column of numbers begins with `#`.
pub const COLUMNS: [&str; 8] =
    ["Part", "Frequency", "#Found, Hz", "#Deviation, %", "#Harmonics", "#SNR, dB", "#Modulation, %", "Assessment"];

/// The indicators that are said in one line.
pub const HEADLINES: [Indicator; 4] = [Indicator::Rms, Indicator::Peak, Indicator::CrestFactor, Indicator::Kurtosis];

/// What an indicator is called that is an average over revolutions: its peaks are no record's.
pub fn indicator_words(indicator: Indicator) -> String {
    match indicator {
        Indicator::Rms => "RMS".into(),
        Indicator::Peak => "mean peak of a revolution".into(),
        Indicator::PeakToPeak => "mean peak to peak of a revolution".into(),
        Indicator::CrestFactor => "mean peak over RMS".into(),
        Indicator::ImpulseFactor => "mean peak over mean |x|".into(),
        other => other.name().replace('_', " "),
    }
}

/// A level by its name, with its unit where it has one.
pub fn level_words(name: &str, indicator: Indicator, value: f64, unit: &str) -> String {
    let unit = if indicator.has_unit() { format!(" {unit}") } else { String::new() };
    format!("{name} {}{unit}", digits::short(value, 4))
}

/// Lines this far, relative, from the speed given may be another shaft's: a tachometer is better than that.
const SHAFT_DOUBT: f64 = 0.005;
/// Slip of a loaded induction motor, at most.
const MOST_SLIP: f64 = 0.05;
/// Turns of the shaft below which less damage is found: of what is found in four seconds (60 to 120 turns) of the
/// records of results/analyze-evidence.md nine tenths in two, five sixths in one, three quarters in 0.6.
const SHORT: f64 = 60.0;
/// Turns of the shaft of the shortest of several records below which damage is called weakly where nothing tells the speed: with pieces of 10
/// turns and a speed 50 % off, 2 of 30 sound bearings were called, whole or piece by piece none.
const PIECES: f64 = 25.0;
/// What else may excite the race at rest.
const PASSING: &str = "Rollers that enter the load of a healthy bearing cause lines of its race too, and modulate the envelope as much where \
                       there is little noise: compare with a run of the healthy bearing.";

/// Nothing found is not nothing there.
const NOTHING: &str = "No damage found. That is no proof of a sound bearing: small damage may not show.";

/// Why damage is called weakly where the shaft's lines do not fit.
const OTHER_RATE: &str = "Are speed and sample rate right? The shaft's lines fit another speed or rate better, at which these lines may be another part's.";

impl Analysis {
    /// `very clear`, `clear` or `weak`: how much the evidence of a family that is damage says.
    pub fn clarity(&self, family: &Family) -> &'static str {
        let may_be_other = self.may_be_passing(family)
            || self.impacts_a_turn(family).is_some()
            || self.is_in_pieces()
            || self.asks_for_rate();
        match (may_be_other, self.less_than_very_clear(family)) {
            (true, _) => "weak",
            (_, None) => "very clear",
            _ => "clear",
        }
    }

    /// Why the evidence of a family that is damage is not very clear, as the end of a sentence; `None` where it is.
    pub fn less_than_very_clear(&self, family: &Family) -> Option<&'static str> {
        if !self.speed_is_told() {
            Some("nothing in the record confirms the speed")
        } else if self.drift.as_ref().is_some_and(Drift::is_lost) {
            Some("the speed is lost during the record")
        } else if self.speed_used().is_some() {
            Some("the shaft's lines tell another speed than was given")
        } else if self.slips(family).is_some() {
            Some("its lines lie farther from pure rolling than usual")
        } else if !family.is_very_clear() {
            Some("its lines are less high or less deep than in most")
        } else {
            None
        }
    }

    /// Whether the lines of the shaft fit another sample rate or speed better.
    fn asks_for_rate(&self) -> bool {
        self.flaws.iter().any(|(_, f)| matches!(f, Flaw::OtherRate { .. }))
    }

    /// Whether the records are several, too short for their lines to be told from others', and nothing tells the speed.
    fn is_in_pieces(&self) -> bool {
        self.records > 1 && self.shortest * self.shaft < PIECES && !self.speed_is_told()
    }

    /// The verdict in plain words: the headline first, its reasons, and what would tell more.
    pub fn verdict(&self) -> String {
        let mut text = Vec::new();
        match self.conclusion() {
            Verdict::Damage => damage(self, &mut text),
            Verdict::CannotTell => open::cannot_tell(self, &mut text),
            Verdict::NothingFound => text.push(NOTHING.into()),
        }
        text.extend(self.speed_used());
        text.extend(half_speed(self));
        let those = |finding| -> Vec<&str> {
            let families = self.families.iter().filter(|f| f.finding == finding);
            families.map(|f| f.name).collect()
        };
        let (faint, before) = (those(Finding::Faint), those(Finding::AsBefore));
        if !before.is_empty() && self.passing_known {
            text.push(format!(
                "Lines of {} are those of rollers that enter the load: without damage the same bearing, simulated, has them half as high or higher.",
                listed(&before)
            ));
        } else if !before.is_empty() {
            text.push(format!(
                "Cannot tell: lines of {} would be damage, and the record given as healthy has them as well. Was the machine healthy then? An older record would decide.",
                listed(&before)
            ));
        }
        text.extend(level(self));
        if self.causes().next().is_none() && self.hiding_drift().is_none() && !faint.is_empty() {
            text.push(format!(
                "Lines of {} are present, below the limits of damage: healthy machines have such lines.",
                listed(&faint)
            ));
        }
        text.extend(left_open(self));
        text.join(" ")
    }

    /// The levels that are said in one line, in a unit: peak and crest factor are the record's, and the mean peak of a
    /// revolution comes last.
    pub fn headlines(&self, unit: &str) -> Vec<String> {
        let these = HEADLINES.into_iter().filter_map(|i| {
            let (name, found) = match i {
                Indicator::Peak => ("peak", Some(self.record_peak)),
                Indicator::CrestFactor => ("crest factor", self.record_crest_factor()),
                i => (i.name(), self.indicator(i).map(|e| e.value)),
            };
            Some(level_words(name, i, found?, unit))
        });
        let mean = self.indicator(Indicator::Peak);
        let mean = mean.map(|e| level_words(&indicator_words(Indicator::Peak), Indicator::Peak, e.value, unit));
        these.chain(mean).collect()
    }

    /// What the signal's own lines say of the shaft's speed.
    pub fn shaft_words(&self) -> String {
        match &self.drift {
            Some(drift) if drift.followed => drift.words(),
            Some(drift) => format!("{}; {}: give the channel of a measured speed", own_lines(self), drift.words()),
            None => own_lines(self),
        }
    }

    /// The speed that the verdict rests on, where it is not the one given: a sentence.
    pub fn speed_used(&self) -> Option<String> {
        let (used, given) = (60.0 * self.shaft, 60.0 * self.options.shaft);
        let is_other =
            self.at_given.is_none() && self.options.rotation.is_none() && self.options.is_other_speed(self.shaft);
        is_other
            .then(|| format!("Evaluated at {used:.0} r/min (from shaft harmonics), not the given {given:.0} r/min."))
    }

    /// A row for each family, in the order of [`COLUMNS`].
    pub fn rows(&self) -> Vec<[String; COLUMNS.len()]> {
        let row = |f: &Family| {
            let says = match f.finding {
                Finding::Damage => format!("damage, {}", self.clarity(f)),
                Finding::Shared(with) => format!("explained by {with}"),
                Finding::Open => "cannot tell".into(),
                Finding::Faint if f.modulation < FAINT => format!("present, modulation below {:.0} %", 100.0 * FAINT),
                Finding::Faint if f.score < f.limit => format!("present, score {:.1} of {:.1}", f.score, f.limit),
                Finding::Faint => "present, below the limit".into(),
                Finding::Grown => "grown since healthy".into(),
                Finding::AsBefore => "as in the healthy record".into(),
                Finding::Silent if f.is_skirt && f.detected_harmonics() > 0 => "outside the tolerance".into(),
                Finding::Silent if f.detected_harmonics() > 0 => "single lines, no more".into(),
                Finding::Silent => "nothing".into(),
            };
            [
                f.component.words().into(),
                f.name.into(),
                format!("{:.2}", f.frequency),
                format!("{:+.2}", 100.0 * f.shift()),
                match f.hidden_harmonics() {
                    0 => format!("{} of {}", f.detected_harmonics(), f.harmonics.len()),
                    n => format!("{} of {}, {n} masked", f.detected_harmonics(), f.harmonics.len() - n),
                },
                format!("{:.0}", f.highest_db()),
                format!("{:.0}", 100.0 * f.modulation),
                says,
            ]
        };
        self.families.iter().map(row).collect()
    }
}

/// What the lines at multiples of the shaft's frequency say of its speed.
fn own_lines(a: &Analysis) -> String {
    if a.options.rotation.is_some() {
        return "followed as stated".into();
    }
    if a.options.exact {
        return "exact: its lines are not sought".into();
    }
    if a.shaft_lines.is_empty() {
        return "no two lines at its harmonics agree on it".into();
    }
    let orders: Vec<String> = a.shaft_lines.iter().map(usize::to_string).collect();
    let off = a.shaft / a.options.shaft - 1.0;
    let doubt = if off.abs() > SHAFT_DOUBT {
        ", which is used instead; lines of another shaft near that speed look the same"
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

/// Whether lines of the shaft at even multiples alone let its speed be twice as high.
fn half_speed(analysis: &Analysis) -> Option<String> {
    let is_even = !analysis.shaft_lines.is_empty() && analysis.shaft_lines.iter().all(|order| order % 2 == 0);
    (is_even && analysis.causes().next().is_some())
        .then(|| "The shaft's lines lie at even multiples of this speed only: is it twice as high?".into())
}

/// How the level has changed since the machine was healthy, where it has doubled or halved.
fn level(analysis: &Analysis) -> Option<String> {
    let is_said = matches!(analysis.unexplained(), Some(Unexplained::Level(_)));
    let growth = analysis.level_growth.filter(|g| !is_said && (*g >= CHANGED || *g <= 1.0 / CHANGED))?;
    let db = 20.0 * growth.log10();
    let within = evidence::within_range(analysis);
    Some(match growth > 1.0 {
        true => format!("The RMS{within} is {growth:.1} times that of the healthy record ({db:+.0} dB)."),
        false => {
            format!(
                "The RMS{within} is {db:+.0} dB from that of the healthy record: are unit, gain and place the same?"
            )
        }
    })
}

/// What a record without damage leaves open: what a slowly sampled or a short one may miss.
fn left_open(analysis: &Analysis) -> Vec<String> {
    if analysis.causes().next().is_some() {
        return Vec::new();
    }
    let mut text = Vec::new();
    let top = 0.5 * analysis.sample_rate;
    if !analysis.options.exact && top < LOWEST_TOP {
        text.push(format!("The record holds nothing above {top:.0} Hz: damage that rings higher is not seen in it."));
    }
    let turns = (analysis.duration() * analysis.shaft).round();
    if turns < SHORT {
        text.push(format!(
            "{} short, {turns:.0} turns of the shaft: {SHORT:.0}, which take {:.1} s, may show more.",
            if analysis.records > 1 { "Together the records are" } else { "The record is" },
            SHORT / analysis.shaft
        ));
    }
    let ftf = analysis.options.orders.ftf.filter(|_| analysis.records > 1);
    if let Some(cage) = ftf.map(|ftf| analysis.shortest * analysis.shaft * ftf).filter(|cage| *cage < TELLING) {
        text.push(format!(
            "The shortest record holds {cage:.0} turns of the cage: damage of a rolling element takes {TELLING:.0} in each to be called, of the cage {TELLING_CAGE:.0}."
        ));
    }
    text
}

fn damage(analysis: &Analysis, text: &mut Vec<String>) {
    for (i, family) in analysis.causes().enumerate() {
        let beside = if i > 0 { "Also " } else { "" };
        let part = match family.name {
            "FTF" => "rolling element or cage",
            _ => family.component.words(),
        };
        let headline =
            format!("{beside}{part} damage, {}: {}.", analysis.clarity(family), evidence::evidence_of(family));
        text.push(capital(&headline));
        if family.name == "FTF" {
            text.push("One element causes an impact once a turn of the cage, in the load zone, and damage of the cage the same.".into());
        }
        text.extend(analysis.slips(family).map(|lag| {
            format!(
                "The cage slips: {:.1} % behind pure rolling it has these lines there, and {} the speed. A light load lets it.",
                100.0 * lag,
                if analysis.has_record_of_speed() { "a record tells" } else { "the shaft's own lines agree with" }
            )
        }));
        if analysis.may_be_passing(family) {
            text.push(PASSING.into());
        }
        if analysis.asks_for_rate() {
            text.push(OTHER_RATE.into());
        }
        text.extend(multiple(analysis, family).or_else(|| inverter(analysis, family)));
        if analysis.is_in_pieces() {
            text.push(format!(
                "Records of fewer than {PIECES:.0} turns, whose lines do not tell the speed: at a wrong speed healthy bearings look the same."
            ));
        }
    }
}

/// That a race's lines may be those of impacts at a multiple of the shaft's frequency, whose own lines tell nothing.
fn multiple(analysis: &Analysis, family: &Family) -> Option<String> {
    analysis.impacts_a_turn(family).map(|times| {
        format!(
            "Impacts {times:.0} times a turn of the shaft (blades, jaws of a coupling) look the same if it turns at {:.1} r/min: a record of the speed would tell.",
            60.0 * family.frequency / times
        )
    })
}

/// Whether the lines of a race may be an inverter's: in motors of 2, 4 or 6 poles multiples of its output lie above
/// those of the shaft's frequency by the slip.
fn inverter(analysis: &Analysis, family: &Family) -> Option<String> {
    let (options, order) = (&analysis.options, family.frequency / analysis.shaft);
    let slip = 1.0 - order.floor() / order;
    let is_race = family.name.starts_with("BPF");
    let may_be = is_race && !options.exact && options.supply.is_none() && slip <= MOST_SLIP;
    let told = "has lines there too where an inverter feeds it: its frequency would tell";
    may_be.then(|| format!("A motor with a slip of {:.1} % {told}.", 100.0 * slip))
}

/// `A, B and C`.
fn listed(names: &[&str]) -> String {
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
