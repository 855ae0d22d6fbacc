//! The noise floor about each bin of a spectrum.

/// Medians over `width` neighbours, taken at every eighth of that and joined by lines.
pub(super) fn running_median(values: &[f64], width: usize) -> Vec<f64> {
    let n = values.len();
    let every = (width / 8).max(1);
    let median = |center: usize| {
        let from = center.saturating_sub(width / 2).min(n.saturating_sub(width));
        let mut near = values[from..(from + width).min(n)].to_vec();
        let middle = near.len() / 2;
        *near.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    let knots: Vec<f64> = (0..n.div_ceil(every) + 1).map(|k| median((k * every).min(n - 1))).collect();
    (0..n)
        .map(|k| {
            let (knot, part) = (k / every, (k % every) as f64 / every as f64);
            knots[knot] + part * (knots[knot + 1] - knots[knot])
        })
        .collect()
}
