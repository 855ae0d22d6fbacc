//! Order analysis: a signal of varying speed, resampled at equal angles of the shaft.
//!
//! Events locked to the shaft smear over a spectrum when the speed varies; sampled at equal angles they are lines at
//! orders (events a revolution): K. R. Fyfe and E. D. S. Munck, "Analysis of computed order tracking", Mech. Syst.
//! Signal Process. 11 (1997) 187-205. For steady speed, an order is the frequency over the speed, and nothing need be
//! resampled.
//!
//! Values between samples come from a Kaiser-windowed sinc of 24 zero crossings to either side, cut off at 0.45 of the
//! smaller of the two sampling rates at that instant: flat to 0.4 of it, and 80 dB down beyond half of it, so that
//! what a slow shaft cannot hold does not fold.

use std::f64::consts::PI;

use super::decimate::bessel_i0;
use super::error::{SignalError, check, require};

/// The shaft's angle over time: cubic between instants, from tacho pulses or from points of speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Rotation {
    /// Time (s), angle (revolutions), speed (revolutions a second).
    knots: Vec<[f64; 3]>,
}

impl Rotation {
    /// From points (time in s, speed in Hz), linear between, constant before the first and after the last; angle 0 at
    /// the first point. The angle between points is exact.
    ///
    /// # Errors
    /// [`SignalError::OutOfRange`] without points, with times that do not increase, or with a negative speed.
    pub fn from_speeds(points: &[(f64, f64)]) -> Result<Self, SignalError> {
        increasing(points)?;
        let mut knots: Vec<[f64; 3]> = Vec::with_capacity(points.len());
        for &(t, speed) in points {
            require(speed >= 0.0 && speed.is_finite(), "speed (Hz)", speed, "0 or above")?;
            let angle = knots.last().map_or(0.0, |k| k[1] + 0.5 * (k[2] + speed) * (t - k[0]));
            knots.push([t, angle, speed]);
        }
        Ok(Rotation { knots })
    }

    /// From instants (time in s, angle in revolutions), such as one pulse a revolution; two or more. Between them the
    /// angle is the monotone cubic of F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, as in
    /// SciPy's `PchipInterpolator`; outside them the speed at the end goes on.
    ///
    /// # Errors
    /// [`SignalError`] with fewer than two instants, times that do not increase, or an angle that decreases.
    pub fn from_angles(points: &[(f64, f64)]) -> Result<Self, SignalError> {
        increasing(points)?;
        if points.len() < 2 {
            return Err(SignalError::TooShort { what: "an angle over time", have: points.len(), need: 2 });
        }
        let mut slopes = Vec::with_capacity(points.len() - 1);
        for pair in points.windows(2) {
            let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
            require(slope >= 0.0 && slope.is_finite(), "angle (revolutions)", pair[1].1, "not below the one before")?;
            slopes.push(slope);
        }
        let width = |i: usize| points[i + 1].0 - points[i].0;
        let last = slopes.len() - 1;
        let knots = (points.iter().enumerate()).map(|(i, &(t, angle))| {
            let speed = if last == 0 {
                slopes[0]
            } else if i == 0 {
                end_slope(width(0), width(1), slopes[0], slopes[1])
            } else if i > last {
                end_slope(width(last), width(last - 1), slopes[last], slopes[last - 1])
            } else if slopes[i - 1] * slopes[i] > 0.0 {
                let (before, after) = (width(i - 1), width(i));
                let (w1, w2) = (2.0 * after + before, after + 2.0 * before);
                (w1 + w2) / (w1 / slopes[i - 1] + w2 / slopes[i])
            } else {
                0.0
            };
            [t, angle, speed]
        });
        Ok(Rotation { knots: knots.collect() })
    }

    /// Angle (revolutions) and speed (Hz) at a time, s.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let after = self.knots.partition_point(|k| k[0] <= t);
        self.within(after, t)
    }

    /// [`at`](Self::at), `after` being the first knot later than t.
    fn within(&self, after: usize, t: f64) -> (f64, f64) {
        let outside = |k: &[f64; 3]| (k[1] + k[2] * (t - k[0]), k[2]);
        if after == 0 {
            return outside(&self.knots[0]);
        }
        if after == self.knots.len() {
            return outside(&self.knots[after - 1]);
        }
        let ([t0, a0, v0], [t1, a1, v1]) = (self.knots[after - 1], self.knots[after]);
        let h = t1 - t0;
        let s = (t - t0) / h;
        // Hermite's cubic, from the left knot.
        let rise = a1 - a0;
        let c2 = 3.0 * rise - h * (2.0 * v0 + v1);
        let c3 = -2.0 * rise + h * (v0 + v1);
        let angle = a0 + s * (h * v0 + s * (c2 + s * c3));
        (angle, v0 + s * (2.0 * c2 + 3.0 * s * c3) / h)
    }
}

