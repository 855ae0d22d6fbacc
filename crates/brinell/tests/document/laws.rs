//! `simulation.laws` and the keys that it decides.

use super::{BARE, LI2023, OUTER, good, refused, report, with};
use brinell::document::{Loaded, json_schema, read};
use brinell::model::Model;
use brinell::plausibility::Beforehand;
use brinell::scenario::*;

const LAWS: (&str, &str) = ("simulation.laws", "mechanics");

fn mechanics(text: &str, more: &[(&str, &str)]) -> Loaded {
    with(text, &[&[LAWS], more].concat()).unwrap_or_else(|problems| panic!("{}", report(&problems)))
}

const NN3007: &str = "\
[bearing]
preset = \"NN3007\"
[operation]
speed_rpm = 1800.0
load_n = [300.0, 0.0]
";

#[test]
fn regress_the_mechanics_defaults_of_a_roller_bearing() {
    let s = mechanics(BARE, &[]).scenario;
    assert_eq!((s.simulation.laws, s.simulation.geometry, s.simulation.seed), (Laws::Mechanics, GeometryLaw::Exact, 1));
    let c = &s.contact;
    assert_eq!((c.law, c.damping, c.roughness_um), (Law::HalfSpace, ContactDamping::Time { us: 2.5 }, 0.1));
    assert_eq!((c.edge_radius_um, c.youngs_modulus_gpa, c.poisson_ratio), (10.0, Some(206.0), Some(0.3)));
    let cage = &s.cage;
    assert_eq!((cage.walls, cage.pockets, cage.friction_coefficient), (Walls::Oiled, Pockets::Slot, 0.05));
    assert_eq!(cage.guidance_film, GuidanceFilm::Dynamic);
    assert_eq!(s.friction.rolling_coefficient, 7e-4);
    assert_eq!(s.housing.mass_kg, 20.0 * s.bearing.outer_ring_mass_kg);
    assert_eq!((&s.bearing.waviness, &s.bearing.element_waviness), (&None, &None));
}

#[test]
fn regress_the_papers_defaults_of_a_roller_bearing() {
    let s = good(&BARE.replace("[operation]", "[simulation]\nlaws = \"li2023\"\n[operation]")).scenario;
    assert_eq!((s.simulation.laws, s.simulation.geometry), (Laws::Li2023, GeometryLaw::Centred));
    let c = &s.contact;
    assert_eq!(
        (c.law, c.damping, c.youngs_modulus_gpa),
        (Law::Ecl, ContactDamping::Constant { ns_per_m: 200.0 }, None)
    );
    assert_eq!((s.cage.walls, s.cage.pockets), (Walls::Linear, Pockets::Slot));
    assert_eq!((s.friction.rolling_coefficient, s.housing.mass_kg), (0.0, 0.0));
}

#[test]
fn regress_a_set_of_laws_chooses_what_the_catalogue_says_of_the_nn3007() {
    let s = mechanics(NN3007, &[]).scenario;
    // Palmgren, of rollers of 6 mm.
    assert!((s.contact.inner_stiffness / 8.54e8 - 1.0).abs() < 1e-3, "{}", s.contact.inner_stiffness);
    assert_eq!(s.contact.inner_stiffness, s.contact.outer_stiffness);
    // The paper's land leaves the cage 1 mm: under heavier loads it ran 0.9 mm off centre, 3.5 % slow.
    assert_eq!((s.cage.guidance, s.cage.guide_clearance_mm), (Guidance::Rollers, 0.09));
    // Chosen for this bearing: larger ones have larger.
    let (support, housing) = (&s.support, s.housing.mass_kg);
    assert_eq!(support.inner_stiffness_n_per_m, 5e7);
    // A tenth of critical of the rings, the outer one with its housing of 20 times its mass.
    assert!((support.inner_damping_ns_per_m - 0.2 * (5e7f64 * 0.101).sqrt()).abs() < 1e-9);
    assert!((support.outer_damping_ns_per_m - 0.2 * (5e7f64 * 21.0 * 0.0791).sqrt()).abs() < 1e-9);
    assert_eq!(support.outer_stiffness_n_per_m, 1e6);
    assert!((housing - 1.582).abs() < 1e-9, "{housing}");
    let linear = mechanics(NN3007, &[("cage.walls", "linear")]).scenario;
    assert!((linear.cage.contact_stiffness_n_per_m * 90e-6 / 11.0 - 1.0).abs() < 1e-12);
    let paper = with(NN3007, &[("simulation.laws", "li2023")]).unwrap().scenario;
    assert_eq!((paper.contact.inner_stiffness, paper.contact.outer_stiffness), (1.828e8, 1.898e8));
    assert_eq!(paper.cage.contact_stiffness_n_per_m, 1e7);
    assert_eq!((paper.cage.guidance, paper.cage.guide_clearance_mm), (Guidance::OuterRing, 1.0));
}

