//! What the readers read from: a file of the disk or bytes in memory, behind one type.
//!
//! Several readers may share one source, each with a place of its own: the libraries of HDF5 and Parquet keep one, the
//! values are read through another.

use std::fs::File;
use std::io::{self, Cursor, Read, Seek, SeekFrom};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Whatever holds a file's bytes.
pub(crate) trait ReadSeek: Read + Seek + Send {}

impl<T: Read + Seek + Send> ReadSeek for T {}

/// A place in a source; a clone has one of its own.
#[derive(Clone)]
pub(crate) struct Contents {
    shared: Arc<Mutex<Shared>>,
    at: u64,
    length: u64,
}

struct Shared {
    source: Box<dyn ReadSeek>,
    /// Where `source` is.
    at: u64,
}

impl Contents {
    /// Of a source of so many bytes that is at its begin.
    fn new(source: Box<dyn ReadSeek>, length: u64) -> Self {
        Self { shared: Arc::new(Mutex::new(Shared { source, at: 0 })), at: 0, length }
    }

    /// Of a file that is at its begin.
    pub(super) fn of_file(file: File) -> io::Result<Self> {
        let length = file.metadata()?.len();
        Ok(Self::new(Box::new(file), length))
    }

    /// Of bytes, which are not copied.
    pub(super) fn of_bytes(bytes: impl AsRef<[u8]> + Send + 'static) -> Self {
        let length = bytes.as_ref().len() as u64;
        Self::new(Box::new(Cursor::new(bytes)), length)
    }

    /// The bytes that there are.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    fn shared(&self) -> MutexGuard<'_, Shared> {
        // A source that panicked is no worse than one that failed: each read says where.
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Read for Contents {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let got = {
            let mut shared = self.shared();
            if shared.at != self.at {
                shared.at = shared.source.seek(SeekFrom::Start(self.at))?;
            }
            let got = shared.source.read(buffer)?;
            shared.at += got as u64;
            got
        };
        self.at += got as u64;
        Ok(got)
    }
}

impl Seek for Contents {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let at = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
            SeekFrom::End(by) => self.length.checked_add_signed(by),
        };
        // As files do; bytes would take any place.
        let at = at.filter(|at| i64::try_from(*at).is_ok());
        self.at = at.ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_clones_read_each_from_its_own_place() {
        let bytes: Vec<u8> = (0..=255).collect();
        let mut one = Contents::of_bytes(bytes.clone());
        let mut other = one.clone();
        other.seek(SeekFrom::End(-56)).unwrap();
        let (mut head, mut tail) = (Vec::new(), Vec::new());
        // In turns, in pieces of different lengths.
        for _ in 0..20 {
            let (mut few, mut more) = ([0; 3], [0; 10]);
            let got = other.read(&mut few).unwrap();
            tail.extend_from_slice(&few[..got]);
            one.read_exact(&mut more).unwrap();
            head.extend_from_slice(&more);
        }
        assert_eq!((&head[..], &tail[..]), (&bytes[..200], &bytes[200..]));
        assert_eq!(one.stream_position().unwrap(), 200);
        assert!(one.seek(SeekFrom::Current(-201)).is_err());
        assert!(one.seek(SeekFrom::Start(1 << 63)).is_err());
        one.seek(SeekFrom::Start(1000)).unwrap();
        assert_eq!(one.read(&mut [0; 4]).unwrap(), 0);
    }
}
