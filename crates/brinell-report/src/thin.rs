//! Curves thinned to the pixels there are.

/// Joins points into lines, broken where a value is missing; of the points that share a pixel column only the first,
/// the lowest, the highest and the last stay, or with `peak` the highest alone.
pub(crate) fn thinned(points: impl Iterator<Item = (f64, Option<f64>)>, peak: bool) -> Vec<Vec<(f64, f64)>> {
    let mut lines: Vec<Vec<(f64, f64)>> = vec![];
    let mut line: Vec<(f64, f64)> = vec![];
    let mut column: Vec<(f64, f64)> = vec![];
    let flush = |column: &mut Vec<(f64, f64)>, line: &mut Vec<(f64, f64)>| {
        let (mut low, mut high) = (0, 0);
        for (i, point) in column.iter().enumerate() {
            // Pixels grow downwards.
            if point.1 > column[low].1 {
                low = i;
            }
            if point.1 < column[high].1 {
                high = i;
            }
        }
        let mut keep = if peak { vec![high] } else { vec![0, low, high, column.len().saturating_sub(1)] };
        keep.sort_unstable();
        keep.dedup();
        line.extend(keep.into_iter().filter_map(|i| column.get(i)));
        column.clear();
    };
    for (x, y) in points {
        if let Some(y) = y {
            if column.last().is_some_and(|last| last.0.floor() != x.floor()) {
                flush(&mut column, &mut line);
            }
            column.push((x, y));
        } else {
            flush(&mut column, &mut line);
            if !line.is_empty() {
                lines.push(std::mem::take(&mut line));
            }
        }
    }
    flush(&mut column, &mut line);
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// Points left out in a row, at most, so that a slow curve cannot drift away from its line.
const STRAIGHT: usize = 12;
/// How far a point may lie from the line that replaces it, px.
const OFF_LINE: f64 = 0.03;

/// The same lines without points that are on the way from one neighbour to the other.
pub(crate) fn straightened(mut lines: Vec<Vec<(f64, f64)>>) -> Vec<Vec<(f64, f64)>> {
    for line in &mut lines {
        let mut kept: Vec<(f64, f64)> = Vec::with_capacity(line.len());
        let mut skipped = 0;
        for (index, point) in line.iter().enumerate() {
            let straight = match (kept.last(), line.get(index + 1)) {
                (Some(before), Some(next)) => {
                    let (dx, dy) = (next.0 - before.0, next.1 - before.1);
                    let (px, py) = (point.0 - before.0, point.1 - before.1);
                    let along = dx * px + dy * py;
                    let length = dx.hypot(dy);
                    (dx * py - dy * px).abs() <= OFF_LINE * length && (0.0..=length * length).contains(&along)
                }
                _ => false,
            };
            if straight && skipped < STRAIGHT {
                skipped += 1;
            } else {
                kept.push(*point);
                skipped = 0;
            }
        }
        *line = kept;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_straight_stretches_lose_points_and_corners_stay() {
        let step: Vec<(f64, f64)> =
            (0..2000).map(|k| (0.25 * f64::from(k), if k < 1000 { 50.0 } else { 10.0 })).collect();
        let thin = straightened(vec![step.clone()]).remove(0);
        assert!(thin.len() < 170, "{}", thin.len());
        for corner in [step[0], step[999], step[1000], step[1999]] {
            assert!(thin.contains(&corner));
        }
        // There and back on one line: the turn stays.
        let spike = vec![(0.0, 0.0), (0.0, 9.0), (0.0, 1.0)];
        assert_eq!(straightened(vec![spike.clone()]), [spike]);
    }

    #[test]
    fn regress_thinning_keeps_extremes_and_gaps() {
        let spike = |i: usize| if i == 777 { 5.0 } else { 100.0 };
        let points = (0..1000).map(|i| (i as f64 * 0.01, (i != 500).then(|| spike(i))));
        let lines = thinned(points, false);
        assert_eq!(lines.len(), 2);
        assert!(lines[1].iter().any(|p| p.1 == 5.0));
        assert!(lines.iter().map(Vec::len).sum::<usize>() <= 44);
        let points = (0..1000).map(|i| (i as f64 * 0.01, Some(spike(i))));
        assert_eq!(thinned(points, true).concat().len(), 10);
    }
}