#[test]
fn prop_what_each_set_writes_is_read_again() {
    for laws in ["mechanics", "li2023"] {
        for text in [BARE, NN3007, OUTER] {
            let plain = text.lines().filter(|l| {
                !["contact_", "law ", "roller_path", "damping_ns", "edge_r"].iter().any(|k| l.starts_with(k))
            });
            let text: String = plain.map(|line| format!("{line}\n")).collect();
            let loaded = with(&text, &[("simulation.laws", laws)]).unwrap_or_else(|e| panic!("{}", report(&e)));
            let again = good(&loaded.to_toml());
            assert_eq!(again.scenario, loaded.scenario);
            assert_eq!(
                loaded.scenario.problems().len(),
                loaded.warnings.len(),
                "{}",
                report(&loaded.scenario.problems())
            );
        }
    }
}

#[test]
fn prop_keys_without_a_meaning_are_refused_with_the_law_that_has_none() {
    for (key, value, law) in [
        ("contact.roller_path", "envelope", "half-space"),
        ("contact.edge_reaction", "none", "half-space"),
        ("cage.contact_stiffness_n_per_m", "1e7", "cage.walls is \"linear\""),
        ("cage.contact_damping_ns_per_m", "20.0", "cage.walls is \"linear\""),
        ("cage.land_stiffness_n_per_m", "1e7", "cage.walls is \"linear\""),
        ("cage.land_damping_ns_per_m", "1.0", "cage.walls is \"linear\""),
    ] {
        refused(BARE, &[LAWS, (key, value)], key, law);
    }
    let both = [("contact.damping_time_us", "2.5"), ("contact.damping_ns_per_m", "200.0")];
    refused(BARE, &both, "contact.damping_ns_per_m", "given twice");
    refused(BARE, &[("contact.damping_time_us", "0")], "contact.damping_time_us", "> 0");
    refused(BARE, &[("contact.damping_time_us", "\"soon\"")], "contact.damping_time_us", "expected a number");
    refused(BARE, &[LI2023, ("contact.youngs_modulus_gpa", "206")], "contact.youngs_modulus_gpa", "half-space");
    let lumped = ("simulation.model", "lumped");
    refused(BARE, &[LAWS, lumped], "simulation.laws", "lumped");
    refused(BARE, &[("contact.law", "half-space"), lumped], "contact.law", "half-space");
    refused(BARE, &[both[0], lumped], "contact.damping_time_us", "constant");
    refused(BARE, &[("bearing.waviness", "{ amplitude_um = 0.1 }"), lumped], "bearing.waviness", "smooth");
}

#[test]
fn prop_damping_is_what_the_file_gives_whatever_the_laws() {
    for laws in ["mechanics", "li2023"] {
        let of = |key, value| with(BARE, &[("simulation.laws", laws), (key, value)]).unwrap().scenario.contact.damping;
        assert_eq!(of("contact.damping_time_us", "4"), ContactDamping::Time { us: 4.0 });
        assert_eq!(of("contact.damping_time_us", "\"10 us\""), ContactDamping::Time { us: 10.0 });
        assert_eq!(of("contact.damping_ns_per_m", "50"), ContactDamping::Constant { ns_per_m: 50.0 });
    }
}

