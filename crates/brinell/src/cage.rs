//! The cage: its pockets, Eqs. (44)-(50), and the film and land that guide it, Eqs. (42)-(43).
//!
//! Sections 5 and 6 of the model. SI; e_r and e_t are the roller's radial and tangential directions, s > 0 where the
//! pocket runs ahead of its roller.

mod film;
mod wall;

pub use film::HalfFilm;
pub use wall::{OIL_FORCE, OiledWall};

use crate::lanes::Lanes;
use crate::scenario::GuidanceFilm;
use std::f64::consts::PI;

/// Largest eccentricity ratio for which the short-bearing film is evaluated.
pub const MAX_ECCENTRICITY: f64 = 0.95;

/// Traction coefficient of the pocket at high slip, Eq. (48).
pub const TRACTION_LIMIT: f64 = 0.1;
/// Its initial slope, s/m.
pub const TRACTION_SLOPE: f64 = 22.28;
/// Its decay, s/m.
pub const TRACTION_DECAY: f64 = 181.46;

/// Traction coefficient of the pocket at the slip velocity |u| (m/s), Eq. (48).
#[inline(always)]
pub fn traction<L: Lanes>(u: L) -> L {
    // Beyond this slip the exponential is below the last bit of the limit.
    let u = u.abs().at_most(L::splat(40.0 / TRACTION_DECAY));
    let limit = L::splat(TRACTION_LIMIT);
    let rise = u.times_plus(L::splat(TRACTION_SLOPE), -limit);
    rise.times_plus((u * L::splat(-TRACTION_DECAY)).exp(), limit)
}

/// Contact of rollers and pockets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pocket {
    /// k_c, N/m.
    pub stiffness: f64,
    /// c_c, N s/m.
    pub damping: f64,
    /// C_p to each side, m.
    pub clearance: f64,
    /// Oiled walls in place of spring and damper, with mu_p (section 21).
    pub wall: Option<(OiledWall, f64)>,
    /// Whether it holds its element in every direction.
    pub is_round: bool,
}

impl Pocket {
    /// |F_c| and its elastic part in each lane, N, at the distance x >= 0 of the element from the pocket's middle (m), the play
    /// (C_p, so wide for padding that it never closes) with 1/C_p, and the rate of x, m/s.
    #[inline(always)]
    pub fn wall_force<L: Lanes>(&self, x: L, play: (L, L), rate: L) -> (L, L) {
        match &self.wall {
            Some((wall, _)) => wall.press(x, play, rate),
            None => self.press((x - play.0).positive_part(), rate),
        }
    }

    /// Friction over the slip u (m/s), along it and against it, N, under the normal force `size`; `v_s` is the slip velocity of
    /// the raceways.
    #[inline(always)]
    pub fn friction<L: Lanes>(&self, size: L, u: L, per_slip: L) -> L {
        match self.wall {
            Some((_, coefficient)) => L::splat(coefficient) * size * (u * per_slip).tanh(),
            None => (traction(u) * size).with_sign_of(u),
        }
    }

    /// Elastic energy of a pocket at the distance x of its element from its middle, J.
    pub fn energy(&self, x: f64) -> f64 {
        match &self.wall {
            Some((wall, _)) => wall.energy(x.abs(), self.clearance),
            None => 0.5 * self.stiffness * self.penetration(x).powi(2),
        }
    }

    /// |F_c| and its elastic part in each lane, N: Eqs. (44), (45), of the deformation beyond the clearance (m, 0 where the pocket is open) and
    /// the rate at which the gap on that side closes (m/s).
    #[inline(always)]
    pub fn press<L: Lanes>(&self, depth: L, closing: L) -> (L, L) {
        let elastic = L::splat(self.stiffness) * depth;
        let size = closing.times_plus(L::splat(self.damping), elastic);
        let size = depth.if_above(L::zero(), size.positive_part(), L::zero());
        (size, elastic)
    }

