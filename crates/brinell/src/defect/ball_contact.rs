//! Force, stiffness and energy of a ball's contact that is on damage (section 17).
//!
//! The ellipse's load is carried by independent strips across the groove ([`Strips`]). Damage divides its own axial
//! extent into slices; over the covered part of a slice the strips are pressed by delta - h_k, over everything else by
//! delta. No term is negative: an ellipse wholly within a pit carries exactly nothing.

use super::across::Across;
use super::contact_defects::{ContactDefects, DamagedContact, joint};
use super::depth_profile::Cover;
use super::extent::slice_borders;
use super::joint::envelope_depth;
use crate::contact::ContactReduction;
use crate::contact::ball::{Pressed, Strips};

const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Hands every part of the ellipse to `add`, with its weight and what presses it. `None` where no damage is met.
#[inline]
fn parts(met: ContactDefects, strips: &Strips, delta: f64, mut add: impl FnMut(f64, &Pressed, [f64; 2])) -> Option<()> {
    let (first, several) = met.first()?;
    let whole = strips.pressed(delta);
    // Where the undamaged part begins that is not added yet.
    let mut from = f64::NEG_INFINITY;
    let mut side = 1.0;
    let mut slice = |side: f64, from: &mut f64, z: [f64; 2], phi: f64, h: f64| {
        add(side, &whole, [*from, z[0]]);
        if phi < 1.0 {
            add(side * (1.0 - phi), &whole, z);
        }
        add(side * phi, &strips.pressed(delta - h), z);
        *from = z[1];
    };
    if several {
        let size = (first.profile.slices, first.profile.extent);
        joint(met, size, |k, phi, h| {
            let z = slice_borders(k, size.0, size.1);
            slice(1.0, &mut from, z, phi, h);
        });
    } else if let Cover::Across(across) = &first.profile.cover {
        if across.mirrored {
            (from, side) = (0.0, 2.0);
        }
        let end = strips.pressed(delta + across.raised).length([0.0, f64::INFINITY]);
        for (z, track) in &across.ranges {
            if z[0] >= end {
                break;
            }
            if z[1] > -end {
                let (phi, h) = track.value(first.s);
                if phi > 0.0 {
                    slice(side, &mut from, *z, phi, h);
                }
            }
        }
    }
    add(side, &whole, [from, f64::INFINITY]);
    Some(())
}

/// What acts where the contact is on damage; `None` off all of it. Its length is what is not carried of the ellipse's
/// axis across.
#[inline]
pub(super) fn damaged(met: ContactDefects, strips: &Strips, delta: f64) -> Option<DamagedContact> {
    let (mut area, mut carried) = (0.0, 0.0);
    parts(met, strips, delta, |weight, pressed, z| {
        area += weight * pressed.area(z);
        carried += weight * pressed.length(z);
    })?;
    let axis = strips.pressed(delta).length(EVERYWHERE);
    Some(DamagedContact {
        elastic: strips.stiffness * area,
        floor: ContactReduction {
            share: if axis > 0.0 { carried / axis } else { 0.0 },
            depth: 0.0,
            damaged_length: axis - carried,
        },
    })
}

/// d(elastic)/d(delta) on damage, N/m; `None` off all of it.
pub(super) fn tangent(met: ContactDefects, strips: &Strips, delta: f64) -> Option<f64> {
    let mut carried = 0.0;
    parts(met, strips, delta, |weight, pressed, z| {
        carried += weight * pressed.length(z);
    })?;
    Some(strips.stiffness * carried)
}

/// Elastic energy on damage, J; `None` off all of it.
pub(super) fn energy(met: ContactDefects, strips: &Strips, delta: f64) -> Option<f64> {
    let mut sum = 0.0;
    parts(met, strips, delta, |weight, pressed, z| {
        sum += weight * pressed.half_squares(z);
    })?;
    Some(strips.stiffness * sum)
}

/// dE/ds of one defect's contact at a fixed deformation, N.
pub(super) fn edge_slope(across: &Across, s: f64, strips: &Strips, delta: f64) -> f64 {
    let whole = strips.pressed(delta);
    let mut sum = 0.0;
    for (z, track) in &across.ranges {
        let (phi, h) = track.value(s);
        if phi > 0.0 {
            let (widens, sinks) = track.slope(s);
            let sunk = strips.pressed(delta - h);
            if phi < 1.0 && widens != 0.0 {
                sum += widens * (sunk.half_squares(*z) - whole.half_squares(*z));
            }
            sum -= phi * sunk.area(*z) * sinks;
        }
    }
    let sides = if across.mirrored { 2.0 } else { 1.0 };
    sides * strips.stiffness * sum
}

/// Depth of the damage under the groove's bottom, z = 0, by the ball's path, m: all that the lumped model knows of it.
/// `None` where no damage is met.
pub(super) fn depth_at_bottom(met: ContactDefects) -> Option<f64> {
    let (first, _) = met.first()?;
    Some(match &first.profile.surface {
        None => met.iter().filter_map(|one| one.under(0.0)).fold(0.0, f64::max),
        Some(surface) => {
            let lines = met.iter().filter_map(|one| one.arc_line(0.0));
            envelope_depth(lines, surface.extremes.0, surface.radius).max(0.0)
        }
    })
}
