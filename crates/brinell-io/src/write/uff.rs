//! Universal File Format, dataset 58b, written: one function per channel, doubles, evenly spaced in time.
//!
//! Layout: University of Cincinnati, SDRL, "Universal File Datasets Summary", 58 and 58b. The abscissa's step has seven
//! digits, as many as its place in the file holds.

use super::spool::{Limit, Spool};
use crate::atomic::{Complete, Destination, PartialFile};
use crate::signals::{check_columns, without_time};
use crate::{Column, IoError, Metadata, Outcome, SignalWriter};

/// Values of one function: the field for its bytes has twelve digits, the one for their number ten.
const LIMIT: Limit = Limit { rows: 9_999_999_999, format: "UFF 58", of: "a function" };

/// Writes a table as UFF 58b.
pub(crate) struct UffWriter {
    file: PartialFile,
    columns: Vec<Column>,
    /// Where the columns to be written are.
    kept: Vec<usize>,
    time: Option<usize>,
    start_s: Option<f64>,
    rate_hz: f64,
    spool: Spool,
}

impl UffWriter {
    /// Starts the file. The metadata must hold [`crate::keys::SAMPLE_RATE_HZ`]; a column `t` in seconds gives the first
    /// instant and is not written itself.
    pub(crate) fn at(destination: Destination<'_>, columns: &[Column], metadata: &Metadata) -> Result<Self, IoError> {
        let path = destination.path();
        check_columns(path, columns)?;
        let refused = |why: String| IoError::NotWritable { path: path.to_owned(), format: "UFF 58", why };
        let rate_hz = metadata.needed_sample_rate().map_err(refused)?;
        let kept = without_time(columns);
        if kept.is_empty() {
            return Err(refused("there is no channel but the time".into()));
        }
        Ok(Self {
            file: PartialFile::at(destination)?,
            time: (0..columns.len()).find(|i| !kept.contains(i)),
            start_s: None,
            rate_hz,
            spool: Spool::create(destination, kept.len(), Some(LIMIT))?,
            columns: columns.to_vec(),
            kept,
        })
    }

    /// The two lines that open the dataset, and its eleven records.
    fn records(&self, column: &Column, outcome: &Outcome) -> String {
        let rows = self.spool.rows();
        // Codes of the physical quantity: 8 displacement, 11 velocity, 12 acceleration, 13 force, 17 time, 0 unknown.
        let quantity = match column.unit.as_str() {
            "m" => 8,
            "m/s" => 11,
            "m/s^2" => 12,
            "N" => 13,
            _ => 0,
        };
        let line = |text: &str| format!("{:<80}\n", short(text, 80));
        let axis = |code: u32, name: &str, unit: &str| {
            format!("{code:>10}{:>5}{:>5}{:>5} {:<20} {:<20}\n", 0, 0, 0, short(name, 20), short(unit, 20))
        };
        let mut text = format!(
            "{:>6}\n{:>6}b{:>6}{:>6}{:>12}{:>12}{:>6}{:>6}{:>12}{:>12}\n",
            -1,
            58,
            1,
            2,
            11,
            8 * rows,
            0,
            0,
            0,
            0
        );
        text += &line(&column.name);
        text += &line(&column.description);
        text += &line("NONE");
        text += &line(concat!("brinell ", env!("CARGO_PKG_VERSION")));
        text += &line(&outcome.to_string());
        // A time response at node 1.
        text += &format!(
            "{:>5}{:>10}{:>5}{:>10} {:<10}{:>10}{:>4} {:<10}{:>10}{:>4}\n",
            1, 0, 0, 0, "NONE", 1, 0, "NONE", 1, 0
        );
        text += &format!(
            "{:>10}{rows:>10}{:>10}{}{}{}\n",
            4,
            1,
            real(self.start_s.unwrap_or(0.0)),
            real(1.0 / self.rate_hz),
            real(0.0)
        );
        text += &axis(17, "Time", "s");
        text += &axis(quantity, &column.name, &column.unit);
        text += &axis(0, "NONE", "NONE");
        text += &axis(0, "NONE", "NONE");
        text
    }
}

/// At most so many characters, plain ASCII, `NONE` for nothing.
fn short(text: &str, most: usize) -> String {
    let plain = |c: char| {
        if c.is_ascii() && !c.is_ascii_control() { c } else { '?' }
    };
    let text: String = text.chars().map(plain).take(most).collect();
    if text.trim().is_empty() { "NONE".into() } else { text }
}

/// A number in thirteen columns, as C's `%13.6e` and Fortran's E13.6.
fn real(value: f64) -> String {
    let text = format!("{value:.6e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{:>13}", format!("{digits}e{sign}{:02}", exponent.abs()))
}

impl SignalWriter for UffWriter {
    fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.file.check_row(self.columns.len(), row)?;
        if self.start_s.is_none() {
            self.start_s = self.time.map(|i| row[i]);
        }
        self.spool.push(self.kept.iter().map(|&i| row[i]))
    }

    fn complete(mut self: Box<Self>, outcome: Outcome) -> Result<Complete, IoError> {
        self.file.check()?;
        for (index, &at) in self.kept.clone().iter().enumerate() {
            let records = self.records(&self.columns[at], &outcome);
            self.file.append(records.as_bytes())?;
            let file = &mut self.file;
            self.spool.column(index, |bytes| file.append(bytes))?;
            self.file.append(b"    -1\n")?;
        }
        self.file.complete()
    }
}