fn increasing(points: &[(f64, f64)]) -> Result<(), SignalError> {
    if points.is_empty() {
        return Err(SignalError::TooShort { what: "a rotation", have: 0, need: 1 });
    }
    let mut before = f64::NEG_INFINITY;
    for &(t, _) in points {
        require(t > before && t.is_finite(), "time (s)", t, "increasing")?;
        before = t;
    }
    Ok(())
}

/// Three-point slope at an end, kept monotone.
fn end_slope(h0: f64, h1: f64, s0: f64, s1: f64) -> f64 {
    let slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
    if slope * s0 <= 0.0 {
        0.0
    } else if slope > 3.0 * s0 && s0 * s1 <= 0.0 {
        3.0 * s0
    } else {
        slope
    }
}

/// A signal at equal angles.
#[derive(Debug, Clone, PartialEq)]
pub struct Angular {
    /// Values, in the signal's unit.
    pub values: Vec<f64>,
    /// Samples a revolution: give it to [`psd`](super::psd()) as the sampling rate, for a spectrum over orders.
    pub samples_per_revolution: f64,
    /// Angle of the first value, revolutions.
    pub first_angle: f64,
}

/// Zero crossings of the kernel to either side.
const CROSSINGS: f64 = 24.0;
/// Kaiser's beta for 80 dB.
const BETA: f64 = 0.1102 * (80.0 - 8.7);
/// Edge as a share of the smaller sampling rate.
const EDGE: f64 = 0.45;
/// Points of the kernel's table from one zero crossing to the next; the error of linear interpolation is below 2e-6.
const TABLE: usize = 512;
/// The edge follows a slowing shaft down to this share of the signal's sampling rate, no further.
const LOWEST_EDGE: f64 = 0.01;

/// Samples from angle 0 beyond which a double cannot count them one by one: 2^53.
const LAST_COUNTED: f64 = 9_007_199_254_740_992.0;

/// Values made at most for each sample of the signal.
const MOST_PER_SAMPLE: f64 = 64.0;

/// `x`, sampled at `fs` Hz from t = 0, at `samples_per_revolution` equal angles a revolution.
///
/// The first and last values are those for which the whole kernel lies within the signal: 27 sample intervals (of the
/// slower of the two rates) from the ends. Where the shaft turns slower than `fs / (45 samples_per_revolution)` Hz,
/// some of what it cannot hold folds.
///
/// # Errors
/// [`SignalError`] with samples that are not finite, a signal too short for one value, fewer than 4 samples a
/// revolution, or an angle beyond 2^53 samples.
pub fn resample(
    x: &[f64],
    fs: f64,
    rotation: &Rotation,
    samples_per_revolution: usize,
) -> Result<Angular, SignalError> {
    let need = (2.0 * CROSSINGS / (2.0 * EDGE)).ceil() as usize + 2;
    check(x, fs, need, "resampling")?;
    require(samples_per_revolution >= 4, "samples per revolution", samples_per_revolution as f64, "4 or more")?;
    let rate = samples_per_revolution as f64;
    let last_time = (x.len() - 1) as f64 / fs;
    let expected = (rotation.at(last_time).0 - rotation.at(0.0).0) * rate;
    require(
        expected <= MOST_PER_SAMPLE * x.len() as f64,
        "values to make",
        expected,
        "at most 64 times as many as the signal has",
    )?;
    for t in [0.0, last_time] {
        let angle = rotation.at(t).0;
        let range = "at most 2^53 samples from 0; let angles begin near 0 at the record's start";
        require((angle * rate).abs() <= LAST_COUNTED, "angle (revolutions)", angle, range)?;
    }
    let first = (rotation.at(0.0).0 * rate).ceil();
    let kernel = Kernel::new();
    let mut values = Vec::new();
    let mut first_angle = None;
    let mut clock = Inverse { rotation, knot: 0, time: 0.0 };
    let mut index = first;
    while let Some((t, speed)) = clock.time_of(index / rate, last_time) {
        let edge = EDGE * (rate * speed / fs).clamp(LOWEST_EDGE / EDGE, 1.0);
        if let Some(value) = kernel.value(x, t * fs, edge) {
            first_angle.get_or_insert(index / rate);
            values.push(value);
        } else if first_angle.is_some() {
            break;
        }
        index += 1.0;
    }
    match first_angle {
        Some(first_angle) => Ok(Angular { values, samples_per_revolution: rate, first_angle }),
        None => Err(SignalError::TooShort { what: "resampling at this speed", have: x.len(), need }),
    }
}