#[test]
fn prop_waviness_has_an_amplitude_and_may_leave_out_the_rest() {
    let of = |value| mechanics(BARE, &[("bearing.waviness", value)]).scenario.bearing.waviness.unwrap();
    assert_eq!(of("{ amplitude_um = 0.2 }"), Waviness { amplitude_um: 0.2, exponent: 1.5, waves: [2, 300] });
    assert_eq!(
        of("{ amplitude_um = 0.2, exponent = 2, waves = [3, 3] }"),
        Waviness { amplitude_um: 0.2, exponent: 2.0, waves: [3, 3] }
    );
    for (value, words) in [
        ("0.1", "expected a table"),
        ("{ exponent = 1 }", "amplitude_um is required"),
        ("{ amplitude_um = -1 }", "out of range"),
        ("{ amplitude_um = 1, waves = [3, 2] }", "waves"),
        ("{ amplitude_um = 1, waves = [0, 2] }", "waves"),
        ("{ amplitude_um = 1, wave = 3 }", "unknown key"),
    ] {
        let problems = with(BARE, &[("bearing.element_waviness", value)]).unwrap_err();
        assert!(report(&problems).contains(words), "{value}: {}", report(&problems));
    }
}

const DAMAGED: &str = "\
[[defects]]
on = \"outer-raceway\"
depth_um = 20.0
shape = { rectangle = { length_mm = 3.0, width_mm = 4.0 } }
";

#[test]
fn prop_a_table_is_a_file_or_what_stands_in_it() {
    let text = format!("{BARE}{DAMAGED}");
    let loaded = mechanics(&text, &[("defects.0.table", "pit.csv")]);
    assert_eq!(loaded.scenario.defects[0].table, Some(DefectTable::File("pit.csv".into())));
    assert_eq!(Model::new(&loaded.scenario).unwrap_err().key, "defects.0.table");
    let inline = "{ s_mm = [-2, 0, 2], delta_um = [0, 1, 5], delta_eff_um = [0, 1, 5, 0, 0.4, 3.9, 0, 1, 5] }";
    let loaded = mechanics(&text, &[("defects.0.table", inline)]);
    let Some(DefectTable::Read(table)) = &loaded.scenario.defects[0].table else { panic!("no table") };
    assert_eq!((table.s_mm.len(), table.delta_um.len(), table.values.list()[4]), (3, 3, 0.4));
    assert_eq!(good(&loaded.to_toml()).scenario, loaded.scenario);
    refused(&text, &[LAWS, ("contact.law", "ecl"), ("defects.0.table", inline)], "defects.0.table", "ecl");
    let energies = inline.replace("delta_eff_um", "energy_j");
    let loaded = mechanics(&text, &[("defects.0.table", &energies)]);
    assert_eq!(good(&loaded.to_toml()).scenario, loaded.scenario);
    let both = energies.replace("energy_j", "delta_eff_um = [], energy_j");
    refused(&text, &[LAWS, ("defects.0.table", &both)], "defects.0.table", "make no table");
    // Of half a per cent's accuracy, raised by 1 um.
    let rim = "{ s_mm = [-2, 0, 2], delta_um = [-1, 0, 5], delta_eff_um = [-1, 0, 5.02, 0, 1, 6, -0.5, 0, 4.98] }";
    mechanics(&text, &[("defects.0.table", rim)]);
    for (value, words) in [
        ("{ s_mm = [1, -1], delta_um = [0, 1], delta_eff_um = [0, 1, 0, 1] }", "s_mm rising"),
        ("{ s_mm = [0, 1], delta_um = [0, 1], delta_eff_um = [0, 1, 0] }", "3 delta_eff_um"),
        ("{ s_mm = [0, 1], delta_um = [0, 1] }", "make no table"),
        // In mm where um are asked for, cut short, and beyond half a per cent.
        (
            "{ s_mm = [0, 1], delta_um = [0, 5], delta_eff_um = [0, 0.005, 0, 0.005] }",
            "the units (mm, um) of all columns",
        ),
        (
            "{ s_mm = [0, 1], delta_um = [0, 5], delta_eff_um = [0, 5, 0, 4] }",
            "end s_mm = 1 delta_eff_um is 4 where delta_um is 5",
        ),
        (
            "{ s_mm = [0, 1], delta_um = [0, 5], delta_eff_um = [0, 5.03, 0, 5] }",
            "within 0.5 % and 0.001 um of delta_um",
        ),
        ("3", "FILE"),
    ] {
        refused(&text, &[LAWS, ("defects.0.table", value)], "defects.0.table", words);
    }
    let mut built = loaded.scenario.clone();
    let values = TableValues::DeltaEffUm(vec![]);
    built.defects[0].table = Some(DefectTable::Read(TableData { s_mm: vec![0.0], delta_um: vec![0.0], values }));
    assert!(built.problems().iter().any(|p| p.key == "defects.0.table"));
}

