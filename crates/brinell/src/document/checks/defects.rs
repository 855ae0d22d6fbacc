//! Damage against the bearing that it lies on.

use std::f64::consts::PI;

use super::{Checker, short};
use crate::scenario::{Defect, Element, Shape, Surface};

/// Rollers' lengths beyond which a width of damage is a slip of the unit, and not damage over the whole raceway.
pub(super) const MOST_ROLLERS: f64 = 10.0;
/// Width of damage below which a unit is wrong, mm.
const NARROWEST_MM: f64 = 0.02;
const LENGTH: &str = "bearing.roller_length_mm";
const BALL: &str = "bearing.roller_diameter_mm";

impl Checker<'_> {
    pub(super) fn defects(&mut self) {
        for (i, defect) in self.s.defects.iter().enumerate() {
            self.whereabouts(i, defect);
            self.width(i, defect);
            match &defect.shape {
                Shape::Profile { .. } => self.profile(i, defect),
                Shape::Outline { polygons_mm } => self.outline(i, defect, "outline", polygons_mm),
                Shape::DepthMap { grid } => self.depth_map(i, defect, grid),
                Shape::Grown { .. } => self.grown(i, defect),
                Shape::Scan(scan) => self.scan(i, scan),
                Shape::Image(image) => self.image(i, image),
                _ => {}
            }
            self.depth_scale(i, defect);
            self.arc(i, defect);
        }
        self.overlaps();
    }

    fn whereabouts(&mut self, i: usize, defect: &Defect) {
        let b = &self.s.bearing;
        if b.rows > 0 && defect.row > b.rows {
            self.error(
                &format!("defects.{i}.row"),
                format!("the bearing has {} row{}", b.rows, if b.rows == 1 { "" } else { "s" }),
                format!("1 to {}", b.rows),
                &["bearing.rows"],
            );
        }
        if let Surface::Roller(roller) = defect.on
            && b.rollers_per_row > 0
            && roller > b.rollers_per_row
        {
            self.error(
                &format!("defects.{i}.roller"),
                format!("each row has {} rollers", b.rollers_per_row),
                format!("1 to {}", b.rollers_per_row),
                &["bearing.rollers_per_row"],
            );
        }
    }

    fn width(&mut self, i: usize, defect: &Defect) {
        let (key, width) = match &defect.shape {
            Shape::Rectangle { width_mm, .. } => ("rectangle.width_mm", *width_mm),
            Shape::Circle { diameter_mm } => ("circle.diameter_mm", *diameter_mm),
            Shape::Profile { width_mm, .. } => {
                ("profile.width_mm", width_mm.iter().fold(0.0, |widest: f64, w| widest.max(*w)))
            }
            Shape::Li2023Irregular { max_width_mm } => ("li2023_irregular.max_width_mm", *max_width_mm),
            Shape::Random { width_mm, .. } => ("random.width_mm", *width_mm),
            Shape::Outline { .. } | Shape::DepthMap { .. } | Shape::Grown { .. } => return,
            // Their extent is known once their file is read.
            Shape::Image(_) | Shape::Svg(_) | Shape::Scan(_) => return,
        };
        let length = self.s.bearing.axial_reach_mm();
        let key = format!("defects.{i}.shape.{key}");
        let (than, also) = match self.s.bearing.element {
            Element::Roller => ("the roller, whose length is", LENGTH),
            Element::Ball => ("any groove: two ball diameters are", BALL),
        };
        let message = format!("{} mm is wider than {than} {} mm", short(width), short(length));
        let most = MOST_ROLLERS * length;
        if width > most {
            let message = format!("{message}, by more than damage is; lengths in um instead of mm?");
            self.error(&key, message, format!("<= {}", short(most)), &[also]);
        } else if defect.axial_offset_mm != 0.0 {
            let half = 0.5e-3 * width;
            self.on_raceway(i, defect, &key, (-half, half));
        } else if width > length {
            let message = format!("{message}; it acts over {} mm, what is beyond is left out", short(length));
            self.warn(&key, message, String::new(), &[also]);
        } else if width < NARROWEST_MM {
            let message =
                format!("{} mm is narrower than any damage that is seen; lengths in m instead of mm?", short(width));
            self.warn(&key, message, format!(">= {NARROWEST_MM}"), &[]);
        }
    }

    fn profile(&mut self, i: usize, defect: &Defect) {
        let Shape::Profile { arc_mm, width_mm, depth_um } = &defect.shape else {
            return;
        };
        let path = |name: &str| format!("defects.{i}.shape.profile.{name}");
        // An empty list that the file does not hold was reported as missing or unreadable.
        let readable =
            |name: &str, list: &[f64]| !list.is_empty() || self.finder.value(&path(name)).as_deref() == Some("[]");
        if !readable("arc_mm", arc_mm) || !readable("width_mm", width_mm) {
            return;
        }
        let count = arc_mm.len();
        let depths = depth_um.as_ref().filter(|list| readable("depth_um", list));
        let lists = [("width_mm", Some(width_mm.len())), ("depth_um", depths.map(Vec::len))];
        for (name, length) in lists {
            if length.is_some_and(|length| length != count) {
                self.error(
                    &path(name),
                    match length.unwrap_or(0) {
                        1 => format!("1 value for the {count} points of arc_mm"),
                        n => format!("{n} values for the {count} points of arc_mm"),
                    },
                    format!("a list of {count}"),
                    &[&path("arc_mm")],
                );
            }
        }
        if count < 2 {
            self.error(&path("arc_mm"), "a profile has at least two points".into(), "a list of 2 or more".into(), &[]);
        }
        if let Some(pair) = arc_mm.windows(2).find(|pair| pair[1] < pair[0]) {
            self.error(
                &path("arc_mm"),
                format!("the arc must not go back; {} mm follows {} mm", short(pair[1]), short(pair[0])),
                "each value at least the one before".into(),
                &[],
            );
        }
    }

    fn arc(&mut self, i: usize, defect: &Defect) {
        let b = &self.s.bearing;
        let (surface, diameter_key) = match defect.on {
            Surface::OuterRaceway => ("outer raceway", "bearing.outer_raceway_diameter_mm"),
            Surface::InnerRaceway => ("inner raceway", "bearing.inner_raceway_diameter_mm"),
            Surface::Roller(_) => (b.element.word(), "bearing.roller_diameter_mm"),
        };
        let half_circle = 0.5 * PI * b.diameter_mm(defect.on);
        let Some(shape) = crate::defect::Shape::new(&defect.shape, 1e-6 * defect.depth_um) else {
            return;
        };
        let (first, last) = shape.arc();
        let reach = 1e3 * first.abs().max(last.abs());
        let (key, limit) = match &defect.shape {
            Shape::Rectangle { .. } => ("rectangle.length_mm", 2.0 * half_circle),
            Shape::Circle { .. } => ("circle.diameter_mm", 2.0 * half_circle),
            Shape::Profile { .. } => ("profile.arc_mm", half_circle),
            Shape::Li2023Irregular { .. } => ("li2023_irregular", half_circle),
            Shape::Outline { .. } => ("outline", half_circle),
            Shape::DepthMap { .. } => ("depth_map", half_circle),
            Shape::Grown { .. } => ("grown", half_circle),
            Shape::Random { .. } => ("random.length_mm", 2.0 * half_circle),
            Shape::Image(_) | Shape::Svg(_) | Shape::Scan(_) => return,
        };
        // A shape without a key of its own for its length is found by its table.
        let table = format!("defects.{i}.shape");
        let also: &[&str] = if key.contains('.') { &[diameter_key] } else { &[&table, diameter_key] };
        if reach > half_circle {
            let allowed = match &defect.shape {
                Shape::Profile { .. } => format!("-{0} to {0}", short(limit)),
                Shape::Outline { .. } | Shape::DepthMap { .. } | Shape::Grown { .. } => {
                    format!("s from -{0} to {0} mm", short(limit))
                }
                Shape::Li2023Irregular { .. } => {
                    format!("a surface of diameter >= {} mm", short(2.0 * reach / PI))
                }
                _ => format!("<= {}", short(limit)),
            };
            self.error(
                &format!("defects.{i}.shape.{key}"),
                format!("the defect goes past a full circle of the {surface}, {} mm around", short(2.0 * half_circle)),
                allowed,
                also,
            );
        } else if last - first > 1e-3 * half_circle {
            self.warn(
                &format!("defects.{i}.shape.{key}"),
                format!(
                    "the defect covers {} of {} mm around the {surface}, more than half: check its scale",
                    short(1e3 * (last - first)),
                    short(2.0 * half_circle)
                ),
                String::new(),
                also,
            );
        }
    }
}
