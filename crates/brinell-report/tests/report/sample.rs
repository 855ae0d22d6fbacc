//! Reports to draw: everything filled from given strings and numbers, and an ordinary run.

use brinell::derived::Passing;
use brinell::document::{Origin, Provenance};
use brinell::observe::passes::PassPoint;
use brinell::observe::slip_course::Slips;
use brinell::scenario::Surface;
use brinell::signal;
use brinell_report::{
    AxialRow, AxialSection, CageOrbit, CageOrbits, DamageCurve, DamageCurves, DamagePanel, DamageView, DepthPatch,
    Estimate, Event, Fact, Healthy, IndicatorRow, IndicatorTable, Marker, MinMax, Motion, MotionDamage, MotionRow,
    Page, Pass, PressureView, RowLoad, SensorView, Series, Signals, SlipRow, Spectrogram, Spectrum, Waveform, chapters,
};
use std::sync::Arc;

/// What the page of a run is made of.
#[derive(Clone, Default)]
pub(crate) struct Report {
    pub(crate) signals: Signals,
    pub(crate) lead: String,
    pub(crate) version: String,
    pub(crate) partial: Option<String>,
    pub(crate) warnings: Vec<String>,
    pub(crate) facts: Vec<Fact>,
    pub(crate) spectrogram: Spectrogram,
    pub(crate) damage: Vec<DamageView>,
    pub(crate) undrawn_damage: Option<String>,
    pub(crate) passes: Vec<Pass>,
    pub(crate) load_distribution: Vec<RowLoad>,
    pub(crate) along: Option<DamageCurves>,
    pub(crate) indicators: IndicatorTable,
    pub(crate) slip: Vec<Fact>,
    pub(crate) slip_rows: Vec<SlipRow>,
    pub(crate) cage_orbits: CageOrbits,
    pub(crate) sensor: SensorView,
    pub(crate) motion: Motion,
    pub(crate) audits: Vec<Fact>,
    pub(crate) solver_work: Vec<Fact>,
    pub(crate) assumptions: Vec<Provenance>,
    pub(crate) scenario_toml: String,
}

impl Report {
    /// As a run's page is put together.
    pub(crate) fn page(&self) -> Page {
        let r = self.clone();
        let signals = Arc::new(r.signals);
        let mut all = chapters::signals(&signals);
        all.push(chapters::spectrogram(r.spectrogram));
        all.extend(chapters::sensor(r.sensor));
        all.extend([
            chapters::damage(r.undrawn_damage.map_or(Ok(r.damage), Err)),
            chapters::passes(r.passes),
            chapters::load(r.load_distribution, r.along),
            chapters::motion(r.motion),
            chapters::orbit(r.cage_orbits),
            chapters::indicators(&r.indicators),
            chapters::slip(&r.slip, r.slip_rows),
            chapters::assumptions(&r.assumptions, false),
        ]);
        all.extend(chapters::appendices(&r.audits, &r.solver_work, &r.scenario_toml));
        all.push(chapters::headline(&signals));
        Page {
            title: signals.title.clone(),
            subtitle: signals.subtitle.clone(),
            version: r.version,
            partial: r.partial,
            lead: r.lead,
            warnings: r.warnings,
            facts: r.facts,
            chapters: all,
            ..Page::simulated()
        }
    }
}

/// Damage in which every list is filled; one with depths and one of a polygon come from the sign of the first value.
fn damage_view(text: &str, values: &[f64]) -> DamageView {
    let at = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
    let panel = DamagePanel {
        label: text.into(),
        unit: text.into(),
        from_zero: at(1) > 0.0,
        curves: vec![DamageCurve { name: text.into(), values: values.to_vec() }; 2],
    };
    let curves = |along: Vec<f64>, panels: usize| DamageCurves {
        title: text.into(),
        along,
        panels: vec![panel.clone(); panels],
        note: text.into(),
    };
    DamageView {
        title: text.into(),
        surface: text.into(),
        element: text.into(),
        plan_title: text.into(),
        half_turn_mm: (at(2) > 0.0).then(|| at(3)),
        facts: vec![Fact::new(text, at(0), text, text)],
        polygons_mm: vec![values.windows(2).map(|w| [w[0], w[1]]).collect()],
        against_mm: values.windows(2).map(|w| [w[1], w[0]]).collect(),
        against: text.into(),
        depths: (at(0) > 0.0).then(|| DepthPatch {
            start_mm: [at(1), at(2)],
            step_mm: [at(3), 0.5],
            columns: 3,
            depth_um: values.to_vec(),
        }),
        roller_length_mm: at(4),
        roller_diameter_mm: at(5),
        passing: if at(2) > 0.0 { Passing::TowardsPlus } else { Passing::TowardsMinus },
        load_zone_mm: Some([at(6), at(7)]),
        passage: curves(values.to_vec(), 2),
        photo: None,
        pressures: vec![PressureView {
            title: text.into(),
            contact: text.into(),
            start_mm: [at(1), at(2)],
            step_mm: [at(3), 0.5],
            columns: 3,
            pressure_mpa: values.to_vec(),
            largest_mpa: at(4),
            at_mm: [at(5), at(6)],
            yield_mpa: at(7),
            note: text.into(),
            ..PressureView::default()
        }],
        section: curves(values.to_vec(), 1),
    }
}

