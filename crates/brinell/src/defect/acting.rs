//! Force, stiffness and energy of a contact that stands on damage, one defect or several (section 3).
//!
//! Under `ecl` the defect with the smallest elastic sum acts. Under `sliced` each slice feels the deepest of the depths that damage it;
//! a defect that leaves a slice alone (h_k = 0) has no say there, so that it does not level another's raised edge. Along an envelope the
//! roller follows the envelope of that joint surface, neighbouring defects included.

use super::ground::Ground;
use super::joint::{Rest, Strip, rest};
use super::{Angles, Defect, Side};
use crate::contact::{Floor, Hertz};
use crate::scenario::{Law, Surface};

/// What acts in one contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Acting {
    /// Elastic sum, N.
    pub elastic: f64,
    /// What the damage leaves.
    pub floor: Floor,
}

/// One defect under one side of a roller.
#[derive(Clone, Copy)]
struct Cut<'a> {
    defect: &'a Defect,
    ground: &'a Ground,
    s: f64,
}

impl<'a> Cut<'a> {
    #[inline]
    fn depth(&self, k: usize) -> f64 {
        self.ground.slices[k].value(self.s)
    }

    /// Slice k of the surface before its envelope.
    fn strip(&self, k: usize) -> Strip<'a> {
        let surface = self.ground.surface.as_ref();
        Strip {
            lines: surface.map_or(&[], |x| &x.slices[k]),
            envelope: self.ground.slices.get(k),
            s: self.s,
        }
    }

    /// Distance of the line of contact from the damage, m; 0 on it.
    #[inline]
    fn away(&self) -> f64 {
        let (first, last) = self.ground.arc;
        (first - self.s).max(self.s - last).max(0.0)
    }
}

/// The defects that bear on a contact: none where it stands on no damage; along an envelope also those beside it that a roller, resting on the
/// deepest floor under it, would reach.
#[inline]
fn cuts<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    angles: &Angles,
    side: Side,
) -> impl Iterator<Item = Cut<'a>> + Clone {
    let angles = *angles;
    let all = defects.filter_map(move |defect| {
        let ground = defect.ground(side)?;
        let s = defect.local_angle(&angles, side) * defect.radius;
        Some(Cut { defect, ground, s })
    });
    let deepest = all
        .clone()
        .filter(|cut| cut.away() == 0.0)
        .map(|cut| cut.ground.surface.as_ref().map_or(0.0, |x| x.extremes.1))
        .reduce(f64::max);
    all.filter(move |cut| {
        let away = cut.away();
        deepest.is_some_and(|deepest| match &cut.ground.surface {
            None => away == 0.0,
            Some(x) => away * away <= 2.0 * x.radius * (deepest - x.extremes.0),
        })
    })
}

/// Where a roller rests on the joint surface of several defects in slice k; `None` at a point, and where one defect alone bears on the contact.
fn rest_on<'a>(
    cuts: impl Iterator<Item = Cut<'a>> + Clone,
    strip: impl Fn(&Cut<'a>) -> Strip<'a> + Clone,
) -> Option<Rest> {
    let surface = cuts.clone().next()?.ground.surface.as_ref()?;
    cuts.clone().nth(1)?;
    let lowest = cuts
        .clone()
        .filter_map(|cut| cut.ground.surface.as_ref())
        .map(|x| x.extremes.0)
        .fold(0.0, f64::min);
    let strips = cuts.map(move |cut| strip(&cut));
    Some(rest(strips, lowest, surface.radius))
}

/// The deeper of two depths of a slice, where each damages it.
#[inline]
fn deeper(a: f64, b: f64) -> f64 {
    if a == 0.0 || (b != 0.0 && b > a) {
        b
    } else {
        a
    }
}

/// Depth of slice k under several defects.
fn depth_of<'a>(cuts: impl Iterator<Item = Cut<'a>> + Clone, k: usize) -> f64 {
    match rest_on(cuts.clone(), move |cut| cut.strip(k)) {
        Some(rest) => rest.depth,
        None => cuts.fold(0.0, |h, cut| deeper(h, cut.depth(k))),
    }
}

