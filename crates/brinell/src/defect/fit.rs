//! Width and depth of damage as piecewise polynomials, Eqs. (25) and (26).
//!
//! The arc is cut into segments; in each L_s and h_s are sampled at equal distances and fitted by least squares, as
//! `polyfit` does. Polynomials are in x = (2 s - from - to)/(to - from), which runs from -1 to 1 over its segment: in
//! the angle itself high orders would be ill-conditioned. A fit acts as damage itself through [`Fit::shape`], a dense
//! profile.

use super::Shape;
use crate::scenario;

/// How to fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FitSettings {
    /// Segments of the arc.
    pub segments: usize,
    /// Order of each polynomial, below the number of samples.
    pub order: usize,
    /// Samples of each segment, its ends among them.
    pub samples: usize,
}

impl FitSettings {
    /// The paper's six segments of 113 samples. It does not state the order: 5 is assumed.
    pub const PAPER: Self = Self { segments: 6, order: 5, samples: 113 };
}

/// Distance of a fit from the shape.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FitError {
    /// Root mean square over the arc.
    pub rms: f64,
    /// Largest.
    pub max: f64,
}

/// One segment.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// First s, m.
    pub from: f64,
    /// Last s, m.
    pub to: f64,
    /// a_0, a_1, ... of L_s in m.
    pub width: Vec<f64>,
    /// b_0, b_1, ... of h_s in m.
    pub depth: Vec<f64>,
}

/// L_s(s) and h_s(s) as piecewise polynomials.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// In ascending order of s.
    pub segments: Vec<Segment>,
    /// Of L_s, m, over twenty times as many points as were fitted.
    pub width_error: FitError,
    /// Of h_s, m.
    pub depth_error: FitError,
}

/// Samples are taken this share of a segment inside its ends, where the shape may jump.
const INSET: f64 = 1e-9;
/// Points between samples at which the error is looked at.
const BETWEEN: usize = 20;
/// Highest order that double precision carries.
pub const HIGHEST_ORDER: usize = 20;

impl Fit {
    /// Fits a shape; `depth` (m) is used where it has none of its own. The paper's irregular shape in six segments is
    /// cut where its arcs join, everything else into equal parts. `None` without segments or with too few samples for
    /// the order.
    pub fn new(shape: &Shape, depth: f64, settings: &FitSettings) -> Option<Self> {
        let FitSettings { segments, order, samples } = *settings;
        if segments == 0 || order > HIGHEST_ORDER || samples < 2 || samples <= order {
            return None;
        }
        let joints = shape.joints(segments);
        let width = |s: f64| shape.damaged_length(s);
        let deep = |s: f64| shape.own_depth(s).unwrap_or(depth);
        let mut errors = [(0.0, 0.0_f64); 2];
        let mut all = Vec::with_capacity(segments);
        let checks = BETWEEN * samples;
        for pair in joints.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let s = |x: f64| 0.5 * (from + to) + 0.5 * (to - from) * (1.0 - INSET) * x;
            let nodes: Vec<f64> = (0..samples).map(|k| 2.0 * k as f64 / (samples - 1) as f64 - 1.0).collect();
            let sampled = |f: &dyn Fn(f64) -> f64| nodes.iter().map(|x| f(s(*x))).collect::<Vec<_>>();
            let segment = Segment {
                from,
                to,
                width: least_squares(&nodes, &sampled(&width), order),
                depth: least_squares(&nodes, &sampled(&deep), order),
            };
            for k in 0..checks {
                let x = (2.0 * k as f64 + 1.0) / checks as f64 - 1.0;
                let off = [polynomial(&segment.width, x) - width(s(x)), polynomial(&segment.depth, x) - deep(s(x))];
                for (error, off) in errors.iter_mut().zip(off) {
                    error.0 += off * off * (to - from) / checks as f64;
                    error.1 = error.1.max(off.abs());
                }
            }
            all.push(segment);
        }
        let length = joints[segments] - joints[0];
        let [width_error, depth_error] = errors.map(|(square, max)| FitError { rms: (square / length).sqrt(), max });
        Some(Self { segments: all, width_error, depth_error })
    }

    /// L_s and h_s (m) at s (m), as fitted: a polynomial may dip below 0. `None` outside the arc.
    pub fn at(&self, s: f64) -> Option<(f64, f64)> {
        let segment = self.segments.iter().find(|g| s >= g.from && s <= g.to)?;
        let x = (2.0 * s - segment.from - segment.to) / (segment.to - segment.from);
        Some((polynomial(&segment.width, x), polynomial(&segment.depth, x)))
    }

    /// The fit as damage: a profile of `points` points in each segment, jumping where the polynomials of two segments
    /// do; what dips below 0 is 0.
    pub fn shape(&self, points: usize) -> scenario::Shape {
        let points = points.max(2);
        let (mut arc_mm, mut width_mm, mut depth_um) = (Vec::new(), Vec::new(), Vec::new());
        for g in &self.segments {
            for k in 0..points {
                let share = k as f64 / (points - 1) as f64;
                let x = 2.0 * share - 1.0;
                // The last point of a segment is the first of the next, to the bit.
                let s = if k + 1 == points { g.to } else { g.from + (g.to - g.from) * share };
                arc_mm.push(1e3 * s);
                width_mm.push((1e3 * polynomial(&g.width, x)).max(0.0));
                depth_um.push((1e6 * polynomial(&g.depth, x)).max(0.0));
            }
        }
        scenario::Shape::Profile { arc_mm, width_mm, depth_um: Some(depth_um) }
    }
}

fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Coefficients of x^0, x^1, ... of the least-squares polynomial, through polynomials that are orthogonal on the nodes
/// (Forsythe 1957).
fn least_squares(nodes: &[f64], values: &[f64], order: usize) -> Vec<f64> {
    let mut fitted = vec![0.0; order + 1];
    let (mut before, mut now) = (vec![0.0], vec![1.0]);
    let mut norm_before = 1.0;
    for k in 0..=order {
        let at: Vec<f64> = nodes.iter().map(|x| polynomial(&now, *x)).collect();
        let norm: f64 = at.iter().map(|p| p * p).sum();
        let share = at.iter().zip(values).map(|(p, y)| p * y).sum::<f64>() / norm;
        for (sum, c) in fitted.iter_mut().zip(&now) {
            *sum += share * c;
        }
        if k == order {
            break;
        }
        let alpha = at.iter().zip(nodes).map(|(p, x)| p * p * x).sum::<f64>() / norm;
        let beta = if k == 0 { 0.0 } else { norm / norm_before };
        // x now - alpha now - beta before
        let mut next = vec![0.0];
        next.extend_from_slice(&now);
        next.iter_mut().zip(&now).for_each(|(n, c)| *n -= alpha * c);
        next.iter_mut().zip(&before).for_each(|(n, c)| *n -= beta * c);
        (before, now) = (now, next);
        norm_before = norm;
    }
    fitted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_polynomials_are_fitted_exactly() {
        let nodes: Vec<f64> = (0..40).map(|k| f64::from(k) / 19.5 - 1.0).collect();
        let exact = [0.3, -1.0, 0.5, 2.0, 0.0, -0.7];
        let values: Vec<f64> = nodes.iter().map(|x| polynomial(&exact, *x)).collect();
        for (c, e) in least_squares(&nodes, &values, 5).iter().zip(exact) {
            assert!((c - e).abs() < 1e-13);
        }
    }

    #[test]
    fn lit_paper_preset_fits_the_irregular_shape() {
        let shape = Shape::Li2023Irregular { scale: 1.0 };
        let fit = Fit::new(&shape, 20e-6, &FitSettings::PAPER).unwrap();
        assert_eq!(fit.segments.len(), 6);
        // Five arcs are smooth; the sixth ends with a vertical tangent, where any polynomial is off by some 0.1 mm.
        let smooth = &fit.segments[..5];
        for g in smooth {
            for k in 1..100 {
                let s = g.from + (g.to - g.from) * f64::from(k) / 100.0;
                assert!((fit.at(s).unwrap().0 - shape.damaged_length(s)).abs() < 1e-5, "at {s}");
            }
        }
        println!("L_s: {:?}", fit.width_error);
        assert!(fit.width_error.rms < 12e-6, "{:?}", fit.width_error);
        assert!(fit.width_error.max < 0.25e-3, "{:?}", fit.width_error);
        assert!(fit.depth_error.max < 1e-18);
        // As damage itself.
        let fitted = Shape::new(&fit.shape(64), 0.0).unwrap();
        assert!((fitted.area() / shape.area() - 1.0).abs() < 1e-3);
    }

    #[test]
    fn prop_more_order_never_fits_the_samples_worse() {
        let shape = Shape::Circle { radius: 2e-3 };
        let rms = |order| {
            let settings = FitSettings { segments: 4, order, samples: 113 };
            Fit::new(&shape, 1e-5, &settings).unwrap().width_error.rms
        };
        let all: Vec<f64> = (0..=12).map(rms).collect();
        assert!(all.windows(2).all(|w| w[1] <= w[0] * 1.001), "{all:?}");
        let bad = FitSettings { segments: 4, order: 5, samples: 5 };
        assert!(Fit::new(&shape, 1e-5, &bad).is_none());
    }
}
