//! Tables as text: CSV with the columns `s_mm,delta_um,delta_eff_um` on a full grid (section 19).

use super::table::{Table, TableError};
use std::collections::{HashMap, HashSet};
use std::fmt::Write;

/// Columns that a table is read from.
const COLUMNS: [&str; 3] = ["s_mm", "delta_um", "delta_eff_um"];

impl Table {
    /// From CSV: a line of names, then one line for every pair of s and delta, in any order. Other columns are not read; lines that are
    /// empty or begin with # do not count.
    ///
    /// # Errors
    /// As [`Table::from_grid`]; where a column, a number or a pair is missing, or one is there twice.
    pub fn from_csv_text(text: &str) -> Result<Self, TableError> {
        let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
        let mut lines =
            lines.map(|(k, line)| (k + 1, line.trim())).filter(|(_, l)| !l.is_empty() && !l.starts_with('#'));
        let (_, header) = lines.next().ok_or(TableError::NoColumn(COLUMNS[0]))?;
        let names: Vec<&str> = header.split(',').map(|name| name.trim().trim_matches('"')).collect();
        let mut places = [0; 3];
        for (place, column) in places.iter_mut().zip(COLUMNS) {
            *place = names.iter().position(|name| *name == column).ok_or(TableError::NoColumn(column))?;
        }
        let mut rows: Vec<(usize, [f64; 3])> = Vec::new();
        for (line, content) in lines {
            let cells: Vec<&str> = content.split(',').collect();
            let mut row = [0.0; 3];
            for ((value, place), column) in row.iter_mut().zip(places).zip(COLUMNS) {
                let number = cells.get(place).and_then(|cell| cell.trim().parse::<f64>().ok());
                // -0 is 0: both stand for one node.
                *value = number.filter(|x| x.is_finite()).ok_or(TableError::NoNumber { line, column })? + 0.0;
            }
            rows.push((line, row));
        }
        from_rows(&rows)
    }

    /// CSV of the nodes, as [`Table::from_csv_text`] reads it, with the force over the healthy one at the same delta:
    /// Q/Q_h = E_H'(delta_eff) (d delta_eff/d delta) / E_H'(delta), where `force` is E_H' (N of m).
    pub fn to_csv_text(&self, force: impl Fn(f64) -> f64) -> String {
        let mut text = String::from("s_mm,delta_um,delta_eff_um,q_over_q_healthy\n");
        for (row, s) in self.s_nodes().iter().enumerate() {
            for (column, delta) in self.delta_nodes().iter().enumerate() {
                let (effective, slope) = self.node(row, column);
                let healthy = force(delta.max(0.0));
                let share = if healthy > 0.0 { force(effective.max(0.0)) * slope / healthy } else { 0.0 };
                // Shortest digits that give the number back; writing to a string cannot fail.
                let _ = writeln!(text, "{},{},{},{share:.6}", rounded(1e3 * s), rounded(1e6 * delta), 1e6 * effective);
            }
        }
        text
    }
}

/// Without the digits that a change of unit adds: a place to 1e-12 of a unit.
fn rounded(x: f64) -> f64 {
    (x * 1e12).round() / 1e12
}

