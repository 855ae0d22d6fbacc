//! Prescribed motion and load: the inner ring's speed and angle, the load and its ramp.

use crate::scenario::{self, Scenario, Speed, Start};
use std::f64::consts::TAU;

/// Speed of the inner ring, piecewise linear in time and held beyond its ends; its angle is the exact integral.
#[derive(Debug, Clone, PartialEq)]
pub struct Rotation {
    /// t increasing; at least one. One lies wherever the speed changes its sign.
    knots: Vec<Knot>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Knot {
    /// s.
    t: f64,
    /// w_i, rad/s.
    w: f64,
    /// W_i, rad.
    angle: f64,
    /// Integral of |w_i|, rad.
    turned: f64,
}

impl Rotation {
    /// From r/min.
    pub fn new(speed: &Speed) -> Self {
        let rad = |rpm: f64| rpm * std::f64::consts::PI / 30.0;
        let points: Vec<[f64; 2]> = match speed {
            Speed::Constant(rpm) => vec![[0.0, *rpm]],
            Speed::Profile(points) => points.clone(),
        };
        let mut rotation = Self { knots: Vec::with_capacity(points.len()) };
        for [t, rpm] in points {
            let w = rad(rpm);
            if let Some(&Knot { t: t0, w: w0, .. }) = rotation.knots.last().filter(|k| k.w * w < 0.0) {
                rotation.push(t0 + (t - t0) * w0 / (w0 - w), 0.0);
            }
            rotation.push(t, w);
        }
        let ((_, angle), turned) = (rotation.at(0.0), rotation.turned(0.0));
        for knot in &mut rotation.knots {
            knot.angle -= angle;
            knot.turned -= turned;
        }
        rotation
    }

    fn push(&mut self, t: f64, w: f64) {
        let moved = self.knots.last().map_or(w * t, |k| 0.5 * (k.w + w) * (t - k.t));
        let (angle, turned) = self.knots.last().map_or((0.0, 0.0), |k| (k.angle, k.turned));
        self.knots.push(Knot { t, w, angle: angle + moved, turned: turned + moved.abs() });
    }

    /// (w_i, W_i) in rad/s and rad; W_i(0) = 0.
    #[inline]
    pub fn at(&self, t: f64) -> (f64, f64) {
        let knots = &self.knots;
        let next = knots.partition_point(|k| k.t <= t);
        if next == 0 || next == knots.len() {
            let Knot { t: t0, w, angle, .. } = knots[next.saturating_sub(1)];
            return (w, angle + w * (t - t0));
        }
        let Knot { t: t0, w: w0, angle, .. } = knots[next - 1];
        let Knot { t: t1, w: w1, .. } = knots[next];
        let slope = (w1 - w0) / (t1 - t0);
        let dt = t - t0;
        (w0 + slope * dt, angle + dt * (w0 + 0.5 * slope * dt))
    }

    /// What it has turned since t = 0, there and back alike: the integral of |w_i|, rad.
    pub fn turned(&self, t: f64) -> f64 {
        let before = self.knots.partition_point(|k| k.t <= t).saturating_sub(1);
        let Knot { t: t0, angle, turned, .. } = self.knots[before];
        let moved = (self.at(t).1 - angle).abs();
        if t < t0 { turned - moved } else { turned + moved }
    }

    /// Whole turns, there and back alike, from one time to a later one.
    pub fn whole_turns(&self, from: f64, t: f64) -> i64 {
        ((self.turned(t) - self.turned(from)) / TAU).floor() as i64
    }

    /// dw_i/dt, rad/s^2; the right-hand value at a knot.
    pub fn acceleration(&self, t: f64) -> f64 {
        let next = self.knots.partition_point(|k| k.t <= t);
        if next == 0 || next == self.knots.len() {
            return 0.0;
        }
        let (from, to) = (self.knots[next - 1], self.knots[next]);
        (to.w - from.w) / (to.t - from.t)
    }

