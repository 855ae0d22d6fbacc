//! The speed of a bearing that runs on while its speed is changed: the inner ring's angle stays continuous.

use brinell::operation::Rotation;
use brinell::scenario::Speed;

/// Time that a change of speed takes, s.
const CHANGE: f64 = 0.05;
/// Knots kept: those long past only add up to an angle.
const MOST: usize = 20_000;

/// Speeds over time since the start of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Course {
    /// (s, r/min).
    knots: Vec<[f64; 2]>,
}

impl Course {
    /// Constant so far; `None` of a profile, which is its own course.
    pub(crate) fn of(speed: &Speed) -> Option<Self> {
        match speed {
            Speed::Constant(rpm) => Some(Self { knots: vec![[0.0, *rpm]] }),
            Speed::Profile(_) => None,
        }
    }

    /// From now, s, to another speed, r/min. `false`: too many changes for one run.
    pub(crate) fn turn_to(&mut self, rpm: f64, now: f64) -> bool {
        let (before, _) = Rotation::new(&self.speed()).at(now);
        let before = before * 60.0 / std::f64::consts::TAU;
        self.knots.retain(|k| k[0] < now);
        if self.knots.is_empty() || (before - rpm).abs() > 1e-9 {
            self.knots.extend([[now, before], [now + CHANGE, rpm]]);
        }
        self.knots.len() <= MOST
    }

    /// As a scenario has it.
    pub(crate) fn speed(&self) -> Speed {
        match &self.knots[..] {
            [[_, rpm]] => Speed::Constant(*rpm),
            knots => Speed::Profile(knots.to_vec()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angle before a change is what it was, and the speed after it what was requested.
    #[test]
    fn prop_a_change_of_speed_leaves_the_past_alone() {
        let mut course = Course::of(&Speed::Constant(1800.0)).unwrap();
        let mut last = Rotation::new(&course.speed());
        let mut now = 0.2;
        for rpm in [1800.0, 900.0, 910.0, 3000.0, -600.0] {
            assert!(course.turn_to(rpm, now));
            let next = Rotation::new(&course.speed());
            for k in 0..=20 {
                let t = now * f64::from(k) / 20.0;
                assert!((next.at(t).1 - last.at(t).1).abs() < 1e-9, "{rpm} at {t}");
            }
            let (speed, _) = next.at(now + 1.0);
            assert!((speed * 60.0 / std::f64::consts::TAU - rpm).abs() < 1e-9);
            (last, now) = (next, now + 0.03);
        }
    }
}
