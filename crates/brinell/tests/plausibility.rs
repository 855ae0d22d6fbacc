//! Warnings about scenarios that run and mean little, and about the energy of runs.

use crate::common::read_li2023 as read;
use crate::common::{rectangle_with, simulate, warnings};
use brinell::model::Model;
use brinell::plausibility::of_energy;
use brinell::pressure::{STATIC_LIMIT, pressure_beside, pressures};
use brinell::scenario::Scenario;
use brinell::simulate::EnergyAudit;
use brinell::statics::static_load_zone;

/// The one warning of a changed scenario.
fn warning(settings: &[(&str, &str)]) -> String {
    let mut all = warnings(&rectangle_with(settings).scenario);
    assert_eq!(all.len(), 1, "{settings:?}: {all:#?}");
    all.remove(0)
}

fn silent(settings: &[(&str, &str)]) {
    assert_eq!(warnings(&rectangle_with(settings).scenario), Vec::<String>::new(), "{settings:?}");
}

#[test]
fn regress_a_sensible_scenario_earns_no_word() {
    silent(&[]);
    silent(&[("operation.speed_rpm", "-1800")]);
    silent(&[("contact.roller_path", "envelope")]);
}

#[test]
fn regress_damage_of_no_depth_is_said() {
    assert!(warning(&[("defects.0.depth_um", "0")]).contains("runs as a healthy one"));
    assert!(warning(&[("defects.0.depth_um", "0.001")]).contains("would hide it"));
    silent(&[("defects.0.depth_um", "0.05")]);
}

#[test]
fn prop_damage_outside_the_load_zone_is_said_of_the_outer_raceway_alone() {
    // The zone of 300 N and 10 um is about 76 degrees wide, around 0 degrees.
    for (center, outside) in
        [("0", false), ("30", false), ("-40", false), ("60", true), ("-60", true), ("180", true), ("340", false)]
    {
        let settings = [("defects.0.center_deg", center)];
        if outside {
            let told = warning(&settings);
            assert!(
                told.contains("defects.0.center_deg")
                    && told.contains("outside the load zone, which is")
                    && told.contains("advised: -"),
                "{told}"
            );
        } else {
            silent(&settings);
        }
        silent(&[settings[0], ("defects.0.on", "inner-raceway")]);
    }
    // A preloaded bearing is loaded all around.
    silent(&[("defects.0.center_deg", "180"), ("bearing.radial_clearance_um", "-10")]);
    // Clearance 0: half of the circumference.
    silent(&[("defects.0.center_deg", "80"), ("bearing.radial_clearance_um", "0")]);
    // A pit that takes all load off the rollers on it lies in the zone all the same.
    let pit = "{ rectangle = { length_mm = 3.0, width_mm = 6.0 } }";
    let along = ("contact.roller_path", "envelope");
    silent(&[("defects.0.shape", pit), along]);
    // With the load the other way, the zone is on the other side.
    let told = warning(&[("operation.load_n", "[0, -300]")]);
    assert!(told.contains("around -90 deg"), "{told}");
}

#[test]
fn prop_a_ridge_higher_than_the_gap_is_loaded_outside_the_load_zone() {
    // At 180 degrees the gap of 300 N is the clearance of 10 um and the displacement of some 13 um.
    let ridge = |um: &str| {
        format!(
            "{{ depth_map = {{ columns = 2, rows = 2, ds_mm = 2, dz_mm = 8, s0_mm = -1, z0_mm = -4, depth_um = [{}] }} }}",
            [um; 4].join(", ")
        )
    };
    let at = |shape: &str| {
        warnings(
            &rectangle_with(&[
                ("defects.0.center_deg", "180"),
                ("contact.law", "half-space"),
                ("simulation.geometry", "exact"),
                ("defects.0.shape", shape),
            ])
            .scenario,
        )
    };
    assert_eq!(at(&ridge("-30")), Vec::<String>::new());
    let low = at(&ridge("-15"));
    assert!(low.len() == 1 && low[0].contains("only impacts of unloaded rollers remain"), "{low:?}");
}

/// The drive end of the Case Western rig.
const BALLS: &str = "\
[bearing]
preset = \"6205\"
[operation]
speed_rpm = 1797.0
load_n = [0.0, -200.0]
load_on = \"outer-ring\"
[[defects]]
on = \"outer-raceway\"
center_deg = -90.0
depth_um = 20.0
shape = { rectangle = { length_mm = 0.4, width_mm = 0.2 } }
[simulation]
geometry = \"exact\"
duration_s = 0.5
";