    /// Largest |w_i|, rad/s.
    pub fn max_speed(&self) -> f64 {
        self.knots.iter().map(|k| k.w.abs()).fold(0.0, f64::max)
    }

    /// Lowest and highest w_i, rad/s.
    pub fn speeds(&self) -> [f64; 2] {
        let speeds = || self.knots.iter().map(|k| k.w);
        [speeds().fold(f64::INFINITY, f64::min), speeds().fold(f64::NEG_INFINITY, f64::max)]
    }
}

impl Scenario {
    /// t_ramp, s: none from the static balance under the full load.
    pub(crate) fn load_ramp_s(&self) -> f64 {
        if self.simulation.start == Start::Equilibrium { 0.0 } else { self.operation.load_ramp_s }
    }

    /// The load ramp and a turn of the shaft after it, at a constant speed, s; infinite where it stands still.
    pub(crate) fn unsettled_s(&self, rpm: f64) -> f64 {
        self.load_ramp_s() + 60.0 / rpm.abs()
    }

    /// Where statistics of its run begin, s: the load ramp is over and the shaft has made a turn since; half-way through
    /// at the latest.
    pub fn settled_s(&self) -> f64 {
        let half_way = 0.5 * self.simulation.duration_s;
        if let Some(rpm) = self.operation.speed_rpm.constant() {
            return self.unsettled_s(rpm).min(half_way);
        }
        let (rotation, ramp) = (Rotation::new(&self.operation.speed_rpm), self.load_ramp_s());
        let turned = |t: f64| rotation.turned(t) - rotation.turned(ramp) >= TAU;
        if ramp >= half_way || !turned(half_way) {
            return half_way;
        }
        let (mut before, mut after) = (ramp, half_way);
        loop {
            let middle = 0.5 * (before + after);
            if middle <= before || middle >= after {
                return after;
            }
            *(if turned(middle) { &mut after } else { &mut before }) = middle;
        }
    }
}

/// The radial load: F points from the centre to the middle of the load zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// F, N.
    pub full: [f64; 2],
    /// Ring it acts on.
    pub on: scenario::LoadOn,
    /// t_ramp, s.
    pub ramp: f64,
}

impl Load {
    /// Share of the load at t.
    #[inline]
    pub fn share(&self, t: f64) -> f64 {
        if self.ramp > 0.0 { (t / self.ramp).clamp(0.0, 1.0) } else { 1.0 }
    }

    /// F, N.
    pub(crate) fn size(&self) -> f64 {
        self.full[0].hypot(self.full[1])
    }

    /// Forces on the inner and on the outer ring for a share of the load, N.
    #[inline]
    pub fn on_rings(&self, share: f64) -> ([f64; 2], [f64; 2]) {
        let f = [self.full[0] * share, self.full[1] * share];
        match self.on {
            scenario::LoadOn::InnerRing => (f, [0.0; 2]),
            scenario::LoadOn::OuterRing => ([0.0; 2], [-f[0], -f[1]]),
        }
    }

