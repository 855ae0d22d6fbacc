//! A limit that the user gives, and on which side of it the records are.

use super::level::Point;
use brinell::signal::short;
use brinell::signal::trend::Reach;

/// On which side of a limit a value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Below, with its interval.
    Below,
    /// Below; the limit is within the interval, or there is none.
    BelowUnsure,
    /// Above; the limit is within the interval, or there is none.
    AboveUnsure,
    /// Above, with its interval.
    Above,
}

impl Side {
    pub(super) fn of(point: &Point, limit: f64) -> Self {
        match point.interval {
            Some((low, _)) if low > limit => Self::Above,
            Some((_, high)) if high < limit => Self::Below,
            _ if point.value > limit => Self::AboveUnsure,
            _ => Self::BelowUnsure,
        }
    }

    /// As files have it.
    pub fn key(self) -> &'static str {
        ["below", "below_within_interval", "above_within_interval", "above"][self as usize]
    }

    /// Whether the value is above.
    pub fn is_above(self) -> bool {
        matches!(self, Self::Above | Self::AboveUnsure)
    }
}

/// A level against its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// In the level's unit.
    pub value: f64,
    /// Of each record that has the level.
    pub sides: Vec<Option<Side>>,
    /// When it is reached at the present rate of growth, or why nothing is said.
    pub reach: Result<Reach, NoReach>,
}

/// Why no time is said at which a limit is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoReach {
    /// It is reached.
    #[error("the last record is above it")]
    Above,
    /// There are too few records.
    #[error("too few records for a rate")]
    Few,
    /// The last records leap off the course of those before: a rate without them would tell too late or too early.
    #[error("no time is said: the last records lie far off the course of those before, and no rate of both is known")]
    Leap,
    /// Nothing grows.
    #[error("it is not reached at the rate of the last records, which do not grow significantly")]
    NoGrowth,
}

impl Limit {
    /// The value as it was given, unless that is long.
    pub fn text(&self) -> String {
        let plain = self.value.to_string();
        if plain.len() <= 10 { plain } else { short(self.value, 4) }
    }

    /// The first record above it, whether its interval is or not.
    pub fn first_above(&self) -> Option<usize> {
        self.sides.iter().position(|side| side.is_some_and(Side::is_above))
    }

    /// The first record above it with its interval.
    pub fn first_surely_above(&self) -> Option<usize> {
        self.sides.iter().position(|side| *side == Some(Side::Above))
    }
}