#[test]
fn analytic_damage_beside_the_heaviest_ellipse_is_said() {
    let scenario = |settings: &[(&str, &str)]| {
        let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        read(BALLS, &settings).unwrap_or_else(|problems| panic!("{problems:?}")).scenario
    };
    let half_length = |model: &str| {
        let healthy = scenario(&[("defects", "[]"), ("simulation.model", model)]);
        let heaviest = static_load_zone(&Model::new(&healthy).unwrap()).unwrap().largest;
        let ellipses = brinell::contact::ball::ellipses(&healthy.bearing, &healthy.contact).unwrap();
        1e3 * ellipses[1].half_axes(heaviest)[1]
    };
    let half = half_length("full");
    // The damage is 0.2 mm wide.
    for (offset, touched) in [(half + 0.09, true), (half + 0.11, false), (-half - 0.11, false)] {
        let all = warnings(&scenario(&[("defects.0.axial_offset_mm", &format!("{offset:?}"))]));
        assert_eq!(all.is_empty(), touched, "{offset}: {all:?}");
        assert!(all.iter().all(|told| told.contains("nothing touches it")), "{all:?}");
    }
    // The lumped model has the depth at z = 0 alone.
    let (lumped, half) = (("simulation.model", "lumped"), half_length("lumped"));
    for (width, offset, words) in [
        (0.2, 0.0, Some("the ball sinks by it as a whole")),
        (0.2, 0.3, Some("this damage does not act")),
        (2.0 * half - 0.01, 0.0, Some("the ball sinks by it as a whole")),
        (2.0 * half + 0.01, 0.0, None),
    ] {
        let shape = format!("{{ rectangle = {{ length_mm = 0.4, width_mm = {width:?} }} }}");
        let all = warnings(&scenario(&[
            lumped,
            ("defects.0.shape", &shape),
            ("defects.0.axial_offset_mm", &format!("{offset:?}")),
        ]));
        assert_eq!(all.len(), usize::from(words.is_some()), "{all:?}");
        assert!(all.iter().zip(words).all(|(told, words)| told.contains(words)), "{all:?}");
    }
}

#[test]
fn analytic_a_ring_displaced_by_more_than_a_roller_is_said() {
    // Hundreds of N on a roller over 6 mm are 1e4 N/m and more; the support is to carry none of it.
    let soft = [
        ("contact.inner_stiffness", "1e4"),
        ("contact.outer_stiffness", "1e5"),
        ("support.outer_stiffness_n_per_m", "0"),
        ("defects", "[]"),
    ];
    let all = warnings(&rectangle_with(&soft).scenario);
    assert!(
        all.iter()
            .any(|told| told.contains("contact.inner_stiffness") && told.contains("the roller's diameter of 6.00 mm")),
        "{all:?}"
    );
}

#[test]
fn analytic_a_preloaded_zone_is_a_full_turn() {
    let s = rectangle_with(&[("bearing.radial_clearance_um", "-10")]).scenario;
    let zone = static_load_zone(&Model::new(&s).unwrap()).unwrap();
    assert_eq!(zone.extent, std::f64::consts::TAU);
}

#[test]
fn prop_pressure_and_rating_are_held_against_the_load() {
    let nu206 = |load: &str| {
        let text = format!(
            "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 1500\nload_n = [0, {load}]\nload_on = \"inner-ring\"\n"
        );
        let s = read(&text, &[]).unwrap().scenario;
        let zone = static_load_zone(&Model::new(&s).unwrap()).unwrap();
        (pressures(&s, zone.heaviest()), warnings(&s))
    };
    let (quarter, none) = nu206("-9000");
    assert!(none.is_empty() && quarter[0] < STATIC_LIMIT, "{none:?}");
    assert!(quarter[0] > quarter[1], "the inner contact is the sharper one");
    let (over, told) = nu206("-80000");
    assert!(over[0] > STATIC_LIMIT);
    assert_eq!(told.len(), 3, "{told:#?}");
    // 80 kN less the inner ring's support on 5e7 N/m are 1.57 mm, of 23.25 mm.
    assert!(told[2].contains("sinks by 1566 um, 6.73 % of the pitch radius"), "{}", told[2]);
    assert!(told[0].contains("C0 = 36.5 kN (SKF"), "{}", told[0]);
    assert!(told[1].contains("at the inner raceway") && told[1].contains("4000 MPa"), "{}", told[1]);
    // Hertz: the pressure grows with the root of the force.
    let s = rectangle_with(&[]).scenario;
    let [one, four] = [100.0, 400.0].map(|force| pressures(&s, [force; 2])[0]);
    assert!((four / one - 2.0).abs() < 1e-12);
}

