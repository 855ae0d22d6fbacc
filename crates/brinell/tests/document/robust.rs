//! Whatever the bytes, a report; whatever the scenario, it reads back.

use brinell::document::*;
use brinell::scenario::*;
use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::{INNER, OUTER, report};

/// Reads, shows and, where possible, writes: nothing may panic, and spans must lie in the text.
fn exercise(text: &str, overrides: &[(String, String)]) {
    match read(text, overrides) {
        Ok(loaded) => {
            let again = read(&loaded.to_toml(), &[]).unwrap_or_else(|e| panic!("{}", report(&e)));
            assert_eq!(again.scenario, loaded.scenario);
        }
        Err(problems) => {
            assert!(problems.iter().any(|problem| problem.severity == Severity::Error));
            for problem in problems {
                assert!(!problem.to_string().is_empty());
                if let Some(span) = problem.span {
                    assert!(text.get(span).is_some());
                }
            }
        }
    }
}

fn scraps() -> impl Strategy<Value = String> {
    let scraps = [
        "[",
        "]",
        "[[",
        "]]",
        "{",
        "}",
        "=",
        ".",
        ",",
        "\"",
        "'",
        "\"\"\"",
        "#",
        "\n",
        "\r\n",
        "\0",
        "\u{feff}",
        "é",
        "nan",
        "-inf",
        "1e999",
        "0x",
        "1979-05-27",
        "true",
        "-1",
        "0",
        "99999999999999999999",
        "1e-320",
        "bearing",
        "defects",
        "shape",
        "profile",
        "rectangle",
        "x.y.z",
        "[defects]",
        "[[defects]]",
        "[[bearing]]",
        "[a.b.c]",
        "preset = \"NN3007\"",
        "roller = 1\n",
        "{ circle = {} }",
        "[[[[[[[[",
        "[]",
        "{}",
        "\\u0000",
        "1_0",
        "+.5",
    ];
    prop_oneof![3 => select(scraps.to_vec()).prop_map(String::from), 1 => any::<char>().prop_map(String::from)]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn prop_no_bytes_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        if let Err(problems) = read_bytes(&bytes, &[]) {
            prop_assert!(!report(&problems).is_empty());
        }
    }

    #[test]
    fn prop_no_scraps_panic(parts in prop::collection::vec(scraps(), 0..60)) {
        exercise(&parts.concat(), &[]);
    }

    #[test]
    fn prop_no_mutation_panics(
        which in 0..3usize,
        edits in prop::collection::vec((any::<Index>(), 0..30usize, scraps()), 1..6),
    ) {
        let mut text = [OUTER.to_string(), INNER.to_string(), template()][which].clone();
        for (at, cut, scrap) in edits {
            let floor = |text: &str, mut i: usize| {
                i = i.min(text.len());
                while !text.is_char_boundary(i) { i -= 1; }
                i
            };
            let start = floor(&text, at.index(text.len() + 1));
            let end = floor(&text, start + cut).max(start);
            text.replace_range(start..end, &scrap);
        }
        exercise(&text, &[]);
    }

    #[test]
    fn prop_no_value_panics(
        which in 0..2usize,
        line in any::<Index>(),
        value in prop_oneof![scraps(), any::<f64>().prop_map(|x| format!("{x:e}")), any::<i64>().prop_map(|n| n.to_string())],
    ) {
        let text = [OUTER, INNER][which];
        let lines: Vec<&str> = text.lines().collect();
        let line = line.index(lines.len());
        let changed: Vec<String> = lines.iter().enumerate().map(|(i, old)| match old.split_once(" = ") {
            Some((name, _)) if i == line => format!("{name} = {value}"),
            _ => old.to_string(),
        }).collect();
        exercise(&changed.join("\n"), &[]);
    }

    #[test]
    fn prop_no_override_panics(
        path in prop_oneof!["[a-z_.0-9]{0,20}", select(vec![
            "defects.0.shape.profile.arc_mm", "defects.1.on", "bearing", "operation.load_n.1", "simulation.record.4", "",
        ]).prop_map(String::from)],
        value in prop::collection::vec(scraps(), 0..4),
    ) {
        exercise(OUTER, &[(path, value.concat())]);
    }

    #[test]
    fn prop_a_scenario_reads_back_bit_for_bit(scenario in scenarios()) {
        let text = scenario.to_toml();
        let loaded = read(&text, &[]);
        prop_assert!(loaded.is_ok(), "{}\n{}", report(&loaded.unwrap_err()), text);
        let loaded = loaded.unwrap();
        // Debug shows the sign of a zero, which equality does not see.
        prop_assert_eq!(format!("{:?}", loaded.scenario), format!("{:?}", scenario));
        prop_assert!(loaded.provenance.iter().all(|p| p.origin == Origin::File && !p.assumed));
    }
}

