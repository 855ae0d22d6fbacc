//! One column of a text file, streamed: while one block of lines is parsed, on as many threads as there are cores, the
//! next one is read. On WebAssembly, which has no threads, one is done after the other.

use std::io::{self, Read};
use std::thread::{self, Scope, ScopedJoinHandle};

use memchr::{memchr, memchr_iter, memchr2, memrchr};

use super::format::{Decimal, Delimiter};
use super::layout::Layout;
use super::lvm::begins_segment;
use super::number::number;
use crate::read::fault::{Fault, damaged};
use crate::read::numbers::{Sink, give};

/// Bytes read at a time.
const BLOCK: usize = 2 << 20;
/// Bytes that are worth a thread.
const SHARE: usize = 256 << 10;
/// A longer line is no line of a table.
pub(super) const MAX_LINE: usize = 16 << 20;
/// Values handed on at a time, whatever the blocks and threads: what is summed piece by piece comes out the same.
const PIECE: usize = 16 << 10;

/// Streams the values of one field of every line from where `reader` is.
pub(super) fn column(
    reader: &mut (impl Read + Send),
    layout: &Layout,
    field: usize,
    sink: Sink<'_>,
) -> Result<(), Fault> {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let cut =
        Cut { block: BLOCK, share: SHARE, threads: cores.min(BLOCK / SHARE), single: cfg!(target_family = "wasm") };
    in_blocks(reader, &Wanted::of(layout, field), sink, &cut)
}

/// How a file is cut up: bytes of a block, the fewest for a thread, and threads at most; whether none is started at
/// all.
struct Cut {
    block: usize,
    share: usize,
    threads: usize,
    single: bool,
}

fn in_blocks(reader: &mut (impl Read + Send), wanted: &Wanted, sink: Sink<'_>, cut: &Cut) -> Result<(), Fault> {
    let (mut buffer, mut next) = (vec![0; cut.block], Vec::new());
    let mut filled = fill(reader, &mut buffer, 0)?;
    let mut line = wanted.layout.first_line;
    let mut shares = vec![Vec::new(); cut.threads];
    let (mut values, mut open) = (Vec::new(), None);
    loop {
        let text = &buffer[..filled];
        // At the end of the file what is left is a line too.
        let end = filled < buffer.len();
        let whole = match memrchr(b'\n', text) {
            _ if end => filled,
            Some(last) => last + 1,
            None if filled >= MAX_LINE => {
                return Err(damaged(format!("line {line} has no end")));
            }
            None => 0,
        };
        let (text, rest) = text.split_at(whole);
        let (found, read) = thread::scope(|scope| {
            let read = (!end).then(|| {
                next.resize(cut.block.max(2 * rest.len()), 0);
                next[..rest.len()].copy_from_slice(rest);
                Job::start(scope, cut, || fill(reader, &mut next, rest.len()))
            });
            let found = wanted.parse(text, (&mut line, &mut open), cut, &mut shares);
            (found, read.map(Job::result))
        });
        for (share, fault) in shares.iter_mut().zip(found) {
            values.append(share);
            let pieces = values.chunks_exact(PIECE);
            let left = pieces.remainder().len();
            for piece in pieces {
                give(sink, piece)?;
            }
            values.drain(..values.len() - left);
            if matches!(fault, Err(Fault::Stopped)) {
                return give(sink, &values);
            }
            fault?;
        }
        match read {
            Some(read) => filled = read?,
            None => return give(sink, &values),
        }
        std::mem::swap(&mut buffer, &mut next);
    }
}

/// Reads until a buffer is full from `filled` on, or the file ends; how far it is filled then.
fn fill(reader: &mut impl Read, buffer: &mut [u8], mut filled: usize) -> Result<usize, Fault> {
    while filled < buffer.len() {
        match reader.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(got) => filled += got,
            Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
            Err(e) => return Err(Fault::Io(e)),
        }
    }
    Ok(filled)
}