#[test]
fn regress_a_load_beyond_an_estimated_rating_is_said() {
    // ISO 76: 44 (1 - 6/49) 38 x 6 x 6 = 52.8 kN.
    let all = warnings(&rectangle_with(&[("operation.load_n", "[60000, 0]")]).scenario);
    let said = |words: &str| all.iter().any(|told| told.contains(words));
    assert!(said("C0 = 52.8 kN (estimated by the formula of ISO 76)"), "{all:#?}");
    silent(&[("operation.load_n", "[5000, 0]"), ("contact.roller_path", "envelope")]);
}

#[test]
fn prop_a_deep_step_over_the_whole_width_is_said_of_a_point_alone() {
    let whole = ("defects.0.shape", "{ rectangle = { length_mm = 3.0, width_mm = 6.0 } }");
    let deep = ("defects.0.depth_um", "100");
    let told = warning(&[whole, deep]);
    for words in ["100 um deep", "drops by the whole depth at once", "advised: \"envelope\""] {
        assert!(told.contains(words), "no {words} in {told}");
    }
    silent(&[whole, deep, ("contact.roller_path", "envelope")]);
    // What is left of the width carries the roller, and so does a floor that it reaches.
    silent(&[deep]);
    silent(&[whole, ("defects.0.depth_um", "5")]);
}

#[test]
fn analytic_pressure_beside_damage_is_that_of_the_length_left() {
    let s = rectangle_with(&[]).scenario;
    let model = Model::new(&s).unwrap();
    let (left, pressure) = pressure_beside(&model, &s, 0, [50.0; 2]).unwrap();
    assert!((left - 2e-3).abs() < 1e-12);
    // A third of the length carries all: the root of three times the pressure.
    let whole = pressures(&s, [50.0; 2])[1];
    assert!((pressure / whole - 3f64.sqrt()).abs() < 1e-9);
    for shape in [
        // Nothing is left.
        ("defects.0.shape", "{ rectangle = { length_mm = 3.0, width_mm = 6.0 } }"),
        // The roller is pressed down to the floor.
        ("defects.0.depth_um", "0.1"),
    ] {
        let s = rectangle_with(&[shape]).scenario;
        let model = Model::new(&s).unwrap();
        assert_eq!(pressure_beside(&model, &s, 0, [50.0; 2]), None);
    }
}

#[test]
fn prop_no_load_and_weight_left_out_are_said() {
    let told = warning(&[("operation.load_n", "[0, 0]"), ("defects", "[]")]);
    assert!(told.contains("neither load nor weight"), "{told}");
    silent(&[("operation.load_n", "[0, 0]"), ("operation.gravity_m_per_s2", "[0, -9.81]"), ("defects", "[]")]);
    // Rings, two cages and 38 rollers: 0.259 kg, 2.54 N.
    let soft = ("support.outer_stiffness_n_per_m", "1e4");
    let told = warning(&[("operation.load_n", "[10, 0]"), ("defects", "[]"), soft]);
    assert!(told.contains("weighs 2.54 N, 25 % of the load"), "{told}");
    silent(&[("operation.load_n", "[26, 0]"), ("defects", "[]"), soft]);
}

