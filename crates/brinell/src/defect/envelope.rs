//! What a roller of finite radius can reach: h_env(s) = min over s' of [h(s') + (s - s')^2 / (2 R_eq)] (section 3).
//!
//! h is made of straight pieces with jumps, 0 elsewhere. Each piece lends the envelope one function of s: its own line
//! moved by m^2 R_eq / 2 where the minimum lies inside the piece, and the parabola about an end elsewhere. Of two such
//! functions the right-hand one falls faster everywhere, so they cross once, and the lower envelope of all comes from
//! one pass with a stack (Felzenszwalb and Huttenlocher's distance transform, with lines besides parabolas). The result
//! is exact but for the crossings, which are found to round-off; a step of the simulation costs what it costs without
//! an envelope.

use super::piecewise::{Line, Piece, PiecewisePolynomial};

/// What a piece of h contributes to the envelope.
impl Line {
    /// s below which the first end acts, and above which the last does.
    fn regimes(&self, radius: f64) -> [f64; 2] {
        let ahead = self.slope() * radius;
        [self.from + ahead, self.to + ahead]
    }

    fn contribution(&self, s: f64, radius: f64) -> f64 {
        let [low, high] = self.regimes(radius);
        let parabola = |vertex: f64| (s - vertex) * (s - vertex) / (2.0 * radius);
        if s < low {
            self.at_from + parabola(self.from)
        } else if s > high {
            self.at_to + parabola(self.to)
        } else {
            let slope = self.slope();
            self.at_from + slope * (s - self.from) - 0.5 * slope * slope * radius
        }
    }

    /// The envelope's pieces where this candidate is the lowest.
    fn emit(&self, from: f64, to: f64, radius: f64, pieces: &mut Vec<Piece>) {
        let [low, high] = self.regimes(radius);
        let parabola = |start: f64, vertex: f64, value: f64| {
            let x = start - vertex;
            Piece { start, c: [value + x * x / (2.0 * radius), x / radius, 0.5 / radius] }
        };
        if from < low {
            pieces.push(parabola(from, self.from, self.at_from));
        }
        let (a, b) = (from.max(low), to.min(high));
        if a < b {
            pieces.push(Piece { start: a, c: [self.contribution(a, radius), self.slope(), 0.0] });
        }
        if to > high {
            pieces.push(parabola(from.max(high), self.to, self.at_to));
        }
    }
}

/// The envelope of h for the radius R_eq (m); `lines` as in [`PiecewisePolynomial::of_lines`].
///
/// Where h >= 0 the envelope is 0 outside the damage. A raised edge (h < 0) is felt before the contact line reaches it:
/// there the envelope extends to where it comes back to 0.
pub fn envelope(lines: &[Line], radius: f64) -> PiecewisePolynomial {
    let lines: Vec<&Line> = lines.iter().filter(|l| l.to > l.from).collect();
    let (Some(first), Some(last)) = (lines.first(), lines.last()) else {
        return PiecewisePolynomial::default();
    };
    let lowest = lines.iter().map(|l| l.at_from.min(l.at_to)).fold(0.0, f64::min);
    let reach = (-2.0 * radius * lowest).sqrt();
    let (start, end) = (first.from - reach, last.to + reach);
    // The undamaged surface on both sides and in the gaps; "far" is beyond all that matters.
    let far = 1.0 + (end - start);
    let mut candidates = vec![Line::flat(first.from - far, first.from, 0.0)];
    let mut at = first.from;
    for line in &lines {
        if line.from > at {
            candidates.push(Line::flat(at, line.from, 0.0));
        }
        candidates.push(**line);
        at = line.to;
    }
    candidates.push(Line::flat(at, at + far, 0.0));

    // Which candidate is the lowest from which s on.
    let mut stack: Vec<(usize, f64)> = vec![(0, start)];
    for (j, right) in candidates.iter().enumerate().skip(1) {
        while let Some(&(i, from)) = stack.last() {
            let above = |s: f64| candidates[i].contribution(s, radius) - right.contribution(s, radius);
            if above(from) >= 0.0 && stack.len() > 1 {
                stack.pop();
                continue;
            }
            if above(from) >= 0.0 {
                stack[0] = (j, start);
            } else if above(end) > 0.0 {
                stack.push((j, crossing(above, from, end)));
            }
            break;
        }
    }

    let mut pieces = Vec::with_capacity(2 * stack.len());
    for (k, &(i, from)) in stack.iter().enumerate() {
        let to = stack.get(k + 1).map_or(end, |next| next.1);
        if to > from {
            candidates[i].emit(from, to, radius, &mut pieces);
        }
    }
    PiecewisePolynomial::of_pieces(start, end, pieces)
}

