//! The path of a roller over several defects: the envelope of the surface that they leave together (section 3).
//!
//! The joint surface is as deep as the deepest defect at each point; a defect that leaves a point alone (h = 0) has no say there. A roller of
//! radius r rests on it at the height min over x of [h(x) + x^2 / (2 R_eq)], x being the distance from its line of contact. Defects on one
//! surface keep their distance, one on a roller and one on a raceway do not, so the minimum is searched where the roller stands.
//!
//! The joint surface is nowhere higher than any defect alone (raised edges apart), so no envelope of one lies below that of all: where the
//! point on which the roller rests over the defect with the lowest-lying envelope is left standing by the others, that is the answer. Else
//! the search goes outwards from x = 0, from one end of a straight piece to the next, until the roller's own curvature lies above what was found.

use super::course::{Course, Line};

/// A ridge between defects that is narrower than this (m) carries nothing: it is the rounding of their centres and lengths.
const NARROWEST: f64 = 1e-9;

/// Depths (m) that differ by less are equal: round-off of a defect's depth, far below an atom.
const ROUND_OFF: f64 = 1e-15;

/// One defect under the roller, along one line z = const.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strip<'a> {
    /// Its depths in ascending order, m; 0 where there are none.
    pub(super) lines: &'a [Line],
    /// Its own envelope.
    pub(super) envelope: Option<&'a Course>,
    /// Where the line of contact stands on it, m.
    pub(super) s: f64,
}

/// Where the roller rests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rest {
    /// Height of the roller's path below the undamaged surface, m; below 0 on raised edges.
    pub(super) depth: f64,
    /// d(depth)/ds of the strips (by their number) that the roller rests on; all others have no say.
    pub(super) slopes: [(usize, f64); 2],
}

/// h = at + slope x of one strip, x from the line of contact.
#[derive(Clone, Copy)]
struct Straight {
    strip: usize,
    at: f64,
    slope: f64,
}

impl Straight {
    fn value(&self, x: f64) -> f64 {
        self.at + self.slope * x
    }
}

impl Strip<'_> {
    /// The deeper of the depths on both sides of x, m; 0 where neither is damaged.
    fn deepest(&self, x: f64) -> f64 {
        [1.0, -1.0]
            .into_iter()
            .filter_map(|direction| self.piece(x, direction).0)
            .map(|l| {
                let share = (self.s + x - l.from) / (l.to - l.from);
                l.at_from + (l.at_to - l.at_from) * share.clamp(0.0, 1.0)
            })
            .fold(0.0, f64::max)
    }

    /// The piece that begins at x and goes on in a direction (1 or -1), and the x of its end. `None`: not damaged there.
    fn piece(&self, x: f64, direction: f64) -> (Option<&Line>, f64) {
        let s = self.s + x;
        if direction > 0.0 {
            let k = self.lines.partition_point(|l| l.to <= s + NARROWEST);
            match self.lines.get(k) {
                Some(l) if l.from <= s + NARROWEST => (Some(l), l.to - self.s),
                Some(l) => (None, l.from - self.s),
                None => (None, f64::INFINITY),
            }
        } else {
            let k = self.lines.partition_point(|l| l.from < s - NARROWEST);
            match k.checked_sub(1).map(|k| &self.lines[k]) {
                Some(l) if l.to >= s - NARROWEST => (Some(l), l.from - self.s),
                Some(l) => (None, l.to - self.s),
                None => (None, f64::NEG_INFINITY),
            }
        }
    }
}

/// The damaging pieces that begin at x.
fn straights<'a>(
    strips: impl Iterator<Item = Strip<'a>> + Clone,
    x: f64,
    direction: f64,
) -> impl Iterator<Item = Straight> + Clone {
    strips.enumerate().filter_map(move |(strip, it)| {
        let line = it.piece(x, direction).0?;
        let slope = (line.at_to - line.at_from) / (line.to - line.from);
        (line.at_from != 0.0 || line.at_to != 0.0).then_some(Straight {
            strip,
            at: line.at_from + slope * (it.s - line.from),
            slope,
        })
    })
}

