//! A normal contact law of the user's own, in place of the program's.

use super::Side;

/// A contact: which it is, and where its bodies have turned to. Rows and rolling elements count from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The raceway that is touched.
    pub side: Side,
    /// The row.
    pub row: usize,
    /// The rolling element within its row.
    pub element: usize,
    /// Angle on the raceway, rad: counter-clockwise, fixed to the ring, 0 where a defect with `center_deg = 0` lies. Not reduced to one turn.
    pub on_raceway: f64,
    /// The same on the rolling element.
    pub on_element: f64,
}

impl Place {
    /// The first contact of a side, nothing turned.
    pub fn of(side: Side) -> Self {
        Self { side, row: 0, element: 0, on_raceway: 0.0, on_element: 0.0 }
    }
}

/// A contact at rest: its elastic energy E(delta, place) and the derivatives of E.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Elastic {
    /// E, J.
    pub energy: f64,
    /// dE/d(delta), N: the normal force, from 0.
    pub force: f64,
    /// d²E/d(delta)², N/m.
    pub tangent: f64,
    /// dE/d(on_raceway) at fixed delta, N m: what a surface that changes along the raceway pushes.
    pub by_raceway: f64,
    /// dE/d(on_element), N m.
    pub by_element: f64,
}

/// A normal contact law for [`Custom`](crate::Custom): E and its derivatives, healthy and damaged, for every contact of the bearing.
///
/// All forces follow from E, so that the energy audit of a run closes exactly where the derivatives are those of E. Damping and friction stay
/// those of the scenario: damping by the tangent (`contact.damping`), friction by the force. The program's law, its damage included, does not act
/// beside it: defects of the scenario then only mark where rolling elements enter and leave. The law is called for every contact at every evaluation and
/// must not allocate.
pub trait ContactLaw: std::fmt::Debug + Send + Sync {
    /// The contact at the deformation `delta` (m, negative where healthy surfaces are apart).
    fn at(&self, place: &Place, delta: f64) -> Elastic;

    /// Deformation under `force` (N, from 0) of the contact that statics, life and the solver's longest step are for, m: by default
    /// [`Place::of`] that side, by bisection between 0 and 1 mm.
    fn deflection(&self, side: Side, force: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1e-3);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.at(&Place::of(side), middle).force < force {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}
