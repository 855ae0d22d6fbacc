//! Measured signals from the files that instruments and other programs write.
//!
//! [`open`] looks at the content, lists what is there and reads nothing else yet. A channel is then read whole
//! ([`SignalFile::read`]) or piece by piece ([`SignalFile::read_pieces`]), which holds a few megabytes whatever the
//! file's size. [`open_bytes`] does the same to a file that is in memory already, and needs no file system.
//!
//! Sample rates and units are what the file states, with the place where it does; there are no guesses.

#[cfg(feature = "hdf5")]
mod attributes;
mod channel;
mod contents;
mod fault;
#[cfg(feature = "hdf5")]
mod hdf5;
mod increments;
mod kind;
mod listing;
mod mat5;
mod named;
mod npy;
#[cfg(feature = "npz")]
mod npz;
mod numbers;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
mod pick;
#[cfg(feature = "parquet")]
pub(crate) mod records;
#[cfg(feature = "hdf5")]
mod soft_links;
mod stated;
mod tdms;
mod text;
mod timed;
mod times;
mod uff;
mod wav;

use std::fs::File;
use std::io::Seek;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

pub use channel::{Channel, Rate, RateSource};
pub use named::NotNamed;
pub use npy::{npy_entry, npy_number, npy_sides, npy_tuple, npy_word};
pub use numbers::Number;
pub use timed::NoTimes;
pub use times::{NoRate, seconds_in};

use crate::{FileKind, IoError, Metadata};
use contents::Contents;
use fault::Fault;
use listing::Source;

/// The most values that [`SignalFile::read`] collects: 2 GiB of them, and 512 MiB where all memory is 4 GiB, as on
/// WebAssembly.
pub const MAX_VALUES: u64 = if cfg!(target_pointer_width = "32") { 1 << 26 } else { 1 << 28 };

/// A file of signals, opened and listed.
pub struct SignalFile {
    path: PathBuf,
    kind: FileKind,
    channels: Vec<Channel>,
    metadata: Metadata,
    source: Box<dyn Source>,
}

impl std::fmt::Debug for SignalFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SignalFile")
            .field("path", &self.path)
            .field("kind", &self.kind)
            .field("channels", &self.channels)
            .finish_non_exhaustive()
    }
}

/// Opens a file of signals and lists its channels.
///
/// The format is what the content shows; where the name promises another, that is an error which names both. Refused
/// are also files that are empty, cut off, damaged, or claim more than they can hold.
pub fn open(path: impl AsRef<Path>) -> Result<SignalFile, IoError> {
    let path = path.as_ref();
    let reading = |e| IoError::reading(path, e);
    let mut file = File::open(path).map_err(reading)?;
    if file.metadata().map_err(reading)?.is_dir() {
        return Err(IoError::NotAFileName { path: path.to_owned() });
    }
    let kind = kind::sniff(path, &mut file)?;
    file.rewind().map_err(reading)?;
    let contents = Contents::of_file(file).map_err(reading)?;
    listed(path, kind, contents)
}

/// [`open`] for a file in memory, as a browser hands it over. `name` is what errors call it; its ending is held against
/// the content as a path's is.
///
/// `bytes` are a `Vec<u8>`, an `Arc<[u8]>`, or anything else that holds them; they are not copied, and kept as long as
/// the [`SignalFile`].
///
/// ```
/// let bytes = b"time [s];acc [g]\n0,0;1,5\n0,1;-2,25\n".to_vec();
/// let mut file = brinell_io::open_bytes("run.csv", bytes)?;
/// assert_eq!(file.read("acc [g]")?, [1.5, -2.25]);
/// # Ok::<(), brinell_io::IoError>(())
/// ```
///
/// # Errors
/// As [`open`], without those of the file system.
pub fn open_bytes(name: &str, bytes: impl AsRef<[u8]> + Send + 'static) -> Result<SignalFile, IoError> {
    let path = Path::new(name);
    let kind = kind::sniff(path, bytes.as_ref())?;
    listed(path, kind, Contents::of_bytes(bytes))
}

