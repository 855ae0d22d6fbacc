//! The law `ecl`, the paper's effective contact length (section 3): what damage of one width L_s and one depth h_s leaves of a
//! contact. Of several defects at a contact the one with the smallest elastic sum acts.

use super::angles::Angles;
use super::placed::Defects;
use crate::contact::{ContactReduction, LoadDeflection};

/// What acts in one contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamagedContact {
    /// Elastic sum, N.
    pub elastic: f64,
    /// What the damage leaves.
    pub floor: ContactReduction,
}

/// What each defect under a contact leaves of it.
pub fn floors<'a>(defects: Defects<'a>, angles: &Angles) -> impl Iterator<Item = ContactReduction> + Clone + use<'a> {
    let angles = *angles;
    defects.iter().filter_map(move |d| d.floor(d.local_angle(&angles, defects.side), defects.side))
}

/// Depth of the damage under a ball at the groove's bottom by its path, m: all that the lumped model knows of it. `None` where
/// none is met.
pub fn depth_at_bottom(defects: Defects, angles: &Angles) -> Option<f64> {
    floors(defects, angles).map(|floor| floor.depth).filter(|depth| *depth > 0.0).reduce(f64::max)
}

/// What acts in the contact of a roller at `angles` that is pressed by `delta` (m), of which `power` is `[delta]_+^n`; `None` off
/// all damage.
#[inline]
pub fn damaged_contact(
    defects: Defects,
    law: &LoadDeflection,
    angles: &Angles,
    (delta, power): (f64, f64),
) -> Option<DamagedContact> {
    floors(defects, angles)
        .map(|floor| DamagedContact { elastic: law.damaged_given(power, delta, &floor), floor })
        .reduce(|a, b| {
            // With no force on either (a gap, or both floors below), the shorter remaining length represents the
            // contact.
            if b.elastic < a.elastic || (b.elastic == a.elastic && b.floor.share < a.floor.share) { b } else { a }
        })
}

/// Elastic energy of a contact that may be on any of `defects`, J: the integral of the elastic sum up to delta.
pub fn energy(defects: Defects, law: &LoadDeflection, angles: &Angles, delta: f64) -> f64 {
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