    /// Deformation beyond the clearance, signed as s, m.
    #[inline]
    pub fn penetration(&self, s: f64) -> f64 {
        if s > self.clearance {
            s - self.clearance
        } else if s < -self.clearance {
            s + self.clearance
        } else {
            0.0
        }
    }
}

/// `along` times a vector and `across` times the same turned by +90 degrees.
#[inline]
fn turned(of: [f64; 2], along: f64, across: f64) -> [f64; 2] {
    [along * of[0] - across * of[1], along * of[1] + across * of[0]]
}

/// Film and land between the cage and its guiding ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guide {
    /// Law of the film; none where rollers guide and a land alone is there.
    pub film: Option<GuidanceFilm>,
    /// eta, Pa s.
    pub viscosity: f64,
    /// C_g, radial, m.
    pub clearance: f64,
    /// L_1, m.
    pub width: f64,
    /// R_1, guiding surface's radius on the cage, m.
    pub radius: f64,
    /// k_c of the land, N/m.
    pub land_stiffness: f64,
    /// c_c of the land, N s/m; 0 for the paper's, which has no damping.
    pub land_damping: f64,
    /// The land in place of spring and damper (section 21); a ring without a land has none and no film.
    pub wall: LandLaw,
}

/// What stops a cage at its guiding ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LandLaw {
    /// Nothing: round pockets alone hold the cage.
    None,
    /// Spring and damper from the play on.
    Linear,
    /// Oil and steel.
    Oiled(OiledWall),
}

/// What the guide does to the cage; the guiding ring gets the opposite force.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct GuideForce {
    /// Film force on the cage, N.
    pub film: [f64; 2],
    /// Land force on the cage, N.
    pub land: [f64; 2],
    /// Moment on the cage, N m.
    pub moment: f64,
    /// What the land's damping dissipates, W.
    pub land_loss: f64,
    /// Bound of the film's damping in any direction, -dF/dv, N s/m: what limits an explicit step.
    pub damping: f64,
}

impl GuideForce {
    /// The land's push on a cage that is `e` off its centre, m: `law` gives it, and its elastic part, at e and its rate.
    fn push(&mut self, offset: [f64; 2], velocity: [f64; 2], e: f64, law: impl FnOnce(f64, f64) -> (f64, f64)) {
        if e > 0.0 {
            let n = offset.map(|x| x / e);
            let rate = velocity[0] * n[0] + velocity[1] * n[1];
            let (push, elastic) = law(e, rate);
            self.land = n.map(|x| -push * x);
            self.land_loss = (push - elastic) * rate;
        }
    }
}