/// The answer where one defect alone gives it; without raised edges.
fn on_one<'a>(strips: impl Iterator<Item = Strip<'a>> + Clone, radius: f64) -> Option<Rest> {
    let (deepest, depth, slope) = strips
        .clone()
        .enumerate()
        .filter_map(|(k, it)| Some((k, it.envelope?.value(it.s), it.envelope?.slope(it.s))))
        .reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    // An envelope falls towards the point that it stands on: its slope is the distance from there over R_eq.
    let x = -slope * radius;
    let point = depth - x * x / (2.0 * radius);
    let left = strips
        .enumerate()
        .all(|(k, it)| k == deepest || it.deepest(x) <= point + ROUND_OFF);
    left.then_some(Rest {
        depth,
        slopes: [(deepest, slope), (deepest, 0.0)],
    })
}

/// Where a roller of relative radius `radius` (m) rests on several strips; `lowest` (m, 0 or less) is the height of the highest raised edge.
///
/// Exact but for ridges that are narrower than a nanometre.
pub(super) fn rest<'a>(
    strips: impl Iterator<Item = Strip<'a>> + Clone,
    lowest: f64,
    radius: f64,
) -> Rest {
    if lowest >= 0.0
        && let Some(rest) = on_one(strips.clone(), radius)
    {
        return rest;
    }
    let mut best = Rest {
        depth: f64::INFINITY,
        slopes: [(0, 0.0); 2],
    };
    for direction in [1.0, -1.0] {
        // Where the piece begins, and whose end that is.
        let (mut x, mut border) = (0.0_f64, 0);
        while x.is_finite() && x * x / (2.0 * radius) + lowest < best.depth {
            let (owner, end) = strips
                .clone()
                .enumerate()
                .map(|(k, strip)| (k, strip.piece(x, direction).1))
                .reduce(|a, b| {
                    if direction * b.1 < direction * a.1 {
                        b
                    } else {
                        a
                    }
                })
                .unwrap_or((0, direction * f64::INFINITY));
            let here = straights(strips.clone(), x, direction);
            let from = (x, border);
            lowest_of(here, from, (end, owner), radius, &mut best);
            (x, border) = (end, owner);
        }
    }
    best
}

