//! Force, stiffness and energy of a contact that is on damage, one defect or several (section 3).
//!
//! Under `ecl` the defect with the smallest elastic sum acts. Under `sliced` all defects at a contact are one surface,
//! the deepest at each point; a defect that leaves a point alone has no say there, so that it does not level another's
//! raised edge. Along an envelope the roller follows the envelope of that joint surface, neighbouring defects included.

use super::ball_contact;
use super::bands::Band;
use super::depth_profile::{Cover, DepthProfile, Extent, slice_borders};
use super::joint::{Depths, Strip, rest};
use super::map_slices::GAUSS;
use super::track::settled;
use super::{Angles, Defect, Shape, Side};
use crate::contact::{ContactReduction, Hertz};
use crate::scenario::{Law, Surface};
use crate::slices::{self, borders};

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
pub(super) struct Cut<'a> {
    pub(super) defect: &'a Defect,
    pub(super) profile: &'a DepthProfile,
    pub(super) s: f64,
}

impl<'a> Cut<'a> {
    /// The line z = const of the surface before its envelope.
    pub(super) fn strip(&self, z: f64) -> Option<Strip<'a>> {
        let depths = match &self.defect.shape {
            Shape::DepthMap(grid) => Depths::Map(grid, z),
            _ => Depths::Within {
                band: Band::at(&self.profile.bands, z),
                z,
                floor: &self.profile.surface.as_ref()?.floor,
                reached: self.profile.floor.as_ref()?,
            },
        };
        Some(Strip { depths, s: self.s })
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
#[inline]
pub(super) fn cuts<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    angles: &Angles,
    side: Side,
) -> impl Iterator<Item = Cut<'a>> + Clone {
    let angles = *angles;
    let all = defects.filter_map(move |defect| {
        let profile = defect.depth_profile(side)?;
        let s = defect.local_angle(&angles, side) * defect.radius;
        Some(Cut { defect, profile, s })
    });
    let deepest = all
        .clone()
        .filter(|cut| cut.away() == 0.0)
        .map(|cut| cut.profile.surface.as_ref().map_or(0.0, |x| x.extremes.1))
        .reduce(f64::max);
    all.filter(move |cut| {
        let away = cut.away();
        deepest.is_some_and(|deepest| match &cut.profile.surface {
            None => away == 0.0,
            Some(x) => away * away <= 2.0 * x.radius * (deepest - x.extremes.0),
        })
    })
}

/// The highest raised edge (m, 0 or less) and R_eq of several defects along an envelope; `None` at a point.
fn rolling<'a>(cuts: impl Iterator<Item = Cut<'a>> + Clone) -> Option<(f64, f64)> {
    let radius = cuts.clone().next()?.profile.surface.as_ref()?.radius;
    let surfaces = cuts.filter_map(|cut| cut.profile.surface.as_ref());
    Some((surfaces.map(|x| x.extremes.0).fold(0.0, f64::min), radius))
}

