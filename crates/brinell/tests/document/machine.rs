//! Files of machines.

use super::{good, report};
use brinell::document::{machine_schema, read};
use brinell::scenario::Scenario;

const MOTOR: &str = include_str!("../../../../examples/motor.toml");

fn with(changes: &[(&str, &str)]) -> Result<brinell::document::Loaded, Vec<brinell::document::Problem>> {
    read(MOTOR, &changes.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect::<Vec<_>>())
}

#[test]
fn prop_a_machines_file_reads_back() {
    let loaded = good(MOTOR);
    let machine = loaded.scenario.machine.as_ref().unwrap();
    assert_eq!((machine.bearings(), machine.lead), (2, 0));
    assert_eq!(machine.others[0].bearing.preset.as_deref(), Some("6203"));
    let assumed = |of: &brinell::document::Loaded| {
        let mut keys: Vec<_> = of.provenance.iter().filter(|p| p.assumed).map(|p| p.key.clone()).collect();
        keys.sort();
        keys
    };
    let again = good(&loaded.to_toml());
    assert_eq!(again.scenario, loaded.scenario);
    assert_eq!(assumed(&again), assumed(&loaded));
    assert!(assumed(&loaded).contains(&"bearing.1.cage.mass_kg".into()));
    assert!(assumed(&loaded).contains(&"shaft.density_kg_per_m3".into()));
    assert_eq!(Scenario::from_toml(&loaded.scenario.to_toml()).unwrap(), loaded.scenario);
    assert_eq!(loaded.scenario.problems(), []);
}

#[test]
fn prop_the_bearing_that_is_observed_is_the_first_that_is_damaged() {
    let second = with(&[
        (
            "bearing.1.defects",
            "[{ on = \"inner-raceway\", center_deg = 0, depth_um = 5, shape = { circle = { diameter_mm = 1 } } }]",
        ),
        ("bearing.0.defects", "[]"),
    ]);
    let scenario = second.unwrap().scenario;
    let machine = scenario.machine.as_ref().unwrap();
    assert_eq!(machine.lead, 1);
    assert_eq!(scenario.bearing.preset.as_deref(), Some("6203"));
    let names: Vec<_> =
        machine.each(&scenario).map(|(seat, of)| (seat.at_mm, of.bearing.preset, of.defects.len())).collect();
    assert_eq!(names, [(50.0, Some("6205".into()), 0), (250.0, Some("6203".into()), 1)]);
    assert_eq!(scenario.shown_channel(), "housing1.fan_end");
}

#[test]
fn prop_sections_at_the_top_are_of_every_bearing_and_a_bearings_own_go_before_them() {
    let loaded = with(&[("friction.raceway_coefficient", "0.03"), ("bearing.1.friction.raceway_coefficient", "0.04")]);
    let scenario = loaded.unwrap_or_else(|problems| panic!("{}", report(&problems))).scenario;
    assert_eq!(scenario.friction.raceway_coefficient, 0.03);
    assert_eq!(scenario.machine.unwrap().others[0].friction.raceway_coefficient, 0.04);
}

