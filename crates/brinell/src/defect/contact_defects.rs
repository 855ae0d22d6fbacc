//! The defects that bear on a contact, and the surface that several of them make together.

use super::angles::Angles;
use super::bands::Band;
use super::depth_profile::DepthProfile;
use super::extent::{Extent, slice_borders};
use super::joint::{ArcLine, Depths, envelope_depth};
use super::map_slices::GAUSS;
use super::placed::{Defect, Defects};
use super::shape::Shape;
use super::track::settled;
use crate::contact::ContactReduction;
use crate::scenario::Surface;

/// What acts in one contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamagedContact {
    /// Elastic sum, N.
    pub elastic: f64,
    /// What the damage leaves.
    pub floor: ContactReduction,
}

/// One defect under one side of a roller.
#[derive(Clone, Copy)]
pub(super) struct DefectAt<'a> {
    pub(super) defect: &'a Defect,
    pub(super) profile: &'a DepthProfile,
    pub(super) s: f64,
}

impl<'a> DefectAt<'a> {
    /// The line z = const of the surface before its envelope.
    pub(super) fn arc_line(&self, z: f64) -> Option<ArcLine<'a>> {
        let depths = match &self.defect.shape {
            Shape::DepthMap(grid) => Depths::Map(grid, z),
            _ => Depths::Within {
                band: Band::at(&self.profile.bands, z),
                z,
                floor: &self.profile.surface.as_ref()?.floor,
                reached: self.profile.floor.as_ref()?,
            },
        };
        Some(ArcLine { depths, s: self.s })
    }

    /// The depth at z where the defect covers it, before any envelope.
    pub(super) fn under(&self, z: f64) -> Option<f64> {
        if let Shape::DepthMap(grid) = &self.defect.shape {
            return grid.under(self.s, z);
        }
        let holds = |c: [f64; 2]| c[0] <= self.s && self.s <= c[1];
        let covered = Band::at(&self.profile.bands, z)?.chords(z).any(holds);
        covered.then(|| self.defect.depth_at(self.s))
    }

    /// The next z above z at which that, or the form of the borders along s, may change; of a depth map along an
    /// envelope only where damage ends.
    fn next(&self, z: f64) -> f64 {
        if let Shape::DepthMap(grid) = &self.defect.shape {
            return match &self.profile.surface {
                None => grid.next_row(z),
                Some(_) => grid.next_end(self.s, z),
            };
        }
        let bands = &self.profile.bands;
        match bands.get(bands.partition_point(|b| b.z[1] <= z)) {
            Some(band) if band.z[0] <= z => band.next(self.s, z),
            Some(band) => band.z[0],
            None => f64::INFINITY,
        }
    }

    pub(super) fn is_on_roller(&self) -> bool {
        matches!(self.defect.surface, Surface::Roller(_))
    }

    /// Distance of the line of contact from the damage, m; 0 on it.
    #[inline]
    fn away(&self) -> f64 {
        let (first, last) = self.profile.arc;
        (first - self.s).max(self.s - last).max(0.0)
    }
}

/// The defects that bear on a contact: none where it is on no damage; along an envelope also those beside it that a
/// roller, resting on the deepest floor under it, would reach.
#[derive(Clone, Copy)]
pub(super) struct ContactDefects<'a> {
    defects: Defects<'a>,
    angles: Angles,
    /// The deepest floor under the line of contact, m; `None` where that is on no damage.
    deepest: Option<f64>,
    /// How far the defects on the raceway, and those on the roller, are moved along the arc, m.
    moved: [f64; 2],
}

impl<'a> ContactDefects<'a> {
    #[inline]
    pub(super) fn new(defects: Defects<'a>, angles: &Angles) -> Self {
        let all = Self { defects, angles: *angles, deepest: None, moved: [0.0; 2] };
        let met = all.all().filter(|one| one.away() == 0.0);
        let floors = met.map(|one| one.profile.surface.as_ref().map_or(0.0, |x| x.extremes.1));
        Self { deepest: floors.reduce(f64::max), ..all }
    }

