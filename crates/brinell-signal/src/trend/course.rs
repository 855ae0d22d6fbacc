//! Values over time.

/// Values over time: times ascend.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Course {
    /// Times, in any unit.
    pub t: Vec<f64>,
    /// Values; of positive quantities their logarithms.
    pub y: Vec<f64>,
    /// Standard uncertainty of each; 0 where none is known.
    pub s: Vec<f64>,
}