/// A square of side 4 with a square hole of side 2, both wound the same way.
pub(crate) fn square_with_a_hole() -> DamageView {
    let square = |h: f64| vec![[-h, -h], [h, -h], [h, h], [-h, h]];
    DamageView {
        polygons_mm: vec![square(2.0), square(1.0)],
        roller_length_mm: 6.0,
        roller_diameter_mm: 6.0,
        load_zone_mm: Some([-30.0, 30.0]),
        ..DamageView::default()
    }
}

fn slip_row(text: &str, values: &[f64], dt: f64) -> SlipRow {
    let some: Vec<f64> = values.iter().take(1000).copied().collect();
    SlipRow {
        name: text.into(),
        dt_s: dt,
        over_time: Slips { cage: some.clone(), orbit: some.clone(), spin: some.clone() },
        over_angle: Slips { cage: vec![], orbit: some.clone(), spin: some },
    }
}

/// Two rows of two rollers, as many frames as the values allow.
fn motion(text: &str, values: &[f64], dt: f64) -> Motion {
    let some: Vec<f32> = values.iter().take(480).map(|v| *v as f32).collect();
    let row = MotionRow {
        title: text.into(),
        pockets: vec![0.0, 3.1],
        cage: some.clone(),
        orbit: some.clone(),
        spin: some.clone(),
        inner_n: some.clone(),
        outer_n: some.clone(),
    };
    let axial = AxialRow {
        middle_mm: values.first().copied().unwrap_or(4.5),
        tilt: some.clone(),
        inner: some.iter().chain(&some).copied().collect(),
        outer: some.iter().chain(&some).copied().collect(),
    };
    let section = AxialSection {
        through: text.into(),
        width_mm: values.last().copied().unwrap_or(20.0),
        roller_length_mm: 6.0,
        roller_diameter_mm: 6.0,
        rings: some.iter().map(|s| [*s, -s]).collect(),
        rows: vec![axial; 2],
        strips: 2,
    };
    Motion {
        section: Some(section),
        t0_s: 0.0,
        dt_s: dt,
        inner_radius_mm: 21.5,
        outer_radius_mm: 27.5,
        pitch_radius_mm: 24.5,
        roller_radius_mm: 3.0,
        ring: some,
        rows: vec![row; 2],
        damage: [Surface::OuterRaceway, Surface::InnerRaceway, Surface::Roller(1)]
            .map(|surface| MotionDamage {
                row: 0,
                surface,
                angle: [values.first().copied().unwrap_or(f64::NAN), values.last().copied().unwrap_or(0.1)],
            })
            .to_vec(),
    }
}

