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

/// Dormand and Prince's 5(4) pair: J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19-26.
pub const DORMAND_PRINCE: Tableau = Tableau {
    order: 5,
    nodes: &[0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0],
    rows: &[
        &[0.2],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
        &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
        &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ],
    error: &[
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_tableaux_are_consistent() {
        for tableau in [BOGACKI_SHAMPINE, DORMAND_PRINCE] {
            assert_eq!(tableau.rows.len() + 1, tableau.stages());
            for (row, node) in tableau.rows.iter().zip(tableau.nodes) {
                assert!((row.iter().sum::<f64>() - node).abs() < 1e-14);
            }
            assert!(tableau.error.iter().sum::<f64>().abs() < 1e-14);
        }
    }
}
