//! Tables as text: CSV with the columns `s_mm,delta_um,delta_eff_um` on a full grid (section 19); read by [`crate::scenario::TableData`].

use super::table::Table;
use std::fmt::Write;

impl Table {
    /// CSV of the nodes, as a defect's `table` reads it, with the force over the healthy one at the same delta:
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::TableData;

    fn read(text: &str) -> Table {
        let data = TableData::from_csv_text(text).unwrap();
        let metres = |values: &[f64], unit: f64| values.iter().map(|x| x * unit).collect::<Vec<_>>();
        let (s, delta) = (metres(&data.s_mm, 1e-3), metres(&data.delta_um, 1e-6));
        Table::from_grid(&s, &delta, &metres(&data.delta_eff_um, 1e-6)).unwrap()
    }

    #[test]
    fn prop_a_table_is_the_same_after_writing() {
        let full = || (0..5).flat_map(|s| (0..4).map(move |delta| (s, delta)));
        // Healthy at both ends.
        let effective = |s: usize, delta: f64| if s.is_multiple_of(4) { delta } else { delta * 0.9 - (s - 1) as f64 };
        let lines = full().map(|(s, delta)| format!("{},{delta},{}\n", s as f64 * 0.1, effective(s, delta as f64)));
        let table = read(&("s_mm,delta_um,delta_eff_um\n".to_owned() + &lines.collect::<String>()));
        let written = table.to_csv_text(|delta| delta * delta.sqrt());
        let again = read(&written);
        for (s, delta) in full() {
            assert!((table.node(s, delta).0 - again.node(s, delta).0).abs() < 1e-18);
        }
        // (0.9)^1.5 * 0.9, at the second s.
        assert!(written.lines().nth(8).unwrap().ends_with("0.768433"), "{written}");
    }

    #[test]
    fn xval_reference_tables_load_and_give_their_nodes_back() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/reference");
        for name in ["mechanics-ball-outer.table.csv", "mechanics-rectangle.table.csv"] {
            // Not in every copy of the repository.
            let Ok(text) = std::fs::read_to_string(folder.join(name)) else { continue };
            let table = read(&text);
            assert_eq!(table.first_delta(), 0.0);
            for (row, s) in table.s_nodes().iter().enumerate().take(60) {
                for (column, delta) in table.delta_nodes().iter().enumerate().skip(1) {
                    assert!((table.at(*delta, *s).delta - table.node(row, column).0).abs() < 1e-18);
                }
            }
        }
    }
}