/// Borders, phi_k and h_k of the slices under several defects, for `add`: what any of them covers, the deepest at each
/// point.
pub(super) fn joint<'a>(
    cuts: impl Iterator<Item = Cut<'a>> + Clone,
    (slices, extent): (usize, Extent),
    mut add: impl FnMut(usize, f64, f64),
) {
    let rolling = rolling(cuts.clone());
    let deepest = |z: f64| cuts.clone().filter_map(|cut| cut.under(z)).reduce(f64::max);
    for k in 0..slices {
        let [low, high] = slice_borders(k, slices, extent);
        let (mut covered, mut section) = (0.0, 0.0);
        let mut z = low;
        while z < high {
            let next = cuts.clone().map(|cut| cut.next(z)).fold(high, f64::min);
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
                        let strips = cuts.clone().filter_map(move |cut| cut.strip(at));
                        let h = rest(strips, lowest, radius);
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

/// Mean over the roller's length of a function of what presses there.
pub(super) struct Mean {
    pub(super) value: f64,
    /// Share of the length that damage covers.
    covered: f64,
}

/// Mean of f(delta - h) over what is damaged and of f(delta), which is `undamaged`, over the rest; where nothing is,
/// that to the bit.
#[inline]
pub(super) fn mean<'a>(
    mut cuts: impl Iterator<Item = Cut<'a>> + Clone,
    undamaged: f64,
    delta: f64,
    f: impl Fn(f64) -> f64,
) -> Option<Mean> {
    let all = cuts.clone();
    let first = cuts.next()?;
    let profile = first.profile;
    let n = profile.slices as f64;
    // What is covered, slices with any depth, what is left of them, and the sum over the rest; a slice counts 1.
    let (mut covered, mut met, mut left, mut sum) = (0.0, 0.0, 0.0, 0.0);
    let mut add = |count: f64, phi: f64, h: f64| {
        covered += count * phi;
        if h != 0.0 {
            met += count;
            left += count * (1.0 - phi);
            sum += count * phi * f(delta - h);
        }
    };
    if cuts.next().is_some() {
        let size = (profile.slices, profile.extent);
        joint(all, size, |_, phi, h| add(1.0, phi, h));
    } else {
        match &profile.cover {
            Cover::Unsliced | Cover::Across(_) => {}
            Cover::Even => {
                let length = first.defect.damaged_length(first.s);
                let phi = settled(length / first.defect.roller_length);
                if phi > 0.0 {
                    let h = match &profile.floor {
                        Some(floor) => floor.value(first.s).max(0.0),
                        None => first.defect.depth_at(first.s),
                    };
                    add(n, phi, h);
                }
            }
            Cover::Slices(tracks) => {
                for track in tracks {
                    let (phi, h) = track.value(first.s);
                    if phi > 0.0 {
                        add(track.count, phi, h);
                    }
                }
            }
        }
    }
    let left = left + (n - met);
    Some(Mean {
        value: if met == 0.0 {
            undamaged
        } else if left == 0.0 {
            sum / n
        } else {
            (left * undamaged + sum) / n
        },
        covered: covered / n,
    })
}

/// phi_k and h_k of every slice under a contact, into `cover`; false where it is on no damage, and nothing is written.
pub fn cover_slices<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    angles: &Angles,
    side: Side,
    cover: &mut slices::Cover,
) -> bool {
    cover_cuts(cuts(defects, angles, side), cover)
}

pub(super) fn cover_cuts<'a>(mut cuts: impl Iterator<Item = Cut<'a>> + Clone, cover: &mut slices::Cover) -> bool {
    let all = cuts.clone();
    let Some(first) = cuts.next() else {
        return false;
    };
    let (profile, s) = (first.profile, first.s);
    let (count, length) = (profile.slices, first.defect.roller_length);
    cover.fraction.fill(0.0);
    cover.depth.fill(0.0);
    let mut put = |k: usize, phi: f64, h: f64| {
        (cover.fraction[k], cover.depth[k]) = (phi, h);
    };
    if cuts.next().is_some() {
        joint(all, (count, profile.extent), put);
        return true;
    }
    match &profile.cover {
        Cover::Unsliced | Cover::Across(_) => return false,
        Cover::Even => {
            let h = match &profile.floor {
                Some(floor) => floor.value(s).max(0.0),
                None => first.defect.depth_at(s),
            };
            let per_length = count as f64 / length;
            let mut bands = profile.bands.iter().peekable();
            for k in 0..count {
                let [low, high] = borders(k, count, length);
                let mut covered = 0.0;
                while let Some(band) = bands.next_if(|band| band.z[0] < high) {
                    if band.z[0] >= low {
                        covered += band.covered(s);
                    }
                }
                put(k, settled(covered * per_length), h);
            }
        }
        Cover::Slices(tracks) => {
            for track in tracks {
                let (phi, h) = track.value(s);
                put(track.slice, phi, h);
                if track.count == 2.0 {
                    put(count - 1 - track.slice, phi, h);
                }
            }
        }
    }
    true
}

/// Law of a model's defects; `Ecl` where there are none.
#[inline]
fn law_of<'a>(mut defects: impl Iterator<Item = &'a Defect>) -> Law {
    defects.next().map_or(Law::Ecl, |d| d.rules.law)
}

/// What acts in the contact of a roller at `angles` on `side` that is pressed by `delta` (m); `None` off all damage.
pub fn damaged_contact<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> Option<DamagedContact> {
    damaged_contact_given(defects, law, angles, side, delta, law.exponent.of(delta))
}

