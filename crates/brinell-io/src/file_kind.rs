//! The formats that are read, and the extensions that promise them.

use std::fmt;
use std::path::Path;

/// A format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FileKind {
    /// Numbers as text: CSV, tab-separated, LabVIEW's LVM.
    Text,
    /// Apache Parquet.
    Parquet,
    /// MATLAB v5, v6 and v7.
    Mat5,
    /// HDF5, among it MATLAB v7.3.
    Hdf5,
    /// One NumPy array.
    Npy,
    /// NumPy's archive of arrays.
    Npz,
    /// WAV: RIFF, RF64.
    Wav,
    /// Universal File Format, dataset 58, as text or binary (58b).
    Uff58,
    /// LabVIEW TDMS.
    Tdms,
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Text => "text",
            Self::Parquet => "Parquet",
            Self::Mat5 => "MATLAB v5/v7",
            Self::Hdf5 => "HDF5 (MATLAB v7.3)",
            Self::Npy => "NumPy npy",
            Self::Npz => "NumPy npz",
            Self::Wav => "WAV",
            Self::Uff58 => "UFF",
            Self::Tdms => "TDMS",
        })
    }
}

/// What file extensions promise: the kinds, and how to call them. `txt`, `dat` and others promise nothing.
const PROMISED: [(&[&str], &[FileKind], &str); 9] = {
    use FileKind as K;
    [
        (&["csv", "tsv", "lvm"], &[K::Text], "text"),
        (&["parquet", "pq"], &[K::Parquet], "Parquet"),
        (&["mat"], &[K::Mat5, K::Hdf5], "MATLAB"),
        (&["hdf5", "h5", "hdf"], &[K::Hdf5], "HDF5"),
        (&["npy"], &[K::Npy], "NumPy npy"),
        (&["npz"], &[K::Npz], "NumPy npz"),
        (&["wav", "wave"], &[K::Wav], "WAV"),
        (&["uff", "unv", "uf", "uf58", "bunv"], &[K::Uff58], "UFF"),
        (&["tdms"], &[K::Tdms], "TDMS"),
    ]
};

impl FileKind {
    /// Extensions that promise a file of signals, in small letters and without the dot.
    pub fn extensions() -> impl Iterator<Item = &'static str> {
        Self::extensions_by_format().flatten().copied()
    }

    /// What can be read, for help and messages: "csv and other text, parquet, ... and tdms".
    pub fn known() -> String {
        let names = PROMISED.map(|(extensions, kinds, _)| match kinds {
            [Self::Text] => "csv and other text",
            _ => extensions[0],
        });
        let [first @ .., last] = &names;
        format!("{} and {last}", first.join(", "))
    }

    /// The same extensions, those of a format together.
    #[doc(hidden)]
    pub fn extensions_by_format() -> impl Iterator<Item = &'static [&'static str]> {
        PROMISED.iter().map(|(extensions, ..)| *extensions)
    }
}

pub(crate) fn promised(path: &Path) -> Option<(&'static [FileKind], &'static str)> {
    let extension = path.extension()?;
    let of = PROMISED.iter().find(|(known, ..)| known.iter().any(|known| extension.eq_ignore_ascii_case(known)))?;
    Some((of.1, of.2))
}
