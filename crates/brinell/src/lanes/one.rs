//! One number as a group of one lane, with the functions of the standard library: slow, and plain to follow in a
//! debugger.

use super::{Lanes, grouped, ninth};

impl Lanes for f64 {
    type Pair = Self;
    grouped!(1);

    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn new(x: [f64; 1]) -> Self {
        x[0]
    }

    #[inline(always)]
    fn array(self) -> [f64; 1] {
        [self]
    }

    #[inline(always)]
    fn if_above(self, other: Self, x: Self, y: Self) -> Self {
        if self > other { x } else { y }
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        f64::exp(self)
    }

    #[inline(always)]
    fn tanh(self) -> Self {
        f64::tanh(self)
    }

    #[inline(always)]
    fn ten_ninths(self) -> Self {
        ninth::ten_ninths(self)
    }
}
