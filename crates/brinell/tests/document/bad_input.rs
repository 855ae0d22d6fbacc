//! Each kind of bad input, and the message that its author gets.

use brinell::document::{Problem, Severity, read, read_bytes};

use super::{BARE, OUTER, report, with};

/// The problem of `key` among those of a text.
fn problem_of(problems: &[Problem], key: &str) -> Problem {
    problems
        .iter()
        .find(|problem| problem.key == key)
        .unwrap_or_else(|| panic!("no problem of {key} in\n{}", report(problems)))
        .clone()
}

fn line_of(text: &str, needle: &str) -> usize {
    1 + text.lines().position(|line| line.starts_with(needle)).expect("needle")
}

#[test]
fn regress_each_bad_line_is_named_with_its_line_and_remedy() {
    // Line of the reference file, what replaces it, key at fault, words of the message, words of the remedy.
    #[rustfmt::skip]
    let cases = [
        ("pitch_diameter_mm", "pitch_diameter = 49.0", "bearing.pitch_diameter", "did you mean `pitch_diameter_mm`", ""),
        ("pitch_diameter_mm", "outer_diameter_mm = 22", "bearing.outer_diameter_mm", "outside diameter is not asked for: elements run on the raceway, `outer_raceway_diameter_mm`", ""),
        ("pitch_diameter_mm", "contact_angle_deg = 15", "bearing.contact_angle_deg", "a contact angle is left out", ""),
        ("speed_rpm", "axial_load_n = 100", "operation.axial_load_n", "axial load is left out: the load is radial", ""),
        ("speed_rpm", "outer_speed_rpm = 3", "operation.outer_speed_rpm", "a turning outer ring is left out", ""),
        ("pitch_diameter_mm", "outside_diameter_mm = 22", "bearing.outside_diameter_mm", "`outer_raceway_diameter_mm`", ""),
        ("pitch_diameter_mm", "bore_mm = 8", "bearing.bore_mm", "`inner_raceway_diameter_mm`", ""),
        ("pitch_diameter_mm", "speed_rpm = 1", "bearing.speed_rpm", "it belongs in [operation]", ""),
        ("pitch_diameter_mm", "depth_um = 1", "bearing.depth_um", "it belongs in [[defects]] or [defects.shape.profile] or [defects.shape.depth_map] (its path is defects.0.depth_um)", ""),
        ("pitch_diameter_mm", "viscosity = 1", "bearing.viscosity", "did you mean `viscosity_pa_s` in [lubricant]", ""),
        ("pitch_diameter_mm", "pitch_diameter_mm = \"49\"", "bearing.pitch_diameter_mm", "no unit: a string needs one; without quotes the number is in mm", "a string with a unit: mm"),
        ("pitch_diameter_mm", "pitch_diameter_mm = 1979-05-27", "bearing.pitch_diameter_mm", "found a date", "> 0 mm"),
        ("pitch_diameter_mm", "pitch_diameter_mm = -49", "bearing.pitch_diameter_mm", "out of range", "> 0 mm"),
        ("pitch_diameter_mm", "pitch_diameter_mm = nan", "bearing.pitch_diameter_mm", "not a finite number", "> 0 mm"),
        ("pitch_diameter_mm", "pitch_diameter_mm = 1e999", "bearing.pitch_diameter_mm", "not a finite number", "> 0 mm"),
        ("pitch_diameter_mm", "pitch_diameter_mm = 50.0", "bearing.pitch_diameter_mm", "gap is in the wrong place", "48.88 to 49.12 mm"),
        ("roller_diameter_mm", "roller_diameter_mm = 7.0", "bearing.roller_diameter_mm", "leave a gap of 6 mm", "5.86 to 6.14 mm"),
        ("outer_raceway_diameter_mm", "outer_raceway_diameter_mm = 40.0", "bearing.outer_raceway_diameter_mm", "larger than the inner", "> 43 mm"),
        ("rollers_per_row", "rollers_per_row = 26.0", "bearing.rollers_per_row", "expected a whole number", "3 to 1000"),
        ("rollers_per_row", "rollers_per_row = 2", "bearing.rollers_per_row", "out of range", "3 to 1000"),
        ("rollers_per_row", "rollers_per_row = 99999999999999999999999", "bearing.rollers_per_row", "out of range", "3 to 1000"),
        ("rollers_per_row", "rollers_per_row = 27", "bearing.rollers_per_row", "rollers overlap in the row", "3 to 25"),
        ("rows", "preset = \"ZA-2115\"", "bearing.preset", "of this bearing the defect frequencies are known", "brinell bearing list"),
        ("radial_clearance_um", "radial_clearance_um = 1000.0", "bearing.radial_clearance_um", "out of proportion", "-300 to 300 um"),
        ("rows", "rows = 0", "bearing.rows", "out of range", "1 to 100"),
        ("rows", "bore_diameter_mm = 43", "bearing.bore_diameter_mm", "leaves no inner ring", "< 43 mm"),
        ("rows", "preset = \"NN3070\"", "bearing.preset", "did you mean \"NN3007\"", "NN3007"),
        ("mass_kg = 0.0148", "mass_kg = 0", "cage.mass_kg", "out of range", "> 0 kg"),
        ("inner_diameter_mm = 45.0", "inner_diameter_mm = 42.0", "cage.inner_diameter_mm", "reaches into the inner ring", ">= 43 mm"),
        ("inner_diameter_mm = 45.0", "inner_diameter_mm = 54.0", "cage.inner_diameter_mm", "less than its outer one", "< 53 mm"),
        ("inner_diameter_mm = 45.0", "inner_diameter_mm = 50.0", "cage.inner_diameter_mm", "roller centres must be within", "< 49 mm"),
        ("outer_diameter_mm = 53.0", "outer_diameter_mm = 56.0", "cage.outer_diameter_mm", "reaches into the outer ring", "<= 55 mm"),
        ("guidance", "guidance = \"outer_ring\"", "cage.guidance", "did you mean \"outer-ring\"", "\"outer-ring\", \"inner-ring\", \"rollers\""),
        ("law = ", "law = \"half_space\"", "contact.law", "did you mean \"half-space\"", "\"half-space\", \"ecl\""),
        ("law = ", "law = \"sliced\"", "contact.law", "did you mean \"half-space\"", "\"half-space\", \"ecl\""),
        ("law = ", "law = 1", "contact.law", "expected one of \"half-space\", \"ecl\", found a whole number", "\"ecl\""),
        ("start", "model = \"reference\"", "simulation.model", "unknown word", "\"full\", \"lumped\""),
        ("roller_path", "roller_path = \"curve\"", "contact.roller_path", "unknown word", "\"point\", \"envelope\""),
        ("roller_path", "slices = 0", "contact.slices", "out of range", "1 to 10000"),
        ("slip_velocity_m_per_s", "slip_velocity_m_per_s = 0", "friction.slip_velocity_m_per_s", "out of range", "> 0 m/s"),
        ("speed_rpm", "speed_rpm = 0", "operation.speed_rpm", "must turn", "not 0"),
        ("speed_rpm", "speed_rpm = \"fast\"", "operation.speed_rpm", "expected a number in r/min or a list of points", ""),
        ("speed_rpm", "speed_rpm = [[0.0, 0.0], [1.0, 0.0]]", "operation.speed_rpm", "0 throughout", ""),
        ("speed_rpm", "speed_rpm = [[0.0, 0.0], [0.0, 9.0]]", "operation.speed_rpm", "must increase", "strictly increasing"),
        ("speed_rpm", "speed_rpm = []", "operation.speed_rpm", "no points", ""),
        ("speed_rpm", "speed_rpm = [[0.0, 1.0, 2.0]]", "operation.speed_rpm", "found 3 of them", ""),
        ("load_n", "load_n = [300.0]", "operation.load_n", "found 1 of them", ""),
        ("load_n", "load_n = 300.0", "operation.load_n", "a list [x, y] of two numbers in N, found a decimal number", ""),
        ("load_n", "load_n = [300.0, inf]", "operation.load_n", "not a finite number", ""),
        ("load_ramp_s", "load_ramp_s = -0.1", "operation.load_ramp_s", "out of range", ">= 0 s"),
        ("on = \"outer", "on = \"outer-race\"", "defects.0.on", "did you mean \"outer-raceway\"", "\"outer-raceway\", \"inner-raceway\", \"roller\""),
        ("row = 1", "row = 3", "defects.0.row", "has 2 rows", "1 to 2"),
        ("row = 1", "roller = 3", "defects.0.roller", "only where on = \"roller\"", ""),
        ("depth_um", "depth_um = -1", "defects.0.depth_um", "out of range", ">= 0 um"),
        ("shape", "shape = { square = { length_mm = 3.0 } }", "defects.0.shape.square", "unknown shape", "rectangle, circle, profile, li2023_irregular, outline, depth_map, grown, random"),
        ("shape", "shape = { polygon = { points_mm = [[0, 0], [1, 0], [0, 1]] } }", "defects.0.shape.polygon", "did you mean `outline`", ""),
        ("shape", "shape = { rectangel = { length_mm = 3.0 } }", "defects.0.shape.rectangel", "did you mean `rectangle`", ""),
        ("shape", "shape = \"rectangle\"", "defects.0.shape", "expected a table such as", "exactly one of"),
        ("shape", "shape = {}", "defects.0.shape", "it has 0 keys", "exactly one of"),
        ("shape", "shape = { rectangle = { length_mm = 3.0, width_mm = 61.0 } }", "defects.0.shape.rectangle.width_mm", "wider than the roller", "<= 60 mm"),
        ("shape", "shape = { rectangle = { length_mm = 173.0, width_mm = 4.0 } }", "defects.0.shape.rectangle.length_mm", "past a full circle", "<= 172.8 mm"),
        ("shape", "shape = { circle = { diameter_mm = 61 } }", "defects.0.shape.circle.diameter_mm", "wider than the roller", "<= 60 mm"),
        ("shape", "shape = { li2023_irregular = { max_width_mm = 61 } }", "defects.0.shape.li2023_irregular.max_width_mm", "wider than the roller", "<= 60 mm"),
        ("shape", "shape = { profile = { arc_mm = [0.0, 1.0], width_mm = [1.0] } }", "defects.0.shape.profile.width_mm", "1 value for the 2 points", "a list of 2"),
        ("shape", "shape = { profile = { arc_mm = [0.0, 1.0], width_mm = [1.0, 90.0] } }", "defects.0.shape.profile.width_mm", "wider than the roller", "<= 60 mm"),
        ("shape", "shape = { profile = { arc_mm = [0.0, 1.0], width_mm = [1.0, 1.0], depth_um = [2.0] } }", "defects.0.shape.profile.depth_um", "1 value for the 2 points", "a list of 2"),
        ("shape", "shape = { profile = { arc_mm = [0.0, -1.0], width_mm = [1.0, 1.0] } }", "defects.0.shape.profile.arc_mm", "must not go back", ""),
        ("shape", "shape = { profile = { arc_mm = [0.0, 90.0], width_mm = [1.0, 1.0] } }", "defects.0.shape.profile.arc_mm", "past a full circle", "-86.39 to 86.39 mm"),
        ("shape", "shape = { profile = { arc_mm = [], width_mm = [] } }", "defects.0.shape.profile.arc_mm", "at least two points", ""),
        ("shape", "shape = { outline = {} }", "defects.0.shape.outline.points_mm", "missing: the corners", "points [s, z]"),
        ("shape", "shape = { outline = { points_mm = [[0, 0], [1, 0], [0, 1]], polygons_mm = [] } }", "defects.0.shape.outline.points_mm", "not both", ""),
        ("shape", "shape = { outline = { points_mm = [] } }", "defects.0.shape.outline.points_mm", "encloses nothing", "three corners"),
        ("shape", "shape = { outline = { points_mm = [0, 1, 2] } }", "defects.0.shape.outline.points_mm", "found a whole number", ""),
        ("shape", "shape = { outline = { points_mm = [[0, 0], [1, nan], [0, 1]] } }", "defects.0.shape.outline.points_mm", "not a finite number", ""),
        ("shape", "shape = { outline = { points_mm = [[0, 0], [1, 0], [0, 0]] } }", "defects.0.shape.outline.points_mm", "fewer than three different corners", ""),
        ("shape", "shape = { outline = { points_mm = [[0, 0], [1, 1], [2, 2]] } }", "defects.0.shape.outline.points_mm", "on one line", ""),
        ("shape", "shape = { outline = { points_mm = [[0, 4], [1, 4], [0, 5]] } }", "defects.0.shape.outline.points_mm", "off the raceway's edge", "-3 to 3 mm"),
        ("shape", "shape = { outline = { points_mm = [[0, 0], [1000, 0], [0, 4000]] } }", "defects.0.shape.outline.points_mm", "um instead of mm", ""),
        ("shape", "shape = { outline = { points_mm = [[0, 0], [90, 0], [0, 1]] } }", "defects.0.shape.outline", "past a full circle", "-86.39 to 86.39 mm"),
        ("shape", "shape = { grown = { points_mm = [[0, 0], [1, 0], [0, 1]] } }", "defects.0.shape.grown.max_width_mm", "missing: the width", ""),
        ("shape", "shape = { grown = { points_mm = [[0, 0], [1, 0], [0, 1]], max_width_mm = 1, area_mm2 = 1 } }", "defects.0.shape.grown.max_width_mm", "not both", ""),
        ("shape", "shape = { grown = { points_mm = [[0, 0], [1, 0], [0, 1]], area_mm2 = 4000 } }", "defects.0.shape.grown.area_mm2", "off the raceway's edge", ""),
        ("shape", "shape = { random = { length_mm = 3, width_mm = 70 } }", "defects.0.shape.random.width_mm", "wider than the roller", "<= 60 mm"),
        ("shape", "shape = { random = { length_mm = 3, width_mm = 2, roughness = 2 } }", "defects.0.shape.random.roughness", "out of range", "0 to 1"),
        ("shape", "shape = { random = { length_mm = 3, width_mm = 2, seed = -1 } }", "defects.0.shape.random.seed", "out of range", ""),
        ("shape", "shape = { depth_map = { ds_mm = 1, dz_mm = 1, columns = 2, rows = 2, depth_um = [1, 2, 3] } }", "defects.0.shape.depth_map.depth_um", "3 depths for 2 columns and 2 rows", "4 numbers"),
        ("shape", "shape = { depth_map = { ds_mm = 1, dz_mm = 1, columns = 2, rows = 2, depth_um = [1, 2, 3, nan] } }", "defects.0.shape.depth_map.depth_um", "not a finite number", ""),
        ("shape", "shape = { depth_map = { ds_mm = 1, dz_mm = 1, columns = 2, rows = 2, depth_um = [0, 0, 0, 0] } }", "defects.0.shape.depth_map.depth_um", "there is no damage", ""),
        ("shape", "shape = { depth_map = { ds_mm = 1, dz_mm = 1, columns = 2, rows = 2, depth_um = [1, 2, 3, -4] } }", "defects.0.shape.depth_map.depth_um", "raised edges (the highest 4 um) act only in contact.law = \"half-space\"", ""),
        ("shape", "shape = { depth_map = { ds_mm = 1, dz_mm = 1, z0_mm = 5, columns = 2, rows = 2, depth_um = [1, 2, 3, 4] } }", "defects.0.shape.depth_map.depth_um", "off the raceway's edge", ""),
        ("shape", "shape = { depth_map = { ds_mm = 1, dz_mm = 1, columns = 2, rows = 2, depth_um = [1, 2, 3, 40000] } }", "defects.0.shape.depth_map.depth_um", "nm instead of um", "<= 6000 um"),
        ("roller_path", "edge_reaction = \"conservative\"", "contact.edge_reaction", "half-space", "none"),
        ("duration_s", "duration_s = 0", "simulation.duration_s", "out of range", "> 0"),
        ("duration_s", "duration_s = 1e-6", "simulation.duration_s", "shorter than one sample", ">= 3.906e-5 s"),
        ("duration_s", "duration_s = 1e6", "simulation.duration_s", "more than any machine keeps", "<= 390625 s"),
        ("start", "start = \"roling\"", "simulation.start", "did you mean \"rolling\"", ""),
        ("start", "record = [\"outer x\"]", "simulation.record", "no channel can match", ""),
        ("start", "record = \"outer_*\"", "simulation.record", "expected a list of strings, found a string", ""),
        ("start", "rekord = []", "simulation.rekord", "did you mean `record`", ""),
    ];
    for (needle, replacement, key, message, allowed) in cases {
        let line = line_of(OUTER, needle);
        let text: String = OUTER
            .lines()
            .enumerate()
            .map(|(i, old)| format!("{}\n", if i + 1 == line { replacement } else { old }))
            .collect();
        let problems = read(&text, &[]).expect_err(replacement);
        let problem = problem_of(&problems, key);
        let shown = problem.to_string();
        assert_eq!(problem.severity, Severity::Error, "{shown}");
        assert_eq!(problem.line, Some(line), "{shown}");
        assert!(shown.contains(message), "{shown}\nlacks {message}");
        assert!(shown.contains(allowed), "{shown}\nlacks {allowed}");
        let span = problem.span.expect("a line has a span");
        assert!(text.get(span).is_some_and(|part| !part.is_empty()), "{shown}");
    }
}

