//! Where +s points in a picture (the key `rolling_direction`), and the turn that brings it to `s`. Turns only: no mirror.
//! Which way rollers pass is another thing: [`brinell::derived::Passing`].

use brinell::scenario::RollingDirection;

/// `[s, z]` of a point `x` to the right and `y` down.
pub(crate) fn turn(direction: RollingDirection, x: f64, y: f64) -> [f64; 2] {
    match direction {
        RollingDirection::Right => [x, -y],
        RollingDirection::Up => [-y, -x],
        RollingDirection::Left => [-x, y],
        RollingDirection::Down => [y, x],
    }
}

/// Whether `s` runs along the picture's rows.
pub(crate) fn along_rows(direction: RollingDirection) -> bool {
    matches!(direction, RollingDirection::Right | RollingDirection::Left)
}

/// Turns a grid whose first row is the picture's top: columns of the result run along `s`, rows along `z`.
pub(crate) fn turn_grid(direction: RollingDirection, width: usize, height: usize, picture: &[f64]) -> Vec<f64> {
    let at = |x: usize, y: usize| picture[y * width + x];
    let mut grid = Vec::with_capacity(picture.len());
    let (columns, rows) = if along_rows(direction) { (width, height) } else { (height, width) };
    for row in 0..rows {
        for column in 0..columns {
            grid.push(match direction {
                RollingDirection::Right => at(column, height - 1 - row),
                RollingDirection::Up => at(width - 1 - row, height - 1 - column),
                RollingDirection::Left => at(width - 1 - column, row),
                RollingDirection::Down => at(row, column),
            });
        }
    }
    grid
}
