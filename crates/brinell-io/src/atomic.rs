//! A file that appears whole or not at all.
//!
//! The order is: make and lock `NAME.partial`, write, force to the disk, rename to `NAME`, force the folder to
//! the disk. After a crash at any point `NAME` is either absent, the old file, or the whole new one.
//!
//! The same writers make the bytes of a file in memory, where nothing of this is needed.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Cursor, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::IoError;

/// Where a file is to be made; the path of one in memory is what errors call it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Destination<'a> {
    Disk(&'a Path),
    Memory(&'a Path),
}

impl<'a> Destination<'a> {
    pub(crate) fn path(self) -> &'a Path {
        match self {
            Self::Disk(path) | Self::Memory(path) => path,
        }
    }
}

/// A file under construction. Dropped before [`PartialFile::commit`], it is removed.
#[derive(Debug)]
pub(crate) struct PartialFile {
    place: Place,
    path: PathBuf,
    failed: bool,
}

#[derive(Debug)]
enum Place {
    Disk { file: File, partial: PathBuf, committed: bool },
    Memory(Cursor<Vec<u8>>),
}

impl PartialFile {
    /// Makes `path`.partial, in place of what a killed run may have left.
    pub(crate) fn create(path: &Path) -> Result<Self, IoError> {
        let Some(name) = path.file_name().filter(|_| !path.is_dir()) else {
            return Err(IoError::NotAFileName { path: path.to_owned() });
        };
        let mut name = name.to_owned();
        name.push(".partial");
        let partial = path.with_file_name(name);
        let file = open_alone(&partial, path)?;
        Ok(Self { place: Place::Disk { file, partial, committed: false }, path: path.to_owned(), failed: false })
    }

    /// Opens a file on the disk as [`PartialFile::create`] does, or begins one in memory.
    pub(crate) fn at(destination: Destination<'_>) -> Result<Self, IoError> {
        match destination {
            Destination::Disk(path) => Self::create(path),
            Destination::Memory(path) => {
                Ok(Self { place: Place::Memory(Cursor::default()), path: path.to_owned(), failed: false })
            }
        }
    }

    /// The path that the file will have.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Appends bytes. After a failure every further call fails: the file has a hole that nobody could see.
    pub(crate) fn append(&mut self, bytes: &[u8]) -> Result<(), IoError> {
        self.check()?;
        self.place.write_all(bytes).map_err(|e| {
            self.failed = true;
            IoError::writing(&self.path, e)
        })
    }

    /// Writes over bytes that were appended before; the next append continues at the end.
    pub(crate) fn patch(&mut self, at: u64, bytes: &[u8]) -> Result<(), IoError> {
        self.check()?;
        let mut write = || {
            let end = self.place.stream_position()?;
            self.place.seek(SeekFrom::Start(at))?;
            self.place.write_all(bytes)?;
            self.place.seek(SeekFrom::Start(end))
        };
        write().map(drop).map_err(|e| {
            self.failed = true;
            IoError::writing(&self.path, e)
        })
    }

    /// Refuses where an earlier append failed.
    pub(crate) fn check(&self) -> Result<(), IoError> {
        if self.failed { Err(IoError::AlreadyFailed { path: self.path.clone() }) } else { Ok(()) }
    }

    /// The same, and where a row has not so many values.
    pub(crate) fn check_row(&self, columns: usize, row: &[f64]) -> Result<(), IoError> {
        self.check()?;
        if row.len() == columns {
            return Ok(());
        }
        Err(IoError::RowLength { path: self.path.clone(), expected: columns, got: row.len() })
    }

    /// Forces the contents to the disk, where they are on one.
    pub(crate) fn complete(self) -> Result<Complete, IoError> {
        self.check()?;
        if let Place::Disk { file, .. } = &self.place {
            file.sync_all().map_err(|e| IoError::writing(&self.path, e))?;
        }
        Ok(Complete(self))
    }

    /// Forces the contents to the disk and gives the file its name.
    pub(crate) fn commit(self) -> Result<PathBuf, IoError> {
        self.complete()?.publish()
    }
}

/// A file whose contents are on the disk, as `NAME.partial`: a file of its name is still there. Several of these are
/// published together, when nothing is left that can fail for want of space. Dropped before, it is removed.
#[derive(Debug)]
pub struct Complete(PartialFile);

impl Complete {
    /// The path that the file will have.
    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// Gives the file its name, in place of one that has it.
    ///
    /// # Errors
    /// Where the folder does not let it.
    pub fn publish(mut self) -> Result<PathBuf, IoError> {
        let path = self.path().to_owned();
        // A file in memory gets no name; nobody outside has a `Complete` of one.
        if let Place::Disk { partial, committed, .. } = &mut self.0.place {
            std::fs::rename(partial, &path).map_err(|e| IoError::writing(&path, e))?;
            *committed = true;
            sync_folder_of(&path);
        }
        Ok(path)
    }

    /// The bytes of a file in memory; of one on the disk there are none here.
    pub(crate) fn into_bytes(mut self) -> Vec<u8> {
        match &mut self.0.place {
            Place::Memory(bytes) => std::mem::take(bytes).into_inner(),
            Place::Disk { .. } => Vec::new(),
        }
    }
}