#[test]
fn regress_all_problems_come_at_once_in_the_order_of_the_file() {
    let text = "naem = 1\n[bearing]\npreset = \"NN3007\"\nrows = -1\n[cgae]\n[operation]\nload_n = [1, \"2\"]\n";
    let problems = read(text, &[]).unwrap_err();
    let lines: Vec<Option<usize>> = problems.iter().map(|problem| problem.line).collect();
    let keys: Vec<&str> = problems.iter().map(|problem| problem.key.as_str()).collect();
    assert_eq!(
        keys,
        ["naem", "bearing.rows", "cgae", "operation.speed_rpm", "operation.load_n"],
        "{}",
        report(&problems)
    );
    assert_eq!(lines, [Some(1), Some(4), Some(5), Some(6), Some(7)]);
}

#[test]
fn regress_missing_keys_are_all_named() {
    let problems = read("", &[]).unwrap_err();
    let keys: Vec<&str> = problems.iter().map(|problem| problem.key.as_str()).collect();
    let mut expected = vec![
        "bearing.inner_raceway_diameter_mm",
        "bearing.outer_raceway_diameter_mm",
        "bearing.roller_diameter_mm",
        "bearing.roller_length_mm",
        "bearing.rollers_per_row",
        "operation.speed_rpm",
        "operation.load_n",
    ];
    expected.sort_unstable();
    let mut sorted = keys.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, expected);
}

