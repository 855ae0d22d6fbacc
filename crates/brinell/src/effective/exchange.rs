//! Tables as text: CSV with the columns `s_mm,delta_um,delta_eff_um` on a full grid (section 19); read by [`crate::scenario::TableData`].

use super::spline;
use super::table::{MOST_NODES, Table};
use std::fmt::Write;

/// What the splines through a file's values may miss of the slope in delta, and of delta_eff over delta.
const MISSED: [f64; 2] = [1e-3, 2e-4];
/// Halvings of the steps of delta at the most.
const HALVINGS: usize = 6;

impl Table {
    /// CSV, as a defect's `table` reads it, with the force over the healthy one at the same delta:
    /// Q/Q_h = E_H'(delta_eff) (d delta_eff/d delta) / E_H'(delta), where `force` is E_H' (N of m).
    ///
    /// A file has no slopes: between the nodes of delta it has further ones where the splines through values alone would miss them.
    pub fn to_csv_text(&self, force: impl Fn(f64) -> f64) -> String {
        let mut text = String::from("s_mm,delta_um,delta_eff_um,q_over_q_healthy\n");
        let deltas = self.denser();
        for (row, s) in self.s_nodes().iter().enumerate() {
            for delta in &deltas {
                let (effective, slope) = self.in_row(row, *delta);
                let healthy = force(delta.max(0.0));
                let share = if healthy > 0.0 { force(effective.max(0.0)) * slope / healthy } else { 0.0 };
                // Shortest digits that give the number back; writing to a string cannot fail.
                let _ = writeln!(text, "{},{},{},{share:.6}", rounded(1e3 * s), rounded(1e6 * delta), 1e6 * effective);
            }
        }
        text
    }

    /// Its nodes of delta, and as many between them as splines through values take, as far as a file may have so many.
    fn denser(&self) -> Vec<f64> {
        let mut deltas = self.delta_nodes().to_vec();
        for _ in 0..HALVINGS {
            let missed = self.missed(&deltas);
            let wanted = missed.iter().filter(|missed| **missed).count();
            if wanted == 0 || (deltas.len() + wanted) * self.s_nodes().len() > MOST_NODES {
                break;
            }
            let mut finer = Vec::with_capacity(deltas.len() + wanted);
            for (k, delta) in deltas.iter().enumerate() {
                finer.push(*delta);
                if k < missed.len() && missed[k] {
                    // A place that the file's digits give back.
                    finer.push(1e-6 * rounded(0.5e6 * (delta + deltas[k + 1])));
                }
            }
            deltas = finer;
        }
        deltas
    }

    /// Between which of these delta natural cubic splines through the values there miss too much.
    fn missed(&self, deltas: &[f64]) -> Vec<bool> {
        let mut missed = vec![false; deltas.len() - 1];
        for row in 0..self.s_nodes().len() {
            let values: Vec<f64> = deltas.iter().map(|delta| self.in_row(row, *delta).0).collect();
            let seconds = spline::curvatures(deltas, &values);
            for (k, missed) in missed.iter_mut().enumerate() {
                for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let at = deltas[k] + part * (deltas[k + 1] - deltas[k]);
                    let weights = spline::Weights::at(deltas, k, at);
                    let (value, slope) = self.in_row(row, at);
                    // No force, no error.
                    if value <= 0.0 {
                        continue;
                    }
                    let [splined, by_delta] = weights.sums(&values, &seconds);
                    *missed |= (by_delta - slope).abs() > MISSED[0] || (splined - value).abs() > MISSED[1] * at.abs();
                }
            }
        }
        missed
    }

    /// delta_eff and its slope in delta at a node of s.
    fn in_row(&self, row: usize, delta: f64) -> (f64, f64) {
        if let Ok(column) = self.delta_nodes().binary_search_by(|node| node.total_cmp(&delta)) {
            return self.node(row, column);
        }
        let at = self.straight(delta, self.s_nodes()[row]);
        (at.delta, at.by_delta)
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
        Table::from_grid(&s, &delta, &metres(data.values.list(), 1e-6)).unwrap()
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
