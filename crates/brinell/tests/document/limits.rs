//! How much a document may hold, and how many of its problems are reported.

use brinell::defect::MOST_CROSSINGS;
use brinell::document::{MOST_OF_A_KIND, Problem, Severity, read};
use brinell::random::Random;

use super::{BARE, LI2023, OUTER, good, report, with};

fn refused(text: &str) -> Vec<Problem> {
    match read(text, &[]) {
        Ok(_) => panic!("nothing is wrong"),
        Err(problems) => problems,
    }
}

/// How many problems there are, told or not.
fn count(problems: &[Problem]) -> usize {
    problems.iter().map(|problem| problem.count).sum()
}

#[test]
fn regress_a_path_has_32_parts_at_most() {
    let path = |parts: usize| vec!["a"; parts].join(".");
    let problems = with(BARE, &[(&path(32), "1")]).unwrap_err();
    assert!(problems[0].message.starts_with("unknown key"));
    for parts in [33, 60_000] {
        let problems = with(BARE, &[(&path(parts), "1")]).unwrap_err();
        let expected = format!("the path of a key has {parts} parts; there are at most 32");
        assert_eq!(problems[0].message, expected);
        assert!(problems[0].key.len() < 100);
    }
}

#[test]
fn regress_tables_and_lists_lie_32_deep_at_most() {
    let words = "tables and lists are nested more than 32 levels deep";
    // The parser allows 80 parts of a key in each of 80 tables.
    let key = vec!["a"; 79].join(".");
    let tables = format!("{}{key} = 1{}\n", format!("{key} = {{").repeat(79), "}".repeat(79));
    assert_eq!(refused(&(tables.clone() + BARE))[0].message, words);
    let lists = "[".repeat(40) + &"]".repeat(40);
    for value in [lists, format!("{{ {} }}", tables.trim())] {
        let problems = with(BARE, &[("cage", &value)]).unwrap_err();
        assert_eq!(problems[0].message, words);
    }
}

#[test]
fn prop_unknown_keys_are_reported_twenty_times_and_counted() {
    let keys: String = (0..3000).map(|k| format!("k{k} = 1\n")).collect();
    let on_one_line = keys.replace('\n', ", ");
    let tables: String = (0..3000).map(|k| format!("[t{k}]\n")).collect();
    for text in [keys + BARE, format!("cage = {{ {on_one_line} }}\n{BARE}"), BARE.to_owned() + &tables] {
        let problems = refused(&text);
        assert_eq!(problems.len(), MOST_OF_A_KIND + 1, "{}", report(&problems));
        assert_eq!(count(&problems), 3000);
        let last = problems.last().unwrap().to_string();
        assert!(last.starts_with("error: and 2980 more like "), "{last}");
        assert!(last.ends_with(": unknown key"), "{last}");
    }
}

#[test]
fn prop_problems_are_few_whatever_they_are() {
    let defect = "[[defects]]\non = \"outer-raceway\"\ndepth_um = -1\nshape = { circle = { diameter_mm = -2 } }\n";
    for (what, text) in [
        ("broken lines", "=\n".repeat(1000) + BARE),
        ("wrong values", BARE.to_owned() + &defect.repeat(1000)),
        ("missing keys", BARE.to_owned() + &"[[defects]]\n".repeat(1000)),
        ("unknown shapes", BARE.to_owned() + &defect.replace("circle", "ball").repeat(1000)),
    ] {
        let problems = refused(&text);
        assert!(problems.len() < 200, "{what}: {} are told", problems.len());
        assert!(count(&problems) >= 1000, "{what}: {}", count(&problems));
        assert!(problems.iter().all(|p| p.severity == Severity::Error));
    }
}

#[test]
fn prop_overlaps_are_reported_twenty_times_and_counted() {
    let defect = "[[defects]]\non = \"outer-raceway\"\ndepth_um = 1\nshape = { circle = { diameter_mm = 2 } }\n";
    let loaded = good(&(BARE.to_owned() + &defect.repeat(300)));
    let overlaps = |w: &&Problem| w.message.starts_with("overlaps");
    let told = loaded.warnings.iter().filter(overlaps).count();
    assert_eq!(told, MOST_OF_A_KIND);
    let more = loaded.warnings.last().unwrap();
    assert_eq!(more.count, 300 * 299 / 2 - MOST_OF_A_KIND);
    assert!(more.message.contains("more like defects."), "{more}");
}

#[test]
fn regress_a_document_holds_so_many_values_and_tables() {
    let values = format!("x = [{}]\n", "1,".repeat(600_000));
    let defects = "[[defects]]\n".repeat(6000);
    let tables = "[[defects]]\n".repeat(60_000);
    for (text, words) in [
        (values + BARE, "values are more than the 500000 of a document"),
        (BARE.to_owned() + &tables, "tables are more than the 50000 of a document"),
        (BARE.to_owned() + &defects, "there are 6000 [[defects]]"),
    ] {
        let problems = refused(&text);
        assert!(problems[0].message.ends_with(words), "{}", report(&problems));
    }
}

#[test]
fn regress_an_outline_that_crosses_everywhere_is_refused() {
    let mut random = Random::new(1);
    let mut point = || format!("[{}, {}]", random.uniform(), random.uniform());
    let points: Vec<String> = (0..2000).map(|_| point()).collect();
    let shape = format!("{{ outline = {{ points_mm = [{}] }} }}", points.join(", "));
    let problems = with(OUTER, &[("defects.0.shape", &shape)]).unwrap_err();
    let expected = format!("sides cross in more than {MOST_CROSSINGS} places");
    assert!(problems.iter().any(|p| p.message == expected), "{}", report(&problems));
}