fn from_rows(rows: &[(usize, [f64; 3])]) -> Result<Table, TableError> {
    let [s_mm, delta_um] = [0, 1].map(|axis| {
        let mut all: Vec<f64> = rows.iter().map(|(_, row)| row[axis]).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    });
    let place =
        |nodes: &[f64]| -> HashMap<u64, usize> { nodes.iter().enumerate().map(|(k, x)| (x.to_bits(), k)).collect() };
    let (s_place, delta_place) = (place(&s_mm), place(&delta_um));
    // Before anything as large as the grid is made: scattered points would make the square of their number.
    let there: HashSet<[u64; 2]> = rows.iter().map(|(_, [s, delta, _])| [s.to_bits(), delta.to_bits()]).collect();
    let mut pairs = s_mm.iter().flat_map(|s| delta_um.iter().map(move |delta| (*s, *delta)));
    if let Some((s_mm, delta_um)) = pairs.find(|(s, delta)| !there.contains(&[s.to_bits(), delta.to_bits()])) {
        return Err(TableError::Missing { s_mm, delta_um });
    }
    let mut values: Vec<Option<f64>> = vec![None; s_mm.len() * delta_um.len()];
    for &(line, [s, delta, effective]) in rows {
        let at = s_place[&s.to_bits()] * delta_um.len() + delta_place[&delta.to_bits()];
        if values[at].replace(effective).is_some() {
            return Err(TableError::Twice { line, s_mm: s, delta_um: delta });
        }
    }
    let metres = |values: &[f64], unit: f64| values.iter().map(|x| x * unit).collect::<Vec<_>>();
    let values: Vec<f64> = values.into_iter().flatten().map(|x| 1e-6 * x).collect();
    Table::from_grid(&metres(&s_mm, 1e-3), &metres(&delta_um, 1e-6), &values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(rows: impl Iterator<Item = (usize, usize)>) -> String {
        let lines = rows.map(|(s, delta)| format!("{},{},{}\n", s as f64 * 0.1, delta, delta as f64 * 0.9 - s as f64));
        "s_mm,delta_um,delta_eff_um\n".to_owned() + &lines.collect::<String>()
    }

    fn full() -> impl DoubleEndedIterator<Item = (usize, usize)> {
        (0..5).flat_map(|s| (0..4).map(move |delta| (s, delta)))
    }

    #[test]
    fn prop_a_table_is_the_same_from_lines_in_any_order_and_after_writing() {
        let table = Table::from_csv_text(&text(full())).unwrap();
        assert_eq!(table, Table::from_csv_text(&text(full().rev())).unwrap());
        let written = table.to_csv_text(|delta| delta * delta.sqrt());
        let again = Table::from_csv_text(&written).unwrap();
        for (s, delta) in full() {
            assert!((table.node(s, delta).0 - again.node(s, delta).0).abs() < 1e-18);
        }
        // (0.9)^1.5 * 0.9, where s = 0.
        assert!(written.lines().nth(4).unwrap().ends_with("0.768433"), "{written}");
    }

    #[test]
    fn prop_errors_name_the_line_the_column_and_the_place() {
        let error = |text: &str| Table::from_csv_text(text).unwrap_err();
        assert_eq!(error(""), TableError::NoColumn("s_mm"));
        assert_eq!(error("s_mm,delta_um\n0,1\n"), TableError::NoColumn("delta_eff_um"));
        let broken = text(full()).replace("0.1,2,", "0.1,two,");
        assert_eq!(error(&broken), TableError::NoNumber { line: 8, column: "delta_um" });
        let holed = text(full().filter(|place| *place != (3, 2)));
        let missing = TableError::Missing { s_mm: 3.0 * 0.1, delta_um: 2.0 };
        assert!(matches!(error(&holed), TableError::Missing { delta_um: 2.0, .. }), "{missing:?}");
        let twice = text(full().chain([(0, 3)]));
        assert_eq!(error(&twice), TableError::Twice { line: 22, s_mm: 0.0, delta_um: 3.0 });
        assert_eq!(error(&text(full().filter(|p| p.1 < 3))), TableError::TooFew { axis: "delta", nodes: 3 });
        let scattered = text((0..3000).map(|k| (k, k)));
        assert_eq!(error(&scattered), TableError::Missing { s_mm: 0.0, delta_um: 1.0 });
    }

    #[test]
    fn xval_reference_tables_load_and_give_their_nodes_back() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/reference");
        for name in ["mechanics-ball-outer.table.csv", "mechanics-rectangle.table.csv"] {
            // Not in every copy of the repository.
            let Ok(text) = std::fs::read_to_string(folder.join(name)) else { continue };
            let table = Table::from_csv_text(&text).unwrap();
            assert_eq!(table.first_delta(), 0.0);
            for (row, s) in table.s_nodes().iter().enumerate().take(60) {
                for (column, delta) in table.delta_nodes().iter().enumerate().skip(1) {
                    assert!((table.at(*delta, *s).delta - table.node(row, column).0).abs() < 1e-18);
                }
            }
        }
    }
}
