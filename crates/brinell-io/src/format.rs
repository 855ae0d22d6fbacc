//! The formats that a table of signals is written in.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use crate::IoError;
use crate::atomic::Destination;
use crate::signals::{Column, Metadata, Outcome, SignalWriter};
use crate::write::csv::CsvWriter;
use crate::write::mat::MatWriter;
use crate::write::uff::UffWriter;
use crate::write::wav::WavWriter;

/// Takes a table row by row and makes of it, in memory, the bytes that its file would have: for where there is no file
/// system.
///
/// Memory is that of the file; MAT, NPZ and UFF take it twice, for they store one channel after the other.
pub struct MemoryWriter(Box<dyn SignalWriter>);

impl MemoryWriter {
    /// Appends one row: a value per column, in the order of the columns.
    ///
    /// # Errors
    /// Where the row has another length, or the format holds no more rows.
    pub fn write_row(&mut self, row: &[f64]) -> Result<(), IoError> {
        self.0.write_row(row)
    }

    /// The whole file.
    ///
    /// # Errors
    /// Where the format cannot hold the table.
    pub fn finish(self, outcome: Outcome) -> Result<Vec<u8>, IoError> {
        Ok(self.0.complete(outcome)?.into_bytes())
    }
}

impl fmt::Debug for MemoryWriter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MemoryWriter").finish_non_exhaustive()
    }
}

/// A file format for signals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// A header line of channel names, then numbers.
    Csv,
    /// Apache Parquet with units, scenario and version in its metadata.
    Parquet,
    /// MATLAB v5: a variable per channel, `fs`, and texts with units, scenario and version.
    Mat,
    /// NumPy's archive: an array per channel, `fs`, and texts with units, scenario and version.
    Npz,
    /// Universal File Format, dataset 58b: a function per channel, double precision, even spacing.
    Uff58,
    /// WAV of 32-bit floats in the channels' units, which a comment states.
    Wav,
}

impl Format {
    /// Every format there is, also those that this build left out; in this order they are looked for in a run's folder.
    pub const ALL: [Self; 6] = [Self::Parquet, Self::Npz, Self::Mat, Self::Csv, Self::Uff58, Self::Wav];

    /// The name that selects it: `csv`, `parquet`, `mat`, `npz`, `uff58` or `wav`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
            Self::Mat => "mat",
            Self::Npz => "npz",
            Self::Uff58 => "uff58",
            Self::Wav => "wav",
        }
    }

    /// The file's name within the folder of a run.
    pub fn file_name(self) -> &'static str {
        match self {
            Self::Csv => "signals.csv",
            Self::Parquet => "signals.parquet",
            Self::Mat => "signals.mat",
            Self::Npz => "signals.npz",
            Self::Uff58 => "signals.uff",
            Self::Wav => "signals.wav",
        }
    }

    /// A writer of this format's file in an existing folder. CSV has no place for metadata and leaves it out.
    ///
    /// MAT, NPZ and UFF keep the rows in a nameless temporary file of that folder until the end, for they store one
    /// channel after the other. UFF and WAV need [`Metadata::with_rate`] and leave out a column `t` in seconds,
    /// which it replaces.
    pub fn create(
        self,
        folder: &Path,
        columns: &[Column],
        metadata: &Metadata,
    ) -> Result<Box<dyn SignalWriter>, IoError> {
        let path = folder.join(self.file_name());
        self.writer(Destination::Disk(&path), columns, metadata)
    }

    /// A writer of this format's bytes in memory, the same as [`Format::create`] makes a file of. Errors call it
    /// [`Format::file_name`].
    ///
    /// ```
    /// use brinell_io::{Column, Format, Metadata, Outcome};
    ///
    /// let columns = [Column::new("outer_ax", "m/s^2", "")];
    /// let mut writer = Format::Csv.in_memory(&columns, &Metadata::default())?;
    /// writer.write_row(&[1.5])?;
    /// assert_eq!(writer.finish(Outcome::Complete)?, b"outer_ax\n1.5\n");
    /// # Ok::<(), brinell_io::IoError>(())
    /// ```
    ///
    /// # Errors
    /// Where the format cannot hold such columns, needs metadata that are not there, or is not in this build.
    pub fn in_memory(self, columns: &[Column], metadata: &Metadata) -> Result<MemoryWriter, IoError> {
        let destination = Destination::Memory(Path::new(self.file_name()));
        Ok(MemoryWriter(self.writer(destination, columns, metadata)?))
    }

    fn writer(
        self,
        destination: Destination<'_>,
        columns: &[Column],
        metadata: &Metadata,
    ) -> Result<Box<dyn SignalWriter>, IoError> {
        Ok(match self {
            Self::Csv => Box::new(CsvWriter::at(destination, columns)?),
            #[cfg(feature = "parquet")]
            Self::Parquet => Box::new(crate::ParquetWriter::at(destination, columns, metadata)?),
            Self::Mat => Box::new(MatWriter::at(destination, columns, metadata)?),
            #[cfg(feature = "npz")]
            Self::Npz => Box::new(crate::write::npz::NpzWriter::at(destination, columns, metadata)?),
            Self::Uff58 => Box::new(UffWriter::at(destination, columns, metadata)?),
            Self::Wav => Box::new(WavWriter::at(destination, columns, metadata)?),
            // Features are called like the formats that they bring.
            #[cfg(not(all(feature = "parquet", feature = "npz")))]
            _ => return Err(IoError::FormatLeftOut { path: destination.path().to_owned(), format: self.name() }),
        })
    }
}

impl FromStr for Format {
    type Err = IoError;

    fn from_str(name: &str) -> Result<Self, IoError> {
        Self::ALL.into_iter().find(|f| f.name() == name).ok_or_else(|| IoError::UnknownFormat(name.to_owned()))
    }
}
