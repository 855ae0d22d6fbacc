//! Pictures of damage: the raceway unrolled, the contact conditions during roller passage, pressures, and the ring's
//! section under it.

mod curves;
mod photo;
mod plan;
mod pressure;
mod shades;

use crate::fact::Fact;
use crate::font;
use crate::picture::{Anchor, Picture, Text};
use brinell::derived::Passing;
pub use curves::{damage_passage, damage_section, load_along};
pub use photo::damage_photo;
pub use plan::damage_plan;
pub use pressure::{PressureView, damage_pressure};

/// One defect, seen before it is simulated. Vectors of a panel are as long as the panel's axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DamageView {
    /// "Defect 1: outer raceway, row 1".
    pub title: String,
    /// "outer raceway".
    pub surface: String,
    /// What rolls over it: "roller" (also where it is empty) or "ball".
    pub element: String,
    /// What the view from above shows, as the picture's heading.
    pub plan_title: String,
    /// Numbers: length, area, time to pass.
    pub facts: Vec<Fact>,
    /// Seen from above, (s, z) in mm from the defect's centre; a polygon within another is a hole.
    pub polygons_mm: Vec<Vec<[f64; 2]>>,
    /// Another shape, drawn as a dashed line around or over the damage; may be empty.
    pub against_mm: Vec<[f64; 2]>,
    /// What that shape is.
    pub against: String,
    /// The photo that its outline was read from.
    pub photo: Option<brinell_damage::Photo>,
    /// Depths, where the damage has more than one; drawn instead of the polygons.
    pub depths: Option<DepthPatch>,
    /// L of the roller.
    pub roller_length_mm: f64,
    /// d of the roller.
    pub roller_diameter_mm: f64,
    /// Of a roller, half its circumference: the view from above goes once around, and either contact meets the damage
    /// half a turn after the other.
    pub half_turn_mm: Option<f64>,
    /// Which way rollers pass it, so where the line of contact is at entry.
    pub passing: Passing,
    /// s of the load zone's ends, where the surface rests in it.
    pub load_zone_mm: Option<[f64; 2]>,
    /// Contact conditions during roller passage, over the angle of a roller from the defect's centre, in degrees; at
    /// which deformation, by which laws.
    pub passage: DamageCurves,
    /// Pressures over it where they are largest, a contact each; none under laws that have none.
    pub pressures: Vec<PressureView>,
    /// Section properties over s along the damage, in mm; for which ring.
    pub section: DamageCurves,
}

/// Panels over one axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DamageCurves {
    /// What they show.
    pub title: String,
    /// Places on the axis.
    pub along: Vec<f64>,
    /// What is drawn over them.
    pub panels: Vec<DamagePanel>,
    /// What to know; may be empty.
    pub note: String,
}

impl DamageView {
    /// What rolls over the damage, for words.
    pub(crate) fn element(&self) -> &str {
        match self.element.is_empty() {
            true => "roller",
            false => &self.element,
        }
    }
}

/// Depths at the nodes of a grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DepthPatch {
    /// (s, z) of the first node, mm.
    pub start_mm: [f64; 2],
    /// Distance of nodes, mm.
    pub step_mm: [f64; 2],
    /// Nodes along s.
    pub columns: usize,
    /// `depth_um[row * columns + column]`; 0 is undamaged, negative a raised edge.
    pub depth_um: Vec<f64>,
}

/// Curves on one pair of axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DamagePanel {
    /// "Depth".
    pub label: String,
    /// "um".
    pub unit: String,
    /// Whether the axis starts at 0.
    pub from_zero: bool,
    /// The curves.
    pub curves: Vec<DamageCurve>,
}

/// One curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DamageCurve {
    /// "envelope, ecl".
    pub name: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// What a picture shows, above it, in as many lines as that takes; returns the height used.
fn heading(picture: &mut Picture, words: &str, left: f64, right: f64, font: f64) -> f64 {
    let mut top = 2.0;
    let mut line = String::new();
    let mut put = |line: &mut String, top: &mut f64| {
        let text = font::fitted(line, font, true, right - left);
        picture.text(Text::new(left, *top + font, font, Anchor::Start, &text).bold());
        *top += 1.5 * font;
        line.clear();
    };
    for word in words.split_whitespace() {
        let longer = format!("{line}{}{word}", if line.is_empty() { "" } else { " " });
        if !line.is_empty() && font::width(&longer, font, true) > right - left {
            put(&mut line, &mut top);
            line = word.to_owned();
        } else {
            line = longer;
        }
    }
    if !line.is_empty() {
        put(&mut line, &mut top);
        top += 0.4 * font;
    }
    top
}
