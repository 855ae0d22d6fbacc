//! Warnings about tables of files that are those of something else, and about what runs show.

use crate::common::{rectangle_with, warnings};
use brinell::plausibility::doubtful;
use brinell::scenario::{DefectTable, Scenario, TableData, TableValues};

/// The base under a half-space with a table whose contact sinks by up to 60 % within `half` mm of its middle and is known to `most` um,
/// out to `end` mm.
fn tabled(half: f64, end: f64, most: f64, settings: &[(&str, &str)]) -> Vec<String> {
    warnings(&with_table([half, end, most], settings))
}

fn with_table([half, end, most]: [f64; 3], settings: &[(&str, &str)]) -> Scenario {
    let mut loaded = rectangle_with(&[&[("simulation.laws", "mechanics")], settings].concat());
    let s_mm: Vec<f64> = (-40..=40).map(|k| f64::from(k) * end / 40.0).collect();
    let delta_um: Vec<f64> = (0..=12).map(|k| f64::from(k) / 12.0 * most).collect();
    let inside = |s: f64| (1.0 - (s / half).powi(2)).max(0.0).powi(2);
    let delta_eff_um =
        s_mm.iter().flat_map(|s| delta_um.iter().map(|delta| delta * (1.0 - 0.6 * inside(*s)))).collect();
    loaded.scenario.defects[0].table =
        Some(DefectTable::Read(TableData { s_mm, delta_um, values: TableValues::DeltaEffUm(delta_eff_um) }));
    assert_eq!(loaded.scenario.problems(), []);
    loaded.scenario
}

#[test]
fn prop_the_table_of_this_damage_and_load_earns_no_word() {
    assert_eq!(tabled(1.6, 2.5, 20.0, &[]), [""; 0]);
    for surface in ["inner-raceway", "roller"] {
        let on = [("defects.0.on", surface), ("defects.0.roller", "3"), ("defects.0.center_deg", "0")];
        let keys = if surface == "roller" { &on[..] } else { &on[..1] };
        assert_eq!(tabled(1.6, 2.5, 20.0, keys), [""; 0], "{surface}");
    }
}

#[test]
fn regress_a_table_of_other_damage_load_or_units_is_said() {
    let cases = [
        // Of damage 0.8 mm and 8 mm long.
        (0.4, 1.0, 20.0, "it ends at s = -1.00 and 1.00 mm, and the damage's shape lies at s = -1.50 to 1.50 mm"),
        (4.0, 5.0, 20.0, "from which contacts reach"),
        (0.5, 2.5, 20.0, "alone, and the damage's shape lies at s = -1.50 to 1.50 mm"),
        // 60 % of 60 um.
        (1.6, 2.5, 60.0, "by 35.4 um more than a healthy one, and the damage is 20.0 um deep"),
        // Of a load of a hundredth; in nm.
        (1.6, 2.5, 0.3, "its delta_um end at 0.300, and the heaviest contact deforms by"),
        (1.6, 2.5, 20e3, "its delta_um begin with"),
    ];
    for (half, end, most, words) in cases {
        let said = tabled(half, end, most, &[]);
        assert!(said.iter().all(|w| w.contains("defects.0.table")), "{said:#?}");
        assert!(said.iter().any(|w| w.contains(words)), "{words}: {said:#?}");
    }
}

/// Metres in place of millimetres, millimetres in place of micrometres: no table of this damage.
#[test]
fn regress_a_table_in_other_units_is_refused() {
    for (sizes, words) in [
        ([1.6e-3, 2.5e-3, 20.0], "its s_mm go over 5.000e-3 mm"),
        ([1.6, 2.5, 0.02], "its delta_um end at 2.000e-2 um"),
    ] {
        let error = brinell::simulate(&with_table(sizes, &[])).unwrap_err().to_string();
        assert!(error.contains("defects.0.table") && error.contains(words), "{error}");
    }
}

/// What a run of 0.2 s of the base under the default laws gives to doubt, changed by `settings` and `change`.
fn doubts(settings: &[(&str, &str)], change: impl Fn(&mut Scenario)) -> Vec<String> {
    let of = [&[("simulation.laws", "mechanics"), ("simulation.duration_s", "0.15")], settings].concat();
    let mut s = rectangle_with(&of).scenario;
    change(&mut s);
    let run = brinell::simulate(&s).unwrap();
    doubtful(&s, &run.simulation, &run.outcome, &run.findings)
}

#[test]
fn prop_a_cage_that_skids_under_load_is_said() {
    assert_eq!(doubts(&[("defects", "[]")], |_| {}), [""; 0]);
    // Stiff drag against hardly any friction.
    let skids = [
        ("defects", "[]"),
        ("friction.raceway_coefficient", "0.0005"),
        ("lubricant.drag_coefficient", "5"),
        ("lubricant.effective_density_kg_per_m3", "800"),
    ];
    let said = doubts(&skids, |_| {});
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(said[0].starts_with("skidding: the cage of row 1 turned at 1"), "{}", said[0]);
    // Nothing drives rollers that nothing presses.
    let idle = [skids[0], skids[1], skids[2], skids[3], ("operation.load_n", "[0, 0]"), ("operation.speed_rpm", "60")];
    assert_eq!(doubts(&idle, |_| {}), [""; 0]);
}

#[test]
fn prop_an_element_beneath_the_floor_of_its_damage_is_said() {
    // Half of delta within 1 mm, known to 0.3 um: contacts of 0.5 um sink by a quarter of one.
    let table = |s: &mut Scenario| {
        let s_mm: Vec<f64> = (-20..=20).map(|k| 0.1 * f64::from(k)).collect();
        let delta_um: Vec<f64> = (0..=6).map(|k| 0.05 * f64::from(k)).collect();
        let share = |s: f64| if s.abs() < 1.0 { 0.5 } else { 1.0 };
        let delta_eff_um = s_mm.iter().flat_map(|s| delta_um.iter().map(move |delta| share(*s) * delta)).collect();
        s.defects[0].table =
            Some(DefectTable::Read(TableData { s_mm, delta_um, values: TableValues::DeltaEffUm(delta_eff_um) }));
    };
    assert_eq!(doubts(&[("defects.0.depth_um", "20")], table), [""; 0]);
    let said = doubts(&[("defects.0.depth_um", "0.1")], table);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].starts_with("sunk too deep: at defect 1 contacts yielded by 0."), "{}", said[0]);
    assert!(
        said[0].contains("the damage is 0.100 um deep: its table ends at a deformation of 0.300 um"),
        "{}",
        said[0]
    );
}