/// Work on a thread of its own, or done at once.
enum Job<'scope, T> {
    Thread(ScopedJoinHandle<'scope, T>),
    Done(T),
}

impl<'scope, T: Send + 'scope> Job<'scope, T> {
    fn start(scope: &'scope Scope<'scope, '_>, cut: &Cut, work: impl FnOnce() -> T + Send + 'scope) -> Self {
        match cut.single {
            true => Self::Done(work()),
            false => Self::Thread(scope.spawn(work)),
        }
    }

    /// What it came to; a thread's panic goes on here.
    fn result(self) -> T {
        match self {
            Self::Thread(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Self::Done(result) => result,
        }
    }
}

/// The field that is wanted of every line.
struct Wanted<'a> {
    layout: &'a Layout,
    field: usize,
    plain: Option<Plain>,
    /// Whether a line between the numbers that has none may stand for one.
    single: bool,
}

impl<'a> Wanted<'a> {
    fn of(layout: &'a Layout, field: usize) -> Self {
        // Runs of blanks and decimal commas are `row`'s business.
        let runs = layout.delimiter == Delimiter::Blanks && layout.columns.len() > 1;
        let plain = !runs && layout.decimal != Some(Decimal::Comma) && layout.columns[field].clock.is_none();
        Wanted {
            layout,
            field,
            single: layout.columns.iter().filter(|c| !c.absent).count() == 1,
            plain: plain.then(|| Plain {
                delimiter: layout.delimiter.sign(),
                before: field,
                after: layout.columns.len() - 1 - field,
            }),
        }
    }

    /// The values of the lines in `text`, the first of which is number `line`, shared out among threads, `cut.share`
    /// bytes or more to each: a thread has a list of its own to write to, and a result. `line` is then the number of
    /// the line after. `open` is a line without a number that no number has followed yet.
    fn parse(
        &self,
        text: &[u8],
        (line, open): (&mut u64, &mut Option<Fault>),
        cut: &Cut,
        shares: &mut [Vec<f64>],
    ) -> Vec<Result<(), Fault>> {
        let length = (text.len() / shares.len()).max(cut.share);
        let mut rest = text;
        thread::scope(|scope| {
            let mut jobs = Vec::new();
            for values in shares {
                if rest.is_empty() {
                    break;
                }
                let end = memchr(b'\n', rest.get(length..).unwrap_or_default());
                let (mine, others) = rest.split_at(end.map_or(rest.len(), |end| length + end + 1));
                rest = others;
                jobs.push(Job::start(scope, cut, move || {
                    let part = self.lines(mine, values);
                    (part, values.is_empty())
                }));
            }
            let found = jobs.into_iter().map(Job::result);
            let results = found.map(|(part, is_empty)| {
                let first = *line;
                *line += part.lines;
                if !is_empty && let Some(between) = open.take() {
                    return Err(between);
                }
                *open = open.take().or(part.open.map(|fault| fault.after(first)));
                part.result.map_err(|fault| fault.after(first))
            });
            results.collect()
        })
    }

    /// The values up to the end, or to the fault.
    fn lines(&self, text: &[u8], values: &mut Vec<f64>) -> Part {
        let (mut at, mut lines, mut open) = (0, 0, None);
        let part = |lines, open, result| Part { lines, open, result };
        while at < text.len() {
            let known = values.len();
            match self.plain.as_ref().and_then(|plain| plain.value(text, at)) {
                Some((value, end)) => {
                    values.push(value);
                    at = end;
                }
                None => {
                    let rest = &text[at..];
                    let end = memchr(b'\n', rest).unwrap_or(rest.len());
                    if let Err(fault) = row(&rest[..end], self.layout, self.field, lines, values) {
                        return part(lines, None, Err(fault));
                    }
                    if self.single && values.len() == known {
                        let blank = rest[..end].trim_ascii().is_empty();
                        open.get_or_insert(Fault::Between { line: lines, blank });
                    }
                    at += end + 1;
                }
            }
            lines += 1;
            if values.len() > known && open.is_some() {
                return part(lines, None, open.map_or(Ok(()), Err));
            }
        }
        part(lines, open, Ok(()))
    }
}

