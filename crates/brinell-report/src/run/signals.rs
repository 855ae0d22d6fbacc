//! Of a run's page, the sensor signal: waveform, spectra, defect frequencies, indicators.

use crate::number::{capital, short};
use crate::{Estimate, Event, IndicatorRow, IndicatorTable, Marker, MinMax, Series, Spectrum, Waveform};
use brinell::analysis::HARMONICS;
use brinell::bearing::Kinematics;
use brinell::model::Model;
use brinell::observe::{ChannelStatistics, DefectLine, Kind};
use brinell::plausibility::of_changing_speed;
use brinell::result::Parts;
use brinell::scenario::{Scenario, Speed};
use brinell::signal::Indicator;
use std::f64::consts::TAU;

/// What the anti-alias filter, whose delay is taken out, does to an impact.
pub(crate) const RINGS_BEFORE: &str =
    "The anti-alias filter is without delay: an impact also shows in the few samples before it.";

/// Indicators that the table shows.
const COLUMNS: [(Indicator, &str); 5] = [
    (Indicator::Rms, "RMS"),
    (Indicator::PeakToPeak, "Peak to peak of a turn"),
    (Indicator::CrestFactor, "Crest factor of a turn"),
    (Indicator::Kurtosis, "Kurtosis"),
    (Indicator::Skewness, "Skewness"),
];

/// What the signal is called where a spectrum is of it.
pub(super) fn axis<'a>(parts: &Parts<'a>) -> &'a str {
    parts.findings.sensor.strip_prefix("sensor_a").unwrap_or(&parts.findings.sensor)
}

/// What waveform and spectra show.
pub(super) fn sensor_label(parts: &Parts) -> String {
    let what = match parts.simulation.sensor() {
        _ if parts.loaded.scenario.machine.is_some() => return format!("Acceleration, {}", parts.findings.sensor),
        Some(_) => "Acceleration at the sensor",
        None => "Outer ring acceleration",
    };
    format!("{what}, {} (sensor)", axis(parts))
}

pub(super) fn waveform(parts: &Parts) -> Waveform {
    let f = parts.findings;
    let dt = 1.0 / parts.simulation.sample_rate();
    let (first, values) = f.waveform.latest();
    let t0 = first as f64 * dt;
    let (bins, per_bin) = f.waveform.overview();
    let l = &parts.simulation.model().layout;
    Waveform {
        series: Series { label: sensor_label(parts), unit: "m/s^2".into(), t0_s: t0, dt_s: dt, values },
        overview: Some(MinMax {
            t0_s: 0.0,
            dt_s: per_bin as f64 * dt,
            min: bins.iter().map(|b| b[0]).collect(),
            max: bins.iter().map(|b| b[1]).collect(),
        }),
        events: f
            .passes
            .events
            .iter()
            .filter(|e| e.t >= t0)
            .map(|e| Event {
                t_s: e.t,
                enters: e.enters,
                label: format!("{}·{:02}", l.row(e.slot) + 1, l.roller(e.slot) + 1),
            })
            .collect(),
    }
}

pub(super) fn spectrum(parts: &Parts) -> Spectrum {
    let Some(s) = &parts.findings.spectrum else {
        return Spectrum::default();
    };
    Spectrum {
        label: "Acceleration amplitude".into(),
        df_hz: s.frequency_step,
        amplitude: s.amplitude.clone(),
        unit: "m/s^2".into(),
        note: format!(
            "Sensor acceleration along {}, peak amplitude, Hann window, {} of {} samples.",
            axis(parts),
            if s.segments == 1 { "one segment".to_owned() } else { format!("mean of {} segments", s.segments) },
            s.segment_length
        ),
    }
}

pub(super) fn envelope_spectrum(parts: &Parts) -> Spectrum {
    let Some((e, band)) = &parts.findings.envelope else {
        return Spectrum::default();
    };
    Spectrum {
        label: "Envelope amplitude".into(),
        df_hz: e.spectrum.frequency_step,
        amplitude: e.spectrum.amplitude.clone(),
        unit: "m/s^2".into(),
        note: format!(
            "Envelope of the sensor acceleration between {:.1} and {:.1} kHz.{}",
            1e-3 * band.low,
            1e-3 * band.high,
            match parts.loaded.scenario.operation.speed_rpm {
                Speed::Constant(_) => "",
                Speed::Profile(_) =>
                    " The speed varies, so no defect frequency is a line here; below, over orders, it is.",
            }
        ),
    }
}

