//! HDF5's symbol tables without their soft links, which the `hdf5-pure` crate takes for objects at no address. What they
//! lead to is listed where it lies. Layout: "HDF5 File Format Specification", III.C.

use std::io::{self, Read, Seek, SeekFrom};

use super::contents::Contents;

/// Bytes before the entries of a node, and of an entry where addresses have eight.
const HEAD: usize = 8;
const ENTRY: usize = 40;

/// A file as if no symbol table had soft links.
pub(super) struct WithoutSoftLinks(pub(super) Contents);

impl Seek for WithoutSoftLinks {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

impl Read for WithoutSoftLinks {
    /// The crate reads a node from its beginning, as no one else reads these letters.
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let at = self.0.stream_position()?;
        let got = self.0.read(buffer)?;
        let head = &buffer[..got];
        if head.starts_with(b"SNOD\x01") && got >= HEAD {
            let entries = usize::from(u16::from_le_bytes([head[6], head[7]]));
            let mut node = Vec::new();
            self.0.seek(SeekFrom::Start(at))?;
            (&mut self.0).take((HEAD + entries * ENTRY) as u64).read_to_end(&mut node)?;
            self.0.seek(SeekFrom::Start(at + got as u64))?;
            without(&mut node);
            let known = got.min(node.len());
            buffer[..known].copy_from_slice(&node[..known]);
        }
        Ok(got)
    }
}

/// Takes the entries of soft links out of a node, which stays as long as it was.
fn without(node: &mut [u8]) {
    let Some((head, entries)) = node.split_at_mut_checked(HEAD) else {
        return;
    };
    let (count, mut kept) = (entries.len() / ENTRY, 0);
    for i in 0..count {
        let entry = &entries[i * ENTRY..(i + 1) * ENTRY];
        let is_soft = entry[8..16] == [0xff; 8] && entry[16..20] == [2, 0, 0, 0];
        if !is_soft {
            entries.copy_within(i * ENTRY..(i + 1) * ENTRY, kept * ENTRY);
            kept += 1;
        }
    }
    if kept < count {
        head[6..8].copy_from_slice(&(kept as u16).to_le_bytes());
    }
}
