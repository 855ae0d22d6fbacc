//! An analysis as JSON: what the library says of it, and what file, channel and speed it is of.

use crate::beside::lead;
use crate::diagnosis::{Diagnosis, Findings};
use crate::measurement::Measurement;
use crate::stretch::Rest;
use brinell::analysis::{HEADLINES, to_json};
use brinell::signal::{Indicator, RECORD_CREST_FACTOR, RECORD_PEAK};
use serde_json::{Value, json};

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
        json!({
            "brinell": brinell::VERSION,
            "file": of_file(&self.measurement),
            "verdict": verdict,
            "leads": self.leads().map(|k| &self.bearings[k].name),
            "bearings": bearings,
        })
    }
}

fn as_json(findings: &Findings, result: &Diagnosis) -> Value {
    let (m, unit) = (&findings.measurement, &findings.measurement.unit.value);
    let comparison = result.against.as_ref().map(|a| &a.comparison);
    let mut value = to_json(&result.analysis, unit, findings.velocity.as_ref(), comparison);
    value["brinell"] = brinell::VERSION.into();
    value["verdict"]["text"] = result.verdict_text().into();
    value["severity"] = result.levels.to_json(unit);
    value["file"] = of_file(m);
    value["file"]["notes"] = json!(findings.notes);
    value["file"]["warnings"] = json!(findings.warnings);
    value["file"]["speed"] = json!(findings.speed);
    value["file"]["bearing"] = json!(result.said_of_bearing());
    if let (Some(rest), Some(last)) = (&findings.rest, &result.last) {
        value["whole"] = json!({
            "samples": rest.samples,
            "missing": rest.missing,
            "indicators": whole_indicators(rest).map(|(_, name, v)| json!({ "name": name, "value": v })).collect::<Vec<_>>(),
            "last": {
                "start_s": rest.last_start,
                "samples": last.samples,
                "verdict": last.verdict(),
                "damage": last.causes().map(|f| f.component.key()).collect::<Vec<_>>(),
            },
        });
    }
    if let Some(other) = &result.against {
        value["against"] = json!({
            "path": other.measurement.path.display().to_string(),
            "channel": other.measurement.channel.value,
            "notes": other.measurement.notes(),
            "verdict": other.analysis.verdict(),
        });
    }
    value
}

/// What was analysed; of several records each.
pub fn of_file(m: &Measurement) -> Value {
    let one = |m: &Measurement| json!({ "path": m.path.display().to_string(), "channel": m.channel.value, "start_s": m.start });
    let mut file = one(m);
    if !m.others.is_empty() {
        file["records"] = m.records().map(one).collect();
    }
    file
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