/// Times of increasing angles.
struct Inverse<'a> {
    rotation: &'a Rotation,
    /// The first knot later than `time`.
    knot: usize,
    time: f64,
}

impl Inverse<'_> {
    /// When the shaft reaches an angle, and its speed then; `None` after `latest`.
    fn time_of(&mut self, angle: f64, latest: f64) -> Option<(f64, f64)> {
        let knots = &self.rotation.knots;
        while self.knot < knots.len() && knots[self.knot][1] <= angle {
            self.time = self.time.max(knots[self.knot][0]);
            self.knot += 1;
        }
        let mut low = self.time;
        let mut high = knots.get(self.knot).map_or(latest, |k| k[0].min(latest));
        if high < low || self.rotation.within(self.knot, high).0 < angle {
            return None;
        }
        // Newton's method, kept within the bracket.
        let mut t = low;
        for _ in 0..60 {
            let (value, speed) = self.rotation.within(self.knot, t);
            let short = angle - value;
            if short.abs() <= 1e-14 * (1.0 + angle.abs()) {
                break;
            }
            if short > 0.0 {
                low = t;
            } else {
                high = t;
            }
            let next = t + short / speed;
            t = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        self.time = t;
        Some((t, self.rotation.within(self.knot, t).1))
    }
}

/// sinc(u) times a Kaiser window, by |u| in zero crossings.
struct Kernel {
    /// Value, and difference to the next.
    table: Vec<[f64; 2]>,
}

impl Kernel {
    fn new() -> Self {
        let count = CROSSINGS as usize * TABLE;
        let scale = 1.0 / bessel_i0(BETA);
        let table = (0..=count + 1).map(|i| {
            let u = i as f64 / TABLE as f64;
            let ratio = (u / CROSSINGS).min(1.0);
            let sinc = if i == 0 { 1.0 } else { (PI * u).sin() / (PI * u) };
            sinc * bessel_i0(BETA * (1.0 - ratio * ratio).sqrt()) * scale
        });
        let table: Vec<f64> = table.collect();
        Kernel { table: table.windows(2).map(|w| [w[0], w[1] - w[0]]).collect() }
    }