#[test]
fn prop_problems_of_a_machine_name_the_key() {
    for (changes, key, words) in [
        (&[("bearing.1.at_mm", "310")][..], "bearing.1.at_mm", "beyond the shaft's ends"),
        (&[("shaft.load.0.at_mm", "-1")], "shaft.load.0.at_mm", "beyond the shaft's ends"),
        (&[("bearing.1.at_mm", "50")], "bearing.1.at_mm", "one place"),
        (&[("bearing.1.housing", "2")], "bearing.1.housing", "there are 1"),
        (&[("sensor.1.name", "drive_end")], "sensor.1.name", "two sensors of one name"),
        (&[("sensor.1.name", "a b")], "sensor.1.name", "letters, digits"),
        (&[("shaft.diameters_mm", "[25, 35]")], "shaft.diameters_mm", "2 diameters for 3 part(s)"),
        (&[("shaft.stations_mm", "[0, 70, 60, 300]")], "shaft.stations_mm", "must rise"),
        (&[("shaft.bores_mm", "[0, 40, 0]")], "shaft.bores_mm", "leaves no wall"),
        (&[("shaft.band_hz", "30000")], "shaft.band_hz", ""),
        (&[("operation.load_n", "[0, -100]")], "operation.load_n", "loads act on the shaft"),
        (&[("simulation.model", "lumped")], "simulation.model", "lumped"),
        (&[("bearing.1.preset", "6999")], "bearing.1.preset", "catalogue"),
        (&[("bearing.0.defects.0.depth_um", "-3")], "bearing.0.defects.0.depth_um", ""),
        (&[("bearing.0.cage.mass_kg", "0")], "bearing.0.cage.mass_kg", ""),
        (&[("bearing.0.atmm", "3")], "bearing.0.atmm", "unknown key"),
        (&[("shaft.wobble", "3")], "shaft.wobble", "unknown key"),
        (&[("housing.0.mass_kg", "0")], "housing.0.mass_kg", ""),
        (&[("operation.speed_rpm", "0")], "operation.speed_rpm", "must turn"),
    ] {
        let problems = with(changes).expect_err(key);
        let found = problems.iter().find(|problem| problem.key == key);
        let found = found.unwrap_or_else(|| panic!("{key}: {}", report(&problems)));
        assert!(found.message.contains(words), "{key}: {}", found.message);
    }
    // One bearing without anything else, and a bearing that is no list.
    let (one, _) = MOTOR.split_once("[[bearing]]                          # fan end").unwrap();
    let rest = "[operation]\nspeed_rpm = 1772.0\n";
    let problems = read(&format!("{one}{rest}"), &[]).unwrap_err();
    assert!(problems.iter().any(|p| p.key == "bearing" && p.message.contains("pendulum")), "{}", report(&problems));
    let single = format!("[shaft]\nstations_mm = [0, 1]\ndiameters_mm = [20]\n[bearing]\npreset = \"6205\"\n{rest}");
    let problems = read(&single, &[]).unwrap_err();
    assert!(problems.iter().any(|p| p.key == "bearing" && p.line == Some(4)), "{}", report(&problems));
}

#[test]
fn prop_the_schema_of_machines_has_every_key_of_a_written_one() {
    let schema = machine_schema();
    let written: toml::Table = good(MOTOR).scenario.to_toml().parse().unwrap();
    fn holds(schema: &serde_json::Value, value: &toml::Value, path: &str) {
        match value {
            toml::Value::Table(table) if schema["properties"].is_object() => {
                for (name, inner) in table {
                    let of = &schema["properties"][name];
                    assert!(of.is_object(), "{path}.{name} is not in the schema");
                    holds(of, inner, &format!("{path}.{name}"));
                }
            }
            toml::Value::Array(items) if schema["items"]["properties"].is_object() => {
                items.iter().for_each(|item| holds(&schema["items"], item, path));
            }
            _ => {}
        }
    }
    holds(&schema, &toml::Value::Table(written), "");
}

