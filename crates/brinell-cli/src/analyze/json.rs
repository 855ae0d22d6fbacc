//! An analysis as JSON: what the library says of it, and what file, channel and speed it is of.

use super::diagnosis::Diagnosis;
use super::measured::{Measured, Rest};
use brinell::analysis::{HEADLINES, to_json};
use brinell::signal::{Indicator, RECORD_CREST_FACTOR, RECORD_PEAK};
use serde_json::{Value, json};

pub(super) fn as_json(result: &Diagnosis) -> Value {
    let m = &result.measured;
    let comparison = result.against.as_ref().map(|a| &a.comparison);
    let mut value = to_json(&result.analysis, &m.unit, result.velocity.as_ref(), comparison);
    value["brinell"] = brinell::VERSION.into();
    value["verdict"]["text"] = result.verdict_text().into();
    value["severity"] = result.levels.to_json(&m.unit);
    value["file"] = of_file(m);
    value["file"]["notes"] = json!(m.notes);
    value["file"]["warnings"] = json!(m.warnings);
    value["file"]["speed"] = json!(result.speed);
    value["file"]["bearing"] = json!(result.bearing);
    if let (Some(rest), Some(last)) = (&result.rest, &result.last) {
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
            "path": other.measured.path.display().to_string(),
            "channel": other.measured.channel,
            "notes": other.measured.notes,
            "verdict": other.analysis.verdict(),
        });
    }
    value
}

/// What was analysed; of several records each.
pub(super) fn of_file(m: &Measured) -> Value {
    let one = |m: &Measured| json!({ "path": m.path.display().to_string(), "channel": m.channel, "start_s": m.start });
    let mut file = one(m);
    if !m.others.is_empty() {
        file["records"] = m.records().map(one).collect();
    }
    file
}

/// Headline indicators of a whole long signal; its peak is the largest of all samples.
pub(super) fn whole_indicators(rest: &Rest) -> impl Iterator<Item = (Indicator, &'static str, f64)> {
    HEADLINES.into_iter().filter_map(|i| {
        let name = match i {
            Indicator::Peak => RECORD_PEAK,
            Indicator::CrestFactor => RECORD_CREST_FACTOR,
            i => i.name(),
        };
        Some((i, name, rest.moments.get(i)?))
    })
}
