//! What damage leaves of a contact by its tables: section 19.
//!
//! Where two damaged surfaces meet at one contact, delta_eff = delta_eff2(delta_eff1(delta, s1), s2), with derivatives by the chain
//! rule.

use super::Side;
use super::angles::Angles;
use super::placed::{Defect, Defects};
use crate::effective::Leaning;
use crate::scenario::Surface;

/// delta_eff of a contact and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Met {
    /// delta_eff, m.
    pub delta: f64,
    /// d(delta_eff)/d(delta).
    pub by_delta: f64,
    /// d(delta_eff)/d(tilt), m.
    pub by_tilt: f64,
    /// d2(delta_eff)/d(delta)2, 1/m.
    pub by_delta2: f64,
    /// d2(delta_eff)/d(delta)d(tilt).
    pub by_delta_tilt: f64,
    /// d2(delta_eff)/d(tilt)2, m.
    pub by_tilt2: f64,
    /// d(delta_eff)/du of the damaged raceway, m/rad.
    pub by_raceway: f64,
    /// The same of the damaged rolling element.
    pub by_element: f64,
}

impl Met {
    /// A healthy contact at the deformation `delta`, m.
    pub(super) fn healthy(delta: f64) -> Self {
        Self {
            delta,
            by_delta: 1.0,
            by_tilt: 0.0,
            by_delta2: 0.0,
            by_delta_tilt: 0.0,
            by_tilt2: 0.0,
            by_raceway: 0.0,
            by_element: 0.0,
        }
    }
}

impl Defects<'_> {
    /// delta_eff of a contact at `angles` whose healthy deformation is `delta`, m, and changes by `tilt` along z where it
    /// tilts; `None` off every table.
    #[inline]
    pub fn effective(self, angles: &Angles, delta: f64, tilt: Option<f64>) -> Option<Met> {
        let mut met: Option<Met> = None;
        for defect in self.iter() {
            let s = defect.local_angle(angles, self.side) * defect.radius;
            let before = met.unwrap_or(Met::healthy(delta));
            let Some(on) = looked_up(defect, self.side, s, (before.delta, tilt)) else {
                continue;
            };
            let by_u = on.by_s * defect.radius;
            let [raceway, element] = match defect.surface {
                Surface::Roller(_) => [0.0, by_u],
                Surface::OuterRaceway | Surface::InnerRaceway => [by_u, 0.0],
            };
            met = Some(Met {
                delta: on.delta,
                by_delta: on.by_delta * before.by_delta,
                by_tilt: on.by_delta * before.by_tilt + on.by_tilt,
                by_delta2: on.by_delta2 * before.by_delta * before.by_delta + on.by_delta * before.by_delta2,
                by_delta_tilt: (on.by_delta2 * before.by_tilt + on.by_delta_tilt) * before.by_delta
                    + on.by_delta * before.by_delta_tilt,
                by_tilt2: (on.by_delta2 * before.by_tilt + 2.0 * on.by_delta_tilt) * before.by_tilt
                    + on.by_tilt2
                    + on.by_delta * before.by_tilt2,
                by_raceway: on.by_delta * before.by_raceway + raceway,
                by_element: on.by_delta * before.by_element + element,
            });
        }
        met
    }
}

/// What one defect's table says at s (m); `None` off it.
#[inline]
fn looked_up(defect: &Defect, side: Side, s: f64, (delta, tilt): (f64, Option<f64>)) -> Option<Leaning> {
    let within = |[first, last]: [f64; 2]| s >= first && s <= last;
    match tilt {
        None => {
            let table = defect.table(side)?;
            within(table.range_s()).then(|| Leaning::upright(table.at(delta, s)))
        }
        Some(tilt) => {
            let tables = defect.tilted(side)?;
            within(tables.range_s()).then(|| tables.at(delta, tilt, s))
        }
    }
}
