//! Sums over long lists, with the instructions of the process's kernel.

use super::{Lanes, Portable, WIDTH};
#[cfg(target_arch = "x86_64")]
use crate::kernel::Kernel;

/// Defines a function that runs `$body::<L, N>` compiled for the instructions of the process's kernel.
macro_rules! dispatched {
    ($(#[$doc:meta])* $name:ident, $body:ident, ($($arg:ident: $type:ty),*) $(-> $out:ty)?) => {
        $(#[$doc])*
        pub fn $name<const N: usize>($($arg: $type),*) $(-> $out)? {
            #[cfg(target_arch = "x86_64")]
            {
                use super::{Avx2, Avx512, Rounded};
                #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
                fn avx512<const N: usize>($($arg: $type),*) $(-> $out)? {
                    $body::<Avx512, N>($($arg),*)
                }
                #[target_feature(enable = "avx2,fma")]
                fn avx2<const N: usize>($($arg: $type),*) $(-> $out)? {
                    $body::<<Avx2 as Lanes>::Pair, N>($($arg),*)
                }
                #[target_feature(enable = "avx2")]
                fn rounded<const N: usize>($($arg: $type),*) $(-> $out)? {
                    $body::<Rounded, N>($($arg),*)
                }
                match Kernel::in_use() {
                    // SAFETY: the kernel in use is one that the processor has the instructions of.
                    Kernel::Avx512 => return unsafe { avx512::<N>($($arg),*) },
                    // SAFETY: as above.
                    Kernel::Avx2 => return unsafe { avx2::<N>($($arg),*) },
                    // SAFETY: as above.
                    Kernel::Portable => return unsafe { rounded::<N>($($arg),*) },
                    Kernel::Plain => {}
                }
            }
            $body::<Portable, N>($($arg),*)
        }
    };
}

dispatched! {
    /// `out` = sum of the factors times their lists. All are equally long.
    blend, blend_lanes, (out: &mut [f64], factors: [f64; N], lists: [&[f64]; N])
}

dispatched! {
    /// Sum over k of `weight[k]` times the square of the sum of the factors times their lists' k-th entries. All are
    /// equally long.
    weighted_square, weighted_square_lanes, (weight: &[f64], factors: [f64; N], lists: [&[f64]; N]) -> f64
}

dispatched! {
    /// Sums of products of `list` with each of the lists. All are equally long.
    inner_products, inner_products_lanes, (list: &[f64], lists: [&[f64]; N]) -> [f64; N]
}

#[inline(always)]
fn add_products<L: Lanes, const N: usize>(
    sums: &mut [L; N],
    head: &[L::Group],
    columns: &[&[L::Group]; N],
    group: usize,
) {
    for k in 0..N {
        sums[k] = L::new(head[group]).times_plus(L::new(columns[k][group]), sums[k]);
    }
}

#[inline(always)]
fn inner_products_lanes<L: Lanes, const N: usize>(list: &[f64], lists: [&[f64]; N]) -> [f64; N] {
    let head = L::groups(list);
    let whole = head.len() * L::COUNT;
    let columns = groups::<L, N>(&lists, head.len());
    // Two sums a list: one product need not wait for the last.
    let (mut evens, mut odds) = ([L::zero(); N], [L::zero(); N]);
    let mut group = 0;
    while group + 1 < head.len() {
        add_products(&mut evens, head, &columns, group);
        add_products(&mut odds, head, &columns, group + 1);
        group += 2;
    }
    if group < head.len() {
        add_products(&mut evens, head, &columns, group);
    }
    let mut out = [0.0; N];
    for k in 0..N {
        out[k] = (evens[k] + odds[k]).sum();
        for (a, b) in list[whole..].iter().zip(&lists[k][whole..]) {
            out[k] += a * b;
        }
    }
    out
}

dispatched! {
    /// Which entries of each list are above 0, a bit each: groups of eight to a byte, the first in the lowest bit. An
    /// incomplete group at the end is left out.
    positive, positive_lanes, (lists: [&[f64]; N], bits: [&mut [u8]; N])
}

#[inline(always)]
fn positive_lanes<L: Lanes, const N: usize>(lists: [&[f64]; N], bits: [&mut [u8]; N]) {
    for (list, bits) in lists.into_iter().zip(bits) {
        for (list, bits) in list.as_chunks::<WIDTH>().0.iter().zip(bits) {
            *bits = 0;
            for (k, group) in L::groups(list).iter().enumerate() {
                *bits |= L::new(*group).above(L::zero()) << (k * L::COUNT);
            }
        }
    }
}

/// The lists as groups, `count` of each.
#[inline(always)]
fn groups<'a, L: Lanes, const N: usize>(lists: &[&'a [f64]; N], count: usize) -> [&'a [L::Group]; N]
where
    L::Group: 'a,
{
    let mut out: [&[L::Group]; N] = [&[]; N];
    for k in 0..N {
        out[k] = &L::groups(lists[k])[..count];
    }
    out
}

/// What a tail too short for a group adds up to at its entry `k`.
#[inline(always)]
fn scalar<const N: usize>(factors: &[f64; N], lists: &[&[f64]; N], k: usize) -> f64 {
    let mut sum = 0.0;
    for n in 0..N {
        sum += factors[n] * lists[n][k];
    }
    sum
}

/// The same of a group.
#[inline(always)]
fn sum<L: Lanes, const N: usize>(factors: &[f64; N], columns: &[&[L::Group]; N], group: usize) -> L {
    let mut sum = L::splat(factors[0]) * L::new(columns[0][group]);
    for k in 1..N {
        sum = L::splat(factors[k]).times_plus(L::new(columns[k][group]), sum);
    }
    sum
}

#[inline(always)]
fn blend_lanes<L: Lanes, const N: usize>(out: &mut [f64], factors: [f64; N], lists: [&[f64]; N]) {
    let count = out.len() / L::COUNT;
    let whole = count * L::COUNT;
    let columns = groups::<L, N>(&lists, count);
    for (group, out) in L::groups_mut(out).iter_mut().enumerate() {
        *out = sum::<L, N>(&factors, &columns, group).array();
    }
    if whole == out.len() {
        return;
    }
    if let Some(start) = out.len().checked_sub(L::COUNT) {
        // A last group that overlaps the one before, whose entries come out as they were.
        let last = lists.map(|list| &list[start..]);
        let columns = groups::<L, N>(&last, 1);
        L::groups_mut(&mut out[start..])[0] = sum::<L, N>(&factors, &columns, 0).array();
    } else {
        for (k, out) in out.iter_mut().enumerate() {
            *out = scalar(&factors, &lists, k);
        }
    }
}

#[inline(always)]
fn weighted_square_lanes<L: Lanes, const N: usize>(weight: &[f64], factors: [f64; N], lists: [&[f64]; N]) -> f64 {
    let head = L::groups(weight);
    let whole = head.len() * L::COUNT;
    let columns = groups::<L, N>(&lists, head.len());
    let mut total = L::zero();
    for (group, weight) in head.iter().enumerate() {
        let sum = sum::<L, N>(&factors, &columns, group);
        total = (L::new(*weight) * sum).times_plus(sum, total);
    }
    let rest: f64 = (whole..weight.len()).map(|k| weight[k] * scalar(&factors, &lists, k).powi(2)).sum();
    total.sum() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_inner_products() {
        let list: Vec<f64> = (0..29).map(f64::from).collect();
        let [squares, sum] = inner_products(&list, [&list, &[1.0; 29]]);
        assert_eq!((squares, sum), (28.0 * 29.0 * 57.0 / 6.0, 28.0 * 29.0 / 2.0));
    }

    #[test]
    fn analytic_positive_entries() {
        let mut list = vec![0.0; 24];
        (list[3], list[8], list[15], list[20]) = (1e-300, 2.0, f64::INFINITY, -1.0);
        list[21] = f64::NAN;
        let mut bits = [0xff; 3];
        positive([&list], [&mut bits]);
        assert_eq!(bits, [1 << 3, 1 | 1 << 7, 0]);
    }

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn prop_sums_have_the_same_bits_with_avx2() {
        use crate::lanes::Rounded;
        #[target_feature(enable = "avx2")]
        fn rounded(weight: &[f64], list: &[f64], factors: [f64; 2], out: &mut [f64]) -> [f64; 2] {
            blend_lanes::<Rounded, 2>(out, factors, [weight, list]);
            let [product] = inner_products_lanes::<Rounded, 1>(weight, [list]);
            [weighted_square_lanes::<Rounded, 2>(weight, factors, [weight, list]), product]
        }
        if !is_x86_feature_detected!("avx2") {
            return;
        }
        for n in [1, 3, 8, 16, 21, 240] {
            let (weight, list): (Vec<f64>, Vec<f64>) = (0..n).map(|k| f64::from(k).sin_cos()).unzip();
            let (factors, mut out, mut wide) = ([0.3, -1.7], vec![0.0; weight.len()], vec![0.0; weight.len()]);
            blend_lanes::<Portable, 2>(&mut out, factors, [&weight, &list]);
            let [product] = inner_products_lanes::<Portable, 1>(&weight, [&list]);
            let square = weighted_square_lanes::<Portable, 2>(&weight, factors, [&weight, &list]);
            // SAFETY: the processor has been asked.
            assert_eq!([square, product], unsafe { rounded(&weight, &list, factors, &mut wide) });
            assert_eq!(out, wide);
        }
    }

    #[test]
    fn analytic_blend_and_weighted_square() {
        let factors = [2.0, -0.25, 1e-3];
        // Shorter than a group of any lanes, one of the widest, and with a last group that overlaps.
        for n in [1, 3, 8, 16, 21] {
            let list = |f: fn(f64) -> f64| (0..n).map(|k| f(k as f64)).collect::<Vec<f64>>();
            let (a, b, c) = (list(f64::sin), list(f64::cos), list(|k| 1.0 + k));
            let mut out = vec![f64::NAN; n];
            blend(&mut out, factors, [&a, &b, &c]);
            let plain: Vec<f64> = (0..n).map(|k| factors[0] * a[k] + factors[1] * b[k] + factors[2] * c[k]).collect();
            for (x, y) in out.iter().zip(&plain) {
                assert!((x - y).abs() < 1e-15);
            }
            let sum: f64 = plain.iter().zip(&c).map(|(x, w)| w * x * x).sum();
            let square = weighted_square(&c, factors, [&a, &b, &c]);
            assert!((square / sum - 1.0).abs() < 1e-14);
        }
    }
}
