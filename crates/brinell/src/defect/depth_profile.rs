//! Damage under a roller, made ready for one surface, law and path: h_s(s), and phi_k(s) and h_k(s) of slices, in
//! constant time.

use super::across::Across;
use super::angles::Side;
use super::bands::Band;
use super::envelope::envelope;
use super::extent::{Extent, slice_borders};
use super::grid::Grid;
use super::map_slices::{along_the_envelope, at_a_point};
use super::piecewise::{Line, PiecewisePolynomial};
use super::shape::Shape;
use super::track::{Track, fit};
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

/// What damage covers of the slices, and how deep.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cover {
    /// Law `ecl`: there are no slices.
    Unsliced,
    /// As deep at every covered z: L_s over L is all that counts, however many slices there are.
    Even,
    /// phi_k(s) and h_k(s); slices that the damage never covers are left out.
    Slices(Vec<Track>),
    /// The same under balls, which need to know where a slice lies.
    Across(Across),
}

/// Depths under one side of a roller.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthProfile {
    /// First and last s at which the contact is on damage, m: the shape's arc, and what the envelope of raised edges
    /// adds.
    pub(super) arc: (f64, f64),
    /// h_env of h_s, where the path is the envelope: for the laws that know one depth, and under slices that the damage
    /// covers from end to end.
    pub(super) floor: Option<PiecewisePolynomial>,
    /// Slices.
    pub(super) cover: Cover,
    /// n_s.
    pub(super) slices: usize,
    /// What they divide.
    pub(super) extent: Extent,
    /// The damage from above, for several defects at one contact; empty under `ecl` and for depth maps.
    pub(super) bands: Vec<Band>,
    /// What the envelopes were made of, for the joint surface of several defects; `None` where the path is the point.
    pub(super) surface: Option<Surface>,
}

/// Depths before their envelope.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Surface {
    /// R_eq, m.
    pub(super) radius: f64,
    /// h_s as straight pieces.
    pub(super) floor: Vec<Line>,
    /// Lowest (0 or less) and deepest of what the law uses, m.
    pub(super) extremes: (f64, f64),
}

impl DepthProfile {
    /// For rollers or balls that meet the damage with the relative radius R_eq (m) and whose slices divide `extent`;
    /// `depth` (m) is the defect's, `middle` (m) the z of a shape that is a width alone.
    pub(super) fn new(shape: &Shape, (depth, middle): (f64, f64), extent: Extent, radius: f64, rules: &Rules) -> Self {
        let sliced = rules.law == Law::Sliced;
        let along_envelope = rules.path == RollerPath::Envelope;
        let surface = along_envelope.then(|| Surface::new(shape, depth, radius, sliced));
        let floor = surface.as_ref().map(|x| envelope(&x.floor, radius));
        let mut profile = Self {
            arc: shape.arc(),
            floor,
            cover: Cover::Unsliced,
            slices: rules.slices,
            extent,
            bands: Vec::new(),
            surface,
        };
        if sliced {
            let (edges, crossings) = shape.borders(middle);
            let mut cuts: Vec<f64> = (0..rules.slices).map(|k| slice_borders(k, rules.slices, extent)[0]).collect();
            cuts.push(extent.middle + 0.5 * extent.length);
            profile.bands = Band::all(&edges, &crossings, &cuts);
            profile.cover = match shape {
                _ if extent.of_balls => Cover::Across(profile.across(shape, (depth, middle), radius)),
                Shape::DepthMap(grid) => Cover::Slices(profile.of_map(grid, radius)),
                _ if !along_envelope || shape.is_straight() => Cover::Even,
                _ => Cover::Slices(profile.tracks(shape, (depth, middle), radius)),
            };
        }
        let reach = |arc: (f64, f64), span: (f64, f64)| (arc.0.min(span.0), arc.1.max(span.1));
        profile.arc = match &profile.cover {
            Cover::Slices(tracks) => tracks.iter().map(Track::span).fold(profile.arc, reach),
            Cover::Across(across) => across.spans().fold(profile.arc, reach),
            Cover::Unsliced | Cover::Even => profile.arc,
        };
        profile
    }

    /// Slices of a depth map.
    fn of_map(&self, grid: &Grid, radius: f64) -> Vec<Track> {
        match self.surface {
            Some(_) => along_the_envelope(grid, self.slices, self.extent, radius),
            None => at_a_point(grid, self.slices, self.extent),
        }
    }

