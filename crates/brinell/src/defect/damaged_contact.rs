//! Force, stiffness and energy of a contact that is on damage, one defect or several (section 3).
//!
//! Under `ecl` the defect with the smallest elastic sum acts. Under `sliced` all defects at a contact are one surface,
//! the deepest at each point; a defect that leaves a point alone has no say there, so that it does not level another's
//! raised edge. Along an envelope the roller follows the envelope of that joint surface, neighbouring defects included.

use super::angles::Angles;
use super::ball_contact;
use super::contact_defects::{ContactDefects, DamagedContact, joint, rolling};
use super::depth_profile::Cover;
use super::joint::{ArcLine, Depths, envelope_depth};
use super::placed::Defects;
use super::track::settled;
use crate::contact::{ContactReduction, LoadDeflection};
use crate::scenario::Law;
use crate::slices::{self, borders};

/// Mean over the roller's length of a function of what presses there.
pub(super) struct Mean {
    pub(super) value: f64,
    /// Share of the length that damage takes from the contact: what it covers; where some of it is raised, what does
    /// not touch.
    lost: f64,
}

/// Mean of f(delta - h) over what is damaged and of f(delta), which is `undamaged`, over the rest; where nothing is,
/// that to the bit.
#[inline]
pub(super) fn mean(met: ContactDefects, undamaged: f64, delta: f64, f: impl Fn(f64) -> f64) -> Option<Mean> {
    let (first, several) = met.first()?;
    let profile = first.profile;
    let n = profile.slices as f64;
    // What is covered, slices with any depth, what is left of them, and the sum over the rest; a slice counts 1.
    let (mut covered, mut sunk, mut left, mut sum) = (0.0, 0.0, 0.0, 0.0);
    // What of the covered touches, and whether any is raised.
    let (mut touching, mut raised) = (0.0, false);
    let mut add = |count: f64, phi: f64, h: f64| {
        covered += count * phi;
        raised |= h < 0.0;
        if delta - h > 0.0 {
            touching += count * phi;
        }
        if h != 0.0 {
            sunk += count;
            left += count * (1.0 - phi);
            sum += count * phi * f(delta - h);
        }
    };
    if several {
        let size = (profile.slices, profile.extent);
        joint(met, size, |_, phi, h| add(1.0, phi, h));
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
    let left = left + (n - sunk);
    Some(Mean {
        value: if sunk == 0.0 {
            undamaged
        } else if left == 0.0 {
            sum / n
        } else {
            (left * undamaged + sum) / n
        },
        lost: match raised {
            true => 1.0 - (touching + if delta > 0.0 { n - covered } else { 0.0 }) / n,
            false => covered / n,
        },
    })
}

/// phi_k and h_k of every slice under a contact, into `cover`; false where it is on no damage, and nothing is written.
pub fn cover_slices(defects: Defects, angles: &Angles, cover: &mut slices::Cover) -> bool {
    cover_met(ContactDefects::new(defects, angles), cover)
}

pub(super) fn cover_met(met: ContactDefects, cover: &mut slices::Cover) -> bool {
    let Some((first, several)) = met.first() else {
        return false;
    };
    let (profile, s) = (first.profile, first.s);
    let (count, length) = (profile.slices, first.defect.roller_length);
    cover.fraction.fill(0.0);
    cover.depth.fill(0.0);
    let mut put = |k: usize, phi: f64, h: f64| {
        (cover.fraction[k], cover.depth[k]) = (phi, h);
    };
    if several {
        joint(met, (count, profile.extent), put);
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

/// What acts in the contact of a roller at `angles` that is pressed by `delta` (m); `None` off all damage.
pub fn damaged_contact(defects: Defects, law: &LoadDeflection, angles: &Angles, delta: f64) -> Option<DamagedContact> {
    damaged_contact_given(defects, law, angles, delta, law.exponent.of(delta))
}

/// The same where `[delta]_+^n` is known already.
#[inline]
pub fn damaged_contact_given(
    defects: Defects,
    law: &LoadDeflection,
    angles: &Angles,
    delta: f64,
    power: f64,
) -> Option<DamagedContact> {
    if let Some(strips) = &law.strips {
        return ball_contact::damaged(ContactDefects::new(defects, angles), strips, delta);
    }
    if defects.law() == Law::Sliced {
        let met = ContactDefects::new(defects, angles);
        let undamaged = law.stiffness * power;
        let length = met.iter().next()?.defect.roller_length;
        let mean = mean(met, undamaged, delta, |x| law.healthy(x))?;
        return Some(DamagedContact {
            elastic: mean.value,
            floor: ContactReduction { share: 1.0 - mean.lost, depth: 0.0, damaged_length: mean.lost * length },
        });
    }
    floors(defects, angles)
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
pub fn floors<'a>(defects: Defects<'a>, angles: &Angles) -> impl Iterator<Item = ContactReduction> + Clone + use<'a> {
    let several = defects.iter().nth(1).is_some();
    let joint = several
        .then(|| {
            let met = ContactDefects::new(defects, angles);
            let (lowest, radius) = rolling(met)?;
            met.iter().nth(1)?;
            let lines = met.iter().filter_map(|one| {
                let floor = &one.profile.surface.as_ref()?.floor;
                let depths = Depths::Lines(floor, one.profile.floor.as_ref());
                Some(ArcLine { depths, s: one.s })
            });
            Some(envelope_depth(lines, lowest, radius))
        })
        .flatten();
    let angles = *angles;
    defects.iter().filter_map(move |d| {
        let u = d.local_angle(&angles, defects.side);
        let floor = d.floor(u, defects.side)?;
        Some(match &joint {
            None => floor,
            Some(rest) => ContactReduction { depth: d.depth_at(u * d.radius).min(*rest).max(0.0), ..floor },
        })
    })
}

/// Mean over the slices of what the deformation of each, m, gives.
#[inline]
fn over_slices(defects: Defects, angles: &Angles, delta: f64, of: impl Fn(f64) -> f64) -> f64 {
    let undamaged = of(delta);
    mean(ContactDefects::new(defects, angles), undamaged, delta, of).map_or(undamaged, |mean| mean.value)
}

/// d(elastic)/d(delta) of a contact, on damage or not, N/m.
pub fn tangent(defects: Defects, law: &LoadDeflection, angles: &Angles, delta: f64) -> f64 {
    if let Some(strips) = &law.strips {
        let on_damage = ball_contact::tangent(ContactDefects::new(defects, angles), strips, delta);
        return on_damage.unwrap_or_else(|| law.tangent(delta, None));
    }
    if defects.law() == Law::Sliced {
        return over_slices(defects, angles, delta, |x| law.tangent(x, None));
    }
    let damaged = damaged_contact(defects, law, angles, delta);
    law.tangent(delta, damaged.map(|a| a.floor).as_ref())
}

/// Depth of the damage under a ball at the groove's bottom by its path, m; `None` where none is met.
pub fn depth_at_bottom(defects: Defects, angles: &Angles) -> Option<f64> {
    ball_contact::depth_at_bottom(ContactDefects::new(defects, angles))
}

/// Elastic energy of a contact that may be on any of `defects`, J: the integral of the elastic sum up to delta.
pub fn energy(defects: Defects, law: &LoadDeflection, angles: &Angles, delta: f64) -> f64 {
    if let Some(strips) = &law.strips {
        let on_damage = ball_contact::energy(ContactDefects::new(defects, angles), strips, delta);
        return on_damage.unwrap_or_else(|| law.energy(delta));
    }
    if defects.law() == Law::Sliced {
        return over_slices(defects, angles, delta, |x| law.energy(x));
    }
    if delta <= 0.0 {
        return 0.0;
    }
    let mut floors = floors(defects, angles);
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
