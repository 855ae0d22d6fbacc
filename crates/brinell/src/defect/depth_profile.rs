//! Damage under a roller, made ready for one surface, law and path: h_s(s), and phi_k(s) and h_k(s) of slices, in constant time.

use super::Shape;
use super::bands::Band;
use super::envelope::envelope;
use super::map_slices::{along_the_envelope, at_a_point};
use super::piecewise::{Line, PiecewisePolynomial};
use super::track::{Track, fit};
use crate::scenario::{self, EdgeReaction, Law, RollerPath};
use crate::slices::borders as slice_borders;

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
}

/// Depths under one side of a roller.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthProfile {
    /// First and last s at which the contact is on damage, m: the shape's arc, and what the envelope of raised edges adds.
    pub(super) arc: (f64, f64),
    /// h_env of h_s, where the path is the envelope: for the laws that know one depth, and under slices that the damage covers from end to end.
    pub(super) floor: Option<PiecewisePolynomial>,
    /// Slices.
    pub(super) cover: Cover,
    /// n_s.
    pub(super) slices: usize,
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
    /// For a roller of length `length` that meets the damage with the relative radius R_eq (m); `depth` (m) is the defect's, `middle` (m) the z
    /// of a shape that is a width alone.
    pub(super) fn new(
        shape: &Shape,
        (depth, middle): (f64, f64),
        length: f64,
        radius: f64,
        rules: &Rules,
    ) -> Self {
        let sliced = rules.law == Law::Sliced;
        let along_envelope = rules.path == RollerPath::Envelope;
        let surface = along_envelope.then(|| Surface::new(shape, depth, radius, sliced));
        let floor = surface.as_ref().map(|x| envelope(&x.floor, radius));
        let mut profile = Self {
            arc: shape.arc(),
            floor,
            cover: Cover::Unsliced,
            slices: rules.slices,
            bands: Vec::new(),
            surface,
        };
        if sliced {
            let (borders, crossings) = shape.borders(middle);
            let mut cuts: Vec<f64> = (0..rules.slices)
                .map(|k| slice_borders(k, rules.slices, length)[0])
                .collect();
            cuts.push(0.5 * length);
            profile.bands = Band::all(&borders, &crossings, &cuts);
            profile.cover = match shape {
                Shape::DepthMap(grid) => Cover::Slices(if along_envelope {
                    along_the_envelope(grid, rules.slices, length, radius)
                } else {
                    at_a_point(grid, rules.slices, length)
                }),
                _ if !along_envelope || shape.is_straight() => Cover::Even,
                _ => Cover::Slices(profile.tracks(shape, (depth, middle), length, radius)),
            };
        }
        if let Cover::Slices(tracks) = &profile.cover {
            profile.arc = tracks
                .iter()
                .map(Track::span)
                .fold(profile.arc, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        }
        profile
    }

    /// Slices along the envelope of damage that has one depth at each s.
    ///
    /// A roller then rests on that floor, or on the nearer end of the damage along s at its z: h_env(s, z) = min(F(s), d^2 / (2 R_eq)), F being the
    /// envelope of a floor without ends.
    fn tracks(
        &self,
        shape: &Shape,
        (depth, middle): (f64, f64),
        length: f64,
        radius: f64,
    ) -> Vec<Track> {
        let own = self.floor.as_ref().filter(|_| shape.has_depths());
        let floor = |s: f64| own.map_or(depth, |floor| floor.value(s).max(0.0));
        let deepest = self.surface.as_ref().map_or(depth, |x| x.extremes.1);
        let reach = own.is_none().then(|| (2.0 * radius * depth).sqrt());
        let n = self.slices;
        // Slices on both sides of a width's middle are alike.
        let alike = shape.is_width() && middle == 0.0;
        let tracks = (if alike { n / 2 } else { 0 }..n).filter_map(|k| {
            let [low, high] = slice_borders(k, n, length);
            let from = self.bands.partition_point(|b| b.z[0] < low);
            let to = self.bands.partition_point(|b| b.z[0] < high);
            let bands = &self.bands[from..to];
            let kinks = bands.iter().flat_map(|b| b.kinks(None));
            let (first, last) = kinks.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| {
                (a.min(s), b.max(s))
            });
            let mut stops: Vec<f64> = bands.iter().flat_map(|b| b.kinks(reach)).collect();
            stops.extend(own.iter().flat_map(|floor| floor.breakpoints()));
            stops.extend([first, last]);
            stops.retain(|s| (first..=last).contains(s));
            stops.sort_by(f64::total_cmp);
            stops.dedup_by(|b, a| *b - *a < 1e-13);
            let parts = fit(&stops, deepest, |s| {
                let covered: f64 = bands.iter().map(|b| b.covered(s)).sum();
                if covered <= 0.0 {
                    return (0.0, 0.0);
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
        let extremes = along.fold((0.0_f64, 0.0_f64), |(low, high), h| {
            (low.min(h), high.max(h))
        });
        let extremes = match shape {
            Shape::DepthMap(grid) if sliced => {
                let (deepest, highest) = grid.extremes();
                (highest.min(0.0), deepest.max(0.0))
            }
            _ => extremes,
        };
        Self {
            radius,
            floor,
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