    /// The same defects, those on the raceway or those on the roller moved along the arc, m.
    pub(super) fn moved(self, on_roller: bool, by: f64) -> Self {
        let mut moved = [0.0; 2];
        moved[usize::from(on_roller)] = by;
        Self { moved, ..self }
    }

    /// Every defect of the contact, bearing on it or not.
    #[inline]
    fn all(self) -> impl Iterator<Item = DefectAt<'a>> + Clone {
        self.defects.iter().filter_map(move |defect| {
            let profile = defect.depth_profile(self.defects.side)?;
            let s = defect.local_angle(&self.angles, self.defects.side) * defect.radius;
            Some(DefectAt { defect, profile, s })
        })
    }

    #[inline]
    pub(super) fn iter(self) -> impl Iterator<Item = DefectAt<'a>> + Clone {
        let bears = move |one: &DefectAt| {
            let away = one.away();
            self.deepest.is_some_and(|deepest| match &one.profile.surface {
                None => away == 0.0,
                Some(x) => away * away <= 2.0 * x.radius * (deepest - x.extremes.0),
            })
        };
        self.all()
            .filter(bears)
            .map(move |one| DefectAt { s: one.s + self.moved[usize::from(one.is_on_roller())], ..one })
    }

    /// The first, and whether there are more.
    #[inline]
    pub(super) fn first(self) -> Option<(DefectAt<'a>, bool)> {
        let mut met = self.iter();
        Some((met.next()?, met.next().is_some()))
    }
}

/// The highest raised edge (m, 0 or less) and R_eq of several defects along an envelope; `None` at a point.
pub(super) fn rolling(met: ContactDefects) -> Option<(f64, f64)> {
    let radius = met.iter().next()?.profile.surface.as_ref()?.radius;
    let surfaces = met.iter().filter_map(|one| one.profile.surface.as_ref());
    Some((surfaces.map(|x| x.extremes.0).fold(0.0, f64::min), radius))
}

/// Borders, phi_k and h_k of the slices under several defects, for `add`: what any of them covers, the deepest at each
/// point.
pub(super) fn joint(met: ContactDefects, (slices, extent): (usize, Extent), mut add: impl FnMut(usize, f64, f64)) {
    let rolling = rolling(met);
    let deepest = |z: f64| met.iter().filter_map(|one| one.under(z)).reduce(f64::max);
    for k in 0..slices {
        let [low, high] = slice_borders(k, slices, extent);
        let (mut covered, mut section) = (0.0, 0.0);
        let mut z = low;
        while z < high {
            let next = met.iter().map(|one| one.next(z)).fold(high, f64::min);
            let to = if next > z { next } else { high };
            let (from, wide) = (z, to - z);
            z = to;
            let is_covered = deepest(from + 0.5 * wide).is_some();
            let lowest = rolling.map_or(0.0, |(lowest, _)| lowest);
            if !is_covered && lowest >= 0.0 {
                continue;
            }
            // Along an envelope each point costs a search.
            let points = if rolling.is_none() || wide > 0.6 * (high - low) {
                3
            } else if wide > 0.25 * (high - low) {
                2
            } else {
                1
            };
            for [x, weight] in GAUSS[points - 1] {
                let at = from + x * wide;
                let h = match rolling {
                    None => deepest(at),
                    Some((lowest, radius)) => {
                        let lines = met.iter().filter_map(move |one| one.arc_line(at));
                        let h = envelope_depth(lines, lowest, radius);
                        // What lifts the roller counts before the line of contact reaches it.
                        (is_covered || h < 0.0).then_some(h)
                    }
                };
                if let Some(h) = h {
                    covered += weight * wide;
                    section += weight * wide * h;
                }
            }
        }
        let phi = settled(covered / (high - low));
        if phi > 0.0 {
            add(k, phi, section / covered);
        }
    }
}
