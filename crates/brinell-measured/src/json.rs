//! An analysis as JSON: what the library says of it, and what file, channel and speed it is of.

use crate::beside::lead;
use crate::diagnosis::{Diagnosis, Findings};
use crate::measurement::Measurement;
use crate::stretch::Rest;
use brinell::analysis::{Component, HEADLINES, to_json};
use brinell::made_by::MadeBy;
use brinell::signal::{Indicator, RECORD_CREST_FACTOR, RECORD_PEAK, Written, objects};
use serde_json::Value;

objects! {
    /// Of one bearing.
    One<'a> {
        #[serde(flatten)] analysis: Value,
        brinell: &'static str, made_by: MadeBy, severity: Value, file: FileOf<'a>,
        #[serde(skip_serializing_if = "Option::is_none")] size: Option<Value>,
        #[serde(skip_serializing_if = "Option::is_none")] whole: Option<Whole>,
        #[serde(skip_serializing_if = "Option::is_none")] against: Option<Beside<'a>>,
    }
    /// The length of the damage, or why it is not known.
    Size<'a> {
        length_mm: Option<Written>,
        #[serde(skip_serializing_if = "Option::is_none")] way_mm: Option<f64>,
        #[serde(skip_serializing_if = "Option::is_none")] if_shorter_than_mm: Option<f64>,
        #[serde(skip_serializing_if = "Option::is_none")] reason: Option<&'a str> }
    /// Of several bearings.
    Several<'a> {
        brinell: &'static str, made_by: MadeBy, file: FileOf<'a>, verdict: Value, leads: Option<&'a str>, bearings: Vec<Value>,
    }
    /// Which signal it is.
    FileOf<'a> {
        path: String, channel: &'a str, start_s: f64,
        #[serde(skip_serializing_if = "Vec::is_empty")] records: Vec<FileOf<'a>>,
        #[serde(flatten)] said: Option<Said<'a>>,
    }
    /// What is said of it.
    Said<'a> { notes: &'a [String], warnings: &'a [String], speed: &'a str, bearing: String }
    /// A long signal, its levels and its end.
    Whole { samples: u64, missing: u64, indicators: Vec<Named>, last: Last }
    /// An indicator.
    Named { name: &'static str, value: f64 }
    /// An analysis of the end.
    Last { start_s: f64, samples: usize, verdict: String, damage: Vec<Component> }
    /// What it is compared with.
    Beside<'a> { path: String, channel: &'a str, notes: Vec<String>, verdict: String }
}

impl<'a> FileOf<'a> {
    pub(crate) fn new(m: &'a Measurement) -> Self {
        let one = |m: &'a Measurement, records| {
            let (path, channel) = (m.path.display().to_string(), m.channel.value.as_str());
            FileOf { path, channel, start_s: m.start, records, said: None }
        };
        let records = m.records().filter(|_| !m.others.is_empty());
        one(m, records.map(|m| one(m, Vec::new())).collect())
    }
}

impl Findings {
    /// The bearing whose damage scores highest, by index.
    pub fn leads(&self) -> Option<usize> {
        lead(&self.bearings)
    }

    /// The bearing that leads, or the first.
    pub fn lead(&self) -> &Diagnosis {
        &self.bearings[self.leads().unwrap_or(0)]
    }

    /// Everything; of several bearings, each under `bearings`. `version` is left out of what one bearing is given.
    pub fn to_json(&self, version: bool) -> Value {
        let one = |diagnosis: &Diagnosis| {
            let mut one = as_json(self, diagnosis);
            if let Some(all) = one.as_object_mut().filter(|_| !version) {
                all.remove("brinell");
                all.remove("made_by");
            }
            one
        };
        if let [only] = &self.bearings[..] {
            return one(only);
        }
        let of = |diagnosis: &Diagnosis| {
            let mut one = one(diagnosis);
            one["bearing"] = diagnosis.name.clone().into();
            one["beside"] = diagnosis.beside.clone().into();
            one
        };
        let bearings: Vec<Value> = self.bearings.iter().map(of).collect();
        // That of the bearing that leads, or of the first; its text speaks of all.
        let mut verdict = bearings[self.leads().unwrap_or(0)]["verdict"].clone();
        let texts = self.bearings.iter().map(|r| format!("{}: {}", r.name, r.verdict_text()));
        verdict["text"] = texts.collect::<Vec<_>>().join("\n").into();
        let leads = self.leads().map(|k| self.bearings[k].name.as_str());
        let several = Several {
            brinell: brinell::VERSION,
            made_by: MadeBy::now(),
            file: FileOf::new(&self.measurement),
            verdict,
            leads,
            bearings,
        };
        serde_json::to_value(several).unwrap_or_default()
    }
}

fn as_json(findings: &Findings, result: &Diagnosis) -> Value {
    let (m, unit) = (&findings.measurement, &findings.measurement.unit.value);
    let comparison = result.against.as_ref().map(|a| &a.comparison);
    let mut analysis = to_json(&result.analysis, unit, findings.velocity.as_ref(), comparison);
    analysis["verdict"]["text"] = result.verdict_text().into();
    let whole = findings.rest.as_ref().zip(result.last.as_ref()).map(|(rest, last)| Whole {
        samples: rest.samples,
        missing: rest.missing,
        indicators: whole_indicators(rest).map(|(_, name, value)| Named { name, value }).collect(),
        last: Last {
            start_s: rest.last_start,
            samples: last.samples,
            verdict: last.verdict(),
            damage: last.causes().map(|f| f.component).collect(),
        },
    });
    let said = Said {
        notes: &findings.notes,
        warnings: &findings.warnings,
        speed: &findings.speed,
        bearing: result.said_of_bearing(),
    };
    let one = One {
        analysis,
        brinell: brinell::VERSION,
        made_by: MadeBy::now(),
        severity: result.levels.to_json(unit),
        file: FileOf { said: Some(said), ..FileOf::new(m) },
        size: result.size_json(),
        whole,
        against: result.against.as_ref().map(|other| Beside {
            path: other.measurement.path.display().to_string(),
            channel: &other.measurement.channel.value,
            notes: other.measurement.notes(),
            verdict: other.analysis.verdict(),
        }),
    };
    serde_json::to_value(one).unwrap_or_default()
}

impl Diagnosis {
    /// The length of the damage, where it was asked: `length_mm` with `value`, `low` and `high`, or null and the `reason`.
    pub fn size_json(&self) -> Option<Value> {
        let size = self.size.as_ref()?;
        let told = Size {
            length_mm: size.as_ref().ok().map(|t| Written::new(t.value, Some((t.interval.low, t.interval.high)))),
            way_mm: size.as_ref().ok().map(|t| t.way),
            if_shorter_than_mm: size.as_ref().ok().map(|t| t.most),
            reason: size.as_ref().err().map(String::as_str),
        };
        serde_json::to_value(told).ok()
    }
}

/// What was analysed; of several records each.
pub fn of_file(m: &Measurement) -> Value {
    serde_json::to_value(FileOf::new(m)).unwrap_or_default()
}

/// Headline indicators of a whole long signal; its peak is the largest of all samples.
pub fn whole_indicators(rest: &Rest) -> impl Iterator<Item = (Indicator, &'static str, f64)> {
    HEADLINES.into_iter().filter_map(|i| {
        let name = match i {
            Indicator::Peak => RECORD_PEAK,
            Indicator::CrestFactor => RECORD_CREST_FACTOR,
            i => i.name(),
        };
        Some((i, name, rest.moments.get(i)?))
    })
}
