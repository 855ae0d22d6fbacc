//! What is kept of each of several files.

use super::args::AnalyzeArgs;
use super::customer;
use super::page::{called, on_page};
use super::records::Record;
use crate::failure::Failure;
use crate::say::{complain, short};
use brinell::analysis::{MachineClass, Unit, Verdict};
use brinell::made_by::MadeBy;
use brinell::signal::{Estimate, Indicator};
use brinell_measured::{Diagnosis, Findings, Measurement, Short, examine, is_too_short};
use brinell_report::{Evidence, Judged, NotJudged, scaled};
use serde_json::Value;

/// What each row is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Each {
    /// A file, of one channel.
    File,
    /// A channel of several, in each file.
    Channel,
}

impl Each {
    pub(super) fn of(args: &AnalyzeArgs) -> Self {
        if args.signal.channel.len() < 2 { Self::File } else { Self::Channel }
    }

    /// In tables and on axes.
    pub(super) fn heading(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Channel => "Channel",
        }
    }

    /// On the terminal, where a channel's row names its file too.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::File => "file",
            Self::Channel => "signal",
        }
    }

    /// What one of them takes that has a page of its own.
    pub(super) fn alone(self) -> &'static str {
        match self {
            Self::File => "the same command with its file alone",
            Self::Channel => "the same command with its `--channel` alone",
        }
    }
}

/// What is kept of a file.
pub(super) struct Row {
    pub(super) name: String,
    pub(super) found: Result<Found, String>,
}

pub(super) struct Found {
    pub(super) seconds: f64,
    pub(super) verdict: String,
    /// Whether it is *cannot tell*, of any bearing, and no damage of another.
    pub(super) is_open: bool,
    /// Whether a verdict takes a longer record.
    pub(super) too_short: bool,
    /// The same in whole, of each bearing.
    pub(super) sentences: Vec<String>,
    /// Score of the damage that leads; `None` where none is called.
    pub(super) lead: Option<f64>,
    pub(super) unit: Unit,
    pub(super) rms: Option<Estimate>,
    pub(super) peak: Option<Estimate>,
    pub(super) kurtosis: Option<Estimate>,
    /// mm/s.
    pub(super) velocity: Option<Estimate>,
    pub(super) zone: Option<&'static str>,
    /// Scores of the families, by name.
    pub(super) scores: Vec<(String, f64)>,
    /// The speed used in place of the one given.
    pub(super) speed_used: Option<String>,
    /// Where speed and bearings come from.
    pub(super) said: String,
    pub(super) class: Option<MachineClass>,
    /// Scores from which a family is high, and beyond noise.
    pub(super) high: f64,
    pub(super) noise: f64,
    /// What it is compared with: name, RMS, kurtosis.
    pub(super) other: Option<(String, f64, f64)>,
    /// The RMS over the other's, in the range that both hold.
    pub(super) rms_over_other: Option<f64>,
    /// What contradicts what was given.
    pub(super) warnings: Vec<String>,
    pub(super) json: Value,
    /// What its verdict rests on, where a page is wanted and it is one of those shown.
    pub(super) evidence: Option<Box<Evidence>>,
    /// What the customer's report says of it, where that is wanted.
    pub(super) judged: Option<Box<Judged>>,
}

pub(super) fn one(args: &AnalyzeArgs, Record { request, path, .. }: &Record) -> Result<Found, Failure> {
    let measurement = Measurement::open(path, request)?;
    let found = match is_too_short(&measurement, request)? {
        true => Found::of_short(Short::of(measurement, request)?),
        false => {
            let findings = examine(measurement, request)?;
            let judged = args.is_reported().then(|| Box::new(customer::judged(&findings)));
            let evidence = args.folder().map(|_| Box::new(on_page(&findings, |of| Evidence::of(&of))));
            Found { evidence, judged, ..Found::of(&findings) }
        }
    };
    if !args.quiet {
        found.warnings.iter().for_each(|warning| complain!("warning: {}: {warning}", path.display()));
    }
    Ok(found)
}

/// What the customer's report says of each signal, and those of which it says nothing.
///
/// # Errors
/// Where no signal has a verdict.
pub(super) fn judged(rows: &[Row]) -> Result<(Vec<Judged>, Vec<NotJudged>), Failure> {
    let (mut signals, mut without) = (Vec::new(), Vec::new());
    for Row { name, found } in rows {
        match found {
            Ok(Found { judged: Some(judged), .. }) => signals.push((**judged).clone()),
            Ok(found) => without.push((name.clone(), found.sentences.join(" "))),
            Err(why) => without.push((name.clone(), why.clone())),
        }
    }
    match (&signals[..], &without[..]) {
        ([], [(name, why), ..]) => {
            Err(Failure::Usage(format!("{name}: {why} The customer's report takes a verdict on one channel at least")))
        }
        _ => Ok((signals, without)),
    }
}

