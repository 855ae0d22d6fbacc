//! A wall of a pocket or a land with oil between it and what it holds: section 21.

use crate::lanes::Lanes;

/// F_f of a pocket, N: oil between element and wall (Meeks and Ng 1985).
pub const OIL_FORCE: f64 = 11.0;
/// K_H, N/m^1.5: Hertz's contact behind the wall.
const HERTZ: f64 = 2e9;
/// tau_c, s.
const TIME: f64 = 17e-6;

/// A wall at the play C from the centred position: N_el = F_f (x/C)^5 + K_H `[x - C]_+^(3/2)` at the distance x from it, and
/// N = `[N_el + tau_c dN_el/dx dx/dt]_+`. SI; smooth for every x >= 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OiledWall {
    /// F_f, N; 0 where another film acts.
    pub film: f64,
}

impl OiledWall {
    /// N and its elastic part in each lane, N: of the distance x >= 0, the play C > 0 (m) with 1/C, and the rate of x, m/s.
    #[inline(always)]
    pub fn press<L: Lanes>(&self, x: L, (play, per_play): (L, L), rate: L) -> (L, L) {
        let share = x * per_play;
        let fourth = (share * share) * (share * share);
        let oil = L::splat(self.film) * fourth;
        let beyond = (x - play).positive_part();
        let mut root = L::zero();
        // Elements seldom come through the oil to the steel.
        if beyond.any_positive() {
            root = L::splat(HERTZ) * beyond.sqrt();
        }
        let elastic = oil.times_plus(share, root * beyond);
        let slope = root.times_plus(L::splat(1.5), L::splat(5.0) * oil * per_play);
        let size = (slope * L::splat(TIME)).times_plus(rate, elastic);
        (size.positive_part(), elastic)
    }

    /// Elastic energy at the distance x from the centred position, J.
    pub fn energy(&self, x: f64, play: f64) -> f64 {
        let beyond = (x - play).max(0.0);
        self.film * x.powi(6) / (6.0 * play.powi(5)) + 0.4 * HERTZ * beyond * beyond * beyond.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_oil_carries_its_force_at_the_wall_and_steel_beyond() {
        let (wall, play) = (OiledWall { film: OIL_FORCE }, 9e-5);
        let press = |x: f64, rate: f64| wall.press(x, (play, 1.0 / play), rate).0;
        assert_eq!(wall.press(0.0, (play, 1.0 / play), 1.0), (0.0, 0.0));
        assert!((press(play, 0.0) - 11.0).abs() < 1e-12);
        assert!((press(0.5 * play, 0.0) - 11.0 / 32.0).abs() < 1e-12);
        let beyond = 1e-5_f64;
        let expected = 11.0 * (1.0 + beyond / play).powi(5) + 2e9 * beyond.powf(1.5);
        assert!((press(play + beyond, 0.0) / expected - 1.0).abs() < 1e-13);
        // Never pulls.
        assert_eq!(press(play, -10.0), 0.0);
    }

    #[test]
    fn analytic_energy_is_the_integral_of_the_elastic_force() {
        let (wall, play) = (OiledWall { film: OIL_FORCE }, 9e-5);
        let (top, steps) = (1.2e-4, 100_000);
        let dx = top / f64::from(steps);
        let work: f64 = (0..steps).map(|k| wall.press((f64::from(k) + 0.5) * dx, (play, 1.0 / play), 0.0).1 * dx).sum();
        assert!((wall.energy(top, play) / work - 1.0).abs() < 1e-7);
    }
}
