//! A bearing and its damage in code, and the page of its run:
//!
//!     cargo run --release -p brinell-report --example page -- report.html

use brinell::plausibility::Beforehand;
use brinell::result::Parts;
use brinell::scenario::{Defect, Scenario, Shape, Surface};
use brinell_report::{Page, html};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut scenario = Scenario::of_bearing("NU206", 1800.0, [500.0, 0.0])?;
    scenario.defects.push(Defect {
        on: Surface::OuterRaceway,
        row: 1,
        center_deg: 0.0,
        depth_um: 20.0,
        axial_offset_mm: 0.0,
        shape: Shape::Rectangle { length_mm: 2.0, width_mm: 4.0 },
        table: None,
    });
    let result = brinell::simulate(&scenario)?;

    let loaded = &brinell::document::read(&scenario.to_toml(), &[]).map_err(brinell::Error::from)?;
    let (simulation, outcome, findings) = (&result.simulation, &result.outcome, &result.findings);
    let beforehand = &Beforehand::of(&scenario, simulation.model());
    let parts = Parts { loaded, simulation, outcome, findings, beforehand, healthy: None };
    let page = Page::of_run(&parts, &[], None);
    std::fs::write(std::env::args().nth(1).as_deref().unwrap_or("report.html"), html(&page))?;
    Ok(())
}