#[test]
fn prop_a_run_names_its_laws_and_what_differs() {
    for text in [BARE, NN3007] {
        for laws in ["mechanics", "li2023"] {
            let s = with(text, &[("simulation.laws", laws)]).unwrap().scenario;
            assert_eq!(s.laws_and_differences().to_string(), laws);
        }
    }
    let changed = [("contact.law", "ecl"), ("contact.damping_ns_per_m", "200"), ("housing.mass_kg", "1")];
    let s = mechanics(NN3007, &changed).scenario;
    let differences = s.laws_and_differences().differences;
    let keys: Vec<&str> = differences.iter().map(|d| d.key.as_str()).collect();
    assert_eq!(keys, ["contact.law", "contact.damping_ns_per_m", "housing.mass_kg"]);
    assert_eq!((&differences[0].value[..], &differences[0].usual[..]), ("\"ecl\"", "\"half-space\""));
}

/// Nobody should be warned of a value that nobody gave, however large the bearing.
#[test]
fn prop_a_bearing_of_any_size_is_not_warned_of_what_it_was_not_given() {
    for element in ["roller", "ball"] {
        for pitch in [49.0, 100.0, 200.0, 400.0, 800.0] {
            let (d, z) = if element == "roller" { (pitch / 8.0, 18) } else { (pitch / 5.0, 9) };
            let length = if element == "roller" { format!("roller_length_mm = {d}") } else { String::new() };
            // Of the static load rating, 44 or 13 N/mm^2 times Z d^2.
            let rating = if element == "roller" { 38.0 } else { 13.0 } * f64::from(z) * d * d;
            for share in [0.02, 0.1, 0.3] {
                let text = format!(
                    "[bearing]\nelement = \"{element}\"\ninner_raceway_diameter_mm = {}\nouter_raceway_diameter_mm = {}\n\
                     roller_diameter_mm = {d}\n{length}\nrollers_per_row = {z}\n[operation]\nspeed_rpm = {}\nload_n = [{}, 0.0]\n\
                     [simulation]\nlaws = \"mechanics\"\n",
                    pitch - d,
                    pitch + d,
                    5e4 / pitch,
                    share * rating
                );
                let loaded = read(&text, &[]).unwrap_or_else(|e| panic!("{text}{}", report(&e)));
                let model = Model::new(&loaded.scenario).unwrap();
                let warnings = [loaded.warnings.clone(), Beforehand::of(&loaded.scenario, &model).warnings].concat();
                let given = |key: &str| text.contains(&format!("\n{} = ", key.rsplit('.').next().unwrap_or_default()));
                // That gravity is left out is said of the load, which is given.
                let unasked = |key: &str| !given(key) && key != "operation.gravity_m_per_s2";
                let unasked: Vec<_> = warnings.into_iter().filter(|w| unasked(&w.key)).collect();
                assert!(unasked.is_empty(), "{element}, {pitch} mm, {share} C0: {}", report(&unasked));
            }
        }
    }
}

