//! The recorded channels of a run, in memory.

use super::{Observer, Simulation};
use crate::error::Error;
use std::ops::ControlFlow;

/// An observer that keeps every row: time and the recorded channels as columns, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Signals {
    rate_hz: f64,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl Signals {
    /// Empty, with room for a complete run.
    ///
    /// # Errors
    /// [`Error::TooLarge`] where there is not enough memory.
    pub fn new(simulation: &Simulation) -> Result<Self, Error> {
        let channels = simulation.channels().iter().map(|c| c.name.clone());
        let names: Vec<String> = std::iter::once("t".to_owned()).chain(channels).collect();
        let samples = simulation.samples();
        let too_large = || Error::TooLarge { bytes: 8 * u128::from(samples) * names.len() as u128 };
        let rows = usize::try_from(samples).map_err(|_| too_large())?;
        let all = rows.checked_mul(names.len()).ok_or_else(too_large)?;
        // All of it at once first: a system that promises memory which it may not have refuses only what is obviously
        // too much, and a column is not.
        Vec::<f64>::new().try_reserve_exact(all).map_err(|_| too_large())?;
        let mut columns = vec![Vec::new(); names.len()];
        for column in &mut columns {
            column.try_reserve_exact(rows).map_err(|_| too_large())?;
        }
        Ok(Self { rate_hz: simulation.sample_rate(), names, columns })
    }

    /// Samples a second.
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Names of the columns: `t`, then the channels in the order of rows.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// A column by its name; `None` where it is not recorded.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        let place = self.names.iter().position(|n| n == name)?;
        Some(&self.columns[place])
    }
}

impl IntoIterator for Signals {
    type Item = (String, Vec<f64>);
    type IntoIter = std::iter::Zip<std::vec::IntoIter<String>, std::vec::IntoIter<Vec<f64>>>;

    /// The columns with their names.
    fn into_iter(self) -> Self::IntoIter {
        self.names.into_iter().zip(self.columns)
    }
}

impl Observer for Signals {
    fn again(&mut self, _: &Simulation) -> ControlFlow<()> {
        self.columns.iter_mut().for_each(Vec::clear);
        ControlFlow::Continue(())
    }

    fn row(&mut self, index: u64, row: &[f64], _: &[f64]) -> ControlFlow<()> {
        self.columns[0].push(index as f64 / self.rate_hz);
        for (column, value) in self.columns[1..].iter_mut().zip(row) {
            column.push(*value);
        }
        ControlFlow::Continue(())
    }
}