/// Two masses on springs, upright: by matrices, by modes and by a file of these.
#[test]
fn analytic_a_housing_by_matrices_is_one_by_its_modes() {
    let bare = |housing: &str| {
        let (before, rest) = MOTOR.split_once("[[housing]]").unwrap();
        let (_, after) = rest.split_once("[[sensor]]").unwrap();
        format!("{before}[[housing]]\n{housing}\n[[sensor]]{after}")
    };
    // x1, y1, x2, y2 and the two sensors, which move with what they sit on as light masses on stiff springs.
    let mut mass = [[0.0; 6]; 6];
    let mut stiffness = [[0.0; 6]; 6];
    for k in 0..4 {
        (mass[k][k], stiffness[k][k]) = (6.0, 2e7);
    }
    for (sensor, seat) in [(4, 1), (5, 3)] {
        mass[sensor][sensor] = 0.01;
        for (i, j, sign) in [(sensor, sensor, 1.0), (seat, seat, 1.0), (sensor, seat, -1.0), (seat, sensor, -1.0)] {
            stiffness[i][j] += sign * 1e7;
        }
    }
    let by = format!("mass_matrix_kg = {mass:?}\nstiffness_matrix_n_per_m = {stiffness:?}\ndamping_ratio = 0.03");
    let loaded = good(&bare(&by));
    assert_eq!(good(&loaded.to_toml()).scenario, loaded.scenario);
    let housing = &loaded.scenario.machine.as_ref().unwrap().housings[0];
    assert!(!housing.is_rigid() && housing.mass_kg == 0.0);
    // Of the seats the frequency is that of 6 kg on 2e7 N/m, but for the sensors' 10 g.
    let simulation = brinell::simulate::Simulation::new(&loaded.scenario).unwrap();
    assert!(simulation.channels().iter().any(|channel| channel.name == "housing1.fan_end"));
    let modes = "modes = [{ frequency_hz = 290.6, damping_ratio = 0.03, seats = [[0.0, 0.408], [0.0, 0.0]], sensors = [0.408, 0.0] }]";
    let loaded = good(&bare(modes));
    assert_eq!(good(&loaded.to_toml()).scenario, loaded.scenario);
    assert!(brinell::simulate::Simulation::new(&loaded.scenario).is_ok());
    for (housing, words) in [
        (
            "modes = [{ frequency_hz = 290.6, damping_ratio = 0.03, seats = [[0.0, 0.4]], sensors = [0.4, 0.0] }]",
            "1 seats",
        ),
        (
            "modes = [{ frequency_hz = 30000, damping_ratio = 0.03, seats = [[0.0, 0.4], [0, 0]], sensors = [0.4, 0.0] }]",
            "",
        ),
        (
            "modes = [{ frequency_hz = 300, seats = [[0.0, 0.4], [0, 0]], sensors = [0.4, 0.0] }]",
            "missing: `damping_ratio`",
        ),
        ("modes = []", "expected"),
        ("mass_matrix_kg = [[1.0]]\nstiffness_matrix_n_per_m = [[1.0]]", "1 coordinates"),
        ("mass_matrix_kg = [[1.0]]", "one matrix without the other"),
        (
            "mass_matrix_kg = [[1.0, 2.0], [0.0, 1.0]]\nstiffness_matrix_n_per_m = [[1.0, 0.0], [0.0, 1.0]]",
            "not symmetric",
        ),
        ("modes = \"m.csv\"\nmass_kg = 3", "has a meaning only where"),
    ] {
        let problems = read(&bare(housing), &[]).expect_err(housing);
        let found = problems.iter().any(|p| p.key.starts_with("housing.0") && p.message.contains(words));
        assert!(found, "{housing}: {}", report(&problems));
    }
}

#[test]
fn regress_modes_are_read_from_a_file_by_the_names_of_its_columns() {
    use brinell::scenario::HousingMode;
    let sensors = ["drive_end".to_owned()];
    let text = "# of a hammer test\ndrive_end,frequency_hz,damping_ratio,bearing2_x,bearing2_y\n0.3,290,0.02,0,0.4\n";
    let modes = HousingMode::from_csv_text(text, &[1], &sensors).unwrap();
    assert_eq!(
        modes,
        [HousingMode { frequency_hz: 290.0, damping_ratio: 0.02, seats: vec![[0.0, 0.4]], sensors: vec![0.3] }]
    );
    for (text, words) in [
        ("", "empty"),
        ("frequency_hz,damping_ratio\n1,2\n", "line 1: there is no column bearing2_x"),
        ("frequency_hz,damping_ratio,bearing2_x,bearing2_y,drive_end\n", "no mode"),
        ("frequency_hz,damping_ratio,bearing2_x,bearing2_y,drive_end\n1,2,3,x,5\n", "line 2: bearing2_y is \"x\""),
    ] {
        let error = HousingMode::from_csv_text(text, &[1], &sensors).unwrap_err();
        assert!(error.contains(words), "{error}");
    }
}