#[test]
fn regress_cross_key_problems_name_every_key_and_line() {
    let problems = with(BARE, &[("bearing.roller_diameter_mm", "7")]).unwrap_err();
    let problem = problem_of(&problems, "bearing.roller_diameter_mm");
    let also: Vec<(&str, Option<usize>)> =
        problem.also.iter().map(|(key, place)| (key.as_str(), place.as_ref().map(|place| place.line))).collect();
    assert_eq!(also, [("bearing.inner_raceway_diameter_mm", Some(2)), ("bearing.outer_raceway_diameter_mm", Some(3))]);
    // The override is on no line, and the lines of others are named as theirs.
    assert_eq!(problem.line, None);
}

#[test]
fn regress_toml_errors_have_lines_and_bytes_have_a_place() {
    let problems = read("[bearing\nx = = 3\n", &[]).unwrap_err();
    let lines: Vec<Option<usize>> = problems.iter().map(|problem| problem.line).collect();
    assert_eq!(lines, [Some(1), Some(2)], "{}", report(&problems));
    let problems = read("name = 1\nname = 2\n", &[]).unwrap_err();
    assert_eq!(problems[0].line, Some(2));
    assert!(problems[0].message.contains("duplicate key"));
    let problems = read_bytes(b"name = \"a\"\nb = \xff\xfe", &[]).unwrap_err();
    assert_eq!((problems[0].line, problems[0].column), (Some(2), Some(5)));
    assert_eq!(problems[0].span, Some(15..16));
}

