//! A grid of numbers in text: one line per row. Commas, semicolons, tabs or blanks between them; decimal commas where
//! semicolons, tabs or blanks separate. Lines that begin with `#` and one line of names at the top are passed over.

use crate::depth_cloud::{gridded, refuse_axes};
use crate::error::{DamageError, excerpt};
use crate::kind::FileKind;
use crate::scan::{MAX_POINTS, Raw};
use crate::scan_header::Stated;

const MAX_BYTES: usize = 512 << 20;

/// `stated_mm`: what is known of the distances of columns and of rows.
pub(crate) fn read(bytes: &[u8], stated_mm: [Option<f64>; 2]) -> Result<Raw, DamageError> {
    if bytes.len() > MAX_BYTES {
        return Err(DamageError::TooLarge {
            what: "the table",
            value: format!("{} bytes", bytes.len()),
            limit: format!("{MAX_BYTES} bytes"),
            way_out: "save it as NPY, or thin the scan out",
        });
    }
    let text = std::str::from_utf8(bytes).map_err(|e| DamageError::Broken {
        kind: FileKind::Csv,
        at: format!("byte {}", e.valid_up_to()),
        why: "not UTF-8".to_owned(),
    })?;
    let text = text.trim_start_matches('\u{feff}');
    let stated = Stated::of(text);
    let lines = || {
        let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim_end_matches('\r')));
        lines.filter(|(_, line)| {
            !line.trim().is_empty() && !line.trim_start().starts_with(['#', '%']) && !Stated::says(line)
        })
    };
    let layout = Layout::of(lines().map(|(_, line)| line));
    let mut raw = Raw::default();
    let mut header = None;
    let mut corner = None;
    for (line, content) in lines() {
        let begin = raw.values.len();
        match layout.row(line, content, &mut raw.values) {
            Ok(()) => {}
            // A line of names: no cell of it is a number.
            Err(_) if raw.height == 0 && header.is_none() && layout.names(content) => {
                raw.values.truncate(begin);
                header = Some((line, content));
                continue;
            }
            // The corner of two axes may hold words.
            Err(error) if raw.height == 0 && corner.is_none() => {
                raw.values.truncate(begin);
                if layout.row_beside_corner(content, &mut raw.values).is_none() {
                    return Err(error);
                }
                corner = Some(error);
            }
            Err(error) => return Err(error),
        }
        let got = raw.values.len() - begin;
        if raw.height == 0 {
            raw.width = got;
        } else if got != raw.width {
            return Err(DamageError::RowLength { line, expected: raw.width, got });
        }
        raw.height += 1;
        if raw.values.len() > MAX_POINTS {
            return Err(Raw::too_large(format!("above {MAX_POINTS}")));
        }
    }
    if header.is_none() {
        refuse_axes(&raw)?;
    }
    if let Some(error) = corner {
        return Err(error);
    }
    let names: Vec<String> = header.map_or(Vec::new(), |(_, content)| {
        layout.cells(content).map(|cell| cell.trim().trim_matches('"').trim().to_owned()).collect()
    });
    let mut raw = gridded(raw, &names, stated_mm)?;
    stated.put_in(&mut raw);
    if let (Some((line, _)), None) = (header, raw.spacing_mm) {
        raw.notes.push(format!("line {line} was taken as names and passed over"));
    }
    Ok(raw)
}

struct Layout {
    /// `None`: blanks.
    separator: Option<char>,
    decimal_comma: bool,
    /// Lines end in a separator.
    trailing: bool,
}

impl Layout {
    /// From the first lines that are not comments.
    fn of<'a>(lines: impl Iterator<Item = &'a str>) -> Self {
        let head: Vec<&str> = lines.take(16).collect();
        let has = |c: char| head.iter().any(|line| line.contains(c));
        let separator = if has(';') {
            Some(';')
        } else if has('\t') {
            Some('\t')
        } else if has(',') && !head.iter().all(|line| blanks_with_commas(line)) {
            Some(',')
        } else {
            None
        };
        let trailing = separator
            .is_some_and(|c| !head.is_empty() && head.iter().all(|line| line.trim_end_matches(' ').ends_with(c)));
        Self { separator, decimal_comma: separator != Some(',') && has(',') && !has('.'), trailing }
    }

    fn cells<'a>(&self, line: &'a str) -> Box<dyn Iterator<Item = &'a str> + 'a> {
        let Some(separator) = self.separator else {
            return Box::new(line.split_whitespace());
        };
        let mut line = line.trim_matches(' ');
        if self.trailing {
            line = line.strip_suffix(separator).unwrap_or(line);
        }
        Box::new(line.split(separator))
    }

    fn row(&self, line: usize, content: &str, values: &mut Vec<f64>) -> Result<(), DamageError> {
        for (i, cell) in self.cells(content).enumerate() {
            let value = self.value(cell).ok_or_else(|| DamageError::NotANumber {
                line,
                column: i + 1,
                text: excerpt(cell.trim()),
            })?;
            values.push(value);
        }
        Ok(())
    }

    /// A row whose first cell is a word.
    fn row_beside_corner(&self, content: &str, values: &mut Vec<f64>) -> Option<()> {
        values.push(f64::NAN);
        for cell in self.cells(content).skip(1) {
            values.push(self.value(cell)?);
        }
        Some(())
    }

    /// NaN for a missing point; `None` for what is no number.
    fn value(&self, cell: &str) -> Option<f64> {
        let cell = cell.trim().trim_matches('"').trim();
        let missing = |word: &str| cell.eq_ignore_ascii_case(word);
        if cell.is_empty() || ["nan", "na", "n/a", "null", "bad", "-", "--", "---", "***"].iter().any(|w| missing(w)) {
            return Some(f64::NAN);
        }
        if self.decimal_comma && cell.contains(',') {
            return cell.replacen(',', ".", 1).parse().ok();
        }
        cell.parse().ok()
    }

    fn names(&self, line: &str) -> bool {
        self.cells(line).all(|cell| self.value(cell).is_none_or(f64::is_nan))
    }
}

/// `1,5 2,5`: blanks separate, commas are decimal. `1, 2` is not that.
fn blanks_with_commas(line: &str) -> bool {
    let words = line.split_whitespace();
    let mut several = 0;
    for word in words {
        several += 1;
        let commas = word.bytes().filter(|&b| b == b',').count();
        if commas > 1 || word.starts_with(',') || word.ends_with(',') {
            return false;
        }
    }
    several > 1
}