/// A rigid shaft on two damaged bearings is one of them under half the load, damage tables and all.
#[test]
fn analytic_damage_in_a_machine_is_that_of_one_bearing_under_its_share() {
    const DAMAGE: &str = "on = \"outer-raceway\"\ncenter_deg = -90\ndepth_um = 15\nshape = { rectangle = { length_mm = 1, width_mm = 3 } }\n";
    const SUPPORT: &str = "outer_stiffness_n_per_m = 5e7\nouter_damping_ns_per_m = 500\n";
    let (shaft_kg, load) = (std::f64::consts::PI / 4.0 * 0.03_f64.powi(2) * 0.2 * 7850.0, 6000.0);
    let run = "[simulation]\nduration_s = 0.012\nstart = \"equilibrium\"\n";
    let bearing = |at: f64| {
        format!(
            "[[bearing]]\npreset = \"6206\"\nat_mm = {at}\n[bearing.support]\n{SUPPORT}[[bearing.defects]]\n{DAMAGE}"
        )
    };
    let two = format!(
        "[shaft]\nstations_mm = [0, 200]\ndiameters_mm = [30]\ndensity_kg_per_m3 = 7850\nrigid = true\n[[shaft.load]]\nat_mm = 100\nforce_n = [0, -{load}]\n{}{}[operation]\nspeed_rpm = 1500\n{run}record = [\"bearing*.outer_ay\"]\n",
        bearing(40.0),
        bearing(160.0)
    );
    let own = good("[bearing]\npreset = \"6206\"\n[operation]\nspeed_rpm = 1500\nload_n = [0, -1]\n")
        .scenario
        .bearing
        .inner_ring_mass_kg;
    let one = format!(
        "[bearing]\npreset = \"6206\"\ninner_ring_mass_kg = {}\n[support]\ninner_stiffness_n_per_m = 0\ninner_damping_ns_per_m = 0\n{SUPPORT}[housing]\nmass_kg = 0\n[[defects]]\n{DAMAGE}[operation]\nspeed_rpm = 1500\nload_n = [0, -{}]\nload_on = \"inner-ring\"\n{run}record = [\"outer_ay\"]\n",
        own + 0.5 * shaft_kg,
        0.5 * load
    );
    let signal = |text: &str, name: &str| {
        let (_, signals) = brinell::result::record(&good(text).scenario).unwrap();
        signals.get(name).unwrap().to_vec()
    };
    let alone = signal(&one, "outer_ay");
    let rms = (alone.iter().map(|a| a * a).sum::<f64>() / alone.len() as f64).sqrt();
    assert!(rms > 10.0, "{rms}");
    for name in ["bearing1.outer_ay", "bearing2.outer_ay"] {
        let off = signal(&two, name).iter().zip(&alone).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / alone.len() as f64;
        // One pass; later impacts amplify what steps of two lengths leave.
        assert!(off.sqrt() < 1e-4 * rms, "{name}: {} of {rms}", off.sqrt());
    }
}

/// Balls beside rollers that tilt stay in the plane, and the file reads back.
#[test]
fn prop_a_ball_bearing_stands_beside_rollers_that_tilt() {
    let loaded = with(&[("bearing.1.preset", "NU205"), ("simulation.model", "tilting")]);
    let loaded = loaded.unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let models: Vec<_> = loaded.scenario.bearings().iter().map(|of| of.simulation.model).collect();
    assert_eq!(models, [brinell::scenario::ModelKind::Full, brinell::scenario::ModelKind::Tilting]);
    assert_eq!(good(&loaded.to_toml()).scenario, loaded.scenario);
    assert_eq!(loaded.scenario.problems(), []);
    assert!(brinell::simulate::Simulation::new(&loaded.scenario).is_ok());
}

/// A short thick shaft has no mode that a run could not follow in the bearings' own steps.
#[test]
fn prop_a_shaft_does_not_shorten_the_step() {
    let steps = |rigid: &str| {
        let text = format!(
            "[shaft]\nstations_mm = [0, 200]\ndiameters_mm = [30]\nrigid = {rigid}\n[[shaft.load]]\nat_mm = 100\nforce_n = [0, -1000]\n[[bearing]]\npreset = \"6206\"\nat_mm = 40\n[[bearing]]\npreset = \"6206\"\nat_mm = 160\n[operation]\nspeed_rpm = 1800\n[simulation]\nduration_s = 0.05\n"
        );
        let simulation = brinell::simulate::Simulation::new(&good(&text).scenario).unwrap();
        simulation.run(&mut ()).work.solver.steps
    };
    let [rigid, bends] = ["true", "false"].map(steps);
    assert!(bends < rigid + rigid / 20, "{bends} and {rigid} steps");
}

#[test]
fn prop_damage_is_where_the_shafts_load_is_if_nothing_else_is_said() {
    let without = MOTOR.replace("center_deg = -90.0\n", "");
    for (changes, degrees) in
        [(&[][..], -90.0), (&[("shaft.load.0.force_n", "[200, 0]")], 0.0), (&[("shaft.load", "[]")], -90.0)]
    {
        let changes: Vec<_> =
            changes.iter().map(|(key, value): &(&str, &str)| ((*key).into(), (*value).into())).collect();
        let scenario = read(&without, &changes).unwrap().scenario;
        assert!((scenario.defects[0].center_deg - degrees).abs() < 1e-9, "{}", scenario.defects[0].center_deg);
        assert_eq!(scenario.operation.load_n, [0.0; 2]);
    }
}
