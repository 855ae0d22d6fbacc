//! Connected parts of what is on a grid.

/// Calls `each` with the nodes of every connected part (four neighbours) of those that are `left`, in the order of the
/// parts' first nodes.
#[doc(hidden)]
pub fn parts(columns: usize, mut left: Vec<bool>, mut each: impl FnMut(&[usize])) {
    let rows = left.len().checked_div(columns).unwrap_or(0);
    let mut part = Vec::new();
    for start in 0..left.len() {
        if !std::mem::take(&mut left[start]) {
            continue;
        }
        part.clear();
        part.push(start);
        let mut next = 0;
        while next < part.len() {
            part.extend(neighbours(part[next], columns, rows).filter(|k| std::mem::take(&mut left[*k])));
            next += 1;
        }
        each(&part);
    }
}

/// The up to four nodes next to a node.
#[doc(hidden)]
pub fn neighbours(i: usize, columns: usize, rows: usize) -> impl Iterator<Item = usize> {
    let (column, row) = (i % columns, i / columns);
    [
        (column > 0).then(|| i - 1),
        (column + 1 < columns).then(|| i + 1),
        (row > 0).then(|| i - columns),
        (row + 1 < rows).then(|| i + columns),
    ]
    .into_iter()
    .flatten()
}
