//! Curves thinned to the pixels there are.

/// Joins points into lines, broken where a value is missing; of the points that share a pixel column only the first, the
/// lowest, the highest and the last stay, or with `peak` the highest alone.
pub(crate) fn thinned(
    points: impl Iterator<Item = (f64, Option<f64>)>,
    peak: bool,
) -> Vec<Vec<(f64, f64)>> {
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
        let mut keep = if peak {
            vec![high]
        } else {
            vec![0, low, high, column.len().saturating_sub(1)]
        };
        keep.sort_unstable();
        keep.dedup();
        line.extend(keep.into_iter().filter_map(|i| column.get(i)));
        column.clear();
    };
    for (x, y) in points {
        if let Some(y) = y {
            if column
                .last()
                .is_some_and(|last| last.0.floor() != x.floor())
            {
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

#[cfg(test)]
mod tests {
    use super::*;

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
