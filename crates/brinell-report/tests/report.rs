//! The page and its pictures: what must be in them, and that nothing odd breaks them.

use brinell_report::{
    Assumption, CageOrbit, CageOrbits, DamageCurve, DamagePanel, DamageView, DamagedSurface,
    DepthPatch, Estimate, Event, EventKind, Fact, IndicatorRow, IndicatorTable, Layout, Marker,
    MinMax, Motion, MotionDamage, MotionRow, Pass, Report, RowLoad, Series, SlipRow, Spectrogram,
    Spectrum, Waveform, bearing_motion, bin_centres, cage_orbit, damage_passage, damage_plan,
    damage_section, detail_window, headline_png, html, load_distribution, pictures, spectrogram,
};
use proptest::prelude::*;

const HOSTILE: &str = "</script><img src=\"x\" onerror='y'>&\u{0}\u{2028}";

/// Damage in which every list is filled; one with depths and one of a polygon come from the sign of the first value.
fn damage_view(text: &str, values: &[f64]) -> DamageView {
    let at = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
    let panel = DamagePanel {
        label: text.into(),
        unit: text.into(),
        from_zero: at(1) > 0.0,
        curves: vec![
            DamageCurve {
                name: text.into(),
                values: values.to_vec(),
            };
            2
        ],
    };
    DamageView {
        title: text.into(),
        surface: text.into(),
        plan_title: text.into(),
        passage_title: text.into(),
        section_title: text.into(),
        half_turn_mm: (at(2) > 0.0).then(|| at(3)),
        facts: vec![Fact::new(text, at(0), text, text)],
        polygons_mm: vec![values.windows(2).map(|w| [w[0], w[1]]).collect()],
        depths: (at(0) > 0.0).then(|| DepthPatch {
            start_mm: [at(1), at(2)],
            step_mm: [at(3), 0.5],
            columns: 3,
            depth_um: values.to_vec(),
        }),
        roller_length_mm: at(4),
        roller_diameter_mm: at(5),
        load_zone_mm: Some([at(6), at(7)]),
        angle_deg: values.to_vec(),
        passage: vec![panel.clone(); 2],
        passage_note: text.into(),
        section_s_mm: values.to_vec(),
        section: vec![panel],
        section_note: text.into(),
    }
}

/// A square of side 4 with a square hole of side 2, both wound the same way.
fn square_with_a_hole() -> DamageView {
    let square = |h: f64| vec![[-h, -h], [h, -h], [h, h], [-h, h]];
    DamageView {
        polygons_mm: vec![square(2.0), square(1.0)],
        roller_length_mm: 6.0,
        roller_diameter_mm: 6.0,
        load_zone_mm: Some([-30.0, 30.0]),
        ..DamageView::default()
    }
}

#[test]
fn analytic_the_plan_is_to_one_scale_and_a_hole_winds_against_its_outline() {
    for layout in [Layout::Wide, Layout::Narrow] {
        let svg = damage_plan(&square_with_a_hole(), 0, layout).svg();
        let path = svg
            .split("<path d=\"")
            .find(|p| p.contains("fill=\"#f2aa6b\""))
            .expect("the damage is drawn");
        let rings: Vec<Vec<[f64; 2]>> = path
            .split('"')
            .next()
            .unwrap()
            .split('Z')
            .filter(|r| !r.is_empty())
            .map(|r| {
                let points = r.trim_start_matches('M').split('L');
                points
                    .map(|p| {
                        let (x, y) = p.split_once(' ').unwrap();
                        [x.parse().unwrap(), y.parse().unwrap()]
                    })
                    .collect()
            })
            .collect();
        assert_eq!(rings.len(), 2);
        let area = |r: &[[f64; 2]]| -> f64 {
            let next = r.iter().skip(1).chain(r.first());
            0.5 * r
                .iter()
                .zip(next)
                .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
                .sum::<f64>()
        };
        let (outer, hole) = (area(&rings[0]), area(&rings[1]));
        assert!(outer * hole < 0.0, "{outer} {hole}");
        assert!((outer / hole + 4.0).abs() < 0.02, "{outer} {hole}");
        let side = |k: usize| {
            (0..4).map(|i| rings[0][i][k]).fold(0.0, f64::max)
                - (0..4).map(|i| rings[0][i][k]).fold(f64::INFINITY, f64::min)
        };
        assert!(
            (side(0) / side(1) - 1.0).abs() < 0.005,
            "{} {}",
            side(0),
            side(1)
        );
    }
}

