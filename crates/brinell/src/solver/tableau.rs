//! Embedded explicit Runge-Kutta pairs whose last stage is the first of the next step.

/// Coefficients of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tableau {
    /// Order of the solution that is propagated.
    pub order: u32,
    /// Nodes c of stages 2, 3, ...
    pub nodes: &'static [f64],
    /// Rows of a for stages 2, 3, ...; the last row holds the weights b.
    pub rows: &'static [&'static [f64]],
    /// Weights of the error estimate, one a stage.
    pub error: &'static [f64],
}

impl Tableau {
    /// Number of stages, the shared one included.
    pub fn stages(&self) -> usize {
        self.error.len()
    }

    /// Weights b of the propagated solution.
    pub fn weights(&self) -> &'static [f64] {
        self.rows[self.rows.len() - 1]
    }
}

/// Bogacki and Shampine's 3(2) pair: P. Bogacki, L. F. Shampine, Appl. Math. Lett. 2 (1989) 321-325.
pub const BOGACKI_SHAMPINE: Tableau = Tableau {
    order: 3,
    nodes: &[0.5, 0.75, 1.0],
    rows: &[&[0.5], &[0.0, 0.75], &[2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0]],
    error: &[-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_tableau_is_consistent() {
        let tableau = BOGACKI_SHAMPINE;
        assert_eq!(tableau.rows.len() + 1, tableau.stages());
        for (row, node) in tableau.rows.iter().zip(tableau.nodes) {
            assert!((row.iter().sum::<f64>() - node).abs() < 1e-14);
        }
        assert!(tableau.error.iter().sum::<f64>().abs() < 1e-14);
    }
}