#[test]
fn analytic_what_the_support_carries_is_said() {
    // 1e6 N/m over the clearance of 10 um, a little more between two rollers, and deformations of about 1 um.
    let told = warning(&[("operation.load_n", "[50, 0]"), ("defects", "[]")]);
    let carried: f64 = told.split("the support carries ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((10.0..12.0).contains(&carried), "{told}");
    assert!(told.contains(&format!("of the 50.0 N on its ring, and the bearing {:.1} N", 50.0 - carried)), "{told}");
    // Less than a tenth.
    silent(&[("operation.load_n", "[200, 0]"), ("defects", "[]")]);
}

#[test]
fn regress_a_sensor_on_a_fixed_ring_is_said() {
    let lumped = ("simulation.model", "lumped");
    let told = warning(&[lumped, ("operation.load_on", "inner-ring"), ("support.outer_stiffness_n_per_m", "0")]);
    assert!(told.contains("its acceleration is 0"), "{told}");
    silent(&[lumped]);
}

#[test]
fn analytic_weight_alone_is_held_against_the_support() {
    // 0.0791 kg: 0.776 N on the outer ring; the support takes 10 N before the clearance is closed.
    let loaded = rectangle_with(&[("operation.load_n", "[0, 0]"), ("operation.gravity_m_per_s2", "[0, -9.81]")]);
    let told: Vec<_> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("k C_r = 10 N against 0.776 N, the ring's weight included"), "{}", told[0]);
}

#[test]
fn analytic_a_floor_out_of_reach_is_said_with_the_depth_that_is_reached() {
    // On the outer raceway 1/R_eq = 1/3 - 1/27.5 per mm: a pit of length l lets the roller sink l^2/(8 R_eq).
    let radius = 1.0 / (1.0 / 3.0 - 1.0 / 27.5);
    for (length, depth) in [(5.0_f64, 2000.0), (0.5, 20.0), (1.0, 20.0), (3.0, 20.0)] {
        let reach = 1e3 * length * length / (8.0 * radius);
        let shape = format!("{{ rectangle = {{ length_mm = {length}, width_mm = 5.0 }} }}");
        let depth_um = depth.to_string();
        let settings = [("defects.0.shape", shape.as_str()), ("defects.0.depth_um", depth_um.as_str())];
        if reach < 0.9 * depth {
            let told = warning(&settings);
            let figures = format!("sink {:.*} um", (2 - reach.log10().floor() as i32).max(0) as usize, reach);
            assert!(told.contains(&figures) && told.contains("\"envelope\""), "{told} {figures}");
            silent(&[settings[0], settings[1], ("contact.roller_path", "envelope")]);
        } else {
            silent(&settings);
        }
    }
    // A roller's damage meets both raceways; the inner one lets it sink less far: R_eq = 2.63 mm there, so 47 against
    // 37 um.
    let on = [
        ("defects.0.on", "roller"),
        ("defects.0.roller", "1"),
        ("defects.0.shape", "{ rectangle = { length_mm = 1.0, width_mm = 4.0 } }"),
    ];
    silent(&on);
    let told = warning(&[on[0], on[1], on[2], ("defects.0.depth_um", "42")]);
    assert!(told.contains("at the outer raceway"), "{told}");
}

#[test]
fn analytic_a_run_must_outlast_its_start() {
    // A turn of the shaft is 1/30 s, of the cage 43/98 of the speed: 0.02 + 1/30 + 98/43/30 = 0.1293 s.
    let duration = |text: &'static str| [("simulation.duration_s", text)];
    silent(&duration("0.13"));
    let told = warning(&duration("0.129"));
    assert!(
        told.contains("too short to settle: the load's ramp of 0.0200 s") && told.contains("advised: >= 0.130 s"),
        "{told}"
    );
    warning(&duration("0.01"));
    // From the static balance there is no ramp.
    silent(&[("simulation.duration_s", "0.11"), ("simulation.start", "equilibrium")]);
    // A run-up to 1800 r/min in 0.4 s makes 6 turns.
    let up = ("operation.speed_rpm", "[[0, 0], [0.4, 1800]]");
    silent(&[up, ("simulation.duration_s", "0.4")]);
    warning(&[up, ("simulation.duration_s", "0.2")]);
    let down = ("operation.speed_rpm", "[[0, 0], [0.4, -1800]]");
    silent(&[down, ("simulation.duration_s", "0.4")]);
}

