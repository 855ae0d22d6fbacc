//! Which format a file is: from its content, checked against its name.

use std::io::Read;
use std::path::Path;

use crate::IoError;
use crate::file_kind::{FileKind, promised};

/// Enough to see any signature: HDF5's may be behind a user block of 512, 1024, ... bytes.
const HEAD: u64 = 8 << 10;
/// A zip file that is no archive of arrays.
pub(super) const OFFICE: &str = "an Excel workbook or other Office document; save the sheet as CSV";
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

/// The kind of a file; an error where content and name disagree.
pub(crate) fn sniff(path: &Path, contents: impl Read) -> Result<FileKind, IoError> {
    let mut head = Vec::new();
    contents.take(HEAD).read_to_end(&mut head).map_err(|e| IoError::reading(path, e))?;
    if head.is_empty() {
        return Err(IoError::EmptyFile { path: path.to_owned() });
    }
    let found = from_content(&head);
    let mislabelled = |name_says, content_is| IoError::Mislabelled { path: path.to_owned(), name_says, content_is };
    match (found, promised(path)) {
        (Ok(kind), Some((kinds, name))) if !kinds.contains(&kind) => Err(mislabelled(name, kind.to_string())),
        (Ok(kind), _) => Ok(kind),
        // Text of a kind that is not read is what its name says.
        (Err(what), Some((_, name))) if !what.starts_with(name) => Err(mislabelled(name, what.to_owned())),
        (Err(what), _) => Err(IoError::UnknownContent { path: path.to_owned(), what }),
    }
}

/// The kind that the first bytes show, or what they look like instead.
fn from_content(head: &[u8]) -> Result<FileKind, &'static str> {
    let at = |from: usize, sign: &[u8]| head.get(from..).is_some_and(|h| h.starts_with(sign));
    if at(0, b"PAR1") {
        return Ok(FileKind::Parquet);
    }
    if at(0, b"\x93NUMPY") {
        return Ok(FileKind::Npy);
    }
    if at(0, b"PK\x03\x04") || at(0, b"PK\x05\x06") {
        let office = memchr::memmem::find(head, b"[Content_Types].xml").is_some();
        return if office { Err(OFFICE) } else { Ok(FileKind::Npz) };
    }
    if (at(0, b"RIFF") || at(0, b"RF64") || at(0, b"BW64")) && at(8, b"WAVE") {
        return Ok(FileKind::Wav);
    }
    if [0, 512, 1024, 2048, 4096].into_iter().any(|n| at(n, HDF5)) {
        return Ok(FileKind::Hdf5);
    }
    if at(126, b"IM") && at(125, &[1]) || at(126, b"MI") && at(124, &[1]) {
        return Ok(FileKind::Mat5);
    }
    if at(0, b"TDSm") {
        return Ok(FileKind::Tdms);
    }
    if at(0, b"\xff\xfe") || at(0, b"\xfe\xff") {
        return Ok(FileKind::Text);
    }
    for (sign, what) in [
        (&b"\x1f\x8b"[..], "a gzip archive"),
        (b"\xd0\xcf\x11\xe0", "an old Office document, as an Excel workbook (.xls) is; save it as CSV"),
        (b"TDSh", "the index of a LabVIEW TDMS file; the signals are in the file whose name ends in .tdms"),
        (b"\x28\xb5\x2f\xfd", "a Zstandard archive"),
        (b"RIFX", "a big-endian RIFF file"),
    ] {
        if at(0, sign) {
            return Err(what);
        }
    }
    let text = String::from_utf8_lossy(head);
    let begin = text.trim_start_matches('\u{feff}').trim_start();
    let within_array = begin.strip_prefix('[').map(|rest| rest.trim_start().chars().next());
    if begin.starts_with('{') || within_array.is_some_and(|c| c.is_some_and(|c| "[{\"-0123456789".contains(c))) {
        return Err("JSON, which is not read; save the numbers as CSV, a column each");
    }
    if begin.starts_with("<?xml") || begin.starts_with("<!DOCTYPE") || begin.starts_with("<html") {
        return Err("XML or HTML, which is not read; save the numbers as CSV");
    }
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let delimiter = lines.next().is_some_and(|line| line.trim_end() == "    -1");
    let number = |line: &str| line.get(..6).is_some_and(|n| n.trim().parse::<u16>().is_ok());
    if delimiter && lines.next().is_some_and(number) {
        return Ok(FileKind::Uff58);
    }
    if head.contains(&0) {
        // Four bytes that say little-endian numbers of a known width, then sizes: MATLAB's format before 1996.
        let old = head.len() >= 20 && head[..4].iter().skip(1).all(|&b| b < 0x10) && head[1] == 0;
        return Err(if old { "no known format (perhaps MATLAB v4; save it again as v7)" } else { "no known format" });
    }
    Ok(FileKind::Text)
}
