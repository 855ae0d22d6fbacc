//! What the report says of a signal, from its findings.

use super::words::rate;
use super::{CustomerReport, Heading, Judged, NotJudged, Whole};
use crate::analysis::{AnalysisReport, Findings, highest_score, scaled, weight, with_interval};
use crate::number::{raised, short};
use crate::tables::Table;
use brinell::analysis::{Analysis, Component, Elsewhere, Finding, Levels, SEVERITY_BAND, Unexplained, Verdict};
use brinell::made_by::MadeBy;
use brinell::signal::{Estimate, Indicator};

/// One signal, with what was found in it and what it was given with.
#[derive(Debug)]
pub struct JudgedOf<'a> {
    /// What the page of the analysis is made of.
    pub findings: Findings<'a>,
    /// Names of its files; none of a signal that is in none.
    pub files: &'a [String],
    /// Where channel, rate and unit come from, and what else is said of the record.
    pub notes: &'a [String],
    /// Whether a simulation made it.
    pub simulated: bool,
    /// The channel's name.
    pub channel: &'a str,
    /// The name of the bearing that leads; may be empty.
    pub bearing: &'a str,
    /// Of each bearing that was asked about its name, and what is found of it in a word or two.
    pub bearings: Vec<(String, String)>,
    /// The shaft's speed and where it comes from.
    pub speed: String,
    /// Where no bearing was given, those that would have the lines found, in a sentence.
    pub alike: Option<String>,
    /// The length of the damage in a sentence, where it was asked.
    pub size: Option<String>,
}

impl Judged {
    /// What the report says of a signal.
    pub fn of(of: JudgedOf) -> Self {
        let (m, a) = (&of.findings.signal, of.findings.signal.analysis);
        let lead = a.causes().next();
        let unit = &of.findings.unit.name;
        let mut severity = Vec::new();
        severity.extend(lead.map(|family| {
            format!(
                "Bearing: the impacts modulate the envelope by {:.0} %. On healthy machines the program was checked on it is 20 % at most, with damage mostly 25 % and more. It tells how clear the damage is, not how large.",
                100.0 * family.modulation
            )
        }));
        severity.extend(of.size.map(|words| format!("Length: {words}")));
        let told = format!("{}; {}", of.speed, a.shaft_words());
        // Expected frequencies stand beside, and are of the speed that was found.
        let speed = match (a.shaft / a.options.shaft - 1.0).abs() > 1e-4 {
            true => format!("{}; used: {:.1} r/min (shaft's lines)", of.speed, 60.0 * a.shaft),
            false => of.speed,
        };
        let record =
            format!("{} s, {} samples at {} Hz, in {}", short(a.duration(), 4), a.samples, m.rate, raised(unit));
        let row = |label: &str, words: String| (label.to_owned(), words);
        let file = match of.files.len() {
            0 => None,
            1 => Some(row("File", listed(of.files))),
            _ => Some(row("Files", listed(of.files))),
        };
        let mut provenance: Vec<(String, String)> = file.into_iter().collect();
        provenance.extend([
            row("Channel", of.channel.to_owned()),
            row(if a.records > 1 { "Records" } else { "Record" }, record),
            row("Speed", told),
            row("Bearing", of.findings.bearing.to_owned()),
        ]);
        if !of.notes.is_empty() {
            provenance.push(row("Sources", raised(&of.notes.join("; "))));
        }
        provenance
            .extend(of.findings.levels.class.map(|class| row("Class", format!("{} (ISO 20816-3)", class.words()))));
        provenance.push(row("Program", format!("brinell {}", MadeBy::now())));
        let named = !of.bearing.is_empty();
        Self {
            channel: of.channel.to_owned(),
            simulated: of.simulated,
            bearing: if named { of.bearing.to_owned() } else { of.findings.bearing.to_owned() },
            bearings: of.bearings,
            speed,
            verdict: a.conclusion(),
            clarity: lead.map_or("", |family| a.clarity(family)),
            less_than_very_clear: lead.and_then(|family| a.less_than_very_clear(family)),
            speed_is_confirmed: a.speed_is_confirmed(),
            // Lines at FTF are those of one element or of the cage.
            parts: a
                .causes()
                .map(|family| if family.name == "FTF" { Component::Cage } else { family.component })
                .collect(),
            score: highest_score(a),
            reason: [Some(reason(a)), of.alike].into_iter().flatten().collect::<Vec<_>>().join(" "),
            whole: whole(of.findings.levels),
            is_ample: a.duration() * a.shaft >= 60.0 && m.rate >= 10_000.0,
            severity,
            evidence: evidence(a),
            levels: levels(&of.findings),
            method: method(a),
            provenance,
            report: AnalysisReport::of_findings(&of.findings),
        }
    }
}