#[test]
fn regress_overrides_reach_every_key_and_say_what_is_wrong() {
    let loaded = with(
        OUTER,
        &[
            ("operation.load_on", "inner-ring"),
            ("operation.speed_rpm", "[[0, 0], [1, 3000]]"),
            ("defects.0.depth_um", "30"),
            ("defects.0.shape.rectangle.length_mm", "2"),
            ("defects.1", "{ on = \"roller\", roller = 2, depth_um = 1, shape = { circle = { diameter_mm = 1 } } }"),
            ("simulation.record", "[\"outer_*\"]"),
            ("name", "a b"),
        ],
    )
    .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let text = loaded.scenario.to_toml();
    for line in [
        "name = \"a b\"",
        "load_on = \"inner-ring\"",
        "speed_rpm = [[0.0, 0.0], [1.0, 3000.0]]",
        "depth_um = 30.0",
        "shape = { rectangle = { length_mm = 2.0, width_mm = 4.0 } }",
        "roller = 2",
        "shape = { circle = { diameter_mm = 1.0 } }",
        "record = [\"outer_*\"]",
    ] {
        assert!(text.lines().any(|own| own.starts_with(line)), "no {line} in\n{text}");
    }
    for (path, value, message) in [
        ("operation.sped_rpm", "1", "did you mean `speed_rpm`"),
        ("operation.sped", "1", "did you mean `speed_rpm`"),
        ("operation.speed_rpm", "fast", "found a string (given as an override)"),
        ("operation..speed_rpm", "1", "dotted path"),
        ("", "1", "dotted path"),
        ("defects.7.depth_um", "1", "1 elements, counted from 0"),
        ("name.first", "1", "name is a string and has no keys"),
        ("operation.load_n", "[1", "not a TOML value"),
    ] {
        let problems = with(OUTER, &[(path, value)]).expect_err(path);
        assert!(report(&problems).contains(message), "{}", report(&problems));
    }
}

