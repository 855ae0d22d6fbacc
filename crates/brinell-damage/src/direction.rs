//! Where the rolling direction points in a picture, and the turn that brings it to `s`. Turns only: no mirror.

/// The direction in which the roller passes, in the picture as it is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Direction {
    /// `s` to the right, `z` up.
    #[default]
    Right,
    /// `s` up, `z` to the left.
    Up,
    /// `s` to the left, `z` down.
    Left,
    /// `s` down, `z` to the right.
    Down,
}

impl Direction {
    /// `[s, z]` of a point `x` to the right and `y` down.
    #[cfg(feature = "image")]
    pub(crate) fn turn(self, x: f64, y: f64) -> [f64; 2] {
        match self {
            Self::Right => [x, -y],
            Self::Up => [-y, -x],
            Self::Left => [-x, y],
            Self::Down => [y, x],
        }
    }

    /// Whether `s` runs along the picture's rows.
    pub(crate) fn along_rows(self) -> bool {
        matches!(self, Self::Right | Self::Left)
    }

    /// Turns a grid whose first row is the picture's top: columns of the result run along `s`, rows along `z`.
    pub(crate) fn turn_grid<T: Copy>(self, width: usize, height: usize, picture: &[T]) -> Vec<T> {
        let at = |x: usize, y: usize| picture[y * width + x];
        let mut grid = Vec::with_capacity(picture.len());
        let (columns, rows) = if self.along_rows() { (width, height) } else { (height, width) };
        for row in 0..rows {
            for column in 0..columns {
                grid.push(match self {
                    Self::Right => at(column, height - 1 - row),
                    Self::Up => at(width - 1 - row, height - 1 - column),
                    Self::Left => at(width - 1 - column, row),
                    Self::Down => at(row, column),
                });
            }
        }
        grid
    }
}
