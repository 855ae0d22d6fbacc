//! One roller on its way over a defect.

use crate::chart::{Chart, Domain, panels, range};
use crate::data::Pass;
use crate::layout::{Layout, legend};
use crate::picture::{Paint, Picture, ink};
use brinell::observe::passes::PassPoint;

/// Contact length, stiffness and force of one roller over its angle from the defect's centre.
pub(crate) fn pass(pass: &Pass, index: usize, layout: Layout) -> Picture {
    let size = layout.size(0.0);
    let paint = Paint::line(ink::BLUE, 1.8);
    let contact = if pass.contact.is_empty() { "this contact" } else { &pass.contact };
    let part = if layout.roomy() { 130.0 } else { 120.0 };
    let values = |of: fn(&PassPoint) -> f64| pass.points.iter().map(of).collect::<Vec<f64>>();
    let angles = values(|p| p.angle.to_degrees());
    let (lo, hi) = range(angles.iter().copied()).unwrap_or((-1.0, 1.0));
    let curves = [
        ("Contact length", "mm", values(|p| 1e3 * p.length)),
        ("Stiffness", &*pass.stiffness_unit, values(|p| p.stiffness)),
        ("Force", "N", values(|p| p.force)),
    ];
    let ys = curves.iter().map(|(label, unit, curve)| {
        (Domain::from_zero(curve.iter().copied()), (*label).to_owned(), (*unit).to_owned())
    });
    let x = (Domain::exact(lo, hi), "Angle from the defect’s centre", "°");
    let specs = panels(size, part, x, ys);
    let left = specs[0].left;
    let total = 3.0 * part + 3.4 * size.font + 1.9 * size.font;
    let name = format!("pass-{}", index + 1);
    let mut picture = Picture::new(&name, &pass.title, size.width, total);
    let mut top = legend(&mut picture, &[(contact, paint)], left, size.width, 2.0, size.font);
    for (spec, (_, _, curve)) in specs.into_iter().zip(&curves) {
        let height = spec.size.height;
        let mut chart = Chart::new(spec);
        if range(curve.iter().copied()).is_none() {
            chart.say("Not recorded");
        }
        chart.of(contact);
        chart.points(&angles, curve, paint);
        picture.place(chart.finish(), 0.0, top);
        top += height;
    }
    picture
}