impl Guide {
    /// Force and moment for the cage's `offset` (m) and `velocity` (m/s) from its guiding ring, its speed and the
    /// ring's (rad/s): Ocvirk's short bearing with the half film that pushes (Guembel). Valid to an eccentricity ratio
    /// of 0.95, held there beyond.
    ///
    /// `Dynamic` holds for any motion of the centres. Seen in a frame that turns at half the sum of both speeds the
    /// film is squeezed alone, so that its force never does work there. `QuasiStatic`, Eq. (42), is the same force for
    /// resting centres, whatever they do.
    #[inline(always)]
    pub fn force(&self, offset: [f64; 2], velocity: [f64; 2], cage_speed: f64, ring_speed: f64) -> GuideForce {
        let mut f = GuideForce::default();
        // Offsets are far from where squares overflow.
        let square = offset[0] * offset[0] + offset[1] * offset[1];
        match self.wall {
            LandLaw::None => {}
            LandLaw::Linear if square <= self.clearance * self.clearance => {}
            LandLaw::Linear => self.dry_land(&mut f, offset, velocity, square.sqrt()),
            // Without oil of its own nothing before the wall.
            LandLaw::Oiled(wall) if wall.film == 0.0 && square <= self.clearance * self.clearance => {}
            LandLaw::Oiled(wall) => {
                let play = (self.clearance, 1.0 / self.clearance);
                f.push(offset, velocity, square.sqrt(), |e, rate| wall.press(e, play, rate))
            }
        }
        let Some(film) = self.film else {
            return f;
        };
        let per_clearance = 1.0 / self.clearance;
        let mut ratio = offset.map(|x| x * per_clearance);
        let mut ratio2 = square * per_clearance * per_clearance;
        if ratio2 > MAX_ECCENTRICITY * MAX_ECCENTRICITY {
            let held = MAX_ECCENTRICITY / ratio2.sqrt();
            ratio = ratio.map(|x| x * held);
            ratio2 = MAX_ECCENTRICITY * MAX_ECCENTRICITY;
        }
        let per_gap = 1.0 / (1.0 - ratio2);
        let per_root = per_gap.sqrt();
        let shear = self.radius * (cage_speed - ring_speed);
        f.moment = -2.0 * PI * self.viscosity * shear * self.radius.powi(2) * self.width * per_clearance * per_root;
        match film {
            GuidanceFilm::QuasiStatic => {
                let entrainment = self.radius * (cage_speed + ring_speed);
                let scale = self.viscosity * self.width.powi(3) * per_clearance * per_clearance;
                // Over the eccentricity ratio, which its direction brings.
                let normal = -scale * entrainment.abs() * ratio2.sqrt() * per_gap * per_gap;
                let tangential = 0.25 * PI * scale * entrainment * per_root * per_gap;
                f.film = turned(ratio, normal, tangential);
            }
            GuidanceFilm::Dynamic => {
                let half_sum = 0.5 * (cage_speed + ring_speed);
                let squeeze = [velocity[0] + half_sum * offset[1], velocity[1] - half_sum * offset[0]];
                let speed2 = squeeze[0] * squeeze[0] + squeeze[1] * squeeze[1];
                if speed2 > 0.0 {
                    let per_speed = 1.0 / speed2.sqrt();
                    let toward = squeeze.map(|u| u * per_speed);
                    let half = HalfFilm::at(
                        ratio[0] * toward[0] + ratio[1] * toward[1],
                        ratio[1] * toward[0] - ratio[0] * toward[1],
                    );
                    let scale = self.viscosity * self.radius * (self.width * per_clearance).powi(3);
                    f.damping = scale * (half.along.max(half.across) + half.mixed.abs());
                    f.film = turned(squeeze, -scale * half.along, -scale * half.mixed);
                }
            }
        }
        f
    }

    /// The land's push on a cage that is `e` > C_g, m, off its centre.
    #[cold]
    fn dry_land(&self, f: &mut GuideForce, offset: [f64; 2], velocity: [f64; 2], e: f64) {
        f.push(offset, velocity, e, |e, rate| {
            let elastic = self.land_stiffness * (e - self.clearance);
            ((elastic + self.land_damping * rate).max(0.0), elastic)
        });
    }

