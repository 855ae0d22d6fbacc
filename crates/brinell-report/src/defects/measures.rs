//! A defect's numbers, and what to say of them.

use crate::Fact;
use crate::number::short;
use brinell::defect::{Defect, Shape};
use brinell::scenario::Bearing;

/// One defect's numbers; lengths in mm, depths in um.
#[derive(Debug, Clone, Copy)]
pub struct Measures {
    /// Along the rolling direction.
    pub length_mm: f64,
    /// Its angle on the damaged surface.
    pub arc_deg: f64,
    /// Largest damaged length of the contact line, L_s.
    pub widest_mm: f64,
    /// Seen from above.
    pub area_mm2: f64,
    /// Volume over area.
    pub mean_depth_um: f64,
    /// Its deepest point.
    pub deepest_um: f64,
    /// Height of its highest raised edge.
    pub raised_um: f64,
    /// Time that the line of contact takes to pass it.
    pub pass_ms: f64,
    /// Shaft speed of that: the largest.
    pub speed_rpm: f64,
    /// Its arc over the static load zone of the healthy bearing; none of a roller's damage.
    pub load_zone_share: Option<f64>,
    /// Elastic deformation of the heaviest static contact, or 10 um where there is no static balance.
    pub approach_um: f64,
    /// Force of that contact.
    pub force_n: Option<f64>,
}

/// s over the arc at equal distances, a hair inside its ends.
fn along(shape: &Shape, points: usize) -> impl Iterator<Item = f64> + use<> {
    let (first, last) = shape.arc();
    let inset = 1e-9 * (last - first);
    (0..points).map(move |k| {
        let share = k as f64 / (points - 1) as f64;
        first + inset + (last - first - 2.0 * inset) * share
    })
}

pub(super) fn widest(defect: &Defect) -> f64 {
    along(&defect.shape, 20_001).map(|s| defect.damaged_length(s)).fold(0.0, f64::max)
}

/// Deepest point and height of the highest raised edge, m.
pub(super) fn deepest(defect: &Defect) -> (f64, f64) {
    let own = match &defect.shape {
        Shape::DepthMap(grid) => grid.extremes().0,
        shape => along(shape, 20_001).map(|s| shape.own_depth(s).unwrap_or(defect.depth)).fold(0.0, f64::max),
    };
    (own, defect.shape.raised())
}

pub(super) fn facts(m: &Measures, bearing: &Bearing) -> Vec<Fact> {
    let fact = |label: &str, value: f64, digits: usize, unit: &str, note: String| {
        Fact::new(label, short(value, digits), unit, note)
    };
    let none = String::new;
    let (element, contact) = match bearing.has_balls() {
        true => ("ball", "contact"),
        false => ("roller", "line of contact"),
    };
    let deformation = short(m.approach_um, 3);
    let floor = if m.deepest_um > m.approach_um {
        format!(
            "deeper than the healthy bearing's heaviest static contact deforms, {deformation} µm: between raceways that stand still the {element} \
             carries nothing at the bottom; over a long defect the rings follow, and it can"
        )
    } else {
        format!(
            "less than the healthy bearing's heaviest static contact deforms, {deformation} µm: the bottom carries load too"
        )
    };
    let mut facts = vec![
        fact("Length", m.length_mm, 4, "mm", "along the rolling direction".into()),
        fact("Arc", m.arc_deg, 4, "°", "of the damaged surface".into()),
        fact(
            "Widest",
            m.widest_mm,
            4,
            "mm",
            format!(
                "largest L_s; the {}",
                match bearing.has_balls() {
                    true => format!("ball is {} mm thick", short(bearing.roller_diameter_mm, 4)),
                    false => format!("roller is {} mm long", short(bearing.roller_length_mm, 4)),
                }
            ),
        ),
        fact("Area", m.area_mm2, 4, "mm^2", none()),
        fact("Mean depth", m.mean_depth_um, 4, "µm", "volume over area".into()),
        fact("Deepest", m.deepest_um, 4, "µm", floor),
        fact("Time to pass", m.pass_ms, 4, "ms", format!("of the {contact}, at {} r/min", short(m.speed_rpm, 4))),
    ];
    if m.raised_um > 0.0 {
        facts.push(fact("Raised edge", m.raised_um, 4, "µm", "felt by the law \"sliced\"".into()));
    }
    if let Some(share) = m.load_zone_share {
        facts.push(fact(
            "Share of the load zone",
            100.0 * share,
            3,
            "%",
            "arc over the static load zone of the healthy bearing".into(),
        ));
    }
    facts
}