/// What became of some lines; a fault's line counts from their first, from 0.
struct Part {
    /// How many there are, up to the fault.
    lines: u64,
    /// The first of those at the end that have no number.
    open: Option<Fault>,
    result: Result<(), Fault>,
}

/// Lines as plain as nearly all are: numbers with a point, one sign between them, and nothing about them.
struct Plain {
    delimiter: u8,
    /// Fields before the wanted one, and after it.
    before: usize,
    after: usize,
}

impl Plain {
    /// The wanted value of the line that begins at `from`, and where the next one does. `None` says
    /// nothing: see [`row`].
    #[inline]
    fn value(&self, text: &[u8], from: usize) -> Option<(f64, usize)> {
        // A letter begins the header of a further segment of a LabVIEW file, or NaN.
        if matches!(text[from], b'#' | b'%' | b'A'..=b'Z') {
            return None;
        }
        let mut at = from;
        for _ in 0..self.before {
            at = self.beyond_delimiter(text, at)?;
        }
        let (value, length) = fast_float2::parse_partial(&text[at..]).ok()?;
        at += length;
        if self.after > 0 {
            if *text.get(at)? != self.delimiter {
                return None;
            }
            at += 1;
            for _ in 1..self.after {
                at = self.beyond_delimiter(text, at)?;
            }
            at += memchr2(self.delimiter, b'\n', &text[at..])?;
        }
        match text.get(at..)? {
            [b'\n', ..] => Some((value, at + 1)),
            [b'\r', b'\n', ..] => Some((value, at + 2)),
            _ => None,
        }
    }

    #[inline]
    fn beyond_delimiter(&self, text: &[u8], from: usize) -> Option<usize> {
        let at = from + memchr2(self.delimiter, b'\n', &text[from..])?;
        (text[at] == self.delimiter).then_some(at + 1)
    }
}

/// The field of a line that is wanted, and how many it has.
pub(super) fn field_of<'a>(bytes: &'a [u8], layout: &Layout, field: usize) -> (Option<&'a [u8]>, usize) {
    let mut wanted = None;
    let mut count = 0;
    let mut take = |piece| {
        if count == field {
            wanted = Some(piece);
        }
        count += 1;
    };
    match layout.delimiter {
        single if single != Delimiter::Blanks && memchr(b'"', bytes).is_none() => {
            let mut start = 0;
            for end in memchr_iter(single.sign(), bytes) {
                take(&bytes[start..end]);
                start = end + 1;
            }
            take(&bytes[start..]);
        }
        any => any.fields(bytes).for_each(take),
    }
    (wanted, count)
}

/// A field as a message shows it.
pub(super) fn shown(field: &[u8]) -> String {
    String::from_utf8_lossy(field).trim().chars().take(40).collect()
}