#[test]
fn prop_the_schema_has_every_key_of_the_laws() {
    let schema = json_schema();
    for (section, key) in [
        ("simulation", "laws"),
        ("simulation", "geometry"),
        ("simulation", "seed"),
        ("contact", "damping_time_us"),
        ("contact", "roughness_um"),
        ("cage", "walls"),
        ("cage", "pockets"),
        ("friction", "rolling_coefficient"),
        ("bearing", "waviness"),
        ("housing", "mass_kg"),
    ] {
        assert!(schema["properties"][section]["properties"][key].is_object(), "{section}.{key}");
    }
    assert!(schema["properties"]["defects"]["items"]["properties"]["table"].is_object());
}

#[test]
fn regress_clearance_grows_beyond_the_standards_table() {
    // A ball bearing of 400 mm bore: the standard has 55 to 145 um for class CN on the diameter.
    let text = "[bearing]\nelement = \"ball\"\nbore_diameter_mm = 400.0\ninner_raceway_diameter_mm = 436.5\n\
                outer_raceway_diameter_mm = 563.5\nroller_diameter_mm = 63.5\nrollers_per_row = 15\n[operation]\n\
                speed_rpm = 500.0\nload_n = [0.0, -60000.0]\n";
    let clearance = good(text).scenario.bearing.radial_clearance_um;
    assert!((27.5..72.5).contains(&clearance), "{clearance}");
}

#[test]
fn prop_what_levers_of_the_centred_bearing_leave_out_is_refused() {
    let centred = [("simulation.laws", "li2023"), ("simulation.geometry", "centred")];
    for (key, value) in [
        ("bearing.waviness", "{ amplitude_um = 0.1 }"),
        ("friction.rolling_coefficient", "1e-3"),
        ("cage.pockets", "round"),
    ] {
        let problems = with(BARE, &[&centred[..], &[(key, value)]].concat()).unwrap_err();
        assert!(problems.len() == 1 && problems[0].key == key, "{problems:?}");
        assert!(problems[0].to_string().contains("simulation.geometry = \"exact\""), "{problems:?}");
    }
    // Waves alone ask for the exact one.
    let waves = with(BARE, &[centred[0], ("bearing.waviness", "{ amplitude_um = 0.1 }")]).unwrap();
    assert_eq!(waves.scenario.simulation.geometry, GeometryLaw::Exact);
}

#[test]
fn regress_the_centred_bearing_is_offered_ecl_where_it_can_be_used() {
    let centred = [LAWS, ("simulation.geometry", "centred"), ("contact.law", "half-space")];
    let text = format!("{BARE}{DAMAGED}");
    refused(&text, &centred, "contact.law", "\"ecl\", or simulation.geometry = \"exact\"");
    let keys = [("bearing.profile", "logarithmic"), ("simulation.model", "tilting")];
    for key in keys {
        let problems = with(&text, &[&centred[..], &[key]].concat()).unwrap_err();
        let of_law =
            problems.iter().find(|p| p.key == "contact.law").unwrap_or_else(|| panic!("{key:?}: {problems:?}"));
        assert!(!of_law.to_string().contains("ecl"), "{of_law}");
    }
    let ball = "[bearing]\npreset = \"6205\"\n[operation]\nspeed_rpm = 1800.0\nload_n = [800.0, 0.0]\n[simulation]\nduration_s = 0.1\n";
    let pit = "[[defects]]\non = \"outer-raceway\"\ndepth_um = 20.0\nshape = { rectangle = { length_mm = 1.0, width_mm = 1.0 } }\n";
    let problems = with(&format!("{ball}{pit}"), &[("simulation.geometry", "centred")]).unwrap_err();
    assert!(problems.iter().all(|p| !p.to_string().contains("ecl")), "{problems:?}");
}