/// The first names, and how many there are beside.
fn listed(names: &[String]) -> String {
    const SHOWN: usize = 3;
    let more = names.len().saturating_sub(SHOWN);
    let first = names[..names.len() - more].join(", ");
    if more > 0 { format!("{first} and {more} more") } else { first }
}

/// What the verdict rests on, or what is open.
fn reason(a: &Analysis) -> String {
    if let Some(family) = a.causes().next() {
        let (found, all) = (family.detected_harmonics(), family.harmonics.len());
        let hidden = match family.hidden_harmonics() {
            0 => String::new(),
            1 => ", and one lies under a line of shaft or mains".to_owned(),
            hidden => format!(", and {hidden} lie under lines of shaft or mains"),
        };
        return format!(
            "The machine rings at the rate at which {}: {:.1} times a second ({}). Of the first {all} multiples of that rate {found} stand out of the noise{hidden}.",
            rate(family.component),
            family.frequency,
            family.name,
        );
    }
    let with = |finding| a.families.iter().find(|family| family.finding == finding);
    match a.conclusion() {
        Verdict::NothingFound => "At none of the rates at which damage of this bearing strikes does the vibration show more than that of healthy machines.".into(),
        _ if a.at_given.is_some() => "At the speed given a part would be damaged, but the record's own lines tell another speed. Which is right?".into(),
        _ if with(Finding::Grown).is_some() => "Impacts at a rate of this bearing have grown since the healthy record, and do not yet reach what damage shows.".into(),
        _ if a.has_no_bearing() => match a.elsewhere {
            Some(comb) => format!(
                "Something strikes regularly, {:.1} times a second, {:.3} times a turn of the shaft, as damage of a bearing's race would. No bearing was given to tell whether it is one.",
                comb.frequency,
                comb.frequency / a.shaft
            ),
            None => "No bearing was given, and nothing strikes regularly as damage of a bearing's race would.".into(),
        },
        _ => match a.elsewhere {
            Some(comb) => at_no_rate_of_the_bearing(a, comb),
            None => otherwise_open(a),
        },
    }
}

/// What is open where a comb lies at no frequency of the bearing.
fn at_no_rate_of_the_bearing(a: &Analysis, comb: Elsewhere) -> String {
    let wrong =
        if a.speed_is_confirmed() { "a wrong designation" } else { "a wrong speed, sample rate or designation" };
    let speeds = a.speeds_of_comb().map_or(String::new(), |words| format!(" {words}"));
    format!(
        "Something strikes regularly, {:.1} times a second, {:.3} times a turn of the shaft, which is no rate of this bearing: another bearing, a gear or {wrong} would explain it.{speeds}",
        comb.frequency,
        comb.frequency / a.shaft
    )
}

/// What is open where there is no such comb.
fn otherwise_open(a: &Analysis) -> String {
    let with = |finding| a.families.iter().find(|family| family.finding == finding);
    match (with(Finding::Open), with(Finding::AsBefore), a.unexplained()) {
        (Some(family), ..) => format!(
            "There is something at the rate at which {} ({:.1} times a second), and not enough of it to tell damage from other causes.",
            rate(family.component),
            family.frequency
        ),
        (_, Some(_), _) => {
            "What would be damage is in the record given as healthy, too. Was the machine healthy then?".into()
        }
        (.., Some(Unexplained::Impacts(..))) => {
            "Something strikes, and not clearly at a rate of this bearing: its damage may be among the causes.".into()
        }
        (.., Some(Unexplained::Level(growth))) => {
            format!(
                "The vibration is {growth:.1} times that of the healthy record, and nothing of this bearing explains it."
            )
        }
        _ => "The speed changes during the record, so that damage may be missed.".into(),
    }
}

