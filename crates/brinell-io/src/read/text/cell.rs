//! Where a value of a column stands, for a message about it: the column is read once more, line by line.

use std::io::{BufRead, BufReader, Read};

use super::layout::Layout;
use super::lines::{MAX_LINE, field_of, row, shown};

/// The line, counted from 1, of a column's value of that number, counted from 0, and what is written there. `reader`
/// is at the first line of numbers. A field that is no number counts as a value.
pub(super) fn find(reader: &mut impl Read, layout: &Layout, field: usize, value: u64) -> Option<(u64, String)> {
    let mut reader = BufReader::new(reader);
    let (mut bytes, mut values, mut before) = (Vec::new(), Vec::new(), 0);
    for line in layout.first_line.. {
        bytes.clear();
        if (&mut reader).take(MAX_LINE as u64).read_until(b'\n', &mut bytes).ok()? == 0 {
            return None;
        }
        let text = bytes.strip_suffix(b"\n").unwrap_or(&bytes);
        values.clear();
        if row(text, layout, field, line, &mut values).is_err() || !values.is_empty() {
            if before == value {
                return Some((line, field_of(text, layout, field).0.map_or(String::new(), shown)));
            }
            before += 1;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::layout::find as layout_of;
    use super::*;

    /// Blank lines and comments count as lines and not as values; what is no number counts as a value.
    #[test]
    fn prop_a_value_is_found_on_its_line() {
        let mut text = String::from("t,a\n");
        let mut expected = Vec::new();
        for i in 0..40 {
            if i % 7 == 3 {
                text += "\n# a remark\n";
            }
            let cell = match i {
                20 => "oops".to_owned(),
                21 => String::new(),
                22 => "NaN".into(),
                _ => format!("{i}.5"),
            };
            text += &format!("{i},{cell}\r\n");
            expected.push((text.matches('\n').count() as u64, cell));
        }
        let layout = layout_of(&text.as_bytes()[..100]).unwrap();
        for (value, at) in expected.iter().enumerate() {
            let mut reader = &text.as_bytes()[layout.start as usize..];
            assert_eq!(find(&mut reader, &layout, 1, value as u64).as_ref(), Some(at));
        }
        let mut reader = &text.as_bytes()[layout.start as usize..];
        assert_eq!(find(&mut reader, &layout, 1, expected.len() as u64), None);
    }
}
