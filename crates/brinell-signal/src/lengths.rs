//! Lengths that are transformed fast: without prime factors above 5, others take several times as long.

fn smooth(mut n: usize) -> bool {
    for p in [2, 3, 5] {
        while n > 0 && n.is_multiple_of(p) {
            n /= p;
        }
    }
    n == 1
}

/// The longest even one up to `n`; `n` itself where there is none.
pub(crate) fn fast_up_to(n: usize) -> usize {
    (1..=n).rev().find(|m| m % 2 == 0 && smooth(*m)).unwrap_or(n)
}

/// The shortest one from `n` on.
pub(crate) fn fast_from(n: usize) -> usize {
    (n.max(1)..).find(|m| smooth(*m)).unwrap_or(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_lengths() {
        for (n, down, up) in
            [(0, 0, 1), (1, 1, 1), (7, 6, 8), (15, 12, 15), (51_200, 51_200, 51_200), (1_000_003, 1_000_000, 1_012_500)]
        {
            assert_eq!((fast_up_to(n), fast_from(n)), (down, up), "{n}");
        }
    }
}