#[test]
fn lit_no_bearing_turns_beyond_its_speed_factor() {
    // The pitch diameter of the bare bearing is 49 mm.
    let most = (1e7_f64 / 49.0).floor();
    let warned = |speed: f64| {
        let loaded = with(BARE, &[("operation.speed_rpm", &speed.to_string())])
            .unwrap_or_else(|problems| panic!("{}", report(&problems)));
        loaded.warnings.iter().any(|w| w.message.contains("tested up to 3e6"))
    };
    for (speed, beyond_tests) in [(most, true), (-most, true), (61_225.0, true), (61_224.0, false)] {
        assert_eq!(warned(speed), beyond_tests, "{speed}");
    }
    for (speed, at) in [
        ("204082.0", ""),
        ("-204082.0", ""),
        ("1e300", ""),
        ("2147483648", ""),
        ("[[0.0, 1000.0], [1.5, 3e5]]", " at t = 1.5 s"),
    ] {
        let problems = with(BARE, &[("operation.speed_rpm", speed)]).unwrap_err();
        let problem = &problems[0];
        assert_eq!(problem.key, "operation.speed_rpm");
        assert!(problem.message.contains(at) && problem.message.contains("speed factor"));
        assert_eq!(problem.allowed.as_deref(), Some("-204081 to 204081"));
        assert_eq!(problem.unit, Some("r/min"));
        assert_eq!(problem.also[0].0, "bearing.pitch_diameter_mm");
    }
}

#[test]
fn lit_no_load_is_beyond_the_strength_of_steel() {
    // ISO 76: C0 = 44 (1 - d/D_m) i Z L d. 10 C0 is 12.6 GPa.
    let b = good(BARE).scenario.bearing;
    let (d, rollers) = (b.roller_diameter_mm, (b.rows * b.rollers_per_row) as f64);
    let most = 440.0 * (1.0 - d / b.pitch_diameter_mm) * rollers * b.roller_length_mm * d;
    let gravity = most / b.inner_ring_mass_kg.max(b.outer_ring_mass_kg);
    for (key, most, unit) in [("operation.load_n", most, "N"), ("operation.gravity_m_per_s2", gravity, "m/s^2")] {
        let at = |share: f64| [(key, format!("[{}, {}]", 0.6 * share * most, -0.8 * share * most))];
        let set = |share: f64| with(BARE, &at(share).each_ref().map(|(k, v)| (*k, v.as_str())));
        set(0.999).unwrap_or_else(|problems| panic!("{}", report(&problems)));
        for share in [1.001, 1e10] {
            let problems = set(share).unwrap_err();
            let problem = &problems[0];
            assert_eq!((&*problem.key, problem.unit), (key, Some(unit)));
            assert!(problem.message.contains("times the static load rating"));
            let allowed = problem.allowed.as_deref().unwrap();
            assert!(allowed.starts_with("a resultant of at most "), "{allowed}");
        }
    }
}

#[test]
fn analytic_no_body_moves_faster_than_a_run_can_follow() {
    let roller = good(BARE).scenario.bearing.roller_mass_kg;
    // m w at w = 1e9 1/s.
    let most = roller * 1e9;
    with(BARE, &[("contact.damping_ns_per_m", &(0.99 * most).to_string())])
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    for (key, value) in [
        ("contact.damping_ns_per_m", (1.01 * most).to_string()),
        ("contact.inner_stiffness", "1e30".into()),
        ("contact.outer_stiffness", "1e30".into()),
        ("cage.contact_damping_ns_per_m", "1e30".into()),
        ("support.inner_stiffness_n_per_m", "1e30".into()),
        ("support.outer_stiffness_n_per_m", "1e30".into()),
        ("support.inner_damping_ns_per_m", "1e30".into()),
        ("support.outer_damping_ns_per_m", "1e30".into()),
        ("friction.slip_velocity_m_per_s", "1e-30".into()),
    ] {
        let problems = with(BARE, &[LI2023, (key, &value)]).unwrap_err();
        let problem = &problems[0];
        assert_eq!(problem.key, key, "{}", report(&problems));
        let told = problem.to_string();
        for words in [key, "= 1", "faster than 1e9 1/s", "allowed: ", " N", "mass_kg"] {
            let speed = words == " N" && key.starts_with("friction");
            assert!(told.contains(words) || speed, "no {words} in {told}");
        }
    }
}

#[test]
fn lit_friction_of_a_ball_is_bounded_by_its_own_load_and_inertia() {
    // 2 mu Q / (2/5 m v_s) < 1e9 1/s, Stribeck's Q = 4.37 F/Z.
    let key = "friction.slip_velocity_m_per_s";
    let text = "[bearing]\npreset = \"6205\"\n[operation]\nspeed_rpm = 1800.0\nload_n = [300.0, 0.0]\n";
    let s = good(text).scenario;
    let heaviest = 4.37 * 300.0 / s.bearing.rollers_per_row as f64;
    let least = 5.0 * s.friction.raceway_coefficient * heaviest / (s.bearing.roller_mass_kg * 1e9);
    with(text, &[(key, &(1.01 * least).to_string())]).unwrap_or_else(|problems| panic!("{}", report(&problems)));
    assert_eq!(with(text, &[(key, &(0.99 * least).to_string())]).unwrap_err()[0].key, key);
}

#[test]
fn regress_keys_and_values_of_megabytes_are_reported_in_part() {
    let long = "k".repeat(3_000_000);
    for text in [
        format!("{long} = 1\n{BARE}"),
        BARE.replace("[bearing]", &format!("[bearing]\npreset = \"{long}\"")),
        format!("{BARE}[provenance]\nassumed = [{{ key = \"{long}\", value = 1, reason = \"x\" }}]\n"),
    ] {
        for problem in refused(&text) {
            assert!(problem.to_string().len() < 5000, "{}", problem.to_string().len());
        }
    }
}
