//! Writes `report.html`, `headline.png` and every picture as SVG and PNG into the directory given, from made-up
//! signals: an impulse train at the BPFO of an NN3007 rings a resonance. Nothing here is a simulation.

use std::error::Error;
use std::f64::consts::TAU;
use std::path::PathBuf;

use brinell_report::{
    Assumption, Estimate, Event, EventKind, Fact, IndicatorRow, IndicatorTable, Layout, Marker, MinMax, Pass, Report,
    RowLoad, Series, Spectrum, Waveform, bin_centres, headline_png, html, pictures,
};

const RATE: f64 = 25_600.0;
const BPFO: f64 = 250.102;

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out".into()));
    std::fs::create_dir_all(&out)?;
    let report = demo(10.0);
    let page = html(&report);
    println!("report.html: {} bytes", page.len());
    std::fs::write(out.join("report.html"), page)?;
    std::fs::write(out.join("empty.html"), html(&Report::default()))?;
    std::fs::write(out.join("headline.png"), headline_png(&report)?)?;
    for picture in pictures(&report, Layout::Wide) {
        std::fs::write(out.join(format!("{}.svg", picture.name)), picture.svg())?;
        std::fs::write(out.join(format!("{}.png", picture.name)), picture.png_file()?)?;
    }
    Ok(())
}

/// Noise that needs no crate.
fn noise(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as f64 / f64::from(1u32 << 31) - 0.5
}

