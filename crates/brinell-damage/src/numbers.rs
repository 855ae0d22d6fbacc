//! Small numerics that fits share: linear equations, middle values.

/// Solution of linear equations by Gaussian elimination with pivots: a row each, its right side in the last column.
/// `None` where no pivot is above `least` in magnitude, or a number is not finite.
pub(crate) fn solved<R: AsRef<[f64]> + AsMut<[f64]>>(rows: &mut [R], least: f64) -> Option<Vec<f64>> {
    let n = rows.len();
    let size = |row: &R, k: usize| row.as_ref()[k].abs();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| size(&rows[a], k).total_cmp(&size(&rows[b], k)))?;
        rows.swap(k, pivot);
        let largest = size(&rows[k], k);
        if largest <= least || !largest.is_finite() {
            return None;
        }
        let (done, below) = rows.split_at_mut(k + 1);
        let above = done[k].as_ref();
        for row in below.iter_mut().map(AsMut::as_mut) {
            let factor = row[k] / above[k];
            for (x, by) in row[k..].iter_mut().zip(&above[k..]) {
                *x -= factor * by;
            }
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let row = rows[k].as_ref();
        let known: f64 = (k + 1..n).map(|c| row[c] * x[c]).sum();
        x[k] = (row[row.len() - 1] - known) / row[k];
    }
    x.iter().all(|v| v.is_finite()).then_some(x)
}

/// The middle value; 0 of none. NaN must not be among them.
pub(crate) fn median(values: impl Iterator<Item = f64>) -> f64 {
    quantile(values, 0.5)
}

/// The value below which `share` (0 to 1) of the others lie.
pub(crate) fn quantile(values: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut values: Vec<f64> = values.collect();
    if values.is_empty() {
        return 0.0;
    }
    let at = (share * (values.len() - 1) as f64).round() as usize;
    *values.select_nth_unstable_by(at, f64::total_cmp).1
}
