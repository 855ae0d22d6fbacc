//! A normal contact law of the user's own, in place of the program's.

use super::{SIDES, Side};
use std::f64::consts::TAU;

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
    /// Sample `k` of a side: over a turn of raceway and element, and over rows and elements (numbers of both).
    fn sample(side: Side, k: usize, (rows, elements): (usize, usize)) -> Self {
        // Steps that fill both turns evenly, whatever the number of samples.
        const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
        let [on_raceway, on_element] = STEPS.map(|step| TAU * (k as f64 * step).fract());
        Self { side, row: k % rows, element: k % elements, on_raceway, on_element }
    }
}

/// A contact at rest: its elastic energy E(delta, place) and the derivatives of E.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Elastic {
    /// E, J.
    pub energy: f64,
    /// dE/d(delta), N: the normal force, never negative.
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
/// All forces follow from E; [`check`] holds the derivatives against differences of E, and no run begins where they are not those. Damping and friction stay
/// those of the scenario: damping by the tangent (`contact.damping`), friction by the force. The program's law, its damage included, does not act
/// beside it: defects of the scenario then only mark where rolling elements enter and leave. Waviness does. The law is called for every contact at every evaluation and
/// must not allocate.
pub trait ContactLaw: std::fmt::Debug + Send + Sync {
    /// The contact at the deformation `delta` (m, negative where healthy surfaces are apart).
    fn at(&self, place: &Place, delta: f64) -> Elastic;
}

/// Deformation of the contact at a place under `force` (N, from 0), m: by bisection up to 1 mm.
pub(crate) fn deflection(law: &dyn ContactLaw, place: &Place, force: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e-3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if law.at(place, middle).force < force {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// The contacts that statics, life and the solver's longest step are for: of each side the one of the median deflection under 100 N, which damage that
/// is short of half a turn leaves alone.
pub(crate) fn usual(law: &dyn ContactLaw, counts: (usize, usize)) -> [Place; 2] {
    SIDES.map(|side| {
        let one = |k| Place::sample(side, k, counts);
        let mut all: Vec<(f64, Place)> =
            (0..25).map(one).map(|place| (deflection(law, &place, 100.0), place)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all[12].1
    })
}

/// Samples of each side and deformation.
const SAMPLES: usize = 2000;
/// Deformations at which a law is held against differences of its energy, m.
const DEFORMATIONS: [f64; 5] = [-5e-6, 0.3e-6, 2e-6, 8e-6, 30e-6];
/// Error of a derivative that differences explain, and the share of samples, near kinks, at which it may be larger.
const MISSED: (f64, f64) = (0.01, 0.1);

/// A law at one place: its derivatives as it gives them, and by differences.
struct Sampled {
    place: Place,
    delta: f64,
    given: [f64; 4],
    found: [f64; 4],
}

impl Sampled {
    /// # Errors
    /// Where a number of the law is not finite.
    fn new(law: &dyn ContactLaw, place: Place, delta: f64) -> Result<Self, String> {
        let at = law.at(&place, delta);
        let given = [at.force, at.tangent, at.by_raceway, at.by_element];
        if given.iter().chain([&at.energy]).any(|x| !x.is_finite()) {
            return Err(format!("not finite at {place:?}, delta = {delta} m: {at:?}"));
        }
        let turned = |raceway: f64, element: f64| {
            let (on_raceway, on_element) = (place.on_raceway + raceway, place.on_element + element);
            law.at(&Place { on_raceway, on_element, ..place }, delta).energy
        };
        let (h, angle) = (1e-4 * delta.abs(), 1e-6);
        let [before, after] = [-h, h].map(|h| law.at(&place, delta + h));
        let found = [
            (after.energy - before.energy) / (2.0 * h),
            (after.force - before.force) / (2.0 * h),
            (turned(angle, 0.0) - turned(-angle, 0.0)) / (2.0 * angle),
            (turned(0.0, angle) - turned(0.0, -angle)) / (2.0 * angle),
        ];
        Ok(Self { place, delta, given, found })
    }

    fn size(&self, n: usize) -> f64 {
        self.given[n].abs().max(self.found[n].abs())
    }

    /// Relative to the size.
    fn error(&self, n: usize) -> f64 {
        (self.given[n] - self.found[n]).abs() / self.size(n)
    }
}

/// Holds a law's derivatives against differences of its energy, and the tangent against those of its force, over bearings of so many rows and elements.
///
/// # Errors
/// Which derivative is wrong, where, and both numbers.
pub fn check(law: &dyn ContactLaw, counts: (usize, usize)) -> Result<(), String> {
    const NAMES: [&str; 4] = ["force (N)", "tangent (N/m)", "by_raceway (N m)", "by_element (N m)"];
    let all = SIDES.into_iter().flat_map(|side| (0..SAMPLES).map(move |k| (side, k)));
    let sampled = |(side, k)| Sampled::new(law, Place::sample(side, k, counts), DEFORMATIONS[k % DEFORMATIONS.len()]);
    let samples: Vec<Sampled> = all.map(sampled).collect::<Result<_, _>>()?;
    for (n, name) in NAMES.into_iter().enumerate() {
        let largest = samples.iter().map(|s| s.size(n)).fold(0.0, f64::max);
        let counted: Vec<&Sampled> = samples.iter().filter(|s| s.size(n) > 1e-3 * largest).collect();
        let wrong = counted.iter().filter(|s| s.error(n) > MISSED.0).count();
        let worst = counted.iter().max_by(|a, b| a.error(n).total_cmp(&b.error(n)));
        if let Some(Sampled { place, delta, given, found }) = worst
            && wrong as f64 > MISSED.1 * counted.len() as f64
        {
            return Err(format!(
                "{name} is not the derivative at {wrong} of {} samples: {:.4e} given, {:.4e} by differences, at {place:?}, delta = {delta} m",
                counted.len(),
                given[n],
                found[n]
            ));
        }
    }
    Ok(())
}