#[test]
fn prop_energy_from_nowhere_is_said_with_what_conserves_it() {
    // 0.06 s of the pit that a review found: 2 mm deep over the whole width, 5 mm long.
    let pit = [
        ("defects.0.shape", "{ rectangle = { length_mm = 5.0, width_mm = 6.0 } }"),
        ("defects.0.depth_um", "2000"),
        ("simulation.duration_s", "0.06"),
    ];
    let s = rectangle_with(&pit).scenario;
    let (_, outcome) = simulate(&s);
    let told = of_energy(&s, &outcome.energy, None);
    assert_eq!(told.len(), 1, "{told:?}");
    for words in [
        "parametric work",
        "energy error of the paper's contact law",
        "it is spurious: levels are unreliable, frequencies are fine",
        "simulation.laws = \"mechanics\" has no such error",
    ] {
        assert!(told[0].contains(words), "no {words} in {}", told[0]);
    }
    // The set that it names has none.
    let conserving = [pit[0], pit[1], pit[2], ("simulation.laws", "mechanics")];
    let s = rectangle_with(&conserving).scenario;
    let (_, outcome) = simulate(&s);
    assert_eq!(outcome.energy.parametric, 0.0);
    assert!(of_energy(&s, &outcome.energy, None).is_empty());
    // A healthy bearing has none either.
    let s = rectangle_with(&[("defects", "[]"), ("simulation.duration_s", "0.02")]).scenario;
    let (_, outcome) = simulate(&s);
    assert!(of_energy(&s, &outcome.energy, None).is_empty());
}

#[test]
fn regress_an_audit_that_does_not_close_is_said() {
    let s = rectangle_with(&[]).scenario;
    let mut energy = EnergyAudit::default();
    energy.flows.load = 1.0;
    energy.parametric = -0.985;
    // Nothing holds what flowed in but the parametric work: 15 mJ of 1.985 J are missing.
    let told = |s: &Scenario, energy: EnergyAudit| of_energy(s, &energy, None).join("\n");
    assert!(!told(&s, energy).contains("audit"), "0.8 % is no word");
    energy.parametric = -0.95;
    let words = "the energy balance error is 2.6 %";
    assert!(told(&s, energy).contains(words), "{}", told(&s, energy));
    assert!(told(&s, energy).contains("raise simulation.accuracy to \"reference\""));
    let mut tight = s.clone();
    tight.simulation.accuracy = brinell::scenario::Accuracy::Reference;
    assert!(told(&tight, energy).contains("\"reference\" already"));
}

/// Round-off over round-off was "closes to 100 %".
#[test]
fn regress_an_audit_of_a_run_in_which_nothing_flows_is_closed() {
    let text = "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 0.01\nload_n = [0, 0]\n[friction]\nraceway_coefficient = 0\n\
        [contact]\ndamping_ns_per_m = 0\n[simulation]\nlaws = \"li2023\"\nduration_s = 0.05\nstart = \"equilibrium\"\n";
    let s = Scenario::from_toml(text).unwrap();
    let (_, outcome) = simulate(&s);
    let mut energy = outcome.energy;
    let held = energy.last.total();
    assert!(held > 0.0 && energy.turnover() < 1e-12 * held, "{energy:?}");
    assert!(of_energy(&s, &energy, None).is_empty(), "{:?}", of_energy(&s, &energy, None));
    // More than flowed, by far, and less than a sum of what is held is exact to.
    energy.last.kinetic += 1e-14 * held;
    assert!(of_energy(&s, &energy, None).is_empty(), "{:?}", of_energy(&s, &energy, None));
    // Energy from nowhere is no round-off.
    energy.last.kinetic += 1e-6 * held;
    assert!(of_energy(&s, &energy, None).join("\n").contains("the energy balance error is"));
}

#[test]
fn analytic_a_fifth_of_the_dissipation_is_the_limit_in_both_directions() {
    let s = rectangle_with(&[]).scenario;
    let mut energy = EnergyAudit::default();
    energy.flows.contact = 4.0;
    for (work, words) in [
        (0.799, None),
        (-0.799, None),
        (0.801, Some("put into the bearing 801 mJ, 20 % of the 4.00 J")),
        (-0.92, Some("took out of the bearing 920 mJ, 23 % of the 4.00 J")),
        (80.0, Some("80.0 J, 20 times the 4.00 J")),
    ] {
        energy.parametric = work;
        // The audit closes.
        energy.flows.load = 4.0 - work;
        let told = of_energy(&s, &energy, None).join("\n");
        match words {
            Some(words) => assert!(told.contains(words), "{work}: {told}"),
            None => assert_eq!(told, "", "{work}"),
        }
    }
    let mut lumped = s.clone();
    lumped.simulation.model = brinell::scenario::ModelKind::Lumped;
    energy.parametric = 1.0;
    energy.flows.load = 3.0;
    let told = of_energy(&lumped, &energy, None).join("\n");
    assert!(told.contains("parametric work") && !told.contains("mechanics"), "{told}");
}