impl Found {
    fn of_short(short: Short) -> Self {
        Found {
            seconds: short.measurement.seconds(),
            json: short.to_json(),
            verdict: "too short".into(),
            is_open: false,
            too_short: true,
            sentences: vec![short.why],
            lead: None,
            unit: short.measurement.unit.value,
            rms: short.rms,
            peak: Some(Estimate { value: short.peak, interval: None }),
            kurtosis: short.kurtosis,
            velocity: short.velocity.map(|v| scaled(&v, 1e3)),
            zone: None,
            scores: Vec::new(),
            speed_used: None,
            said: format!("{}; bearing: {}", short.speed, short.bearing),
            class: None,
            high: 0.0,
            noise: 0.0,
            other: None,
            rms_over_other: None,
            warnings: short.warnings,
            evidence: None,
            judged: None,
        }
    }

    /// Levels are those of the bearing that leads: its band is the one shown.
    fn of(found: &Findings) -> Self {
        let (results, lead, result) = (&found.bearings[..], found.leads(), found.lead());
        let a = &result.analysis;
        let prefix = |r: &Diagnosis| match results.len() {
            1 => String::new(),
            _ => format!("{} ", r.name),
        };
        let verdicts = results.iter().enumerate().map(|(k, r)| {
            let calls = r.analysis.causes().next().is_some();
            let doubt = if calls && lead != Some(k) { "?" } else { "" };
            format!("{}{}{doubt}", prefix(r), called(r))
        });
        let scores = results.iter().flat_map(|r| {
            let families = r.analysis.families.iter();
            families.map(move |f| (format!("{}{}", prefix(r), f.name), f.score))
        });
        Found {
            seconds: a.duration(),
            verdict: verdicts.collect::<Vec<_>>().join("; "),
            is_open: lead.is_none() && results.iter().any(|r| r.analysis.conclusion() == Verdict::CannotTell),
            too_short: false,
            sentences: match results {
                [only] => vec![only.verdict_text()],
                _ => results.iter().map(|r| format!("{}: {}", r.name, r.verdict_text())).collect(),
            },
            lead: lead.and(result.call()).map(|family| family.score),
            unit: found.measurement.unit.value.clone(),
            rms: a.indicator(Indicator::Rms),
            // The record's own, which has no interval.
            peak: Some(Estimate { value: a.record_peak, interval: None }),
            kurtosis: a.indicator(Indicator::Kurtosis),
            velocity: result.levels.velocity.as_ref().ok().map(|v| scaled(v, 1e3)),
            zone: result.levels.letter(),
            speed_used: a.speed_used(),
            said: format!("{}; bearing: {}", found.speed, said_of_bearings(results)),
            class: result.levels.class,
            high: a.families.iter().map(|f| f.limit).fold(0.0, f64::max),
            noise: a.families.iter().map(|f| f.noise).fold(0.0, f64::max),
            other: result.against.as_ref().map(|other| {
                // Of two sample rates levels are not of one range: none is drawn over the other's.
                let whole = other.comparison.range.is_none();
                let value = |i| other.analysis.indicator(i).filter(|_| whole).map_or(f64::NAN, |e| e.value);
                (other.measurement.path.display().to_string(), value(Indicator::Rms), value(Indicator::Kurtosis))
            }),
            rms_over_other: result.against.as_ref().and_then(|other| {
                let rms = other.comparison.indicators.iter().find(|d| d.indicator == Indicator::Rms)?;
                Some(rms.first / rms.second)
            }),
            scores: scores.collect(),
            warnings: found.warnings.clone(),
            // The version is above all records.
            json: found.to_json(false),
            evidence: None,
            judged: None,
        }
    }

    /// Its JSON, of itself.
    pub(super) fn whole(&self) -> Value {
        let mut json = self.json.clone();
        json["brinell"] = brinell::VERSION.into();
        json["made_by"] = serde_json::json!(MadeBy::now());
        json
    }

    /// In the order of [`COLUMNS`].
    pub(super) fn cells(&self) -> [String; 7] {
        let number = |e: &Option<Estimate>, unit: &str| match e {
            Some(e) if unit.is_empty() => short(e.value, 4),
            Some(e) => format!("{} {unit}", short(e.value, 4)),
            None => "-".into(),
        };
        let mut rms = number(&self.rms, &self.unit.name);
        rms += &self.rms_over_other.map_or(String::new(), |ratio| format!(" (x {})", short(ratio, 3)));
        [
            format!("{:.3}", self.seconds),
            self.verdict.clone(),
            rms,
            number(&self.peak, &self.unit.name),
            number(&self.kurtosis, ""),
            number(&self.velocity, ""),
            self.zone.unwrap_or("-").into(),
        ]
    }
}

/// Where each bearing's frequencies come from.
fn said_of_bearings(results: &[Diagnosis]) -> String {
    let all: Vec<String> = results.iter().map(Diagnosis::said_of_bearing).collect();
    all.join("; ")
}