pub(super) fn row(bytes: &[u8], layout: &Layout, field: usize, line: u64, values: &mut Vec<f64>) -> Result<(), Fault> {
    let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
    if layout.is_lvm && begins_segment(bytes) {
        if !layout.lenient {
            return Err(Fault::Segment { line });
        }
        // Something follows, and is not read.
        values.push(f64::NAN);
        return Err(Fault::Stopped);
    }
    let (wanted, count) = field_of(bytes, layout, field);
    let value = wanted.and_then(|text| layout.columns[field].value(text, layout.decimal));
    if let Some(value) = value
        && count == layout.columns.len()
        && !matches!(bytes.first(), Some(b'#' | b'%'))
    {
        values.push(value);
        return Ok(());
    }
    let trimmed = bytes.trim_ascii();
    if trimmed.is_empty() || matches!(trimmed[0], b'#' | b'%') {
        return Ok(());
    }
    if layout.lenient {
        values.push(f64::NAN);
        return Ok(());
    }
    if count != layout.columns.len() {
        return Err(Fault::Row { line, expected: layout.columns.len(), got: count });
    }
    let wanted = wanted.unwrap_or_default();
    let text = shown(wanted);
    let column = layout.columns[field].name.clone();
    let has_point = layout.decimal == Some(Decimal::Comma) && number(wanted, Some(Decimal::Point)).is_some();
    Err(if has_point { Fault::Point { line, column, text } } else { Fault::Number { line, column, text } })
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::super::layout::find;
    use super::*;

    /// Values and fault of a text, however it is cut up.
    fn read(text: &str, field: usize, cut: &Cut) -> (Vec<f64>, Option<String>) {
        let layout = find(text.as_bytes()).unwrap();
        let mut reader = &text.as_bytes()[layout.start as usize..];
        let mut values = Vec::new();
        let mut sink = |piece: &[f64]| {
            values.extend_from_slice(piece);
            ControlFlow::Continue(())
        };
        let done = in_blocks(&mut reader, &Wanted::of(&layout, field), &mut sink, cut);
        (values, done.err().map(|fault| format!("{fault:?}")))
    }

    #[test]
    fn prop_blocks_and_threads_change_nothing() {
        let mut text = String::from("a,b,c\n");
        let mut expected = Vec::new();
        for i in 0..3000 {
            let value = f64::from(i * 7919 % 2003 - 1000) / 16.0;
            match i % 97 {
                0 => text += "\n# a remark\n",
                1 => text += "  \r\n",
                _ => {}
            }
            // Plain lines among such as are not.
            match i % 13 {
                0 => text += &format!("1,{value:e},2\n"),
                1 => text += &format!(" 1 , {value} ,2\r\n"),
                2 => text += &format!("{},\"{value}\",\n", "0".repeat(200)),
                _ => text += &format!("{i},{value},-0.25\r\n"),
            }
            expected.push(value);
        }
        let cuts = [
            (50, 10, 1, false),
            (64, 1, 3, false),
            (700, 100, 4, false),
            (4096, 1000, 2, false),
            (1 << 20, 5000, 8, false),
            (50, 10, 1, true),
            (4096, 1000, 2, true),
        ];
        let cuts = cuts.map(|(block, share, threads, single)| Cut { block, share, threads, single });
        for cut in &cuts {
            assert_eq!(read(&text, 1, cut), (expected.clone(), None), "{}", cut.block);
            // Without an end to the last line.
            let open = text.trim_end();
            assert_eq!(read(open, 1, cut), (expected.clone(), None), "{}", cut.block);
        }
        // One column: a line without a number may stand for one, but at the end.
        for (between, is_blank) in [("\n", true), ("  \r\n", true), ("# a remark\n", false)] {
            let numbers = "0.5\n".repeat(700);
            for cut in &cuts {
                let ends = format!("a\n{numbers}{between}{between}");
                assert_eq!(read(&ends, 0, cut), (vec![0.5; 700], None), "{}", cut.block);
                let fault = format!("Between {{ line: 702, blank: {is_blank} }}");
                assert_eq!(read(&format!("{ends}{numbers}"), 0, cut).1.as_ref(), Some(&fault), "{}", cut.block);
            }
        }
        let line = text.matches('\n').count() + 1;
        let more = "5,0,0\n".repeat(100);
        for (bad, fault) in [
            ("1,2\n", format!("Row {{ line: {line}, expected: 3, got: 2 }}")),
            ("1,x,2\n", format!("Number {{ line: {line}, column: \"b\", text: \"x\" }}")),
        ] {
            let text = format!("{text}{bad}{more}{bad}");
            for cut in &cuts {
                assert_eq!(read(&text, 1, cut).1.as_ref(), Some(&fault), "{}", cut.block);
            }
        }
    }
}
