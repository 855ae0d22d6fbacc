//! Of a run's page, the contacts: a roller's pass over a defect, and forces around the bearing.

use crate::RowLoad;
use brinell::channel::stiffness_unit;
use brinell::observe::passes::{Pass, place};
use brinell::result::Parts;
use brinell::scenario::Element;
use brinell::statics::StaticLoadZone;

/// Points of a pass that are drawn.
const PASS_POINTS: usize = 600;
pub(super) fn pass(parts: &Parts, pass: &Pass) -> crate::Pass {
    let model = parts.simulation.model();
    let l = &model.layout;
    let stride = pass.points.len().div_ceil(PASS_POINTS).max(1);
    crate::Pass {
        title: format!(
            "{} {} of row {} over defect {} ({})",
            match model.element {
                Element::Roller => "Roller",
                Element::Ball => "Ball",
            },
            l.roller(pass.slot) + 1,
            l.row(pass.slot) + 1,
            pass.defect + 1,
            place(&model.defects[pass.defect])
        ),
        points: pass.points.iter().step_by(stride).copied().collect(),
        stiffness_unit: stiffness_unit(parts.loaded.scenario.contact.exponent).into(),
        contact: format!("{} contact", pass.side.word()),
    }
}

pub(super) fn load_distribution(parts: &Parts) -> Vec<RowLoad> {
    let statics: &[(usize, f64, f64, f64)] = match &parts.beforehand.statics {
        Ok(StaticLoadZone { points, .. }) => points,
        Err(_) => &[],
    };
    let rows = parts.findings.load_zone.rows.iter().enumerate();
    rows.map(|(row, load)| {
        let mut static_points: Vec<(f64, f64)> =
            statics.iter().filter(|p| p.0 == row).map(|p| (p.1.to_degrees(), p.3)).collect();
        static_points.sort_by(|a, b| a.0.total_cmp(&b.0));
        RowLoad {
            title: format!("Row {}, force at the outer contact", row + 1),
            mean_n: load.mean(),
            max_n: load.max.clone(),
            static_points,
        }
    })
    .collect()
}
