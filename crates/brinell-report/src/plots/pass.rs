//! One roller on its way over a defect.

use super::layout::{Layout, legend};
use crate::chart::{Chart, Domain, Size, Spec, left_margin, range};
use crate::data::Pass;
use crate::picture::{Paint, Picture, ink};

/// Contact length, stiffness and force of one roller over its angle from the defect's centre.
pub(crate) fn pass(pass: &Pass, index: usize, layout: Layout) -> Picture {
    let size = layout.size(0.0);
    let paint = Paint::line(ink::BLUE, 1.8);
    let contact = if pass.contact.is_empty() { "this contact" } else { &pass.contact };
    let specs = specs(pass, layout);
    let left = specs[0].left;
    let total = 3.0 * part(layout) + 3.4 * size.font + 1.9 * size.font;
    let name = format!("pass-{}", index + 1);
    let mut picture = Picture::new(&name, &pass.title, size.width, total);
    let mut top = legend(&mut picture, &[(contact, paint)], left, size.width, 2.0, size.font);
    let curves = [&pass.length_mm, &pass.stiffness, &pass.force_n];
    for (spec, curve) in specs.into_iter().zip(curves) {
        let height = spec.size.height;
        let mut chart = Chart::new(spec);
        if range(curve.iter().copied()).is_none() || pass.angle_deg.is_empty() {
            chart.say("Not recorded");
        }
        chart.of(contact);
        chart.points(&pass.angle_deg, curve, paint);
        picture.place(chart.finish(), 0.0, top);
        top += height;
    }
    picture
}

/// Height of a panel, px.
fn part(layout: Layout) -> f64 {
    if layout.roomy() { 130.0 } else { 120.0 }
}

/// The panels of length, stiffness and force, one above the other on one axis.
fn specs(pass: &Pass, layout: Layout) -> [Spec; 3] {
    let size = layout.size(0.0);
    let part = part(layout);
    let (lo, hi) = range(pass.angle_deg.iter().copied()).unwrap_or((-1.0, 1.0));
    let panel = |y_label: &str, unit: &str, y: Domain, last: bool| Spec {
        x_axis: last,
        ..Spec::new(
            "",
            "",
            Size { height: part + if last { 3.4 * size.font } else { 0.0 }, ..size },
            (Domain::exact(lo, hi), "Angle from the defect’s centre", "°"),
            (y, y_label, unit),
        )
    };
    let mut specs = [
        panel("Contact length", "mm", Domain::from_zero(pass.length_mm.iter().copied()), false),
        panel("Stiffness", &pass.stiffness_unit, Domain::from_zero(pass.stiffness.iter().copied()), false),
        panel("Force", "N", Domain::from_zero(pass.force_n.iter().copied()), true),
    ];
    let left = specs.iter().map(left_margin).fold(0.0, f64::max);
    specs.iter_mut().for_each(|spec| spec.left = left);
    specs
}
