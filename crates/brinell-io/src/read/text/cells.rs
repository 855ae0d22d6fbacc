//! Cells that hold their unit, as `0.139 g` does.

use super::format::Delimiter;
use super::number::number;

/// Lines that have to be alike.
const ALIKE: usize = 3;
const LONGEST: usize = 12;

/// Where every cell of the lines of numbers is a number with a unit behind it, or a number: what is behind it in each
/// column. In `sample` it becomes blanks, so that all that is known of a table serves.
pub(super) fn blank_units(sample: &mut [u8]) -> Option<Vec<String>> {
    let lines = || sample.split(|b| *b == b'\n').filter(|line| !line.trim_ascii().is_empty());
    let found = [Delimiter::Tab, Delimiter::Semicolon, Delimiter::Comma].into_iter().find_map(|delimiter| {
        let units = |line: &[u8]| -> Option<Vec<String>> {
            let cells = delimiter.fields(line).map(|cell| Some(split(cell)?.1.to_owned()));
            cells.collect::<Option<Vec<String>>>().filter(|units| units.iter().any(|unit| !unit.is_empty()))
        };
        let all: Vec<Option<Vec<String>>> = lines().map(units).collect();
        let first = all.windows(ALIKE).position(|w| w[0].is_some() && w.iter().all(|units| *units == w[0]))?;
        Some((delimiter, first, all.into_iter().nth(first).flatten()?))
    });
    let (delimiter, first, units) = found?;
    let lines = sample.split_mut(|b| *b == b'\n').filter(|line| !line.trim_ascii().is_empty());
    for line in lines.skip(first) {
        let mut ends = Vec::new();
        for (cell, unit) in delimiter.fields(line).zip(&units) {
            if let Some(number) = without(cell, unit) {
                let at = cell.as_ptr() as usize - line.as_ptr() as usize;
                ends.push(at + number.len()..at + cell.trim_ascii_end().len());
            }
        }
        ends.into_iter().for_each(|end| line[end].fill(b' '));
    }
    Some(units)
}

/// A cell without the unit behind its number; `None` where another is there.
pub(super) fn without<'a>(cell: &'a [u8], unit: &str) -> Option<&'a [u8]> {
    cell.trim_ascii_end().strip_suffix(unit.as_bytes())
}

/// A number and the unit behind it, which may be none.
fn split(cell: &[u8]) -> Option<(f64, &str)> {
    let cell = cell.trim_ascii();
    let numeric = |b: &u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b',');
    let exponent = |i: usize| {
        matches!(cell[i], b'e' | b'E')
            && cell.get(i + 1).is_some_and(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-'))
    };
    let end = (0..cell.len()).find(|&i| !numeric(&cell[i]) && !exponent(i)).unwrap_or(cell.len());
    let value = number(&cell[..end], None).filter(|v| v.is_finite())?;
    let unit = std::str::from_utf8(&cell[end..]).ok()?.trim();
    let is_unit = |unit: &str| {
        let begins = unit.starts_with(|c: char| c.is_alphabetic() || matches!(c, '°' | '%'));
        begins && unit.len() <= LONGEST && !unit.contains(char::is_whitespace)
    };
    (unit.is_empty() || is_unit(unit)).then_some((value, unit))
}