    /// `x` at `position` samples, low-passed at `edge` cycles a sample; `None` where the kernel reaches past its ends.
    fn value(&self, x: &[f64], position: f64, edge: f64) -> Option<f64> {
        let reach = CROSSINGS / (2.0 * edge);
        let (first, last) = ((position - reach).ceil(), (position + reach).floor());
        if first < 0.0 || last > (x.len() - 1) as f64 {
            return None;
        }
        let per_sample = 2.0 * edge * TABLE as f64;
        let start = (position - first) * per_sample;
        let (mut sum, mut weights) = (0.0, 0.0);
        for (i, v) in x[first as usize..=last as usize].iter().enumerate() {
            let u = (start - i as f64 * per_sample).abs();
            let at = u as u32;
            let [value, difference] = self.table[at as usize];
            let weight = value + (u - f64::from(at)) * difference;
            sum += weight * v;
            weights += weight;
        }
        // Unit gain at zero frequency whatever the position.
        Some(sum / weights)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::psd::{Segments, psd};
    use super::super::spectrum::peak_near;
    use super::super::test_signals::cosine;
    use super::*;

    const FS: f64 = 10_000.0;

    fn steady(speed: f64) -> Rotation {
        Rotation::from_speeds(&[(0.0, speed)]).unwrap()
    }

    #[test]
    fn analytic_run_up_becomes_lines() {
        // 20 to 40 Hz over 4 s; orders 7.3 (amplitude 1) and 31 (amplitude 0.2).
        let rotation = Rotation::from_speeds(&[(0.0, 20.0), (4.0, 40.0)]).unwrap();
        let x: Vec<f64> = (0..40_000)
            .map(|i| {
                let t = i as f64 / FS;
                let turns = 20.0 * t + 2.5 * t * t;
                assert!((rotation.at(t).0 - turns).abs() < 1e-9);
                (TAU * 7.3 * turns).cos() + 0.2 * (TAU * 31.0 * turns).sin()
            })
            .collect();
        let angular = resample(&x, FS, &rotation, 256).unwrap();
        let segments = Segments::of(angular.values.len());
        let s = psd(&angular.values, angular.samples_per_revolution, &segments).unwrap();
        for (order, amplitude) in [(7.3, 1.0), (31.0, 0.2)] {
            let peak = peak_near(&s, order, 0.3).unwrap();
            assert!((peak.frequency - order).abs() < 1e-3, "{peak:?}");
            assert!((peak.amplitude / amplitude - 1.0).abs() < 3e-3, "{peak:?}");
        }
        // Values are where they say.
        for k in [0, 5000, 20_000] {
            let turns = angular.first_angle + k as f64 / 256.0;
            let exact = (TAU * 7.3 * turns).cos() + 0.2 * (TAU * 31.0 * turns).sin();
            assert!((angular.values[k] - exact).abs() < 1e-3, "{k}");
        }
    }

    #[test]
    fn analytic_what_a_slow_shaft_cannot_hold_does_not_fold() {
        // 64 samples a revolution at 20 Hz: 1280 a second. 1000 Hz is order 50, above 32.
        let rotation = steady(20.0);
        let angular = resample(&cosine(20_000, FS, 1000.0, 1.0, 0.1), FS, &rotation, 64).unwrap();
        assert!(angular.values.iter().all(|v| v.abs() < 2e-4));
        let x = cosine(20_000, FS, 500.0, 1.0, 0.1);
        let angular = resample(&x, FS, &rotation, 64).unwrap();
        for (k, v) in angular.values.iter().enumerate() {
            let t = (angular.first_angle + k as f64 / 64.0) / 20.0;
            let e = (v - (TAU * 500.0 * t + 0.1).cos()).abs();
            assert!(e < 2e-4, "{k} {e:e} {v} {t}");
        }
    }

    #[test]
    fn prop_pulses_and_speeds_agree() {
        let speeds = Rotation::from_speeds(&[(0.0, 20.0), (4.0, 40.0)]).unwrap();
        let pulses: Vec<(f64, f64)> = (0..=100)
            .map(|n| {
                let turns = f64::from(n);
                ((-20.0 + (400.0 + 10.0 * turns).sqrt()) / 5.0, turns)
            })
            .collect();
        let angles = Rotation::from_angles(&pulses).unwrap();
        for i in 1..60 {
            let t = 0.05 * f64::from(i);
            let (a, b) = (speeds.at(t), angles.at(t));
            assert!((a.0 - b.0).abs() < 2e-5 && (a.1 - b.1).abs() < 0.02, "{t} {a:?} {b:?}");
        }
    }

    #[test]
    fn prop_run_up_from_rest_and_bad_input() {
        let x = cosine(10_000, FS, 50.0, 1.0, 0.0);
        let rotation = Rotation::from_speeds(&[(0.0, 0.0), (0.3, 0.0), (1.0, 30.0)]).unwrap();
        let angular = resample(&x, FS, &rotation, 128).unwrap();
        assert!(angular.values.iter().all(|v| v.is_finite()));
        assert!(angular.values.len() > 900);
        let still = Rotation::from_speeds(&[(0.0, 0.0)]).unwrap();
        assert!(resample(&x, FS, &still, 128).is_err());
        assert!(Rotation::from_speeds(&[]).is_err());
        assert!(Rotation::from_speeds(&[(0.0, 1.0), (0.0, 2.0)]).is_err());
        assert!(Rotation::from_speeds(&[(0.0, -1.0)]).is_err());
        assert!(Rotation::from_angles(&[(0.0, 1.0)]).is_err());
        assert!(Rotation::from_angles(&[(0.0, 1.0), (1.0, 0.0)]).is_err());
        assert!(resample(&x[..20], FS, &steady(20.0), 64).is_err());
        assert!(resample(&x, FS, &steady(20.0), 2).is_err());
        assert!(resample(&x, FS, &steady(1e12), 64).is_err());
    }

    /// A double does not count on from there by ones: the loop had no end.
    #[test]
    fn prop_angles_too_far_from_zero_are_refused() {
        let x = cosine(10_000, FS, 50.0, 1.0, 0.0);
        let seconds = x.len() as f64 / FS;
        let far = |angle: f64| Rotation::from_angles(&[(0.0, angle), (seconds, angle + 30.0 * seconds)]).unwrap();
        assert!(resample(&x, FS, &far(1e6), 64).is_ok());
        let past = Rotation::from_speeds(&[(-1e17, 30.0)]).unwrap();
        for rotation in [far(2e14), far(-2e14), past] {
            let refused = resample(&x, FS, &rotation, 64).unwrap_err().to_string();
            assert!(refused.starts_with("angle (revolutions) = ") && refused.contains("2^53"), "{refused}");
        }
    }
}
