//! What a conservative edge does: derivatives of a contact's elastic energy with the angles that carry it over damage.

use super::ball_contact;
use super::contact_defects::ContactDefects;
use super::damaged_contact::{cover_met, mean};
use super::depth_profile::Cover;
use super::track::settled;
use super::{Angles, Defects};
use crate::contact::LoadDeflection;
use crate::scenario::Surface;
use crate::slices;

/// Derivatives of a contact's elastic energy at a fixed deformation with the angles that carry it over damage, N m.
///
/// With E(x) the energy of the healthy contact at the deformation x and Q(x) its force, dE/ds = (1/n_s) sum over slices
/// of dphi_k/ds (E(delta - h_k) - E(delta)) - phi_k Q(delta - h_k) dh_k/ds; dE/du = R dE/ds, and u =
/// theta - psi, theta - psi - W or theta - phi - psi (+ pi) by the damaged surface: so dE/dtheta = dE/du always,
/// dE/dphi = -dE/du for a roller's defect, dE/dW = -dE/du for an inner one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EdgeGradient {
    /// dE/dtheta.
    pub orbit: f64,
    /// dE/dphi.
    pub spin: f64,
    /// dE/dW.
    pub ring: f64,
}

impl EdgeGradient {
    /// Adds dE/du of defects on one surface.
    fn add(&mut self, surface: Surface, slope: f64) {
        self.orbit += slope;
        match surface {
            Surface::OuterRaceway => {}
            Surface::InnerRaceway => self.ring -= slope,
            Surface::Roller(_) => self.spin -= slope,
        }
    }
}

/// Derivatives of an energy of what is one by central differences. Defects on the roller move over the contact apart
/// from those on the raceway.
fn central_differences(met: ContactDefects, mut energy: impl FnMut(ContactDefects) -> f64) -> EdgeGradient {
    /// m. A thousandth of what h changes over, and a hundred times the ridges that the search over several defects
    /// leaves out.
    const STEP: f64 = 1e-7;
    let mut gradient = EdgeGradient::default();
    for on_roller in [false, true] {
        let Some(one) = met.iter().find(|one| one.is_on_roller() == on_roller) else {
            continue;
        };
        let mut held = |by: f64| energy(met.moved(on_roller, by));
        let slope = (held(STEP) - held(-STEP)) / (2.0 * STEP);
        gradient.add(one.defect.surface, slope * one.defect.radius);
    }
    gradient
}

/// The derivatives under `sliced` and `envelope`. Of one defect exact; of several a central difference over 0.2 um of
/// the arc.
pub fn edge_gradient(defects: Defects, law: &LoadDeflection, angles: &Angles, delta: f64) -> EdgeGradient {
    let mut gradient = EdgeGradient::default();
    let met = ContactDefects::new(defects, angles);
    let Some((first, several)) = met.first() else {
        return gradient;
    };
    if several {
        if let Some(strips) = &law.strips {
            return central_differences(met, |moved| ball_contact::energy(moved, strips, delta).unwrap_or_default());
        }
        let undamaged = law.energy(delta);
        return central_differences(met, |moved| {
            mean(moved, undamaged, delta, |x| law.energy(x)).map_or(undamaged, |m| m.value)
        });
    }
    let (profile, s) = (first.profile, first.s);
    let slope = match &profile.cover {
        Cover::Unsliced => 0.0,
        Cover::Across(across) => law.strips.map_or(0.0, |strips| ball_contact::edge_slope(across, s, &strips, delta)),
        Cover::Even => {
            let phi = settled(first.defect.damaged_length(s) / first.defect.roller_length);
            let floor = profile.floor.as_ref();
            floor.map_or(0.0, |floor| -phi * law.healthy(delta - floor.value(s).max(0.0)) * floor.slope(s))
        }
        Cover::Slices(tracks) => {
            let whole = law.energy(delta);
            let mut sum = 0.0;
            for track in tracks {
                let (phi, h) = track.value(s);
                if phi > 0.0 {
                    let (widens, sinks) = track.slope(s);
                    let x = delta - h;
                    let edge = if phi < 1.0 && widens != 0.0 { widens * (law.energy(x) - whole) } else { 0.0 };
                    sum += track.count * (edge - phi * law.healthy(x) * sinks);
                }
            }
            sum / profile.slices as f64
        }
    };
    gradient.add(first.defect.surface, slope * first.defect.radius);
    gradient
}

/// Derivatives of the elastic energy that `energy` gives of what damage covers: central differences over 0.2 um of the
/// arc.
pub fn edge_gradient_of_slices(
    defects: Defects,
    angles: &Angles,
    cover: &mut slices::Cover,
    energy: impl Fn(Option<&slices::Cover>) -> f64,
) -> EdgeGradient {
    central_differences(ContactDefects::new(defects, angles), |moved| match cover_met(moved, cover) {
        true => energy(Some(cover)),
        false => energy(None),
    })
}