#[test]
fn analytic_support_that_carries_the_load_is_warned_of() {
    // k C_r < F: 3e7 N/m at 300 N and 10 um (`docs/src/theory/motion.md`).
    let gap = ("bearing.radial_clearance_um", "10");
    let below = with(BARE, &[gap, ("support.outer_stiffness_n_per_m", "2.99e7")]).unwrap();
    assert!(below.warnings.is_empty(), "{}", report(&below.warnings));
    let above = with(BARE, &[gap, ("support.outer_stiffness_n_per_m", "3.01e7")]).unwrap();
    let warning = problem_of(&above.warnings, "support.outer_stiffness_n_per_m");
    assert_eq!(warning.severity, Severity::Warning);
    assert!(warning.to_string().contains("< 3.000e7 N/m"), "{warning}");
    let inner = [("operation.load_on", "inner-ring"), ("support.inner_stiffness_n_per_m", "5e7")];
    let inner = with(BARE, &inner).unwrap();
    problem_of(&inner.warnings, "support.inner_stiffness_n_per_m");
}

#[test]
fn analytic_sample_rate_is_held_against_the_defect_frequencies() {
    // Section 13: BPFO 250.102, BPFI 319.898, BSF 120.663 Hz; five harmonics below 0.4 f_s.
    for (on, frequency) in [
        ("on = \"outer-raceway\"", 250.102),
        ("on = \"inner-raceway\"", 319.898),
        ("on = \"roller\", roller = 1", 241.326),
    ] {
        let defect = format!("{{ {on}, depth_um = 1, shape = {{ circle = {{ diameter_mm = 1 }} }} }}");
        let needed: f64 = frequency * 5.0 / 0.4;
        for (rate, warned) in [(needed * 0.9999, true), (needed * 1.0001, false)] {
            let text = format!("{BARE}[simulation]\nsample_rate_hz = {rate}\n");
            let loaded = with(&text, &[("defects", &format!("[{defect}]"))]);
            let loaded = loaded.unwrap_or_else(|problems| panic!("{}", report(&problems)));
            let low = loaded.warnings.iter().any(|w| w.key == "simulation.sample_rate_hz");
            assert_eq!(low, warned, "{on} at {rate} Hz");
        }
    }
}

