//! What a roller stands on, made ready for one surface, law and path: depths h_s(s) and h_k(s) in constant time.

use super::Shape;
use super::course::{Course, Line};
use super::envelope::envelope;
use crate::scenario::{self, EdgeReaction, Law, RollerPath};

/// How damage acts, the same for every contact of a model (section 3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rules {
    /// Law of a damaged contact.
    pub law: Law,
    /// Path of a roller.
    pub path: RollerPath,
    /// n_s.
    pub slices: usize,
    /// Tangential push of slopes.
    pub edge_reaction: EdgeReaction,
}

impl Rules {
    /// From the scenario.
    pub fn new(contact: &scenario::Contact) -> Self {
        Self {
            law: contact.law,
            path: contact.roller_path,
            slices: contact.slices.max(1),
            edge_reaction: contact.edge_reaction,
        }
    }

    /// Whether slopes push on what turns, so that no work is parametric.
    pub fn is_conservative(&self) -> bool {
        self.edge_reaction == EdgeReaction::Conservative
    }
}

/// A border closer to a slice's middle than this share of L lies on it.
const SLACK: f64 = 1e-9;

/// Axial position z_k of slice k (from 0) of n_s across a roller of length L, m.
pub fn slice_position(k: usize, slices: usize, length: f64) -> f64 {
    // From the middle, so that slices on both sides are mirror images to the bit.
    (2 * k as i64 + 1 - slices as i64) as f64 / (2.0 * slices as f64) * length
}

/// Depths under one side of a roller.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// First and last s at which the contact stands on damage, m: the shape's arc, and what the envelope of raised edges adds.
    pub(super) arc: (f64, f64),
    /// h_env of h_s, where the path is the envelope: for the laws that know one depth.
    pub(super) floor: Option<Course>,
    /// h_k of each slice; empty under `ecl`.
    pub(super) slices: Vec<Course>,
    /// What the envelopes were made of, for the joint surface of several defects; `None` where the path is the point.
    pub(super) surface: Option<Surface>,
}

/// Depths before their envelope, as straight pieces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Surface {
    /// R_eq, m.
    pub(super) radius: f64,
    /// h_s.
    pub(super) floor: Vec<Line>,
    /// h_k of each slice; empty under `ecl`.
    pub(super) slices: Vec<Vec<Line>>,
    /// Lowest (0 or less) and deepest of what the law uses, m.
    pub(super) extremes: (f64, f64),
}

impl Ground {
    /// For a roller of length `length` that meets the damage with the relative radius R_eq (m); `depth` (m) is the defect's.
    pub(super) fn new(shape: &Shape, depth: f64, length: f64, radius: f64, rules: &Rules) -> Self {
        let slices: Vec<Vec<Line>> = match rules.law {
            Law::Ecl => Vec::new(),
            Law::Sliced => (0..rules.slices)
                .map(|k| {
                    let z = slice_position(k, rules.slices, length);
                    shape.along(z, SLACK * length, depth)
                })
                .collect(),
        };
        let along_envelope = rules.path == RollerPath::Envelope;
        let courses: Vec<Course> = slices
            .iter()
            .map(|lines| match rules.path {
                RollerPath::Point => Course::of_lines(lines),
                RollerPath::Envelope => envelope(lines, radius),
            })
            .collect();
        let arc = courses
            .iter()
            .filter(|c| !c.is_zero())
            .map(Course::span)
            .fold(shape.arc(), |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let depths = along_envelope.then(|| shape.depths(depth));
        Self {
            arc,
            floor: depths.as_ref().map(|lines| envelope(lines, radius)),
            slices: courses,
            surface: depths.map(|floor| Surface::new(floor, slices, radius)),
        }
    }
}

impl Surface {
    fn new(floor: Vec<Line>, slices: Vec<Vec<Line>>, radius: f64) -> Self {
        let solid = |mut lines: Vec<Line>| {
            lines.retain(|l| l.to > l.from);
            lines
        };
        let floor = solid(floor);
        let slices: Vec<Vec<Line>> = slices.into_iter().map(solid).collect();
        let used = slices
            .iter()
            .flatten()
            .chain(slices.is_empty().then_some(&floor).into_iter().flatten());
        let extremes = used
            .flat_map(|l| [l.at_from, l.at_to])
            .fold((0.0_f64, 0.0_f64), |(low, high), h| {
                (low.min(h), high.max(h))
            });
        Self {
            radius,
            floor,
            slices,
            extremes,
        }
    }
}

/// Relative radius of curvature R_eq (m) of a roller of radius r on a raceway: 1/R_eq = 1/r - 1/R_o at the outer one, 1/r + 1/R_i at the
/// inner one.
pub fn relative_radius(bearing: &scenario::Bearing, side: super::Side) -> f64 {
    let roller = 2e3 / bearing.roller_diameter_mm;
    match side {
        super::Side::Outer => 1.0 / (roller - 2e3 / bearing.outer_raceway_diameter_mm),
        super::Side::Inner => 1.0 / (roller + 2e3 / bearing.inner_raceway_diameter_mm),
    }
}
