//! The frequency of public power supplies.

/// A mains frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mains {
    /// 50 Hz.
    Hz50,
    /// 60 Hz.
    Hz60,
}

impl Mains {
    /// Both.
    pub const ALL: [Mains; 2] = [Mains::Hz50, Mains::Hz60];

    /// Hz.
    pub fn frequency(self) -> f64 {
        match self {
            Mains::Hz50 => 50.0,
            Mains::Hz60 => 60.0,
        }
    }
}