fn demo(duration: f64) -> Report {
    let count = (duration * RATE) as usize;
    let mut state = 7;
    let mut values: Vec<f64> = (0..count).map(|_| 12.0 * noise(&mut state)).collect();
    let mut events = vec![];
    for hit in 0..(duration * BPFO) as usize {
        let t = hit as f64 / BPFO;
        let roller = format!("1·{:02}", hit % 19 + 1);
        events.push(Event { t_s: t, kind: EventKind::Enter, label: roller.clone() });
        events.push(Event { t_s: t + 0.0013, kind: EventKind::Leave, label: roller });
        for (delay, size) in [(0.0, 45.0), (0.0013, 80.0)] {
            let first = ((t + delay) * RATE).ceil() as usize;
            for (k, value) in values.iter_mut().enumerate().skip(first).take(200) {
                let s = k as f64 / RATE - t - delay;
                *value += size * (-s * 900.0).exp() * (TAU * 4200.0 * s).sin();
            }
        }
    }
    let bins = 2000;
    let chunk = count / bins;
    let extreme = |pick: fn(f64, f64) -> f64| {
        values.chunks(chunk).map(|c| c.iter().copied().reduce(pick).unwrap_or(0.0)).collect()
    };
    let kept = values[count - 65_536.min(count)..].to_vec();
    let t0 = (count - kept.len()) as f64 / RATE;
    events.retain(|event| event.t_s >= t0);
    Report {
        title: "nn3007-rectangle".into(),
        subtitle: "NN3007, outer raceway, rectangle 3 × 4 mm, 20 µm deep; 1800 r/min, 300 N".into(),
        version: "0.1.0".into(),
        partial: Some("Stopped by Ctrl-C after 10.00 s of 20 s; everything below covers the part that was run.".into()),
        facts: vec![
            Fact::new("RMS, measured", 22.93, "m/s^2", "outer ring, x; anti-aliased at 25.6 kHz"),
            Fact::new("BPFO from the envelope", 250.0, "Hz", "pure rolling: 250.1 Hz"),
            Fact::new("Largest contact force", 41.27, "N", "row 1, roller 7, outer contact"),
            Fact::new("Load zone", 168.0, "°", "outer contacts above 1 % of the largest"),
            Fact::new("Kurtosis", 9.42, "", "3 for noise"),
            Fact::new("Cage slip", 0.11, "%", "mean over the last second"),
            Fact::new("Momentum audit", 3.1e-13, "N s", "").judged(true),
            Fact::new("Model", "full, 124 degrees of freedom", "", "law ecl, path point"),
        ],
        spectrum: spectrum(&kept, 1.0, "Acceleration amplitude", "Hann window, one block of the last 2.56 s."),
        envelope_spectrum: spectrum(
            &kept.iter().map(|v| v.abs()).collect::<Vec<_>>(),
            1.0,
            "Envelope amplitude",
            "Envelope of the band 2.0 to 6.0 kHz.",
        ),
        waveform: Waveform {
            series: Series {
                label: "Outer ring acceleration, x".into(),
                unit: "m/s^2".into(),
                t0_s: t0,
                dt_s: 1.0 / RATE,
                values: kept,
            },
            overview: Some(MinMax { t0_s: 0.0, dt_s: chunk as f64 / RATE, min: extreme(f64::min), max: extreme(f64::max) }),
            events,
        },
        markers: [
            ("BPFO", "a roller passes a point of the outer raceway", BPFO, 6, true),
            ("BPFI", "a roller passes a point of the inner raceway", 319.898, 6, false),
            ("2 BSF", "a point of a roller passes either raceway", 241.326, 6, false),
            ("FTF", "the cage turns once", 13.163, 6, false),
        ]
        .map(|(label, meaning, frequency_hz, harmonics, present)| Marker {
            label: label.into(),
            meaning: meaning.into(),
            frequency_hz,
            harmonics,
            present,
        })
        .to_vec(),
        damage: vec![],
        undrawn_damage: None,
        passes: vec![rectangle_pass()],
        load_distribution: (1..=2).map(row_load).collect(),
        indicators: indicators(),
        slip: vec![
            Fact::new("Rollers on the inner raceway, loaded", 0.02, "%", "mean over contacts above 10 % of the largest force"),
            Fact::new("Rollers on the inner raceway, unloaded", 4.31, "%", "mean over the rest"),
            Fact::new("Cage, row 1", 0.11, "%", "against pure rolling, last second"),
            Fact::new("Cage, row 2", 0.12, "%", "against pure rolling, last second"),
        ],
        audits: vec![
            Fact::new("Linear momentum, x", 3.1e-13, "N s", "largest imbalance over the run").judged(true),
            Fact::new("Energy: input − change − dissipation − defects", 2.4e-4, "J", "limit 1e-3 J").judged(true),
            Fact::new("Estimated solver error of outer_ax", 1.9, "%", "limit 1.5 %").judged(false),
        ],
        solver_work: vec![
            Fact::new("Steps", 1_204_331.0, "", ""),
            Fact::new("Rejected steps", 48_212.0, "", ""),
            Fact::new("Right-hand sides", 3_757_629.0, "", "375 763 for each simulated second"),
            Fact::new("Force switches", 108_201.0, "", "contacts, pockets, defect edges"),
            Fact::new("Time taken", 21.4, "s", "2.1 s for each simulated second"),
        ],
        assumptions: [
            ("bearing.outer_raceway_diameter_mm", 55.0, "mm", "paper, Table 1", false),
            ("contact.outer_stiffness", 1.898e8, "N/m^(10/9)", "paper, Table 1; read as a force-deflection constant", false),
            ("support.outer_stiffness_n_per_m", 1e6, "N/m", "not stated; below the bound at which the support carries the load", true),
            ("lubricant.viscosity_pa_s", 0.01, "Pa s", "not stated; a light spindle oil at 60 °C", true),
        ]
        .map(|(key, value, unit, source, estimated)| Assumption {
            key: key.into(),
            value: value.into(),
            unit: unit.into(),
            source: source.into(),
            estimated,
        })
        .to_vec(),
        scenario_toml: "name = \"nn3007-rectangle\"\n\n[bearing]\npreset = \"NN3007\"\n\n[operation]\nspeed_rpm = 1800.0\nload_n = [300.0, 0.0]\n\n\
                        [[defects]]\non = \"outer-raceway\"\nrow = 1\ndepth_um = 20.0\nshape = { rectangle = { length_mm = 3.0, width_mm = 4.0 } }\n\n\
                        [simulation]\nduration_s = 10.0\nsample_rate_hz = 25600.0\n"
            .into(),
        ..Report::default()
    }
}