/// Mean over the slices of f(delta - h_k); `undamaged` is f(delta), and nothing but undamaged slices gives it to the bit.
#[inline]
fn mean<'a>(
    mut cuts: impl Iterator<Item = Cut<'a>> + Clone,
    undamaged: f64,
    delta: f64,
    f: impl Fn(f64) -> f64,
) -> Option<f64> {
    let all = cuts.clone();
    let first = cuts.next()?;
    let several = cuts.next().is_some();
    let n = first.ground.slices.len();
    let (mut healthy, mut sum) = (0_usize, 0.0);
    for k in 0..n {
        let h = if several {
            depth_of(all.clone(), k)
        } else {
            first.depth(k)
        };
        if h == 0.0 {
            healthy += 1;
        } else {
            sum += f(delta - h);
        }
    }
    Some(if healthy == n {
        undamaged
    } else if healthy == 0 {
        sum / n as f64
    } else {
        (healthy as f64 * undamaged + sum) / n as f64
    })
}

/// Law of a model's defects; `Ecl` where there are none.
#[inline]
fn law_of<'a>(mut defects: impl Iterator<Item = &'a Defect>) -> Law {
    defects.next().map_or(Law::Ecl, |d| d.rules.law)
}

/// What acts in the contact of a roller at `angles` on `side` that is pressed by `delta` (m); `None` off all damage.
pub fn acting<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> Option<Acting> {
    acting_given(defects, law, angles, side, delta, law.exponent.of(delta))
}

/// The same where `[delta]_+^n` is known already.
#[inline]
pub fn acting_given<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
    power: f64,
) -> Option<Acting> {
    if law_of(defects.clone()) == Law::Sliced {
        let cuts = cuts(defects, angles, side);
        let undamaged = law.stiffness * power;
        let elastic = mean(cuts.clone(), undamaged, delta, |x| law.healthy(x))?;
        let (length, damaged) = cuts.fold((0.0, 0.0_f64), |(_, widest), cut| {
            (
                cut.defect.roller_length,
                widest.max(cut.defect.damaged_length(cut.s)),
            )
        });
        return Some(Acting {
            elastic,
            floor: Floor {
                share: 1.0 - damaged / length,
                depth: 0.0,
                damaged_length: damaged,
            },
        });
    }
    floors(defects, angles, side)
        .map(|floor| Acting {
            elastic: law.damaged_given(power, delta, &floor),
            floor,
        })
        .reduce(|a, b| {
            // With no force on either (a gap, or both floors below), the shorter remaining length stands for the contact.
            if b.elastic < a.elastic || (b.elastic == a.elastic && b.floor.share < a.floor.share) {
                b
            } else {
                a
            }
        })
}

/// What each defect under a contact leaves of it, under a law that knows one width and one depth.
///
/// Along an envelope, where several bear on the contact, the roller follows the envelope of the joint surface of their h_s; no floor is deeper for
/// that than its own defect is there. Each keeps its own L_s, so that a narrow pit in a wide dent makes the dent no deeper.
pub fn floors<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    angles: &Angles,
    side: Side,
) -> impl Iterator<Item = Floor> + Clone {
    let several = defects.clone().nth(1).is_some();
    let joint = several
        .then(|| {
            rest_on(cuts(defects.clone(), angles, side), |cut| Strip {
                lines: cut.ground.surface.as_ref().map_or(&[], |x| &x.floor),
                envelope: cut.ground.floor.as_ref(),
                s: cut.s,
            })
        })
        .flatten();
    let angles = *angles;
    defects.filter_map(move |d| {
        let u = d.local_angle(&angles, side);
        let floor = d.floor(u, side)?;
        Some(match &joint {
            None => floor,
            Some(rest) => Floor {
                depth: d.depth_at(u * d.radius).min(rest.depth).max(0.0),
                ..floor
            },
        })
    })
}

