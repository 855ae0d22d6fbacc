//! Several defects at one contact are one surface, the deepest at each point (section 3); a defect that leaves a point
//! alone has no say there.
//!
//! Along an envelope a roller rests on that surface at the height min over x of [h(x) + x^2 / (2 R_eq)], x being the
//! distance from its line of contact. Defects on one surface keep their distance, one on a roller and one on a raceway
//! do not, so the minimum is searched for each position of the roller.
//!
//! The joint surface is nowhere higher than any defect alone (raised edges apart), so no envelope of one lies below
//! that of all: where the point on which the roller rests over the defect with the lowest-lying envelope is not removed
//! by the others, that is the answer. Else the search goes outwards from x = 0, from one end of a straight piece to the
//! next, until the roller's own curvature lies above what was found.

use super::bands::Band;
use super::grid::Grid;
use super::piecewise::{Line, PiecewisePolynomial};

/// A ridge between defects that is narrower than this (m) carries nothing: it is the rounding of their centres and
/// lengths.
const NARROWEST: f64 = 1e-9;

/// Depths (m) that differ by less are equal: round-off of a defect's depth, far below an atom.
const ROUND_OFF: f64 = 1e-15;

/// One defect under the roller, along one line z = const.
#[derive(Debug, Clone, Copy)]
pub(super) struct ArcLine<'a> {
    /// Its depths.
    pub(super) depths: Depths<'a>,
    /// Where the line of contact is on it, m.
    pub(super) s: f64,
}

/// Depths along one line z = const.
#[derive(Debug, Clone, Copy)]
pub(super) enum Depths<'a> {
    /// Straight pieces in ascending order, 0 between them, and their envelope where it is known.
    Lines(&'a [Line], Option<&'a PiecewisePolynomial>),
    /// Within the borders at z of a band, if there are any, as deep as `floor`; `reached` is the envelope of that floor
    /// without ends.
    Within { band: Option<&'a Band>, z: f64, floor: &'a [Line], reached: &'a PiecewisePolynomial },
    /// A depth map at z.
    Map(&'a Grid, f64),
}

/// h = at + slope x of one line, x from the line of contact.
#[derive(Clone, Copy)]
struct Straight {
    at: f64,
    slope: f64,
}

impl Straight {
    fn value(&self, x: f64) -> f64 {
        self.at + self.slope * x
    }
}

/// The part of a straight piece between two s.
fn part(line: &Line, from: f64, to: f64) -> Line {
    let at = |s: f64| line.at_from + (line.at_to - line.at_from) * ((s - line.from) / (line.to - line.from));
    Line {
        from: if from > line.from { from } else { line.from },
        to: if to < line.to { to } else { line.to },
        at_from: if from > line.from { at(from) } else { line.at_from },
        at_to: if to < line.to { at(to) } else { line.at_to },
    }
}

/// The piece of `lines` that begins at s and goes on in a direction (1 or -1), and the s of its end. `None`: nothing
/// there.
fn piece_of(lines: &[Line], s: f64, direction: f64) -> (Option<Line>, f64) {
    if direction > 0.0 {
        let k = lines.partition_point(|l| l.to <= s + NARROWEST);
        match lines.get(k) {
            Some(l) if l.from <= s + NARROWEST => (Some(*l), l.to),
            Some(l) => (None, l.from),
            None => (None, f64::INFINITY),
        }
    } else {
        let k = lines.partition_point(|l| l.from < s - NARROWEST);
        match k.checked_sub(1).map(|k| &lines[k]) {
            Some(l) if l.to >= s - NARROWEST => (Some(*l), l.from),
            Some(l) => (None, l.to),
            None => (None, f64::NEG_INFINITY),
        }
    }
}

/// The same within the chords of a band.
fn piece_within(band: &Band, z: f64, floor: &[Line], s: f64, direction: f64) -> (Option<Line>, f64) {
    let wide = |c: &[f64; 2]| c[1] - c[0] > NARROWEST;
    let chord = if direction > 0.0 {
        band.chords(z).filter(wide).find(|c| c[1] > s + NARROWEST)
    } else {
        band.chords(z).rev().filter(wide).find(|c| c[0] < s - NARROWEST)
    };
    let Some([from, to]) = chord else {
        return (None, direction * f64::INFINITY);
    };
    if direction > 0.0 && from > s + NARROWEST {
        return (None, from);
    }
    if direction < 0.0 && to < s - NARROWEST {
        return (None, to);
    }
    match piece_of(floor, s, direction) {
        (Some(line), _) => {
            let line = part(&line, from, to);
            (Some(line), if direction > 0.0 { line.to } else { line.from })
        }
        (None, end) => (None, end.clamp(from, to)),
    }
}

/// The same of a depth map.
fn piece_on(grid: &Grid, z: f64, s: f64, direction: f64) -> (Option<Line>, f64) {
    let none = (None, direction * f64::INFINITY);
    let (Some(row), last) = (grid.row_at(z), grid.columns() as i64 - 2) else {
        return none;
    };
    let cell = |column: i64| {
        let c = column as usize;
        Line {
            from: grid.s(c),
            to: grid.s(c + 1),
            at_from: grid.between_rows(c, row, z),
            at_to: grid.between_rows(c + 1, row, z),
        }
    };
    let step = direction as i64;
    let is_ahead = |column: i64| {
        let c = column as usize;
        if direction > 0.0 { grid.s(c + 1) > s + NARROWEST } else { grid.s(c) < s - NARROWEST }
    };
    // The cell beside s, whichever side round-off puts s on.
    let mut column = (grid.column_at(s) - 2 * step).clamp(0, last);
    while (0..=last).contains(&column) && !is_ahead(column) {
        column += step;
    }
    let mut end = f64::INFINITY;
    while (0..=last).contains(&column) {
        let line = cell(column);
        if line.at_from != 0.0 || line.at_to != 0.0 {
            let (near, far) = if direction > 0.0 { (line.from, line.to) } else { (line.to, line.from) };
            if direction * (near - s) <= NARROWEST {
                return (Some(line), far);
            }
            end = near;
            break;
        }
        column += step;
    }
    if end.is_finite() { (None, end) } else { none }
}

impl ArcLine<'_> {
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

    /// The piece that begins at x and goes on in a direction (1 or -1), and the x of its end. `None`: not damaged
    /// there.
    fn piece(&self, x: f64, direction: f64) -> (Option<Line>, f64) {
        let s = self.s + x;
        let (line, end) = match self.depths {
            Depths::Lines(lines, _) => piece_of(lines, s, direction),
            Depths::Within { band: Some(band), z, floor, .. } => piece_within(band, z, floor, s, direction),
            Depths::Within { band: None, .. } => (None, direction * f64::INFINITY),
            Depths::Map(grid, z) => piece_on(grid, z, s, direction),
        };
        (line, end - self.s)
    }

    /// A piece as a function of x, where it is damage.
    fn straight(&self, line: &Line) -> Option<Straight> {
        let slope = line.slope();
        (line.at_from != 0.0 || line.at_to != 0.0)
            .then_some(Straight { at: line.at_from + slope * (self.s - line.from), slope })
    }

    /// The envelope of this defect alone and its derivative, where they are known without a search.
    fn alone(&self, radius: f64) -> Option<(f64, f64)> {
        match self.depths {
            Depths::Lines(_, envelope) => {
                let envelope = envelope?;
                Some((envelope.value(self.s), envelope.slope(self.s)))
            }
            Depths::Within { band, z, reached, .. } => {
                let s = self.s;
                let holds = |c: &[f64; 2]| c[0] <= s && s <= c[1];
                let Some([from, to]) = band.and_then(|b| b.chords(z).find(holds)) else {
                    return Some((0.0, 0.0));
                };
                let d = if s - from <= to - s { s - from } else { s - to };
                let (end, floor) = (d * d / (2.0 * radius), reached.value(s).max(0.0));
                Some(if end < floor { (end, d / radius) } else { (floor, reached.slope(s)) })
            }
            Depths::Map(..) => None,
        }
    }
}