    /// Slices under balls, with where they lie.
    fn across(&self, shape: &Shape, (depth, middle): (f64, f64), radius: f64) -> Across {
        let size = (self.slices, self.extent);
        let tracks = match shape {
            Shape::Rectangle { half_length, width } => {
                let mut stops = vec![-half_length, *half_length];
                stops.extend(self.floor.iter().flat_map(|floor| floor.breakpoints()));
                stops.sort_by(f64::total_cmp);
                stops.dedup_by(|b, a| *b - *a < 1e-13);
                let floor = |s: f64| {
                    let floor = self.floor.as_ref();
                    floor.map_or(depth, |floor| floor.value(s).max(0.0))
                };
                let of = |phi: f64| {
                    let parts = fit(&stops, depth, |s| (phi, floor(s)));
                    Track::new(0, 1.0, parts, *half_length)
                };
                let range = [middle - 0.5 * width, middle + 0.5 * width];
                return Across::of_rectangle(range, size, of);
            }
            Shape::DepthMap(grid) => self.of_map(grid, radius),
            _ => self.tracks(shape, (depth, middle), radius),
        };
        let mirrored = self.is_mirrored(shape, middle);
        Across::of_slices(tracks, size, mirrored, shape.raised())
    }

    /// Whether slices on both sides of the middle are alike.
    fn is_mirrored(&self, shape: &Shape, middle: f64) -> bool {
        shape.is_width() && middle == 0.0 && self.extent.middle == 0.0
    }

    /// Slices of damage that has one depth at each s.
    ///
    /// Along the envelope a roller then rests on that floor, or on the nearer end of the damage along s at its z:
    /// h_env(s, z) = min(F(s), d^2 / (2 R_eq)), F being the envelope of a floor without ends.
    fn tracks(&self, shape: &Shape, (depth, middle): (f64, f64), radius: f64) -> Vec<Track> {
        let own = self.floor.as_ref().filter(|_| shape.has_depths());
        let floor = |s: f64| own.map_or(depth, |floor| floor.value(s).max(0.0));
        let along_envelope = self.surface.is_some();
        let lines = shape.depths(depth);
        let deepest = match &self.surface {
            Some(surface) => surface.extremes.1,
            None => (lines.iter().flat_map(|l| [l.at_from, l.at_to])).fold(0.0, f64::max),
        };
        let reach = (along_envelope && own.is_none()).then(|| (2.0 * radius * depth).sqrt());
        let n = self.slices;
        let alike = self.is_mirrored(shape, middle);
        let tracks = (if alike { n / 2 } else { 0 }..n).filter_map(|k| {
            let [low, high] = slice_borders(k, n, self.extent);
            let from = self.bands.partition_point(|b| b.z[0] < low);
            let to = self.bands.partition_point(|b| b.z[0] < high);
            let bands = &self.bands[from..to];
            let kinks = bands.iter().flat_map(|b| b.kinks(None));
            let (first, last) = kinks.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
            let mut stops: Vec<f64> = bands.iter().flat_map(|b| b.kinks(reach)).collect();
            stops.extend(own.iter().flat_map(|floor| floor.breakpoints()));
            if !along_envelope {
                stops.extend(lines.iter().flat_map(|l| [l.from, l.to]));
            }
            stops.extend([first, last]);
            stops.retain(|s| (first..=last).contains(s));
            stops.sort_by(f64::total_cmp);
            stops.dedup_by(|b, a| *b - *a < 1e-13);
            let parts = fit(&stops, deepest, |s| {
                let covered: f64 = bands.iter().map(|b| b.covered(s)).sum();
                if covered <= 0.0 {
                    return (0.0, 0.0);
                }
                if !along_envelope {
                    return (covered / (high - low), shape.own_depth(s).unwrap_or(depth));
                }
                let reached: f64 = bands.iter().map(|b| b.reached(s, floor(s), radius)).sum();
                (covered / (high - low), reached / covered)
            });
            let twice = alike && 2 * k + 1 != n;
            Track::new(k, if twice { 2.0 } else { 1.0 }, parts, last)
        });
        tracks.collect()
    }
}

impl Surface {
    fn new(shape: &Shape, depth: f64, radius: f64, sliced: bool) -> Self {
        let mut floor = shape.depths(depth);
        floor.retain(|l| l.to > l.from);
        let along = floor.iter().flat_map(|l| [l.at_from, l.at_to]);
        let extremes = along.fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
        let extremes = match shape {
            Shape::DepthMap(grid) if sliced => {
                let (deepest, highest) = grid.extremes();
                (highest.min(0.0), deepest.max(0.0))
            }
            _ => extremes,
        };
        Self { radius, floor, extremes }
    }
}

/// Relative radius of curvature R_eq (m) of a roller of radius r on a raceway: 1/R_eq = 1/r - 1/R_o at the outer one,
/// 1/r + 1/R_i at the inner one.
pub fn relative_radius(bearing: &scenario::Bearing, side: Side) -> f64 {
    let roller = 2e3 / bearing.roller_diameter_mm;
    match side {
        Side::Outer => 1.0 / (roller - 2e3 / bearing.outer_raceway_diameter_mm),
        Side::Inner => 1.0 / (roller + 2e3 / bearing.inner_raceway_diameter_mm),
    }
}