fn shapes() -> impl Strategy<Value = Shape> {
    let profile = prop::collection::vec((0.0..1.0f64, 0.0..5.0f64, 0.0..100.0f64), 2..9);
    prop_oneof![
        (1e-3..15.0f64, 0.0..5.0f64).prop_map(|(length_mm, width_mm)| Shape::Rectangle { length_mm, width_mm }),
        (1e-3..5.0f64).prop_map(|diameter_mm| Shape::Circle { diameter_mm }),
        (0.0..5.0f64).prop_map(|max_width_mm| Shape::Li2023Irregular { max_width_mm }),
        (any::<u64>(), 0.1..5.0f64, 0.1..5.0f64, 0.0..1.0f64)
            .prop_map(|(seed, length_mm, width_mm, roughness)| Shape::Random { seed, length_mm, width_mm, roughness }),
        (0.1..2.0f64, 0.1..2.0f64, any::<bool>()).prop_map(|(a, b, several)| {
            let first = vec![[-a, -b], [a, -b], [0.5 * a, b]];
            let second = vec![[-3.0 * a, 0.0], [-2.0 * a, 0.0], [-2.0 * a, b]];
            let mut polygons_mm = vec![first];
            polygons_mm.extend(several.then_some(second));
            Shape::Outline { polygons_mm }
        }),
        (0.1..2.0f64, 0.1..2.0f64, any::<bool>()).prop_map(|(a, b, wide)| Shape::Grown {
            outline: vec![vec![[-a, -b], [a, -b], [0.5 * a, b]]],
            max_width_mm: wide.then_some(b),
            area_mm2: (!wide).then_some(a * b),
        }),
        (0.01..0.5f64, 0.01..0.5f64, prop::collection::vec(0.0..30.0f64, 6)).prop_map(
            |(ds_mm, dz_mm, mut depth_um)| {
                depth_um[0] = 1.0;
                let grid =
                    DepthGrid { s0_mm: -ds_mm, z0_mm: -0.3 * dz_mm, ds_mm, dz_mm, columns: 3, rows: 2, depth_um };
                Shape::DepthMap { grid }
            }
        ),
        (profile, any::<bool>()).prop_map(|(points, deep)| {
            let arc = points.iter().scan(-4.0, |s, point| {
                *s += point.0;
                Some(*s)
            });
            Shape::Profile {
                arc_mm: arc.collect(),
                width_mm: points.iter().map(|point| point.1).collect(),
                depth_um: deep.then(|| points.iter().map(|point| point.2).collect()),
            }
        }),
    ]
}

fn defects() -> impl Strategy<Value = Vec<Defect>> {
    let surface =
        prop_oneof![Just(Surface::OuterRaceway), Just(Surface::InnerRaceway), (1..=12usize).prop_map(Surface::Roller),];
    let defect = (surface, 1..=2usize, any::<f32>(), 0.0..1e3f64, shapes());
    let defect = defect.prop_map(|(on, row, center, depth_um, shape)| Defect {
        on,
        row,
        center_deg: if center.is_finite() { f64::from(center) } else { -0.0 },
        depth_um,
        axial_offset_mm: 0.25,
        shape,
        table: None,
    });
    prop::collection::vec(defect, 0..4)
}

/// None, a few keys, or all of them.
fn sensor(kind: usize, x: &[f64]) -> Sensor {
    let rate = 1.0 + x[13];
    let mode = |gain: f64| PathMode { frequency_hz: 0.01 * rate, damping_ratio: 0.3 * x[1] / 1e9 + 1e-3, gain };
    match kind {
        0 => Sensor::off(),
        1 => Sensor {
            direction_deg: Some(-x[3]),
            noise_rms_m_per_s2: Some(x[4]),
            noise_seed: x[5].to_bits(),
            path: vec![mode(1.0), mode(-x[6] / 1e9)],
            ..Sensor::off()
        },
        _ => Sensor {
            direction_deg: Some(-0.0),
            sensitivity_mv_per_m_per_s2: Some(x[0]),
            mounting_resonance_hz: Some(3.0 * rate),
            mounting_damping_ratio: 0.9 * x[2] / 1e9 + 1e-3,
            low_cut_hz: Some(1e-3 * rate),
            high_cut_hz: Some(0.7 * rate),
            noise_rms_m_per_s2: None,
            noise_snr_db: Some(x[3] / 1e9),
            noise_reference_rms_m_per_s2: x[4],
            noise_colour: NoiseColour::Pink,
            noise_corner_hz: 1e-2 * rate,
            noise_seed: 7,
            converter_bits: Some(16),
            converter_range_m_per_s2: None,
            converter_range_mv: Some(x[5]),
            path: vec![mode(x[6] / 1e9)],
        },
    }
}