#[test]
fn regress_a_view_of_nothing_is_drawn_all_the_same() {
    let empty = DamageView::default();
    for draw in [damage_plan, damage_passage, damage_section] {
        let picture = draw(&empty, 0, Layout::Narrow);
        assert!(picture.png(1.0).is_ok());
    }
}

#[test]
fn analytic_a_rollers_view_goes_once_around_with_both_contacts_half_a_turn_apart() {
    let around = 6.0 * std::f64::consts::PI;
    let view = DamageView {
        half_turn_mm: Some(0.5 * around),
        load_zone_mm: None,
        ..square_with_a_hole()
    };
    let svg = damage_plan(&view, 0, Layout::Wide).svg();
    assert!(svg.contains("Around the roller") && svg.contains("the other raceway"));
    let tree = roxmltree::Document::parse(&svg).expect("valid");
    // Upright strokes: the contacts in blue, 2.4 and 2 wide, and the ends of the roller's surface.
    let uprights = |width: &str| -> Vec<f64> {
        tree.descendants()
            .filter(|n| n.attribute("stroke-width") == Some(width))
            .filter_map(|n| n.attribute("d"))
            .flat_map(|d| {
                d.split('M')
                    .filter_map(|part| {
                        let numbers: Vec<f64> = part
                            .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
                            .filter_map(|x| x.parse().ok())
                            .collect();
                        (numbers.len() == 4 && numbers[0] == numbers[2]).then(|| numbers[0])
                    })
                    .collect::<Vec<f64>>()
            })
            .collect()
    };
    let (one, other) = (uprights("2.4"), uprights("2"));
    assert!(one.len() == 1 && other.len() == 1, "{one:?} {other:?}");
    let ends = uprights("1");
    let [.., from, to] = ends[..] else {
        panic!("the ends of the surface are drawn: {ends:?}")
    };
    let mm = (other[0] - one[0]).abs() / (to - from).abs() * around;
    assert!(
        (mm - 0.5 * around).abs() < 0.05,
        "{one:?} {other:?} {ends:?}"
    );
}

#[test]
fn regress_damage_that_cannot_be_drawn_is_not_called_healthy() {
    let mut report = filled("plain", &[1.0, -2.0, 3.0], 1e-4, 250.0);
    report.damage.clear();
    report.undrawn_damage = Some("contact.slices: 0".into());
    let page = html(&report);
    assert!(page.contains("could not be drawn") && page.contains("contact.slices: 0"));
    assert!(!page.contains("healthy"));
    report.undrawn_damage = None;
    assert!(html(&report).contains("The bearing is healthy."));
}

