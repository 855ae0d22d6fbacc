//! What sections 4 and 5 say, sentence by sentence.

mod defects;
mod operation;

use super::judge::{Check, Claim, Statement};
use super::verdict::Trend;

/// Every claim, in the paper's order.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    defects::CLAIMS.iter().chain(operation::CLAIMS)
}

const fn so(words: &'static str, check: Check) -> Statement {
    Statement { words, check }
}

/// A trend of a number.
const fn trend(
    words: &'static str,
    name: &'static str,
    trend: Trend,
    cases: &'static [&'static str],
) -> Statement {
    so(words, Check::Follows { trend, cases, name })
}

const fn greater(
    words: &'static str,
    of: (&'static str, &'static str),
    than: (&'static str, &'static str),
) -> Statement {
    so(words, Check::Greater { of, than })
}