/// The machine as a whole.
fn whole(levels: &Levels) -> Whole {
    let (low, high) = (SEVERITY_BAND.low, SEVERITY_BAND.high);
    let velocity = match &levels.velocity {
        Ok(velocity) => 1e3 * velocity.value,
        Err(why) => return Whole { words: format!("Machine: RMS velocity {why}."), ..Whole::default() },
    };
    let level = format!("Machine: {} mm/s RMS, {low:.0} to {high:.0} Hz", short(velocity, 3));
    let (zone, words) = match (levels.zone, levels.class) {
        (Some(Ok(zone)), Some(class)) => {
            let [ab, bc, cd] = class.boundaries();
            let limits =
                [format!("up to {ab}"), format!("{ab} to {bc}"), format!("{bc} to {cd}"), format!("above {cd}")];
            let words = format!(
                "{level}: zone {} of ISO 20816-3 for {} ({} mm/s), {}.",
                zone.name(),
                class.words(),
                limits[zone as usize],
                zone.words()
            );
            (Some(zone), words)
        }
        (Some(Err(why)), _) => (None, format!("{level}. Zone of ISO 20816-3: {why}.")),
        _ => (None, format!("{level}. No zone of ISO 20816-3: the class of the machine was not given.")),
    };
    Whole { velocity: Some(velocity), zone, words }
}

/// Each defect frequency: where it should be, where it is, and how much of it.
fn evidence(a: &Analysis) -> Table {
    let rows =
        a.families.iter().zip(a.rows()).map(|(family, [part, name, found, off, harmonics, db, modulation, says])| {
            let expected = format!("{:.2}", family.expected);
            let is_found = family.finding != Finding::Silent;
            let [found, off] = [found, off].map(|cell| if is_found { cell } else { "–".into() });
            vec![part, name, expected, found, off, harmonics, db, modulation, says]
        });
    let heads = [
        "Part",
        "Rate",
        "#Expected, Hz",
        "#Found, Hz",
        "#Deviation, %",
        "Multiples",
        "#SNR, dB",
        "#Modulation, %",
        "Assessment",
    ];
    Table::new("Defect frequencies", heads, rows, "")
}

/// Levels of the signal, most with intervals.
fn levels(of: &Findings) -> Table {
    let (a, unit) = (of.signal.analysis, raised(&of.unit.name));
    let row = |name: &str, e: &Estimate, unit: &str| {
        let interval = with_interval(e);
        vec![name.to_owned(), short(e.value, 4), interval, unit.to_owned()]
    };
    let alone = |value: f64| Estimate { value, interval: None };
    let mut rows = Vec::new();
    rows.extend(a.indicator(Indicator::Rms).map(|e| row("RMS", &e, &unit)));
    rows.push(row("Peak of the record", &alone(a.record_peak), &unit));
    rows.extend(a.record_crest_factor().map(|crest| row("Crest factor", &alone(crest), "")));
    rows.extend(a.indicator(Indicator::Kurtosis).map(|e| row("Kurtosis (noise: 3)", &e, "")));
    rows.extend(of.levels.velocity.as_ref().ok().map(|v| row("RMS velocity", &scaled(v, 1e3), "mm/s")));
    rows.extend(of.levels.band.map(|band| row("RMS of the envelope", &band.envelope_rms, &unit)));
    let band =
        of.levels.band.map_or(String::new(), |b| format!("; envelope of {:.0} to {:.0} Hz", b.band.low, b.band.high));
    let note = match of.levels.velocity {
        Ok(_) => format!("Velocity of {:.0} to {:.0} Hz{band}.", SEVERITY_BAND.low, SEVERITY_BAND.high),
        Err(_) => crate::number::capital(band.trim_start_matches("; ")),
    };
    Table::new("Levels", ["Level", "#Value", "#95 % interval", "Unit"], rows, note)
}