#[test]
fn regress_the_page_shows_what_a_roller_meets_and_the_rings_section() {
    let mut report = ordinary();
    let curve = |name: &str| DamageCurve {
        name: name.into(),
        values: vec![1.0, 2.0, 1.0],
    };
    let panel = |label: &str| DamagePanel {
        label: label.into(),
        unit: "mm".into(),
        from_zero: true,
        curves: vec![curve("in contact, L_e"), curve("damaged, L_s")],
    };
    report.damage = vec![DamageView {
        passage_title: "What a passing roller meets".into(),
        section_title: "Section under it".into(),
        angle_deg: vec![-1.0, 0.0, 1.0],
        passage: vec![panel("Length")],
        passage_note: "stiffness at 1 um".into(),
        section_s_mm: vec![-1.0, 0.0, 1.0],
        section: vec![panel("Thickness")],
        ..square_with_a_hole()
    }];
    let page = html(&report);
    for words in [
        "What a passing roller meets",
        "Section under it",
        "Stiffness at 1 um.",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // Symbols have lowered indices, not underscores.
    assert!(!page.contains(">damaged, L_s<") && page.contains(">damaged, L<tspan"));
    let names: Vec<String> = pictures(&report).into_iter().map(|p| p.name).collect();
    for name in ["damage-1", "damage-1-passage", "damage-1-section"] {
        assert!(names.iter().any(|n| n == name), "{names:?}");
    }
}

fn slip_row(text: &str, values: &[f64], dt: f64) -> SlipRow {
    let some: Vec<f64> = values.iter().take(1000).copied().collect();
    SlipRow {
        name: text.into(),
        t0_s: 0.5 * dt,
        dt_s: dt,
        cage: some.clone(),
        orbit: some.clone(),
        spin: some.clone(),
        angle_deg: some.clone(),
        orbit_there: some.clone(),
        spin_there: some,
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
    Motion {
        t0_s: 0.0,
        dt_s: dt,
        inner_radius_mm: 21.5,
        outer_radius_mm: 27.5,
        pitch_radius_mm: 24.5,
        roller_radius_mm: 3.0,
        ring: some,
        rows: vec![row; 2],
        damage: [
            DamagedSurface::Outer,
            DamagedSurface::Inner,
            DamagedSurface::Roller(1),
        ]
        .map(|surface| MotionDamage {
            row: 0,
            surface,
            angle: [
                values.first().copied().unwrap_or(f64::NAN),
                values.last().copied().unwrap_or(0.1),
            ],
        })
        .to_vec(),
    }
}

/// A report in which every list is filled, strings from `text` and numbers from `values`.
fn filled(text: &str, values: &[f64], dt: f64, frequency: f64) -> Report {
    let at = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
    let fact = || Fact::new(text, at(0), text, text).judged(at(1) > 0.0);
    let spectrum = || Spectrum {
        label: text.into(),
        df_hz: dt,
        amplitude: values.to_vec(),
        unit: text.into(),
        note: text.into(),
    };
    Report {
        title: text.into(),
        subtitle: text.into(),
        version: text.into(),
        partial: Some(text.into()),
        undrawn_damage: (at(2) < 0.0).then(|| text.to_owned()),
        facts: vec![fact(), Fact::new(text, text, text, text)],
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
                Event {
                    t_s: at(3),
                    kind: EventKind::Enter,
                    label: text.into(),
                },
                Event {
                    t_s: at(4),
                    kind: EventKind::Leave,
                    label: text.into(),
                },
            ],
        },
        spectrum: spectrum(),
        envelope_spectrum: spectrum(),
        markers: [true, false]
            .map(|present| Marker {
                label: text.into(),
                meaning: text.into(),
                frequency_hz: frequency,
                harmonics: 5,
                present,
            })
            .to_vec(),
        damage: vec![damage_view(text, values)],
        passes: vec![Pass {
            title: text.into(),
            angle_deg: values.to_vec(),
            length_mm: values.to_vec(),
            other_length_mm: Some(values.iter().rev().copied().collect()),
            stiffness: values.iter().skip(1).copied().collect(),
            stiffness_unit: text.into(),
            force_n: vec![],
            contact: text.into(),
            other_contact: text.into(),
        }],
        load_distribution: vec![RowLoad {
            title: text.into(),
            angle_deg: values.to_vec(),
            mean_n: values.to_vec(),
            max_n: values.iter().rev().copied().collect(),
            static_points: values.iter().map(|v| (*v, at(0))).collect(),
        }],
        indicators: IndicatorTable {
            columns: vec![text.into(), text.into()],
            rows: vec![IndicatorRow {
                channel: text.into(),
                kind: text.into(),
                cells: vec![Estimate {
                    value: at(0),
                    half_width: Some(at(1)),
                    unit: text.into(),
                }],
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
        motion: motion(text, values, dt),
        spectrogram: Spectrogram {
            label: text.into(),
            unit: text.into(),
            t0_s: at(1),
            dt_s: dt,
            df_hz: frequency,
            bins: 3,
            density: values.iter().take(3000).copied().collect(),
            note: text.into(),
        },
        audits: vec![fact()],
        solver_work: vec![fact()],
        assumptions: vec![Assumption {
            key: text.into(),
            value: at(0).into(),
            unit: text.into(),
            source: text.into(),
            estimated: true,
        }],
        scenario_toml: text.into(),
    }
}

/// Ten seconds at 25.6 kHz with bursts every 4 ms.
fn ordinary() -> Report {
    let values: Vec<f64> = (0..256_000)
        .map(|i| {
            let phase = f64::from(i) / 25_600.0 % 0.004;
            60.0 * (-phase * 900.0).exp() * (phase * 26_000.0).sin()
        })
        .collect();
    let mut report = filled("plain", &values, 1.0 / 25_600.0, 250.102);
    report.spectrum.df_hz = 0.1;
    report.envelope_spectrum.df_hz = 0.1;
    report.waveform.series.t0_s = 0.0;
    report.waveform.series.unit = "m/s^2".into();
    let angle_deg: Vec<f64> = (0..500).map(|i| 0.02 * f64::from(i) - 5.0).collect();
    report.damage = vec![square_with_a_hole()];
    report.passes[0] = Pass {
        title: "Row 1, roller 7".into(),
        length_mm: angle_deg
            .iter()
            .map(|a| if a.abs() < 3.1 { 2.0 } else { 6.0 })
            .collect(),
        other_length_mm: None,
        stiffness: vec![1.9e8; 500],
        stiffness_unit: "N/m^(10/9)".into(),
        force_n: vec![40.0; 500],
        angle_deg,
        ..Pass::default()
    };
    report.load_distribution[0] = RowLoad {
        title: "Row 1".into(),
        angle_deg: bin_centres(36),
        mean_n: vec![10.0; 36],
        max_n: vec![12.0; 36],
        static_points: vec![(0.0, 11.0)],
    };
    report
}

/// What a page must hold whatever its data, and what it must not.
fn check(page: &str) {
    let mut from = 0;
    for heading in [
        "<h1>",
        ">Waveform</h2>",
        ">Spectrum</h2>",
        ">Envelope spectrum</h2>",
        ">Spectrogram</h2>",
        ">Passing the defect</h2>",
        ">Load distribution</h2>",
        ">The bearing in motion</h2>",
        ">Cage orbit</h2>",
        ">Indicators</h2>",
        ">Slip</h2>",
        ">Audits</h2>",
        ">Solver work</h2>",
        ">Assumptions</h2>",
        ">Scenario</h2>",
    ] {
        let at = page[from..].find(heading);
        from += at.unwrap_or_else(|| panic!("{heading} is missing or out of order"));
    }
    for (open, close) in [
        ("<svg", "</svg>"),
        ("<table", "</table>"),
        ("<figure>", "</figure>"),
        ("<script", "</script>"),
    ] {
        assert_eq!(
            page.matches(open).count(),
            page.matches(close).count(),
            "{open}"
        );
    }
    for part in page.match_indices("url(").map(|(at, _)| &page[at..at + 9]) {
        assert!(
            part.starts_with("url(data:") || part.starts_with("url(#"),
            "{part}"
        );
    }
    // Samples and images travel in base64, which may spell anything.
    let page = page.replace(";base64,", "\"values\":\"");
    let plain: String = page
        .split("\"values\":\"")
        .enumerate()
        .map(|(k, part)| {
            if k == 0 {
                part
            } else {
                part.split_once('"').map_or("", |p| p.1)
            }
        })
        .collect();
    for never in [
        "http:", "https:", "@import", "<link", "<iframe", " src=\"", "NaN", ":inf", ",inf",
    ] {
        assert!(!plain.contains(never), "{never} in the page");
    }
}

fn check_pictures(report: &Report) {
    for picture in pictures(report) {
        let svg = picture.svg();
        let tree = roxmltree::Document::parse(&svg);
        assert!(tree.is_ok(), "{}: {tree:?}", picture.name);
        assert!(
            !svg.contains("NaN") && !svg.contains("inf\""),
            "{}",
            picture.name
        );
    }
}

#[test]
fn regress_an_ordinary_page_is_whole_and_small() {
    let report = ordinary();
    let page = html(&report);
    check(&page);
    check_pictures(&report);
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    for text in ["m/s²", "Time (", "Frequency (Hz)", "Force (N)", "250.102"] {
        assert!(page.contains(text), "{text}");
    }
    // Two drawings of every figure, and data for the three that zoom.
    assert_eq!(
        page.matches("class=\"wide\"").count(),
        page.matches("class=\"narrow\"").count()
    );
    assert_eq!(page.matches("data-chart=").count(), 3);
}

#[test]
fn regress_units_with_exponents_are_raised() {
    let mut report = ordinary();
    report.audits = vec![Fact::new("Stiffness", 1.898e8, "N/m^(10/9)", "")];
    let page = html(&report);
    assert!(page.contains("1.898×10⁸") && page.contains("N/m<sup>10/9</sup>"));
}

#[test]
fn regress_an_empty_report_says_so() {
    let page = html(&Report::default());
    check(&page);
    check_pictures(&Report::default());
    for words in [
        "No waveform was recorded",
        "No spectrum was made",
        "No roller passed a defect",
        "No audit was made",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("<svg"));
    let svg = load_distribution(&[], Layout::Narrow).svg();
    assert!(roxmltree::Document::parse(&svg).is_ok());
}

#[test]
fn regress_every_string_is_escaped() {
    let report = filled(HOSTILE, &[1.0, 2.0, 3.0, 0.5, 0.7], 0.1, 2.0);
    let page = html(&report);
    check(&page);
    check_pictures(&report);
    assert!(!page.contains("<img") && !page.contains('\u{0}'));
}

#[test]
fn regress_the_close_up_spans_five_periods_of_the_damage() {
    let mut report = ordinary();
    let (lo, hi) = detail_window(&report);
    assert!((hi - lo - 5.0 / 250.102).abs() < 1e-9 && (hi - 255_999.0 / 25_600.0).abs() < 1e-9);
    report.markers.clear();
    let (lo, hi) = detail_window(&report);
    assert!((hi - lo - 0.02).abs() < 1e-9);
}

#[test]
fn regress_odd_data_is_drawn() {
    for values in [
        vec![],
        vec![0.0],
        vec![7.0],
        vec![f64::NAN; 5],
        vec![0.0; 1000],
        vec![1.0, f64::NAN, 2.0, f64::INFINITY, -3.0],
        vec![f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324],
        vec![-1.0, -2.0, -3.0],
    ] {
        for (dt, frequency) in [
            (0.1, 2.0),
            (0.0, 0.0),
            (f64::NAN, f64::INFINITY),
            (1e300, 1e-300),
        ] {
            let report = filled("x", &values, dt, frequency);
            check(&html(&report));
            check_pictures(&report);
            assert!(headline_png(&report).is_ok_and(|png| png.starts_with(b"\x89PNG")));
        }
    }
}

#[test]
fn regress_the_headline_is_1400_by_700() {
    let png = headline_png(&ordinary()).unwrap();
    let size = |at: usize| u32::from_be_bytes([png[at], png[at + 1], png[at + 2], png[at + 3]]);
    assert_eq!((size(16), size(20)), (1400, 700));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn prop_no_data_breaks_the_page(
        text in "\\PC{0,12}",
        values in prop::collection::vec(any::<f64>(), 0..200),
        dt in any::<f64>(),
        frequency in any::<f64>(),
    ) {
        let report = filled(&text, &values, dt, frequency);
        let page = html(&report);
        prop_assert_eq!(page.matches("<svg").count(), page.matches("</svg>").count());
        check_pictures(&report);
    }

    #[test]
    fn prop_ordinary_values_break_nothing(
        values in prop::collection::vec(prop_oneof![Just(f64::NAN), -1e3..1e3, Just(0.0)], 0..300),
        dt in 1e-6..1.0,
        frequency in 1e-3..1e5,
    ) {
        let report = filled("x", &values, dt, frequency);
        check(&html(&report));
        check_pictures(&report);
        prop_assert!(headline_png(&report).is_ok());
    }
}

/// A quarter turn on, a roller that orbits at (r, 0) stands at (0, r), its force's line above it; the scale is the same both ways.
#[test]
fn analytic_a_force_line_stands_on_its_contact_and_is_as_long_as_the_force() {
    let quarter = std::f32::consts::FRAC_PI_2;
    let motion = Motion {
        dt_s: 1e-3,
        inner_radius_mm: 20.0,
        outer_radius_mm: 30.0,
        pitch_radius_mm: 25.0,
        roller_radius_mm: 5.0,
        ring: vec![0.0, quarter],
        rows: vec![MotionRow {
            title: "Row 1".into(),
            pockets: vec![0.0],
            cage: vec![0.0, quarter],
            orbit: vec![0.0, quarter],
            spin: vec![0.0, -quarter],
            inner_n: vec![0.0, 50.0],
            outer_n: vec![100.0, 50.0],
        }],
        ..Motion::default()
    };
    let numbers = |svg: &str, group: &str| -> Vec<f64> {
        let after = svg.split(&format!("class=\"{group}\">")).nth(1).unwrap();
        let d = after.split("d=\"").nth(1).unwrap();
        d.split('"')
            .next()
            .unwrap()
            .split(['M', 'L', ' '])
            .filter_map(|n| n.parse().ok())
            .collect()
    };
    let first = bearing_motion(&motion, 0, Layout::Wide).svg();
    let second = bearing_motion(&motion, 1, Layout::Wide).svg();
    let (a, b) = (numbers(&first, "m-outer"), numbers(&second, "m-outer"));
    assert!(numbers(&first, "m-inner").is_empty());
    // The largest force is 46 px long, half of it 23 px.
    assert!((a[2] - a[0] - 46.0).abs() < 0.11 && a[1] == a[3], "{a:?}");
    assert!((b[1] - b[3] - 23.0).abs() < 0.11 && b[0] == b[2], "{b:?}");
    let inwards = numbers(&second, "m-inner");
    assert!((inwards[3] - inwards[1] - 23.0).abs() < 0.11, "{inwards:?}");
    // From contact to contact it is the rollers' diameter: (30 - 20) mm to 30 mm of (0.5 460 - 52) px.
    let per_mm = (0.5 * 460.0 - 52.0) / 30.0;
    assert!((inwards[1] - b[1] - 10.0 * per_mm).abs() < 0.11);
}

/// An orbit of circles is drawn round: as wide as it is high.
#[test]
fn analytic_a_cage_orbit_has_one_scale() {
    let turn = |k: i32| (f64::from(k) * 6.0).to_radians();
    let row = CageOrbit {
        title: "Cage of row 1".into(),
        x_um: (0..=60).map(|k| 30.0 * turn(k).cos()).collect(),
        y_um: (0..=60).map(|k| 30.0 * turn(k).sin()).collect(),
        last_turn: 61,
    };
    let orbits = CageOrbits {
        rows: vec![row.clone(), row],
        clearance_um: Some(40.0),
        note: String::new(),
    };
    for layout in [Layout::Wide, Layout::Narrow] {
        let svg = cage_orbit(&orbits, layout).svg();
        let way = svg
            .split("<path d=\"")
            .filter(|p| p.contains("#0072B2") && p.matches('L').count() > 30)
            .map(|p| p.split('"').next().unwrap())
            .next()
            .expect("the orbit is drawn");
        let points: Vec<f64> = way
            .split(['M', 'L', ' '])
            .filter_map(|n| n.parse().ok())
            .collect();
        let extent = |first: usize| {
            let seen = || points.iter().skip(first).step_by(2).copied();
            seen().fold(f64::MIN, f64::max) - seen().fold(f64::MAX, f64::min)
        };
        assert!((extent(0) - extent(1)).abs() < 0.3 && extent(0) > 100.0);
    }
}

/// The one loud cell of a spectrogram is the dark one, at its time and frequency.
#[test]
fn analytic_the_spectrogram_puts_a_tone_where_it_is() {
    let (frames, bins) = (40, 20);
    let mut density = vec![1e-6; frames * bins];
    density[10 * bins + 15] = 1.0;
    let view = Spectrogram {
        label: "a".into(),
        unit: "(m/s^2)^2/Hz".into(),
        t0_s: 0.05,
        dt_s: 0.1,
        df_hz: 100.0,
        bins,
        density,
        note: String::new(),
    };
    let picture = spectrogram(&view, Layout::Wide);
    let svg = picture.svg();
    assert!(svg.contains("Frequency (Hz)") && svg.contains("Time (s)") && svg.contains(">dB<"));
    let png = picture.png(1.0).unwrap();
    let map = tiny_skia::Pixmap::decode_png(&png).unwrap();
    let image = svg.split("<image x=\"").nth(1).unwrap();
    let place = |name: &str| -> f64 {
        let text = format!("x=\"{image}");
        let after = text.split(&format!("{name}=\"")).nth(1).unwrap();
        after.split('"').next().unwrap().parse().unwrap()
    };
    let (x, y, width, height) = (place("x"), place(" y"), place("width"), place("height"));
    let lightness = |column: f64, row: f64| {
        let at = |share: f64, from: f64, span: f64| (from + share * span) as u32;
        let color = map
            .pixel(at(column / 40.0, x, width), at(1.0 - row / 20.0, y, height))
            .unwrap();
        u32::from(color.red()) + u32::from(color.green()) + u32::from(color.blue())
    };
    assert!(lightness(10.5, 15.5) < 150, "{}", lightness(10.5, 15.5));
    for (column, row) in [(9.2, 15.5), (11.8, 15.5), (10.5, 14.2), (10.5, 16.8)] {
        assert!(lightness(column, row) > 650);
    }
}