/// The lowest of max h(x) + x^2 / (2 R_eq) between two x, each the end of the piece of a strip, where it lies below what was found before.
///
/// The function is convex: its minimum lies on one straight line's own, where two cross, or at an end.
fn lowest_of(
    straights: impl Iterator<Item = Straight> + Clone,
    from: (f64, usize),
    to: (f64, usize),
    radius: f64,
    best: &mut Rest,
) {
    let (low, high) = (from.0.min(to.0), from.0.max(to.0));
    let top = |x: f64| {
        straights
            .clone()
            .map(|l| l.value(x))
            .reduce(f64::max)
            .unwrap_or(0.0)
    };
    let mut offer = |x: f64, slopes: [(usize, f64); 2]| {
        let depth = top(x) + x * x / (2.0 * radius);
        if depth < best.depth {
            *best = Rest { depth, slopes };
        }
    };
    if straights.clone().next().is_none() {
        // The undamaged surface, up to whose edge the roller leans.
        offer(from.0, [(from.1, -from.0 / radius), (from.1, 0.0)]);
        return;
    }
    for line in straights.clone() {
        let free = -line.slope * radius;
        let (x, owner) = if free >= low && free <= high {
            (free, line.strip)
        } else if (free < low) == (from.0 < to.0) {
            from
        } else {
            to
        };
        if line.value(x) < top(x) {
            continue;
        }
        // An end moves with the strip whose end it is, the height with the line; where the line's own minimum is free, x moves nothing.
        let slopes = [
            (line.strip, line.slope),
            (owner, -(line.slope + x / radius)),
        ];
        offer(x, slopes);
    }
    for (k, a) in straights.clone().enumerate() {
        for b in straights.clone().skip(k + 1) {
            let x = (b.at - a.at) / (a.slope - b.slope);
            if x > low && x < high {
                let share = (-x / radius - b.slope) / (a.slope - b.slope);
                let slopes = [
                    (a.strip, share * a.slope),
                    (b.strip, (1.0 - share) * b.slope),
                ];
                offer(x, slopes);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defect::envelope;

    const R: f64 = 3.367e-3;

    /// Numbers in 0..1, the same ones each time.
    fn draws(mut state: u64) -> impl FnMut() -> f64 {
        move || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        }
    }

    fn random_lines(draw: &mut impl FnMut() -> f64, raised: f64) -> Vec<Line> {
        let mut at = -1e-3 * draw();
        let mut lines = Vec::new();
        for _ in 0..8 {
            let to = at + 20e-6 + 0.18e-3 * draw();
            let mut depth = || 30e-6 * (draw() - raised);
            let (at_from, at_to) = (depth(), depth());
            if draw() > 0.25 {
                lines.push(Line {
                    from: at,
                    to,
                    at_from,
                    at_to,
                });
            }
            at = to;
        }
        lines
    }

    fn lowest(strips: &[Strip]) -> f64 {
        let lines = strips.iter().flat_map(|s| s.lines);
        lines.map(|l| l.at_from.min(l.at_to)).fold(0.0, f64::min)
    }

    fn resting(strips: &[Strip]) -> Rest {
        rest(strips.iter().copied(), lowest(strips), R)
    }

    #[test]
    fn analytic_one_strip_alone_has_its_own_envelope() {
        let mut draw = draws(3);
        for round in 0..60 {
            let lines = random_lines(&mut draw, if round % 2 == 0 { 0.0 } else { 0.3 });
            let plain = envelope(&lines, R);
            for k in 0..200 {
                let s = -1.5e-3 + 3e-3 * f64::from(k) / 200.0;
                let strip = Strip {
                    lines: &lines,
                    envelope: None,
                    s,
                };
                let ours = resting(&[strip]).depth;
                assert!(
                    (ours - plain.value(s)).abs() < 1e-15,
                    "round {round} at {s}"
                );
            }
        }
    }

    /// The definition, tried every 50 nm: half a step on the steepest slope, 30 um in 20 um, is 38 nm.
    fn brute(strips: &[Strip]) -> f64 {
        let height = |x: f64| {
            let depths = strips.iter().filter_map(|strip| {
                let s = strip.s + x;
                let l = strip.lines.iter().find(|l| s >= l.from && s < l.to)?;
                Some(l.at_from + (l.at_to - l.at_from) * (s - l.from) / (l.to - l.from))
            });
            depths.reduce(f64::max).unwrap_or(0.0) + x * x / (2.0 * R)
        };
        (-20_000..=20_000)
            .map(|k| height(5e-8 * f64::from(k)))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn prop_rest_on_random_strips_agrees_with_the_definition_and_its_slopes_are_derivatives() {
        let mut draw = draws(11);
        let mut kinks = 0;
        for round in 0..400 {
            let raised = if round % 2 == 0 { 0.0 } else { 0.3 };
            let lines: Vec<Vec<Line>> = (0..2 + round % 2)
                .map(|_| random_lines(&mut draw, raised))
                .collect();
            let envelopes: Vec<Course> = lines.iter().map(|l| envelope(l, R)).collect();
            let mut strips: Vec<Strip> = lines
                .iter()
                .zip(&envelopes)
                .map(|(lines, envelope)| Strip {
                    lines,
                    envelope: Some(envelope),
                    s: 1e-3 * (draw() - 0.5),
                })
                .collect();
            let ours = resting(&strips);
            let tried = brute(&strips);
            assert!(
                ours.depth <= tried + 1e-15,
                "round {round}: {} above {tried}",
                ours.depth
            );
            assert!(
                ours.depth >= tried - 4e-8,
                "round {round}: {} below {tried}",
                ours.depth
            );
            for k in 0..strips.len() {
                let by = |step: f64, strips: &mut Vec<Strip>| {
                    strips[k].s += step;
                    let depth = resting(strips).depth;
                    strips[k].s -= step;
                    depth
                };
                let step = 1e-9;
                let numeric = (by(step, &mut strips) - by(-step, &mut strips)) / (2.0 * step);
                let slope: f64 = ours
                    .slopes
                    .iter()
                    .filter(|(strip, _)| *strip == k)
                    .map(|(_, slope)| slope)
                    .sum();
                // Where the roller changes from one support to another, the depth has a kink.
                kinks += usize::from((slope - numeric).abs() > 1e-6);
            }
        }
        assert!(kinks <= 4, "{kinks} of 1000 slopes");
    }
}