fn method(a: &Analysis) -> String {
    if a.has_no_bearing() {
        return format!(
            "The vibration was demodulated in {} bands, and the spectra of their envelopes were averaged, each over its noise floor. There a comb of five lines was sought at every frequency from 1.5 times the shaft's; lines of shaft and mains do not count. One is named where it is high over the noise and modulates the envelope deeply, as damage of a race does.",
            a.bands
        );
    }
    format!(
        "The vibration was demodulated in {} bands, and the spectra of their envelopes were averaged, each over its noise floor. There each rate at which damage of this bearing strikes was sought with five multiples and its sidebands, within {} % of pure rolling (those of rolling element and cage no more than 1 % above); lines of shaft and mains do not count. Damage is called where these lines are high over the noise and modulate the envelope deeply, which those of healthy machines do not (after Randall and Antoni, Mech. Syst. Signal Process. 25 (2011) 485-520).",
        a.bands,
        a.options.tolerance_percent()
    )
}

impl CustomerReport {
    /// Of one signal or several of one machine; `None` where none was judged. What leads is the highest score of a
    /// damage, then what cannot be told, then the first.
    pub fn of(heading: Heading, signals: Vec<Judged>, without: &[NotJudged]) -> Option<Self> {
        let most = signals.iter().filter(|one| one.whole.velocity.is_some()).max_by(|a, b| {
            let velocity = |one: &Judged| one.whole.velocity.unwrap_or(0.0);
            velocity(a).total_cmp(&velocity(b))
        });
        let whole = most.or(signals.first())?.whole.clone();
        let all = all(&signals, without);
        let weight = |one: &Judged| weight(one.score, one.verdict);
        let mut lead: Option<Judged> = None;
        for one in signals {
            let ahead = lead.as_ref().is_none_or(|lead| weight(&one) > weight(lead));
            if ahead {
                lead = Some(one);
            }
        }
        Some(Self { heading, lead: lead?, whole, all, version: brinell::VERSION.into() })
    }
}

/// A row a signal and bearing; none where there is one of each.
fn all(signals: &[Judged], without: &[NotJudged]) -> Table {
    let bearings = signals.iter().map(|one| one.bearings.len()).max().unwrap_or(0);
    if signals.len() + without.len() < 2 && bearings < 2 {
        return Table::default();
    }
    let of = |one: &Judged| {
        let velocity = one.whole.velocity.map_or("–".into(), |v| short(v, 3));
        let zone = one.whole.zone.map_or("–", |zone| zone.name()).to_owned();
        let score = one.score.map_or("–".into(), |score| format!("{score:.1}"));
        let channel = one.channel.clone();
        one.bearings
            .iter()
            .enumerate()
            .map(|(k, (bearing, called))| {
                let first = |cell: &String| if k == 0 { cell.clone() } else { String::new() };
                vec![first(&channel), bearing.clone(), called.clone(), first(&score), first(&velocity), first(&zone)]
            })
            .collect::<Vec<_>>()
    };
    let none = |(name, why): &NotJudged| {
        let dash = || "–".to_owned();
        vec![name.clone(), dash(), format!("no result: {why}"), dash(), dash(), dash()]
    };
    let rows = signals.iter().flat_map(of).chain(without.iter().map(none));
    let heads = ["Channel", "Bearing", "Finding", "#Score", "#mm/s RMS", "Zone"];
    Table::new(
        "Channels",
        heads,
        rows,
        "The clearest damage leads, and the evidence below and on page 2 is its; a channel without damage does not cancel it. Score: how far the lines rise over the noise; the verdict also takes how deep they modulate.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_every_part_has_its_rate() {
        let all = [Component::OuterRace, Component::InnerRace, Component::Element, Component::Cage];
        let mut words: Vec<&str> = all.into_iter().map(rate).collect();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), 4);
        assert_eq!(listed(&["a", "b", "c", "d", "e"].map(String::from)), "a, b, c and 2 more");
    }
}