/// A report in which every list is filled, strings from `text` and numbers from `values`.
pub(crate) fn filled(text: &str, values: &[f64], dt: f64, frequency: f64) -> Report {
    let at = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
    let fact = || Fact::new(text, at(0), text, text).judged(at(1) > 0.0);
    let spectrum =
        || Spectrum { label: text.into(), df_hz: dt, amplitude: values.to_vec(), unit: text.into(), note: text.into() };
    let marker = |present: bool| Marker {
        label: text.into(),
        meaning: text.into(),
        frequency_hz: frequency,
        pure_rolling_hz: present.then_some(at(2)),
        harmonics: 5,
        present,
        sidebands: vec![],
    };
    Report {
        signals: Signals {
            healthy: Healthy {
                waveform: values.to_vec(),
                spectrum: values.to_vec(),
                envelope_spectrum: values.to_vec(),
                envelope_orders: values.to_vec(),
            },
            envelope_orders: spectrum(),
            order_markers: vec![marker(true)],
            title: text.into(),
            subtitle: text.into(),
            waveform: Waveform {
                series: Series {
                    label: text.into(),
                    unit: text.into(),
                    t0_s: at(2),
                    dt_s: dt,
                    values: values.to_vec(),
                },
                overview: Some(MinMax {
                    t0_s: at(2),
                    dt_s: dt,
                    min: values.to_vec(),
                    max: values.iter().skip(1).copied().collect(),
                }),
                events: vec![
                    Event { t_s: at(3), enters: true, label: text.into() },
                    Event { t_s: at(4), enters: false, label: text.into() },
                ],
            },
            spectrum: spectrum(),
            envelope_spectrum: spectrum(),
            markers: vec![marker(true), marker(false)],
        },
        lead: text.into(),
        version: text.into(),
        partial: Some(text.into()),
        warnings: vec![text.into()],
        undrawn_damage: (at(2) < 0.0).then(|| text.to_owned()),
        facts: vec![fact(), Fact::new(text, text, text, text)],
        damage: vec![damage_view(text, values)],
        passes: vec![Pass {
            title: text.into(),
            points: values
                .iter()
                .map(|v| PassPoint { t: *v, angle: *v, length: *v, stiffness: *v, force: f64::NAN })
                .collect(),
            stiffness_unit: text.into(),
            contact: text.into(),
        }],
        // As many as slices at most.
        along: Some(DamageCurves {
            along: values.iter().take(200).copied().collect(),
            ..damage_view(text, values).section
        }),
        load_distribution: vec![RowLoad {
            title: text.into(),
            mean_n: values.to_vec(),
            max_n: values.iter().rev().copied().collect(),
            static_points: values.iter().map(|v| (*v, at(0))).collect(),
        }],
        indicators: IndicatorTable {
            columns: vec![text.into(), text.into()],
            rows: vec![IndicatorRow {
                channel: text.into(),
                kind: text.into(),
                cells: vec![Estimate { value: at(0), interval: Some((at(1), at(2))), unit: text.into() }],
            }],
            note: text.into(),
        },
        slip: vec![fact()],
        slip_rows: vec![slip_row(text, values, dt); 2],
        cage_orbits: CageOrbits {
            rows: vec![
                CageOrbit {
                    title: text.into(),
                    x_um: values.iter().take(2000).copied().collect(),
                    y_um: values.iter().take(2000).rev().copied().collect(),
                    last_turn: 3,
                };
                3
            ],
            clearance_um: Some(at(1)),
            note: text.into(),
        },
        sensor: SensorView {
            frequency_hz: (0..values.len()).map(|k| k as f64 * frequency).collect(),
            gain_db: values.to_vec(),
            facts: vec![fact()],
        },
        motion: motion(text, values, dt),
        spectrogram: Spectrogram {
            label: text.into(),
            unit: text.into(),
            of: signal::Spectrogram {
                first_time: at(1),
                time_step: dt,
                frequency_step: frequency,
                bins: 3,
                density: values.iter().take(3000).copied().collect(),
            },
            note: text.into(),
        },
        audits: vec![fact()],
        solver_work: vec![fact()],
        assumptions: vec![Provenance {
            key: text.into(),
            value: text.into(),
            unit: "m/s^2",
            origin: Origin::Recorded(text.into()),
            assumed: true,
            plausible: None,
        }],
        scenario_toml: text.into(),
    }
}

/// Ten seconds at 25.6 kHz with bursts every 4 ms.
pub(crate) fn ordinary() -> Report {
    let values: Vec<f64> = (0..256_000)
        .map(|i| {
            let phase = f64::from(i) / 25_600.0 % 0.004;
            60.0 * (-phase * 900.0).exp() * (phase * 26_000.0).sin()
        })
        .collect();
    let mut report = filled("plain", &values, 1.0 / 25_600.0, 250.102);
    report.signals.healthy = Healthy::default();
    report.signals.spectrum.df_hz = 0.1;
    report.signals.envelope_spectrum.df_hz = 0.1;
    report.signals.waveform.series.t0_s = 0.0;
    report.signals.waveform.series.unit = "m/s^2".into();
    let point = |i: i32| {
        let degrees = 0.02 * f64::from(i) - 5.0;
        let length = if degrees.abs() < 3.1 { 2e-3 } else { 6e-3 };
        PassPoint { t: f64::from(i), angle: degrees.to_radians(), length, stiffness: 1.9e8, force: 40.0 }
    };
    report.damage = vec![square_with_a_hole()];
    report.passes[0] = Pass {
        title: "Row 1, roller 7".into(),
        points: (0..500).map(point).collect(),
        stiffness_unit: "N/m^(10/9)".into(),
        ..Pass::default()
    };
    report.load_distribution[0] = RowLoad {
        title: "Row 1".into(),
        mean_n: vec![10.0; 36],
        max_n: vec![12.0; 36],
        static_points: vec![(0.0, 11.0)],
    };
    report
}