/// Straight pieces that are kept rather than looked for again; of more defects at one point there is no room.
const KEPT: usize = 8;

/// The answer where one defect alone gives it; without raised edges.
fn on_one<'a>(lines: impl Iterator<Item = ArcLine<'a>> + Clone, radius: f64) -> Option<f64> {
    let mut deepest: Option<(usize, f64, f64)> = None;
    for (k, it) in lines.clone().enumerate() {
        let (depth, slope) = it.alone(radius)?;
        if deepest.is_none_or(|d| depth > d.1) {
            deepest = Some((k, depth, slope));
        }
    }
    let (deepest, depth, slope) = deepest?;
    // An envelope falls towards the point that it is on: its slope is the distance from there over R_eq.
    let x = -slope * radius;
    let point = depth - x * x / (2.0 * radius);
    let left = lines.enumerate().all(|(k, it)| k == deepest || it.deepest(x) <= point + ROUND_OFF);
    left.then_some(depth)
}

/// Height of the path of a roller of relative radius `radius` (m) over several lines, below the undamaged surface, m;
/// below 0 on raised edges. `lowest` (m, 0 or less) is the height of the highest raised edge.
///
/// Exact but for ridges that are narrower than a nanometre.
pub(super) fn envelope_depth<'a>(lines: impl Iterator<Item = ArcLine<'a>> + Clone, lowest: f64, radius: f64) -> f64 {
    if lowest >= 0.0
        && let Some(depth) = on_one(lines.clone(), radius)
    {
        return depth;
    }
    let mut best = f64::INFINITY;
    for direction in [1.0, -1.0] {
        // Where the piece begins.
        let mut x = 0.0_f64;
        while x.is_finite() && x * x / (2.0 * radius) + lowest < best {
            let (mut kept, mut count, mut end) = ([Straight { at: 0.0, slope: 0.0 }; KEPT], 0, f64::INFINITY);
            for it in lines.clone() {
                let (line, to) = it.piece(x, direction);
                end = end.min(direction * to);
                if let Some(straight) = line.and_then(|line| it.straight(&line)) {
                    if let Some(place) = kept.get_mut(count) {
                        *place = straight;
                    }
                    count += 1;
                }
            }
            let end = direction * end;
            best = best.min(match kept.get(..count) {
                Some(kept) => lowest_of(kept.iter().copied(), x, end, radius),
                None => {
                    let all = lines.clone().filter_map(|it| it.straight(&it.piece(x, direction).0?));
                    lowest_of(all, x, end, radius)
                }
            });
            x = end;
        }
    }
    best
}

