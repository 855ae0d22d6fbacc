//! The two contacts of a rolling element.

/// Side of a roller: the raceway that it meets there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// Inner raceway.
    Inner,
    /// Outer raceway.
    Outer,
}

impl Side {
    /// In words: `inner` or `outer`.
    pub fn word(self) -> &'static str {
        match self {
            Side::Inner => "inner",
            Side::Outer => "outer",
        }
    }
}

/// Both sides, in the order of arrays indexed by side.
pub const SIDES: [Side; 2] = [Side::Inner, Side::Outer];