/// The file with its channels.
fn listed(path: &Path, kind: FileKind, contents: Contents) -> Result<SignalFile, IoError> {
    let list = || match kind {
        FileKind::Text => text::list(text::in_utf8(contents)?),
        #[cfg(feature = "parquet")]
        FileKind::Parquet => parquet::list(contents),
        FileKind::Mat5 => mat5::list(contents),
        #[cfg(feature = "hdf5")]
        FileKind::Hdf5 => hdf5::list(contents),
        FileKind::Npy => npy::list(contents),
        #[cfg(feature = "npz")]
        FileKind::Npz => npz::list(contents),
        FileKind::Wav => wav::list(contents),
        FileKind::Uff58 => uff::list(contents),
        FileKind::Tdms => tdms::list(contents),
        #[cfg(not(all(feature = "parquet", feature = "hdf5", feature = "npz")))]
        _ => Err(fault::unsupported("this build leaves the format out; build brinell-io with its default features")),
    };
    let mut listing = guarded(list).map_err(|fault| located(path, kind, fault))?;
    channel::tell_apart(&mut listing.channels);
    Ok(SignalFile {
        path: path.to_owned(),
        kind,
        channels: listing.channels,
        metadata: listing.metadata,
        source: listing.source,
    })
}

impl SignalFile {
    /// The path, or the name of the bytes, as given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The format, from the content.
    pub fn kind(&self) -> FileKind {
        self.kind
    }

    /// Every array in the file, in its order; also single numbers and what cannot be read.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Short texts in the file, by name: MATLAB's strings under their paths, WAV's comment, Parquet's pairs.
    pub fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    /// The one channel that may be a signal. An error names them where there are several, as beside a column of times.
    pub fn only_signal(&self) -> Result<&Channel, IoError> {
        let mut signals = self.channels.iter().filter(|c| c.may_be_signal());
        match (signals.next(), signals.next()) {
            (Some(signal), None) => Ok(signal),
            (None, _) => Err(IoError::NoSignal { path: self.path.clone(), found: names(plain(self.channels.iter())) }),
            (Some(_), Some(_)) => Err(IoError::SeveralSignals {
                path: self.path.clone(),
                names: names(plain(self.channels.iter().filter(|c| c.may_be_signal()))),
            }),
        }
    }

    /// All values of a channel, or of a matrix's column or row such as `X(:,2)`: at most [`MAX_VALUES`].
    ///
    /// Values are as stored, in the unit that [`Channel::unit`] states. Whole numbers of a WAV are counts of the ADC and
    /// not scaled to 1: what a count is worth is not in the file.
    ///
    /// Memory is taken as values arrive, so that a file cannot claim it. Missing values are NaN. 64-bit integers beyond
    /// 2^53 round.
    pub fn read(&mut self, name: &str) -> Result<Vec<f64>, IoError> {
        let mut values = Vec::new();
        let mut too_long = false;
        self.read_pieces(name, |piece| {
            too_long = (values.len() + piece.len()) as u64 > MAX_VALUES;
            if too_long {
                return ControlFlow::Break(());
            }
            values.extend_from_slice(piece);
            ControlFlow::Continue(())
        })?;
        if too_long {
            return Err(IoError::TooLong { path: self.path.clone(), name: name.to_owned(), limit: MAX_VALUES });
        }
        Ok(values)
    }

    /// Where a value of a channel, counted from 0, stands in a text file: its line, counted from 1, and what is written
    /// there. `None` in other files.
    pub fn cell(&mut self, name: &str, value: u64) -> Option<(u64, String)> {
        let index = self.channels.iter().position(|c| c.name == name)?;
        self.source.cell(index, value)
    }