fn indicators() -> IndicatorTable {
    let row = |channel: &str, kind: &str, scale: f64| {
        let cell = |value: f64, half: f64, unit: &str| Estimate {
            value,
            interval: Some((value - half, value + half)),
            unit: unit.into(),
        };
        IndicatorRow {
            channel: channel.into(),
            kind: kind.into(),
            cells: vec![
                cell(22.93 * scale, 0.42 * scale, "m/s^2"),
                cell(288.1 * scale, 14.0 * scale, "m/s^2"),
                cell(6.41, 0.3, ""),
                cell(9.42, 0.55, ""),
                cell(0.08, 0.04, ""),
            ],
        }
    };
    IndicatorTable {
        columns: ["RMS", "Peak to peak", "Crest factor", "Kurtosis", "Skewness"].map(str::to_owned).to_vec(),
        rows: vec![
            row("sensor_ax", "anti-aliased", 1.0),
            row("sensor_ay", "anti-aliased", 0.61),
            row("outer_ax", "instantaneous", 1.29),
            row("outer_ay", "instantaneous", 0.74),
        ],
        note: "95 % intervals from 30 blocks of 10 revolutions each.".into(),
    }
}

fn rectangle_pass() -> Pass {
    let angle_deg: Vec<f64> = (0..400).map(|i| -6.0 + 12.0 * f64::from(i) / 399.0).collect();
    let over = |a: f64| a.abs() <= 3.125;
    Pass {
        title: "Row 1, roller 7 over defect 1 (rectangle, outer raceway)".into(),
        length_mm: angle_deg.iter().map(|a| if over(*a) { 2.0 } else { 6.0 }).collect(),
        other_length_mm: Some(vec![6.0; 400]),
        stiffness: angle_deg.iter().map(|a| if over(*a) { 7.15e7 } else { 1.898e8 }).collect(),
        stiffness_unit: "N/m^(10/9)".into(),
        force_n: angle_deg
            .iter()
            .map(|a| if over(*a) { 20.0 + 12.0 * (-(a + 3.1)).exp() * (9.0 * a).cos() } else { 38.0 - 0.2 * a * a })
            .collect(),
        contact: "outer contact".into(),
        other_contact: "inner contact".into(),
        angle_deg,
    }
}

fn row_load(row: u32) -> RowLoad {
    let angle_deg = bin_centres(72);
    let force = |a: f64| 40.0 * (a.to_radians().cos() - 0.1).max(0.0).powf(1.11);
    RowLoad {
        title: format!("Row {row}, outer contact"),
        mean_n: angle_deg.iter().map(|a| force(*a)).collect(),
        max_n: angle_deg.iter().map(|a| 1.15 * force(*a) + 0.2).collect(),
        static_points: (0..19)
            .map(|j| (f64::from(j) + 0.5 * f64::from(row - 1)) * 360.0 / 19.0)
            .map(|a| (a, force(a)))
            .collect(),
        angle_deg,
    }
}

/// A slow transform of a short block, for the look of it.
fn spectrum(values: &[f64], scale: f64, label: &str, note: &str) -> Spectrum {
    let n = 8192.min(values.len());
    let mean = values[..n].iter().sum::<f64>() / n as f64;
    let windowed: Vec<f64> =
        values[..n].iter().enumerate().map(|(i, v)| (v - mean) * (1.0 - (TAU * i as f64 / n as f64).cos())).collect();
    let amplitude = (0..n / 2)
        .map(|line| {
            let (mut re, mut im) = (0.0, 0.0);
            let (step_im, step_re) = (TAU * line as f64 / n as f64).sin_cos();
            let (mut c, mut s) = (1.0, 0.0);
            for v in &windowed {
                re += v * c;
                im += v * s;
                (c, s) = (c * step_re - s * step_im, c * step_im + s * step_re);
            }
            scale * 2.0 * f64::hypot(re, im) / n as f64
        })
        .collect();
    Spectrum { label: label.into(), df_hz: RATE / n as f64, amplitude, unit: "m/s^2".into(), note: note.into() }
}
