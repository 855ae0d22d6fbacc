//! One row or column of a matrix, named as MATLAB does: `X(:,2)`, `X(3,:)`. Indices count from 1.

use std::ops::ControlFlow;

use super::channel::Channel;

/// What of a channel is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pick {
    All,
    /// Every value of this column, from 0.
    Column(u64),
    /// Every value of this row, from 0.
    Row(u64),
}

/// Splits `X(:,2)` into `X` and its column. A name without such an end is all of it.
pub(crate) fn split(name: &str) -> (&str, Pick) {
    let parse = || {
        let open = name.rfind('(')?;
        let (row, column) = name[open + 1..].strip_suffix(')')?.split_once(',')?;
        let index = |text: &str| text.trim().parse::<u64>().ok()?.checked_sub(1);
        let pick = match (row.trim(), column.trim()) {
            (":", column) => Pick::Column(index(column)?),
            (row, ":") => Pick::Row(index(row)?),
            _ => return None,
        };
        Some((&name[..open], pick))
    };
    parse().unwrap_or((name, Pick::All))
}

/// Where a row or column is in the file's order: first, step, count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stride {
    first: u64,
    step: u64,
    pub(crate) count: u64,
}

const ALL: Stride = Stride { first: 0, step: 1, count: u64::MAX };

/// The stride of a pick; `Err` says what is wrong.
pub(crate) fn stride(channel: &Channel, pick: Pick) -> Result<Stride, String> {
    let name = &channel.name;
    if pick == Pick::All {
        if !channel.is_vector() {
            let sizes: Vec<String> = channel.shape.iter().map(u64::to_string).collect();
            let way_out = if channel.plane().len() == 2 {
                format!("choose a column such as `{name}(:,1)`, or a row such as `{name}(1,:)`")
            } else {
                "it has more than two dimensions, and only vectors and matrices can be read".into()
            };
            return Err(format!("`{name}` is {}; {way_out}", sizes.join(" x ")));
        }
        return Ok(ALL);
    }
    let plane = channel.plane();
    let &[rows, columns] = &plane[..] else {
        return Err(format!("`{name}` is no matrix; leave out the index"));
    };
    let (at, of, count, what) = match pick {
        Pick::Row(at) => (at, rows, columns, "row"),
        Pick::Column(at) => (at, columns, rows, "column"),
        Pick::All => return Ok(ALL),
    };
    if at >= of {
        return Err(format!("`{name}` has no {what} {}; it has {of}", at + 1));
    }
    // A column is contiguous where the first index runs fastest, a row where the last does.
    let contiguous = matches!(pick, Pick::Column(_)) == channel.column_major;
    Ok(if contiguous {
        Stride { first: at.saturating_mul(count), step: 1, count }
    } else {
        Stride { first: at, step: of, count }
    })
}

/// Passes on what a stride picks from the values that stream by.
pub(crate) fn through<'a>(
    stride: Stride,
    mut sink: impl FnMut(&[f64]) -> ControlFlow<()> + 'a,
) -> impl FnMut(&[f64]) -> ControlFlow<()> + 'a {
    let (mut passed, mut left, mut next) = (0u64, stride.count, stride.first);
    let mut picked = Vec::new();
    move |values: &[f64]| {
        let end = passed + values.len() as u64;
        let flow = if stride == ALL {
            sink(values)
        } else {
            picked.clear();
            while next < end && left > 0 {
                picked.push(values[(next - passed) as usize]);
                next = next.saturating_add(stride.step);
                left -= 1;
            }
            if picked.is_empty() { ControlFlow::Continue(()) } else { sink(&picked) }
        };
        passed = end;
        if left == 0 { ControlFlow::Break(()) } else { flow }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::numbers::Number;

    fn picked(column_major: bool, name: &str) -> Vec<f64> {
        let mut channel = Channel::array("X", vec![2, 3], Number::F64);
        channel.column_major = column_major;
        let stride = stride(&channel, split(name).1).unwrap();
        let mut out = Vec::new();
        let mut pass = through(stride, |v: &[f64]| {
            out.extend_from_slice(v);
            ControlFlow::Continue(())
        });
        for piece in [&[0.0, 1.0][..], &[2.0], &[3.0, 4.0, 5.0]] {
            if pass(piece).is_break() {
                break;
            }
        }
        drop(pass);
        out
    }

    #[test]
    fn analytic_rows_and_columns_of_a_matrix() {
        assert_eq!(picked(true, "X(:,2)"), [2.0, 3.0]);
        assert_eq!(picked(true, "X(2,:)"), [1.0, 3.0, 5.0]);
        assert_eq!(picked(false, "X(:,2)"), [1.0, 4.0]);
        assert_eq!(picked(false, "X( 2 , : )"), [3.0, 4.0, 5.0]);
    }

    #[test]
    fn regress_names_with_brackets_that_are_no_index() {
        for name in ["acc (g)", "X(:,0)", "X(1,2)", "X(:)", "X"] {
            assert_eq!(split(name), (name, Pick::All));
        }
        let channel = Channel::array("X", vec![2, 3], Number::F64);
        let say = |name| stride(&channel, split(name).1).unwrap_err();
        assert_eq!(say("X(:,4)"), "`X` has no column 4; it has 3");
        assert_eq!(say("X"), "`X` is 2 x 3; choose a column such as `X(:,1)`, or a row such as `X(1,:)`");
    }
}
