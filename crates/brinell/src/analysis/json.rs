//! An analysis as JSON. Frequencies in Hz; amplitudes in the unit named.

use super::view::candidates;
use super::{Analysis, Comparison, Finding, Strength, Unit};
use crate::signal::{Line, VelocityBands};
use serde_json::{Map, Value, json};

/// The analysis; `velocity` is in m/s where it was computed.
pub fn to_json(
    analysis: &Analysis,
    unit: &Unit,
    velocity: Option<&VelocityBands>,
    comparison: Option<&Comparison>,
) -> Value {
    let view = analysis.view();
    let mut object = json!({
        "verdict": {
            "text": analysis.verdict(),
            "damage": analysis.causes().map(|f| f.component.key()).collect::<Vec<_>>(),
            "nothing_stands_out": analysis.causes().next().is_none(),
            "level": analysis.options.level,
        },
        "findings": analysis.findings.iter().map(|f| finding(analysis, f)).collect::<Vec<_>>(),
        "families": analysis.families.iter().map(|f| json!({
            "component": f.component.key(),
            "name": f.name,
            "expected_hz": f.expected,
            "found_hz": f.frequency,
            "score": f.score,
            "limit": f.limit,
            "depth": f.depth,
            "is_damage": f.is_damage(),
            "harmonics_db": f.snr_db,
        })).collect::<Vec<_>>(),
        "beyond_tolerance": analysis.beyond.as_ref().map(|b| json!({
            "component": b.component.key(),
            "name": b.name,
            "expected_hz": b.expected,
            "found_hz": b.evidence.frequency,
            "false_alarm": b.false_alarm,
            "shaft_hz_if_its": b.shaft,
            "harmonics": b.evidence.harmonics.lines.iter().map(line).collect::<Vec<_>>(),
        })),
        "searched": candidates(analysis.shaft, &analysis.options).iter().enumerate().map(|(i, (component, name, c))| {
            let best = analysis.views.iter().map(|v| v.diagnosis.evidence[i].false_alarm).fold(1.0, f64::min);
            json!({
                "name": name,
                "component": component.key(),
                "frequency_hz": c.frequency,
                "order": c.frequency / analysis.shaft,
                "tolerance_hz": c.tolerance,
                "stands": analysis.views.iter().any(|v| v.diagnosis.evidence[i].stands),
                "false_alarm": (best * analysis.views.len() as f64).min(1.0),
            })
        }).collect::<Vec<_>>(),
        "signal": {
            "unit": unit.name,
            "quantity": unit.quantity.words().to_lowercase(),
            "sample_rate_hz": analysis.sample_rate,
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
        "bands": analysis.views.iter().enumerate().map(|(i, v)| json!({
            "low_hz": v.band.band.low,
            "high_hz": v.band.band.high,
            "choice": v.band.choice.words(),
            "line_spacing_hz": v.spectrum.frequency_step,
            "averages": v.spectrum.segments,
            "set_aside_hz": v.removed,
            "shown": i == analysis.best,
        })).collect::<Vec<_>>(),
        "envelope": { "mean": view.mean, "frequency_step_hz": view.spectrum.frequency_step },
        "kurtogram": analysis.kurtogram.map(|k| json!({
            "low_hz": k.band.low, "high_hz": k.band.high, "kurtosis": k.kurtosis, "noise_scatter": k.noise_scatter,
        })),
        "indicators": analysis.indicators.iter().map(|(i, e)| {
            let unit = if i.has_unit() { unit.name.as_str() } else { "" };
            (i.name().to_owned(), json!({
                "value": e.value,
                "unit": unit,
                "interval_95": e.interval.map(|v| [v.low, v.high]),
            }))
        }).collect::<Map<_, _>>(),
    });
    if let Some(bands) = velocity {
        let rows: Vec<Value> = (bands.iter().flatten())
            .map(|b| {
                json!({
                    "low_hz": b.band.low, "high_hz": b.band.high, "rms_m_per_s": b.rms.value,
                    "interval_95": b.rms.interval.map(|v| [v.low, v.high]), "cut_short": b.cut_short,
                })
            })
            .collect();
        object["velocity_bands"] = rows.into();
    }
    if let Some(c) = comparison {
        object["comparison"] = comparison_json(c);
    }
    object
}

fn line(l: &Line) -> Value {
    json!({
        "order": l.order, "frequency_hz": l.frequency, "amplitude": l.amplitude, "floor": l.floor,
        "snr_db": l.snr_db, "false_alarm": l.false_alarm,
    })
}

fn finding(analysis: &Analysis, f: &Finding) -> Value {
    let band = analysis.views[f.view].band.band;
    json!({
        "component": f.component.key(),
        "name": f.name,
        "is_cause": f.is_cause(),
        "strength": match f.strength { Strength::Damage => "damage", Strength::Faint => "faint" },
        "clarity": f.clarity(),
        "score": f.score,
        "false_alarm": f.false_alarm,
        "expected_hz": f.expected,
        "found_hz": f.evidence.frequency,
        "modulation": f.modulation,
        "band_hz": [band.low, band.high],
        "stands_in": f.standing_in,
        "of_searches": analysis.views.len(),
        "explained_by": f.explained_by,
        "alternatives": f.alternatives,
        "too_short_to_tell_from": f.untold_from,
        "may_be_passing": f.may_be_passing,
        "harmonics": f.evidence.harmonics.lines.iter().map(line).collect::<Vec<_>>(),
        "shown_by_sidebands": f.evidence.carried,
        "sidebands": f.evidence.sidebands.as_ref().map(|s| json!({
            "spacing_hz": s.spacing, "standing": s.standing, "of": s.lines.len(), "false_alarm": s.false_alarm,
        })),
    })
}

fn comparison_json(c: &Comparison) -> Value {
    json!({
        "band_hz": [c.band.0, c.band.1],
        "level_difference_db": { "mean": c.level_db.0, "rms": c.level_db.1 },
        "indicators": c.indicators.iter().map(|d| (d.indicator.name().to_owned(), json!({
            "measured": d.first, "other": d.second, "ratio": d.second / d.first, "intervals_apart": d.apart,
        }))).collect::<Map<_, _>>(),
        "lines": c.lines.iter().map(|l| json!({
            "name": l.name, "order": l.order, "frequency_hz": l.frequency, "modulation": l.modulation, "snr_db": l.snr_db,
        })).collect::<Vec<_>>(),
    })
}