/// d(elastic)/d(delta) of a contact, on damage or not, N/m.
pub fn tangent<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> f64 {
    if law_of(defects.clone()) == Law::Sliced {
        let cuts = cuts(defects, angles, side);
        let undamaged = law.tangent(delta, None);
        return mean(cuts, undamaged, delta, |x| law.tangent(x, None)).unwrap_or(undamaged);
    }
    let acting = acting(defects, law, angles, side, delta);
    law.tangent(delta, acting.map(|a| a.floor).as_ref())
}

/// Elastic energy of a contact that may stand on any of `defects`, J: the integral of the acting elastic sum up to delta.
pub fn energy<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> f64 {
    if law_of(defects.clone()) == Law::Sliced {
        // Exact for several defects too: which depth acts in a slice does not depend on delta.
        let cuts = cuts(defects, angles, side);
        let undamaged = law.energy(delta);
        return mean(cuts, undamaged, delta, |x| law.energy(x)).unwrap_or(undamaged);
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
            // Overlapping damage: the acting defect may change on the way, so the work is integrated (midpoint rule).
            const CELLS: u32 = 64;
            let dx = delta / f64::from(CELLS);
            let force = |x: f64| {
                all.clone()
                    .map(|f| law.damaged(x, &f))
                    .fold(f64::INFINITY, f64::min)
            };
            (0..CELLS)
                .map(|k| force((f64::from(k) + 0.5) * dx) * dx)
                .sum()
        }
    }
}

/// Derivatives of a contact's elastic energy at a fixed approach with the angles that carry it over damage, N m.
///
/// dE/du = (1/n_s) sum over slices of Q(delta - h_k) (-dh_k/ds) R, and u = theta - psi, theta - psi - W or theta - phi - psi (+ pi) by the
/// damaged surface: so dE/dtheta = dE/du always, dE/dphi = -dE/du for a roller's defect, dE/dW = -dE/du for an inner one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EdgeGradient {
    /// dE/dtheta.
    pub orbit: f64,
    /// dE/dphi.
    pub spin: f64,
    /// dE/dW.
    pub ring: f64,
}

/// The derivatives under `sliced`; each slice counts for the defect that acts in it, or for those that the roller rests on.
pub fn edge_gradient<'a>(
    defects: impl Iterator<Item = &'a Defect> + Clone,
    law: &Hertz,
    angles: &Angles,
    side: Side,
    delta: f64,
) -> EdgeGradient {
    let mut gradient = EdgeGradient::default();
    let cuts = cuts(defects, angles, side);
    let Some(first) = cuts.clone().next() else {
        return gradient;
    };
    let n = first.ground.slices.len();
    let mut add = |slope: f64, cut: Cut| {
        gradient.orbit += slope;
        match cut.defect.surface {
            Surface::OuterRaceway => {}
            Surface::InnerRaceway => gradient.ring -= slope,
            Surface::Roller(_) => gradient.spin -= slope,
        }
    };
    for k in 0..n {
        // dE over an arc of the damage, N.
        let push = |h: f64| -law.healthy(delta - h) / n as f64;
        if let Some(rest) = rest_on(cuts.clone(), move |cut| cut.strip(k)) {
            if rest.depth != 0.0 {
                for (strip, slope) in rest.slopes {
                    if let Some(cut) = cuts.clone().nth(strip) {
                        add(push(rest.depth) * slope * cut.defect.radius, cut);
                    }
                }
            }
            continue;
        }
        let (h, cut) = cuts.clone().fold((0.0, first), |(h, acting), cut| {
            let own = cut.depth(k);
            if deeper(h, own) == h {
                (h, acting)
            } else {
                (own, cut)
            }
        });
        if h != 0.0 {
            let slope = cut.ground.slices[k].slope(cut.s);
            add(push(h) * slope * cut.defect.radius, cut);
        }
    }
    gradient
}