/// The roller of the model is 6 mm long.
#[test]
fn prop_damage_wider_than_the_roller_is_that_cut_to_it() {
    for (wide, cut) in [
        ("{ rectangle = { length_mm = 3, width_mm = 20 } }", "{ rectangle = { length_mm = 3, width_mm = 6 } }"),
        (
            "{ profile = { arc_mm = [-1, 1], width_mm = [8, 40] } }",
            "{ profile = { arc_mm = [-1, 1], width_mm = [6, 6] } }",
        ),
        (
            "{ outline = { points_mm = [[-1, -9], [1, -9], [1, 2], [-1, 2]] } }",
            "{ outline = { points_mm = [[-1, -3], [1, -3], [1, 2], [-1, 2]] } }",
        ),
    ] {
        let [wide, cut] = [wide, cut].map(|shape| {
            let loaded = with(OUTER, &[("defects.0.shape", shape)]).unwrap_or_else(|p| panic!("{}", report(&p)));
            brinell::model::Model::new(&loaded.scenario).unwrap()
        });
        assert!((wide.defects[0].area() / cut.defects[0].area() - 1.0).abs() < 1e-9);
        for k in -20..=20 {
            let s = 1e-4 * f64::from(k);
            let [wide, cut] = [&wide, &cut].map(|model| model.defects[0].damaged_length(s));
            assert!((wide - cut).abs() < 1e-12 && cut <= 6e-3, "{wide} {cut} at {s}");
        }
    }
}

