//! An entry of `[[defects]]`: the one that is meant, and one as TOML.

use crate::failure::Failure;
use crate::say::{complain, document, one_line, say, twelve_digits};
use brinell::scenario::{self, Scenario};

/// The defect numbered from 1.
pub(super) fn chosen(s: &Scenario, number: usize) -> Result<&scenario::Defect, Failure> {
    let defect = number.checked_sub(1).and_then(|k| s.defects.get(k));
    defect.ok_or_else(|| {
        Failure::Usage(match s.defects.len() {
            0 => format!("{}: the scenario has no [[defects]]", one_line(&s.name)),
            n => format!("--defect {number}: {} has defects 1 to {n}", one_line(&s.name)),
        })
    })
}

/// One `[[defects]]` entry as TOML; what the scenario's checks say of it goes to standard error.
pub(super) fn print(s: &Scenario, mut defect: scenario::Defect, remarks: &[String]) {
    round(&mut defect);
    let alone = Scenario { defects: vec![defect], ..s.clone() };
    for problem in alone.problems() {
        if problem.to_string().contains("defects") {
            complain!("{problem}");
        }
    }
    print_entry(&alone, remarks);
}

/// Twelve digits of what was computed: the others are the round-off of sums and of changes of unit.
fn round(defect: &mut scenario::Defect) {
    let twelve = |x: &mut f64| *x = twelve_digits(*x);
    twelve(&mut defect.depth_um);
    twelve(&mut defect.center_deg);
    match &mut defect.shape {
        scenario::Shape::Rectangle { length_mm, width_mm } => {
            twelve(length_mm);
            twelve(width_mm);
        }
        scenario::Shape::Circle { diameter_mm } => twelve(diameter_mm),
        scenario::Shape::Profile { arc_mm, width_mm, depth_um } => {
            arc_mm.iter_mut().for_each(twelve);
            width_mm.iter_mut().for_each(twelve);
            depth_um.iter_mut().flatten().for_each(twelve);
        }
        scenario::Shape::Outline { polygons_mm } => {
            polygons_mm.iter_mut().flatten().flatten().for_each(twelve);
        }
        _ => {}
    }
}

pub(super) fn print_entry(alone: &Scenario, remarks: &[String]) {
    for remark in remarks {
        say!("# {remark}");
    }
    let text = alone.to_toml();
    let entry = text
        .lines()
        .skip_while(|line| *line != "[[defects]]")
        .enumerate()
        .take_while(|(k, line)| *k == 0 || !line.starts_with('['))
        .map(|(_, line)| line)
        .collect::<Vec<_>>()
        .join("\n");
    document(entry.trim_end());
}
