//! Curves of damage: the contact conditions during roller passage, and the ring's section under it.

use super::{DamageCurves, DamageView, heading};
use crate::chart::{self, Chart, Domain, range};
use crate::layout::{Layout, legend};
use crate::picture::{Paint, Picture, ink};

/// L_s, L_e, depth and stiffness over the angle of a roller that passes the damage.
pub fn damage_passage(view: &DamageView, index: usize, layout: Layout) -> Picture {
    let x = match view.half_turn_mm {
        Some(_) => format!("Angle on the {} from the defect’s centre", view.element()),
        None => "Angle from the defect’s centre".to_owned(),
    };
    stack(&format!("damage-{}-passage", index + 1), &view.title, (&x, "°"), &view.passage, layout)
}

/// Section properties along the damage.
pub fn damage_section(view: &DamageView, index: usize, layout: Layout) -> Picture {
    let x = ("Along the damage, from its centre", "mm");
    stack(&format!("damage-{}-section", index + 1), &view.title, x, &view.section, layout)
}

/// Profile, line load and pressure along a roller at rest.
pub fn load_along(along: &DamageCurves, layout: Layout) -> Picture {
    stack("along", &along.title, ("Along the roller, from its middle", "mm"), along, layout)
}

const LINES: [(&str, f64, &[f64]); 4] =
    [(ink::BLUE, 2.2, &[]), (ink::ORANGE, 2.0, &[7.0, 3.0]), (ink::GREEN, 1.6, &[]), (ink::PURPLE, 1.6, &[3.0, 3.0])];

/// Panels over one axis, each with its own legend where it holds several curves; `title` is the picture's where they
/// have none.
fn stack(name: &str, title: &str, (x_label, x_unit): (&str, &str), curves: &DamageCurves, layout: Layout) -> Picture {
    let DamageCurves { title: shown, along: xs, panels, .. } = curves;
    let size = layout.size(0.0);
    let part = if layout.roomy() { 118.0 } else { 112.0 };
    let (lo, hi) = range(xs.iter().copied()).unwrap_or((-1.0, 1.0));
    let ys = panels.iter().map(|panel| {
        let values = panel.curves.iter().flat_map(|c| c.values.iter().copied());
        let domain = if panel.from_zero { Domain::from_zero(values) } else { Domain::around(values) };
        (domain, panel.label.clone(), panel.unit.clone())
    });
    let specs = chart::panels(size, part, (Domain::exact(lo, hi), x_label, x_unit), ys);
    let left = specs.first().map_or(0.0, |spec| spec.left);
    let title = if shown.is_empty() { title } else { shown };
    let mut picture = Picture::new(name, title, size.width, 0.0);
    let mut top = heading(&mut picture, shown, left, size.width, size.font);
    for (spec, panel) in specs.into_iter().zip(panels) {
        let paint = |k: usize| {
            let (color, width, dash) = LINES[k % LINES.len()];
            Paint::line(color, width).dashed(dash)
        };
        let entries: Vec<(&str, Paint)> = panel
            .curves
            .iter()
            .enumerate()
            .map(|(k, c)| (c.name.as_str(), paint(k)))
            .filter(|(name, _)| !name.is_empty())
            .collect();
        if !entries.is_empty() {
            top += legend(&mut picture, &entries, left, size.width, top, size.font);
        }
        let height = spec.size.height;
        let mut chart = Chart::new(spec);
        if range(panel.curves.iter().flat_map(|c| c.values.iter().copied())).is_none() || xs.is_empty() {
            chart.say("Not computed");
        }
        for (k, curve) in panel.curves.iter().enumerate() {
            chart.of(&curve.name);
            chart.points(xs, &curve.values, paint(k));
        }
        picture.place(chart.finish(), 0.0, top);
        top += height;
    }
    picture.height = top.max(1.0);
    picture
}