/// Defect frequencies at constant speed; at a varying speed there are none to mark.
pub fn defect_markers(scenario: &Scenario, model: &Model) -> Vec<Marker> {
    let Speed::Constant(_) = scenario.operation.speed_rpm else {
        return Vec::new();
    };
    markers_at(scenario, model, model.rotation.at(0.0).0)
}

/// The same of a run: of damage whose frequency was found, at that one.
pub(crate) fn found_markers(scenario: &Scenario, model: &Model, lines: &[DefectLine]) -> Vec<Marker> {
    let mut markers = defect_markers(scenario, model);
    for marker in &mut markers {
        let found = lines.iter().filter(|line| line.name == marker.label).find_map(|line| line.found);
        if let Some(found) = found {
            marker.pure_rolling_hz = Some(marker.frequency_hz);
            marker.frequency_hz = found.frequency;
        }
    }
    markers
}

/// Defect frequencies at a speed of the shaft, rad/s.
pub(super) fn markers_at(scenario: &Scenario, model: &Model, speed: f64) -> Vec<Marker> {
    let k: Kinematics = model.kinematics(speed);
    let damaged: Vec<&str> = scenario.defects.iter().map(|d| k.defect_frequency(d.on).0).collect();
    // Impacts first, then what modulates them.
    let shaft = speed.abs() / TAU;
    ["BPFO", "BPFI", "2 BSF", "FTF", "shaft"]
        .into_iter()
        .filter_map(|name| k.table(shaft).into_iter().find(|row| row.0 == name))
        .map(|(name, frequency_hz, meaning)| Marker {
            label: name.into(),
            meaning: meaning.into(),
            frequency_hz,
            pure_rolling_hz: None,
            harmonics: HARMONICS,
            present: damaged.contains(&name),
            sidebands: Vec::new(),
        })
        .collect()
}

pub(super) fn indicators(parts: &Parts, has_spread: bool) -> IndicatorTable {
    let cell = |channel: &ChannelStatistics, indicator: Indicator| {
        let unit = indicator.unit(channel.unit);
        match channel.blocks.estimate(indicator) {
            Some(e) => Estimate { value: e.value, interval: e.interval.map(|i| (i.low, i.high)), unit: unit.into() },
            None => Estimate { value: f64::NAN, interval: None, unit: unit.into() },
        }
    };
    let mut rows: Vec<IndicatorRow> = parts
        .findings
        .channels
        .iter()
        .filter(|c| c.unit == "m/s^2" || c.name.starts_with("sensor"))
        .filter(|c| !c.name.starts_with("roller"))
        .map(|c| IndicatorRow {
            channel: c.name.clone(),
            kind: match c.kind {
                Kind::AntiAliased => "anti-aliased".into(),
                Kind::Instantaneous => "instantaneous".into(),
            },
            cells: COLUMNS.iter().map(|(i, _)| cell(c, *i)).collect(),
        })
        .collect();
    // What a sensor sees comes first.
    rows.sort_by_key(|r| {
        (!r.channel.starts_with("sensor") && r.channel != parts.findings.sensor, r.kind == "instantaneous")
    });
    let of = match parts.findings.of_sensor().is_some_and(|c| c.blocks.revolutions() == 0) {
        true => "No whole revolution was analysed: averages and peaks are those of the record.".to_owned(),
        false => format!(
            "Averages over whole revolutions, in brackets their 95 % intervals, scatter only: what is assumed is not in them ({}); peaks are those of a revolution.",
            if has_spread { "the section on it has its bands" } else { "`brinell run --spread`" }
        ),
    };
    let changing = of_changing_speed(&parts.loaded.scenario, parts.simulation, parts.findings);
    let changing = changing.map_or(String::new(), |words| format!(" {}.", capital(&words)));
    IndicatorTable {
        columns: COLUMNS.iter().map(|(_, name)| (*name).to_owned()).collect(),
        rows,
        note: format!(
            "From t = {} s on. {of}{changing} The anti-alias filter takes away what lies above half the sample rate: instantaneous values hold all of it.",
            short(parts.findings.from, 3)
        ),
    }
}
