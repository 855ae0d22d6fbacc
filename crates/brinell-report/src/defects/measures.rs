//! A defect's numbers, and what to say of them.

use crate::Fact;
use crate::number::short;
use brinell::defect::{Defect, Shape};
use brinell::derived::Passing;
use brinell::scenario::{Law, Scenario, Surface};

/// One defect's numbers; lengths in mm, depths in um.
#[derive(Debug, Clone, Copy)]
pub struct Measures {
    /// Along s.
    pub length_mm: f64,
    /// Its angle on the damaged surface.
    pub arc_deg: f64,
    /// Along the axis, from the lowest to the highest z.
    pub width_mm: f64,
    /// Largest damaged length of the contact line, L_s; of a depth map what the surface between its nodes covers.
    pub widest_mm: f64,
    /// Seen from above; with the other numbers of a depth map of the surface between its nodes.
    pub area_mm2: f64,
    /// What L_s of the law `ecl` adds up to; another only of a depth map, whose nodes it counts.
    pub area_in_ecl_mm2: f64,
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

/// Largest L_s that the law `ecl` takes, m.
fn widest_in_ecl(defect: &Defect) -> f64 {
    along(&defect.shape, 20_001).map(|s| defect.damaged_length(s)).fold(0.0, f64::max)
}

/// Along which coordinate the length is, and which way it is passed.
fn passed(passing: Passing, defect: &Defect) -> String {
    let who = match defect.surface {
        Surface::Roller(_) => "both contacts pass".to_owned(),
        _ => format!("{}s pass", defect.element.word()),
    };
    let side = |plus: bool| if plus { "+s" } else { "-s" };
    let way = match passing {
        Passing::Never => return "along s, which runs counter-clockwise; the shaft stands still".into(),
        Passing::TowardsPlus => side(true).to_owned(),
        Passing::TowardsMinus => side(false).to_owned(),
        Passing::Both { plus_at_positive } => {
            format!("{} at positive, {} at negative speed", side(plus_at_positive), side(!plus_at_positive))
        }
    };
    format!("along s, which runs counter-clockwise; {who} towards {way}")
}

pub(super) fn facts(m: &Measures, s: &Scenario, defect: &Defect, passing: Passing) -> Vec<Fact> {
    let (bearing, law) = (&s.bearing, s.contact.law);
    let fact = |label: &str, value: f64, digits: usize, unit: &str, note: String| {
        Fact::new(label, short(value, digits), unit, note)
    };
    let (element, contact) = match bearing.has_balls() {
        true => ("ball", "contact"),
        false => ("roller", "line of contact"),
    };
    let deformation = short(m.approach_um, 3);
    let floor = if m.deepest_um > m.approach_um && law == Law::HalfSpace {
        format!(
            "deeper than the healthy bearing's heaviest static contact deforms, {deformation} µm: pressed no further, the {element} rests on what \
             lies beside the damage"
        )
    } else if m.deepest_um > m.approach_um {
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
        fact("Length", m.length_mm, 4, "mm", passed(passing, defect)),
        fact("Arc", m.arc_deg, 4, "°", "of the damaged surface".into()),
        fact(
            "Width",
            m.width_mm,
            4,
            "mm",
            format!(
                "along the axis, from the lowest to the highest z; the {}",
                match bearing.has_balls() {
                    true => format!("ball is {} mm thick", short(bearing.roller_diameter_mm, 4)),
                    false => format!("roller is {} mm long", short(bearing.roller_length_mm, 4)),
                }
            ),
        ),
        fact("Area", m.area_mm2, 4, "mm^2", "seen from above".into()),
        fact("Mean depth", m.mean_depth_um, 4, "µm", "volume over area".into()),
        fact("Deepest", m.deepest_um, 4, "µm", floor),
        fact("Time to pass", m.pass_ms, 4, "ms", format!("of the {contact}, at {} r/min", short(m.speed_rpm, 4))),
    ];
    if m.widest_mm < (1.0 - 1e-6) * m.width_mm {
        let note = "of one line along the axis: undamaged surface lies beside or between".into();
        facts.insert(3, fact("Largest damaged length", m.widest_mm, 4, "mm", note));
    }
    if m.raised_um > 0.0 {
        facts.push(fact("Raised edge", m.raised_um, 4, "µm", "felt by the law \"half-space\"".into()));
    }
    if let (Shape::DepthMap(_), Law::Ecl) = (&defect.shape, law) {
        let note = format!(
            "largest L_s: this law counts each damaged node as wide as dz, {} mm^2 in all; the law \"half-space\" takes the surface",
            short(m.area_in_ecl_mm2, 4)
        );
        facts.push(fact("Largest damaged length in the law ecl", 1e3 * widest_in_ecl(defect), 4, "mm", note));
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
