//! Pressures over a defect by the half-space (section 19), where they are largest while a contact passes it.

use super::passage::contact;
use crate::PressureView;
use crate::number::short;
use brinell::defect::Side;
use brinell::half_space::{healthy_pressure, pressure_over};
use brinell::model::Model;
use brinell::pressure::yields_at;
use brinell::scenario::{Law, Scenario};

/// Of one defect, on each side that it meets with the deformation given, m. None under laws without pressures, and where the damage's
/// table is from elsewhere.
pub(super) fn pressures(
    (s, model, index): (&Scenario, &Model, usize),
    sides: &[(Side, f64)],
    title: &str,
) -> Vec<PressureView> {
    if s.contact.law != Law::HalfSpace || s.defects[index].table.is_some() {
        return Vec::new();
    }
    let element = s.bearing.element.word();
    let yields = yields_at(&s.bearing);
    let of = |&(side, delta): &(Side, f64)| {
        let field = pressure_over((&model.defects, index), (&s.bearing, &s.contact), side, delta)?;
        let share = field.share_above(yields);
        let on = if sides.len() > 1 { format!(" of the {}", contact(side)) } else { String::new() };
        let view = PressureView {
            title: format!(
                "{title}. Pressure{on} where it is largest: {element} at s = {} mm, pressed by {} µm; axes not to one scale",
                short(1e3 * field.middle, 3).replace('-', "−"),
                short(1e6 * delta, 3)
            ),
            contact: side.word().into(),
            start_mm: field.first.map(|x| 1e3 * x),
            step_mm: field.size.map(|x| 1e3 * x),
            columns: field.cells[0],
            pressure_mpa: field.pressure.iter().map(|p| 1e-6 * p).collect(),
            largest_mpa: 1e-6 * field.largest,
            at_mm: field.at.map(|x| 1e3 * x),
            middle_mm: 1e3 * field.middle,
            deformation_um: 1e6 * delta,
            force_n: field.force,
            healthy_mpa: 1e-6 * healthy_pressure((&s.bearing, &s.contact), side, delta)?,
            yield_mpa: 1e-6 * yields,
            share_beyond_yield: share,
            note: String::new(),
        };
        let note = note(&view, s);
        Some(PressureView { note, ..view })
    };
    sides.iter().filter_map(of).collect()
}

fn note(of: &PressureView, s: &Scenario) -> String {
    let beyond = match of.share_beyond_yield {
        0.0 => "nowhere reached".to_owned(),
        share => format!(
            "exceeded on {} % of the pressed area, where steel would yield and press less",
            short(100.0 * share, 2)
        ),
    };
    let (form, ends) = match s.bearing.has_balls() {
        true => ("1.6 Y in a circle", ""),
        false => ("1.8 Y in line contact", " and a straight roller's ends"),
    };
    format!(
        "largest {} MPa at s = {} mm, z = {} mm, with the {} contact held at the static deformation of {} µm ({} N; healthy {} MPa). Elastic; \
         at sharp edges{ends} it grows as cells shrink, so it is of this grid: cells of {} by {} µm, edges rounded over {} µm \
         (contact.edge_radius_um). Bearing steel begins to yield, below the surface, where a smooth contact's largest pressure is {} MPa ({form}, \
         Y = 1.9 GPa assumed): {beyond}",
        short(of.largest_mpa, 3),
        short(of.at_mm[0], 3),
        short(of.at_mm[1], 3),
        of.contact,
        short(of.deformation_um, 3),
        short(of.force_n, 3),
        short(of.healthy_mpa, 3),
        short(1e3 * of.step_mm[0], 2),
        short(1e3 * of.step_mm[1], 2),
        short(s.contact.edge_radius_um, 3),
        short(of.yield_mpa, 3),
    )
}