/// Where a function that does not fall changes sign from below 0 at `low` to above 0 at `high`: secant steps kept
/// within the bracket (Illinois), bisection where they stall.
fn crossing(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (f(low), f(high));
    let mut kept = 0;
    for round in 0..200 {
        let secant = low - at_low * (high - low) / (at_high - at_low);
        let middle = 0.5 * (low + high);
        let s = if round % 4 == 3 || !(secant > low && secant < high) { middle } else { secant };
        if middle <= low || middle >= high || high - low < 1e-16 {
            break;
        }
        let value = f(s);
        if value < 0.0 {
            (low, at_low) = (s, value);
            if kept == -1 {
                at_high *= 0.5;
            }
            kept = -1;
        } else {
            (high, at_high) = (s, value);
            if kept == 1 {
                at_low *= 0.5;
            }
            kept = 1;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    const R: f64 = 3.367e-3;

    /// The definition, tried at many s' of every piece and of the undamaged surface.
    fn brute(lines: &[Line], s: f64, radius: f64) -> f64 {
        const TRIES: i32 = 4000;
        let (first, last) = (lines[0].from, lines[lines.len() - 1].to);
        let mut best = if s <= first || s >= last { 0.0 } else { f64::INFINITY };
        let mut at = first;
        let mut all = vec![Line::flat(first - 1e-3, first, 0.0), Line::flat(last, last + 1e-3, 0.0)];
        for l in lines {
            if l.from > at {
                all.push(Line::flat(at, l.from, 0.0));
            }
            all.push(*l);
            at = l.to;
        }
        for l in all {
            for k in 0..=TRIES {
                let f = f64::from(k) / f64::from(TRIES);
                let p = l.from + f * (l.to - l.from);
                let h = l.at_from + f * (l.at_to - l.at_from);
                best = best.min(h + (s - p) * (s - p) / (2.0 * radius));
            }
        }
        best
    }

    #[test]
    fn analytic_envelope_of_a_rectangle() {
        for (half, depth) in [(1.5e-3, 20e-6), (0.1e-3, 20e-6)] {
            let e = envelope(&[Line::flat(-half, half, depth)], R);
            for k in -1000..=1000 {
                let s = half * f64::from(k) / 1000.0;
                let exact = depth.min((half - s.abs()).powi(2) / (2.0 * R));
                assert!((e.value(s) - exact).abs() < 1e-18, "at {s}");
            }
            assert_eq!((e.value(1.01 * half), e.value(-half)), (0.0, 0.0));
        }
    }

    #[test]
    fn analytic_envelope_of_a_v_groove() {
        let (half, depth) = (1e-3, 30e-6);
        let m = depth / half;
        let groove = [
            Line { from: -half, to: 0.0, at_from: 0.0, at_to: depth },
            Line { from: 0.0, to: half, at_from: depth, at_to: 0.0 },
        ];
        let e = envelope(&groove, R);
        for k in -2000..=2000 {
            let x = half * (f64::from(k) / 2000.0);
            // Resting on a flank where the foot lies within it, else on the groove's edge.
            let foot = x.abs() + m * R;
            let exact =
                if foot <= half { depth - m * x.abs() - 0.5 * m * m * R } else { (half - x.abs()).powi(2) / (2.0 * R) };
            assert!((e.value(x) - exact).abs() < 1e-18, "at {x}: {} {exact}", e.value(x));
        }
    }

    #[test]
    fn prop_envelope_of_random_courses_agrees_with_its_definition() {
        let mut state = 7u64;
        let mut draw = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for round in 0..60 {
            let raised = round % 2 == 1;
            let mut lines = Vec::new();
            let mut at = -1e-3;
            for _ in 0..12 {
                let to = at + 0.2e-3 * draw();
                let depth = |x: f64| 30e-6 * if raised { x - 0.3 } else { x };
                let (a, b) = (depth(draw()), depth(draw()));
                if draw() > 0.25 {
                    lines.push(Line { from: at, to, at_from: a, at_to: b });
                }
                at = to;
            }
            let e = envelope(&lines, R);
            let plain = PiecewisePolynomial::of_lines(&lines);
            for k in 0..200 {
                let s = -1.6e-3 + 4e-3 * f64::from(k) / 200.0;
                let (ours, tried) = (e.value(s), brute(&lines, s, R));
                assert!(ours <= tried + 1e-15, "round {round} at {s}: {ours} above {tried}");
                assert!(ours >= tried - 2e-8, "round {round} at {s}: {ours} below {tried}");
                assert!(ours <= plain.value(s).max(0.0) + 1e-15, "deeper than the floor");
            }
        }
    }
}