    /// Elastic energy of the land, J.
    pub fn land_energy(&self, offset: [f64; 2]) -> f64 {
        let e = offset[0].hypot(offset[1]);
        match &self.wall {
            LandLaw::None => 0.0,
            LandLaw::Linear => 0.5 * self.land_stiffness * (e - self.clearance).max(0.0).powi(2),
            LandLaw::Oiled(wall) => wall.energy(e, self.clearance),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUIDE: Guide = Guide {
        film: Some(GuidanceFilm::QuasiStatic),
        viscosity: 0.01,
        clearance: 1e-3,
        width: 6e-3,
        radius: 26.5e-3,
        land_stiffness: 1e7,
        land_damping: 0.0,
        wall: LandLaw::Linear,
    };
    const AT_REST: [f64; 2] = [0.0; 2];

    #[test]
    fn analytic_ocvirk_centred_cage_feels_petroff_alone() {
        let g = GUIDE.force([0.0, 0.0], AT_REST, 80.0, 0.0);
        assert_eq!(g.film, [0.0, 0.0]);
        // Petroff: tau = eta U / C over the area 2 pi R L at the lever R.
        let u = GUIDE.radius * 80.0;
        let petroff = GUIDE.viscosity * u / GUIDE.clearance * 2.0 * PI * GUIDE.radius * GUIDE.width * GUIDE.radius;
        assert!((g.moment / -petroff - 1.0).abs() < 1e-14);
    }

    #[test]
    fn analytic_ocvirk_attitude_angle() {
        // tan(attitude) = pi sqrt(1 - eps^2) / (4 eps) for the short bearing (Ocvirk 1952).
        for eps in [0.01, 0.3, 0.6, 0.9] {
            let g = GUIDE.force([eps * GUIDE.clearance, 0.0], AT_REST, 80.0, 0.0);
            let expected = PI * (1.0_f64 - eps * eps).sqrt() / (4.0 * eps);
            assert!((g.film[1] / -g.film[0] / expected - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn analytic_film_centres_whichever_way_the_cage_turns() {
        for speed in [80.0, -80.0] {
            let g = GUIDE.force([2e-4, 0.0], AT_REST, speed, 0.0);
            assert!(g.film[0] < 0.0);
            assert_eq!(g.moment.signum(), -speed.signum());
        }
    }

    #[test]
    fn analytic_land_pushes_only_past_the_clearance() {
        assert_eq!(GUIDE.force([0.99e-3, 0.0], AT_REST, 80.0, 0.0).land[0], 0.0);
        let g = GUIDE.force([0.0, -1.01e-3], AT_REST, 80.0, 0.0);
        assert!((g.land[1] - 1e7 * 1e-5).abs() < 1e-6);
    }

    #[test]
    fn analytic_damped_land_never_pulls_and_only_dissipates() {
        let guide = Guide { film: None, land_damping: 20.0, ..GUIDE };
        let at = |rate: f64| guide.force([1.01e-3, 0.0], [rate, 3.0], 80.0, 0.0);
        assert!((at(0.5).land[0] + 110.0).abs() < 1e-6);
        assert!((at(0.5).land_loss - 5.0).abs() < 1e-6);
        assert!((at(-0.5).land[0] + 90.0).abs() < 1e-6);
        // Faster apart than the spring follows: no force, and what the spring held is lost.
        assert_eq!(at(-10.0).land[0], 0.0);
        assert!((at(-10.0).land_loss - 1000.0).abs() < 1e-6);
        for rate in [0.5, -0.5, -10.0] {
            assert!(at(rate).land_loss > 0.0);
            assert_eq!((at(rate).film, at(rate).moment), ([0.0; 2], 0.0));
        }
    }

    #[test]
    fn analytic_traction_curve() {
        assert_eq!(traction(0.0), 0.0);
        assert!((traction(1.0) - 0.1).abs() < 1e-12);
        // Its peak, where the derivative vanishes: |u| = 1/181.46 + 0.1/22.28.
        let peak = 1.0 / 181.46 + 0.1 / 22.28;
        assert!(traction(peak) > traction(peak * 1.01) && traction(peak) > traction(peak * 0.99));
    }

    #[test]
    fn analytic_pocket_has_clearance_to_both_sides_and_never_pulls() {
        let p = Pocket { stiffness: 1e7, damping: 20.0, clearance: 9e-5, wall: None, is_round: false };
        assert_eq!(p.penetration(8e-5), 0.0);
        assert!((p.penetration(10e-5) - 1e-5).abs() < 1e-18);
        assert!((p.penetration(-10e-5) + 1e-5).abs() < 1e-18);
        assert_eq!(p.press(0.0, 1.0), (0.0, 0.0));
        assert!((p.press(1e-5, 0.0).0 - 100.0).abs() < 1e-9);
        assert_eq!(p.press(1e-6, -10.0).0, 0.0);
    }
}