/// Stiffness and damping of linear walls; oiled ones hold the defaults, which do not act.
fn walls(oiled: bool, d: f64, x: &[f64]) -> [f64; 2] {
    let usual = 11.0 / (1e-3 * (d / 100.0).max(0.01));
    if oiled { [usual, 20.0 * (usual / 1e7).sqrt()] } else { [x[9], x[10]] }
}

fn scenarios() -> impl Strategy<Value = Scenario> {
    let speed = prop_oneof![
        (1e-3..3e4f64).prop_map(Speed::Constant),
        prop::collection::vec((1e-9..1.0f64, -3e4..3e4f64), 1..6).prop_map(|points| {
            let times = points.iter().scan(-1.0, |t, point| {
                *t += point.0;
                Some(*t)
            });
            Speed::Profile(times.zip(&points).map(|(t, point)| [t, point.1]).collect())
        }),
    ];
    // A preset of rollers has no balls, and balls do not tilt.
    let balls = |words: (usize, usize, usize, usize, usize)| words.1 == 0 && words.2 != 2 && words.4 == 1;
    // The lumped model is the paper's.
    let mechanics = |words: (usize, usize, usize, usize, usize)| words.2 != 1 && words.3 == 2;
    // What the law `ecl` does not know: tilt, and balls but for the lumped model.
    let half_space = move |words: (usize, usize, usize, usize, usize)| {
        words.2 == 2 || (words.2 == 0 && (balls(words) || (mechanics(words) && words.0 != 1)))
    };
    // Whose levers leave out what pushes along the surface.
    let centred =
        move |words: (usize, usize, usize, usize, usize)| words.4 == 1 && !half_space(words) && !mechanics(words);
    let words = (0..3usize, 0..2usize, 0..3usize, 0..3usize, 0..2usize);
    let numbers = prop::collection::vec(1e-9..1e9f64, 16);
    let text = (any::<String>(), prop::collection::vec("[a-z0-9_*]{1,9}", 0..4));
    (text, 5.5..40.0f64, 12..=15usize, 2..=4usize, numbers, speed, words, defects()).prop_map(
        move |((name, record), d, z, rows, x, speed_rpm, words, defects)| Scenario {
            name,
            machine: None,
            bearing: Bearing {
                preset: (words.1 == 1).then(|| "NN3007".into()),
                element: if balls(words) { Element::Ball } else { Element::Roller },
                inner_groove_conformity: balls(words).then_some(0.5 + x[6] / 4e9 + 1e-9),
                outer_groove_conformity: balls(words).then_some(0.5 + x[7] / 4e9 + 1e-9),
                inner_raceway_diameter_mm: 6.0 * d,
                outer_raceway_diameter_mm: 8.0 * d,
                pitch_diameter_mm: 7.0 * d,
                roller_diameter_mm: d,
                static_load_rating_n: (words.0 == 1).then_some(1e3 * (1.0 + x[8])),
                roller_length_mm: if balls(words) { d } else { d * 1.1 },
                rollers_per_row: z,
                rows,
                row_stagger_deg: -x[0],
                bore_diameter_mm: None,
                radial_clearance_um: d * x[1] / 1e9,
                outer_gap_um: d * x[2] / 1e9,
                // No damper here moves a body of 1 kg faster than a run can follow.
                inner_ring_mass_kg: 1.0 + x[3],
                outer_ring_mass_kg: 1.0 + x[4],
                roller_mass_kg: 1.0 + x[5],
                profile: match (words.2, words.3) {
                    (2, 0) => RollerProfile::Logarithmic,
                    (2, 1) => RollerProfile::Crowned { crowned_radius_mm: 1e3 + x[0] },
                    (2, _) => {
                        RollerProfile::Table { z_mm: vec![-x[0] - 1.0, x[1] + 1.0], drop_um: vec![0.0, 1e-12 * x[2]] }
                    }
                    _ => RollerProfile::Straight,
                },
                waviness: mechanics(words).then(|| Waviness {
                    amplitude_um: 1e-7 * x[8],
                    exponent: 1.5,
                    waves: [2, 30],
                }),
                element_waviness: None,
                width_mm: 1.6 * (if balls(words) { d } else { d * 1.1 }) * rows as f64,
                row_spacing_mm: match (rows, balls(words)) {
                    (1, _) => 0.0,
                    (_, true) => 1.5 * d,
                    (_, false) => 1.5 * (d * 1.1),
                },
            },
            cage: Cage {
                mass_kg: 1.0 + x[6],
                inner_diameter_mm: 6.5 * d,
                outer_diameter_mm: 7.7 * d,
                pocket_clearance_mm: d / 100.0,
                guidance: [Guidance::OuterRing, Guidance::InnerRing, Guidance::Rollers][words.0],
                guidance_film: [GuidanceFilm::Dynamic, GuidanceFilm::QuasiStatic][words.0 % 2],
                guide_clearance_mm: x[7],
                guide_width_mm: x[8],
                walls: if mechanics(words) { Walls::Oiled } else { Walls::Linear },
                pockets: if centred(words) { Pockets::Slot } else { [Pockets::Slot, Pockets::Round][words.4] },
                friction_coefficient: if mechanics(words) { x[11] } else { 0.05 },
                contact_stiffness_n_per_m: walls(mechanics(words), d, &x)[0],
                contact_damping_ns_per_m: walls(mechanics(words), d, &x)[1],
                land_stiffness_n_per_m: walls(mechanics(words), d, &x)[0],
                land_damping_ns_per_m: walls(mechanics(words), d, &x)[1],
            },
            contact: Contact {
                law: if half_space(words) { Law::HalfSpace } else { Law::Ecl },
                roller_path: RollerPath::Point,
                slices: z,
                exponent: if balls(words) { 1.5 } else { 1.0 + x[0] / 1e9 },
                youngs_modulus_gpa: (balls(words) || half_space(words)).then_some(x[8]),
                poisson_ratio: (balls(words) || half_space(words)).then_some(x[9] / 2e9),
                inner_stiffness: x[11],
                outer_stiffness: x[12],
                damping: match mechanics(words) {
                    true => ContactDamping::Time { us: 1.0 + x[13] / 1e6 },
                    false => ContactDamping::Constant { ns_per_m: x[13] },
                },
                roughness_um: if mechanics(words) { 1e-9 * x[14] } else { 0.1 },
                edge_radius_um: if half_space(words) { 1e-7 * x[15] } else { 10.0 },
                tables: if half_space(words) { [Tables::Standard, Tables::Coarse][words.4] } else { Tables::Standard },
            },
            friction: Friction {
                raceway_coefficient: x[14] / 1e9,
                slip_velocity_m_per_s: x[15],
                rolling_coefficient: if centred(words) { 0.0 } else { x[13] },
            },
            lubricant: Lubricant {
                viscosity_pa_s: x[1],
                raceway_film: [RacewayFilm::None, RacewayFilm::Squeeze]
                    [usize::from(x[2] > x[3] && !balls(words) && !mechanics(words))],
                drag_coefficient: x[2],
                effective_density_kg_per_m3: x[3],
            },
            support: Support {
                inner_stiffness_n_per_m: x[4],
                inner_damping_ns_per_m: x[5],
                outer_stiffness_n_per_m: x[6],
                outer_damping_ns_per_m: x[7],
                inner_tilt_stiffness_nm_per_rad: x[4] * (0.5e-3 * (7.0 * d)).powi(2),
                inner_tilt_damping_nms_per_rad: x[5] * (0.5e-3 * (7.0 * d)).powi(2),
                outer_tilt_stiffness_nm_per_rad: x[6] * (0.5e-3 * (7.0 * d)).powi(2),
                outer_tilt_damping_nms_per_rad: x[7] * (0.5e-3 * (7.0 * d)).powi(2),
            },
            operation: Operation {
                speed_rpm,
                // Within ten times the least static load rating, as the weight.
                load_n: [-7e-5 * x[8], 7e-5 * x[9]],
                load_on: [LoadOn::OuterRing, LoadOn::InnerRing][words.1],
                load_ramp_s: x[10],
                gravity_m_per_s2: [-0.0, -1e-13 * x[11]],
                load_offset_mm: 0.0,
            },
            defects,
            housing: Housing { mass_kg: x[13] },
            sensor: sensor(words.0, &x),
            simulation: Simulation {
                laws: if mechanics(words) { Laws::Mechanics } else { Laws::Li2023 },
                geometry: if centred(words) { GeometryLaw::Centred } else { GeometryLaw::Exact },
                seed: x[6].to_bits(),
                model: [ModelKind::Full, ModelKind::Lumped, ModelKind::Tilting][words.2],
                duration_s: 1.0 + x[12] / 1e9,
                sample_rate_hz: 1.0 + x[13],
                start: [Start::Rolling, Start::Rest, Start::Equilibrium][words.3],
                accuracy: [Accuracy::Standard, Accuracy::Reference][words.4],
                most_steps: 1.0 + x[7],
                record,
            },
        },
    )
}
