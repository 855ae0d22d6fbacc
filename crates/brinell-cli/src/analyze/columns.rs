//! The rows of several files on the terminal.

/// Columns after the name, with their widths on the terminal.
pub(super) const COLUMNS: [(&str, usize); 7] =
    [("s", 8), ("damage", 28), ("RMS", 16), ("peak", 16), ("kurtosis", 9), ("mm/s", 9), ("zone", 5)];

/// A row on as many lines as its longest cell needs.
pub(super) fn in_columns(name: &str, width: usize, cells: &[String; 7], columns: &[(&str, usize); 7]) -> Vec<String> {
    let name = wrapped(name, width);
    let cells: Vec<(Vec<String>, usize)> =
        cells.iter().zip(columns).map(|(cell, (_, width))| (wrapped(cell, *width), *width)).collect();
    let lines = cells.iter().map(|(lines, _)| lines.len()).chain([name.len()]).max().unwrap_or(0);
    let at = |lines: &[String], i: usize| lines.get(i).cloned().unwrap_or_default();
    let line = |i: usize| {
        let cells: Vec<String> = cells.iter().map(|(lines, width)| format!("{:>width$}", at(lines, i))).collect();
        format!("{:<width$} {}", at(&name, i), cells.join(" ")).trim_end().to_owned()
    };
    (0..lines).map(line).collect()
}

/// The words of a cell on lines of at most `width` characters; a longer word is cut.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut length = 0;
    for word in text.split(' ') {
        let word: Vec<char> = word.chars().collect();
        for (k, piece) in word.chunks(width).enumerate() {
            let space = usize::from(k == 0 && length > 0);
            if length + space + piece.len() > width {
                lines.push(String::new());
                length = 0;
            } else if space == 1 {
                lines.last_mut().into_iter().for_each(|line| line.push(' '));
                length += 1;
            }
            lines.last_mut().into_iter().for_each(|line| line.extend(piece));
            length += piece.len();
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A long cell goes on below itself: every cell ends where its column does, and no word is lost.
    #[test]
    fn prop_a_long_cell_stays_in_its_column() {
        let cells = ["1.000", "outer race, very clear, and inner race, clear", "1.2 m/s^2", "8 m/s^2", "3", "-", "-"];
        let name = "a_name_that_is_longer_than_the_column_it_is_in.csv";
        let lines = in_columns(name, 20, &cells.map(String::from), &COLUMNS);
        assert_eq!(lines.len(), 3, "{lines:#?}");
        assert_eq!(lines[0].chars().count(), 20 + COLUMNS.iter().map(|c| c.1 + 1).sum::<usize>());
        assert_eq!(lines[0].split_whitespace().last(), Some("-"));
        let column = |line: &String| line.chars().skip(20 + 10).take(28).collect::<String>().trim().to_owned();
        let words: Vec<String> = lines.iter().map(column).filter(|words| !words.is_empty()).collect();
        assert_eq!(words.join(" "), cells[1]);
        let whole: String =
            lines.iter().map(|line| line.chars().take(20).collect::<String>().trim().to_owned()).collect();
        assert_eq!(whole, name);
    }
}