    /// [`read_pieces`](Self::read_pieces), where a line of a text file that [holds no number](IoError::is_of_a_line)
    /// counts as a missing value, NaN, as a further segment does, which ends it.
    pub fn read_around(&mut self, name: &str, sink: impl FnMut(&[f64]) -> ControlFlow<()>) -> Result<(), IoError> {
        self.source.set_lenient(true);
        let read = self.read_pieces(name, sink);
        self.source.set_lenient(false);
        read
    }

    /// Hands the values of a channel to `sink` in order, piece by piece, until the end or until it breaks off.
    pub fn read_pieces(&mut self, name: &str, sink: impl FnMut(&[f64]) -> ControlFlow<()>) -> Result<(), IoError> {
        let find = |name: &str| {
            let named = self.channels.iter().position(|c| c.name == name);
            let called = |c: &Channel| c.label.as_deref() == Some(name);
            let mut labelled = (0..self.channels.len()).filter(|&i| called(&self.channels[i]));
            let only = labelled.next().filter(|_| labelled.next().is_none());
            named.or(only)
        };
        let (index, pick) = match find(name) {
            Some(index) => (index, pick::Pick::All),
            None => {
                let (base, pick) = pick::split(name);
                let index = find(base).ok_or_else(|| IoError::NoChannel {
                    path: self.path.clone(),
                    name: name.to_owned(),
                    names: names(plain(self.channels.iter())),
                })?;
                (index, pick)
            }
        };
        let channel = &self.channels[index];
        let cannot = |why: String| IoError::Unsupported { path: self.path.clone(), why };
        if let Some(why) = &channel.unreadable {
            return Err(cannot(format!("`{}` {why}", channel.name)));
        }
        let stride = pick::stride(channel, pick).map_err(cannot)?;
        let mut through = pick::through(stride, sink);
        let source = &mut self.source;
        match guarded(|| source.stream(index, &mut through)) {
            Ok(()) | Err(Fault::Stopped) => Ok(()),
            Err(fault) => Err(located(&self.path, self.kind, fault)),
        }
    }
}

fn plain<'a>(channels: impl Iterator<Item = &'a Channel>) -> impl Iterator<Item = String> {
    channels.map(|c| c.name.clone())
}

/// Up to twenty names, for a message.
#[doc(hidden)]
pub fn names(names: impl Iterator<Item = String>) -> String {
    let mut all: Vec<String> = names.collect();
    let more = all.len().saturating_sub(20);
    all.truncate(20);
    let mut text = all.join(", ");
    if more > 0 {
        text += &format!(" and {more} more");
    }
    if text.is_empty() {
        text = "nothing".into();
    }
    text
}

/// Other people's readers assert some of what a damaged file can break; such a panic ends here. On WebAssembly no panic
/// can be caught: there it ends the module, and the page starts another.
fn guarded<T>(work: impl FnOnce() -> Result<T, Fault>) -> Result<T, Fault> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Err(fault::damaged("a reader gave up on it")))
}

fn located(path: &Path, kind: FileKind, fault: Fault) -> IoError {
    let path = path.to_owned();
    match fault {
        Fault::Io(source) => IoError::Read { path, source },
        Fault::Damaged(why) => IoError::Damaged { path, kind, why },
        Fault::Unsupported(why) => IoError::Unsupported { path, why },
        Fault::Number { line, column, text } => IoError::CsvNumber { path, line, column, text },
        Fault::Point { line, column, text } => IoError::DecimalPoint { path, line, column, text },
        Fault::Between { line, blank } => {
            let what = if blank { "blank" } else { "a comment" };
            let why = format!("line {line} is {what}, among numbers; take it out if no number is missing there");
            IoError::Damaged { path, kind, why }
        }
        Fault::Segment { line } => IoError::Segment { path, line },
        Fault::Row { line, expected, got } => IoError::TextRow { path, line, expected, got },
        // Only `read_pieces` has a receiver, and takes this out before.
        Fault::Stopped => IoError::Damaged { path, kind, why: "reading stopped".into() },
    }
}