/// The same where `[delta]_+^n` is known already.
#[inline]
pub fn damaged_contact_given<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
    power: f64,
) -> Option<DamagedContact> {
    if let Some(strips) = &law.strips {
        return ball_contact::damaged(cuts(defects, angles, side), strips, delta);
    }
    if law_of(defects.clone()) == Law::Sliced {
        let cuts = cuts(defects, angles, side);
        let undamaged = law.stiffness * power;
        let length = cuts.clone().next()?.defect.roller_length;
        let mean = mean(cuts, undamaged, delta, |x| law.healthy(x))?;
        return Some(DamagedContact {
            elastic: mean.value,
            floor: ContactReduction { share: 1.0 - mean.covered, depth: 0.0, damaged_length: mean.covered * length },
        });
    }
    floors(defects, angles, side)
        .map(|floor| DamagedContact { elastic: law.damaged_given(power, delta, &floor), floor })
        .reduce(|a, b| {
            // With no force on either (a gap, or both floors below), the shorter remaining length represents the
            // contact.
            if b.elastic < a.elastic || (b.elastic == a.elastic && b.floor.share < a.floor.share) { b } else { a }
        })
}

/// What each defect under a contact leaves of it, under a law that knows one width and one depth.
///
/// Along an envelope, where several bear on the contact, the roller follows the envelope of the joint surface of their
/// h_s; no floor is deeper for that than its own defect is there. Each keeps its own L_s, so that a narrow pit in a
/// wide dent makes the dent no deeper.
pub fn floors<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    angles: &Angles,
    side: Side,
) -> impl Iterator<Item = ContactReduction> + Clone {
    let several = defects.clone().nth(1).is_some();
    let joint = several
        .then(|| {
            let cuts = cuts(defects.clone(), angles, side);
            let (lowest, radius) = rolling(cuts.clone())?;
            cuts.clone().nth(1)?;
            let strips = cuts.filter_map(|cut| {
                let lines = &cut.profile.surface.as_ref()?.floor;
                let depths = Depths::Lines(lines, cut.profile.floor.as_ref());
                Some(Strip { depths, s: cut.s })
            });
            Some(rest(strips, lowest, radius))
        })
        .flatten();
    let angles = *angles;
    defects.filter_map(move |d| {
        let u = d.local_angle(&angles, side);
        let floor = d.floor(u, side)?;
        Some(match &joint {
            None => floor,
            Some(rest) => ContactReduction { depth: d.depth_at(u * d.radius).min(*rest).max(0.0), ..floor },
        })
    })
}

/// Mean over the slices of what the deformation of each, m, gives.
#[inline]
fn over_slices<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    angles: &Angles,
    side: Side,
    delta: f64,
    of: impl Fn(f64) -> f64,
) -> f64 {
    let undamaged = of(delta);
    mean(cuts(defects, angles, side), undamaged, delta, of).map_or(undamaged, |mean| mean.value)
}

/// d(elastic)/d(delta) of a contact, on damage or not, N/m.
pub fn tangent<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> f64 {
    if let Some(strips) = &law.strips {
        let on_damage = ball_contact::tangent(cuts(defects, angles, side), strips, delta);
        return on_damage.unwrap_or_else(|| law.tangent(delta, None));
    }
    if law_of(defects.clone()) == Law::Sliced {
        return over_slices(defects, angles, side, delta, |x| law.tangent(x, None));
    }
    let damaged = damaged_contact(defects, law, angles, side, delta);
    law.tangent(delta, damaged.map(|a| a.floor).as_ref())
}

/// Depth of the damage under a ball at the groove's bottom by its path, m; `None` where none is met.
pub fn depth_at_bottom<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    angles: &Angles,
    side: Side,
) -> Option<f64> {
    ball_contact::depth_at_bottom(cuts(defects, angles, side))
}

/// Elastic energy of a contact that may be on any of `defects`, J: the integral of the elastic sum up to delta.
pub fn energy<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> f64 {
    if let Some(strips) = &law.strips {
        let on_damage = ball_contact::energy(cuts(defects, angles, side), strips, delta);
        return on_damage.unwrap_or_else(|| law.energy(delta));
    }
    if law_of(defects.clone()) == Law::Sliced {
        return over_slices(defects, angles, side, delta, |x| law.energy(x));
    }
    if delta <= 0.0 {
        return 0.0;
    }
    let mut floors = floors(defects, angles, side);
    let all = floors.clone();
    match (floors.next(), floors.next()) {
        (None, _) => law.energy(delta),
        (Some(floor), None) => law.damaged_energy(delta, &floor),
        _ => {
            // Overlapping damage: the defect that counts may change on the way, so the work is integrated (midpoint
            // rule).
            const CELLS: u32 = 64;
            let dx = delta / f64::from(CELLS);
            let force = |x: f64| all.clone().map(|f| law.damaged(x, &f)).fold(f64::INFINITY, f64::min);
            (0..CELLS).map(|k| force((f64::from(k) + 0.5) * dx) * dx).sum()
        }
    }
}
