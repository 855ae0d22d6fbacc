//! The grey level between damage and sound surface, when the user gives none: Otsu's method.

/// A level on the scale 0 to 65535, and the share of the picture's variance that lies between its two sides.
pub(crate) struct Split {
    pub(crate) level: f64,
    pub(crate) separation: f64,
}

/// Otsu, IEEE Trans. SMC 9 (1979) 62: the level that separates two groups with the largest variance between them,
/// on 256 bins. `None` where the picture has one brightness only.
pub(crate) fn otsu(values: &[u16]) -> Option<Split> {
    let mut bins = [0_u64; 256];
    for &value in values {
        bins[usize::from(value >> 8)] += 1;
    }
    let total = values.len() as f64;
    let mean = weighted(&bins, |i| i) / total;
    let variance = weighted(&bins, |i| (i - mean) * (i - mean)) / total;
    if variance <= 0.0 {
        return None;
    }
    let (mut best, mut first, mut last) = (0.0, 0, 0);
    let (mut below, mut sum_below) = (0.0, 0.0);
    for (i, &count) in bins.iter().enumerate().take(255) {
        below += count as f64;
        sum_below += i as f64 * count as f64;
        let above = total - below;
        if below == 0.0 || above == 0.0 {
            continue;
        }
        let gap = sum_below / below - (mean * total - sum_below) / above;
        let between = below * above / (total * total) * gap * gap;
        // Bins without a pixel between the groups leave the value as it is: take the middle of such a stretch.
        if between > best * (1.0 + 1e-12) {
            (best, first, last) = (between, i, i);
        } else if between >= best * (1.0 - 1e-12) && i == last + 1 {
            last = i;
        }
    }
    Some(Split { level: 128.0 * (first + last + 2) as f64, separation: best / variance })
}

fn weighted(bins: &[u64; 256], weight: impl Fn(f64) -> f64) -> f64 {
    (0..).zip(bins).map(|(i, &count)| weight(f64::from(i)) * count as f64).sum()
}