/// Where no number of rollers fits, no range of numbers is named.
#[test]
fn regress_a_row_without_room_has_no_range() {
    let text = "[bearing]\nrollers_per_row = 5\ninner_raceway_diameter_mm = 5\nouter_raceway_diameter_mm = 105\n\
                roller_diameter_mm = 50\nroller_length_mm = 10\n[operation]\nspeed_rpm = 1500\nload_n = [100, 0]\n";
    let problems = read(text, &[]).unwrap_err();
    let of_count: Vec<_> = problems.iter().filter(|p| p.key == "bearing.rollers_per_row").collect();
    assert!(of_count[0].allowed.as_deref().unwrap().contains("fewer than three fit"), "{of_count:?}");
}

#[test]
fn regress_overlaps_crossings_and_overhang_are_said_and_run() {
    let outline = |points: &str| format!("{{ outline = {{ polygons_mm = {points} }} }}");
    let crossing = outline("[[[-1,-1],[1,-1],[1,1],[-1,1]],[[0,0],[2,0],[2,2],[0,2]]]");
    let bow = outline("[[[0,0],[1,1],[1,0],[0,1]]]");
    let long = outline("[[[-1,-9],[1,-9],[1,9],[-1,9]]]");
    let map = "{ depth_map = { ds_mm = 1, dz_mm = 1, columns = 3, rows = 12, depth_um = [REST] } }"
        .replace("REST", &["5"; 36].join(", "));
    let second = "{ on = \"outer-raceway\", depth_um = 5, center_deg = 1, shape = { circle = { diameter_mm = 2 } } }";
    for (key, value, at, words) in [
        ("defects.0.shape", crossing.as_str(), "defects.0.shape.outline.polygons_mm", "counts as undamaged"),
        ("defects.0.shape", map.as_str(), "defects.0.shape.depth_map.depth_um", "what is beyond is left out"),
        ("defects.1", second, "defects.1", "overlaps defect 1"),
        (
            "defects.0.shape",
            bow.as_str(),
            "defects.0.shape.outline.polygons_mm",
            "crosses itself at s = 0.5 mm, z = 0.5 mm",
        ),
        ("defects.0.axial_offset_mm", "2.5", "defects.0.axial_offset_mm", "what is beyond is left out"),
        (
            "defects.0.shape",
            "{ rectangle = { length_mm = 3, width_mm = 20 } }",
            "defects.0.shape.rectangle.width_mm",
            "20 mm is wider than the roller, whose length is 6 mm; it acts over 6 mm",
        ),
        ("defects.0.shape", "{ circle = { diameter_mm = 7 } }", "defects.0.shape.circle.diameter_mm", "7 mm is wider"),
        (
            "defects.0.shape",
            "{ circle = { diameter_mm = 0.004 } }",
            "defects.0.shape.circle.diameter_mm",
            "in m instead of mm?",
        ),
        (
            "defects.0.shape",
            "{ random = { length_mm = 3, width_mm = 7 } }",
            "defects.0.shape.random.width_mm",
            "it acts over 6 mm",
        ),
        ("defects.0.shape", long.as_str(), "defects.0.shape.outline.polygons_mm", "and the roller covers -3 to 3 mm"),
    ] {
        let loaded = with(OUTER, &[(key, value)]).unwrap_or_else(|p| panic!("{}", report(&p)));
        let warning = problem_of(&loaded.warnings, at);
        assert!(warning.to_string().contains(words), "{warning}");
        brinell::model::Model::new(&loaded.scenario).unwrap();
    }
    // Side by side they do not overlap.
    let apart = second.replace("center_deg = 1", "center_deg = 9");
    let loaded = with(OUTER, &[("defects.1", &apart)]).unwrap_or_else(|p| panic!("{}", report(&p)));
    assert!(loaded.warnings.iter().all(|w| !w.message.contains("overlaps")));
}

#[test]
fn regress_a_key_is_found_where_it_is() {
    let text = "a = 1\n[[defects]]\nrow = 1\n[[defects]]\nshape = { image = { file = \"x.png\" } }\n";
    let place = brinell::document::locate(text, "defects.1.shape.image.file").unwrap();
    assert_eq!((place.line, place.column), (5, 28));
    assert_eq!(&text[place.span], "\"x.png\"");
    for missing in ["defects.2.row", "defects.x", "defects.0.shape.image", "b", "a.b", ""] {
        assert_eq!(brinell::document::locate(text, missing), None, "{missing}");
    }
    assert_eq!(brinell::document::locate("a = [", "a"), None);
}
