//! An analysis as JSON. Frequencies in Hz; amplitudes in the unit named.

use super::{Analysis, Comparison, Family, Finding, Unexplained, Unit};
use crate::{InUnit, RECORD_CREST_FACTOR, RECORD_PEAK, VelocityBands, Written};
use serde_json::{Map, Value, json};

/// The analysis; `velocity` is in m/s where it was computed.
pub fn to_json(
    analysis: &Analysis,
    unit: &Unit,
    velocity: Option<&VelocityBands>,
    comparison: Option<&Comparison>,
) -> Value {
    let view = &analysis.view;
    let mut object = json!({
        "verdict": {
            "text": analysis.verdict(),
            "says": analysis.conclusion().key(),
            "unexplained": analysis.unexplained().map(Unexplained::key),
            "kurtosis_beside_healthy": analysis.kurtosis_beside,
            "rms_over_healthy": analysis.level_growth,
            "rms_over_healthy_range_hz": analysis.level_range.map(|range| [range.low, range.high]),
            "damage": analysis.causes().map(|f| f.component.key()).collect::<Vec<_>>(),
            "clarity": analysis.causes().next().map(|f| analysis.clarity(f)),
        },
        "families": analysis.families.iter().map(|f| family(analysis, f)).collect::<Vec<_>>(),
        "at_given": analysis.at_given.as_ref().map(|f| family(analysis, f)),
        "elsewhere": analysis.elsewhere.map(|e| json!({
            "frequency_hz": e.frequency, "order": e.frequency / analysis.shaft, "score": e.score, "modulation": e.modulation,
            "nearest": e.nearest.map(|n| json!({ "component": n.component.key(), "name": n.name, "shift": n.shift, "shaft_hz_if_its": n.shaft, "slip_if_its": n.slip })),
        })),
        "tolerance": analysis.options.tolerance,
        "signal": {
            "unit": unit.name,
            "quantity": unit.quantity.words().to_lowercase(),
            "sample_rate_hz": analysis.sample_rate,
            "records": analysis.records,
            "samples": analysis.samples,
            "duration_s": analysis.duration(),
            "mean_removed": analysis.mean,
        },
        "shaft": {
            "given_hz": analysis.options.shaft,
            "used_hz": analysis.shaft,
            "found_in_signal": !analysis.shaft_lines.is_empty(),
            "harmonics_found": analysis.shaft_lines,
        },
        "flaws": analysis.flaws.iter().map(|(_, flaw)| flaw.to_string()).collect::<Vec<_>>(),
        "drift": analysis.drift.as_ref().map(|d| {
            let point = |(t, hz): (f64, f64)| json!({ "at_s": t, "rpm": 60.0 * hz });
            json!({
                "by": d.by,
                "lowest": point(d.lowest()),
                "highest": point(d.highest()),
                "order_10_smears_bins": d.smear,
                "leaves_range": d.leaves,
                "followed": d.followed,
                "course": d.course.iter().map(|p| point(*p)).collect::<Vec<_>>(),
            })
        }),
        "bands": analysis.bands,
        "envelope": {
            "low_hz": view.band.low,
            "high_hz": view.band.high,
            "choice": view.choice.words(),
            "mean": view.mean,
            "frequency_step_hz": view.spectrum.frequency_step,
            "averages": view.spectrum.segments,
        },
        "kurtogram": analysis.kurtogram,
        "indicators": indicators(analysis, unit),
    });
    if let Some(bands) = velocity {
        object["velocity_bands"] = json!(bands.iter().flatten().collect::<Vec<_>>());
    }
    if let Some(c) = comparison {
        object["comparison"] = comparison_json(c);
    }
    object
}

/// Averages over revolutions, and the peak and the crest factor of the whole record, which have no interval.
fn indicators(analysis: &Analysis, unit: &Unit) -> Map<String, Value> {
    let one = |number: Written, unit: &str| json!(InUnit { number, unit });
    let mut all: Map<String, Value> = (analysis.indicators.iter())
        .map(|(i, e)| (i.name().to_owned(), one((*e).into(), i.unit(&unit.name))))
        .collect();
    all.insert(RECORD_PEAK.into(), one(Written::new(analysis.record_peak, None), &unit.name));
    if let Some(crest) = analysis.record_crest_factor() {
        all.insert(RECORD_CREST_FACTOR.into(), one(Written::new(crest, None), ""));
    }
    all
}

fn family(analysis: &Analysis, f: &Family) -> Value {
    json!({
        "component": f.component.key(),
        "name": f.name,
        "says": f.finding.key(),
        "shared_with": match f.finding { Finding::Shared(with) => Some(with), _ => None },
        "may_be_passing": analysis.may_be_passing(f),
        "masked": f.masked,
        "other_spacing_hz": f.other_spacing,
        "others_slip": f.others_slip,
        "expected_hz": f.expected,
        "found_hz": f.frequency,
        "order": f.frequency / analysis.shaft,
        "shift": f.shift(),
        "score": f.score,
        "limit": f.limit,
        "noise": f.noise,
        "modulation": f.modulation,
        "over_healthy": f.growth,
        "harmonics": f.harmonics,
        "sidebands": f.sidebands.as_ref().map(|s| json!({
            "spacing_hz": s.spacing, "detected": s.detected.len(), "of": s.of,
        })),
    })
}

fn comparison_json(c: &Comparison) -> Value {
    json!({
        "band_hz": [c.band.0, c.band.1],
        "indicators_range_hz": c.range.map(|range| [range.low, range.high]),
        "level_difference_db": { "mean": c.level_db.0, "rms": c.level_db.1 },
        "indicators": c.indicators.iter().map(|d| (d.indicator.name().to_owned(), json!({
            "measured": d.first, "other": d.second, "ratio": d.first / d.second, "intervals_apart": d.apart,
        }))).collect::<Map<_, _>>(),
        "lines": c.lines,
    })
}
