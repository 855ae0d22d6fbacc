//! Columns of the state as groups of lanes, and vectors in the plane.

use crate::lanes::Lanes;

/// Column `k` of a structure of arrays, as `count` groups.
#[inline(always)]
pub(super) fn column<L: Lanes>(from: &[f64], k: usize, count: usize) -> &[L::Group] {
    &L::groups(from)[k * count..][..count]
}

/// r, theta and phi.
#[inline(always)]
pub(super) fn columns<L: Lanes>(from: &[f64], count: usize) -> [&[L::Group]; 3] {
    [column::<L>(from, 0, count), column::<L>(from, 1, count), column::<L>(from, 2, count)]
}

/// Three columns to write to, and what follows them.
#[inline(always)]
pub(super) fn columns_mut<L: Lanes>(from: &mut [f64], count: usize) -> ([&mut [L::Group]; 3], &mut [L::Group]) {
    let (first, rest) = L::groups_mut(from).split_at_mut(count);
    let (second, rest) = rest.split_at_mut(count);
    let (third, rest) = rest.split_at_mut(count);
    ([first, second, third], rest)
}

/// A vector in the plane, the same in every lane.
pub(super) type Plane<L> = [L; 2];

#[inline(always)]
pub(super) fn pair<L: Lanes>(from: &[f64]) -> Plane<L> {
    [L::splat(from[0]), L::splat(from[1])]
}

/// u along e_r and along e_t.
#[inline(always)]
pub(super) fn polar<L: Lanes>((sin, cos): (L, L), u: &Plane<L>) -> (L, L) {
    (cos.times_plus(u[0], sin * u[1]), sin.minus_times(u[0], cos * u[1]))
}

/// u along e_t.
#[inline(always)]
pub(super) fn along_t<L: Lanes>((sin, cos): (L, L), u: &Plane<L>) -> L {
    sin.minus_times(u[0], cos * u[1])
}