/// The lowest of max h(x) + x^2 / (2 R_eq) between two x, of which the first is nearer to 0.
///
/// The function is convex: its minimum lies on one straight line's own, where two cross, or at an end.
fn lowest_of(straights: impl Iterator<Item = Straight> + Clone, from: f64, to: f64, radius: f64) -> f64 {
    let (low, high) = (from.min(to), from.max(to));
    let path = |x: f64| {
        let top = straights.clone().map(|l| l.value(x)).reduce(f64::max);
        top.unwrap_or(0.0) + x * x / (2.0 * radius)
    };
    // Without any the undamaged surface carries, up to whose edge the roller leans.
    let mut best = path(from);
    for (k, a) in straights.clone().enumerate() {
        best = best.min(path((-a.slope * radius).clamp(low, high)));
        for b in straights.clone().skip(k + 1) {
            let x = (b.at - a.at) / (a.slope - b.slope);
            if x > low && x < high {
                best = best.min(path(x));
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defect::envelope;

    const R: f64 = 3.367e-3;

    /// Numbers in 0..1, the same ones each time.
    fn draws(mut state: u64) -> impl FnMut() -> f64 {
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
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
                lines.push(Line { from: at, to, at_from, at_to });
            }
            at = to;
        }
        lines
    }

    fn lowest(lines: &[ArcLine]) -> f64 {
        let lines = lines.iter().flat_map(lines_of);
        lines.map(|l| l.at_from.min(l.at_to)).fold(0.0, f64::min)
    }

    fn lines_of<'a>(line: &ArcLine<'a>) -> &'a [Line] {
        match line.depths {
            Depths::Lines(lines, _) => lines,
            _ => &[],
        }
    }

    fn resting(lines: &[ArcLine]) -> f64 {
        envelope_depth(lines.iter().copied(), lowest(lines), R)
    }

    #[test]
    fn analytic_one_strip_alone_has_its_own_envelope() {
        let mut draw = draws(3);
        for round in 0..60 {
            let lines = random_lines(&mut draw, if round % 2 == 0 { 0.0 } else { 0.3 });
            let plain = envelope(&lines, R);
            for k in 0..200 {
                let s = -1.5e-3 + 3e-3 * f64::from(k) / 200.0;
                let depths = Depths::Lines(&lines, None);
                let ours = resting(&[ArcLine { depths, s }]);
                assert!((ours - plain.value(s)).abs() < 1e-15, "round {round} at {s}");
            }
        }
    }

    /// The definition, tried every 50 nm: half a step on the steepest slope, 30 um in 20 um, is 38 nm.
    fn brute(lines: &[ArcLine]) -> f64 {
        let height = |x: f64| {
            let depths = lines.iter().filter_map(|line| {
                let s = line.s + x;
                let l = lines_of(line).iter().find(|l| s >= l.from && s < l.to)?;
                Some(l.at_from + (l.at_to - l.at_from) * (s - l.from) / (l.to - l.from))
            });
            depths.reduce(f64::max).unwrap_or(0.0) + x * x / (2.0 * R)
        };
        (-20_000..=20_000).map(|k| height(5e-8 * f64::from(k))).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn prop_rest_on_random_strips_agrees_with_the_definition() {
        let mut draw = draws(11);
        for round in 0..400 {
            let raised = if round % 2 == 0 { 0.0 } else { 0.3 };
            let lines: Vec<Vec<Line>> =
                (0..[2, 3, KEPT + 2][round % 3]).map(|_| random_lines(&mut draw, raised)).collect();
            let envelopes: Vec<PiecewisePolynomial> = lines.iter().map(|l| envelope(l, R)).collect();
            let lines: Vec<ArcLine> = lines
                .iter()
                .zip(&envelopes)
                .map(|(lines, envelope)| ArcLine {
                    depths: Depths::Lines(lines, Some(envelope)),
                    s: 1e-3 * (draw() - 0.5),
                })
                .collect();
            let (ours, tried) = (resting(&lines), brute(&lines));
            assert!(ours <= tried + 1e-15, "round {round}: {ours} above {tried}");
            assert!(ours >= tried - 4e-8, "round {round}: {ours} below {tried}");
        }
    }
}
