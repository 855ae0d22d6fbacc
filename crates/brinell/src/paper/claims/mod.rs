//! What sections 3 to 5 say, sentence by sentence.

mod defects;
mod models;
mod operation;

use super::claim::{Check, Claim, Statement};
use super::verdict::Trend;

/// Every claim, in the paper's order.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    let operation = operation::CLAIMS.iter().chain(models::CLAIMS);
    defects::CLAIMS.iter().chain(operation)
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