    /// Size of the full load and the weight together on the ring that the load acts on, N; masses (kg) of the inner and
    /// the outer ring, gravity in m/s^2.
    pub fn with_weight(&self, masses: [f64; 2], gravity: [f64; 2]) -> f64 {
        let (inner, outer) = self.on_rings(1.0);
        let (force, mass) = match self.on {
            scenario::LoadOn::InnerRing => (inner, masses[0]),
            scenario::LoadOn::OuterRing => (outer, masses[1]),
        };
        (force[0] + mass * gravity[0]).hypot(force[1] + mass * gravity[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn analytic_angle_is_the_integral_of_the_speed() {
        let r = Rotation::new(&Speed::Profile(vec![[0.1, 0.0], [0.3, 3000.0], [0.4, 1500.0]]));
        assert_eq!(r.at(0.05), (0.0, 0.0));
        let (w, angle) = r.at(0.2);
        assert!((w - 50.0 * PI).abs() < 1e-12 && (angle - 0.5 * 0.1 * 50.0 * PI).abs() < 1e-12);
        let (w, angle) = r.at(0.5);
        let exact = 0.5 * 0.2 * 100.0 * PI + 0.1 * 75.0 * PI + 0.1 * 50.0 * PI;
        assert!((w - 50.0 * PI).abs() < 1e-12 && (angle - exact).abs() < 1e-12);
        let (w, angle) = Rotation::new(&Speed::Constant(60.0)).at(2.0);
        assert!((w - 2.0 * PI).abs() < 1e-14 && (angle - 4.0 * PI).abs() < 1e-13);
    }

    #[test]
    fn analytic_turns_there_and_back_add_up() {
        // 10 turns a second to -10 in 0.2 s: a quarter of 2 turns each way, then one in 0.1 s.
        let r = Rotation::new(&Speed::Profile(vec![[0.0, 600.0], [0.2, -600.0]]));
        for (t, turned, angle) in [(0.1, 0.5, 0.5), (0.2, 1.0, 0.0), (0.3, 2.0, -1.0), (0.15, 0.625, 0.375)] {
            assert!((r.turned(t) - TAU * turned).abs() < 1e-13 && (r.at(t).1 - TAU * angle).abs() < 1e-13);
        }
        let r = Rotation::new(&Speed::Constant(-60.0));
        assert!((r.turned(2.0) - 4.0 * PI).abs() < 1e-13);
        // Before its first point a profile has that point's speed, and nothing has turned at 0.
        let r = Rotation::new(&Speed::Profile(vec![[0.1, -600.0], [0.2, 0.0]]));
        assert_eq!(r.turned(0.0), 0.0);
        assert!((r.turned(0.05) - TAU * 0.5).abs() < 1e-13 && (r.turned(0.2) - TAU * 1.5).abs() < 1e-13);
    }

    #[test]
    fn analytic_statistics_begin_a_turn_after_the_ramp() {
        let begun = |start: &str, speed: &str, duration: f64| {
            let text = format!(
                "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = {speed}\nload_n = [500, 0]\nload_ramp_s = 0.02\n\
                 [simulation]\nduration_s = {duration}\nstart = \"{start}\"\n"
            );
            crate::document::read(&text, &[]).unwrap().scenario.settled_s()
        };
        let settled = |speed: &str, duration: f64| begun("rolling", speed, duration);
        assert!((settled("-6000", 0.5) - 0.03).abs() < 1e-15);
        assert!((begun("equilibrium", "6000", 0.5) - 0.01).abs() < 1e-15, "no ramp");
        assert_eq!(settled("600", 0.2), 0.1, "half-way, before a turn");
        assert_eq!(settled("6000", 0.03), 0.015, "half-way, before the end of the ramp");
        // From rest at b rad/s^2: b (t^2 - ramp^2) / 2 is a turn.
        let t = (0.02_f64.powi(2) + 4.0 * PI / (100.0 * PI)).sqrt();
        assert!((settled("[[0, 0], [1, 3000]]", 1.0) - t).abs() < 1e-14);
        // Turns there and back are turns: 50 Hz, and half of a turn each way.
        let swing = "[[0, 3000], [0.03, 3000], [0.030001, -3000], [1, -3000]]";
        assert!((settled(swing, 1.0) - 0.04).abs() < 1e-5);
        // Slowly through rest: 0.32 turns from the ramp to rest at 0.1 s, half a turn back, and what is left at 10 a second.
        let there = 0.5 * 100.0 * (0.1_f64 - 0.02).powi(2);
        assert!((settled("[[0, 600], [0.2, -600], [1, -600]]", 1.0) - (0.2 + (0.5 - there) / 10.0)).abs() < 1e-12);
    }
}
