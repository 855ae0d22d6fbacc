//! One roller on its way over a defect.

use super::layout::{Layout, legend};
use crate::chart::{Chart, Domain, Size, Spec, left_margin, range};
use crate::data::Pass;
use crate::picture::{Paint, Picture, ink};

/// Contact length, stiffness and force of one roller over its angle from the defect's centre.
pub(crate) fn pass(pass: &Pass, index: usize, layout: Layout) -> Picture {
    let size = layout.size(0.0);
    let other = pass.other_length_mm.as_deref();
    let second = Paint::line(ink::ORANGE, 1.8).dashed(&[6.0, 3.0]);
    let first = Paint::line(ink::BLUE, 1.8);
    let or = |name: &str, fallback: &str| {
        if name.is_empty() { fallback.to_owned() } else { name.to_owned() }
    };
    let specs = specs(pass, layout);
    let left = specs[0].left;
    let total = 3.0 * part(layout) + 3.4 * size.font + 1.9 * size.font;
    let name = format!("pass-{}", index + 1);
    let mut picture = Picture::new(&name, &pass.title, size.width, total);
    let mut entries = vec![];
    let names = (or(&pass.contact, "this contact"), or(&pass.other_contact, "other contact"));
    entries.push((names.0.as_str(), first));
    if other.is_some() {
        entries.push((names.1.as_str(), second));
    }
    let mut top = legend(&mut picture, &entries, left, size.width, 2.0, size.font);
    let curves = [&pass.length_mm, &pass.stiffness, &pass.force_n];
    for (index, (spec, curve)) in specs.into_iter().zip(curves).enumerate() {
        let height = spec.size.height;
        let mut chart = Chart::new(spec);
        if range(curve.iter().copied()).is_none() || pass.angle_deg.is_empty() {
            chart.say("Not recorded");
        }
        if let (0, Some(other)) = (index, other) {
            chart.of(&names.1);
            chart.points(&pass.angle_deg, other, second);
        }
        chart.of(&names.0);
        chart.points(&pass.angle_deg, curve, first);
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
    let other = pass.other_length_mm.as_deref().unwrap_or(&[]);
    let x = {
        let (lo, hi) = range(pass.angle_deg.iter().copied()).unwrap_or((-1.0, 1.0));
        Domain::exact(lo, hi)
    };
    let panel = |y_label: &str, unit: &str, y: Domain, last: bool| Spec {
        name: String::new(),
        title: String::new(),
        size: Size { height: part + if last { 3.4 * size.font } else { 0.0 }, ..size },
        x,
        y,
        x_label: "Angle from the defect’s centre".into(),
        x_unit: "°".into(),
        y_label: y_label.into(),
        y_unit: unit.into(),
        lanes: vec![],
        left: 0.0,
        right: 0.0,
        x_axis: last,
    };
    let lengths = pass.length_mm.iter().chain(other).copied();
    let mut specs = [
        panel("Contact length", "mm", Domain::from_zero(lengths), false),
        panel("Stiffness", &pass.stiffness_unit, Domain::from_zero(pass.stiffness.iter().copied()), false),
        panel("Force", "N", Domain::from_zero(pass.force_n.iter().copied()), true),
    ];
    let left = specs.iter().map(left_margin).fold(0.0, f64::max);
    specs.iter_mut().for_each(|spec| spec.left = left);
    specs
}