impl Write for Place {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Disk { file, .. } => file.write(bytes),
            Self::Memory(memory) => memory.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Disk { file, .. } => file.flush(),
            Self::Memory(_) => Ok(()),
        }
    }
}

impl Seek for Place {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::Disk { file, .. } => file.seek(to),
            Self::Memory(memory) => memory.seek(to),
        }
    }
}

/// For encoders that write to a stream.
impl Write for PartialFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.place.write(bytes).inspect_err(|_| self.failed = true)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.place.flush()
    }
}

impl Seek for PartialFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.place.seek(to)
    }
}

impl Drop for PartialFile {
    fn drop(&mut self) {
        if let Place::Disk { partial, committed: false, .. } = &self.place {
            // Nobody is left to tell of a failure here; the name says that the file is partial.
            let _ = std::fs::remove_file(partial);
        }
    }
}

/// Makes the partial file anew and holds its lock, so that two runs into one folder cannot mix their rows. Never through
/// a link: what it names is another's file. A link to a device is opened as it is: nothing is kept there.
fn open_alone(partial: &Path, path: &Path) -> Result<File, IoError> {
    let failed = |e| IoError::writing(path, e);
    if is_device(partial) {
        return OpenOptions::new().write(true).open(partial).map_err(failed);
    }
    loop {
        match OpenOptions::new().write(true).create_new(true).open(partial) {
            // Between our open and our lock another may have taken it for a killed run's; then start over.
            Ok(file) if !lock(&file, path)? || is_still_at(&file, partial) => return Ok(file),
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::AlreadyExists => clear(partial, path)?,
            Err(error) => return Err(failed(error)),
        }
    }
}

/// Removes what a killed run left, or a link.
///
/// # Errors
/// [`IoError::Busy`] where a run that goes on has it.
fn clear(partial: &Path, path: &Path) -> Result<(), IoError> {
    let gone = |result: io::Result<()>| match result {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(IoError::writing(path, error)),
        _ => Ok(()),
    };
    if !partial.is_symlink() {
        let left = match OpenOptions::new().write(true).open(partial) {
            Ok(left) => left,
            Err(error) => return gone(Err(error)),
        };
        // Renamed or removed meanwhile: what is there now is another's.
        if lock(&left, path)? && !is_still_at(&left, partial) {
            return Ok(());
        }
    }
    gone(std::fs::remove_file(partial))
}

fn is_device(path: &Path) -> bool {
    path.metadata().is_ok_and(|there| !there.is_file() && !there.is_dir())
}

/// Keeps other processes away from an open file, for as long as it is open; `path` is what they would be told is busy.
/// False where the file system has no locks, as some networks' have not: that is no reason not to work, and the user
/// keeps runs apart.
///
/// # Errors
/// [`IoError::Busy`] where another process has it.
pub fn lock(file: &File, path: &Path) -> Result<bool, IoError> {
    match file.try_lock() {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Err(IoError::Busy { path: path.to_owned() }),
        Err(TryLockError::Error(_)) => Ok(false),
    }
}

#[cfg(unix)]
fn is_still_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |m: io::Result<std::fs::Metadata>| m.ok().map(|m| (m.dev(), m.ino()));
    let here = id(file.metadata());
    here.is_some() && here == id(std::fs::symlink_metadata(path))
}

#[cfg(not(unix))]
fn is_still_at(_: &File, _: &Path) -> bool {
    true
}

/// Makes the rename itself durable. The file is complete either way, so a system without this is no error.
fn sync_folder_of(path: &Path) {
    if cfg!(unix) {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let _ = File::open(folder).and_then(|f| f.sync_all());
    }
}

/// Copies a file; the copy appears whole or not at all.
///
/// # Errors
/// Where the one cannot be read or the other not written.
pub fn atomic_copy(from: impl AsRef<Path>, to: impl AsRef<Path>) -> Result<(), IoError> {
    let (from, to) = (from.as_ref(), to.as_ref());
    let mut source = File::open(from).map_err(|e| IoError::reading(from, e))?;
    let mut file = PartialFile::create(to)?;
    io::copy(&mut source, &mut file).map_err(|e| IoError::writing(to, e))?;
    file.commit().map(drop)
}

/// Writes a small file (JSON, TOML, HTML) that appears whole or not at all, replacing one of the same name. To a device
/// or a pipe the bytes go as they are.
pub fn atomic_write(path: impl AsRef<Path>, bytes: impl AsRef<[u8]>) -> Result<(), IoError> {
    if is_device(path.as_ref()) {
        // A device or a pipe: a file in its place would be the end of it.
        let device = OpenOptions::new().write(true).open(path.as_ref());
        let written = device.and_then(|mut device| device.write_all(bytes.as_ref()));
        return written.map_err(|e| IoError::writing(path.as_ref(), e));
    }
    atomic_prepare(path, bytes)?.publish().map(drop)
}

/// The same up to its name, which [`Complete::publish`] gives.
///
/// # Errors
/// Where the file cannot be written, or another process is about to write it.
pub fn atomic_prepare(path: impl AsRef<Path>, bytes: impl AsRef<[u8]>) -> Result<Complete, IoError> {
    let mut file = PartialFile::create(path.as_ref())?;
    file.append(bytes.as_ref())?;
    file.complete()
}
